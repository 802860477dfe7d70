"""Values as bare figures of a control: in the unit it keeps them in, without the unit's name.

Where a family has a parameter that chooses the unit system (Default Units, inch or metric), a figure is in the unit of
the system that is chosen; where nothing is chosen, in that of the printed default.
"""

from __future__ import annotations

import math
from decimal import Decimal
from fractions import Fraction

from amp_studio.files import ParameterFile
from amp_studio.schema import InvalidValueError, Parameter, Schema, Value, dimension, shown
from amp_studio.schema.quoting import quoted, short
from amp_studio.schema.register_words import WordError, choice_of, code_of, exact
from amp_studio.schema.units import UNITS
from amp_studio.schema.values import checked, exact_number


def system_of(file: ParameterFile) -> str:
    """Return the unit system of a file's figures."""
    chooser = file.schema.family.unit_parameter
    chosen = file.get((chooser, "")) if chooser else None
    if chosen is not None and chosen.value in file.schema.family.units:
        return str(chosen.value)
    return default_system(file.schema) or file.header.units


def default_system(schema: Schema) -> str:
    """Return the unit system that holds while nobody has chosen one; empty where the family prints no default."""
    chooser = schema.family.unit_parameter
    default = schema.parameters[chooser].default if chooser else None
    return str(default.value) if default and default.value in schema.family.units else ""


def write_figure(schema: Schema, parameter: Parameter, value: Value, system: str) -> str:
    """Write the bare figure of a value, without an exponent; raises WordError."""
    if parameter.choices:
        return str(code_of(parameter, value.value))
    if isinstance(value.value, str):
        raise WordError(f"{parameter.name} is a text, which is no figure")
    unit, scale = _kept_in(schema, parameter, system)
    if dimension(value.unit) != dimension(unit):
        raise WordError(
            f"{parameter.name} is kept in {shown(unit) or 'a bare number'}, not in {shown(value.unit) or 'a bare number'}"
        )
    number = float(exact(value.value) * UNITS[value.unit][1] / UNITS[unit][1] * scale)
    if parameter.storage and parameter.storage.decimals is not None:
        number = round(number, parameter.storage.decimals)
    text = format(Decimal(repr(number)), "f")
    return text.rstrip("0").rstrip(".") if "." in text else text


def read_figure(schema: Schema, parameter: Parameter, text: str, system: str) -> Value:
    """Return the value that a bare figure means; raises WordError."""
    unit, scale = _kept_in(schema, parameter, system)
    try:
        number = exact_number(text) / scale
        is_double = math.isfinite(float(number)) and (float(number) != 0 or number == 0)
    except InvalidValueError as error:
        raise WordError(str(error)) from None
    except OverflowError:
        is_double = False
    if not is_double:
        raise WordError(f"{quoted(text)} is no number that a value can be")
    is_whole = number.denominator == 1
    if not is_whole and (parameter.choices or parameter.type in ("integer", "bits")):
        raise WordError(f"{parameter.name} takes whole numbers, not {short(text)}")
    try:
        if parameter.choices:
            return checked(parameter, choice_of(parameter, int(number)))
        return checked(
            parameter, Value(int(number) if parameter.type in ("integer", "bits") else float(number), unit)
        )
    except InvalidValueError as error:
        raise WordError(str(error)) from None


def _kept_in(schema: Schema, parameter: Parameter, system: str) -> tuple[str, Fraction]:
    """Return the unit of a parameter's figures, and the figure of one such unit."""
    storage = parameter.storage
    unit = (
        storage.unit if storage and storage.unit is not None else schema.unit(parameter, system, turns=False)
    )
    return unit, exact(storage.scale) if storage else Fraction(1)
