"""Asks for a file and writes the check list of commissioning."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from PySide6.QtCore import QUrl
from PySide6.QtGui import QDesktopServices

from amp_studio.files import Notify, ParameterFile, check_output
from amp_studio.guide import GuideProgress
from amp_studio.ui.base.ask_path import ask_to_save
from amp_studio.ui.base.loading import load
from amp_studio.ui.base.task import in_background
from amp_studio.ui.base.translated import tr, written_to
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.window.studio_window import StudioWindow


def write_check_list_of(window: StudioWindow, workspace: Workspace) -> None:
    """Ask for a file and write the check list into it, then open it; nothing where the dialog is
    cancelled.
    """
    endings = tr("PDF (*.pdf);;Web page (*.html);;Text (*.txt)")
    start = workspace.path.with_name(f"{workspace.path.stem}-check-list.pdf")
    path = ask_to_save(window, tr("Check List"), start, endings)
    if path is None:
        return
    check_output(path, workspace.path)
    notes: list[str] = []
    write = partial(
        _write,
        workspace.file.copy(),
        workspace.progress,
        workspace.path,
        window.report_options.contents.language,
        path,
        notes.append,
    )
    in_background(window, tr("Check List"), write)
    window.show_status("; ".join([written_to(path), *notes]))
    QDesktopServices.openUrl(QUrl.fromLocalFile(str(path)))


def _write(
    file: ParameterFile, progress: GuideProgress, name: Path, language: str, path: Path, notify: Notify
) -> None:
    """Write the list with the tests at the machine, which the simulator makes."""
    load("amp_studio.dossier")
    from amp_studio.dossier import machine_tests_of
    from amp_studio.report import build_check_list, write_check_list

    write_check_list(
        build_check_list(file, progress, name, language=language, tests=machine_tests_of(file)), path, notify
    )
