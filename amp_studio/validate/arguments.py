"""What the arguments of a formula may be; ValueError names the one that makes no sense."""

from __future__ import annotations

import math


def finite(what: str, value: float) -> float:
    if not math.isfinite(value):
        raise ValueError(f"{what} must be a finite number, not {value!r}.")
    return value


def positive(what: str, value: float) -> float:
    if not (math.isfinite(value) and value > 0):
        raise ValueError(f"{what} must be greater than zero, not {value!r}.")
    return value


def not_negative(what: str, value: float) -> float:
    if not (math.isfinite(value) and value >= 0):
        raise ValueError(f"{what} must not be negative, not {value!r}.")
    return value


def whole(what: str, value: float, least: int = 1, most: int | None = None) -> int:
    """A whole number of at least ``least``; doubles that are one are welcome, CEL knows no others.

    ``most`` bounds what would be reckoned with without end (a power of two with a billion digits).
    """
    if most is not None and value > most:
        raise ValueError(f"{what} must be at most {most}, not {value!r}.")
    if not (math.isfinite(value) and value >= least and value == int(value)):
        raise ValueError(f"{what} must be a whole number of at least {least}, not {value!r}.")
    return int(value)


def percent_of(what: str, value: float) -> float:
    if not (math.isfinite(value) and 0 <= value <= 100.0):
        raise ValueError(f"{what} must be 0 to 100 %, not {value!r}.")
    return value
