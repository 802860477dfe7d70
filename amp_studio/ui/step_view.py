"""The step plot: one commanded move of one axis, with its following error and torque."""

from __future__ import annotations

import threading

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import (
    QComboBox,
    QFileDialog,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QPushButton,
    QTextBrowser,
    QVBoxLayout,
    QWidget,
)

from amp_studio.files import axis_title, fitted_axes
from amp_studio.schema import Address, canonical, unit_named
from amp_studio.schema.values import read_number
from amp_studio.sim import SimulationError, Trace, simulate, write_trace

from .task import Progress, Task
from .theme import is_dark
from .workspace import Workspace

_COLOURS = ("#1a5fb4", "#c64600", "#26a269", "#813d9c")


class StepView(QWidget):
    """Simulates with the values as they are edited now, and again after every edit."""

    def __init__(self, workspace: Workspace, address: Address | None, show: object, parent: QWidget | None = None) -> None:
        super().__init__(parent, Qt.WindowType.Window)
        self.setWindowTitle("Step response")
        self.resize(1060, 760)
        self._workspace = workspace
        self._task: Task | None = None
        self._again = False
        self.trace: Trace | None = None
        self.axis = QComboBox()
        for axis in fitted_axes(workspace.file):
            self.axis.addItem(axis_title(workspace.file, axis), axis)
        if address:
            self.axis.setCurrentIndex(max(self.axis.findData(address[1]), 0))
        self.distance, self.feedrate = QLineEdit(), QLineEdit()
        self.distance.setPlaceholderText("as long as needed")
        self.feedrate.setPlaceholderText("rapid feedrate")
        self.mode = QComboBox()
        for key, name in (("", "as configured"), ("linear", "linear ramp"), ("exponential", "exponential"), ("none", "no ramp")):
            self.mode.addItem(name, key)
        self.run_button, self.save_button = QPushButton("&Run"), QPushButton("&Save…")
        self.told = QLabel()
        self.told.setWordWrap(True)
        self.plots = self._plots()
        self.figures = QTextBrowser()
        self._arrange()
        self.axis.currentIndexChanged.connect(lambda _: self.run())
        self.mode.currentIndexChanged.connect(lambda _: self.run())
        for field in (self.distance, self.feedrate):
            field.returnPressed.connect(self.run)
        self.run_button.clicked.connect(self.run)
        self.save_button.clicked.connect(self.save)
        workspace.changed.connect(lambda _: self.run())
        self.run()

    def _arrange(self) -> None:
        form = QFormLayout()
        for label, field in (("Axis", self.axis), ("Distance", self.distance), ("Feedrate", self.feedrate), ("Ramp", self.mode)):
            form.addRow(label, field)
        side = QVBoxLayout()
        side.addLayout(form)
        buttons = QHBoxLayout()
        buttons.addWidget(self.run_button)
        buttons.addWidget(self.save_button)
        side.addLayout(buttons)
        side.addWidget(self.figures)
        layout = QHBoxLayout()
        layout.addWidget(self.plots, 3)
        layout.addLayout(side, 2)
        outer = QVBoxLayout(self)
        outer.addWidget(self.told)
        outer.addLayout(layout)

    def _plots(self) -> pg.GraphicsLayoutWidget:
        pg.setConfigOptions(antialias=True, background="#1e1e1e" if is_dark() else "w", foreground="#ddd" if is_dark() else "k")
        widget = pg.GraphicsLayoutWidget()
        self._panels = [widget.addPlot(row=n, col=0) for n in range(3)]
        for panel in self._panels:
            panel.showGrid(x=True, y=True, alpha=0.25)
            panel.addLegend(offset=(70, 8))
            panel.getAxis("left").enableAutoSIPrefix(False)
            panel.getAxis("left").setWidth(64)
            panel.setXLink(self._panels[0])
        self._panels[2].setLabel("bottom", "time", "s")
        return widget

    # -- running ---------------------------------------------------------------

    def _settings(self) -> dict[str, float | str]:
        settings: dict[str, float | str] = {}
        for name, field, unit in (("move.distance", self.distance, "mm"), ("move.feedrate", self.feedrate, "mm/min")):
            if field.text().strip():
                number, rest = read_number(field.text())
                settings[name] = canonical(number, unit_named(rest) if rest else unit)
        if self.mode.currentData():
            settings["move.mode"] = str(self.mode.currentData())
        return settings

    def run(self) -> None:
        """Simulate in a thread of its own; a run asked for meanwhile follows."""
        if self._task is not None:
            self._again = True
            return
        try:
            settings = self._settings()
        except ValueError as error:
            self.told.setText(str(error))
            return
        file, axis = self._workspace.file.copy(), str(self.axis.currentData())

        def work(progress: Progress, cancel: threading.Event) -> Trace:
            return simulate(file, "step", axis, settings)

        self.told.setText("Simulating …")
        self._task = Task(work, self)
        self._task.done.connect(self._draw)
        self._task.failed.connect(lambda error: self.told.setText(str(error)))
        self._task.finished.connect(self._ended)
        self._task.start()

    def _ended(self) -> None:
        self._task = None
        if self._again:
            self._again = False
            self.run()

    def _draw(self, trace: Trace) -> None:
        self.trace = trace
        self.told.setText(f"{trace.model}.")
        groups = (("command_position", "position"), ("following_error",), ("command_velocity", "velocity", "torque_percent"))
        time = trace.columns["time_s"]
        step = max(1, len(time) // 6000)
        self._panels[0].setXRange(0.0, float(time[-1]) if len(time) else 1.0, padding=0.02)
        for panel, names in zip(self._panels, groups, strict=True):
            panel.clear()
            unit = next((trace.units[n] for n in names if n in trace.columns), "")
            panel.setLabel("left", names[0].replace("command_", "").replace("_", " "), unit)
            for colour, name in zip(_COLOURS, names, strict=False):
                if name in trace.columns and name != "torque_percent":
                    pen = pg.mkPen(colour, width=2)
                    panel.plot(time[::step], trace.columns[name][::step], pen=pen, name=name.replace("_", " "))
        self._draw_limits(trace)
        self._draw_torque(trace, time, step)
        self.figures.setHtml(self._told(trace))

    def _draw_limits(self, trace: Trace) -> None:
        reached = float(np.max(np.abs(trace.columns["following_error"]), initial=0.0))
        for n, (name, (level, unit)) in enumerate(trace.limits.items()):
            colour = _COLOURS[1 + n % 3]
            if level is not None and level <= 3 * reached:
                line = pg.InfiniteLine(level, angle=0, pen=pg.mkPen(colour, style=Qt.PenStyle.DashLine),
                                       label=f"{name.replace('_', ' ')} {level:.5g} {unit}",
                                       labelOpts={"position": 0.3 + 0.22 * n, "color": QColor(colour)})  # fmt: skip
                self._panels[1].addItem(line, ignoreBounds=False)

    def _draw_torque(self, trace: Trace, time: np.ndarray, step: int) -> None:
        torque = trace.columns.get("torque_percent")
        velocity = trace.columns.get("velocity")
        if torque is None or velocity is None or not len(torque):
            return
        top = float(np.max(np.abs(velocity), initial=0.0)) or 1.0
        scale = top / max(float(np.max(np.abs(torque))), 1e-9)
        name = f"torque (full height {top / scale:.4g} %)"
        self._panels[2].plot(time[::step], torque[::step] * scale, pen=pg.mkPen(_COLOURS[2], width=1), name=name)

    def _told(self, trace: Trace) -> str:
        rows = "".join(
            f"<tr><td>{name.replace('_', ' ')}&nbsp;&nbsp;</td><td><b>{'–' if v is None else f'{v:.6g}'}</b> {unit}</td></tr>"
            for name, (v, unit) in trace.result.items()
        )
        alarms = "".join(f"<p style='color:#c01c28'><b>{a.code}</b> at {a.time_s:.4g} s: {a.message}</p>" for a in trace.alarms)
        advice = "".join(f"<li>{a.parameter} = {a.value:.6g} {a.unit}: {a.why}</li>" for a in trace.advice)
        assumed = "".join(f"<li>{text}</li>" for text in trace.assumptions)
        advice = f"<h4>Advice</h4><ul>{advice}</ul>" if advice else ""
        return f"{alarms}<table>{rows}</table>{advice}<h4>Assumptions</h4><ul>{assumed}</ul>"

    def save(self) -> None:
        """Write the trace as CSV, SVG or PNG."""
        if self.trace is None:
            return
        from pathlib import Path

        text, _ = QFileDialog.getSaveFileName(self, "Save", "step.svg", "SVG (*.svg);;PNG (*.png);;CSV (*.csv)")
        if text:
            try:
                write_trace(self.trace, Path(text))
            except (OSError, SimulationError) as error:
                self.told.setText(str(error))
