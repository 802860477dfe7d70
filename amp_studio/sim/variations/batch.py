"""Many runs of one law, each figured out as soon as it is made: the rows of one are kept at a time.

``measure`` reduces the rows of a run to the figures of the scenario `step`, with the definitions of
scenarios/step.py and scenarios/figures.py; tests/sim/test_sweep.py compares both. Like the kernel it is plain
Python and machine code (`compiled.compiled_figures`) with equal results.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from amp_studio.sim.axis.motion import TIMING, Engine, RunEnd, prepared, run_prepared, steps
from amp_studio.sim.engine.arrays import Vector
from amp_studio.sim.engine.compiled import FiguresOfRows, can_compile, compiled_figures, pays_off
from amp_studio.sim.engine.kernel import (
    ALARM_ROW,
    ENDED,
    SERVO_PERIOD,
    SHARE_RATE,
    SUBSTEPS,
    VELOCITY_SAMPLES,
)
from amp_studio.sim.engine.signals import DIVERGED, STOP
from amp_studio.sim.errors import SimulationError
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
_NOISE_COUNTS, _GROWN, _MIN_SWING, _EDGE = 3.0, 1.0 + 1e-6, 1e-9, 1.0 + 1e-9
"""As in scenarios/figures.py."""


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
        # Settled is the sample after the last one outside of the band.
        if abs(wanted[TARGET] - rows[n * every, 1] + rows[n * every, 5]) > wanted[BAND] * _EDGE:
            first = n + 1
    at = (samples - 1) * every
    out[0], out[1], out[2] = stop, peak, max(0.0, furthest - abs(wanted[TARGET]))
    out[3] = out[4] = np.nan
    out[5], out[6], out[7] = most, (squares / driven) ** 0.5, output
    out[8] = abs(wanted[TARGET] - rows[at, 1] + rows[at, 5])
    # Never settled, or for the last samples only, which may be a passage through the band.
    if stop != 0.0 or end < 0.0 or first >= samples - 2:
        return
    # A swing that grows from the first half of the rest to the second is no settling, however small it
    # is now.
    half = (samples - first) // 2
    if half >= 4:
        before = span(rows, first, first + half, every, wanted[TARGET])
        after = span(rows, first + half, samples, every, wanted[TARGET])
        if after > max(before, _NOISE_COUNTS * wanted[COUNT]) * _GROWN and after > _MIN_SWING:
            return
    out[4] = rows[first * every, 0]
    out[3] = max(0.0, out[4] - end)


def run_batch(
    runs: Sequence[tuple[AxisLaw, list[float], RunEnd, float, float]], *, machine_code: bool | None = None
) -> npt.NDArray[np.float64]:
    """Return the figures (runs, FIGURES) of runs of one law: axis, profile, when it ends, its target in u,
    rate of the feed share in 1/s.

    ``machine_code`` None is as `motion.run_axis` chooses.
    A run whose numbers overflow has ``nan`` figures and the stop DIVERGED.
    """
    axis, _, until, *_ = runs[0]
    samples, substeps = steps(axis)
    law = axis.position_sample, axis.velocity_sample
    expected = len(runs) * until.duration / axis.servo_period * samples * substeps
    is_fast = (pays_off(*law, expected) if machine_code is None else machine_code) and can_compile()
    figures = compiled_figures(measure) if is_fast else measure
    out = np.full((len(runs), len(FIGURES)), np.nan)
    # One room for the rows of all: large arrays that come and go are a page fault for every 4 kB of each run,
    # above all in the worker of a cluster, which gives memory back at once.
    room = np.empty(0)
    for each, row in zip(runs, out, strict=True):
        room = _run(*each, "compiled" if is_fast else "plain", figures, row, room)
    beyond = ~np.isfinite(out[:, 1])
    out[beyond], out[beyond, 0] = np.nan, DIVERGED
    return out


def _run(
    axis: AxisLaw,
    profile: list[float],
    until: RunEnd,
    target: float,
    share_rate: float,
    engine: Engine,
    figures: FiguresOfRows,
    out: npt.NDArray[np.float64],
    room: npt.NDArray[np.float64],
) -> npt.NDArray[np.float64]:
    """Write the figures of one run to ``out``; return the room of its rows for the next one."""
    vectors, rows = prepared(axis, profile, until, stride=1, room=room)
    room = room if rows.size <= room.size else rows.reshape(-1)
    timing = vectors[TIMING]
    timing[SHARE_RATE] = share_rate
    try:
        filled, io, x = run_prepared(axis, vectors, rows, engine, 0.0)
    except SimulationError:  # it runs away
        return room
    band = max(axis.inposition_band, axis.machine.position_count, 1e-9 * abs(target))
    wanted = np.array([target, band, axis.machine.position_count])
    driven = filled if x[ALARM_ROW] < 0.0 else int(x[ALARM_ROW]) + 1
    end = x[ENDED] * timing[SERVO_PERIOD] if x[ENDED] >= 0.0 else -1.0
    every = int(timing[VELOCITY_SAMPLES] * timing[SUBSTEPS])
    figures(rows, max(driven, 1), every, wanted, io[STOP], end, out)
    return room
