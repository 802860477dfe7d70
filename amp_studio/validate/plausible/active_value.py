"""One active value as the checks of experience compare it: its number in the canonical unit."""

from __future__ import annotations

from typing import NamedTuple

from amp_studio.files import ParameterFile
from amp_studio.schema import ACTIVE, Address, canonical, dimension, show_value


class ActiveValue(NamedTuple):
    """One active value."""

    address: Address
    number: float | str | bool
    measures: str


class ActiveValues(dict[str, dict[str, ActiveValue]]):
    """Parameter -> its active values by instance, in the order of the schema; each looked up once until
    ``clear``.
    """

    def __init__(self, file: ParameterFile) -> None:
        self._file = file

    def __missing__(self, name: str) -> dict[str, ActiveValue]:
        file, values = self._file, self._file.values
        known, here = file.evaluation.known_states(), file.schema.on(file.machine)
        found: dict[str, ActiveValue] = {}
        for instance in here.instances(file.schema.parameters[name]):
            address = name, instance
            value = values.get(address)
            if value is None or (known.get(address) or file.evaluation.state(address)) is not ACTIVE:
                continue
            number = value.value
            if not isinstance(number, bool | str):
                number = float(canonical(number, value.unit))
            found[instance] = ActiveValue(address, number, dimension(value.unit))
        self[name] = found
        return found


def sentence(file: ParameterFile, one: ActiveValue) -> str:
    """Return ``Rapid (1) is 5 mm/min``, as every finding names a value."""
    value = show_value(file.schema.parameters[one.address[0]], file.values[one.address])
    return f"{file.schema.on(file.machine).label(one.address)} is {value}"
