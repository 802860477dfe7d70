"""Scenario `velocity`: a step of the velocity command on the velocity loop alone, and back to rest.

The tuning procedures of the manuals look at this: rise, overshoot,
and whether the axis swings at speed or at rest.
"""

from __future__ import annotations

import math

import numpy as np

from amp_studio.sim.axis.motion import Motion, RunEnd, run_axis
from amp_studio.sim.axis.moves import feedrate_of, ramp_of
from amp_studio.sim.command.ramps import move
from amp_studio.sim.engine.signals import VELOCITY_LOOP
from amp_studio.sim.law import AxisLaw, Ramp
from amp_studio.sim.model import assumptions
from amp_studio.sim.scenario import Scenario, ScenarioSettings, above_zero, refuse_unknown
from amp_studio.sim.series import Series
from amp_studio.sim.trace import Figure, Trace
from amp_studio.sim.tuning.linear import LinearModel, axis_model

from .columns import alarms_of, column_units, per_minute
from .figures import steady
from .step import RUN_OUT

_SETTINGS = {
    "move.feedrate": "commanded velocity (mm/min or deg/min); default: a tenth of the rapid feedrate",
    "move.duration": "time at that velocity, and at rest after it (s); default: as the loop needs",
    "move.mode": "ramp of the command; default: none",
}
SHARE = 0.1
"""Share of the rapid feedrate of a step when no velocity is given: below the torque limit on most axes."""
_SHORTEST, _LONGEST, _LAGS = 0.1, 2.0, 12.0
"""s, s, and time constants of the slowest pole: the time at the velocity."""
_BAND = 0.02
"""Share of the step inside which the velocity has settled."""
_POSITIONS = ("command_position", "measured_position", "following_error")
"""Columns that mean nothing while no position is commanded."""


def _run_velocity(axis: AxisLaw, settings: ScenarioSettings) -> Trace:
    """Run one step of the velocity; raises SimulationError if it is not possible."""
    refuse_unknown(settings, _SETTINGS)
    speed = feedrate_of(axis, settings) * (1.0 if settings.get("move.feedrate") is not None else SHARE)
    ramp = ramp_of(axis, settings) if settings.get("move.mode") is not None else Ramp()
    loop = axis_model(axis).inner
    lasts = above_zero(settings, "move.duration") or _time(loop)
    profile = move(speed * lasts, speed, ramp)
    motion = run_axis(axis, profile, RunEnd(2.0 * lasts), mode=VELOCITY_LOOP, coast=1.0)
    stable = loop is None or loop.is_stable(drift=True)
    margins = None if loop is None or stable else loop.margins()
    columns = {name: each for name, each in per_minute(motion.columns).items() if name not in _POSITIONS}
    units = column_units(axis)
    return Trace(
        scenario="velocity",
        axis=axis.axis,
        model=axis.title,
        columns=columns,
        units={name: units[name] for name in columns},
        result=_figures(axis, motion, speed, lasts, loop if stable else None),
        alarms=alarms_of(axis, motion, stable, margins),
        assumptions=(*assumptions(axis), *([RUN_OUT] if motion.alarm_row is not None else [])),
        move={"move.feedrate": speed * 60.0, "move.duration": lasts},
    )


def _time(loop: LinearModel | None) -> float:
    """Return the time in s in which the velocity loop settles; _LONGEST for one that does not."""
    if loop is None:
        return 0.5
    sizes = np.abs(loop.poles())
    moving = sizes[sizes < 1.0 - 1e-6]
    if moving.size == 0 or np.any(sizes > 1.0 + 1e-6):
        return _LONGEST
    return float(np.clip(-_LAGS * loop.period / math.log(moving.max()), _SHORTEST, _LONGEST))


def _figures(
    axis: AxisLaw, motion: Motion, speed: float, lasts: float, loop: LinearModel | None
) -> dict[str, Figure]:
    """Return the named figures; those of the loop only where it is stable."""
    unit = f"{axis.unit}/min"
    rows = motion.driven
    time, velocity = motion.columns["time_s"][rows], motion.columns["velocity"][rows]
    driven = velocity[time < lasts]
    at_rest = velocity[time >= lasts]
    tenth, most = (np.flatnonzero(driven >= share * speed) for share in (0.1, 0.9))
    rise = float(time[most[0]] - time[tenth[0]]) if most.size else None
    end = steady(driven, 1e-6 * speed)
    outside = np.flatnonzero(np.abs(driven / speed - 1.0) > _BAND)
    inside = int(outside[-1]) + 1 if outside.size else 0
    settle = float(time[inside]) if end is not None and inside < driven.size else None
    figures: dict[str, Figure] = {
        "velocity": (speed * 60.0, unit),
        "rise_time": (rise, "s"),
        "settle_time": (settle, "s"),
        "steady_velocity": (None if end is None else end * 60.0, unit),
        "overshoot": (100.0 * max(0.0, float(driven.max()) / speed - 1.0), "%"),
        "swing_at_speed": (_swing(driven) * 60.0, unit),
        "swing_at_rest": (_swing(at_rest) * 60.0 if at_rest.size else None, unit),
        "peak_output": (float(np.abs(motion.columns["output"][rows]).max()), axis.output_unit),
        "peak_torque": (float(np.abs(motion.columns["torque"][rows]).max()), column_units(axis)["torque"]),
    }
    if loop is not None:
        margins = loop.margins()
        figures["phase_margin"] = (margins.phase, "deg")
        figures["gain_margin"] = (margins.gain, "dB")
    return figures


def _swing(velocity: Series) -> float:
    """Return how far the velocity goes to and fro in the last fifth, in u/s."""
    return float(np.ptp(velocity[-max(1, len(velocity) // 5) :]))


SCENARIO = Scenario(
    "velocity",
    "One step of the velocity command on the velocity loop alone",
    _SETTINGS,
    _run_velocity,
    checked=("settle_time", "overshoot", "peak_torque"),
)
