"""Round numbers along a scale, and how a number is written beside it."""

from __future__ import annotations

import math
import re
from decimal import Decimal

THIN = "\u202f"
"""A narrow space that no line breaks at, between groups of three digits."""
_GROUPED = re.compile(r"([-−]?)([1-9][0-9]{4,})(.*)")


def round_step(least: float) -> float:
    """Return the smallest of 1, 2 and 5 times the powers of ten that is not below a number."""
    power = 10.0 ** math.floor(math.log10(least))
    return next(power * n for n in (1.0, 2.0, 5.0, 10.0) if power * n >= least * 0.999)


def multiple(number: float, step: float) -> float:
    """Return the multiple of a step that is nearest to a number, without the dust of doubles: -150.0,
    not -150.00000000000003.
    """
    if step <= 0.0:
        return number
    grain = Decimal(f"{step:.12g}")
    return float(round(Decimal(number) / grain) * grain)


def ticks(low: float, high: float, about: float, step: float = 0.0) -> list[float]:
    """Return the multiples of a step from low to high;
    without a step of one that makes about so many round numbers.
    """
    step = step or round_step((high - low) / max(about, 2.0))
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    return [multiple(n * step, step) for n in range(first, last + 1)]


def decades(low: float, high: float, about: float) -> list[float]:
    """Return powers of ten from low to high, and where there is room 2 and 5 times each."""
    exponents = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    steps = (1.0, 2.0, 5.0) if 2 * len(exponents) < about else (1.0,)
    every = [n * 10.0**e for e in exponents for n in steps]
    return [multiple(v, 10.0 ** math.floor(math.log10(v))) for v in every if low <= v <= high]


def figure_text(value: float) -> str:
    """Write a number beside an axis: grouped by narrow spaces from five digits on, with a real minus."""
    text = f"{value:.10g}"
    if "e-" in text:
        text = f"{value:.12f}".rstrip("0").rstrip(".")
    return grouped(text.replace("-", "−", 1) if text.startswith("-") else text)


def grouped(figure: str) -> str:
    """Return a number with its digits in groups of three from five digits on: ``2 097 152``."""
    match = _GROUPED.fullmatch(figure)
    if match is None:
        return figure
    sign, whole, rest = match.groups()
    return sign + f"{int(whole):_}".replace("_", THIN) + rest
