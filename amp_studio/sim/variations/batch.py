"""Many runs of one law over flat arrays, each figured out where it was made: no rows leave the kernel.

``batch`` calls `kernel.run` once for each variation into one scratch array, and ``measure`` reduces its rows
to the figures of the scenario `step`, with the definitions of scenarios/step.py and scenarios/figures.py;
tests/sim/test_sweep.py compares both. Like the kernel it is plain Python and machine code
(`compiled.compiled_batch`) with equal results.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol, overload

import numpy as np
import numpy.typing as npt

from amp_studio.sim.axis.motion import (
    AFTER,
    BEFORE,
    IO,
    LINE,
    MACHINE,
    PARAMETERS,
    PROFILE,
    PUSH,
    TIMING,
    Until,
    prepared,
)
from amp_studio.sim.engine.arrays import Vector
from amp_studio.sim.engine.compiled import can_compile, compiled_batch, pays, plain_batch
from amp_studio.sim.engine.kernel import (
    ALARM_ROW,
    DRIVEN_ROWS,
    ENDED,
    SERVO_PERIOD,
    SHARE,
    SHARE_RATE,
    SINCE,
    STATE_SIZE,
    STRIDE,
    SUBSTEPS,
    VELOCITY_SAMPLES,
    run,
)
from amp_studio.sim.engine.signals import FEED_SHARE, MODE, POSITION_LOOP, STOP
from amp_studio.sim.law import AxisLaw

FIGURES = (
    "stop",
    "peak_following_error",
    "overshoot",
    "settle_time",
    "in_position_time",
    "peak_torque",
    "rms_torque",
    "peak_output",
    "rest_error",
)
"""Columns of the result: number of the alarm, u, u, s, s, torque, torque, output, u."""
TARGET, BAND, COUNT = 0, 1, 2
"""Of the wanted motion: its end, the band in which it is there, a count of the position device; u."""
NOISE_COUNTS, GROWN, LEAST_SWING, EDGE = 3.0, 1.0 + 1e-6, 1e-9, 1.0 + 1e-9
"""As in scenarios/figures.py."""


class Sliced(Vector, Protocol):
    """Numbers of which a part is such numbers again: a view in compiled code, a copy in plain Python."""

    @overload
    def __getitem__(self, index: int, /) -> float: ...
    @overload
    def __getitem__(self, index: slice, /) -> Vector: ...


def span(rows: npt.NDArray[np.float64], first: int, last: int, every: int, target: float) -> float:
    """Return the difference of the largest and the smallest distance from the target
    at the samples from ``first`` to before ``last``.
    """
    least = most = target - rows[first * every, 1] + rows[first * every, 5]
    for n in range(first + 1, last):
        off = target - rows[n * every, 1] + rows[n * every, 5]
        least, most = min(least, off), max(most, off)
    return float(most - least)


def measure(
    rows: npt.NDArray[np.float64],
    driven: int,
    every: int,
    wanted: Vector,
    stop: float,
    end: float,
    out: Vector,
) -> None:
    """Write the figures of a motion to ``out``: ``driven`` rows, one in ``every`` a servo sample,
    the command at its end at ``end`` s.
    """
    sign = 1.0 if wanted[TARGET] >= 0.0 else -1.0
    peak = furthest = most = squares = output = 0.0
    for n in range(driven):
        furthest = max(furthest, sign * rows[n, 3])
        most, output = max(most, abs(rows[n, 8])), max(output, abs(rows[n, 7]))
        squares += rows[n, 8] * rows[n, 8]
    samples, first = (driven + every - 1) // every, 0
    for n in range(samples):
        peak = max(peak, abs(rows[n * every, 5]))
        if abs(wanted[TARGET] - rows[n * every, 1] + rows[n * every, 5]) > wanted[BAND] * EDGE:
            first = n + 1
    at = (samples - 1) * every
    out[0], out[1], out[2] = stop, peak, max(0.0, furthest - abs(wanted[TARGET]))
    out[3] = out[4] = np.nan
    out[5], out[6], out[7] = most, (squares / driven) ** 0.5, output
    out[8] = abs(wanted[TARGET] - rows[at, 1] + rows[at, 5])
    if stop != 0.0 or end < 0.0 or first >= samples - 2:
        return
    half = (samples - first) // 2
    if half >= 4:
        before = span(rows, first, first + half, every, wanted[TARGET])
        after = span(rows, first + half, samples, every, wanted[TARGET])
        if after > max(before, NOISE_COUNTS * wanted[COUNT]) * GROWN and after > LEAST_SWING:
            return
    out[4] = rows[first * every, 0]
    out[3] = max(0.0, out[4] - end)


def batch(
    parameters: Sequence[Vector],
    machines: Sequence[Vector],
    befores: Sequence[Vector],
    afters: Sequence[Vector],
    timings: Sequence[Vector],
    profiles: Sliced,
    starts: Vector,
    lines: Vector,
    wanted: Sequence[Vector],
    push: Vector,
    s: Vector,
    io: Vector,
    x: Vector,
    line: Sliced,
    rows: npt.NDArray[np.float64],
    out: Sequence[Vector],
) -> None:
    """Run all variations; each has its row in the arrays, ``profiles`` from one of ``starts`` to the next,
    ``lines`` long a delay line.

    ``s``, ``io``, ``x``, ``line`` and ``rows`` are scratch.
    """
    for n in range(len(timings)):
        timing = timings[n]
        for k in range(len(s)):
            s[k] = 0.0
        for k in range(len(io)):
            io[k] = 0.0
        for k in range(len(x)):
            x[k] = 0.0
        for k in range(len(line)):
            line[k] = 0.0
        io[FEED_SHARE], io[MODE] = 1.0, POSITION_LOOP
        x[ENDED] = x[ALARM_ROW] = -1.0
        x[SINCE], x[SHARE] = timing[STRIDE], 1.0
        filled = run(
            parameters[n],
            s,
            io,
            machines[n],
            befores[n],
            afters[n],
            x,
            line[: int(lines[n])],
            timing,
            profiles[int(starts[n]) : int(starts[n + 1])],
            push,
            rows,
        )
        driven = filled if x[ALARM_ROW] < 0.0 else int(x[ALARM_ROW]) + 1
        end = x[ENDED] * timing[SERVO_PERIOD] if x[ENDED] >= 0.0 else -1.0
        every = int(timing[VELOCITY_SAMPLES] * timing[SUBSTEPS])
        measure(rows, max(driven, 1), every, wanted[n], io[STOP], end, out[n])


def run_batch(
    runs: Sequence[tuple[AxisLaw, list[float], Until, float, float]], *, machine_code: bool | None = None
) -> npt.NDArray[np.float64]:
    """Return the figures (runs, FIGURES) of runs of one law: axis, profile, when it ends, its target in u,
    rate of the feed share in 1/s.

    ``machine_code`` None is as `motion.run_axis` chooses.
    A run whose numbers leave all bounds has ``nan`` figures and the stop DIVERGED.
    """
    ready = [_ready(*each) for each in runs]
    vectors = [each[0] for each in ready]
    axis = runs[0][0]
    starts = np.concatenate([[0.0], np.cumsum([float(len(each[PROFILE])) for each in vectors])])
    columns = [[each[place] for each in vectors] for place in (PARAMETERS, MACHINE, BEFORE, AFTER, TIMING)]
    profiles = [figure for each in vectors for figure in each[PROFILE]]
    lines = [float(len(each[LINE])) for each in vectors]
    scratch = [
        [0.0] * axis.state_size,
        [0.0] * len(vectors[0][IO]),
        [0.0] * STATE_SIZE,
        [0.0] * int(max(lines)),
    ]
    most = int(max(each[TIMING][DRIVEN_ROWS] for each in vectors))
    rows = np.empty((most, ready[0][1]))
    wanted, out = [each[2] for each in ready], np.full((len(runs), len(FIGURES)), np.nan)
    law = axis.position_sample, axis.velocity_sample
    steps = sum(each[TIMING][DRIVEN_ROWS] for each in vectors)
    if (pays(*law, steps) if machine_code is None else machine_code) and can_compile():
        arrays = [
            np.array(each) for each in (*columns, profiles, starts, lines, wanted, vectors[0][PUSH], *scratch)
        ]
        compiled_batch(batch, *law)(*arrays, rows, out)
    else:
        plain_batch(batch, *law)(
            *columns, profiles, starts.tolist(), lines, wanted, vectors[0][PUSH], *scratch, rows, out
        )
    out[~np.isfinite(out[:, 1])] = np.nan
    return out


def _ready(
    axis: AxisLaw, profile: list[float], until: Until, target: float, share_rate: float
) -> tuple[list[list[float]], int, list[float]]:
    """Return the vectors of a run, the width of its rows and what is wanted of it."""
    vectors, rows = prepared(axis, profile, until, stride=1)
    vectors[TIMING][SHARE_RATE] = share_rate
    band = max(axis.inposition_band, axis.machine.position_count, 1e-9 * abs(target))
    return vectors, rows.shape[1], [target, band, axis.machine.position_count]
