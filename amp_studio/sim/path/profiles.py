"""The command of every axis along a planned path, as pieces of `engine/profiles.py`."""

from __future__ import annotations

import math

import numpy as np

from amp_studio.sim.command.events import Ramp
from amp_studio.sim.command.pieces import Piece, change
from amp_studio.sim.engine.profiles import POLYNOMIAL, SINE
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.path_rules import Indices, PathRows

from .geometry import places_of, plane_columns
from .planner import ProgramPlan


def axis_profiles(plan: ProgramPlan) -> list[list[float]]:
    """Return the flat profile of each axis; positions from 0 on.

    Raises SimulationError for a path whose arcs have curved ramps.
    """
    count = len(plan.path.axes)
    profiles: list[list[float]] = [[] for _ in range(count)]
    geometry, now = plan.geometry, 0.0
    origin = plan.path.start
    for n in range(len(plan.entry)):
        gone = 0.0
        if geometry.length[n] > 0.0:
            ramp = plan.ramps[int(plan.is_rapid[n])]
            for piece in _pieces(plan, n, ramp):
                for axis, rows in enumerate(profiles):
                    rows.extend(_row(plan, n, axis, now, gone, piece, float(origin[axis])))
                gone += piece.length()
                now += piece.duration
        if plan.rest[n] > 0.0:
            _add_rest(profiles, now, float(plan.rest[n]), geometry.ends[n] - origin)
            now += float(plan.rest[n])
    last = geometry.ends[-1] if len(geometry.ends) else origin
    _add_rest(profiles, now, math.inf, last - origin)
    return profiles


def _add_rest(profiles: list[list[float]], now: float, duration: float, at: PathRows) -> None:
    """Have each axis stay where it is, ``at`` from its start, for a time in s."""
    for place, rows in zip(at.tolist(), profiles, strict=True):
        rows.extend([now, duration, place, 0.0, 0.0, 0.0, POLYNOMIAL, 0.0])


def _pieces(plan: ProgramPlan, n: int, ramp: Ramp) -> list[Piece]:
    """Return the pieces of a row along the path."""
    entry, peak, leave = float(plan.entry[n]), float(plan.peak[n]), float(plan.leave[n])
    slopes = float(plan.acceleration[n]), float(plan.deceleration[n])
    # In a `Ramp`, 0 is a change of speed at once.
    up, down = (each if math.isfinite(each) else 0.0 for each in slopes)
    own = Ramp(ramp.kind, up, down, ramp.jerk, ramp.time)
    even = [Piece(float(plan.times[n, 1]), peak)] if plan.times[n, 1] > 0.0 else []
    every = [*change(own, entry, peak), *even, *change(own, peak, leave)]
    return [piece for piece in every if piece.duration > 0.0]


def _row(
    plan: ProgramPlan, n: int, axis: int, now: float, gone: float, piece: Piece, origin: float
) -> list[float]:
    """Return one piece of one axis."""
    geometry = plan.geometry
    if geometry.is_arc[n] and axis in (places := places_of(plan.path, int(geometry.row[n]))):
        if piece.kind != POLYNOMIAL or piece.jerk != 0.0:
            # The angle of a sine piece is of second degree in time. A ramp whose acceleration changes would
            # need the third.
            raise SimulationError("Arcs with curved ramps are not run on the servo loops")
        row = int(geometry.row[n])
        first, second = places
        center, sweep = plan.path.center[row], float(plan.path.sweep[row])
        begun = math.atan2(geometry.begins[n, second] - center[1], geometry.begins[n, first] - center[0])
        rate = sweep / float(geometry.length[n])
        is_second = axis == second
        # x = R cos(angle) = R sin(angle + 90°), y = R sin(angle); the angle goes with the way.
        phase = begun + rate * gone + (0.0 if is_second else 0.5 * math.pi)
        middle = float(center[1 if is_second else 0]) - origin
        radius = float(geometry.radius[n])
        return [
            now,
            piece.duration,
            middle,
            radius,
            rate * piece.velocity,
            rate * piece.acceleration,
            SINE,
            phase,
        ]
    # With its sign, which `geometry.share` has not.
    share = float(geometry.ends[n, axis] - geometry.begins[n, axis]) / float(geometry.length[n])
    position = float(geometry.begins[n, axis]) - origin + share * gone
    return [
        now,
        piece.duration,
        position,
        share * piece.velocity,
        share * piece.acceleration,
        share * piece.jerk,
        piece.kind,
        piece.figure,
    ]


def path_points(plan: ProgramPlan, within: float, chosen: Indices | None = None) -> tuple[PathRows, Indices]:
    """Return points on the programmed path (n, axes), arcs at most ``within`` u off, and their rows (n,):
    all that move, or those that are ``chosen``.
    """
    geometry, path = plan.geometry, plan.path
    moving = np.flatnonzero(geometry.length > 0.0) if chosen is None else chosen
    of_path, is_arc = geometry.row[moving], geometry.is_arc[moving]
    sweep, radius = path.sweep[of_path], geometry.radius[moving]
    # A chord over the angle a is r (1 - cos(a/2)) off, about r a²/8: solved for a, that is how often
    # it goes into the sweep.
    parts = np.ones(len(moving), np.int64)
    turns = np.abs(sweep[is_arc]) * np.sqrt(radius[is_arc] / (8.0 * within))
    parts[is_arc] = np.maximum(2, np.ceil(turns))
    each = np.repeat(np.arange(len(moving)), parts)
    begins, points = geometry.begins[moving[each]], geometry.ends[moving[each]]
    on_arc = np.flatnonzero(is_arc[each])
    share = (np.arange(len(each)) - np.repeat(np.cumsum(parts) - parts, parts) + 1.0)[on_arc] / parts[
        each[on_arc]
    ]
    begun = begins[on_arc]
    points[on_arc] = begun + share[:, None] * (points[on_arc] - begun)
    rows = of_path[each[on_arc]]
    columns, center = plane_columns(path)[path.plane[rows]], path.center[rows]
    x, y = (np.take_along_axis(begun, columns, axis=1) - center).T
    cosine, sine = np.cos(share * path.sweep[rows]), np.sin(share * path.sweep[rows])
    points[on_arc, columns[:, 0]] = center[:, 0] + x * cosine - y * sine
    points[on_arc, columns[:, 1]] = center[:, 1] + x * sine + y * cosine
    return np.vstack([path.start[None, :], points]), np.concatenate([[0], moving[each]])
