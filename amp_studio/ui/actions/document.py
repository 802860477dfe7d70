"""What is printed of the open file: the report, tables to fill in by hand, and a template of the project to begin with."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import QUrl
from PySide6.QtGui import QAction, QDesktopServices, QKeySequence
from PySide6.QtWidgets import QFileDialog

from amp_studio.files import check_output, real_path
from amp_studio.ui.base.task import in_background
from amp_studio.ui.base.translated import Translated
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.window.studio_window import StudioWindow


class DocumentActions(Translated):
    """A part of the file menu."""

    def __init__(self, window: StudioWindow) -> None:
        self.window = window
        act = window.action
        report = act(
            self.tr("&Report…"),
            self.report,
            QKeySequence.StandardKey.Print,
            "file",
            "printer",
            self.tr("Report"),
        )
        self.actions: list[QAction] = [
            report,
            act(self.tr("&Form to Fill In…"), self.form),
            act(self.tr("New Report &Template…"), self.new_template),
        ]

    def _workspace(self) -> Workspace:
        workspace = self.window.workspace
        assert workspace is not None
        return workspace

    def report(self) -> None:
        """Print the file as PDF, HTML, CSV or text."""
        from amp_studio.ui.paper.printing import print_report

        print_report(self.window, self._workspace())

    def form(self) -> None:
        """Write the tables of this machine with room for values that are filled in by hand."""
        from amp_studio.report import form_paper, write_paper
        from amp_studio.ui.dialogs.file_dialogs import PAPER_KINDS, path_of_kind

        workspace = self._workspace()
        near = workspace.path.with_name(f"{workspace.path.stem}-form.pdf")
        text, kind = QFileDialog.getSaveFileName(
            self.window, self.tr("Form to Fill In"), str(near), PAPER_KINDS
        )
        if not text:
            return
        path, file = path_of_kind(text, kind), workspace.file.copy()
        language = self.window.report_choice.contents.language
        check_output(path, workspace.path)
        notes: list[str] = []
        in_background(
            self.window,
            self.tr("Form to Fill In"),
            lambda: write_paper(form_paper(file, language=language), path, notes.append),
        )
        self.window.show_status("; ".join([self.tr("{path} written").format(path=path), *notes]))

    def new_template(self) -> None:
        """Write a template to begin with beside the open file, and show its folder; raises FileExistsError where there is one."""
        from amp_studio.report import write_starting_template

        folder = real_path(self._workspace().path).parent
        written = in_background(
            self.window, self.tr("New Report Template"), partial(write_starting_template, folder)
        )
        self.window.show_status(self.tr("{path} written").format(path=written))
        QDesktopServices.openUrl(QUrl.fromLocalFile(str(written.parent)))
