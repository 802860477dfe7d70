"""The linear model of an axis, sampled as its control samples it: margins, bandwidth and poles.

The law is not written twice: its own sample functions are differentiated at rest, where a linear function is zero, so that the
differences are exact to rounding. The position loop is cut where the control measures the position, with every inner loop closed.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from . import signals
from .compiled import Sample
from .law import AxisLaw
from .sampled import Matrix, Places, SampledLoop, jacobian, plant_of, sampled
from .series import Response

_POINTS = 2400
"""Points of the grid on which crossings are sought before they are refined."""
WELL_APART = 1e6
"""Condition of the eigenvectors up to which they are used: nine digits of the response are left."""
SHARP = 0.3
"""Damping ratio of a pole around which the grid is closer."""
CLOSE = 41
"""Points of the grid around a pole."""
HALVINGS, COARSE = 48, 12
"""Halvings of the space between two points around a crossing, for a figure and for a value that is tried."""
_LOWEST = 1e-4
"""Lowest frequency of the grid as a share of the sampling frequency."""
_NOTHING = 1e-300
"""Keeps the logarithm of a response of 0 finite."""
HALF_POWER = math.sqrt(0.5)
"""Share of the amplitude at the bandwidth: -3 dB."""


@dataclass(frozen=True)
class Margins:
    """Distance of a loop from its limit of stability; None where the loop does not cross."""

    phase: float | None
    """deg"""
    phase_frequency: float | None
    """Hz, where the gain of the loop is 1."""
    gain: float | None
    """dB; negative: the gain must be lowered by so much."""
    gain_frequency: float | None
    """Hz, where the phase of the loop is -180 deg."""


class LinearModel(SampledLoop):
    """Stability, margins and response of a sampled loop."""

    @property
    def nyquist(self) -> float:
        """Highest frequency in Hz that the samples can distinguish."""
        return 0.5 / self.period

    def poles(self) -> Response:
        """Return the poles of the closed loop in the z plane, the slowest first."""
        return self._poles

    @cached_property
    def _poles(self) -> Response:
        found = np.linalg.eigvals(self.closed).astype(np.complex128)
        return found[np.argsort(-np.abs(found))]

    def is_stable_inside(self) -> bool:
        """Return whether the loop is stable where it is cut: what is inside of it does not run away by itself."""
        return bool(np.all(np.abs(np.linalg.eigvals(self.open)) < 1.0 + 1e-7))

    def is_stable(self, *, drift: bool = False) -> bool:
        """Return whether every motion of the closed loop dies away; with ``drift`` a position may stay where it is."""
        return bool(np.all(np.abs(self.poles()) < (1.0 + 1e-7 if drift else 1.0 - 1e-9)))

    def loop(self, frequencies: Matrix) -> Response:
        """Return the open position loop at frequencies in Hz: from position error to position."""
        z = self._z(frequencies)
        if self._modes is None:
            return -_response(self.open, self.measured, self.sensed, z)
        closed = self._answer(self.measured, self.sensed, z)
        return np.asarray(-closed / (1.0 + closed))

    def follows(self, frequencies: Matrix) -> Response:
        """Return the closed loop: from commanded to actual position, feed-forward included."""
        z, turn = self._z(frequencies), 2j * math.pi * frequencies
        parts = [self._answer(self.command[:, [n]], self.position, z) for n in range(3)]
        return np.asarray(parts[0] + turn * parts[1] + turn**2 * parts[2])

    def forwards_velocity(self) -> bool:
        """Return whether the law uses velocity or acceleration of the command."""
        return bool(np.any(self.command[:, 1:] != 0.0))

    def forwards_position(self) -> bool:
        """Return whether the law uses the commanded position for more than the position error."""
        grid = np.geomspace(_LOWEST, 0.4, 20) / self.period
        wanted = self._answer(self.command[:, [0]], self.sensed, self._z(grid))
        return not np.allclose(wanted, self.feedback(grid), rtol=1e-3)

    def feedback(self, frequencies: Matrix) -> Response:
        """Return the closed loop without feed-forward: L / (1 + L)."""
        loop = self.loop(frequencies)
        return np.asarray(loop / (1.0 + loop))

    def grid(self, points: int = _POINTS) -> Matrix:
        """Return frequencies in Hz up to Nyquist, close together where a pole is."""
        low = _LOWEST / self.period
        even = np.geomspace(low, self.nyquist, points)
        found = np.concatenate([self.poles(), np.linalg.eigvals(self.open)])
        rates = np.log(found[np.abs(found) > 1e-6])
        sharp = rates[np.abs(rates.real) < SHARP * np.abs(rates)]
        peaks = np.abs(sharp.imag) / (2.0 * math.pi * self.period)
        close = np.geomspace(0.8, 1.25, CLOSE if points >= _POINTS else CLOSE // 4)
        near = (peaks[:, None] * close[None, :]).ravel()
        every = np.concatenate([even, near[(near > low) & (near < self.nyquist)]])
        return np.unique(every)

    def margins(self, points: int = _POINTS) -> Margins:
        """Return the least phase and gain margin of the loop, sought on a grid of ``points`` frequencies and more at poles."""
        grid = self.grid(points)
        halvings = HALVINGS if points >= _POINTS else COARSE
        size = _crossings(lambda f: np.log(np.abs(self.loop(f)) + _NOTHING), grid, halvings)
        phase = _least([(_phase_margin(self._at(f)), f) for f in size])
        real = _crossings(lambda f: self.loop(f).imag, grid, halvings)
        gains = [(-20.0 * math.log10(abs(at)), f) for f in [*real, self.nyquist] if (at := self._at(f)).real < 0.0
                 and abs(at.imag) < 1e-3 * abs(at)]  # fmt: skip
        gain = _least(gains)
        return Margins(*phase, *gain)

    def bandwidth(self) -> float | None:
        """Return the frequency in Hz from which the axis follows less than -3 dB; None if it always does."""
        grid = self.grid()
        fall = _crossings(lambda f: np.log(np.abs(self.follows(f)) / HALF_POWER + _NOTHING), grid)
        return fall[0] if fall else None

    def oscillations(self) -> list[tuple[float, float]]:
        """Return (rate in 1/s, damping ratio) of every oscillation of the closed loop."""
        poles = self.poles()
        rates = np.log(poles[np.abs(poles) > 1e-9]) / self.period
        swinging = rates[rates.imag > 1e-6 * np.abs(rates)]
        return [(float(abs(rate)), float(-rate.real / abs(rate))) for rate in swinging]

    def least_damping(self) -> float:
        """Return the least damping ratio of the closed loop's oscillations; 1 if there is none."""
        return min((damping for _, damping in self.oscillations()), default=1.0)

    @cached_property
    def _modes(self) -> tuple[Response, Response, Response] | None:
        """Poles and eigenvectors of the closed loop, both ways, by which many frequencies cost little; None where they are
        too close together for that.
        """
        values, vectors = np.linalg.eig(self.closed)
        if not values.size or np.linalg.cond(vectors) > WELL_APART:
            return None
        return (
            values.astype(np.complex128),
            vectors.astype(np.complex128),
            np.linalg.inv(vectors).astype(np.complex128),
        )

    def _answer(self, b: Matrix, c: Matrix, z: Response) -> Response:
        """Return c (z - closed)^-1 b for every z."""
        if self._modes is None:
            return _response(self.closed, b, c, z)
        values, vectors, inverse = self._modes
        shares = (c @ vectors)[0] * (inverse @ b)[:, 0]
        return np.asarray((shares / (z[:, None] - values)).sum(axis=1))

    def _z(self, frequencies: Matrix) -> Response:
        return np.asarray(np.exp(2j * math.pi * np.asarray(frequencies) * self.period))

    def _at(self, frequency: float) -> complex:
        return complex(self.loop(np.array([frequency]))[0])


def linear_model(axis: AxisLaw) -> LinearModel:
    """Return the model of the position loop of an axis, its velocity loop closed."""
    plant = plant_of(axis.machine)
    position = _law_matrix(axis, axis.position_sample)
    velocity = _law_matrix(axis, axis.velocity_sample) if axis.velocity_sample else None
    places = _places(axis)
    loop = sampled(plant, position, velocity, places, axis.servo_period, axis.velocity_period)
    return LinearModel(**vars(loop))


NEAR = 3.0
"""An oscillation this many times faster than the position loop is that of another loop."""


@dataclass(frozen=True)
class AxisModel:
    """The linear models of one axis."""

    whole: LinearModel
    """From the command to the position."""
    cut: LinearModel
    """The position loop, cut where the position is measured."""
    inner: LinearModel | None
    """The velocity loop alone; None for a law without one."""

    def damping(self, crossing: float | None) -> float:
        """Return the damping ratio of the position loop: of the slowest oscillation near ``crossing``, the frequency in Hz where its
        gain is 1; 1 for none.
        """
        nearest = math.inf if crossing is None else NEAR * 2.0 * math.pi * crossing
        pairs = [pair for pair in self.whole.oscillations() if pair[0] < nearest]
        return min(pairs)[1] if pairs else 1.0


def axis_model(axis: AxisLaw) -> AxisModel:
    """Return the models of an axis; a law that closes its position loop with the motor's device is cut there."""
    whole, inner = linear_model(axis), velocity_model(axis)
    if inner is not None and not np.any(whole.measured):
        return AxisModel(whole, inner, None)
    return AxisModel(whole, whole, inner)


def velocity_model(axis: AxisLaw) -> LinearModel | None:
    """Return the model of the velocity loop alone, cut where it measures the motor; None for a law without one."""
    if axis.velocity_sample is None:
        return None
    places = _places(axis)
    swapped = {**places.signals, "position": places.signals["motor"], "motor": places.signals["position"]}
    matrix = _law_matrix(axis, axis.velocity_sample)
    period = axis.servo_period / max(1, round(axis.servo_period / axis.velocity_period))
    return LinearModel(**vars(sampled(plant_of(axis.machine), matrix, None, Places(swapped), period, period)))


def _places(axis: AxisLaw) -> Places:
    first = axis.state_size
    names = {
        "command": signals.COMMAND,
        "command_velocity": signals.COMMAND_VELOCITY,
        "command_acceleration": signals.COMMAND_ACCELERATION,
        "position": signals.POSITION,
        "motor": signals.MOTOR,
        "output": signals.OUTPUT,
    }
    return Places({name: first + index for name, index in names.items()}, axis.machine.load_sensor)


def _law_matrix(axis: AxisLaw, function: Sample) -> Matrix:
    """Return the matrix of a sample function over its state and signals, at rest."""
    given = axis.parameters if axis.linear_parameters is None else axis.linear_parameters
    parameters, states = [float(each) for each in given], axis.state_size
    rest = np.zeros(states + signals.MONITOR + len(axis.monitors))
    rest[states + signals.FEED_SHARE], rest[states + signals.MODE] = 1.0, signals.POSITION_LOOP

    def sample(z: Matrix) -> Matrix:
        s, io = z[:states].tolist(), z[states:].tolist()
        function(parameters, s, io)
        return np.array([*s, *io])

    return jacobian(sample, rest)


def _response(a: Matrix, b: Matrix, c: Matrix, z: Response) -> Response:
    """Return c (z - a)^-1 b for every z."""
    system = z[:, None, None] * np.eye(len(a)) - a
    return np.asarray((c @ np.linalg.solve(system, np.broadcast_to(b, (len(z), *b.shape))))[:, 0, 0])


def _crossings(function: Callable[[Matrix], Matrix], grid: Matrix, halvings: int = HALVINGS) -> list[float]:
    """Return where a function of the frequency changes its sign, refined by halving."""
    values = function(grid)
    changes = np.flatnonzero((values[:-1] > 0.0) != (values[1:] > 0.0))
    low, high, sign = grid[changes], grid[changes + 1], values[changes] > 0.0
    for _ in range(halvings):
        middle = 0.5 * (low + high)
        same = (function(middle) > 0.0) == sign if middle.size else sign
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return [float(f) for f in 0.5 * (low + high)]


def _phase_margin(at: complex) -> float:
    return (math.degrees(math.atan2(at.imag, at.real)) + 180.0 + 180.0) % 360.0 - 180.0


def _least(found: Sequence[tuple[float, float]]) -> tuple[float | None, float | None]:
    return min(found, key=lambda margin: abs(margin[0])) if found else (None, None)
