"""Simulates in a thread what was asked for last."""

from __future__ import annotations

import threading
from collections.abc import Callable

from PySide6.QtCore import QObject, Signal

from amp_studio.sim import SimulationError
from amp_studio.ui.base.task import Task, TaskProgress


class LatestWork(QObject):
    """Does work in a thread, one after the other; of what is asked meanwhile only the last is done."""

    done = Signal(object)
    """What was asked for last has this result, or this error."""

    def __init__(self) -> None:
        super().__init__()
        self._task: Task | None = None
        self._next: Callable[[], object] | None = None

    @property
    def is_busy(self) -> bool:
        """Whether something is under way."""
        return self._task is not None

    def ask(self, work: Callable[[], object]) -> None:
        """Do it, once what is under way has ended."""
        self._next = work
        if self._task is None:
            self._begin()

    def stop(self) -> None:
        """Want nothing any more; what is under way ends unheard."""
        self._next = None
        if self._task is not None:
            # Disconnected, not cancelled: a simulation cannot be interrupted; its result is dropped.
            self._task.done.disconnect(self._receive)
            self._task.failed.disconnect(self._receive)
            self._task = None

    def _begin(self) -> None:
        work, self._next = self._next, None
        assert work is not None

        def run(_progress: TaskProgress, _cancelled: threading.Event) -> object:
            return work()

        self._task = Task(run)
        self._task.done.connect(self._receive)
        self._task.failed.connect(self._receive)
        self._task.begin()

    def _receive(self, found: object) -> None:
        self._task = None
        if self._next is not None:
            self._begin()
        # A move that cannot be simulated is an answer for the page; other errors are faults of the program.
        elif isinstance(found, Exception) and not isinstance(found, SimulationError):
            raise found
        else:
            self.done.emit(found)
