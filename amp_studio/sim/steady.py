"""The following error of a move at its full speed, with its sign."""

from __future__ import annotations

import numpy as np

from .trace import Trace

SPEED = 1e-3
"""Largest relative difference from the feedrate of a constant speed."""


def error_at_speed(trace: Trace) -> float | None:
    """Return the mean following error in the second half of the rows at full speed,
    above 0 for an axis that is behind.

    None where the scenario found no steady error.
    """
    feedrate = trace.result.get("feedrate", (None, ""))[0]
    if not feedrate or trace.result.get("steady_following_error", (None, ""))[0] is None:
        return None
    speed = trace.columns["command_velocity"]
    even = np.flatnonzero(np.abs(np.abs(speed) / feedrate - 1.0) <= SPEED)
    if even.size == 0:
        return None
    late = even[even.size // 2 :]
    return float((trace.columns["following_error"][late] * np.sign(speed[late])).mean())
