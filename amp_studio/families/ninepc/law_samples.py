"""The 9/PC's loops as sample functions over flat arrays: position loop, velocity loop, analog output.

Pages are those of the 9/PC AMP manual. Where it is silent the choice is documented here and in the
assumptions of every result (`law_notes.py`). Lengths are in the unit u of the axis (mm or deg), times in s,
torque in % of rated torque. The functions run as plain Python and as machine code: flat arrays,
indices below.
"""

from __future__ import annotations

import math

from amp_studio.sim import (
    COMMAND,
    COMMAND_VELOCITY,
    FEED_SHARE,
    MODE,
    MONITOR,
    MOTOR,
    OUTPUT,
    OUTPUT_TEST,
    POSITION,
    POSITION_LOOP,
    REFERENCE_LAG,
    STOP,
    Vector,
)

# -- parameters ------------------------------------------------------------------------------------
GAIN, BREAK_POINT, BREAK_RATIO, FEED_FORWARD, OPEN = 0, 1, 2, 3, 4
"""1/s; u; share; share of the command velocity; 1 for an open position loop."""
EXCESS, SUPPRESSION = 5, 6
"""u: Excess Error and Feedrate Suppression Point."""
REVERSAL, FIRST = 7, 8
"""u, without sign; the direction (1 or -1) that the control takes the axis to have come from."""
COUNT, THRESHOLD, STICTION, FRICTION_POSITIVE, FRICTION_NEGATIVE = 9, 10, 11, 12, 13
"""u for one count of the position device; counts; %; %; %."""
PROPORTIONAL, INTEGRAL, DISCHARGE = 14, 15, 16
"""% for 1 u/s of velocity error; % for 1 u/s of the sum of velocity errors; a multiple."""
LIMIT_POSITIVE, LIMIT_NEGATIVE = 17, 18
"""% in the positive and in the negative direction of travel."""
OFFSET, FILTER = 19, 20
"""% with its sign; share of a change that passes the torque filter in one sample (1: off)."""
PERIOD = 21
"""s between two velocity samples."""
VOLTS_POSITIVE, VOLTS_NEGATIVE, VOLTS_LIMIT = 22, 23, 24
"""V for 1 u/s in each direction; V."""
DESKEW, SKEW_LIMIT, MASTER_SAMPLES = 25, 26, 27
"""1/u: change of the slave's gain by the skew; u; number of following errors of the master, from MASTER
on."""
CUTTING, TORQUE_UNIT = 28, 29
"""Not used by the loops: u/s of Maximum Cutting Feedrate; PROPORTIONAL for a gain of 1."""
CHANNELS, DAC, DAC_FIGURES = 30, 31, 3
"""Number of DAC monitors shown; from DAC on for each: number of the monitor it shows, V for 1 of its unit,
V at full scale."""
MASTER = 37
SIZE = 37

# -- state -----------------------------------------------------------------------------------------
CAME_FROM, SHIFT = 0, 1
"""Direction of the last motion commanded (0 at the start);
u that reversal error compensation adds to the command."""
VELOCITY_COMMAND, FRICTION, ABOVE = 2, 3, 4
"""u/s; %; 1 while the following error is at or above the threshold for friction compensation."""
LAST_MOTOR, ERROR_SUM, FILTERED, SAMPLE = 5, 6, 7, 8
"""u; u/s; %; number of servo samples so far."""
STATE_SIZE = 9

_ALMOST = 1.0 - 1e-9
"""Whole counts times the length of a count are that many counts, whatever the last bit is."""

# -- alarms and monitors ---------------------------------------------------------------------------
EXCESS_ERROR_ALARM, EXCESS_SKEW_ALARM = 1.0, 2.0
MONITORS = (
    ("velocity_command", "u/s"),
    ("velocity_error", "u/s"),
    ("integral_torque", "%"),
    ("control_following_error", "u"),
    ("skew", "u"),
    ("feed_share", ""),
    ("velocity_feedback", "u/s"),
)
FINAL_VELOCITY, VELOCITY_ERROR, INTEGRAL_TORQUE, FOLLOWING_ERROR, VELOCITY_FEEDBACK = 0, 1, 2, 3, 6
COMMAND_SPEED = COMMAND_VELOCITY - MONITOR
"""Places from MONITOR on of what a DAC monitor can show; the velocity of the command comes before it."""
DAC_MONITOR = 7
"""The DAC monitors come after those."""


def position_sample(p: Vector, s: Vector, io: Vector) -> None:
    """Close the position loop of a digital servo and set its friction compensation, once a servo period.

    Friction compensation (7-84 to 7-89): nothing below the threshold of following error, the friction of the
    direction from it on, and stiction on top in the one sample that reaches it. The direction is that of the
    motion commanded, at rest that of the following error.
    """
    position_loop(p, s, io)
    error, velocity = io[MONITOR + 3], io[COMMAND_VELOCITY]
    # At rest friction still has to be overcome, in the direction in which the axis is late.
    direction = velocity if velocity != 0.0 else error
    reached = direction != 0.0 and abs(error) >= p[THRESHOLD] * p[COUNT] * _ALMOST
    above = 1.0 if reached else 0.0
    size = p[FRICTION_POSITIVE] if direction > 0.0 else p[FRICTION_NEGATIVE]
    if above > s[ABOVE]:
        size += p[STICTION]
    s[ABOVE] = above
    s[FRICTION] = above * math.copysign(size, direction)


def analog_sample(p: Vector, s: Vector, io: Vector) -> None:
    """Close the position loop of an analog servo:
    its output is a voltage in proportion to the velocity (7-41, 7-43).
    """
    if io[MODE] == OUTPUT_TEST:
        volts = io[COMMAND]
    else:
        position_loop(p, s, io)
        velocity = s[VELOCITY_COMMAND]
        volts = velocity * (p[VOLTS_POSITIVE] if velocity > 0.0 else p[VOLTS_NEGATIVE])
    io[OUTPUT] = min(max(volts, -p[VOLTS_LIMIT]), p[VOLTS_LIMIT])
    dac_monitors(p, io)


def position_loop(p: Vector, s: Vector, io: Vector) -> None:
    """Set the velocity command; checks the limits of the following error (7-20, 7-21).

    Closed loop: in proportion to the following error (7-14, 7-25); the part beyond the gain break point
    counts only gain break ratio times (7-22, 7-27). ZFE: a share of the command velocity is added (7-15,
    7-28). Open loop: the command velocity itself (7-13); nothing is checked.
    """
    closed = io[MODE] == POSITION_LOOP and p[OPEN] == 0.0
    if closed and p[REVERSAL] != 0.0:
        reversal_error(p, s, io[COMMAND_VELOCITY])
    # The axis is meant to be off by the compensation: it is no following error of the load.
    io[REFERENCE_LAG] = -s[SHIFT]
    error = io[COMMAND] + s[SHIFT] - io[POSITION]
    size = abs(error)
    if closed and size > p[EXCESS]:
        io[STOP] = EXCESS_ERROR_ALARM
    io[FEED_SHARE] = 0.5 if closed and size > p[SUPPRESSION] else 1.0
    gain = p[GAIN]
    if p[MASTER_SAMPLES] > 0.0:
        gain *= slave_gain(p, s, io, error)
    if size > p[BREAK_POINT]:
        # The curve is bent, not broken: up to the break the full gain stays, only the part beyond is
        # reduced.
        size = p[BREAK_POINT] + p[BREAK_RATIO] * (size - p[BREAK_POINT])
    velocity = math.copysign(gain * size, error) + p[FEED_FORWARD] * io[COMMAND_VELOCITY]
    if not closed:
        velocity, error = io[COMMAND_VELOCITY], 0.0
    s[VELOCITY_COMMAND] = velocity
    io[MONITOR], io[MONITOR + 3], io[MONITOR + 5] = velocity, error, io[FEED_SHARE]


def reversal_error(p: Vector, s: Vector, velocity: float) -> None:
    """Add Reversal Error Compensation at the beginning of a motion in the other direction (7-18).

    A negative value is added to the first motion in the positive direction,
    a positive one to the first in the negative direction.
    """
    if velocity == 0.0:
        return
    direction = 1.0 if velocity > 0.0 else -1.0
    # Before the first motion the sign of the parameter decides which side the play is taken up on (7-18).
    before = s[CAME_FROM] if s[CAME_FROM] != 0.0 else p[FIRST]
    if direction != before:
        s[SHIFT] += direction * p[REVERSAL]
    s[CAME_FROM] = direction


def slave_gain(p: Vector, s: Vector, io: Vector, error: float) -> float:
    """Return the factor of the gain of the slave of a split axis (32-9); checks the skew (32-10).

    The factor is 1 + Deskew Gain x skew, the skew counted positive where the slave is further behind: the
    manual prints that the gain changes in proportion to the skew, and no unit.
    """
    samples, k = int(p[MASTER_SAMPLES]), int(s[SAMPLE])
    s[SAMPLE] += 1.0
    # The motion of the master may end first: it rests then, with its last error.
    master = p[MASTER + min(k, samples - 1)]
    skew = error - master
    io[MONITOR + 4] = skew
    if abs(skew) > p[SKEW_LIMIT]:
        io[STOP] = EXCESS_SKEW_ALARM
    # Never negative: a gain that changes its sign would drive the slave away.
    return max(0.0, 1.0 + p[DESKEW] * (skew if error > 0.0 else -skew))


def velocity_sample(p: Vector, s: Vector, io: Vector) -> None:
    """Close the velocity loop of a digital servo, once a velocity period (7-54 to 7-69).

    Velocity error times Velocity Proportional Gain and the sum of velocity errors times Velocity Integral
    Gain are added (7-54, 7-56); torque offset (7-63) and friction compensation come on top, then the torque
    filter (7-69) and the limit of the direction of travel (7-61, 7-62).
    """
    velocity = (io[MOTOR] - s[LAST_MOTOR]) / p[PERIOD]
    s[LAST_MOTOR] = io[MOTOR]
    # The limit of the direction of travel, in which it accelerates and brakes; at rest the commanded one
    # (7-61, 7-62).
    direction = velocity if velocity != 0.0 else s[VELOCITY_COMMAND]
    limit = p[LIMIT_POSITIVE] if direction >= 0.0 else p[LIMIT_NEGATIVE]
    if io[MODE] == OUTPUT_TEST:
        io[OUTPUT] = min(max(io[COMMAND], -limit), limit)
        return
    error = s[VELOCITY_COMMAND] - velocity
    total = summed(s[ERROR_SUM], error, p[DISCHARGE])
    proportional, added = p[PROPORTIONAL] * error, p[OFFSET] + s[FRICTION]
    wanted = proportional + p[INTEGRAL] * total + added
    # At the limit the sum is not added to, or it would have to be taken down again by an overshoot.
    if abs(wanted) <= limit or wanted * error < 0.0:
        s[ERROR_SUM] = total
    # The filter is before the limit: what the motor gets is never beyond it.
    s[FILTERED] += p[FILTER] * (proportional + p[INTEGRAL] * s[ERROR_SUM] + added - s[FILTERED])
    io[OUTPUT] = min(max(s[FILTERED], -limit), limit)
    io[MONITOR + 1], io[MONITOR + 2], io[MONITOR + 6] = error, p[INTEGRAL] * s[ERROR_SUM], velocity
    dac_monitors(p, io)


def dac_monitors(p: Vector, io: Vector) -> None:
    """Show signals as voltages within their full scale (A-5 to A-7)."""
    for n in range(int(p[CHANNELS])):
        first = DAC + DAC_FIGURES * n
        volts = p[first + 1] * io[MONITOR + int(p[first])]
        io[MONITOR + DAC_MONITOR + n] = min(max(volts, -p[first + 2]), p[first + 2])


def summed(total: float, error: float, discharge: float) -> float:
    """Return the sum of velocity errors with one more:
    what takes it down counts VE Integrator Discharge Rate times (7-58).
    """
    if total * error >= 0.0:
        return total + error
    after = total + discharge * error
    # Past zero it builds up in the other direction, where errors count once again.
    return after if after * total >= 0.0 else after / discharge
