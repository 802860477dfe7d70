"""The test motor of appendix C, identified from the figures that its story prints (User's Guide,
from page 115 on).

A bare motor in torque mode turns at 500 turns a minute with 4096 pulses a turn and a servo period of 400 µs.
Four printed figures give four of the plant, all in pulses and volts:

    ACC FFwd 0.000000199 leaves no spike in the ramps             -> pulses/s² for 1 V are its reciprocal
    Vel FFwd 0.0000015 leaves no error that grows with the speed  -> viscous friction, V for 1 pulse/s
    about 100 pulses of error at speed with P Gain 0.001          -> 0.1 V of friction in all; what is not
    viscous is dry P Gain 0.08 is good, "raising it further" unstable            -> the delay
    from a sample to the torque

The remaining dry friction of 0.049 V keeps an error of 1 pulse at P Gain 0.05, which is what the story reads
at rest: a figure that was not used. "Further" is taken as the same step once more, 0.08 + 0.03 = 0.11: the
delay puts the limit of stability between both, at 0.097 with D Gain 0.00021. Every delay from 0.6 to 0.68 ms
gives the same story: a shorter one is stable at 0.11, a longer one already at P Gain 0.05 and D Gain 0.00005
not. The traces themselves are lost.
"""

from __future__ import annotations

from .law_facts import MOTION

PULSES_PER_TURN = MOTION.value("pulses_per_turn")
SERVO_PERIOD = MOTION.value("servo_period")
"""s"""
SPEED = MOTION.value("speed") / 60.0 * PULSES_PER_TURN
"""Pulses/s."""
ACCELERATION = 1.0 / MOTION.value("acc_ffwd")
"""Pulses/s² for 1 V."""
VISCOUS = MOTION.value("vel_ffwd")
"""V for 1 pulse/s."""
COULOMB = MOTION.value("p_gain_at_speed") * MOTION.value("error_at_speed") - VISCOUS * SPEED
"""V."""
DELAY = MOTION.value("delay")
"""s: 1.6 servo periods."""
REASONS = MOTION.reasons(
    acceleration_per_output="acc_ffwd",
    viscous_friction="vel_ffwd",
    coulomb_friction="error_at_speed",
    delay="delay",
)
"""Figure of the machine -> why it has its value."""
