"""A part program under a file: its plan, where it meets limits, and the axes on it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import chain

import numpy as np

from amp_studio.files import ParameterFile
from amp_studio.programs import ToolPath
from amp_studio.schema import Address, load_part
from amp_studio.sim.axis.motion import RunEnd, run_axis
from amp_studio.sim.axis_parameters import ParameterValue
from amp_studio.sim.command.events import Ramp
from amp_studio.sim.command.ramps import end_of, move
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import AxisLaw, BoundMachine, law_of
from amp_studio.sim.model import assumptions
from amp_studio.sim.path_rules import PathRules, row_sums
from amp_studio.sim.run import bound_machine

from .contour import ContourError, contour_error
from .limits_met import GuardedBox, LimitsWatch, PathAlarm, ZonesWatch, guarded_boxes
from .planned import PlannedProgram
from .planner import ProgramPlan

MAX_ROWS = 50_000
"""Rows of a path that the servo loops are run on."""
LONGEST_WAIT = 5.0
"""s that an exact stop is waited for in position."""
NO_ZERO = "Limits of travel are not checked: give the zero of the program, which is not in the file."


@dataclass(frozen=True)
class ProgramRun:
    """A program under one file."""

    plan: PlannedProgram
    alarms: tuple[PathAlarm, ...]
    contour: ContourError | None
    why_no_contour: str
    read: tuple[Address, ...]
    """Values that were read."""
    assumptions: tuple[str, ...]
    guarded: tuple[GuardedBox, ...] = ()
    """Zones and limits of travel."""


def run_program(
    file: ParameterFile,
    parts: Iterable[ToolPath],
    *,
    override: float = 1.0,
    rapid_override: float = 1.0,
    model: Mapping[str, ParameterValue] | None = None,
    with_contour: bool = True,
    progress: Callable[[float], None] = lambda _share: None,
) -> ProgramRun:
    """Return a program in motion, whose path comes in ``parts``; ``override`` and ``rapid_override`` are
    shares of feed and rapid.

    Raises SimulationError where a value is missing or no page prints how the family goes along a path.
    """
    law = law_of(file.schema.family.family)
    if not law.path:
        raise SimulationError(
            f"{file.schema.family.name}: no page here prints how it goes along the path of a program"
        )
    read: list[Address] = []
    machine = bound_machine(file, law, (), model or {}, read.append)
    rules: PathRules = load_part(law.path)(machine)
    rules = replace(rules, override=override, rapid_override=rapid_override)
    plan = PlannedProgram(parts, rules, progress)
    path = plan.path
    axes = _axes(machine, path)
    notes = [*path.assumptions, *rules.assumptions]
    wait = 0.0
    if rules.waits:
        # How long a wait is depends on the speed into the stop, which depends on no wait.
        waits = _Waits(axes, rules.feed_ramp)
        for stretch in plan:
            waits.look(stretch)
        wait = waits.wait()
        if wait:
            notes.append(
                f"An exact stop waits {wait:.3g} s until the axes are in position: that of the largest"
                " of them, moved by itself."
            )
    travel, zones = LimitsWatch(axes), ZonesWatch(machine)
    plan.add_up(wait, (travel.look, zones.look))
    alarms = [*travel.alarms, *zones.alarms]
    if not path.zero_known:
        notes.append(NO_ZERO)
    contour, why = None, "not asked for"
    if with_contour:
        contour, why = _contour(plan, axes)
        if contour is not None:
            alarms += _alarms_on(plan, contour)
            notes += chain.from_iterable(map(assumptions, axes))
    if path.fault is not None:
        fault = path.fault
        alarms.append(PathAlarm(fault.line, plan.time, fault.code, fault.message))
    return ProgramRun(
        plan,
        tuple(alarms),
        contour,
        why,
        tuple(read),
        tuple(dict.fromkeys(notes)),
        guarded_boxes(path, machine, axes),
    )


def _alarms_on(plan: PlannedProgram, contour: ContourError) -> Iterator[PathAlarm]:
    for alarm in contour.alarms:
        yield PathAlarm(_line_at(plan.whole, alarm.time_s), alarm.time_s, alarm.code, alarm.message)


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
        self._fastest: tuple[float, list[tuple[AxisLaw, float, float, float]]] = (-1.0, [])

    def look(self, plan: ProgramPlan) -> None:
        """Take the fastest exact stop of a stretch as the example."""
        # 1 is the dwell, and what rows without any rest have.
        exact = np.flatnonzero((plan.rest_by != 1) & (row_sums(plan.times) > 0.0))
        if not len(exact):
            return
        # One example: the loops at every stop would be run for longer than the program.
        row = int(exact[np.argmax(plan.peak[exact])])
        peak, way, slope = (float(each[row]) for each in (plan.peak, plan.geometry.length, plan.acceleration))
        if peak > self._fastest[0]:
            shares = zip(self._axes, plan.geometry.share[row].tolist(), strict=True)
            self._fastest = peak, [(axis, share * way, share * peak, share * slope) for axis, share in shares]

    def wait(self) -> float:
        """Return the time in s."""
        return max(
            (
                _wait(axis, way, speed, replace(self._ramp, acceleration=slope))
                for axis, way, speed, slope in self._fastest[1]
                if speed > 0.0 and axis.inposition_band > 0.0
            ),
            default=0.0,
        )


def _wait(axis: AxisLaw, way: float, speed: float, ramp: Ramp) -> float:
    profile = move(way, speed, ramp, axis.machine.position_count)
    end = end_of(profile)
    # In position for 0.2 s: a loop that overshoots leaves its band again.
    motion = run_axis(
        axis, profile, RunEnd(end + LONGEST_WAIT, axis.inposition_band, 0.2, LONGEST_WAIT), thin=True
    )
    time, error = motion.columns["time_s"], np.abs(motion.columns["following_error"])
    after = (time >= end) & (error > axis.inposition_band)
    return float(time[after][-1] - end) if after.any() else 0.0


def _contour(program: PlannedProgram, axes: list[AxisLaw]) -> tuple[ContourError | None, str]:
    """Return the contour error, or why there is none."""
    if program.rows > MAX_ROWS:
        return None, f"The path has more than {MAX_ROWS} moves"
    plan = program.whole
    if not len(plan.entry):
        return None, "the program moves nothing"
    # The end of a whole circle is its start: an axis moves where it has a share in a row.
    ways = plan.geometry.share * plan.geometry.length[:, None]
    chosen = [axis if (ways[:, n] > 1e-9).any() else None for n, axis in enumerate(axes)]
    moving = [*filter(None, chosen)]
    if not moving:
        return None, "the program moves nothing"
    if any(axis.sources.keys().isdisjoint(axis.gains) for axis in moving):
        return None, "this control has no servo loop whose gains are in the file"
    # A distance from the path of mm and degrees together has no unit.
    if len({axis.unit for axis in moving}) > 1:
        return None, "the axes do not move in one unit"
    try:
        return contour_error(plan, chosen), ""
    except SimulationError as error:
        return None, f"{error}"
