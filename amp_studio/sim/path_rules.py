"""How a control goes along a path, as a family fills it in: limits, ramps, corners, look-ahead."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import reduce

import numpy as np
import numpy.typing as npt

from amp_studio.programs import ToolPath
from amp_studio.schema import Address
from amp_studio.sim.command.events import Ramp

PathRows = npt.NDArray[np.float64]
Causes = npt.NDArray[np.int16]
Indices = npt.NDArray[np.int64]


def row_sums(values: PathRows) -> PathRows:
    """Return the sum of each row of (rows, up to seven), as numpy adds them; a column at a time takes a
    twentieth of the time of its sum of such short rows.
    """
    sums: PathRows = reduce(np.add, values.T, np.zeros(len(values)))
    return sums


@dataclass(frozen=True)
class PathLimit:
    """A figure that bounds something on the path, and where it comes from."""

    value: float
    """u/s, u/s2 or blocks."""
    param: Address | None
    """None for what the control does by itself."""
    title: str = ""
    """What it is where it has no parameter."""


@dataclass(frozen=True)
class Corners:
    """Where a row follows another without a stop; (n,) or (n, axes)."""

    axes: tuple[str, ...]
    """Letters of the columns."""
    before: PathRows
    """Direction at the end of the first row, of length 1."""
    after: PathRows
    """Direction at the start of the second one."""
    slow: npt.NDArray[np.bool_]
    """Whether the program asks for slower corners."""


@dataclass(frozen=True)
class Geometry:
    """PathRows as the control plans them; (rows,) or (rows, axes)."""

    row: npt.NDArray[np.int64]
    """Row of the program's path."""
    begins: PathRows
    ends: PathRows
    length: PathRows
    first: PathRows
    """Direction at the start; 0 without length."""
    last: PathRows
    share: PathRows
    """Largest share of the speed that an axis has in the row."""
    radius: PathRows
    """Infinite on a line."""
    is_arc: npt.NDArray[np.bool_]


@dataclass(frozen=True)
class RowBounds:
    """What bounds each row: values (rows,), and by which of some limits (rows,)."""

    value: PathRows
    by: Indices


@dataclass(frozen=True)
class ShapedPath:
    """The rows that a control itself makes of a program: joined, with rounded corners."""

    path: ToolPath
    limits: Sequence[PathLimit]
    speed: RowBounds
    """u/s along the path."""
    acceleration: RowBounds
    """u/s2 along the path."""
    joint: RowBounds
    """u/s at the end of a row."""
    move: Indices
    """(rows,): which of the moves that it is made of each row belongs to."""
    begins: Indices
    """(moves,): the row of the program that begins where a move does; -1 where none does."""


CornerRule = Callable[[Corners], Sequence[tuple[PathLimit, PathRows]]]
"""rule(corners) -> the highest speeds (n,) in u/s by what bounds them; infinite where it does not."""


_STRAIGHT = 1e-9
"""Change of direction below which an axis goes on evenly."""
LINEAR = Ramp("linear")
_NO_STEP = PathLimit(0.0, None, "no velocity step")


def steps_of_axes(steps: Mapping[str, PathLimit]) -> CornerRule:
    """Return the rule of a control that lets each axis change its speed by its step in a corner;
    an axis without one must stop in every corner.
    """

    def rule(corners: Corners) -> Sequence[tuple[PathLimit, PathRows]]:
        change = np.abs(corners.after - corners.before)
        found = []
        for n, axis in enumerate(corners.axes):
            step, bound = steps.get(axis, _NO_STEP), np.full(len(change), np.inf)
            # An axis that goes straight on sets no bound, and would divide by 0.
            np.divide(step.value, change[:, n], out=bound, where=change[:, n] > _STRAIGHT)
            found.append((step, bound))
        return found

    return rule


@dataclass(frozen=True)
class PathRules:
    """One control; speeds u/s along the path or of an axis, accelerations u/s2."""

    feed_ramp: Ramp = LINEAR
    rapid_ramp: Ramp = LINEAR
    """Their kind, jerk and time; the accelerations are the limits below."""
    feed: Sequence[PathLimit] = ()
    rapid: Sequence[PathLimit] = ()
    """Along the path."""
    feed_acceleration: Sequence[PathLimit] = ()
    rapid_acceleration: Sequence[PathLimit] = ()
    """Along the path."""
    axis_speed: Mapping[str, PathLimit] = field(default_factory=dict)
    axis_acceleration: Mapping[str, PathLimit] = field(default_factory=dict)
    """Axis -> its own limit in every move."""
    axis_deceleration: Mapping[str, PathLimit] | None = None
    """Axis -> that of slowing down; None for the acceleration."""
    axis_rapid_acceleration: Mapping[str, PathLimit] | None = None
    """That of rapid moves, up and down; None for the same."""
    axis_rapid: Mapping[str, PathLimit] | None = None
    """That of its speed in rapid; None for the same."""
    corner: CornerRule = lambda _corners: ()
    arc: Callable[[PathRows], Sequence[tuple[PathLimit, PathRows]]] | None = None
    """arc(radius in u) -> the highest speeds by what bounds them."""
    chord: PathLimit | None = None
    """u between an arc and the straight pieces that the control makes of it; None for true arcs."""
    look_ahead: PathLimit | None = None
    """Blocks that are known, the present one too; None for all."""
    shape: Callable[[ToolPath, Geometry, bool], ShapedPath] | None = None
    """shape(path, its geometry, whether it is all that is left) -> what the control makes of a path; None
    where it goes along the rows of the program. A move depends on the one before it and the two after it, and
    on the rows from its begin on; the last one of a path that goes on is left out.
    """
    pause: float = 0.0
    """s that it needs at each stop between rows."""
    rapid_rests: bool = False
    """Whether every rapid move begins and ends at rest."""
    waits: bool = False
    """Whether an exact stop waits until the axes are in position."""
    stop: PathLimit = field(default_factory=lambda: PathLimit(0.0, None, "exact stop"))
    """What an exact stop belongs to."""
    override: float = 1.0
    rapid_override: float = 1.0
    assumptions: tuple[str, ...] = ()
