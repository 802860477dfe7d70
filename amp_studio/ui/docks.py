"""The docks around the tabs: they stay while files come and go, and show the panels of the file in front."""

from __future__ import annotations

from PySide6.QtCore import QByteArray, Qt
from PySide6.QtWidgets import QDockWidget, QMainWindow, QStackedWidget

from .file_page import FilePage
from .settings import UserSettings

_PANELS = (
    ("Groups", Qt.DockWidgetArea.LeftDockWidgetArea, 248),
    ("Parameter", Qt.DockWidgetArea.RightDockWidgetArea, 308),
    ("Findings", Qt.DockWidgetArea.BottomDockWidgetArea, 202),
)
"""Name of a dock, where it is and how wide or high, until somebody arranges them."""
_LEAST_TABLE = 320
"""Width in pixels that a kept arrangement must leave to the table."""


class Docks:
    """One dock for each kind of panel. Nothing is docked while no file is open."""

    def __init__(self, window: QMainWindow, settings: UserSettings) -> None:
        self._window, self._settings = window, settings
        self._stacks: dict[str, QStackedWidget] = {}
        self._arranged: QByteArray | None = None
        """How the docks were when the last file was closed; None while they are there."""
        self.docks: list[QDockWidget] = []
        for title, area, _ in _PANELS:
            dock, stack = QDockWidget(title, window), QStackedWidget()
            dock.setObjectName(title)
            dock.setWidget(stack)
            window.addDockWidget(area, dock)
            dock.hide()
            self.docks.append(dock)
            self._stacks[title] = stack
        self._is_first = True

    def add(self, page: FilePage) -> None:
        """Take the panels of a page in."""
        for title, panel in page.panels.items():
            self._stacks[title].addWidget(panel)

    def remove(self, page: FilePage) -> None:
        """Let the panels of a page go."""
        for title, panel in page.panels.items():
            self._stacks[title].removeWidget(panel)
            panel.deleteLater()

    def show_page(self, page: FilePage | None) -> None:
        """Show the panels of a page; without one the docks leave until there is one again."""
        if page is None:
            if not self._is_first and self._arranged is None:
                self._arranged = self._window.saveState()
            for dock in self.docks:
                dock.hide()
            return
        for title, panel in page.panels.items():
            self._stacks[title].setCurrentWidget(panel)
            self._stacks[title].setFocusProxy(panel)
        if self._is_first or self._arranged is not None:
            kept = self._settings.arrangement() if self._is_first else self._arranged
            self._is_first, self._arranged = False, None
            self.reset()
            if kept is not None:
                self._restore(kept)

    def _restore(self, kept: QByteArray) -> None:
        """Arrange the docks as they were, unless that leaves the table no room or hides everything off the screen."""
        if not self._window.restoreState(kept):
            return
        self._settings.bring_back(self.docks)
        centre = self._window.centralWidget()
        if self._window.isVisible() and centre.width() < min(_LEAST_TABLE, self._window.width() // 3):
            self.reset()

    def reset(self) -> None:
        """Dock everything in its place, in its size."""
        for dock, (_, area, _) in zip(self.docks, _PANELS, strict=True):
            dock.setFloating(False)
            self._window.addDockWidget(area, dock)
            dock.show()
        for dock, (_, area, size) in zip(self.docks, _PANELS, strict=True):
            below = area == Qt.DockWidgetArea.BottomDockWidgetArea
            self._window.resizeDocks(
                [dock], [size], Qt.Orientation.Vertical if below else Qt.Orientation.Horizontal
            )

    def keep(self) -> None:
        """Store the arrangement for the next start."""
        if not self._is_first:
            self._settings.keep_arrangement(self._arranged or self._window.saveState())
