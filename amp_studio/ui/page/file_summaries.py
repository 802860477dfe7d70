"""What lists of files show of each, read in the background one after the other
and kept while the files stay as they are.
"""

from __future__ import annotations

import threading
from collections.abc import Iterable
from functools import partial
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from amp_studio.guide import FileSummary, summary_of
from amp_studio.ui.base.task import Task, TaskProgress


class FileSummaries(QObject):
    """The summaries of one window; a file that has changed is read again when it is wanted."""

    summary_read = Signal(object)
    """The path of a file whose summary is known now."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._known: dict[tuple[Path, int], FileSummary | str] = {}
        self._asked: list[Path] = []
        self._reading: Task | None = None
        self._is_over = False

    def of(self, path: Path) -> FileSummary | str | None:
        """Return the summary of a file, or why it has none; None while it is not known."""
        return self._known.get(_version(path))

    def want(self, paths: Iterable[Path]) -> None:
        """Read what is not known of these files, in their order; what was asked for before is dropped."""
        self._asked = [] if self._is_over else list(paths)
        self._next()

    def stop(self) -> None:
        """Read nothing any more; the window is closing."""
        self._asked, self._is_over = [], True

    def _next(self) -> None:
        while self._asked and self._reading is None:
            path = self._asked.pop(0)
            if self.of(path) is None:
                self._reading = task = Task(partial(_summary, path))
                task.done.connect(self._keep)  # a bound method: it ends with this object
                task.finished.connect(self._done)
                task.begin()

    def _keep(self, read: tuple[tuple[Path, int], FileSummary | str]) -> None:
        version, summary = read
        self._known[version] = summary
        self.summary_read.emit(version[0])

    def _done(self) -> None:
        self._reading = None
        self._next()


def _summary(path: Path, _: TaskProgress, __: threading.Event) -> tuple[tuple[Path, int], FileSummary | str]:
    """Return a file as it is now and its summary, or why there is none."""
    version = _version(path)
    try:
        return version, summary_of(path)
    except (OSError, ValueError) as error:
        return version, str(error)


def _version(path: Path) -> tuple[Path, int]:
    """Return a file as it is now: another content is another version."""
    try:
        return path, path.stat().st_mtime_ns
    except OSError:
        return path, 0
