"""Work that takes longer than a blink, in a thread of its own, with progress and cancel."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

from PySide6.QtCore import QObject, QThread, Signal
from PySide6.QtWidgets import QDialog, QDialogButtonBox, QLabel, QProgressBar, QVBoxLayout, QWidget

Progress = Callable[[str, int, int], None]
Work = Callable[[Progress, threading.Event], Any]


class Task(QThread):
    """Runs ``work(progress, cancel)`` and gives its result or its error as a signal."""

    progressed = Signal(str, int, int)
    done = Signal(object)
    failed = Signal(object)

    def __init__(self, work: Work, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._work = work
        self.cancelled = threading.Event()

    def run(self) -> None:
        try:
            result = self._work(self.progressed.emit, self.cancelled)
        except Exception as error:  # every error of the work belongs to whoever asked for it
            self.failed.emit(error)
        else:
            self.done.emit(result)


class ProgressDialog(QDialog):
    """Shows a task: what it does, the per cent, a cancel button, and at the end how it went."""

    def __init__(self, title: str, work: Work, parent: QWidget | None, hint: str = "") -> None:
        super().__init__(parent)
        self.setWindowTitle(title)
        self.setMinimumWidth(460)
        self.result_value: Any = None
        self.error: Exception | None = None
        self._text = QLabel(hint or title)
        self._text.setWordWrap(True)
        self._bar = QProgressBar()
        self._bar.setRange(0, 0)
        self._buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
        self._buttons.rejected.connect(self._cancel)
        layout = QVBoxLayout(self)
        for widget in (self._text, self._bar, self._buttons):
            layout.addWidget(widget)
        self.task = Task(work, self)
        self.task.progressed.connect(self._progress)
        self.task.done.connect(self._done)
        self.task.failed.connect(self._failed)
        self.task.finished.connect(self._ended)

    def run(self) -> Any:
        """Run the task to its end; returns its result or raises its error."""
        self.task.start()
        self.exec()
        self.task.wait()
        if self.error is not None:
            raise self.error
        return self.result_value

    def _progress(self, stage: str, done: int, total: int) -> None:
        self._text.setText(stage)
        self._bar.setRange(0, max(total, 0))
        self._bar.setValue(done)

    def _done(self, result: object) -> None:
        self.result_value = result

    def _failed(self, error: Exception) -> None:
        self.error = error

    def _ended(self) -> None:
        super().accept()

    def _cancel(self) -> None:
        self.task.cancelled.set()
        self._text.setText("Stopping at the next safe point …")
        self._buttons.setEnabled(False)

    def reject(self) -> None:
        """Escape and the window's close button cancel the task; the dialog closes when it has ended."""
        self._cancel()
