"""How LinuxCNC goes along the path of a program (emccanon.cc, tp.c and blendmath.c of 2.9.8)."""

from __future__ import annotations

from functools import partial

from amp_studio.sim import BoundMachine, PathLimit, PathRules

from .law_blends import PathFigures, shaped
from .law_facts import MOTION, ids

ASSUMED = (
    (
        "Limits of the axes, joined points, rounded corners and changes of direction are those of"
        " emccanon.cc, tp.c and blendmath.c; ASSUMED: moves come as fast as they are needed, and enough of"
        " them are known."
    ),
    "ASSUMED: no spindle is waited for, and no maximum speed was set at the screen.",
)


def path_rules(machine: BoundMachine) -> PathRules:
    """Return the rules of a file; raises SimulationError naming what is missing."""
    read = machine.parameters
    speeds, accelerations = {}, {}
    for axis in machine.fitted:
        values, letter = machine.read(axis), machine.letter(axis) or axis
        speeds[letter] = PathLimit(values.number(ids.axis_max_velocity) / 60.0, (ids.axis_max_velocity, axis))
        accelerations[letter] = PathLimit(values.number(ids.max_acceleration), (ids.max_acceleration, axis))
    whole = read.optional(ids.traj_max_velocity, everywhere=True)
    greatest = () if whole is None else (PathLimit(whole / 60.0, (ids.traj_max_velocity, "")),)
    period = (read.optional(ids.servo_period, everywhere=True) or MOTION.value("servo_period")) * 1e-3
    kink = read.optional(ids.arc_blend_kink, everywhere=True)
    figures = PathFigures(
        speeds,
        accelerations,
        period,
        PathLimit(MOTION.value("kink_ratio") if kink is None else kink, (ids.arc_blend_kink, "")),
        read.optional(ids.max_feed_override, everywhere=True) or 1.0,
        with_arcs=read.value(ids.arc_blend, everywhere=True) not in (False, "no"),
    )
    return PathRules(
        feed=greatest,
        rapid=greatest,
        axis_speed=speeds,
        axis_acceleration=accelerations,
        shape=partial(shaped, figures),
        pause=MOTION.value("cycles_of_a_stop") * period,
        assumptions=ASSUMED,
    )
