"""The desktop program: a thin view over files, findings, reports, transfer and simulation.

Qt is imported in this room only.
"""

from __future__ import annotations

import sys
import traceback
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING

from amp_studio.front_pages import front_page

from .base.display import MISSING, has_display

if TYPE_CHECKING:
    from PySide6.QtWidgets import QWidget

    from .merge.program import merge_in_window
else:
    __getattr__ = front_page(__name__)

if has_display():
    from .base.unread_sources import leave_sources_unread

    leave_sources_unread()  # before every other module

    from .base.guard import guard_overrides

    guard_overrides()  # before the first class of this room is made


def main(arguments: Sequence[str] | None = None, emulate: bool = False) -> int:
    """Open the desktop program, on files if some are named, else on those of the last time; ``emulate``
    starts an emulated control. Returns the exit code.
    """
    if not has_display():
        print(f"amp-studio: {MISSING}", file=sys.stderr, flush=True)
        return 2
    from PySide6.QtCore import QTimer
    from PySide6.QtGui import QGuiApplication
    from PySide6.QtWidgets import QApplication

    from .base.task import Task
    from .base.translated import set_language
    from .main_window import MainWindow
    from .window.settings import UserSettings

    arguments = sys.argv[1:] if arguments is None else arguments
    # Without the files: a name that is no text where the locale is C ends Qt with a segmentation fault.
    application = QApplication.instance() or QApplication(["amp-studio"])
    application.setApplicationName("AMP Studio")
    application.setOrganizationName("AMP Studio")
    set_language(UserSettings().language())
    window = MainWindow(opening=arguments or [str(path) for path in UserSettings().session()])
    sys.excepthook = _hook(window)
    window.show()

    def begin() -> None:
        for argument in arguments:
            window.open_first(Path(argument))
        if not arguments:
            window.files.restore_session()
        if window.page is None:
            window.show_values()
        if emulate:
            window.control.start_emulated()

    QTimer.singleShot(0, window, begin)  # in the program's loop: who ends it while a file is opened ends it
    code = int(application.exec())
    Task.end_all()  # a system that ends the program without closing its window leaves them running
    clipboard = QGuiApplication.clipboard()
    # A platform without a clipboard has one for this process, which it does not call its own.
    if clipboard.ownsClipboard() or QGuiApplication.platformName() == "offscreen":
        # What Python has put there, Qt deletes after the end of Python, with a segmentation fault where the
        # platform has not handed it on: a text alone is Qt's own.
        clipboard.setText(clipboard.text())
    return code


def _hook(window: QWidget):  # type: ignore[no-untyped-def]  # the type of sys.excepthook has no name
    """Return the hook that shows an internal error as a message;
    the traceback goes to the terminal and into the log folder.

    One error is reported once: what fails while the window is painted fails again at once. Its message waits
    for the event loop, because a box that is opened while Qt paints ends the process.
    """
    from PySide6.QtCore import QTimer

    reported: set[str] = set()

    def show_internal_error(
        kind: type[BaseException], error: BaseException, trace: TracebackType | None
    ) -> None:
        from amp_studio.trouble import keep_details

        from .base.modal import AskerGoneError
        from .base.questions import show_message

        if kind is AskerGoneError:
            return
        last = traceback.extract_tb(trace)[-1:]
        where = f"{kind.__name__} {last[0].filename}:{last[0].lineno}" if last else kind.__name__
        if where in reported:
            return
        reported.add(where)
        traceback.print_exception(kind, error, trace)
        keep_details(error)  # for Help > Report a Problem
        text = (
            f"AMP Studio has an internal error: {kind.__name__}: {error}\n\n"
            "Your work is still open. Save it under a new name."
        )
        # Later: this is called from within what Qt was doing, perhaps a paint, where a dialog with an event
        # loop inside may not be opened.
        QTimer.singleShot(0, window, lambda: show_message(window, "Internal error", text))

    return show_internal_error
