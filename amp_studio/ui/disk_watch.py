"""Notices when another program changes the open file on disk."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QFileSystemWatcher, QObject, QTimer
from PySide6.QtWidgets import QApplication

from .questions import ask, show_message
from .settings import is_there
from .studio_window import StudioWindow
from .workspace import Workspace

SETTLE_MS = 250
"""Milliseconds to wait, as a program may write a file in several steps."""


class DiskWatch(QObject):
    """Watches one file, and its folder, because a rename over a file ends the watch of the file itself."""

    def __init__(self, window: StudioWindow, reload: Callable[[Path], object]) -> None:
        super().__init__(window)
        self._window, self._reload = window, reload
        self._workspace: Workspace | None = None
        self._refused: str | None = None
        self._watcher = QFileSystemWatcher(self)
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.timeout.connect(self._look)
        self._watcher.fileChanged.connect(self._wait)
        self._watcher.directoryChanged.connect(self._wait)

    def follow(self, workspace: Workspace | None) -> None:
        """Watch the file of a workspace, or nothing."""
        self._timer.stop()
        watched = self._watcher.files() + self._watcher.directories()
        if watched:
            self._watcher.removePaths(watched)
        self._workspace, self._refused = workspace, None
        if workspace is not None:
            self._watcher.addPaths([str(workspace.path), str(workspace.path.parent)])

    def _wait(self, _: str) -> None:
        self._timer.start(SETTLE_MS)

    def _look(self) -> None:
        workspace = self._workspace
        if workspace is None:
            return
        if workspace.is_saving or QApplication.activeModalWidget() is not None:
            self._timer.start(4 * SETTLE_MS)
            return
        if is_there(workspace.path) and str(workspace.path) not in self._watcher.files():
            self._watcher.addPath(str(workspace.path))
        state = workspace.disk_state()
        if state is None or state == self._refused:
            return
        self._refused = state  # asked once for each change
        if state == "removed":
            show_message(self._window, "File removed", f"{workspace.path.name} was removed or renamed by another program.\n\n"
                 "Your work is still open. Save it under a new name.")  # fmt: skip
            return
        lost = " Your unsaved changes will be lost." if workspace.is_dirty else ""
        question = f"{workspace.path.name} was changed by another program.\n\nReload it?{lost}"
        if ask(self._window, "Changed on disk", question, "&Reload", "Keep Open Version") == "&Reload":
            self._window.guarded(lambda: self._reload(workspace.path), "Open")
