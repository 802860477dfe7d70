"""How one number came of another by a slip of the hand: a digit more, inches, the sign, digits swapped."""

from __future__ import annotations

from collections.abc import Hashable
from typing import TypeGuard

from amp_studio.schema import Value

_INCH = 25.4
_SWAPPED = "two digits swapped against"
_FACTORS = {
    10.0: "ten times",
    0.1: "a tenth of",
    100.0: "a hundred times",
    0.01: "a hundredth of",
    1000.0: "a thousand times",
    0.001: "a thousandth of",
    _INCH: "25.4 times",
    1 / _INCH: "1/25.4 of",
    -1.0: "the negative of",
}

MIN_DIGITS = 5
"""Digits from which a number is not chosen by hand that is a plain multiple of the printed default:
8.46666 for 4.23333."""
_OUTLIER_FACTORS = {**_FACTORS, 2.0: "twice", 0.5: "half of"}

_POWERS = frozenset(words for factor, words in _FACTORS.items() if factor not in (_INCH, 1 / _INCH, -1.0))


def slip_of_default(value: float, default: float, digits: int) -> str:
    """Return in words how ``value`` came of a printed default of so many significant digits by a slip.

    A round number that is ten times another one is chosen every day; of 4.23333 no user chooses 42.3333. A
    slip does not make a number rounder either: 1 mm is no slip of 25.4 mm.
    """
    words = slip_between(value, default) or (
        _off_by(value / default) if digits >= MIN_DIGITS and default else ""
    )
    if not words or not value or digits < 2 or significant_digits(value) < digits - 1:
        return ""
    return "" if digits < 3 and words in _POWERS else words


def _off_by(ratio: float) -> str:
    """Return in words what a number of many digits was multiplied by, also where its last digits went,
    or it was doubled.
    """
    return next((words for factor, words in _OUTLIER_FACTORS.items() if abs(ratio / factor - 1) < 2e-5), "")


def significant_digits(number: float) -> int:
    """Return how many digits of a number there are between its first and its last that is not zero."""
    return len(f"{abs(number):.10g}".split("e")[0].replace(".", "").strip("0"))


def _is_number(value: Hashable) -> TypeGuard[float]:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def slip_between(value: Hashable, other: Hashable) -> str:
    """Return in words how ``value`` came of ``other`` by a slip (``ten times``);
    "" where no slip explains it.
    """
    if not _is_number(value) or not _is_number(other) or value == other or not other:
        return ""
    if value == 0:
        return "zero instead of"
    ratio = value / other
    for factor, words in _FACTORS.items():
        # Both went through a conversion into the canonical unit, which may cost the last digits.
        if abs(ratio - factor) <= 1e-9 * abs(factor) or _is_rounded(value, other * factor):
            return words
    return _SWAPPED if _is_swapped(float(value), float(other)) else ""


def slip_as_written(words: str, value: Value, other: Value) -> str:
    """Return the slip that explains two canonical numbers, or two swapped digits of the written ones.

    7.5 mm/s and 9 mm/s are 450 and 540 mm/min, and no slip; 19 mm/s for 91 mm/s is one.
    """
    if words not in ("", _SWAPPED):
        return words
    # Only what was typed has digits that a hand can swap.
    is_one_unit = value.unit == other.unit and _is_number(value.value) and _is_number(other.value)
    return _SWAPPED if is_one_unit and slip_between(value.value, other.value) == _SWAPPED else ""


def _is_rounded(value: float, exact: float) -> bool:
    """Return whether a whole number of three digits and more is the exact one, rounded."""
    # Of fewer digits, half a unit is so much that rounding would explain nearly everything.
    return float(value).is_integer() and abs(value) >= 100 and abs(value - exact) <= 0.5


def _is_swapped(value: float, other: float) -> bool:
    """Return whether two neighbouring digits of one are exchanged in the other."""
    # Neighbours that are swapped make ten times of a number at most; a change below 2 % is none that
    # matters.
    if not 1.02 < abs(value / other) < 50 and not 1.02 < abs(other / value) < 50:
        return False
    a, b = _digits(value), _digits(other)
    length = max(len(a), len(b))
    a, b = a.rjust(length, "0"), b.rjust(length, "0")
    differ = [n for n in range(length) if a[n] != b[n]]
    if len(differ) != 2 or differ[1] != differ[0] + 1:
        return False
    first, second = differ
    return (a[first], a[second]) == (b[second], b[first]) and (value < 0) == (other < 0)


def _digits(number: float) -> str:
    """Return the digits of a number on both sides of the point, six behind it."""
    return f"{abs(number):.6f}".replace(".", "")
