"""Axes, homing and zones: chapters 4 to 6."""

from __future__ import annotations

from collections.abc import Sequence

from amp_studio.validate import finite, not_negative


def rollover_position(position: float, move: float, rollover: float = 360.0) -> float:
    """Position of a rotary axis, in degrees, after a move; 0 switches rollover off (page 4-6)."""
    target = finite("The position", position) + finite("The move", move)
    return target % rollover if not_negative("The rollover value", rollover) else target


def home_distance(marker_distance: float, calibration: float) -> float:
    """Signed way from the end of the home switch to home: nearest marker plus calibration (page 5-2)."""
    return finite("The distance to the marker", marker_distance) + finite("Home Calibration", calibration)


def dcm_position(scale_position: float, machine_position_at_zero: float) -> float:
    """Absolute axis position on a scale with distance-coded markers (page 5-6)."""
    zero = finite("Machine Position at DCM Scale 0", machine_position_at_zero)
    return finite("The position on the scale", scale_position) + zero


def inside_zone(position: Sequence[float], limits: Sequence[tuple[float, float]]) -> bool:
    """Whether a position lies in the block of one zone group (page 6-4).

    ``position`` and ``limits`` (minimum, maximum) are those of the axes of the group only, in machine
    coordinates; an axis outside the group does not count. The manual has "between", so a position
    on a limit is not inside.
    """
    if len(position) != len(limits) or not limits:
        raise ValueError("A zone group needs at least one axis, and one pair of limits for each position.")
    if any(low > high for low, high in limits):
        raise ValueError("The minimum of a zone must not be above its maximum.")
    return all(low < value < high for value, (low, high) in zip(position, limits, strict=True))
