"""Scenario `step`: one commanded move of one axis, from rest to rest."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
import numpy.typing as npt

from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import RAMPS, AxisLaw, Ramp
from amp_studio.sim.model import assumptions
from amp_studio.sim.motion import Motion, Until, run_axis
from amp_studio.sim.ramps import end_of, move
from amp_studio.sim.rounding import rounded_up
from amp_studio.sim.signals import DIVERGED
from amp_studio.sim.trace import Alarm, Figure, Trace

from .scenario import Scenario, Settings, above_zero, number, refuse_unknown

SETTINGS = {
    "move.distance": "distance of the move, with its sign (mm or deg)",
    "move.feedrate": "feedrate of the move (mm/min or deg/min); default: the rapid feedrate",
    "move.mode": f"ramp: {', '.join(RAMPS)}; default: the axis' ramp for positioning",
    "move.duration": "time to simulate (s); default: until the axis is at rest",
}

STEADY_SPEED = 1e-3
"""Largest relative difference from the feedrate of a constant command speed."""
STEADY_LAGS = 6.0
"""Number of time constants of the position loop after which a constant speed is steady."""
PAUSE = 0.1
"""Time at rest in s at the end of every trace; longer for a slow loop."""
LONGEST_WAIT = 12.0
"""Time constants of the position loop after the end of the command, after which an axis is not waited for any more."""


def run_step(axis: AxisLaw, settings: Settings) -> Trace:
    """Run one move; raises SimulationError if it is not possible."""
    refuse_unknown(settings, SETTINGS)
    feedrate, ramp = feedrate_of(axis, settings), ramp_of(axis, settings)
    distance = number(settings, "move.distance")
    if distance == 0.0:
        raise SimulationError("move.distance is 0; it must not be 0", "move.distance")
    lag = 1.0 / axis.position_rate
    if distance is None:
        ramps = end_of(move(feedrate, feedrate, ramp)) - 1.0
        distance = rounded_up(feedrate * (max(ramps, 0.0) + 2.0 * STEADY_LAGS * lag), 2)
    profile = move(distance, feedrate, ramp)
    duration = above_zero(settings, "move.duration")
    if duration is None:
        settle = LONGEST_WAIT * lag + 5.0
        until = Until(
            2.0 * end_of(profile) + settle,
            max(axis.inposition_band, 1.5 * axis.machine.position_count),
            3.0 * lag + PAUSE,
            settle,
        )
    else:
        until = Until(duration)
    motion = run_axis(axis, profile, until, share_rate=_share_rate(ramp, feedrate))
    return Trace(
        scenario="step",
        axis=axis.axis,
        model=axis.title,
        columns=per_minute(motion.columns),
        units=column_units(axis),
        result=_figures(axis, motion, distance, feedrate, end_of(profile)),
        alarms=alarms_of(axis, motion),
        recommendations=(),
        assumptions=assumptions(axis),
        limits={name: (level, axis.unit) for name, level in axis.limits.items() if math.isfinite(level)},
    )


def feedrate_of(axis: AxisLaw, settings: Settings) -> float:
    """Return the feedrate of a move in u/s; raises SimulationError if none is known."""
    given = above_zero(settings, "move.feedrate")
    if given is not None:
        return given / 60.0
    if axis.feedrate is None or not axis.feedrate > 0.0:
        source = axis.sources.get("feedrate")
        raise SimulationError(
            "The rapid feedrate of the axis is not set. Give a feedrate for the move",
            source.parameter if source else "move.feedrate",
        )
    return axis.feedrate


def ramp_of(axis: AxisLaw, settings: Settings) -> Ramp:
    """Return the ramp of a move: the one asked for, else the axis' own."""
    kind = settings.get("move.mode")
    if kind is None:
        return next(iter(axis.ramps.values()))
    found = axis.ramps.get(str(kind))
    if found is None:
        raise SimulationError(
            f"Unknown ramp '{kind}'. Axis {axis.axis} has: {', '.join(axis.ramps)}", "move.mode"
        )
    return found


def per_minute(columns: dict[str, npt.NDArray[np.float64]]) -> dict[str, npt.NDArray[np.float64]]:
    """Return the columns with velocities in u/min, as feedrates are."""
    return {
        name: column * 60.0 if name in ("command_velocity", "velocity") else column
        for name, column in columns.items()
    }


def column_units(axis: AxisLaw) -> dict[str, str]:
    """Return the unit of every column of a trace."""
    u = axis.unit
    torque = "%" if axis.machine.velocity_per_output > 0.0 else axis.output_unit
    own = {"time_s": "s", "command_position": u, "command_velocity": f"{u}/min", "position": u}
    own |= {"measured_position": u, "following_error": u, "velocity": f"{u}/min"}
    return own | {"output": axis.output_unit, "torque": torque} | dict(axis.monitors)


def alarms_of(axis: AxisLaw, motion: Motion) -> tuple[Alarm, ...]:
    """Return the alarm that ended a run."""
    if motion.stop == 0:
        return ()
    moment = float(motion.columns["time_s"][-1])
    if motion.stop == int(DIVERGED):
        return (Alarm("UNSTABLE", moment, f"Axis {axis.axis} runs away: its loop is not stable"),)
    text = axis.alarms[motion.stop]
    return (Alarm(text.code, moment, text.message),)


def _share_rate(ramp: Ramp, feedrate: float) -> float:
    """Return how fast a suppressed feedrate changes in 1/s: by the ramp of the move."""
    return ramp.acceleration / feedrate if ramp.acceleration > 0.0 else math.inf


def _figures(
    axis: AxisLaw, motion: Motion, distance: float, feedrate: float, end: float
) -> dict[str, Figure]:
    """Return the named figures; the following error at the servo samples, as the control measures it."""
    columns, every = motion.columns, motion.rows_per_servo_period
    error = np.abs(columns["following_error"][::every])
    forward = columns["position"] * math.copysign(1.0, distance)
    torque = np.abs(columns["torque"])
    predicted: Mapping[str, Figure] = {
        f"predicted_{name}": (figure.value, figure.unit) for name, figure in axis.predict(feedrate).items()
    }
    in_position, settle = (None, None) if motion.stop else _settled(axis, motion, distance, end)
    return {
        "distance": (distance, axis.unit),
        "feedrate": (feedrate * 60.0, f"{axis.unit}/min"),
        **predicted,
        "steady_following_error": (_steady(axis, motion, feedrate, distance), axis.unit),
        "peak_following_error": (float(error.max()), axis.unit),
        "peak_output": (float(np.abs(columns["output"]).max()), axis.output_unit),
        "peak_torque": (float(torque.max()), column_units(axis)["torque"]),
        "in_position_time": (in_position, "s"),
        "settle_time": (settle, "s"),
        "overshoot": (max(0.0, float(forward.max()) - abs(distance)), axis.unit),
    }


def _steady(axis: AxisLaw, motion: Motion, feedrate: float, distance: float) -> float | None:
    """Return the mean following error (without sign) at the end of the longest stretch of constant feedrate.

    None if the stretch is shorter than STEADY_LAGS time constants or the error still changes in it.
    """
    every = motion.rows_per_servo_period
    error = np.abs(motion.columns["following_error"][::every])
    constant = np.abs(np.abs(motion.columns["command_velocity"][::every]) / feedrate - 1.0) <= STEADY_SPEED
    edges = np.flatnonzero(np.diff(np.concatenate(([0], constant.astype(np.int8), [0]))))
    starts, ends = edges[::2], edges[1::2]
    if starts.size == 0:
        return None
    longest = int(np.argmax(ends - starts))
    start, end = int(starts[longest]), int(ends[longest])
    if (end - start) * axis.servo_period < STEADY_LAGS / axis.position_rate:
        return None
    window = error[end - max(1, (end - start) // 10) : end]
    mean = float(window.mean())
    spread = float(window.max() - window.min())
    return (
        mean if spread <= max(3.0 * axis.machine.position_count, 0.01 * mean, 1e-9 * abs(distance)) else None
    )


def _settled(axis: AxisLaw, motion: Motion, distance: float, end: float) -> tuple[float | None, float | None]:
    """Return (time in s from the start of the move, time in s from the end of the command) of reaching the position."""
    every = motion.rows_per_servo_period
    time = motion.columns["time_s"][::every]
    # Where the control takes the axis to be: what it adds to the command for itself (REFERENCE_LAG) is no error.
    taken = motion.columns["command_position"][::every] - motion.columns["following_error"][::every]
    off = np.abs(distance - taken)
    outside = np.flatnonzero(off > max(axis.inposition_band, 1e-9 * abs(distance)))
    first = int(outside[-1]) + 1 if outside.size else 0
    if first >= time.size:
        return None, None
    moment = float(time[first])
    return moment, max(0.0, moment - end)


SCENARIO = Scenario("step", "One commanded move of one axis, from rest to rest", SETTINGS, run_step)
