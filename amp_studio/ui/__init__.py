"""The desktop program: a thin view over files, findings, reports, transfer and simulation.

Qt is imported in this room only.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

__all__ = ["main"]


def main(arguments: Sequence[str] | None = None, emulate: bool = False) -> int:
    """Open the desktop program, on a file if one is named; ``emulate`` starts an emulated control. Returns the exit code."""
    from PySide6.QtWidgets import QApplication

    from .main_window import MainWindow

    arguments = sys.argv[1:] if arguments is None else arguments
    application = QApplication.instance() or QApplication(["amp-studio", *arguments])
    application.setApplicationName("AMP Studio")
    application.setOrganizationName("AMP Studio")
    window = MainWindow()
    window.show()
    if arguments:
        window.open_first(Path(arguments[0]))
    if emulate:
        window.control.start_emulated()
    return int(application.exec())
