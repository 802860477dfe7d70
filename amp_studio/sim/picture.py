"""What a picture of a trace shows: panels with curves, limits and marks, as the room `drawing` draws them.

A time picture has linked axes and a close look at the settling; a frequency picture is a Bode plot,
a circle a ball-bar picture.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from amp_studio.drawing import (
    Curve,
    NamedPlace,
    Picture,
    Ring,
    Scene,
    ShapeSort,
    linked,
    panel_of,
    picture_svg,
    ring_scene,
)
from amp_studio.scenarios import CHARTS

from .identification.recording import SignalRecord
from .loop_picture import nichols, nyquist, tuned
from .rounding import value_text
from .series import Series
from .sweep_picture import sweep_picture
from .trace import Trace

CLOSE = 10.0
"""Inposition bands around the end of a move that a close look at the settling begins with."""
FAR = 1.6
"""A limit below this multiple of the peak is drawn as a line; a higher one is given as text."""


def picture_of(trace: Trace, before: Trace | None = None, chart: str = CHARTS[0]) -> Picture:
    """Return the picture of a trace; ``before`` is drawn under it where it shows the same.

    ``chart`` is how an open loop is drawn, one of CHARTS; every other trace has one picture.
    """
    # Another first column is another kind of picture: time beside frequency has no common axis.
    if before is not None and next(iter(before.columns)) != next(iter(trace.columns)):
        before = None
    return replace(
        _drawn(trace, before, chart),
        title=_title(trace),
        facts=_facts(trace),
        has_alarm=bool(trace.alarms),
        assumed=tuple(a.removeprefix("ASSUMED: ") for a in trace.assumptions if a.startswith("ASSUMED")),
    )


def _drawn(trace: Trace, before: Trace | None, chart: str) -> Picture:
    """Return the picture of the columns that a trace has."""
    if chart != CHARTS[0] and "open_gain_db_model" in trace.columns:
        return nyquist(trace, before) if chart == "nyquist" else nichols(trace, before)
    if "frequency_hz" in trace.columns:
        return _bode(trace, before)
    if "inertia_share" in trace.columns:
        return tuned(trace)
    if "radius_deviation" in trace.columns:
        return _ballbar(trace, before)
    if trace.over:
        return sweep_picture(trace)
    if "predicted_torque" in trace.columns:
        return _fit(trace)
    return _plan(trace) if trace.areas else _motion(trace, before)


def _title(trace: Trace) -> str:
    axis = f", axis {trace.axis_title}" if trace.axis else ""
    names = {"step": ("distance", "feedrate"), "circle": ("radius", "feedrate")}.get(trace.scenario, ())
    figures = [_figure_of(trace, name) for name in names if _has(trace, name)]
    return f"{trace.scenario.capitalize()}{axis}" + (f": {' at '.join(figures)}" if figures else "")


_NAMED = {
    "steady_following_error": "following error {}",
    "overshoot": "overshoot {}",
    "settle_time": "settled {} after the command",
    "peak_torque": "peak torque {}",
    "peak_output": "peak output {}",
    "bandwidth": "bandwidth {}",
    "phase_margin": "phase margin {}",
    "gain_margin": "gain margin {}",
    "radius_error": "radius error {}",
    "predicted_radius_error": "predicted {}",
    "reversal_spike": "reversal spike {}",
    "home_position": "home position {}",
    "acceleration_per_output": "acceleration {} for one unit of torque",
    "coulomb_friction": "dry friction {}",
    "gravity": "gravity {}",
    "r_squared": "r² {}",
    "overrun": "stops {} behind the limit",
    "time": "after {}",
}


def _facts(trace: Trace) -> tuple[str, ...]:
    facts = [words.format(_figure_of(trace, name)) for name, words in _NAMED.items() if _has(trace, name)]
    return (*(f"{a.code} at {value_text(a.time_s, 's')}" for a in trace.alarms), *facts)


def _has(trace: Trace, name: str) -> bool:
    return trace.result.get(name, (None, ""))[0] is not None


def _figure_of(trace: Trace, name: str) -> str:
    value, unit = trace.result[name]
    return "–" if value is None else value_text(value, unit)


# -- over time ---------------------------------------------------------------


_TIME = ("time", "s")


def _motion(trace: Trace, before: Trace | None) -> Picture:
    """Return the picture of a move over its time, with the curves of the move before."""
    alarms = tuple(NamedPlace("", alarm.time_s, "error") for alarm in trace.alarms)
    panels = [
        _panel(trace, before, alarms, "position", ("recorded_position", "command_position", "position"), 0.9),
        _error(trace, before, alarms),
        _difference(trace, alarms),
        _panel(trace, before, alarms, "axis less spindle", ("tapping_error",), 1.0),
        _panel(
            trace,
            before,
            alarms,
            "velocity",
            ("recorded_velocity", "command_velocity", "expected_speed", "velocity"),
            1.0,
        ),
        _panel(trace, before, alarms, "torque", ("recorded_torque", "torque_percent", "torque"), 0.8),
        _panel(trace, before, alarms, "output", ("output",), 0.8) if _has_own_output(trace) else None,
    ]
    return Picture("", (), linked([p for p in panels if p is not None]), close=_settling(trace, before))


def _difference(trace: Trace, alarms: Sequence[NamedPlace]) -> Scene | None:
    """Return what a record of the machine has more than the simulation, of the first signal that it has."""
    name = next((each for each in trace.columns if each.startswith("difference_")), "")
    return _panel(trace, None, alarms, "machine less simulation", (name,), 0.8) if name else None


def _has_own_output(trace: Trace) -> bool:
    """Return whether the output is another thing than the torque: the input of a drive with a velocity
    loop.
    """
    return trace.units.get("output", "") != trace.units.get("torque", "")


_DOTTED = 0.2
"""Share of the rows that a record has, below which its readings are dots: nothing is known between them."""

_WORDS: dict[str, tuple[str, ShapeSort]] = {
    "command_position": ("command", "dim"),
    "position": ("actual", "now"),
    "command_velocity": ("command", "dim"),
    "velocity": ("actual", "now"),
    "following_error": ("following error", "now"),
    "torque_percent": ("torque", "output"),
    "torque": ("torque", "output"),
    "output": ("output", "output"),
}


def _panel(
    trace: Trace,
    before: Trace | None,
    alarms: Sequence[NamedPlace],
    title: str,
    names: Iterable[str],
    share: float,
    levels: Sequence[NamedPlace] = (),
    subtitle: str = "",
) -> Scene | None:
    """Return a panel with those of some columns that the trace has; None without one."""
    present = [name for name in names if name in trace.columns]
    if not present:
        return None
    curves = [*_before(before, present[-1]), *(_curve(trace, name) for name in present)]
    unit = trace.units.get(present[-1], "")
    return panel_of(title, curves, _TIME, unit, levels=levels, marks=alarms, share=share, subtitle=subtitle)


def _curve(trace: Trace, name: str) -> Curve:
    """Return a column as a curve, without the times at which it has no value."""
    words, sort = _WORDS.get(name, (name.replace("_", " "), "outside"))
    known = np.isfinite(trace.columns[name])  # a record does not cover all of the move
    return Curve(
        words,
        trace.columns["time_s"][known],
        trace.columns[name][known],
        sort,
        dashed=sort == "dim",
        dots=bool(known.size)
        and float(np.mean(known)) < _DOTTED
        and name.startswith(("recorded_", "difference_")),
        is_stepped=name == "command_velocity",
        dense=sort == "output" or name == "following_error",
    )


def _before(before: Trace | None, name: str) -> list[Curve]:
    if before is None or name not in before.columns:
        return []
    return [Curve("before", before.columns["time_s"], before.columns[name], "before")]


SPARSE = 50.0
"""Readings in a second below which they are dots: nothing is known between them."""


def recording_picture(recording: SignalRecord, begin: float = 0.0) -> Picture:
    """Return the signals of a recording alone, ``begin`` (s) where its time is 0."""
    time = recording.time - begin
    dots = len(time) - 2 < SPARSE * float(time[-1] - time[0])  # one row alone, too
    panels = [
        panel_of(
            signal.replace("_", " "),
            (Curve("", time, values, "outside", dots=dots),),
            _TIME,
            recording.units.get(signal, ""),
        )
        for signal, values in recording.signals.items()
    ]
    return Picture("", (), linked(panels))


def _error(trace: Trace, before: Trace | None, alarms: Sequence[NamedPlace]) -> Scene | None:
    """Return the following error with the limits that are near it as lines, and those that are not in
    words.
    """
    error = trace.columns.get("following_error")
    if error is None:
        return None
    low, high = float(error.min(initial=0.0)), float(error.max(initial=0.0))
    peak, sign, unit = max(-low, high), (-1.0 if -low > high else 1.0), trace.units.get("following_error", "")
    # A limit far above the curve would flatten it; it is named in words instead.
    near = [
        NamedPlace(f"{name} {value_text(level, unit)}", sign * level)
        for name, (level, _) in trace.limits.items()
        if level is not None and level <= FAR * peak
    ]
    far = ", ".join(f"{name} {level}" for name, level in limits_outside(trace).items()).replace("_", " ")
    above = f"above the plot: {far}" if far else ""
    return _panel(
        trace,
        before,
        alarms,
        "following error",
        ("recorded_following_error", "following_error"),
        1.3,
        near,
        above,
    )


def settling_span(trace: Trace) -> tuple[float, float] | None:
    """Return the times in s between which the axis settles, None if the command does not end.

    From where it is within ten inposition bands of the end (without a band: from the end of the command) to
    some time after it has settled.
    """
    columns = trace.columns
    if (
        trace.alarms
        or not {"time_s", "command_position", "position"} <= set(columns)
        or len(columns["time_s"]) < 3
    ):
        return None
    time, command = columns["time_s"], columns["command_position"]
    moving = np.flatnonzero(command != command[-1])
    # The command must end two rows before the trace does: else there is nothing of the settling to show.
    if not moving.size or moving[-1] + 2 >= len(time):
        return None
    end, last = float(time[moving[-1] + 1]), float(time[-1])
    settled = trace.result.get("settle_time", (None, ""))[0]
    close = end + 1.6 * settled if settled else last
    band = trace.limits.get("inposition band", (None, ""))[0]
    far = np.flatnonzero(np.abs(columns["position"] - command[-1]) > CLOSE * band) if band else moving
    start = float(time[far[-1]]) if far.size else end
    # Where it is far away once more behind the settling, the picture begins at the end of the command.
    start = min(start, end if start >= close else start)
    # At least four samples: an axis that settles at once would give a picture without width.
    close = max(close, start + 4.0 * (time[1] - time[0]))
    return max(0.0, start - 0.05 * (close - start)), min(last, close)


def _settling(trace: Trace, before: Trace | None) -> Scene | None:
    """Return a close look at the end of the move: distance from the end, with the band around it."""
    span = settling_span(trace)
    if span is None:
        return None
    curves = []
    pairs: tuple[tuple[Trace | None, str, ShapeSort], ...] = (
        (before, "before", "before"),
        (trace, "distance from the end", "now"),
    )
    for each, name, sort in pairs:
        if each is None or "position" not in each.columns:
            continue
        inside = (each.columns["time_s"] >= span[0]) & (each.columns["time_s"] <= span[1])
        if inside.sum() > 1:
            off = each.columns["position"][inside] - trace.columns["command_position"][-1]
            curves.append(Curve(name, each.columns["time_s"][inside], off, sort))
    band = trace.limits.get("inposition band", (None, ""))[0]
    levels = (
        ()
        if band is None
        else (NamedPlace(f"inposition band ±{value_text(band)}", band), NamedPlace("", -band))
    )
    along = ("time, the end of the move", "s")
    return (
        panel_of("settling", curves, along, trace.units.get("position", ""), levels=levels)
        if curves
        else None
    )


def _fit(trace: Trace) -> Picture:
    """Return measured and predicted torque of a record, and what is left between them where it was used."""
    names = {"torque": "measured", "predicted_torque": "predicted", "residual": "", "velocity": ""}
    time, unit = trace.columns["time_s"], trace.units["torque"]
    measured, predicted, rest, speed = (
        Curve(words, time, np.nan_to_num(trace.columns[name]), "output" if words == "measured" else "now")
        for name, words in names.items()
    )
    return Picture(
        "",
        (),
        linked(
            [
                panel_of("torque", (measured, predicted), _TIME, unit, share=2.0),
                panel_of("measured less predicted, where used", (rest,), _TIME, unit, share=0.8),
                panel_of("velocity", (speed,), _TIME, trace.units["velocity"], share=0.9),
            ]
        ),
    )


def _plan(trace: Trace) -> Picture:
    """Return the way of two axes in their plane, with the zones."""
    names = [name for name in trace.columns if name.startswith("position_")][:2]
    letters = [name.removeprefix("position_") for name in names]
    unit = trace.units[names[0]]
    curves = [
        Curve(
            area.name,
            np.array([area.x[0], area.x[1], area.x[1], area.x[0], area.x[0]]),
            np.array([area.y[0], area.y[0], area.y[1], area.y[1], area.y[0]]),
            "outside",
        )
        for area in trace.areas
    ]
    ways: tuple[tuple[str, str, ShapeSort], ...] = (
        ("command", "command", "dim"),
        ("actual", "position", "now"),
    )
    for words, what, sort in ways:
        x, y = (trace.columns[f"{what}_{letter}"] for letter in letters)
        curves.append(Curve(words, x, y, sort, dashed=sort == "dim"))
    return Picture("", (), (panel_of(letters[1], curves, (letters[0], unit), unit, share=3.0),))


# -- over frequency ------------------------------------------------------------

_LOOPS: tuple[tuple[str, str, ShapeSort], ...] = (
    ("plant", "plant", "now"),
    ("closed", "closed loop", "now"),
    ("open", "open loop", "output"),
)


def _bode(trace: Trace, before: Trace | None) -> Picture:
    """Return gain and phase over the frequency, one above the other."""
    along = ("frequency", "Hz")
    gain = panel_of(
        "gain",
        tuple(_frequency_curves(trace, before, "gain_db")),
        along,
        "dB",
        log=True,
        share=1.5,
        levels=(NamedPlace("−3 dB", -3.0103), NamedPlace("", 0.0)),
        marks=_frequency_marks(trace, ("bandwidth", "phase_margin_frequency")),
    )
    phase = panel_of(
        "phase",
        tuple(_frequency_curves(trace, before, "phase_deg")),
        along,
        "deg",
        log=True,
        share=1.5,
        step=(0.0, 90.0),
        levels=(NamedPlace("−180 deg", -180.0),),
        marks=_frequency_marks(trace, ("gain_margin_frequency",)),
        without_zero=True,
    )
    return Picture("", (), linked((gain, phase)))


def _frequency_curves(trace: Trace, before: Trace | None, what: str) -> Iterable[Curve]:
    for loop, words, sort in _LOOPS:
        old = f"{loop}_{what}"
        if before is not None and old in before.columns:
            yield Curve(f"{words} before", *_known(before, old), "before")
        model = f"{loop}_{what}_model"
        if model in trace.columns:
            yield Curve(f"{words}, model", *_known(trace, model), sort)
        if old in trace.columns:
            measured = "measured" if loop == "plant" else "swept"
            yield Curve(f"{words}, {measured}", *_known(trace, old), sort, dots=True)


def _known(trace: Trace, name: str) -> tuple[Series, Series]:
    """Return a column over the frequency, without the frequencies at which it was not measured."""
    known = np.isfinite(trace.columns[name])
    return trace.columns["frequency_hz"][known], trace.columns[name][known]


_MARKS = {"bandwidth": "bandwidth", "phase_margin_frequency": "gain 1", "gain_margin_frequency": "−180 deg"}


def _frequency_marks(trace: Trace, names: Iterable[str]) -> tuple[NamedPlace, ...]:
    found = ((name, trace.result.get(name, (None, ""))[0]) for name in names)
    return tuple(
        NamedPlace(f"{_MARKS[name]} {value_text(at, 'Hz', 3)}", at) for name, at in found if at is not None
    )


# -- around a circle -----------------------------------------------------------


def _ballbar(trace: Trace, before: Trace | None) -> Picture:
    """Return the deviation of the radius around the circle, as a ring and over the angle."""
    rings, curves = [], []
    sides: tuple[tuple[Trace | None, str, ShapeSort], ...] = (
        (before, "before", "before"),
        (trace, "simulated", "now"),
    )
    for each, name, sort in sides:
        if each is None:
            continue
        angle, off = each.columns["angle_deg"], each.columns["radius_deviation"]
        rings.append(Ring(np.radians(angle), off, sort))
        curves.append(Curve(name, angle, off, sort))
    unit = trace.units["radius_deviation"]
    levels = []
    # A radius error above 0 is a circle that is too small, a deviation below 0.
    predicted = trace.result.get("predicted_radius_error", (None, ""))[0]
    if predicted is not None and math.isfinite(predicted):
        levels.append(NamedPlace(f"predicted {value_text(-predicted, unit)}".replace("-", "−"), -predicted))
    marks = tuple(NamedPlace("", float(turn)) for turn in (90, 180, 270))
    panel = panel_of(
        "radius deviation",
        curves,
        ("angle", "deg"),
        unit,
        levels=levels,
        marks=marks,
        share=1.2,
        step=(45.0, 0.0),
    )
    return Picture("", (), (panel,), ring_scene(rings, unit))


def limits_outside(trace: Trace) -> Mapping[str, str]:
    """Return the limits of the following error that are far above the curve, as text."""
    error = trace.columns.get("following_error")
    if error is None or not len(error):
        return {}
    peak = float(np.max(np.abs(error)))
    return {
        name: value_text(level, unit)
        for name, (level, unit) in trace.limits.items()
        if level is not None and level > FAR * peak
    }


def plot_svg(
    trace: Trace,
    before: Trace | None = None,
    *,
    chart: str = CHARTS[0],
    width: int = 960,
    unit: int = 132,
    small_print: bool = True,
) -> str:
    """Return the SVG text of a trace, with the trace before a change under it;
    the rest as ``picture_svg`` takes it.
    """
    return picture_svg(picture_of(trace, before, chart), width=width, unit=unit, small_print=small_print)
