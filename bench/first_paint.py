"""Start the desktop program on a file, say ``painted`` when the table of its values has been painted,
and end.

The start is that of the program itself (``amp_studio.ui.main``); all that is
added is an ear for the paint event of the table.
"""

import sys

from PySide6.QtCore import QEvent, QObject, QTimer
from PySide6.QtWidgets import QApplication, QTableView

from amp_studio.ui import main


class _Ear(QObject):
    """Hears the first paint event of a table with rows, and ends the program once it has been carried out."""

    heard = False

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802  # Qt's own name
        if event.type() == QEvent.Type.Paint and not self.heard:
            table = watched.parent()
            if isinstance(table, QTableView) and table.model() is not None and table.model().rowCount() > 0:
                self.heard = True
                QTimer.singleShot(0, self._painted)
        return False

    def _painted(self) -> None:
        print("painted", flush=True)
        application = QApplication.instance()
        assert application is not None
        application.exit()


if __name__ == "__main__":
    application = QApplication(["amp-studio"])
    application.installEventFilter(ear := _Ear())
    sys.exit(main(sys.argv[1:2]))
