"""The machine parameters of an emulated NUM control, as utility 5 loads, lists and unloads them.

Written from section 13.2.6 and page 1-3 of the NUM parameter manual;
it shares nothing with the driver and the text format.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from amp_studio.transfer.emulated import Memory

TABLE = "table"
"""The words as of the last load that came to its end; a table as the control unloads it."""
_TAKEN = "taken"
"""Lines of a load since then, in the order in which they came."""
_LINE = re.compile(rb"([ -~]*);([0-9A-F]{2})")
_HEADER = re.compile(r"P([0-9]{1,4})N([0-9]{1,4}):t([0-9])n([0-9]{1,4})")
_MAX_LINE_VALUES = 10
"""Values of a data line (page 13-14)."""


class TableError(ValueError):
    """A line that the control does not take; what is wrong with it."""


@dataclass(frozen=True)
class WordType:
    """A type of words (page 1-3): how one looks, and what it may be."""

    form: re.Pattern[str]
    base: int = 10
    low: float = float("-inf")
    high: float = float("inf")

    def takes(self, word: str) -> bool:
        """Return whether a word is of this type."""
        if not self.form.fullmatch(word):
            return False
        return self.low == float("-inf") or self.low <= int(word, self.base) <= self.high


def _hex(bits: int) -> WordType:
    return WordType(re.compile(f"[0-9A-F]{{1,{bits // 4}}}"), 16, 0, (1 << bits) - 1)


def _decimal(low: int, high: int) -> WordType:
    return WordType(re.compile("[+-]?[0-9]{1,10}"), 10, low, high)


_TYPES = {
    0: _hex(8),
    1: _decimal(-32_768, 32_767),
    2: _decimal(-99_999_999, 99_999_999),
    4: _decimal(0, 99_999_999),
    5: _decimal(0, 65_535),
    6: _hex(32),
    7: _hex(16),
    8: WordType(re.compile("[ -~]*")),
    9: WordType(re.compile(r"[+-]?[0-9]*\.?[0-9]*(?:E[+-]?[0-9]+)?")),
}


def measured(line: str) -> bytes:
    """Return a line of a table with its length behind it."""
    return f"{line};{len(line):02X}\n".encode("ascii")


def content_of(line: bytes) -> str:
    """Return a line without its length; raises TableError where it has none or another one."""
    match = _LINE.fullmatch(line)
    if match is None:
        raise TableError("no length at the end of the line")
    if int(match[2], 16) != len(match[1]):
        raise TableError(f"{len(match[1])} characters, {match[2].decode()} given")
    return match[1].decode("ascii")


@dataclass
class TableHeader:
    """The header of a data line: which parameter, from which word on."""

    parameter: int
    first: int
    spelled: str


class ParameterMemory:
    """Type and words of every parameter, with the job reference of the CNC; kept in a folder."""

    def __init__(self, memory: Memory, delivered: bytes) -> None:
        """Take what the folder has, else the table ``delivered``;
        raises ValueError for a folder of something else.
        """
        self._memory = memory
        self.job_reference = "00000000"
        self.types: dict[int, int] = {}
        self.words: dict[int, list[str]] = {}
        kept = memory.read(TABLE)
        self._take_all(delivered if kept is None else kept)
        if kept is None:
            memory.replace(TABLE, delivered)
        self._replay(memory.read(_TAKEN) or b"")

    def _take_all(self, table: bytes) -> None:
        """Take the words of a stored table; raises ValueError for one that this program has not written."""
        try:
            lines = [content_of(line) for line in table.rstrip(b"\x13").splitlines()]
            self.job_reference = lines[0][1:9]
            for header, data in zip(lines[1::2], lines[2::2], strict=True):
                match = _HEADER.fullmatch(header)
                if match is None:
                    raise TableError(f"{header} is no header")
                parameter, code, count = int(match[1]), int(match[3]), int(match[4])
                if parameter not in self.words:
                    self.types[parameter] = code
                    self.words[parameter] = ["00000000" if code == 6 else "0"] * count
                self.take(head := self.header(header), self.split(head, data[1:]))
        except (ValueError, IndexError) as error:
            raise ValueError(
                f"{self._memory.folder / TABLE} is not what an emulated control writes: {error}"
            ) from None

    def _replay(self, lines: bytes) -> None:
        whole, _, _ = lines.rpartition(
            b"\n"
        )  # what came after the last end of a line was cut off with the power
        for line in whole.splitlines():
            spelled, _, data = content_of(line).partition("#")
            self.take(header := self.header(spelled), self.split(header, data))

    def header(self, line: str) -> TableHeader:
        """Read a header that this control can take; raises TableError."""
        match = _HEADER.fullmatch(line)
        if match is None:
            raise TableError("neither a header PaNb:tcnd nor a data line")
        parameter, first, code, count = (int(number) for number in match.groups())
        if parameter not in self.words:
            raise TableError(f"this control has no P{parameter}")
        if code != self.types[parameter] or count != len(self.words[parameter]):
            raise TableError(f"P{parameter} is t{self.types[parameter]}n{len(self.words[parameter])} here")
        if first >= count:
            raise TableError(f"P{parameter} has {count} words")
        return TableHeader(parameter, first, line)

    def split(self, header: TableHeader, data: str) -> list[str]:
        """Part a data line into its words; a text that is alone may contain blanks."""
        alone = self.types[header.parameter] == 8 and len(self.words[header.parameter]) == 1
        return [data] if alone else data.split(" ")

    def fault_of(self, header: TableHeader, data: list[str]) -> str:
        """Return why these words cannot be taken, "" where they can."""
        words, kind = self.words[header.parameter], _TYPES[self.types[header.parameter]]
        if len(data) > _MAX_LINE_VALUES:
            return f"more than {_MAX_LINE_VALUES} values"
        if header.first + len(data) > len(words):
            return f"P{header.parameter} has {len(words)} words"
        bad = next((word for word in data if not kind.takes(word)), None)
        return "" if bad is None else f"{bad} is no word of type {self.types[header.parameter]}"

    def take(self, header: TableHeader, data: list[str]) -> None:
        """Take the words of a data line; raises TableError and changes nothing where one cannot be taken."""
        if fault := self.fault_of(header, data):
            raise TableError(fault)
        hexadecimal = self.types[header.parameter] == 6
        spelled = [word.zfill(8) if hexadecimal else word for word in data]
        self.words[header.parameter][header.first : header.first + len(data)] = spelled

    def load(self, header: TableHeader, data: list[str]) -> None:
        """Take the words of a data line so that they outlast the power; raises TableError, OSError."""
        if fault := self.fault_of(header, data):
            raise TableError(fault)
        # On the disk before it counts: a load that is cut off leaves what was taken so far.
        self._memory.append(_TAKEN, measured(f"{header.spelled}#{' '.join(data)}"))
        self.take(header, data)

    def differs(self, header: TableHeader, data: list[str]) -> int | None:
        """Return the first word in which a data line differs from the control, None where none does."""
        kind = self.types[header.parameter]
        own = self.words[header.parameter][header.first : header.first + len(data)]
        for n, (word, here) in enumerate(zip(data, own, strict=False)):
            if (word.zfill(8) if kind == 6 else word) != here:
                return header.first + n
        return None

    def settle(self) -> None:
        """Write all words as one table; raises OSError."""
        # The table first: if the power goes before the lines are removed, they are replayed, which changes
        # nothing.
        self._memory.replace(TABLE, b"".join(self.lines()) + b"\x13")
        self._memory.remove(_TAKEN)

    def lines(self, start: str = "") -> Iterator[bytes]:
        """Yield the lines of the table as it is unloaded;
        ``start`` is what the operator made of the first one.
        """
        yield measured(start or f"%{self.job_reference}")
        for parameter, words in sorted(self.words.items()):
            for first in range(0, len(words), _MAX_LINE_VALUES):
                yield measured(f"P{parameter}N{first}:t{self.types[parameter]}n{len(words)}")
                yield measured("#" + " ".join(words[first : first + _MAX_LINE_VALUES]))
