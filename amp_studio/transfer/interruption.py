"""Ctrl-C and a polite kill, while something runs that must end with the truth."""

from __future__ import annotations

import contextlib
import signal
import threading
from collections.abc import Callable, Iterator
from types import FrameType


@contextlib.contextmanager
def interrupts(call: Callable[[], object], after: signal.Handlers | None = None) -> Iterator[None]:
    """Have SIGINT and SIGTERM call ``call``, which must return at once, instead of ending what runs inside.

    Only the main thread hears signals; elsewhere this does nothing. A program started to ignore a signal (as
    ``nohup`` does) goes on ignoring it. At the end the signals do again what they did before, or ``after``.
    """

    def handle(_: int, __: FrameType | None) -> None:
        call()

    old = {}
    if threading.current_thread() is threading.main_thread():
        for number in (signal.SIGINT, signal.SIGTERM):
            if signal.getsignal(number) is not signal.SIG_IGN:
                old[number] = signal.signal(number, handle)
    try:
        yield
    finally:
        for number, before in old.items():
            signal.signal(number, after or before or signal.SIG_DFL)
