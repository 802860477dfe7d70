"""The position loop of a NUM axis from sample to sample: what the CNC does in every sampling period of P50.

Lengths are in the axis' unit u (mm or deg), times in s, the output in V. Printed, and taken as printed: the
reference in points of a 15-bit converter, KVAR x following error, 10 V for 32768 points (6-14); the filter
that averages 2j+1 references (6-26); the share of the speed reference that is added (6-26); the recursion of
the dry friction correction (6-34); the limit of the following error (6-22) and the two speeds between which
the axis must move (6-24); the share of the synchronisation error that is given back to the driven axis
(6-30). Where a figure is lost, ``law.py`` names what is assumed in its place. The function is plain Python
over arrays, so that it also runs compiled.
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

from .formulas.servo import DAC_POINTS_AT_10_V, GAIN_BAND

FULL_POINTS = float(DAC_POINTS_AT_10_V)
"""Points of the converter at its full 10 V (6-14)."""
SLOWEST, FASTEST = GAIN_BAND
"""Shares of the theoretical speed between which the axis must move (6-24)."""
MAX_TERMS = 13
"""Most references that the filter averages: E32005 takes less than 14 (6-26)."""

# Parameters
GAIN, CONSTANT, PERIOD, SHARE, TERMS, FRICTION, FRICTION_LEFT, EMAX, TOLERANCE, VOLTS = range(10)
LEADER, CORRECTION, SYNC_LIMIT, WHOLE, BACKLASH, AHEAD = 10, 11, 12, 13, 14, 15
PARAMETERS = 16

# State
REFERENCE, MEASURED, AMPLITUDE, FRICTION_NOW, SAMPLE, THEORETICAL, ADDED, STEP = range(8)
_RING = 8
STATES = _RING + MAX_TERMS

# Monitors
POINTS, THEORETICAL_SPEED, REAL_SPEED, SYNC_ERROR = range(4)

# Alarms
EXCESS_ERROR, DYNAMIC_CHECK, SYNCHRONISATION = 1.0, 2.0, 3.0


def position_sample(p: Vector, s: Vector, io: Vector) -> None:
    """Set the speed reference of one sample in V.

    p: GAIN in points per u, CONSTANT of the loop and PERIOD in s, SHARE of the speed reference 0 to 1, TERMS
    of the filter, FRICTION amplitude in u and what a sample leaves of it, EMAX in u, TOLERANCE in u per
    sample (negative: no check), VOLTS for 1 u/s; number of samples of the LEADER (0: not synchronised), whose
    measured positions in u come behind the parameters, CORRECTION 0 to 1, SYNC_LIMIT in u;
    WHOLE: 0 for a converter without steps (the linear model); BACKLASH: u added on positive moves; AHEAD:
    acceleration anticipation in samples.
    """
    if io[MODE] == VELOCITY_LOOP or io[MODE] == OUTPUT_TEST:
        volts = io[COMMAND] if io[MODE] == OUTPUT_TEST else p[VOLTS] * io[COMMAND_VELOCITY]
        points = volts * FULL_POINTS / 10.0
        if p[WHOLE] != 0.0:
            points = 1.0 * math.floor(points + 0.5)
        io[OUTPUT] = 10.0 * min(max(points, -FULL_POINTS), FULL_POINTS) / FULL_POINTS
        return
    # The filter averages the last references; it delays the command by half of its length.
    terms = int(p[TERMS])
    total = io[COMMAND]
    for place in range(terms - 1, 0, -1):
        s[_RING + place] = s[_RING + place - 1]
        total += s[_RING + place]
    s[_RING] = io[COMMAND]
    reference = total / terms
    # The speed reference and the direction of friction are taken behind the filter, as the loop sees
    # them.
    step = reference - s[REFERENCE]
    moved = io[POSITION] - s[MEASURED]

    apart = 0.0
    # The motion of the leader may end first: then nothing is corrected any more.
    if p[LEADER] > 0.0 and s[SAMPLE] < p[LEADER]:
        apart = p[PARAMETERS + int(s[SAMPLE])] - io[POSITION]
        s[SAMPLE] += 1.0

    amplitude = s[AMPLITUDE]
    if step > 0.0:
        amplitude = p[FRICTION]
        s[ADDED] = p[BACKLASH]
    elif step < 0.0:
        amplitude = -p[FRICTION]
        s[ADDED] = 0.0
    # Only a change of direction feeds the recursion (6-34); what it added dies away by FRICTION_LEFT.
    s[FRICTION_NOW] = amplitude - s[AMPLITUDE] + s[FRICTION_NOW] * p[FRICTION_LEFT]

    error = reference + s[ADDED] - io[POSITION]
    ahead = p[SHARE] * step + p[AHEAD] * (step - s[STEP])
    wanted = error + p[CONSTANT] / p[PERIOD] * ahead
    points = p[GAIN] * (wanted + p[CORRECTION] * apart + s[FRICTION_NOW])
    if p[WHOLE] != 0.0:
        points = 1.0 * math.floor(points + 0.5)
    points = min(max(points, -FULL_POINTS), FULL_POINTS)

    theoretical = s[THEORETICAL]
    # The speed that the loop asked for in the last sample: the axis can only have answered that one.
    slowest, fastest = SLOWEST * theoretical, FASTEST * theoretical
    # In the negative direction the greater share is the lower bound.
    if theoretical < 0.0:
        slowest, fastest = fastest, slowest
    io[OUTPUT] = 10.0 * points / FULL_POINTS
    # What filter and compensation put between command and reference is no error of the axis.
    io[REFERENCE_LAG] = io[COMMAND] - reference - s[ADDED]
    if abs(error) > p[EMAX]:
        io[STOP] = EXCESS_ERROR
    elif p[TOLERANCE] >= 0.0 and not (slowest - p[TOLERANCE] <= moved <= fastest + p[TOLERANCE]):
        io[STOP] = DYNAMIC_CHECK
    elif abs(apart) > p[SYNC_LIMIT]:
        io[STOP] = SYNCHRONISATION
    io[MONITOR + POINTS] = points
    io[MONITOR + THEORETICAL_SPEED] = theoretical / p[PERIOD]
    io[MONITOR + REAL_SPEED] = moved / p[PERIOD]
    io[MONITOR + SYNC_ERROR] = apart
    s[REFERENCE], s[STEP] = reference, step
    s[MEASURED] = io[POSITION]
    s[AMPLITUDE] = amplitude
    # A loop with the time CONSTANT removes PERIOD / CONSTANT of its error in a sample.
    s[THEORETICAL] = wanted * p[PERIOD] / p[CONSTANT]
