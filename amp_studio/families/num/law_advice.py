"""Recommendations about a NUM axis: time constant and EMAX, which follow KVAR, window, dynamic check and
acceleration, with page and price.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from amp_studio.sim import AxisLaw, Recommendation, Source, Trace, rounded_down, value_text

from . import law_sample as sample
from .formulas.servo import FOLLOWING_ERROR_MARGIN
from .law_facts import ids

LOOSE = 2.0
"""Ratio of EMAX to the recommended one from which it is too large. A choice of this program."""
_APART = 0.03
"""Relative difference of gain and time constant from which they are not the same. A choice of this
program."""
_HALF_MS = 0.00051
"""s: P66 is in whole ms."""
_RESERVE = 0.8
"""Share of the available acceleration that a ramp may use. A choice of this program."""


def advise(axis: AxisLaw, trace: Trace) -> tuple[Recommendation, ...]:
    """Return the recommendations after the scenario `step`, the most urgent first; none after others."""
    if trace.scenario != "step":
        return ()
    parts = (_constant, _largest_error, _acceleration, _window, _tolerance)
    return tuple(each for part in parts for each in part(axis, trace))


def follow(axis: AxisLaw) -> tuple[Recommendation, ...]:
    """Return the time constant and the EMAX that fit the KVAR of an axis."""
    return (*_constant(axis), *_largest_error(axis))


def _constant(axis: AxisLaw, _trace: Trace | None = None) -> Iterator[Recommendation]:
    """Yield the time constant that KVAR gives (6-14), with which anticipation and dynamic check are
    reckoned.
    """
    if _fits(axis):
        return
    constant, gives = axis.parameters[sample.CONSTANT], 1000.0 / axis.position_rate
    yield Recommendation(
        ids.axis_time_constant,
        float(max(1, round(gives))),
        "ms",
        f"KVAR gives a time constant of {value_text(gives, 'ms', 3)}, but P56 or P66 is"
        f" {value_text(constant * 1000.0, 'ms', 3)}, which anticipation and dynamic movement control "
        "use (pages"
        " 6-14, 6-18, 6-40).",
        "On paths with axes of another time constant the contour is wrong: give all of them the same one.",
    )


def _fits(axis: AxisLaw) -> bool:
    """Return whether gain and time constant are the same thing, as far as whole ms can say it."""
    constant = axis.parameters[sample.CONSTANT]
    near = abs(axis.position_rate * constant - 1.0) <= _APART
    # A short time constant cannot be closer than half a ms, which may be more than 3 %.
    return near or abs(1.0 / axis.position_rate - constant) <= _HALF_MS


def _largest_error(axis: AxisLaw, trace: Trace | None = None) -> Iterator[Recommendation]:
    """Yield EMAX = 1.1 x VMAX x T (6-22), T as KVAR gives it, where it is below VMAX x T or far above."""
    limit = axis.parameters[sample.EMAX]
    wanted = FOLLOWING_ERROR_MARGIN * (axis.feedrate or 0.0) / axis.position_rate
    anticipated = trace is not None and axis.parameters[sample.SHARE] > 0.0
    peak = (trace.result["peak_following_error"][0] or 0.0) if trace else 0.0
    # With anticipation the error is far below VMAX x T: what the move reached decides.
    low = limit < (peak if anticipated else wanted / FOLLOWING_ERROR_MARGIN)
    if not low and limit <= LOOSE * wanted:
        return
    why = (
        f"Maximum Following Error is {value_text(limit, axis.unit)}; 1.1 x highest speed x time constant is"
        f" {value_text(wanted, axis.unit)}"
    )
    price = (
        f"A blocked axis is noticed after {value_text(wanted, axis.unit, 3)} instead of"
        f" {value_text(limit, axis.unit, 3)}."
        if low
        else "Less room for a drive that lags behind."
    )
    yield _counted(axis.sources["excess_error"], wanted, f"{why} (page 6-22).", price)


def _acceleration(axis: AxisLaw, trace: Trace) -> Iterator[Recommendation]:
    """Yield a lower P32 where the torque was at its limit; only with a machine whose acceleration was
    given.
    """
    limit = min(axis.machine.torque_limit_positive, axis.machine.torque_limit_negative)
    available = _RESERVE * axis.machine.acceleration_per_output * (limit - axis.machine.coulomb_friction)
    now = next(iter(axis.ramps.values())).acceleration
    limited = (trace.result["peak_torque"][0] or 0.0) >= limit
    # An assumed machine shows an assumed torque: no ramp is lowered by it.
    if "acceleration_per_output" in axis.assumed or not limited or not 0.0 < available < now:
        return
    source = axis.sources["acceleration"]
    value = float(math.floor(rounded_down(available)))
    # P32 is in whole units; below 1 there is none that helps.
    if value >= 1.0:
        yield Recommendation(
            source.parameter,
            value,
            f"{axis.unit}/s2",
            "The torque was at its limit; 80 % of it accelerate by "
            f"{value_text(available, f'{axis.unit}/s2', 4)}"
            f" (page {source.page}).",
            f"A change to the highest speed takes {value_text(now / value, digits=3)} times as long.",
        )


def _window(axis: AxisLaw, trace: Trace) -> Iterator[Recommendation]:
    """Yield twice the standing error (11-7) where the axis never comes into its window,
    or the window is below a count.
    """
    count, band = axis.machine.position_count, axis.inposition_band
    left = abs(float(trace.columns["following_error"][-1]))
    arrived = trace.result["in_position_time"][0] is not None
    # An axis that is far from its end is not at rest there: its window is not what is wrong.
    if trace.alarms or (arrived and band > count) or left > 0.01 * abs(trace.result["distance"][0] or 0.0):
        return
    why = (
        f"The window of {value_text(band, axis.unit)} must be above one increment, "
        f"{value_text(count, axis.unit)}"
        if arrived
        else (
            f"The axis rests {value_text(left, axis.unit, 3)} from its end, outside the window of"
            f" {value_text(band, axis.unit)}"
        )
    )
    wanted = max(2.0 * left, 2.0 * count)
    yield _counted(
        axis.sources["inposition_band"],
        wanted,
        f"{why}; twice the error at rest (page 11-7).",
        "The next block begins farther from the end.",
    )


def _tolerance(axis: AxisLaw, trace: Trace) -> Iterator[Recommendation]:
    """Yield a tolerance of the dynamic check (11-8: 2 to 4 windows) where there is none,
    no less than this move needs.
    """
    # Where gain and time constant do not fit, the check would end every move: that comes first.
    if axis.unit != "mm" or axis.parameters[sample.TOLERANCE] >= 0.0 or trace.alarms or not _fits(axis):
        return
    import numpy as np  # what binds an axis only needs none

    theory, real = trace.columns["theoretical_speed"], trace.columns["measured_speed"]
    slow, fast = (
        np.minimum(sample.SLOWEST * theory, sample.FASTEST * theory),
        np.maximum(sample.SLOWEST * theory, sample.FASTEST * theory),
    )
    outside = float(np.maximum(slow - real, real - fast).max(initial=0.0)) * axis.servo_period
    wanted = max(3.0 * axis.inposition_band, 1.5 * outside)
    yield _counted(
        axis.sources["dynamic_check"],
        wanted,
        "Dynamic movement control is off, so that a broken encoder or drive is noticed at the maximum"
        " following error only; 3 in-position windows, and this move is"
        f" {value_text(outside * 1000.0, 'um/sample', 2)} outside the band (pages 6-24, 11-8).",
        "Errors 40 to 71 on a sound axis whose time constant in P56 or P66 does not fit.",
    )


def _counted(source: Source, figure: float, why: str, price: str) -> Recommendation:
    """Return a recommendation in whole units of the file, rounded up."""
    # Rounded before: a float a hair above a whole number is not to become the next one.
    value = float(math.ceil(round(figure * source.scale, 6)))
    return Recommendation(source.parameter, value, source.unit or "", why, price)
