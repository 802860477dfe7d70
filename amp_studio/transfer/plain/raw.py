"""Raw text as a tape punch and reader have it: a leader, ``%``, the text, ``%``, a trailer;
nothing is acknowledged.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from .line import ByteLine, PlainFileError
from .receiver import LARGEST

_PIECE_SECONDS = 0.2  # of a slow line between two looks
PIECE = 1_024
_FILLERS = b"\0\x7f"  # blank tape, and what was rubbed out on it
_END = re.compile(rb"[\r\n\0]%(?=[ \0]*[\r\n\0])")
_LAST = re.compile(rb"[\r\n\0]%[ \0\x7f]*\Z")


@dataclass(frozen=True)
class Tape:
    """``leader`` bytes of ``filler`` come before and after;
    ``percent`` marks begin and end of the text by ``%``.
    """

    leader: int = 0
    filler: bytes = b"\0"
    percent: bool = False


def punch(line: ByteLine, content: bytes, tape: Tape, rate: float | None) -> None:
    """Send a text; it has left this end at the return, and whether it has arrived is not confirmed."""
    data = punched(content, tape)
    piece = PIECE if rate is None else max(1, min(PIECE, int(rate * _PIECE_SECONDS)))
    for at in range(0, len(data), piece):
        line.await_time(line.put(data[at : at + piece]))
        line.progress("send", min(at + piece, len(data)), len(data))


def punched(content: bytes, tape: Tape) -> bytes:
    """Return the tape of a text; a ``%`` that it has already is not doubled."""
    if tape.percent:
        end = b"\r\n" if b"\r\n" in content else b"\n"
        if not content.lstrip(_FILLERS + b" \r\n").startswith(b"%"):
            content = b"%" + end + content
        if not re.search(rb"[\r\n]%[\s\0]*\Z", content):
            content += (b"" if content.endswith((b"\n", b"\r")) else end) + b"%" + end
    blank = tape.filler * tape.leader
    return blank + content + blank


def read_tape(line: ByteLine, tape: Tape, idle: float) -> bytes:
    """Return a text: from ``%`` to ``%``, or until nothing more has come for ``idle`` seconds.

    Leader and trailer are left out. Raises PlainFileError where nothing comes, or too much.
    """
    got, start = bytearray(), -1
    while came := line.get(1, line.patience.start if not got else idle):
        got += came + line.waiting()
        if len(got) > LARGEST:
            raise PlainFileError(f"the other end sends more than {LARGEST} bytes")
        line.progress("receive", len(got), 0)
        if tape.percent:
            start = got.find(b"%") if start < 0 else start
            if start >= 0 and (end := _END.search(got, start + 1)):
                return bytes(got[start : end.end()]) + b"\n"
    if tape.percent:
        return _between_percents(bytes(got))
    return _without_fillers(bytes(got), tape, line.patience.start)


def _without_fillers(got: bytes, tape: Tape, seconds: float) -> bytes:
    """Return a text without leader and trailer; raises PlainFileError where there is nothing else."""
    text = got.strip(_FILLERS + (tape.filler if tape.filler != b"\0" else b""))
    if not text:
        raise PlainFileError(f"nothing has come for {seconds:g} s")
    return text


def _between_percents(got: bytes) -> bytes:
    """Return a text from its first ``%`` to one at the end of all; raises PlainFileError."""
    start = got.find(b"%")
    if start < 0:
        raise PlainFileError("no % has come")
    if not (end := _LAST.search(got, start + 1)):
        raise PlainFileError("the text has no % at its end: it may have been cut off")
    return got[start : end.start() + 2] + b"\n"
