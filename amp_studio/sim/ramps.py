"""Builds the profile of a move from rest to rest (`profiles.py`), for every ramp."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from .errors import SimulationError
from .law import Ramp
from .profiles import POLYNOMIAL, WIDTH


@dataclass(frozen=True)
class Piece:
    """One piece of a profile along the move; s, u/s, u/s2, u/s3. Its start and position follow from the pieces before."""

    duration: float
    velocity: float = 0.0
    acceleration: float = 0.0
    jerk: float = 0.0
    kind: float = POLYNOMIAL
    figure: float = 0.0

    @property
    def length(self) -> float:
        """How far it goes, in u."""
        t = self.duration
        return t * (self.velocity + t * (self.acceleration / 2.0 + t * self.jerk / 6.0))


def profile_of(pieces: Sequence[Piece], distance: float, sign: float = 1.0) -> list[float]:
    """Return the flat profile of pieces that go ``distance`` u; pieces without duration are left out."""
    rows: list[float] = []
    start = position = 0.0
    for piece in pieces:
        if piece.duration <= 0.0:
            continue
        rows += [start, piece.duration, sign * position, sign * piece.velocity, sign * piece.acceleration]
        rows += [sign * piece.jerk, piece.kind, piece.figure]
        start, position = start + piece.duration, position + piece.length
    rows += [start, math.inf, sign * distance, 0.0, 0.0, 0.0, POLYNOMIAL, 0.0]
    return rows


def end_of(profile: Sequence[float]) -> float:
    """Return when a profile is at its end, in s."""
    return profile[len(profile) - WIDTH]


def move(distance: float, feedrate: float, ramp: Ramp) -> list[float]:
    """Return the profile of a move of ``distance`` u with its sign at ``feedrate`` u/s, from rest to rest."""
    sign, length = math.copysign(1.0, distance), abs(distance)
    if ramp.kind == "none" or (ramp.kind == "linear" and ramp.acceleration == 0.0):
        return profile_of([Piece(length / feedrate, feedrate)], length, sign)
    if ramp.kind == "linear":
        return profile_of(_linear(length, feedrate, ramp), length, sign)
    raise SimulationError(f"the ramp '{ramp.kind}' is not simulated yet")


def _linear(length: float, feedrate: float, ramp: Ramp) -> list[Piece]:
    up, down = ramp.acceleration, ramp.deceleration or ramp.acceleration
    peak = min(feedrate, math.sqrt(2.0 * length / (1.0 / up + 1.0 / down)))
    even = length - 0.5 * peak * peak * (1.0 / up + 1.0 / down)
    return [Piece(peak / up, 0.0, up), Piece(max(even, 0.0) / peak, peak), Piece(peak / down, peak, -down)]
