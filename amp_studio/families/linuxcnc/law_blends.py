"""Where the moves of LinuxCNC meet: a small change of direction is passed, a corner is rounded by an arc,
or the path stops (tp.c, blendmath.c). A rounded corner in a plane of the program becomes an arc, another
one short straight rows.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from amp_studio.programs import ARC, DWELL, EXACT, KEPT, LINE, MAX_ROWS, PLANES, RAPID, ToolPath
from amp_studio.sim import Geometry, PathLimit, PathRows, RowBounds, ShapedPath, SimulationError

from .law_segments import NORMAL, AxisLimits, Booleans, Integers, segments

_TANGENTIAL = 0.5
"""Share of the acceleration that is left along an arc (blendmath.h, line 19)."""
_SHARP = math.radians(2.0)
"""Of the direction back from which a corner is a stop (TP1877)."""
_OF_LENGTH = 0.25
"""Share of a move that a corner may be off where the program gives no distance (TS546)."""
_OF_MOVE = 0.5
"""Share of a move that a corner may take."""
_SMALLEST_ANGLE, _SHORTEST = 1e-6, 1e-6
"""rad, u: of a rounded corner."""
_MIN_CYCLES = 1.02
"""Servo cycles of a move."""
_GAP_CYCLES = 4.0
"""Servo cycles below which what is left before a corner goes at its speed."""
_WITHIN = 1e-4
"""u between a rounded corner and the straight rows of it."""

STOP = PathLimit(0.0, None, "exact stop")
CHANGE = PathLimit(0.0, None, "change between rapid and feed")
BACK = PathLimit(0.0, None, "way back in the same line")
_GIVEN = PathLimit(0.0, None, "distance of G64 from a corner")
ROTARY = "Line {line}: corners of rotary axes with G64 are not simulated"
_NOT_ROUNDED = (
    "Line {line}: how G64 rounds a corner at an arc is not simulated; an arc that goes on in the direction of"
    " its neighbours is, and every arc with G61"
)


@dataclass(frozen=True)
class PathFigures:
    """What the planner takes from the file; u/s, u/s2, s."""

    speeds: Mapping[str, PathLimit]
    accelerations: Mapping[str, PathLimit]
    period: float
    kink: PathLimit
    """Share of the acceleration that a change of direction may take."""
    greatest_override: float
    with_arcs: bool


class _Junctions:
    """What is between each move and the next one, (n,); lengths u, speeds u/s."""

    def __init__(self, count: int) -> None:
        self.speed, self.by = np.full(count, math.inf), np.zeros(count, np.int64)
        """At which the path goes on."""
        self.kink = np.zeros(count)
        """Share of the acceleration that the change of direction takes."""
        self.is_round = np.zeros(count, bool)
        """Whether an arc is between them, which the columns below are of."""
        self.radius, self.angle, self.cut = np.zeros((3, count))
        """``cut`` is the length that it takes of each of its moves."""
        self.top, self.top_by = np.zeros(count), np.zeros(count, np.int64)
        self.acceleration, self.ramp_by = np.zeros(count), np.zeros(count, np.int64)
        self.programmed = np.zeros(count)
        """Speed as programmed."""


def shaped(figures: PathFigures, path: ToolPath, geometry: Geometry, is_all: bool) -> ShapedPath:
    """Return what the control makes of a path, but for the last move of one that goes on;
    raises SimulationError for a corner that is not simulated.
    """
    return _Shaping(figures, path, geometry, is_all=is_all).shape()


class _Shaping:
    """One path. A corner depends on nothing that the corner before it changes: that one takes at most half of
    the move between them, and this one no more than the other half. So all are worked out at once.
    """

    def __init__(self, figures: PathFigures, path: ToolPath, geometry: Geometry, *, is_all: bool) -> None:
        self._figures, self._path, self._geometry = figures, path, geometry
        self._limits = AxisLimits.of(path.axes, figures.speeds, figures.accelerations)
        self._count = count = len(path.axes)
        self._causes: list[PathLimit] = [
            *(figures.speeds[letter] for letter in path.axes),
            *(figures.accelerations[letter] for letter in path.axes),
            figures.kink,
            STOP,
            CHANGE,
            BACK,
            _GIVEN,
        ]
        self._kink, self._stop, self._change, self._back, self._given = range(2 * count, 2 * count + 5)
        self._straight = [n for n, letter in enumerate(path.axes) if letter in "XYZ"]
        self._rotary = [n for n in range(count) if n not in self._straight]
        columns = {letter: n for n, letter in enumerate(path.axes)}
        self._planes = {
            n: [columns["XYZ"[each]] for each in plane]
            for n, plane in enumerate(PLANES)
            if columns.keys() >= {*"XYZ"}
        }
        self._moves = moves = segments(path, geometry, self._limits, is_all=is_all)
        # No move is shorter than a cycle.
        self._top = np.where(
            moves.kind == DWELL, math.inf, np.minimum(moves.top, moves.length / figures.period)
        )
        self._most = np.minimum(moves.programmed * figures.greatest_override, self._top)

    def shape(self) -> ShapedPath:
        """Work it out."""
        between = _Junctions(len(self._moves))
        self._join(between, np.arange(max(len(self._moves) - 1, 0)))
        return self._written(between)

    # -- where two moves meet --------------------------------------------------------

    def _join(self, between: _Junctions, one: Integers) -> None:
        """Work out what is between some moves and the next ones."""
        moves, two = self._moves, one + 1
        moving = (moves.kind[one] != DWELL) & (moves.kind[two] != DWELL)
        one, two = one[moving], two[moving]
        corner, kind = moves.corner, moves.kind

        def stop(where: Booleans, cause: int) -> None:
            nonlocal one, two
            between.speed[one[where]], between.by[one[where]] = 0.0, cause
            one, two = one[~where], two[~where]

        stop((kind[one] == RAPID) != (kind[two] == RAPID), self._change)
        exact = corner[one] == EXACT
        for axis in self._rotary:
            exact |= (moves.first[one, axis] != 0.0) | (moves.first[two, axis] != 0.0)
        not_simulated = exact & (corner[one] != EXACT) & (corner[one] != KEPT)
        refused = [(two[not_simulated], ROTARY)]
        stop(exact, self._stop)
        back = ((moves.last[one] + moves.first[two]) ** 2).sum(axis=1) < _SHARP * _SHARP
        stop(back, self._back)
        speed = np.minimum(self._most[one], self._most[two])
        share = self._kinked(one, two, speed)
        kink = self._figures.kink.value
        passed = (share < kink) | (share == 0.0)
        at = one[passed]
        between.speed[at], between.by[at], between.kink[at] = speed[passed], self._kink, share[passed]
        one, two, slow = one[~passed], two[~passed], speed[~passed] * kink / share[~passed]
        # The planner takes the acceleration of a change of direction away where it stops there too (TP1929).
        between.kink[one], between.speed[one], between.by[one] = kink, slow, self._kink
        kept = corner[one] == KEPT
        slow = slow[~kept]
        stop(kept, self._stop)
        refused.append((two[(kind[one] == ARC) | (kind[two] == ARC)], _NOT_ROUNDED))
        self._refuse(refused)
        if self._figures.with_arcs:
            self._round(between, one, two, slow)

    def _refuse(self, refused: list[tuple[Integers, str]]) -> None:
        """Refuse the first of some moves, each with the sentence of why."""
        first = min(((int(rows[0]), text) for rows, text in refused if len(rows)), default=None)
        if first is not None:
            raise SimulationError(first[1].format(line=int(self._path.line[self._moves.row[first[0]]])))

    def _kinked(self, one: Integers, two: Integers, speed: PathRows) -> PathRows:
        """Return the share of an acceleration that a change of direction takes in a cycle (TP1894)."""
        moves, straight = self._moves, self._straight
        # The whole speed changes its direction within one cycle, on top of the ramp of the next move.
        at_once = speed / self._figures.period + moves.acceleration[two]
        turn = np.abs(moves.first[two] - moves.last[one])[:, straight]
        share = (turn * at_once[:, None] / self._limits.accelerations[straight]).max(axis=1)
        is_arc = (moves.kind[one] == ARC) | (moves.kind[two] == ARC)
        kinked: PathRows = np.where(is_arc, share / _TANGENTIAL, share)
        return kinked

    # -- a rounded corner --------------------------------------------------------------

    def _round(self, between: _Junctions, one: Integers, two: Integers, slow: PathRows) -> None:
        """Round the corners between straight moves that are faster so than at ``slow``, the speed of a
        change of direction (blendComputeParameters).
        """
        moves, tolerance = self._moves, self._moves.tolerance
        cosine = (moves.last[one] * moves.first[two]).sum(axis=1)
        # Half the angle between the two moves inside the corner; ``phi`` is by how much the path turns.
        theta = 0.5 * np.arccos(np.clip(-cosine, -1.0, 1.0))
        # Straight on there is nothing to round, and back no arc fits.
        turns = (theta > _SMALLEST_ANGLE) & (theta < 0.5 * math.pi - _SMALLEST_ANGLE)
        one, two, theta, slow = one[turns], two[turns], theta[turns], slow[turns]
        phi = math.pi - 2.0 * theta
        least = np.minimum(moves.length[one], moves.length[two])
        given = [np.where(tolerance[n] > 0.0, tolerance[n], moves.length[n] * _OF_LENGTH) for n in (one, two)]
        off = np.minimum(np.minimum(*given), least * _OF_LENGTH)
        acceleration, ramp_by = self._inscribed(one, two, self._limits.accelerations)
        by_tolerance = np.cos(theta) * off / (1.0 - np.sin(theta))
        room = np.minimum(least * _OF_MOVE, by_tolerance)
        largest = np.tan(theta) * room
        goal = self._goal(one, two, phi, np.maximum(self._most[one], self._most[two]))
        speed = np.sqrt(NORMAL * acceleration * largest)
        by = np.where((room == by_tolerance) & (tolerance[one] > 0.0), self._given, ramp_by + self._count)
        by = np.where(speed > goal, moves.top_by[two], by)
        speed = np.minimum(speed, goal)
        half = 0.5 * acceleration
        time = np.minimum(np.sqrt(2.0 * half * room), speed) / half
        radius = np.maximum(speed * speed / (NORMAL * acceleration), np.minimum(time * speed / phi, largest))
        # An arc shorter than a cycle at its speed would be jumped over.
        speed = np.minimum(speed, radius * phi / self._figures.period)
        # Where the sharp corner is passed faster, the planner leaves it sharp.
        is_round = (radius * phi >= _SHORTEST) & (speed > slow)
        at, after = one[is_round], two[is_round]
        between.speed[at], between.by[at], between.kink[at] = math.inf, 0, 0.0
        between.is_round[at] = True
        between.radius[at], between.angle[at] = radius[is_round], phi[is_round]
        between.cut[at] = (radius / np.tan(theta))[is_round]
        between.top[at], between.top_by[at] = speed[is_round], by[is_round]
        between.acceleration[at], between.ramp_by[at] = (
            (acceleration * _TANGENTIAL)[is_round],
            ramp_by[is_round],
        )
        wanted = [np.minimum(moves.programmed[n], self._top[n]) for n in (at, after)]
        between.programmed[at] = np.maximum(*wanted)

    def _goal(self, one: Integers, two: Integers, phi: PathRows, wanted: PathRows) -> PathRows:
        """Return the wanted speed, or what the axes have in every direction of a corner if that is less
        (blendParamKinematics).
        """
        # Just short of a right angle, where the cosine would be 0.
        flat = np.cos(np.minimum(phi, math.pi * 0.49))
        a = np.minimum(self._top[one], self._top[two] / flat)
        b = np.minimum(self._top[two], self._top[one] / flat)
        base = a[:, None] * self._moves.last[one] - b[:, None] * self._moves.first[two]
        across = a * b * np.sin(phi) / np.sqrt((base * base).sum(axis=1))
        every = self._inscribed(one, two, self._limits.speeds)[0]
        goal: PathRows = np.minimum(wanted, np.where(across >= wanted, wanted, np.maximum(across, every)))
        return goal

    def _inscribed(self, one: Integers, two: Integers, bounds: PathRows) -> tuple[PathRows, Integers]:
        """Return what all directions in the plane of two moves can have, and the axis that bounds it."""
        u, v = self._moves.last[one][:, self._straight], self._moves.first[two][:, self._straight]
        moving = (u != 0.0) | (v != 0.0)
        across = v - (u * v).sum(axis=1)[:, None] * u
        size = np.sqrt((across * across).sum(axis=1))
        # How far an axis lies in the plane is the length of its projection on the two directions of it.
        lies = np.hypot(u, across / np.where(size > 0.0, size, 1.0)[:, None])
        # Two axes that move lie in it whole.
        is_flat = moving.sum(axis=1) == 2
        lies[is_flat] = moving[is_flat]
        # An axis that is square to the plane bounds nothing in it.
        found = bounds[self._straight] / np.maximum(lies, 1e-12)
        least = found.argmin(axis=1)
        return found[np.arange(len(least)), least], np.array(self._straight)[least]

    # -- rows ----------------------------------------------------------------------

    def _written(self, between: _Junctions) -> ShapedPath:
        """Return the moves and the rounded corners as rows, with what bounds them."""
        moves, path = self._moves, self._path
        count = len(moves)
        rounds = np.flatnonzero(between.is_round)
        planes = self._plane_of(rounds)
        parts = np.zeros(count, np.int64)
        # A row can be an arc in a plane of the program only; half of it belongs to each of the two blocks.
        parts[rounds] = np.where(
            planes >= 0, 2, _straight_rows(between.radius[rounds], between.angle[rounds])
        )
        left, top, top_by, acceleration = self._left(between)
        # A move that its two corners take whole leaves no row.
        is_row = ~between.is_round | (left > _SHORTEST)
        total = int(is_row.sum() + parts.sum())
        if total > MAX_ROWS:
            raise SimulationError(f"The rounded corners of the program become more than {MAX_ROWS} moves")
        start = np.cumsum(is_row + parts) - is_row - parts
        out = _Rows(total, len(path.axes))
        # The moves themselves.
        own = np.flatnonzero(is_row)
        at, row = start[own], moves.row[own]
        cut = np.where(between.is_round, between.cut, 0.0)
        out.ends[at] = moves.ends[own] - cut[own, None] * moves.last[own]
        out.kind[at], out.row[at], out.plane[at] = moves.kind[own], row, path.plane[row]
        out.line[at] = path.line[row]
        out.feed[at], out.arc[at] = path.feed[row], np.column_stack([path.center[row], path.sweep[row]])
        out.arc[at[moves.kind[own] != ARC]] = 0.0
        speed, ramp = self._bounds(between, top, acceleration)
        out.speed[at], out.speed_by[at] = speed[own], top_by[own]
        out.ramp[at], out.ramp_by[at] = ramp[own], moves.ramp_by[own] + self._count
        out.joint[at], out.joint_by[at] = between.speed[own], between.by[own]
        dwells = at[moves.kind[own] == DWELL]
        out.speed_by[dwells], out.ramp_by[dwells] = 0, 0
        self._end(out, start, left, ramp)
        self._add_corners(out, between, rounds, planes, parts[rounds], (start + is_row)[rounds])
        out.move = np.repeat(np.arange(count), is_row + parts)
        return out.shaped(path, self._causes, moves.begun_by)

    def _left(self, between: _Junctions) -> tuple[PathRows, PathRows, Integers, PathRows]:
        """Return what rounded corners leave of each move: length, greatest speed, its cause, acceleration."""
        moves, period = self._moves, self._figures.period
        left = moves.length.copy()
        left[1:] -= between.cut[:-1]
        left -= between.cut
        top, top_by, acceleration = self._top.copy(), moves.top_by.copy(), moves.acceleration.copy()
        rounds = between.is_round
        short = np.zeros(len(left), bool)
        # What is left would be faster than the arcs for a few cycles only: the planner goes on at their
        # speed.
        short[rounds] = left[rounds] / between.top[rounds] < _GAP_CYCLES * period
        slower = short & (between.top < top)
        top[slower], top_by[slower] = between.top[slower], between.top_by[slower]
        acceleration[short] = np.minimum(acceleration[short], between.acceleration[short])
        rest = rounds & ~short & (left > 0.0)
        top[rest] = np.minimum(top[rest], left[rest] / (period * _MIN_CYCLES))
        return left, top, top_by, acceleration

    def _is_last(self) -> Booleans:
        """Return whether no move comes after a move: the end of the path, or a dwell."""
        kind = self._moves.kind
        is_last: Booleans = (kind != DWELL) & np.append(kind[1:] == DWELL, True)[: len(kind)]
        return is_last

    def _bounds(
        self, between: _Junctions, top: PathRows, acceleration: PathRows
    ) -> tuple[PathRows, PathRows]:
        """Return speed and acceleration of each move; with G64 the last one has half of the acceleration."""
        moves, kink = self._moves, between.kink.copy()
        kink[1:] = np.maximum(kink[1:], between.kink[:-1])
        ramp = acceleration * (1.0 - kink)
        is_half = self._is_last() & (moves.corner != EXACT) & (moves.corner != KEPT)
        whole = np.where(is_half, 0.5 * ramp, ramp)
        dwells, arcs = moves.kind == DWELL, np.flatnonzero(moves.kind == ARC)
        speed, bound = top.copy(), whole.copy()
        speed[dwells] = bound[dwells] = math.inf
        if len(arcs):
            speed[arcs], along_arc = self._along_arcs(arcs, top[arcs], ramp[arcs], whole[arcs])
            bound[arcs] = np.where(is_half[arcs], 0.5 * along_arc, along_arc)
        return speed, bound

    def _along_arcs(
        self, arcs: Integers, top: PathRows, ramp: PathRows, whole: PathRows
    ) -> tuple[PathRows, PathRows]:
        """Return speed and acceleration along arcs; the last one of all gets no others (TS745)."""
        moves = self._moves
        radius = self._geometry.radius[moves.row[arcs]]
        thirds = np.array([self._path.axes.index("XYZ"[third]) for *_, third in PLANES])
        third = thirds[self._path.plane[moves.row[arcs]]]
        rise = moves.ends[arcs, third] - moves.begins[arcs, third]
        radius = radius + rise * rise / radius  # as pmCircleEffectiveMinRadius has it
        across = top * top / radius
        is_last = self._is_last()[arcs]
        slows = (across > NORMAL * whole) & ~is_last
        speed = np.where(slows, np.sqrt(NORMAL * whole * radius), top)
        inside = np.sqrt(np.maximum(1.0 - (across / whole) ** 2, 0.0))
        return speed, ramp * np.where(slows | is_last, _TANGENTIAL, inside)

    def _end(self, out: _Rows, start: Integers, left: PathRows, ramp: PathRows) -> None:
        """Slow down into moves with nothing after them: a next move could take half of one, so it begins only
        as fast as it stops in half (TP776).
        """
        last = np.flatnonzero(self._is_last())
        last = last[start[last] > 0]
        before, most = start[last] - 1, np.sqrt(ramp[last] * left[last])
        lower = most < out.joint[before]
        out.joint[before[lower]] = most[lower]
        out.joint_by[before[lower]] = self._moves.ramp_by[last[lower]] + self._count

    def _plane_of(self, rounds: Integers) -> Integers:
        """Return the plane of the program in which each corner lies; -1 where it leaves all three, or the
        moves are rapid ones.
        """
        u, v = self._moves.last[rounds], self._moves.first[rounds + 1]
        found = np.full(len(rounds), -1)
        # The first plane wins where a corner is in several.
        for n, (_, _, third) in reversed(self._planes.items()):
            found[(u[:, third] == 0.0) & (v[:, third] == 0.0)] = n
        # Rapid rows are straight: an arc would have a feedrate.
        found[self._moves.kind[rounds] == RAPID] = -1
        return found

    def _add_corners(
        self,
        out: _Rows,
        between: _Junctions,
        rounds: Integers,
        planes: Integers,
        parts: Integers,
        start: Integers,
    ) -> None:
        """Write the rows of the rounded corners."""
        moves, path = self._moves, self._path
        u, v = moves.last[rounds], moves.first[rounds + 1]
        angle, radius, cut = (each[rounds, None] for each in (between.angle, between.radius, between.cut))
        to_start = (u * np.cos(angle) - v) / np.sin(angle)
        center = moves.ends[rounds] - cut * u - radius * to_start
        end = moves.ends[rounds] + cut * v
        arc = np.zeros((len(rounds), 3))
        for n, (a, b, _) in self._planes.items():
            flat = np.flatnonzero(planes == n)
            turn = u[flat, a] * v[flat, b] - u[flat, b] * v[flat, a]
            sweep = np.copysign(between.angle[rounds[flat]] / parts[flat], turn)
            arc[flat] = np.column_stack([center[flat, a], center[flat, b], sweep])
        each = np.repeat(np.arange(len(rounds)), parts)
        part = np.arange(len(each)) - np.repeat(np.cumsum(parts) - parts, parts) + 1
        at, corner = start[each] + part - 1, rounds[each]
        turned = (between.angle[corner] * part / parts[each])[:, None]
        place = center[each] + radius[each] * (np.cos(turned) * to_start[each] + np.sin(turned) * u[each])
        out.ends[at] = np.where((part == parts[each])[:, None], end[each], place)
        is_rapid = moves.kind[corner] == RAPID
        out.kind[at] = np.where(is_rapid, RAPID, np.where(planes[each] >= 0, ARC, LINE))
        out.row[at], out.plane[at] = moves.row[corner], np.maximum(planes[each], 0)
        # Half of the corner is of the block before, half of the one after.
        out.line[at] = path.line[moves.row[np.where(part * 2 > parts[each], corner + 1, corner)]]
        out.feed[at] = np.where(is_rapid, 0.0, between.programmed[corner])
        out.arc[at] = arc[each]
        out.speed[at], out.speed_by[at] = between.top[corner], between.top_by[corner]
        out.ramp[at], out.ramp_by[at] = between.acceleration[corner], between.ramp_by[corner] + self._count


def _straight_rows(radius: PathRows, angle: PathRows) -> Integers:
    """Return how many straight rows a rounded corner becomes."""
    rows = np.ceil(angle / (2.0 * np.sqrt(2.0 * _WITHIN / np.maximum(radius, _WITHIN))))
    return np.maximum(2, rows).astype(np.int64)


class _Rows:
    """Rows with what bounds them; (rows,) or (rows, axes)."""

    def __init__(self, count: int, axes: int) -> None:
        self.ends, self.arc = np.zeros((count, axes)), np.zeros((count, 3))
        """``arc``: center and sweep."""
        self.kind, self.plane = np.zeros((2, count), np.uint8)
        self.row, self.line = np.zeros(count, np.int64), np.zeros(count, np.int32)
        """``row``: of the program's path."""
        self.feed = np.zeros(count)
        self.speed, self.ramp = np.zeros((2, count))
        self.joint = np.full(count, math.inf)
        self.speed_by, self.ramp_by, self.joint_by = np.zeros((3, count), np.int64)
        self.move = np.zeros(count, np.int64)

    def shaped(self, path: ToolPath, causes: list[PathLimit], begins: Integers) -> ShapedPath:
        """Return them as the path of a program, with the figures of its rows that stay."""
        dwells, zeros = self.kind == DWELL, np.zeros(len(self.kind), np.uint8)
        rows = replace(
            path,
            ends=self.ends,
            kind=self.kind,
            line=self.line,
            feed=np.where(dwells, 0.0, self.feed),
            center=self.arc[:, :2],
            sweep=self.arc[:, 2],
            plane=np.where(dwells, 0, self.plane).astype(np.uint8),
            seconds=np.where(dwells, path.seconds[self.row], 0.0),
            corner=np.where(dwells, EXACT, zeros).astype(np.uint8),
            free=np.where(dwells, 1, path.free[self.row]).astype(np.uint8),
            rounding=zeros,
            roundings=path.roundings[:1],
            zones=path.zones[self.row],
        )
        return ShapedPath(
            rows,
            causes,
            RowBounds(self.speed, self.speed_by),
            RowBounds(self.ramp, self.ramp_by),
            RowBounds(self.joint, self.joint_by),
            self.move,
            begins,
        )
