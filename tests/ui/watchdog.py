"""Notices when the window does not come back to its event loop."""

from __future__ import annotations

import time
from types import TracebackType

from PySide6.QtCore import QTimer

BEAT_MS = 2
TRIAL_MS = 3.0
"""What the trial takes on a machine with nothing else to do, one for which the limits are meant."""


def slowness() -> float:
    """Return how many times longer this machine takes for the same work now:
    processors share caches and pipelines.
    """
    begin = time.thread_time()
    sum(n * n for n in range(100_000))
    return max(1.0, (time.thread_time() - begin) * 1000 / TRIAL_MS)


class Watchdog:
    """Beats by a timer of the window while ``with`` lasts;
    each stall is how long the main thread worked between two beats.

    That is the time of the processor, not of the clock: a machine that is busy with other things is no stall.
    Neither is one whose processor is slow while others share it, which a trial before each action measures.
    """

    def __init__(self) -> None:
        self.stalls: list[tuple[int, float]] = []
        """Number of the action, and milliseconds."""
        self._actions = [""]
        self._slowness = [1.0]
        """Before each action, and at the end."""
        self._last = 0.0
        self._timer = QTimer()
        self._timer.timeout.connect(self._beat)

    def _beat(self) -> None:
        now = time.thread_time()
        self.stalls.append((len(self._actions) - 1, (now - self._last) * 1000))
        self._last = now

    def watch(self, action: str) -> None:
        """Say what is going on from now on."""
        self._beat()
        self._actions.append(action)
        self._slowness.append(slowness())
        self._last = time.thread_time()

    def over(self, limit: float) -> dict[str, float]:
        """Return the longest stall over a limit in milliseconds, for each action.

        The trials before and behind an action, and one more on both sides,
        give it as much more time as they were slow.
        """
        found: dict[str, float] = {}
        for number, stall in self.stalls:
            if stall > limit * max(self._slowness[max(0, number - 1) : number + 3]):
                action = self._actions[number]
                found[action] = max(stall, found.get(action, 0.0))
        return found

    def __enter__(self) -> Watchdog:
        self._slowness[0] = slowness()
        self._last = time.thread_time()
        self._timer.start(BEAT_MS)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._beat()
        self._timer.stop()
        self._slowness.append(slowness())
