"""A file of one build on a control of another: setting by setting, by number, and what does not fit is named.

A number means the same setting in every build. What a build does not have (a setting, the bits of an axis in
a mask), or takes in other bounds (a choice it does not know), is listed before anything is sent,
where a sender would stop half-way.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from amp_studio.files import Header, ParameterFile, fitted_axes
from amp_studio.schema import Address, InvalidValueError, Schema, Value, fault, show_value

from .masks import Build, MaskBits, bits_beyond, set_bits, with_bits
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
    header = {**vars(file.header), "extra": dict(file.header.extra), "signature": schema.signature}
    machine = file.machine if file.machine in schema.machines else schema.family.default_machine
    found = ParameterFile(schema, Header(**{**header, "machine": machine}))
    known = addresses_by_number(found.machine_schema)
    no_room = bits_beyond(build_of(file), Build(found.machine_schema, axes), axes_only=True)
    lost: dict[int, dict[int, str]] = {}
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
        # What is hidden is not in the control that the file is of.
        elif file.evaluation.state(address).state != "hidden":
            # A bit of an axis that is not there would be refused, or be that of another option.
            if number in no_room and isinstance(value.value, (int, float)):
                bits = no_room[number]
                text = str(int(value.value))
                if gone := set_bits(text, bits):
                    lost[number] = gone
                cut = replace(value, value=int(with_bits(text, bits, "0")))
                misfits += _set(file, found, address, cut, known.get(number))
            else:
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
    return Fitted(found, tuple(misfits), lost)


def _set(
    file: ParameterFile, found: ParameterFile, address: Address, value: Value, target: Address | None
) -> list[Misfit]:
    parameter = file.schema.parameters[address[0]]
    name, value_text = file.machine_schema.label(address), show_value(parameter, value)
    if target is None:
        return [Misfit(name, value_text, LACKING)]
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
