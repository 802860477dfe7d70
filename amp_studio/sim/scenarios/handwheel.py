"""Scenario `handwheel`: an axis driven by turns of a handwheel: how far a mark moves it, how fast it may go,
and how long it goes on when the wheel has stopped.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import AxisLaw, BoundMachine
from amp_studio.sim.rounding import page_text, value_text
from amp_studio.sim.scenario import Scenario, ScenarioSettings, above_zero, number, refuse_unknown
from amp_studio.sim.trace import Figure, Trace

from .step import SCENARIO as STEP

_SETTINGS = {
    "move.turns": "turns of the wheel, with their sign; default: 1",
    "move.rate": "turns of the wheel in a second; default: 1",
    "move.marks": "marks of the wheel in a turn; default: that of the file, or 100, assumed",
    "move.wheel": "which wheel, by its number; default: the first",
}
_MARKS = 100.0
MAX_TURNS, FASTEST = 1000.0, 100.0
_KEPT = (
    "ASSUMED: marks that come faster than the axis may go are kept, so that it goes on after the wheel"
    " has stopped; no page prints whether they are lost."
)
_EVEN = "ASSUMED: the wheel is turned evenly, from its first mark to its last one."
_HUNDRED = "ASSUMED: a wheel of 100 marks; move.marks gives another."


def _run_handwheel(machine: BoundMachine, settings: ScenarioSettings) -> Trace:
    """Turn the wheel; raises SimulationError where the axis has none."""
    refuse_unknown(settings, _SETTINGS)
    axis = machine.axis(machine.one_chosen("handwheel"))
    if axis.handwheel is None:
        raise SimulationError("No page of this family prints how a handwheel moves an axis")
    given = settings.get("move.wheel")
    wheel = axis.handwheel("" if given is None else f"{given:g}" if isinstance(given, float) else str(given))
    marks = above_zero(settings, "move.marks", 1e6)
    turns, rate = number(settings, "move.turns"), above_zero(settings, "move.rate", FASTEST) or 1.0
    turns = 1.0 if turns is None else turns
    if not 0.0 < abs(turns) <= MAX_TURNS:
        raise SimulationError(
            f"move.turns is {turns:g}; it must not be 0, and {MAX_TURNS:g} at most", "move.turns"
        )
    counted = marks or wheel.marks or _MARKS
    distance = turns * counted * wheel.step
    by_wheel = rate * counted * abs(wheel.step)
    feedrate = min(by_wheel, wheel.fastest)
    ramp = wheel.ramp or (axis.manual_ramp(False) if axis.manual_ramp else next(iter(axis.ramps.values())))
    trace = STEP.run(
        replace(axis, ramps={ramp.kind: ramp}), {"move.distance": distance, "move.feedrate": feedrate * 60.0}
    )
    notes = (*wheel.notes, _EVEN, *(() if marks or wheel.marks else (_HUNDRED,)))
    if by_wheel > wheel.fastest:
        fastest = value_text(wheel.fastest * 60.0, f"{axis.unit}/min")
        notes = (*notes, f"The wheel asks for more than {fastest} ({page_text(wheel.page)}).", _KEPT)
    return replace(
        trace,
        scenario="handwheel",
        result={**_figures(axis, trace, wheel.step, by_wheel, abs(turns) / rate), **_seen(trace)},
        assumptions=(*notes, *trace.assumptions),
        move={"move.turns": turns, "move.rate": rate},
    )


def _figures(axis: AxisLaw, trace: Trace, step: float, by_wheel: float, lasts: float) -> dict[str, Figure]:
    """Return the figures of the wheel, which stops after ``lasts`` s."""
    time, position = trace.columns["time_s"], trace.columns["position"]
    ended = trace.result["in_position_time"][0]
    left = trace.result["distance"][0] or 0.0
    behind = abs(left - float(np.interp(lasts, time, position)))
    return {
        "step": (abs(step), axis.unit),
        "distance": (left, axis.unit),
        "wheel_feedrate": (by_wheel * 60.0, f"{axis.unit}/min"),
        "wheel_time": (lasts, "s"),
        "behind": (behind, axis.unit),
        "runs_on": (None if ended is None else max(ended - lasts, 0.0), "s"),
    }


def _seen(trace: Trace) -> dict[str, Figure]:
    names = ("feedrate", "peak_following_error", "overshoot", "peak_torque")
    return {name: trace.result[name] for name in names if not math.isnan(trace.result[name][0] or 0.0)}


SCENARIO = Scenario(
    "handwheel",
    "An axis driven by turns of a handwheel",
    _SETTINGS,
    _run_handwheel,
    gains=False,
    of_machine=True,
    checked=("step", "feedrate", "behind", "runs_on"),
    once=True,
    part="travel",
)
