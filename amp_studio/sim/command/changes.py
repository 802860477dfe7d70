"""Time and way of a change of velocity in closed form, for many changes at once; `pieces.py` has the pieces.

Every ramp here is symmetric: the mean velocity of a change is that of its ends.
"""

from __future__ import annotations

import math
from typing import cast

import numpy as np
import numpy.typing as npt

from .events import Ramp

Changes = npt.NDArray[np.float64]
"""(n,) of velocities or accelerations, u/s or u/s2."""
SYMMETRIC = ("none", "linear", "s-curve", "sine-squared")
"""Kinds of ramps that have these forms."""


def change_time(ramp: Ramp, difference: Changes, acceleration: Changes) -> Changes:
    """Return the time in s of each change of velocity by ``difference`` (not negative) u/s."""
    if ramp.kind == "none":
        return np.zeros_like(difference)
    with np.errstate(divide="ignore", invalid="ignore"):
        if ramp.kind == "sine-squared":
            # The mean of sin² is half its peak.
            found = np.where(difference > 0.0, np.maximum(ramp.time, 2.0 * difference / acceleration), 0.0)
        elif ramp.kind == "s-curve" and ramp.jerk > 0.0:
            # Without an even part, half of the change is made while the acceleration rises: d = jerk t².
            slope = np.minimum(acceleration / ramp.jerk, np.sqrt(difference / ramp.jerk))
            even = np.maximum(difference / (slope * ramp.jerk) - slope, 0.0)
            found = np.where(difference > 0.0, 2.0 * slope + even, 0.0)
        else:
            found = np.where(difference > 0.0, difference / acceleration, 0.0)
    return cast(Changes, found)


def change_way(ramp: Ramp, before: Changes, after: Changes, acceleration: Changes) -> Changes:
    """Return how far each change goes, u."""
    way: Changes = 0.5 * (before + after) * change_time(ramp, np.abs(after - before), acceleration)
    return way


def reached(ramp: Ramp, velocity: float, way: float, acceleration: float) -> float:
    """Return the velocity in u/s that is reached from another within ``way`` u."""
    if ramp.kind == "none":
        return math.inf
    if ramp.kind == "sine-squared":
        in_time = 2.0 * way / ramp.time - velocity if ramp.time > 0.0 else math.inf
        # The least time is kept as long as the peak acceleration, 2 d / T, allows it.
        if in_time - velocity <= 0.5 * acceleration * ramp.time:
            return max(in_time, velocity)
        return math.sqrt(velocity * velocity + acceleration * way)
    if ramp.kind == "s-curve" and ramp.jerk > 0.0:
        return velocity + _rise(velocity, way, acceleration, ramp.jerk)
    return math.sqrt(velocity * velocity + 2.0 * acceleration * way)


def _rise(velocity: float, way: float, acceleration: float, jerk: float) -> float:
    """Return the change of an S-curve over a way."""
    whole = acceleration * acceleration / jerk
    if (velocity + 0.5 * whole) * 2.0 * acceleration / jerk >= way:
        # The acceleration is not reached: with s² = change, s³ + 2 v s = way √jerk has one real root
        # (the hyperbolic form of Cardano's).
        p, q = 2.0 * velocity, way * math.sqrt(jerk)
        if p <= 0.0:
            return float(np.cbrt(q)) ** 2
        s = 2.0 * math.sqrt(p / 3.0) * math.sinh(math.asinh(1.5 * q / p * math.sqrt(3.0 / p)) / 3.0)
        return s * s
    # way = (v + d/2) (d/a + a/j), solved for the change d.
    b = acceleration / jerk + 2.0 * velocity / acceleration
    c = 2.0 * velocity * acceleration / jerk - 2.0 * way
    return 0.5 * acceleration * (math.sqrt(b * b - 4.0 * c / acceleration) - b)


def peaks(
    ramp: Ramp,
    before: Changes,
    after: Changes,
    way: Changes,
    highest: Changes,
    acceleration: Changes,
    deceleration: Changes,
) -> Changes:
    """Return the highest velocity of each block from one velocity to another within its way."""
    if ramp.kind == "none":
        return highest.copy()
    if ramp.kind == "linear" or (ramp.kind == "s-curve" and ramp.jerk == 0.0):
        # An infinite slope takes no way: its share is the limit of the quotient.
        with np.errstate(invalid="ignore"):  # of two infinite ones
            share = 1.0 / (1.0 + np.where(np.isfinite(deceleration), acceleration / deceleration, 0.0))
        share = np.where(np.isfinite(acceleration), share, 0.0)
        slope = np.where(np.isfinite(acceleration), acceleration, deceleration)
        slope = np.where(np.isfinite(slope), slope, 1e12)
        square = share * before * before + (1.0 - share) * after * after
        square += 2.0 * np.where(np.isfinite(acceleration), share, 1.0) * slope * way
        return cast(Changes, np.minimum(np.sqrt(square), highest))
    low, high = np.maximum(before, after), highest.copy()
    # No closed form for both ramps together: halved until no float is between, at most as often as a float
    # has bits.
    for _ in range(60):
        middle = 0.5 * (low + high)
        taken = change_way(ramp, before, middle, acceleration) + change_way(ramp, middle, after, deceleration)
        fits = taken <= way
        low, high = np.where(fits, middle, low), np.where(fits, high, middle)
    whole = change_way(ramp, before, highest, acceleration) + change_way(ramp, highest, after, deceleration)
    return cast(Changes, np.where(whole <= way, highest, low))
