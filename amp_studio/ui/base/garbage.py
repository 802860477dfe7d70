"""Python's garbage is collected by a timer of the event loop, and at no other moment.

Python collects wherever it happens to allocate, and a closed window is garbage with cycles. In another thread
Qt crashes where it is destroyed. In the middle of what Qt does in the window's own thread, it waits for ever:
while an object is destroyed, PySide looks for its Python methods, and another object that is destroyed in
there needs a lock that the first one has.

What belongs to an open file lives as long as it is open: a collection need not look at it. With five files
open, looking at all of it stalls the window for a quarter of a second;
without them it is over in a third of a millisecond.

What a file needs is made in the seconds after it was opened, and is then set apart. Until then only the
youngest objects are collected, and often: each collection is paid by one frame of a scrolling table.

Everything is gone through once no file was closed or opened for some seconds. That stalls the
window for a third of a second: files are closed one after another, and work goes on in the next one.

What is freed goes back to the system after a whole collection. The C library keeps free pages between those
in use, in an area for each thread that has ever run: 40 to 110 MB of the 500 that a long day takes.
"""

from __future__ import annotations

import ctypes
import gc
import sys
from collections.abc import Callable

from PySide6.QtCore import QCoreApplication, QDeadlineTimer, QObject, QTimer

COLLECT_MS = 100
"""Milliseconds between two looks whether there is enough to collect."""
REST_MS = 3000
"""Milliseconds after the last closing until everything is gone through."""
_NAME, _REST = "garbage", "garbage of closed files"
"""Names of the two timers."""
_BACKGROUND_MS = 4000
"""Milliseconds until the background work after opening a file is done."""
_opening = QDeadlineTimer(0)
"""Expires when the file opened last has what it needs."""


def collect_by_timer() -> None:
    """Leave the collection of garbage to the event loop from now on; the application has one timer for it."""
    gc.disable()
    timer = _timer(_NAME, collect)
    if timer is not None and not timer.isActive():
        timer.start(COLLECT_MS)


def _timer(name: str, act: Callable[[], None]) -> QTimer | None:
    """Return a timer that the application has once; None without an application."""
    application = QCoreApplication.instance()
    if application is None:
        return None
    timer = application.findChild(QTimer, name)
    if timer is None:
        timer = QTimer(application)
        timer.setObjectName(name)
        timer.timeout.connect(act)
    return timer


def set_apart(page: QObject) -> None:
    """Leave what there is now out of later collections,
    and once more when what the page makes in the background is there.
    """
    gc.freeze()
    _opening.setRemainingTime(_BACKGROUND_MS)
    rest = _timer(_REST, collect_closed)
    if rest is not None and rest.isActive():
        rest.start(REST_MS + _BACKGROUND_MS)
    QTimer.singleShot(_BACKGROUND_MS, page, gc.freeze)


def collect_soon() -> None:
    """Look at everything again after a rest: a file was closed, and what belonged to it is garbage."""
    rest = _timer(_REST, collect_closed)
    if rest is not None:
        rest.setSingleShot(True)
        rest.start(REST_MS)


def collect_closed() -> None:
    """Collect what belonged to closed files, and set apart what is left."""
    gc.unfreeze()
    gc.collect()
    _return_free_pages()
    gc.freeze()


def collect() -> None:
    """Collect the oldest generation that has as many objects as Python would collect it for;
    after an opening the youngest.
    """
    for generation in (2, 1, 0) if _opening.hasExpired() else (0,):
        if gc.get_count()[generation] > gc.get_threshold()[generation]:
            gc.collect(generation)
            if generation == 2:
                _return_free_pages()
            return


def _return_free_pages() -> None:
    """Give free pages back to the system, where the C library is glibc; it takes 1 to 20 ms."""
    if sys.platform == "linux" and (trim := getattr(ctypes.CDLL(None), "malloc_trim", None)) is not None:
        trim(0)
