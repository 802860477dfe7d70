"""A timer that calls once after each start."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject, QTimer


def single_shot(owner: QObject | None, act: Callable[[], object], wait_ms: int = 0) -> QTimer:
    """Return a timer that calls ``act`` once, ``wait_ms`` after its start; another start begins again."""
    timer = QTimer(owner)
    timer.setSingleShot(True)
    timer.setInterval(wait_ms)
    timer.timeout.connect(act)
    return timer
