"""Figures of a motion: what is steady is steady, what settles stays."""

from __future__ import annotations

import numpy as np

from amp_studio.sim.axis.motion import Motion
from amp_studio.sim.axis.moves import STEADY_LAGS
from amp_studio.sim.law import AxisLaw
from amp_studio.sim.series import Series
from amp_studio.sim.tuning.linear import Margins, axis_model

_STEADY_SPEED = 1e-3
"""Largest relative difference from the feedrate of a constant command speed."""
_RESIDUE = 1e-6
"""Share of the error that the loop alone would have: what is less is left over by the arithmetic."""
_NOISE_COUNTS = 3.0
"""Counts between which a measured figure may go to and fro and is still steady."""
_RIPPLE, _DRIFT = 0.01, 0.005
"""Shares of a steady figure that it may go to and fro, and that it would still change if it were waited
for."""


def steady(series: Series, noise: float) -> float | None:
    """Return the mean of the last tenth of a series; None where it swings or still changes.

    From the means of the last three tenths follows where a change that dies away geometrically would end: an
    axis that is slow is not called steady because little happens in a tenth.
    """
    tenth = len(series) // 10
    if tenth < 3:
        return None
    first, second, last = (series[len(series) - n * tenth :][:tenth] for n in (3, 2, 1))
    mean = float(last.mean())
    allowed = max(noise, _RIPPLE * abs(mean))
    if float(last.max() - last.min()) > allowed:
        return None
    before, after = float(second.mean() - first.mean()), mean - float(second.mean())
    ratio = after / before if before else 0.0
    # What is still to come is after (r + r² + …); a change that grows never ends.
    to_go = abs(after) * (ratio / (1.0 - ratio) if 0.0 < ratio < 1.0 else np.inf if ratio >= 1.0 else 1.0)
    if abs(after) > noise / _NOISE_COUNTS and to_go > max(noise, _DRIFT * abs(mean)):
        return None
    return mean


def _at_servo_samples(motion: Motion, column: str) -> Series:
    """Return a column at the servo samples in which the control moved the axis."""
    return motion.columns[column][motion.driven][:: motion.rows_per_servo_period]


def steady_at_feedrate(axis: AxisLaw, motion: Motion, feedrate: float) -> float | None:
    """Return the size of the steady mean following error in the longest stretch at the full feedrate (u/s).

    What goes to and fro around 0 has a mean of 0. None if the stretch is shorter than STEADY_LAGS time
    constants or the figure is not steady in it.
    """
    series = _at_servo_samples(motion, "following_error")
    speed = np.abs(_at_servo_samples(motion, "command_velocity"))
    constant = np.abs(speed / feedrate - 1.0) <= _STEADY_SPEED
    edges = np.flatnonzero(np.diff(np.concatenate(([0], constant.astype(np.int8), [0]))))
    starts, ends = edges[::2], edges[1::2]
    if starts.size == 0:
        return None
    longest = int(np.argmax(ends - starts))
    start, end = int(starts[longest]), int(ends[longest])
    if (end - start) * axis.servo_period < STEADY_LAGS / axis.position_rate:
        return None
    noise = max(_NOISE_COUNTS * axis.machine.position_count, 1e-9 * feedrate)
    if steady(np.abs(series[start:end]), noise) is None:
        return None
    mean = abs(float(series[end - (end - start) // 10 : end].mean()))
    return mean if mean > _RESIDUE * feedrate / axis.position_rate else 0.0


def settled(axis: AxisLaw, motion: Motion, target: float) -> tuple[float | None, float | None]:
    """Return (time in s from the start, time in s from the end of the command)
    of reaching the target for good.

    Settled is the first servo sample from which the measured position stays within the in-position band.
    (None, None) where the command or the axis does not get there,
    or where the axis still swings in the end and more than it did.
    """
    if motion.stop != 0 or motion.command_end is None:
        return None, None
    time = _at_servo_samples(motion, "time_s")
    # Where the control takes the axis to be: what it adds to the command for itself (REFERENCE_LAG) is no
    # error.
    off = (
        target - _at_servo_samples(motion, "command_position") + _at_servo_samples(motion, "following_error")
    )
    band = max(axis.inposition_band, axis.machine.position_count, 1e-9 * abs(target))
    outside = np.flatnonzero(np.abs(off) > band * (1.0 + 1e-9))
    first = int(outside[-1]) + 1 if outside.size else 0
    if first >= time.size - 2 or grows(off[first:], axis.machine.position_count):
        return None, None
    moment = float(time[first])
    return moment, max(0.0, moment - motion.command_end)


def grows(series: Series, count: float) -> bool:
    """Return whether what is left of an error swings more in its second half than in its first,
    by more than 3 counts.
    """
    half = len(series) // 2
    # Too few samples to know a swing from noise.
    if half < 4:
        return False
    swings = [float(np.ptp(part)) for part in (series[:half], series[half:])]
    return swings[1] > max(swings[0], _NOISE_COUNTS * count) * (1.0 + 1e-6) and swings[1] > 1e-9


def stability(axis: AxisLaw) -> tuple[bool, Margins | None]:
    """Return (whether the loop is stable, the margins of the loop that is not), of the linear model."""
    models = axis_model(axis)
    open_loop = not np.any(models.whole.measured)  # nothing controls the position, which may drift
    if models.whole.is_stable(drift=open_loop):
        return True, None
    inner = models.inner
    loop = inner if inner is not None and not inner.is_stable(drift=True) else models.cut
    return False, loop.margins()
