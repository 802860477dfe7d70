"""What a family brings so that its axes can be simulated, found by its registration."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from amp_studio.schema import Table
from amp_studio.schema.registration import load_part, registration_of
from amp_studio.sim.axis_parameters import AxisParameters
from amp_studio.sim.errors import SimulationError

from .servo import AxisServo

MotorGains = Callable[[str, str], tuple[float, float] | None]
"""gains(motor type, load inertia ratio) -> (velocity proportional gain, velocity integral gain), or None."""
Binding = Callable[[AxisParameters, MotorGains | None], AxisServo]


def _no_gains(_tables: Mapping[str, Table]) -> MotorGains | None:
    return None


@dataclass(frozen=True)
class Law:
    """From the parameters of an axis to its servo.

    ``bind``            the servo of an axis; raises SimulationError naming the parameter
    ``settings``        figures that are no parameters and can be given by hand -> what they are
    ``standard_gains``  a look-up into the printed motor tables; None when the family has none
    """

    bind: Binding
    settings: Mapping[str, str]
    standard_gains: Callable[[Mapping[str, Table]], MotorGains | None] = _no_gains


def law_of(family: str) -> Law:
    """Return the law of a family's axes; raises SimulationError where it is not known."""
    place = registration_of(family).law
    if not place:
        raise SimulationError(f"the servo of family '{family}' cannot be simulated yet")
    found = load_part(place)
    assert isinstance(found, Law)
    return found
