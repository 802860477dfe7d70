"""Rounded numbers for recommendations and messages."""

from __future__ import annotations

import math
from decimal import ROUND_CEILING, ROUND_FLOOR, ROUND_HALF_EVEN, Decimal


def _rounded(value: float, digits: int, way: str) -> float:
    if value == 0.0 or not math.isfinite(value):
        return value
    # From the shortest text: the binary value of 0.1 is above 0.1, and rounding up would give 0.101.
    exact = Decimal(repr(float(value)))
    return float(exact.quantize(Decimal(1).scaleb(exact.adjusted() - digits + 1), rounding=way))


def rounded_up(value: float, digits: int = 3) -> float:
    """Return the value rounded up to this number of digits."""
    return _rounded(value, digits, ROUND_CEILING)


def rounded_down(value: float, digits: int = 3) -> float:
    """Return the value rounded down to this number of digits."""
    return _rounded(value, digits, ROUND_FLOOR)


def rounded(value: float, digits: int) -> float:
    """Return the value with this number of digits."""
    return _rounded(value, digits, ROUND_HALF_EVEN)


def value_text(value: float, unit: str = "", digits: int = 4) -> str:
    """Return a value with this number of digits and its unit, without trailing zeros and without an
    exponent.
    """
    # Less than a position of some metres is resolved to is the rounding of the calculation.
    near = 0.0 if abs(value) < 1e-12 else rounded(value, digits) + 0.0  # no "-0"
    text = format(Decimal(repr(float(near))), "f") if math.isfinite(near) else repr(near)
    if "." in text:
        text = text.rstrip("0").rstrip(".")
    return f"{text}{unit}" if unit == "°" else f"{text} {unit}".rstrip()


def page_text(page: str) -> str:
    """Return ``page 6-10``; a file of a firmware and a line by its letter are named as they are."""
    return f"page {page}" if page[:1].isdigit() else page
