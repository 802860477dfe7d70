"""The command of an axis as closed pieces of motion.

A piece is one row of figures: from its start on for its duration, position, velocity and acceleration follow
from closed equations, so that the command is exact at any time. Lengths are in the unit u of the axis, times
in s; every profile starts at position 0 and ends with a piece without end, at rest.
"""

from __future__ import annotations

import math

from .arrays import Vector
from .signals import COMMAND, COMMAND_ACCELERATION, COMMAND_VELOCITY

START, DURATION, POSITION, VELOCITY, ACCELERATION, JERK, KIND, FIGURE = range(8)
_SIXTH = 1.0 / 6.0
WIDTH = 8
"""Figures in a piece: s, s, u, u/s, u/s2, u/s3, kind, figure of the kind."""

POLYNOMIAL = 0.0
"""x = POSITION + VELOCITY t + ACCELERATION t2/2 + JERK t3/6."""
EXPONENTIAL = 1.0
"""The acceleration decays: a = ACCELERATION exp(-t / FIGURE), FIGURE the time constant in s."""
SINE_SQUARED = 2.0
"""a = ACCELERATION sin2(pi t / FIGURE), FIGURE in s:
the velocity changes by ACCELERATION FIGURE / 2 without a jerk."""
SINE = 3.0
"""x = POSITION + VELOCITY sin(ACCELERATION t + JERK t2/2 + FIGURE): amplitude in u, rate in rad/s, change of
the rate in rad/s2, phase in rad."""
IN_POSITION = 4.0
"""At rest until the axis is in position, checked once in DURATION s: the end of an exact stop."""


def piece_at(profile: Vector, piece: int, time: float) -> int:
    """Return the piece of a moment, not before ``piece``."""
    # The last piece has no end, so the search has one.
    while time >= profile[piece * WIDTH + START] + profile[piece * WIDTH + DURATION]:
        piece += 1
    return piece


def command(profile: Vector, piece: int, time: float, io: Vector) -> None:
    """Put the commanded position, velocity and acceleration of a moment into the signals."""
    k = piece * WIDTH
    t = time - profile[k + START]
    p, v, a = profile[k + POSITION], profile[k + VELOCITY], profile[k + ACCELERATION]
    kind, figure = profile[k + KIND], profile[k + FIGURE]
    if kind in (POLYNOMIAL, IN_POSITION):
        j = profile[k + JERK]
        io[COMMAND] = p + t * (v + t * (0.5 * a + t * j * _SIXTH))
        io[COMMAND_VELOCITY] = v + t * (a + 0.5 * t * j)
        io[COMMAND_ACCELERATION] = a + t * j
    elif kind == EXPONENTIAL:
        rest = math.exp(-t / figure)
        gone = a * figure * (1.0 - rest)
        io[COMMAND] = p + (v + a * figure) * t - gone * figure
        io[COMMAND_VELOCITY] = v + gone
        io[COMMAND_ACCELERATION] = a * rest
    elif kind == SINE_SQUARED:
        rate = 2.0 * math.pi / figure
        wave = math.sin(0.5 * rate * t)
        io[COMMAND] = p + t * (v + 0.25 * a * t) - a * wave * wave / (rate * rate)
        io[COMMAND_VELOCITY] = v + 0.5 * a * (t - math.sin(rate * t) / rate)
        io[COMMAND_ACCELERATION] = a * wave * wave
    else:
        j = profile[k + JERK]
        angle, rate = figure + t * (a + 0.5 * j * t), a + j * t
        io[COMMAND] = p + v * math.sin(angle)
        io[COMMAND_VELOCITY] = v * rate * math.cos(angle)
        io[COMMAND_ACCELERATION] = v * (j * math.cos(angle) - rate * rate * math.sin(angle))
