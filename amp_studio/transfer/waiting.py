"""Waiting on a line to a control that is no frame protocol: every wait has an end, silence is shown,
Ctrl-C ends it at once.
"""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable

from .errors import CancelledError
from .exchange import QUIET, Exchange
from .links import Link
from .progress import SILENT

_SLICE = 0.1  # seconds between two looks at the cancel event
SILENT_AFTER = 1.8  # seconds without an answer until the waiting caller is notified
_SILENT_EVERY = 1.0
OPERATOR = -1
"""The total of a progress whose stage is a sentence: what a person is to do at the control."""

OpenLink = Callable[[Callable[[], None]], Link]


class Waiting:
    """Whose progress and cancel event are obeyed just now, and how long nothing has been heard."""

    def __init__(
        self, clock: Callable[[], float] = time.monotonic, sleep: Callable[[float], None] = time.sleep
    ) -> None:
        self.now = clock
        self.sleep = sleep
        self._exchange = QUIET
        self._received_at = self._notified_at = clock()

    def begin(self, exchange: Exchange) -> None:
        """Serve another call."""
        self._exchange = exchange
        self._received_at = self._notified_at = self.now()

    @property
    def is_stopped(self) -> bool:
        """Whether a stop was asked for."""
        return self._exchange.is_stopped

    def look(self) -> None:
        """Notify of silence; raises CancelledError where a stop was asked for."""
        if self.is_stopped:
            raise CancelledError("stopped")
        now = self.now()
        silent = now - self._received_at
        if silent >= SILENT_AFTER and now - self._notified_at >= _SILENT_EVERY:
            self._notified_at = now
            self.notify(SILENT, round(silent), 0)

    def note_answer(self) -> None:
        """Something that was waited for has come."""
        was_silent = self._notified_at > self._received_at
        self._received_at = self._notified_at = self.now()
        if was_silent:
            self.notify(SILENT, 0, 0)

    def notify(self, stage: str, done: int, total: int) -> None:
        """Notify the waiting caller; an error in that ends no exchange."""
        with contextlib.suppress(Exception):
            self._exchange.progress(stage, done, total)

    def ask(self, sentence: str) -> None:
        """Show a person what to do at the control."""
        self.notify(sentence, 0, OPERATOR)

    def read(self, link: Link, seconds: float) -> bytes:
        """Return what comes within so many seconds, b"" for nothing; raises LinkError, CancelledError."""
        end = self.now() + seconds
        while True:
            self.look()
            left = end - self.now()
            data = link.read(max(0.0, min(left, _SLICE)))
            if data or left <= _SLICE:
                return data
