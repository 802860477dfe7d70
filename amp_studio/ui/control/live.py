"""The live page: what a control states of itself now, asked for at most five times a second,
and never written to.
"""

from __future__ import annotations

import html
import time
from collections.abc import Callable
from datetime import datetime
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, QTimer
from PySide6.QtGui import QCloseEvent
from PySide6.QtWidgets import (
    QComboBox,
    QDialog,
    QGridLayout,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QLineEdit,
    QPushButton,
    QTableWidget,
    QVBoxLayout,
    QWidget,
)

from amp_studio.pictures import LiveLimits
from amp_studio.schema import load_schema
from amp_studio.ui.base.emulated_control import EmulatedControl
from amp_studio.ui.base.plot import Plot
from amp_studio.ui.base.screen_room import fit_to_screen
from amp_studio.ui.base.theme import GAP2, GAP3, font
from amp_studio.ui.base.translated import message_in_words, sentenced
from amp_studio.ui.forms.table_items import item_at

from .limit_bar import LimitBar
from .readings import AxisReadings, Happened, StatusReadings, lamps_of, titled, without_error

if TYPE_CHECKING:
    from amp_studio.transfer import ActiveFault, AxisStatus, ControlStatus

SILENT_MS = 2000
"""Milliseconds without an answer after which the figures are grey."""
EVENTS = 6
"""Events that are shown."""
PLACES = 4
_WORDS = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
_FIGURE = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter


class LivePage(QDialog):
    """Position, following error, states and faults of a control. Reads only; a fault stops it,
    an exchange ends it. ``emulated`` is the emulated control whose keys can be pressed here,
    ``limits`` returns those of an axis in a unit, as the file in front has them.
    """

    def __init__(
        self,
        address: str,
        family: str,
        show_parameter: Callable[[str], object],
        parent: QWidget | None = None,
        readings: StatusReadings | None = None,
        emulated: EmulatedControl | None = None,
        limits: Callable[[str, str], LiveLimits] = lambda _axis, _unit: LiveLimits(),
    ) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.address, self._family = address, family
        self._show_parameter = show_parameter
        self.readings = readings or StatusReadings(address, family)
        self.readings.read.connect(self.show_status)
        self.readings.failed.connect(self._over)
        self._emulated, self._limits = emulated, limits
        self._axes: dict[str, AxisReadings] = {}
        self._status: ControlStatus | None = None
        self._begun = time.monotonic()
        self.happened = Happened()
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
        self.figures = QLabel()
        self.figures.setFont(font("figure"))
        self.figures.setAccessibleName(self.tr("Position of the chosen axis"))
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
        self.events = QLabel()
        self.events.setFont(font("small"))
        self.events.setAccessibleName(self.tr("What has happened before"))
        self.chosen = QComboBox()
        self.chosen.setAccessibleName(self.tr("Axis that is shown large, and whose readings are drawn"))
        self.chosen.currentIndexChanged.connect(lambda _: self._draw())
        self.bars = {
            "position": LimitBar(self.tr("Position between the ends of the travel")),
            "error": LimitBar(self.tr("Following error between its limits")),
        }
        self.bar_words = {name: QLabel() for name in self.bars}
        self.lamps = QLabel()
        self.lamps.setWordWrap(True)
        self.lamps.setAccessibleName(self.tr("States of the chosen axis"))
        self.plot = Plot(has_cursors=False)
        self.plot.setAccessibleName(self.tr("Readings over time, a dot for each"))
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
        head = QHBoxLayout()
        head.addWidget(self.state, 1)
        head.addWidget(self.chosen)
        head.addWidget(self.figures)
        column = QVBoxLayout(self)
        column.setContentsMargins(GAP3, GAP3, GAP3, GAP3)
        column.setSpacing(GAP2)
        column.addLayout(head)
        column.addLayout(self._bars())
        for part in (self.lamps, self.axes, self.values, self.faults, self.plot, self.events, self.notes):
            column.addWidget(part, {self.axes: 1, self.plot: 2}.get(part, 0))
        if self._emulated is not None:
            column.addLayout(self._keys(self._emulated))
        column.addLayout(foot)
        fit_to_screen(self, 760, 680)

    def _bars(self) -> QGridLayout:
        """Return the limit bars of the chosen axis, each with its limits in words."""
        rows = QGridLayout()
        rows.setSpacing(GAP2)
        for row, (name, bar) in enumerate(self.bars.items()):
            self.bar_words[name].setFont(font("small"))
            rows.addWidget(bar, row, 0)
            rows.addWidget(self.bar_words[name], row, 1)
            self._show_bar(name, None, None, None, "")
        rows.setColumnStretch(0, 1)
        return rows

    def _keys(self, emulated: EmulatedControl) -> QHBoxLayout:
        """Return what presses the keys of an emulated control; no other control is operated from here."""
        self.keys = QLineEdit()
        self.keys.setAccessibleName(self.tr("Keys of the emulated control"))
        self.keys.setPlaceholderText(self.tr("status; a word that it does not know lists those that it does"))
        label = QLabel(self.tr("&Keys of the emulated control:"))
        label.setBuddy(self.keys)
        self.keys.returnPressed.connect(self._press)
        emulated.line_shown.connect(self._answered)
        row = QHBoxLayout()
        row.addWidget(label)
        row.addWidget(self.keys, 1)
        return row

    def _press(self) -> None:
        command = self.keys.text().strip()
        if command and self._emulated is not None:
            self._emulated.send(command)
            self.keys.selectAll()
            if not self.readings.is_running:  # an axis that is moved is to be seen
                self.start()

    def _answered(self, line: str) -> None:
        self.happened.record_act(line)
        self._show_events()

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
        text = self._why  # without an error it was stopped here
        if isinstance(error, Exception):  # of an exchange without what the control contains: this reads only
            what = message_in_words(getattr(error, "what", "") or str(error))
            text = f"{what[:1].upper()}{what[1:]}"
        self.state.setText(text)
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
        self._status = status
        name = status.name or status.family
        self.state.setText(f"{name}: {status.state}" if status.state else name)
        self._show_axes(status.axes)
        words = (
            f"{sentenced(key, self._family)} {_value_text(value)}" for key, value in status.values.items()
        )
        self.values.setText(", ".join(words))
        self.values.setVisible(bool(status.values))
        is_new = self.happened.take(status)
        self._show_faults()
        self._show_events()
        self._draw()
        if is_new:
            self.stop(self.tr("Stopped: the control has a fault."))

    def _show_axes(self, axes: tuple[AxisStatus, ...]) -> None:
        # Not at every reading: a list that is filled again would lose the chosen axis five times a second.
        if self.axes.rowCount() != len(axes):
            self.axes.setRowCount(len(axes))
            self.chosen.clear()
            self.chosen.addItems([axis.axis for axis in axes])
        now = time.monotonic() - self._begun
        for row, axis in enumerate(axes):
            velocity = "" if axis.velocity is None else f"{_value_text(axis.velocity)} {axis.unit}/s"
            error, place = (
                "–" if value is None else f"{_value_text(value)} {axis.unit}"
                for value in (axis.following_error, axis.position)
            )
            for column, text in enumerate((axis.axis, place, error, velocity, ", ".join(axis.states))):
                item = item_at(self.axes, row, column)
                # Qt repaints a cell for the same text too.
                if item.text() != text:
                    item.setText(text)
                    item.setTextAlignment(_FIGURE if 0 < column < 4 else _WORDS)
            self._axes.setdefault(axis.axis, AxisReadings()).add(now, axis)
        for column in range(2, self.axes.columnCount()):  # what the control does not show
            texts = {item_at(self.axes, row, column).text() for row in range(len(axes))}
            self.axes.setColumnHidden(column, texts <= {"", "–"})

    def _show_faults(self) -> None:
        parts = [self._fault_html(fault, since) for fault, since in self.happened.active.values()]
        self.faults.setText("<br>".join(parts))
        self.faults.setVisible(bool(parts))

    def _show_events(self) -> None:
        self.events.setText("\n".join(self.happened.events[:EVENTS]))
        self.events.setVisible(bool(self.happened.events))

    def _fault_html(self, fault: ActiveFault, since: datetime) -> str:
        page = self.tr(" (page {page})").format(page=fault.page) if fault.page else ""
        lines = [f"<b>{html.escape(titled(fault))}</b>{html.escape(page)} {since:%H:%M:%S}"]
        if fault.means:
            lines.append(self._in_words(fault.means))
        lines += [f"{self.tr('Cause:')} {self._in_words(each)}" for each in fault.causes]
        lines += [f"{self.tr('Cure:')} {self._in_words(each)}" for each in fault.cures]
        if fault.params:
            known = load_schema(self._family).parameters
            names = {each: known[each].name if each in known else each for each in fault.params}
            links = [f'<a href="{html.escape(each)}">{html.escape(name)}</a>' for each, name in names.items()]
            lines.append(f"{self.tr('Parameters:')} {', '.join(links)}")
        return "<br>".join(lines)

    def _in_words(self, text: str) -> str:
        return html.escape(sentenced(text, self._family))

    def _draw(self) -> None:
        """Show the chosen axis large, and draw its readings as dots; nothing is known between them."""
        name, status = self.chosen.currentText(), self._status
        axis = next((each for each in status.axes if each.axis == name), None) if status else None
        place = axis.position if axis else None
        self.figures.setText("" if axis is None or place is None else f"{_value_text(place)} {axis.unit}")
        self._show_axis(axis)
        readings = self._axes.get(name)
        picture = readings.picture() if readings else None
        self.plot.setVisible(picture is not None)
        notes = status.assumptions if status else ()
        if picture is not None and readings is not None:
            self.plot.draw(picture)
            notes = notes if "following error" in readings.signals else (*notes, without_error())
        self.notes.setText("\n".join(sentenced(note, self._family) for note in notes))

    def _show_axis(self, axis: AxisStatus | None) -> None:
        """Show the lamps of an axis, and where it is between its limits."""
        lamps = {} if axis is None else lamps_of(axis)
        self.lamps.setText("   ".join(f"{'●' if on else '○'}\u00a0{name}" for name, on in lamps.items()))
        self.lamps.setVisible(bool(lamps))
        if axis is not None:
            own = self._limits(axis.axis, axis.unit)
            most = own.error
            self._show_bar("position", axis.position, own.low, own.high, axis.unit)
            self._show_bar("error", axis.following_error, None if most is None else -most, most, axis.unit)

    def _show_bar(
        self, name: str, value: float | None, low: float | None, high: float | None, unit: str
    ) -> None:
        is_known = value is not None and low is not None and high is not None and low < high
        if is_known and value is not None and low is not None and high is not None:
            self.bars[name].show_value(value, low, high)
            limits = f"{_value_text(low)} … {_value_text(high)} {unit}"
            title = {"position": self.tr("Travel"), "error": self.tr("Following error")}[name]
            self.bar_words[name].setText(f"{title} {limits}")
        self.bars[name].setVisible(is_known)
        self.bar_words[name].setVisible(is_known)


def _value_text(value: float | str) -> str:
    return value if isinstance(value, str) else f"{round(value, PLACES):g}"
