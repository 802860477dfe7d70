"""Figures of a linear or rotary axis by ISO 230-2: mean errors, reversal, repeatability and accuracy.

For target i, of n runs in a direction: mean error x_i, estimator of the standard deviation s_i with n - 1.
Both directions give the mean (x_i+ + x_i-)/2 and the reversal value B_i = x_i+ - x_i-.
Everything is in the unit of the measurement.
"""

from __future__ import annotations

import math
import statistics
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction

from .measurement import Measurement


@dataclass(frozen=True)
class TargetFigures:
    """One target; what needs another direction or more runs is None."""

    position: float
    mean_rising: float | None
    mean_falling: float | None
    spread_rising: float | None
    """Estimator of the standard deviation."""
    spread_falling: float | None

    @property
    def mean(self) -> float | None:
        """Mean of both directions."""
        if self.mean_rising is None or self.mean_falling is None:
            return None
        return (self.mean_rising + self.mean_falling) / 2

    @property
    def reversal(self) -> float | None:
        """B_i: rising less falling; negative where motion is lost."""
        if self.mean_rising is None or self.mean_falling is None:
            return None
        return self.mean_rising - self.mean_falling


@dataclass(frozen=True)
class AxisFigures:
    """Figures of an axis; None for what the runs do not give (one direction, or one run of each).

    ``reversal``        B, the largest |B_i|; ``mean_reversal`` the mean of B_i
    ``repeatability_*`` R: of a direction 4 s, of both the largest of 2 s+ + 2 s- + |B|, R+ and R-
    ``systematic_*``    E: range of the means; ``mean_range`` M: that of the means of both directions
    ``accuracy_*``      A: range of mean + 2 s and mean - 2 s
    """

    targets: tuple[TargetFigures, ...]
    runs_rising: int
    runs_falling: int
    reversal: float | None
    mean_reversal: float | None
    mean_range: float | None
    systematic_rising: float | None
    systematic_falling: float | None
    systematic: float | None
    repeatability_rising: float | None
    repeatability_falling: float | None
    repeatability: float | None
    accuracy_rising: float | None
    accuracy_falling: float | None
    accuracy: float | None


def figures(measurement: Measurement) -> AxisFigures:
    """Return the figures of a measurement."""
    rising, falling = _errors(measurement, rising=True), _errors(measurement, rising=False)
    targets = tuple(_target(at, rising.get(at), falling.get(at)) for at in measurement.targets)
    reversals = _known(t.reversal for t in targets)
    up = _measured((t.mean_rising, t.spread_rising) for t in targets)
    down = _measured((t.mean_falling, t.spread_falling) for t in targets)
    both = [*up, *down] if up and down else []
    directions = Counter(run.rising for run in measurement.runs)
    return AxisFigures(
        targets,
        directions[True],
        directions[False],
        max(map(abs, reversals), default=None),
        _mean(reversals),
        _range(_known(t.mean for t in targets)),
        _range_of_means(up),
        _range_of_means(down),
        _range_of_means(both),
        _fourfold(up),
        _fourfold(down),
        _largest(_repeatability(t) for t in targets),
        _accuracy(up),
        _accuracy(down),
        _accuracy(both),
    )


def _errors(measurement: Measurement, *, rising: bool) -> dict[Fraction, list[float]]:
    return {at: [float(v) for v in values] for at, values in measurement.errors(rising=rising).items()}


def _known(values: Iterable[float | None]) -> list[float]:
    return [value for value in values if value is not None]


def _measured(targets: Iterable[tuple[float | None, float | None]]) -> list[tuple[float, float | None]]:
    """Return mean and spread of the targets that were reached."""
    return [(mean, spread) for mean, spread in targets if mean is not None]


def _target(at: Fraction, rising: list[float] | None, falling: list[float] | None) -> TargetFigures:
    return TargetFigures(float(at), _mean(rising), _mean(falling), _spread(rising), _spread(falling))


def _mean(values: list[float] | None) -> float | None:
    return math.fsum(values) / len(values) if values else None


def _spread(values: list[float] | None) -> float | None:
    return statistics.stdev(values) if values and len(values) > 1 else None


def _range(values: list[float]) -> float | None:
    return max(values) - min(values) if values else None


def _range_of_means(targets: Iterable[tuple[float, float | None]]) -> float | None:
    return _range([mean for mean, _ in targets])


def _largest(values: Iterable[float | None]) -> float | None:
    """Return the largest; None where one of them is not known."""
    known = list(values)
    # The largest of some targets only would promise more than was measured.
    return max((v for v in known if v is not None), default=None) if None not in known else None


def _fourfold(side: list[tuple[float, float | None]]) -> float | None:
    """Return the repeatability of one direction: four times the largest standard deviation."""
    return _largest(None if spread is None else 4 * spread for _, spread in side)


def _repeatability(target: TargetFigures) -> float | None:
    """Return the repeatability of both directions at one target."""
    up, down, reversal = target.spread_rising, target.spread_falling, target.reversal
    if up is None or down is None or reversal is None:
        return None
    # R of both directions is never below that of one: where the spreads differ much and nothing is lost, 4 s
    # of the worse direction is the larger figure.
    return max(2 * up + 2 * down + abs(reversal), 4 * up, 4 * down)


def _accuracy(side: list[tuple[float, float | None]]) -> float | None:
    """Return the accuracy of a direction, or of both: the span of mean ± 2 standard deviations."""
    bands = [(mean - 2 * s, mean + 2 * s) for mean, s in side if s is not None]
    # One target without a spread, and the accuracy of the axis is not known.
    if not bands or len(bands) < len(side):
        return None
    return max(high for _, high in bands) - min(low for low, _ in bands)
