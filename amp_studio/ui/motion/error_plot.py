"""Errors over the positions of an axis as curves: what a table takes away, what was measured,
what is expected to remain.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from amp_studio.calibration import ErrorCurve
from amp_studio.drawing import Curve, Picture, ShapeSort, panel_of
from amp_studio.ui.base.plot import Plot

MICRO = 1000
"""Errors are drawn in µm where positions are in mm."""
MOST_DOTS = 60
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
        times, error_unit = (MICRO, "µm") if "mm" in unit else (1, unit)
        curves = []
        for trace in (trace for trace in traces if trace.curve.points):
            x, y = (np.array([float(each[n]) for each in trace.curve.points]) for n in (0, 1))
            curves.append(Curve(trace.name, x, y * times, trace.sort, trace.dashed))
            if len(x) <= MOST_DOTS:
                curves.append(replace(curves[-1], name="", dots=True))
        named = [curve.name for curve in curves if curve.name]
        title = named[0] if len(named) == 1 else "error" if named else self.tr("No points")
        self.draw(Picture("", (), (panel_of(title, curves, ("position", unit), error_unit),)))
