"""The machine in a frequency response: acceleration, viscous friction, pairs of antiresonance and resonance,
delay.

The velocity for one unit of torque is A / (s + A b) times exp(-s T) times, for each pair at the motor, (s²/z²
+ 2 d s/z + 1) / (s²/p² + 2 e s/p + 1), or at the load 1 over the same (a load that swings behind its motor
has no antiresonance); a position has 1/s more, an acceleration s. The logarithm of measured by modelled
response is made small: gain in Np and phase in rad weigh equally, a decade above like a decade below (R.
Pintelon, J. Schoukens, *System Identification*, 2012, 9.11). A pair is added where the information criterion
of G. Schwarz (Annals of Statistics 6, 1978) becomes smaller by it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from amp_studio.sim.errors import SimulationError
from amp_studio.sim.series import Response, Series
from amp_studio.sim.tuning.sampled import Matrix

from .least_squares import LeastSquares, fit
from .response import FrequencyResponse

QUANTITIES = {"position": 1, "velocity": 0, "acceleration": -1}
"""What moves -> how often the velocity is integrated."""
_MAX_PAIRS = 3
_PLACES, _RATIOS, _DAMPING = 36, (0.25, 1.0, 3.0), 0.04
"""Frequencies at which a pair is tried first, ratios of load and motor, damping of the first try."""
_STARTS = 3
_WORSE = 1.5
"""Of the mean square residual: another quantity or side that is so much worse is another one."""
_MAX_CORNER = 0.3
"""Share of the highest frequency: an axis whose friction decides up to there is another quantity."""
_LOWEST_PAIR, _HIGHEST_PAIR = 1.5, 1.2
"""Times the lowest and the highest frequency between which a resonance is one."""
_MIN_RATIO = 1e-3
"""Load and motor: a smaller one is a pair that takes itself out, and none."""
_MIN_FIT = 0.35
"""Root mean square residual (Np and rad) from which a model does not describe a response."""


@dataclass(frozen=True)
class Pair:
    """Resonance and, at the motor, antiresonance before it, in Hz, with the damping ratio of the
    resonance.
    """

    resonance: float
    damping: float
    antiresonance: float | None
    most_damping: float
    """The larger damping ratio of resonance and antiresonance."""


@dataclass(frozen=True, eq=False)
class PlantFit:
    """The machine, in the unit of the response's motion, s and Hz; each figure with its standard
    deviation.
    """

    quantity: str
    at_load: bool
    figures: dict[str, tuple[float, float]]
    """acceleration_per_output (u/s²), viscous_friction (torque for 1 u/s), delay (s), and of the first pair
    resonance (Hz), damping, inertia_ratio."""
    pairs: tuple[Pair, ...]
    model: Response
    misfit: float
    """Root mean square of what is left, in Np and rad."""
    sure: bool
    """Whether no other quantity fits about as well."""


@dataclass(frozen=True)
class _Shape:
    quantity: str
    at_load: bool
    pairs: int

    def response(self, parameters: Series, s: Response) -> Response:
        """Return the model over s = j omega."""
        # Each parameter is about 1 where it matters (`least_squares.SMALL`): the size by its logarithm,
        # bounded as exp overflows; the friction by its root, so that it is not below 0; the delay in ms.
        size, friction, delay = math.exp(min(parameters[0], 300.0)), parameters[1] ** 2, parameters[2] * 1e-3
        found = size / (s + size * friction) * np.exp(-s * delay) / s ** QUANTITIES[self.quantity]
        for n in range(self.pairs):
            rate, ratio, damping, before_damping = np.exp(
                np.clip(parameters[3 + 4 * n : 7 + 4 * n], -40.0, 40.0)
            )
            under = s**2 / rate**2 + 2.0 * damping * s / rate + 1.0
            if self.at_load and n == 0:
                found = found * (1.0 + 2.0 * damping * s / rate) / under
            else:
                # At the antiresonance the load swings against a motor that rests, at the resonance both
                # swing.
                before = rate / math.sqrt(1.0 + ratio)
                found = found * (s**2 / before**2 + 2.0 * before_damping * s / before + 1.0) / under
        return np.asarray(found)

    def slopes(self, parameters: Series, s: Response) -> Response:
        """Return how the logarithm of the model changes with each parameter, a row each."""
        size = math.exp(min(parameters[0], 300.0))
        inertia = s + size * parameters[1] ** 2
        rows = [s / inertia, -2.0 * size * parameters[1] / inertia, -1e-3 * s]
        for n in range(self.pairs):
            rate, ratio, damping, before_damping = np.exp(
                np.clip(parameters[3 + 4 * n : 7 + 4 * n], -40.0, 40.0)
            )
            square, damped, none = (s / rate) ** 2, 2.0 * damping * s / rate, np.zeros_like(s)
            under, over = square + damped + 1.0, 1.0 + damped
            by_rate, by_damping = (2.0 * square + damped) / under, -damped / under
            if self.at_load and n == 0:
                rows += [by_rate - damped / over, none, by_damping + damped / over, none]
            else:
                square, before_damped = (1.0 + ratio) * square, 2.0 * before_damping * s / rate
                before_damped = before_damped * math.sqrt(1.0 + ratio)
                over = square + before_damped + 1.0
                by_before = -(2.0 * square + before_damped) / over
                by_ratio = -0.5 * ratio / (1.0 + ratio) * by_before
                rows += [by_rate + by_before, by_ratio, by_damping, before_damped / over]
        return np.array(rows)


def fit_plant(response: FrequencyResponse, quantity: str | None = None) -> PlantFit:
    """Return the machine of a response; ``quantity`` None finds out which of QUANTITIES it is of.

    The torque of a record is that of a drive, which keeps it for a sample, or of something finer: what fits
    better. Raises SimulationError for a response that such a machine does not have.
    """
    found = _fit_plant(response, quantity)
    if not response.period:
        return found
    kept = np.sinc(response.frequency * response.period)
    other = _fit_plant(replace(response, response=response.response / kept), quantity)
    return found if found.misfit < other.misfit else replace(other, model=other.model * kept)


def _fit_plant(response: FrequencyResponse, quantity: str | None) -> PlantFit:
    fits = [
        (shape, fitted)
        for name in QUANTITIES
        if quantity in (None, name)
        for shape, fitted in _fits(response, name)
        if _is_inside(shape, fitted, response)
        if quantity is not None or _corner(fitted) < _MAX_CORNER * response.frequency[-1]
    ]
    # Gain and phase of each frequency.
    count = 2 * len(response.frequency)
    if not fits:
        raise SimulationError(
            "The response has no frequencies at which inertia decides: measure up to higher ones"
        )
    fits.sort(key=lambda each: _criterion(each[1], count))
    shape, fitted = fits[0]
    weights = float(np.mean(response.weights**2))
    misfit = math.sqrt(fitted.cost / count / weights)
    if misfit > _MIN_FIT:
        raise SimulationError(
            f"The response is not that of inertia, friction, resonances and a delay: on average {misfit:.2g}"
            " Np or rad are left"
        )
    others = [other.cost for each, other in fits if each.quantity != shape.quantity]
    sure = all(cost > _WORSE * fitted.cost + 1e-9 for cost in others)
    s = _rates(response)
    return PlantFit(
        shape.quantity,
        shape.at_load,
        _figures(shape, fitted.parameters, _errors(response, s, shape, fitted)),
        tuple(_pairs(shape, fitted)),
        shape.response(fitted.parameters, s),
        misfit,
        sure,
    )


def _corner(fitted: LeastSquares) -> float:
    """Return the frequency in Hz from which inertia and not friction decides."""
    return (
        math.exp(min(float(fitted.parameters[0]), 300.0)) * float(fitted.parameters[1]) ** 2 / (2.0 * math.pi)
    )


def _rates(response: FrequencyResponse) -> Response:
    return np.asarray(2j * np.pi * response.frequency, dtype=np.complex128)


def _is_inside(shape: _Shape, fitted: LeastSquares, response: FrequencyResponse) -> bool:
    """Return whether every resonance is among the frequencies and swings.

    One beside them, or one that creeps, takes the place of an integral or a difference, so that another
    quantity would fit as well.
    """
    lowest, highest = float(response.frequency[0]), float(response.frequency[-1])
    return all(
        _LOWEST_PAIR * lowest < pair.resonance < _HIGHEST_PAIR * highest and pair.most_damping < 1.0
        for pair in _pairs(shape, fitted)
    )


def _criterion(fitted: LeastSquares, count: int) -> float:
    # A response that was computed leaves nothing, whose logarithm is no number.
    return count * math.log(fitted.cost + 1e-20) + len(fitted.parameters) * math.log(count)


def _fits(response: FrequencyResponse, quantity: str) -> Iterator[tuple[_Shape, LeastSquares]]:
    """Yield fits of one quantity with more and more pairs, on both sides of the machine."""
    s, count = _rates(response), 2 * len(response.frequency)
    rigid = _Shape(quantity, False, 0)
    first = _best(response, s, rigid, [_start(response, s, rigid, ())])
    yield rigid, first
    for at_load in (False, True):
        shape, best = rigid, first
        for pairs in range(1, _MAX_PAIRS + 1):
            # Four values for each parameter, or a pair would fit the noise.
            if count < 4 * (3 + 4 * pairs):
                break
            more = _Shape(quantity, at_load, pairs)
            fitted = _best(response, s, more, _starts(response, s, more, best.parameters))
            if _criterion(fitted, count) >= _criterion(best, count):
                break
            shape, best = more, fitted
            yield shape, best


def _residual(response: FrequencyResponse, s: Response, shape: _Shape, parameters: Series) -> Series:
    with np.errstate(all="ignore"):
        rest = np.log(response.response / shape.response(parameters, s))
    # As bad as can be and yet finite, so that the search turns back from there.
    rest = np.where(np.isfinite(rest), rest, 1e3)
    return np.concatenate([response.weights * rest.real, response.weights * rest.imag])


def _slopes(response: FrequencyResponse, s: Response, shape: _Shape, parameters: Series) -> Matrix:
    with np.errstate(all="ignore"):
        rows = shape.slopes(parameters, s)
    weighed = np.where(np.isfinite(rows), rows, 0.0) * -response.weights
    return np.concatenate([weighed.real, weighed.imag], axis=1).T


def _best(response: FrequencyResponse, s: Response, shape: _Shape, starts: Sequence[Series]) -> LeastSquares:
    fits = [
        fit(lambda p: _residual(response, s, shape, p), start, lambda p: _slopes(response, s, shape, p))
        for start in starts
    ]
    return min(fits, key=lambda each: each.cost)


def _start(response: FrequencyResponse, s: Response, shape: _Shape, pairs: Sequence[float]) -> Series:
    """Return parameters whose size and delay fit best to the pairs: both are linear in the logarithm."""
    there = np.array([0.0, 1e-3, 0.0, *pairs])
    ratio = response.response / shape.response(there, s)
    size = float(np.average(np.log(np.abs(ratio)), weights=response.weights**2))
    phase, omega, weights = np.unwrap(np.angle(ratio)), s.imag, response.weights**2
    # A whole turn is no delay.
    phase -= 2.0 * np.pi * np.round(phase[0] / (2.0 * np.pi))
    there[0], there[2] = (
        size,
        # No machine acts before it is driven.
        max(0.0, -1e3 * float((weights * omega * phase).sum() / (weights * omega**2).sum())),
    )
    return there


def _starts(response: FrequencyResponse, s: Response, shape: _Shape, known: Series) -> list[Series]:
    """Return the starts with one pair more that fit best as they are."""
    tried = []
    for rate in np.geomspace(s.imag[1], s.imag[-1] * 1.2, _PLACES):
        for ratio in _RATIOS:
            pairs = [*known[3:], math.log(rate), math.log(ratio), math.log(_DAMPING), math.log(_DAMPING)]
            start = _start(response, s, shape, pairs)
            rest = _residual(response, s, shape, start)
            tried.append((float(rest @ rest), start))
    return [start for _, start in sorted(tried, key=lambda each: each[0])[:_STARTS]]


def _errors(response: FrequencyResponse, s: Response, shape: _Shape, fitted: LeastSquares) -> Series:
    """Return the standard deviation of each parameter.

    What the model does not describe is alike in neighbouring frequencies, which are then fewer than they
    seem (W. Newey, K. West, Econometrica 55, 1987). What is above half of the sampling frequency of a
    record is folded back, which shifts the parameters; nothing in the record shows how the torque was
    between its rows, so that this shift is an uncertainty.
    """
    slopes, count = _slopes(response, s, shape, fitted.parameters), len(response.frequency)
    pushes = slopes[:count] * fitted.residual[:count, None] + slopes[count:] * fitted.residual[count:, None]
    lags = max(3, round(1.5 * count ** (1.0 / 3.0)))
    spread = pushes.T @ pushes
    for lag in range(1, min(lags, count - 1) + 1):
        beside = pushes[lag:].T @ pushes[:-lag]
        spread += (1.0 - lag / (lags + 1.0)) * (beside + beside.T)
    inverse = np.linalg.pinv(slopes.T @ slopes)
    freedom = 2 * count / max(1, 2 * count - len(fitted.parameters))
    alike = freedom * np.diag(inverse @ spread @ inverse)
    off = [_folded(response, s, shape, fitted.parameters)]
    off += [
        np.concatenate([response.weights * e.real, response.weights * e.imag]) for e in response.open_ends
    ]
    shifts = sum((inverse @ (slopes.T @ each)) ** 2 for each in off)
    return np.asarray(np.sqrt(np.maximum(alike, np.diag(fitted.covariance)) + shifts))


def _folded(response: FrequencyResponse, s: Response, shape: _Shape, parameters: Series) -> Series:
    """Return the residual of what is folded back where a torque is kept for a sample."""
    weights, period = response.weights, response.period
    if not period:
        return np.zeros(2 * len(weights))
    own = shape.response(parameters, s) * np.sinc(response.frequency * period)
    other = sum(
        shape.response(parameters, s - 2j * np.pi * n / period) * np.sinc(response.frequency * period - n)
        for n in (-2, -1, 1, 2)
    )
    with np.errstate(all="ignore"):
        rest = np.log(1.0 + other / own)
    rest = np.where(np.isfinite(rest), rest, 0.0)
    return np.concatenate([weights * rest.real, weights * rest.imag])


def _figures(shape: _Shape, parameters: Series, errors: Series) -> dict[str, tuple[float, float]]:
    size, root = math.exp(parameters[0]), abs(float(parameters[1]))
    found = {
        "acceleration_per_output": (size, size * float(errors[0])),
        # Of a square: at 0, where its slope is none, the square of the error is left.
        "viscous_friction": (root**2, 2.0 * root * float(errors[1]) + float(errors[1]) ** 2),
        "delay": (float(parameters[2]) * 1e-3, float(errors[2]) * 1e-3),
    }
    if shape.pairs:
        rate, ratio, damping = (math.exp(each) for each in parameters[3:6])
        found["resonance"] = rate / (2.0 * math.pi), rate / (2.0 * math.pi) * float(errors[3])
        found["damping"] = damping, damping * float(errors[5])
        if not shape.at_load and ratio > _MIN_RATIO:
            found["inertia_ratio"] = ratio, ratio * float(errors[4])
    return found


def _pairs(shape: _Shape, fitted: LeastSquares) -> Iterator[Pair]:
    for n in range(shape.pairs):
        rate, ratio, damping, before_it = (
            math.exp(each) for each in fitted.parameters[3 + 4 * n : 7 + 4 * n]
        )
        before = None if shape.at_load and n == 0 else rate / math.sqrt(1.0 + ratio) / (2.0 * math.pi)
        most = damping if before is None else max(damping, before_it)
        yield Pair(rate / (2.0 * math.pi), damping, before, most)
