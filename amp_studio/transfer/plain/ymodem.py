"""YMODEM: files with their names and sizes, one after the other; an empty name ends the batch."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from .blocks import SHORT, SUB
from .line import ByteLine, PlainFileError
from .receiver import BlockReceiver
from .sender import BlockSender

_MAX_FILES = 100  # of one batch
_LONGEST_NAME = 100  # bytes: name, size and their ends fit into one short block
_UNSUITABLE = re.compile(r'[<>:"|?*\x00-\x1f\x7f]')


@dataclass(frozen=True)
class PlainFile:
    """``name`` is "" where none came along; ``padding`` the bytes (1Ah) that were taken off its end."""

    name: str
    content: bytes
    padding: int = 0


def send_batch(sender: BlockSender, files: Sequence[PlainFile]) -> None:
    """Send files; raises PlainFileError."""
    for file in files:
        sender.await_start()
        sender.send_block(0, header_of(file))
        sender.await_start()
        sender.send(file.content)
    sender.await_start()
    sender.send_block(0, bytes(SHORT))


def receive_batch(line: ByteLine) -> list[PlainFile]:
    """Return the files of a batch; raises PlainFileError."""
    receiver, files = BlockReceiver(line, may_fall_back=False), list[PlainFile]()
    while True:
        header = receiver.block(0, is_first=True)
        name, size = read_header(header or b"")
        if not name:
            receiver.finish()
            return files
        if len(files) == _MAX_FILES:
            raise PlainFileError(f"the other end sends more than {_MAX_FILES} files")
        content = receiver.receive(size)
        if size is None:
            files.append(without_padding(name, content))
            continue
        if len(content) < size:
            raise PlainFileError(f"only {len(content)} of {size} bytes have come")
        files.append(PlainFile(name, content[:size]))


def header_of(file: PlainFile) -> bytes:
    """Return what block 0 contains; raises PlainFileError for a name that does not fit."""
    name = file.name.encode()
    if not 0 < len(name) <= _LONGEST_NAME or 0 in name:
        raise PlainFileError(f"a name of {len(name)} bytes cannot be sent: it has {_LONGEST_NAME} at most")
    return (name + b"\0" + str(len(file.content)).encode() + b"\0").ljust(SHORT, b"\0")


def read_header(block: bytes) -> tuple[str, int | None]:
    """Return the name that a sender gives, "" for the end of the batch, and the size if it names one."""
    name, _, rest = block.partition(b"\0")
    size = re.match(rb"\d{1,12}(?=[ \0]|$)", rest)
    return name.decode("utf-8", errors="replace"), int(size[0]) if size else None


def file_name(name: str) -> str:
    """Return the name under which a file of a stranger may be saved in a folder: no path,
    nothing that is hidden or special.
    """
    last = re.split(r"[/\\]", name)[-1]
    last = "".join(
        character if character.isprintable() else "_" for character in _UNSUITABLE.sub("_", last)
    ).strip(" .")
    return last[:_LONGEST_NAME] or "file"


def without_padding(name: str, content: bytes) -> PlainFile:
    """Return a file without the 1Ah that fill its last block up."""
    kept = content.rstrip(bytes([SUB]))
    return PlainFile(name, kept, len(content) - len(kept))
