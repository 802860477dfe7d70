"""Scenario `adaptive-feed`: a 9/PC keeps the torque of a cut at that of the G25 block by changing the
feedrate (30-1, 30-2), while the cut becomes harder half way.

What the file decides are the two torque gains and whether the feedrate is ramped (30-3). The cut is in no
file: it is a torque in proportion to the feedrate, which the loops of the axis move against.
"""

from __future__ import annotations

import math
from collections.abc import Generator
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from amp_studio.sim import (
    Alarm,
    AxisLaw,
    BoundMachine,
    Figure,
    GoOrder,
    Machine,
    Motion,
    MovingAxis,
    Ramp,
    Scenario,
    ScenarioSettings,
    Seen,
    SimulationError,
    Trace,
    Watch,
    above_zero,
    alarms_of,
    assumptions,
    column_units,
    per_minute,
    refuse_unknown,
)

from .formulas import feedrate_change_percent
from .law_dual import group_of
from .law_facts import ids
from .law_reading import if_set
from .law_split import slave_named, slave_of

_SETTINGS = {
    "move.feedrate": "programmed feedrate (mm/min or deg/min); default: 500",
    "move.torque": "torque of the G25 block (% of rated torque); default: 30",
    "move.cut_torque": "torque of the cut at the programmed feedrate (% of rated torque); default: 30",
    "move.harder": "how many times that it takes from half way on; default: 1.5",
}
DEFAULTS = {"move.feedrate": 500.0, "move.torque": 30.0, "move.cut_torque": 30.0, "move.harder": 1.5}
_ITERATION, _DURATION = 0.02, 4.0
"""s between two changes of the feedrate, and of the whole run."""
_NEAR = 0.05
"""Share of the torque of the block within which it is reached."""
_NOT_REACHED = Alarm(
    "TORQUE NOT REACHED",
    _DURATION,
    f"The torque does not stay within {100.0 * _NEAR:g} % of that of the block: lower both gains (30-1,"
    " 30-2)",
)
"""Ours: the manual prints no message for it."""
ASSUMED = (
    (
        "ASSUMED: the feedrate is changed each 20 ms by both gains together, and the torque error in % is"
        " summed up at the same moments: neither the interval nor the unit of the integrated error is printed"
        " (30-1, 30-2)."
    ),
    "ASSUMED: the cut is a torque in proportion to the feedrate (move.cut_torque); no file has it.",
)


def _run_adaptive_feed(machine: BoundMachine, settings: ScenarioSettings) -> Trace:
    """Cut with one axis; raises SimulationError for impossible settings and an axis without the feature."""
    refuse_unknown(settings, _SETTINGS)
    axis = machine.axis(machine.one_chosen("adaptive-feed"))
    asked = {name: above_zero(settings, name) or default for name, default in DEFAULTS.items()}
    _refuse(machine, axis)
    motion = _cut(machine, axis, asked)
    result = _figures(axis, motion, asked["move.torque"])
    return Trace(
        scenario="adaptive-feed",
        axis=axis.axis,
        model=axis.title,
        columns=per_minute(motion.columns),
        units=column_units(axis),
        result=result,
        alarms=alarms_of(axis, motion)
        or (() if result["time_off_torque"][0] is not None else (_NOT_REACHED,)),
        assumptions=(*ASSUMED, *assumptions(axis)),
        limits={name: (level, axis.unit) for name, level in axis.limits.items()},
        move=asked,
    )


def _refuse(machine: BoundMachine, axis: AxisLaw) -> None:
    read = machine.read(axis.axis)
    if axis.machine.velocity_per_output > 0.0:
        raise SimulationError("The 9/PC must close the velocity loop for adaptive feed (30-2)")
    if slave_of(read) or slave_named(read) or group_of(read):
        raise SimulationError("An axis that positions more than one servo has no adaptive feed (30-2)")


def _cut(machine: BoundMachine, axis: AxisLaw, asked: dict[str, float]) -> Motion:
    """Return a cut whose feedrate follows the torque; from half of it on the material is harder."""
    read, feed = machine.read(axis.axis), asked["move.feedrate"] / 60.0
    gains = read.number(ids.adaptive_proportional), read.number(ids.adaptive_integral)
    ramp = axis.ramps["linear"] if read.choice(ids.adaptive_ramp) == "yes" else Ramp()

    def cut(harder: float) -> Machine:
        drag = harder * asked["move.cut_torque"] / feed
        return replace(axis.machine, viscous_friction=axis.machine.viscous_friction + drag)

    moving = MovingAxis(replace(axis, machine=cut(max(1.0, asked["move.harder"]))))
    top = if_set(read, ids.max_cutting) / 60.0 or math.inf
    total, velocity, moments = 0.0, feed, round(_DURATION / _ITERATION)
    for n in range(moments):
        if n in (0, moments // 2):
            moving.change(cut(asked["move.harder"] if n else 1.0))
        # An axis at rest would take no torque, and never move again: a thousandth of the feedrate.
        moving.begin(_order(min(max(velocity, 0.001 * feed), top), ramp))
        moving.advance(_ITERATION)
        if moving.is_over:
            break
        error = asked["move.torque"] - abs(moving.torque)
        total += error
        velocity = feed * (1.0 + feedrate_change_percent(error, total, *gains) / 100.0)
    return moving.motion()


def _order(velocity: float, ramp: Ramp) -> Generator[GoOrder, Seen | None, None]:
    yield GoOrder(velocity, ramp, Watch(math.inf, 1.0), 2.0 * _ITERATION * velocity)


def _figures(axis: AxisLaw, motion: Motion, block: float) -> dict[str, Figure]:
    """Return torque and feedrate before and after the cut becomes harder, and how long the torque is off."""
    columns = motion.columns
    cut = slice(0, int(np.searchsorted(columns["time_s"][motion.driven], _DURATION)))  # no rest behind it
    times, torque = columns["time_s"][cut], np.abs(columns["torque"][cut])
    feed = columns["velocity"][cut] * 60.0
    middle = min(int(np.searchsorted(times, _DURATION / 2.0)), len(times) - 1)
    off = np.flatnonzero(np.abs(torque[middle:] - block) > _NEAR * block)
    settled = off.size == 0 or off[-1] < len(torque) - middle - 2
    wait = (float(times[middle + off[-1]] - times[middle]) if off.size else 0.0) if settled else None

    def mean(rows: npt.NDArray[np.float64], last: int) -> float:
        return float(rows[max(last - len(times) // 20, 0) : last].mean())

    return {
        "torque_of_block": (block, "%"),
        "torque_before": (mean(torque, middle), "%"),
        "torque_after": (mean(torque, len(times)), "%"),
        "peak_torque": (float(torque[middle:].max()), "%"),
        "feedrate_before": (mean(feed, middle), f"{axis.unit}/min"),
        "feedrate_after": (mean(feed, len(times)), f"{axis.unit}/min"),
        "time_off_torque": (wait, "s"),
    }


SCENARIO = Scenario(
    "adaptive-feed",
    "A cut becomes harder, and the feedrate follows so that the torque stays that of the block (G25)",
    _SETTINGS,
    _run_adaptive_feed,
    gains=False,
    of_machine=True,
)
