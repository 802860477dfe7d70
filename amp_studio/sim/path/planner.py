"""The speed along a path: limits of each row, corners, look-ahead, ramps; and what limits each piece.

Backward, every row gets the highest speed from which the rows after it can be kept to; forward, the highest
that the rows before it let it reach (J. Huang, L.-M. Zhu, Feed scheduling of a path in two passes, as every
planner of short blocks does it). What a row leaves over is run at its own limit.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from amp_studio.programs import DWELL, EXACT, RAPID, SLOW, ToolPath
from amp_studio.sim.command.changes import SYMMETRIC, change_time, change_way, peaks, reached
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
    RowBounds,
    ShapedPath,
)

from .geometry import geometry_of

AS_PROGRAMMED = PathLimit(math.inf, None, "feed as programmed")
DWELLS = PathLimit(0.0, None, "dwell")
EVERY = 16384
"""Rows between two reports of progress, each of which may cancel the planning."""
_ROUNDING = 1e-9
"""Share of the time of a program that is only the rounding of sums."""
SAME = 1e-12
"""Share of the way below which an axis does not move in a row: what is left of it is rounding."""


class CauseTable:
    """What limits, numbered."""

    def __init__(self) -> None:
        self.limits: list[PathLimit] = [AS_PROGRAMMED, DWELLS]
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
    """When every row is where; (rows,) unless noted. Speeds u/s, times s."""

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
        """Of the whole program."""
        return float(self.start[-1] + self.times[-1].sum() + self.rest[-1]) if len(self.start) else 0.0

    @cached_property
    def time_by_cause(self) -> PathRows:
        """The time in s of each limit, (causes,); 0 for one whose time is the rounding of a sum."""
        found = np.zeros(len(self.causes))
        for cause, time in (
            (self.faster_by, self.times[:, 0]),
            (self.even_by, self.times[:, 1]),
            (self.slower_by, self.times[:, 2]),
            (self.rest_by, self.rest),
        ):
            found += np.bincount(cause, time, len(found))
        return np.where(found > _ROUNDING * found.sum(), found, 0.0)

    def time_of_lines(self, rows: Indices | slice = slice(None)) -> dict[int, float]:
        """Return line of the program -> its time in s; of some rows alone."""
        whole = self.times[rows].sum(axis=1) + self.rest[rows]
        lines = self.path.line[self.geometry.row[rows]]
        sums, present = np.bincount(lines, whole), np.unique(lines)
        return dict(zip(present.tolist(), sums[present].tolist(), strict=True))


def plan_program(
    path: ToolPath,
    rules: PathRules,
    waits: Callable[[int], float] = lambda _row: 0.0,
    progress: Callable[[float], None] = lambda _share: None,
) -> ProgramPlan:
    """Return when every row of a path is where.

    ``waits`` gives the time in s that the axes need to be in position after a row that ends exactly;
    ``progress`` gets the share that is done, and may raise to cancel. Raises SimulationError.
    """
    # All below uses the mean of both ends as the mean speed of a ramp, which an exponential one has not.
    for ramp in (rules.feed_ramp, rules.rapid_ramp):
        if ramp.kind not in SYMMETRIC:
            raise SimulationError(f"A path with {ramp.kind} ramps is not simulated")
    geometry = geometry_of(path, rules.chord.value if rules.chord else None)
    shaped = rules.shape(path, geometry) if rules.shape else None
    if shaped is not None:
        path, geometry = shaped.path, geometry_of(shaped.path, None)
    progress(0.1)
    table = CauseTable()
    kind = path.kind[geometry.row]
    is_rapid = kind == RAPID
    # What a row allows by itself comes first, then the corner behind it. Each step only lowers values and
    # writes down by what, so that the cause that is left is the one that bounds.
    wanted, top, top_by = _tops(path, geometry, rules, table, is_rapid)
    acceleration, ramp_by = _accelerations(path, geometry, rules, table, is_rapid, rules.axis_acceleration)
    slower = rules.axis_acceleration if rules.axis_deceleration is None else rules.axis_deceleration
    deceleration, slower_by = _accelerations(path, geometry, rules, table, is_rapid, slower)
    for values, by in ((top, top_by), (acceleration, ramp_by), (deceleration, slower_by)):
        _check_moves(geometry, table, values, by)
    slopes = acceleration, deceleration
    joint, joint_by = _joints(path, geometry, rules, table, top)
    if shaped is not None:
        _shape(
            shaped,
            table,
            (top, top_by),
            (joint, joint_by),
            (acceleration, ramp_by),
            (deceleration, slower_by),
        )
    progress(0.3)
    entry, entry_by = _look_ahead(geometry, rules, table, is_rapid, slopes, joint, joint_by, progress)
    leave = np.append(entry[1:], 0.0)
    leave_by = np.append(entry_by[1:], -1)
    # The look-ahead bounds the speed at an end of a row. The ramp towards that end is run because of it, and
    # its time counts for it, not for the acceleration.
    peak, times = _ramps(geometry, rules, is_rapid, entry, leave, top, slopes)
    ahead = table.number(rules.look_ahead) if rules.look_ahead else -1
    rest, rest_by = _rests(path, geometry, rules, table, leave, waits)
    whole = times.sum(axis=1) + rest
    start = np.concatenate([[0.0], np.cumsum(whole)[:-1]]) if len(whole) else whole
    progress(1.0)
    return ProgramPlan(
        path,
        geometry,
        entry,
        peak,
        leave,
        acceleration,
        deceleration,
        times,
        rest,
        start,
        np.where(entry_by == ahead, ahead, ramp_by).astype(np.int16) if ahead >= 0 else ramp_by,
        top_by,
        np.where(leave_by == ahead, ahead, slower_by).astype(np.int16) if ahead >= 0 else slower_by,
        rest_by,
        tuple(table.limits),
        (rules.feed_ramp, rules.rapid_ramp),
        is_rapid,
        wanted,
    )


def _check_moves(geometry: Geometry, table: CauseTable, values: PathRows, by: Causes) -> None:
    """Refuse a speed or a ramp of 0, with which a move would never end."""
    never = np.flatnonzero((geometry.length > 0.0) & ~(values > 0.0))
    if len(never):
        limit = table.limits[int(by[never[0]])]
        named = limit.param[0] if limit.param else ""
        raise SimulationError(f"{named or limit.title} is 0: a move along the path would never end", named)


def _shape(
    shaped: ShapedPath,
    table: CauseTable,
    speed: tuple[PathRows, Causes],
    joint: tuple[PathRows, Causes],
    *ramps: tuple[PathRows, Causes],
) -> None:
    """Lower what bounds the rows to what the control made of them."""
    numbers = np.array([table.number(limit) for limit in shaped.limits], np.int16)

    def lower(values: tuple[PathRows, Causes], bounds: RowBounds) -> None:
        lower = bounds.value < values[0]
        values[0][lower], values[1][lower] = bounds.value[lower], numbers[bounds.by[lower]]

    lower(speed, shaped.speed)
    # A joint is never faster than the rows on its sides, and those have just become slower.
    if len(joint[0]):
        joint[0][:-1] = np.minimum(joint[0][:-1], np.minimum(speed[0][:-1], speed[0][1:]))
    lower(joint, shaped.joint)
    for values in ramps:
        lower(values, shaped.acceleration)


def _lowered(
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
    for n, axis in enumerate(path.axes):
        limit = limits.get(axis)
        if limit is None:
            continue
        # An axis with the share s of the way moves at s times the speed along the path.
        share = geometry.share[:, n]
        bound = np.full(len(share), math.inf)
        np.divide(limit.value, share, out=bound, where=share > SAME)
        _lowered(value, by, bound, table.number(limit), where)


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
            _lowered(top, by, np.full(len(top), limit.value * share), table.number(limit), where)
    rapid = rules.axis_speed if rules.axis_rapid is None else rules.axis_rapid
    _of_axes(top, by, geometry, path, rules.axis_speed, table, ~is_rapid)
    _of_axes(top, by, geometry, path, rapid, table, is_rapid)
    # Where a parameter bounds rapid along the path, the override has scaled that already; here only the axes
    # bound it.
    if rules.rapid_override < 1.0 and not rules.rapid:
        top[is_rapid] *= rules.rapid_override
    if rules.arc is not None and geometry.is_arc.any():
        for limit, bound in rules.arc(geometry.radius):
            _lowered(top, by, bound, table.number(limit), geometry.is_arc)
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
    count = len(geometry.length)
    value, by = np.full(count, math.inf), np.zeros(count, np.int16)
    for limits, where in ((rules.feed_acceleration, ~is_rapid), (rules.rapid_acceleration, is_rapid)):
        for limit in limits:
            # 0 is "no ramp" here, as in `Ramp`: no bound.
            bound = np.full(count, limit.value if limit.value > 0.0 else math.inf)
            _lowered(value, by, bound, table.number(limit), where)
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
        _lowered(joint[:-1], by[:-1], bound, table.number(limit))
    kind = path.kind[geometry.row]
    stops = (corner[:-1] == EXACT) & ~inside
    _lowered(joint[:-1], by[:-1], np.zeros(count - 1), table.number(rules.stop), stops)
    rests = (kind == DWELL) | ((kind == RAPID) & rules.rapid_rests)
    # Both ends of a rest: the axes do not move while it lasts.
    joint[:-1][rests[:-1] | rests[1:]] = 0.0
    joint[-1] = 0.0
    return joint, by


def _look_ahead(
    geometry: Geometry,
    rules: PathRules,
    table: CauseTable,
    is_rapid: npt.NDArray[np.bool_],
    slopes: tuple[PathRows, PathRows],
    joint: PathRows,
    joint_by: Causes,
    progress: Callable[[float], None],
) -> tuple[PathRows, Causes]:
    """Return the speed at which each row begins, and what bounds it."""
    count = len(joint)
    # A row begins with the joint before it; the first one at rest, which nothing of the file bounds.
    entry_by = np.concatenate([[-1], joint_by[:-1]]).astype(np.int16) if count else joint_by
    most = np.concatenate([[0.0], joint[:-1]]) if count else joint
    straight = all(ramp.kind in ("none", "linear") for ramp in (rules.feed_ramp, rules.rapid_ramp))
    # Braking ways add up as v² = 2 a s with straight ramps only.
    if rules.look_ahead is not None and straight:
        # The rows that are known must be enough to stop in: their braking ways are added up. That bound is
        # all a shorter look-ahead changes, as every bound of a row farther ahead is higher than it.
        known = max(1, int(rules.look_ahead.value))
        # Finite, as the difference of two infinite sums is no number.
        braking = np.where(np.isfinite(slopes[1]), slopes[1], 1e12)
        gain = np.concatenate([[0.0], np.cumsum(2.0 * braking * geometry.length)])
        room = gain[np.minimum(np.arange(count) + known, count)] - gain[:-1]
        _lowered(most, entry_by, np.sqrt(room), table.number(rules.look_ahead))
    if straight:
        return _straight_passes(most, geometry.length, slopes, progress), entry_by
    ramps = [rules.rapid_ramp if rapid else rules.feed_ramp for rapid in is_rapid.tolist()]
    return _curved_passes(ramps, most, geometry.length, slopes, progress), entry_by


def _straight_passes(
    most: PathRows, length: PathRows, slopes: tuple[PathRows, PathRows], progress: Callable[[float], None]
) -> PathRows:
    """Return the speeds at which rows begin, as `_curved_passes`, with straight ramps."""
    bound = most * most
    # More than the greatest square lowers nothing: so is a ramp without an end, whatever its way is.
    with np.errstate(invalid="ignore"):
        faster, slower = (
            np.nan_to_num(
                np.minimum(2.0 * slope * length, bound.max(initial=0.0)), nan=bound.max(initial=0.0)
            )
            for slope in slopes
        )
    # Backward from rest at the end, then forward.
    square = lowest_sums(np.append(0.0, bound[::-1]), slower[::-1])[:0:-1]
    progress(0.6)
    square = lowest_sums(square, faster[:-1])
    progress(0.9)
    return np.where(square < bound, np.sqrt(square), most)


CHUNK = 512
"""Rows whose sums are taken together: few enough to keep them exact, many enough to be fast."""


def lowest_sums(bound: PathRows, gain: PathRows) -> PathRows:
    """Return the highest values of which none is above its ``bound`` (n), nor above the one before it by more
    than ``gain`` (n - 1). A value at its bound is that bound, bit for bit.

    Each is the lowest of all bounds before it plus the gains from there on, so that no loop is needed.
    """
    count = len(bound)
    chunks = max(-(-count // CHUNK), 1)
    most, step = np.full((2, chunks * CHUNK), [[math.inf], [0.0]])
    most[:count], step[1:count] = bound, gain
    most, step = most.reshape(chunks, CHUNK), step.reshape(chunks, CHUNK)
    way = np.cumsum(step, axis=1)
    low = np.minimum.accumulate(most - way, axis=1)
    before, last = np.empty(chunks), math.inf
    for n, (own, whole) in enumerate(zip(low[:, -1].tolist(), way[:, -1].tolist(), strict=True)):
        before[n] = last
        last = min(own, last) + whole
    earlier = np.minimum(np.hstack([before[:, None], low[:, :-1]]), before[:, None])
    found: PathRows = np.minimum(most, earlier + way).ravel()[:count]
    return found


def _curved_passes(
    ramps: Sequence[Ramp],
    most: PathRows,
    length: PathRows,
    slopes: tuple[PathRows, PathRows],
    progress: Callable[[float], None],
) -> PathRows:
    """Return the speeds at which rows begin, of which none is above ``most``."""
    ways, speeds, count = length.tolist(), most.tolist(), len(most)
    faster, slower = (each.tolist() for each in slopes)
    after = 0.0
    # Backward: from the end of the program, where the axes rest, no row may begin faster than it can brake to
    # what the next one begins with.
    for n in range(count - 1, -1, -1):
        can = reached(ramps[n], after, ways[n], slower[n]) if ways[n] else after
        after = speeds[n] = min(speeds[n], can)
        if n % EVERY == 0:
            progress(0.3 + 0.3 * (count - n) / count)
    # Forward: of that, a row reaches only what it can accelerate to. What is lowered here is never below the
    # beginning of its row, so that no row has to brake for it.
    for n in range(count - 1):
        can = reached(ramps[n], speeds[n], ways[n], faster[n]) if ways[n] else speeds[n]
        speeds[n + 1] = min(speeds[n + 1], can)
        if n % EVERY == 0:
            progress(0.6 + 0.3 * n / count)
    return np.array(speeds)


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
    path: ToolPath,
    geometry: Geometry,
    rules: PathRules,
    table: CauseTable,
    leave: PathRows,
    waits: Callable[[int], float],
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
        cause = table.number(rules.stop)
        for n in np.flatnonzero(exact).tolist():
            rest[n], by[n] = waits(n), cause
    return rest, by
