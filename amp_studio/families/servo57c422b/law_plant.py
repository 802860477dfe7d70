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

from .law_sample import SCAN, WORDS_PER_VOLT

ACCELERATION = 400_000.0
"""Counts/s² for 1 V of a current reference: 1000 turns/s² of 4000 counts at 10 V."""
VISCOUS = 1.15 * SCAN / WORDS_PER_VOLT
"""V for 1 count/s: the mean of both programs."""
COULOMB = 27.5 / WORDS_PER_VOLT
"""V: the deadband compensation of both programs."""
DELAY = 0.0002
"""s from the measured position to the reference at the drive."""
FULL_SPEED = 1_000_000.0
"""Counts/s of a velocity drive at 10 V: the most that the encoder inputs take with *4 quadrature (page
A-1)."""
DRIVE_BANDWIDTH = 50.0
"""Hz: the velocity loop of such a drive."""
FULL_VOLTS = 10.0
PERCENT_PER_VOLT = 10.0
"""% of the torque of a velocity drive that is as much as 1 V of a current reference."""

_NO_MOTOR = "The module knows no motor."
CURRENT = {
    "acceleration_per_output": f"{_NO_MOTOR} 1000 turns/s2 of 4000 counts at 10 V.",
    "viscous_friction": (
        f"{_NO_MOTOR} What the feed-forward of both printed programs has above 8192 (pages 4-48, 5-5)."
    ),
    "coulomb_friction": f"{_NO_MOTOR} The deadband compensation of both printed programs (pages 4-48, 5-5).",
    "delay": "How long the module computes in its scan is not printed.",
}
VELOCITY = {
    **CURRENT,
    "velocity_per_output": (
        "Full speed of the drive at 10 V is not in the registers: 1000000 counts/s, the most that the encoder"
        " inputs take (page A-1). Set model.velocity_per_output in counts/s for 1 V."
    ),
    "velocity_bandwidth": "The drive closes the velocity loop with separate settings (page 4-4).",
}
"""Figures of the machine that are assumed -> why."""


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
        acceleration_per_output=ACCELERATION / PERCENT_PER_VOLT,
        viscous_friction=VISCOUS * PERCENT_PER_VOLT,
        coulomb_friction=COULOMB * PERCENT_PER_VOLT,
        delay=DELAY,
        output_limit=FULL_VOLTS,
        velocity_per_output=FULL_SPEED / FULL_VOLTS if velocity_per_volt is None else velocity_per_volt,
        velocity_bandwidth=DRIVE_BANDWIDTH,
        motor_count=1.0,
        position_count=1.0,
    )
