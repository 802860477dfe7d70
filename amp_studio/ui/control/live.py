"""The live page: what a control states of itself now, asked for at most five times a second,
and never written to.
"""

from __future__ import annotations

import html
import threading
import time
from collections import deque
from collections.abc import Callable
from datetime import UTC, datetime
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QObject, Qt, QTimer, Signal
from PySide6.QtGui import QCloseEvent
from PySide6.QtWidgets import (
    QComboBox,
    QDialog,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QPushButton,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from amp_studio.drawing import Curve, Picture, panel_of
from amp_studio.ui.base.plot import Plot
from amp_studio.ui.base.task import Task, TaskProgress
from amp_studio.ui.base.theme import GAP2, GAP3, colour, font

if TYPE_CHECKING:
    from amp_studio.transfer import ActiveFault, AxisStatus, ControlStatus

PERIOD = 0.2
"""s from one question to the next, at least."""
SILENT_MS = 2000
"""Milliseconds without an answer after which the figures are grey."""
KEPT = 300
"""Readings of the following error that stay in the picture."""
HISTORY = 50
PLACES = 4


class StatusReadings(QObject):
    """Asks a control for its status in a separate thread, until it is stopped; may outlast its page."""

    read = Signal(object)
    failed = Signal(object)

    def __init__(self, address: str, family: str) -> None:
        super().__init__()
        self._address, self._family = address, family
        self._task: Task | None = None

    @property
    def is_running(self) -> bool:
        """Whether the control is being asked."""
        return self._task is not None

    def start(self) -> None:
        """Begin to ask."""
        if self._task is not None:
            return
        task = self._task = Task(self._ask)
        task.failed.connect(self._over)
        task.done.connect(self._over)  # a method: it is called in the window's thread
        task.begin()

    def stop(self) -> None:
        """Ask no more; the line is closed after the present answer."""
        if self._task is not None:
            self._task.cancelled.set()

    def _over(self, error: object) -> None:
        self._task = None
        self.failed.emit(error)

    def _ask(self, _progress: TaskProgress, cancelled: threading.Event) -> None:
        from contextlib import closing

        from amp_studio.transfer.client import StatusReader

        with closing(StatusReader(self._address, self._family)) as reader:
            while not cancelled.is_set():
                begun = time.monotonic()
                self.read.emit(reader.read())
                cancelled.wait(max(PERIOD - (time.monotonic() - begun), 0.0))


class LivePage(QDialog):
    """Position, following error, states and faults of a control. Reads only; a fault stops it,
    an exchange ends it.
    """

    def __init__(
        self,
        address: str,
        family: str,
        show_parameter: Callable[[str], object],
        parent: QWidget | None = None,
        readings: StatusReadings | None = None,
    ) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.address = address
        self._show_parameter = show_parameter
        self.readings = readings or StatusReadings(address, family)
        self.readings.read.connect(self.show_status)
        self.readings.failed.connect(self._over)
        self._errors: dict[str, deque[tuple[float, float]]] = {}
        self._begun = time.monotonic()
        self._active: dict[tuple[str, str], tuple[ActiveFault, datetime]] = {}
        self.past: list[str] = []
        """Faults that are over, the last one first."""
        self._why = ""
        self._silence = QTimer(self)
        self._silence.setInterval(SILENT_MS)
        self._silence.setSingleShot(True)
        self._silence.timeout.connect(self._silent)
        self._build()

    def _build(self) -> None:
        self.setWindowTitle(self.tr("Live: {address}").format(address=self.address))
        self.setModal(False)
        self.state = QLabel(self.tr("No readings yet."))
        self.state.setFont(font("text", own=True))
        self.lock = QLabel(self.tr("Reads only: nothing is written to the control."))
        self.axes = QTableWidget(0, 5)
        self.axes.setHorizontalHeaderLabels(
            [
                self.tr("Axis"),
                self.tr("Position"),
                self.tr("Following error"),
                self.tr("Velocity"),
                self.tr("Status"),
            ]
        )
        self.axes.setAccessibleName(self.tr("Axes of the control"))
        self.axes.setEditTriggers(QTableWidget.EditTrigger.NoEditTriggers)
        self.axes.verticalHeader().hide()
        self.axes.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        self.axes.horizontalHeader().setStretchLastSection(True)
        self.values = QLabel()
        self.values.setWordWrap(True)
        self.faults = QLabel()
        self.faults.setWordWrap(True)
        self.faults.setTextFormat(Qt.TextFormat.RichText)
        self.faults.setTextInteractionFlags(Qt.TextInteractionFlag.TextBrowserInteraction)
        self.faults.linkActivated.connect(self._show_parameter)
        self.faults.setAccessibleName(self.tr("Faults of the control"))
        self.notes = QLabel()
        self.notes.setWordWrap(True)
        self.notes.setFont(font("small"))
        self.chosen = QComboBox()
        self.chosen.setAccessibleName(self.tr("Axis whose following error is drawn"))
        self.chosen.currentIndexChanged.connect(lambda _: self._draw())
        self.plot = Plot(has_cursors=False)
        self.plot.setAccessibleName(self.tr("Following error over time, a dot for each reading"))
        self.plot.setMinimumHeight(140)
        self.toggle = QPushButton(self.tr("&Start"))
        self.toggle.setAutoDefault(False)
        self.toggle.clicked.connect(self._toggle)
        close = QPushButton(self.tr("&Close"))
        close.setAutoDefault(False)
        close.clicked.connect(self.close)
        foot = QHBoxLayout()
        foot.addWidget(self.lock, 1)
        foot.addWidget(self.toggle)
        foot.addWidget(close)
        column = QVBoxLayout(self)
        column.setContentsMargins(GAP3, GAP3, GAP3, GAP3)
        column.setSpacing(GAP2)
        for part in (self.state, self.axes, self.values, self.faults, self.chosen, self.plot, self.notes):
            column.addWidget(part, 1 if part in (self.axes, self.plot) else 0)
        column.addLayout(foot)
        self.resize(760, 640)

    # -- asking ------------------------------------------------------------------

    def start(self) -> None:
        """Begin to ask the control."""
        self._why = ""
        self.readings.start()
        self._silence.start()
        self.toggle.setText(self.tr("&Stop"))

    def stop(self, why: str) -> None:
        """Stop asking, and say why."""
        if self.readings.is_running:
            self._why = why
            self.readings.stop()

    def _toggle(self) -> None:
        if self.readings.is_running:
            self.stop(self.tr("Stopped."))
        else:
            self.start()

    def _over(self, error: object) -> None:
        self._silence.stop()
        self.toggle.setText(self.tr("&Start"))
        self.state.setText(str(error) if error is not None else self._why)
        self._grey(True)

    def _silent(self) -> None:
        """Show that the figures are old."""
        if self.readings.is_running:
            self.state.setText(self.tr("No answer for 2 s: the figures below are the last ones."))
            self._grey(True)

    def _grey(self, is_old: bool) -> None:
        self.axes.setEnabled(not is_old)

    def closeEvent(self, event: QCloseEvent) -> None:  # Qt's name
        self.readings.stop()
        super().closeEvent(event)

    # -- showing -----------------------------------------------------------------

    def show_status(self, status: ControlStatus) -> None:
        """Show a reading; a fault that is new stops the readings."""
        self._silence.start()
        self._grey(False)
        name = status.name or status.family
        self.state.setText(f"{name}: {status.state}" if status.state else name)
        self._show_axes(status.axes)
        self.values.setText(", ".join(f"{key} {_value_text(value)}" for key, value in status.values.items()))
        self.values.setVisible(bool(status.values))
        self.notes.setText("\n".join(status.assumptions))
        if self._take_faults(status.faults):
            self.stop(self.tr("Stopped: the control has a fault."))
        self._draw()

    def _show_axes(self, axes: tuple[AxisStatus, ...]) -> None:
        if self.axes.rowCount() != len(axes):
            self.axes.setRowCount(len(axes))
            self.chosen.clear()
            self.chosen.addItems([axis.axis for axis in axes])
        now = time.monotonic() - self._begun
        for row, axis in enumerate(axes):
            velocity = "" if axis.velocity is None else f"{_value_text(axis.velocity)} {axis.unit}/s"
            error = (
                "–" if axis.following_error is None else f"{_value_text(axis.following_error)} {axis.unit}"
            )
            place = "–" if axis.position is None else f"{_value_text(axis.position)} {axis.unit}"
            for column, text in enumerate((axis.axis, place, error, velocity, ", ".join(axis.states))):
                item = self.axes.item(row, column)
                if item is None:
                    item = QTableWidgetItem()
                    self.axes.setItem(row, column, item)
                if item.text() != text:
                    item.setText(text)
            if axis.following_error is not None:
                self._errors.setdefault(axis.axis, deque(maxlen=KEPT)).append((now, axis.following_error))

    def _take_faults(self, faults: tuple[ActiveFault, ...]) -> bool:
        """Show active faults and those that are over; returns whether one is new."""
        now = datetime.now(UTC).astimezone()
        present = {(fault.axis, fault.code): fault for fault in faults}
        for key in [key for key in self._active if key not in present]:
            fault, since = self._active.pop(key)
            self.past.insert(0, f"{since:%H:%M:%S}–{now:%H:%M:%S} {_titled(fault)}")
            del self.past[HISTORY:]
        new = [key for key in present if key not in self._active]
        self._active |= {key: (present[key], now) for key in new}
        parts = [self._fault_html(fault, since) for fault, since in self._active.values()]
        parts += [
            f'<span style="color:{colour("dim").name()}">{html.escape(text)}</span>' for text in self.past[:3]
        ]
        self.faults.setText("<br>".join(parts))
        self.faults.setVisible(bool(parts))
        return bool(new)

    def _fault_html(self, fault: ActiveFault, since: datetime) -> str:
        page = self.tr(" (page {page})").format(page=fault.page) if fault.page else ""
        lines = [f"<b>{html.escape(_titled(fault))}</b>{html.escape(page)} {since:%H:%M:%S}"]
        if fault.means:
            lines.append(html.escape(fault.means))
        lines += [f"{self.tr('Cause:')} {html.escape(each)}" for each in fault.causes]
        lines += [f"{self.tr('Cure:')} {html.escape(each)}" for each in fault.cures]
        if fault.params:
            links = [f'<a href="{html.escape(each)}">{html.escape(each)}</a>' for each in fault.params]
            lines.append(f"{self.tr('Parameters:')} {', '.join(links)}")
        return "<br>".join(lines)

    def _draw(self) -> None:
        """Draw the readings of the chosen axis as dots; nothing is known between them."""
        points = self._errors.get(self.chosen.currentText())
        self.plot.setVisible(bool(points))
        self.chosen.setVisible(bool(points))
        if points:
            x, y = np.array(points).T
            dots = Curve("", x, y, "now", dots=True)
            self.plot.draw(Picture("", (), (panel_of("following error", (dots,), ("time", "s")),)))


def _titled(fault: ActiveFault) -> str:
    return f"{fault.axis + ': ' if fault.axis else ''}{fault.code} {fault.text}".strip()


def _value_text(value: float | str) -> str:
    return value if isinstance(value, str) else f"{round(value, PLACES):g}"
