"""How the firmware reads, keeps and shows a number: nuts_bolts.c ``read_float``, ``ftoa``;
a 32-bit float in between.

It knows no exponents: of ``1e-05`` it reads the 1. It takes nine digits from the first that is not zero.
"""

from __future__ import annotations

import re
import struct
from decimal import Decimal

_DIGITS = 9
LARGEST = 4_000_000_000.0
"""Beyond it the whole part is not shown any more (32 bits)."""

_WHOLE_NUMBER = re.compile(r"-?\d{1,40}(\.\d{0,40})?")
_NUMBER = re.compile(r"[+-]?(\d*)(?:\.(\d*))?")


def single(number: float) -> float:
    """Return the 32-bit float nearest to a number."""
    return float(struct.unpack("<f", struct.pack("<f", number))[0])


def written_number(number: float) -> str:
    """Return the text from which the firmware reads a number as exactly as it can: no exponent,
    nine digits at most.

    Raises ValueError for a number that it cannot read or show.
    """
    exact = Decimal(repr(number))
    if not exact.is_finite() or abs(number) > LARGEST:
        raise ValueError(f"{number:g} is too large")
    digits = len(exact.as_tuple().digits)
    rounded = round(exact, _DIGITS - 1 - exact.adjusted()) if digits > _DIGITS else exact
    text = format(rounded, "f")
    return text.rstrip("0").rstrip(".") if "." in text else text


def read_number(text: str) -> float:
    """Return the 32-bit float that the firmware reads from a text; raises ValueError where it reads none."""
    match = _NUMBER.match(text)
    if match is None or not (match[1] or match[2]):
        raise ValueError(f"'{text[:40]}' is no number")
    whole, fraction = match[1].lstrip("0"), match[2] or ""
    # The firmware counts nine digits and drops the rest without rounding.
    number = int((whole + fraction).lstrip("0")[:_DIGITS] or "0")
    if len(whole) >= _DIGITS:
        exponent = len(whole) - _DIGITS
    else:
        zeros = len(fraction) - len(fraction.lstrip("0")) if not whole else 0
        exponent = -min(len(fraction), zeros + _DIGITS - len(whole))
    # Nine digits do not fit a 32-bit float: rounded here once, as the firmware does.
    value = single(float(number))
    # Before it is scaled: thousands of digits would multiply for ever.
    if value and (exponent > _DIGITS or value * 10.0**exponent > LARGEST):
        raise ValueError(f"{text[:20]} is too large")
    value = _scaled(value, exponent) if value else value
    return -value if text.startswith("-") else value


def _scaled(value: float, exponent: int) -> float:
    """Return a number times a power of ten, rounded after each step as the firmware rounds."""
    while exponent <= -2:
        value, exponent = single(value * single(0.01)), exponent + 2
    if exponent < 0:
        value = single(value * single(0.1))
    while exponent > 0:
        value, exponent = single(value * 10.0), exponent - 1
    return value


def shown_number(value: float, decimals: int) -> str:
    """Return the text that the firmware shows of a 32-bit float with so many decimals."""
    rest = single(abs(value) + single(0.5 * 10.0**-decimals))
    whole = int(rest)
    rest, left = single(rest - whole), decimals
    # Two digits at a time, as ``ftoa``: each multiplication rounds, and another order would round
    # otherwise.
    while left >= 2:
        rest, left = single(rest * 100.0), left - 2
    if left:
        rest = single(rest * 10.0)
    digits = f"{int(rest):0{decimals}d}"[-decimals:] if decimals else ""
    return f"{'-' if value < 0 else ''}{whole}.{digits}"


def decimals_of(reported: str) -> int | None:
    """Return with how many decimals a number is shown; None for a whole number or a text."""
    match = re.fullmatch(r"-?\d+\.(\d*)", reported)
    return len(match[1]) if match else None


def is_shown_as(sent: str, reported: str) -> bool:
    """Return whether a control that shows a setting so may have got it so."""
    if sent == reported or is_same_number(sent, reported):
        return True
    decimals = decimals_of(reported)
    try:
        if decimals is None:
            return re.fullmatch(r"\d+", reported) is not None and single(float(reported)) == read_number(sent)
        return shown_number(read_number(sent), decimals) == reported
    except ValueError:
        return False


def is_same_number(a: str, b: str) -> bool:
    """Return whether two texts are the same number, whatever zeros are written."""
    numbers = [_WHOLE_NUMBER.fullmatch(text) for text in (a, b)]
    return all(numbers) and Decimal(a) == Decimal(b)
