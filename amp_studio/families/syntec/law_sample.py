"""The pulse loop of a Syntec axis: what servo card and drive do in one interpolation time and between.

Lengths are in the axis' unit u (mm or deg), times in s, the output is a velocity in u/min. Printed, and taken as printed:
in every interpolation time the control sends whole pulses, at most 2047, evenly spread (1.4.1), and more are MOT-05
(1.5.1); the following error of a steady speed is speed / loop gain (1.5.3); it is an alarm beyond two times (MOT-019,
1.5.3) and four times (MOT-023, 1.5.4) that of the greater of rapid and first homing speed. What is assumed in the place
of what is not printed is named in ``law.py``. Both functions are plain Python over arrays, so that they also run compiled.
"""

from __future__ import annotations

import math

from amp_studio.sim.arrays import Vector
from amp_studio.sim.signals import (
    COMMAND,
    COMMAND_VELOCITY,
    MODE,
    MONITOR,
    MOTOR,
    OUTPUT,
    OUTPUT_TEST,
    POSITION,
    POSITION_LOOP,
    REFERENCE_LAG,
    STOP,
    VELOCITY_LOOP,
)

# Parameters: u, 1/s, pulses, u, u, samples of the drive in one interpolation time, 1 where the scale closes the loop,
# 0 for pulses without steps (the linear model)
PULSE, GAIN, MOST_PULSES, LIMIT, FATAL_LIMIT, PARTS, BY_SCALE, WHOLE = range(8)
PARAMETERS = 8

# State: pulses sent up to this interpolation time and up to its end, drive samples since it began
FROM, TO, PART = range(3)
STATES = 3

# Monitors
PULSES = 0

# Alarms
DDA_OVERFLOW, EXCESS_ERROR, FATAL_ERROR = 1.0, 2.0, 3.0


def position_sample(p: Vector, s: Vector, io: Vector) -> None:
    """Begin one interpolation time: the pulses that it sends, and the following error of the control.

    p: length of a PULSE in u, GAIN in 1/s, MOST_PULSES in one interpolation time, LIMIT and FATAL_LIMIT of the
    following error in u, PARTS of the interpolation time in which the drive samples, BY_SCALE, WHOLE.
    """
    if io[MODE] == VELOCITY_LOOP:
        io[OUTPUT] = 60.0 * io[COMMAND_VELOCITY]
        return
    if io[MODE] == OUTPUT_TEST:
        io[OUTPUT] = io[COMMAND]
        return
    target = io[COMMAND] / p[PULSE]
    if p[WHOLE] != 0.0:
        target = 1.0 * math.floor(target + 0.5)
    s[FROM] = s[TO]
    s[TO] = target
    s[PART] = 0.0
    pulses = target - s[FROM]
    error = s[FROM] * p[PULSE] - io[POSITION]
    if abs(pulses) > p[MOST_PULSES]:
        io[STOP] = DDA_OVERFLOW
    elif abs(error) > p[FATAL_LIMIT]:
        io[STOP] = FATAL_ERROR
    elif abs(error) > p[LIMIT]:
        io[STOP] = EXCESS_ERROR
    io[REFERENCE_LAG] = io[COMMAND] - s[FROM] * p[PULSE]
    io[MONITOR + PULSES] = pulses


def velocity_sample(p: Vector, s: Vector, io: Vector) -> None:
    """Close the position loop over the pulses that have left the card by now."""
    if io[MODE] != POSITION_LOOP:
        return
    share = min(s[PART] / p[PARTS], 1.0)
    s[PART] += 1.0
    pulses = (s[TO] - s[FROM]) * share
    if p[WHOLE] != 0.0:
        pulses = 1.0 * int(pulses)
    pulses += s[FROM]
    measured = io[POSITION] if p[BY_SCALE] != 0.0 else io[MOTOR]
    io[OUTPUT] = 60.0 * p[GAIN] * (pulses * p[PULSE] - measured)
