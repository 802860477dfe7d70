"""A file of one build on a control of another: setting by setting, by number, and what does not fit is named.

A number means the same setting in every build. What a build does not have (a setting, the bits of an axis in
a mask), or takes in other bounds (a choice it does not know), is listed before anything is sent,
where a sender would stop half-way.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from itertools import chain

from amp_studio.files import Header, ParameterFile, fitted_axes
from amp_studio.schema import Address, InvalidValueError, Schema, Value, fault, show_value

from .masks import Build, MaskBits, bits_beyond, set_bits, with_bits
from .settings import addresses_by_number, number_at, text_of_value, value_of_text

_LACKING = "this control does not have the setting"


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
        return self.why == _LACKING

    def __str__(self) -> str:
        return f"{self.name} = {self.value}: {self.why}"


@dataclass(frozen=True)
class Fitted:
    """A file by the schema of another control, and what of it does not fit there.

    ``lost`` are the bits of masks that are set for axes that the control does not have.
    """

    file: ParameterFile
    misfits: tuple[Misfit, ...]
    lost: MaskBits = field(default_factory=dict)


def build_of(file: ParameterFile) -> Build:
    """Return the build that a file is for."""
    return Build(file.machine_schema, fitted_axes(file))


def fit_to(file: ParameterFile, schema: Schema, axes: Sequence[str]) -> Fitted:
    """Return a file with the same settings by another schema, by their numbers;
    ``axes`` are those of the control.
    """
    found = _begun(file, schema)
    known = addresses_by_number(found.machine_schema)
    no_room = bits_beyond(build_of(file), Build(found.machine_schema, axes), axes_only=True)
    lost: dict[int, dict[int, str]] = {}
    misfits: list[Misfit] = []
    read = chain.from_iterable(c.reads.values() for c in schema.family.conditions.values())
    deciding = {text.partition("@")[0] for text in read}
    # First what decides whether others exist and what they are measured in.
    for address, value in sorted(file.values.items(), key=lambda pair: pair[0][0] not in deciding):
        number = number_at(file.machine_schema, address)
        if number is None:
            if address in found.machine_schema.addresses:
                found.set(address, value)
        # What is hidden is not in the control that the file is of.
        elif file.evaluation.state(address).state != "hidden":
            cut, gone = _without(value, no_room.get(number, {}))
            lost |= {number: gone} if gone else {}
            misfits += _set(file, found, address, cut, known.get(number))
    for key, text in file.unknown.items():
        if re.fullmatch(r"\$[0-9]{1,5}", key):
            misfits += _set_text(found, known.get(int(key[1:])), key, text)
        else:
            found.unknown[key] = text
    return Fitted(found, (*misfits, *_refused(found)), lost)


def _begun(file: ParameterFile, schema: Schema) -> ParameterFile:
    """Return a file without values by another schema, with the header of this one."""
    machine = file.machine if file.machine in schema.machines else schema.family.default_machine
    header = {"extra": dict(file.header.extra), "signature": schema.signature, "machine": machine}
    return ParameterFile(schema, Header(**{**vars(file.header), **header}))


def _without(value: Value, bits: dict[int, str]) -> tuple[Value, dict[int, str]]:
    """Return a mask without the bits of axes that are not there, and those of them that were set:
    they would be refused, or be those of another option.
    """
    if not bits or not isinstance(value.value, (int, float)):
        return value, {}
    text = str(int(value.value))
    return replace(value, value=int(with_bits(text, bits, "0"))), set_bits(text, bits)


def _refused(found: ParameterFile) -> list[Misfit]:
    """Return the settings of a file that its control would refuse."""
    return [
        Misfit(found.machine_schema.label(a), show_value(found.schema.parameters[a[0]], v), why)
        for a, v in found.values.items()
        if number_at(found.machine_schema, a) is not None and (why := _why(found, a, v))
    ]


def _set(
    file: ParameterFile, found: ParameterFile, address: Address, value: Value, target: Address | None
) -> list[Misfit]:
    """Set the value of a file in the one that is found; returns why it does not fit, empty where it does."""
    parameter = file.schema.parameters[address[0]]
    name, value_text = file.machine_schema.label(address), show_value(parameter, value)
    if target is None:
        return [Misfit(name, value_text, _LACKING)]
    other = found.schema.parameters[target[0]]
    if other.type == parameter.type and not other.choices and other.type != "bits":
        found.set(target, value)
        return []
    if (
        parameter.type == "boolean" and other.first_axis is not None
    ):  # one input for all axes has become one bit each
        found.set(target, Value((1 << len(fitted_axes(file))) - 1 if value.value else 0))
        return []
    try:
        text = text_of_value(parameter, value, turns=file.evaluation.turns(address))
    except InvalidValueError as error:
        return [Misfit(name, value_text, str(error))]
    return _set_text(found, target, name, text)


def _set_text(found: ParameterFile, target: Address | None, name: str, text: str) -> list[Misfit]:
    """Set a value by its text; returns why it does not fit, empty where it does."""
    if target is None:
        return [Misfit(name, text, _LACKING)]
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
