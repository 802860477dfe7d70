"""Dual axes and split axes: chapters 31 and 32."""

from __future__ import annotations

from collections.abc import Sequence

from amp_studio.validate import finite, not_negative

from .servo import following_error


def dual_group_limit(values: Sequence[float]) -> float:
    """Ramp, velocity step, rapid or cutting feedrate of a dual group: that of its slowest axis (page 31-2).

    A parked axis counts too, and the limit stays when the group is decoupled.
    """
    if len(values) < 2:
        raise ValueError("A dual group has at least two axes.")
    return min(not_negative("The value of an axis", value) for value in values)


def split_axis_skew(master_error: float, slave_error: float) -> float:
    """Skew of a split axis: difference of the following errors of its two servos (page 32-10)."""
    return abs(finite("The following error of the master", master_error) - finite("The other", slave_error))


def split_axis_skew_at(feedrate: float, master_gain: float, slave_gain: float) -> float:
    """Skew that different gains alone give a split axis at a steady feedrate per minute (page 32-1).

    The manual prints no equation; it follows from the following error of each servo (page 7-25). In the
    length unit of the feedrate.
    """
    return split_axis_skew(following_error(feedrate, master_gain), following_error(feedrate, slave_gain))
