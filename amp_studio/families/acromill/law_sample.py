"""The servo loop of an ACR controller, one servo period at a time: PID in volts, feed-forward, filters, torque limit.

Printed in the User's Guide: units of the gains page 59 and appendix C, page 113; order of PID, filters and torque limit
page 128; FBVEL, taken off where the PID goes into the filters, page 135. The picture of the servo loop (page 95) is
lost. What is not printed and assumed: both feed-forwards are added where FBVEL is taken off; the integral keeps its value during I Delay; the derivative is constant
between its samples; the output is rounded to whole words of the converter.

``position_sample`` is ordinary Python over arrays of floats that numba can compile; it calls no other function.
"""

from __future__ import annotations

import math

from amp_studio.sim.arrays import Vector
from amp_studio.sim.signals import (
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
"""V, s since the command rests, V, periods to the next derivative, pulses, pulses, commanded travel in pulses."""
FILTER_STATE = 7
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
    motor = io[MOTOR] * p[PULSES]
    if io[MODE] == VELOCITY_LOOP:  # D Gain alone controls the speed, as in steps 8 and 9 of page 115
        s[RUN] += velocity * p[PERIOD]
        error, closed = s[RUN] - io[POSITION] * p[PULSES], 0.0
    else:
        error, closed = (io[COMMAND] - io[POSITION]) * p[PULSES], 1.0

    s[RESTING] = s[RESTING] + p[PERIOD] if velocity == 0.0 and acceleration == 0.0 else 0.0
    if p[I_DELAY] == 0.0 or s[RESTING] > p[I_DELAY]:
        wanted = s[INTEGRAL] + closed * p[I_GAIN] * error * p[PERIOD]
        s[INTEGRAL] = min(max(wanted, -p[I_LIMIT]), p[I_LIMIT])
    s[SAMPLE_IN] -= 1.0
    if s[SAMPLE_IN] <= 0.0:
        s[DERIVATIVE] = p[D_GAIN] * (error - s[ERROR_SAMPLED]) / (p[D_PERIODS] * p[PERIOD])
        s[ERROR_SAMPLED], s[SAMPLE_IN] = error, p[D_PERIODS]
    proportional = closed * p[P_GAIN] * error
    forward = p[VEL_FFWD] * velocity + p[ACC_FFWD] * acceleration
    volts = proportional + s[INTEGRAL] + s[DERIVATIVE] + forward
    volts -= p[FBVEL] * (motor - s[MOTOR_BEFORE]) / p[PERIOD]
    s[MOTOR_BEFORE] = motor

    for k in range(2):
        f, m = FILTERS + 5 * k, FILTER_STATE + 2 * k
        passed = p[f] * volts + s[m]
        s[m] = p[f + 1] * volts + p[f + 3] * passed + s[m + 1]
        s[m + 1] = p[f + 2] * volts + p[f + 4] * passed
        volts = passed

    volts = min(max(volts, -p[TORQUE_LIMIT]), p[TORQUE_LIMIT])
    volts = min(max(volts * p[DAC_SHARE], -FULL_VOLTS), FULL_VOLTS)
    if p[DAC_WORDS] > 0.0:
        volts = math.floor(volts * p[DAC_WORDS] + 0.5) / p[DAC_WORDS]
    io[OUTPUT] = volts
    io[MONITOR], io[MONITOR + 1] = proportional, s[INTEGRAL]
    io[MONITOR + 2], io[MONITOR + 3] = s[DERIVATIVE], forward
    if p[EXCESS] > 0.0 and closed * abs(error) > p[EXCESS]:
        io[STOP] = EXCESS_ERROR
