"""Between the text of a setting, as the control shows and takes it, and the value of a parameter.

$110=500.000   ->   axis.max_rate@X: 500 mm/min
$22=67         ->   homing.cycle: 67 (Enable, Enable single axis commands, Override locks)
$20=1          ->   limits.soft: Yes
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from decimal import Decimal

from amp_studio.files import ParameterFile
from amp_studio.schema import (
    Address,
    InvalidValueError,
    MachineSchema,
    Parameter,
    Schema,
    Value,
    checked,
    exact_number,
    from_stored,
    quoted,
    stored_unit,
    to_figure,
)

_BUILD = "build"
"""The group of what is compiled in."""
_LONGEST = 80
"""Characters of a number; the control shows at most some 20."""


class SettingError(InvalidValueError):
    """A text that is no value of a setting; ``number`` is that of the setting."""

    def __init__(self, number: int, what: str) -> None:
        self.number = number
        super().__init__(f"${number}: {what}")


def number_at(here: MachineSchema, address: Address) -> int | None:
    """Return the number of a setting: 110 of ``$110``; None for what is no setting."""
    found = here.plain_number(address)
    return int(found) if found else None


def addresses_by_number(here: MachineSchema) -> dict[int, Address]:
    """Return number -> address of every setting that the control can have."""
    pairs = ((number_at(here, address), address) for address in here.addresses)
    return {number: address for number, address in pairs if number is not None}


def value_of_text(parameter: Parameter, text: str, *, turns: bool = False) -> Value:
    """Return what the text of a setting means; raises InvalidValueError."""
    if parameter.type == "text":
        return checked(parameter, Value(text))
    if (
        not re.fullmatch(r"[+-]?[0-9]*\.?[0-9]*", text)
        or len(text) > _LONGEST
        or not re.search("[0-9]", text)
    ):
        raise InvalidValueError(f"{quoted(text)} is not a number")
    number = exact_number(text)
    whole = parameter.type != "real"
    if whole and number.denominator != 1:
        raise InvalidValueError(f"{parameter.name} takes whole numbers, not {text}")
    found = from_stored(parameter, number, stored_unit(parameter, turns=turns))
    return checked(parameter, found)


def text_of_value(parameter: Parameter, value: Value, *, turns: bool = False) -> str:
    """Return the text that sets a value: no exponent, in the control's unit; raises StorageError."""
    if parameter.type == "text":
        return str(value.value)
    # Through the shortest text of the float: the firmware reads no exponent.
    text = format(Decimal(repr(to_figure(parameter, value, stored_unit(parameter, turns=turns)))), "f")
    return text.rstrip("0").rstrip(".") if "." in text else text


def values_of_settings(
    schema: Schema, settings: Mapping[int, str], machine: str = ""
) -> tuple[dict[Address, Value], dict[int, str]]:
    """Return the values of settings by number, and those that the schema does not have; raises SettingError.

    Where an axis turns, its figures are degrees: that is a setting too, which is read first.
    """
    file = ParameterFile(schema)
    file.header.machine = machine
    here = file.machine_schema
    known = addresses_by_number(here)
    deciding = {
        read.partition("@")[0] for c in schema.family.conditions.values() for read in c.reads.values()
    }
    # First the settings that decide in which unit others are.
    for number in sorted(settings, key=lambda n: (known.get(n, ("", ""))[0] not in deciding, n)):
        if number not in known:
            continue
        address = known[number]
        parameter = schema.parameters[address[0]]
        try:
            value = value_of_text(parameter, settings[number], turns=file.evaluation.turns(address))
        except InvalidValueError as error:
            raise SettingError(number, str(error)) from None
        file.set(address, value)
    return dict(file.values), {n: text for n, text in settings.items() if n not in known}


def compiled_in(schema: Schema) -> dict[Address, Value]:
    """Return what a control describes of its build, which is no setting: its axes,
    the step rate of its driver.
    """
    here = schema.on(schema.family.default_machine)
    defaults = {(p.id, ""): p.default for g in schema.groups if g.key == _BUILD for p in g.parameters}
    return {
        a: Value(d.value, d.unit) for a, d in defaults.items() if d is not None and number_at(here, a) is None
    }


def settings_of_file(file: ParameterFile, *, padded: bool = False, hidden: bool = False) -> dict[int, str]:
    """Return number -> text of every setting that a file sets and this control has; raises StorageError.

    ``padded`` writes the decimals that the control shows also where they are zeros; ``hidden`` has also
    settings that the control does not list as it is set (``$180`` without Per axis feedrates).
    """
    found = {}
    for address, value in file.values.items():
        number = number_at(file.machine_schema, address)
        if number is not None and (hidden or file.evaluation.state(address).state != "hidden"):
            parameter = file.schema.parameters[address[0]]
            text = text_of_value(parameter, value, turns=file.evaluation.turns(address))
            found[number] = _padded(parameter, text) if padded else text
    return dict(sorted(found.items()))


def _padded(parameter: Parameter, text: str) -> str:
    decimals = parameter.storage.decimals if parameter.storage and parameter.type == "real" else None
    if not decimals:
        return text
    whole, _, fraction = text.partition(".")
    return f"{whole}.{fraction.ljust(decimals, '0')}"
