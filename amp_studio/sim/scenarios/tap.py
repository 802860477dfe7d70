"""Scenario `tap`: solid tapping to a depth and back:
how far the axis is from the thread that the spindle makes, worst at the reversal.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from amp_studio.sim.axis.motion import RunEnd, run_axis
from amp_studio.sim.command.events import Ramp
from amp_studio.sim.command.pieces import Piece, length
from amp_studio.sim.command.ramps import end_of, leg, profile_of
from amp_studio.sim.engine.profiles import WIDTH
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import AxisLaw, BoundMachine
from amp_studio.sim.model import assumptions
from amp_studio.sim.rounding import page_text, value_text
from amp_studio.sim.scenario import Scenario, ScenarioSettings, above_zero, refuse_unknown
from amp_studio.sim.series import Series
from amp_studio.sim.spindle import Gear, Spindle, Tapping
from amp_studio.sim.trace import Alarm, Figure, Trace

from .columns import alarms_of, column_units, per_minute
from .spindle import HIGHEST, spindle_of

SETTINGS = {
    "move.pitch": "pitch of the thread (mm)",
    "move.speed": "speed of the spindle (rpm), or highest",
    "move.depth": "depth of the hole (mm); default: 15 mm",
    "move.spindle": "which spindle, by its number; default: the first",
    "move.gear": "the gear it is in; default: one that has the speed",
    "move.feed_stop": "when the feed is stopped on the way into the hole (s); default: it is not",
    "move.drive_time": "time constant of the spindle drive (s); default: 0.02, assumed",
}
DEPTH = 15.0
"""mm"""
DRIVE_TIME = 0.02
"""s"""
NEAR = 0.25
"""s around the reversal in which its error is looked for, at most."""
SETTLE = 8.0
"""Time constants of the position loop after the command."""
LAGS = 3.0
DRIVEN = (
    "ASSUMED: the spindle follows its command by a position loop of {0} and a drive with a lag of {1};"
    " nothing of the drive is in the file (move.drive_time)."
)
BACK_AT_ONCE = (
    "The feed stop turns the tap back before the bottom of the hole ({0}). ASSUMED: along the ramp of"
    " tapping, as in the bottom."
)
GOES_ON = "The feed stop has no effect while tapping; it is kept for the end of the cycle ({0})."
LED = (
    "ASSUMED: the spindle goes along its ramp exactly, and the axis follows its measured angle; the torque of"
    " the cut is left out."
)


def run_tap(machine: BoundMachine, settings: ScenarioSettings) -> Trace:
    """Tap one hole; raises SimulationError where spindle, gear or pitch do not allow it."""
    refuse_unknown(settings, SETTINGS)
    law = machine.law
    if law.tapping is None:
        raise SimulationError("No solid tapping is printed for this family")
    pitch = above_zero(settings, "move.pitch")
    if pitch is None or settings.get("move.speed") is None:
        name, example = ("move.pitch", 1) if pitch is None else ("move.speed", 600)
        raise SimulationError(f"Give {name}, as {example}", name)
    depth = above_zero(settings, "move.depth") or DEPTH
    spindle = spindle_of(machine, settings)
    speed = _speed(spindle, settings)
    gear, assumption = _gear(spindle, settings, speed)
    name = machine.one_chosen("tap") or _tapping_axis(machine)
    axis = machine.bind(name, {})
    if axis.unit != "mm":
        raise SimulationError(f"Axis {axis.axis} turns: give the axis that taps")
    tapping = law.tapping(machine, spindle, gear, axis, pitch)
    axis = machine.bind(name, dict(tapping.overrides)) if tapping.overrides else axis
    lag = above_zero(settings, "move.drive_time") or DRIVE_TIME
    stop = above_zero(settings, "move.feed_stop")
    if stop is not None and not tapping.feed_stop:
        raise SimulationError(
            "What a feed stop does while tapping is not printed for this family", "move.feed_stop"
        )
    trace = _tapped(
        axis, spindle, gear, tapping, pitch, min(speed, tapping.speed), speed, depth, lag, assumption, stop
    )
    if stop is None:
        return trace
    note = (BACK_AT_ONCE if tapping.feed_stop == "detaps" else GOES_ON).format(
        page_text(tapping.feed_stop_page)
    )
    return replace(trace, assumptions=(note, *trace.assumptions))


def _gear(spindle: Spindle, settings: ScenarioSettings, speed: float) -> tuple[Gear, str]:
    """Return the gear in which a speed is tapped, and what is assumed of it; raises SimulationError."""
    given = settings.get("move.gear")
    present = None if given is None else f"{given:g}" if isinstance(given, float) else str(given)
    if spindle.refusal:
        raise SimulationError(f"{spindle.refusal} ({page_text(spindle.page)})", "move.gear")
    gear, assumption = spindle.gear_for(speed, present)
    if gear is None:
        raise SimulationError(
            f"No gear of spindle {spindle.name} has {value_text(speed, 'rpm')} ({page_text(spindle.page)})",
            "move.speed",
        )
    return gear, assumption


def _speed(spindle: Spindle, settings: ScenarioSettings) -> float:
    """Return the speed that is asked for, rpm: the highest one that a gear has while tapping, or the one
    given.
    """
    if settings["move.speed"] == HIGHEST:
        return max((min(gear.high, gear.tap_speed) for gear in spindle.gears), default=0.0)
    return above_zero(settings, "move.speed") or 0.0


def _tapping_axis(machine: BoundMachine) -> str:
    """Return the axis Z, else the last one."""
    return next((axis for axis in machine.fitted if machine.letter(axis) == "Z"), machine.fitted[-1])


def _tapped(
    axis: AxisLaw,
    spindle: Spindle,
    gear: Gear,
    tapping: Tapping,
    pitch: float,
    speed: float,
    asked: float,
    depth: float,
    lag: float,
    assumption: str,
    stop: float | None,
) -> Trace:
    """Run the axis down to the depth and back with the spindle, and return how far it is from the thread."""
    feed = speed / 60.0 * pitch
    own = next(iter(axis.ramps.values()))
    rate = tapping.rate or own.acceleration
    if not rate:
        raise SimulationError(
            f"No acceleration of axis {axis.axis} or of the spindle is set: the reversal takes no time"
        )
    reached = (
        depth if stop is None or tapping.feed_stop != "detaps" else min(depth, _run_in(stop, feed, rate))
    )
    there = leg(reached, feed, Ramp("linear", rate))
    profile = _there_and_back(there, reached)
    until = end_of(profile) + SETTLE / axis.position_rate + NEAR
    motion = run_axis(axis, profile, RunEnd(until), thin=True)
    columns = per_minute({key: each.copy() for key, each in motion.columns.items()})
    time, command = motion.columns["time_s"], motion.columns["command_position"]
    thread = command if tapping.leads else _followed(time, command, tapping, lag)
    position = motion.columns["position"]
    if tapping.anticipation:
        position = np.interp(time + tapping.anticipation, time, position)
        columns["position"] = position
    error = position - thread
    columns["tapping_error"] = error
    turn = end_of(profile) / 2.0
    near = np.abs(time - turn) <= min(NEAR, LAGS / axis.position_rate + lag + speed / 60.0 * pitch / rate)
    at = int(np.argmax(np.abs(np.where(near, error, 0.0))))
    deepest = float(np.max(-position))
    alarms = alarms_of(axis, motion)
    if asked > tapping.speed:
        text = (
            f"{value_text(asked, 'rpm')} is above the highest tapping speed of gear {gear.name},"
            f" {value_text(tapping.speed, 'rpm')} ({page_text(tapping.page)})"
        )
        alarms = (Alarm("TAPPING SPEED", 0.0, text), *alarms)
    result: dict[str, Figure] = {
        "reversal_error": (abs(float(error[at])), axis.unit),
        "depth": (deepest, axis.unit),
        "depth_error": (deepest - depth, axis.unit),
        "largest_error": (float(np.abs(error).max()), axis.unit),
        "speed": (speed, "rpm"),
        "feedrate": (feed * 60.0, f"{axis.unit}/min"),
        "gear": (float(gear.name), ""),
        "acceleration": (rate, f"{axis.unit}/s2"),
        "peak_following_error": (float(np.abs(motion.columns["following_error"]).max()), axis.unit),
        "time": (motion.command_end, "s"),
        **(tapping.figures or {}),
    }
    driven = LED if tapping.leads else DRIVEN.format(value_text(tapping.gain, "1/s"), value_text(lag, "s"))
    of_gear = (assumption,) if assumption else ()
    return Trace(
        scenario="tap",
        axis=axis.axis,
        model=f"{axis.title}; {spindle.title}",
        columns=columns,
        units=column_units(axis) | {"tapping_error": axis.unit},
        result=result,
        alarms=alarms,
        assumptions=(
            *of_gear,
            *tapping.notes,
            driven,
            "ASSUMED: the reversal follows at once, without a dwell in the bottom.",
            *assumptions(axis),
        ),
        move={"move.depth": depth},
    )


def _run_in(stop: float, feed: float, rate: float) -> float:
    """Return how deep the tap is when it has come to rest from where a feed stop met it, u."""
    rising = min(stop, feed / rate)
    speed = rate * rising
    return 0.5 * rate * rising * rising + feed * (stop - rising) + speed * speed / (2.0 * rate)


def _there_and_back(there: list[Piece], depth: float) -> list[float]:
    """Return the profile of the way into the hole, downwards, and back."""
    down = profile_of(there, length(there), -1.0)
    lasts, rows = end_of(down), down[: len(down) - WIDTH]
    up = profile_of(there, length(there), 1.0)
    for k in range(0, len(up), WIDTH):
        up[k] += lasts
        up[k + 2] -= depth
    return rows + up


def _followed(time: Series, command: Series, tapping: Tapping, lag: float) -> Series:
    """Return where the thread is by the angle of a spindle that follows a command: position loop,
    then the lag of its drive.
    """
    step = float(time[1] - time[0])
    share = 1.0 - math.exp(-step / lag)
    rate = np.gradient(command, step) * tapping.forward
    out, place, speed = np.empty_like(command), float(command[0]), 0.0
    for n, (wanted, ahead) in enumerate(zip(command.tolist(), rate.tolist(), strict=True)):
        out[n] = place
        speed += share * (tapping.gain * (wanted - place) + ahead - speed)
        place += speed * step
    return out


SCENARIO = Scenario(
    "tap",
    "Solid tapping: how far the axis is from the thread of the spindle, at the reversal and in the bottom",
    SETTINGS,
    run_tap,
    gains=False,
    of_machine=True,
    part="spindle",
    headline="reversal_error",
    checked=("gear", "speed", "reversal_error", "depth_error"),
    once=True,
    programmed={"move.pitch": 1.0, "move.speed": HIGHEST},
)
