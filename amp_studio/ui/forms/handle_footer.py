"""Name, value and step of the chosen handle of a picture; the value can be typed."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QPalette, QResizeEvent
from PySide6.QtWidgets import QFrame, QLineEdit

from amp_studio.drawing import Handle, figure_text
from amp_studio.schema import Address, Value, convert, dimension, write_figure, write_value
from amp_studio.ui.base.figures import sentence, show_value, typed, written
from amp_studio.ui.base.layout import in_row
from amp_studio.ui.base.theme import CONTROL, GAP3, font
from amp_studio.ui.base.translated import unit_in_words
from amp_studio.ui.base.workspace import Workspace

from .elided_label import ElidedLabel

_WITH_KEYS = 620
"""Width from which the keys are shown."""


class HandleFooter(QFrame):
    """Name, value and step of the chosen handle; the value can be typed."""

    entered = Signal(str)
    left = Signal()

    def __init__(self, workspace: Workspace) -> None:
        super().__init__()
        self._workspace = workspace
        self._handle: Handle | None = None
        self.name, self.more, self.keys = ElidedLabel(), ElidedLabel(), ElidedLabel()
        self.name.setFont(font("text", own=True))
        self.field = QLineEdit()
        self.field.setFixedWidth(150)
        self.field.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.field.returnPressed.connect(lambda: self.entered.emit(self.field.text()))
        self.field.installEventFilter(self)
        for label in (self.more, self.keys):
            label.setFont(font("small"))
            label.setForegroundRole(QPalette.ColorRole.PlaceholderText)
        in_row(
            self.name, self.field, (self.more, 1), self.keys, on=self, margins=(GAP3, 4, GAP3, 4), gap=GAP3
        )
        self.setFixedHeight(CONTROL + 14)  # the same with a handle and without, or the picture would move
        self.show_handle(None)

    def show_handle(self, handle: Handle | None) -> None:
        """Show a handle; without one what can be done."""
        self.more.setForegroundRole(QPalette.ColorRole.PlaceholderText)
        has_one = handle is not None and len(handle.drags) == 1
        self.field.setVisible(has_one)
        self._handle = handle
        self._fit()
        self.name.setVisible(handle is not None)
        if handle is None:
            self.name.setText("")
            self.more.setText(self.tr("Drag a handle, or go to it with Tab and use the arrow keys"))
            return
        self.name.setText(handle.label)
        drag = handle.drags[0]
        step = f"{written(figure_text(drag.step))} {unit_in_words(drag.unit)}".strip()
        self.keys.setText(self.tr("← → {step}, Shift 10").format(step=step))
        if has_one and not self.field.hasFocus():
            self.field.setText(typed(self._typed(drag.address)))
            self.field.setAccessibleName(handle.label)
        self.more.setText(self._default(drag.address) if has_one else handle.value)

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        """Show the keys where the name has room besides."""
        self.keys.setVisible(self._handle is not None and self.width() >= _WITH_KEYS)

    def _typed(self, address: Address) -> str:
        """Return a value as it would be typed, in the unit of the file."""
        file = self._workspace.file
        value, unit = file.get(address), self._workspace.typed_unit(address)
        if (
            value is not None
            and not isinstance(value.value, (str, bool))
            and dimension(value.unit) == dimension(unit)
        ):
            value = (
                Value(float(write_figure(convert(float(value.value), value.unit, unit))), unit)
                if unit != value.unit
                else value
            )
        return write_value(file.schema.parameters[address[0]], value)

    def _default(self, address: Address) -> str:
        file = self._workspace.file
        default = file.default(address)
        if default is None:
            return self.tr("No default")
        return self.tr("Default {value}").format(
            value=show_value(file.schema.parameters[address[0]], default)
        )

    def type(self, text: str) -> None:
        """Take a value from the keyboard, beginning with what was typed."""
        if not self.field.isVisible():
            return
        self.field.setFocus()
        if text:
            self.field.setText(text)
        else:
            self.field.selectAll()

    def refuse(self, reason: str) -> None:
        """Say why a value is not taken; it stays in the field."""
        self.more.setText(sentence(reason))
        self.more.setForegroundRole(QPalette.ColorRole.BrightText)

    def eventFilter(self, watched: object, event: object) -> bool:
        """Esc in the field gives the value up."""
        if event.type() == event.Type.KeyPress and event.key() == Qt.Key.Key_Escape:  # type: ignore[attr-defined]  # Qt gives the event of this kind
            self.field.clearFocus()
            self.left.emit()
            return True
        return False
