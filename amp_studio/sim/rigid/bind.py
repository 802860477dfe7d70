"""Makes the servo of an axis from a parameter file, for every supported family."""

from __future__ import annotations

from collections.abc import Mapping

from amp_studio.sim.axis_parameters import AxisParameters, ParameterValue, ReadParameter

from .law import MotorGains, law_of
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

    ``value(parameter id, instance)`` returns canonical units and choice keys, None for a value that is not set.
    ``overrides`` are values by parameter id (or by a name of the law's settings) that go before those of the
    file; an override that is not used is refused. ``motor_gains`` looks up printed motor tables. Raises
    SimulationError naming the parameter.
    """
    law = law_of(family)
    read = AxisParameters(value, axis, overrides or {})
    servo = law.bind(read, motor_gains)
    read.refuse_unused()
    return servo
