"""The path of a whole program as columns: a row for each move or dwell."""

from __future__ import annotations

from array import array
from collections.abc import Sequence
from dataclasses import dataclass, field

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
MOST_ROWS = 4_000_000
MOST_ROUNDINGS = 200
"""Different ones in a program; a row has a byte for its own."""
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


NO_ROUNDING = Rounding()


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


@dataclass
class RowsWriter:
    """The rows of a path while a program is read."""

    axes: tuple[str, ...]
    # Arrays of numbers, not lists: a float as an object takes four times the memory.
    ends: array[float] = field(default_factory=lambda: array("d"))
    kind: array[int] = field(default_factory=lambda: array("B"))
    line: array[int] = field(default_factory=lambda: array("i"))
    feed: array[float] = field(default_factory=lambda: array("d"))
    arcs: array[float] = field(default_factory=lambda: array("d"))
    """Center and sweep of a row."""
    plane: array[int] = field(default_factory=lambda: array("B"))
    seconds: array[float] = field(default_factory=lambda: array("d"))
    corner: array[int] = field(default_factory=lambda: array("B"))
    free: array[int] = field(default_factory=lambda: array("B"))
    rounding: array[int] = field(default_factory=lambda: array("B"))
    roundings: list[Rounding] = field(default_factory=lambda: [NO_ROUNDING])
    active: int = 0
    """Place of the rounding of the next rows."""
    zones: array[int] = field(default_factory=lambda: array("B"))
    zone_sets: list[tuple[str, ...] | None] = field(default_factory=lambda: [None])
    active_zones: int = 0
    """Place of the zones of the next rows."""

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
        self.ends.extend(end)
        self.kind.append(kind)
        self.line.append(line)
        self.feed.append(feed)
        self.arcs.extend(arc)
        self.plane.append(plane)
        self.seconds.append(seconds)
        self.corner.append(corner)
        self.free.append(free)
        self.rounding.append(self.active)
        self.zones.append(self.active_zones)

    def guard_by(self, zones: tuple[str, ...]) -> None:
        """Have these zones on in the next rows, and no others."""
        if zones not in self.zone_sets:
            self.zone_sets.append(zones)
        self.active_zones = self.zone_sets.index(zones)

    def round_by(self, rounding: Rounding) -> None:
        """Round the corners of the next rows by this."""
        if rounding not in self.roundings:
            if len(self.roundings) > MOST_ROUNDINGS:
                raise ProgramBlockError(f"More than {MOST_ROUNDINGS} kinds of G64 in one program")
            self.roundings.append(rounding)
        self.active = self.roundings.index(rounding)

    def path(
        self,
        start: Sequence[float],
        blocks: int,
        fault: ProgramFault | None,
        assumptions: Sequence[str],
        *,
        zero_known: bool,
    ) -> ToolPath:
        """Return the path of the rows."""
        rows = len(self.kind)
        # The numbers themselves, not a copy: the writer ends here.
        arcs = np.frombuffer(self.arcs).reshape(rows, 3)
        return ToolPath(
            axes=self.axes,
            start=np.array(start, np.float64),
            ends=np.frombuffer(self.ends).reshape(rows, len(self.axes)),
            kind=np.frombuffer(self.kind, np.uint8),
            line=np.frombuffer(self.line, np.int32),
            feed=np.frombuffer(self.feed),
            center=arcs[:, :2],
            sweep=arcs[:, 2],
            plane=np.frombuffer(self.plane, np.uint8),
            seconds=np.frombuffer(self.seconds),
            corner=np.frombuffer(self.corner, np.uint8),
            free=np.frombuffer(self.free, np.uint8),
            rounding=np.frombuffer(self.rounding, np.uint8),
            roundings=tuple(self.roundings),
            zones=np.frombuffer(self.zones, np.uint8),
            zone_sets=tuple(self.zone_sets),
            blocks=blocks,
            fault=fault,
            assumptions=tuple(dict.fromkeys(assumptions)),
            zero_known=zero_known,
        )
