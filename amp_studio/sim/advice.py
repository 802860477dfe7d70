"""What to change after a move: each time a number, its price, and what to do with it.

Every piece of advice names one figure of the axis. Where that figure came from a parameter, the value is
given as that parameter takes it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from .laws import (
    available_acceleration,
    excess_error_wanted,
    gain_break_wanted,
    loop_ratio,
    response_ramp,
    response_time,
    steady_following_error,
)
from .rounding import rounded_down, rounded_up, shown
from .servo import AxisServo, Source
from .trace import Advice, Figure

RESERVE = 0.8
"""Share of the available acceleration a ramp may use; the rest is for load and wear. A choice of this
program."""
APERIODIC = 4.0
"""Velocity loop rate over position loop rate from which the position loop no longer overshoots."""
INTEGRAL_SHARE = 10.0
"""The tuning procedure ends with an integral gain 5 to 10 times below the proportional one (appendix A, from
A-8 on)."""
LOOSE = 2.0
"""Excess error over the wanted one from which it is called loose. A choice of this program."""


def advise(servo: AxisServo, feedrate: float, ramp: str, result: Mapping[str, Figure]) -> tuple[Advice, ...]:
    """Return the advice a move gives rise to, the most urgent first.

    ``feedrate`` is that of the move in unit/min, ``ramp`` the one in force (linear, exponential, none),
    ``result`` the figures of the move.
    """
    move = _Move(servo, feedrate, ramp, {name: figure for name, (figure, _) in result.items()})
    parts = (_excess_error, _order, _suppression, _ramp, _loops, _gain_break, _resolution)
    return tuple(advice for part in parts for advice in part(move))


@dataclass(frozen=True)
class _Move:
    """What the advice looks at: the axis, the feedrate in unit/min, the ramp in force, the figures."""

    servo: AxisServo
    feedrate: float
    ramp: str
    figures: Mapping[str, float | None]


def _advice(
    servo: AxisServo, name: str, value: float, unit: str, why: str, *, up: bool = True
) -> Advice | None:
    """Put the value into the parameter's own unit and bounds; None where it is that already."""
    source = servo.sources.get(name, Source(name))
    told = value * source.scale
    told = rounded_up(told) if up else rounded_down(told)
    if source.whole:
        told = float(math.ceil(told) if up else math.floor(told))
    if told > source.largest:
        told = source.largest
        why = f"{why[:-1]}; {shown(told)} is the most {source.parameter} takes."
    now = getattr(servo, name)
    if isinstance(now, float) and told == now * source.scale:
        return None
    why = f"{why[:-1]} (page {source.page})." if source.page else why
    return Advice(source.parameter, told, unit if source.unit is None else source.unit, why)


def _some(*advice: Advice | None) -> Iterator[Advice]:
    return (each for each in advice if each is not None)


def _excess_target(m: _Move) -> float:
    """Return the excess error the axis should have: 110 % of the largest following error where it is below
    that error or far above it, else the one it has.
    """
    wanted = excess_error_wanted(m.servo, m.servo.rapid_feedrate or m.feedrate)
    now = m.servo.excess_error
    if math.isfinite(wanted) and (now < wanted / 1.1 or now > LOOSE * wanted):
        return wanted
    return now


def _excess_error(m: _Move) -> Iterator[Advice]:
    servo, unit = m.servo, m.servo.unit
    now, wanted = servo.excess_error, _excess_target(m)
    if wanted == now:
        return
    rapid = servo.rapid_feedrate or m.feedrate
    speed = f"At {shown(rapid, unit)}/min the axis follows up to {shown(wanted / 1.1, unit)} behind"
    if now < wanted:
        why = f"{speed}, but EXCESS FOLLOWING ERROR comes at {shown(now, unit)}: allow 110 % of it."
    elif math.isinf(now):
        why = f"{speed}; without a limit a blocked axis is never noticed: allow 110 % of it."
    else:
        late = shown((now - wanted) / (rapid / 60.0), "s", 3)
        why = f"{speed}; at {shown(now, unit)} a blocked axis is noticed {late} later than with 110 % of it."
    yield from _some(_advice(servo, "excess_error", wanted, unit, why))


def _order(m: _Move) -> Iterator[Advice]:
    """A smaller excess error takes the limits below it along: inposition band < gain break point <
    feedrate suppression point <= excess error (7-20), or the control corrects them itself.
    """
    servo, unit, highest = m.servo, m.servo.unit, _excess_target(m)
    if highest >= servo.excess_error or highest >= servo.feedrate_suppression:
        return
    limits = "a limit of following error must not be above the next one"
    why = f"The feedrate suppression point goes down with the excess error: {limits}."
    yield from _some(_advice(servo, "feedrate_suppression", highest, unit, why))
    if not highest <= servo.gain_break_point < math.inf:
        return
    wanted = max(
        gain_break_wanted(servo, servo.cutting_feedrate or 0.5 * m.feedrate), 2.0 * servo.inposition_band
    )
    if wanted < highest:
        why = f"The gain break point goes down with it, to what the maximum cutting feedrate needs: {limits}."
        yield from _some(_advice(servo, "gain_break_point", wanted, unit, why))


def _suppression(m: _Move) -> Iterator[Advice]:
    servo, unit, limit = m.servo, m.servo.unit, _excess_target(m)
    lost = m.figures["time_in_feedrate_suppression"] or 0.0
    if lost == 0.0 or math.isinf(limit) or limit <= servo.feedrate_suppression:
        return
    why = (
        f"The feedrate was halved for {shown(lost, 's', 3)} of this move, because following error passed"
        f" {shown(servo.feedrate_suppression, unit)}; {shown(m.feedrate, unit)}/min alone needs"
        f" {shown(steady_following_error(servo, m.feedrate), unit)}. A value equal to the excess error turns"
        " suppression off; one in between keeps it as a warning."
    )
    yield from _some(_advice(servo, "feedrate_suppression", limit, unit, why))


def _ramp(m: _Move) -> Iterator[Advice]:
    """Ramps against the torque there is (10-8, 7-67) and against the servo's own response (10-2)."""
    servo = m.servo
    cut = (m.figures["time_at_torque_limit"] or 0.0) > 0.0
    available = RESERVE * available_acceleration(servo, m.feedrate)
    unit = f"{servo.unit}/s2"
    if available <= 0.0:
        weaker = "torque_limit_positive"
        if servo.torque_limit_negative < servo.torque_limit_positive:
            weaker = "torque_limit_negative"
        why = "Friction takes all the torque this limit allows: the axis cannot hold this feedrate."
        yield from _some(_advice(servo, weaker, max(2.0 * getattr(servo, weaker), 100.0), "%", why))
        return
    if m.ramp == "none" and servo.linear_acceleration > 0.0:
        return  # a move without the ramp the axis has was asked for
    if m.ramp == "exponential":
        if cut:
            wanted = 1000.0 * (m.feedrate / 60.0) / available
            why = (
                "The torque stood at its limit for"
                f" {shown(m.figures['time_at_torque_limit'] or 0.0, 's', 3)}; an exponential ramp starts with"
                f" feedrate / time constant, and {shown(available, unit)} is 80 % of what the torque can do."
            )
            yield from _some(_advice(servo, "exponential_time", wanted, "ms", why))
        return
    speed = (servo.rapid_feedrate if servo.zero_following_error else servo.cutting_feedrate) or m.feedrate
    natural = response_ramp(servo, speed)
    now = max(servo.linear_acceleration, servo.linear_deceleration) if m.ramp == "linear" else math.inf
    if cut and now > available:
        asked = shown(now, unit) if m.ramp == "linear" else "no ramp"
        why = (
            f"The torque stood at its limit for {shown(m.figures['time_at_torque_limit'] or 0.0, 's', 3)}"
            f" with {asked}; {shown(available, unit)} is 80 % of what it can do at"
            f" {shown(m.feedrate, servo.unit)}/min."
        )
        yield from _some(_ramp_value(servo, min(available, natural), unit, why))
    elif now > natural:
        asked = f"A ramp of {shown(now, unit)}" if m.ramp == "linear" else "Without a ramp the command"
        why = (
            f"{asked} is steeper than the servo's own response of"
            f" {shown(1000.0 * response_time(servo), 'ms')} to {shown(speed, servo.unit)}/min and acts like a"
            f" jump of speed; up to {shown(natural, unit)} the axis follows it."
        )
        yield from _some(_ramp_value(servo, min(available, natural), unit, why))


def _ramp_value(servo: AxisServo, value: float, unit: str, why: str) -> Advice | None:
    """The steeper of the two ramps is the one to change; a deceleration of 0 follows the acceleration."""
    steeper = "linear_acceleration"
    if servo.linear_deceleration > servo.linear_acceleration > 0.0:
        steeper = "linear_deceleration"
    return _advice(servo, steeper, value, unit, why, up=False)


def _loops(m: _Move) -> Iterator[Advice]:
    """Overshoot: first the ratio of the loops (7-54), then the integral share (7-56), then its discharge."""
    servo = m.servo
    over = m.figures["overshoot"] or 0.0
    if over <= max(servo.inposition_band, 2.0 * servo.count):
        return
    ran = f"The axis ran {shown(over, servo.unit, 3)} past the end"
    ratio = loop_ratio(servo)
    if ratio < APERIODIC:
        why = (
            f"{ran}: the velocity loop is only {shown(ratio, digits=2)} times as fast as the position loop;"
            " from 4 times on the position loop does not overshoot."
        )
        yield from _some(_advice(servo, "velocity_rate", APERIODIC * servo.position_rate, "1/s", why))
    elif servo.integral_rate > servo.velocity_rate / INTEGRAL_SHARE:
        why = f"{ran}: the integral share is stronger than a tenth of the proportional one."
        value = servo.velocity_rate / INTEGRAL_SHARE
        yield from _some(_advice(servo, "integral_rate", value, "1/s", why, up=False))
    elif servo.integral_rate > 0.0 and servo.integrator_discharge < 2.0:
        why = (
            f"{ran}: the sum of the velocity error was still full; at 2 it empties twice as fast as it fills."
        )
        yield from _some(_advice(servo, "integrator_discharge", 2.0, "", why))


def _gain_break(m: _Move) -> Iterator[Advice]:
    servo = m.servo
    if servo.break_ratio == 1.0 or servo.cutting_feedrate is None:
        return
    wanted = gain_break_wanted(servo, servo.cutting_feedrate)
    if servo.gain_break_point < wanted:
        speed = servo.gain_break_point * servo.position_gain * 1000.0
        why = (
            f"The gain breaks at {shown(speed, servo.unit)}/min, below the maximum cutting feedrate"
            f" {shown(servo.cutting_feedrate, servo.unit)}/min: contours above it are not true."
        )
        yield from _some(_advice(servo, "gain_break_point", wanted, servo.unit, why))


def _resolution(m: _Move) -> Iterator[Advice]:
    servo = m.servo
    if servo.ideal_feedback or servo.inposition_band >= servo.count:
        return
    why = (
        f"One count is {shown(servo.count, servo.unit)}: inside a band of"
        f" {shown(servo.inposition_band, servo.unit)} the axis is never sure to be in position; two counts"
        " are."
    )
    yield from _some(_advice(servo, "inposition_band", 2.0 * servo.count, servo.unit, why))
