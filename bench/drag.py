"""A handle of a picture that is dragged in a window of 1440 by 900, all pictures in view.
The slowest frame of many counts.
"""

from __future__ import annotations

import shutil
import time
from collections.abc import Iterator
from itertools import cycle
from pathlib import Path
from typing import TYPE_CHECKING

from desktop import window_with
from measure import Measure

if TYPE_CHECKING:
    from amp_studio.ui.main_window import MainWindow

FRAME = 0.016
"""Seconds that a frame may take at worst, until all is painted. Processor time,
which other programs do not add to."""
EXAMPLES = Path(__file__).resolve().parent.parent / "examples"
DRAGGED = (
    ("9/PC", "mill-1394/MILL_1394.amp", ("zone.overtravel_negative", "1")),
    ("NUM", "num-1060-mill/MILL_1060.amp", ("travel.limit_max", "0")),
)


def measures(folder: Path, times: int) -> Iterator[Measure]:
    """Yield what a frame of a drag takes; in some of them findings and other views follow."""
    for name, example, address in DRAGGED:
        with window_with(Path(shutil.copy(EXAMPLES / example, folder))) as window:
            yield from _dragged(window, times, name, address)


def _dragged(window: MainWindow, times: int, name: str, address: tuple[str, str]) -> Iterator[Measure]:
    from PySide6.QtCore import QCoreApplication, QPointF, Qt
    from PySide6.QtTest import QTest

    window.pictures.show(window.page, True)
    QCoreApplication.processEvents()
    canvas = window.pictures.pages(window.page).cards["travel"].canvas
    number = next(n for n, h in enumerate(canvas.scene.handles) if h.drags[0].address == address)
    start = QPointF(*canvas.place.at(canvas.scene.handles[number].at))
    QTest.mousePress(canvas, Qt.MouseButton.LeftButton, pos=start.toPoint())
    places = cycle([*range(1, 41), *range(39, 0, -1)])
    frames = []
    for n in range(-3, 20 * times):
        begin = time.process_time()
        canvas.drag_to(QPointF(start.x() + next(places), start.y()))
        QCoreApplication.processEvents()
        if n >= 0:  # the first ones still build what the press began
            frames.append(time.process_time() - begin)
    yield Measure(f"frame of a dragged handle, {name}, processor time", tuple(frames), FRAME)
    yield Measure("  the worst of all, with findings and other views", (max(frames),), FRAME)
    QTest.keyClick(canvas, Qt.Key.Key_Escape)
