"""How the velocity of a command changes: closed pieces from one velocity to another, for every ramp.

Velocities are in u/s along the move and not negative, times in s. The pieces of a change are all that
`ramps.py` needs to build moves, stops and changes of the feedrate.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

from amp_studio.sim.engine.profiles import EXPONENTIAL, POLYNOMIAL, SINE_SQUARED

from .events import Ramp

_TIME_CONSTANTS = 30.0
"""Time constants after which an exponential ramp has arrived: what is left is 1e-13 of the change."""


@dataclass(frozen=True)
class Piece:
    """One piece of a profile along the move; s, u/s, u/s2, u/s3.
    Its start and position follow from the pieces before.
    """

    duration: float
    velocity: float = 0.0
    acceleration: float = 0.0
    jerk: float = 0.0
    kind: float = POLYNOMIAL
    figure: float = 0.0

    def length(self, after: float | None = None) -> float:
        """Return how far it goes in u, to its end or ``after`` s."""
        t = self.duration if after is None else after
        v, a = self.velocity, self.acceleration
        if self.kind == EXPONENTIAL:
            # expm1: of a time that is short against the constant, 1 - exp would lose the digits.
            return v * t + a * self.figure * (t + self.figure * math.expm1(-t / self.figure))
        if self.kind == SINE_SQUARED:
            turn = 2.0 * math.pi / self.figure
            return t * (v + 0.25 * a * t) - a * (math.sin(0.5 * turn * t) / turn) ** 2
        return t * (v + t * (0.5 * a + t * self.jerk / 6.0))

    def velocity_after(self, after: float) -> float:
        """Return the velocity in u/s ``after`` s."""
        t, v, a = after, self.velocity, self.acceleration
        if self.kind == EXPONENTIAL:
            return v - a * self.figure * math.expm1(-t / self.figure)
        if self.kind == SINE_SQUARED:
            turn = 2.0 * math.pi / self.figure
            return v + 0.5 * a * (t - math.sin(turn * t) / turn)
        return v + t * (a + 0.5 * t * self.jerk)

    @property
    def end(self) -> float:
        """The velocity at its end in u/s."""
        return self.velocity_after(self.duration)


def length(pieces: Iterable[Piece]) -> float:
    """Return how far pieces go in u."""
    return math.fsum(piece.length() for piece in pieces)


def change(ramp: Ramp, before: float, after: float) -> list[Piece]:
    """Return the pieces from one velocity to another; none where the velocity may jump."""
    up = after > before
    difference = after - before
    limit = ramp.acceleration if up or ramp.deceleration == 0.0 else ramp.deceleration
    if difference == 0.0 or abs(difference) <= ramp.velocity_step:
        return []
    if ramp.kind == "exponential":
        return _exponential(ramp, before, difference)
    if ramp.kind == "none" or limit == 0.0:
        return []
    rise = math.copysign(limit, difference)
    if ramp.kind == "sine-squared":
        duration = max(ramp.time, 2.0 * difference / rise)
        return [Piece(duration, before, 2.0 * difference / duration, 0.0, SINE_SQUARED, duration)]
    if ramp.kind == "s-curve" and ramp.jerk > 0.0:
        return _s_curve(before, difference, rise, math.copysign(ramp.jerk, difference))
    return [Piece(difference / rise, before, rise)]


def _exponential(ramp: Ramp, before: float, difference: float) -> list[Piece]:
    if ramp.time == 0.0:
        return []
    return [
        Piece(_TIME_CONSTANTS * ramp.time, before, difference / ramp.time, kind=EXPONENTIAL, figure=ramp.time)
    ]


def _s_curve(before: float, difference: float, rise: float, jerk: float) -> list[Piece]:
    """Return jerk up, constant acceleration, jerk down; without the middle where the limit is not reached."""
    slope = min(rise / jerk, math.sqrt(difference / jerk))
    peak = jerk * slope
    even = max(difference / peak - slope, 0.0)
    low = before + 0.5 * peak * slope
    high = low + peak * even
    return [
        Piece(slope, before, 0.0, jerk),
        *([Piece(even, low, peak)] if even > 0.0 else []),
        Piece(slope, high, peak, -jerk),
    ]
