"""The following error and the limits at which it is an alarm: slides 1.5.3 and 1.5.4."""

from __future__ import annotations

from amp_studio.validate import not_negative, positive

from .resolution import STANDARD_BLU

ALARM_FACTOR = 2.0
"""MOT-019 comes up at so many times the following error of the fastest of both speeds (page 1.5.3)."""

FATAL_FACTOR = 4.0
"""MOT-023 comes up at so many times the same (page 1.5.4)."""


def following_error(speed: float, gain: float, blu: float = STANDARD_BLU) -> float:
    """Reasonable following error in BLU of an axis at a speed in mm/min: speed / loop gain (page 1.5.3)."""
    return not_negative("speed", speed) / positive("blu", blu) / 60.0 / positive("gain", gain)


def following_error_limit(
    first_homing_speed: float, rapid: float, gain: float, blu: float = STANDARD_BLU
) -> float:
    """Following error in BLU beyond which MOT-019 comes up: max(homing, G00) / Kp x 2 (page 1.5.3)."""
    return ALARM_FACTOR * following_error(max(first_homing_speed, rapid), gain, blu)


def fatal_following_error_limit(
    first_homing_speed: float, rapid: float, gain: float, blu: float = STANDARD_BLU
) -> float:
    """Following error in BLU beyond which MOT-023 comes up: max(homing, G00) / Kp x 4 (page 1.5.4)."""
    return FATAL_FACTOR * following_error(max(first_homing_speed, rapid), gain, blu)


def alarm_speed(first_homing_speed: float, rapid: float) -> float:
    """Steady speed whose following error is just that of MOT-019, whatever the loop gain (page 1.5.3)."""
    return ALARM_FACTOR * not_negative("speed", max(first_homing_speed, rapid))


def fatal_alarm_speed(first_homing_speed: float, rapid: float) -> float:
    """Steady speed whose following error is just that of MOT-023, whatever the loop gain (page 1.5.4)."""
    return FATAL_FACTOR * not_negative("speed", max(first_homing_speed, rapid))
