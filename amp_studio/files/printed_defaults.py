"""The printed default of a value, as the manual delivers a control."""

from __future__ import annotations

from functools import lru_cache

from amp_studio.schema import Address, Default, Evaluation, Parameter, Schema, Value, angular, same_value


def default_value(schema: Schema, evaluation: Evaluation, address: Address) -> Value | None:
    """Return the printed default of an instance; None where the manual prints none."""
    parameter = schema.parameters[address[0]]
    if parameter.default is None:
        return None
    return _printed(parameter, parameter.default, address[1], turns=evaluation.turns(address))


@lru_cache(maxsize=65_536)  # every view asks it of every value after every edit
def is_printed(schema: Schema, parameter_id: str, instance: str, turns: bool, value: Value | None) -> bool:
    """Return whether a value is the printed default, on an axis that turns or does not; both may be none."""
    parameter = schema.parameters[parameter_id]
    if parameter.default is None:
        return value is None
    return same_value(value, _printed(parameter, parameter.default, instance, turns=turns))


def _printed(parameter: Parameter, default: Default, instance: str, *, turns: bool) -> Value:
    value = (default.instances or {}).get(instance, default.value)
    if parameter.type == "boolean":
        return Value(value in ("yes", True))
    if isinstance(value, (str, bool)) or parameter.type == "format":
        return Value(str(value))
    unit = angular(default.unit) if turns else default.unit
    return Value(int(value) if parameter.type in ("integer", "bits") else float(value), unit)
