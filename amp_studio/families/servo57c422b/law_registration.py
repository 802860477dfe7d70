"""The registration input of a 57C422B: the feedback position is stored while the axis goes on (2-4, 4-34,
A-2).
"""

from __future__ import annotations

from amp_studio.sim import AxisLaw, AxisParameters, Probing, SimulationError

FAST, SLOW = 25e-6, 50e-6
"""s: page 2-4 and page A-2 disagree."""


def probing(_read: AxisParameters, axis: AxisLaw, cycle: str) -> Probing:
    """Return the registration; the motion goes on. Raises SimulationError for another cycle."""
    if cycle.lower() not in ("", "registration"):
        raise SimulationError(f"Unknown cycle {cycle}. Known: registration", "move.cycle")
    return Probing(
        "feedback registration",
        axis.feedrate or 0.0,
        SLOW,
        "Page A-2 prints 50 µs, page 2-4 25 µs: the longer one is used.",
        after="goes on",
        alternatives={"2-4": FAST, "A-2": SLOW},
        page="2-4, A-2",
        notes=(
            (
                "The position of registers 84, 85 is stored at either edge, or at the falling one by register"
                " 41 (4-22); the axis goes on."
            ),
        ),
    )
