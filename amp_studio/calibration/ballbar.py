"""Lost motion of an axis from the circles of a ball-bar:
the radius steps outwards where the axis turns round.

Before it turns at the end of its travel the slide lags behind by half of the lost motion and the circle is
that much too small; behind it the slide lags on the other side and the circle is too large. The first axis of
a circle turns at 0 and 180 degrees, the second one at 90 and 270. Lines are fitted on both sides, so that the
slope of other errors does not count, and the first degrees are left out:
there the controller is still taking up what is lost.
"""

from __future__ import annotations

import statistics
from collections.abc import Sequence
from fractions import Fraction

from .errors import CalibrationError
from .measurement import MeasuredRun, Measurement

_TURNS = {"first": (0.0, 180.0), "second": (90.0, 270.0)}
"""Which axis of a circle -> the angles at which it turns round, in degrees."""
_NEAR, _FAR = 2.0, 12.0
"""Degrees on each side of a turn between which the lines are fitted."""
_MIN_POINTS = 3


def lost_motions(measurement: Measurement, which: str) -> list[Fraction]:
    """Return the outward step of the radius at each turn of an axis, in the unit of the measurement.

    ``which`` axis of the circle: "first" or "second".
    Raises CalibrationError where the points do not reach a turn.
    """
    if which not in _TURNS:
        raise CalibrationError("name whether the axis is the first or the second one of the circle")
    steps = [_step(run, turn) for run in measurement.runs for turn in _TURNS[which]]
    found = [Fraction(repr(step)) for step in steps if step is not None]
    if not found:
        ends = " and ".join(f"{turn:g}" for turn in _TURNS[which])
        raise CalibrationError(
            f"the circle has too few points about {ends} degrees, where this axis turns round"
        )
    return found


def _step(run: MeasuredRun, turn: float) -> float | None:
    """Return the radius behind a turn less that before it, in the direction of travel;
    None with too few points.
    """
    below: list[tuple[float, float]] = []
    above: list[tuple[float, float]] = []
    for at, by in run.points:
        # Within half a turn of it: 359 degrees is 1 before the turn at 0.
        distance = (float(at) - turn + 180.0) % 360.0 - 180.0
        if _NEAR <= abs(distance) <= _FAR:
            (above if distance > 0 else below).append((distance, float(by)))
    low, high = _at_zero(below), _at_zero(above)
    if low is None or high is None:
        return None
    # A clockwise circle comes from above the turn.
    return high - low if run.rising else low - high


def _at_zero(points: Sequence[tuple[float, float]]) -> float | None:
    """Return where the line through points meets the turn; None with too few of them."""
    if len({x for x, _ in points}) < _MIN_POINTS:
        return None
    return statistics.linear_regression([x for x, _ in points], [y for _, y in points]).intercept
