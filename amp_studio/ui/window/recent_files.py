"""The files that were open before: the pinned ones, the latest ones, and the menu of them."""

from __future__ import annotations

from collections.abc import Callable
from datetime import UTC, datetime
from functools import partial
from pathlib import Path

from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMenu

from amp_studio.ui.base.translated import Translated

from .settings import is_there
from .studio_window import StudioWindow

_KEPT, _IN_MENU = 24, 9


class RecentFiles(Translated):
    """The recent files of the user's settings; ``open_path`` opens the one that is chosen in the menu."""

    def __init__(self, window: StudioWindow, open_path: Callable[[Path], None]) -> None:
        self._window, self._open_path = window, open_path
        self.menu = QMenu(self.tr("Open R&ecent"), window)
        self.menu.aboutToShow.connect(self._fill)
        self.menu.setEnabled(bool(self.paths()))

    def paths(self) -> list[Path]:
        """Return the recent files that still exist, the pinned ones first."""
        settings = self._window.settings
        # A dictionary keeps the order and takes each path once: a pinned one is recent too.
        paths = dict.fromkeys((*settings.pinned(), *settings.recent()[:_KEPT]))
        return [path for path in paths if is_there(path)]

    def pin(self, path: Path) -> None:
        """Keep a file at the top, or no longer."""
        settings = self._window.settings
        pinned = settings.pinned()
        settings.keep_pinned([p for p in pinned if p != path] if path in pinned else [*pinned, path])

    def forget(self, path: Path) -> None:
        """Take a file off the list; the file itself stays."""
        settings = self._window.settings
        settings.keep_pinned([p for p in settings.pinned() if p != path])
        settings.keep_recent([p for p in settings.recent() if p != path])

    def remember(self, path: Path) -> None:
        """Put a file that has been opened in front of the others."""
        path, settings = path.absolute(), self._window.settings
        settings.keep_recent([path, *(p for p in settings.recent() if p != path and is_there(p))][:_KEPT])
        self.menu.setEnabled(True)

    def _fill(self) -> None:
        paths = self.paths()[:_IN_MENU]
        if paths == [action.data() for action in self.menu.actions()]:
            return
        self.menu.clear()
        for n, path in enumerate(paths, 1):
            action = QAction(f"&{n} {path.name.replace('&', '&&')}  ({path.parent})", self.menu)
            action.setData(path)
            action.triggered.connect(
                lambda *_, path=path: self._window.guarded(partial(self._open_path, path), self.tr("Open"))
            )
            self.menu.addAction(action)


def changed_at(path: Path) -> datetime | None:
    """Return when a file was changed, in local time; None for a file that cannot be asked."""
    try:
        return datetime.fromtimestamp(path.stat().st_mtime, UTC).astimezone()
    except (OSError, OverflowError, ValueError):
        return None


def folder_of(path: Path) -> str:
    """Return the folder of a file, short."""
    try:
        return f"~/{path.parent.relative_to(Path.home())}"
    except (ValueError, RuntimeError):
        return str(path.parent)
