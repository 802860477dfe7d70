"""A message in the window that waits for nobody: what happened, and at most two things to do about it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal

from PySide6.QtCore import Qt, QTimer
from PySide6.QtGui import QAccessible, QAccessibleEvent, QKeyEvent
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QPushButton, QToolButton, QWidget

from .theme import severity_ink

MessageKind = Literal["information", "advice", "warning", "error"]
READING_MS = 8_000
"""Milliseconds after which an information leaves by itself; anything else stays until it is answered or closed."""


class MessageBar(QFrame):
    """A line under the tabs. A new message takes the place of the one before."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAccessibleName("Message")
        self.text = QLabel()
        self.text.setWordWrap(True)
        self.text.setTextFormat(Qt.TextFormat.PlainText)
        self.text.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.buttons: list[QPushButton] = []
        self._close = QToolButton()
        self._close.setText("×")
        self._close.setAutoRaise(True)
        self._close.setToolTip("Close this message (Escape)")
        self._close.setAccessibleName("Close message")
        self._close.clicked.connect(self.hide)
        self._layout = QHBoxLayout(self)
        self._layout.setContentsMargins(12, 4, 8, 4)
        self._layout.addWidget(self.text, 1)
        self._layout.addWidget(self._close)
        self._leave = QTimer(self)
        self._leave.setSingleShot(True)
        self._leave.timeout.connect(self.hide)
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
            button.clicked.connect(lambda *_, act=act: (self.hide(), act()))
            self._layout.insertWidget(self._layout.count() - 1, button)
            self.buttons.append(button)
        ink = severity_ink(kind).name() if kind != "information" else "palette(mid)"
        self.setStyleSheet(f"MessageBar {{ border: 0; border-left: 3px solid {ink}; }}")
        self.text.setText(text)
        self.setAccessibleDescription(text)
        self.show()
        QAccessible.updateAccessibility(QAccessibleEvent(self, QAccessible.Event.Alert))
        if kind == "information" and not answers:
            self._leave.start(READING_MS)
        else:
            self._leave.stop()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape:
            self.hide()
        else:
            super().keyPressEvent(event)
