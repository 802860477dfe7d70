"""From a parameter file to an axis that can be simulated, whatever the family."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from amp_studio.schema import Table

from . import ninepc
from .reading import MotorGains, Readings, Value, ValueOf
from .servo import AxisServo, SimulationError

Binding = Callable[[Readings, MotorGains | None], AxisServo]

BINDINGS: dict[str, Binding] = {"9pc": ninepc.axis_servo}
"""Families whose servo is known."""
MODEL_SETTINGS: dict[str, Mapping[str, str]] = {"9pc": ninepc.MODEL_SETTINGS}
"""Family -> figures that are no parameters and can be given by hand -> what they are."""


def standard_gains(family: str, tables: Mapping[str, Table]) -> MotorGains | None:
    """Return a look-up into the family's printed motor tables; None when it has none."""
    return ninepc.standard_gains(tables) if family == "9pc" else None


def axis_servo(
    value: ValueOf,
    axis: str,
    overrides: Mapping[str, Value] | None = None,
    *,
    family: str = "9pc",
    motor_gains: MotorGains | None = None,
) -> AxisServo:
    """Return the servo of an axis.

    ``value(parameter id, instance)`` answers in canonical units and choice keys, None where nothing is set.
    ``overrides`` are values by parameter id (or by a name of MODEL_SETTINGS) that go before those of the
    file; one that plays no part is refused. ``motor_gains`` looks up printed motor tables. Raises
    SimulationError naming the parameter.
    """
    binding = BINDINGS.get(family)
    if binding is None:
        known = ", ".join(sorted(BINDINGS))
        raise SimulationError(f"the servo of family '{family}' cannot be simulated yet; known: {known}")
    read = Readings(value, axis, overrides or {})
    servo = binding(read, motor_gains)
    read.refuse_unused()
    return servo
