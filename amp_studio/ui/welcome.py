"""The page shown while no file is open."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import (
    QHBoxLayout,
    QLabel,
    QListWidget,
    QListWidgetItem,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from .program_icon import program_icon


class WelcomePage(QWidget):
    """The first commands as buttons, and the recent files."""

    def __init__(self, actions: Iterable[QAction], show: Callable[[Path], object]) -> None:
        super().__init__()
        icon, title = QLabel(), QLabel("<h1>AMP Studio</h1>")
        icon.setPixmap(program_icon().pixmap(64, 64))
        head, buttons = QHBoxLayout(), QHBoxLayout()
        for widget in (icon, title):
            head.addWidget(widget)
        head.addStretch()
        for action in actions:
            button = QToolButton()
            button.setDefaultAction(action)
            button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
            buttons.addWidget(button)
        buttons.addStretch()
        self.list = QListWidget()
        self.list.itemActivated.connect(lambda item: show(item.data(Qt.ItemDataRole.UserRole)))
        self.list.setAccessibleName("Recent files")
        column = QVBoxLayout()
        column.setSpacing(12)
        column.addStretch(1)
        column.addLayout(head)
        column.addLayout(buttons)
        self.title = QLabel("Recent files (Enter opens)")
        column.addWidget(self.title)
        column.addWidget(self.list, 3)
        column.addWidget(QLabel("Press Ctrl+Shift+P to find any command by its name."))
        column.addStretch(1)
        inner = QWidget()
        inner.setMaximumWidth(560)
        inner.setLayout(column)
        outer = QHBoxLayout(self)
        outer.addStretch(1)
        outer.addWidget(inner, 4)
        outer.addStretch(1)
        self.setFocusProxy(self.list)

    def show_recent(self, recent: list[Path]) -> None:
        """List the recent files, the newest first."""
        self.list.clear()
        for path in recent:
            item = QListWidgetItem(f"{path.name}\n{path.parent}")
            item.setData(Qt.ItemDataRole.UserRole, path)
            self.list.addItem(item)
        self.list.setCurrentRow(0)
        self.title.setVisible(bool(recent))
        self.list.setVisible(bool(recent))
        self.setFocus()
