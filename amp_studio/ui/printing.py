"""The documentation of the open file, asked for in a dialog and written in a thread."""

from __future__ import annotations

import threading

from PySide6.QtCore import QUrl
from PySide6.QtGui import QDesktopServices

from amp_studio.files import check_output

from .file_dialogs import ReportDialog
from .studio_window import StudioWindow
from .task import ProgressDialog, TaskProgress
from .workspace import Workspace


def print_report(window: StudioWindow, workspace: Workspace) -> None:
    """Print a file as PDF, HTML, CSV or text; nothing where the dialog is cancelled."""
    dialog = ReportDialog(workspace.path, window)
    if not dialog.exec():
        return
    path, contents, show = dialog.output, dialog.contents(), dialog.show_it.isChecked()
    check_output(path, workspace.path)
    file = workspace.file.copy()
    notes: list[str] = []

    def work(_: TaskProgress, __: threading.Event) -> None:
        from amp_studio.dossier import write_dossier

        write_dossier(
            file,
            path,
            contents,
            source=workspace.path,
            own=workspace.validator.own,
            notify=notes.append,
        )

    ProgressDialog("Report", work, window, f"Writing {path.name} …", cancellable=False).run()
    window.show_status("; ".join([f"{path} written", *notes]))
    if show:
        QDesktopServices.openUrl(QUrl.fromLocalFile(str(path)))
