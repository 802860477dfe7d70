"""What a path allows, a stretch of its rows at a time: limits of each row, corners, and the ramps between the
speeds of `passes.py`; and what limits each piece.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
import numpy.typing as npt

from amp_studio.programs import DWELL, EXACT, RAPID, SLOW, ToolPath
from amp_studio.sim.command.changes import change_time, change_way, peaks
from amp_studio.sim.command.events import Ramp
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.path_rules import (
    Causes,
    Corners,
    Geometry,
    Indices,
    PathLimit,
    PathRows,
    PathRules,
    row_sums,
)

from .geometry import geometry_of

Bounds = tuple[PathRows, Causes]
"""Values, and by which cause."""
_AS_PROGRAMMED = PathLimit(math.inf, None, "feed as programmed")
_DWELLS = PathLimit(0.0, None, "dwell")
_SAME = 1e-12
"""Share of the way below which an axis does not move in a row: what is left of it is rounding."""


class CauseTable:
    """What limits, numbered."""

    def __init__(self) -> None:
        self.limits: list[PathLimit] = [_AS_PROGRAMMED, _DWELLS]
        self._numbers: dict[tuple[object, str], int] = {
            (None, each.title): n for n, each in enumerate(self.limits)
        }

    def number(self, limit: PathLimit) -> int:
        """Return the number of a limit; limits of one parameter are one."""
        key = (limit.param, "" if limit.param else limit.title)
        if key not in self._numbers:
            self._numbers[key] = len(self.limits)
            self.limits.append(limit)
        return self._numbers[key]


@dataclass(frozen=True)
class ProgramPlan:
    """When every row of a stretch is where; (rows,) unless noted. Speeds u/s, times s."""

    path: ToolPath
    geometry: Geometry
    entry: PathRows
    peak: PathRows
    leave: PathRows
    acceleration: PathRows
    deceleration: PathRows
    times: PathRows
    """(rows, 3): faster, even, slower."""
    rest: PathRows
    """Dwell and wait for in position at the end of the row."""
    start: PathRows
    faster_by: Causes
    even_by: Causes
    slower_by: Causes
    rest_by: Causes
    causes: tuple[PathLimit, ...]
    ramps: tuple[Ramp, Ramp]
    """Of feed and of rapid."""
    is_rapid: npt.NDArray[np.bool_]
    programmed: PathRows
    """Speed as programmed, u/s."""

    @property
    def time(self) -> float:
        """When the last row ends."""
        return float(self.start[-1] + self.times[-1].sum() + self.rest[-1]) if len(self.start) else 0.0

    @property
    def time_by_cause(self) -> PathRows:
        """The time in s of each limit, (causes,)."""
        found = np.zeros(len(self.causes))
        for cause, time in (
            (self.faster_by, self.times[:, 0]),
            (self.even_by, self.times[:, 1]),
            (self.slower_by, self.times[:, 2]),
            (self.rest_by, self.rest),
        ):
            found += np.bincount(cause, time, len(found))
        return found

    @property
    def lines(self) -> Indices:
        """Line of the program of each row, from 1."""
        return self.path.line[self.geometry.row].astype(np.int64)

    @property
    def whole(self) -> PathRows:
        """Time in s of each row with its rest."""
        rows: PathRows = row_sums(self.times) + self.rest
        return rows


@dataclass
class StretchBounds:
    """What bounds the rows of a stretch by themselves and at their corners; (rows,). Speeds u/s."""

    path: ToolPath
    geometry: Geometry
    is_rapid: npt.NDArray[np.bool_]
    programmed: PathRows
    top: PathRows
    top_by: Causes
    acceleration: PathRows
    ramp_by: Causes
    deceleration: PathRows
    slower_by: Causes
    entry: PathRows
    """The highest speed at which a row may begin."""
    entry_by: Causes


def stretch_bounds(
    path: ToolPath,
    rules: PathRules,
    table: CauseTable,
    shaped: Callable[[ShapedLimits], None] | None = None,
    *,
    continues: bool = False,
) -> StretchBounds:
    """Return what bounds the rows of a path; that which ``continues`` begins with the last row of the stretch
    before it, which is left out. Raises SimulationError.
    """
    geometry = geometry_of(path, rules.chord.value if rules.chord else None)
    kind = path.kind[geometry.row]
    is_rapid = kind == RAPID
    # What a row allows by itself comes first, then the corner behind it. Each step only lowers values and
    # writes down by what, so that the cause that is left is the one that bounds.
    wanted, top, top_by = _tops(path, geometry, rules, table, is_rapid)
    acceleration, ramp_by = _accelerations(path, geometry, rules, table, is_rapid, rules.axis_acceleration)
    deceleration, slower_by = acceleration.copy(), ramp_by.copy()
    if rules.axis_deceleration is not None:
        deceleration, slower_by = _accelerations(
            path, geometry, rules, table, is_rapid, rules.axis_deceleration
        )
    for values, by in ((top, top_by), (acceleration, ramp_by), (deceleration, slower_by)):
        _check_moves(geometry, table, values, by)
    joint, joint_by = _joints(path, geometry, rules, table, top)
    if shaped is not None:
        shaped(
            ShapedLimits((top, top_by), (joint, joint_by), (acceleration, ramp_by), (deceleration, slower_by))
        )
    # A row begins with the joint before it; the first one at rest, which nothing of the file bounds.
    entry = np.concatenate([[0.0], joint[:-1]]) if len(joint) else joint
    entry_by = np.concatenate([[-1], joint_by[:-1]]).astype(np.int16) if len(joint) else joint_by
    own = int(np.count_nonzero(geometry.row == 0)) if continues else 0
    columns = (is_rapid, wanted, top, top_by, acceleration, ramp_by, deceleration, slower_by, entry, entry_by)
    if own:
        path, geometry = path.rows(1, len(path)), _without(geometry, own)
    kept: list[Any] = [each[own:] for each in columns]
    return StretchBounds(path, geometry, *kept)


def _without(geometry: Geometry, own: int) -> Geometry:
    """Return the geometry without the first rows, which are of the first row of the path."""
    columns = {each.name: getattr(geometry, each.name)[own:] for each in fields(geometry)}
    return Geometry(**{**columns, "row": columns["row"] - 1})


@dataclass(frozen=True)
class Speeds:
    """Speed u/s at which each row of a stretch begins, what bounds it, and that after the last row."""

    entry: PathRows
    entry_by: Causes
    after: float
    after_by: int


def stretch_plan(
    bounds: StretchBounds, rules: PathRules, table: CauseTable, speeds: Speeds, wait: float, begun: float
) -> ProgramPlan:
    """Return when every row of a stretch that begins after ``begun`` s is where; ``wait`` is the time in s
    that the axes need to be in position after a row that ends exactly.
    """
    entry, entry_by, geometry = speeds.entry, speeds.entry_by, bounds.geometry
    leave = np.append(entry[1:], speeds.after) if len(entry) else entry
    leave_by = np.append(entry_by[1:], speeds.after_by) if len(entry) else entry_by
    slopes = bounds.acceleration, bounds.deceleration
    peak, times = _ramps(geometry, rules, bounds.is_rapid, entry, leave, bounds.top, slopes)
    # The look-ahead bounds the speed at an end of a row. The ramp towards that end is run because of it, and
    # its time counts for it, not for the acceleration.
    ahead = table.number(rules.look_ahead) if rules.look_ahead else -2
    rest, rest_by = _rests(bounds.path, geometry, rules, table, leave, wait)
    whole = row_sums(times) + rest
    return ProgramPlan(
        path=bounds.path,
        geometry=geometry,
        entry=entry,
        peak=peak,
        leave=leave,
        acceleration=bounds.acceleration,
        deceleration=bounds.deceleration,
        times=times,
        rest=rest,
        start=begun + np.concatenate([[0.0], np.cumsum(whole)[:-1]]) if len(whole) else whole,
        faster_by=np.where(entry_by == ahead, ahead, bounds.ramp_by).astype(np.int16),
        even_by=bounds.top_by,
        slower_by=np.where(leave_by == ahead, ahead, bounds.slower_by).astype(np.int16),
        rest_by=rest_by,
        causes=tuple(table.limits),
        ramps=(rules.feed_ramp, rules.rapid_ramp),
        is_rapid=bounds.is_rapid,
        programmed=bounds.programmed,
    )


def _check_moves(geometry: Geometry, table: CauseTable, values: PathRows, by: Causes) -> None:
    """Refuse a speed or a ramp of 0, with which a move would never end."""
    never = np.flatnonzero((geometry.length > 0.0) & ~(values > 0.0))
    if len(never):
        limit = table.limits[int(by[never[0]])]
        named = limit.param[0] if limit.param else ""
        raise SimulationError(f"{named or limit.title} is 0: a move along the path would never end", named)


@dataclass(frozen=True)
class ShapedLimits:
    """What a control that shapes its path may lower: values (rows,), and by what."""

    speed: tuple[PathRows, Causes]
    joint: tuple[PathRows, Causes]
    faster: tuple[PathRows, Causes]
    slower: tuple[PathRows, Causes]

    def lower(self, speed: Bounds, acceleration: Bounds, joint: Bounds) -> None:
        """Lower what bounds the rows to what the control made of them: values, and the numbers of causes."""
        _lower_to(self.speed, speed)
        # A joint is never faster than the rows on its sides, and those have just become slower.
        if len(self.joint[0]):
            most = np.minimum(self.speed[0][:-1], self.speed[0][1:])
            self.joint[0][:-1] = np.minimum(self.joint[0][:-1], most)
        _lower_to(self.joint, joint)
        for values in (self.faster, self.slower):
            _lower_to(values, acceleration)


def _lower_to(values: tuple[PathRows, Causes], bounds: Bounds) -> None:
    lower = bounds[0] < values[0]
    values[0][lower], values[1][lower] = bounds[0][lower], bounds[1][lower]


def lowered(
    value: PathRows, by: Causes, bound: PathRows, cause: int, where: npt.NDArray[np.bool_] | None = None
) -> None:
    """Lower values to a bound where it is lower, and write down by what."""
    lower = bound < value
    if where is not None:
        lower &= where
    value[lower], by[lower] = bound[lower], cause


def _of_axes(
    value: PathRows,
    by: Causes,
    geometry: Geometry,
    path: ToolPath,
    limits: Mapping[str, PathLimit],
    table: CauseTable,
    where: npt.NDArray[np.bool_] | None = None,
) -> None:
    """Lower values along the path to what the axes allow."""
    if where is not None and not where.any():
        return
    for n, axis in enumerate(path.axes):
        limit = limits.get(axis)
        if limit is None:
            continue
        # An axis with the share s of the way moves at s times the speed along the path.
        share = geometry.share[:, n]
        bound = np.full(len(share), math.inf)
        np.divide(limit.value, share, out=bound, where=share > _SAME)
        lowered(value, by, bound, table.number(limit), where)


def _tops(
    path: ToolPath, geometry: Geometry, rules: PathRules, table: CauseTable, is_rapid: npt.NDArray[np.bool_]
) -> tuple[PathRows, PathRows, Causes]:
    """Return the programmed speed of each row, the one at which it can be run, and what bounds that."""
    free = path.free[geometry.row] == 1
    wanted = path.feed[geometry.row] * np.where(free, 1.0, rules.override)
    wanted[is_rapid] = math.inf
    top, by = wanted.copy(), np.zeros(len(wanted), np.int16)
    for limits, where, share in ((rules.feed, ~is_rapid, 1.0), (rules.rapid, is_rapid, rules.rapid_override)):
        for limit in limits:
            lowered(top, by, np.full(len(top), limit.value * share), table.number(limit), where)
    rapid = rules.axis_speed if rules.axis_rapid is None else rules.axis_rapid
    _of_axes(top, by, geometry, path, rules.axis_speed, table, ~is_rapid)
    _of_axes(top, by, geometry, path, rapid, table, is_rapid)
    # Where a parameter bounds rapid along the path, the override has scaled that already; here only the axes
    # bound it.
    if rules.rapid_override < 1.0 and not rules.rapid:
        top[is_rapid] *= rules.rapid_override
    if rules.arc is not None and geometry.is_arc.any():
        for limit, bound in rules.arc(geometry.radius):
            lowered(top, by, bound, table.number(limit), geometry.is_arc)
    moving = geometry.length > 0.0
    if not np.isfinite(top[moving]).all():
        raise SimulationError(
            "No parameter of the file bounds the speed of a rapid move: set the rapid speed"
        )
    if (top[moving] <= 0.0).any():
        cause = table.limits[int(by[moving][np.argmin(top[moving])])]
        named = cause.param[0] if cause.param else cause.title
        raise SimulationError(f"A move would never end: {named} is 0", named)
    # A row without way, a dwell, has no speed: both joints beside it are at rest.
    top[~moving] = 0.0
    return wanted, top, by


def _accelerations(
    path: ToolPath,
    geometry: Geometry,
    rules: PathRules,
    table: CauseTable,
    is_rapid: npt.NDArray[np.bool_],
    of_axes: Mapping[str, PathLimit],
) -> tuple[PathRows, Causes]:
    """Return the acceleration that each piece may have, u/s², and which limit it is."""
    count = len(geometry.length)
    value, by = np.full(count, math.inf), np.zeros(count, np.int16)
    for limits, where in ((rules.feed_acceleration, ~is_rapid), (rules.rapid_acceleration, is_rapid)):
        for limit in limits:
            # 0 is "no ramp" here, as in `Ramp`: no bound.
            bound = np.full(count, limit.value if limit.value > 0.0 else math.inf)
            lowered(value, by, bound, table.number(limit), where)
    rapid = of_axes if rules.axis_rapid_acceleration is None else rules.axis_rapid_acceleration
    for own, where in ((of_axes, ~is_rapid), (rapid, is_rapid)):
        axes = {name: limit for name, limit in own.items() if limit.value > 0.0}
        _of_axes(value, by, geometry, path, axes, table, where)
    return value, by


def _joints(
    path: ToolPath, geometry: Geometry, rules: PathRules, table: CauseTable, top: PathRows
) -> tuple[PathRows, Causes]:
    """Return the highest speed between each row and the next, and what bounds it;
    the last one ends at rest.
    """
    count = len(top)
    joint, by = np.zeros(count), np.full(count, -1, np.int16)
    if count < 2:
        return joint, by
    joint[:-1] = np.minimum(top[:-1], top[1:])
    corner = path.corner[geometry.row]
    inside = geometry.row[:-1] == geometry.row[1:]  # pieces of one arc: no end of a block
    slow = (corner[:-1] == SLOW) & ~inside
    for limit, bound in rules.corner(Corners(path.axes, geometry.last[:-1], geometry.first[1:], slow)):
        lowered(joint[:-1], by[:-1], bound, table.number(limit))
    kind = path.kind[geometry.row]
    stops = (corner[:-1] == EXACT) & ~inside
    lowered(joint[:-1], by[:-1], np.zeros(count - 1), table.number(rules.stop), stops)
    rests = (kind == DWELL) | ((kind == RAPID) & rules.rapid_rests)
    # Both ends of a rest: the axes do not move while it lasts.
    joint[:-1][rests[:-1] | rests[1:]] = 0.0
    joint[-1] = 0.0
    return joint, by


def _ramps(
    geometry: Geometry,
    rules: PathRules,
    is_rapid: npt.NDArray[np.bool_],
    entry: PathRows,
    leave: PathRows,
    top: PathRows,
    slopes: tuple[PathRows, PathRows],
) -> tuple[PathRows, PathRows]:
    """Return the highest speed of each row, and its times faster, even, slower."""
    peak, times = np.zeros_like(entry), np.zeros((len(entry), 3))
    for ramp, chosen in ((rules.feed_ramp, ~is_rapid), (rules.rapid_ramp, is_rapid)):
        rows = np.flatnonzero(chosen & (geometry.length > 0.0))
        if not len(rows):
            continue
        v, w, way = entry[rows], leave[rows], geometry.length[rows]
        a, d = slopes[0][rows], slopes[1][rows]
        # Both passes keep the ends reachable to a rounding error. A peak that is lower than an end by such an
        # error would give a negative way at even speed, hence the bounds here and below.
        most = np.maximum(np.maximum(top[rows], v), w)
        high = np.maximum(peaks(ramp, v, w, way, most, a, d), np.maximum(v, w))
        even = np.maximum(way - change_way(ramp, v, high, a) - change_way(ramp, high, w, d), 0.0)
        peak[rows] = high
        times[rows, 0] = change_time(ramp, high - v, a)
        times[rows, 1] = np.where(high > 0.0, even / np.where(high > 0.0, high, 1.0), 0.0)
        times[rows, 2] = change_time(ramp, high - w, d)
    return peak, times


def _rests(
    path: ToolPath, geometry: Geometry, rules: PathRules, table: CauseTable, leave: PathRows, wait: float
) -> tuple[PathRows, Causes]:
    """Return how long the axes rest at the end of each row, and why."""
    rest = path.seconds[geometry.row].copy()
    # Cause 1 is the dwell, the second that `CauseTable` numbers.
    by = np.ones(len(rest), np.int16)
    if rules.pause > 0.0:
        stops = (leave == 0.0) & (geometry.length > 0.0)
        rest[stops], by[stops] = rules.pause, table.number(rules.stop)
    if rules.waits:
        # An arc in pieces ends with the last of them.
        last = np.append(geometry.row[:-1] != geometry.row[1:], True)
        exact = (path.corner[geometry.row] == EXACT) & (path.kind[geometry.row] != DWELL) & last
        rest[exact], by[exact] = wait, table.number(rules.stop)
    return rest, by
