"""Values as bare figures of a control: in the unit it keeps them in, without the unit's name.

Where a family has a parameter that chooses the unit system (Default Units, inch or metric), a figure is in
the unit of the system that is chosen; where nothing is chosen, in that of the printed default.
"""

from __future__ import annotations

from decimal import Decimal

from amp_studio.files import ParameterFile
from amp_studio.schema import (
    Parameter,
    Schema,
    Value,
    checked,
    exact_number,
    from_stored,
    shown_number,
    stored_unit,
    to_stored,
)


def system_of(file: ParameterFile) -> str:
    """Return the unit system of a file's figures."""
    chooser = file.schema.family.unit_parameter
    chosen = file.get((chooser, "")) if chooser else None
    if chosen is not None and chosen.value in file.schema.family.units:
        return str(chosen.value)
    return default_system(file.schema) or file.header.units


def default_system(schema: Schema) -> str:
    """Return the unit system that is used while none is chosen; empty where the family prints no default."""
    chooser = schema.family.unit_parameter
    default = schema.parameters[chooser].default if chooser else None
    return str(default.value) if default and default.value in schema.family.units else ""


def write_figure(schema: Schema, parameter: Parameter, value: Value, system: str) -> str:
    """Write the bare figure of a value, without an exponent; raises StorageError."""
    number = to_stored(parameter, value, _kept_in(schema, parameter, system))
    if parameter.choices:
        return str(int(number))
    text = format(Decimal(repr(shown_number(parameter, number))), "f")
    return text.rstrip("0").rstrip(".") if "." in text else text


def read_figure(schema: Schema, parameter: Parameter, text: str, system: str) -> Value:
    """Return the value that a bare figure means; raises InvalidValueError."""
    number = exact_number(text)
    return checked(parameter, from_stored(parameter, number, _kept_in(schema, parameter, system)))


def _kept_in(schema: Schema, parameter: Parameter, system: str) -> str:
    """Return the unit of a parameter's figures."""
    return stored_unit(parameter, schema.unit(parameter, system, turns=False))
