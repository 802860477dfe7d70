"""Sending and receiving plain files over an endpoint, by the name of a protocol."""

from __future__ import annotations

import contextlib
import threading
from collections.abc import Iterator, Sequence
from dataclasses import replace

from amp_studio.schema import quoted
from amp_studio.transfer.links import Endpoint, Link, LinkError, SerialLink, connect, parse_endpoint
from amp_studio.transfer.progress import Progress, quiet

from .line import ByteLine, Patience, PlainFileError
from .raw import Tape, punch, read_tape
from .receiver import BlockReceiver
from .sender import BlockSender
from .ymodem import PlainFile, header_of, receive_batch, send_batch, without_padding

SENDING = ("xmodem", "xmodem-1k", "ymodem", "raw")
RECEIVING = ("xmodem", "xmodem-1k", "xmodem-checksum", "ymodem", "raw")
_IDLE = 5.0  # seconds without a byte that end a raw text


def protocol_of(address: str, protocol: str | None, known: Sequence[str]) -> tuple[Endpoint, str]:
    """Return the endpoint, and the protocol that is asked for or named in it; raises ValueError."""
    endpoint = parse_endpoint(address)
    name = protocol or endpoint.protocol or known[0]
    if name not in known:
        raise ValueError(f"Unknown protocol {quoted(name)} of a plain file. Known: {', '.join(known)}")
    if name != "raw":
        endpoint.need_all_bytes(name.partition("-")[0].upper())
    return endpoint, name


def send_files(
    endpoint: Endpoint,
    protocol: str,
    files: Sequence[PlainFile],
    *,
    tape: Tape | None = None,
    patience: Patience | None = None,
    progress: Progress = quiet,
    cancel: threading.Event | None = None,
) -> None:
    """Send files (one, unless by YMODEM); raises PlainFileError,
    whose ``at_control`` is "unknown" once some has arrived.
    """
    if protocol == "raw":
        _need_fitting(endpoint, files[0].content)
    if protocol == "ymodem":
        for file in files:
            header_of(file)  # a name that does not fit is refused before anything is opened
    with _line(endpoint, protocol != "raw", patience, progress, cancel) as (line, link):
        sender = BlockSender(line, long_blocks=protocol != "xmodem")
        try:
            if protocol == "raw":
                sender.has_begun = True
                punch(line, files[0].content, tape or Tape(), link.bytes_per_second)
                _drain(link)
            elif protocol == "ymodem":
                send_batch(sender, files)
            else:
                sender.await_start()
                sender.send(files[0].content)
        except PlainFileError as error:
            if sender.has_begun:
                error.at_control = "unknown"
                error.what += f"; {_what_arrived(protocol, sender, files)}"
            raise


def _what_arrived(protocol: str, sender: BlockSender, files: Sequence[PlainFile]) -> str:
    """Return how much of the files has arrived, in words."""
    if protocol == "raw":
        return "how much has arrived is not known: look at the control"
    total = sum(len(file.content) for file in files)
    done = sender.accepted_bytes
    return f"{done} of {total} bytes were acknowledged: look at the control what it has made of them"


def receive_files(
    endpoint: Endpoint,
    protocol: str,
    *,
    tape: Tape | None = None,
    idle: float = _IDLE,
    patience: Patience | None = None,
    progress: Progress = quiet,
    cancel: threading.Event | None = None,
) -> list[PlainFile]:
    """Return the files that come (one, unless by YMODEM); raises PlainFileError."""
    with _line(endpoint, protocol != "raw", patience, progress, cancel) as (line, _):
        if protocol == "ymodem":
            return receive_batch(line)
        if protocol == "raw":
            return [PlainFile("", read_tape(line, tape or Tape(), idle))]
        receiver = BlockReceiver(line, crc=protocol != "xmodem-checksum")
        content = receiver.receive(None)
        receiver.finish()
        return [without_padding("", content)]


def _drain(link: Link) -> None:
    """Wait for the other end of a serial line that stops the last bytes; raises PlainFileError."""
    if isinstance(link, SerialLink):
        try:
            link.drain()
        except LinkError as error:
            raise PlainFileError(f"not everything has left ({error})") from None


@contextlib.contextmanager
def _line(
    endpoint: Endpoint,
    is_block: bool,
    patience: Patience | None,
    progress: Progress,
    cancel: threading.Event | None,
) -> Iterator[tuple[ByteLine, Link]]:
    """Give the open line; after an error the other end is notified that nothing more comes."""

    def look() -> None:
        if cancel is not None and cancel.is_set():
            raise PlainFileError("stopped")

    try:
        link = connect(replace(endpoint, protocol=""), look=look)
    except LinkError as error:
        raise PlainFileError(f"no connection ({error})") from None
    with contextlib.closing(link):
        line = ByteLine(link, patience, progress, cancel)
        try:
            yield line, link
        except (PlainFileError, KeyboardInterrupt):
            if is_block:  # in a raw text it would be two more characters
                line.cancel_transfer()
            raise


def _need_fitting(endpoint: Endpoint, content: bytes) -> None:
    """Refuse bytes that a line of seven bits would change; raises ValueError."""
    if endpoint.serial_settings().bits == 8:
        return
    at = next((at for at, byte in enumerate(content) if byte > 0x7F), None)
    if at is not None:
        line = content.count(b"\n", 0, at) + 1
        raise ValueError(f"line {line} contains the byte {content[at]:02X}h, which 7 data bits cannot carry")
