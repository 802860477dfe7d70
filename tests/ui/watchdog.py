"""Notices when the window does not come back to its event loop."""

from __future__ import annotations

import sys
import time
from types import TracebackType

from PySide6.QtCore import QTimer

from tests.campaigns import CAMPAIGN

BEAT_MS = 2


class Watchdog:
    """Beats by a timer of the window while ``with`` lasts;
    each stall is how much the main thread worked between two beats.

    In the tests that is a number of calls, which is the same on every machine. In the campaign it is
    milliseconds of the processor: what a person waits, on a machine with nothing else to do.
    """

    UNIT = "ms" if CAMPAIGN else "calls"

    def __init__(self) -> None:
        self.stalls: dict[str, float] = {}
        """The longest of each action."""
        self._action = ""
        self._calls = 0
        self._last = 0.0
        self._timer = QTimer()
        self._timer.timeout.connect(self._beat)

    def _count(self, _frame: object, event: str, _argument: object) -> None:
        self._calls += event.endswith("call")

    def _now(self) -> float:
        return time.thread_time() * 1000 if CAMPAIGN else self._calls

    def _beat(self) -> None:
        now = self._now()
        self.stalls[self._action] = max(now - self._last, self.stalls.get(self._action, 0.0))
        self._last = now

    def watch(self, action: str) -> None:
        """Say what is going on from now on."""
        self._beat()
        self._action = action

    def over(self, limit: float) -> dict[str, float]:
        """Return the longest stall over a limit, for each action."""
        return {action: stall for action, stall in self.stalls.items() if stall > limit}

    def __enter__(self) -> Watchdog:
        self._last = self._now()
        if not CAMPAIGN:
            sys.setprofile(self._count)
        self._timer.start(BEAT_MS)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._beat()
        if not CAMPAIGN:
            sys.setprofile(None)
        self._timer.stop()
