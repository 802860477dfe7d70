"""How often a control answers, and how old its last answer is."""

from __future__ import annotations

from collections import deque
from datetime import UTC, datetime

from PySide6.QtCore import QObject, QTimer, Signal

from amp_studio.ui.base.figures import written
from amp_studio.ui.base.single_shot import single_shot

_SILENT_MS = 2000
"""Milliseconds without an answer after which the figures are grey."""
_RATED = 10
"""Readings from which the rate is counted."""


class AnswerTimes(QObject):
    """The times of the answers while a control is asked."""

    silent = Signal()
    """No answer for so long that the figures are old."""
    aged = Signal(str)
    """The rate of the answers, or the age of the last one, in words: at each of them and once a second."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.last: datetime | None = None
        self._times: deque[float] = deque(maxlen=_RATED)
        self._silence = single_shot(self, self.silent.emit, _SILENT_MS)
        self._clock = QTimer(self)
        self._clock.setInterval(1000)
        self._clock.timeout.connect(self.show_age)

    def begin(self) -> None:
        """Await answers from now on."""
        self._silence.start()
        self._clock.start()

    def end(self) -> None:
        """Await no more; the last answer gets its age."""
        self._silence.stop()
        self._clock.stop()
        self.show_age()

    def take(self, at: float) -> None:
        """Count an answer of a time in seconds."""
        self._silence.start()
        self._times.append(at)
        self.last = datetime.now(UTC).astimezone()

    def show_age(self) -> None:
        """Give how often the control answers, and how old its last answer is."""
        if self.last is None:
            self.aged.emit(self.tr("no readings yet"))
            return
        age = max((datetime.now(UTC).astimezone() - self.last).total_seconds(), 0.0)
        text = self.tr("{age} s old").format(age=written(f"{age:.1f}" if age < 10.0 else f"{age:.0f}"))
        if self._clock.isActive() and age < 0.001 * _SILENT_MS and len(self._times) > 1:
            rate = (len(self._times) - 1) / max(self._times[-1] - self._times[0], 1e-3)
            text = self.tr("{rate} readings a second").format(
                rate=written(f"{rate:.0f}" if rate >= 1.0 else f"{rate:.1f}")
            )
        self.aged.emit(text)
