"""The moves that LinuxCNC makes of the rows of a program: points that lie on one straight move are joined,
flat arcs become two straight moves, and each move gets its own greatest speed and acceleration (emccanon.cc).

All moves are columns: what a move is depends on its own rows alone. Only how far a straight move may go on
depends on the points before it, so those alone are checked one after another.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from amp_studio.programs import ARC, DWELL, LINE, PLANES, RAPID, ROUNDED, ToolPath
from amp_studio.sim import Geometry, PathLimit, PathRows, SimulationError

_MAX_JOINED = 100
"""Points that one straight move replaces (CN978)."""
NORMAL = math.sqrt(3.0) / 2.0
"""Share of the acceleration across an arc while it speeds up by half of it (CN1682)."""
Integers = npt.NDArray[np.int64]
Booleans = npt.NDArray[np.bool_]


@dataclass(frozen=True)
class PathSegments:
    """The moves of the planner and the dwells between them; (n,) or (n, axes). Lengths u, speeds u/s."""

    row: Integers
    """Of the program's path."""
    kind: npt.NDArray[np.uint8]
    begins: PathRows
    ends: PathRows
    length: PathRows
    first: PathRows
    """Directions at their ends, of length 1."""
    last: PathRows
    programmed: PathRows
    """Speed; infinite in rapid."""
    top: PathRows
    top_by: Integers
    acceleration: PathRows
    ramp_by: Integers
    corner: npt.NDArray[np.uint8]
    tolerance: PathRows
    """From its corner, as programmed; 0 where the program gives none."""
    begun_by: Integers
    """The row of the path that begins where it does; -1 in the middle of one."""

    def __len__(self) -> int:
        return len(self.row)


@dataclass(frozen=True)
class AxisLimits:
    """Limits of the axes in the columns of a path, (axes,)."""

    speeds: PathRows
    accelerations: PathRows

    @classmethod
    def of(
        cls, letters: tuple[str, ...], speeds: Mapping[str, PathLimit], accelerations: Mapping[str, PathLimit]
    ) -> AxisLimits:
        """Return those of some axes."""
        return cls(
            np.array([speeds[letter].value for letter in letters]),
            np.array([accelerations[letter].value for letter in letters]),
        )


def along(direction: PathRows, bounds: PathRows) -> tuple[PathRows, Integers]:
    """Return what the axes allow in each direction (n, axes), and the axis that bounds it (CN739)."""
    share = np.abs(direction)
    # An axis that does not move bounds nothing, and would divide by 0.
    moves = share > 1e-12
    allowed = np.where(moves, bounds / np.where(moves, share, 1.0), math.inf)
    axis = allowed.argmin(axis=1)
    return allowed[np.arange(len(axis)), axis], axis


def segments(path: ToolPath, geometry: Geometry, limits: AxisLimits, *, is_all: bool) -> PathSegments:
    """Return the moves of a path in their order, without the last one where the path goes on: more points may
    be joined to it. Raises SimulationError for one that is not simulated.
    """
    rotary = [n for n, letter in enumerate(path.axes) if letter in "ABC"]
    if rotary:
        _refuse_mixed(path, geometry, rotary)
    points, rows, is_straight = _points(path, geometry)
    ends = _ends_of_moves(path, points, rows, is_straight, rotary)
    if not is_all:
        ends = ends[:-1]
    begun = np.concatenate([[0], ends + 1])[: len(ends)]
    # The end of a flat arc is no row's begin, as its middle comes before it.
    begun_by = np.where(begun == np.searchsorted(rows, rows[begun]), rows[begun], -1)
    rows, stops, is_straight = rows[ends], points[ends], is_straight[ends]
    begins = np.vstack([path.start[None, :], stops[:-1]]) if len(stops) else stops
    kind = np.where(is_straight & (path.kind[rows] == ARC), LINE, path.kind[rows]).astype(np.uint8)
    # The planner drops a straight move without length.
    moved = (kind == ARC) | (kind == DWELL) | (begins != stops).any(axis=1)
    found = _straight(path, rows[moved], kind[moved], begins[moved], stops[moved], begun_by[moved], limits)
    return _round(path, geometry, found, limits)


def _refuse_mixed(path: ToolPath, geometry: Geometry, rotary: list[int]) -> None:
    moving = np.abs(path.ends - geometry.begins) > 1e-12
    turning = moving[:, rotary].sum(axis=1)
    mixed = np.flatnonzero((turning > 0) & (turning < moving.sum(axis=1)))
    if len(mixed):
        raise SimulationError(
            f"Line {int(path.line[mixed[0]])}: a move of rotary and straight axes together is not simulated"
        )


def _joins(path: ToolPath, rows: Integers) -> PathRows:
    """Return how far points of rows may be from the straight move that replaces them, u."""
    points = np.array([each.points for each in path.roundings])[path.rounding[rows]]
    joins: PathRows = np.where(path.corner[rows] == ROUNDED, points, 0.0)
    return joins


def _points(path: ToolPath, geometry: Geometry) -> tuple[PathRows, Integers, Booleans]:
    """Return where moves may end, the rows of these points, and whether straight moves lead there: the end of
    each row, and the middle of an arc that is so flat that it becomes two straight moves (CN1494).
    """
    rows = np.arange(len(path))
    arcs = np.flatnonzero((path.kind == ARC) & (path.plane == 0))
    off = geometry.radius[arcs] * (1.0 - np.cos(0.5 * path.sweep[arcs]))
    flat = arcs[off < _joins(path, arcs)]
    is_straight = path.kind == LINE
    is_straight[flat] = True
    if not len(flat):
        return path.ends, rows, is_straight
    a, b = path.axes.index("X"), path.axes.index("Y")
    begin, center = geometry.begins[flat], path.center[flat]
    middle = 0.5 * (begin + path.ends[flat])
    angle = np.arctan2(begin[:, b] - center[:, 1], begin[:, a] - center[:, 0]) + 0.5 * path.sweep[flat]
    middle[:, a] = center[:, 0] + geometry.radius[flat] * np.cos(angle)
    middle[:, b] = center[:, 1] + geometry.radius[flat] * np.sin(angle)
    return (
        np.insert(path.ends, flat, middle, axis=0),
        np.insert(rows, flat, flat),
        np.insert(is_straight, flat, True),
    )


def _ends_of_moves(
    path: ToolPath, points: PathRows, rows: Integers, is_straight: Booleans, rotary: list[int]
) -> Integers:
    """Return the points at which moves end: those that no straight move replaces together with the next."""
    joins = _joins(path, rows)
    before = np.vstack([path.start[None, :], points])[:-1]
    # Whether the straight move to the point before could go on to this one.
    continues = np.zeros(len(rows), bool)
    continues[1:] = (
        is_straight[1:]
        & is_straight[:-1]
        & (joins[1:] > 0.0)
        & (path.corner[rows[:-1]] == ROUNDED)
        & (path.feed[rows[1:]] == path.feed[rows[:-1]])
        & (path.rounding[rows[1:]] == path.rounding[rows[:-1]])
    )
    for axis in rotary:
        continues &= points[:, axis] == before[:, axis]
    second = np.flatnonzero(continues)
    second = second[_is_near(before[second - 1], points[second], points[second - 1], joins[second])]
    third = second + 1
    has_third = third < len(rows)
    has_third[has_third] = continues[third[has_third]]
    begun, third = before[second - 1][has_third], third[has_third]
    has_third[has_third] = _is_near(begun, points[third], points[third - 1], joins[third]) & _is_near(
        begun, points[third], points[third - 2], joins[third]
    )
    is_end = np.ones(len(rows), bool)
    after = 0
    for n, has_more in zip(second.tolist(), has_third.tolist(), strict=True):
        if n <= after:
            continue  # the move before has replaced a point of it, or ends because it could not
        after = _joined(before[n - 1], points, continues, float(joins[n]), n) if has_more else n + 1
        is_end[n - 1 : after - 1] = False
    return np.flatnonzero(is_end)


def _joined(begin: PathRows, points: PathRows, continues: Booleans, joins: float, second: int) -> int:
    """Return the point after those that one straight move from ``begin`` reaches (CN970): it is known to
    reach from the point before ``second`` to the one after it.
    """
    first, n = second - 1, second + 2
    end = min(second + _MAX_JOINED, len(points))
    while n < end:
        # As many as were joined so far: so a long row of points takes few rounds, and a short one few
        # checks in vain.
        tried = np.arange(n, min(n + max(8, n - first), end))
        replaced = points[first : tried[-1]]
        near = _is_near(begin, points[tried][:, None], replaced[None], joins)
        # Each of the tried ends replaces the points before it, not those behind.
        behind = np.arange(first, tried[-1])[None] >= tried[:, None]
        stays = continues[tried] & (near | behind).all(axis=1)
        if not stays.all():
            return int(tried[np.argmin(stays)])
        n = int(tried[-1]) + 1
    return end


def _is_near(begins: PathRows, ends: PathRows, points: PathRows, within: PathRows | float) -> Booleans:
    """Return whether points (…, axes) are near straight moves; one that ends where it begins is near none."""
    way, off = ends - begins, points - begins
    size = (way * way).sum(axis=-1)
    share = np.clip((off * way).sum(axis=-1) / np.where(size > 0.0, size, 1.0), 0.0, 1.0)
    apart = off - share[..., None] * way
    near: Booleans = ((apart * apart).sum(axis=-1) <= within * within) & (size > 0.0)
    return near


def _straight(
    path: ToolPath,
    rows: Integers,
    kind: npt.NDArray[np.uint8],
    begins: PathRows,
    ends: PathRows,
    begun_by: Integers,
    limits: AxisLimits,
) -> PathSegments:
    """Return moves as if all were straight, with their directions and what the axes allow along them."""
    way = ends - begins
    length = np.sqrt((way * way).sum(axis=1))
    direction = way / np.where(length > 0.0, length, 1.0)[:, None]
    return PathSegments(
        rows,
        kind,
        begins,
        ends,
        length,
        direction,
        direction,
        np.where(kind == RAPID, math.inf, path.feed[rows]),
        *along(direction, limits.speeds),
        *along(direction, limits.accelerations),
        path.corner[rows],
        np.array([each.corner for each in path.roundings])[path.rounding[rows]],
        begun_by,
    )


def _round(path: ToolPath, geometry: Geometry, found: PathSegments, limits: AxisLimits) -> PathSegments:
    """Return moves with their arcs: the smaller of the limits of the two axes of its plane is that of an arc
    in every direction (CN1640 to CN1800).
    """
    if not (found.kind == ARC).any():
        return found
    length, top, acceleration = found.length.copy(), found.top.copy(), found.acceleration.copy()
    first, last = found.first.copy(), found.last.copy()
    top_by, ramp_by = found.top_by.copy(), found.ramp_by.copy()
    for plane, axes in enumerate(PLANES):
        arcs = np.flatnonzero((found.kind == ARC) & (path.plane[found.row] == plane))
        if not len(arcs):
            continue
        rows = found.row[arcs]
        *flat, third = (path.axes.index("XYZ"[n]) for n in axes)
        around = geometry.radius[rows] * np.abs(path.sweep[rows])
        slowest = min(flat, key=lambda n: float(limits.speeds[n]))
        weakest = min(flat, key=lambda n: float(limits.accelerations[n]))
        across = np.sqrt(limits.accelerations[weakest] * NORMAL * geometry.radius[rows])
        is_across = across < limits.speeds[slowest]
        time = around / np.where(is_across, across, limits.speeds[slowest])
        ramp_time = around / limits.accelerations[weakest]
        rise = np.abs(found.ends[arcs, third] - found.begins[arcs, third])
        rises, ramps = rise / limits.speeds[third], rise / limits.accelerations[third]
        length[arcs], first[arcs], last[arcs] = (
            geometry.length[rows],
            geometry.first[rows],
            geometry.last[rows],
        )
        # A helix takes the longer of the two: the turn, or the rise of its third axis.
        top[arcs] = length[arcs] / np.maximum(time, rises)
        acceleration[arcs] = length[arcs] / np.maximum(ramp_time, ramps)
        flat_by = np.where(is_across, len(limits.speeds) + weakest, slowest)
        top_by[arcs] = np.where(rises > time, third, flat_by)
        ramp_by[arcs] = np.where(ramps > ramp_time, third, weakest)
    return replace(
        found,
        length=length,
        first=first,
        last=last,
        top=top,
        top_by=top_by,
        acceleration=acceleration,
        ramp_by=ramp_by,
    )
