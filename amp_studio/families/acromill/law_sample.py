"""The servo loop of an ACR controller, one servo period at a time: PID in volts, feed-forward, filters,
torque limit.

Printed in the User's Guide: units of the gains page 59 and appendix C, page 113; order of PID, filters and
torque limit page 128; FBVEL, taken off where the PID goes into the filters, page 135. The picture of the
servo loop (page 95) is lost. What is not printed and assumed: both feed-forwards are added where FBVEL is
taken off; the integral keeps its value during I Delay; the derivative is constant between its samples; the
output is rounded to whole words of the converter.

``position_sample`` is ordinary Python over arrays of floats that numba can compile. It reads first and puts
the output out last, and what divides does not depend on the motion: the time of a sample is that of the
longest chain of operations in it.
"""

from __future__ import annotations

import math

from amp_studio.sim import (
    COMMAND,
    COMMAND_ACCELERATION,
    COMMAND_VELOCITY,
    MODE,
    MONITOR,
    MOTOR,
    OUTPUT,
    OUTPUT_TEST,
    POSITION,
    STOP,
    VELOCITY_LOOP,
    Vector,
    nearest,
)

# Parameters. V, s, pulses.
PULSES, PERIOD = 0, 1
"""Pulses for 1 u; s."""
P_GAIN, I_GAIN, D_GAIN = 2, 3, 4
"""V/pulse, V/s/pulse, V/(pulse/s)."""
I_DELAY, I_LIMIT, D_PERIODS = 5, 6, 7
"""s, V, servo periods between two samples of the derivative (at least 1)."""
VEL_FFWD, ACC_FFWD, FBVEL = 8, 9, 10
"""V/(pulse/s), V/(pulse/s²), V/(pulse/s)."""
TORQUE_LIMIT, DAC_SHARE, DAC_WORDS, EXCESS = 11, 12, 13, 14
"""V; volts put out for 1 V; words of the converter for 1 V, 0 for an ideal one; pulses, 0 for no limit."""
FILTERS = 15
"""The first of a0, a1, a2, b1, b2 of the first filter; those of the second follow."""
PARAMETERS = 25

# State.
INTEGRAL, RESTING, DERIVATIVE, SAMPLE_IN, ERROR_SAMPLED, MOTOR_BEFORE, RUN = 0, 1, 2, 3, 4, 5, 6
"""V, s since the command rests, V, periods to the next derivative, pulses, pulses,
commanded travel in pulses."""
_FILTER_STATE = 7
STATE = 11

FULL_VOLTS = 10.0
"""V: the converter's range to either side (pages 77 and 128)."""

EXCESS_ERROR = 1.0
"""STOP: the bit for "not excess error" goes off (page 114)."""

MONITORS = (("proportional", "V"), ("integral", "V"), ("derivative", "V"), ("feed_forward", "V"))


def position_sample(p: Vector, s: Vector, io: Vector) -> None:
    """One servo period: from command and measured position to volts."""
    if io[MODE] == OUTPUT_TEST:
        io[OUTPUT] = min(max(io[COMMAND], -p[TORQUE_LIMIT]), p[TORQUE_LIMIT])
        return
    velocity, acceleration = io[COMMAND_VELOCITY] * p[PULSES], io[COMMAND_ACCELERATION] * p[PULSES]
    position, motor = io[POSITION] * p[PULSES], io[MOTOR] * p[PULSES]
    if io[MODE] == VELOCITY_LOOP:  # D Gain alone controls the speed, as in steps 8 and 9 of page 115
        s[RUN] += velocity * p[PERIOD]
        error, closed = s[RUN] - position, 0.0
    else:
        error, closed = io[COMMAND] * p[PULSES] - position, 1.0

    resting = s[RESTING] + p[PERIOD] if velocity == 0.0 and acceleration == 0.0 else 0.0
    integral, derivative = s[INTEGRAL], s[DERIVATIVE]
    # In pulses per period: divided by the period where it is used, once.
    speed = motor - s[MOTOR_BEFORE]
    s[RESTING], s[MOTOR_BEFORE] = resting, motor
    # I Delay counts from where the command rests; 0 integrates always.
    if p[I_DELAY] == 0.0 or resting > p[I_DELAY]:
        integral += closed * p[I_GAIN] * p[PERIOD] * error
        if abs(integral) > p[I_LIMIT]:
            integral = math.copysign(p[I_LIMIT], integral)
        s[INTEGRAL] = integral
    # The derivative is taken over several periods, because one count in a single one is a whole step of
    # speed.
    wait = s[SAMPLE_IN] - 1.0
    if wait <= 0.0:
        derivative = p[D_GAIN] / (p[D_PERIODS] * p[PERIOD]) * (error - s[ERROR_SAMPLED])
        s[DERIVATIVE], s[ERROR_SAMPLED], wait = derivative, error, p[D_PERIODS]
    s[SAMPLE_IN] = wait
    proportional = closed * p[P_GAIN] * error
    forward = p[VEL_FFWD] * velocity + p[ACC_FFWD] * acceleration
    volts = forward + integral + proportional + derivative - p[FBVEL] / p[PERIOD] * speed
    io[MONITOR], io[MONITOR + 1] = proportional, integral
    io[MONITOR + 2], io[MONITOR + 3] = derivative, forward
    if p[EXCESS] > 0.0 and closed * abs(error) > p[EXCESS]:
        io[STOP] = EXCESS_ERROR

    # Two sections in the transposed direct form: two states each, whatever the coefficients are.
    for k in range(2):
        f, m = FILTERS + 5 * k, _FILTER_STATE + 2 * k
        passed = p[f] * volts + s[m]
        s[m] = p[f + 1] * volts + p[f + 3] * passed + s[m + 1]
        s[m + 1] = p[f + 2] * volts + p[f + 4] * passed
        volts = passed

    if abs(volts) > p[TORQUE_LIMIT]:
        volts = math.copysign(p[TORQUE_LIMIT], volts)
    # DAC GAIN comes behind the torque limit, so that the converter may still clip.
    volts *= p[DAC_SHARE]
    if abs(volts) > FULL_VOLTS:
        volts = math.copysign(FULL_VOLTS, volts)
    if p[DAC_WORDS] > 0.0:
        volts = nearest(volts * p[DAC_WORDS]) * (1.0 / p[DAC_WORDS])
    io[OUTPUT] = volts
