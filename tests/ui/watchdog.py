"""Notices when the window does not come back to its event loop."""

from __future__ import annotations

import time
from types import TracebackType

from PySide6.QtCore import QTimer

BEAT_MS = 2


class Watchdog:
    """Beats by a timer of the window while ``with`` lasts; each stall is how long the main thread worked between two beats.

    That is the time of the processor, not of the clock: a machine that is busy with other things is no stall.
    """

    def __init__(self) -> None:
        self.stalls: list[tuple[str, float]] = []
        """What was going on, and milliseconds."""
        self.doing = ""
        self._last = 0.0
        self._timer = QTimer()
        self._timer.timeout.connect(self._beat)

    def _beat(self) -> None:
        now = time.thread_time()
        self.stalls.append((self.doing, (now - self._last) * 1000))
        self._last = now

    def over(self, limit: float) -> dict[str, float]:
        """Return the longest stall over a limit in milliseconds, for each thing that was going on."""
        found: dict[str, float] = {}
        for doing, stall in self.stalls:
            if stall > limit:
                found[doing] = max(stall, found.get(doing, 0.0))
        return found

    def __enter__(self) -> Watchdog:
        self._last = time.thread_time()
        self._timer.start(BEAT_MS)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._beat()
        self._timer.stop()
