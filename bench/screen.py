"""The desktop program while it is used, on Qt's offscreen platform."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import cycle
from pathlib import Path
from typing import TYPE_CHECKING

from desktop import window_with
from measure import Measure, timed

if TYPE_CHECKING:
    from amp_studio.ui.main_window import MainWindow


def measures(full: Path, times: int) -> Iterator[Measure]:
    """Yield what a keystroke and an edit cost until everything is painted again."""
    with window_with(full) as window:
        yield from _typed(window, times)


def _typed(window: MainWindow, times: int) -> Iterator[Measure]:
    from PySide6.QtCore import QCoreApplication

    box = window.finder.box
    box.begin("")

    def until_painted(act: Callable[[], object]) -> Callable[[], None]:
        def call() -> None:
            act()
            QCoreApplication.processEvents()

        return call

    texts = cycle(["f", "fo", "fol", "foll", "follo", "follow"])
    search = until_painted(lambda: (box.setText(next(texts)), box.search()))
    yield Measure("keystroke in the find box, painted", timed(search, 6 * times), 0.030)
    box.clear()
    window.go_to(("servo.excess_error", "1"))
    values = cycle(["12 mm", "11 mm"])
    edit = until_painted(lambda: window.edits.commit(("servo.excess_error", "1"), next(values)))
    yield Measure("edit of a value in the table, painted", timed(edit, 4 * times))
