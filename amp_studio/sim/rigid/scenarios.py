"""The scenarios by name; each is one call from a parameter file to a trace."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from amp_studio.sim.axis_parameters import ParameterValue, ReadParameter
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.trace import Trace

from .bind import axis_servo
from .law import MotorGains
from .step import default_move, run_step

Run = Callable[[ReadParameter, str, Mapping[str, ParameterValue], str, MotorGains | None], Trace]


@dataclass(frozen=True)
class Scenario:
    """One kind of simulation."""

    name: str
    title: str
    settings: Mapping[str, str]
    """Settings of the move -> their description."""
    run: Run
    """run(value, axis, overrides, family, motor gains) -> Trace; overrides as in bind.axis_servo, with
    settings."""


MOVE = {
    "move.distance": "distance of the move, with its sign (mm or deg)",
    "move.feedrate": "feedrate of the move (mm/min or deg/min); default: the rapid feedrate",
    "move.mode": "ramp: linear, exponential or none; default: the axis' ramp for positioning",
    "move.duration": "time to simulate (s); default: until the axis is at rest",
}


def _run_step(
    value: ReadParameter,
    axis: str,
    overrides: Mapping[str, ParameterValue],
    family: str,
    motor_gains: MotorGains | None,
) -> Trace:
    given = {name: setting for name, setting in overrides.items() if name.startswith("move.")}
    for name in given:
        if name not in MOVE:
            raise SimulationError(f"Unknown setting '{name}' of a move. Known: {', '.join(MOVE)}", name)
    others = {name: setting for name, setting in overrides.items() if name not in given}
    servo = axis_servo(value, axis, others, family=family, motor_gains=motor_gains)
    mode = given.get("move.mode")
    move = default_move(
        servo,
        _number(given, "move.distance"),
        _number(given, "move.feedrate"),
        None if mode is None else str(mode),
        _number(given, "move.duration"),
    )
    return run_step(servo, move)


def _number(given: Mapping[str, ParameterValue], name: str) -> float | None:
    setting = given.get(name)
    if setting is None:
        return None
    if isinstance(setting, (bool, str)):
        raise SimulationError(f"{name} is {setting!r}, not a number", name)
    return float(setting)


SCENARIOS: dict[str, Scenario] = {
    "step": Scenario("step", "One commanded move of one axis, from rest to rest", MOVE, _run_step),
}
