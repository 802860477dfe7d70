"""Split axes: a slave servo that goes with its master (chapter 32)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import partial

from amp_studio.sim.axis_parameters import AxisParameters
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import AlarmText, AxisLaw, Leader
from amp_studio.sim.rounding import shown

from . import law_samples as samples

SETS = (("deskew.master", "deskew.slave", "1"), ("deskew.master_2", "deskew.slave_2", "2"))
GAIN, LIMIT, NAME = "deskew.gain", "deskew.skew_limit", "axis.name"
AXES = tuple(str(n) for n in range(1, 9))

SLAVE = (
    "This servo is the slave of axis {0}: command, ramps and feedrates are those of its master (32-4), whose motion is simulated first. Its gain is"
    " multiplied by 1 + Deskew Gain x skew; that the gain changes in proportion to the skew is printed (32-9), its unit, 1/{1}, is ASSUMED. The"
    " mechanics join the two servos with no force, and a master does not feel its slave."
)
MASTER = "This servo is the master of a split axis (32-4); simulate axis {0} to see the skew."


@dataclass(frozen=True)
class Slave:
    """The pair of a slave: the axis of its master, Deskew Gain in 1/u, Excess Skew Limit in u."""

    master: str
    gain: float
    limit: float


def slave_of(read: AxisParameters) -> Slave | None:
    """Return the pair of an axis that is a slave, None for any other; raises SimulationError for an impossible pair."""
    own = read.value(NAME)
    for master, slave, place in SETS:
        names = read.value(master, at=place), read.value(slave, at=place)
        if own is None or names[1] != own or names[0] in (None, "none", own):
            continue
        gain, limit = (_not_negative(read, name, place) for name in (GAIN, LIMIT))
        return Slave(_axis_named(read, str(names[0]), master), gain, limit)
    return None


def slave_named(read: AxisParameters) -> str | None:
    """Return the axis of the slave of a master, None for any other axis."""
    own = read.value(NAME)
    for master, slave, place in SETS:
        if own is not None and own == read.value(master, at=place):
            name = str(read.value(slave, at=place) or "none")
            return None if name == "none" else _axis_named(read, name, slave)
    return None


def coupled(law: AxisLaw, slave: Slave, master: AxisLaw) -> AxisLaw:
    """Return the slave with its deskew gain and skew limit; it goes by the following errors of its master."""
    p = list(law.parameters)
    p[samples.DESKEW], p[samples.SKEW_LIMIT] = slave.gain, slave.limit
    text = f"Skew above {shown(slave.limit, law.unit)} ({LIMIT}): the control goes into E-STOP"
    alarms = {**law.alarms, int(samples.EXCESS_SKEW_ALARM): AlarmText("EXCESS SKEW", text)}
    return replace(law, parameters=p, alarms=alarms, after=partial(_with_master, master))


def _with_master(master: AxisLaw, axis: AxisLaw, run: Leader) -> AxisLaw:
    """Return the axis with the following errors of its master, servo sample by servo sample."""
    if not math.isfinite(axis.parameters[samples.EXCESS]):
        return replace(axis, after=None)  # a swept sine: the loop of the slave alone
    errors = run(master)["control_following_error"]
    p = [*axis.parameters[: samples.MASTER], *errors]
    p[samples.MASTER_SAMPLES] = float(len(errors))
    return replace(axis, parameters=p, after=None)


def _axis_named(read: AxisParameters, name: str, parameter: str) -> str:
    for axis in AXES:
        if read.value(NAME, at=axis) == name:
            return axis
    raise SimulationError(f"{parameter} is '{name}', the name of no axis", parameter)


def _not_negative(read: AxisParameters, name: str, place: str) -> float:
    """Return a figure of a set; a gain that is not set is 0, the default, which switches it off (32-9, 37-3)."""
    value = (read.optional(name, at=place) or 0.0) if name == GAIN else read.number(name, at=place)
    if not 0.0 <= value < math.inf:
        raise SimulationError(f"{name}@{place} is {value:g}; it must not be negative", name)
    return value
