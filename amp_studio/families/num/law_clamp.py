"""Scenario `clamp`: an axis with a clamp, from M11 to M10: the control waits for the PLC before it moves the
axis and before the program goes on (functional diagram, 4-23).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from amp_studio.sim import (
    STEP,
    Alarm,
    AxisLaw,
    BoundMachine,
    Figure,
    Scenario,
    ScenarioSettings,
    SimulationError,
    Trace,
    above_zero,
    number,
    refuse_unknown,
)

from .law_facts import ids

_SETTINGS = {
    "move.distance": (
        "distance of the move, with its sign (mm or deg); default: as far as it needs to reach its speed"
    ),
    "move.feedrate": "feedrate of the move (mm/min or deg/min); default: the rapid feedrate",
    "move.timeout": "the internal timeout before the clamp is opened (s); default: 0",
    "move.unclamping": (
        "time from there until the PLC reports the end of unclamping, CRM (s); default: 0.2, assumed"
    ),
    "move.clamping": (
        "time from the end of the movement until it reports clamping, CRM (s); default: 0.2, assumed"
    ),
    "move.crm": "none for a PLC that never reports",
}
_LONGEST = 60.0
"""s"""
_TAKES = 0.2
_SEQUENCE = (
    "Internal timeout, wait for CRM, unclamping (CRM = 0), CRM = 1, movement, deceleration, end of"
    " movement, wait for CRM, clamping, CRM = 1, program continued (4-23)."
)
_TIMES = "ASSUMED: {0}: no page prints how long the timeout and a clamp take."
END = (
    "ASSUMED: the end of the movement, after which the axis is clamped, is where it comes into its"
    " in-position window (P22)."
)
_WAITING = "WAIT FOR CRM"
"""Ours: no page prints what a NUM shows while it waits."""


def _run_clamp(machine: BoundMachine, settings: ScenarioSettings) -> Trace:
    """Open the clamp of an axis, move it and close the clamp; raises SimulationError for one without."""
    refuse_unknown(settings, _SETTINGS)
    axis = machine.axis(_clamped(machine))
    before, opening, closing = _times(settings)
    if settings.get("move.crm") not in (None, "none"):
        raise SimulationError("move.crm must be none, or be left out", "move.crm")
    move = {name: settings[name] for name in ("move.distance", "move.feedrate") if name in settings}
    trace = STEP.run(axis, move)
    ended = trace.result["in_position_time"][0]
    starts = before + opening
    is_alone = settings.get("move.crm") == "none"
    alarms = trace.alarms
    if is_alone:
        text = (
            "The PLC reports no end of unclamping (CRM): the axis gets no reference and waits for ever (4-23)"
        )
        alarms = (Alarm(_WAITING, before, text),)
    notes = (_SEQUENCE, END, _TIMES.format(f"{before:g} s, {opening:g} s to open and {closing:g} s to close"))
    return replace(
        trace,
        scenario="clamp",
        columns=_columns(trace, starts, ended, closing, is_alone=is_alone),
        units={**trace.units, "clamped": ""},
        result=_figures(axis, trace, starts, None if is_alone or alarms else ended, closing),
        alarms=alarms,
        assumptions=(*notes, *trace.assumptions),
    )


def _clamped(machine: BoundMachine) -> str:
    """Return the axis that is asked for, else the first one with a clamp; raises SimulationError."""
    word = int(machine.parameters.optional(ids.axes_clamped) or 0.0)
    with_clamp = [name for name in machine.fitted if word >> int(name) & 1]
    chosen = machine.one_chosen("clamp")
    if chosen is not None and chosen not in with_clamp:
        raise SimulationError(f"P8 gives axis {chosen} no clamp (4-22)", ids.axes_clamped)
    if not with_clamp:
        raise SimulationError("P8 gives no axis a clamp (4-22)")
    return chosen or with_clamp[0]


def _times(settings: ScenarioSettings) -> tuple[float, float, float]:
    timeout = number(settings, "move.timeout") or 0.0
    if not 0.0 <= timeout <= _LONGEST:
        raise SimulationError(f"move.timeout is {timeout:g}; simulated is 0 to {_LONGEST:g}", "move.timeout")
    opening, closing = (
        above_zero(settings, name, _LONGEST) or _TAKES for name in ("move.unclamping", "move.clamping")
    )
    return timeout, opening, closing


def _columns(
    trace: Trace, starts: float, ended: float | None, closing: float, *, is_alone: bool
) -> dict[str, np.ndarray]:
    """Return the columns of the move behind the time in which the clamp opens, with the clamp beside them."""
    columns = {}
    for name, column in trace.columns.items():
        rest = column[:1] * (0.0 if name == "time_s" else 1.0)
        later = column + starts if name == "time_s" else column
        columns[name] = np.concatenate((rest, rest + (starts if name == "time_s" else 0.0), later))
        if is_alone:
            columns[name] = columns[name][:2]
    time = columns["time_s"]
    closes = np.inf if ended is None else starts + ended + closing
    columns["clamped"] = np.where((time < starts) | (time >= closes), 1.0, 1.0 if is_alone else 0.0)
    return columns


def _figures(
    axis: AxisLaw, trace: Trace, starts: float, ended: float | None, closing: float
) -> dict[str, Figure]:
    """Return the times before, in and after a move of a clamped axis, and the error when it is clamped."""
    time, error = trace.columns["time_s"], np.abs(trace.columns["following_error"])
    return {
        "distance": trace.result["distance"],
        "feedrate": trace.result["feedrate"],
        "time_before": (starts, "s"),
        "motion_time": (ended, "s"),
        "time_after": (closing, "s"),
        "time": (None if ended is None else starts + ended + closing, "s"),
        "error_at_clamping": (None if ended is None else float(np.interp(ended, time, error)), axis.unit),
        "peak_following_error": trace.result["peak_following_error"],
    }


SCENARIO = Scenario(
    "clamp",
    "An axis with a clamp: opened, moved, clamped again (M11, M10)",
    _SETTINGS,
    _run_clamp,
    gains=False,
    of_machine=True,
    checked=("time_before", "motion_time", "time_after", "error_at_clamping"),
    once=True,
    part="travel",
)
