"""Scenario `step`: one commanded move of one axis, from rest to rest."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from amp_studio.sim.axis.motion import Motion, run_axis
from amp_studio.sim.axis.moves import MOVE_SETTINGS, Move, move_of, until_of
from amp_studio.sim.engine.kernel import STANDSTILL
from amp_studio.sim.law import AxisLaw
from amp_studio.sim.model import assumptions, torque_unit
from amp_studio.sim.scenario import Scenario, ScenarioSettings, above_zero, refuse_unknown
from amp_studio.sim.series import Series
from amp_studio.sim.trace import Figure, Trace

from .columns import alarms_of, column_units, per_minute
from .figures import settled, stability, steady_at_feedrate

COAST = 2.0
"""s in which an axis is watched after an alarm."""
_RATED = "move.rated_torque"
_SETTINGS = MOVE_SETTINGS | {
    _RATED: "torque that the motor gives all the time (torque); default: 100 % where torque is in %"
}
RUN_OUT = (
    "ASSUMED: after an alarm the drive gets 0. A torque drive lets the axis run out against its friction and"
    " the brake (model.brake), a velocity drive brakes it by its own loop; dynamic braking is in no manual"
    " here."
)


def run_step(axis: AxisLaw, settings: ScenarioSettings) -> Trace:
    """Run one move; raises SimulationError if it is not possible."""
    refuse_unknown(settings, _SETTINGS)
    moved, rated = move_of(axis, settings), above_zero(settings, _RATED)
    emergency = above_zero(settings, "move.emergency_time")
    motion = run_axis(
        axis,
        moved.profile,
        until_of(axis, moved, above_zero(settings, "move.duration")),
        share_rate=moved.share_rate,
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
        result=_figures(axis, motion, moved, stable, rated),
        alarms=alarms_of(axis, motion, stable, margins),
        assumptions=(*assumptions(axis), *([RUN_OUT] if motion.alarm_row is not None else [])),
        limits={name: (level, axis.unit) for name, level in axis.limits.items() if math.isfinite(level)},
        move={"move.distance": moved.distance, "move.feedrate": moved.feedrate * 60.0},
    )


def _figures(
    axis: AxisLaw, motion: Motion, moved: Move, stable: bool, rated: float | None
) -> dict[str, Figure]:
    """Return the named figures; the following error at the servo samples, as the control measures it."""
    unit = axis.unit
    driven = {name: column[motion.driven] for name, column in motion.columns.items()}
    error = np.abs(driven["following_error"][:: motion.rows_per_servo_period])
    forward = driven["position"] * math.copysign(1.0, moved.distance)
    steady = steady_at_feedrate(axis, motion, moved.feedrate) if stable else None
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
        "duty": (_duty(driven["torque"], rated or _rated(axis)), "%"),
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
    """Return the share of the move in % in which the torque is at its limit;
    None without a limit in the machine.
    """
    machine = axis.machine
    limits = [machine.torque_limit_positive, machine.torque_limit_negative]
    if machine.velocity_per_output == 0.0:
        limits.append(machine.output_limit)
    limit = min(limits)
    return 100.0 * float(np.mean(np.abs(torque) >= 0.999 * limit)) if math.isfinite(limit) else None


def _rated(axis: AxisLaw) -> float | None:
    """Return the torque that the motor gives all the time; None where the unit of torque does not say it."""
    return 100.0 if torque_unit(axis) == "%" else None


def _duty(torque: Series, rated: float | None) -> float | None:
    """Return the share of the time in % that the move may take, at rest in between, until the root mean
    square of the torque is the rated one: d rms² + (1 - d) hold² = rated². A motor warms up slowly beside a
    move.
    """
    if rated is None:
        return None
    hold = float(torque[-max(1, len(torque) // 50) :].mean())
    square = float(np.mean(torque**2))
    if square <= rated**2:
        return 100.0
    return 100.0 * max(0.0, (rated**2 - hold**2) / (square - hold**2))


SCENARIO = Scenario(
    "step",
    "One commanded move of one axis, from rest to rest",
    _SETTINGS,
    run_step,
    headline="peak_following_error",
    checked=("steady_following_error", "peak_following_error", "settle_time", "overshoot", "peak_output"),
)
