"""The path of a whole program as columns: a row for each move or dwell."""

from __future__ import annotations

from array import array
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from .words import ProgramBlockError

RAPID, LINE, ARC, DWELL = range(4)
"""Kinds of rows."""
CUTTING, SLOW, EXACT, KEPT, ROUNDED = range(5)
"""At the end of a row the control goes on, slows down in corners, waits until it is in position, keeps to the
path, or rounds its corner."""
PLANES = ((0, 1, 2), (2, 0, 1), (1, 2, 0))
"""Plane XY, ZX, YZ: places of its two axes and of the third one among X, Y, Z."""
MAX_ROWS = 4_000_000
_MAX_ROUNDINGS = 200
"""Different ones in a program; a row has a byte for its own."""
COLUMNS = (
    "ends",
    "kind",
    "line",
    "feed",
    "center",
    "sweep",
    "plane",
    "seconds",
    "corner",
    "free",
    "rounding",
    "zones",
)
"""Of a `ToolPath`."""
Floats = npt.NDArray[np.float64]
Bytes = npt.NDArray[np.uint8]


@dataclass(frozen=True)
class ProgramFault:
    """Where a program ends because the control cannot use a block, or its effect is not known here."""

    line: int
    """From 1."""
    block: str
    message: str
    code: str = ""
    """As the control shows it; "" where no source has it."""


@dataclass(frozen=True)
class Rounding:
    """How far a control may leave the path; mm, 0 where the program gives nothing."""

    corner: float = 0.0
    """From a corner."""
    points: float = 0.0
    """From points that one straight move replaces."""


_NO_ROUNDING = Rounding()


@dataclass(frozen=True)
class ToolPath:
    """What a program moves; lengths in mm or deg in the coordinates of the machine, speeds per s."""

    axes: tuple[str, ...]
    start: Floats
    """(axes,)"""
    ends: Floats
    """(rows, axes)"""
    kind: Bytes
    """(rows,)"""
    line: npt.NDArray[np.int32]
    """(rows,): line of the program, from 1."""
    feed: Floats
    """(rows,): programmed, u/s; 0 in rapid."""
    center: Floats
    """(rows, 2): of an arc, in the axes of its plane."""
    sweep: Floats
    """(rows,): rad, above 0 from the first axis of the plane to the second."""
    plane: Bytes
    """(rows,)"""
    seconds: Floats
    """(rows,): of a dwell."""
    corner: Bytes
    """(rows,): what happens at the end."""
    free: Bytes
    """(rows,): 1 where the override of the feed has no effect."""
    rounding: Bytes
    """(rows,): place in ``roundings``."""
    roundings: tuple[Rounding, ...]
    zones: Bytes
    """(rows,): place in ``zone_sets``."""
    zone_sets: tuple[tuple[str, ...] | None, ...]
    """Numbers of zones that the program switched on; None for those of power-up."""
    blocks: int
    """How many blocks were read, repeated ones every time."""
    fault: ProgramFault | None
    assumptions: tuple[str, ...]
    zero_known: bool
    """Whether the file, or who asked, has where the zero of the program is in the machine."""

    def __len__(self) -> int:
        return len(self.kind)

    @property
    def columns(self) -> list[npt.NDArray[Any]]:
        """What there is of each row, (rows,) or (rows, …), and where the path begins, (1, axes)."""
        return [getattr(self, name) for name in COLUMNS] + [self.start[None, :]]

    def with_columns(self, columns: Sequence[npt.NDArray[Any]]) -> ToolPath:
        """Return a path of other rows."""
        *rows, start = columns
        named: dict[str, Any] = dict(zip(COLUMNS, rows, strict=True))
        return replace(self, **named, start=start[0])

    def rows(self, first: int, last: int) -> ToolPath:
        """Return the rows from ``first`` to before ``last`` as a path."""
        begin = self.ends[first - 1] if first else self.start
        return self.with_columns([*(each[first:last] for each in self.columns[:-1]), begin[None, :]])


class RowsWriter:
    """The rows of a path while a program is read."""

    def __init__(self, axes: tuple[str, ...], start: Sequence[float]) -> None:
        self._axes, self._start = axes, list(start)
        self.roundings: list[Rounding] = [_NO_ROUNDING]
        self.active = 0
        """Place of the rounding of the next rows."""
        self.zone_sets: list[tuple[str, ...] | None] = [None]
        self.active_zones = 0
        """Place of the zones of the next rows."""
        self.count = 0
        """Of all rows so far."""
        self.last_kind = -1
        """Of the last row; -1 before the first."""
        self._begin()

    def _begin(self) -> None:
        """Begin with no rows."""
        # Arrays of numbers, not lists: a float as an object takes four times the memory.
        self._ends, self._feed, self._seconds = array("d"), array("d"), array("d")
        self._arcs = array("d")
        """Center and sweep of a row."""
        self._line = array("i")
        self._kind, self._plane, self._corner, self._free = (array("B") for _ in range(4))
        self._rounding, self._zones = array("B"), array("B")

    def __len__(self) -> int:
        """Return how many rows are here, which were not taken away."""
        return len(self._kind)

    def add(
        self,
        end: Sequence[float],
        kind: int,
        line: int,
        feed: float,
        corner: int,
        free: int,
        arc: tuple[float, float, float] = (0.0, 0.0, 0.0),
        plane: int = 0,
        seconds: float = 0.0,
    ) -> None:
        """Add a row."""
        self._ends.extend(end)
        self._kind.append(kind)
        self._line.append(line)
        self._feed.append(feed)
        self._arcs.extend(arc)
        self._plane.append(plane)
        self._seconds.append(seconds)
        self._corner.append(corner)
        self._free.append(free)
        self._rounding.append(self.active)
        self._zones.append(self.active_zones)
        self.count, self.last_kind = self.count + 1, kind

    def guard_by(self, zones: tuple[str, ...]) -> None:
        """Have these zones on in the next rows, and no others."""
        if zones not in self.zone_sets:
            self.zone_sets.append(zones)
        self.active_zones = self.zone_sets.index(zones)

    def round_by(self, rounding: Rounding) -> None:
        """Round the corners of the next rows by this."""
        if rounding not in self.roundings:
            if len(self.roundings) > _MAX_ROUNDINGS:
                raise ProgramBlockError(f"More than {_MAX_ROUNDINGS} kinds of G64 in one program")
            self.roundings.append(rounding)
        self.active = self.roundings.index(rounding)

    def take(
        self, blocks: int, fault: ProgramFault | None, assumptions: Sequence[str], *, zero_known: bool
    ) -> ToolPath:
        """Return the rows since the last time as a path, and go on with none."""
        rows, start = len(self), np.array(self._start, np.float64)
        # The numbers themselves, not a copy: others take their place.
        arcs = np.frombuffer(self._arcs).reshape(rows, 3)
        ends = np.frombuffer(self._ends).reshape(rows, len(self._axes))
        path = ToolPath(
            axes=self._axes,
            start=start,
            ends=ends,
            kind=np.frombuffer(self._kind, np.uint8),
            line=np.frombuffer(self._line, np.int32),
            feed=np.frombuffer(self._feed),
            center=arcs[:, :2],
            sweep=arcs[:, 2],
            plane=np.frombuffer(self._plane, np.uint8),
            seconds=np.frombuffer(self._seconds),
            corner=np.frombuffer(self._corner, np.uint8),
            free=np.frombuffer(self._free, np.uint8),
            rounding=np.frombuffer(self._rounding, np.uint8),
            roundings=tuple(self.roundings),
            zones=np.frombuffer(self._zones, np.uint8),
            zone_sets=tuple(self.zone_sets),
            blocks=blocks,
            fault=fault,
            assumptions=tuple(dict.fromkeys(assumptions)),
            zero_known=zero_known,
        )
        if rows:
            self._start = ends[-1].tolist()
        self._begin()
        return path
