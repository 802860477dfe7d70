"""Errors over the positions of an axis: straight lines from point to point,
constant beyond the first and the last.
"""

from __future__ import annotations

from bisect import bisect_left
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from .measurement import MeasuredPoints, Measurement


@dataclass(frozen=True)
class ErrorCurve:
    """Points of one unit with rising positions; an empty curve is zero everywhere."""

    points: MeasuredPoints

    @cached_property
    def _positions(self) -> list[Fraction]:
        return [at for at, _ in self.points]

    def at(self, position: Fraction) -> Fraction:
        """Return the value at a position."""
        n = bisect_left(self._positions, position)
        if not self.points:
            return Fraction(0)
        # Beyond its ends a table goes on with its last value: no control extrapolates.
        if n == 0 or n == len(self.points):
            return self.points[min(n, len(self.points) - 1)][1]
        (low, before), (high, after) = self.points[n - 1], self.points[n]
        return before + (after - before) * (position - low) / (high - low)

    @property
    def span(self) -> Fraction:
        """Largest value less smallest one."""
        values = [value for _, value in self.points]
        return max(values) - min(values) if values else Fraction(0)


def mean_curve(measurement: Measurement, rising: bool | None = None) -> ErrorCurve:
    """Return the mean error at each target: of one direction, or of both with the same weight (ISO 230-2,
    3.12).

    Targets that were not reached from every direction of the measurement are left out of the mean of both.
    """
    sides = [measurement.errors(rising=side) for side in (True, False)] if rising is None else []
    if rising is not None:
        sides = [measurement.errors(rising=rising)]
    sides = [side for side in sides if side]
    # A mean with a target of one direction would put half of the lost motion into the table.
    common = set.intersection(*(set(side) for side in sides)) if sides else set()
    return ErrorCurve(
        tuple(
            (at, sum((_mean(side[at]) for side in sides), Fraction(0)) / len(sides)) for at in sorted(common)
        )
    )


def _mean(values: list[Fraction]) -> Fraction:
    return sum(values, Fraction(0)) / len(values)
