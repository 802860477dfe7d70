"""Cam tables: how many points, how far apart, and what fits a byte."""

from __future__ import annotations

import math

from amp_studio.validate import finite, not_negative, positive, whole

from .registers import SCAN_MS

WORDS = 1915
"""Registers 132 to 2046 of the X axis, 2180 to 4094 of the Y axis (page 4-57)."""
_SCAN_S = SCAN_MS / 1000.0
_ROUND_UP = 0.999
"""What the printed program adds before it cuts off the fraction (page 5-10)."""


def cam_largest_value(speed: float, counts_per_unit: float, time_scans: float) -> float:
    """Largest value in a time cam: counts in a step at the greatest speed, in units/s (page 4-50)."""
    counts = not_negative("The speed", speed) * positive("The counts of a unit", counts_per_unit)
    return counts * positive("The time between points", time_scans) * _SCAN_S


def needs_words(largest_value: float) -> bool:
    """Return whether a time cam with this largest value has to be stored in words,
    beyond 127 counts (page 4-50).
    """
    return abs(finite("The largest value", largest_value)) > 127


def cam_time_between_points(cycle_s: float, points: float) -> float:
    """Scans between two points: time of the cam cycle over number of points times 0.00125 s (page 4-54)."""
    return positive("The time of the cycle", cycle_s) / (whole("The number of points", points) * _SCAN_S)


def cam_step_time(cycle_s: float) -> int:
    """Scans between two points in the printed program: as few as a table of 1915 words allows (page 5-10)."""
    full = WORDS * _SCAN_S
    cycle = positive("The time of the cycle", cycle_s)
    return 1 if cycle < full else math.floor(cycle / full + _ROUND_UP)


def cam_points(cycle_s: float, time_scans: float) -> int:
    """Number of points of a cycle in the printed program, at most 1915 words (page 5-10)."""
    step = whole("The time between points", time_scans) * _SCAN_S
    return min(WORDS, math.floor(positive("The time of the cycle", cycle_s) / step + _ROUND_UP))


def cam_jump(value: float, next_value: float, time_ms: float) -> float:
    """Acceleration in counts/s2 from one value of a time cam to the next,
    as at the loop back point (page 4-56).
    """
    seconds = positive("The time between points", time_ms) / 1000.0
    return (finite("The next value", next_value) - finite("The value", value)) / seconds**2


def cam_master_travel(points: float, increment: float) -> float:
    """Travel of the master, in counts, over a whole position cam:
    its points are one increment apart (page 4-53).
    """
    steps = whole("The number of points", points) - 1
    return steps * not_negative("The master axis position increment", increment)


def bytes_word(first: float, second: float) -> int:
    """Register that contains two values of a time cam in bytes: the earlier one is the low byte (page
    4-49).
    """
    values = [whole("A value", value, -128) for value in (first, second)]
    if max(values) > 127:
        raise ValueError(f"A value of a cam in bytes must be -128 to 127, not {max(first, second)!r}.")
    return values[0] & 0xFF | (values[1] & 0xFF) << 8


def word_bytes(word: float) -> tuple[int, int]:
    """The two values of a time cam that a register contains in bytes, the earlier one first (page 4-49)."""
    stored = whole("The register", word, 0)
    if stored > 0xFFFF:
        raise ValueError(f"The register must fit 16 bits, not {word!r}.")
    # A byte has a sign: two's complement.
    low, high = (byte - 256 if byte > 127 else byte for byte in (stored & 0xFF, stored >> 8))
    return low, high
