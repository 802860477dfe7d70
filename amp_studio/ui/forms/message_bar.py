"""A message in the window that stops nothing: what happened, and at most two things to do about it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal

from PySide6.QtCore import Qt
from PySide6.QtGui import QAccessible, QAccessibleEvent, QKeyEvent
from PySide6.QtWidgets import QFrame, QLabel, QPushButton, QToolButton, QWidget

from amp_studio.ui.base.layout import in_row
from amp_studio.ui.base.single_shot import single_shot
from amp_studio.ui.base.theme import GAP2, GAP3, ICON, MESSAGE, icon, scheme, severity_colour, severity_icon
from amp_studio.ui.base.translated import without_number

MessageKind = Literal["information", "advice", "warning", "error"]
_READING_MS = 8_000
"""Milliseconds after which an information leaves by itself;
anything else stays until it is answered or closed."""


class MessageBar(QFrame):
    """A line under the tabs. A new message takes the place of the one before."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAccessibleName(self.tr("Message"))
        self.setMinimumHeight(MESSAGE)
        self._kind: MessageKind = "information"
        self._icon = QLabel()
        self.text = QLabel()
        self.text.setWordWrap(True)
        self.text.setTextFormat(Qt.TextFormat.PlainText)
        self.text.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.buttons: list[QPushButton] = []
        self._close = QToolButton()
        self._close.setIcon(icon("x", "dim"))
        self._close.setToolTip(self.tr("Close this message (Escape)"))
        self._close.setAccessibleName(self.tr("Close message"))
        self._close.clicked.connect(self.hide)
        self._layout = in_row(
            self._icon, (self.text, 1), self._close, on=self, margins=(GAP3, 3, GAP2, 3), gap=GAP2
        )
        self._hide_timer = single_shot(self, self.hide)
        scheme().changed.connect(self._colour)
        self.hide()

    def say(
        self, text: str, kind: MessageKind = "information", *answers: tuple[str, Callable[[], object]]
    ) -> None:
        """Show a text with a button for each of at most two answers; a click hides the message first."""
        for button in self.buttons:
            self._layout.removeWidget(button)
            button.deleteLater()
        self.buttons = []
        for name, act in answers:
            button = QPushButton(name)
            button.setAutoDefault(False)
            button.setProperty("primary", kind in ("warning", "error") and not self.buttons)
            button.clicked.connect(lambda *_, act=act: (self.hide(), act()))
            self._layout.insertWidget(self._layout.count() - 1, button)
            self.buttons.append(button)
        self._kind, text = kind, without_number(text)
        self.text.setText(text)
        self._colour()
        self.setAccessibleDescription(text)
        self.show()
        QAccessible.updateAccessibility(QAccessibleEvent(self, QAccessible.Event.Alert))
        if kind == "information" and not answers:
            self._hide_timer.start(_READING_MS)
        else:
            self._hide_timer.stop()

    def _colour(self) -> None:
        """Show the severity by the left edge and by the shape of the icon."""
        if self.isHidden() and not self.text.text():  # it has had no message yet
            return
        shade = severity_colour(self._kind).name()
        self.setStyleSheet(
            f"MessageBar {{ border: 0; border-left: 3px solid {shade}; border-bottom: 1px solid"
            " palette(midlight); }"
        )
        self._icon.setPixmap(severity_icon(self._kind).pixmap(ICON, ICON))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape:
            self.hide()
        else:
            super().keyPressEvent(event)
