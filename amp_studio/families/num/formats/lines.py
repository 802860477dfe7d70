"""The lines of a NUM parameter table: their lengths, its start and its end, headers with their data lines."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from amp_studio.formats import FormatError

from .layout import XOFF, TableLayout
from .words import Word

_LINE = re.compile(r"(.*);([0-9A-F]{2})")
_START = re.compile(r"%([0-9]{8})(?![0-9])([ -~]*)")
HEADER = re.compile(r"P(0|[1-9][0-9]{0,3})N(0|[1-9][0-9]{0,3})(?::t([0-9])n([1-9][0-9]{0,3}))?")
_HEADER_PARTS = (
    ("P", "'P'"),
    ("0|[1-9][0-9]{0,3}", "the number of the parameter"),
    ("N", "'N'"),
    ("0|[1-9][0-9]{0,3}", "the number of its first word"),
    (":t", "':t' or the end"),
    ("[0-9]", "the code of a type"),
    ("n", "'n'"),
    ("[1-9][0-9]{0,3}", "the number of words"),
)
_TAIL = re.compile(r"(?:\r\n|\n)*\x1a?[\0\r\n]*")


@dataclass(frozen=True, slots=True)
class Block:
    """A header and its data line."""

    line: int
    """Of the header; the data line is the next one."""
    header: str
    first: Word
    code: int | None
    """None in the tables of older software, which do not give it."""
    count: int | None
    data: str
    """The data line behind its ``#``."""


def _content(text: str, n: int) -> str:
    """Return a line without its length; raises FormatError where it has none or another one."""
    match = _LINE.fullmatch(text)
    if match is None:
        raise _unmeasured(text, n)
    if odd := re.search(r"[^ -~]", match[1]):
        raise FormatError(
            f"the character with the code {ord(odd[0])} has no place in a line", n, odd.start() + 1
        )
    length = len(match[1])
    if int(match[2], 16) != length:
        raise FormatError(
            f"the line has {length} characters, {length:02X} in hexadecimal, and gives {match[2]}",
            n,
            length + 2,
        )
    return match[1]


def _unmeasured(text: str, n: int) -> FormatError:
    """Return what is wrong with a line that does not end with its length."""
    if not text.strip():
        return FormatError("an empty line", n, 1)
    if text.endswith("\r") or "\n" in text:
        place = re.search(r"\r?\n|\r$", text)
        return FormatError(
            "the line ends otherwise than the first one", n, place.start() + 1 if place else None
        )
    written = list(re.finditer(r";[0-9A-Fa-f]{2}", text))
    if not written:
        return FormatError("the line does not close with ';' and two digits for its length", n, len(text) + 1)
    last = written[-1]
    if last.end() == len(text):
        return FormatError(f"the length is written with capitals: {last[0][1:].upper()}", n, last.start() + 2)
    return FormatError("something comes after the length of the line", n, last.end() + 1)


def _place_behind(text: str) -> tuple[int, int]:
    """Return line and column of what follows a text."""
    return text.count("\n") + 1, len(text.rpartition("\n")[2]) + 1


def _without_end(text: str) -> FormatError:
    """Return the error of a table without Xoff: its name is written there, or it was cut off."""
    word = re.search(r"^[ \t]*X[ -]?off\b", text, re.IGNORECASE | re.MULTILINE)
    if word is not None:
        line = text[: word.start()].count("\n") + 1
        return FormatError("the table ends with the character Xoff (ALT 19), not with its name", line, 1)
    return FormatError(
        "the table has no Xoff (ALT 19) at its end: it may have been cut off", *_place_behind(text)
    )


def split_table(text: str) -> tuple[list[str], TableLayout]:
    """Return the lines of a table without their lengths, the start apart; raises FormatError."""
    body, xoff, tail = text.partition(XOFF)
    if not xoff:
        raise _without_end(text)
    behind = _TAIL.match(tail)
    if behind is None or behind.end() != len(tail):
        before = f"{body}{xoff}{tail[: behind.end() if behind else 0]}"
        raise FormatError("something comes after Xoff, which ends the table", *_place_behind(before))
    # By the first line: one that ends otherwise was joined from two files, or damaged.
    line_end = "\r\n" if body.partition("\n")[0].endswith("\r") else "\n"
    lines = body.split(line_end)
    end = xoff + tail
    if lines[-1] == "":
        lines.pop()
        end = line_end + end
    # The length of each line is its only checksum.
    lines = [_content(line, n) for n, line in enumerate(lines, 1)]
    start = _START.fullmatch(lines[0]) if lines else None
    if start is None:
        raise FormatError("a table begins with '%' and the eight digits of the job reference", 1, 1)
    return lines[1:], TableLayout(start[1], start[2], line_end, end)


def blocks_of(lines: list[str]) -> Iterator[Block]:
    """Yield the headers with their data lines; the first of the lines is the second of the table."""
    header: tuple[int, re.Match[str]] | None = None
    for n, line in enumerate(lines, 2):
        if line.startswith("#"):
            if header is None:
                raise FormatError("a data line without a header PaNb before it", n, 1)
            at, head = header
            a, b, code, count = (None if number is None else int(number) for number in head.groups())
            yield Block(at, head[0], (a or 0, b or 0), code, count, line[1:])
            header = None
            continue
        if header is not None:
            break
        match = HEADER.fullmatch(line)
        if match is None:
            raise _no_header(line, n)
        header = n, match
    if header is not None:
        raise FormatError(f"{header[1][0]} has no data line", header[0], 1)


def _no_header(line: str, n: int) -> FormatError:
    """Return at which character a line stops to be a header."""
    at = 0
    for pattern, expected in _HEADER_PARTS:
        match = re.compile(pattern).match(line, at)
        if match is None:
            return FormatError(f"{expected} is expected here, as in P9N0:t0n32", n, at + 1)
        at = match.end()
    return FormatError("the header goes on behind the number of words", n, at + 1)
