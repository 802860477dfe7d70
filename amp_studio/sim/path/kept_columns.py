"""Columns of numbers, a stretch of rows after the other, that need no memory however many there are."""

from __future__ import annotations

import math
import weakref
from collections.abc import Sequence
from tempfile import TemporaryFile
from typing import IO, Any

import numpy as np
import numpy.typing as npt

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
        self._looks: list[list[tuple[np.dtype[Any], tuple[int, ...]]]] = []
        """Kind and shape of the columns of each stretch."""
        self._last: tuple[int, Columns] = (-1, [])

    def __len__(self) -> int:
        return len(self._places)

    def add(self, columns: Sequence[npt.NDArray[Any]]) -> None:
        """Keep one more stretch; raises SaveError."""
        self._write_last()
        self._last = len(self._places), list(columns)
        self._places.append(-1)
        self._looks.append([(column.dtype, column.shape) for column in columns])

    def __getitem__(self, place: int) -> Columns:
        if place != self._last[0]:
            self._write_last()
            assert self._file is not None
            self._file.seek(self._places[place])
            self._last = place, [self._read(*look) for look in self._looks[place]]
        return self._last[1]

    def _read(self, kind: np.dtype[Any], shape: tuple[int, ...]) -> npt.NDArray[Any]:
        # As bytes, without a head: that of npy is read as Python, which takes longer than a
        # stretch of arcs.
        assert self._file is not None
        return np.fromfile(self._file, kind, math.prod(shape)).reshape(shape)

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
                self._file.write(np.ascontiguousarray(column).data)
            self._file.flush()
