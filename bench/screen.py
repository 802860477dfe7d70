"""The desktop program while it is used on the full file, on Qt's offscreen platform."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import cycle
from pathlib import Path
from typing import TYPE_CHECKING

from desktop import PaintEar, until_painted, window_with
from measure import Measure, timed, worst

if TYPE_CHECKING:
    from amp_studio.ui.main_window import MainWindow

KEYSTROKE, EDIT, FRAME, SWITCH = 0.030, 0.030, 0.016, 0.100
"""Seconds until all is painted, at worst: a key in the find box, an edit, a page of the table; and a file that is
opened, or another theme."""
EDITS = (
    ("a value", ("servo.excess_error", "1"), ("12 mm", "11 mm")),
    ("a value with ten findings", ("servo.initial_gain", "1"), ("0.001", "1")),
    ("another type of axis, with its rows", ("axis.type", "1"), ("rotary", "linear")),
)
"""What is edited, and the two values that it gets in turn."""


def measures(full: Path, example: Path, times: int) -> Iterator[Measure]:
    """Yield what is done at a file in front takes until it is painted, and what opening it does."""
    with window_with(full) as window:
        yield from _typed(window, times)
        yield from _edited(window, times)
        yield from _seen(window, times)
    with window_with(example) as window:
        ear = PaintEar()
        opened = timed(lambda: ear.wait_for(lambda: window.open_path(full)), times, lambda: _close(window, full))
        yield Measure("a full file opened in a running window, painted", opened, SWITCH)


def _typed(window: MainWindow, times: int) -> Iterator[Measure]:
    box = window.finder.box
    box.begin("")
    texts = cycle(["f", "fo", "fol", "foll", "follo", "follow"])
    search = until_painted(lambda: (box.setText(next(texts)), box.search()))
    yield Measure("keystroke in the find box, painted", timed(search, 6 * times), KEYSTROKE)
    box.clear()
