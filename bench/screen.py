"""The desktop program while it is used, on Qt's offscreen platform."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator
from itertools import cycle
from pathlib import Path

from measure import Measure, timed

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")


def measures(folder: Path, full: Path, times: int) -> Iterator[Measure]:
    """Yield what a keystroke and an edit cost until everything is painted again."""
    from PySide6.QtCore import QSettings
    from PySide6.QtWidgets import QApplication

    from amp_studio.ui.main_window import MainWindow

    QSettings.setPath(QSettings.Format.NativeFormat, QSettings.Scope.UserScope, str(folder))
    application = QApplication.instance() or QApplication(["bench"])
    window = MainWindow()
    window.show()
    window.open_first(full)
    end = time.monotonic() + 10.0
    while window.workspace is None and time.monotonic() < end:  # a file may be opened in the background
        application.processEvents()
    assert window.workspace is not None, "the file is open"
    assert window.groups is not None
    box = window.finder.box
    box.begin("")

    def until_painted(act: Callable[[], object]) -> Callable[[], None]:
        def call() -> None:
            act()
            application.processEvents()

        return call

    texts = cycle(["f", "fo", "fol", "foll", "follo", "follow"])
    search = until_painted(lambda: (box.setText(next(texts)), box.search()))
    yield Measure("keystroke in the find box, painted", timed(search, 6 * times), 0.030)
    box.clear()
    window.go_to(("servo.excess_error", "1"))
    values = cycle(["12 mm", "11 mm"])
    edit = until_painted(lambda: window.edits.commit(("servo.excess_error", "1"), next(values)))
    yield Measure("edit of a value in the table, painted", timed(edit, 4 * times))
    window.workspace.close()
    window.control.close()
    window.hide()
