"""Positions, speeds, accelerations, gear ratio and output, in units and in register words."""

from __future__ import annotations

from amp_studio.validate import finite, not_negative, positive, whole

from .registers import SCAN_MS

VELOCITY_SCALE = 65.536
"""Register number of 1 count/s (page 4-13)."""
ACCELERATION_SCALE = 0.065536
"""Register number of 1 count/s2 (page 4-13)."""
GEAR_SCALE = 16777216.0
"""Register number of the ratio 1 (page 4-15)."""
VOLTAGE_SCALE = 198.4
"""Register number of 1 V: 1984 is 10 V (page 4-17)."""


def position_counts(position: float, counts_per_unit: float) -> float:
    """Counts of a position or distance in units (page 5-7)."""
    return finite("The position", position) * positive("The counts of a unit", counts_per_unit)


def counts_per_second(speed: float, counts_per_unit: float) -> float:
    """Counts/s of a speed in units/s (page 5-7)."""
    return finite("The speed", speed) * positive("The counts of a unit", counts_per_unit)


def counts_per_second_squared(acceleration: float, counts_per_unit: float) -> float:
    """Counts/s2 of an acceleration in units/s2 (page 4-13)."""
    return finite("The acceleration", acceleration) * positive("The counts of a unit", counts_per_unit)


def velocity_word(speed: float) -> float:
    """Register number of a speed in counts/s: times 65.536 (page 4-13)."""
    return finite("The speed", speed) * VELOCITY_SCALE


def acceleration_word(acceleration: float) -> float:
    """Register number of an acceleration in counts/s2: times 0.065536 (page 4-13)."""
    return finite("The acceleration", acceleration) * ACCELERATION_SCALE


def velocity_error_word(speed: float) -> float:
    """Register number of a velocity error in counts/s: counts in a scan (page 4-9)."""
    return finite("The velocity error", speed) * SCAN_MS / 1000.0


def measured_velocity(counts: float, period_ms: float) -> float:
    """Speed in counts/s of the counts in registers 78, 79,
    gathered for the period of register 83 (page 4-41).
    """
    return finite("The counts", counts) / (positive("The period", period_ms) / 1000.0)


def home_speeds(speed: float) -> tuple[float, float]:
    """Slow and fast speed of homing in the printed program,
    a hundredth and a tenth of the axis' speed (page 5-6).
    """
    whole_speed = positive("The speed", speed)
    return whole_speed / 100.0, whole_speed / 10.0


def deceleration_ratio(acceleration: float, deceleration: float) -> float:
    """Deceleration over acceleration, which has to be 0.2 to 5 (page 4-14)."""
    return finite("The deceleration", deceleration) / positive("The acceleration", acceleration)


def s_curve_time(trapezoidal_time: float) -> float:
    """Time to accelerate or decelerate with the S-curve profile: twice that of the trapezoid (page 4-25)."""
    return 2.0 * not_negative("The time with the trapezoid", trapezoidal_time)


def gear_ratio(feedback_travel: float, gearing_travel: float) -> float:
    """Gear ratio: travel of the feedback axis over that of the gearing reference axis, in counts (page
    4-15).
    """
    return finite("The travel of the feedback axis", feedback_travel) / positive(
        "The travel of the gearing reference axis", gearing_travel
    )


def gear_ratio_of_units(
    ratio: float, feedback_counts_per_unit: float, gearing_counts_per_unit: float
) -> float:
    """Gear ratio in counts of one in units: times feedback counts of a unit over gearing counts (page
    5-8).
    """
    scaled = positive("The feedback counts of a unit", feedback_counts_per_unit) * positive(
        "The ratio", ratio
    )
    return scaled / positive("The gearing counts of a unit", gearing_counts_per_unit)


def gear_ratio_word(ratio: float) -> float:
    """Register number of a gear ratio: times 16777216, which is 65536 times 256 (pages 4-15 and 5-8)."""
    return positive("The ratio", ratio) * GEAR_SCALE


def voltage_word(volts: float) -> float:
    """Register number of an output voltage: 1984 for 10 V (pages 4-16 and 4-17)."""
    return finite("The voltage", volts) * VOLTAGE_SCALE


def backlash_moves(distance: float, backlash: float) -> tuple[int, ...]:
    """Moves, in counts, that a commanded move becomes with automatic backlash compensation (page 4-21).

    A move in the direction of the compensation's sign is made as it is; one against it overruns by the
    compensation and comes back.
    """
    counts = whole("The distance", distance, -(2**31))
    play = whole("The backlash compensation", backlash, -(2**31))
    if counts * play >= 0:
        return (counts,)
    return counts - play, play
