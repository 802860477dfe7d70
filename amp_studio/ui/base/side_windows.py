"""The windows beside the table: of each kind there is one for each file.

A command that is given again brings its window back. Another one would lie over the first, with a copy of
the file in it, and a window that stays open behind is of no use.
"""

from __future__ import annotations

from typing import TypeVar
from weakref import WeakKeyDictionary

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget

from .modal import is_alive
from .workspace import Workspace

Side = TypeVar("Side", bound=QWidget)


class SideWindows:
    """What is open beside the table; a window that is gone is forgotten with it."""

    def __init__(self) -> None:
        self._opened: WeakKeyDictionary[QWidget, tuple[Workspace | None, object]] = WeakKeyDictionary()
        """Window -> the file that it is for, and what it was asked for there."""

    def of(self, kind: type[Side], file: Workspace | None = None) -> list[Side]:
        """Return the open windows of a kind for a file, the oldest first."""
        return [
            window
            for window, (for_file, _) in list(self._opened.items())
            if isinstance(window, kind) and for_file is file and is_alive(window) and window.isVisible()
        ]

    def again(self, kind: type[Side], file: Workspace | None = None, asked: object = None) -> Side | None:
        """Bring the window of a kind to the front that was opened for the same; None where there is none."""
        for window in self.of(kind, file):
            if self._opened[window][1] == asked:
                bring(window)
                return window
        return None

    def show(self, window: QWidget, file: Workspace | None = None, asked: object = None) -> None:
        """Show a new window in the place of the one of its kind that the file had."""
        for older in self.of(type(window), file):
            older.close()
        self.show_too(window, file, asked)

    def show_too(self, window: QWidget, file: Workspace | None = None, asked: object = None) -> None:
        """Show a new window; others of its kind, with work in them, stay."""
        self._opened[window] = (file, asked)
        window.show()


def bring(window: QWidget) -> None:
    """Bring a window to the front, from the task bar too."""
    window.setWindowState(window.windowState() & ~Qt.WindowState.WindowMinimized)
    window.raise_()
    window.activateWindow()
