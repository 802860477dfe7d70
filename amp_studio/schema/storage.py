"""What a control stores for a value, and the value that a stored number means: the one codec between the two.

A choice is stored as its code; a number as the value in the unit of its storage times its scale. Both ways
are exact until the one rounding at the end: to a double, to the printed decimals, or to the whole number of a
register (a half to the even one). How a control spells the number (hexadecimal words, bare figures)
is a matter of its format.
"""

from __future__ import annotations

import math
import struct
from decimal import Decimal
from fractions import Fraction
from functools import lru_cache

from .model import Parameter, Storage
from .quoting import short
from .units import UNITS, angular, dimension, unit_text
from .value import InvalidValueError, Value
from .values import choice_key, choice_value, label_of, write_number

WORD = 16
"""Bits of a register."""
_ENTERED = 8
"""Most digits of a number that a person enters."""
_PLAIN = Storage.model_construct()  # of defaults alone: nothing to check, at every start


class StorageError(InvalidValueError):
    """A value that the control cannot store, or a stored number that means none; one clear sentence."""


def exact(number: float) -> Fraction:
    """Return the number that a person reads, not the double that approximates it:
    65.536 is 65536 thousandths.
    """
    return Fraction(Decimal(repr(number)))


# -- numbers ---------------------------------------------------------------------


def stored_unit(parameter: Parameter, otherwise: str = "", *, turns: bool = False) -> str:
    """Return the unit of what the control stores: its storage's, else ``otherwise``;
    degrees where the axis turns.
    """
    storage = parameter.storage
    unit = otherwise if storage is None or storage.unit is None else storage.unit
    return angular(unit) if turns else unit


def to_stored(parameter: Parameter, value: Value, unit: str) -> Fraction:
    """Return what is stored for a value where numbers are kept in ``unit``, before it is rounded;
    raises StorageError.
    """
    if parameter.choices:
        return Fraction(code_of(parameter, value))
    if isinstance(value.value, str):
        raise StorageError(f"{parameter.name} is a text, which the control does not store as a number")
    if dimension(value.unit) != dimension(unit):
        raise StorageError(f"{parameter.name} is stored in {_named(unit)}, not in {_named(value.unit)}")
    return exact(value.value) * _factor(value.unit, unit, _storage(parameter).scale)


def to_figure(parameter: Parameter, value: Value, unit: str) -> float:
    """Return the double nearest to ``to_stored``; raises StorageError."""
    # Stored as it was entered: the double itself, without a fraction in between.
    if value.unit == unit and _storage(parameter).scale == 1.0 and not isinstance(value.value, (str, bool)):
        return value.value
    return _double(to_stored(parameter, value, unit))


@lru_cache(maxsize=1000)
def _factor(unit: str, stored: str, scale: float) -> Fraction:
    return UNITS[unit][1] / UNITS[stored][1] * exact(scale)


def from_stored(parameter: Parameter, number: Fraction | float, unit: str) -> Value:
    """Return the value that a stored number means where numbers are kept in ``unit``; raises StorageError.

    A code that is not one of the parameter's is kept as it is.
    """
    if parameter.type in ("text", "format"):
        raise StorageError(f"{parameter.name} is a text, which the control does not store as a number")
    # Stored without a scale: the double itself, without a fraction in between.
    if parameter.type == "real" and isinstance(number, float) and _storage(parameter).scale == 1.0:
        return Value(number, unit)
    found = number if isinstance(number, Fraction) else exact(number)
    # A code is no quantity, and has no scale.
    if not parameter.choices:
        found /= exact(_storage(parameter).scale)
    if parameter.type == "real":
        return Value(_real_of(parameter, found), unit)
    if found.denominator != 1:
        raise StorageError(f"{parameter.name} takes whole numbers, not {short(write_number(_double(found)))}")
    return choice_of(parameter, int(found)) if parameter.choices else Value(int(found), unit)


def _real_of(parameter: Parameter, number: Fraction) -> float:
    """Return the nearest double; raises StorageError where it is infinite, or 0 for what is not."""
    double = _double(number)
    if math.isinf(double) or (double == 0 and number != 0):
        raise StorageError(f"{parameter.name} cannot have a number of that size")
    return double


def stored_number(parameter: Parameter, value: Value, *, turns: bool) -> float | int | None:
    """Return what the control shows of a value (its patch value); None where the manual prints no form."""
    if not parameter.choices and (parameter.storage is None or isinstance(value.value, str)):
        return None
    try:
        number = to_stored(parameter, value, stored_unit(parameter, turns=turns))
    except StorageError:
        return None
    return int(number) if parameter.choices else shown_number(parameter, number)


def value_of_stored(parameter: Parameter, number: float, *, turns: bool) -> Value:
    """Return the value that a number keyed in at the control means;
    ``stored_number`` in the opposite direction.

    Raises StorageError for a fraction where the control stores whole numbers.
    """
    return from_stored(parameter, number, stored_unit(parameter, turns=turns))


def shown_number(parameter: Parameter, number: Fraction) -> float:
    """Return a stored number as the control shows it: the nearest double, with the decimals that it has."""
    decimals = _storage(parameter).decimals
    return _double(number) if decimals is None else round(_double(number), decimals)


def single(number: float) -> float:
    """Return the number that a control keeps as a 32-bit float, by its shortest digits:
    0.1 and not 0.10000000149.
    """
    try:
        kept = struct.unpack("<f", struct.pack("<f", number))[0]
    except OverflowError:
        return math.copysign(math.inf, number)
    # 6 digits always survive a 32-bit float, and two of them always differ in 9 (IEEE 754).
    texts = (f"{kept:.{digits}g}" for digits in range(6, 10))
    return next(
        (float(t) for t in texts if struct.unpack("<f", struct.pack("<f", float(t)))[0] == kept), kept
    )


def _double(number: Fraction) -> float:
    """Return the double nearest to a number; infinite where no double is that large."""
    try:
        return float(number)
    except OverflowError:
        return math.inf if number > 0 else -math.inf


# -- choices ---------------------------------------------------------------------


def code_of(parameter: Parameter, value: Value) -> int:
    """Return the code that the control keeps for a choice; raises StorageError where none is printed."""
    key = choice_key(value)
    if key.startswith("raw:"):
        return int(key[4:])
    for choice in parameter.choices or ():
        if choice.key == key and choice.raw is not None:
            return choice.raw
    raise StorageError(f"no code is printed for '{label_of(parameter, key)}' of {parameter.name}")


def choice_of(parameter: Parameter, number: int) -> Value:
    """Return the choice of a code; one that is not one of the parameter's is kept as it is."""
    for choice in parameter.choices or ():
        if choice.raw == number:
            return choice_value(parameter, choice)
    return Value(f"raw:{number}")


# -- what fits -------------------------------------------------------------------


def stored_range(parameter: Parameter) -> tuple[int, int]:
    """Return the smallest and the largest number that the bits, or else the registers,
    of a parameter can store.
    """
    storage = _storage(parameter)
    numbers = 1 << (storage.bits or WORD * storage.words)
    return (-numbers // 2, numbers // 2 - 1) if is_signed(parameter) else (0, numbers - 1)


def is_signed(parameter: Parameter) -> bool:
    """Return whether a number is stored with its sign; a word of bits has none."""
    return parameter.type != "bits" and _storage(parameter).signed


def fitting(parameter: Parameter, number: int) -> int:
    """Return a number that the bits of a parameter can store; raises StorageError for any other."""
    low, high = stored_range(parameter)
    if not low <= number <= high:
        bits = (high - low).bit_length()
        raise StorageError(f"{number} does not fit the {bits} bits of {parameter.name}, {low} to {high}")
    return number


# -- registers -------------------------------------------------------------------


def words_taken(parameter: Parameter) -> int:
    """Return how many registers a value takes."""
    return _storage(parameter).words


def is_low_first(parameter: Parameter) -> bool:
    """Return whether the first of several registers is the lowest part of the number."""
    storage = _storage(parameter)
    return storage.words > 1 and storage.word_order == "low-first"


def register_number(parameter: Parameter, value: Value, unit: str) -> int:
    """Return the whole number that registers store for a value;
    ``unit`` is that of a storage which names none.

    Raises StorageError. The value that comes back differs by at most half a count,
    and is stored as the same number.
    """
    return fitting(parameter, round(to_stored(parameter, value, stored_unit(parameter, unit))))


def value_of_register(parameter: Parameter, number: int, unit: str) -> Value:
    """Return the value that a whole number in the registers means; raises StorageError.

    One of many digits is the shortest of all that are stored as this number, which a person is likely to have
    entered: 1600 and not 1600.006103515625.
    """
    value = from_stored(parameter, fitting(parameter, number), stored_unit(parameter, unit))
    if isinstance(value.value, float) and value.value != float(f"{value.value:.{_ENTERED}g}"):
        # From one digit up: the first that is stored as this number is the shortest.
        for digits in range(1, 17):
            shorter = Value(float(f"{value.value:.{digits}g}"), value.unit)
            if round(to_stored(parameter, shorter, stored_unit(parameter, unit))) == number:
                return shorter
    return value


def words_of(parameter: Parameter, value: Value, unit: str) -> tuple[int, ...]:
    """Return the words of a value, 0 to 65535 each, in the order of their registers; raises StorageError."""
    # Python shifts a negative number with its sign: the mask makes the two's complement of its words.
    number = register_number(parameter, value, unit)
    words = [number >> WORD * n & 0xFFFF for n in range(words_taken(parameter))]
    return tuple(words if is_low_first(parameter) else reversed(words))


def value_of_words(parameter: Parameter, words: tuple[int, ...], unit: str) -> Value:
    """Return the value that words mean, given in the order of their registers; raises StorageError."""
    pattern = 0
    for word in reversed(words) if is_low_first(parameter) else words:
        pattern = pattern << WORD | word
    width = WORD * words_taken(parameter)
    is_negative = is_signed(parameter) and pattern >> (width - 1)
    return value_of_register(parameter, pattern - (1 << width) if is_negative else pattern, unit)


def _storage(parameter: Parameter) -> Storage:
    return parameter.storage or _PLAIN


def _named(unit: str) -> str:
    return unit_text(unit) or "a bare number"
