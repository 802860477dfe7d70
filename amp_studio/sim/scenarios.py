"""The scenarios by name, each with one call from a parameter file to a trace."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from .bind import axis_servo
from .reading import MotorGains, Value, ValueOf
from .servo import SimulationError
from .step import default_move, run_step
from .trace import Trace

Run = Callable[[ValueOf, str, Mapping[str, Value], str, MotorGains | None], Trace]


@dataclass(frozen=True)
class Scenario:
    """Something that can be simulated."""

    name: str
    title: str
    settings: Mapping[str, str]
    """Settings of the move that can be given by hand -> what they are."""
    run: Run
    """run(value, axis, overrides, family, motor gains) -> Trace; overrides as in bind.axis_servo, with
    settings."""


MOVE = {
    "move.distance": "distance of the move, with its sign (mm or deg)",
    "move.feedrate": "feedrate of the move (mm/min or deg/min); the rapid feedrate when not given",
    "move.mode": "ramp: linear, exponential or none; the one of the axis for positioning when not given",
    "move.duration": "time to simulate (s); until the axis rests when not given",
}


def _run_step(
    value: ValueOf, axis: str, overrides: Mapping[str, Value], family: str, motor_gains: MotorGains | None
) -> Trace:
    given = {name: setting for name, setting in overrides.items() if name.startswith("move.")}
    for name in given:
        if name not in MOVE:
            raise SimulationError(f"'{name}' is no setting of a move; there are {', '.join(MOVE)}", name)
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


def _number(given: Mapping[str, Value], name: str) -> float | None:
    setting = given.get(name)
    if setting is None:
        return None
    if isinstance(setting, (bool, str)):
        raise SimulationError(f"{name} is {setting!r}, not a number", name)
    return float(setting)


SCENARIOS: dict[str, Scenario] = {
    "step": Scenario("step", "One commanded move of one axis, from rest to rest", MOVE, _run_step),
}
