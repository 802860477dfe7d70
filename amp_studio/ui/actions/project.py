"""The project menu: the folder of one machine, and its files."""

from __future__ import annotations

import contextlib
from collections.abc import Callable
from pathlib import Path

from PySide6.QtWidgets import QFileDialog, QInputDialog

from amp_studio.files import ParameterFileError, Project
from amp_studio.schema import Address
from amp_studio.ui.base.modal import run_dialog
from amp_studio.ui.base.questions import ask
from amp_studio.ui.base.task import PATIENCE_MS, ProgressDialog, in_background
from amp_studio.ui.base.translated import Translated, counted
from amp_studio.ui.merge.compare_actions import FILTER
from amp_studio.ui.window.studio_window import StudioWindow


class ProjectActions(Translated):
    """New, open, information; open, copy, rename, delete and recover the files of a project."""

    def __init__(self, window: StudioWindow, open_path: Callable[[Path], None]) -> None:
        self.window, self._open_path = window, open_path
        act = window.action
        menu = window.menuBar().addMenu(self.tr("&Project"))
        menu.addActions([
            act(self.tr("&New Project…"), self.new, None, ""),
            act(self.tr("&Open Project…"), self.open, None, ""),
            act(self.tr("Project &Information…"), self.change, None, "project"),
        ])  # fmt: skip
        menu.addSeparator()
        menu.addActions([
            act(self.tr("Open &File of the Project…"), self.open_file, "Ctrl+Shift+O", "project"),
            act(self.tr("Chec&k All Files…"), self.check, "Ctrl+Shift+F8", "project"),
            act(self.tr("Compare &Machines…"), self.compare, None, ""),
            act(self.tr("&Copy File…"), self.copy, None, "project"),
            act(self.tr("Copy from &Another Project…"), self.copy_from, None, "project"),
            act(self.tr("&Rename File…"), self.rename, None, "project"),
            act(self.tr("&Delete File…"), self.delete, None, "project"),
            act(self.tr("Reco&ver a Deleted or Older File…"), self.recover, None, "project"),
        ])  # fmt: skip

    def notice(self, folder: Path) -> None:
        """Use the project of a folder, if it is one, because one of its files was opened."""
        if (folder / "project.yaml").exists() and (
            self.window.project is None or self.window.project.folder != folder
        ):
            with contextlib.suppress(
                ParameterFileError
            ):  # an unreadable project file does not prevent work on the parameters
                self.window.project = Project.open(folder)

    def name_of(self, path: Path) -> str:
        """Return the name of the project a file belongs to."""
        return (
            self.window.project.info.name
            if self.window.project and self.window.project.folder == path.parent
            else ""
        )

    def _the_project(self) -> Project:
        if self.window.project is None:
            raise ValueError(self.tr("Open a project first: Project > Open Project."))
        return self.window.project

    def _show(self, project: Project) -> None:
        self.window.project = project
        files = len(project.files())
        self.window.show_status(
            self.tr("Project {name}: {count} in {folder}").format(
                name=project.info.name, count=counted(files, "file", none="no"), folder=project.folder
            )
        )

    # -- the project -----------------------------------------------------------

    def new(self) -> None:
        """Create a project folder."""
        from amp_studio.ui.dialogs.file_dialogs import ProjectDialog

        dialog = ProjectDialog(None, self.window)
        if run_dialog(dialog):
            info = dialog.info()
            folder = QFileDialog.getExistingDirectory(self.window, self.tr("Folder of the new project"))
            if folder:
                self._show(Project.create(Path(folder), info))

    def open(self) -> None:
        """Ask for a project folder and choose one of its files."""
        folder = QFileDialog.getExistingDirectory(self.window, self.tr("Open project"))
        if folder:
            self.open_folder(Path(folder))

    def open_folder(self, folder: Path) -> None:
        """Open a project and choose one of its files. Raises ParameterFileError."""
        self._show(Project.open(folder))
        if self._the_project().files():
            self.open_file()

    def change(self) -> None:
        """Change the project information."""
        from amp_studio.ui.dialogs.file_dialogs import ProjectDialog

        project = self._the_project()
        dialog = ProjectDialog(project.info, self.window)
        if run_dialog(dialog):
            info = dialog.info()
            keys = ("name", "application", "machine", "control", "control_name", "revision", "notes")
            project.change(**{key: getattr(info, key) for key in keys})
            self.window.project = project

    # -- its files -------------------------------------------------------------

    def _choose(self, title: str, paths: list[Path]) -> Path | None:
        if not paths:
            raise ValueError(self.tr("The project has no files of this kind."))
        names, workspace = [p.stem for p in paths], self.window.workspace
        here = names.index(workspace.path.stem) if workspace and workspace.path in paths else 0
        name, accepted = QInputDialog.getItem(self.window, title, self.tr("File"), names, here, False)
        return paths[names.index(name)] if accepted else None

    def _ask_name(self, title: str, name: str = "") -> str:
        text, accepted = QInputDialog.getText(self.window, title, self.tr("New name"), text=name)
        return text.strip() if accepted else ""

    def _let_go(self, path: Path) -> bool:
        """Close a file if it is open, asking about unsaved work; returns whether it may be moved."""
        page = self.window.page_of(path)
        if page is None or not page.workspace.may_edit:
            return True
        if not self.window.may_leave(page):
            return False
        self.window.close_page(page)
        return True

    def open_file(self) -> None:
        """Open a file of the project."""
        path = self._choose(self.tr("Open"), self._the_project().files())
        if path:
            self._open_path(path)

    def check(self) -> None:
        """Check every file of the project as it is on disk, and list the findings."""
        from amp_studio.ui.project.check import ProjectCheckDialog, check_files

        paths = self._the_project().files()
        if not paths:
            raise ValueError(self.tr("The project has no files yet."))
        checking = ProgressDialog(
            self.tr("Check All Files"),
            lambda progress, cancelled: check_files(paths, progress, cancelled),
            self.window,
        )
        ProjectCheckDialog(checking.run(PATIENCE_MS), self.show_at, self.window).show()

    def compare(self) -> None:
        """Show what differs between files of the project and those that are open."""
        from amp_studio.ui.merge.machines_dialog import MachinesDialog

        project, pages = self.window.project, self.window.tabs.pages()
        front = [self.window.workspace] if self.window.workspace is not None else []
        opened = list(dict.fromkeys([*front, *(page.workspace for page in pages)]))
        paths = project.files() if project is not None else []
        dialog = MachinesDialog(
            opened, paths, self.show_at, self.window, self.window.report_choice.contents.language
        )
        dialog.show()
        dialog.begin()

    def show_at(self, path: Path, address: Address | None) -> None:
        """Select an address in a file of the project; opens the file if necessary."""

        def show() -> None:
            self._open_path(path)
            page = self.window.page_of(path)
            if address is not None and page is not None:
                page.go_to(address)

        self.window.guarded(show, self.tr("Open"))

    def copy(self) -> None:
        """Copy a file of the project under a new name and open the copy."""
        self._copy(self._choose(self.tr("Copy"), self._the_project().files()))

    def copy_from(self) -> None:
        """Copy a file of another project into this one."""
        folder = str(self._the_project().folder.parent)
        text, _ = QFileDialog.getOpenFileName(
            self.window, self.tr("Copy from another project"), folder, FILTER
        )
        self._copy(Path(text) if text else None)

    def _copy(self, source: Path | None) -> None:
        name = self._ask_name(self.tr("Copy"), source.stem) if source else ""
        if source and name:
            project = self._the_project()
            path = in_background(self.window, self.tr("Copying"), lambda: project.copy(source, name))
            self._open_path(path)

    def rename(self) -> None:
        """Rename a file of the project; the open one stays open under its new name."""
        project = self._the_project()
        path = self._choose(self.tr("Rename"), project.files())
        name = self._ask_name(self.tr("Rename"), path.stem) if path else ""
        if path is None or not name:
            return
        was_open = self.window.page_of(path) is not None
        if self._let_go(path):
            try:
                path = project.rename(path, name)
            finally:
                if was_open:
                    self._open_path(path)

    def delete(self) -> None:
        """Delete a file of the project; it can be recovered."""
        project = self._the_project()
        path = self._choose(self.tr("Delete"), project.files())
        question = (
            self.tr("Delete {name}? It is kept as a backup and can be recovered.").format(name=path.name)
            if path
            else ""
        )
        if path is None or ask(
            self.window, self.tr("Delete"), question, self.tr("&Delete"), self.tr("Cancel"), default=1
        ) != self.tr("&Delete"):
            return
        if self._let_go(path):
            project.delete(path)
            self.window.show_status(self.tr("{name} deleted").format(name=path.name))

    def recover(self) -> None:
        """Recover a deleted file or an older version."""
        project = self._the_project()
        path = self._choose(self.tr("Recover"), project.backups())
        if path and self._let_go(path):
            project.recover(path)
            self._open_path(path)
