"""Recommendations after a move: the value to change, why, and what it costs.

Every recommendation names one figure of the axis. If that figure came from a parameter, the value is
given in the unit and bounds of that parameter.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from amp_studio.sim.law import Source
from amp_studio.sim.rounding import rounded_down, rounded_up, shown
from amp_studio.sim.trace import Figure, Recommendation

from .laws import (
    available_acceleration,
    excess_error_wanted,
    gain_break_wanted,
    loop_ratio,
    response_ramp,
    response_time,
    steady_following_error,
)
from .servo import AxisServo

RESERVE = 0.8
"""Share of the available acceleration that a ramp may use; the rest is a reserve for load and wear. A choice of this
program."""
APERIODIC = 4.0
"""Least ratio of velocity loop rate to position loop rate without overshoot of the position loop."""
INTEGRAL_SHARE = 10.0
"""The tuning procedure ends with an integral gain 5 to 10 times below the proportional one (appendix A, from
A-8 on)."""
LOOSE = 2.0
"""Ratio of excess error to the recommended one from which it is too large. A choice of this program."""


def recommend(
    servo: AxisServo, feedrate: float, ramp: str, result: Mapping[str, Figure]
) -> tuple[Recommendation, ...]:
    """Return the recommendations for a move, the most urgent first.

    ``feedrate`` is that of the move in unit/min, ``ramp`` the active one (linear, exponential, none),
    ``result`` the figures of the move.
    """
    move = _Move(servo, feedrate, ramp, {name: figure for name, (figure, _) in result.items()})
    parts = (_excess_error, _order, _suppression, _ramp, _loops, _gain_break, _resolution)
    return tuple(advice for part in parts for advice in part(move))


@dataclass(frozen=True)
class _Move:
    """The input of the recommendations: the axis, the feedrate in unit/min, the active ramp, the figures."""

    servo: AxisServo
    feedrate: float
    ramp: str
    figures: Mapping[str, float | None]


def _recommendation(
    servo: AxisServo, name: str, value: float, unit: str, why: str, *, up: bool = True
) -> Recommendation | None:
    """Return the value in unit and bounds of the parameter; None if it already has this value."""
    source = servo.sources.get(name, Source(name))
    limited = value * source.scale
    limited = rounded_up(limited) if up else rounded_down(limited)
    if source.whole:
        limited = float(math.ceil(limited) if up else math.floor(limited))
    if limited > source.largest:
        limited = source.largest
        why = f"{why[:-1]}; the upper limit of {source.parameter} is {shown(limited)}."
    now = getattr(servo, name)
    if isinstance(now, float) and limited == now * source.scale:
        return None
    why = f"{why[:-1]} (page {source.page})." if source.page else why
    return Recommendation(source.parameter, limited, unit if source.unit is None else source.unit, why)


def _some(*advice: Recommendation | None) -> Iterator[Recommendation]:
    return (each for each in advice if each is not None)


def _excess_target(m: _Move) -> float:
    """Return the recommended excess error: 110 % of the largest following error if the present one is below
    that error or far above it, else the present one.
    """
    wanted = excess_error_wanted(m.servo, m.servo.rapid_feedrate or m.feedrate)
    now = m.servo.excess_error
    if math.isfinite(wanted) and (now < wanted / 1.1 or now > LOOSE * wanted):
        return wanted
    return now


def _excess_error(m: _Move) -> Iterator[Recommendation]:
    servo, unit = m.servo, m.servo.unit
    now, wanted = servo.excess_error, _excess_target(m)
    if wanted == now:
        return
    rapid = servo.rapid_feedrate or m.feedrate
    speed = f"At {shown(rapid, unit)}/min the following error reaches {shown(wanted / 1.1, unit)}"
    if now < wanted:
        why = f"{speed}, but the EXCESS FOLLOWING ERROR alarm comes at {shown(now, unit)}: allow 110 % of the error."
    elif math.isinf(now):
        why = f"{speed}; without a limit a blocked axis is never detected: allow 110 % of the error."
    else:
        late = shown((now - wanted) / (rapid / 60.0), "s", 3)
        why = f"{speed}; at {shown(now, unit)} a blocked axis is detected {late} later than with 110 % of the error."
    yield from _some(_recommendation(servo, "excess_error", wanted, unit, why))


def _order(m: _Move) -> Iterator[Recommendation]:
    """A smaller excess error also lowers the limits below it: inposition band < gain break point <
    feedrate suppression point <= excess error (7-20); otherwise the control corrects them itself.
    """
    servo, unit, highest = m.servo, m.servo.unit, _excess_target(m)
    if highest >= servo.excess_error or highest >= servo.feedrate_suppression:
        return
    limits = "each limit of the following error must not be above the next one"
    why = f"Lower the feedrate suppression point together with the excess error: {limits}."
    yield from _some(_recommendation(servo, "feedrate_suppression", highest, unit, why))
    if not highest <= servo.gain_break_point < math.inf:
        return
    wanted = max(
        gain_break_wanted(servo, servo.cutting_feedrate or 0.5 * m.feedrate), 2.0 * servo.inposition_band
    )
    if wanted < highest:
        why = (
            f"Lower the gain break point too, to the value needed for the maximum cutting feedrate: {limits}."
        )
        yield from _some(_recommendation(servo, "gain_break_point", wanted, unit, why))


def _suppression(m: _Move) -> Iterator[Recommendation]:
    servo, unit, limit = m.servo, m.servo.unit, _excess_target(m)
    lost = m.figures["time_in_feedrate_suppression"] or 0.0
    if lost == 0.0 or math.isinf(limit) or limit <= servo.feedrate_suppression:
        return
    why = (
        f"The feedrate was halved for {shown(lost, 's', 3)} of this move, because the following error was above"
        f" {shown(servo.feedrate_suppression, unit)}; {shown(m.feedrate, unit)}/min alone needs"
        f" {shown(steady_following_error(servo, m.feedrate), unit)}. A value equal to the excess error switches"
        " suppression off; a value between them keeps it as a warning."
    )
    yield from _some(_recommendation(servo, "feedrate_suppression", limit, unit, why))


def _ramp(m: _Move) -> Iterator[Recommendation]:
    """Ramps against the torque there is (10-8, 7-67) and against the servo's own response (10-2)."""
    servo = m.servo
    cut = (m.figures["time_at_torque_limit"] or 0.0) > 0.0
    available = RESERVE * available_acceleration(servo, m.feedrate)
    unit = f"{servo.unit}/s2"
    if available <= 0.0:
        weaker = "torque_limit_positive"
        if servo.torque_limit_negative < servo.torque_limit_positive:
            weaker = "torque_limit_negative"
        why = "Friction needs all the torque that this limit allows: the axis cannot keep this feedrate."
        yield from _some(_recommendation(servo, weaker, max(2.0 * getattr(servo, weaker), 100.0), "%", why))
        return
    if m.ramp == "none" and servo.linear_acceleration > 0.0:
        return  # the move was requested without the ramp of the axis
    if m.ramp == "exponential":
        if cut:
            wanted = 1000.0 * (m.feedrate / 60.0) / available
            why = (
                "The torque was at its limit for"
                f" {shown(m.figures['time_at_torque_limit'] or 0.0, 's', 3)}; an exponential ramp starts with"
                f" feedrate / time constant, and {shown(available, unit)} is 80 % of what the torque allows."
            )
            yield from _some(_recommendation(servo, "exponential_time", wanted, "ms", why))
        return
    speed = (servo.rapid_feedrate if servo.zero_following_error else servo.cutting_feedrate) or m.feedrate
    natural = response_ramp(servo, speed)
    now = max(servo.linear_acceleration, servo.linear_deceleration) if m.ramp == "linear" else math.inf
    if cut and now > available:
        asked = shown(now, unit) if m.ramp == "linear" else "no ramp"
        why = (
            f"The torque was at its limit for {shown(m.figures['time_at_torque_limit'] or 0.0, 's', 3)}"
            f" with {asked}; {shown(available, unit)} is 80 % of what the torque allows at"
            f" {shown(m.feedrate, servo.unit)}/min."
        )
        yield from _some(_ramp_value(servo, min(available, natural), unit, why))
    elif now > natural:
        asked = f"A ramp of {shown(now, unit)}" if m.ramp == "linear" else "Without a ramp the command"
        why = (
            f"{asked} is steeper than the servo's response of"
            f" {shown(1000.0 * response_time(servo), 'ms')} to {shown(speed, servo.unit)}/min and acts like a"
            f" step in speed; the axis can follow up to {shown(natural, unit)}."
        )
        yield from _some(_ramp_value(servo, min(available, natural), unit, why))


def _ramp_value(servo: AxisServo, value: float, unit: str, why: str) -> Recommendation | None:
    """Return the recommendation for the steeper of the two ramps; a deceleration of 0 means the acceleration."""
    steeper = "linear_acceleration"
    if servo.linear_deceleration > servo.linear_acceleration > 0.0:
        steeper = "linear_deceleration"
    return _recommendation(servo, steeper, value, unit, why, up=False)


def _loops(m: _Move) -> Iterator[Recommendation]:
    """Yield recommendations for overshoot: ratio of the loops (7-54), integral gain (7-56), discharge rate."""
    servo = m.servo
    over = m.figures["overshoot"] or 0.0
    if over <= max(servo.inposition_band, 2.0 * servo.count):
        return
    ran = f"The axis overshot the end position by {shown(over, servo.unit, 3)}"
    ratio = loop_ratio(servo)
    if ratio < APERIODIC:
        why = (
            f"{ran}: the velocity loop is only {shown(ratio, digits=2)} times as fast as the position loop;"
            " with a ratio of 4 or more the position loop does not overshoot."
        )
        yield from _some(_recommendation(servo, "velocity_rate", APERIODIC * servo.position_rate, "1/s", why))
    elif servo.integral_rate > servo.velocity_rate / INTEGRAL_SHARE:
        why = f"{ran}: the integral gain is more than a tenth of the proportional gain."
        value = servo.velocity_rate / INTEGRAL_SHARE
        yield from _some(_recommendation(servo, "integral_rate", value, "1/s", why, up=False))
    elif servo.integral_rate > 0.0 and servo.integrator_discharge < 2.0:
        why = f"{ran}: the integral of the velocity error was still large; with 2 it discharges twice as fast as it charges."
        yield from _some(_recommendation(servo, "integrator_discharge", 2.0, "", why))


def _gain_break(m: _Move) -> Iterator[Recommendation]:
    servo = m.servo
    if servo.break_ratio == 1.0 or servo.cutting_feedrate is None:
        return
    wanted = gain_break_wanted(servo, servo.cutting_feedrate)
    if servo.gain_break_point < wanted:
        speed = servo.gain_break_point * servo.position_gain * 1000.0
        why = (
            f"The gain break is at {shown(speed, servo.unit)}/min, below the maximum cutting feedrate"
            f" {shown(servo.cutting_feedrate, servo.unit)}/min: contours above that speed are not accurate."
        )
        yield from _some(_recommendation(servo, "gain_break_point", wanted, servo.unit, why))


def _resolution(m: _Move) -> Iterator[Recommendation]:
    servo = m.servo
    if servo.ideal_feedback or servo.inposition_band >= servo.count:
        return
    why = (
        f"One count is {shown(servo.count, servo.unit)}: inside a band of"
        f" {shown(servo.inposition_band, servo.unit)} the in-position state is not reliable; use at least"
        " two counts."
    )
    yield from _some(_recommendation(servo, "inposition_band", 2.0 * servo.count, servo.unit, why))
