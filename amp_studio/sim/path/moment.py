"""Where the axes are commanded to be at one moment of a planned program."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from amp_studio.sim.path_rules import PathRows

from .geometry import places_of
from .planned import PlannedProgram
from .planner import ProgramPlan


@dataclass(frozen=True)
class PathMoment:
    """One moment; u and s."""

    line: int
    """Of the program, from 1."""
    place: PathRows
    """(axes,)"""
    speed: float
    """Along the path."""
    feed: float
    """As programmed; infinite in rapid, 0 in a dwell."""


def moment_at(program: PlannedProgram, time: float) -> PathMoment | None:
    """Return the moment after so many seconds; None for a program that moves nothing."""
    return moment_in(program.stretch_at(time), time)


def moment_in(plan: ProgramPlan, time: float) -> PathMoment | None:
    """Return the moment of a stretch after so many seconds of the program.

    Within a ramp the speed is taken to change evenly, which a sin² ramp does but at its ends and middle.
    """
    if not len(plan.start):
        return None
    row = int(np.clip(np.searchsorted(plan.start, time, side="right") - 1, 0, len(plan.start) - 1))
    left = time - float(plan.start[row])
    gone, speed = 0.0, float(plan.entry[row])
    peak, leave = float(plan.peak[row]), float(plan.leave[row])
    for duration, after in zip(plan.times[row].tolist(), (peak, peak, leave), strict=True):
        part = min(max(left, 0.0), duration)
        if duration > 0.0:
            now = speed + (after - speed) * part / duration
            gone += 0.5 * (speed + now) * part
            speed = now
        left -= duration
    length = float(plan.geometry.length[row])
    share = min(gone / length, 1.0) if length > 0.0 else 1.0
    line = int(plan.path.line[plan.geometry.row[row]])
    # Time that is left after the three parts of a row is its rest (dwell, in position).
    feed = math.inf if plan.is_rapid[row] else float(plan.programmed[row])
    return PathMoment(line, _place(plan, row, share), 0.0 if left > 0.0 else speed, feed)


def _place(plan: ProgramPlan, row: int, share: float) -> PathRows:
    """Return the place on a piece, (axes,): on a straight line, or turned about the center of its arc."""
    geometry, path = plan.geometry, plan.path
    place: PathRows = geometry.begins[row] + share * (geometry.ends[row] - geometry.begins[row])
    if geometry.is_arc[row]:
        of_path = int(geometry.row[row])
        a, b = places_of(path, of_path)
        center, turned = path.center[of_path], share * float(path.sweep[of_path])
        x, y = geometry.begins[row, a] - center[0], geometry.begins[row, b] - center[1]
        place[a] = center[0] + x * math.cos(turned) - y * math.sin(turned)
        place[b] = center[1] + x * math.sin(turned) + y * math.cos(turned)
    return place
