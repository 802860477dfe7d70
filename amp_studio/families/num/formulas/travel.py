"""Axis travels: chapter 7."""

from __future__ import annotations

from amp_studio.validate import finite


def axis_travel(least: float, most: float) -> float:
    """Travel of an axis between its lower and its upper limit (page 7-12);
    below zero where they are exchanged.
    """
    return finite("The upper travel limit", most) - finite("The lower travel limit", least)


def backlash_on_positive_move(value: float) -> float:
    """Correction with its sign when the axis moves in the positive direction (page 7-14).

    The amount of the word is the greatest backlash; its sign is that of the correction on a positive move.
    """
    return finite("The backlash", value)
