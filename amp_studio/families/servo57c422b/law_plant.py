"""The motor behind a 57C422B, which the module knows nothing of: figures that are assumed,
named and settable.

The manual prints no motor. The evidence of its two tuned programs (pages 4-48 and 5-5), read with the scales
of `law_sample.py`, in words (1984 is 10 V) and counts a scan (1.25 ms):

    program    velocity gain   feed-forward   viscous friction = gain × (feed-forward / 8192 - 1)   deadband
    page 4-48             78           8320                                                   1.22        28
    page 5-5             140           8256                                                   1.09        27

The acceleration is such that both programs are stable and well damped and a velocity gain well above them
makes the motor vibrate, as in step 4 of page 5-4.
"""

from __future__ import annotations

from amp_studio.sim import Machine

from .law_facts import MOTION
from .law_sample import SCAN, WORDS_PER_VOLT

ACCELERATION = MOTION.value("acceleration_per_output")
"""Counts/s² for 1 V of a current reference."""
VISCOUS = MOTION.value("viscous_friction") * SCAN / WORDS_PER_VOLT
"""V for 1 count/s."""
COULOMB = MOTION.value("coulomb_friction") / WORDS_PER_VOLT
"""V"""
DELAY = MOTION.value("delay")
"""s from the measured position to the reference at the drive."""
_FULL_SPEED = MOTION.value("velocity_per_output")
"""Counts/s of a velocity drive at 10 V."""
FULL_VOLTS = 10.0
_PERCENT_PER_VOLT = MOTION.value("percent_per_volt")


def reasons(*, current_reference: bool) -> dict[str, str]:
    """Return figure of the machine that is assumed -> why."""
    common = ("acceleration_per_output", "viscous_friction", "coulomb_friction", "delay")
    drive = () if current_reference else ("velocity_per_output", "velocity_bandwidth")
    return MOTION.reasons(*common, *drive)


def machine(*, current_reference: bool, velocity_per_volt: float | None) -> Machine:
    """Return the assumed machine, in counts; a velocity drive reaches ``velocity_per_volt`` counts/s for 1
    V.
    """
    if current_reference:
        return Machine(
            acceleration_per_output=ACCELERATION,
            viscous_friction=VISCOUS,
            coulomb_friction=COULOMB,
            delay=DELAY,
            output_limit=FULL_VOLTS,
            motor_count=1.0,
            position_count=1.0,
        )
    return Machine(
        # The output of a velocity drive is a speed: its torque is in % there, not in volts.
        acceleration_per_output=ACCELERATION / _PERCENT_PER_VOLT,
        viscous_friction=VISCOUS * _PERCENT_PER_VOLT,
        coulomb_friction=COULOMB * _PERCENT_PER_VOLT,
        delay=DELAY,
        output_limit=FULL_VOLTS,
        velocity_per_output=_FULL_SPEED / FULL_VOLTS if velocity_per_volt is None else velocity_per_volt,
        velocity_bandwidth=MOTION.value("velocity_bandwidth"),
        motor_count=1.0,
        position_count=1.0,
    )
