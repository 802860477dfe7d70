"""Speeds, ramps and overrides: the Speeds and override tabs and appendix C."""

from __future__ import annotations

from amp_studio.validate import finite, not_negative, positive


def ramp_for(speed: float, seconds: float) -> float:
    """Ramp in units/s² that reaches a speed in units a minute in a time (page 115).

    0 to 3000 turns a minute, which are 50 a second, in 0.1 s: 500. Page 115 sets this ramp for a move at 500
    turns a minute and expects 0.1 s there too; that takes 17 ms.
    """
    return finite("The speed", speed) / 60.0 / positive("The time", seconds)


def ramp_time(speed: float, ramp: float) -> float:
    """Time in s in which a ramp in units/s² reaches a speed in units a minute (pages 115 and 128).

    The sine of page 128 reaches 1000 cycles a second, which are 60000 a minute, with 2500 in 0.4 s.
    """
    return not_negative("The speed", speed) / 60.0 / positive("The ramp", ramp)


def index_time(distance: float, speed: float) -> float:
    """Time in s of a move at a speed in units a minute, its ramps left out (page 115):
    15 turns at 500 take 1.8 s.
    """
    return abs(finite("The distance", distance)) * 60.0 / positive("The speed", speed)


def overridden_feed(speed: float, percent: float, highest: float) -> float:
    """Speed of a feed or rapid move under an override, never above Max Machine Speed (pages 70, 71 and 74).

    G63 keeps the override of the feed at 100 % (page 33). That the two are multiplied is ours.
    """
    asked = not_negative("The speed", speed) * not_negative("The override", percent) / 100.0
    return min(asked, positive("Max Machine Speed", highest))
