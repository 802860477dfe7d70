"""A value as other programs read it: a number, yes or no, a text."""

from __future__ import annotations

from amp_studio.schema import Parameter, Value, write_value


def data_of(parameter: Parameter, value: Value | None) -> float | bool | str | None:
    """Return a value as data: the label of a choice, else what it is."""
    if value is None:
        return None
    is_label = isinstance(value.value, str) and parameter.choices is not None
    return write_value(parameter, Value(value.value)) if is_label else value.value
