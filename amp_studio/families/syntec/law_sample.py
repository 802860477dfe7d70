"""The pulse loop of a Syntec axis: what servo card and drive do in one sample of the drive.

Lengths are in the axis' unit u (mm or deg), times in s, the output is a velocity in u/min. Printed, and taken
as printed: in every interpolation time the control sends whole pulses, at most 2047, evenly spread (1.4.1),
and more are MOT-05 (1.5.1); the following error of a steady speed is speed / loop gain (1.5.3); it is an
alarm beyond two times (MOT-019,
1.5.3) and four times (MOT-023, 1.5.4) that of the greater of rapid and first homing speed. What is assumed in
the place of what is not printed is named in ``law.py``. The functions are plain Python over arrays,
so that they also run compiled.
"""

from __future__ import annotations

import math

from amp_studio.sim import (
    COMMAND,
    COMMAND_VELOCITY,
    MODE,
    MONITOR,
    OUTPUT,
    OUTPUT_TEST,
    POSITION,
    REFERENCE_LAG,
    STOP,
    VELOCITY_LOOP,
    Vector,
)

PARTS = 8
"""Samples of the drive in one interpolation time; an assumption."""

# Parameters: u, 1/s, pulses, u, u, 0 for pulses without steps (the linear model)
PULSE, GAIN, MAX_PULSES, LIMIT, FATAL_LIMIT, WHOLE = range(6)
PARAMETERS = 6

# State: pulses sent up to this interpolation time and up to its end, samples since it began; then the last
# references
FROM, TO, PART = range(3)
_RING = 3
STATES = _RING + PARTS

# Monitors
PULSES = 0

# Alarms
DDA_OVERFLOW, EXCESS_ERROR, FATAL_ERROR = 1.0, 2.0, 3.0


def position_sample(p: Vector, s: Vector, io: Vector) -> None:
    """Close the position loop over the pulses that have left the card by now.

    p: length of a PULSE in u, GAIN in 1/s, MAX_PULSES in one interpolation time, LIMIT and FATAL_LIMIT of
    the following error in u, WHOLE.
    """
    if io[MODE] == VELOCITY_LOOP:
        io[OUTPUT] = 60.0 * io[COMMAND_VELOCITY]
        return
    if io[MODE] == OUTPUT_TEST:
        io[OUTPUT] = io[COMMAND]
        return
    position, gain = io[POSITION], 60.0 * p[GAIN]
    reference = sent(p, s, io) if p[WHOLE] != 0.0 else late(s, io[COMMAND])
    io[REFERENCE_LAG] = io[COMMAND] - reference
    error = reference - position
    # An overflow of this sample is the cause, and the error only what comes of it.
    if io[STOP] == 0.0 and abs(error) > p[LIMIT]:
        io[STOP] = EXCESS_ERROR if abs(error) <= p[FATAL_LIMIT] else FATAL_ERROR
    io[OUTPUT] = gain * error


def sent(p: Vector, s: Vector, io: Vector) -> float:
    """Return the position in u of the pulses that have left the card;
    begin an interpolation time where one is due.
    """
    if s[PART] == 0.0:
        s[FROM] = s[TO]
        s[TO] = 1.0 * math.floor(io[COMMAND] / p[PULSE] + 0.5)
        io[MONITOR + PULSES] = s[TO] - s[FROM]
        if abs(s[TO] - s[FROM]) > p[MAX_PULSES]:
            io[STOP] = DDA_OVERFLOW
    # Evenly spread, and whole: int cuts towards the start, so that no pulse leaves before its time.
    pulses = s[FROM] + 1.0 * int((s[TO] - s[FROM]) * s[PART] / PARTS)
    s[PART] += 1.0
    if s[PART] == PARTS:
        s[PART] = 0.0
    return pulses * p[PULSE]


def late(s: Vector, command: float) -> float:
    """Return the command one interpolation time ago: what evenly spread pulses are without their steps."""
    oldest = s[_RING + PARTS - 1]
    for place in range(PARTS - 1, 0, -1):
        s[_RING + place] = s[_RING + place - 1]
    s[_RING] = command
    return oldest
