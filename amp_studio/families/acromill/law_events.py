"""Homing and jogging of an AcroMill axis (pages 65 and 67)."""

from __future__ import annotations

import math

from amp_studio.sim import AxisParameters, Homing, Jogging, Ramp, SimulationError, Travel

from .law_facts import MOTION, ids

_NOTES = (
    (
        "To the switch at Home Fast Speed, away from it at Home Slow Speed, on to the marker at Marker Speed"
        " (page 65)."
    ),
    (
        "ASSUMED: a marker each 4096 pulses (page 113); at the marker the position becomes Home Preset, and"
        " the axis stops along Home STP; where it rests is not printed."
    ),
)


def homing(read: AxisParameters, pulses: float) -> Homing:
    """Return the sequence; ``pulses`` for 1 u."""
    sign = -1.0 if read.choice(ids.home_direction) == "neg" else 1.0
    priority = int(read.optional(ids.home_priority) or 0.0)
    if priority == 0:
        raise SimulationError(
            f"Axis {read.axis} is not homed: its Home Priority is 0 (page 65)", ids.home_priority
        )
    return Homing(
        approach=sign * read.above_zero(ids.fast_speed) / 60.0,
        leave=-sign * read.above_zero(ids.slow_speed) / 60.0,
        marker="next",
        turn=MOTION.value("pulses_per_turn") / pulses,
        coordinate=read.optional(ids.home_preset) or 0.0,
        search=read.above_zero(ids.marker_speed) / 60.0,
        ramp=Ramp("linear", read.above_zero(ids.home_acceleration), read.above_zero(ids.home_stop)),
        order=priority,
        speeds={"approach": ids.fast_speed, "leave": ids.slow_speed, "search": ids.marker_speed},
        page="65",
        notes=_NOTES,
    )


def jogging(read: AxisParameters) -> Jogging:
    """Return the jog speeds and increments (page 67)."""
    speeds = {name: read.above_zero(ids[f"jog_{name}"]) / 60.0 for name in ("feedrate", "rapid")}
    increments = {str(n): read.optional(ids[f"jog_increment_{n}"]) or 0.0 for n in range(1, 6)}
    ramp = Ramp("linear", read.above_zero(ids.jog_acceleration), read.above_zero(ids.jog_deceleration))
    return Jogging(speeds, {name: way for name, way in increments.items() if way}, ramp=ramp, page="67")


def travel(read: AxisParameters) -> Travel:
    """Return the soft limits from the home position (page 60)."""
    if read.value(ids.disable_limit) is True:
        return Travel({}, "SOFT LIMIT", "60", ("Soft limits of this axis are disabled.",))
    low, high = read.optional(ids.soft_limit_minus), read.optional(ids.soft_limit_plus)
    edges = (-math.inf if low is None else low, math.inf if high is None else high)
    note = (
        "ASSUMED: a manual move stops at once at a soft limit; the guide prints the limits alone (page 60)."
    )
    return Travel({"the soft limit": edges}, "SOFT LIMIT", "60", (note,))
