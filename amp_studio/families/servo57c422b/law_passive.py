"""Passive homing of a 57C422B (register 67, page 4-33): nothing moves by it, but the first feedback marker in
any motion gives the axis the position of registers 17 and 18. Here it is a move at the velocity of the file.
"""

from __future__ import annotations

import math

import numpy as np

from amp_studio.sim import (
    STEP,
    Alarm,
    AxisLaw,
    Figure,
    Scenario,
    ScenarioSettings,
    SimulationError,
    Trace,
    above_zero,
    number,
    refuse_unknown,
)

from . import switch_bits as bits
from .law_axis import ModuleAxis
from .law_facts import MOTION, ids

_SETTINGS = {
    "move.distance": "distance of the motion (counts), with its sign; default: one turn and a half",
    "move.marker": "distance from the start to the first marker (counts); default: a quarter turn",
    "move.turn": "from one marker to the next (counts); default: that of an encoder of 1000 lines",
}
_TURNS, _QUARTER = 1.5, 0.25
_NO_MARKER = "NO MARKER"
"""Ours: the module waits on, and no fault is printed for it."""
_WAITS = (
    "The command causes no motion (4-33): the axis is moved by a move here. ASSUMED: the move goes on to the"
    " place where it was going to, and its feedback position is counted from the marker on."
)
LINES = "ASSUMED: an encoder of 1000 lines (page 4-48); move.turn gives another."


def _run_passive_home(axis: AxisLaw, settings: ScenarioSettings) -> Trace:
    """Move over the first marker; raises SimulationError where register 2 uses no feedback marker."""
    refuse_unknown(settings, _SETTINGS)
    assert isinstance(axis, ModuleAxis)
    setup = axis.register(ids.setup_switches)
    if setup is not None and not int(setup) & bits.MARKER:
        raise SimulationError(
            "Register 2 uses no feedback marker (bit 3, inferred): passive homing waits for ever (4-33)",
            ids.setup_switches,
        )
    turn = above_zero(settings, "move.turn") or MOTION.value("marker_distance")
    distance = number(settings, "move.distance")
    distance = _TURNS * turn if distance is None else distance
    sign = math.copysign(1.0, distance)
    marker = _next_marker(number(settings, "move.marker"), turn, sign)
    coordinate = axis.needed(ids.command_position, "it is the position of the marker (page 4-33)")
    trace = STEP.run(axis, {"move.distance": distance})
    position = trace.columns["position"]
    # Times the sign, one comparison serves both directions.
    rows = np.flatnonzero(sign * position >= sign * marker)
    met = bool(rows.size) and not trace.alarms
    alarms = trace.alarms
    if not met and not alarms:
        alarms = (
            Alarm(_NO_MARKER, float(trace.columns["time_s"][-1]), "The motion ends before the next marker"),
        )
    result: dict[str, Figure] = {
        "home_position": (coordinate if met else None, "counts"),
        "home_from_start": (marker if met else None, "counts"),
        "stop_position": (float(position[-1]) - marker + coordinate if met else None, "counts"),
        "time": (float(trace.columns["time_s"][rows[0]]) if met else None, "s"),
        "peak_following_error": trace.result["peak_following_error"],
    }
    notes = (_WAITS, *(() if settings.get("move.turn") else (LINES,)), bits.SWITCHES, *trace.assumptions)
    return Trace(
        scenario="passive-home",
        axis=axis.axis,
        model=axis.title,
        columns=trace.columns,
        units=trace.units,
        result=result,
        alarms=alarms,
        assumptions=notes,
        limits=trace.limits,
    )


def _next_marker(given: float | None, turn: float, sign: float) -> float:
    """Return the first marker in the direction of the motion; they are a turn apart on both sides."""
    first = sign * _QUARTER * turn if given is None else given
    return first + turn * (math.ceil(-first / turn) if sign > 0.0 else math.floor(-first / turn))


SCENARIO = Scenario(
    "passive-home",
    "Passive homing: the first marker in any motion gives the position",
    _SETTINGS,
    _run_passive_home,
    gains=False,
    part="homing",
    checked=("home_position", "time"),
)
