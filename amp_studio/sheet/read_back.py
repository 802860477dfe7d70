"""What the control's screen shows after the values have been keyed in,
typed in by a person and compared exactly.
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Literal

from amp_studio.errors import AmpStudioError
from amp_studio.files import ParameterFile
from amp_studio.schema import Address, UnknownParameterError, quoted

from .model import Sheet, SheetEntry

ReadBackState = Literal["same", "old", "other", "not read"]
"""``old``: the screen still shows what the control contained before."""

STATES: dict[ReadBackState, str] = {
    "same": "as keyed in",
    "old": "still the old value",
    "other": "another value",
    "not read": "not read back",
}

_NUMBER_HEAD, _SHOWN_HEAD = "number", "read back"
_MAX_CHARACTERS = 1 << 20  # characters
_LINE = re.compile(r"([^\s=;:,]+)(?:,\s*|\s*[=;:]\s*|\s+)(.*)")


class ReadBackError(AmpStudioError, ValueError):
    """A text that is no list of numbers and values; ``line`` counts from 1."""

    def __init__(self, what: str, line: int) -> None:
        super().__init__(f"line {line}: {what}")
        self.line = line


@dataclass(frozen=True)
class ScreenReading:
    """What the operator has read on the screen for a number, and the line he wrote it on."""

    number: str
    text: str
    line: int


@dataclass(frozen=True)
class ReadBack:
    """One entry and what the screen shows for it: ``screen_text`` is None where it was not read."""

    entry: SheetEntry
    screen_text: str | None
    state: ReadBackState


def read_screen_readings(text: str) -> list[ScreenReading]:
    """Return what the operator has read on the screen, of lines ``1750 203.20000``; raises ReadBackError.

    Number and value are parted by blanks, a tab, or one of ``= ; : ,``; what begins with ``#`` is for the
    reader. The sheet's own CSV is taken too, with its column ``read back`` filled in.
    """
    if len(text) > _MAX_CHARACTERS:
        raise ReadBackError(f"the text has more than {_MAX_CHARACTERS} characters", 1)
    lines = text.removeprefix("\ufeff").splitlines()
    first = next((line for line in lines if line.strip() and not line.startswith("#")), "")
    heads = next(csv.reader([first], delimiter=_delimiter(first)), [])
    if {_SHOWN_HEAD, _NUMBER_HEAD} <= {*heads}:
        return _of_table(lines, _delimiter(first))
    stripped = ((n, line.strip()) for n, line in enumerate(lines, 1))
    return [_reading(line, n) for n, line in stripped if line and not line.startswith("#")]


def _reading(line: str, n: int) -> ScreenReading:
    """Return number and value of a line; raises ReadBackError."""
    parts = _LINE.fullmatch(line)
    if parts is None or not parts[2].strip():
        raise ReadBackError(f"{quoted(line)} is not a number and the value that the screen shows", n)
    return ScreenReading(parts[1], parts[2].strip(), n)


def _delimiter(line: str) -> str:
    return ";" if line.count(";") > line.count(",") else ","


def _of_table(lines: list[str], delimiter: str) -> list[ScreenReading]:
    """Return what was filled into the sheet's own table; raises ReadBackError."""
    readings: list[ScreenReading] = []
    reader = csv.reader(io.StringIO("\n".join(lines)), delimiter=delimiter)
    head: list[str] | None = None
    for row in _rows(reader):
        if head is None:
            head = row
            continue
        cells = dict(zip(head, row, strict=False))
        # The apostrophe is how the sheet keeps a spreadsheet from taking a text for a formula
        # (``text_cell``).
        if screen_text := cells.get(_SHOWN_HEAD, "").strip().removeprefix("'"):
            number = cells.get(_NUMBER_HEAD, "").strip().removeprefix("'")
            readings.append(ScreenReading(number, screen_text, reader.line_num))
    return readings


def _rows(reader: Iterator[list[str]]) -> Iterator[list[str]]:
    try:
        yield from reader
    except csv.Error as error:
        raise ReadBackError(f"the table cannot be read ({error})", getattr(reader, "line_num", 1)) from None


def compare_screen(sheet: Sheet, file: ParameterFile, screen_text: Iterable[ScreenReading]) -> list[ReadBack]:
    """Compare every entry of a file's sheet with what the screen shows.

    Raises ReadBackError for a number that is not on the sheet, or that is there twice.
    """
    entries = {entry.address: entry for entry in sheet.entries}
    given: dict[Address, str] = {}
    for each in screen_text:
        try:
            address = file.find(each.number)
        except UnknownParameterError as error:
            raise ReadBackError(str(error), each.line) from None
        if address not in entries:
            raise ReadBackError(f"{quoted(each.number)} is not on this sheet", each.line)
        if address in given:
            raise ReadBackError(f"{quoted(each.number)} occurs twice", each.line)
        given[address] = each.text
    return [judged(entry, given.get(address)) for address, entry in entries.items()]


def judged(entry: SheetEntry, screen_text: str | None) -> ReadBack:
    """Compare one entry with what the screen shows; blank is not read."""
    if screen_text is None or not screen_text.strip():
        return ReadBack(entry, None, "not read")
    if entry.keyed.shows(screen_text):
        return ReadBack(entry, screen_text, "same")
    is_old = entry.was is not None and entry.was.shows(screen_text)
    return ReadBack(entry, screen_text, "old" if is_old else "other")
