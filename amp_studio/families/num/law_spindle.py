"""Spindles, indexing and rigid tapping of a NUM control (chapter 8)."""

from __future__ import annotations

import math

from amp_studio.sim import (
    AxisLaw,
    AxisParameters,
    BoundMachine,
    Gear,
    Orient,
    SimulationError,
    Spindle,
    Tapping,
)

from .formulas.spindle import indexing_standstill, spindle_increment, tapping_deceleration_distance
from .law_facts import ids

_RANGES = range(40, 46)
_FULL_V = 10.0
SEARCH = 1 << 7
"""Bit of P7N0 that switches the automatic search of a range off (8-16)."""
_FEED_STOP_WAITS = 1 << 4
"""Bit of P7N1 (8-9)."""
_GROUP_1 = "1"
_PROPORTION = (
    "ASSUMED: lower speeds are in proportion to the 10 V at the end of the range (8-16). No ramp of the"
    " reference is printed."
)
_FOLLOWS = (
    "The axis follows the angle of the spindle; word 1 of P63 of group 1 puts its command ahead (8-35)."
)
INTEGRAL = (
    "ASSUMED: the integration of P63 word 0 and the start of the axis by word 2 are not simulated: both make"
    " the error smaller after it has begun."
)


def spindle(read: AxisParameters, number: str) -> Spindle:
    """Return a spindle with its six ranges; raises SimulationError where none is set."""
    if number not in ("1", "2", "3", "4"):
        raise SimulationError(f"There is no spindle {number}: 1 to 4", "move.spindle")
    gears = []
    for word in _RANGES:
        at = f"{number}.{word}"
        high = read.optional(ids.range_max, at=at) or 0.0
        if high <= 0.0:
            continue  # the range is not there (8-16)
        limit = read.optional(ids.limit_speed, at=at) or high
        low = read.optional(ids.range_min, at=at) or 0.0
        gears.append(
            Gear(
                str(word),
                low,
                limit,
                full=high,
                output=_FULL_V,
                gain=(read.optional(ids.spindle_gain, at=number) or 0.0) / 60.0,
                tap_rate=read.optional(ids.tapping_acceleration, at=number) or 0.0,
            )
        )
    if not gears:
        raise SimulationError(f"Spindle {number} has no speed range (P46 to P49)", ids.range_max)
    functions = int(read.optional(ids.misc_functions, everywhere=True) or 0.0)
    return Spindle(
        number,
        f"NUM spindle {number}: {len(gears)} ranges, 10 V at the end of each",
        "V",
        tuple(gears),
        "8-16",
        (
            (_PROPORTION,)
            if not functions & SEARCH
            else (_PROPORTION, "Bit 7 of P7N0 is set: no range is searched (8-16).")
        ),
        orient=_orient(read, number),
        no_gear="ERROR 29",
        programs_ranges=True,
    )


def _orient(read: AxisParameters, number: str) -> Orient | None:
    """Return how a spindle is indexed, in rpm and deg; None where it is not."""
    speed, points = (
        read.optional(ids[f"spindle_{each}"], at=number) for each in ("indexing_speed", "points")
    )
    period = read.optional(ids.sampling_period, everywhere=True)
    if not speed or not points or not period:
        return None
    unit = spindle_increment(points)
    return Orient(
        speed,
        1.0,
        (read.optional(ids.spindle_origin, at=number) or 0.0) * unit,
        0.0,
        (read.optional(ids.spindle_window, at=number) or 0.0) * unit,
        standstill=indexing_standstill(period * 1000.0),  # ms to µs
        page="8-5, 8-6",
    )


def tapping(machine: BoundMachine, spindle: Spindle, gear: Gear, axis: AxisLaw, pitch: float) -> Tapping:
    """Return how the axis follows the spindle (8-32 to 8-35);
    raises SimulationError without an acceleration in P62.
    """
    read = machine.parameters
    if not gear.tap_rate:
        raise SimulationError(f"P62 gives spindle {spindle.name} no acceleration", ids.tapping_acceleration)
    period = (read.optional(ids.sampling_period, everywhere=True) or 0.0) / 1000.0  # ms to s
    ahead = (read.optional(ids.position_anticipation, at=_GROUP_1) or 0.0) / 1000.0 * period
    start = (read.optional(ids.zero_crossing_anticipation, at=_GROUP_1) or 0.0) * period
    volts = read.optional(ids.hole_bottom_reference, at=spindle.name) or 0.0
    distance = tapping_deceleration_distance(pitch, gear.high, gear.tap_rate)
    figures = {
        "deceleration_distance_at_limit": (distance, axis.unit),
        "hole_bottom_speed": (volts / _FULL_V * gear.full, "rpm"),
        "anticipation": (ahead, "s"),
        "zero_crossing_anticipation": (start, "s"),
    }
    return Tapping(
        {},
        0.0,
        0.0,
        gear.tap_rate * pitch,
        math.inf,
        leads=True,
        anticipation=ahead,
        figures=figures,
        feed_stop="inhibited" if _inhibits_feed_stop(read) else "detaps",
        feed_stop_page="8-9",
        page="8-32 to 8-35",
        notes=(_FOLLOWS, INTEGRAL),
    )


def _inhibits_feed_stop(read: AxisParameters) -> bool:
    """Return whether CYHLD waits for the end of a tap (8-9); without the bit it turns the tap back."""
    return bool(int(read.optional(ids.functions_more, everywhere=True) or 0.0) & _FEED_STOP_WAITS)
