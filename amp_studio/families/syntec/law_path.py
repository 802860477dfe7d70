"""How a Syntec goes along rapid moves, the only ones whose speed is printed (1.5.1)."""

from __future__ import annotations

from amp_studio.sim import BoundMachine, PathLimit, PathRules

from .law_facts import ids

ASSUMED = (
    "No axis passes its Max rapid travel feedrate (1.5.1).",
    "ASSUMED: every rapid move begins and ends at rest, in a straight line.",
)


def path_rules(machine: BoundMachine) -> PathRules:
    """Return the rules of a file; raises SimulationError naming what is missing."""
    speeds, ramps = {}, {}
    for axis in machine.fitted:
        law, read = machine.axis(axis), machine.read(axis)
        letter = machine.letter(axis) or axis
        own = read.optional(ids.axis_acceleration)
        named = (ids.acceleration_time, "") if own is None else (ids.axis_acceleration, axis)
        speeds[letter] = PathLimit(law.feedrate or 0.0, (ids.feed_rapid, axis))
        ramps[letter] = PathLimit(law.ramps["linear"].acceleration or 0.0, named)
    return PathRules(axis_speed=speeds, axis_acceleration=ramps, rapid_rests=True, assumptions=ASSUMED)
