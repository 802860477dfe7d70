"""Homing of a 57C422B axis: the fourth of the four sequences of page 4-29, with switch and marker."""

from __future__ import annotations

from amp_studio.sim.axis_parameters import AxisParameters
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.events import Homing

POSITION, FAST, SLOW = "command.position", "command.velocity", "command.home_speed_low"
TURN = 4000.0
"""Counts from marker to marker: 1000 lines, times 4 (page 4-48)."""
NOTES = (
    (
        "The bits of register 2 are lost with figure 4.3. ASSUMED: the fourth sequence of page 4-29, with home switch and marker, in the direction of"
        " move.direction, and an encoder of 1000 lines (page 4-48)."
    ),
    "At the marker the position becomes that of registers 17 and 18 (page 4-29). ASSUMED: the axis then stops by its deceleration.",
)


def homing(read: AxisParameters) -> Homing:
    """Return the sequence; raises SimulationError for speeds that are not set."""
    fast, slow = (read.number(name) for name in (FAST, SLOW))
    for name, speed in ((FAST, fast), (SLOW, slow)):
        if not speed > 0.0:
            raise SimulationError(f"{name} of axis {read.axis} is {speed:g}; it must be above 0", name)
    return Homing(
        approach=fast,
        leave=-slow,
        marker="next",
        turn=TURN,
        coordinate=read.number(POSITION),
        direction_lost=True,
        page="4-29",
        notes=NOTES,
    )
