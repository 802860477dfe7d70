"""Round numbers for the axes and the rings of a plot."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from .panels import Ring


def ticks(low: float, high: float, about: int = 5) -> list[float]:
    """Return round numbers (1, 2 or 5 times a power of ten apart) from low to high."""
    if not high > low:
        return [low]
    return multiples(round_step((high - low) / about), low, high)


def round_step(least: float) -> float:
    """Return the smallest of 1, 2 and 5 times the powers of ten that is not below a number."""
    power = 10.0 ** math.floor(math.log10(least))
    return next(power * n for n in (1.0, 2.0, 5.0, 10.0) if power * n >= least * 0.999)


def multiples(step: float, low: float, high: float) -> list[float]:
    """Return the multiples of a step from low to high."""
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    return [n * step for n in range(first, last + 1)]


def decades(low: float, high: float) -> list[float]:
    """Return 1, 2 and 5 times the powers of ten from low to high."""
    exponents = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    every = [n * 10.0**e for e in exponents for n in (1.0, 2.0, 5.0)]
    return [value for value in every if low * 0.999 <= value <= high * 1.001]


def ring_levels(rings: Sequence[Ring]) -> tuple[list[float], float]:
    """Return the deviations at which a ball-bar plot has rings, and the largest that it shows."""
    peak = max((float(np.max(np.abs(r.deviation), initial=0.0)) for r in rings), default=0.0) or 1e-6
    step = round_step(0.5 * peak)
    count = math.ceil(peak / step - 1e-9)
    return [n * step for n in range(-count, count + 1)], count * step
