"""The number a control stores for a value: the code of a choice, or the number in the control's own unit."""

from __future__ import annotations

from .model import Parameter
from .units import UnitError, angular, convert
from .values import Value


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
