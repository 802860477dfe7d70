"""The linear model of an axis, sampled as its control samples it: margins, bandwidth and poles.

The law is not written twice: its own sample functions are differentiated at rest, where a linear function is
zero, so that the differences are exact to rounding. The position loop is cut where the control measures the
position, with every inner loop closed.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from amp_studio.sim.engine import signals
from amp_studio.sim.engine.compiled import Sample
from amp_studio.sim.law import AxisLaw
from amp_studio.sim.series import Response

from .sampled import Matrix, Places, SampledLoop, jacobian, plant_of, sampled

_POINTS = 2400
"""Points of the grid on which crossings are sought before they are refined."""
_WELL_APART = 1e6
"""Condition of the eigenvectors up to which they are used: nine digits of the response are left."""
_SHARP = 0.3
"""Damping ratio of a pole around which the grid is closer."""
CLOSE = 41
"""Points of the grid around a pole."""
_SLOWER = 20.0
"""Ten times below the slowest pole the grid begins at the latest."""
_WIDTHS = np.array([-4.0, -2.5, -1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5, 2.5, 4.0])
"""Half-widths of its peak beside a pole at which the grid has points."""
_HALVINGS, _COARSE = 48, 12
"""Halvings of the space between two points around a crossing, for a figure and for a value that is tried."""
_LOWEST = 1e-4
"""Lowest frequency of the grid as a share of the sampling frequency."""
_NOTHING = 1e-300
"""Keeps the logarithm of a response of 0 finite."""
_LONGEST_STEP = 20.0
"""s that a push on the axis is followed for."""
_JOLTED = 12
"""Samples within which a count moves the output most: longer than the first peak of a filter."""
_HALF_POWER = math.sqrt(0.5)
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
        found = self._eigen[0]
        return found[np.argsort(-np.abs(found))]

    @cached_property
    def _eigen(self) -> tuple[Response, Response]:
        """Poles and eigenvectors of the closed loop."""
        values, vectors = np.linalg.eig(self.closed)
        return values.astype(np.complex128), vectors.astype(np.complex128)

    def is_stable_inside(self) -> bool:
        """Return whether the loop is stable where it is cut:
        what is inside of it does not run away by itself.
        """
        # An integrator has a pole at z = 1. Two of them together are found with an error of about the root of
        # the rounding, 1.5e-8, so that a narrower bound would call them unstable.
        return bool(np.all(np.abs(np.linalg.eigvals(self.open)) < 1.0 + 1e-7))

    def is_stable(self, *, drift: bool = False) -> bool:
        """Return whether every motion of the closed loop dies away;
        with ``drift`` a position may stay where it is.
        """
        return bool(np.all(np.abs(self.poles()) < (1.0 + 1e-7 if drift else 1.0 - 1e-9)))

    def drifts(self) -> bool:
        """Return whether nothing measures the position: the pole at 1 is the open integrator,
        no instability.
        """
        return not np.any(self.measured) and not self.is_stable() and self.is_stable(drift=True)

    def loop(self, frequencies: Matrix) -> Response:
        """Return the open position loop at frequencies in Hz: from position error to position."""
        z = self._z(frequencies)
        if self._modes is None:
            return -_response(self.open, self.measured, self.sensed, z)
        # The open loop out of the closed one, whose modes are known.
        closed = self._answer(self.measured, self.sensed, z)
        return np.asarray(-closed / (1.0 + closed))

    def follows(self, frequencies: Matrix) -> Response:
        """Return the closed loop: from commanded to actual position, feed-forward included."""
        z, turn = self._z(frequencies), 2j * math.pi * frequencies
        parts = [self._answer(self.command[:, [n]], self.position, z) for n in range(3)]
        # Velocity and acceleration of the command are jω and (jω)² of its position.
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
        found = np.concatenate([self.poles(), np.linalg.eigvals(self.open)])
        return _around(found, self.period, points, CLOSE if points >= _POINTS else CLOSE // 4)

    def margins(self, points: int = _POINTS) -> Margins:
        """Return the least phase and gain margin of the loop,
        sought on a grid of ``points`` frequencies and more at poles.
        """
        grid = self.grid(points)
        halvings = _HALVINGS if points >= _POINTS else _COARSE
        size = _crossings(lambda f: np.log(np.abs(self.loop(f)) + _NOTHING), grid, halvings)
        phase = _least([(_phase_margin(self._at(f)), f) for f in size])
        real = _crossings(lambda f: self.loop(f).imag, grid, halvings)
        # At Nyquist the response is real, without a change of sign; at a pole the sign changes and the
        # response is not real.
        gains = [
            (-20.0 * math.log10(abs(at)), f)
            for f in [*real, self.nyquist]
            if (at := self._at(f)).real < 0.0 and abs(at.imag) < 1e-3 * abs(at)
        ]
        gain = _least(gains)
        return Margins(*phase, *gain)

    def sensitivity(self) -> tuple[float, float]:
        """Return Ms, the largest size of the sensitivity 1 / (1 + L), and its frequency in Hz: 1 / Ms is the
        least distance of the Nyquist curve from -1.
        """
        grid = self.grid()
        # Twice closer around the largest one: the peak of a sharp resonance lies between two points of
        # the first grid.
        for _ in range(2):
            size = np.abs(1.0 / (1.0 + self.loop(grid)))
            most = int(np.argmax(size))
            low, high = grid[max(0, most - 1)], grid[min(len(grid) - 1, most + 1)]
            grid = np.linspace(low, high, CLOSE)
        size = np.abs(1.0 / (1.0 + self.loop(grid)))
        most = int(np.argmax(size))
        return float(size[most]), float(grid[most])

    def quick(self, points: int) -> tuple[Margins, float]:
        """Return margins and Ms by straight lines between ``points`` frequencies: within half a percent,
        for values that are tried.
        """
        grid = _around(self.poles(), self.period, points, CLOSE // 4)
        loop = self.loop(grid)
        size, angle = np.log(np.abs(loop) + _NOTHING), np.angle(loop)
        at = np.flatnonzero((size[:-1] > 0.0) != (size[1:] > 0.0))
        share = size[at] / (size[at] - size[at + 1])
        turn = (angle[at + 1] - angle[at] + math.pi) % (2.0 * math.pi) - math.pi
        phases = [((p + math.pi + math.pi) % (2.0 * math.pi)) - math.pi for p in angle[at] + share * turn]
        crossed = np.exp(np.log(grid[at]) + share * np.log(grid[at + 1] / grid[at]))
        real = np.flatnonzero(((loop.imag[:-1] > 0.0) != (loop.imag[1:] > 0.0)) & (loop.real[1:] < 0.0))
        part = loop.imag[real] / (loop.imag[real] - loop.imag[real + 1])
        gains = size[real] + part * (size[real + 1] - size[real])
        turned = grid[real] + part * (grid[real + 1] - grid[real])
        found = [(-20.0 / math.log(10.0) * gain, f) for gain, f in zip(gains, turned, strict=True)]
        if loop[-1].real < 0.0 and abs(loop[-1].imag) < 1e-3 * abs(loop[-1]):
            found.append((-20.0 / math.log(10.0) * float(size[-1]), self.nyquist))
        phase = _least([(math.degrees(p), f) for p, f in zip(phases, crossed, strict=True)])
        return Margins(*phase, *_least(found)), float(np.max(1.0 / np.abs(1.0 + loop)))

    def yields(self, window: float) -> tuple[float, float]:
        """Return the largest way of the load for one unit of torque that comes at once and stays, and its
        mean in the first ``window`` s; infinite for an axis that is not stable.
        """
        slowest = float(np.max(np.abs(self._poles), initial=0.0))
        if slowest >= 1.0 - 1e-12:
            return math.inf, math.inf
        # Until the slowest pole has left a ten thousandth.
        needed = math.log(1e-4) / math.log(slowest) if slowest > 0.0 else 1.0
        steps = math.ceil(min(max(needed, window / self.period + 1.0), _LONGEST_STEP / self.period))
        way = np.abs(self.pushed_way(steps))
        # A push that is not followed to its end stays where (I - A)⁻¹ puts it.
        stays = float(
            (self.position @ np.linalg.solve(np.eye(len(self.closed)) - self.closed, self.pushed))[0, 0]
        )
        return max(float(way.max()), abs(stays)), float(way[: max(1, round(window / self.period))].mean())

    def pushed_way(self, steps: int) -> Matrix:
        """Return the position of the load at so many samples after one unit of torque came,
        from a sample later on.
        """
        # The push is a state that stays, and the way at sample n + m is (c Aⁿ)(Aᵐ x): two short ways, each
        # made twice as long in a step, instead of a long one of all states.
        size = len(self.closed)
        move = np.block([[self.closed, self.pushed], [np.zeros((1, size)), np.ones((1, 1))]])
        rows, states = np.hstack([self.position, [[0.0]]]), np.eye(size + 1)[:, -1:]
        while len(rows) ** 2 <= steps:
            rows, move = np.vstack([rows, rows @ move]), move @ move
        while len(rows) * states.shape[1] <= steps:
            states, move = np.hstack([states, move @ states]), move @ move
        return np.asarray((rows @ states).T.ravel()[1 : steps + 1])

    def bandwidth(self, *, forward: bool = True) -> float | None:
        """Return the frequency in Hz from which the axis follows less than -3 dB,
        with its feed-forward or without; None if it always does.
        """
        answer = self.follows if forward else self.feedback
        fall = _crossings(lambda f: np.log(np.abs(answer(f)) / _HALF_POWER + _NOTHING), self.grid())
        return fall[0] if fall else None

    def oscillations(self) -> list[tuple[float, float]]:
        """Return (rate in 1/s, damping ratio) of every oscillation of the closed loop."""
        poles = self.poles()
        # A pole at 0 is over in one sample and has no rate; of a pair one is taken.
        rates = np.log(poles[np.abs(poles) > 1e-9]) / self.period
        swinging = rates[rates.imag > 1e-6 * np.abs(rates)]
        return [(float(abs(rate)), float(-rate.real / abs(rate))) for rate in swinging]

    def least_damping(self) -> float:
        """Return the least damping ratio of the closed loop's oscillations; 1 if there is none."""
        return min((damping for _, damping in self.oscillations()), default=1.0)

    @cached_property
    def _modes(self) -> tuple[Response, Response, Response] | None:
        """Poles and eigenvectors of the closed loop, both ways, by which many frequencies cost little; None
        where they are too close together for that.
        """
        values, vectors = self._eigen
        if not values.size:
            return None
        try:
            inverse = np.asarray(np.linalg.inv(vectors), dtype=np.complex128)
        except np.linalg.LinAlgError:
            return None
        if np.linalg.norm(vectors) * np.linalg.norm(inverse) > _WELL_APART:  # a bound of the condition
            return None
        return values, vectors, inverse

    def _answer(self, b: Matrix, c: Matrix, z: Response) -> Response:
        """Return c (z - closed)^-1 b for every z."""
        if self._modes is None:
            return _response(self.closed, b, c, z)
        values, vectors, inverse = self._modes
        # A sum of first-order terms, one for each pole: many frequencies cost one multiplication each.
        shares = (c @ vectors)[0] * (inverse @ b)[:, 0]
        return np.asarray((shares / (z[:, None] - values)).sum(axis=1))

    def _z(self, frequencies: Matrix) -> Response:
        return np.asarray(np.exp(2j * math.pi * np.asarray(frequencies) * self.period))

    def _at(self, frequency: float) -> complex:
        return complex(self.loop(np.array([frequency]))[0])


@dataclass(frozen=True, eq=False)
class LawMatrices:
    """The two sample functions of a law at rest, each as a matrix over its states and signals."""

    position: Matrix
    velocity: Matrix | None
    places: Places
    loops: int = 1
    """Velocity samples in a position sample."""

    @classmethod
    def of(cls, axis: AxisLaw) -> LawMatrices:
        """Return those of an axis; its machine has no part in them."""
        velocity = _law_matrix(axis, axis.velocity_sample) if axis.velocity_sample else None
        loops = max(1, round(axis.servo_period / axis.velocity_period)) if velocity is not None else 1
        return cls(_law_matrix(axis, axis.position_sample), velocity, _places(axis), loops)

    def jolt(self) -> float:
        """Return by how much one unit of the measured position, which stays, moves the output at most in
        `_JOLTED` samples: a filter spreads it over several.
        """
        signal, most = self.places.signals, 0.0
        measured = [signal["position"], signal["motor"]]
        z = np.zeros((len(self.position), 1))
        for n in range(_JOLTED):
            z[measured] = 1.0
            if n % self.loops == 0:
                z = self.position @ z
            if self.velocity is not None:
                z[signal["motor"]] = 1.0
                z = self.velocity @ z
            most = max(most, abs(float(z[signal["output"], 0])))
        return most


def linear_model(axis: AxisLaw, law: LawMatrices | None = None) -> LinearModel:
    """Return the model of the position loop of an axis, its velocity loop closed;
    ``law`` where it is known already.
    """
    law = law or LawMatrices.of(axis)
    plant = plant_of(axis.machine)
    loop = sampled(plant, law.position, law.velocity, law.places, axis.servo_period, axis.velocity_period)
    return LinearModel(**vars(loop))


_NEAR = 3.0
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
        """Return the damping ratio of the position loop: of the slowest oscillation near ``crossing``, the
        frequency in Hz where its gain is 1; 1 for none, and for a loop that never has that gain.
        """
        if crossing is None:
            return 1.0
        nearest = _NEAR * 2.0 * math.pi * crossing
        pairs = [pair for pair in self.whole.oscillations() if pair[0] < nearest]
        return min(pairs)[1] if pairs else 1.0


def axis_model(axis: AxisLaw, law: LawMatrices | None = None) -> AxisModel:
    """Return the models of an axis; a law that closes its position loop with the motor's device is cut
    there.
    """
    law = law or LawMatrices.of(axis)
    whole, inner = linear_model(axis, law), velocity_model(axis, law)
    if inner is not None and not np.any(whole.measured):
        return AxisModel(whole, inner, None)
    return AxisModel(whole, whole, inner)


def velocity_model(axis: AxisLaw, law: LawMatrices | None = None) -> LinearModel | None:
    """Return the model of the velocity loop alone, cut where it measures the motor;
    None for a law without one.
    """
    law = law or LawMatrices.of(axis)
    if law.velocity is None:
        return None
    signal = law.places.signals
    # Cut where it measures the motor, as the position loop is cut at its position: the two signals
    # change places.
    swapped = {**signal, "position": signal["motor"], "motor": signal["position"]}
    period = axis.servo_period / max(1, round(axis.servo_period / axis.velocity_period))
    loop = sampled(plant_of(axis.machine), law.velocity, None, Places(swapped), period, period)
    return LinearModel(**vars(loop))


def _places(axis: AxisLaw) -> Places:
    """Return where the signals are in the state of the linear loop: behind those of the law."""
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
    # Differentiated where the loop is closed and the feed full: elsewhere a law has other branches.
    rest[states + signals.FEED_SHARE], rest[states + signals.MODE] = 1.0, signals.POSITION_LOOP

    def sample(z: Matrix) -> Matrix:
        s, io = z[:states].tolist(), z[states:].tolist()
        function(parameters, s, io)
        return np.array([*s, *io])

    return jacobian(sample, rest)


@lru_cache(maxsize=32)
def _even(period: float, points: int) -> Matrix:
    """Return frequencies in Hz up to Nyquist."""
    return np.asarray(np.geomspace(_LOWEST / period, 0.5 / period, points))


def _around(poles: Response, period: float, points: int, close: int) -> Matrix:
    """Return frequencies in Hz up to Nyquist, ``close`` more around each pole that rings."""
    even = _even(period, points)
    rates = np.log(poles[np.abs(poles) > 1e-6])
    moving = np.abs(rates)[np.abs(rates) > 1e-9]
    lowest = float(moving.min(initial=1.0)) / (_SLOWER * math.pi * period)
    if lowest < even[0]:  # a loop that is slower than the grid begins
        even = np.concatenate([np.geomspace(lowest, even[0], points // 4, endpoint=False), even])
    sharp = rates[(np.abs(rates.real) < _SHARP * np.abs(rates)) & (rates.imag > 0.0)]
    if not sharp.size:
        return even
    peaks, widths = sharp.imag / (2.0 * math.pi * period), -sharp.real / np.abs(sharp)
    wide = peaks[:, None] * np.geomspace(0.8, 1.25, close)[None, :]
    # Close to the pole in widths of its resonance, and farther out in shares of its frequency.
    fine = peaks[:, None] * (1.0 + widths[:, None] * _WIDTHS[None, :])
    near = np.concatenate([wide.ravel(), fine.ravel()])
    return np.unique(np.concatenate([even, near[(near > even[0]) & (near < even[-1])]]))


def _response(a: Matrix, b: Matrix, c: Matrix, z: Response) -> Response:
    """Return c (z - a)^-1 b for every z."""
    # A state in a queue is the one ahead of it a sample later, z x[n] = a x[ahead] + b[n]. Put into the
    # others it leaves a system of these alone, which a delay of many samples does not enlarge.
    first = np.arange(len(a))
    late, added = np.ones((len(a), len(z)), complex), np.zeros((len(a), len(z)), complex)
    for n, ahead in _queue(a):
        first[n] = first[ahead]
        late[n], added[n] = a[n, ahead] * late[ahead] / z, (a[n, ahead] * added[ahead] + b[n, 0]) / z
    kept, place = np.unique(first, return_inverse=True)
    from_where = np.flatnonzero(a[kept].any(axis=0))
    moved = a[kept][:, from_where] * late.T[:, None, from_where] @ np.eye(len(kept))[place[from_where]]
    system = z[:, None, None] * np.eye(len(kept)) - moved
    found = np.linalg.solve(system, (b[kept] + a[kept] @ added).T[:, :, None])[:, :, 0]
    return np.asarray((c @ (late * found.T[place] + added))[0])


def _queue(a: Matrix) -> list[tuple[int, int]]:
    """Return the states that follow one other alone, each after the one ahead of it."""
    waiting = {n: int(np.flatnonzero(row)[0]) for n, row in enumerate(a) if np.count_nonzero(row) == 1}
    found: list[tuple[int, int]] = []
    # A state that follows itself, or a ring of them, is no queue and stays.
    while ready := [(n, ahead) for n, ahead in waiting.items() if ahead not in waiting]:
        found += ready
        for n, _ in ready:
            del waiting[n]
    return found


def _crossings(function: Callable[[Matrix], Matrix], grid: Matrix, halvings: int = _HALVINGS) -> list[float]:
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
    # The angle of L beyond -180 degrees, brought into -180 … 180: a negative margin is an unstable loop and
    # must not be read as one of more than 180.
    return (math.degrees(math.atan2(at.imag, at.real)) + 180.0 + 180.0) % 360.0 - 180.0


def _least(found: Sequence[tuple[float, float]]) -> tuple[float | None, float | None]:
    return min(found, key=lambda margin: abs(margin[0])) if found else (None, None)
