"""One run of an axis over a profile: chooses the physics step, runs the kernel plain or compiled,
returns columns.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

import numpy as np
import numpy.typing as npt

from amp_studio.sim.command.ramps import end_of
from amp_studio.sim.engine import kernel
from amp_studio.sim.engine.compiled import can_compile, compiled, pays_off, plain
from amp_studio.sim.engine.machine import DELAY_SHARE, DELAY_STEPS, Machine, machine_array
from amp_studio.sim.engine.signals import DIVERGED, FEED_SHARE, MODE, MONITOR, POSITION_LOOP, STOP
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import AxisLaw

PARAMETERS, IO, MACHINE, BEFORE, AFTER, STATE, LINE, TIMING, PROFILE, PUSH = 0, *range(2, 11)
"""Places of the vectors that `prepared` returns; the state of the law, at 1, needs no name."""
Engine = Literal["auto", "plain", "compiled"]

_LONGEST_STEP = 0.4e-3
"""Longest physics step in s."""
# Leapfrog is stable up to 2; at 0.25 a resonance is off by 0.25²/24, 0.3 % of its frequency.
_STIFFEST_STEP = 0.25
"""Physics step times the fastest rate of the machine."""
_MAX_SUBSTEPS = 10_000
MAX_STEPS = 40_000_000
"""Most physics steps of a run, almost three hours at the longest one."""
MAX_ROWS = 2_000_000


@dataclass(frozen=True)
class RunEnd:
    """When a run ends: at the latest after ``duration`` s; when the axis was in the ``rest_band`` (u) around
    the commanded end for ``rest_time`` s; ``settle_time`` s after the end of the command.
    """

    duration: float
    rest_band: float = 0.0
    rest_time: float = math.inf
    settle_time: float = math.inf


@dataclass(frozen=True)
class Motion:
    """The result of a run."""

    columns: dict[str, npt.NDArray[np.float64]]
    """Name -> (rows,) float64 in s, u, u/s, the units of output, torque and monitors."""
    stop: int
    """Number of the alarm that ended the run; 0 for none, below 0 one of the kernel (`signals.py`)."""
    rows_per_servo_period: int
    """Rows from one servo sample to the next; the first row is a servo sample."""
    alarm_row: int | None
    """Row of the alarm; in the rows after it the axis runs out without output."""
    command_end: float | None
    """s: when the command was at its end; None if the run was over before."""

    @property
    def driven(self) -> slice:
        """The rows in which the control moved the axis."""
        return slice(None if self.alarm_row is None else self.alarm_row + 1)


def run_axis(
    axis: AxisLaw,
    profile: list[float],
    until: RunEnd,
    *,
    mode: float = POSITION_LOOP,
    share_rate: float = math.inf,
    engine: Engine = "auto",
    refine: int = 1,
    thin: bool = False,
    feed_forward: bool = True,
    coast: float = 0.0,
    emergency: float = math.inf,
) -> Motion:
    """Run an axis from rest over a profile (`profiles.py`).

    ``mode`` is a mode of `signals.MODE`; ``share_rate`` in 1/s the speed of a change of the feed share;
    ``refine`` divides the physics step; ``thin`` keeps one row for each velocity sample; without
    ``feed_forward`` the law sees the commanded position only; after an alarm, or the emergency stop at
    ``emergency`` s, the axis runs out for up to ``coast`` s. Raises SimulationError where the run would take
    too long or its figures overflow.
    """
    axis = with_leader(axis, profile, until, mode=mode, share_rate=share_rate, engine=engine, refine=refine)
    samples, substeps = steps(axis, refine)
    stride = substeps if thin else 1
    vectors, rows = prepared(axis, profile, until, stride, refine, coast)
    io, timing = vectors[IO], vectors[TIMING]
    io[MODE] = mode
    timing[kernel.SHARE_RATE], timing[kernel.FORWARD] = share_rate, float(feed_forward)
    timing[kernel.COAST_TIME], timing[kernel.EMERGENCY] = coast, emergency
    expected = min(until.duration, end_of(profile) + until.rest_time) / timing[kernel.STEP]
    filled, io, x = run_prepared(axis, vectors, rows, engine, expected)
    if not np.isfinite(rows[:filled]).all():
        raise SimulationError(
            f"The figures of axis {axis.axis} are too large or too small to be computed with. Check its gains"
            " and model.*"
        )
    names = [*kernel.COLUMNS, *(name for name, _ in axis.monitors)]
    return Motion(
        dict(zip(names, np.ascontiguousarray(rows[:filled].T), strict=True)),
        int(io[STOP]),
        samples * substeps // stride,
        int(x[kernel.ALARM_ROW]) if x[kernel.ALARM_ROW] >= 0.0 else None,
        x[kernel.ENDED] * axis.servo_period if x[kernel.ENDED] >= 0.0 else None,
    )


def with_leader(
    axis: AxisLaw,
    profile: list[float],
    until: RunEnd,
    *,
    mode: float = POSITION_LOOP,
    share_rate: float = math.inf,
    engine: Engine = "auto",
    refine: int = 1,
) -> AxisLaw:
    """Return an axis that goes by the motion of another with that motion, which is run first;
    any other axis as it is.
    """
    if axis.after is None:
        return axis

    def lead(other: AxisLaw) -> dict[str, npt.NDArray[np.float64]]:
        # A push from outside is found by many runs: worth the time to load machine code.
        own: Engine = "compiled" if engine == "auto" and other.push else engine
        first = run_axis(other, profile, until, mode=mode, share_rate=share_rate, engine=own, refine=refine)
        return {name: column[:: first.rows_per_servo_period] for name, column in first.columns.items()}

    return axis.after(axis, lead)


def prepared(
    axis: AxisLaw,
    profile: list[float],
    until: RunEnd,
    stride: int,
    refine: int = 1,
    coast: float = 0.0,
    room: npt.NDArray[np.float64] | None = None,
) -> tuple[list[list[float]], npt.NDArray[np.float64]]:
    """Return the vectors of `kernel.run` for an axis at rest, and room for its rows,
    one in ``stride`` physics steps: a part of ``room`` if that is enough.

    Raises SimulationError where the run would take too long.
    """
    samples, substeps = steps(axis, refine)
    step = axis.servo_period / samples / substeps
    # Written with "not", so that a duration that is no number is refused too.
    if not (until.duration / step <= MAX_STEPS and until.duration / step / stride <= MAX_ROWS):
        longest = min(MAX_STEPS, MAX_ROWS * stride) * step
        raise SimulationError(
            f"The move takes about {until.duration:.6g} s, more than can be simulated ({longest:.6g} s)."
            " Give a shorter distance or a higher feedrate"
        )
    # A duration of whole steps gets no row more by rounding.
    driven = max(1, math.ceil((until.duration / step - 1e-6) / stride))
    timing = [0.0] * kernel.TIMING_SIZE
    timing[kernel.SERVO_PERIOD], timing[kernel.STEP] = axis.servo_period, step
    timing[kernel.VELOCITY_SAMPLES], timing[kernel.SUBSTEPS] = float(samples), float(substeps)
    timing[kernel.STRIDE], timing[kernel.MONITORS] = float(stride), float(len(axis.monitors))
    timing[kernel.REST_BAND], timing[kernel.REST_TIME] = until.rest_band, until.rest_time
    # A band below a count would never be met: measured positions go in counts.
    timing[kernel.IN_POSITION_BAND] = max(axis.inposition_band, 1.5 * axis.machine.position_count)
    timing[kernel.SETTLE_TIME], timing[kernel.DRIVEN_ROWS] = until.settle_time, float(driven)
    timing[kernel.SHARE_RATE], timing[kernel.EMERGENCY], timing[kernel.FORWARD] = math.inf, math.inf, 1.0
    timing[kernel.LAST_SAMPLE] = math.inf
    io, x = [0.0] * (MONITOR + len(axis.monitors)), [0.0] * kernel.STATE_SIZE
    io[FEED_SHARE], io[MODE] = 1.0, POSITION_LOOP
    x[kernel.ENDED] = x[kernel.ALARM_ROW] = -1.0
    # As if a stride had just passed: the first step writes a row.
    x[kernel.SINCE], x[kernel.SHARE] = float(stride), 1.0
    machine, before, after = machine_vectors(axis.machine, step)
    # `delayed` reads two places, the farther one ``DELAY_STEPS`` + 1 before the one just written.
    line = [0.0] * (int(machine[DELAY_STEPS]) + 2)
    parameters, state = [float(each) for each in axis.parameters], [0.0] * axis.state_size
    shape = driven + math.ceil(coast / step / stride), len(kernel.COLUMNS) + len(axis.monitors)
    size = shape[0] * shape[1]
    rows = np.empty(shape) if room is None or room.size < size else room[:size].reshape(shape)
    push = [float(each) for each in axis.push]
    return [parameters, state, io, machine, before, after, x, line, timing, profile, push], rows


def machine_vectors(machine: Machine, step: float) -> list[list[float]]:
    """Return the vectors of a machine over a physics step, and over its parts before and after the delay."""
    whole = _machine_array(machine, step)
    part = whole[DELAY_SHARE] * step
    return [
        whole,
        *(_machine_array(machine, span) if part > 0.0 else [*whole] for span in (part, step - part)),
    ]


@lru_cache(maxsize=256)
def _figures_of(machine: Machine, step: float) -> tuple[float, ...]:
    return tuple(machine_array(machine, step))


def _machine_array(machine: Machine, step: float) -> list[float]:
    """Return `machine_array`, computed once for the runs of one machine: a sweep has thousands."""
    return list(_figures_of(machine, step))


def steps(axis: AxisLaw, refine: int = 1) -> tuple[int, int]:
    """Return (velocity samples in a servo period, physics steps in a velocity sample)."""
    samples = max(1, round(axis.servo_period / axis.velocity_period))
    sample = axis.servo_period / samples
    # A servo period of whole longest steps gets no step more by rounding.
    wanted = max(sample / _LONGEST_STEP - 1e-9, sample * axis.machine.fastest / _STIFFEST_STEP)
    if not wanted <= _MAX_SUBSTEPS:
        raise SimulationError(
            f"The machine of axis {axis.axis} is too stiff to simulate ({axis.machine.fastest:.6g} 1/s)"
        )
    return samples, max(1, math.ceil(wanted)) * refine


def run_prepared(
    axis: AxisLaw, vectors: list[list[float]], rows: npt.NDArray[np.float64], engine: Engine, expected: float
) -> tuple[int, list[float], list[float]]:
    """Run the kernel for about ``expected`` steps; return the filled rows,
    the signals and the state at the end. Raises SimulationError where they overflow.
    """
    law = axis.position_sample, axis.velocity_sample
    machine_code = engine == "compiled" or (engine == "auto" and pays_off(*law, expected))
    if machine_code and can_compile():
        arrays = [np.array(each, dtype=np.float64) for each in vectors]
        filled = compiled(*law)(*arrays, rows)
        return filled, arrays[IO].tolist(), arrays[STATE].tolist()
    try:
        filled = plain(*law)(*vectors, rows)
    except OverflowError:  # a count of a position without bounds
        raise SimulationError(f"Axis {axis.axis} runs away: its loop is not stable") from None
    return filled, vectors[IO], vectors[STATE]


__all__ = ["DIVERGED", "Engine", "Motion", "RunEnd", "run_axis", "steps"]
