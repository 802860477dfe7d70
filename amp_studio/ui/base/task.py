"""Long work in a separate thread, with progress and cancel."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable
from typing import Any, ClassVar, TypeVar

from PySide6.QtCore import QEventLoop, QObject, QThread, Signal
from PySide6.QtWidgets import QDialog, QDialogButtonBox, QLabel, QProgressBar, QWidget

from .garbage import collect_by_timer
from .layout import in_column
from .modal import run_dialog, waiting_for
from .single_shot import single_shot

TaskProgress = Callable[[str, int, int], None]
"""Takes a stage, how much is done and of how much; that of an exchange (``transfer.progress``)
has the same arguments."""
Work = Callable[[TaskProgress, threading.Event], Any]
_T = TypeVar("_T")

PATIENCE_MS = 300
"""Milliseconds that work may last before a progress dialog is shown."""

_TURN_S = 0.00005
"""Seconds after which a thread lets the window have its turn. Python's own 5 ms, paid several times while a
frame is painted, would be seen."""
STOPPING = "Stopping at the next safe point …"


class Task(QThread):
    """Runs ``work(progress, cancel)`` and emits its result or its error.

    A task may outlive the widget that started it: the program waits for all tasks at its end.

    Only the window's thread collects garbage (see ``garbage``).
    """

    progressed = Signal(str, int, int)
    done = Signal(object)
    failed = Signal(object)

    running: ClassVar[set[Task]] = set()

    def __init__(self, work: Work, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._work = work
        self._result: Any = None
        self._error: Exception | None = None
        self.cancelled = threading.Event()
        self.finished.connect(self._discard)

    def begin(self) -> None:
        """Start the thread."""
        # Qt ends the process where a QThread is collected while it runs: the set keeps it until its end.
        Task.running.add(self)
        collect_by_timer()
        sys.setswitchinterval(_TURN_S)
        self.start()

    def _discard(self) -> None:
        self.wait()  # "finished" comes just before the end
        Task.running.discard(self)

    @classmethod
    def end_all(cls) -> None:
        """Cancel all running tasks and wait for their end."""
        for task in list(cls.running):
            task.cancelled.set()
            task.wait()
            cls.running.discard(task)

    def run(self) -> None:
        try:
            self._result = self._work(self.progressed.emit, self.cancelled)
        except Exception as error:  # every error of the work is raised in the caller
            self._error = error
            self.failed.emit(error)
        else:
            self.done.emit(self._result)

    def outcome(self) -> Any:
        """Wait for the end; returns the result or raises the error. Needs no events: a program that is
        ended from outside runs none any more.
        """
        self.wait()
        if self._error is not None:
            raise self._error
        return self._result


class ProgressDialog(QDialog):
    """Shows a task: its stage, the percentage, and a cancel button if the work can be cancelled.

    ``stages`` maps stage names to texts; other stages are shown by their name.
    The work may be a task that has begun.
    """

    def __init__(
        self,
        title: str,
        work: Work | Task,
        parent: QWidget | None,
        hint: str = "",
        stages: dict[str, str] | None = None,
        cancellable: bool = True,
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(title)
        self.setMinimumWidth(460)
        self._stages = stages or {}
        self._cancellable = cancellable
        self._stage = hint or title
        self.text = QLabel(self._stage)
        self.text.setWordWrap(True)
        self.bar = QProgressBar()
        self.bar.setRange(0, 0)
        self.buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
        self.buttons.rejected.connect(self.reject)
        self.buttons.setVisible(cancellable)
        if not cancellable:
            self.setFocus()  # else the keyboard is nowhere, and its way back from here is not seen
        in_column(self.text, self.bar, self.buttons, on=self, gap=10)
        self.task = work if isinstance(work, Task) else Task(work)
        self.task.progressed.connect(self._progress)
        self.task.finished.connect(self.accept)

    def run(self) -> Any:
        """Run the task; returns its result or raises its error.

        Raises AskerGoneError where the parent is gone at the end.
        """
        if not self.task.isRunning() and not self.task.isFinished():
            self.task.begin()
        if not self.task.isFinished():
            run_dialog(self)
        self.deleteLater()
        return self.task.outcome()

    def _progress(self, stage: str, done: int, total: int) -> None:
        if stage in ("silent", "cut"):
            silence = self.tr("No answer for {done} s").format(done=done) if done else ""
            self._silence(self.tr("The line is cut") if stage == "cut" else silence)
            return
        self._stage = self._stages.get(stage, stage)
        if not self.task.cancelled.is_set():
            self.text.setText(self._stage)
        self.bar.setRange(0, max(total, 0))
        self.bar.setValue(done)

    def _silence(self, why: str) -> None:
        """Show why there is no answer; nothing when there is one again."""
        waiting = self.tr("\n{why}, trying again …").format(why=why) if why else ""
        doing = STOPPING if self.task.cancelled.is_set() else self._stage
        self.text.setText(doing + waiting)

    def reject(self) -> None:
        """Escape and the close button cancel the task; the dialog closes when the task has ended."""
        if self._cancellable:
            self.task.cancelled.set()
            self.text.setText(STOPPING)
            self.buttons.setEnabled(False)


def run_with_progress(
    title: str,
    work: Work,
    parent: QWidget | None,
    hint: str = "",
    stages: dict[str, str] | None = None,
    cancellable: bool = True,
) -> Any:
    """Run work in a thread; returns its result or raises its error.
    A ``ProgressDialog`` shows it where it lasts longer than a moment.

    Raises AskerGoneError where the parent is gone at the end.
    """
    task = Task(work)
    _wait_quietly(task, parent)
    if task.isFinished():
        return task.outcome()
    return ProgressDialog(title, task, parent, hint, stages, cancellable).run()


def _wait_quietly(task: Task, parent: QWidget | None) -> None:
    """Begin a task, and keep painting for a moment; keys and clicks are handled afterwards."""
    loop = QEventLoop()
    timer = single_shot(None, loop.quit)
    task.finished.connect(loop.quit)
    task.begin()
    timer.start(PATIENCE_MS)
    with waiting_for(parent):
        loop.exec(QEventLoop.ProcessEventsFlag.ExcludeUserInputEvents)


def in_background(parent: QWidget | None, title: str, work: Callable[[], _T]) -> _T:
    """Return the result of ``work``, run in a thread while the window stays responsive; raises its errors."""

    def run(_: TaskProgress, __: threading.Event) -> _T:
        return work()

    result: _T = run_with_progress(title, run, parent, f"{title} …", cancellable=False)
    return result
