"""Values tuned in steps, as with {INCRE VALUE} and {DECRE VALUE}: by how much, and where they stop.

The manuals print no size of a step, so it is a person's choice: the last decimal that the control keeps, or
ten, a hundred or a thousand of it. A value stops at the bounds of its range (9/PC, page 36-11).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from fractions import Fraction

from amp_studio.files import ParameterFile
from amp_studio.schema import UNITS, Address, Value, dimension, limits

from .compensation import compensation_of
from .errors import CalibrationError

_USUAL_DECIMALS = {"length": 5, "angle": 5, "time": 3}
"""Where neither the parameter nor the control's memory names any."""
_MIN_DECIMALS = 6
"""Of another quantity that is 0: AcroMill begins with a gain of 0.000001 (page 115)."""
_PART = 100
"""The step that is offered first is at most this part of the value."""


def steps_of(file: ParameterFile, address: Address) -> tuple[Fraction, ...]:
    """Return the steps that are offered for a value, in the unit in which it is shown;
    none for what is no number.
    """
    parameter = file.schema.parameters[address[0]]
    if parameter.type not in ("integer", "real") or parameter.choices:
        return ()
    if parameter.type == "integer":
        return tuple(Fraction(10**n) for n in range(4))
    unit = file.evaluation.unit(address, file.header.units)
    decimals = parameter.decimals
    if decimals is None and parameter.storage is not None:
        decimals = parameter.storage.decimals
    if decimals is None:
        decimals = _decimals_of(file.get(address), dimension(unit))
    return tuple(Fraction(10**n, 10**decimals) for n in range(4))


def usual_step(file: ParameterFile, address: Address) -> Fraction:
    """Return the step that is offered first: some hundredth of the value; of 0 a micrometre, or the smallest
    one of what is no way.
    """
    steps, value = steps_of(file, address), file.get(address)
    if value is None or isinstance(value.value, (str, bool)) or not value.value:
        unit = file.evaluation.unit(address, file.header.units)
        return steps[2 if dimension(unit) in ("length", "angle") else 0]
    return max((step for step in steps if step * _PART <= abs(value.value)), default=steps[0])


def _decimals_of(value: Value | None, quantity: str) -> int:
    """Return decimals for which a step is no multiple of the value: a gain may be a millionth."""
    if value is None or isinstance(value.value, (str, bool)) or not value.value:
        return _USUAL_DECIMALS.get(quantity, _MIN_DECIMALS)
    return max(_USUAL_DECIMALS.get(quantity, 3), 3 - math.floor(math.log10(abs(value.value))))


def stepped(file: ParameterFile, address: Address, by: Fraction) -> Value:
    """Return a value increased by so much in the unit in which it is shown, at most to its bound;
    raises CalibrationError.
    """
    present = file.get(address)
    unit = file.evaluation.unit(address, file.header.units)
    label = file.machine_schema.label(address)
    if present is None or isinstance(present.value, (str, bool)):
        raise CalibrationError(f"{label} is not set: give it a value first")
    # By its text: 0.1 as a binary fraction would show digits that were not entered after ten steps.
    number = Fraction(repr(present.value) if isinstance(present.value, float) else present.value)
    if present.unit != unit and dimension(present.unit) == dimension(unit):
        number *= UNITS[present.unit][1] / UNITS[unit][1]
    # A unit that cannot be converted, as turns to mm without a pitch: the step counts in the value's own.
    elif present.unit != unit:
        unit = present.unit
    number = bounded(file, address, number, number + by, unit)
    whole = file.schema.parameters[address[0]].type == "integer"
    return Value(int(number) if whole else float(number), unit)


def bounded(file: ParameterFile, address: Address, old: Fraction, new: Fraction, unit: str) -> Fraction:
    """Return the new number, or the bound that lies between it and the old one."""
    allowed = limits(file.evaluation, address, unit)
    if allowed is None:
        return new
    low, high = (None if bound is None else Fraction(repr(bound)) for bound in (allowed.low, allowed.high))
    # Only a bound that the step crosses: a value outside of its range already can still be moved.
    if high is not None and new > high >= old:
        return high
    return low if low is not None and new < low <= old else new


def with_followers(
    file: ParameterFile, values: Mapping[Address, Value | None]
) -> dict[Address, Value | None]:
    """Return values together with those that the control changes by itself when these are tuned on line."""
    follow = compensation_of(file.schema.family.family).follow
    found = dict(values)
    for address in values:
        if address[0] in follow and file.get(address) != values[address]:
            name, text = follow[address[0]]
            for instance in file.machine_schema.instances(file.schema.parameters[name]):
                # What a person sets at the same time counts more than what would follow.
                if instance in ("", address[1]) and (name, instance) not in values:
                    found[name, instance] = file.read((name, instance), text)
    return found
