"""What a picture of a trace shows: panels with curves, limits and marks; `svg` and the program draw it.

A time picture has linked axes and a close look at the settling; a frequency picture is a Bode plot, a circle a ball-bar picture.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import replace

import numpy as np

from amp_studio.sim.rounding import shown
from amp_studio.sim.series import Series
from amp_studio.sim.trace import Trace

from .panels import Curve, Panel, Picture, Ring, Role
from .sweep_picture import sweep_picture

CLOSE = 10.0
"""Inposition bands around the end of a move that a close look at the settling begins with."""
FAR = 1.6
"""A limit below this multiple of the peak is drawn as a line; a higher one is given as text."""


def picture_of(trace: Trace, before: Trace | None = None) -> Picture:
    """Return the picture of a trace; ``before`` is drawn under it where it shows the same."""
    if before is not None and next(iter(before.columns)) != next(iter(trace.columns)):
        before = None
    if "frequency_hz" in trace.columns:
        picture = _bode(trace, before)
    elif "radius_deviation" in trace.columns:
        picture = _ballbar(trace, before)
    elif trace.over:
        picture = sweep_picture(trace)
    elif "predicted_torque" in trace.columns:
        picture = _fit(trace)
    elif trace.areas:
        picture = _plan(trace)
    else:
        picture = _motion(trace, before)
    return replace(
        picture,
        title=_title(trace),
        facts=_facts(trace),
        assumed=tuple(a.removeprefix("ASSUMED: ") for a in trace.assumptions if a.startswith("ASSUMED")),
    )


def thinned(x: Series, y: Series, columns: int) -> tuple[Series, Series]:
    """Return first, least, greatest and last point of each of ``columns`` stretches: the line as it is drawn.

    No peak is lost and no edge moves (U. Jugel et al., M4, Proceedings of the VLDB Endowment 7, 2014).
    """
    if len(x) <= 4 * columns:
        return x, y
    edges = np.linspace(0, len(x), columns + 1).astype(np.int64)
    starts, ends = edges[:-1], edges[1:]
    least = [int(s + np.argmin(y[s:e])) for s, e in zip(starts, ends, strict=True)]
    most = [int(s + np.argmax(y[s:e])) for s, e in zip(starts, ends, strict=True)]
    index = np.unique(np.concatenate([starts, least, most, ends - 1]))
    return x[index], y[index]


def unheld(x: Series, y: Series) -> tuple[Series, Series]:
    """Return a value that is constant between samples as the line through its samples, without the stairs.

    A sample that stays much longer than the others keeps its end, so that a pause stays level.
    """
    changes = np.flatnonzero(np.diff(y)) + 1
    if len(changes) < 2:
        return x, y
    hold = float(np.median(np.diff(changes)))
    gaps = np.diff(np.concatenate([[0], changes]))
    ends = changes[gaps > 1.5 * hold] - 1
    index = np.unique(np.concatenate([[0], ends, changes, [len(x) - 1]]))
    return x[index], y[index]


def banded(x: Series, y: Series, columns: int) -> tuple[Series, Series, Series, Series]:
    """Return (x, mean, least, greatest) of each of ``columns`` stretches, for a value that jumps at every sample."""
    edges = np.linspace(0, len(x), min(columns, len(x)) + 1).astype(np.int64)
    starts = edges[:-1]
    counts = np.diff(edges)
    middle = x[starts + counts // 2]
    mean = np.add.reduceat(y, starts) / counts
    return middle, mean, np.minimum.reduceat(y, starts), np.maximum.reduceat(y, starts)


def _title(trace: Trace) -> str:
    axis = f", axis {trace.axis_title}" if trace.axis else ""
    names = {"step": ("distance", "feedrate"), "circle": ("radius", "feedrate")}.get(trace.scenario, ())
    figures = [_shown(trace, name) for name in names if _has(trace, name)]
    return f"{trace.scenario.capitalize()}{axis}" + (f": {' at '.join(figures)}" if figures else "")


_TOLD = {
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
    found = [words.format(_shown(trace, name)) for name, words in _TOLD.items() if _has(trace, name)]
    return (*(f"{a.code} at {shown(a.time_s, 's')}" for a in trace.alarms), *found)


def _has(trace: Trace, name: str) -> bool:
    return trace.result.get(name, (None, ""))[0] is not None


def _shown(trace: Trace, name: str) -> str:
    value, unit = trace.result[name]
    return "–" if value is None else shown(value, unit)


# -- over time ---------------------------------------------------------------


def _motion(trace: Trace, before: Trace | None) -> Picture:
    panels = [
        _panel(trace, before, "position", ("command_position", "position"), 0.9),
        _error(trace, before),
        _panel(trace, before, "axis less spindle", ("tapping_error",), 1.0),
        _panel(trace, before, "velocity", ("command_velocity", "expected_speed", "velocity"), 1.0),
        _panel(trace, before, "torque", ("torque_percent", "torque"), 0.8),
        _panel(trace, before, "output", ("output",), 0.8) if _has_own_output(trace) else None,
    ]
    return Picture(
        "", (), "time (s)", tuple(p for p in panels if p is not None), close=_settling(trace, before),
        alarms=tuple((a.code, a.time_s) for a in trace.alarms),
    )  # fmt: skip


def _has_own_output(trace: Trace) -> bool:
    """Return whether the output is another thing than the torque: the input of a drive with a velocity loop."""
    return trace.units.get("output", "") != trace.units.get("torque", "")


_WORDS = {
    "command_position": ("command", "command"),
    "position": ("actual", "actual"),
    "command_velocity": ("command", "command"),
    "velocity": ("actual", "actual"),
    "following_error": ("following error", "actual"),
    "torque_percent": ("torque", "output"),
    "torque": ("torque", "output"),
    "output": ("output", "output"),
}


def _panel(
    trace: Trace, before: Trace | None, label: str, names: Iterable[str], height: float
) -> Panel | None:
    present = [name for name in names if name in trace.columns]
    if not present:
        return None
    curves = [*_before(before, present[-1]), *(_curve(trace, name) for name in present)]
    return Panel(label, trace.units.get(present[-1], ""), tuple(curves), height=height)


def _curve(trace: Trace, name: str) -> Curve:
    words, role = _WORDS.get(name, (name.replace("_", " "), "other"))
    held, dense = name == "command_velocity", role == "output" or name == "following_error"
    return Curve(words, trace.columns["time_s"], trace.columns[name], role, held=held, dense=dense)  # type: ignore[arg-type]  # the role is one of the words above


def _before(before: Trace | None, name: str) -> list[Curve]:
    if before is None or name not in before.columns:
        return []
    return [Curve("before", before.columns["time_s"], before.columns[name], "before")]


def _error(trace: Trace, before: Trace | None) -> Panel | None:
    panel = _panel(trace, before, "following error", ("following_error",), 1.3)
    if panel is None:
        return None
    error = trace.columns["following_error"]
    low, high = float(error.min(initial=0.0)), float(error.max(initial=0.0))
    peak, sign = max(-low, high), (-1.0 if -low > high else 1.0)
    levels = [(name, level) for name, (level, _) in trace.limits.items() if level is not None]
    near = tuple((name, sign * level) for name, level in levels if level <= FAR * peak)
    return replace(panel, levels=near)


def settling_span(trace: Trace) -> tuple[float, float] | None:
    """Return the times in s between which the axis settles, None if the command does not end.

    From where it is within ten inposition bands of the end (without a band: from the end of the command) to some
    time after it has settled.
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
    if not moving.size or moving[-1] + 2 >= len(time):
        return None
    end, last = float(time[moving[-1] + 1]), float(time[-1])
    settled = trace.result.get("settle_time", (None, ""))[0]
    close = end + 1.6 * settled if settled else last
    band = trace.limits.get("inposition band", (None, ""))[0]
    far = np.flatnonzero(np.abs(columns["position"] - command[-1]) > CLOSE * band) if band else moving
    start = float(time[far[-1]]) if far.size else end
    start = min(start, end if start >= close else start)
    close = max(close, start + 4.0 * (time[1] - time[0]))
    return max(0.0, start - 0.05 * (close - start)), min(last, close)


def _settling(trace: Trace, before: Trace | None) -> Panel | None:
    """Return a close look at the end of the move: distance from the end, with the band around it."""
    span = settling_span(trace)
    if span is None:
        return None
    curves = []
    for each, name, role in ((before, "before", "before"), (trace, "distance from the end", "actual")):
        if each is None or "position" not in each.columns:
            continue
        inside = (each.columns["time_s"] >= span[0]) & (each.columns["time_s"] <= span[1])
        if inside.sum() > 1:
            off = each.columns["position"][inside] - trace.columns["command_position"][-1]
            curves.append(Curve(name, each.columns["time_s"][inside], off, role))  # type: ignore[arg-type]  # the role is one of the words above
    band = trace.limits.get("inposition band", (None, ""))[0]
    levels = () if band is None else ((f"inposition band ±{shown(band)}", band), ("", -band))
    return (
        Panel("settling", trace.units.get("position", ""), tuple(curves), levels, height=1.0)
        if curves
        else None
    )


def _fit(trace: Trace) -> Picture:
    """Return measured and predicted torque of a record, and what is left between them where it was used."""
    names = {"torque": "measured", "predicted_torque": "predicted", "residual": "", "velocity": ""}
    time, unit = trace.columns["time_s"], trace.units["torque"]
    measured, predicted, rest, speed = (
        Curve(words, time, np.nan_to_num(trace.columns[name]), "output" if words == "measured" else "actual")
        for name, words in names.items()
    )
    return Picture("", (), "time (s)", (
        Panel("torque", unit, (measured, predicted), height=2.0),
        Panel("measured less predicted, where used", unit, (rest,), height=0.8),
        Panel("velocity", trace.units["velocity"], (speed,), height=0.9),
    ))  # fmt: skip


def _plan(trace: Trace) -> Picture:
    """Return the way of two axes in their plane, with the zones."""
    names = [name for name in trace.columns if name.startswith("position_")][:2]
    letters = [name.removeprefix("position_") for name in names]
    unit = trace.units[names[0]]
    boxes = [
        Curve(
            area.name,
            np.array([area.x[0], area.x[1], area.x[1], area.x[0], area.x[0]]),
            np.array([area.y[0], area.y[0], area.y[1], area.y[1], area.y[0]]),
            "other",
        )
        for area in trace.areas
    ]
    ways: list[Curve] = []
    for what, role in (("command", "command"), ("position", "actual")):
        x, y = (trace.columns[f"{what}_{letter}"] for letter in letters)
        ways.append(Curve(role, x, y, role))  # type: ignore[arg-type]  # the role is one of both
    return Picture(
        "", (), f"{letters[0]} ({unit})", (Panel(letters[1], unit, (*boxes, *ways), height=3.0),)
    )  # fmt: skip


# -- over frequency ------------------------------------------------------------

_LOOPS: tuple[tuple[str, str, Role], ...] = (
    ("closed", "closed loop", "actual"),
    ("open", "open loop", "output"),
)


def _bode(trace: Trace, before: Trace | None) -> Picture:
    gain = Panel("gain", "dB", tuple(_frequency_curves(trace, before, "gain_db")), (("−3 dB", -3.0103), ("", 0.0)),
                 _frequency_marks(trace, ("bandwidth", "phase_margin_frequency")), 1.5)  # fmt: skip
    phase = Panel("phase", "deg", tuple(_frequency_curves(trace, before, "phase_deg")), (("−180 deg", -180.0),),
                  _frequency_marks(trace, ("gain_margin_frequency",)), 1.5, step=90.0)  # fmt: skip
    return Picture("", (), "frequency (Hz)", (gain, phase), x_log=True)


def _frequency_curves(trace: Trace, before: Trace | None, what: str) -> Iterable[Curve]:
    for loop, words, role in _LOOPS:
        old = f"{loop}_{what}"
        if before is not None and old in before.columns:
            yield Curve(f"{words} before", *_known(before, old), "before")
        model = f"{loop}_{what}_model"
        if model in trace.columns:
            yield Curve(f"{words}, model", *_known(trace, model), role)
        if old in trace.columns:
            yield Curve(f"{words}, swept", *_known(trace, old), role, dots=True)


def _known(trace: Trace, name: str) -> tuple[Series, Series]:
    """Return a column over the frequency, without the frequencies at which it was not measured."""
    known = np.isfinite(trace.columns[name])
    return trace.columns["frequency_hz"][known], trace.columns[name][known]


_MARKS = {
    "bandwidth": "bandwidth",
    "phase_margin_frequency": "gain 1",
    "gain_margin_frequency": "−180 deg",
}


def _frequency_marks(trace: Trace, names: Iterable[str]) -> tuple[tuple[str, float], ...]:
    found = ((name, trace.result.get(name, (None, ""))[0]) for name in names)
    return tuple((f"{_MARKS[name]} {shown(at, 'Hz', 3)}", at) for name, at in found if at is not None)


# -- around a circle -----------------------------------------------------------


def _ballbar(trace: Trace, before: Trace | None) -> Picture:
    rings, curves = [], []
    for each, name, role in ((before, "before", "before"), (trace, "simulated", "actual")):
        if each is None:
            continue
        angle, off = each.columns["angle_deg"], each.columns["radius_deviation"]
        rings.append(Ring(name, np.radians(angle), off, role))  # type: ignore[arg-type]  # the role is one of the words above
        curves.append(Curve(name, angle, off, role))  # type: ignore[arg-type]  # the role is one of the words above
    unit = trace.units["radius_deviation"]
    levels: list[tuple[str, float]] = [("", 0.0)]
    # A radius error above 0 is a circle that is too small, a deviation below 0.
    predicted = trace.result.get("predicted_radius_error", (None, ""))[0]
    if predicted is not None and math.isfinite(predicted):
        levels.append((f"predicted {shown(-predicted, unit)}".replace("-", "−"), -predicted))
    marks = tuple((f"{turn} deg", float(turn)) for turn in (90, 180, 270))
    panel = Panel("radius deviation", unit, tuple(curves), tuple(levels), marks, 1.2)
    return Picture("", (), "angle (deg)", (panel,), rings=tuple(rings), ring_unit=unit)


def limits_outside(trace: Trace) -> Mapping[str, str]:
    """Return the limits of the following error that are far above the curve, as text."""
    error = trace.columns.get("following_error")
    if error is None or not len(error):
        return {}
    peak = float(np.max(np.abs(error)))
    return {
        name: shown(level, unit)
        for name, (level, unit) in trace.limits.items()
        if level is not None and level > FAR * peak
    }
