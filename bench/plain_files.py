"""How much of a line plain files use: XMODEM and YMODEM beside sz and rz, in one run over one cable.

``python bench/plain_files.py [BYTES]``. The cable is a pseudo terminal of 11,520 bytes a second each way
(115,200 bit/s), clean, and with one byte of so many changed. 100 % is the time the bytes alone take.
"""

import contextlib
import random
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from amp_studio.transfer.links.endpoint import parse_endpoint
from amp_studio.transfer.plain.files import receive_files, send_files
from amp_studio.transfer.plain.line import PlainFileError
from amp_studio.transfer.plain.ymodem import PlainFile
from tests.transfer.cable import Cable

RATE = 11_520.0  # bytes a second
NOISES = (0, 20_000, 5_000)
PEERS = {
    "sz to rz (ZMODEM)": (["sz", "-b"], ["rz", "-b"]),
    "sb to rb (YMODEM)": (["sb", "-b"], ["rb", "-b"]),
    "sx -k to rx -c (XMODEM-1K)": (["sx", "-b", "-k"], ["rx", "-b", "-c"]),
}
LIMIT = 20.0  # times the time of the bytes alone, after which a run is ended


def main() -> None:
    """Print one line a way."""
    size = int(sys.argv[1]) if len(sys.argv) > 1 else 40_000
    content = random.Random(1).randbytes(size)
    print(
        f"{size} bytes at {RATE:g} bytes/s; one byte changed of: "
        + ", ".join(str(n or "none") for n in NOISES)
    )
    for name, run in ways(content):
        print(
            f"{name:32}" + "".join(f"{efficiency(run, content, noise):>10}" for noise in NOISES), flush=True
        )


def efficiency(run: Callable[[Cable, Path], bytes], content: bytes, noise: int) -> str:
    """Return the per cent of the line that a way used, or what came of it."""
    with tempfile.TemporaryDirectory() as name, Cable(rate=RATE, noise=noise) as cable:
        (Path(name) / "file").write_bytes(content)
        began = time.monotonic()
        try:
            got = run(cable, Path(name))
        except (PlainFileError, OSError):
            return "failed"
        took = time.monotonic() - began
        return (
            f"{len(content) / RATE / took:.0%}"
            if got.rstrip(b"\x1a") == content.rstrip(b"\x1a")
            else "failed"
        )


def ways(content: bytes) -> Iterator[tuple[str, Callable[[Cable, Path], bytes]]]:
    """Yield this program against the peers, and the peers among themselves."""
    for protocol, sender in (
        ("xmodem", ["sx", "-b"]),
        ("xmodem-1k", ["sx", "-b", "-k"]),
        ("ymodem", ["sb", "-b"]),
    ):

        def receive(
            cable: Cable, folder: Path, protocol: str = protocol, sender: list[str] = sender
        ) -> bytes:
            port = parse_endpoint(f"{cable.port()}?baud=115200")
            with running(cable, [*sender, "file"], folder):
                return receive_files(port, protocol)[0].content

        yield f"receive --protocol {protocol}", receive
    for protocol, receiver in (
        ("xmodem", ["rx", "-b", "-c"]),
        ("xmodem-1k", ["rx", "-b", "-c"]),
        ("ymodem", ["rb", "-b"]),
    ):

        def send(
            cable: Cable, folder: Path, protocol: str = protocol, receiver: list[str] = receiver
        ) -> bytes:
            out = folder / "out"
            out.mkdir()
            port = parse_endpoint(f"{cable.port()}?baud=115200")
            command = [*receiver, *(() if protocol == "ymodem" else ("file",))]
            with running(cable, command, out, wait=True):
                send_files(port, protocol, [PlainFile("file", content)])
            return (out / "file").read_bytes()

        yield f"send --protocol {protocol}", send
    for name, (peer_sender, peer_receiver) in PEERS.items():

        def both(
            cable: Cable, folder: Path, sender: list[str] = peer_sender, receiver: list[str] = peer_receiver
        ) -> bytes:
            out = folder / "out"
            out.mkdir()
            names = ["file"] if receiver[0] == "rx" else []
            with (
                running(cable, [*receiver, *names], out, wait=True),
                running(cable, [*sender, "file"], folder, wait=True),
            ):
                pass
            return (out / "file").read_bytes()

        yield name, both


@contextlib.contextmanager
def running(cable: Cable, command: list[str], folder: Path, *, wait: bool = False) -> Iterator[None]:
    """Run a program at one end of the cable; ``wait`` for its own end."""
    process = cable.attach(command, folder)
    try:
        yield
        if wait:
            with contextlib.suppress(Exception):
                process.wait(LIMIT * 10)
    finally:
        process.kill()
        process.wait()


if __name__ == "__main__":
    main()
