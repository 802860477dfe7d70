"""The DDA limit of generic controllers: section 1.4."""

from __future__ import annotations

from amp_studio.validate import not_negative, positive

from .resolution import travel_per_motor_turn

DDA_LIMIT = 2047.0
"""Most pulses of an axis in one interpolation time (page 1.4.1)."""

US_PER_MINUTE = 60e6

PRINTED_BASIC_TIMES_US = {"super": 983.0, "a10": 819.0, "b10": 819.0}
"""Hardware basic time by Controller series (page 1.4.1)."""

WITHOUT_PRINTED_TIME = ("s20", "s21", "s6", "ez")
"""Series of which none is printed (erratum e-3203-series)."""


def hardware_basic_time_us(series: str) -> float:
    """Hardware basic time in µs: 983 for super, 819 for a10 and b10 (page 1.4.1).

    Of the other series none is printed; they get the longest, with which the limit is lowest.
    """
    if series in WITHOUT_PRINTED_TIME:
        return max(PRINTED_BASIC_TIMES_US.values())
    try:
        return PRINTED_BASIC_TIMES_US[series]
    except KeyError:
        known = ", ".join((*PRINTED_BASIC_TIMES_US, *WITHOUT_PRINTED_TIME))
        raise ValueError(f"series must be one of {known}, not '{series}'.") from None


def is_basic_time_printed(series: str) -> bool:
    """Whether the hardware basic time of a series is printed, not assumed (page 1.4.1,
    erratum e-3203-series).
    """
    return series in PRINTED_BASIC_TIMES_US


def interpolation_time_us(setting: float, basic_time_us: float) -> float:
    """Interpolation time in µs: Pr3203 / 1000 x hardware basic time (page 1.4.1)."""
    return positive("setting", setting) * positive("basic_time_us", basic_time_us) / 1000.0


def dda_pulses_per_minute(time_us: float) -> float:
    """Most pulses in a minute: 2047 in each interpolation time (page 1.4.2)."""
    return DDA_LIMIT * US_PER_MINUTE / positive("time_us", time_us)


def dda_motor_speed(time_us: float, pulses: float) -> float:
    """Highest motor speed under the DDA limit in rpm,
    with so many pulses a turn after multiplication (page 1.4.2).
    """
    return dda_pulses_per_minute(time_us) / positive("pulses", pulses)


def dda_feedrate(
    time_us: float, pulses: float, pitch: float, screw_teeth: float = 1.0, motor_teeth: float = 1.0
) -> float:
    """Highest feedrate under the DDA limit, in the unit of the pitch per minute (page 1.4.2).

    The printed formula has no gear; with one the screw turns by the ratio
    of page 1.2.6 slower than the motor.
    """
    # One division at the end, so that whole figures give an exact limit.
    way = US_PER_MINUTE * positive("pitch", pitch) * positive("motor_teeth", motor_teeth)
    pulses_for_it = (
        positive("time_us", time_us) * positive("pulses", pulses) * positive("screw_teeth", screw_teeth)
    )
    return DDA_LIMIT * way / pulses_for_it


def commands_per_interpolation(
    feedrate: float,
    time_us: float,
    pulses: float,
    pitch: float,
    screw_teeth: float = 1.0,
    motor_teeth: float = 1.0,
) -> float:
    """Pulses that a feedrate sends in one interpolation time; more than 2047 bring MOT-005 (page 1.5.1)."""
    turns = not_negative("feedrate", feedrate) / travel_per_motor_turn(pitch, screw_teeth, motor_teeth)
    return turns * positive("pulses", pulses) * positive("time_us", time_us) / US_PER_MINUTE
