"""Feedrates and ramps: chapters 9 and 10."""

from __future__ import annotations

import math
from collections.abc import Sequence

from amp_studio.validate import finite, not_negative, percent_of, positive

JERK_SCANS = (2, 60)
"""Shortest and longest S-curve in coarse scans (page 10-19)."""


# -- chapter 9: feedrates


def vector_feedrate_limit(distances: Sequence[float], limits: Sequence[float]) -> float:
    """Highest path feedrate of a straight move at which no axis exceeds its own limit (pages 9-1, 9-2).

    ``limits`` are the rapid or maximum cutting feedrates of the axes whose ``distances`` are given.
    """
    if len(distances) != len(limits):
        raise ValueError("Every axis of the move needs its distance and its feedrate limit.")
    length = math.hypot(*(finite("A distance", distance) for distance in distances))
    if length == 0:
        raise ValueError("A move without length has no feedrate.")
    pairs = zip(distances, limits, strict=True)
    return min(not_negative("A feedrate limit", top) * length / abs(way) for way, top in pairs if way)


def f1_rapid(rapid: float, percent: float) -> float:
    """Rapid feedrate with the rapid override switch on F1; 0 % is standstill (page 9-5)."""
    share = percent_of("F1 Rapid Override Percent", percent) / 100.0
    return not_negative("The rapid feedrate", rapid) * share


def arc_radius_error(
    start: tuple[float, float], end: tuple[float, float], center: tuple[float, float]
) -> float:
    """Difference of start and end radius, to compare with Circular Error Tolerance Limit (page 9-9)."""
    return abs(math.dist(start, center) - math.dist(end, center))


def arc_reaches(start: tuple[float, float], end: tuple[float, float], radius: float) -> bool:
    """Whether an arc given by R exists: start and end at most twice the radius apart (page 9-9)."""
    if finite("The radius", radius) == 0:
        raise ValueError("The radius of an arc must not be zero.")
    return math.dist(start, end) <= 2.0 * abs(radius)


# -- chapter 10: acc/dec


def response_time_ms(gain: float) -> float:
    """Time of the servo from one steady speed to another: 120 ms / gain (page 10-2).

    The table on that page prints 30 and 15 ms for the gains 3 and 4; the equation gives 40 and 30.
    """
    return 120.0 / positive("The gain", gain)


def linear_ramp_per_ms(speed: float, response_ms: float) -> float:
    """Linear Acc/Dec ramp as the manual prints it: speed per minute, gained per ms (page 10-2)."""
    return not_negative("The contouring speed", speed) / positive("The response time", response_ms)


def linear_ramp(speed: float, response_ms: float) -> float:
    """Linear Acc/Dec ramp per second squared, as 1210 and 1211 want it: speed over time (page 10-2).

    The ramp per ms times 1000 ms/s over 60 s/min. ``speed`` per minute is the highest contouring speed, with
    ZFE Closed Loop the rapid feedrate.
    """
    return linear_ramp_per_ms(speed, response_ms) * 1000.0 / 60.0


def deceleration_in_force(deceleration: float, acceleration: float) -> float:
    """Deceleration ramp the control uses: the acceleration ramp where it is 0 (pages 10-10 and 10-13)."""
    ramp = not_negative("The deceleration ramp", deceleration)
    return ramp or not_negative("The acceleration ramp", acceleration)


def is_velocity_step(feedrate: float, next_feedrate: float, step: float) -> bool:
    """Whether the change between two blocks is made at once, without Acc/Dec (page 10-7).

    True up to and including Velocity Step for ACC/DEC; all three in one speed unit.
    """
    change = abs(finite("The next feedrate", next_feedrate) - finite("The feedrate", feedrate))
    return change <= not_negative("Velocity Step for ACC/DEC", step)


def exponential_speed(
    start: float, commanded: float, elapsed_s: float, delay_constant: float, scan_ms: float
) -> float:
    """Axis speed a time after an exponential speed change began; up and down alike (page 10-14).

    start + (commanded - start)(1 - e^-x) with x = (1000 / scan_ms) elapsed_s / delay_constant; all speeds
    in one unit, ``elapsed_s`` in s, ``delay_constant`` in coarse scans, ``scan_ms`` in ms.
    """
    scans = 1000.0 / positive("The system scan time", scan_ms) * not_negative("The elapsed time", elapsed_s)
    x = scans / positive("The delay constant", delay_constant)
    change = finite("The commanded speed", commanded) - finite("The start speed", start)
    return start - change * math.expm1(-x)


def exponential_time_ms(delay_constant: float, scan_ms: float) -> float:
    """Whole time of an exponential speed change in ms: five time constants (pages 10-14, 10-17)."""
    return 5.0 * positive("The delay constant", delay_constant) * positive("The system scan time", scan_ms)


def scurve_time(ramp: float, jerk: float) -> float:
    """S-curve time in s from a ramp and a jerk in units of one second: T = R / J (page 10-19)."""
    return not_negative("The ramp", ramp) / positive("The jerk", jerk)


def jerk_limits(ramp: float, scan_ms: float) -> tuple[float, float]:
    """Smallest and largest Axis Jerk for a ramp and the coarse scan time in ms (page 10-19).

    J = R / T with T of 60 and of 2 scans, per second: a ramp in mm/s2 gives mm/s3, one in in/min/s gives
    in/min/s2. (The second footnote on page 10-22 has the two scan counts exchanged.)
    """
    scan_s = positive("The coarse scan time", scan_ms) / 1000.0
    shortest, longest = JERK_SCANS
    return not_negative("The ramp", ramp) / (longest * scan_s), ramp / (shortest * scan_s)
