"""Servo-control: chapter 6, and what chapter 11 adds to its parameters.

Speeds are mm or degrees per minute as in the words of P30, times (the sampling period too) are ms, and
``unit`` is the internal unit of the axis in mm or degrees (see ``units``).
The manual's own formulas take mm/s and seconds.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from amp_studio.validate import finite, not_negative, percent_of, positive, whole

from .units import internal_unit_mm, rotary_unit_deg, servo_coefficient, to_internal

INCREMENTS_PER_SAMPLE = 30000
"""Most increments that an axis may travel in one sample (page 6-6)."""

DAC_POINTS_AT_10_V = 32768
"""Points of the 15-bit converter of an axis encoder card at its full 10 V (page 6-14)."""

DAC_POINTS_AT_9_V = 29491
"""The same at 9 V, the reference at which an axis usually has its top speed (page 6-14)."""

FOLLOWING_ERROR_MARGIN = 1.1
"""10 percent above the following error at top speed (page 6-44)."""

GAIN_BAND = (0.875, 1.125)
"""Multipliers of the loop gain for the slowest and the fastest right speed (page 6-24)."""


ROTARY_NAMES = (6.0, 7.0, 8.0)
"""A, B and C in the right digit of a word of P9 (page 4-24)."""


def axis_turns(axis: float, modulo: float, limited: float, assignment: float) -> bool:
    """Return whether an axis turns, as P1 declares it or its name A, B or C does (page 4-12).

    The axis is given by its address, the rest are the words P1N0 and P1N1 and its own word of P9.
    """
    declared = int(modulo) | int(limited)
    return declared >> int(axis) & 1 == 1 or float(int(assignment) & 15) in ROTARY_NAMES


def axis_unit(
    axis: float, modulo: float, limited: float, assignment: float, digits: float, divider: float
) -> float:
    """Internal unit of one axis in mm, or in degrees where it turns (page 4-18);
    the last two are P4N2 and P4N4.
    """
    turns = axis_turns(axis, modulo, limited, assignment)
    return rotary_unit_deg(divider) if turns else internal_unit_mm(digits)


# -- speed and acceleration


def increments_per_sample(speed: float, period: float, unit: float) -> float:
    """Increments per sample at a speed (page 6-6)."""
    per_second = to_internal(not_negative("The speed", speed) / 60.0, unit)
    return per_second * positive("The sampling period", period) / 1000.0


def largest_traverse_rate(period: float, unit: float) -> float:
    """Largest Maximum Axis Traverse Rate for a sampling period: 30000 increments per sample (page 6-6)."""
    samples_per_minute = 60000.0 / positive("The sampling period", period)
    return INCREMENTS_PER_SAMPLE * samples_per_minute * positive("The internal unit", unit)


def slowest_axis(speeds: Sequence[float | None], measured: float, servoed: float) -> float:
    """Speed of Fast JOG: the lowest top speed among the servo-controlled axes,
    in the order of addresses (page 6-42).

    The masks are those of P2 and P3; an axis without a top speed does not count.
    """
    declared = int(measured) & int(servoed)
    known = [speed for axis, speed in enumerate(speeds) if declared >> axis & 1 and speed]
    if not known:
        raise ValueError("No servo-controlled axis has a top speed.")
    return min(known)


def smallest_acceleration(period: float, unit: float) -> float:
    """Acceleration of 1 increment per sample squared, which the words of P32 must exceed (page 6-10)."""
    seconds = positive("The sampling period", period) / 1000.0
    return positive("The internal unit", unit) / (seconds * seconds)


def buildup_acceleration(speed: float, buildup_time: float) -> float:
    """Maximum acceleration DDM from a top speed and the ms in which it is reached (page 6-43)."""
    return not_negative("The speed", speed) / 60.0 * 1000.0 / positive("The speed buildup time", buildup_time)


def average_acceleration(speed_variation: float, least_time: float, acceleration: float) -> float:
    """Average acceleration with the sin² function for a change of speed (page 6-38).

    ``least_time`` is the word of P53; 0 is the old way,
    half of the greatest acceleration whatever the change.
    """
    # The mean of a sin² ramp is half of its greatest acceleration.
    half = not_negative("The acceleration", acceleration) / 2.0
    change = not_negative("The speed variation", speed_variation) / 60.0
    seconds = _seconds(least_time)
    # A small change takes the least time of P53, and is gentler than the limit then.
    return change / seconds if change < seconds * half else half


def approach_speed(acceleration: float, time_constant: float, divider: float = 1.0) -> float:
    """Approach Speed from acceleration and time constant (page 6-36): 1000 mm/s² and 60 ms give 3600 mm/min.

    With the very high speed machining option the manual divides it by a value of around 9.
    """
    per_second = not_negative("The acceleration", acceleration) * _seconds(time_constant)
    return round(per_second * 60.0 / positive("The divider", divider), 6)


# -- the position loop


def loop_gain_per_second(gain: float) -> float:
    """Gain in 1/s of a gain in m/min per mm of following error (page 6-14): 1 is 16.66."""
    return 1000.0 / 60.0 * positive("The gain", gain)


def loop_time_constant(gain: float) -> float:
    """Time constant of a gain in m/min per mm of following error (page 6-14): 1 is 60 ms."""
    return 1000.0 / loop_gain_per_second(gain)


def measured_time_constant(speed: float, following_error: float) -> float:
    """Time constant from a speed and its following error (page 6-18): 1 m/min and 1 mm are 60 ms."""
    return positive("The following error", following_error) * 60000.0 / positive("The speed", speed)


def of_group(values: Sequence[float | None], assignment: float) -> float:
    """Value of the group of an axis, out of one for each group: the left digit of its word of P9 (page
    4-24).
    """
    group = int(assignment) >> 4
    found = values[group] if group < len(values) else None
    if found is None:
        raise ValueError("The axis belongs to no group, or its group has no such value.")
    return found


def axis_time_constant(own: float, of_group: float) -> float:
    """Time constant of an axis: its word of P66, and if that is 0 the one of its group (page 6-40)."""
    group = not_negative("The time constant of the group", of_group)
    return not_negative("The time constant of the axis", own) or group


def steady_following_error(speed: float, time_constant: float) -> float:
    """Following error in mm or degrees at a steady speed without speed anticipation (page 6-14)."""
    return not_negative("The speed", speed) / 60.0 * _seconds(time_constant)


def reference_points(voltage: float) -> float:
    """Points of the axis card's converter for a speed reference (page 6-14): 9 V are 29491."""
    if not 0 <= voltage <= 10:
        raise ValueError(f"The reference voltage must be 0 to 10 V, not {voltage!r}.")
    # Whole points, rounded down: 9 V are 29491.2, and the page prints 29491.
    return float(math.floor(voltage / 10.0 * DAC_POINTS_AT_10_V))


def loop_gain_coefficient(max_speed: float, time_constant: float, unit: float, voltage: float = 9.0) -> float:
    """Servo-System Loop Gain Coefficient KVAR from top speed and time constant (page 6-14).

    ``voltage`` is the reference at which the axis has its top speed;
    another than 9 V takes its place (page 6-44).
    """
    error = steady_following_error(
        positive("The speed", max_speed), positive("The time constant", time_constant)
    )
    return reference_points(voltage) / error * servo_coefficient(unit)


def reference_voltage(coefficient: float, max_speed: float, time_constant: float, unit: float) -> float:
    """Reference in V that a KVAR gives at top speed (page 6-14); the converter ends at 10 V."""
    error = steady_following_error(max_speed, time_constant)
    points = not_negative("The loop gain coefficient", coefficient) * error / servo_coefficient(unit)
    # By the printed 29491 points, so that KVAR and this give 9 V back exactly.
    return points * 9.0 / DAC_POINTS_AT_9_V


def max_following_error(max_speed: float, time_constant: float, unit: float) -> float:
    """Maximum Following Error EMAX in internal units, with its margin of 10 percent (page 6-22)."""
    return to_internal(FOLLOWING_ERROR_MARGIN * steady_following_error(max_speed, time_constant), unit)


def theoretical_speeds(following_error: float, time_constant: float) -> tuple[float, float]:
    """Speeds between which the real one must be at a following error in mm or degrees (page 6-24).

    How the tolerance of P57 widens that band was in a figure that is lost.
    """
    seconds = positive("The time constant", time_constant) / 1000.0
    speed = not_negative("The following error", following_error) / seconds * 60.0
    return GAIN_BAND[0] * speed, GAIN_BAND[1] * speed


# -- tolerances


def in_position_window(standing_error: float) -> float:
    """In-Position Window: twice the error displayed at standstill (page 11-7)."""
    return 2.0 * not_negative("The error of the standing axis", standing_error)


def movement_tolerances(window: float) -> tuple[float, float]:
    """Least and greatest usual tolerance of Dynamic Movement Control:
    2 and 4 in-position windows (page 11-8).
    """
    window = not_negative("The in-position window", window)
    return 2.0 * window, 4.0 * window


def circle_error(speed: float, time_constant: float, radius: float) -> float:
    """Servo-loop error in mm on a circle with a radius in mm (page 6-32)."""
    error = steady_following_error(speed, time_constant)
    return error * error / (2.0 * positive("The radius", radius))


def circle_speed(tolerance: float, time_constant: float, radius: float) -> float:
    """Greatest speed on a circle with a radius in mm for a tolerated error in µm (page 6-32)."""
    room = 2.0 * positive("The radius", radius) * not_negative("The tolerated error", tolerance) / 1000.0
    return math.sqrt(room) * 60000.0 / positive("The time constant", time_constant)


# -- very high speed machining


def effective_anticipation(percent: float) -> float:
    """Speed anticipation in percent that the system uses: more than 100 counts as 100 (page 6-26)."""
    return percent_of("The speed anticipation", min(percent, 100.0))


def filtered_reference(references: Sequence[float], terms: float) -> float:
    """Mean of the last 2j+1 speed references, the newest last (page 6-26)."""
    number = whole("The number of terms", terms)
    if number > len(references):
        raise ValueError(f"{number} terms need as many references, not {len(references)}.")
    return math.fsum(references[-number:]) / number


def friction_correction(amplitudes: Sequence[float], period: float, time_constant: float) -> float:
    """Dry friction correction after a sequence of amplitudes, the newest last (page 6-34).

    Each sample adds the change of the amplitude to what the time constant leaves of the correction before it;
    period and time constant are in the same unit.
    """
    left = 1.0 - positive("The sampling period", period) / positive("The time constant", time_constant)
    correction = before = 0.0
    for amplitude in amplitudes:
        correction = finite("An amplitude", amplitude) - before + correction * left
        before = amplitude
    return correction


def _seconds(milliseconds: float) -> float:
    return not_negative("The time in ms", milliseconds) / 1000.0
