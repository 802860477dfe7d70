"""Scenario `step`: one commanded move of one axis, from rest to rest."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from amp_studio.sim.axis.motion import Motion, Until, run_axis
from amp_studio.sim.command.ramps import Override, blocks, end_of, move, overridden
from amp_studio.sim.engine.kernel import STANDSTILL
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import RAMPS, AxisLaw, Ramp
from amp_studio.sim.model import assumptions
from amp_studio.sim.rounding import rounded_up
from amp_studio.sim.scenario import Scenario, Settings, above_zero, number, refuse_unknown
from amp_studio.sim.series import Series
from amp_studio.sim.trace import Figure, Trace

from .columns import alarms_of, column_units, per_minute
from .figures import STEADY_LAGS, settled, stability, steady_at_feedrate

SETTINGS = {
    "move.distance": "distance of the move, with its sign (mm or deg)",
    "move.feedrate": "feedrate of the move (mm/min or deg/min); default: the rapid feedrate",
    "move.mode": f"ramp: {', '.join(RAMPS)}; default: the axis' ramp for positioning",
    "move.duration": "time to simulate (s); default: until the axis is at rest",
    "move.override": "share of the feedrate from move.override_time on (%); 0 for feedhold",
    "move.override_time": "when the override changes (s)",
    "move.resume_time": "when the override goes back to 100 % (s)",
    "move.blocks": "number of equal blocks that the move has",
    "move.corner": "between the blocks: exact-stop or contour",
    "move.emergency_time": "when the emergency stop takes the output from the drive (s)",
}

PAUSE = 0.1
"""Time at rest in s at the end of every trace; longer for a slow loop."""
LONGEST_WAIT = 12.0
"""Time constants of the position loop after the end of the command, after which an axis is not waited for any more."""
LONGEST_SETTLING = 5.0
"""s more than that."""
LONG_STRETCH = 1e5
"""s of a move that reaches its feedrate by any ramp."""
COAST = 2.0
"""s in which an axis is watched after an alarm."""
RUN_OUT = (
    "ASSUMED: after an alarm the drive gets 0. A torque drive lets the axis run out against its friction and the brake"
    " (model.brake), a velocity drive brakes it by its own loop; dynamic braking is in no manual here."
)


@dataclass(frozen=True)
class Move:
    """What is commanded: u, u/s, the ramp."""

    distance: float
    feedrate: float
    ramp: Ramp
    profile: list[float]


def run_step(axis: AxisLaw, settings: Settings) -> Trace:
    """Run one move; raises SimulationError if it is not possible."""
    refuse_unknown(settings, SETTINGS)
    moved = _move(axis, settings)
    emergency = above_zero(settings, "move.emergency_time")
    motion = run_axis(
        axis,
        moved.profile,
        _until(axis, moved, above_zero(settings, "move.duration")),
        share_rate=moved.ramp.acceleration / moved.feedrate if moved.ramp.acceleration > 0.0 else math.inf,
        coast=COAST,
        emergency=math.inf if emergency is None else emergency,
    )
    stable, margins = stability(axis)
    return Trace(
        scenario="step",
        axis=axis.axis,
        model=axis.title,
        columns=per_minute(motion.columns),
        units=column_units(axis),
        result=_figures(axis, motion, moved, stable),
        alarms=alarms_of(axis, motion, stable, margins),
        recommendations=(),
        assumptions=(*assumptions(axis), *([RUN_OUT] if motion.alarm_row is not None else [])),
        limits={name: (level, axis.unit) for name, level in axis.limits.items() if math.isfinite(level)},
        move={"move.distance": moved.distance, "move.feedrate": moved.feedrate * 60.0},
    )


def _move(axis: AxisLaw, settings: Settings) -> Move:
    feedrate, ramp = feedrate_of(axis, settings), ramp_of(axis, settings)
    count = axis.machine.position_count
    distance = number(settings, "move.distance")
    if distance == 0.0:
        raise SimulationError("move.distance is 0; it must not be 0", "move.distance")
    if distance is None:
        ramps = end_of(move(LONG_STRETCH * feedrate, feedrate, ramp, count)) - LONG_STRETCH
        distance = rounded_up(feedrate * (max(ramps, 0.0) + 2.0 * STEADY_LAGS / axis.position_rate), 2)
    if not (math.isfinite(distance) and abs(distance) / feedrate < math.inf):
        raise SimulationError("The move is too long to be simulated. Give move.distance", "move.distance")
    overrides, parts = _overrides(settings), _parts(settings)
    if parts > 1:
        if overrides:
            raise SimulationError(
                "A move in blocks has no override here: leave out one of both", "move.blocks"
            )
        exact = _exact(settings)
        profile = blocks(
            [(distance / parts, feedrate)] * parts, ramp, exact_stop=exact, check=axis.servo_period
        )
    elif overrides:
        profile = overridden(distance, feedrate, ramp, overrides, count)
    else:
        profile = move(distance, feedrate, ramp, count)
    return Move(distance, feedrate, ramp, profile)


def _overrides(settings: Settings) -> list[Override]:
    share, start = number(settings, "move.override"), number(settings, "move.override_time")
    resumed = number(settings, "move.resume_time")
    if share is None and start is None and resumed is None:
        return []
    if share is None or start is None:
        raise SimulationError("Give move.override and move.override_time together", "move.override")
    if not (share >= 0.0 and start > 0.0 and (resumed is None or resumed > start)):
        raise SimulationError(
            "The override must not be negative, and its times above 0 and in their order", "move.override"
        )
    return [Override(start, share / 100.0), *([] if resumed is None else [Override(resumed, 1.0)])]


def _parts(settings: Settings) -> int:
    parts = number(settings, "move.blocks")
    if parts is None:
        return 1
    if not (parts == int(parts) and 1 <= parts <= 1000):
        raise SimulationError(
            f"move.blocks is {parts:g}; it must be a whole number from 1 to 1000", "move.blocks"
        )
    return int(parts)


def _exact(settings: Settings) -> bool:
    corner = settings.get("move.corner", "exact-stop")
    if corner not in ("exact-stop", "contour"):
        raise SimulationError(f"move.corner is '{corner}'; it must be exact-stop or contour", "move.corner")
    return corner == "exact-stop"


def _until(axis: AxisLaw, moved: Move, duration: float | None) -> Until:
    if duration is not None:
        return Until(duration)
    lag = 1.0 / axis.position_rate
    settle = LONGEST_WAIT * lag + LONGEST_SETTLING
    blocks = len(moved.profile) // 8
    return Until(
        2.0 * end_of(moved.profile) + settle + blocks * LONGEST_WAIT * lag,
        max(axis.inposition_band, axis.rest_band, 1.5 * axis.machine.position_count),
        3.0 * lag + PAUSE,
        settle,
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


def _figures(axis: AxisLaw, motion: Motion, moved: Move, stable: bool) -> dict[str, Figure]:
    """Return the named figures; the following error at the servo samples, as the control measures it."""
    unit = axis.unit
    driven = {name: column[motion.driven] for name, column in motion.columns.items()}
    error = np.abs(driven["following_error"][:: motion.rows_per_servo_period])
    forward = driven["position"] * math.copysign(1.0, moved.distance)
    steady = steady_at_feedrate(axis, motion, moved.feedrate, "following_error") if stable else None
    in_position, settle = settled(axis, motion, moved.distance) if stable else (None, None)
    predicted: Mapping[str, Figure] = {
        f"predicted_{name}": (each.value, each.unit) for name, each in axis.predict(moved.feedrate).items()
    }
    figures: dict[str, Figure] = {
        "distance": (moved.distance, unit),
        "feedrate": (moved.feedrate * 60.0, f"{unit}/min"),
        **predicted,
        "steady_following_error": (steady, unit),
        "peak_following_error": (float(error.max()), unit),
        "peak_output": (float(np.abs(driven["output"]).max()), axis.output_unit),
        "peak_torque": (float(np.abs(driven["torque"]).max()), column_units(axis)["torque"]),
        "rms_torque": (float(np.sqrt(np.mean(driven["torque"] ** 2))), column_units(axis)["torque"]),
        "torque_limit_time": (_at_limit(axis, driven["torque"]), "%"),
        "in_position_time": (in_position, "s"),
        "settle_time": (settle, "s"),
        "overshoot": (max(0.0, float(forward.max()) - abs(moved.distance)), unit),
    }
    if motion.alarm_row is not None:
        at_rest = abs(float(motion.columns["velocity"][-1])) < STANDSTILL
        gone = abs(float(motion.columns["position"][-1] - driven["position"][-1]))
        figures["stop_position"] = (float(motion.columns["position"][-1]) if at_rest else None, unit)
        figures["stop_distance"] = (gone if at_rest else None, unit)
    return figures


def _at_limit(axis: AxisLaw, torque: Series) -> float | None:
    """Return the share of the move in % in which the torque is at its limit; None without a limit in the machine."""
    machine = axis.machine
    limits = [machine.torque_limit_positive, machine.torque_limit_negative]
    if machine.velocity_per_output == 0.0:
        limits.append(machine.output_limit)
    limit = min(limits)
    return 100.0 * float(np.mean(np.abs(torque) >= 0.999 * limit)) if math.isfinite(limit) else None


SCENARIO = Scenario("step", "One commanded move of one axis, from rest to rest", SETTINGS, run_step)
