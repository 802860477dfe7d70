"""The window that is measured, on Qt's offscreen platform and with settings of a separate folder."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from amp_studio.ui.main_window import MainWindow

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")


@contextmanager
def window_with(path: Path) -> Iterator[MainWindow]:
    """Give a window with a file open, its settings beside the file. It is closed as a person closes it,
    which ends what still works for it; unsaved work is thrown away.
    """
    from PySide6.QtCore import QSettings
    from PySide6.QtWidgets import QApplication

    from amp_studio.ui.main_window import MainWindow

    QSettings.setPath(QSettings.Format.NativeFormat, QSettings.Scope.UserScope, str(path.parent))
    application = QApplication.instance() or QApplication(["bench"])
    window = MainWindow()
    window.resize(1440, 900)
    window.show()
    window.open_first(path)
    end = time.monotonic() + 10.0
    while window.page is None and time.monotonic() < end:  # a file may be opened in the background
        application.processEvents()
    assert window.page is not None, "the file is open"
    yield window
    window.may_leave = lambda *_: True
    window.close()


def until_painted(act: Callable[[], object]) -> Callable[[], None]:
    """Return what does something and what follows from it, until all of it is painted."""

    def call() -> None:
        from PySide6.QtCore import QCoreApplication

        act()
        QCoreApplication.processEvents()

    return call


def painted_table(window: MainWindow, path: Path) -> None:
    """Open a file in a window, until its table is painted: it is read in a thread."""
    from PySide6.QtCore import QCoreApplication, QEvent, QObject

    class Ear(QObject):
        heard = False

        def eventFilter(self, _: QObject, event: QEvent) -> bool:  # noqa: N802  # Qt's own name
            self.heard = self.heard or event.type() == QEvent.Type.Paint
            return False

    window.open_path(path)
    end = time.monotonic() + 10.0
    while window.workspace_in_front.path != path and time.monotonic() < end:
        QCoreApplication.processEvents()
    ear = Ear()
    window.page_in_front.table_view.viewport().installEventFilter(ear)
    while not ear.heard and time.monotonic() < end:
        QCoreApplication.processEvents()
    assert ear.heard, "the table is painted"
    window.page_in_front.table_view.viewport().removeEventFilter(ear)
