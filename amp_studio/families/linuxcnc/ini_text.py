"""The lines of a configuration file as LinuxCNC reads them (src/libnml/inifile/inifile.cc of 2.9.8,
F and its lines).

A section ends at the next one, and only the first of its name is read (F226 to F269). Of several lines of a
key the first counts (F353). A remark takes a whole line; behind a value it is part of the value (F393). A
backslash goes on in the next line (F296). ``#INCLUDE name`` at the start of a line means the lines of another
file, which the start script puts there (LN339).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

_SECTION = re.compile(r"[ \t\r]*\[([^\]]*)\]")
_KEY = re.compile(r"[ \t\r]*([^\s=;#\[][^\s=]*)[ \t\r]*=[ \t\r]*")
_CONTENT = re.compile(r"\s*[^\s#;]")
_INCLUDE = re.compile(r"#INCLUDE[ \t]+(\S.*?)[ \t\r]*$")
_MAX_INCLUDES = 50
_MAX_LINES = 20
"""Lines that one value may go on over (F27)."""


@dataclass(frozen=True)
class IniEntry:
    """A key and its value.

    ``text``   the value, without blanks around it
    ``file``   "" for the configuration itself, else the name of an included file
    ``line``   of the file, from 0; ``lines`` how many the value takes
    ``start``, ``end``  of the value in its line; of one that takes several they are in the first
    ``shadow`` why LinuxCNC does not read it; "" for one that counts
    """

    section: str
    key: str
    text: str
    file: str
    line: int
    lines: int
    start: int
    end: int
    shadow: str = ""

    @property
    def name(self) -> str:
        """``[JOINT_0]FERROR``."""
        return f"[{self.section}]{self.key}"


@dataclass(frozen=True)
class IniText:
    """A configuration file with what it includes.

    ``lines``     of each file, "" for the configuration itself
    ``entries``   in the order in which they are read
    ``last``      section -> its last line, where one more key belongs; of sections of the configuration
                  itself
    ``missing``   names of files that are included and not there
    """

    lines: dict[str, list[str]]
    entries: tuple[IniEntry, ...]
    last: dict[str, int]
    missing: tuple[str, ...]

    def counting(self) -> dict[tuple[str, str], IniEntry]:
        """Return section and key -> the entry that LinuxCNC reads."""
        return {(e.section, e.key): e for e in self.entries if not e.shadow}


def read_ini(text: str, beside: Callable[[str], str | None] = lambda _name: None) -> IniText:
    """Return the entries of a text; ``beside`` returns the text of a file that is named in it,
    None where it is not there.
    """
    reader = _Reader(beside)
    reader.read("", text)
    return IniText(reader.lines, tuple(reader.entries), reader.last, tuple(reader.missing))


class _Reader:
    def __init__(self, beside: Callable[[str], str | None]) -> None:
        self.beside = beside
        self.lines: dict[str, list[str]] = {}
        self.entries: list[IniEntry] = []
        self.last: dict[str, int] = {}
        self.missing: list[str] = []
        self._section: str | None = None
        self._is_again = False
        self._seen: dict[tuple[str, str], IniEntry] = {}
        self._sections: dict[str, str] = {}

    def read(self, file: str, text: str) -> None:
        rows = self.lines[file] = text.split("\n")
        at = 0
        while at < len(rows):
            count = 1
            while (
                rows[at + count - 1].rstrip("\r").endswith("\\")
                and at + count < len(rows)
                and count <= _MAX_LINES
            ):
                count += 1
            self._line(file, rows, at, count)
            at += count

    def _line(self, file: str, rows: Sequence[str], at: int, count: int) -> None:
        """Read a line, with the ``count`` - 1 lines that go on from it."""
        row = rows[at]
        if match := _INCLUDE.match(row):
            if not file:  # the start script looks for them in the configuration alone
                self._include(match[1])
        elif match := _SECTION.match(row):
            self._begin(match[1], file, at)
        elif (match := _KEY.match(row)) and self._section is not None:
            self._entry(match, file, rows, at, count)
        # A new key goes below the last line with content: behind remarks and blank lines it would seem to
        # be of the next section.
        if not file and self._section is not None and not self._is_again and _CONTENT.match(row):
            self.last[self._section] = at + count - 1

    def _include(self, name: str) -> None:
        # A file that includes itself, directly or through others, would go on for ever.
        text = self.beside(name) if len(self.lines) <= _MAX_INCLUDES and name not in self.lines else None
        if text is None:
            self.missing.append(name)
        else:
            self.read(name, text)

    def _begin(self, section: str, file: str, at: int) -> None:
        self._section = section
        self._is_again = section in self._sections
        self._sections.setdefault(section, _place(file, at))

    def _entry(self, match: re.Match[str], file: str, rows: Sequence[str], at: int, count: int) -> None:
        """Keep an entry, and why it does not count where it does not."""
        assert self._section is not None
        first = (
            match.string[match.end() :].rstrip("\r")
            if count == 1
            else match.string[match.end() :].rstrip("\r")[:-1]
        )
        more = [row.rstrip("\r").removesuffix("\\") for row in rows[at + 1 : at + count]]
        value = "".join((first, *more)).strip(" \t\r")
        # Before the backslash of a value over several lines, which is taken away where it is replaced.
        end = match.end() + (len(first.rstrip(" \t\r")) if count == 1 else len(first))
        where = (self._section, match[1])
        shadow = ""
        if self._is_again:
            shadow = f"the section is in {self._sections[self._section]} already, and only that one is read"
        elif where in self._seen:
            before = self._seen[where]
            shadow = f"{_place(before.file, before.line)} comes first and counts"
        entry = IniEntry(self._section, match[1], value, file, at, count, match.end(), end, shadow)
        # Kept without a value too: an empty first line also hides the ones after it.
        self._seen.setdefault(where, entry)
        if value or shadow:  # without a value it is as if it were not there (F465), and so are those after it
            self.entries.append(entry)


def _place(file: str, line: int) -> str:
    return f"{file} line {line + 1}" if file else f"line {line + 1}"


def with_value(row: str, entry: IniEntry, value: str) -> str:
    """Return the line of an entry with another value; what is behind a number stays."""
    return row[: entry.start] + value + row[entry.end :]
