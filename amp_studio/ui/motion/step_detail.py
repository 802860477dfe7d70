"""One step of tuning as its manual prints it: what to change, what to look for, what the simulated axis
shows.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QGridLayout, QLabel, QLineEdit, QToolButton, QVBoxLayout, QWidget

from amp_studio.calibration import stepped, steps_of
from amp_studio.schema import Address, GuideStep, Value, unit_text
from amp_studio.sim import Trace, address_of, value_text
from amp_studio.ui.base.figures import show_value, written
from amp_studio.ui.base.theme import GAP, GAP2, SMALL_CONTROL, colour, font
from amp_studio.ui.base.translated import sentenced, worded

from .tuning_target import TuningTarget
from .tuning_values import usual_step


class StepDetail(QWidget):
    """The texts of a step and a line for each value that is changed at it."""

    def __init__(self, guarded: Callable[[Callable[[], object]], object]) -> None:
        """``guarded`` runs what may fail and shows the error."""
        super().__init__()
        self._guarded = guarded
        self._target: TuningTarget | None = None
        self.fields: dict[Address, QLineEdit] = {}
        self.change, self.look, self.shows = QLabel(), QLabel(), QLabel()
        shows = self.tr("The simulated axis shows")
        self.heads = [QLabel(text) for text in (self.tr("Change"), self.tr("Look for"), shows)]
        self.values = QGridLayout()
        self.values.setContentsMargins(0, 0, 0, 0)
        self.values.setSpacing(GAP)
        for head in self.heads:
            head.setFont(font("caption", own=True))
            head.setContentsMargins(0, GAP, 0, 0)  # else the dots of an Ä are cut
        column = QVBoxLayout(self)
        column.setContentsMargins(GAP2, GAP2, GAP2, GAP2)
        column.setSpacing(GAP)
        for head, text in zip(self.heads, (self.change, self.look, self.shows), strict=True):
            text.setWordWrap(True)
            text.setTextFormat(Qt.TextFormat.PlainText)
            text.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
            column.addWidget(head)
            column.addWidget(text)
            if text is self.change:
                column.addLayout(self.values)
        column.addStretch()

    def show_step(self, target: TuningTarget, step: GuideStep, axis: str) -> None:
        """Show a step with the values of an axis, in a file or a control."""
        self._target = target
        family = target.file.schema.family.family
        self.change.setText(worded(step.what, family))
        self.look.setText(worded(step.look, family))
        for head, text in zip(self.heads[:2], (self.change, self.look), strict=True):
            text.setVisible(bool(text.text()))
            head.setVisible(bool(text.text()))
        self.heads[0].setVisible(bool(step.what or step.params))
        self.heads[2].setVisible(step.shows is not None)
        self.shows.setVisible(step.shows is not None)
        found = [each for name in step.params if (each := self._address(name, axis)) is not None]
        if found != list(self.fields):
            self._make_lines(found)
        self._fill()

    def _address(self, parameter: str, axis: str) -> Address | None:
        """Return the value of the axis, or the only one; None for one that this machine has not."""
        assert self._target is not None
        file = self._target.file
        address = address_of(file, parameter, axis)
        return address if address and file.evaluation.state(address).is_active else None

    def _make_lines(self, addresses: list[Address]) -> None:
        while self.values.count():
            item = self.values.takeAt(0)
            widget = item.widget() if item is not None else None
            if widget is not None:
                widget.hide()
                widget.deleteLater()
        self.fields = {}
        for row, address in enumerate(addresses):
            self._make_line(row, address)

    def _make_line(self, row: int, address: Address) -> None:
        assert self._target is not None
        label = self._target.file.machine_schema.label(address)
        name, field = QLabel(label), QLineEdit()
        name.setWordWrap(True)
        field.setAccessibleName(label)
        field.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        field.setFixedWidth(110)
        field.editingFinished.connect(lambda: self._guarded(lambda: self._typed(address)))
        self.values.addWidget(name, 2 * row, 0, 1, 3)
        for column, (text, sign) in enumerate((("−", -1), ("+", 1))):
            button = QToolButton()
            button.setText(text)
            button.setFixedSize(SMALL_CONTROL, SMALL_CONTROL)
            button.setAutoRepeat(True)
            words = self.tr("One step less: {name}") if sign < 0 else self.tr("One step more: {name}")
            button.setAccessibleName(words.format(name=label))
            button.setToolTip(words.format(name=label))
            button.clicked.connect(lambda *_, sign=sign: self._guarded(lambda: self._stepped(address, sign)))
            self.values.addWidget(button, 2 * row + 1, 2 * column)
        self.values.addWidget(field, 2 * row + 1, 1)
        self.fields[address] = field

    def _fill(self) -> None:
        assert self._target is not None
        file = self._target.file
        for address, field in self.fields.items():
            text = show_value(file.schema.parameters[address[0]], file.get(address))
            if field.text() != text:
                field.setText(text)
            field.setEnabled(self._target.may_edit)

    def _typed(self, address: Address) -> None:
        assert self._target is not None
        file, text = self._target.file, self.fields[address].text()
        # Leaving a field is no edit: a rounded text must not be written back.
        if text == show_value(file.schema.parameters[address[0]], file.get(address)):
            return
        try:
            self._set(address, file.read(address, text))
        finally:
            self._fill()

    def _stepped(self, address: Address, sign: int) -> None:
        assert self._target is not None
        file = self._target.file
        steps = steps_of(file, address)
        step: Fraction = steps[usual_step(steps, file.get(address))]
        self._set(address, stepped(file, address, sign * step))

    def _set(self, address: Address, value: Value) -> None:
        assert self._target is not None
        label = self._target.file.machine_schema.label(address)
        self._target.set(self.tr("Tune") + f" {label}", {address: value})

    def show_figures(self, step: GuideStep, now: Trace | None, before: Trace | None, why: str = "") -> None:
        """Show the figures of the simulated axis, with those from the start of the step; ``why`` there are
        none.
        """
        if now is None or step.shows is None:
            self.shows.setText(why)
            return
        family = self._target.file.schema.family.family if self._target is not None else ""
        lines = [f"{alarm.code}: {sentenced(alarm.message, family)}" for alarm in now.alarms]
        for name in step.shows.figures:
            value, unit = now.result.get(name, (None, ""))
            if value is None:
                continue
            line = f"{worded(name.replace('_', ' '))} {written(value_text(value, unit_text(unit), 4))}"
            old = before.result.get(name, (None, ""))[0] if before is not None else None
            if old is not None and value_text(old, digits=4) != value_text(value, digits=4):
                line += self.tr(", was {value}").format(value=written(value_text(old, digits=4)))
            lines.append(line)
        self.shows.setText("\n".join(lines))
        self.shows.setStyleSheet(f"color: {colour('error' if now.alarms else 'text').name()}")
