"""What a control states of the chosen axis now, at the right of Live: figures, states, faults, history."""

from __future__ import annotations

import html
from collections.abc import Sequence
from datetime import datetime
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QFontMetrics, QResizeEvent
from PySide6.QtWidgets import (
    QFrame,
    QGridLayout,
    QLabel,
    QLineEdit,
    QPushButton,
    QScrollArea,
    QSizePolicy,
    QWidget,
)

from amp_studio.pictures import LiveLimits
from amp_studio.schema import load_schema
from amp_studio.ui.base.figures import written
from amp_studio.ui.base.layout import in_column
from amp_studio.ui.base.theme import GAP, GAP2, GAP3, HEAD, colour, font, scheme, severity_html
from amp_studio.ui.base.translated import sentenced, unit_in_words
from amp_studio.ui.control.limit_bar import LimitBar
from amp_studio.ui.control.readings import EventReadings, lamps_of, titled
from amp_studio.ui.control.rows import FOOT, side_by_side
from amp_studio.ui.forms.elided_label import ElidedLabel

from .sign import LiveSign

if TYPE_CHECKING:
    from amp_studio.transfer import ActiveFault, AxisStatus, ControlStatus

_EVENTS = 8
"""Events that are shown."""
_PLACES = 4
"""Decimals of a figure, and digits from which they are grouped."""
WIDE, NARROW = 320, 284
"""Widths of the panel."""
_FIGURES = ("position", "error", "velocity")


class LiveStatusPanel(QWidget):
    """Reads only. Links lead to parameters."""

    linked = Signal(str)
    keys_pressed = Signal(str)
    """A command for the keys of the emulated control."""

    def __init__(self, family: str) -> None:
        super().__init__()
        self._family = family
        self.heading = ElidedLabel(self.tr("Live"))
        self.heading.setFont(font("text", own=True))
        self.lock = QLabel(self.tr("reads only"))
        self.lock.setFont(font("small"))
        self.figures = {name: QLabel("–") for name in _FIGURES}
        self.units = {name: QLabel() for name in _FIGURES}
        self.bars = {
            "position": LimitBar(self.tr("Position between the ends of the travel")),
            "error": LimitBar(self.tr("Following error between its limits")),
        }
        self.bar_words = {name: (QLabel(), QLabel()) for name in self.bars}
        self.age = QLabel()
        self.lamps, self.raw, self.values = QLabel(), QLabel(), QLabel()
        self.faults, self.fault_count, self.events = QLabel(), QLabel(), QLabel()
        self.notes, self._before = QLabel(), _head(self.tr("Before this"))
        self.keys = QLineEdit()
        self.place = ElidedLabel()
        self.end = QPushButton(self.tr("End Li&ve"))
        self._status: ControlStatus | None = None
        self._axis: AxisStatus | None = None
        self._limits = LiveLimits()
        self._happened = EventReadings()
        self._lay_out()
        scheme().changed.connect(self._colour)
        self.setFixedWidth(WIDE)

    def _lay_out(self) -> None:
        for label in (self.lamps, self.raw, self.values, self.faults, self.events, self.notes):
            label.setWordWrap(True)
            # They ask for no width and wrap: without a horizontal scroll bar a long line would be cut.
            label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        for label in (self.raw, self.notes, self.age, self.fault_count, self.place, self.events):
            label.setFont(font("small"))
        self.faults.setTextFormat(Qt.TextFormat.RichText)
        self.faults.setTextInteractionFlags(Qt.TextInteractionFlag.TextBrowserInteraction)
        self.faults.linkActivated.connect(self.linked)
        self.lamps.setTextFormat(Qt.TextFormat.RichText)
        self.events.setTextFormat(Qt.TextFormat.RichText)
        self.faults.setAccessibleName(self.tr("Faults of the control"))
        self.events.setAccessibleName(self.tr("What has happened before"))
        self.lamps.setAccessibleName(self.tr("States of the chosen axis"))
        self.figures["position"].setAccessibleName(self.tr("Position of the chosen axis"))
        self.keys.setAccessibleName(self.tr("Keys of the emulated control"))
        self.keys.setPlaceholderText(self.tr("status; a word that it does not know lists those that it does"))
        self.keys.returnPressed.connect(self._press)
        self.key_label = QLabel(self.tr("&Keys of the emulated control:"))
        self.key_label.setBuddy(self.keys)
        self.readings = self._figures_part()
        inside = QWidget()
        in_column(
            self.readings,
            _line(),
            _head(self.tr("Status"), self.age),
            self.lamps,
            self.raw,
            self.values,
            self.notes,
            _line(),
            _head(self.tr("Faults"), self.fault_count),
            self.faults,
            _line(),
            self._before,
            self.events,
            self.key_label,
            self.keys,
            1,
            on=inside,
            margins=(GAP3, GAP2, GAP3, GAP2),
            gap=GAP2,
        )
        area = QScrollArea()
        area.setWidgetResizable(True)
        area.setFrameShape(QFrame.Shape.NoFrame)
        area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        area.setWidget(inside)
        sign, lock = LiveSign("broadcast"), LiveSign("lock-simple-fill")
        in_column(
            side_by_side(HEAD, sign, self.heading, None, lock, self.lock),
            (area, 1),
            side_by_side(FOOT, self.place, None, self.end),
            on=self,
            margins=0,
            gap=0,
        )
        self.show_keys(False)
        self.show_nothing("")

    def _figures_part(self) -> QWidget:
        part = QWidget()
        rows = QGridLayout(part)
        rows.setContentsMargins(0, 0, 0, 0)
        rows.setHorizontalSpacing(GAP2)
        rows.setVerticalSpacing(GAP)
        words = (self.tr("Position"), self.tr("Following error"), self.tr("Speed"))
        self.words = dict(zip(_FIGURES, map(QLabel, words), strict=True))
        for row, name in enumerate(_FIGURES):
            self.figures[name].setFont(font("figure" if name == "position" else "title"))
            self.figures[name].setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
            for column, label in enumerate((self.words[name], self.figures[name], self.units[name])):
                rows.addWidget(label, row, column)
        rows.setColumnStretch(2, 1)
        for row, (name, bar) in enumerate(self.bars.items()):
            low, high = self.bar_words[name]
            high.setAlignment(Qt.AlignmentFlag.AlignRight)
            low.setFont(font("small"))
            high.setFont(font("small"))
            rows.addWidget(bar, 3 + 2 * row, 0, 1, 3)
            rows.addWidget(low, 4 + 2 * row, 0, 1, 2)
            rows.addWidget(high, 4 + 2 * row, 2)
        return part

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._show_lamps()

    def _press(self) -> None:
        if command := self.keys.text().strip():
            self.keys_pressed.emit(command)
            # Kept and selected: Enter repeats it, typing replaces it.
            self.keys.selectAll()

    def show_keys(self, wanted: bool) -> None:
        """Show what presses the keys of an emulated control; no other control is operated from here."""
        self.key_label.setVisible(wanted)
        self.keys.setVisible(wanted)

    # -- a reading ---------------------------------------------------------------

    def show_nothing(self, text: str) -> None:
        """Show that there is no reading yet, and why."""
        self._status = self._axis = None
        self.age.setText(text)
        self._colour()
        self._show_figures()
        self.grey(True)

    def show_status(self, status: ControlStatus, axis: AxisStatus | None, limits: LiveLimits) -> None:
        """Show a reading of the chosen axis between its limits."""
        self._status, self._axis, self._limits = status, axis, limits
        name = status.name or status.family
        self.heading.setText(self.tr("Live, {axis}").format(axis=axis.axis) if axis else name)
        self.heading.setToolTip(name)
        self.grey(False)
        self._show_figures()
        self._show_lamps()
        raw = " ".join(filter(None, (axis.raw if axis else "", status.raw)))
        self._set(self.raw, raw)
        words = [
            f"{sentenced(key, self._family)} {_value_text(value)}" for key, value in status.values.items()
        ]
        self._set(self.values, ", ".join([status.state, *words] if status.state else words))
        self._set(self.notes, "\n".join(sentenced(note, self._family) for note in status.assumptions))

    def grey(self, is_old: bool) -> None:
        """Show that the figures are old."""
        # Disabled, not cleared: after a lost line the last position is all that the operator has.
        self.readings.setEnabled(not is_old)
        self.lamps.setEnabled(not is_old)
        self.raw.setEnabled(not is_old)

    @staticmethod
    def _set(label: QLabel, text: str) -> None:
        label.setText(text)
        label.setVisible(bool(text))

    def _show_figures(self) -> None:
        axis, limits = self._axis, self._limits
        unit = unit_in_words(axis.unit) if axis else ""
        figures = (axis.position, axis.following_error, axis.velocity) if axis else (None,) * 3
        for name, value in zip(_FIGURES, figures, strict=True):
            self.figures[name].setText("–" if value is None else _value_text(value))
            self.units[name].setText("" if value is None else f"{unit}/s" if name == "velocity" else unit)
            # A control that never reports a speed has no row for it; before the first reading
            # all rows are there, so that the panel does not jump.
            if name != "position":
                for label in (self.words[name], self.figures[name], self.units[name]):
                    label.setVisible(value is not None or axis is None)
        most = limits.error
        self._show_bar("position", figures[0], limits.low, limits.high)
        self._show_bar("error", figures[1], None if most is None else -most, most)

    def _show_bar(self, name: str, value: float | None, low: float | None, high: float | None) -> None:
        is_known = value is not None and low is not None and high is not None and low < high
        if is_known and value is not None and low is not None and high is not None:
            self.bars[name].show_value(value, low, high)
            title = {"position": self.tr("Travel"), "error": self.tr("Following error")}[name]
            for label, text in zip(
                self.bar_words[name], (f"{title} {_value_text(low)}", _value_text(high)), strict=True
            ):
                label.setText(text)
        for part in (self.bars[name], *self.bar_words[name]):
            part.setVisible(is_known)

    def _show_lamps(self) -> None:
        """Show the lamps of the axis side by side where their names have room, filled where they are on."""
        lamps = {} if self._axis is None else lamps_of(self._axis)
        texts = []
        for name, is_on in lamps.items():
            shade = colour("text" if is_on else "dim").name()
            word = html.escape(sentenced(name, self._family))
            texts.append(f'<span style="color:{shade}">{"●" if is_on else "○"}&nbsp;{word}</span>')
        room = (self.width() - 2 * GAP3) // 2 - 3 * GAP2
        letters = QFontMetrics(self.lamps.font())
        is_wide = any(letters.horizontalAdvance(f"● {name}") > room for name in lamps)
        count = 1 if is_wide else 2
        rows = [texts[n : n + count] for n in range(0, len(texts), count)]
        table = "".join(
            "<tr>" + "".join(f'<td width="{100 // count}%">{each}</td>' for each in row) + "</tr>"
            for row in rows
        )
        self._set(self.lamps, f'<table width="100%" cellspacing="1">{table}</table>' if texts else "")

    def show_happened(self, happened: EventReadings) -> None:
        """Show the faults that are active, and what has happened before."""
        self._happened = happened
        parts = [self._fault_html(fault, since) for fault, since in happened.active.values()]
        count = self.tr("%n in the control's words", "", len(parts))
        self.fault_count.setText(count if parts else self.tr("none now"))
        self._set(self.faults, "".join(parts))
        shade = colour("dim").name()
        lines = (
            f'<span style="color:{shade}">{html.escape(time)}</span>&nbsp; {html.escape(text)}'
            for time, _, text in (event.partition(" ") for event in happened.events[:_EVENTS])
        )
        self._set(self.events, "<br>".join(lines))
        self._before.setVisible(bool(happened.events))

    def _colour(self) -> None:
        """Write again what has a colour in its text."""
        self._show_lamps()
        self.show_happened(self._happened)

    def _fault_html(self, fault: ActiveFault, since: datetime) -> str:
        page = self.tr(" (page {page})").format(page=fault.page) if fault.page else ""
        head = f"{severity_html('error')} <b>{html.escape(titled(fault))}</b>{html.escape(page)}"
        begun = self.tr("since {time}").format(time=f"{since:%H:%M:%S}")
        rows: list[tuple[str, str]] = []
        if fault.means:
            rows.append(("", self._in_words(fault.means)))
        rows += [(self.tr("Cause:"), self._in_words(each)) for each in fault.causes]
        rows += [(self.tr("Cure:"), self._in_words(each)) for each in fault.cures]
        if fault.params:
            rows.append((self.tr("Parameters:"), "<br>".join(self._links(fault.params))))
        shade = colour("dim").name()
        cells = "".join(
            f'<tr><td width="76" style="color:{shade}">{word}</td><td>{text}</td></tr>'
            if word
            else f'<tr><td colspan="2">{text}</td></tr>'
            for word, text in rows
        )
        return f'<p style="margin:0">{head} {begun}</p><table cellspacing="1">{cells}</table>'

    def _links(self, parameters: Sequence[str]) -> list[str]:
        known, shade = load_schema(self._family).parameters, colour("sel").name()
        names = {each: known[each].name if each in known else each for each in parameters}
        return [
            f'<a style="color:{shade}" href="{html.escape(each)}">{html.escape(name)}</a>'
            for each, name in names.items()
        ]

    def _in_words(self, text: str) -> str:
        # Texts of the facts, some with < and &: they are no markup.
        return html.escape(sentenced(text, self._family))


def _value_text(value: float | str) -> str:
    """Return a figure of a reading as it is shown."""
    if isinstance(value, str):
        return value
    text = f"{round(value, _PLACES):.{_PLACES}f}".rstrip("0").rstrip(".")
    # A minus in front of 0 would come and go at rest.
    return written("0" if text in ("-0", "") else text)


def _line() -> QFrame:
    made = QFrame()
    made.setFrameShape(QFrame.Shape.HLine)
    made.setForegroundRole(made.palette().ColorRole.Midlight)
    return made


def _head(text: str, right: QLabel | None = None) -> QWidget:
    name = QLabel(text)
    name.setFont(font("small", own=True))
    made = side_by_side(0, name, None, *([right] if right is not None else []))
    layout = made.layout()
    assert layout is not None
    layout.setContentsMargins(0, 0, 0, 0)
    return made
