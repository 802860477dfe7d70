"""One step of tuning as its manual prints it: what to change, what to look for, what the simulated axis
shows.
"""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QComboBox, QLabel, QLineEdit, QSizePolicy, QToolButton, QWidget

from amp_studio.calibration import stepped, steps_of, usual_step
from amp_studio.drawing import THIN
from amp_studio.files import ParameterFile
from amp_studio.schema import Address, GuideStep, Value
from amp_studio.sim import Trace, address_of, value_text
from amp_studio.ui.base.figures import show_value, written
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.theme import GAP, GAP2, SMALL_CONTROL, colour, font
from amp_studio.ui.base.translated import sentenced, unit_in_words, worded

from .tuning_target import TuningTarget


class _Choices(QComboBox):
    """The choices of a value; the wheel scrolls what is around it and changes nothing."""

    def __init__(self, choices: list[str]) -> None:
        super().__init__()
        self.addItems(choices)
        # As wide as the panel, and not as the longest of them.
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)

    def show_choice(self, text: str) -> None:
        """Show the present one, or another text, as ``not set``, in their place."""
        self.setPlaceholderText(text)
        self.setCurrentIndex(self.findText(text))
        self.setToolTip(text)

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Leave it to the area around."""
        event.ignore()


class StepDetail(QWidget):
    """The texts of a step and a line for each value that is changed at it."""

    def __init__(self, guarded: Callable[[Callable[[], object]], object]) -> None:
        """``guarded`` runs what may fail and shows the error."""
        super().__init__()
        self._guarded = guarded
        self._target: TuningTarget | None = None
        self.fields: dict[Address, QLineEdit | _Choices] = {}
        self.change, self.look, self.shows = QLabel(), QLabel(), QLabel()
        shows = self.tr("The simulated axis shows")
        self.heads = [QLabel(text) for text in (self.tr("Change"), self.tr("Look for"), shows)]
        self.values = in_column(gap=GAP)
        for head in self.heads:
            head.setFont(font("caption", own=True))
            head.setContentsMargins(0, GAP, 0, 0)  # else the dots of an Ä are cut
        column = in_column(on=self, margins=GAP2, gap=GAP)
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
        found = [each for name in step.params for each in self._addresses(name, axis)]
        if found != list(self.fields):
            self._make_lines(found)
        self._fill()

    def _addresses(self, parameter: str, axis: str) -> list[Address]:
        """Return the value of the axis, or those of all groups, spindles and outputs of this machine."""
        assert self._target is not None
        file = self._target.file
        address, definition = address_of(file, parameter, axis), file.schema.parameters[parameter]
        instances = [] if definition.scope == "axis" else file.machine_schema.instances(definition)
        found = [address] if address else [(parameter, each) for each in instances]
        return [each for each in found if file.evaluation.state(each).is_active]

    def _make_lines(self, addresses: list[Address]) -> None:
        while self.values.count():
            item = self.values.takeAt(0)
            widget = item.widget() if item is not None else None
            if widget is not None:
                widget.hide()
                widget.deleteLater()
        self.fields = {}
        for address in addresses:
            self._make_line(address)

    def _make_line(self, address: Address) -> None:
        assert self._target is not None
        file = self._target.file
        label = file.machine_schema.label(address)
        choices = [choice.label for choice in file.schema.parameters[address[0]].choices or ()]
        name, field = QLabel(label), _Choices(choices) if choices else QLineEdit()
        name.setWordWrap(True)
        field.setAccessibleName(label)
        if isinstance(field, QLineEdit):
            field.editingFinished.connect(lambda: self._guarded(lambda: self._typed(address, field.text())))
        else:
            field.textActivated.connect(lambda text: self._guarded(lambda: self._typed(address, text)))
        self.fields[address] = field
        self.values.addWidget(name)
        if isinstance(field, QLineEdit) and steps_of(file, address):
            field.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
            self.values.addWidget(self._with_buttons(field, address, label))
        else:
            self.values.addWidget(field)

    def _with_buttons(self, field: QLineEdit, address: Address, label: str) -> QWidget:
        line = QWidget()
        row = in_row(on=line, margins=0)
        for text, sign in (("−", -1), ("+", 1)):
            button = QToolButton()
            button.setText(text)
            button.setFixedSize(SMALL_CONTROL, SMALL_CONTROL)
            button.setAutoRepeat(True)
            words = self.tr("One step less: {name}") if sign < 0 else self.tr("One step more: {name}")
            button.setAccessibleName(words.format(name=label))
            button.setToolTip(words.format(name=label))
            button.clicked.connect(lambda *_, sign=sign: self._guarded(lambda: self._stepped(address, sign)))
            row.addWidget(button)
        row.insertWidget(1, field)
        return line

    def _fill(self) -> None:
        assert self._target is not None
        file = self._target.file
        for address, field in self.fields.items():
            text = _typed(file, address)
            if isinstance(field, _Choices):
                field.show_choice(text)
            elif field.text() != text:
                field.setText(text)
            field.setEnabled(self._target.may_edit)

    def _typed(self, address: Address, text: str) -> None:
        assert self._target is not None
        file = self._target.file
        # Leaving a field is no edit: a rounded text must not be written back.
        if text == _typed(file, address):
            return
        try:
            self._set(address, file.read(address, text))
        finally:
            self._fill()

    def _stepped(self, address: Address, sign: int) -> None:
        assert self._target is not None
        file = self._target.file
        self._set(address, stepped(file, address, sign * usual_step(file, address)))

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
            line = f"{worded(name.replace('_', ' '))} {written(value_text(value, unit_in_words(unit), 4))}"
            old = before.result.get(name, (None, ""))[0] if before is not None else None
            if old is not None and value_text(old, digits=4) != value_text(value, digits=4):
                line += self.tr(", was {value}").format(value=written(value_text(old, digits=4)))
            lines.append(line)
        self.shows.setText("\n".join(lines))
        self.shows.setStyleSheet(f"color: {colour('error' if now.alarms else 'text').name()}")


def _typed(file: ParameterFile, address: Address) -> str:
    """Return a value as it is in a field: without groups, which nobody types."""
    return show_value(file.schema.parameters[address[0]], file.get(address)).replace(THIN, "")
