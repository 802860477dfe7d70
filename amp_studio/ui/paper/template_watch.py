"""Notices when the report templates of a project, or the pictures that they show, are saved."""

from __future__ import annotations

import contextlib
from collections.abc import Sequence
from itertools import islice
from pathlib import Path

from PySide6.QtCore import QFileSystemWatcher, QObject, Signal

from amp_studio.report import OWN
from amp_studio.ui.base.single_shot import single_shot

_SETTLE_MS = 150
"""Milliseconds to wait, as an editor may write a file in several steps."""


_MAX_FILES = 200
"""Files of a folder that are watched."""


class TemplateWatch(QObject):
    """Watches the folder ``templates`` beside a file, also while there is none yet."""

    changed = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._folder: Path | None = None
        self._state: object = None
        self._watcher = QFileSystemWatcher(self)
        self._timer = single_shot(self, self._compare, _SETTLE_MS)
        self._watcher.fileChanged.connect(lambda _: self._timer.start())
        self._watcher.directoryChanged.connect(lambda _: self._timer.start())

    def watch(self, folder: Path | None) -> None:
        """Watch the templates of a project's folder; None watches nothing."""
        if folder == self._folder:
            return
        self._folder = folder
        if known := [*self._watcher.files(), *self._watcher.directories()]:
            self._watcher.removePaths(known)
        self._state = self._read()

    def _compare(self) -> None:
        before, self._state = self._state, self._read()
        if before != self._state:
            self.changed.emit()

    def _read(self) -> object:
        """Return what the folder has, and watch what is new:
        a rename over a file ends the watch of that file.
        """
        if self._folder is None:
            return None
        own = self._folder / OWN
        found: list[tuple[str, int, int]] = []
        with contextlib.suppress(OSError):  # there is no folder, or a file goes away just now
            self._add([self._folder, own])
            files = [path for path in sorted(islice(own.iterdir(), _MAX_FILES)) if path.is_file()]
            self._add(files)  # before their state is read: what is saved after that is noticed
            for path in files:
                known = path.stat()
                found.append((path.name, known.st_mtime_ns, known.st_size))
        return found

    def _add(self, paths: Sequence[Path]) -> None:
        watched = {*self._watcher.files(), *self._watcher.directories()}
        if new := [str(path) for path in paths if str(path) not in watched and path.exists()]:
            self._watcher.addPaths(new)
