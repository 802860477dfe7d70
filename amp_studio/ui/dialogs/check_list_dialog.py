"""Asks for a file and writes the check list of commissioning."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from PySide6.QtCore import QUrl
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import QFileDialog

from amp_studio.files import check_output
from amp_studio.ui.base.task import in_background
from amp_studio.ui.base.translated import tr
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.window.studio_window import StudioWindow


def write_check_list_of(window: StudioWindow, workspace: Workspace) -> None:
    """Ask for a file and write the check list into it, then open it; nothing where the dialog is
    cancelled.
    """
    from amp_studio.report import build_check_list, write_check_list

    endings = tr("PDF (*.pdf);;Web page (*.html);;Text (*.txt)")
    start = workspace.path.with_name(f"{workspace.path.stem}-check-list.pdf")
    text, chosen = QFileDialog.getSaveFileName(window, tr("Check List"), str(start), endings)
    if not text:
        return
    path = Path(text)
    if not path.suffix:
        path = path.with_suffix(chosen[chosen.index("*") + 1 : -1])
    check_output(path, workspace.path)
    checks = build_check_list(
        workspace.file, workspace.progress, workspace.path, language=window.report_choice.contents.language
    )
    notes: list[str] = []
    in_background(window, tr("Check List"), partial(write_check_list, checks, path, notes.append))
    window.show_status("; ".join([tr("{path} written").format(path=path), *notes]))
    QDesktopServices.openUrl(QUrl.fromLocalFile(str(path)))
