"""The axis of a plot, painted without detours."""

from __future__ import annotations

from typing import Any

import pyqtgraph as pg
from PySide6.QtGui import QPainter, QPicture


class PlotAxis(pg.AxisItem):
    """Paints its lines and figures each time. A recording of them, as pyqtgraph plays it, looks up a font for every figure."""

    picture: Any
    """Where lines and figures are; pyqtgraph sets it to None to have it worked out again."""

    def paint(self, painter: QPainter, *_: object) -> None:
        if self.picture is None:
            self.picture = self._worked_out()
        if self.picture:
            painter.save()
            painter.setClipRect(self.boundingRect())
            self.drawPicture(painter, *self.picture)
            painter.restore()

    def _worked_out(self) -> tuple[Any, ...]:
        measured = QPicture()
        painter = QPainter(measured)
        if self.style["tickFont"]:
            painter.setFont(self.style["tickFont"])
        found = self.generateDrawSpecs(painter)
        painter.end()
        return found or ()


def plot_axes() -> dict[str, PlotAxis]:
    """Return the two axes of a plot."""
    return {side: PlotAxis(side) for side in ("left", "bottom")}
