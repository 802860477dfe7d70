"""Values as the 16-bit registers of a control hold them: whole numbers, scaled, in one word or in several.

What a register holds is the value in the unit of its storage, times its scale, rounded to the nearest whole number
(a half to the even one). A value that comes back is that number divided by the scale: it differs from the one that
was written by at most half a count of the register, and is written to the same words again. The arithmetic is exact
before the one rounding to a double.
"""

from __future__ import annotations

import re
from decimal import Decimal
from fractions import Fraction

from .model import Parameter, Storage
from .quoting import quoted
from .units import UNITS, dimension, shown
from .value import Value
from .values import label_of, write_number

WORD = 16
_PLAIN = Storage()
_DECIMAL = re.compile(r"[+-]?[0-9]{1,20}(?:\.0{0,20})?")
_HEXADECIMAL = re.compile(r"([0-9][0-9A-F]{0,19})H", re.IGNORECASE)


class WordError(ValueError):
    """A value that no register can hold, or a word that means none; one clear sentence."""


def words_taken(parameter: Parameter) -> int:
    """Return how many registers a value takes."""
    return _storage(parameter).words


def words_of(parameter: Parameter, value: Value, unit: str) -> tuple[int, ...]:
    """Return the words of a value, 0 to 65535 each, in the order of their registers; raises WordError."""
    storage, number = _storage(parameter), number_of(parameter, value, unit)
    words = [number >> WORD * n & 0xFFFF for n in range(storage.words)]
    return tuple(words if is_low_first(parameter) else reversed(words))


def value_of(parameter: Parameter, words: tuple[int, ...], unit: str) -> Value:
    """Return the value that words mean, given in the order of their registers; raises WordError."""
    pattern = 0
    for word in reversed(words) if is_low_first(parameter) else words:
        pattern = pattern << WORD | word
    return value_of_number(parameter, number_of_pattern(parameter, pattern), unit)


def number_of(parameter: Parameter, value: Value, unit: str) -> int:
    """Return the whole number that registers hold for a value; ``unit`` is that of a storage which names none.

    Raises WordError.
    """
    found = value.value
    if parameter.choices:
        number = code_of(parameter, found)
    elif isinstance(found, str):
        raise WordError(f"{parameter.name} is a text, which no register is given")
    else:
        storage = _storage(parameter)
        stored = unit if storage.unit is None else storage.unit
        if dimension(value.unit) != dimension(stored):
            raise WordError(
                f"{parameter.name} is held in {_named(stored)}, which {_named(value.unit)} cannot be given in"
            )
        number = round(exact(found) * UNITS[value.unit][1] / UNITS[stored][1] * exact(storage.scale))
    _fit(parameter, number)
    return number


def value_of_number(parameter: Parameter, number: int, unit: str) -> Value:
    """Return the value that a whole number in the registers means; raises WordError."""
    _fit(parameter, number)
    if parameter.choices:
        return choice_of(parameter, number)
    if parameter.type in ("text", "format"):
        raise WordError(f"{parameter.name} is a text, which no register is given")
    storage = _storage(parameter)
    stored = unit if storage.unit is None else storage.unit
    found = number / exact(storage.scale)
    if parameter.type == "real":
        return Value(float(found), stored)
    if found.denominator != 1:
        raise WordError(
            f"{parameter.name} takes whole numbers, and {number} means {write_number(float(found))}"
        )
    return Value(int(found), stored)


def number_of_pattern(parameter: Parameter, pattern: int) -> int:
    """Return the number that the bits of all the words of a parameter mean."""
    width = WORD * _storage(parameter).words
    return pattern - (1 << width) if is_signed(parameter) and pattern >> (width - 1) else pattern


def is_low_first(parameter: Parameter) -> bool:
    """Tell whether the first of several registers is the lowest part of the number."""
    storage = _storage(parameter)
    return storage.words > 1 and storage.word_order == "low-first"


def is_signed(parameter: Parameter) -> bool:
    """Tell whether the registers hold a number with its sign; a word of bits has none."""
    return parameter.type != "bits" and _storage(parameter).signed


def _fit(parameter: Parameter, number: int) -> None:
    storage = _storage(parameter)
    bits = storage.bits or WORD * storage.words
    low, high = (-(1 << bits - 1), (1 << bits - 1) - 1) if is_signed(parameter) else (0, (1 << bits) - 1)
    if not low <= number <= high:
        raise WordError(f"{number} does not fit the {bits} bits of {parameter.name}, {low} to {high}")


def _storage(parameter: Parameter) -> Storage:
    return parameter.storage or _PLAIN


def exact(number: float) -> Fraction:
    """Return the number that a person reads, not the double that stands for it: 65.536 is 65536 thousandths."""
    return Fraction(Decimal(repr(number)))


def code_of(parameter: Parameter, found: float | bool | str) -> int:
    """Return the code that the control keeps for a choice; raises WordError where none is printed."""
    key = ("yes" if found else "no") if isinstance(found, bool) else str(found)
    if key.startswith("raw:"):
        return int(key[4:])
    for choice in parameter.choices or ():
        if choice.key == key and choice.raw is not None:
            return choice.raw
    raise WordError(f"no code is printed for '{label_of(parameter, key)}' of {parameter.name}")


def choice_of(parameter: Parameter, number: int) -> Value:
    """Return the choice of a code; one that is none of the parameter's is kept as it is."""
    for choice in parameter.choices or ():
        if choice.raw == number:
            return Value(choice.key == "yes" if parameter.type == "boolean" else choice.key)
    return Value(f"raw:{number}")


def _named(unit: str) -> str:
    return shown(unit) or "a bare number"


# -- how numbers are written (pages 4-48 and 5-5) ------------------------------------------------------------------


def write_hexadecimal(pattern: int) -> str:
    """Write the bits of a word as the tasks of the manual do: ``01414H``, ``02H``, ``01DH`` (page 5-5), ``0H``."""
    return f"0{pattern:X}H" if pattern else "0H"


def read_word(text: str) -> tuple[int, bool]:
    """Read a whole number, and tell whether it is hexadecimal: the bits as they are. Raises WordError."""
    text = text.strip()
    if found := _HEXADECIMAL.fullmatch(text):
        return int(found[1], 16), True
    if _DECIMAL.fullmatch(text):
        return int(text.partition(".")[0]), False
    raise WordError(f"{quoted(text)} is no whole number, as 1984, -1 or 01414H")
