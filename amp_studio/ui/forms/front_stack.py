"""Several widgets in one place, of which the one in front alone asks for room."""

from __future__ import annotations

from PySide6.QtCore import QSize
from PySide6.QtWidgets import QSizePolicy, QStackedWidget


class FrontStack(QStackedWidget):
    """A stack as small as the widget in front may be: Qt's keeps the window as wide as the widest behind."""

    def __init__(self) -> None:
        super().__init__()
        self.currentChanged.connect(lambda _row: self.updateGeometry())

    def sizeHint(self) -> QSize:
        front = self.currentWidget()
        return super().sizeHint() if front is None else front.sizeHint()

    def minimumSizeHint(self) -> QSize:
        front = self.currentWidget()
        if front is None:
            return super().minimumSizeHint()
        if front.sizePolicy().horizontalPolicy() == QSizePolicy.Policy.Ignored:
            return front.minimumSize()  # it makes do with the room that there is
        return front.minimumSizeHint().expandedTo(front.minimumSize())
