"""Something that opens a line and cannot be broken off: it runs in a thread of which the caller is free."""

from __future__ import annotations

import contextlib
import queue
import threading
import time
from collections.abc import Callable
from typing import Generic, TypeVar

Made = TypeVar("Made")

SLICE = 0.1  # seconds between two looks while waiting


def in_time(
    work: Callable[[], Made],
    put_away: Callable[[Made], object],
    timeout: float,
    look: Callable[[], None],
    error_of: Callable[[Exception], Exception],
) -> Made:
    """Return what ``work`` makes within ``timeout`` seconds; raises what ``look`` raises.

    Where it fails or takes too long, raises what ``error_of`` makes of its error or of a TimeoutError. What
    it makes when the caller has stopped waiting is given to ``put_away``.
    """
    attempt = _Attempt(work, put_away)
    threading.Thread(target=attempt.run, name="connect", daemon=True).start()
    end = time.monotonic() + timeout
    made: Made | Exception
    try:
        while True:
            look()
            left = end - time.monotonic()
            if left <= 0:
                made = TimeoutError()
                attempt.abandon()
                break
            with contextlib.suppress(queue.Empty):
                made = attempt.result.get(timeout=min(left, SLICE))
                break
    except BaseException:
        attempt.abandon()
        raise
    if isinstance(made, Exception):
        raise error_of(made) from None
    return made


class _Attempt(Generic[Made]):
    """One line in the making."""

    def __init__(self, work: Callable[[], Made], put_away: Callable[[Made], object]) -> None:
        self.result: queue.SimpleQueue[Made | Exception] = queue.SimpleQueue()
        self._work = work
        self._put_away = put_away
        self._is_abandoned = threading.Event()

    def run(self) -> None:
        try:
            self.result.put(self._work())
        except Exception as error:  # the waiting caller gets it
            self.result.put(error)
        if self._is_abandoned.is_set():
            self.abandon()

    def abandon(self) -> None:
        self._is_abandoned.set()
        with contextlib.suppress(queue.Empty):
            made = self.result.get_nowait()
            if not isinstance(made, Exception):
                self._put_away(made)
