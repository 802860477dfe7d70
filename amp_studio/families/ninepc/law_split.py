"""Split axes: a slave servo that goes with its master (chapter 32)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING

from amp_studio.sim import AlarmText, AxisLaw, AxisParameters, Leader, SimulationError, value_text

from . import law_samples as samples
from .law_facts import MOTION, ids

SETS = ((ids.deskew_master, ids.deskew_slave, "1"), (ids.master_2, ids.slave_2, "2"))
if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    Positions = npt.NDArray[np.float64]
    Leads = Mapping[str, Positions]

SLAVE = (
    "This servo is the slave of axis {0}: command, ramps and feedrates are those of its master (32-4), whose"
    " motion is simulated first. Its gain is multiplied by 1 + Deskew Gain x skew; that the gain changes in"
    " proportion to the skew is printed (32-9), its unit, 1/{1}, is ASSUMED."
)
LOOSE = (
    "ASSUMED: model.coupling = 0 % for 1 {0}. The mechanics join the two servos of the split axis with no"
    " force, and each is moved for itself; set the torque that a skew brings."
)
JOINED = (
    "The loads of both servos of the split axis pull at each other by model.coupling; each is computed with"
    " the motion of the other until none changes."
)
MASTER = "This servo is the master of a split axis (32-4); simulate axis {0} to see the skew."
_OWN_COUPLING = "model.coupling"
_STIFFEST = 1e9
ROUNDS = 80
"""Runs of both servos until neither changes any more."""
_KEPT = 20
"""Motions that are mixed."""
_SAME = 0.2
"""Counts that they may still change."""


@dataclass(frozen=True)
class Slave:
    """The pair of a slave: the axis of its master, Deskew Gain in 1/u, Excess Skew Limit in u."""

    master: str
    gain: float
    limit: float
    limit_called: str
    """What a sentence calls Excess Skew Limit."""


def slave_of(read: AxisParameters) -> Slave | None:
    """Return the pair of an axis that is a slave, None for any other;
    raises SimulationError for an impossible pair.
    """
    own = read.value(ids.axis_name)
    for master, slave, place in SETS:
        names = read.value(master, at=place), read.value(slave, at=place)
        if own is None or names[1] != own or names[0] in (None, "none", own):
            continue
        gain, limit = (_not_negative(read, name, place) for name in (ids.deskew_gain, ids.skew_limit))
        called = read.called(ids.skew_limit, at=place)
        return Slave(_axis_named(read, str(names[0]), master, place), gain, limit, called)
    return None


def slave_named(read: AxisParameters) -> str | None:
    """Return the axis of the slave of a master, None for any other axis."""
    own = read.value(ids.axis_name)
    for master, slave, place in SETS:
        if own is not None and own == read.value(master, at=place):
            name = str(read.value(slave, at=place) or "none")
            return None if name == "none" else _axis_named(read, name, slave, place)
    return None


def coupling_of(read: AxisParameters) -> float:
    """Return the torque in % that a skew of 1 u brings on both loads, 0 for none."""
    value = read.optional(_OWN_COUPLING) or 0.0
    if not 0.0 <= value <= _STIFFEST:
        raise SimulationError(f"{_OWN_COUPLING} is {value:g}; it must be 0 to {_STIFFEST:g}", _OWN_COUPLING)
    return value


def coupled(law: AxisLaw, slave: Slave, master: AxisLaw, stiffness: float) -> AxisLaw:
    """Return the slave with its deskew gain and skew limit; it goes by the motion of its master."""
    law = _deskewed(law, slave)
    return replace(law, after=partial(_with_master, master, stiffness))


def leading(law: AxisLaw, slave: AxisLaw, own: Slave, stiffness: float) -> AxisLaw:
    """Return a master that feels its slave."""
    return replace(law, after=partial(_with_slave, _deskewed(slave, own), stiffness))


def _deskewed(law: AxisLaw, slave: Slave) -> AxisLaw:
    p = list(law.parameters)
    p[samples.DESKEW], p[samples.SKEW_LIMIT] = slave.gain, slave.limit
    text = (
        f"Skew above {value_text(slave.limit, law.unit)} ({slave.limit_called}): the control goes into E-STOP"
    )
    alarms = {**law.alarms, int(samples.EXCESS_SKEW_ALARM): AlarmText("EXCESS SKEW", text)}
    return replace(law, parameters=p, alarms=alarms)


def _with_master(master: AxisLaw, stiffness: float, axis: AxisLaw, run: Leader) -> AxisLaw:
    """Return a slave with the following errors of its master, servo sample by servo sample,
    and the force between both.
    """
    if not math.isfinite(axis.parameters[samples.EXCESS]):
        return replace(axis, after=None)  # a swept sine: the loop of the slave alone
    if stiffness:
        return _joined(master, axis, stiffness, run)[1]
    return _following(axis, run(master))


def _with_slave(slave: AxisLaw, stiffness: float, axis: AxisLaw, run: Leader) -> AxisLaw:
    """Return a master with the force of its slave."""
    alone = replace(axis, after=None)
    if not math.isfinite(axis.parameters[samples.EXCESS]):
        return alone
    return _joined(alone, slave, stiffness, run)[0]


def _following(slave: AxisLaw, leads: Leads) -> AxisLaw:
    """Return the slave with the following errors of its master."""
    errors = leads["control_following_error"]
    p = [*slave.parameters[: samples.MASTER], *errors]
    p[samples.MASTER_SAMPLES] = float(len(errors))
    return replace(slave, parameters=p, after=None)


def _joined(master: AxisLaw, slave: AxisLaw, stiffness: float, run: Leader) -> tuple[AxisLaw, AxisLaw]:
    """Return both servos with the force of the other on their loads: each in turn with the last motion of the
    other, until neither changes (waveform relaxation: E. Lelarasmee, A. Ruehli, A. Sangiovanni-Vincentelli,
    1982).
    """

    def pulled(axis: AxisLaw, other: Positions) -> AxisLaw:
        # The force is stiffness x (other - own): the own part is a spring to zero, the other's a push over
        # time.
        spring = axis.machine.spring + stiffness
        push = (stiffness * other).tolist()
        return replace(axis, machine=replace(axis.machine, spring=spring), push=push)

    def answer(positions: Positions) -> tuple[AxisLaw, AxisLaw, Positions]:
        """Return both servos with a motion of the slave given, and the one that it answers with."""
        # The first round has no motion of the slave yet: the master runs free.
        feels = pulled(master, positions) if positions.size else master
        leads = run(feels)
        goes = pulled(_following(slave, leads), leads["position"])
        return feels, goes, run(goes)["position"]

    import numpy as np  # most axes have one servo

    same = _SAME * max(master.machine.position_count, 1e-6)
    given: list[Positions] = []
    answers: list[Positions] = []
    positions = np.zeros(0)
    for _ in range(ROUNDS):
        feels, goes, answered = answer(positions)
        if positions.size:
            # A motion ends when the axis rests, so both may be of different length.
            length = min(len(positions), len(answered))
            if float(np.max(np.abs(positions[:length] - answered[:length]))) < same:
                return feels, goes
            # Older ones are of a problem that was farther away, and make the least squares worse.
            given, answers = [*given, positions][-_KEPT:], [*answers, answered][-_KEPT:]
        # The answer alone need not settle where the coupling is stiff: each servo answers too much.
        positions = _mixed(given, answers) if len(given) > 1 else answered
    raise SimulationError(
        f"The coupling of {stiffness:g} % for 1 {master.unit} is too stiff for these loops to be computed:"
        " give a smaller one",
        _OWN_COUPLING,
    )


def _mixed(given: list[Positions], answers: list[Positions]) -> Positions:
    """Return the mixture of the last answers whose error is least (D. G. Anderson, Journal of the ACM 12,
    1965).
    """
    import numpy as np

    length = max(map(len, [*given, *answers]))
    g, a = (
        # Ended early is at rest: the last position goes on.
        np.array([np.pad(each, (0, length - len(each)), "edge") for each in kept])
        for kept in (given, answers)
    )
    errors = a - g
    shares = np.linalg.lstsq((errors[1:] - errors[:-1]).T, errors[-1], rcond=1e-12)[0]
    return np.asarray(a[-1] - shares @ (a[1:] - a[:-1]))


def _axis_named(read: AxisParameters, name: str, parameter: str, place: str) -> str:
    for axis in MOTION.axes:
        if read.value(ids.axis_name, at=axis) == name:
            return axis
    raise SimulationError(f"{read.called(parameter, at=place)} is '{name}', the name of no axis", parameter)


def _not_negative(read: AxisParameters, name: str, place: str) -> float:
    """Return a figure of a set; a gain that is not set is 0, the default, which switches it off (32-9,
    37-3).
    """
    value = (read.optional(name, at=place) or 0.0) if name == ids.deskew_gain else read.number(name, at=place)
    if not 0.0 <= value < math.inf:
        raise SimulationError(f"{read.called(name, at=place)} is {value:g}; it must not be negative", name)
    return value
