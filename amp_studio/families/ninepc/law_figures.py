"""What the 9/PC's manual itself calculates of a motion, to compare with the motion (7-20 to 7-28, 10-2)."""

from __future__ import annotations

import math
from dataclasses import dataclass

from amp_studio.sim import Prediction


@dataclass(frozen=True)
class Loop:
    """Position loop of an axis; lengths in u, times in s."""

    gain: float
    """Initial Gain of Position Loop: 1000 u/min for 1 u of following error."""
    break_point: float
    break_ratio: float
    """1 with ZFE, which does not use the gain break."""
    feed_forward: float
    """Share, 0 to 1."""

    @property
    def rate(self) -> float:
        """1/s"""
        return self.gain * 1000.0 / 60.0


def following_error(loop: Loop, feedrate: float) -> float:
    """Return the following error at a constant feedrate in u/s; infinite where the loop never reaches it.

    feedrate / (1000 gain) (7-25), the share 1 - p / 100 of it with ZFE (7-28); beyond the gain break point
    the part above it is divided by the gain break ratio (the inverse of 7-22 and 7-27).
    """
    plain = abs(feedrate) * (1.0 - loop.feed_forward) / loop.rate
    if loop.break_ratio == 1.0 or plain <= loop.break_point:
        return plain
    if loop.break_ratio == 0.0:
        return math.inf
    return loop.break_point + (plain - loop.break_point) / loop.break_ratio


def printed_excess_error(loop: Loop, feedrate: float) -> float:
    """Return the printed equation of the least Excess Error: 1.1 feedrate / (1000 gain ratio),
    the ratio from the start (7-20).
    """
    if loop.break_ratio == 0.0:
        return math.inf
    return 1.1 * abs(feedrate) / (loop.rate * loop.break_ratio)


def sentence_excess_error(loop: Loop, feedrate: float) -> float:
    """Return the reading of the sentence beside that equation:
    110 % of the following error that is expected (7-20).

    Below the printed equation where the gain break is in between, and with ZFE;
    the same without a gain break.
    """
    return 1.1 * following_error(loop, feedrate)


def response_time(loop: Loop) -> float:
    """Return the time in s from one steady velocity to another: 120 ms / gain (10-2)."""
    return 0.12 / loop.gain


def predictions(loop: Loop, unit: str, feedrate: float) -> dict[str, Prediction]:
    """Return the figures by name; ``feedrate`` in u/s, ``unit`` that of a length."""

    def length(value: float, page: str) -> Prediction:
        return Prediction(value if math.isfinite(value) else None, unit, page)

    page = "7-25" if loop.feed_forward == 0.0 else "7-28"
    return {
        "steady_following_error": length(following_error(loop, feedrate), page),
        "response_time": Prediction(response_time(loop), "s", "10-2"),
        "excess_error_printed": length(printed_excess_error(loop, feedrate), "7-20"),
        "excess_error_by_sentence": length(sentence_excess_error(loop, feedrate), "7-20"),
    }
