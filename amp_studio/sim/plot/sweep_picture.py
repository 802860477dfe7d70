"""The picture of a sweep: a map of two values with a cut through the present point, a curve over one, or a distribution of samples."""

from __future__ import annotations

import math

import numpy as np

from amp_studio.sim.rounding import shown
from amp_studio.sim.series import Series
from amp_studio.sim.trace import Trace
from amp_studio.sim.variations.text import best_row

from .panels import Curve, Field, Panel, Picture

WIDEST = 200
"""Values of each side of a map at most; a sweep of more is drawn as samples."""


def sweep_picture(trace: Trace) -> Picture:
    """Return the picture of a sweep, by what it varied."""
    sides = [np.unique(trace.columns[name]) for name in trace.over]
    grid = math.prod(len(side) for side in sides) == trace.rows and all(len(side) > 1 for side in sides)
    if grid and len(sides) == 2 and max(len(side) for side in sides) <= WIDEST:
        return _map(trace, sides[0], sides[1])
    if grid and len(sides) == 1:
        return _line(trace, sides[0])
    return _distribution(trace)


def _words(name: str) -> str:
    return name.replace("_", " ")


def _map(trace: Trace, x: Series, y: Series) -> Picture:
    one, two = trace.over
    shape = len(x), len(y)
    values = trace.columns[trace.figure].reshape(shape).T
    safe = (trace.columns["safe"] == 1.0).reshape(shape).T
    at = [trace.limits[name][0] for name in trace.over]
    row = best_row(trace)
    field = Field(
        _words(trace.figure), trace.units[trace.figure], _axis(trace, one), _axis(trace, two), x, y, values, safe,
        None if at[0] is None or at[1] is None else (at[0], at[1]),
        None if row is None else (float(trace.columns[one][row]), float(trace.columns[two][row])),
    )  # fmt: skip
    nearest = int(np.argmin(np.abs(y - (y[len(y) // 2] if at[1] is None else at[1]))))
    cut = f"{_words(trace.figure)} at {_words(two)} {shown(float(y[nearest]), trace.units[two])}"
    panel = _panel(trace, cut, x, values[nearest], safe[nearest], at[0])
    return Picture("", (), _axis(trace, one), (panel,), field=field)


def _axis(trace: Trace, name: str) -> str:
    unit = trace.units[name]
    return f"{_words(name)} ({unit})" if unit else _words(name)


def _line(trace: Trace, x: Series) -> Picture:
    values, safe = trace.columns[trace.figure], trace.columns["safe"] == 1.0
    panel = _panel(trace, _words(trace.figure), x, values, safe, trace.limits[trace.over[0]][0])
    return Picture("", (), _axis(trace, trace.over[0]), (panel,))


def _panel(trace: Trace, label: str, x: Series, values: Series, safe: Series, at: float | None) -> Panel:
    known = np.isfinite(values)
    curves = [Curve(_words(trace.figure), x[known], values[known], "actual")]
    if (known & safe).any():
        curves.append(Curve("safe", x[known & safe], values[known & safe], "other", dots=True))
    marks = () if at is None else (("present", at),)
    return Panel(label, trace.units[trace.figure], tuple(curves), marks=marks, height=1.4)


def _distribution(trace: Trace) -> Picture:
    """Return which share of the variations stays below each value of the figure."""
    values = np.sort(trace.columns[trace.figure][np.isfinite(trace.columns[trace.figure])])
    if not values.size:
        values = np.zeros(1)
    share = 100.0 * (np.arange(len(values)) + 0.5) / len(values)
    marks = tuple((f"{part} %", float(np.percentile(values, part))) for part in (5, 50, 95))
    panel = Panel(
        "variations below", "%", (Curve("share", values, share, "actual"),), marks=marks, height=2.0
    )
    return Picture("", (), _axis(trace, trace.figure), (panel,))
