"""Settings of a scenario and of the machine as a person writes them: ``50 mm``, ``0.5 s``, ``linear``.

The unit of a setting is in its description, in brackets: "(mm or deg)", "(s)".
A number without a unit is in that unit.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from numbers import Real

from amp_studio.schema import UNITS, InvalidValueError, canonical, dimension, read_number, unit_named

from .axis_parameters import ParameterValue
from .errors import SimulationError
from .unit_system import own_unit

_BRACKETS = re.compile(r"\(([^()]*)\)")
_ANGULAR = {"mm": "deg", "mm/min": "deg/min", "mm/s2": "deg/s2"}


def units_of(description: str) -> tuple[str, ...]:
    """Return the units that a description names."""
    units = [part for found in _BRACKETS.findall(description) for part in found.split(" or ")]
    # Brackets of a description hold other words too; the unit of the torque is the law's own.
    return tuple(unit for part in units if (unit := part.removesuffix(" per torque")) in UNITS)


def read_settings(
    given: Mapping[str, ParameterValue], known: Mapping[str, str], unit: str = "mm"
) -> tuple[dict[str, ParameterValue], dict[str, str]]:
    """Return the settings as numbers in their units, other texts as they are;
    and the unit that each was written in.

    ``known`` are the descriptions; a length without a unit is in the ``unit`` of the axis. Raises
    SimulationError for a unit that does not fit.
    """
    values: dict[str, ParameterValue] = {}
    written: dict[str, str] = {}
    for name, value in given.items():
        if not (value is None or isinstance(value, str) or _is_number(value)):
            raise SimulationError(f"{name} is {value!r:.80}, not a number", name)
        values[name], units = value, units_of(known.get(name, ""))
        number, rest = _number_and_unit(value)
        if not isinstance(number, float):
            continue  # a word, as of a ramp, or what a sweep varies
        values[name] = number
        if rest.strip():
            values[name], written[name] = _converted(name, number, rest, units, unit)
        # A bare number is in the length of the person's unit system; inside everything is in mm.
        elif unit == "in" and units and units[0] in _ANGULAR:
            values[name] = canonical(number, own_unit(units[0], unit))
    return values, written


def _is_number(value: object) -> bool:
    """Return whether a value is a number that a float can be."""
    try:
        float(value if isinstance(value, Real) else "none")
    except (OverflowError, ValueError):
        return False
    return True


def _number_and_unit(value: ParameterValue) -> tuple[ParameterValue, str]:
    """Return the number that a text begins with, and the rest; the value itself where it has none."""
    # With an equals sign it is what a sweep varies, and is read there.
    if not isinstance(value, str) or "=" in value:
        return value, ""
    try:
        return read_number(value)
    except InvalidValueError:
        return value, ""


def _converted(name: str, number: float, unit: str, units: tuple[str, ...], length: str) -> tuple[float, str]:
    """Return a number in the one of ``units`` that fits, and that unit."""
    try:
        own = unit_named(unit)
    except ValueError as error:
        raise SimulationError(f"{name}: {error}", name) from None
    for wanted in units:
        if dimension(wanted) == dimension(own):
            return canonical(number, own) / canonical(1.0, wanted), wanted
    takes = (
        f"in {' or '.join(own_unit(each, length) for each in units)}"
        if units
        else "as a number without a unit"
    )
    raise SimulationError(f"{name} is given in {own}; give it {takes}", name)


def refuse_other_unit(written: Mapping[str, str], axis: str, unit: str) -> None:
    """Raise SimulationError for a length given to an axis that turns, or an angle to one that does not."""
    for name, used in written.items():
        turns, moves = used in _ANGULAR.values(), used in _ANGULAR
        if (turns and unit != "deg") or (moves and unit == "deg"):
            other = f"{unit}{used[3 if turns else 2 :]}"
            raise SimulationError(
                f"{name} is given in {used}, and axis {axis} moves in {unit}: give it in {other}", name
            )
