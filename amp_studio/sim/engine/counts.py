"""Whole numbers in compiled code: counts, points, words of a converter."""

from __future__ import annotations

# From 2**52 to 2**53 a float64 has no bits for a fraction, so that the sum is rounded; 1.5 times, so that a
# negative number stays in that range.
_TO_WHOLE = 1.5 * 2.0**52


def nearest(number: float) -> float:
    """Return the nearest whole number, the even one of two; up to 2**51.

    Added and taken away again, ``_TO_WHOLE`` leaves no room for a fraction:
    faster than a conversion to an integer and back.
    """
    return number + _TO_WHOLE - _TO_WHOLE
