"""Values of parameters: how a person writes them, and how they are written back."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from .model import Parameter
from .units import UnitError, dimension, shown, unit_named


@dataclass(frozen=True, slots=True)
class Value:
    """One value in the unit it was entered in.

    ``value`` is a float or int, the key of a choice, a bool for a yes/no
    parameter, or a text. A choice for which the control holds a code that the
    database does not know is kept as ``raw:<code>``.
    """

    value: float | bool | str
    unit: str = ""


class ValueFault(ValueError):
    """A value that cannot be read; the text is one clear sentence."""


_NUMBER = re.compile(r"^\s*([+-]?[0-9.,' _]*[0-9][0-9.,]*(?:[eE][+-]?[0-9]+)?)\s*(.*)$")


def read_number(text: str) -> tuple[float, str]:
    """Read a number with decimal point or comma, and what follows it.

    A comma that could be either (``1,234``) is refused rather than guessed.
    Returns the number and the rest of the text; raises ValueFault.
    """
    found = _NUMBER.match(text)
    if not found:
        raise ValueFault(f"'{text.strip()}' is not a number")
    digits, rest = found.group(1).replace("'", "").replace("_", "").replace(" ", ""), found.group(2)
    if "," in digits and "." in digits:
        decimal = max(digits.rfind(","), digits.rfind("."))
        whole, fraction = digits[:decimal], digits[decimal + 1 :]
        group = "," if digits[decimal] == "." else "."
        if digits[decimal] in whole or not re.fullmatch(rf"[+-]?\d{{1,3}}(\{group}\d{{3}})+", whole):
            raise ValueFault(f"'{digits}' is not a number")
        digits = whole.replace(group, "") + "." + fraction
    elif "," in digits:
        if digits.count(",") > 1:
            if not re.fullmatch(r"[+-]?\d{1,3}(,\d{3})+", digits):
                raise ValueFault(f"'{digits}' is not a number")
            digits = digits.replace(",", "")
        elif re.fullmatch(r"[+-]?[1-9]\d{0,2},\d{3}", digits):
            plain = digits.replace(",", "")
            raise ValueFault(f"'{digits}' can be read two ways: write {plain} or {digits.replace(',', '.')}")
        else:
            digits = digits.replace(",", ".")
    try:
        number = float(digits)
    except ValueError:
        raise ValueFault(f"'{digits}' is not a number") from None
    if not math.isfinite(number):
        raise ValueFault(f"'{digits}' is not a finite number")
    return number, rest


def read_value(parameter: Parameter, text: str, unit: str) -> Value:
    """Read what a person or a file says of a parameter.

    ``unit`` is the unit of entry when the text names none. A choice is given by
    label, letter, key or ``raw:<code>``; a yes/no also by yes, no, true, false.
    Raises ValueFault with one sentence that tells what is allowed.
    """
    text = text.strip()
    if parameter.type == "text":
        return Value(text)
    if parameter.choices:
        return _read_choice(parameter, text)
    if parameter.type in ("bits", "integer") and re.fullmatch(r"(0x|\$)[0-9a-fA-F]+", text):
        return Value(int(text.lstrip("$").removeprefix("0x"), 16), unit)
    number, rest = read_number(text)
    if rest:
        try:
            named = unit_named(rest)
        except UnitError as error:
            raise ValueFault(f"{error}; {parameter.name} is given in {shown(unit) or 'a bare number'}") from None
        if dimension(named) != dimension(unit):
            raise ValueFault(f"{parameter.name} is given in {shown(unit) or 'a bare number'}, not in {shown(named)}")
        unit = named
    if parameter.type in ("integer", "bits"):
        if number != int(number):
            raise ValueFault(f"{parameter.name} takes whole numbers, not {write_number(number)}")
        return Value(int(number), unit)
    return Value(number, unit)


def _read_choice(parameter: Parameter, text: str) -> Value:
    choices = parameter.choices or ()
    yes_no = parameter.type == "boolean"
    word = text.casefold()
    if word.startswith("raw:"):
        try:
            raw = int(text[4:])
        except ValueError:
            raise ValueFault(f"'{text}' is not 'raw:' and a whole number") from None
        for choice in choices:
            if choice.raw == raw:
                return Value(choice.key == "yes" if yes_no else choice.key)
        return Value(f"raw:{raw}")
    squeezed = re.sub(r"\s+", " ", word)
    for field in ("label", "code", "key"):
        for choice in choices:
            said = getattr(choice, field)
            if said is not None and said.casefold() == squeezed:
                return Value(choice.key == "yes" if yes_no else choice.key)
    if yes_no and word in ("true", "yes", "on", "1", "false", "no", "off", "0"):
        return Value(word in ("true", "yes", "on", "1"))
    offered = ", ".join(f"{c.label} ({c.code})" if c.code else c.label for c in choices)
    raise ValueFault(f"'{text}' is not a choice of {parameter.name}: {offered}")


def write_number(number: float) -> str:
    """Write a number by its shortest text that reads back exactly."""
    if isinstance(number, int):
        return str(number)
    if number == int(number) and abs(number) < 1e15:
        return str(int(number))
    return repr(number)


def write_value(parameter: Parameter, value: Value | None) -> str:
    """Write a value so that ``read_value`` gives it back; an unset one is empty."""
    if value is None:
        return ""
    if isinstance(value.value, str):
        return label_of(parameter, value.value)
    if isinstance(value.value, bool):
        return label_of(parameter, "yes" if value.value else "no")
    number = write_number(value.value)
    return f"{number} {value.unit}" if value.unit else number


def show_value(parameter: Parameter, value: Value | None) -> str:
    """Write a value for a person: as ``write_value`` with the unit's proper signs; a dash when unset."""
    if value is None:
        return "—"
    if isinstance(value.value, (str, bool)):
        return write_value(parameter, value)
    number = write_number(value.value)
    unit = shown(value.unit)
    return f"{number}{unit}" if unit in ("°",) else f"{number} {unit}" if unit else number


def label_of(parameter: Parameter, key: str) -> str:
    """Return the label of a choice key; a text or a raw code stays as it is."""
    for choice in parameter.choices or ():
        if choice.key == key:
            return choice.label
    return key
