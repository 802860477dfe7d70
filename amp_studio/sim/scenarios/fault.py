"""Scenario `fault`: the drive trips, or its feedback is lost, in the middle of a move.

A control that is informed takes the output away at once and shows its own words; another one goes on with
its loop, without torque, until its following error is beyond its limit.
"""

from __future__ import annotations

import math

import numpy as np

from amp_studio.sim.axis.motion import Motion
from amp_studio.sim.axis.moves import MOVE_SETTINGS, Move, move_of
from amp_studio.sim.axis.moving_axis import MovingAxis
from amp_studio.sim.axis.orders import MoveOrder, one
from amp_studio.sim.command.ramps import end_of
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import FAULTS, AxisLaw
from amp_studio.sim.model import assumptions
from amp_studio.sim.scenario import Scenario, ScenarioSettings, above_zero, refuse_unknown
from amp_studio.sim.trace import Alarm, Figure, Trace

from .columns import alarms_of, column_units, per_minute
from .step import COAST, RUN_OUT

_SETTINGS = {
    "move.fault": f"{' or '.join(FAULTS)}; default: drive",
    "move.fault_time": "when the fault comes (s); default: in the middle of the command",
    **{name: MOVE_SETTINGS[name] for name in ("move.distance", "move.feedrate", "move.mode")},
}
_INFORMED = "The control is informed of the fault and takes the output away ({0})."
_UNSEEN = (
    "ASSUMED: how a tripped drive informs this control is in no manual here. The drive has no torque, and the"
    " control goes on until its following error shows it."
)
_STILL_MOVES = (
    f"The axis still moves {COAST:g} s after the fault: without friction and a brake (model.*) it runs on."
)
_NO_ALARM = "The drive has tripped, and no limit of the following error shows it: the command ends as usual"


def _run_fault(axis: AxisLaw, settings: ScenarioSettings) -> Trace:
    """Run one move with a fault in it; raises SimulationError for one that no page prints."""
    refuse_unknown(settings, _SETTINGS)
    kind = str(settings.get("move.fault", "drive"))
    axis.refuse_unknown_fault(kind)
    moved = move_of(axis, settings)
    moment = above_zero(settings, "move.fault_time") or 0.5 * end_of(moved.profile)
    if moment >= end_of(moved.profile):
        raise SimulationError("move.fault_time is behind the end of the command", "move.fault_time")
    course = MovingAxis(axis, coast=COAST)
    course.begin(one(MoveOrder(moved.distance, moved.feedrate, moved.ramp)))
    course.advance(moment)
    moment = course.time
    if kind in axis.faults:
        course.switch_off()
    else:
        course.trip()
        course.finish()
    motion = course.motion()
    times, row = motion.columns["time_s"], motion.alarm_row
    runs_on = row is not None and times[-1] - times[row] > 0.99 * COAST
    return Trace(
        scenario="fault",
        axis=axis.axis,
        model=axis.title,
        columns=per_minute(motion.columns),
        units=column_units(axis),
        result=_figures(axis, motion, moved, moment),
        alarms=_alarms(axis, motion, kind),
        assumptions=(
            _INFORMED.format(axis.faults[kind].message) if kind in axis.faults else _UNSEEN,
            *assumptions(axis),
            RUN_OUT,
            *([_STILL_MOVES] if runs_on else []),
        ),
        limits={name: (level, axis.unit) for name, level in axis.limits.items() if math.isfinite(level)},
        move={"move.distance": moved.distance, "move.feedrate": moved.feedrate * 60.0},
    )


def _alarms(axis: AxisLaw, motion: Motion, kind: str) -> tuple[Alarm, ...]:
    """Return what the control shows: the words of the fault, or those of the following error."""
    if kind in axis.faults:
        words, at = axis.faults[kind], float(motion.columns["time_s"][motion.alarm_row or 0])
        return (Alarm(words.code, at, words.message),)
    return alarms_of(axis, motion) or (Alarm("NO ALARM", float(motion.columns["time_s"][-1]), _NO_ALARM),)


def _figures(axis: AxisLaw, motion: Motion, moved: Move, moment: float) -> dict[str, Figure]:
    times, positions = motion.columns["time_s"], motion.columns["position"]
    at = min(int(np.searchsorted(times, moment)), len(times) - 1)
    noticed = None if motion.alarm_row is None else float(times[motion.alarm_row]) - moment
    error = float(np.abs(motion.columns["following_error"][motion.driven]).max())
    return {
        "feedrate": (moved.feedrate * 60.0, f"{axis.unit}/min"),
        "speed_at_fault": (abs(float(motion.columns["velocity"][at])) * 60.0, f"{axis.unit}/min"),
        "noticed_after": (None if noticed is None else max(noticed, 0.0), "s"),
        "run_out": (abs(float(positions[-1] - positions[at])), axis.unit),
        "stop_position": (float(positions[-1]), axis.unit),
        "peak_following_error": (error, axis.unit),
    }


SCENARIO = Scenario(
    "fault",
    "A drive that trips, or feedback that is lost, in a move: the control's words, and how far the axis runs",
    _SETTINGS,
    _run_fault,
    gains=False,
)
