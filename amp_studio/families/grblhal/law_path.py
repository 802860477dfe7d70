"""How a grblHAL goes along the path of a program (planner.c, motion_control.c of the core)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from amp_studio.sim import BoundMachine, CornerRule, Corners, PathLimit, PathRows, PathRules, row_sums

from .law_facts import MOTION, ids

_STRAIGHT = 0.999999
"""Cosine from which two directions are one, or opposite (plan_buffer_line)."""
ASSUMED = (
    (
        "Corners, limits of the axes, pieces of arcs and the blocks known ahead are those of planner.c and"
        " motion_control.c; ASSUMED: the program comes as fast as it is needed."
    ),
    "ASSUMED: no build option for jerk, backlash or another machine than one with straight axes is on.",
)


def path_rules(machine: BoundMachine) -> PathRules:
    """Return the rules of a file; raises SimulationError naming what is missing."""
    read = machine.parameters
    speeds, accelerations = {}, {}
    for axis in machine.fitted:
        values, letter = machine.read(axis), machine.letter(axis) or axis
        speeds[letter] = PathLimit(values.number(ids.max_rate) / 60.0, (ids.max_rate, axis))
        acceleration = values.number(ids.axis_acceleration)
        accelerations[letter] = PathLimit(acceleration, (ids.axis_acceleration, axis))
    deviation = PathLimit(read.number(ids.junction_deviation, everywhere=True), (ids.junction_deviation, ""))
    blocks = read.optional(ids.planner_blocks, everywhere=True)
    return PathRules(
        axis_speed=speeds,
        axis_acceleration=accelerations,
        corner=_corner(deviation, accelerations),
        chord=PathLimit(read.number(ids.arc_tolerance, everywhere=True), (ids.arc_tolerance, "")),
        look_ahead=PathLimit(blocks or MOTION.value("planner_blocks"), (ids.planner_blocks, "")),
        assumptions=ASSUMED,
    )


def _corner(deviation: PathLimit, accelerations: Mapping[str, PathLimit]) -> CornerRule:
    """Return the rule of junction deviation: the speed of a circle that is so far from the corner, at what
    the axes can accelerate across it.
    """

    def rule(corners: Corners) -> Sequence[tuple[PathLimit, PathRows]]:
        cosine = -row_sums(corners.before * corners.after)
        across = corners.after - corners.before
        size = np.sqrt(row_sums(across * across))
        with np.errstate(divide="ignore", invalid="ignore"):
            bound = np.full(len(size), np.inf)
            for n, axis in enumerate(corners.axes):
                unit = np.abs(across[:, n] / size)
                np.minimum(bound, accelerations[axis].value / unit, out=bound, where=unit > 0.0)
            # Half the angle by its sine, without an arc function (half-angle formula).
            half = np.sqrt(0.5 * (1.0 - cosine))
            speed = np.sqrt(bound * deviation.value * half / (1.0 - half))
        # ``cosine`` is of the angle inside the corner: 1 is a reversal, -1 straight on, where 1 - half is
        # 0.
        speed[cosine > _STRAIGHT] = 0.0
        speed[cosine < -_STRAIGHT] = np.inf
        return ((deviation, speed),)

    return rule
