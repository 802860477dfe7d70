"""The moves that LinuxCNC makes of the rows of a program: points that lie on one straight move are joined,
flat arcs become two straight moves, and each move gets its own greatest speed and acceleration (emccanon.cc).
"""

from __future__ import annotations

import math
from array import array
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from operator import mul

import numpy as np

from amp_studio.programs import ARC, DWELL, LINE, PLANES, RAPID, ROUNDED, ToolPath
from amp_studio.sim import Geometry, PathLimit, SimulationError

MOST_JOINED = 100
"""Points that one straight move replaces (CN978)."""
NORMAL = math.sqrt(3.0) / 2.0
"""Share of the acceleration across an arc while it speeds up by half of it (CN1682)."""
PathPoint = tuple[float, ...]


@dataclass(slots=True)
class PathSegment:
    """A move of the planner; lengths u, speeds u/s."""

    row: int
    """Of the program's path."""
    begin: PathPoint
    end: PathPoint
    length: float
    """Without what a rounded corner takes."""
    nominal: float
    """With it."""
    first: PathPoint
    """Directions at its ends, of length 1."""
    last: PathPoint
    programmed: float
    """Speed; infinite in rapid."""
    top: float
    top_by: int
    acceleration: float
    ramp_by: int
    is_arc: bool
    is_rapid: bool
    corner: int
    tolerance: float
    kink_before: float = 0.0
    """Share of the acceleration that changes of direction at its ends take."""
    kink_after: float = 0.0
    half: bool = False
    """Whether it has half of the acceleration: it ends with no move after it."""

    @property
    def ramp(self) -> float:
        """The acceleration that is left along a straight move."""
        return self.acceleration * (1.0 - max(self.kink_before, self.kink_after))


@dataclass(frozen=True)
class AxisLimits:
    """Limits of the axes in the columns of a path; numbers of causes go with them."""

    speeds: tuple[float, ...]
    accelerations: tuple[float, ...]

    @classmethod
    def of(
        cls, letters: tuple[str, ...], speeds: Mapping[str, PathLimit], accelerations: Mapping[str, PathLimit]
    ) -> AxisLimits:
        """Return those of some axes."""
        return cls(
            tuple(speeds[letter].value for letter in letters),
            tuple(accelerations[letter].value for letter in letters),
        )

    def straight(self, direction: PathPoint) -> tuple[float, int, float, int]:
        """Return the greatest speed in a direction and its axis, acceleration and its axis (CN739)."""
        speed, ramp, by_speed, by_ramp = math.inf, math.inf, 0, 0
        for n, share in enumerate(map(abs, direction)):
            if share > 1e-12:
                if self.speeds[n] / share < speed:
                    speed, by_speed = self.speeds[n] / share, n
                if self.accelerations[n] / share < ramp:
                    ramp, by_ramp = self.accelerations[n] / share, n
        return speed, by_speed, ramp, by_ramp


class _Chain:
    """Points that one straight move may replace."""

    def __init__(self) -> None:
        self.flat = array("d")
        self.end: PathPoint = ()
        self.row = 0
        """Of the last one."""

    def __len__(self) -> int:
        return len(self.flat) // len(self.end) if self.end else 0

    def add(self, point: PathPoint, row: int) -> None:
        """Add a point."""
        self.flat.extend(point)
        self.end, self.row = point, row


def segments(path: ToolPath, geometry: Geometry, limits: AxisLimits) -> Iterator[PathSegment | int]:
    """Yield the moves of a path in their order, and for each dwell its row. Raises SimulationError."""
    rotary = [n for n, letter in enumerate(path.axes) if letter in "ABC"]
    chain = _Chain()
    begin: PathPoint = tuple(path.start.tolist())
    state: tuple[float, int] | None = None
    ends, kinds = path.ends.tolist(), path.kind.tolist()
    corners, rounding, feeds = path.corner.tolist(), path.rounding.tolist(), path.feed.tolist()
    for row, end in enumerate(tuple(each) for each in ends):
        here = path.ends[row - 1] if row else path.start
        if rotary and _is_mixed(np.asarray(end) - here, rotary):
            raise SimulationError(
                f"Line {int(path.line[row])}: a move of rotary and straight axes together is not simulated"
            )
        joins = path.roundings[rounding[row]].points if corners[row] == ROUNDED else 0.0
        points = _points(path, geometry, row, joins) if kinds[row] in (LINE, ARC) else ()
        now = (feeds[row], rounding[row])
        if chain and (not points or now != state or corners[row] != ROUNDED):
            yield _straight(path, begin, chain.end, chain.row, limits)
            begin, chain = chain.end, _Chain()
        state = now
        for point in points:
            if chain and not _on_one_line(begin, point, chain, joins, rotary):
                yield _straight(path, begin, chain.end, chain.row, limits)
                begin, chain = chain.end, _Chain()
            chain.add(point, row)
            if corners[row] != ROUNDED:
                yield _straight(path, begin, chain.end, chain.row, limits)
                begin, chain = chain.end, _Chain()
        if points:
            continue
        if kinds[row] == DWELL:
            yield row
        elif kinds[row] == RAPID:
            yield _straight(path, begin, end, row, limits)
        else:
            yield _round(path, geometry, row, begin, limits)
        begin = end
    if chain:
        yield _straight(path, begin, chain.end, chain.row, limits)


def _is_mixed(way: np.ndarray, rotary: list[int]) -> bool:
    moving = np.abs(way) > 1e-12
    turning = int(moving[rotary].sum())
    return 0 < turning < int(moving.sum())


def _points(path: ToolPath, geometry: Geometry, row: int, joins: float) -> tuple[PathPoint, ...]:
    """Return the points of the straight moves of a row; none for an arc that stays one (CN1494)."""
    end = tuple(path.ends[row].tolist())
    if path.kind[row] == LINE:
        return (end,)
    radius, sweep = float(geometry.radius[row]), float(path.sweep[row])
    if path.plane[row] != 0 or radius * (1.0 - math.cos(0.5 * sweep)) >= joins:
        return ()
    a, b = path.axes.index("X"), path.axes.index("Y")
    begin, center = geometry.begins[row], path.center[row]
    middle = 0.5 * (begin + path.ends[row])
    angle = math.atan2(begin[b] - center[1], begin[a] - center[0]) + 0.5 * sweep
    middle[a], middle[b] = center[0] + radius * math.cos(angle), center[1] + radius * math.sin(angle)
    return (tuple(middle.tolist()), end)


def _on_one_line(begin: PathPoint, end: PathPoint, chain: _Chain, joins: float, rotary: list[int]) -> bool:
    """Return whether one straight move may replace all points of a chain and go on to another (CN970)."""
    last = chain.end
    if joins == 0.0 or len(chain) > MOST_JOINED or any(end[n] != last[n] for n in rotary) or end == begin:
        return False
    # The newest point is the one beyond which the path turns: most corners need no look at the others.
    near = _square_off(begin, end, last) <= joins * joins
    if not near or len(chain) == 1:
        return near
    off = np.array(chain.flat).reshape(len(chain), len(begin)) - np.array(begin)
    way = np.array(end) - np.array(begin)
    share = np.clip(off @ way / (way @ way), 0.0, 1.0)
    apart = off - share[:, None] * way
    return not bool(((apart * apart).sum(axis=1) > joins * joins).any())


def _square_off(begin: PathPoint, end: PathPoint, point: PathPoint) -> float:
    """Return the square of the distance of a point from a straight move."""
    way = [e - b for e, b in zip(end, begin, strict=True)]
    off = [p - b for p, b in zip(point, begin, strict=True)]
    share = min(max(sum(map(mul, off, way)) / sum(map(mul, way, way)), 0.0), 1.0)
    return math.fsum((o - share * w) ** 2 for o, w in zip(off, way, strict=True))


def _straight(path: ToolPath, begin: PathPoint, end: PathPoint, row: int, limits: AxisLimits) -> PathSegment:
    """Return a straight move with its direction and what the axes allow along it."""
    length = math.dist(begin, end)
    size = length or 1.0
    direction = tuple((e - b) / size for e, b in zip(end, begin, strict=True))
    top, top_by, acceleration, ramp_by = limits.straight(direction)
    return PathSegment(
        row,
        begin,
        end,
        length,
        length,
        direction,
        direction,
        math.inf if path.kind[row] == RAPID else float(path.feed[row]),
        top,
        top_by,
        acceleration,
        ramp_by,
        is_arc=False,
        is_rapid=path.kind[row] == RAPID,
        corner=int(path.corner[row]),
        tolerance=path.roundings[int(path.rounding[row])].corner,
    )


def _round(path: ToolPath, geometry: Geometry, row: int, begin: PathPoint, limits: AxisLimits) -> PathSegment:
    """Return an arc: the smaller of the limits of its two axes in every direction (CN1640 to CN1800)."""
    end = tuple(path.ends[row].tolist())
    places = [path.axes.index("XYZ"[n]) for n in PLANES[int(path.plane[row])]]
    radius, length = float(geometry.radius[row]), float(geometry.length[row])
    around = radius * abs(float(path.sweep[row]))
    slowest = min(places[:2], key=lambda n: limits.speeds[n])
    weakest = min(places[:2], key=lambda n: limits.accelerations[n])
    across = math.sqrt(limits.accelerations[weakest] * NORMAL * radius)
    planar, by = min((limits.speeds[slowest], slowest), (across, len(limits.speeds) + weakest))
    along = abs(end[places[2]] - begin[places[2]])
    time, ramp_time = around / planar, around / limits.accelerations[weakest]
    ramp_by = weakest
    if along / limits.speeds[places[2]] > time:
        time, by = along / limits.speeds[places[2]], places[2]
    if along / limits.accelerations[places[2]] > ramp_time:
        ramp_time, ramp_by = along / limits.accelerations[places[2]], places[2]
    return PathSegment(
        row,
        begin,
        end,
        length,
        length,
        tuple(geometry.first[row].tolist()),
        tuple(geometry.last[row].tolist()),
        float(path.feed[row]),
        length / time,
        by,
        length / ramp_time,
        ramp_by,
        is_arc=True,
        is_rapid=False,
        corner=int(path.corner[row]),
        tolerance=path.roundings[int(path.rounding[row])].corner,
    )
