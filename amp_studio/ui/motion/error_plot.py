"""Errors over the positions of an axis as curves: what a table takes away, what was measured,
what is expected to remain.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import chain

import numpy as np

from amp_studio.calibration import ErrorCurve
from amp_studio.drawing import Curve, Picture, ShapeSort, panel_of
from amp_studio.ui.base.plot import Plot

_MICRO = 1000
"""Errors are drawn in µm where positions are in mm."""
_MAX_DOTS = 60
"""Points that are drawn one by one; of more only the line."""


@dataclass(frozen=True)
class ErrorTrace:
    """One curve of the plot; a dashed one is what was before."""

    name: str
    curve: ErrorCurve
    sort: ShapeSort
    dashed: bool = False


class ErrorPlot(Plot):
    """Curves over one position axis, with their names above."""

    def __init__(self, name: str) -> None:
        super().__init__(has_cursors=False)
        self.setAccessibleName(name)

    def show_errors(self, traces: Sequence[ErrorTrace], unit: str) -> None:
        """Draw these curves instead of the ones before; ``unit`` of positions and errors."""
        times, error_unit = (_MICRO, "µm") if "mm" in unit else (1, unit)
        curves = [*chain.from_iterable(_curves(trace, times) for trace in traces)]
        named = [curve.name for curve in curves if curve.name]
        title = named[0] if len(named) == 1 else "error" if named else self.tr("No points")
        self.draw(Picture("", (), (panel_of(title, curves, ("position", unit), error_unit),)))


def _curves(trace: ErrorTrace, times: float) -> Iterator[Curve]:
    """Yield a curve, and dots at its points where there is room for them."""
    if not trace.curve.points:
        return
    x, y = (np.array([float(each[n]) for each in trace.curve.points]) for n in (0, 1))
    curve = Curve(trace.name, x, y * times, trace.sort, trace.dashed)
    yield curve
    if len(x) <= _MAX_DOTS:
        yield replace(curve, name="", dots=True)
