"""What is assumed about a 9/PC axis, and where its figures do not fit the manual: sentences of every
result.
"""

from __future__ import annotations

import math

from amp_studio.sim import value_text

from .law_units import SEPARATE, UNUSUAL_FRAMES, gain_for_rate, highest_rate, loop_rate

TUNING_START = 1500.0
"""Velocity Proportional Gain at the start of appendix A (Table A.A, A-8)."""

CLOSED = (
    "The velocity command is proportional to the following error (7-14, 7-25); the part beyond the gain break"
    " point counts only gain break ratio times (7-22, 7-27), without a step (the figure of 7-23 was not"
    " legible)."
)
ZFE = (
    "Feed Forward Percent of the command velocity is added to the velocity command (7-15, 7-28); the gain"
    " break is not used (7-22, 7-27)."
)
OPEN = (
    "The position loop is open (7-13): the command velocity is the velocity command, and no following error"
    " is checked."
)
SAMPLED = (
    "The position loop runs at the SERCOS cycle, the servo update rate (7-4); excess error and feedrate"
    " suppression are checked there (7-20, 7-21)."
)
RAMPS = (
    "A linear ramp of 0 means no ramp (10-8), a deceleration of 0 the acceleration (10-10). While the"
    " feedrate is suppressed the command goes to half and back by the same ramp (7-21 does not say how)."
)
GAINS = (
    "INFERRED: Velocity Proportional Gain / 65536 is rated torque for 1 rad/s of velocity error of the motor,"
    " Velocity Integral Gain the same for the sum of the errors, once a millisecond (7-54 to 7-57, A-8 to"
    " A-10; the manual prints no unit: docs/simulation.md)."
)
VELOCITY_LOOP = (
    "ASSUMED: the velocity loop takes a sample each millisecond, its velocity is the difference of two"
    " positions, and the sum stops at the torque limit; the manual prints none of it (7-9 has the block"
    " diagram only)."
)
LIMITS = (
    "Max % rated torque (+) and (-) limit the torque, accelerating and braking, in the positive and negative"
    " direction of travel (7-61, 7-62)."
)
FILTER = (
    "ASSUMED: the torque filter is of first order and acts on the whole torque command (7-69 prints its"
    " cutoff only)."
)
OFFSET = (
    "Torque Offset Percentage is of the motor's maximum torque (7-63), taken as Peak Current as a % of RMS of"
    " rated torque (7-60): {0} % of rated torque."
)
FRICTION = (
    "The direction of friction compensation is that of the command, at rest that of the following error (7-86"
    " to 7-89)."
)
REVERSAL = (
    "Reversal Error Compensation is added at once, with the first motion in the other direction (7-18 does"
    " not say how fast)."
)
REVERSAL_ON_SCALE = "Reversal Error Compensation is not used: the position device is a linear scale (7-18)."
ANALOG = (
    "The drive closes the velocity loop itself with settings that are not in this file (7-2). Its scale is"
    " that of Analog Servo Pos. Voltage at the rapid feedrate (7-41); the output ends at 10 V."
)
THIRD_PARTY = (
    "A third-party SERCOS drive closes both loops with settings that are not in this file (7-2): no limit of"
    " the following error, no gain and no device of this axis is known."
)
_SMOOTH = (
    "With the integral gain at 0 appendix A (A-9) shows a smooth overshoot of large systems: with the"
    " position loop closed over a motor encoder this model does not give it (a soft load does, on a linear"
    " scale or with the position loop open)."
)
_UNUSUAL_MOTOR = (
    "The cells of the 7xx motors in Tables 7.B and 7.C (7-55, 7-56) do not fit the unit of the gains: the"
    " proportional one is 120 to 220 times the integral one, 14 to 25 times for all others. Take the results"
    " of this motor as rough."
)


def gain_notes(
    proportional: float, integral: float, rotation: float, rate: float, lag: float, motor: str
) -> list[str]:
    """Return where velocity gains do not fit the axis: too low for its position loop, too high for the lag,
    motors that fit no unit.

    ``rotation`` in rad/s2 at rated torque, ``rate`` of the position loop in 1/s (0 for an open one),
    ``lag`` in s.
    """
    notes = []
    loop = loop_rate(proportional, rotation)
    if rate > 0.0 and loop < SEPARATE * rate:
        needed = gain_for_rate(SEPARATE * rate, rotation)
        words = (
            f"The velocity loop is only {value_text(loop / rate, digits=2)} times as fast as the "
            "position loop:"
            " such an axis overshoots in any closed position loop. The lower bound of 7-54 is 3 times,"
            f" Velocity Proportional Gain {value_text(needed, digits=3)} on this axis."
        )
        if needed > TUNING_START:
            words += (
                f" It is too heavy for its position gain to be overdamped at {TUNING_START:.0f}, where"
                " appendix A begins (A-8)."
            )
        notes.append(words)
    integral_time = proportional / integral * 1e-3 if integral > 0.0 else math.inf
    highest = highest_rate(lag, integral_time)
    if loop > 0.0 and loop >= highest:
        notes.append(f"The velocity loop is not stable: {_why_unstable(loop, lag, highest)}")
    if motor[:2] in UNUSUAL_FRAMES:
        notes.append(_UNUSUAL_MOTOR)
    if integral == 0.0 and rate > 0.0:
        notes.append(_SMOOTH)
    return notes


def _why_unstable(loop: float, lag: float, highest: float) -> str:
    late = value_text(1000.0 * lag, "ms", 2)
    if highest > 0.0:
        return (
            f"its rate is {value_text(loop, '1/s', 3)}, and with a lag of {late} it"
            f" oscillates from {value_text(highest, '1/s', 3)} on (A-9)."
        )
    return f"the integral gain is too high for any proportional gain with a lag of {late} (A-10)."
