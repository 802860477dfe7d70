"""The steps of Home All."""

from __future__ import annotations

from collections.abc import Sequence


def has_step_before(step: float, steps: Sequence[float | None]) -> bool:
    """Whether Home All comes to a step (H437 to H452): 0 and 1 always,
    any other where a joint has the one before.
    """
    before = abs(step) - 1.0
    return before <= 0.0 or any(other is not None and abs(other) == before for other in steps)
