"""Scenario `hard-stop`: a 9/PC feeds an axis against a fixed stop until its torque is that of Hard Stop
Detection Torque, and goes on pressing with Hard Stop Holding Torque (G24, 7-65 and 7-66).

What decides whether the stop is found at all: the torque limits, which the detection must not exceed, and
Excess Error, as the following error grows while the axis does not move. How the control compares the torque
is not printed: here at each row.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from amp_studio.sim import (
    Alarm,
    AxisLaw,
    BoundMachine,
    Figure,
    Motion,
    RunEnd,
    Scenario,
    ScenarioSettings,
    SimulationError,
    Trace,
    above_zero,
    alarms_of,
    assumptions,
    column_units,
    end_of,
    move,
    per_minute,
    refuse_unknown,
    run_axis,
)

from .law_facts import ids

_SETTINGS = {
    "move.feedrate": "feedrate against the stop (mm/min or deg/min); default: 100",
    "stop.stiffness": "torque for 1 mm or 1 deg into the stop (% of rated torque); default: 1000",
}
_FEEDRATE, _STIFFNESS = 100.0, 1000.0
_TOUCHING = (
    "The axis begins at the stop, which is a spring without friction: what the axis does before, and that a"
    " stop can be hit, is not in it."
)
_ASSUMED_STOP = (
    "ASSUMED: 100 % of rated torque press the axis 0.1 mm or deg into the stop (set stop.stiffness)."
)
_NOT_FOUND = "NO HARD STOP"
"""Ours: what a 9/PC shows where G24 finds no stop is not printed in this manual."""
_FARTHER = 3.0
"""Ways to the detection that are commanded, at most."""
_LONGEST = 30.0
"""s"""


def _run_hard_stop(machine: BoundMachine, settings: ScenarioSettings) -> Trace:
    """Feed one axis against a stop; raises SimulationError for impossible settings and torques that are not
    set.
    """
    refuse_unknown(settings, _SETTINGS)
    axis = machine.axis(machine.one_chosen("hard-stop"))
    read = machine.read(axis.axis)
    detection, holding = read.number(ids.hard_stop_detection), read.number(ids.hard_stop_holding)
    if axis.machine.velocity_per_output > 0.0:
        raise SimulationError("The 9/PC must close the velocity loop for feed to hard stop (7-65)")
    speed = (above_zero(settings, "move.feedrate") or _FEEDRATE) / 60.0
    given = above_zero(settings, "stop.stiffness")
    stiffness = given or _STIFFNESS
    motion = _pressed(axis, detection, stiffness, speed)
    torque = np.abs(motion.columns["torque"])
    found = np.flatnonzero(torque >= detection)
    row = int(found[0]) if found.size else None
    # An alarm after the detection is none: the feed has ended by then.
    alarms = alarms_of(axis, motion) if row is None else ()
    if row is not None:  # there the control ends the feed: what was commanded beyond is not done
        torque = torque[: row + 1]
    elif not alarms:
        text = (
            f"The torque ends at {torque.max():.0f} %, below Hard Stop Detection Torque, {detection:g} %"
            " (7-65): the stop is never found"
        )
        alarms = (Alarm(_NOT_FOUND, float(motion.columns["time_s"][-1]), text),)
    return Trace(
        scenario="hard-stop",
        axis=axis.axis,
        model=axis.title,
        columns={name: column[: torque.size] for name, column in per_minute(motion.columns).items()},
        units=column_units(axis),
        result=_figures(axis, motion, row, (detection, holding, stiffness)),
        alarms=alarms,
        assumptions=(_TOUCHING, *(() if given else (_ASSUMED_STOP,)), *assumptions(axis)),
        limits={name: (level, axis.unit) for name, level in axis.limits.items()},
        move={"move.feedrate": speed * 60.0, "stop.stiffness": stiffness},
    )


def _pressed(axis: AxisLaw, detection: float, stiffness: float, speed: float) -> Motion:
    """Move from the stop on, farther than the detection needs with the following error that this takes."""
    against = replace(axis, machine=replace(axis.machine, spring=stiffness), after=None)
    # The following error is part of the way: the axis is late by it while it presses.
    way = _FARTHER * (detection / stiffness + max(axis.limits.values(), default=1.0))
    ramp = next(iter(axis.ramps.values()))
    profile = move(min(way, speed * _LONGEST), speed, ramp)
    return run_axis(against, profile, RunEnd(end_of(profile)))


def _figures(
    axis: AxisLaw, motion: Motion, row: int | None, of_stop: tuple[float, float, float]
) -> dict[str, Figure]:
    """Return what the run found; ``row`` is the one in which the stop was detected."""
    detection, holding, stiffness = of_stop
    columns, unit = motion.columns, axis.unit

    def at(name: str) -> float | None:
        return None if row is None else float(columns[name][row])

    return {
        "detection_torque": (detection, "%"),
        "holding_torque": (holding, "%"),
        "time": (at("time_s"), "s"),
        "following_error": (at("following_error"), unit),
        "pressed_in": (at("position"), unit),
        "held_in": (None if row is None else holding / stiffness, unit),
        "peak_torque": (float(np.abs(columns["torque"][: None if row is None else row + 1]).max()), "%"),
    }


SCENARIO = Scenario(
    "hard-stop",
    "An axis is fed against a fixed stop until its torque finds it (G24)",
    _SETTINGS,
    _run_hard_stop,
    gains=False,
    of_machine=True,
    part="probing",
    checked=("detection_torque", "following_error", "pressed_in"),
)
