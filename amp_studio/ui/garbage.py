"""Python's garbage is collected by a timer of the event loop, and at no other moment.

Python collects wherever it happens to allocate, and a closed window is garbage with cycles. In another thread Qt crashes
where it is destroyed. In the middle of what Qt does in the window's own thread, it waits for ever: while an object is
destroyed, PySide looks for its Python methods, and another object that is destroyed in there needs a lock that the
first one has.
"""

from __future__ import annotations

import gc

from PySide6.QtCore import QCoreApplication, QTimer

COLLECT_MS = 2000
"""Milliseconds between two looks whether there is enough to collect."""
_NAME = "garbage"


def collect_by_timer() -> None:
    """Leave the collection of garbage to the event loop from now on; the application has one timer for it."""
    gc.disable()
    application = QCoreApplication.instance()
    if application is not None and application.findChild(QTimer, _NAME) is None:
        timer = QTimer(application)
        timer.setObjectName(_NAME)
        timer.timeout.connect(collect)
        timer.start(COLLECT_MS)


def collect() -> None:
    """Collect the oldest generation that has as many objects as Python would collect it for."""
    for generation in (2, 1, 0):
        if gc.get_count()[generation] > gc.get_threshold()[generation]:
            gc.collect(generation)
            return
