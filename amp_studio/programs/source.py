"""The text of a program from a file, bounded: it comes from anywhere."""

from __future__ import annotations

import threading
import weakref
from array import array
from collections.abc import Iterable, Iterator, Sequence
from itertools import islice
from pathlib import Path
from tempfile import SpooledTemporaryFile
from typing import overload

from amp_studio.files import ParameterFile, in_temporary_folder
from amp_studio.schema import quoted

from .words import LONGEST, ProgramBlockError

_MAX_BYTES = 100_000_000
"""Of a file, counted in characters; a million blocks have about 30 million."""
_MAX_LINES = 2_000_000
IN_MEMORY = 1 << 18
"""Bytes of a program that need no temporary file."""
_TOGETHER = 512
"""Lines that are read from it at once."""


class ProgramLines(Sequence[str]):
    """The lines of a program, of which a few are in memory: a long one is in a temporary file."""

    def __init__(self, lines: Iterable[str]) -> None:
        self._file = SpooledTemporaryFile(IN_MEMORY)  # noqa: SIM115  # as long as the lines are
        weakref.finalize(self, self._file.close)
        self._places, self._count = array("q"), 0
        """Of each `_TOGETHER` lines in the file."""
        self._read: tuple[int, list[str]] = (-1, [])
        # A run that was stopped may still read while the next one begins.
        self._lock = threading.Lock()
        coming = iter(lines)
        while part := list(islice(coming, _TOGETHER)):
            self._places.append(self._file.tell())
            with in_temporary_folder():
                self._file.write("".join(f"{line}\n" for line in part).encode("utf-8", "surrogatepass"))
                self._file.flush()
            self._count += len(part)
        self._places.append(self._file.tell())

    def __len__(self) -> int:
        return self._count

    @overload
    def __getitem__(self, place: int) -> str: ...
    @overload
    def __getitem__(self, place: slice) -> list[str]: ...
    def __getitem__(self, place: int | slice) -> str | list[str]:
        if isinstance(place, slice):
            return [self[n] for n in range(*place.indices(self._count))]
        part, lines = self._read
        if part != place // _TOGETHER:
            lines = self._part(range(self._count)[place] // _TOGETHER)
        return lines[place % _TOGETHER if place >= 0 else (place + self._count) % _TOGETHER]

    def __iter__(self) -> Iterator[str]:
        for part in range(len(self._places) - 1):
            yield from self._part(part)

    def _part(self, part: int) -> list[str]:
        with self._lock:
            self._file.seek(self._places[part])
            content = self._file.read(self._places[part + 1] - self._places[part])
        lines = content.decode("utf-8", "surrogatepass").split("\n")[:-1]
        self._read = part, lines
        return lines


def read_program(path: Path, file: ParameterFile | None = None) -> ProgramLines:
    """Return the lines of a program as the control of a file reads them; raises ProgramBlockError for a file
    that is none, SaveError where there is no room for a long one, OSError.
    """
    facts = file.schema.program.path if file is not None else None
    return ProgramLines(_lines(path, is_plain=facts is not None and facts.plain_text))


def _lines(path: Path, *, is_plain: bool) -> Iterator[str]:
    """Yield the lines; those of a control that takes a CR for a blank end by LF alone."""
    count = gone = 0
    # Lines end by LF, CR LF or CR: most controls take each for the end of a block.
    encoding, newline = ("utf-8", "\n") if is_plain else ("utf-8-sig", None)
    with path.open(encoding=encoding, errors="replace", newline=newline) as text:
        # A line is never read whole before its length is known: one line can be as long as the disk.
        while part := text.readline(LONGEST + 2):
            gone += len(part)
            name = quoted(path.name)
            if len(part) > LONGEST and not part.endswith("\n"):
                raise ProgramBlockError(
                    f"Line {count + 1} of {name} has more than {LONGEST} characters: no part program"
                )
            if "\0" in part:
                raise ProgramBlockError(f"{name} is no text: there is a zero byte in line {count + 1}")
            if gone > _MAX_BYTES or count >= _MAX_LINES:
                raise ProgramBlockError(
                    f"{name} is longer than {_MAX_LINES} lines or {_MAX_BYTES // 1_000_000} MB"
                )
            yield part.strip(" \t\r\n").replace("\r", " ")
            count += 1
