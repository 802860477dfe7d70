"""Errors over the positions of an axis as curves: what a table takes away, what was measured, what is expected to remain."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import pyqtgraph as pg
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QVBoxLayout, QWidget

from amp_studio.calibration import ErrorCurve
from amp_studio.ui.base.theme import Token, colour, font, scheme

MICRO = 1000
"""Errors are drawn in µm where positions are in mm."""


@dataclass(frozen=True)
class ErrorTrace:
    """One curve of the plot; a dashed one is what was before."""

    name: str
    curve: ErrorCurve
    ink: Token
    dashed: bool = False


class ErrorPlot(QWidget):
    """Curves over one position axis, with their names above."""

    def __init__(self, name: str) -> None:
        pg.setConfigOptions(antialias=True)
        super().__init__()
        self._traces: Sequence[ErrorTrace] = ()
        self._unit = "mm"
        self.names, self.plot = QLabel(), pg.PlotWidget()
        self.names.setTextFormat(Qt.TextFormat.RichText)
        self.names.setWordWrap(True)
        self.names.setFont(font("small"))
        self.plot.setAccessibleName(name)
        self.plot.hideButtons()
        self.plot.setMenuEnabled(False)
        self.plot.setMouseEnabled(False, False)
        self.plot.setMinimumSize(200, 120)
        self.plot.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.names)
        layout.addWidget(self.plot, 1)
        scheme().changed.connect(self._draw_again)  # a method: a plot that is gone is not asked

    def _draw_again(self) -> None:
        self.draw(self._traces, self._unit)

    def draw(self, traces: Sequence[ErrorTrace], unit: str) -> None:
        """Draw these curves instead of the ones before; ``unit`` of positions and errors."""
        self._traces, self._unit = traces, unit
        item = self.plot.getPlotItem()
        item.clear()
        self.plot.setBackground(colour("base"))
        times, error_unit = (MICRO, "µm") if "mm" in unit else (1, unit)
        drawn = [trace for trace in traces if trace.curve.points]
        names = "&nbsp;&nbsp;&nbsp; ".join(
            f'<span style="color:{colour(t.ink).name()}">{"- -" if t.dashed else "—"} {t.name}</span>'
            for t in drawn
        )
        self.names.setText(names or self.tr("No points"))
        for side, text in (("left", error_unit), ("bottom", unit)):
            axis = item.getAxis(side)
            axis.enableAutoSIPrefix(False)
            axis.setPen(colour("dim"))
            axis.setTextPen(colour("dim"))
            axis.setTickFont(font("caption"))
            axis.setLabel(text, color=colour("dim").name())
        item.showGrid(x=True, y=True, alpha=0.18)
        item.addItem(pg.InfiniteLine(0, angle=0, pen=pg.mkPen(colour("edge"), width=1)))
        for trace in drawn:
            x = [float(at) for at, _ in trace.curve.points]
            y = [float(by) * times for _, by in trace.curve.points]
            ink = colour(trace.ink)
            style = Qt.PenStyle.DashLine if trace.dashed else Qt.PenStyle.SolidLine
            symbol = "o" if len(x) <= 60 else None
            item.addItem(
                pg.PlotDataItem(
                    x, y, pen=pg.mkPen(ink, width=1.6, style=style), symbol=symbol, symbolSize=5, symbolPen=ink,
                    symbolBrush=colour("base"),
                )
            )  # fmt: skip
        item.enableAutoRange()
