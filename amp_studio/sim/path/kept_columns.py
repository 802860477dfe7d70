"""Columns of numbers, a stretch of rows after the other, that need no memory however many there are."""

from __future__ import annotations

import weakref
from collections.abc import Sequence
from tempfile import TemporaryFile
from typing import IO, Any

import numpy as np
import numpy.typing as npt
from numpy.lib import format as npy

from amp_studio.files import in_temporary_folder

Columns = list[npt.NDArray[Any]]


class KeptColumns:
    """Columns of stretches: of one stretch in memory, of several in a temporary file but for the one that was
    read last.
    """

    def __init__(self) -> None:
        self._file: IO[bytes] | None = None
        self._places: list[int] = []
        """Of each stretch in the file; -1 for one that is in memory alone."""
        self._widths: list[int] = []
        self._last: tuple[int, Columns] = (-1, [])

    def __len__(self) -> int:
        return len(self._places)

    def add(self, columns: Sequence[npt.NDArray[Any]]) -> None:
        """Keep one more stretch; raises SaveError."""
        self._write_last()
        self._last = len(self._places), list(columns)
        self._places.append(-1)
        self._widths.append(len(columns))

    def __getitem__(self, place: int) -> Columns:
        if place != self._last[0]:
            self._write_last()
            assert self._file is not None
            self._file.seek(self._places[place])
            self._last = place, [npy.read_array(self._file) for _ in range(self._widths[place])]
        return self._last[1]

    def _write_last(self) -> None:
        place, columns = self._last
        if place < 0 or self._places[place] >= 0:
            return
        with in_temporary_folder():
            if self._file is None:
                self._file = TemporaryFile()  # noqa: SIM115  # as long as the columns are
                weakref.finalize(self, self._file.close)
            self._places[place] = self._file.seek(0, 2)
            for column in columns:
                npy.write_array(self._file, np.ascontiguousarray(column))
            self._file.flush()
