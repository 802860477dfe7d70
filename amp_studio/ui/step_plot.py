"""The curves of a step: position, following error, velocity with torque."""

from __future__ import annotations

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor

from amp_studio.sim import Trace

from .theme import is_dark

_POINTS = 6000
"""Most points to draw, more than a screen is wide; a longer trace is thinned out."""
_PANELS = (("command_position", "position"), ("following_error",), ("command_velocity", "velocity"))


class StepPlot(pg.GraphicsLayoutWidget):
    """Three plots with a common time axis."""

    def __init__(self) -> None:
        dark = is_dark()
        pg.setConfigOptions(
            antialias=True, background="#1e1e1e" if dark else "w", foreground="#ddd" if dark else "k"
        )
        super().__init__()
        self._colours = (
            ("#62a0ea", "#ffa348", "#57e389", "#dc8add")
            if dark
            else ("#1a5fb4", "#c64600", "#208050", "#813d9c")
        )
        self.panels = [self.addPlot(row=n, col=0) for n in range(len(_PANELS))]
        for panel, legend in zip(
            self.panels, ((-8, -8), None, (-8, 8)), strict=True
        ):  # where there is no curve
            panel.showGrid(x=True, y=True, alpha=0.25)
            if legend:
                panel.addLegend(offset=legend)
            panel.getAxis("left").enableAutoSIPrefix(False)
            panel.getAxis("left").setWidth(64)
            panel.setXLink(self.panels[0])
        self.panels[-1].setLabel("bottom", "time", "s")

    def draw(self, trace: Trace) -> None:
        """Draw a trace and remove the previous one."""
        time = trace.columns["time_s"]
        step = max(1, len(time) // _POINTS)
        self.panels[0].setXRange(0.0, float(time[-1]) if len(time) else 1.0, padding=0.02)
        for panel, names in zip(self.panels, _PANELS, strict=True):
            panel.clear()
            unit = next((trace.units[n] for n in names if n in trace.columns), "")
            panel.setLabel("left", names[0].replace("command_", "").replace("_", " "), unit)
            for colour, name in zip(self._colours, names, strict=False):
                if name in trace.columns:
                    pen = pg.mkPen(colour, width=2)
                    panel.plot(
                        time[::step], trace.columns[name][::step], pen=pen, name=name.replace("_", " ")
                    )
        self._draw_limits(trace)
        self._draw_torque(trace, time, step)

    def _draw_limits(self, trace: Trace) -> None:
        """Draw the limits near the following error; limits that would overlap share a line."""
        reached = float(np.max(np.abs(trace.columns["following_error"]), initial=0.0))
        near = [
            (v, f"{n.replace('_', ' ')} {v:.5g} {u}")
            for n, (v, u) in trace.limits.items()
            if v is not None and v <= 3 * reached
        ]
        lines: list[tuple[float, list[str]]] = []
        for level, text in sorted(near):
            if lines and level - lines[-1][0] < 0.05 * reached:
                lines[-1][1].append(text)
            else:
                lines.append((level, [text]))
        for n, (level, texts) in enumerate(lines):
            colour = self._colours[1 + n % 3]
            options = {"position": 0.98, "color": QColor(colour), "anchors": [(1.0, 1.0), (1.0, 1.0)]}
            pen = pg.mkPen(colour, style=Qt.PenStyle.DashLine)
            self.panels[1].addItem(
                pg.InfiniteLine(level, angle=0, pen=pen, label=", ".join(texts), labelOpts=options)
            )
        error = trace.columns["following_error"]
        top = max([float(np.max(error, initial=0.0)), *(level for level, _ in lines)])
        bottom = min(0.0, float(np.min(error, initial=0.0)))
        self.panels[1].setYRange(
            bottom, top + 0.14 * (top - bottom or 1.0), padding=0.03
        )  # room for the highest line's text

    def _draw_torque(self, trace: Trace, time: np.ndarray, step: int) -> None:
        """Draw the torque over the velocity, scaled to its height; the legend gives the scale."""
        torque, velocity = trace.columns.get("torque"), trace.columns.get("velocity")
        if torque is None or velocity is None or not len(torque):
            return
        top = float(np.max(np.abs(velocity), initial=0.0)) or 1.0
        scale = top / max(float(np.max(np.abs(torque))), 1e-9)
        name = f"torque (full height {top / scale:.4g} %)"
        self.panels[2].plot(
            time[::step], torque[::step] * scale, pen=pg.mkPen(self._colours[2], width=1), name=name
        )
