"""Synchronized spindles: chapter 14."""

from __future__ import annotations

from amp_studio.validate import finite, not_negative

from .feedback import lowest_terms

LARGEST_RATIO = 10
"""Neither side of the feedback ratio may be greater (page 14-1)."""


def synchronized_feedback_ratio(controlling_counts: float, follower_counts: float) -> tuple[int, int]:
    """Feedback ratio of two spindles in lowest terms, such as 10:7 (page 14-1).

    ValueError where a side is above 10, as of 11:1 and 5:12: the control gives an error there.
    """
    ratio = lowest_terms(controlling_counts, follower_counts)
    if max(ratio) > LARGEST_RATIO:
        raise ValueError(f"The feedback ratio {ratio[0]}:{ratio[1]} has a side above {LARGEST_RATIO}.")
    return ratio


def synchronized_range(
    controlling: tuple[float, float], follower: tuple[float, float]
) -> tuple[float, float] | None:
    """Lowest and highest rpm two synchronized spindles can be programmed at, None for no speed (page 14-2).

    The arguments are (minimum, maximum) of the gear each spindle is in. The highest minimum and the lowest
    maximum of both count, as in every row of example 14.1; the text names the follower alone.
    """
    low, high = _gear(controlling)
    other_low, other_high = _gear(follower)
    least, most = max(low, other_low), min(high, other_high)
    return (least, most) if least <= most else None


def synchronized_speed(
    requested: float, controlling: tuple[float, float], follower: tuple[float, float]
) -> float | None:
    """Speed in rpm at which two spindles synchronize; None where they have no common one (page 14-2).

    The requested speed, or the end of the common range that it lies beyond: example 14.1.
    """
    rpm = not_negative("The requested speed", requested)
    both = synchronized_range(controlling, follower)
    return None if both is None else min(max(rpm, both[0]), both[1])


def mirrored_angle(angle: float) -> float:
    """Orient angle of a follower with reversed orientation, 0 to 360: 45 becomes 315 (page 14-4)."""
    return -finite("The angle", angle) % 360.0


def follower_position(position: float, offset: float, is_reversed: bool) -> float:
    """Angle in degrees of the follower while positions are synchronized (page 14-6).

    With an offset of 60 and the controlling spindle at 80 it is 20, and -20 with reversed orientation.
    """
    behind = finite("The position of the controlling spindle", position) - finite("The offset", offset)
    return -behind if is_reversed else behind


def _gear(speeds: tuple[float, float]) -> tuple[float, float]:
    low, high = speeds
    if not_negative("The minimum speed", low) > not_negative("The maximum speed", high):
        raise ValueError(f"A gear cannot go from {low!r} to {high!r} rpm.")
    return low, high
