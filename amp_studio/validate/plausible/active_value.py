"""One active value as the checks of experience compare it: its number in the canonical unit."""

from __future__ import annotations

from typing import NamedTuple

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, canonical, dimension, show_value


class ActiveValue(NamedTuple):
    """One active value."""

    address: Address
    number: float | str | bool
    measures: str


def active_values(file: ParameterFile, name: str) -> dict[str, ActiveValue]:
    """Return the active values of a parameter by instance, in the order of the schema."""
    values, state = file.values, file.evaluation.state
    schema, seen = file.schema, {}
    for instance in schema.on(file.machine).instances(schema.parameters[name]):
        value = values.get((name, instance))
        if value is None or not state((name, instance)).is_active:
            continue
        number = value.value
        if not isinstance(number, bool | str):
            number = float(canonical(number, value.unit))
        seen[instance] = ActiveValue((name, instance), number, dimension(value.unit))
    return seen


def sentence(file: ParameterFile, one: ActiveValue) -> str:
    """Return ``Rapid (1) is 5 mm/min``, as every finding names a value."""
    value = show_value(file.schema.parameters[one.address[0]], file.values[one.address])
    return f"{file.schema.on(file.machine).label(one.address)} is {value}"
