"""Homing, jogging and software stroke limits of a Syntec axis (chapters 2 and 3)."""

from __future__ import annotations

import math

from amp_studio.sim.axis_parameters import AxisParameters
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.events import Homing, Jogging, Travel

METHOD, OFFSET, DIRECTION = "home.search_method", "home.offset", "home.direction"
FIRST, SECOND, GRID = "home.first_speed", "home.second_speed", "home.grid"
BLU = 0.001
"""mm or deg (1.2.6)."""
HALF = 0.5
"""Share of a turn below which home grid passes an index over (2.2)."""
FARTHEST_BLU = 999999999.0
"""The delivered stroke limits: none (3.2)."""

NOTES = (
    "Onto the dog at the first speed, stop, off it backwards at the second, on to the nearest index (2.2).",
    (
        "ASSUMED: a unit of Axis home offset is a BLU, its sign the machine's; neither is printed (2.2). The axis stops along its ramp and returns to the index at"
        " the second speed."
    ),
)
STOPPED = "ASSUMED: beyond the limit the command stops at once; the slides print the alarm alone (3.2)."


def _above_zero(read: AxisParameters, name: str) -> float:
    value = read.number(name)
    if not (math.isfinite(value) and value > 0.0):
        raise SimulationError(f"{name} of axis {read.axis} is {value:g}; it must be above 0", name)
    return value


def homing(read: AxisParameters, turn: float) -> Homing:
    """Return the homing sequence; ``turn`` is u from index to index. Raises SimulationError where a value is missing."""
    if read.choice("resolution.encoder_type") == "absolute":
        raise SimulationError(
            f"Axis {read.axis} has an absolute encoder: it is not homed by a search (2.1.1)",
            "resolution.encoder_type",
        )
    method = read.choice(METHOD)
    sign = -1.0 if read.choice(DIRECTION) == "negative" else 1.0
    offset = (read.optional(OFFSET) or 0.0) * BLU
    second = _above_zero(read, SECOND) / 60.0
    alone, stays = method == "index-only", method == "stay"
    return Homing(
        approach=0.0 if alone else sign * _above_zero(read, FIRST) / 60.0,
        leave=sign * second * (1.0 if alone else -1.0),
        marker="none" if method == "dog-only" else "next",
        turn=turn,
        coordinate=offset if stays else 0.0,
        final=second,
        offset=0.0 if stays else offset,
        skipped=HALF if read.value(GRID) is True else 0.0,
        page="2.2",
        notes=NOTES,
    )


def jogging(read: AxisParameters) -> Jogging:
    """Return the jog speed (Pr521)."""
    return Jogging({"jog": _above_zero(read, "jog.feedrate") / 60.0}, page="4.1")


def travel(read: AxisParameters) -> Travel:
    """Return the first software stroke limits (Pr2401), which are active after homing (3.2)."""
    edges = []
    for name, none in (("limit.first_negative", -FARTHEST_BLU), ("limit.first_positive", FARTHEST_BLU)):
        value = read.optional(name)
        edges.append(math.copysign(math.inf, none) if value in (None, none) else float(value or 0.0) * BLU)
    return Travel({"the 1st software stroke limit": (edges[0], edges[1])}, "MOT-017/018", "3.2", (STOPPED,))
