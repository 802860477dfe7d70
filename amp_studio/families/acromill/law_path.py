"""How an AcroMill goes along the path of a program (pages 26 to 33, 61 and 74)."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from amp_studio.sim import (
    BoundMachine,
    CornerRule,
    Corners,
    PathLimit,
    PathRows,
    PathRules,
    SimulationError,
    row_sums,
)

from .law_facts import ids

ASSUMED = (
    "ASSUMED: Master ACC/DEC and the speeds are those along the path (page 74 prints no other).",
    (
        "ASSUMED: the angle of Acute Angle1 and 2 is that by which the direction changes; from Angle1 on a"
        " corner of G62 is passed at Min Corner Speed, from Angle2 on at rest. The shape between is not"
        " printed (page 61)."
    ),
    (
        "ASSUMED: Forward Threshold is how many blocks beside the present one are known (page 61); the blocks"
        " that are calculated before the start (DripFeed Threshold) are there in time."
    ),
)


def path_rules(machine: BoundMachine) -> PathRules:
    """Return the rules of a file; raises SimulationError naming what is missing."""
    read = machine.parameters

    def limit(name: str, scale: float = 1.0) -> PathLimit | None:
        value = read.optional(name, everywhere=True)
        if value is None:
            return None
        if not 0.0 <= value < 1e12:
            raise SimulationError(f"{name} is {value:g}; it must not be negative", name)
        return PathLimit(value * scale, (name, ""))

    def present_ones(*limits: PathLimit | None) -> tuple[PathLimit, ...]:
        return tuple(each for each in limits if each is not None)

    minute = 1.0 / 60.0
    highest, rapid = limit(ids.max_machine, minute), limit(ids.speeds_rapid, minute)
    blocks = limit(ids.forward_threshold)
    return PathRules(
        feed=present_ones(highest),
        rapid=present_ones(rapid, highest),
        feed_acceleration=present_ones(limit(ids.feed_acc_dec)),
        rapid_acceleration=present_ones(limit(ids.rapid_acc_dec)),
        corner=_corner(limit(ids.acute_angle_1), limit(ids.acute_angle_2), limit(ids.min_corner, minute)),
        # The block that is being made counts as known too.
        look_ahead=PathLimit(blocks.value + 1.0, blocks.param) if blocks else None,
        rapid_rests=True,
        waits=True,
        stop=PathLimit(0.0, (ids.inposition_band, ""), "in position"),
        assumptions=ASSUMED,
    )


def _corner(first: PathLimit | None, second: PathLimit | None, slow: PathLimit | None) -> CornerRule:
    """Return the rule of the corners of G62; an angle of 0 is off (page 61)."""

    def rule(corners: Corners) -> Sequence[tuple[PathLimit, PathRows]]:
        # Clipped: directions of length 1 can give a hair more, of which there is no arccos.
        cosine = np.clip(row_sums(corners.before * corners.after), -1.0, 1.0)
        turned = np.degrees(np.arccos(cosine))
        found = []
        if first is not None and slow is not None and first.value > 0.0:
            reached = corners.slow & (turned >= first.value)
            found.append((slow, np.where(reached, slow.value, math.inf)))
        if second is not None and second.value > 0.0:
            reached = corners.slow & (turned >= second.value)
            found.append((second, np.where(reached, 0.0, math.inf)))
        return found

    return rule
