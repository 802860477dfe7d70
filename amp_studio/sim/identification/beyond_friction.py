"""What a record shows beside inertia and friction: a time shift between its channels, static friction,
and what the fit leaves.

Everything is computed on the filtered rows of the fit (`friction.py`):
a filter takes the same part of torque and motion.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from amp_studio.sim.rounding import value_text
from amp_studio.sim.series import Series
from amp_studio.sim.tuning.sampled import Matrix

from .friction import FrictionFit
from .least_squares import fit as least_squares

_FURTHEST_SHIFT = 0.02
"""s: a longer shift is not sought."""
_MIN_ROWS = 3
"""Rows to both sides that a shift is sought in at least."""
SURE = 4.0
"""Standard deviations from which a shift or a static friction is there."""
_MIN_SHIFT = 0.2
"""Of a row's period: a shorter shift changes nothing."""
SLOWEST, STRIBECK = 0.003, np.geomspace(0.004, 0.2, 30)
"""Shares of the top speed: below it an axis is at rest; Stribeck speeds that are tried."""
SEEN = 1.2
"""Times the speed of the slowest row, the Stribeck speed at least: half of its curve is seen."""
_MIN_GAIN = 0.02
"""Share by which the squares have to become fewer for a static friction."""
_MIN_STATIC_SHARE = 0.05
"""Share of the Coulomb friction below which what is more at the start is none."""
_BINS = 16
_DEPENDS, _MIN_BENEFIT = 0.25, 0.02
"""Share of the residual that its means by speed (or position) explain, and of the torque that they are,
for a doubt."""


@dataclass(frozen=True)
class EstimatedFigure:
    """A figure and its standard error."""

    value: float
    error: float


def _directions(table: Matrix) -> Matrix:
    """Return orthonormal columns that reach what a table does: the rest of a series is then two products,
    where a fit for each of many series would cost much more.
    """
    # Columns of one length, for the condition; one of zeros stays as it is.
    return np.asarray(np.linalg.qr(table / (np.sqrt((table**2).sum(axis=0)) + 1e-300))[0])


def _rest(directions: Matrix, given: Series) -> Series:
    """Return what a fit leaves of a series."""
    return np.asarray(given - directions @ (directions.T @ given))


def time_shift(fit: FrictionFit) -> EstimatedFigure:
    """Return by how many s the motion is later than its torque in the record: where the fit is best."""
    most = max(_MIN_ROWS, math.ceil(_FURTHEST_SHIFT / fit.period))
    shifts = fit.period * np.arange(
        -most, most + 1
    )  # whole rows: between two of them noise would be less, and look like a better fit
    used, forward = fit.is_used, fit.velocity > 0.0
    table = np.column_stack([np.gradient(fit.velocity, fit.period), fit.velocity, forward, ~forward])
    directions = _directions(table.astype(float)[used])
    shifted = [np.interp(fit.time - shift, fit.time, fit.torque)[used] for shift in shifts]
    left = np.array([float((_rest(directions, torque) ** 2).sum()) for torque in shifted])
    # A parabola needs a neighbour on each side.
    best = min(max(int(np.argmin(left)), 1), len(shifts) - 2)
    low, middle, high = left[best - 1 : best + 2]
    bend = low - 2.0 * middle + high
    # No minimum within the shifts: an infinite error, so that none counts as found.
    if bend <= 0.0:
        return EstimatedFigure(0.0, math.inf)
    step = shifts[1] - shifts[0]
    rows = (
        int(used.sum()) * fit.period / max(fit.window, fit.period)
    )  # rows of one filter are not independent
    # Four coefficients and the shift have been fitted.
    spread = middle / max(1.0, rows - 5.0)
    # The sum is larger by one variance a standard deviation beside its minimum: step √(2 s² / bend).
    return EstimatedFigure(
        float(shifts[best] + 0.5 * step * (low - high) / bend),
        float(step * math.sqrt(2.0 * spread / bend * max(1.0, fit.period / fit.window))),
    )


def is_shifted(fit: FrictionFit, shift: EstimatedFigure) -> bool:
    """Return whether a shift is there and matters."""
    # A best shift at the edge of the search may be farther out.
    inside = abs(shift.value) < max(_FURTHEST_SHIFT, _MIN_ROWS * fit.period) * 0.98
    return inside and abs(shift.value) > SURE * shift.error and abs(shift.value) > _MIN_SHIFT * fit.period


@dataclass(frozen=True)
class StaticFriction:
    """By how much friction is larger at the start of a motion, and the speed (u/s) over which that falls."""

    more: EstimatedFigure
    speed: EstimatedFigure

    def excess(self, speed: Series) -> Series:
        """Return what friction has at a speed above the Coulomb friction, with its sign."""
        return np.asarray(self.more.value * _stribeck(speed, self.speed.value))


def _stribeck(speed: Series, over: float) -> Series:
    return np.asarray(np.sign(speed) * np.exp(-((speed / over) ** 2)))


def static_friction(fit: FrictionFit, coulomb: float, slowest: float = SLOWEST) -> StaticFriction | None:
    """Return the static friction by R. Stribeck's curve, coulomb + (static - coulomb) exp(-(v/v_s)²);
    None where the record shows none.

    Rows of low speed that the fit left out are used, where the axis comes to rest: where it begins, friction
    yields before it slides, and has not all of it yet (P. Dahl, A Solid Friction Model, 1968).
    """
    top, speeding = float(np.abs(fit.velocity).max()), np.gradient(fit.velocity, fit.period)
    slides = (fit.velocity * speeding < 0.0) | (np.abs(fit.velocity) > STRIBECK[-1] * top)
    moves = slides & (np.abs(fit.velocity) > slowest * top)
    acceleration, speed = speeding[moves], fit.velocity[moves]
    # Friction that rises with the square of the speed has its own column: a wide curve of R. Stribeck's,
    # beside less Coulomb friction, would look like it.
    table = np.column_stack([acceleration, speed, speed > 0.0, speed < 0.0, speed * np.abs(speed)])
    table, given = table.astype(float), fit.torque[moves]

    directions = _directions(table)
    plain = _rest(directions, given)

    def left(over: float) -> tuple[Series, float]:
        own = _rest(directions, _stribeck(speed, over))
        size = float(own @ plain) / max(float(own @ own), 1e-300)
        return plain - size * own, size

    # A Stribeck speed with hardly a row on its curve would fit the noise.
    # One of which the rows have the foot alone would be drawn out to any height at rest.
    tried = [
        top * share
        for share in STRIBECK
        if (_stribeck(np.abs(speed), share * top) > 0.3).sum() >= 8 and share > SEEN * slowest
    ]
    if not tried:
        return None
    best = min(tried, key=lambda over: float(left(over)[0] @ left(over)[0]))

    # By its logarithm, so that the speed stays above 0; where no row has the curve, any other is as good.
    def speed_of(there: Series) -> float:
        return max(math.exp(float(there[0])), 0.3 * slowest * top)

    refined = least_squares(lambda there: left(speed_of(there))[0], np.array([math.log(best)]))
    over = speed_of(refined.parameters)
    rest, more = left(over)
    if float(rest @ rest) > (1.0 - _MIN_GAIN) * float(plain @ plain):
        return None
    if not SEEN * slowest * top < over < 1.5 * STRIBECK[-1] * top:
        return None
    # The curve's own slope by its speed is a column too: how much friction there is more and over which speed
    # it falls are found together.
    bend = 2.0 * more * (speed / over) ** 2 / over * _stribeck(speed, over)
    curve = _stribeck(speed, over)
    slopes = np.column_stack([table, curve, bend])
    slopes = slopes / (sizes := np.sqrt((slopes**2).sum(axis=0)) + 1e-300)
    # Seven figures have been fitted: the five of the axis, the static friction and its speed.
    rows = max(1.0, len(given) * fit.period / max(fit.window, fit.period) - 7.0)
    spread = np.diag(np.linalg.pinv(slopes.T @ slopes)) / sizes**2 * float(rest @ rest) / rows
    error, speed_error = np.sqrt(np.maximum(spread[-2:], 0.0)).tolist()
    if more < SURE * error or more < _MIN_STATIC_SHARE * max(coulomb, 1e-12):
        return None
    blur = _blur(speed, acceleration, curve, over, fit)
    return StaticFriction(
        EstimatedFigure(more, math.hypot(error, blur * more)),
        EstimatedFigure(over, math.hypot(speed_error, 0.5 * blur * over)),
    )


def _blur(speed: Series, acceleration: Series, curve: Series, over: float, fit: FrictionFit) -> float:
    """Return by which share the curve is lower, and twice by which it is wider, as the speed changes within
    the filter: its bend at the top is 2 / over². The variance of three boxes and of the means of three rows
    before them is (width² + 1) / 4 squared rows. A filter that reaches a standstill, where friction may have
    any value, shows nothing.
    """
    rows = fit.window / fit.period
    change, width = np.abs(acceleration) * fit.period, (rows + 2.0) / 3.0
    fallen = np.minimum(1.0, (width**2 + 1.0) / 4.0 * (change / over) ** 2)
    lower = np.where(np.abs(speed) < 0.5 * (rows + 2.0) * change, 1.0, fallen)
    return float(np.average(lower, weights=curve**2))


def residual_doubts(fit: FrictionFit, unit: str) -> Iterator[str]:
    """Yield what the fit leaves that depends on the speed or on the position: friction that is no line,
    a screw, a cable, a bent rail.
    """
    used = fit.is_used
    rest = (fit.torque - fit.predicted)[used]
    size = float(np.sqrt(np.mean(fit.torque[used] ** 2)))
    way = np.cumsum(fit.velocity)[used] * fit.period
    for name, by in (("speed", fit.velocity[used]), ("position", way)):
        edges = np.linspace(float(by.min()), float(by.max()) + 1e-12, _BINS + 1)
        places = np.clip(np.digitize(by, edges) - 1, 0, _BINS - 1)
        counts = np.bincount(places, minlength=_BINS)
        means = np.bincount(places, weights=rest, minlength=_BINS) / np.maximum(counts, 1)
        explained = float((counts * means**2).sum() / max(float((rest**2).sum()), 1e-300))
        # A bin with less than an eighth of its share of the rows has a mean of noise.
        largest = float(np.abs(means[counts > len(rest) // (8 * _BINS)]).max(initial=0.0))
        if explained > _DEPENDS and largest > _MIN_BENEFIT * size:
            at = float(edges[int(np.argmax(np.abs(means)))])
            yield (
                f"What inertia and friction leave depends on the {name}: up to "
                f"{value_text(largest, unit, 2)},"
                f" most near {value_text(at * (60.0 if name == 'speed' else 1.0), '', 3)}; the "
                "friction of this"
                " axis is not the same everywhere"
            )
