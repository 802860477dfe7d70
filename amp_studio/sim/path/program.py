"""A part program under a file: its plan, where it meets limits, and the axes on it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from amp_studio.files import ParameterFile
from amp_studio.programs import ToolPath
from amp_studio.schema import Address
from amp_studio.sim.axis.motion import Until, run_axis
from amp_studio.sim.axis_parameters import ParameterValue
from amp_studio.sim.command.events import Ramp
from amp_studio.sim.command.ramps import end_of, move
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import AxisLaw, BoundMachine, law_of
from amp_studio.sim.model import assumptions
from amp_studio.sim.path_rules import PathRows
from amp_studio.sim.run import bound_machine

from .contour import ContourError, contour_error
from .geometry import places_of
from .planner import ProgramPlan, plan_program

LONGEST_WAIT = 5.0
"""s that an exact stop is waited for in position."""
NO_ZERO = (
    "Limits of travel are not checked: where the zero of the program is, the file does not have. Give --zero."
)
BEYOND = 1e-6
"""u: an axis on its limit is not beyond it."""


@dataclass(frozen=True)
class PathAlarm:
    """Where a program meets a limit, or the control stops it."""

    line: int
    time_s: float
    code: str
    message: str


@dataclass(frozen=True)
class ProgramRun:
    """A program under one file."""

    plan: ProgramPlan
    alarms: tuple[PathAlarm, ...]
    contour: ContourError | None
    why_no_contour: str
    read: tuple[Address, ...]
    """Values that were read."""
    assumptions: tuple[str, ...]


def run_program(
    file: ParameterFile,
    path: ToolPath,
    *,
    override: float = 1.0,
    rapid_override: float = 1.0,
    model: Mapping[str, ParameterValue] | None = None,
    with_contour: bool = True,
    progress: Callable[[float], None] = lambda _share: None,
) -> ProgramRun:
    """Return a program in motion; ``override`` and ``rapid_override`` are shares of feed and rapid.

    Raises SimulationError where a value is missing or no page prints how the family goes along a path.
    """
    law = law_of(file.schema.family.family)
    if law.path is None:
        raise SimulationError(
            f"{file.schema.family.name}: no page here prints how it goes along the path of a program"
        )
    read: list[Address] = []
    machine = bound_machine(file, law, (), model or {}, read.append)
    rules = replace(law.path(machine), override=override, rapid_override=rapid_override)
    axes = _axes(machine, path)
    waits = _Waits(axes, rules.feed_ramp if rules.waits else Ramp())
    plan = plan_program(path, rules, progress=lambda share: progress(0.5 * share))
    path = plan.path
    notes = [*path.assumptions, *rules.assumptions]
    if rules.waits:
        waits.look(plan)
        if waits.wait:
            plan = plan_program(path, rules, waits=lambda _row: waits.wait, progress=progress)
            notes.append(
                f"An exact stop waits {waits.wait:.3g} s until the axes are in position: that of the largest"
                " of them, moved by itself."
            )
    alarms = [*_limits_met(plan, axes, path)]
    if not path.zero_known:
        notes.append(NO_ZERO)
    contour, why = None, "not asked for"
    if with_contour:
        contour, why = _contour(plan, axes)
        if contour is not None:
            alarms += [
                PathAlarm(_line_at(plan, alarm.time_s), alarm.time_s, alarm.code, alarm.message)
                for alarm in contour.alarms
            ]
            notes += [note for axis in axes for note in assumptions(axis)]
    if path.fault is not None:
        fault = path.fault
        alarms.append(PathAlarm(fault.line, plan.time, fault.code, fault.message))
    return ProgramRun(plan, tuple(alarms), contour, why, tuple(read), tuple(dict.fromkeys(notes)))


def home_positions(file: ParameterFile, letters: Sequence[str]) -> list[float]:
    """Return where the axes are when they are home, in mm or deg; 0 where the file does not have it."""
    law, found = law_of(file.schema.family.family), []
    machine = bound_machine(file, law, (), {}, lambda _address: None)
    for letter in letters:
        try:
            axis = machine.axis(letter)
            found.append(axis.homing().coordinate if axis.homing else 0.0)
        except SimulationError:
            found.append(0.0)
    return found


def _axes(machine: BoundMachine, path: ToolPath) -> list[AxisLaw]:
    """Return the axes in the order of the path."""
    return [machine.axis(letter) for letter in path.axes]


def _line_at(plan: ProgramPlan, time: float) -> int:
    row = int(np.searchsorted(plan.start, time, side="right")) - 1
    return int(plan.path.line[plan.geometry.row[max(row, 0)]]) if len(plan.start) else 0


class _Waits:
    """How long an axis needs to be in position after an exact stop, from a move of each axis by itself."""

    def __init__(self, axes: list[AxisLaw], ramp: Ramp) -> None:
        self._axes, self._ramp = axes, ramp
        self.wait = 0.0

    def look(self, plan: ProgramPlan) -> None:
        """Take the largest exact stop of the plan as the example."""
        exact = np.flatnonzero((plan.rest_by != 1) & (plan.times.sum(axis=1) > 0.0))
        if not len(exact):
            return
        row = int(exact[np.argmax(plan.peak[exact])])
        for n, axis in enumerate(self._axes):
            share = float(plan.geometry.share[row, n])
            speed = share * float(plan.peak[row])
            if speed > 0.0 and axis.inposition_band > 0.0:
                ramp = replace(self._ramp, acceleration=share * float(plan.acceleration[row]))
                self.wait = max(self.wait, _wait(axis, share * float(plan.geometry.length[row]), speed, ramp))


def _wait(axis: AxisLaw, way: float, speed: float, ramp: Ramp) -> float:
    profile = move(way, speed, ramp, axis.machine.position_count)
    end = end_of(profile)
    motion = run_axis(
        axis, profile, Until(end + LONGEST_WAIT, axis.inposition_band, 0.2, LONGEST_WAIT), thin=True
    )
    time, error = motion.columns["time_s"], np.abs(motion.columns["following_error"])
    after = (time >= end) & (error > axis.inposition_band)
    return float(time[after][-1] - end) if after.any() else 0.0


def _contour(plan: ProgramPlan, axes: list[AxisLaw]) -> tuple[ContourError | None, str]:
    """Return the contour error, or why there is none."""
    if not len(plan.entry):
        return None, "the program moves nothing"
    # The end of a whole circle is its start: an axis moves where it has a share in a row.
    ways = plan.geometry.share * plan.geometry.length[:, None]
    chosen = [axis if (ways[:, n] > 1e-9).any() else None for n, axis in enumerate(axes)]
    moving = [axis for axis in chosen if axis is not None]
    if not moving:
        return None, "the program moves nothing"
    if not all(any(gain in axis.sources for gain in axis.gains) for axis in moving):
        return None, "this control has no servo loop whose gains are in the file"
    if len({axis.unit for axis in moving}) > 1:
        return None, "the axes do not move in one unit"
    try:
        return contour_error(plan, chosen), ""
    except SimulationError as error:
        return None, f"{error}"


def _limits_met(plan: ProgramPlan, axes: list[AxisLaw], path: ToolPath) -> Iterator[PathAlarm]:
    """Yield the first row that leaves each limit of travel."""
    least, most = _extent(plan, path)
    for n, axis in enumerate(axes):
        if axis.travel is None or not len(least) or not path.zero_known:
            continue
        try:
            travel = axis.travel()
        except SimulationError:
            continue
        for title, (low, high) in travel.limits.items():
            beyond = (least[:, n] < low - BEYOND) | (most[:, n] > high + BEYOND)
            if not beyond.any():
                continue
            row = int(np.argmax(beyond))
            is_low = bool(least[row, n] < low - BEYOND)
            edge, place = (low, least[row, n]) if is_low else (high, most[row, n])
            begun = (
                "the block is not begun" if travel.refuses or travel.reads_ahead else "the axis stops there"
            )
            code = travel.reads_ahead or (travel.alarm_negative if is_low else "") or travel.alarm
            yield PathAlarm(
                int(path.line[plan.geometry.row[row]]),
                float(plan.start[row]),
                code,
                f"{path.axes[n]} would go to {place:.6g} {axis.unit}, beyond {title} at {edge:.6g}"
                f" {axis.unit}: {begun} (page {travel.page})",
            )


def _extent(plan: ProgramPlan, path: ToolPath) -> tuple[PathRows, PathRows]:
    """Return the least and the greatest place of every axis in every row."""
    geometry = plan.geometry
    least, most = np.minimum(geometry.begins, geometry.ends), np.maximum(geometry.begins, geometry.ends)
    for n in np.flatnonzero(geometry.is_arc).tolist():
        row = int(geometry.row[n])
        a, b = places_of(path, row)
        center, radius, sweep = path.center[row], float(geometry.radius[n]), float(path.sweep[row])
        begun = math.atan2(geometry.begins[n, b] - center[1], geometry.begins[n, a] - center[0])
        low, high = min(begun, begun + sweep), max(begun, begun + sweep)
        for quarter in range(math.ceil(low / (0.5 * math.pi)), math.floor(high / (0.5 * math.pi)) + 1):
            angle = quarter * 0.5 * math.pi
            for axis, place in (
                (a, center[0] + radius * math.cos(angle)),
                (b, center[1] + radius * math.sin(angle)),
            ):
                least[n, axis], most[n, axis] = min(least[n, axis], place), max(most[n, axis], place)
    return least, most
