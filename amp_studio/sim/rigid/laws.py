"""Closed equations of the manual and of textbooks for an axis.

Lengths in the axis' unit, velocities in unit/min, accelerations in unit/s2, times in s.
"""

from __future__ import annotations

import math

from .servo import AxisServo

RESPONSE_SHARE = 1.0 - math.exp(-2.0)
"""Share of the final speed of a first-order lag after two time constants: 86.5 %.

The manual's response time of 120 ms at gain 1 (10-2) is two of the 60 ms of that gain (Table 7.A, 7-25)."""


def steady_following_error(servo: AxisServo, feedrate: float) -> float:
    """Return the following error at a constant feedrate; infinite if the loop never reaches that feedrate.

    feedrate / (gain x 1000) (7-25); with velocity feed-forward of p % the share 1 - p/100 of it (7-28). With
    a gain break: up to the feedrate 1000 gain x break point as above,
    beyond it break point + (feedrate - that feedrate) / (1000 gain x ratio) (inverse of the law of 7-22 and
    7-27).
    """
    plain = abs(feedrate) * (1.0 - servo.feed_forward_share) / (servo.position_gain * 1000.0)
    if servo.break_ratio == 1.0 or plain <= servo.gain_break_point:
        return plain
    if servo.break_ratio == 0.0:
        return math.inf
    return servo.gain_break_point + (plain - servo.gain_break_point) / servo.break_ratio


def excess_error_wanted(servo: AxisServo, rapid: float) -> float:
    """Return 110 % of the largest following error to expect: 1.1 rapid / (gain x 1000 x ratio) (7-20)."""
    if servo.break_ratio == 0.0:
        return math.inf
    return 1.1 * rapid / (servo.position_gain * 1000.0 * servo.break_ratio)


def gain_break_wanted(servo: AxisServo, cutting: float) -> float:
    """Return the least gain break point that keeps cutting below it: 0.001 x feedrate / gain (7-22)."""
    return 0.001 * cutting / servo.position_gain


def response_time(servo: AxisServo) -> float:
    """Return the time in s to go from one steady speed to another: 120 ms / gain (10-2)."""
    return 0.12 / servo.position_gain


def response_ramp(servo: AxisServo, feedrate: float) -> float:
    """Return the ramp that matches the response of the servo: feedrate / response time (10-2)."""
    return feedrate / 60.0 / response_time(servo)


def loop_ratio(servo: AxisServo) -> float:
    """Return the ratio of velocity loop rate to position loop rate.

    For a first-order velocity loop the damping of the position loop is half the root of this ratio: 4 for the
    aperiodic limit (Gross, Hamann, Wiegärtner, Electrical Feed Drives in Automation, 2001).
    """
    return servo.velocity_rate / servo.position_rate


def available_acceleration(servo: AxisServo, feedrate: float) -> float:
    """Return the acceleration that the lower torque limit allows at a feedrate after friction; may be
    negative.
    """
    torque = min(servo.torque_limit_positive, servo.torque_limit_negative)
    friction = servo.coulomb_friction + servo.viscous_friction * abs(feedrate) / 1000.0
    return servo.acceleration_at_rated * (torque - friction) / 100.0
