"""The picture of a sweep: a map of two values with a cut through the present point, a curve over one,
or a distribution of samples.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from amp_studio.drawing import Curve, NamedPlace, Picture, Point, Scene, ShapeSort, map_scene, panel_of
from amp_studio.sim.rounding import value_text
from amp_studio.sim.series import Series
from amp_studio.sim.trace import Trace
from amp_studio.sim.variations.text import best_row

_WIDEST = 200
"""Values of each side of a map at most; a sweep of more is drawn as samples."""


def sweep_picture(trace: Trace) -> Picture:
    """Return the picture of a sweep, by what it varied."""
    sides = [np.unique(trace.columns[name]) for name in trace.over]
    sizes = [len(side) for side in sides]
    # Of several values sampled at random hardly one repeats: the product is far above the rows.
    is_grid = math.prod(sizes) == trace.rows and min(sizes, default=0) > 1
    if is_grid and len(sides) == 2 and max(sizes) <= _WIDEST:
        return _map(trace, sides[0], sides[1])
    if is_grid and len(sides) == 1:
        return _line(trace, sides[0])
    return _distribution(trace)


def _words(name: str) -> str:
    return name.replace("_", " ")


def _map(trace: Trace, x: Series, y: Series) -> Picture:
    """Return a figure over two varied values, with where none is safe, the present one and the best."""
    one, two = trace.over
    shape = len(x), len(y)
    values = trace.columns[trace.figure].reshape(shape).T
    safe = (trace.columns["safe"] == 1.0).reshape(shape).T
    at = [trace.limits[name][0] for name in trace.over]
    row = best_row(trace)
    points: list[tuple[str, Point, ShapeSort]] = []
    if at[0] is not None and at[1] is not None:
        points.append(("present", (at[0], at[1]), "error"))
    if row is not None:
        points.append(("best", (float(trace.columns[one][row]), float(trace.columns[two][row])), "outside"))
    above = map_scene(
        _words(trace.figure),
        trace.units[trace.figure],
        (*_axis(trace, one), x),
        (*_axis(trace, two), y),
        values,
        safe,
        points,
    )
    # The present value is seldom one of the grid.
    nearest = int(np.argmin(np.abs(y - (y[len(y) // 2] if at[1] is None else at[1]))))
    cut = f"where {_axis(trace, two)[0]} is {value_text(float(y[nearest]), trace.units[two])}"
    panel = replace(_panel(trace, one, x, values[nearest], safe[nearest], at[0]), subtitle=cut)
    return Picture("", (), (panel,), above)


def _axis(trace: Trace, name: str) -> tuple[str, str]:
    return trace.called.get(name) or _words(name), trace.units[name]


def _line(trace: Trace, x: Series) -> Picture:
    values, safe = trace.columns[trace.figure], trace.columns["safe"] == 1.0
    one = trace.over[0]
    return Picture("", (), (_panel(trace, one, x, values, safe, trace.limits[one][0]),))


def _panel(trace: Trace, over: str, x: Series, values: Series, safe: Series, at: float | None) -> Scene:
    known, title = np.isfinite(values), _words(trace.figure)
    curves = [Curve(title, x[known], values[known], "now")]
    if (known & safe).any():
        curves.append(Curve("safe", x[known & safe], values[known & safe], "outside", dots=True))
    marks = () if at is None else (NamedPlace("present", at),)
    return panel_of(title, curves, _axis(trace, over), trace.units[trace.figure], marks=marks, share=1.4)


def _distribution(trace: Trace) -> Picture:
    """Return which share of the variations stays below each value of the figure."""
    values = np.sort(trace.columns[trace.figure][np.isfinite(trace.columns[trace.figure])])
    if not values.size:
        values = np.zeros(1)
    # The middle of each step: n samples do not show where 0 and 100 % are.
    share = 100.0 * (np.arange(len(values)) + 0.5) / len(values)
    marks = tuple(NamedPlace(f"{part} %", float(np.percentile(values, part))) for part in (5, 50, 95))
    curve = Curve("share", values, share)
    panel = panel_of("variations below", (curve,), _axis(trace, trace.figure), "%", marks=marks, share=2.0)
    return Picture("", (), (panel,))
