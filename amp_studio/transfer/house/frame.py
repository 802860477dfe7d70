"""Frames: how one message is written in a stream of bytes.

    frame   = COBS(body) 00
    body    = type u8, sequence u16, payload, CRC-32 u32      (numbers little-endian)

COBS (consistent overhead byte stuffing) leaves no zero byte in what it encodes, so a zero byte always ends a
frame. What the decoder assumes and how it recovers:

- garbage before a frame: it is dropped with the frame it ran into; a single
  00 in front of the first frame of a line ends whatever was there before.
- a changed, lost or added byte inside a frame: the CRC differs, that frame is
  dropped and counted, the next one is read.
- a lost 00: two frames run together and are both dropped.
- no 00 at all: nothing longer than the longest frame is kept.
"""

from __future__ import annotations

import struct
import zlib
from dataclasses import dataclass

MAX_PAYLOAD = 4_160  # bytes: a chunk of 4096 and its head
HEAD = struct.Struct("<BH")
CHECK = struct.Struct("<I")
_MAX_BODY = HEAD.size + MAX_PAYLOAD + CHECK.size
MAX_ENCODED = _MAX_BODY + _MAX_BODY // 254 + 1


@dataclass(frozen=True)
class Frame:
    """One frame: ``type`` 0 to 255, ``sequence`` 0 to 65535, up to MAX_PAYLOAD bytes."""

    type: int
    sequence: int
    payload: bytes = b""


def encode_frame(frame: Frame) -> bytes:
    """Return the bytes of a frame with the 00 that ends it; raises ValueError for too long a payload."""
    if len(frame.payload) > MAX_PAYLOAD:
        raise ValueError(f"a payload of {len(frame.payload)} bytes does not fit a frame ({MAX_PAYLOAD})")
    body = HEAD.pack(frame.type, frame.sequence) + frame.payload
    return cobs_encode(body + CHECK.pack(zlib.crc32(body))) + b"\x00"


def _decode_frame(encoded: bytes) -> Frame | None:
    """Return the frame between two zero bytes, or None when it is damaged."""
    body = cobs_decode(encoded)
    if body is None or not HEAD.size + CHECK.size <= len(body) <= _MAX_BODY:
        return None
    content, check = body[: -CHECK.size], body[-CHECK.size :]
    if CHECK.unpack(check)[0] != zlib.crc32(content):
        return None
    kind, sequence = HEAD.unpack_from(content)
    return Frame(kind, sequence, content[HEAD.size :])


class FrameDecoder:
    """Finds the frames in a stream that comes in pieces; ``bad_frames`` counts those it had to drop."""

    def __init__(self) -> None:
        self.bad_frames = 0
        self._buffer = b""
        self._skipping = False

    def feed(self, data: bytes) -> list[Frame]:
        """Return the whole frames that end within ``data``."""
        *ended, rest = data.split(b"\x00")
        frames = [frame for piece in ended if (frame := self._end(piece)) is not None]
        self._keep(rest)
        return frames

    def _end(self, piece: bytes) -> Frame | None:
        """Return the frame that ends with a piece; None for an empty or damaged one, which is counted."""
        encoded, self._buffer = self._buffer + piece, b""
        if self._skipping or len(encoded) > MAX_ENCODED:
            self._skipping = False
            self.bad_frames += 1
            return None
        if not encoded:
            return None
        frame = _decode_frame(encoded)
        if frame is None:
            self.bad_frames += 1
        return frame

    def _keep(self, rest: bytes) -> None:
        if self._skipping:
            return
        self._buffer += rest
        if len(self._buffer) > MAX_ENCODED:
            self._buffer, self._skipping = b"", True


def cobs_encode(data: bytes) -> bytes:
    """Return ``data`` without zero bytes: each becomes the distance to the next one (or to the end).

    A code byte n (1 to 254) means n - 1 bytes and a zero, 255 for 254 bytes and no zero; the zero after
    the last group is not part of the data.
    """
    out = bytearray()
    for run in data.split(b"\x00"):
        whole = len(run) // 254 * 254
        for start in range(0, whole, 254):
            out.append(255)
            out += run[start : start + 254]
        out.append(len(run) - whole + 1)
        out += run[whole:]
    if run and whole == len(run):
        del out[-1]  # the data ends with a full group: there is no zero left to write
    return bytes(out)


def cobs_decode(encoded: bytes) -> bytes | None:
    """Return what was encoded, or None where a code points past the end or is zero."""
    out = bytearray()
    at, end = 0, len(encoded)
    while at < end:
        code = encoded[at]
        if code == 0 or at + code > end:
            return None
        out += encoded[at + 1 : at + code]
        at += code
        if code < 255 and at < end:
            out.append(0)
    return bytes(out)
