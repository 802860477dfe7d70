"""A value as it is written in a configuration file, and back:
what the programs make of a text (F107 to F180).

A number ends where it is none any more, whatever follows; a word has to be the whole text.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from decimal import Decimal
from functools import lru_cache

from amp_studio.formats import FormatError
from amp_studio.schema import (
    Address,
    Choice,
    InvalidValueError,
    MachineSchema,
    Parameter,
    Schema,
    Value,
    angular,
    checked,
    exact_number,
    from_stored,
    to_stored,
)

UNITS, TYPE = "traj.linear_units", "joint.type"
_REAL = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?")
_WHOLE = re.compile(r"[+-]?(?:0[xX][0-9a-fA-F]+|\d+)")
_BOOLEAN = {"true": "yes", "yes": "yes", "false": "no", "no": "no"}
_OTHER_WORDS = {
    UNITS: {"metric": "metric", "in": "inch", "imperial": "inch"},
    "traj.angular_units": {"deg": "degree", "gon": "grad", "rad": "radian"},
}
"""Words for the choices of units besides their own (emcIniFile.cc 77 to 105)."""
_INCH = (0.0393, 0.0394)
"""A number for the unit of length is units per mm: 1 for mm, 1/25.4 for inches."""
_ROTARY = "ABC"


@lru_cache(maxsize=16)
def addresses_by_name(schema: Schema, machine: str) -> dict[str, Address]:
    """Return ``[JOINT_0]FERROR`` -> its address, for what a version reads."""
    here: MachineSchema = schema.on(machine)
    named = ((here.number(address), address) for address in here.addresses)
    return {name: address for name, address in named if name}


def unit_of(schema: Schema, address: Address, system: str, *, turns: bool) -> str:
    """Return the unit of a bare figure; ``turns`` for one of a joint or an axis in degrees."""
    parameter = schema.parameters[address[0]]
    unit = schema.unit(parameter, system, turns=False)
    return angular(unit) if turns and parameter.quantity else unit


def is_rotary_axis(instance: str) -> bool:
    """Return whether the letter of an axis is one of those that turn (X44)."""
    return instance in _ROTARY and instance != ""


def number_in(parameter: Parameter, text: str) -> str:
    """Return the number at the start of a text, "" where there is none."""
    match = (_REAL if parameter.type == "real" else _WHOLE).match(text)
    return match[0] if match else ""


def read_figure(parameter: Parameter, text: str, unit: str) -> Value:
    """Return the value of a text; raises InvalidValueError for one that LinuxCNC refuses, too."""
    if parameter.type == "text":
        return checked(parameter, Value(text))
    if parameter.choices:
        return _read_choice(parameter, text)
    digits = number_in(parameter, text)
    if not digits:
        raise InvalidValueError("it is no number")
    number = exact_number(digits) if parameter.type == "real" else exact_number(str(_whole(digits)))
    return checked(parameter, from_stored(parameter, number, unit))


def _whole(digits: str) -> int:
    """Return a whole number as C reads it: 0x is hexadecimal, a zero in front octal."""
    sign, digits = (-1 if digits.startswith("-") else 1), digits.lstrip("+-")
    try:
        return sign * int(digits, 16 if digits[:2].casefold() == "0x" else 8 if digits[:1] == "0" else 10)
    except ValueError:
        return 0  # 08: the octal number ends before the 8


def _read_choice(parameter: Parameter, text: str) -> Value:
    choices = parameter.choices or ()
    found = (
        _yes_or_no(choices, text) if parameter.type == "boolean" else _choice_key(parameter, choices, text)
    )
    if found is None:
        raise InvalidValueError(f"it is not one of {', '.join(c.label for c in choices)}")
    return Value(found)


def _yes_or_no(choices: Sequence[Choice], text: str) -> bool | None:
    """Return what a number, or a word where the choices are words, means; None for neither."""
    if digits := _WHOLE.match(text):
        return bool(_whole(digits[0]))
    key = None if choices[0].label.isdecimal() else _BOOLEAN.get(text.casefold())
    return None if key is None else key == "yes"


def _choice_key(parameter: Parameter, choices: Sequence[Choice], text: str) -> str | None:
    """Return the key of a choice by its word or its number; None where there is none."""
    keys = {choice.label.casefold(): choice.key for choice in choices} | _OTHER_WORDS.get(parameter.id, {})
    if (key := keys.get(text.casefold())) is not None:
        return key
    if parameter.id == UNITS and (match := _REAL.match(text)):
        return _unit_system(float(match[0]))
    digits = _WHOLE.match(text) if choices[0].label.isdecimal() else None
    return keys.get(str(_whole(digits[0]))) if digits else None


def _unit_system(per_mm: float) -> str | None:
    """Return the choice that a number of units per mm is."""
    if per_mm == 1.0:
        return "metric"
    return "inch" if _INCH[0] < per_mm < _INCH[1] else None


def _line_text(parameter: Parameter, text: str) -> str:
    """Return a text; raises FormatError for one that a line cannot contain."""
    if re.search(r"[\r\n]|\\$", text) or text != text.strip():
        raise FormatError(f"{parameter.name} is a text that one line cannot contain")
    return text


def write_figure(parameter: Parameter, value: Value, unit: str) -> str:
    """Return the text of a value; raises FormatError for one that a line cannot contain."""
    if parameter.choices:
        key = ("yes" if value.value else "no") if isinstance(value.value, bool) else str(value.value)
        return next((c.label for c in parameter.choices if c.key == key), key.removeprefix("raw:"))
    if parameter.type == "text":
        return _line_text(parameter, str(value.value))
    number = to_stored(parameter, value, unit)
    # Through the shortest text of the float, without an exponent: LinuxCNC reads one, but a person should
    # not have to.
    text = format(Decimal(repr(float(number))) if parameter.type == "real" else Decimal(int(number)), "f")
    return text.rstrip("0").rstrip(".") if "." in text else text
