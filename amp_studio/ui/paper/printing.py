"""The documentation of the open file, asked for in a dialog and written in a thread, or shown and printed."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QPoint, QRect, Qt, QUrl
from PySide6.QtGui import QDesktopServices, QImage, QPageLayout, QPainter

from amp_studio.files import check_output
from amp_studio.ui.base.loading import load
from amp_studio.ui.base.modal import run_dialog
from amp_studio.ui.base.task import ProgressDialog, TaskProgress
from amp_studio.ui.base.translated import tr, written_to
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.dialogs.file_dialogs import ReportDialog
from amp_studio.ui.window.studio_window import StudioWindow

if TYPE_CHECKING:
    from PySide6.QtPrintSupport import QPrinter

PPI = 200
"""Pixels to the inch of a printed page."""


def print_report(window: StudioWindow, workspace: Workspace) -> None:
    """Ask what a report contains, and write it or show it as it is printed;
    nothing where the dialog is cancelled.
    """
    dialog = ReportDialog(workspace.path, window, window.report_options.contents)
    if not run_dialog(dialog):
        return
    path, show = dialog.output, dialog.form.answer("open")
    window.report_options.contents = dialog.contents()
    if dialog.to_printer:
        _preview(window, workspace)
        return
    write_to(window, workspace, path)
    if show:
        QDesktopServices.openUrl(QUrl.fromLocalFile(str(path)))


def write_to(window: StudioWindow, workspace: Workspace, path: Path) -> None:
    """Write the report as it was last chosen, in the format of the file's ending."""
    check_output(path, workspace.path)
    file, contents = workspace.file.copy(), window.report_options.contents
    notes: list[str] = []

    def work(_: TaskProgress, __: threading.Event) -> None:
        load("amp_studio.dossier")
        from amp_studio.dossier import motion_apart, write_report

        write_report(
            file,
            path,
            contents,
            source=workspace.path,
            own=workspace.validator.own,
            notify=notes.append,
            motion=motion_apart,
        )

    ProgressDialog(
        tr("Report"), work, window, tr("Writing {name} …").format(name=path.name), cancellable=False
    ).run()
    window.show_status("; ".join([written_to(path), *notes]))


def _set_for_paper(window: StudioWindow, workspace: Workspace) -> Sequence[bytes]:
    """Return the pages of the report for a printer."""
    file, contents, notes = workspace.file.copy(), window.report_options.contents, list[str]()

    def work(_: TaskProgress, __: threading.Event) -> tuple[bytes, ...]:
        load("amp_studio.dossier")
        from amp_studio.dossier import motion_apart, set_dossier

        motion = () if "motion" in contents.without else motion_apart(file)
        return set_dossier(
            file,
            contents,
            PPI,
            source=workspace.path,
            motion=motion,
            own=workspace.validator.own,
            notify=notes.append,
        ).pages

    pages: Sequence[bytes] = ProgressDialog(
        tr("Report"), work, window, tr("Setting the pages …"), cancellable=False
    ).run()
    if notes:
        window.show_status("; ".join(notes))
    return pages


def _printer_for(workspace: Workspace) -> QPrinter:
    from PySide6.QtPrintSupport import QPrinter

    printer = QPrinter(QPrinter.PrinterMode.HighResolution)
    printer.setDocName(workspace.path.stem)
    return printer


def print_now(window: StudioWindow, workspace: Workspace) -> None:
    """Print the report as it was last chosen, on a printer that the system's dialog asks for."""
    from PySide6.QtPrintSupport import QPrintDialog

    printer = _printer_for(workspace)
    dialog = QPrintDialog(printer, window)
    if run_dialog(dialog):
        _put_on_paper(_set_for_paper(window, workspace), printer)
    dialog.deleteLater()


def _preview(window: StudioWindow, workspace: Workspace) -> None:
    """Show the pages of a report as they are printed;
    the system's dialog of printers is a button of the preview.
    """
    from PySide6.QtPrintSupport import QPrintPreviewDialog

    pages, printer = _set_for_paper(window, workspace), _printer_for(workspace)
    preview = QPrintPreviewDialog(printer, window)  # which does not keep the printer alive
    preview.setWindowTitle(tr("Report"))
    preview.paintRequested.connect(partial(_put_on_paper, pages))
    run_dialog(preview)
    preview.deleteLater()


def _put_on_paper(pages: Sequence[bytes], printer: QPrinter) -> None:
    """Paint pages, given as PNG, each on a sheet that lies as the page does."""
    painter = QPainter()
    for n, page in enumerate(pages):
        image = QImage.fromData(page)
        across = image.width() > image.height()
        printer.setPageOrientation(
            QPageLayout.Orientation.Landscape if across else QPageLayout.Orientation.Portrait
        )
        if n == 0:
            painter.begin(printer)
        else:
            printer.newPage()
        sheet = printer.pageLayout().fullRectPixels(printer.resolution())
        margins = printer.pageLayout().marginsPixels(printer.resolution())
        size = image.size().scaled(sheet.size(), Qt.AspectRatioMode.KeepAspectRatio)
        painter.drawImage(QRect(QPoint(-margins.left(), -margins.top()), size), image)
    painter.end()
