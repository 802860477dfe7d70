"""Units whose size another parameter sets: internal units, the basic length unit.

A value in such a unit keeps it, and is compared in it. What it is in mm or degrees follows from the
``scales`` of the family and from the value of the parameter that sets the size;
a length that is entered instead is counted exactly.
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import NamedTuple

from .address import Address, UnknownParameterError
from .evaluation import Evaluation
from .model import Parameter, UnitSize
from .storage import exact
from .units import UNITS, UnitError, dimension, unit_named, unit_text
from .value import InvalidValueError, Value
from .values import EXACT, checked, choice_key, read_exact, write_number


class Size(NamedTuple):
    """How long one of a unit is here."""

    number: Fraction
    unit: str
    """A length or an angle."""
    set_by: Address

    def text(self) -> str:
        """Return ``0.001 mm``."""
        return f"{write_number(float(self.number))} {unit_text(self.unit)}"


def size_of(evaluation: Evaluation, address: Address, unit: str) -> Size | None:
    """Return the size of a unit for one instance; None for a unit that has none,
    or whose size is not set or known.
    """
    scale = evaluation.schema.family.scales.get(unit)
    if scale is None or (scale.angle is not None and evaluation.scope(address) != "axis"):
        return None  # of a value that no axis has it is not known whether it is a length or an angle
    entry = scale.angle if evaluation.turns(address) else scale.length
    if entry is None:
        return None
    try:
        source = evaluation.reference(entry.param, address[1], evaluation.scope(address)).addresses[0]
    except UnknownParameterError:
        return None
    value = evaluation.value(source)
    if value is None or evaluation.state(source).state == "hidden":
        return None
    found = unit_size(entry, value)
    return Size(*found, source) if found else None


def unit_size(entry: UnitSize, value: Value) -> tuple[Fraction, str] | None:
    """Return the size, with its unit, that a value of the parameter sets: one of the list,
    or the value itself.
    """
    if entry.sizes:
        number = value.value
        key = choice_key(value) if isinstance(number, (str, bool)) else write_number(number)
        text = entry.sizes.get(key, entry.otherwise)
        if text is None:
            return None
        size, unit = read_exact(text)
        return size, unit_named(unit)
    if isinstance(value.value, (str, bool)) or not math.isfinite(value.value) or value.value <= 0:
        return None
    return exact(value.value), value.unit


def real_value(evaluation: Evaluation, address: Address, value: Value | None) -> Value | None:
    """Return what a value in a unit with a size is in mm or degrees, exact before one rounding;
    None for any other.
    """
    if value is None or isinstance(value.value, (str, bool)) or not math.isfinite(value.value):
        return None
    size = size_of(evaluation, address, value.unit)
    if size is None:
        return None
    try:
        return Value(float(exact(value.value) * size.number), size.unit)
    except OverflowError:
        return None


def read_real(evaluation: Evaluation, address: Address, text: str, unit: str) -> Value | None:
    """Read a length or an angle for a parameter in a ``unit`` with a size; None for a text that is none.

    Raises InvalidValueError where it is no whole count of a parameter that takes whole numbers.
    """
    size = size_of(evaluation, address, unit)
    if size is None:
        return None
    try:
        number, rest = read_exact(text)
        named = unit_named(rest)
    except (InvalidValueError, UnitError):
        return None
    if not rest or dimension(named) != dimension(size.unit):
        return None
    count = number * UNITS[named][1] / UNITS[size.unit][1] / size.number
    return _counted(evaluation.schema.parameters[address[0]], text, count, size, unit)


def _counted(parameter: Parameter, text: str, count: Fraction, size: Size, unit: str) -> Value:
    """Return a number of counts as a value; raises InvalidValueError for one that cannot be stored."""
    whole = count.denominator == 1
    # Beyond it a double would round the count, in silence.
    if abs(count) > EXACT or (parameter.type == "integer" and not whole):
        what = "too many" if whole else "no whole number of"
        raise InvalidValueError(
            f"{text.strip()} is {what} {unit_text(unit)}, each {size.text()}: {parameter.name}"
        )
    return checked(parameter, Value(int(count) if parameter.type == "integer" else float(count), unit))
