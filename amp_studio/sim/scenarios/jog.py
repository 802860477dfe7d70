"""Scenario `jog`: an axis/direction button pressed for a time, or one increment, at a speed of the switch."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

from amp_studio.schema import unknown_name
from amp_studio.sim.axis_parameters import ParameterValue
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import AxisLaw
from amp_studio.sim.scenario import Scenario, ScenarioSettings, above_zero, direction, refuse_unknown
from amp_studio.sim.trace import Trace

from .step import SCENARIO as STEP

_SETTINGS = {
    "move.speed": "position of the speed switch; default: the lowest speed",
    "move.increment": "increment of an incremental jog; default: a continuous jog",
    "move.hold": "how long the button of a continuous jog is pressed (s); default: 1",
    "move.direction": "plus or minus; default: plus",
}
_PRESS_TIME = 1.0
"""s"""


def _run_jog(axis: AxisLaw, settings: ScenarioSettings) -> Trace:
    """Run one jog; raises SimulationError for a speed that is not set or an unknown one."""
    refuse_unknown(settings, _SETTINGS)
    if axis.jogging is None:
        raise SimulationError(f"No jog of axis {axis.axis} is printed")
    jogging = axis.jogging()
    increment = settings.get("move.increment")
    if increment is not None and settings.get("move.hold") is not None:
        raise SimulationError("An incremental jog has no time: leave out move.hold", "move.hold")
    chosen = settings.get("move.speed")
    if increment is not None and jogging.increment_speed:
        if chosen is not None:
            raise SimulationError(
                f"Incremental jogs go at the speed '{jogging.increment_speed}': leave out move.speed",
                "move.speed",
            )
        chosen = jogging.increment_speed
    speed = _chosen("speed", chosen, jogging.speeds)
    sign = direction(settings) or 1.0
    ramp = jogging.ramp or (axis.manual_ramp(False) if axis.manual_ramp else next(iter(axis.ramps.values())))
    if increment is not None:
        distance = _chosen("increment", increment, jogging.increments)
    else:
        # A ramp up during the hold and one down after it are as long as the hold at full speed.
        distance = speed * (above_zero(settings, "move.hold") or _PRESS_TIME)
        if ramp.acceleration:
            distance = _pressed(
                speed, distance / speed, ramp.acceleration, ramp.deceleration or ramp.acceleration
            )
    jogged = replace(axis, ramps={ramp.kind: ramp})
    trace = STEP.run(jogged, {"move.distance": sign * distance, "move.feedrate": speed * 60.0})
    unit = axis.unit
    end = float(trace.columns["position"][-1])
    in_position = trace.result["in_position_time"]
    result = {**trace.result, "stop_position": (end, unit), "time": in_position}
    return replace(
        trace, scenario="jog", result=result, assumptions=(*jogging.notes, *trace.assumptions), move={}
    )


def _pressed(speed: float, time: float, up: float, down: float) -> float:
    """Return how far a straight ramp takes an axis whose button is pressed for ``time`` s;
    lower than ``speed`` for a short one.
    """
    reached = min(speed, up * time)
    return reached * time - 0.5 * reached * reached / up + 0.5 * reached * reached / down


def _chosen(what: str, name: ParameterValue, known: Mapping[str, float]) -> float:
    """Return the figure of a name, the first for none; raises SimulationError for an unknown one."""
    if not known:
        raise SimulationError(f"No jog {what} of this axis is set", f"move.{what}")
    if name is None:
        return float(next(iter(known.values())))
    key = f"{name:g}" if isinstance(name, float) else str(name)
    if key not in known:
        raise SimulationError(unknown_name(f"jog {what}", key, known), f"move.{what}")
    if not math.isfinite(known[key]) or known[key] <= 0.0:
        raise SimulationError(f"The jog {what} {key} is {known[key]:g}; it must be above 0", f"move.{what}")
    return float(known[key])


SCENARIO = Scenario(
    "jog",
    "A continuous or incremental jog",
    _SETTINGS,
    _run_jog,
    part="travel",
    checked=("feedrate", "stop_position", "time"),
)
