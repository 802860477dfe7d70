"""What is printed of the open file: the report, tables to fill in by hand,
and a template of the project to begin with.
"""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import QUrl
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import QMessageBox

from amp_studio.files import ParameterFile, check_output, real_path
from amp_studio.ui.base.ask_path import ask_to_save
from amp_studio.ui.base.questions import show_message
from amp_studio.ui.base.task import in_background
from amp_studio.ui.base.translated import tr, written_to
from amp_studio.ui.window.studio_window import StudioWindow


def report(window: StudioWindow) -> None:
    """Print the file as PDF, HTML, CSV or text."""
    from amp_studio.ui.paper.printing import print_report

    print_report(window, window.workspace_in_front)


def form(window: StudioWindow) -> None:
    """Write the tables of this machine with room for values that are filled in by hand."""
    from amp_studio.report import form_paper, write_paper
    from amp_studio.ui.dialogs.file_dialogs import PAPER_KINDS

    workspace = window.workspace_in_front
    near = workspace.path.with_name(f"{workspace.path.stem}-form.pdf")
    path, file = ask_to_save(window, tr("Form to Fill In"), near, PAPER_KINDS), workspace.file.copy()
    if path is None:
        return
    language = window.report_options.contents.language
    check_output(path, workspace.path)
    notes: list[str] = []
    in_background(
        window,
        tr("Form to Fill In"),
        lambda: write_paper(form_paper(file, language=language), path, notes.append),
    )
    window.show_status("; ".join([written_to(path), *notes]))


def new_template(window: StudioWindow) -> None:
    """Write a template to begin with beside the open file, and show its folder;
    raises SaveError where there is one, or where the folder cannot be written to.
    """
    from amp_studio.report import write_starting_template

    folder = real_path(window.workspace_in_front.path).parent
    written = in_background(window, tr("New Report Template"), partial(write_starting_template, folder))
    window.show_status(written_to(written))
    QDesktopServices.openUrl(QUrl.fromLocalFile(str(written.parent)))


def show_about(window: StudioWindow) -> None:
    """Show what the program is, and its version."""
    from amp_studio.version import __version__

    show_message(
        window,
        tr("About AMP Studio"),
        tr(
            "AMP Studio {version}\n\nThe numbered parameters of machine controls: edit, check, print,"
            " exchange and simulate them."
        ).format(version=__version__),
        QMessageBox.Icon.Information,
    )


def migrate(window: StudioWindow) -> None:
    """Show what becomes of the file in front at another control."""
    from amp_studio.ui.migration.window import MigrationWindow

    workspace = window.workspace_in_front
    if (opened := window.beside.again(MigrationWindow, workspace)) is not None:
        opened.migrate()
        return

    def read() -> ParameterFile:
        return workspace.file.copy()

    window.beside.show(MigrationWindow(read, workspace.path, window.follow, window), workspace)
