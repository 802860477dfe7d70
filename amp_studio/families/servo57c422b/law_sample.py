"""The control loop of the 57C422B servo module, one scan of 1.25 ms at a time (manual J-3642-7).

Printed: the scan (page A-2); the output of ±1984 for ±10 V and its clamp in register 31 (pages 4-16, 4-17);
the faults of position and velocity error (pages 4-8, 4-9, 4-37) with the velocity error in counts a scan;
that the velocity loop is the module's own for a current reference and switched off for a velocity reference
(page 5-3); what each gain is for (pages 4-29, 4-30, 5-2 to 5-4).

Lost: the diagram of the loop and the scale of every gain (section 4.5 to 4.9, appendix I). The loop below is
therefore an ASSUMPTION, a cascade in counts a scan:

    wanted = feed-forward / 8192 * commanded velocity + proportional / 65536 * error + integral / 65536 * sum
    of errors output = velocity gain * (wanted - measured velocity)             current reference
    output = words * wanted                                           velocity reference
    output + deadband in the direction of the output, cut to ± register 31

What speaks for these scales are the tuned gains of the two printed programs (pages 4-48 and 5-5):
feed-forward 8320 and 8256, a little above 8192 in both; proportional 17595 and 18700 with integral 768 and
1575, which make a well damped loop of 34 and 36 Hz; and what feed-forward has above 8192, times the velocity
gain, is the same viscous friction in both,
1.22 and 1.09 words for a count a scan. All scales can be set.
"""

from __future__ import annotations

import math

from amp_studio.sim import (
    COMMAND,
    COMMAND_VELOCITY,
    MODE,
    MONITOR,
    MOTOR,
    OUTPUT,
    OUTPUT_TEST,
    POSITION,
    POSITION_LOOP,
    STOP,
    Vector,
)

SCAN = 0.00125
"""s (page A-2)."""
WORDS_PER_VOLT = 198.4
"""1984 is 10 V (page 4-16)."""

# Parameters, lengths in counts.
PROPORTIONAL, INTEGRAL, FEED_FORWARD = 0, 1, 2
"""Counts a scan for a count, for a count in one scan, for a count a scan."""
VELOCITY, DEADBAND, CLAMP = 3, 4, 5
"""Words for a count a scan, words, words."""
CURRENT_REFERENCE, WHOLE_WORDS = 6, 7
"""1 or 0: the module closes the velocity loop; the output is a whole word."""
POSITION_ERROR, VELOCITY_ERROR = 8, 9
"""Counts and counts a scan; negative for no limit."""
PARAMETERS = 10

# State.
BEFORE, SUM, WANTED, CUT = 0, 1, 2, 3
"""Counts at the last scan; sum of the errors, counts; counts a scan;
words that the clamp took off the last output."""
STATE = 4

_POSITION_FAULT, _VELOCITY_FAULT = 1.0, 2.0
"""STOP: register 73, bits 4 and 5."""

MONITORS = (("wanted_velocity", "counts/scan"), ("velocity_error", "counts/scan"), ("output_word", ""))


def position_sample(p: Vector, s: Vector, io: Vector) -> None:
    """The position loop in one scan: from command and measured position to the wanted velocity."""
    commanded = io[COMMAND_VELOCITY] * SCAN
    s[WANTED] = commanded
    if io[MODE] == POSITION_LOOP:
        error = io[COMMAND] - io[POSITION]
        if error * s[CUT] <= 0.0:  # a clamped output lets the sum only shrink
            s[SUM] += error
        s[WANTED] = p[FEED_FORWARD] * commanded + p[PROPORTIONAL] * error + p[INTEGRAL] * s[SUM]
        if p[POSITION_ERROR] >= 0.0 and abs(error) > p[POSITION_ERROR]:
            io[STOP] = _POSITION_FAULT


def velocity_sample(p: Vector, s: Vector, io: Vector) -> None:
    """The velocity loop in the same scan: from wanted and measured velocity to volts."""
    commanded, velocity = io[COMMAND_VELOCITY] * SCAN, io[MOTOR] - s[BEFORE]
    s[BEFORE] = io[MOTOR]
    # With a velocity reference the drive takes the measured speed off itself.
    word = p[VELOCITY] * (s[WANTED] - p[CURRENT_REFERENCE] * velocity)
    if io[MODE] == OUTPUT_TEST:  # the direct drive reference of register 28
        word = io[COMMAND] * WORDS_PER_VOLT
    elif word > 0.0:
        # The deadband of the drive is jumped over, so that a small word moves the axis at all.
        word += p[DEADBAND]
    elif word < 0.0:
        word -= p[DEADBAND]
    cut = min(max(word, -p[CLAMP]), p[CLAMP])
    # The position loop of the next scan has to know whether more output would do anything.
    s[CUT] = word - cut
    if p[WHOLE_WORDS] > 0.0:
        cut = 1.0 * math.floor(cut + 0.5)
    io[OUTPUT] = cut / WORDS_PER_VOLT
    io[MONITOR], io[MONITOR + 1], io[MONITOR + 2] = s[WANTED], commanded - velocity, cut
    if io[MODE] == POSITION_LOOP and 0.0 <= p[VELOCITY_ERROR] < abs(commanded - velocity):
        io[STOP] = _VELOCITY_FAULT


def whole_sample(p: Vector, s: Vector, io: Vector) -> None:
    """Both in one, for a velocity reference: the velocity loop is in the drive."""
    position_sample(p, s, io)
    velocity_sample(p, s, io)
