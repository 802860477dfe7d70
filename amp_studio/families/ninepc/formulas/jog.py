"""Jogging: chapter 8."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby

from amp_studio.validate import whole


def remembered_retract_moves(jogged: Sequence[str], limit: float) -> int:
    """Moves of a jog retract that are traced back, at most Max Jogs in Retracts (page 8-13).

    ``jogged`` are the names of the axes in the order they were jogged, all axes together. Consecutive jogs
    of one axis are one move.
    """
    return min(sum(1 for _ in groupby(jogged)), whole("Max Jogs in Retracts", limit))
