"""The number a control stores for a value, and back: the code of a choice, or the number in the control's own unit."""

from __future__ import annotations

from .model import Parameter
from .units import UnitError, angular, convert
from .value import InvalidValueError, Value
from .values import read_value, write_number


def stored_number(parameter: Parameter, value: Value, turns: bool) -> float | int | None:
    """Return what the control stores for a value (its patch value); None where the manual prints no form."""
    found = value.value
    if parameter.choices:
        key = ("yes" if found else "no") if isinstance(found, bool) else str(found)
        if key.startswith("raw:"):
            return int(key[4:])
        return next((c.raw for c in parameter.choices if c.key == key), None)
    if isinstance(found, str) or parameter.storage is None:
        return None
    unit = parameter.storage.unit or ""
    try:
        stored = convert(float(found), value.unit, angular(unit) if turns else unit) * parameter.storage.scale
    except UnitError:
        return None
    return stored if parameter.storage.decimals is None else round(stored, parameter.storage.decimals)


def value_of_stored(parameter: Parameter, number: float, turns: bool) -> Value:
    """Return the value that a stored number means: a choice by its code, a number in the unit the control keeps.

    ``turns`` says that the parameter belongs to an axis that turns. Raises InvalidValueError for a fraction where the control
    stores whole numbers.
    """
    is_whole = bool(parameter.choices) or parameter.type in ("integer", "bits")
    if is_whole and number != int(number):
        raise InvalidValueError(f"{parameter.name} takes whole numbers, not {write_number(number)}")
    if parameter.choices:
        code = int(number)
        choice = next((c for c in parameter.choices if c.raw == code), None)
        if choice is None:
            return read_value(parameter, f"raw:{code}", "")
        return Value(choice.key == "yes" if parameter.type == "boolean" else choice.key)
    unit = (parameter.storage.unit if parameter.storage else None) or ""
    return Value(int(number) if is_whole else number, angular(unit) if turns else unit)
