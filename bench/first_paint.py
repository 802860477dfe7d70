"""Start the desktop program on a file, say ``painted`` when the table of its values has been painted, and end.

The start is that of the program itself (``amp_studio.ui.main``); all that is
added is an ear for the paint event of the table.
"""

from __future__ import annotations

import sys
from pathlib import Path

from PySide6.QtCore import QEvent, QObject, QTimer
from PySide6.QtWidgets import QApplication

from amp_studio.ui import main
from amp_studio.ui.main_window import MainWindow


class _Ear(QObject):
    """Hears the first paint event and ends the program once it has been carried out."""

    heard = False

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802  # Qt's own name
        if event.type() == QEvent.Type.Paint and not self.heard:
            self.heard = True
            QTimer.singleShot(0, self._painted)
        return super().eventFilter(watched, event)

    def _painted(self) -> None:
        print("painted", flush=True)
        application = QApplication.instance()
        assert application is not None
        application.exit()


def _open_and_listen(window: MainWindow, path: Path) -> None:
    _open_first(window, path)
    assert window.table_view is not None, "the file is open"
    ear = _Ear(window)
    window.table_view.viewport().installEventFilter(ear)


if __name__ == "__main__":
    _open_first = MainWindow.open_first
    MainWindow.open_first = _open_and_listen  # type: ignore[method-assign]  # the one thing that is added
    sys.exit(main(sys.argv[1:2]))
