"""Probes: chapters 29 and 30. Lengths may be in any one unit."""

from __future__ import annotations

import math

from amp_studio.validate import finite, not_negative, positive


def probe_radius(diameter: float) -> float:
    """Probe Radius Compensation of a tip whose diameter is known: half of it (page 29-2)."""
    return not_negative("The diameter of the tip", diameter) / 2.0


def approach_end(start: float, expected: float, approach: float) -> float:
    """Position at which a probing move slows from approach to probe rate (page 29-4).

    Approach Distance is counted from the start point, in the direction of the expected firing point.
    """
    way = finite("The expected firing point", expected) - finite("The start point", start)
    return start + math.copysign(not_negative("Approach Distance", approach), way)


# -- chapter 30: adaptive feed


def feedrate_change_percent(
    torque_error: float, integrated_error: float, proportional_gain: float, integral_gain: float
) -> float:
    """Change of feedrate in % by which adaptive feed answers a torque error (pages 30-1 and 30-2).

    Each gain is % of change per torque error, of the moment or integrated. The manual gives no unit of the
    errors, and that the two parts add up is implied by "in conjunction with".
    """
    proportional = finite("The torque error", torque_error) * proportional_gain
    return proportional + finite("The integrated torque error", integrated_error) * integral_gain


# -- chapter 30: adaptive depth


def trigger_direction(before: float, further_in: float) -> int:
    """Controlling Axis Trigger Dir, 1 or -1, from two positions: Z10 to Z5 into the part is -1 (page
    30-9).
    """
    way = finite("The position further in the part", further_in) - finite("The position before", before)
    if way == 0:
        raise ValueError("A move without length has no direction.")
    return 1 if way > 0 else -1


def deceleration_room(depth: float, tolerance: float) -> float:
    """Way left for an adaptive depth move to stop once the probe has tripped: 21 - 20 = 1 (page 30-10)."""
    if positive("The depth of the move", depth) < not_negative("Probe Trigger Tolerance", tolerance):
        raise ValueError(f"A move of {depth!r} ends before the probe has given {tolerance!r} to trip.")
    return depth - tolerance


def probe_travel_limit(probe_travel: float, zero_offset: float) -> float:
    """Largest sensible Depth Sensor Travel Limit of a probe with a mechanical travel (page 30-11).

    The limit counts from the zero point, where the probe is already depressed by ``zero_offset``; the manual
    asks to make the limit small enough for that offset, the difference is ours.
    """
    travel = positive("The travel of the probe", probe_travel)
    if not_negative("The offset of the zero point", zero_offset) >= travel:
        raise ValueError(f"A probe depressed by {zero_offset!r} has nothing left of a travel of {travel!r}.")
    return travel - zero_offset
