"""The parameter table at its largest: every parameter of the NUM mill in a window of 1440 by 900.
The slowest of many counts.
"""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from itertools import cycle
from pathlib import Path
from typing import TYPE_CHECKING, Any

from desktop import until_painted, window_with
from measure import Measure, timed, worst

if TYPE_CHECKING:
    from amp_studio.ui.main_window import MainWindow

FRAME, KEYSTROKE, EDIT = 0.016, 0.030, 0.050
"""Seconds that a frame of a scrolling table, a keystroke and an edit may take at worst, until all is
painted."""
EXAMPLE = Path(__file__).resolve().parent.parent / "examples" / "num-1060-mill" / "MILL_1060.amp"


def measures(folder: Path, times: int) -> Iterator[Measure]:
    """Yield the slowest frame, keystroke and edit of the table."""
    with window_with(Path(shutil.copy(EXAMPLE, folder))) as window:
        yield from _used(window, times)


def _used(window: MainWindow, times: int) -> Iterator[Measure]:
    from PySide6.QtCore import QCoreApplication, Qt
    from PySide6.QtTest import QTest

    table, view, workspace = window.page.table, window.page.table_view, window.page.workspace
    every = list(workspace.file.schema.parameters.values())

    few, lists = every[:20], cycle([every, every[:20]])
    table.show_parameters(few)
    yield Measure(
        "all parameters listed, painted",
        timed(until_painted(lambda: table.show_parameters(next(lists))), 2 * times),
    )
    table.show_parameters(every)
    QCoreApplication.processEvents()
    bar, steps = view.verticalScrollBar(), cycle([3] * 40 + [-3] * 40)
    yield worst(
        "frame while scrolling by the wheel",
        FRAME,
        timed(until_painted(lambda: bar.setValue(bar.value() + next(steps))), 20 * times),
    )
    page, pages = bar.pageStep(), cycle([1] * 20 + [-1] * 20)
    yield worst(
        "frame while scrolling by the page",
        FRAME,
        timed(until_painted(lambda: bar.setValue(bar.value() + page * next(pages))), 8 * times),
    )
    address = _number(table)
    view.setCurrentIndex(table.index_of(address))
    down = cycle([Qt.Key.Key_Down] * 15 + [Qt.Key.Key_Up] * 15)
    yield worst(
        "key that moves the current cell, painted",
        KEYSTROKE,
        timed(until_painted(lambda: QTest.keyClick(view, next(down))), 8 * times),
    )
    view.setCurrentIndex(table.index_of(address))
    values = cycle(["1", "2"])
    yield worst(
        "edit of a value in the table, painted",
        EDIT,
        timed(until_painted(lambda: workspace.enter(address, next(values))), 4 * times),
    )
    view.setCurrentIndex(table.index_of(address))
    view.edit(table.index_of(address))
    field: Any = view.indexWidget(table.index_of(address))
    assert field is not None, "the cell is edited"
    letters = cycle("=1+2*3/4+5*6-7")
    yield worst(
        "keystroke in a cell, with its result, painted",
        KEYSTROKE,
        timed(until_painted(lambda: QTest.keyClick(field, next(letters))), 4 * times),
    )


def _number(table: Any) -> tuple[str, str]:
    """Return an address of a number that 1 and 2 are allowed for."""
    file = table.workspace.file
    for address in file.addresses():
        if file.schema.parameters[address[0]].type == "integer" and table.index_of(address).isValid():
            try:
                for text in ("1", "2"):
                    trial = file.copy()
                    trial.set_checked({address: trial.read(address, text)})
            except ValueError:
                continue
            return address
    raise LookupError("no number can be 1 and 2")
