"""A file of one build on a control of another: setting by setting, by number, and what does not fit is named.

A number means the same setting in every build. What a build does not have, or takes in other bounds (a mask with an axis too
many, a choice it does not know), is listed before anything is sent, where a sender would stop half-way.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from amp_studio.files import Header, ParameterFile
from amp_studio.schema import Address, InvalidValueError, Schema, Value, fault, show_value

from .settings import addresses_by_number, number_at, text_of_value, value_of_text

LACKING = "this control does not have the setting"


@dataclass(frozen=True)
class Misfit:
    """A value of a file that a control cannot get."""

    name: str
    """``$140 Motor current``."""
    value: str
    why: str

    @property
    def is_lacking(self) -> bool:
        """Whether the control does not have it at all."""
        return self.why == LACKING

    def __str__(self) -> str:
        return f"{self.name} = {self.value}: {self.why}"


@dataclass(frozen=True)
class Fitted:
    """A file by the schema of another control, and what of it does not fit there."""

    file: ParameterFile
    misfits: tuple[Misfit, ...]


def fit_to(file: ParameterFile, schema: Schema) -> Fitted:
    """Return a file with the same settings by another schema, by their numbers."""
    header = {**vars(file.header), "extra": dict(file.header.extra), "signature": schema.signature}
    machine = file.machine if file.machine in schema.machines else schema.family.default_machine
    found = ParameterFile(schema, Header(**{**header, "machine": machine}))
    known = addresses_by_number(found.machine_schema)
    misfits: list[Misfit] = []
    given = [(address, value) for address, value in file.values.items()]
    # First what decides whether others exist and what they are measured in.
    deciding = {
        text.partition("@")[0] for c in schema.family.conditions.values() for text in c.reads.values()
    }
    for address, value in sorted(given, key=lambda pair: pair[0][0] not in deciding):
        number = number_at(file.machine_schema, address)
        if number is None:
            if address in found.machine_schema.addresses:
                found.set(address, value)
        elif file.evaluation.state(address).state != "hidden":
            misfits += _set(file, found, address, value, known.get(number))
    for key, text in file.unknown.items():
        number = int(key[1:]) if re.fullmatch(r"\$[0-9]{1,5}", key) else None
        if number is None:
            found.unknown[key] = text
        else:
            misfits += _set_text(found, known.get(number), key, text)
    misfits += [
        Misfit(found.machine_schema.label(a), show_value(schema.parameters[a[0]], v), why)
        for a, v in found.values.items()
        if number_at(found.machine_schema, a) is not None and (why := _why(found, a, v))
    ]
    return Fitted(found, tuple(misfits))


def _set(
    file: ParameterFile, found: ParameterFile, address: Address, value: Value, target: Address | None
) -> list[Misfit]:
    parameter = file.schema.parameters[address[0]]
    name, shown = file.machine_schema.label(address), show_value(parameter, value)
    if target is None:
        return [Misfit(name, shown, LACKING)]
    other = found.schema.parameters[target[0]]
    if other.type == parameter.type and not other.choices and other.type != "bits":
        found.set(target, value)
        return []
    try:
        text = text_of_value(parameter, value, turns=file.evaluation.turns(address))
    except InvalidValueError as error:
        return [Misfit(name, shown, str(error))]
    return _set_text(found, target, name, text)


def _set_text(found: ParameterFile, target: Address | None, name: str, text: str) -> list[Misfit]:
    if target is None:
        return [Misfit(name, text, LACKING)]
    try:
        value = value_of_text(found.schema.parameters[target[0]], text, turns=found.evaluation.turns(target))
    except InvalidValueError as error:
        return [Misfit(name, text, str(error))]
    found.set(target, value)
    return []


def _why(found: ParameterFile, address: Address, value: Value) -> str:
    """Return why a control does not take a value that its schema has a place for; empty where it does."""
    state = found.evaluation.state(address)
    if state.state == "hidden":
        return f"this control does not have it as it is set: {state.why}"
    return fault(found.evaluation, address, value) or ""
