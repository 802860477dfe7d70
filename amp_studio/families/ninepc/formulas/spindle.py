"""Spindles: chapters 7, 11 to 13, 16 and 27. Angles are in degrees, speeds in rpm."""

from __future__ import annotations

import math

from amp_studio.validate import finite, not_negative, percent_of, positive, whole

DEGREES_PER_GAIN_UNIT = 0.36
"""The gain of a spindle counts rpm per 0.001 revolution, which is 0.36 degrees (page 12-15)."""

TURN = 360.0


# -- chapter 7: 1394 spindles


def spindle_speed(motor_rpm: float, motor_teeth: float, shaft_teeth: float) -> float:
    """Spindle rpm behind the gear of a 1394 spindle (pages 7-82 and 7-83)."""
    motor = whole("The number of motor teeth", motor_teeth)
    return finite("The motor speed", motor_rpm) * motor / whole("The number of shaft teeth", shaft_teeth)


def spindle_motor_speed(spindle_rpm: float, motor_teeth: float, shaft_teeth: float) -> float:
    """Motor rpm that a 1394 spindle needs for a spindle rpm (pages 7-82 and 7-83)."""
    shaft = whole("The number of shaft teeth", shaft_teeth)
    return finite("The spindle speed", spindle_rpm) * shaft / whole("The number of motor teeth", motor_teeth)


# -- chapters 11 and 16: speeds in a program


def css_spindle_speed(surface_speed: float, radius: float, inch: bool) -> float:
    """Spindle rpm that keeps a constant surface speed at a radius (page 11-1).

    m/min and mm, or with ``inch`` ft/min and inch, as an S-word counts them (page 16-15). The manual prints
    no equation: speed = circumference x rpm is implied.
    """
    per_unit = 12.0 if inch else 1000.0
    around = 2.0 * math.pi * positive("The distance from the center", radius)
    return not_negative("The surface speed", surface_speed) * per_unit / around


def feed_per_minute(per_revolution: float, rpm: float) -> float:
    """Feedrate per minute of a feed or thread lead per spindle revolution (pages 16-7, 16-10 and 18-2).

    In the length unit of ``per_revolution``; implied by the units of the words, not printed.
    """
    return not_negative("The feed per revolution", per_revolution) * not_negative("The spindle speed", rpm)


# -- chapters 12 and 13: analog output and deviation


def spindle_voltage(rpm: float, max_rpm: float, volts_at_max: float) -> float:
    """DAC output in V at a spindle speed of a gear: its share of Voltage at Max (page 12-5).

    The voltage at Max. Spindle Speed is what the manual defines; that speeds below it are in proportion is
    implied, not printed. ValueError above Max. Spindle Speed, which the output does not go beyond.
    """
    top = positive("Max. Spindle Speed", max_rpm)
    if not_negative("The spindle speed", rpm) > top:
        raise ValueError(f"The gear ends at {max_rpm!r} rpm, below {rpm!r}.")
    return finite("Voltage at Max", volts_at_max) * rpm / top


def spindle_ramp_step(top_rpm: float, duration_ms: float, scan_ms: float) -> float:
    """Change of speed in rpm that DAC output ramping makes in one coarse iteration (page 12-3).

    The ramp goes from 0 to ``top_rpm`` in ``duration_ms``: Maximum Tapping Speed and Acceleration Time with
    the solid tapping option, else Max. Spindle Speed and Dev. Detection Filter Time. ``scan_ms`` is the
    coarse scan time. The division is implied, not printed.
    """
    duration = positive("The duration of the ramp", duration_ms)
    return not_negative("The speed", top_rpm) * positive("The coarse scan time", scan_ms) / duration


def deviation_band(rpm: float, tolerance: float) -> tuple[float, float]:
    """Lowest and highest speed in rpm without excessive deviation: 20 % of 1000 are 800, 1200 (page 12-5)."""
    share = not_negative("The spindle speed", rpm) * percent_of("Spindle Deviation Tolerance", tolerance)
    return rpm - share / 100.0, rpm + share / 100.0


def deviation_filter_time_ms(shortest_ms: float, longest_ms: float) -> float:
    """Dev. Detection Filter Time in ms: mean of the times of smallest and largest change (page 12-9)."""
    longest = not_negative("The time of the largest change", longest_ms)
    return (not_negative("The time of the smallest change", shortest_ms) + longest) / 2.0


# -- chapters 12 and 13: orienting


def spindle_zero_angle(marker: float, calibration: float) -> float:
    """Angle of the spindle zero, counted from where the marker was counted from, 0 to 360 (page 12-11)."""
    angle = finite("The angle of the marker", marker) + finite("Spindle Marker Calibration", calibration)
    return angle % TURN


def orient_turn(position: float, target: float) -> float:
    """Signed angle, positive with the angles, that an orient turns once the marker is known (page 12-13).

    Of a closed-loop spindle at rest, by the shortest way. The manual does not state which way half a turn
    goes; here it is positive.
    """
    way = (finite("The orient angle", target) - finite("The position", position)) % TURN
    return way - TURN if way > TURN / 2.0 else way


def spindle_following_error(rpm: float, gain: float) -> float:
    """Following error in degrees of a closed spindle loop: 0.36 x rpm / gain (page 12-15).

    Gain for Spindle counts rpm per 0.001 revolution; Excess Error and Gain Break Point of a spindle are
    compared with it in degrees (pages 7-20 and 7-22).
    """
    return DEGREES_PER_GAIN_UNIT * not_negative("The spindle speed", rpm) / positive("The gain", gain)


# -- chapter 27: solid tapping


def tapping_gain(axis_gain: float, spindle_gain: float) -> float:
    """Gain of axis and spindle while solid tapping: the lower of the two (page 12-15)."""
    return min(
        positive("The gain of the tapping axis", axis_gain), positive("The spindle gain", spindle_gain)
    )


def acceleration_time_s(milliseconds: float) -> float:
    """Acceleration Time in s, as it is entered, of a time in ms: 125 ms are 0.125 (page 27-2)."""
    return not_negative("The acceleration time", milliseconds) / 1000.0


def tapping_ramp(max_rpm: float, time_s: float) -> float:
    """Spindle ramp in rpm per s: from 0 to Maximum Tapping Speed in Acceleration Time (page 27-2)."""
    return not_negative("Maximum Tapping Speed", max_rpm) / positive("Acceleration Time", time_s)


def tapping_acceleration(ramp: float, lead: float, axis_acceleration: float) -> float:
    """Acceleration of the tapping axis, per s squared: the lower of the axis's and the spindle's (page 27-2).

    ``ramp`` of the spindle in rpm per s, ``lead`` of the thread in the length unit of ``axis_acceleration``.
    That the spindle moves the axis by the lead in each turn is implied, not printed.
    """
    of_spindle = not_negative("The spindle ramp", ramp) / 60.0 * positive("The thread lead", lead)
    return min(of_spindle, not_negative("The acceleration of the tapping axis", axis_acceleration))
