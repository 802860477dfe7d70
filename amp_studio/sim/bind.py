"""Makes the servo of an axis from a parameter file, for every supported family."""

from __future__ import annotations

from collections.abc import Mapping

from .law import law_of
from .reading import MotorGains, Readings, Value, ValueOf
from .servo import AxisServo


def axis_servo(
    value: ReadParameter,
    axis: str,
    overrides: Mapping[str, ParameterValue] | None = None,
    *,
    family: str,
    motor_gains: MotorGains | None = None,
) -> AxisServo:
    """Return the servo of an axis.

    ``value(parameter id, instance)`` answers in canonical units and choice keys, None where nothing is set.
    ``overrides`` are values by parameter id (or by a name of the law's settings) that go before those of the
    file; one that plays no part is refused. ``motor_gains`` looks up printed motor tables. Raises
    SimulationError naming the parameter.
    """
    law = law_of(family)
    read = Readings(value, axis, overrides or {})
    servo = law.bind(read, motor_gains)
    read.refuse_unused()
    return servo
