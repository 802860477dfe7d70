"""What the tree of a project does with its files. Nothing is deleted: what is removed goes to the trash,
after a question.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QFile, QObject, QUrl
from PySide6.QtGui import QDesktopServices

from amp_studio.files import (
    ENDING,
    EditLock,
    ParameterFileError,
    Project,
    file_content,
    is_there,
    parameter_files_in,
    read_content,
    same_file,
    write_atomic,
)
from amp_studio.ui.base.ask_path import ask_to_open
from amp_studio.ui.base.questions import ask
from amp_studio.ui.base.task import in_background, run_with_progress
from amp_studio.ui.merge.comparisons import Comparisons, parameter_files
from amp_studio.ui.page.file_page import FilePage
from amp_studio.ui.window.studio_window import StudioWindow

from .check import ProjectCheckDialog, check_files

_MAX_PROJECTS = 12
"""Projects that are remembered."""


class ProjectFiles(QObject):
    """Open, compare, check, add, remove; for any folder, a project or not."""

    def __init__(
        self,
        window: StudioWindow,
        open_path: Callable[[Path], None],
        comparing: Comparisons,
        show_at: Callable[..., None],
        information: Callable[[], None],
    ) -> None:
        super().__init__(window)
        self.window, self.open, self._comparing = window, open_path, comparing
        self._show_at, self.information = show_at, information
        window.project_changed.connect(self._remember)

    def _remember(self) -> None:
        """Keep the project that is open now among the recent ones."""
        if self.window.project is not None:
            here = self.window.project.folder.absolute()
            others = [folder for folder in self.window.settings.projects() if folder != here]
            self.window.settings.keep_projects([here, *others][:_MAX_PROJECTS])

    def project_of(self, folder: Path) -> Project | None:
        """Return the project of a folder; None where it is none, or cannot be read."""
        if self.window.project is not None and self.window.project.folder == folder:
            return self.window.project
        with contextlib.suppress(ParameterFileError):
            return Project.open(folder)
        return None

    def recent_projects(self) -> list[Path]:
        """Return the folders of the projects that were open, the latest first."""
        return [folder for folder in self.window.settings.projects() if (folder / "project.yaml").is_file()]

    def open_project(self, folder: Path) -> None:
        """Open a project: the first of its files where none of it is open. Raises ParameterFileError."""
        project = Project.open(folder)
        self.window.project = project
        files = project.files()
        if not files:
            raise ValueError(self.tr("The project {name} has no files yet.").format(name=project.info.name))
        opened = next((p for p in files if self.window.page_of(p) is not None), files[0])
        self.open(opened)

    def compare(self, page: FilePage, path: Path) -> None:
        """Compare the file of a page with another file, its backup or a copy of a control."""
        self._comparing.with_path(page, path)

    def open_text(self, path: Path) -> None:
        """Open a text in the editor of the system."""
        QDesktopServices.openUrl(QUrl.fromLocalFile(str(path)))

    def check(self, folder: Path) -> None:
        """Check every file of a folder as it is on disk, and list the findings."""
        paths = parameter_files_in(folder)
        found = run_with_progress(
            self.tr("Check all files"),
            lambda progress, cancelled: check_files(paths, progress, cancelled),
            self.window,
        )
        self.window.beside.show(ProjectCheckDialog(found, self._show_at, self.window, len(paths)))

    # -- in and out ---------------------------------------------------------------------

    def add(self, folder: Path) -> None:
        """Ask for a file and copy it into a folder."""
        if path := ask_to_open(self.window, self.tr("Add a file"), folder.parent, parameter_files()):
            self.take(path, folder)

    def take(self, path: Path, folder: Path) -> None:
        """Copy a parameter file into a folder and open the copy; one that is there already is opened.
        Raises ValueError, OSError.
        """
        if same_file(path.parent, folder):
            self.open(path)
            return
        target = folder / path.name
        if is_there(target):
            raise FileExistsError(self.tr("{name} is in the folder already.").format(name=path.name))

        def copy() -> None:
            content = file_content(path)
            read_content(path, content)  # raises for what is no parameter file
            write_atomic(target, content, None)

        in_background(self.window, self.tr("Copying"), copy)
        self.open(target)

    def remove(self, path: Path) -> None:
        """Move a file to the trash, after a question; an open one is closed first. Raises OSError,
        InUseError.
        """
        question = self.tr("Move {name} to the trash? Its backup and the copies of controls stay.").format(
            name=path.name
        )
        if path.suffix.lower() != ENDING:
            question = self.tr("Move {name} to the trash?").format(name=path.name)
        move = self.tr("&Move to Trash")
        if ask(self.window, self.tr("Remove"), question, move, self.tr("Cancel"), default=1) != move:
            return
        page = self.window.page_of(path)
        if page is not None:
            if not self.window.may_leave(page):
                return
            self.window.close_page(page)
        if path.suffix.lower() == ENDING:
            with EditLock(path):  # raises InUseError while another program edits it
                to_trash(path)
        else:
            to_trash(path)
        self.window.show_status(self.tr("{name} is in the trash").format(name=path.name))

    def recover(self, backup: Path) -> None:
        """Make the backup of a file that is gone the file again, and open it. Raises OSError,
        ParameterFileError.
        """
        path = backup.with_name(backup.name.removesuffix(".bak"))
        project = self.project_of(path.parent)
        if project is None:
            raise ValueError(
                self.tr("Only a file of a project is recovered: {name} is in none.").format(name=path.name)
            )
        project.recover(path)
        self.open(path)


def to_trash(path: Path) -> None:
    """Move a file to the trash of the system. Raises OSError, and then the file is where it was."""
    moved: object = QFile.moveToTrash(str(path))  # with the new name beside it, but for a failure
    if not (moved[0] if isinstance(moved, tuple) else moved):
        raise OSError(f"{path.name} was not removed: the system has no trash for this folder")
