"""What is shown in the place of the values of a file."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QShortcut
from PySide6.QtWidgets import QWidget


class PageOfFile(QWidget):
    """A page of one file; Esc goes back to the values."""

    left = Signal()
    """The values are wanted again."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        leave = QShortcut(Qt.Key.Key_Escape, self, self.escape)
        leave.setContext(Qt.ShortcutContext.WidgetWithChildrenShortcut)

    def escape(self) -> None:
        """Go back to the values."""
        self.left.emit()

    def go_to(self) -> bool:
        """Ask for a place in what the page shows; returns whether it has places to go to."""
        return False

    def may_turn_away(self) -> bool:
        """Ask about what is to be settled before another page comes; returns whether it may."""
        return True

    def turned_away(self) -> None:
        """Rest while another page is in front."""

    def may_leave(self) -> bool:
        """Ask about work that is lost with the file; returns whether the file may be closed."""
        return True
