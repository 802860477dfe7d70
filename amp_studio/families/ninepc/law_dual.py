"""Dual axes: the orders of the master of a group move all of it, and its slowest member counts for all
(chapter 31).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

from amp_studio.sim import AxisLaw, AxisParameters, Ramp

from .law_facts import MOTION, ids
from .law_reading import if_set

SLOWEST = (
    "The axis is in a dual axis group with master {0}: rapid, cutting feedrate, ramps and velocity step are"
    " those of its slowest member, though one is parked or the group decoupled (31-2)."
)


def group_of(read: AxisParameters) -> tuple[AxisParameters, ...]:
    """Return the axes of the dual group of an axis, its master first (31-3); () for an independent axis."""
    group = read.value(ids.dual_group)
    if group in (None, "independent"):
        return ()
    found = [axis for axis in MOTION.axes if read.value(ids.dual_group, at=axis) == group]
    return tuple(read if axis == read.axis else read.of(axis) for axis in found) if len(found) > 1 else ()


def slowest(read: AxisParameters, parameter: str) -> AxisParameters:
    """Return the values of the member whose figure counts for an axis: the least one that is above 0."""
    return min(group_of(read) or (read,), key=lambda each: if_set(each, parameter) or math.inf)


def slower(ramps: Mapping[str, Ramp], others: Mapping[str, Ramp]) -> dict[str, Ramp]:
    """Return the ramps of one axis, each no steeper than that of another."""
    return {kind: _slower(ramp, others.get(kind, ramp)) for kind, ramp in ramps.items()}


def grouped(law: AxisLaw, read: AxisParameters) -> AxisLaw:
    """Return a member of a dual group with what moves it; any other axis as it is."""
    group = group_of(read)
    if not group:
        return law
    master = group[0]
    note = SLOWEST.format(master.value(ids.axis_name) or master.axis)
    ordered_by = None if master.axis == read.axis else (master.axis, "31-3")
    return replace(law, ordered_by=law.ordered_by or ordered_by, assumptions=(*law.assumptions, note))


def _slower(ramp: Ramp, other: Ramp) -> Ramp:
    """Return the ramp that both axes of a pair can follow."""
    # 0 is no ramp: the other one is slower.
    return replace(
        ramp,
        acceleration=_least(ramp.acceleration, other.acceleration),
        deceleration=_least(ramp.deceleration, other.deceleration),
        jerk=_least(ramp.jerk, other.jerk),
        velocity_step=_least(ramp.velocity_step, other.velocity_step),
    )


def _least(*figures: float) -> float:
    return min((figure for figure in figures if figure > 0.0), default=0.0)
