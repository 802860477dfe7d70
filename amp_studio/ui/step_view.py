"""The step plot: one commanded move of one axis, with its following error and torque."""

from __future__ import annotations

import html
import threading
from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import Qt, QUrl
from PySide6.QtGui import QCloseEvent
from PySide6.QtWidgets import (
    QComboBox,
    QFileDialog,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QPushButton,
    QSplitter,
    QTextBrowser,
    QVBoxLayout,
    QWidget,
)

from amp_studio.files import axis_title, fitted_axes
from amp_studio.schema import Address, angular, canonical, dimension, shown, unit_named, write_number
from amp_studio.schema.values import read_number
from amp_studio.sim import Trace, simulate, write_trace

from .step_plot import StepPlot
from .task import Progress, Task
from .theme import severity_ink
from .workspace import Workspace

_RAMPS = (
    ("", "as configured"),
    ("linear", "linear ramp"),
    ("exponential", "exponential"),
    ("none", "no ramp"),
)
_ENDINGS = "SVG (*.svg);;PNG (*.png);;CSV (*.csv)"


class StepView(QWidget):
    """Simulates with the present values, and again after every edit."""

    def __init__(
        self,
        workspace: Workspace,
        address: Address | None,
        show: Callable[[Address], None],
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent, Qt.WindowType.Window)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowTitle(f"Step response — {workspace.path.name}")
        self.resize(1100, 740)
        self._workspace, self._show_parameter = workspace, show
        self._task: Task | None = None
        self._again = False
        self.trace: Trace | None = None
        self.axis, self.mode = QComboBox(), QComboBox()
        self.distance, self.feedrate = QLineEdit(), QLineEdit()
        for key, name in _RAMPS:
            self.mode.addItem(name, key)
        self.run_button, self.save_button = QPushButton("&Run"), QPushButton("&Save…")
        self.save_button.setEnabled(False)
        self.summary = QLabel()
        self.summary.setWordWrap(True)
        self.plot, self.figures = StepPlot(), QTextBrowser()
        self.figures.setOpenLinks(False)
        self.figures.anchorClicked.connect(self._follow)
        self._fill_axes(address[1] if address else "")
        self._arrange()
        self.axis.currentIndexChanged.connect(self.run)
        self.mode.currentIndexChanged.connect(self.run)
        for field in (self.distance, self.feedrate):
            field.returnPressed.connect(self.run)
        self.run_button.clicked.connect(self.run)
        self.save_button.clicked.connect(self.save)
        workspace.changed.connect(self._after_edit)
        workspace.closed.connect(self.close)
        self.run()

    def _fill_axes(self, wanted: str) -> None:
        self.axis.blockSignals(True)
        self.axis.clear()
        for axis in fitted_axes(self._workspace.file):
            self.axis.addItem(axis_title(self._workspace.file, axis), axis)
        self.axis.setCurrentIndex(max(self.axis.findData(wanted), 0))
        self.axis.blockSignals(False)
        length, velocity = self._units()
        self.distance.setPlaceholderText(f"{shown(length)}, empty for automatic")
        self.feedrate.setPlaceholderText(f"{shown(velocity)}, empty for rapid")

    def _arrange(self) -> None:
        form = QFormLayout()
        fields = (
            ("&Axis", self.axis),
            ("&Distance", self.distance),
            ("&Feedrate", self.feedrate),
            ("Ra&mp", self.mode),
        )
        for label, field in fields:
            form.addRow(label, field)
        buttons = QHBoxLayout()
        buttons.addStretch()
        buttons.addWidget(self.run_button)
        buttons.addWidget(self.save_button)
        side = QWidget()
        column = QVBoxLayout(side)
        column.setContentsMargins(0, 0, 0, 0)
        column.addLayout(form)
        column.addLayout(buttons)
        column.addWidget(self.figures)
        middle = QSplitter()
        middle.addWidget(self.plot)
        middle.addWidget(side)
        middle.setStretchFactor(0, 1)
        middle.setSizes([760, 320])
        outer = QVBoxLayout(self)
        outer.addWidget(self.summary)
        outer.addWidget(middle, 1)

    # -- running ---------------------------------------------------------------

    def _units(self) -> tuple[str, str]:
        """Return the units of distance and feedrate for the chosen axis."""
        file, axis = self._workspace.file, self.axis.currentData()
        family = file.schema.family
        system = family.units.get(file.header.units, {})
        length, velocity = system.get("length", "mm"), system.get("velocity", "mm/min")
        turns = family.axes is not None and axis and file.evaluation.turns((family.axes.type, str(axis)))
        return (angular(length), angular(velocity)) if turns else (length, velocity)

    def _settings(self) -> dict[str, float | str]:
        settings: dict[str, float | str] = {}
        fields = (("move.distance", "Distance", self.distance), ("move.feedrate", "Feedrate", self.feedrate))
        for (key, name, field), unit in zip(fields, self._units(), strict=True):
            if field.text().strip():
                number, rest = read_number(field.text())
                named = unit_named(rest) if rest else unit
                if dimension(named) != dimension(unit):
                    raise ValueError(
                        f"Give the {name.lower()} of this axis in {shown(unit)}, not in {shown(named)}."
                    )
                settings[key] = canonical(number, named)
        if self.mode.currentData():
            settings["move.mode"] = str(self.mode.currentData())
        return settings

    def _after_edit(self, _: list[Address]) -> None:
        """Update the axes and simulate again."""
        self._fill_axes(str(self.axis.currentData()))
        self.run()

    def run(self, *_: object) -> None:
        """Simulate in a separate thread; a run requested meanwhile follows."""
        if self._task is not None:
            self._again = True
            return
        if self.axis.count() == 0:
            self.summary.setText("No axis is fitted. Choose an axis type with Axis > Configure Axis Type.")
            return
        self._fill_axes(str(self.axis.currentData()))
        try:
            settings = self._settings()
        except ValueError as error:
            self._fail(error)
            return
        file, axis = self._workspace.file.copy(), str(self.axis.currentData())

        def work(_: Progress, __: threading.Event) -> Trace:
            return simulate(file, "step", axis, settings)

        self.summary.setText("Simulating …")
        self._task = Task(work)
        self._task.done.connect(self._draw)
        self._task.failed.connect(self._fail)
        self._task.finished.connect(self._ended)
        self._task.begin()

    def _ended(self) -> None:
        self._task = None
        if self._again:
            self._again = False
            self.run()

    def _fail(self, error: Exception) -> None:
        self.summary.setText(
            f'<span style="color:{severity_ink("error").name()}">{html.escape(str(error))}</span>'
        )

    def _draw(self, trace: Trace) -> None:
        self.trace = trace
        self.save_button.setEnabled(True)
        self.summary.setText(f"{html.escape(trace.model)}.")
        self.plot.draw(trace)
        self.figures.setHtml(self._summary(trace))

    def _summary(self, trace: Trace) -> str:
        rows = "".join(
            f"<tr><td>{name.replace('_', ' ')}&nbsp;&nbsp;</td>"
            f"<td align=right><b>{'–' if v is None else f'{v:.6g}'}</b> {shown(unit)}</td></tr>"
            for name, (v, unit) in trace.result.items()
        )
        ink = severity_ink("error").name()
        alarms = "".join(f'<p style="color:{ink}"><b>{a.code}</b> at {a.time_s:.4g} s: {html.escape(a.message)}</p>'
                         for a in trace.alarms)  # fmt: skip
        recommended = "".join(f"<li>{self._link(a.parameter)} = {write_number(a.value)} {shown(a.unit)}: {html.escape(a.why)}</li>"
                         for a in trace.recommendations)  # fmt: skip
        assumed = "".join(f"<li>{html.escape(text)}</li>" for text in trace.assumptions)
        recommended = f"<h4>Recommendations</h4><ul>{recommended}</ul>" if recommended else ""
        return (
            f"{alarms}<table cellpadding=1>{rows}</table>{recommended}<h4>Assumptions</h4><ul>{assumed}</ul>"
        )

    def _link(self, parameter: str) -> str:
        found = self._workspace.file.schema.parameters.get(parameter)
        return (
            f'<a href="param:{parameter}">{html.escape(found.name)}</a>' if found else html.escape(parameter)
        )

    def _follow(self, url: QUrl) -> None:
        if self.trace is not None:
            parameter = url.toString().removeprefix("param:")
            schema, machine = self._workspace.file.schema, self._workspace.file.machine
            instances = schema.on(machine).instances(schema.parameters[parameter])
            self._show_parameter(
                (parameter, self.trace.axis if self.trace.axis in instances else instances[0])
            )

    def save(self) -> None:
        """Write the trace as CSV, SVG or PNG."""
        if self.trace is None:
            return
        near = self._workspace.path.with_name(f"{self._workspace.path.stem}-step-{self.trace.axis}.svg")
        text, chosen = QFileDialog.getSaveFileName(self, "Save", str(near), _ENDINGS)
        if not text:
            return
        path = Path(text)
        path = path if path.suffix else path.with_suffix(chosen[chosen.index("*") + 1 : -1])
        notes: list[str] = []
        try:
            write_trace(self.trace, path, notes.append)
        except (OSError, ValueError) as error:
            self._fail(error)
        else:
            self.summary.setText(html.escape("; ".join([f"{path} written", *notes])))

    def closeEvent(self, event: QCloseEvent) -> None:
        """Ignore the result of a run that has not finished."""
        if self._task is not None:
            self._task.done.disconnect(self._draw)
            self._task.failed.disconnect(self._fail)
            self._task.finished.disconnect(self._ended)
        super().closeEvent(event)
