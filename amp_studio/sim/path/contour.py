"""The axes of a machine on a planned path: how far from it they are (the whole servo simulation)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from amp_studio.sim.axis.motion import Motion, RunEnd, run_axis
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import AxisLaw
from amp_studio.sim.path_rules import Indices, PathRows
from amp_studio.sim.scenarios.columns import alarms_of
from amp_studio.sim.trace import Alarm

from .geometry import places_of
from .planner import ProgramPlan
from .profiles import axis_profiles, path_points

_LONGEST = 120.0
"""s of a program that the servo loops are run on."""
_ON_ARC = 1e-5
"""u between an arc and the straight pieces that the distance is measured to."""
_MAX_NEAR_PIECES = 2000
"""Pieces of the path that are compared with a place."""
_NEAR = 1e-3
"""u along the path by which arcs and the straight pieces of them may differ."""
_SETTLES = 6.0
"""Time constants of the position loops after the end."""


@dataclass(frozen=True)
class ContourError:
    """How far the axes are from the programmed path; u and s."""

    time: PathRows
    """(samples,)"""
    error: PathRows
    """(samples,): distance from the path."""
    following: PathRows
    """(samples, axes): following error."""
    row: Indices
    """(samples,): row of the plan."""
    alarms: tuple[Alarm, ...]

    @property
    def largest(self) -> float:
        """The greatest distance."""
        return float(self.error.max(initial=0.0))

    @property
    def p95(self) -> float:
        """What 95 % of the samples do not exceed."""
        return float(np.percentile(self.error, 95.0)) if len(self.error) else 0.0

    @property
    def worst(self) -> int:
        """The sample of the greatest distance."""
        return int(np.argmax(self.error)) if len(self.error) else 0


def contour_error(plan: ProgramPlan, axes: Sequence[AxisLaw | None]) -> ContourError:
    """Run the axes over a plan, None for one that rests.
    Raises SimulationError where it is too long or an axis cannot be run.
    """
    if plan.time > _LONGEST:
        raise SimulationError(f"The program takes {plan.time:.4g} s, more than {_LONGEST:g} s")
    profiles = axis_profiles(plan)
    moving = [(n, axis) for n, axis in enumerate(axes) if axis is not None]
    # Following errors decay with the gain of the position loop: after six time constants 0.25 % is left.
    after = max(_SETTLES / axis.position_rate for _, axis in moving)
    motions = {n: run_axis(axis, profiles[n], RunEnd(plan.time + after), thin=True) for n, axis in moving}
    alarms = [alarm for n, axis in moving for alarm in alarms_of(axis, motions[n])]
    # After the alarm of one axis the others have no common path any more.
    samples = min(len(motion.columns["time_s"][motion.driven]) for motion in motions.values())
    time = next(iter(motions.values())).columns["time_s"][:samples]

    def column(name: str, start: PathRows) -> PathRows:
        resting = np.zeros(len(time))
        return np.column_stack(
            # Profiles begin at 0 (`profiles.axis_profiles`): the start of the path is added.
            [start[n] + (_on(motions[n], name, time) if n in motions else resting) for n in range(len(axes))]
        )

    place, commanded = column("position", plan.path.start), column("command_position", plan.path.start)
    following = column("following_error", np.zeros(len(axes)))
    found = np.searchsorted(plan.start, time, side="right") - 1
    # After the last row, while the axes settle, that row counts on.
    rows = np.clip(found, 0, max(len(plan.start) - 1, 0)).astype(np.int64)
    error = distances(place, commanded, _along_path(plan, commanded, rows), path_points(plan, _ON_ARC)[0])
    alarms.sort(key=lambda alarm: alarm.time_s)
    return ContourError(time, error, following, rows, tuple(alarms))


def _on(motion: Motion, column: str, time: PathRows) -> PathRows:
    """Return a column at the times of the first axis: axes may have other periods."""
    own = motion.columns["time_s"]
    if len(own) >= len(time) and np.array_equal(own[: len(time)], time):
        return motion.columns[column][: len(time)]
    return np.interp(time, own, motion.columns[column])


def _along_path(plan: ProgramPlan, commanded: PathRows, rows: Indices) -> PathRows:
    """Return how far along the path each commanded place is, u; ``rows`` are its rows of the plan."""
    geometry = plan.geometry
    before = np.concatenate([[0.0], np.cumsum(geometry.length)])[rows]
    begins, ends = geometry.begins[rows], geometry.ends[rows]
    share = _share(commanded, begins, ends, _apart(begins, ends))
    on_arc = np.flatnonzero(geometry.is_arc[rows])
    for row in np.unique(rows[on_arc]).tolist():
        here = on_arc[rows[on_arc] == row]
        of_path = int(geometry.row[row])
        a, b = places_of(plan.path, of_path)
        center, sweep = plan.path.center[of_path], float(plan.path.sweep[of_path])
        begun = math.atan2(geometry.begins[row, b] - center[1], geometry.begins[row, a] - center[0])
        angle = np.arctan2(commanded[here, b] - center[1], commanded[here, a] - center[0]) - begun
        turned = np.mod(angle * math.copysign(1.0, sweep), 2.0 * math.pi)
        # Rounding puts the first places a hair before the arc, which is almost a whole turn after it.
        turned = np.where(turned > 0.5 * (abs(sweep) + 2.0 * math.pi) + 1e-9, 0.0, turned)
        share[here] = np.minimum(turned / abs(sweep), 1.0)
    gone: PathRows = before + share * geometry.length[rows]
    return gone


def distances(place: PathRows, commanded: PathRows, gone: PathRows, points: PathRows) -> PathRows:
    """Return how far each place is from the path near what is commanded.

    ``gone`` is how far along the path that is; the path is the straight pieces between ``points``. Only
    pieces nearer along the path than twice the following error are compared: another part of the path that
    comes close by is not the one that was meant.
    """
    apart = _apart(place, commanded)
    if len(points) < 2:
        return apart
    begins, ends = points[:-1], points[1:]
    way = _apart(begins, ends)
    along = np.concatenate([[0.0], np.cumsum(way)])
    low = np.searchsorted(along, gone - 2.0 * apart - _NEAR, side="right") - 1
    high = np.searchsorted(along, gone + 2.0 * apart + _NEAR, side="right") - 1
    low, high = np.clip(low, 0, len(way) - 1), np.clip(high, 0, len(way) - 1)
    least = np.full(len(place), math.inf)
    # All samples at once, one piece of each window a turn: windows are short, and samples are many.
    for step in range(min(int((high - low).max(initial=0)) + 1, _MAX_NEAR_PIECES)):
        at = low + step
        active = np.flatnonzero(at <= high)
        chosen = at[active]
        share = _share(place[active], begins[chosen], ends[chosen], way[chosen])
        near = begins[chosen] + share[:, None] * (ends[chosen] - begins[chosen])
        least[active] = np.minimum(least[active], _apart(place[active], near))
    return least


def _share(place: PathRows, begins: PathRows, ends: PathRows, way: PathRows) -> PathRows:
    """Return where on each piece the nearest point is, 0 to 1."""
    # A piece without length is its first point.
    size = np.where(way > 0.0, way * way, 1.0)
    share: PathRows = np.clip(((place - begins) * (ends - begins)).sum(axis=1) / size, 0.0, 1.0)
    return share


def _apart(one: PathRows, other: PathRows) -> PathRows:
    """Return the distances of points, (n,)."""
    rows: PathRows = np.sqrt(((one - other) ** 2).sum(axis=1))
    return rows
