"""Where the moves of LinuxCNC meet: a small change of direction is passed, a corner is rounded by an arc,
or the path stops (tp.c, blendmath.c). A rounded corner in a plane of the program becomes an arc, another
one short straight rows.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from amp_studio.programs import ARC, EXACT, KEPT, LINE, MOST_ROWS, PLANES, RAPID, RowsWriter, ToolPath
from amp_studio.sim import Geometry, PathLimit, RowBounds, ShapedPath, SimulationError

from .law_segments import NORMAL, AxisLimits, PathPoint, PathSegment, segments

TANGENTIAL = 0.5
"""Share of the acceleration that is left along an arc (blendmath.h, line 19)."""
SHARP = math.radians(2.0)
"""Of the direction back from which a corner is a stop (TP1877)."""
OF_LENGTH = 0.25
"""Share of a move that a corner may be off where the program gives no distance (TS546)."""
OF_MOVE = 0.5
"""Share of a move that a corner may take."""
SMALLEST_ANGLE, SHORTEST = 1e-6, 1e-6
"""rad, u: of a rounded corner."""
LEAST_CYCLES = 1.02
"""Servo cycles of a move."""
GAP_CYCLES = 4.0
"""Servo cycles below which what is left before a corner goes at its speed."""
WITHIN = 1e-4
"""u between a rounded corner and the straight rows of it."""

STOP = PathLimit(0.0, None, "exact stop")
CHANGE = PathLimit(0.0, None, "change between rapid and feed")
BACK = PathLimit(0.0, None, "way back in the same line")
GIVEN = PathLimit(0.0, None, "distance of G64 from a corner")
NOT_ROUNDED = (
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


@dataclass(frozen=True)
class _Corner:
    """A rounded corner; u, u/s."""

    radius: float
    cut: float
    """Length that it takes of each of its moves, u."""
    angle: float
    speed: float
    by: int
    acceleration: float
    ramp_by: int
    programmed: float
    """Speed as programmed."""


@dataclass
class _Writer:
    """Rows with what bounds them."""

    rows: RowsWriter
    speed: list[float] = field(default_factory=list)
    speed_by: list[int] = field(default_factory=list)
    ramp: list[float] = field(default_factory=list)
    ramp_by: list[int] = field(default_factory=list)
    joint: list[float] = field(default_factory=list)
    joint_by: list[int] = field(default_factory=list)

    def bound(self, speed: tuple[float, int], ramp: tuple[float, int]) -> None:
        self.speed.append(speed[0])
        self.speed_by.append(speed[1])
        self.ramp.append(ramp[0])
        self.ramp_by.append(ramp[1])
        self.joint.append(math.inf)
        self.joint_by.append(0)


def shaped(figures: PathFigures, path: ToolPath, geometry: Geometry) -> ShapedPath:
    """Return what the control makes of a path; raises SimulationError for a corner that is not simulated."""
    return _Shaping(figures, path, geometry).shape()


class _Shaping:
    """One path."""

    def __init__(self, figures: PathFigures, path: ToolPath, geometry: Geometry) -> None:
        self._figures, self._path, self._geometry = figures, path, geometry
        self._limits = AxisLimits.of(path.axes, figures.speeds, figures.accelerations)
        count = len(path.axes)
        self._causes: list[PathLimit] = [
            *(figures.speeds[letter] for letter in path.axes),
            *(figures.accelerations[letter] for letter in path.axes),
            figures.kink,
            STOP,
            CHANGE,
            BACK,
            GIVEN,
        ]
        self._kink, self._stop, self._change, self._back, self._given = range(2 * count, 2 * count + 5)
        self._count = count
        self._straight = [n for n, letter in enumerate(path.axes) if letter in "XYZ"]
        columns = {letter: n for n, letter in enumerate(path.axes)}
        self._planes = {
            n: tuple(columns["XYZ"[each]] for each in plane)
            for n, plane in enumerate(PLANES)
            if columns.keys() >= {*"XYZ"}
        }
        self._out = _Writer(RowsWriter(path.axes))

    def shape(self) -> ShapedPath:
        """Work it out."""
        previous: PathSegment | None = None
        begun = tuple(self._path.start.tolist())
        for move in segments(self._path, self._geometry, self._limits):
            if isinstance(move, int):
                if previous is not None:
                    self._end(previous, begun)
                previous = None
                self._dwell(move)
                begun = tuple(self._path.ends[move].tolist())
                continue
            move.top = min(move.top, move.length / self._figures.period)
            if previous is not None:
                begun = self._join(previous, move, begun)
            previous = move
        if previous is not None:
            self._end(previous, begun)
        out, path = self._out, self._path
        rows = out.rows.path(
            path.start.tolist(), path.blocks, path.fault, path.assumptions, zero_known=path.zero_known
        )
        return ShapedPath(
            rows,
            self._causes,
            RowBounds(np.array(out.speed), np.array(out.speed_by, np.int64)),
            RowBounds(np.array(out.ramp), np.array(out.ramp_by, np.int64)),
            RowBounds(np.array(out.joint), np.array(out.joint_by, np.int64)),
        )

    # -- rows ----------------------------------------------------------------------

    def _end(self, move: PathSegment, begun: PathPoint) -> None:
        """Write a move with nothing after it: with G64 it has half of its acceleration."""
        move.half = move.corner not in (EXACT, KEPT)
        before = len(self._out.ramp) - 1
        self._write(move, move.end, begun, is_last=True)
        if before >= 0 and len(self._out.ramp) > before + 1:
            # A next move could take half of it: it begins only as fast as it stops in half (TP776).
            most = math.sqrt(self._out.ramp[-1] * move.length)
            if most < self._out.joint[before]:
                self._out.joint[before], self._out.joint_by[before] = most, move.ramp_by + self._count

    def _write(self, move: PathSegment, end: PathPoint, begun: PathPoint, *, is_last: bool = False) -> None:
        path, row = self._path, move.row
        if end == begun and not move.is_arc:
            return
        kind = ARC if move.is_arc else RAPID if move.is_rapid else LINE
        arc = (
            (float(path.center[row, 0]), float(path.center[row, 1]), float(path.sweep[row]))
            if move.is_arc
            else (0.0,) * 3
        )
        self._out.rows.add(
            end,
            kind,
            int(path.line[row]),
            float(path.feed[row]),
            0,
            int(path.free[row]),
            arc,
            int(path.plane[row]),
        )
        top, ramp = self._arc_limits(move, is_last=is_last) if move.is_arc else (move.top, move.ramp)
        cause = move.ramp_by + self._count
        self._out.bound((top, move.top_by), (0.5 * ramp if move.half else ramp, cause))

    def _arc_limits(self, move: PathSegment, *, is_last: bool) -> tuple[float, float]:
        """Return speed and acceleration along an arc; the last one of all gets no others (TS745)."""
        radius = float(self._geometry.radius[move.row])
        along = move.end[third := self._third(move)] - move.begin[third]
        radius += along * along / radius  # as pmCircleEffectiveMinRadius has it
        whole = move.ramp * (0.5 if move.half else 1.0)
        if is_last:
            return move.top, move.ramp * TANGENTIAL
        across = move.top * move.top / radius
        if across > NORMAL * whole:
            return math.sqrt(NORMAL * whole * radius), move.ramp * TANGENTIAL
        return move.top, move.ramp * math.sqrt(1.0 - (across / whole) ** 2)

    def _third(self, move: PathSegment) -> int:
        """Return the axis across the plane of an arc."""
        return self._path.axes.index("XYZ"[PLANES[int(self._path.plane[move.row])][2]])

    def _dwell(self, row: int) -> None:
        path = self._path
        self._out.rows.add(
            path.ends[row].tolist(),
            int(path.kind[row]),
            int(path.line[row]),
            0.0,
            EXACT,
            1,
            seconds=float(path.seconds[row]),
        )
        self._out.bound((math.inf, 0), (math.inf, 0))

    # -- where two moves meet --------------------------------------------------------

    def _join(self, one: PathSegment, two: PathSegment, begun: PathPoint) -> PathPoint:
        """Write the first of two moves and what is between them; return where the second begins."""
        if one.is_rapid != two.is_rapid:
            return self._stop_between(one, begun, self._change)
        if one.corner == EXACT or self._turns(one) or self._turns(two):
            if one.corner not in (EXACT, KEPT):
                raise SimulationError(
                    f"Line {int(self._path.line[two.row])}: corners of rotary axes with G64 are not simulated"
                )
            return self._stop_between(one, begun, self._stop)
        u, v = one.last, two.first
        if math.dist(u, [-each for each in v]) < SHARP:
            return self._stop_between(one, begun, self._back)
        speed = min(self._most(one), self._most(two))
        share = self._kinked(one, two, speed)
        if share < self._figures.kink.value:
            one.kink_after, two.kink_before = max(one.kink_after, share), share
            return self._pass(one, begun, speed)
        kink = self._figures.kink.value
        if one.corner == KEPT:
            # The planner takes the acceleration of a change of direction away though it stops there (TP1929).
            one.kink_after, two.kink_before = max(one.kink_after, kink), kink
            return self._stop_between(one, begun, self._stop)
        if one.is_arc or two.is_arc:
            raise SimulationError(NOT_ROUNDED.format(line=int(self._path.line[two.row])))
        corner = self._corner(one, two) if self._figures.with_arcs else None
        slow = speed * kink / share
        if corner is None or corner.speed <= slow:
            one.kink_after, two.kink_before = max(one.kink_after, kink), kink
            return self._pass(one, begun, slow)
        return self._round(one, two, corner, begun)

    def _turns(self, move: PathSegment) -> bool:
        return any(move.first[n] for n in range(self._count) if n not in self._straight)

    def _most(self, move: PathSegment) -> float:
        return min(move.programmed * self._figures.greatest_override, move.top)

    def _kinked(self, one: PathSegment, two: PathSegment, speed: float) -> float:
        """Return the share of an acceleration that a change of direction takes in a cycle (TP1894)."""
        at_once = speed / self._figures.period + two.acceleration
        share = max(
            abs(two.first[n] - one.last[n]) * at_once / self._limits.accelerations[n] for n in self._straight
        )
        return share / TANGENTIAL if one.is_arc or two.is_arc else share

    def _stop_between(self, one: PathSegment, begun: PathPoint, cause: int) -> PathPoint:
        return self._pass(one, begun, 0.0, cause)

    def _pass(self, one: PathSegment, begun: PathPoint, speed: float, cause: int | None = None) -> PathPoint:
        self._write(one, one.end, begun)
        if self._out.joint:
            self._out.joint[-1] = speed
            self._out.joint_by[-1] = self._kink if cause is None else cause
        return one.end

    # -- a rounded corner --------------------------------------------------------------

    def _corner(self, one: PathSegment, two: PathSegment) -> _Corner | None:
        """Return the arc between two straight moves; None where there is none (blendComputeParameters)."""
        cosine = sum(a * b for a, b in zip(one.last, two.first, strict=True))
        theta = 0.5 * math.acos(min(max(-cosine, -1.0), 1.0))
        if not SMALLEST_ANGLE < theta < 0.5 * math.pi - SMALLEST_ANGLE:
            return None
        phi = math.pi - 2.0 * theta
        nominal = min(each.tolerance or each.nominal * OF_LENGTH for each in (one, two))
        tolerance = min(nominal, one.nominal * OF_LENGTH, two.nominal * OF_LENGTH)
        acceleration, ramp_by = self._inscribed(one, two, self._limits.accelerations)
        by_tolerance = math.cos(theta) * tolerance / (1.0 - math.sin(theta))
        room = min(one.length, one.nominal * OF_MOVE, two.length * OF_MOVE, by_tolerance)
        largest = math.tan(theta) * room
        goal = self._goal(one, two, phi, max(self._most(one), self._most(two)))
        speed = math.sqrt(NORMAL * acceleration * largest)
        by = ramp_by + self._count
        if speed > goal:
            speed, by = goal, two.top_by
        elif room == by_tolerance and one.tolerance:
            by = self._given
        half = 0.5 * acceleration
        time = min(math.sqrt(2.0 * half * room), speed) / half
        radius = max(speed * speed / (NORMAL * acceleration), min(time * speed / phi, largest))
        if radius * phi < SHORTEST:
            return None
        speed = min(speed, radius * phi / self._figures.period)
        wanted = max(min(each.programmed, each.top) for each in (one, two))
        return _Corner(
            radius, radius / math.tan(theta), phi, speed, by, acceleration * TANGENTIAL, ramp_by, wanted
        )

    def _goal(self, one: PathSegment, two: PathSegment, phi: float, wanted: float) -> float:
        """Return the wanted speed, or what the axes have in every direction of a corner if that is less
        (blendParamKinematics).
        """
        flat = math.cos(min(phi, math.pi * 0.49))
        a, b = min(one.top, two.top / flat), min(two.top, one.top / flat)
        base = math.dist([a * each for each in one.last], [b * each for each in two.first])
        between = a * b * math.sin(phi) / base
        if between >= wanted:
            return wanted
        return min(wanted, max(between, self._inscribed(one, two, self._limits.speeds)[0]))

    def _inscribed(self, one: PathSegment, two: PathSegment, bounds: tuple[float, ...]) -> tuple[float, int]:
        """Return what all directions in the plane of two moves can have, and the axis that bounds it."""
        moving = [n for n in self._straight if one.last[n] or two.first[n]]
        if len(moving) == 2:
            return min((bounds[n], n) for n in moving)
        u = [one.last[n] for n in self._straight]
        v = [two.first[n] for n in self._straight]
        inside = sum(a * b for a, b in zip(u, v, strict=True))
        across = [b - inside * a for a, b in zip(u, v, strict=True)]
        size = math.sqrt(sum(each * each for each in across)) or 1.0
        # How far an axis lies in the plane is the length of its projection on the two directions of it.
        lies = [math.hypot(a, b / size) for a, b in zip(u, across, strict=True)]
        found = [(bounds[n] / max(lies[k], 1e-12), n) for k, n in enumerate(self._straight)]
        return min(found)

    def _round(self, one: PathSegment, two: PathSegment, corner: _Corner, begun: PathPoint) -> PathPoint:
        """Write the first move as far as the corner, and the corner; return where it ends."""
        d = corner.cut
        start = tuple(e - d * u for e, u in zip(one.end, one.last, strict=True))
        end = tuple(e + d * u for e, u in zip(one.end, two.first, strict=True))
        left = one.length - d
        one.length, two.length = left, two.length - d
        if left / corner.speed < GAP_CYCLES * self._figures.period:
            one.top, one.top_by = min(one.top, corner.speed), corner.by
            one.acceleration = min(one.acceleration, corner.acceleration)
        elif left > 0.0:
            one.top = min(one.top, left / (self._figures.period * LEAST_CYCLES))
        if left > SHORTEST:
            self._write(one, start, begun)
        middle_to_start = [
            (u * math.cos(corner.angle) - v) / math.sin(corner.angle)
            for u, v in zip(one.last, two.first, strict=True)
        ]
        center = [s - corner.radius * n for s, n in zip(start, middle_to_start, strict=True)]
        plane = None if one.is_rapid else self._plane_of(one, two)
        # A row can be an arc in a plane of the program only; half of it belongs to each of the two blocks.
        parts = 2 if plane is not None else self._straight_rows(corner)
        if len(self._out.rows.kind) + parts > MOST_ROWS:
            raise SimulationError(f"The rounded corners of the program become more than {MOST_ROWS} moves")
        row, path = one.row, self._path
        kind = RAPID if one.is_rapid else LINE if plane is None else ARC
        feed = 0.0 if one.is_rapid else corner.programmed
        arc = (0.0,) * 3 if plane is None else self._flat_arc(one, two, center, plane, corner.angle / parts)
        for n in range(1, parts + 1):
            angle = corner.angle * n / parts
            place = tuple(
                c + corner.radius * (math.cos(angle) * r + math.sin(angle) * u)
                for c, r, u in zip(center, middle_to_start, one.last, strict=True)
            )
            self._out.rows.add(
                end if n == parts else place,
                kind,
                int(path.line[two.row if n * 2 > parts else row]),
                feed,
                0,
                int(path.free[row]),
                arc,
                plane or 0,
            )
            self._out.bound((corner.speed, corner.by), (corner.acceleration, corner.ramp_by + self._count))
        return end

    def _plane_of(self, one: PathSegment, two: PathSegment) -> int | None:
        """Return the plane of the program in which two moves lie; None where they leave all three."""
        u, v = one.last, two.first
        return next((n for n, (_, _, third) in self._planes.items() if not (u[third] or v[third])), None)

    def _flat_arc(
        self, one: PathSegment, two: PathSegment, center: Sequence[float], plane: int, angle: float
    ) -> tuple[float, float, float]:
        """Return the center of a rounded corner in its plane, and its sweep."""
        a, b, _ = self._planes[plane]
        turn = one.last[a] * two.first[b] - one.last[b] * two.first[a]
        return center[a], center[b], math.copysign(angle, turn)

    @staticmethod
    def _straight_rows(corner: _Corner) -> int:
        return max(2, math.ceil(corner.angle / (2.0 * math.sqrt(2.0 * WITHIN / max(corner.radius, WITHIN)))))
