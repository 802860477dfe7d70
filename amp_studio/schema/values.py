"""Values of parameters: how a person writes them, and how they are written back."""

from __future__ import annotations

import math
import re
import sys
from collections.abc import Iterable
from decimal import Decimal
from fractions import Fraction

from .bit_fields import no_label, word_of_labels
from .model import Choice, Parameter
from .quoting import quoted, short
from .units import UNITS, UnitError, dimension, unit_named, unit_text
from .value import LONGEST_NUMBER, InvalidValueError, Value, plain
from .visible_text import visible

MASKED = "•••• (secret)"
"""The text shown instead of a secret value unless it is requested in clear; never read as a value."""


def is_mask(parameter: Parameter, text: str) -> bool:
    """Return whether a text is what is shown in place of a secret,
    so that an export that comes back changes nothing.
    """
    return parameter.secret and text.strip().startswith("••••")


def not_readable(parameter: Parameter, error: ValueError) -> str:
    """Return why a text is no value of a parameter; what was written for a secret is not repeated."""
    if not parameter.secret:
        return str(error)
    kind = {"integer": "a whole number", "real": "a number"}.get(parameter.type, "a text")
    return f"{parameter.name} takes {kind}; the value given is secret and not shown"


# A blank, ' or _ belongs to the number only before a digit: ``12 mm`` ends at the blank.
_NUMBER = re.compile(r"\s*([+-]?[0-9.,](?:[0-9.,]|[ '_](?=[0-9]))*)((?:[eE][+-]?[0-9]+)?)\s*(.*)$")
_GROUPED = re.compile(r"[+-]?[0-9]{1,3}([ '_])[0-9]{3}(?:\1[0-9]{3})*(?:[.,][0-9]+)?")
EXACT = 2**53 - 1
"""Largest whole number up to which a double is exact."""
_LARGEST = sys.float_info.max
_PLAIN: tuple[type[bool] | type[int] | type[float] | type[str], ...] = (bool, int, float, str)
"""Types of what a file contains; what is made after one of them (numpy.float64) becomes it."""
_LONGEST_TEXT = 100_000
"""Characters of a text; the longest there are is a table of ballscrew compensation."""
_RAW = re.compile(r"[+-]?[0-9]{1,16}")
_NOT_ZERO = re.compile(r"[^eE]*[1-9]")
_SHOWN = str.maketrans("\u2212\u202f", "- ")
"""A minus and the space between groups of digits, as a window and a PDF have them: what is copied is read."""
# Half characters of UTF-16, and two that Unicode keeps out of texts: YAML and XML have no form for them.
_UNWRITABLE = re.compile("[\ud800-\udfff\ufffe\uffff]")


def read_number(text: str) -> tuple[float, str]:
    """Read a number with decimal point or comma, and what follows it.

    Groups of three digits may be set apart (``12 345.6``, ``12'345.6``). A comma
    that could be either (``1,234``) is refused rather than guessed.
    Returns the number and the rest of the text; raises InvalidValueError.
    """
    digits, rest = _digits(text)
    number = float(digits)
    if not math.isfinite(number):
        raise InvalidValueError(f"{quoted(digits)} is too large")
    if number == 0 and _NOT_ZERO.match(digits):  # no Decimal: it does not take every exponent
        raise InvalidValueError(f"{quoted(digits)} is too small")
    return number, rest


def read_bare_number(text: str, *units: str) -> float:
    """Read a number of something that has its unit already, which may be written behind it; raises
    InvalidValueError for another one: ``5 in`` are no 5 mm.
    """
    number, rest = read_number(text.strip())
    if rest.strip() not in ("", *units):
        raise InvalidValueError(f"{quoted(text.strip())} is no bare number")
    return number


def _digits(text: str) -> tuple[str, str]:
    """Return a number with decimal point and exponent as Python writes it, and what follows;
    raises InvalidValueError.
    """
    if len(text) > LONGEST_NUMBER:
        raise InvalidValueError(f"{quoted(text)} is too long for a number")
    text = text.translate(_SHOWN)
    match = _NUMBER.match(text)
    if not match:
        raise InvalidValueError(f"{quoted(text.strip())} is not a number")
    digits, exponent, rest = match.groups()
    if _GROUPED.fullmatch(digits):
        digits = re.sub("[ '_]", "", digits)
    elif " " in digits:  # "3000 1/min": what comes after the blank is no part of the number
        digits, _, tail = digits.partition(" ")
        exponent, rest = "", tail + text[match.end(1) :]
    number = _decimal(digits, exponent)
    # No exponent makes more of zero; Decimal would not take one of twenty digits.
    return (number if _NOT_ZERO.match(number) else number.lower().partition("e")[0]), rest


def _decimal(digits: str, exponent: str) -> str:
    """Return the number that digits with points and commas mean, with a decimal point;
    raises InvalidValueError.
    """
    if "," in digits and "." in digits:
        decimal = max(digits.rfind(","), digits.rfind("."))
        whole, fraction = digits[:decimal], digits[decimal + 1 :]
        group = "," if digits[decimal] == "." else "."
        digits = f"{_without_groups(whole, group, digits)}.{fraction}"
    elif digits.count(",") > 1:
        digits = _without_groups(digits, ",", digits)
    elif re.fullmatch(r"[+-]?[1-9]\d{0,2},\d{3}", digits):
        # With one decimal more, which can be read one way only, whichever sign the language writes.
        ways = [digits.replace(",", "") + exponent, digits.replace(",", ".") + "0" + exponent]
        raise InvalidValueError(f"'{digits}{exponent}' can be read two ways: write {ways[0]} or {ways[1]}")
    else:
        digits = digits.replace(",", ".")
    try:
        if "_" in digits:
            raise ValueError  # Python reads 1_0 as 10
        float(digits + exponent)
    except ValueError:
        raise InvalidValueError(f"{quoted(digits + exponent)} is not a number") from None
    return digits + exponent


def _without_groups(whole: str, group: str, digits: str) -> str:
    """Return a whole number without the character between its groups of three; raises InvalidValueError."""
    if not re.fullmatch(rf"[+-]?\d{{1,3}}(\{group}\d{{3}})+", whole):
        raise InvalidValueError(f"{quoted(digits)} is not a number")
    return whole.replace(group, "")


def read_value(parameter: Parameter, text: str, unit: str) -> Value:
    """Read the value of a parameter from a text of a person or a file.

    ``unit`` is the unit of entry when the text names none. A choice is given by
    label, letter, key or ``raw:<code>``; a yes/no also by yes, no, true, false.
    Raises InvalidValueError with a message that contains what is allowed.
    """
    if is_mask(parameter, text):
        raise InvalidValueError(f"{parameter.name}: '{MASKED}' is shown in place of a secret and is no value")
    try:
        return _checked(parameter, _read(parameter, text.strip(), unit))
    except InvalidValueError as error:
        raise InvalidValueError(not_readable(parameter, error)) from None


def checked(parameter: Parameter, value: Value) -> Value:
    """Return a value that a file can contain: written, and read back as the same;
    raises InvalidValueError for any other.

    Every value passes here that is made of something from outside: a text, a number of a control, a journal.
    """
    try:
        return _checked(parameter, value)
    except InvalidValueError as error:
        raise InvalidValueError(not_readable(parameter, error)) from None


def _checked(parameter: Parameter, value: Value) -> Value:
    """Return a value in the form of its type; raises InvalidValueError, with the value itself in the
    message.
    """
    found = value.value
    if type(found) not in _PLAIN:  # a number or text of another library
        value = Value(next(kind(found) for kind in _PLAIN if isinstance(found, kind)), value.unit)
        found = value.value
    if isinstance(found, str):
        return _checked_text(parameter, value, found)
    is_of_type = parameter.type not in ("choice", "text", "format")
    if not is_of_type or isinstance(found, bool) != (parameter.type == "boolean"):
        raise InvalidValueError(f"{found} is no value of {parameter.name}")
    if isinstance(found, bool):
        return value
    if value.unit not in UNITS:
        raise InvalidValueError(f"{quoted(value.unit)} is not a unit")
    if not -_LARGEST <= found <= _LARGEST:  # math.isfinite takes no integer of so many digits
        number = found if isinstance(found, float) else "An integer of so many digits"
        raise InvalidValueError(f"{number} is not a number that {parameter.name} can have")
    if parameter.type in ("integer", "bits"):
        return Value(_whole_number(parameter, found), value.unit)
    return Value(0.0, value.unit) if found == 0 else value  # there is no -0


def _whole_number(parameter: Parameter, number: float) -> int:
    """Return a number as the whole one that it is; raises InvalidValueError for a fraction, and for one
    beyond what a double has exactly.
    """
    if number != int(number):
        raise InvalidValueError(f"{parameter.name} takes whole numbers, not {write_number(number)}")
    if abs(number) > EXACT:
        raise InvalidValueError(f"{short(write_number(number))} is too large for {parameter.name}")
    return int(number)


def _checked_text(parameter: Parameter, value: Value, found: str) -> Value:
    """Return a text, a format or a choice as it is stored; raises InvalidValueError."""
    if parameter.type in ("integer", "real", "bits"):
        raise InvalidValueError(f"{parameter.name} is a number, and {quoted(found)} is none")
    if len(found) > _LONGEST_TEXT:
        raise InvalidValueError(
            f"{parameter.name} has {len(found):,} characters, and {_LONGEST_TEXT:,} are the most"
        )
    if odd := _UNWRITABLE.search(found):
        raise InvalidValueError(
            f"{parameter.name} contains the character U+{ord(odd[0]):04X}, which no file can contain"
        )
    if parameter.type == "format":
        return _read_format(parameter, found)
    if parameter.choices is None:
        return value
    if parameter.type != "boolean" and any(choice.key == found for choice in parameter.choices):
        return value
    return _read_raw(parameter, found) if found.startswith("raw:") else _read_choice(parameter, found)


def _read(parameter: Parameter, text: str, unit: str) -> Value:
    """Read a text as the type of its parameter has it; raises InvalidValueError."""
    if parameter.type == "text":
        return Value(text)
    if parameter.choices:
        return _read_choice(parameter, text)
    if parameter.type == "format":
        return _read_format(parameter, text)
    return _read_figure(parameter, text, unit)


def _read_figure(parameter: Parameter, text: str, unit: str) -> Value:
    """Read a number, or the labels of the bits of a word."""
    if len(text) > LONGEST_NUMBER:
        raise InvalidValueError(f"{quoted(text)} is too long for a number")
    text = text.translate(_SHOWN)
    is_whole = parameter.type in ("integer", "bits")
    if is_whole and (hexadecimal := re.fullmatch(r"(?:0[xX]|\$)([0-9a-fA-F]+)", text)):
        return Value(int(hexadecimal[1], 16), unit)
    if parameter.bits and not text.isdecimal() and (word := _labelled(parameter, text)) is not None:
        return Value(word, unit)
    if _is_hex(parameter):
        _refuse_ambiguous(text)
    number, behind = read_number(text)
    unit = _unit_entered(parameter, behind, unit) if behind else unit
    if is_whole:
        _refuse_rounded(parameter, text, number)
    return Value(number, unit)


def _refuse_rounded(parameter: Parameter, text: str, number: float) -> None:
    """Raise InvalidValueError for a number beyond what a double stores: 2 ** 53 + 1, or a half that would be
    rounded away.
    """
    exact = Decimal(_digits(text)[0])
    if exact != number:
        size = "too large for" if exact == exact.to_integral_value() else "no whole number, which is taken by"
        raise InvalidValueError(f"{quoted(text)} is {size} {parameter.name}")


def _refuse_ambiguous(text: str) -> None:
    """Refuse the digits of a hexadecimal word without a sign of their notation: a control and its manual
    write 00000044 for the bits 2 and 6. Raises InvalidValueError.
    """
    if not re.fullmatch("[0-9a-fA-F]+", text):
        return
    if not text.isdecimal():
        raise InvalidValueError(f"{quoted(text)} is not a decimal number: write 0x{short(text)}")
    if text.startswith("0") and int(text, 16) != int(text):
        raise InvalidValueError(
            f"{quoted(text)} can be read two ways: write 0x{short(text)} or {short(str(int(text)))}"
        )


def _unit_entered(parameter: Parameter, text: str, usual: str) -> str:
    """Return the unit that was entered; raises InvalidValueError for one that measures something else."""
    wanted = f"{parameter.name} is given in {unit_text(usual) or 'a bare number'}"
    try:
        named = unit_named(text)
    except UnitError as error:
        raise InvalidValueError(f"{error}; {wanted}") from None
    if dimension(named) != dimension(usual):
        raise InvalidValueError(f"{wanted}, not in {unit_text(named)}")
    return named


def read_exact(text: str) -> tuple[Fraction, str]:
    """Read a number as ``read_number`` does, exactly; returns it and the rest of the text.
    Raises InvalidValueError.
    """
    number, rest = read_number(text)
    return Fraction(Decimal(_digits(text)[0])) if number else Fraction(0), rest


def exact_number(text: str) -> Fraction:
    """Return the number that bare digits with a decimal point mean, exactly; raises InvalidValueError.

    Its exponent is that of a double at most, so that it stays a number that can be worked with.
    """
    number, rest = read_number(text)
    if rest:
        raise InvalidValueError(f"{quoted(text)} is not a number")
    return Fraction(Decimal(text)) if number else Fraction(0)


def _labelled(parameter: Parameter, text: str) -> int | None:
    """Return the word that the labels of its bits mean; None for what may be a number.
    Raises InvalidValueError.
    """
    word = word_of_labels(parameter, text)
    if word is None and not re.match("[+-]?[0-9.,]|[0-9a-fA-F]+$", text):
        raise InvalidValueError(no_label(parameter, text))
    return word


def _is_hex(parameter: Parameter) -> bool:
    """Return whether the control shows the word in hexadecimal."""
    return (
        parameter.type in ("bits", "integer")
        and parameter.storage is not None
        and parameter.storage.notation == "hex"
    )


def _read_format(parameter: Parameter, text: str) -> Value:
    """Read a word format, digits before and behind the point:
    6.0 and 3.10 are no fractions and stay as they are.
    """
    match = re.fullmatch(r"([0-9]{1,2})[.,]([0-9]{1,2})", text)
    if not match:
        raise InvalidValueError(
            f"{quoted(text)} is not a format: {parameter.name} takes digits before and behind the point,"
            " as 3.4"
        )
    return Value(f"{int(match[1])}.{int(match[2])}")


def digits_of(form: str) -> tuple[int, int]:
    """Return the digits before and behind the point of a word format."""
    whole, _, decimals = form.partition(".")
    return int(whole), int(decimals or 0)


def _named_choice(choices: Iterable[Choice], text: str) -> Choice | None:
    """Return the choice with this label, else that with this code, else that with this key."""
    # Field by field over all choices: the letter of one may be the label of another, and labels are what
    # is shown.
    for field in ("label", "code", "key"):
        for choice in choices:
            name = getattr(choice, field)
            if name is not None and plain(name) == plain(text):
                return choice
    return None


def _read_choice(parameter: Parameter, text: str) -> Value:
    """Read a choice by any of its names, a yes/no by yes, true, on and 1 too; raises InvalidValueError."""
    choices = parameter.choices or ()
    yes_no = parameter.type == "boolean"
    word = text.casefold()
    if word.startswith("raw:"):
        return _read_raw(parameter, text)
    if choice := _named_choice(choices, text):
        return choice_value(parameter, choice)
    if yes_no and word in ("true", "yes", "on", "1", "false", "no", "off", "0"):
        return Value(word in ("true", "yes", "on", "1"))
    offered = ", ".join(f"{c.label} ({c.code})" if c.code else c.label for c in choices)
    raise InvalidValueError(f"{quoted(text)} is not a choice of {parameter.name}: {offered}")


def _read_raw(parameter: Parameter, text: str) -> Value:
    """Read a choice by what the control stores, ``raw:-1``;
    a code that is not one of the parameter's is kept.
    """
    if not _RAW.fullmatch(digits := text[4:].strip()) or abs(raw := int(digits)) > EXACT:
        raise InvalidValueError(f"{quoted(text)} is not 'raw:' and a whole number")
    for choice in parameter.choices or ():
        if choice.raw == raw:
            return choice_value(parameter, choice)
    return Value(f"raw:{raw}")


def choice_value(parameter: Parameter, choice: Choice) -> Value:
    """Return the value that a choice is: its key, or for a yes/no parameter a bool."""
    return Value(choice.key == "yes" if parameter.type == "boolean" else choice.key)


def choice_key(value: Value) -> str:
    """Return the key of the choice that a value is, or ``raw:<code>``."""
    return ("yes" if value.value else "no") if isinstance(value.value, bool) else str(value.value)


def write_number(number: float) -> str:
    """Write a number by its shortest text that reads back exactly."""
    if isinstance(number, int):
        return str(number)
    if number.is_integer() and abs(number) < 1e15:
        return str(int(number))
    return repr(number)


_FIGURE_DIGITS = 6
"""Digits that matter of a calculated number, for a person."""


def write_figure(number: float) -> str:
    """Write a calculated number for a person: six digits that matter, and every digit of its whole part."""
    if isinstance(number, int) or not math.isfinite(number):
        return write_number(number)
    whole_digits = len(str(int(abs(number))))
    return write_number(float(f"{number:.{max(_FIGURE_DIGITS, whole_digits)}g}"))


def write_value(parameter: Parameter, value: Value | None) -> str:
    """Write a value so that ``read_value`` gives it back; a value that is not set is empty."""
    if value is None:
        return ""
    if isinstance(value.value, str):
        return label_of(parameter, value.value)
    if isinstance(value.value, bool):
        return label_of(parameter, "yes" if value.value else "no")
    number = _number_text(parameter, value)
    return f"{number} {value.unit}" if value.unit else number


NOT_SET = "not set"
"""What is shown where there is no value."""


def _number_text(parameter: Parameter, value: Value) -> str:
    """Write a number; a word that the control shows in hexadecimal, so."""
    number, storage = value.value, parameter.storage
    if storage and _is_hex(parameter) and isinstance(number, int) and number >= 0:
        return f"0x{number:0{(storage.bits or 0) // 4}X}"
    return write_number(float(number) if not isinstance(number, int) else number)


def show_value(parameter: Parameter, value: Value | None, *, secrets: bool = False) -> str:
    """Write a value for a person: as ``write_value`` with the unit's proper symbol; ``NOT_SET`` without one.

    A secret is masked unless ``secrets`` asks for it in clear.
    """
    if value is None:
        return NOT_SET
    if parameter.secret and not secrets:
        return MASKED
    if isinstance(value.value, (str, bool)):
        return visible(write_value(parameter, value))
    number = _number_text(parameter, value)
    unit = unit_text(value.unit)
    return f"{number}{unit}" if unit == "°" else f"{number} {unit}" if unit else number


def label_of(parameter: Parameter, key: str) -> str:
    """Return the label of a choice key; a text or a raw code stays as it is."""
    for choice in parameter.choices or ():
        if choice.key == key:
            return choice.label
    return key
