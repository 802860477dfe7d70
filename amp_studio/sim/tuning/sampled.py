"""A law and its machine as one matrix a servo period: the loop as the control samples it.

The machine is discretised exactly over each velocity period with a constant output, delay included (K. J.
Åström, B. Wittenmark, Computer-Controlled Systems, 1997, chapter 3);
the law is the matrices of its two sample functions.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import numpy.typing as npt

from amp_studio.sim.engine.machine import Machine
from amp_studio.sim.errors import SimulationError

Matrix = npt.NDArray[np.float64]

_LONGEST_DELAY = 100
"""Most samples of the faster loop from an output to its effect."""
# A power of two, so that the division by it is exact.
_STEP = 2.0**-23
"""Disturbance of a signal at rest, in its own unit: far below every limit, far above rounding."""


@dataclass(frozen=True, eq=False)
class Plant:
    """The machine as a linear system: dx/dt = a x + b u(t - delay) + push w,
    positions of motor and load in x.
    """

    a: Matrix
    b: Matrix
    motor: Matrix
    load: Matrix
    delay: float = 0.0
    """s"""
    push: Matrix | None = None
    """What a torque on the load does; None for a machine that nothing pushes."""


@dataclass(frozen=True)
class Places:
    """Where the signals of a law are in its vector of states and signals."""

    signals: dict[str, int]
    """command, command_velocity, command_acceleration, position, motor, output -> index"""
    load_sensor: bool = False
    """Whether the position is measured at the load."""


@dataclass(frozen=True)
class SampledLoop:
    """x' = open x + measured w + command (r, dr/dt, d2r/dt2) + pushed d; one step is one ``period`` in s.

    ``w`` is the position that the control measures, ``sensed x`` the position that it would measure,
    ``position x`` the position of the load, ``d`` a torque on the load.
    """

    period: float
    open: Matrix
    measured: Matrix
    command: Matrix
    sensed: Matrix
    position: Matrix
    pushed: Matrix

    @property
    def closed(self) -> Matrix:
        """The matrix of the closed loop."""
        return self.open + self.measured @ self.sensed


@lru_cache(maxsize=256)
def plant_of(machine: Machine) -> Plant:
    """Return the linear machine: no dry friction, no backlash (motor and load in contact), no limits,
    no weight.
    """
    motor, motor_speed, load, load_speed, torque, error_sum = range(6)
    a, b = np.zeros((6, 6)), np.zeros((6, 1))
    acceleration = machine.acceleration_per_output
    frequency, ratio_of_damping, ratio = machine.coupling
    push = {motor_speed: acceleration * (1.0 + ratio), load_speed: acceleration * (1.0 + ratio) / ratio}
    a[motor, motor_speed] = a[load, load_speed] = 1.0
    if machine.two_masses:
        # Motor and load against each other are one oscillator, with the sum of what a torque does to each:
        # its square rate is stiffness times that sum, its damping term twice damping ratio times rate.
        both, rate = sum(push.values()), 2.0 * math.pi * frequency
        stiffness, damping = rate**2 / both, 2.0 * ratio_of_damping * rate / both
        own = {motor_speed: machine.motor_friction, load_speed: 1.0 - machine.motor_friction}
        for speed, sign in ((motor_speed, -1.0), (load_speed, 1.0)):
            a[speed, motor] += sign * push[speed] * stiffness
            a[speed, load] -= sign * push[speed] * stiffness
            a[speed, motor_speed] += sign * push[speed] * damping
            a[speed, load_speed] -= sign * push[speed] * damping
            a[speed, speed] -= push[speed] * own[speed] * machine.viscous_friction
        a[load_speed, load] -= push[load_speed] * machine.spring
        driven = push[motor_speed]
    else:
        a[motor_speed, motor] = -acceleration * machine.spring
        a[motor_speed, motor_speed] = -acceleration * machine.viscous_friction
        driven = acceleration
    # A drive with a velocity loop asks for a torque by speed and integral (a row over the states) and by
    # output (a factor); any other drive for the output itself.
    wanted, scale = np.zeros(6), 1.0
    if machine.velocity_per_output > 0.0:
        gain = 2.0 * math.pi * machine.velocity_bandwidth / acceleration
        wanted[motor_speed], wanted[error_sum] = -gain, gain * machine.velocity_integral
        scale = gain * machine.velocity_per_output
        a[error_sum, motor_speed], b[error_sum, 0] = -1.0, machine.velocity_per_output
    if machine.bandwidth > 0.0:
        lag = 2.0 * math.pi * machine.bandwidth
        a[torque] += lag * wanted
        a[torque, torque] -= lag
        b[torque, 0] = lag * scale
        a[motor_speed, torque] += driven
    else:
        a[motor_speed] += driven * wanted
        b[motor_speed, 0] += driven * scale
    row, push_at = np.eye(6), np.zeros((6, 1))
    if machine.two_masses:
        push_at[load_speed, 0] = push[load_speed]
    else:
        push_at[motor_speed, 0] = acceleration
    return Plant(a, b, row[[motor]], row[[load if machine.two_masses else motor]], machine.delay, push_at)


def sampled(
    plant: Plant,
    position: Matrix,
    velocity: Matrix | None,
    places: Places,
    period: float,
    velocity_period: float,
) -> SampledLoop:
    """Join the matrices of a law's two sample functions with the machine.

    ``position`` and ``velocity`` map the law's states and signals to their next values (``jacobian``).
    """
    loops = max(1, round(period / velocity_period)) if velocity is not None else 1
    step = period / loops
    whole, rest = divmod(plant.delay / step, 1.0)
    # Division can leave 0.999999… of a sample for a whole one: then there would be one state more, with the
    # effect of none.
    if 1.0 - rest < 1e-9:
        whole, rest = whole + 1.0, 0.0
    waiting = int(whole) + (1 if rest > 1e-9 else 0)
    if waiting > _LONGEST_DELAY:
        raise SimulationError(
            f"The delay of the machine is {waiting} samples of the loop; at most {_LONGEST_DELAY} are"
            " simulated",
            "model.delay",
        )
    x, law = len(plant.a), len(position)
    size = x + law + waiting
    signal = {name: x + place for name, place in places.signals.items()}
    move = _Move.of(plant, step, rest, waiting, signal["output"], size)
    taken = [signal[name] for name in ("position", "command", "command_velocity", "command_acceleration")]
    # A row for each state and signal: what it is made of, the states before the period and the inputs.
    rows = np.hstack([np.eye(size), np.zeros((size, len(taken) + 1))])  # the last one is the push on the load
    # What is measured and commanded is no state of the loop but an input of this period: its rows are cut off
    # from the states before and tied to the columns of the inputs.
    rows[taken] = 0.0
    rows[taken, range(size, size + len(taken))] = 1.0
    rows[signal["motor"]] = plant.motor[0] @ rows[:x]
    rows[x : x + law] = position @ rows[x : x + law]
    # In the order of the kernel: the position sample, then each velocity sample with the motor as it is by
    # then.
    for _ in range(loops):
        if velocity is not None:
            rows[signal["motor"]] = plant.motor[0] @ rows[:x]
            rows[x : x + law] = velocity @ rows[x : x + law]
        move.apply(rows)
    sensed, load = np.zeros((1, size)), np.zeros((1, size))
    sensed[0, :x] = plant.load if places.load_sensor else plant.motor
    load[0, :x] = plant.load
    inputs = rows[:, size:]
    return _reduced(
        SampledLoop(period, rows[:, :size], inputs[:, :1], inputs[:, 1:-1], sensed, load, inputs[:, -1:])
    )


def jacobian(sample: Callable[[Matrix], Matrix], rest: Matrix) -> Matrix:
    """Return the matrix of a sample function at rest, by differences, which are exact for a linear
    function.
    """
    still, columns = sample(rest), []
    for n in range(len(rest)):
        ahead = rest.copy()
        ahead[n] += _STEP
        columns.append((sample(ahead) - still) / _STEP)
    return np.array(columns).T


def exponential(matrix: Matrix) -> Matrix:
    """Return the exponential of a matrix by scaling, a Taylor series and squaring (Golub, Van Loan, 9.3)."""
    # The norm (largest sum of a row) is brought to 1/16 at most: 13 terms of the series then leave a
    # remainder of (1/16)^14 / 14!, 2e-28, which is nothing beside the rounding of a double.
    halvings = max(
        0, math.ceil(math.log2(max(float(np.abs(matrix).sum(axis=1).max(initial=0.0)), 1e-300))) + 4
    )
    small = matrix / 2.0**halvings
    total, term = np.eye(len(matrix)), np.eye(len(matrix))
    for n in range(1, 14):
        term = term @ small / n
        total = total + term
    for _ in range(halvings):
        total = total @ total
    return total


def zero_order_hold(a: Matrix, b: Matrix, time: float) -> tuple[Matrix, Matrix]:
    """Return (phi, gamma) of dx/dt = a x + b u over a time in s with a constant u."""
    # exp([[a, b], [0, 0]] t) is [[phi, gamma], [0, 1]] (Van Loan 1978). The formula a^-1 (phi - 1) b would
    # need an inverse that a plant with a position does not have: it integrates, so a is singular.
    n, m = b.shape
    joined = np.zeros((n + m, n + m))
    joined[:n, :n], joined[:n, n:] = a, b
    over = exponential(joined * time)
    return over[:n, :n], over[:n, n:]


@dataclass(frozen=True, eq=False)
class _Move:
    """One velocity period of the machine: its input is a number of outputs old, which wait in a queue,
    the oldest first.
    """

    phi: Matrix
    old: Matrix
    """What the oldest output does, and the one after it if the delay is no whole number of periods."""
    new: Matrix | None
    push: Matrix
    """What a torque on the load does."""
    places: list[int]
    """Rows of the waiting outputs and of the present one."""

    @classmethod
    @lru_cache(maxsize=256)
    def of(cls, plant: Plant, step: float, rest: float, waiting: int, output: int, size: int) -> _Move:
        """Return the move over ``step`` s; ``rest`` is the share of a period in the delay."""
        places = [*range(size - waiting, size), output]
        phi, gamma = zero_order_hold(plant.a, plant.b, step)
        push = (
            np.zeros((len(phi), 1)) if plant.push is None else zero_order_hold(plant.a, plant.push, step)[1]
        )
        if rest <= 1e-9:
            return cls(phi, gamma, None, push, places)
        # In the first share of the period the older output still acts, then the newer one.
        phi_early, gamma_early = zero_order_hold(plant.a, plant.b, (1.0 - rest) * step)
        _, gamma_late = zero_order_hold(plant.a, plant.b, rest * step)
        return cls(phi, phi_early @ gamma_late, gamma_early, push, places)

    def apply(self, rows: Matrix) -> None:
        """Move the machine in the first rows, and the queue."""
        x = len(self.phi)
        moved = self.phi @ rows[:x] + self.old * rows[self.places[0]]
        if self.new is not None:
            moved += self.new * rows[self.places[1]]
        moved[:, -1:] += self.push
        rows[:x] = moved
        rows[self.places[:-1]] = rows[self.places[1:]]


def _reduced(model: SampledLoop) -> SampledLoop:
    """Leave out the states that no input reaches or no position shows: signals that the law does not use."""
    # By which entries are zero at all, not by size: a state that is left out has no influence, not a small
    # one.
    links = (model.closed != 0.0) | (model.open != 0.0)
    inputs = (model.measured != 0.0)[:, 0] | (model.command != 0.0).any(axis=1)
    outputs = ((model.sensed != 0.0) | (model.position != 0.0))[0]
    keep = _used(len(links), links.tobytes(), inputs.tobytes(), outputs.tobytes())
    return SampledLoop(
        model.period,
        model.open[keep[:, None], keep],
        model.measured[keep],
        model.command[keep],
        model.sensed[:, keep],
        model.position[:, keep],
        model.pushed[keep],
    )


@lru_cache(maxsize=256)
def _used(size: int, links: bytes, inputs: bytes, outputs: bytes) -> npt.NDArray[np.int64]:
    """Return the places of the states that an input reaches and a position shows."""
    linked = np.frombuffer(links, dtype=np.bool_).reshape(size, size)
    reached, seen = (np.frombuffer(each, dtype=np.bool_) for each in (inputs, outputs))
    return np.flatnonzero(_spread(linked, reached) & _spread(linked.T, seen))


def _spread(links: npt.NDArray[np.bool_], begin: npt.NDArray[np.bool_]) -> npt.NDArray[np.bool_]:
    reached = begin
    while True:
        more = reached | (links @ reached)
        if np.array_equal(more, reached):
            return reached
        reached = more
