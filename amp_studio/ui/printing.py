"""The documentation of the open file, asked for in a dialog and written in a thread, or shown and printed."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtCore import QPoint, QRect, Qt, QUrl
from PySide6.QtGui import QDesktopServices, QImage, QPageLayout, QPainter

from amp_studio.files import check_output
from amp_studio.report import Contents

from .file_dialogs import ReportDialog
from .studio_window import StudioWindow
from .task import ProgressDialog, TaskProgress
from .translated import tr
from .workspace import Workspace

if TYPE_CHECKING:
    from PySide6.QtPrintSupport import QPrinter

PPI = 200
"""Pixels to the inch of a printed page."""


def print_report(window: StudioWindow, workspace: Workspace) -> None:
    """Print a file as PDF, HTML, CSV or text; nothing where the dialog is cancelled."""
    dialog = ReportDialog(workspace.path, window)
    if not dialog.exec():
        return
    path, contents, show = dialog.output, dialog.contents(), dialog.show_it.isChecked()
    if dialog.to_printer:
        _preview(window, workspace, contents)
        return
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


def _preview(window: StudioWindow, workspace: Workspace, contents: Contents) -> None:
    """Show the pages of a report as they are printed; the system's dialog of printers is a button of the preview."""
    from PySide6.QtPrintSupport import QPrinter, QPrintPreviewDialog

    file, notes = workspace.file.copy(), list[str]()

    def work(_: TaskProgress, __: threading.Event) -> list[bytes]:
        from amp_studio.dossier import dossier_pages

        return dossier_pages(
            file, contents, PPI, source=workspace.path, own=workspace.validator.own, notify=notes.append
        )

    pages = ProgressDialog(tr("Report"), work, window, tr("Setting the pages …"), cancellable=False).run()
    printer = QPrinter(QPrinter.PrinterMode.HighResolution)
    printer.setDocName(workspace.path.stem)
    preview = QPrintPreviewDialog(printer, window)
    preview.setWindowTitle(tr("Report"))
    preview.paintRequested.connect(partial(put_on_paper, pages))
    preview.exec()
    preview.deleteLater()
    if notes:
        window.show_status("; ".join(notes))


def put_on_paper(pages: Sequence[bytes], printer: QPrinter) -> None:
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
