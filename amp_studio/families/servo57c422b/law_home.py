"""Homing of a 57C422B axis, in the four sequences of page 4-29, and its software overtravel (4-10, 4-6)."""

from __future__ import annotations

import math
from typing import Literal

from amp_studio.sim import AxisParameters, Homing, Jogging, Ramp, SimulationError, Travel

from . import switch_bits as bits
from .law_facts import MOTION, ids

MARKER = "ASSUMED: an encoder of 1000 lines (page 4-48), if a marker is used; move.turn gives another."
_UNKNOWN = (
    "Register 2 is not set. ASSUMED: the fourth sequence of page 4-29, with home switch and marker, in the"
    " direction of move.direction; and an encoder of 1000 lines (page 4-48)."
)
PLACE = (
    "At the marker, or where the switch goes off, the position becomes that of registers 17 and 18 (page"
    " 4-29). ASSUMED: the axis then stops by its deceleration."
)


def homing(read: AxisParameters) -> Homing:
    """Return the sequence of register 2; raises SimulationError for speeds that are not set."""
    word = read.optional(ids.setup_switches)
    setup = bits.HOME_SWITCH | bits.MARKER if word is None else int(word)
    switch, marker = bool(setup & bits.HOME_SWITCH), bool(setup & bits.MARKER)
    sign = -1.0 if setup & bits.HOME_NEGATIVE else 1.0
    fast = read.above_zero(ids.command_velocity) if switch else 0.0
    slow = read.above_zero(ids.home_speed_low) if switch or marker else 0.0
    counts: Literal["next", "none"] = "next" if marker else "none"
    return Homing(
        approach=sign * fast,
        # Without a switch there is nothing to back off: the marker is searched straight on.
        leave=-sign * slow if switch else sign * slow,
        marker=counts,
        turn=MOTION.value("marker_distance"),
        coordinate=read.number(ids.command_position),
        direction_lost=True,
        speeds={"approach": ids.command_velocity, "leave": ids.home_speed_low},
        page="4-29",
        notes=(
            _UNKNOWN if word is None else bits.SWITCHES,
            *([MARKER] if word is not None and marker else []),
            PLACE,
        ),
    )


def travel(read: AxisParameters, ramp: Ramp) -> Travel:
    """Return the software overtravel of registers 11 to 14,
    of a linear axis that has it enabled in register 2.
    """
    setup, encoder = (
        int(read.optional(ids.setup_switches) or 0.0),
        int(read.optional(ids.setup_encoder) or 0.0),
    )
    low, high = read.optional(ids.setup_overtravel_negative), read.optional(ids.setup_overtravel_positive)
    notes = (bits.SWITCHES,)
    if encoder & bits.ROTARY:
        return Travel({}, "OVERTRAVEL", "4-10", ("A rotary axis has no software overtravel (4-10).", *notes))
    if not setup & bits.SOFTWARE_OVERTRAVEL:
        return Travel(
            {}, "OVERTRAVEL", "4-10", ("Software overtravel is not enabled in register 2 (4-6).", *notes)
        )
    edges = (-math.inf if low is None else low, math.inf if high is None else high)
    if edges[0] >= edges[1]:
        raise SimulationError(
            f"The negative overtravel limit {edges[0]:g} is not below the positive one, {edges[1]:g}: a"
            " motion fault (4-10)",
            ids.setup_overtravel_negative,
        )
    coasts = bool(setup & bits.OVERTRAVEL_COASTS)
    action = (
        "At the limit the loop is switched off and the axis coasts (4-6)."
        if coasts
        else "At the limit the axis decelerates by registers 23, 24 and is regulated there (4-6)."
    )
    return Travel(
        {"the software overtravel limit": edges},
        "OVERTRAVEL",
        "4-10",
        (action, *notes),
        stop=None if coasts else ramp,
        coasts=coasts,
    )


JOGGED = (
    "A jog is velocity control (4-25): bit 2 of register 65 begins it, bit 4 is its direction, and without"
    " bit 2 the axis decelerates. It has the velocity of registers 19, 20 and the rates of 21 to 24; the time"
    " of the button is that of the application program, which writes the bits."
)


def jogging(read: AxisParameters, ramp: Ramp) -> Jogging:
    """Return the jog of an axis: velocity control (4-25). Raises SimulationError for a velocity that is not
    set.
    """
    speed = read.number(ids.command_velocity)
    return Jogging({"velocity control": abs(speed)}, ramp=ramp, page="4-25", notes=(JOGGED,))
