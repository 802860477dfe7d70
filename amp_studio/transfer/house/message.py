"""Messages: what the two ends send to each other, one frame each.

A message declares its fields with the words of ``docs/protocols/exchange.md``:

    u8 u16 u32   unsigned, little-endian         flag      one byte, 0 or 1
    bytes4 bytes16 bytes32  that many bytes      text      u8 length, then UTF-8
    rest         all bytes that are left
"""

from __future__ import annotations

import dataclasses
import struct
from collections.abc import Callable
from dataclasses import dataclass
from enum import IntEnum, IntFlag
from typing import Any, ClassVar, TypeVar

from .frame import MAX_PAYLOAD, Frame

PROTOCOL_VERSION = 1
MAX_CHUNK = 4_096  # bytes of an image in one Data


class Code(IntEnum):
    """Why something was refused."""

    MALFORMED = 1
    UNSUPPORTED = 2
    VERSION = 3
    BUSY = 4
    NOT_IN_ESTOP = 5
    SIGNATURE = 6
    IMAGE_CHANGED = 7
    TOO_LARGE = 8
    STORAGE = 9
    UNKNOWN_TRANSFER = 10
    INCOMPLETE = 11
    DIGEST = 12
    NO_UPLOAD = 13
    OUT_OF_RANGE = 14
    ALREADY_COMMITTED = 15
    REJECTED = 16


class RefusalError(Exception):
    """A request that is not done: raised where it is judged, and again at the other end of the line."""

    def __init__(self, code: int, text: str) -> None:
        super().__init__(text)
        self.code = code
        self.text = text


class Flags(IntFlag):
    """The state of a control."""

    ESTOP = 1
    RUNNING = 2
    RESTART_NEEDED = 4
    AUTOSTART = 8
    CHANGED_AT_CONTROL = 16


def _wire(kind: str) -> Any:
    return dataclasses.field(metadata={"wire": kind})


@dataclass(frozen=True)
class Message:
    """Any message; ``TYPE`` is the frame's type byte."""

    TYPE: ClassVar[int] = 0


@dataclass(frozen=True)
class Hello(Message):
    """The first word on a line. The nonce comes back, so that an answer to an earlier Hello is not taken."""

    TYPE = 0x01
    version: int = _wire("u8")
    nonce: bytes = _wire("bytes4")
    client: str = _wire("text")


@dataclass(frozen=True)
class OpenDownload(Message):
    """Begins a download or takes it up again. ``expected`` is the digest of the image it is to replace."""

    TYPE = 0x03
    transfer: bytes = _wire("bytes16")
    size: int = _wire("u32")
    sha256: bytes = _wire("bytes32")
    expected: bytes = _wire("bytes32")
    signature: str = _wire("text")


@dataclass(frozen=True)
class Data(Message):
    """A piece of an image, to the control (download) or from it (upload)."""

    TYPE = 0x04
    offset: int = _wire("u32")
    content: bytes = _wire("rest")


@dataclass(frozen=True)
class Commit(Message):
    """Asks the control to put the staged image in the place of the active one."""

    TYPE = 0x05
    transfer: bytes = _wire("bytes16")
    sha256: bytes = _wire("bytes32")


@dataclass(frozen=True)
class OpenUpload(Message):
    """Asks the control to keep a copy of its image unchanged, to be read."""

    TYPE = 0x06


@dataclass(frozen=True)
class Read(Message):
    """Asks for a piece of that copy."""

    TYPE = 0x07
    offset: int = _wire("u32")
    length: int = _wire("u16")


@dataclass(frozen=True)
class Abort(Message):
    """Gives a download up; what is staged is thrown away."""

    TYPE = 0x08
    transfer: bytes = _wire("bytes16")


@dataclass(frozen=True)
class Welcome(Message):
    """Who the control is, what it contains, and what it can take at once."""

    TYPE = 0x81
    version: int = _wire("u8")
    nonce: bytes = _wire("bytes4")
    family: str = _wire("text")
    signature: str = _wire("text")
    name: str = _wire("text")
    revision: str = _wire("text")
    flags: int = _wire("u8")
    incarnation: int = _wire("u32")
    size: int = _wire("u32")
    sha256: bytes = _wire("bytes32")
    window: int = _wire("u8")
    chunk: int = _wire("u16")


@dataclass(frozen=True)
class Ready(Message):
    """A download may go on from this offset."""

    TYPE = 0x83
    offset: int = _wire("u32")


@dataclass(frozen=True)
class Ack(Message):
    """The Data of this number is kept; everything before ``next`` is staged."""

    TYPE = 0x84
    next: int = _wire("u32")


@dataclass(frozen=True)
class Gap(Message):
    """The Data of this number is not kept, because what comes before it is missing from ``next`` on."""

    TYPE = 0x85
    next: int = _wire("u32")


@dataclass(frozen=True)
class Committed(Message):
    """The image with this digest is the active one. ``incarnation`` is the one before the restart."""

    TYPE = 0x86
    transfer: bytes = _wire("bytes16")
    sha256: bytes = _wire("bytes32")
    incarnation: int = _wire("u32")
    restarting: bool = _wire("flag")


@dataclass(frozen=True)
class UploadReady(Message):
    """The copy to be read."""

    TYPE = 0x87
    size: int = _wire("u32")
    sha256: bytes = _wire("bytes32")


@dataclass(frozen=True)
class Aborted(Message):
    """Nothing is staged for this transfer, and the active image was not touched by it."""

    TYPE = 0x88
    transfer: bytes = _wire("bytes16")


@dataclass(frozen=True)
class Refused(Message):
    """Why the request was not done; nothing has changed by it."""

    TYPE = 0xFF
    code: int = _wire("u8")
    text: str = _wire("text")


MESSAGES: dict[int, type[Message]] = {
    kind.TYPE: kind
    for kind in (
        Hello,
        OpenDownload,
        Data,
        Commit,
        OpenUpload,
        Read,
        Abort,
        Welcome,
        Ready,
        Ack,
        Gap,
        Committed,
        UploadReady,
        Aborted,
        Refused,
    )
}

AnyMessage = TypeVar("AnyMessage", bound=Message)


LAYOUTS: dict[int, tuple[tuple[str, str], ...]] = {
    number: tuple((field.name, field.metadata["wire"]) for field in dataclasses.fields(kind))
    for number, kind in MESSAGES.items()
}
"""The fields of each message in the order of the wire: name and kind."""


def pack(message: Message, sequence: int) -> Frame:
    """Return the frame of a message; raises ValueError for a value that its field cannot contain."""
    try:
        parts = [_PACK[kind](getattr(message, name)) for name, kind in LAYOUTS[message.TYPE]]
    except struct.error as error:
        raise ValueError(f"{message!r} cannot be packed: {error}") from None
    return Frame(message.TYPE, sequence, b"".join(parts))


def unpack(frame: Frame) -> Message:
    """Return the message of a frame; raises RefusalError for a type or a length that does not exist."""
    kind = MESSAGES.get(frame.type)
    if kind is None:
        raise RefusalError(Code.UNSUPPORTED, f"there is no message of type {frame.type:#04x}")
    values: list[Any] = []
    at = 0
    try:
        for _, wire in LAYOUTS[kind.TYPE]:
            value, at = _UNPACK[wire](frame.payload, at)
            values.append(value)
    except (struct.error, UnicodeDecodeError, IndexError, ValueError):
        raise RefusalError(Code.MALFORMED, f"a {kind.__name__} is damaged or too short") from None
    if at != len(frame.payload):
        raise RefusalError(Code.MALFORMED, f"a {kind.__name__} has {len(frame.payload) - at} bytes too many")
    return kind(*values)


def shorten(text: str) -> str:
    """Return as much of a text as a text field can contain (255 bytes of UTF-8)."""
    return text.encode("utf-8")[:255].decode("utf-8", errors="ignore")


# -- how each kind of field is written in the payload --------------------------------------------------


def _number(form: str) -> tuple[Callable[[Any], bytes], Callable[[bytes, int], tuple[Any, int]]]:
    packer = struct.Struct(form)
    return packer.pack, lambda data, at: (packer.unpack_from(data, at)[0], at + packer.size)


def _fixed(length: int) -> tuple[Callable[[Any], bytes], Callable[[bytes, int], tuple[Any, int]]]:
    """Return what packs and unpacks a field of so many bytes."""

    def pack_bytes(value: bytes) -> bytes:
        if len(value) != length:
            raise ValueError(f"{len(value)} bytes where {length} belong")
        return value

    def unpack_bytes(data: bytes, at: int) -> tuple[bytes, int]:
        if at + length > len(data):
            raise ValueError("too short")
        return data[at : at + length], at + length

    return pack_bytes, unpack_bytes


def _pack_text(value: str) -> bytes:
    encoded = value.encode("utf-8")
    if len(encoded) > 255:
        raise ValueError(f"a text of {len(encoded)} bytes, and 255 is the most")
    return bytes((len(encoded),)) + encoded


def _unpack_text(data: bytes, at: int) -> tuple[str, int]:
    end = at + 1 + data[at]
    if end > len(data):
        raise ValueError("too short")
    return data[at + 1 : end].decode("utf-8"), end


def _unpack_flag(data: bytes, at: int) -> tuple[bool, int]:
    if data[at] > 1:
        raise ValueError("neither 0 nor 1")
    return data[at] == 1, at + 1


_FIELDS = {
    "u8": _number("<B"),
    "u16": _number("<H"),
    "u32": _number("<I"),
    "bytes4": _fixed(4),
    "bytes16": _fixed(16),
    "bytes32": _fixed(32),
    "text": (_pack_text, _unpack_text),
    "flag": (lambda value: b"\x01" if value else b"\x00", _unpack_flag),
    "rest": (bytes, lambda data, at: (data[at:], len(data))),
}
_PACK = {kind: both[0] for kind, both in _FIELDS.items()}
_UNPACK = {kind: both[1] for kind, both in _FIELDS.items()}

assert MAX_CHUNK + 8 <= MAX_PAYLOAD
