"""The file and project menus: new, open, save, save as, recover, copy, rename, delete, report, project."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtWidgets import QFileDialog, QInputDialog, QLabel, QMessageBox, QVBoxLayout, QWidget

from amp_studio.files import Document, InUse, Project, Unsaved, backup_path, compare, open_file, recover_backup

from .file_dialogs import NewFileDialog, ProjectDialog, ReportDialog, project_summary
from .task import ProgressDialog
from .workspace import Workspace

if TYPE_CHECKING:
    from .main_window import MainWindow

FILTER = "Parameter files (*.amp);;All files (*)"


class FileActions:
    """Everything that opens, saves or renames."""

    def __init__(self, window: MainWindow) -> None:
        self.window = window
        self.project: Project | None = None
        act, keys = window.action, QKeySequence.StandardKey
        menu = window.menuBar().addMenu("&File")
        new = act("&New…", self.new, keys.New, needs_file=False)
        opened = act("&Open…", self.open, keys.Open, needs_file=False)
        save = act("&Save", window.save_or_tell, keys.Save)
        self.report_action = act("&Report…", self.report, QKeySequence.StandardKey.Print)
        menu.addActions([new, opened, save, act("Save &As…", self.save_as, keys.SaveAs)])
        menu.addSeparator()
        menu.addActions([act("Compare &With…", self.compare, None), act("Recover &Backup…", self.recover, None)])
        menu.addSeparator()
        menu.addActions([self.report_action, act("Machine Facts…", self.facts, None)])
        menu.addSeparator()
        menu.addAction(act("E&xit", window.close, keys.Quit, needs_file=False))
        project = window.menuBar().addMenu("&Project")
        project.addActions([
            act("New &Project…", self.new_project, None, needs_file=False),
            act("&Open Project…", self.open_project, None, needs_file=False),
            act("Project &Information…", self.change_project, None, needs_file=False),
        ])  # fmt: skip
        project.addSeparator()
        project.addActions([
            act("Open &File of the Project…", self.open_of_project, "Ctrl+Shift+O", needs_file=False),
            act("&Copy File…", self.copy, None, needs_file=False),
            act("Copy from &Another Project…", self.copy_from, None, needs_file=False),
            act("&Rename File…", self.rename, None, needs_file=False),
            act("&Delete File…", self.delete, None, needs_file=False),
            act("Recover a Deleted or Older File…", self.recover_of_project, None, needs_file=False),
        ])  # fmt: skip
        self.toolbar: list[QAction] = [new, opened, save, self.report_action]

    def show_welcome(self) -> None:
        """Show what can be done without a file."""
        label = QLabel(
            "<h2>AMP Studio</h2><p>Open a parameter file (Ctrl+O) or make a new one (Ctrl+N).</p>"
            "<p>Every command is one Ctrl+Shift+P away.</p>"
        )
        label.setAlignment(Qt.AlignmentFlag.AlignCenter)
        page = QWidget()
        QVBoxLayout(page).addWidget(label)
        self.window.setCentralWidget(page)

    # -- files -----------------------------------------------------------------

    def new(self) -> None:
        """Make a new file from the family's defaults."""
        if not self.window.may_leave():
            return
        dialog = NewFileDialog(self.window)
        if dialog.exec():
            file = dialog.make()
            if self.project and self.project.info.family == file.schema.family.family:
                path = self.project.path(file.header.name)
            else:
                path = self._ask_path("New parameter file", Path(file.header.name or "machine"))
            if path:
                self.show_document(Document.create(file, path))

    def _ask_path(self, title: str, near: Path) -> Path | None:
        text, _ = QFileDialog.getSaveFileName(self.window, title, str(near.with_suffix(".amp")), FILTER)
        return Path(text) if text else None

    def open(self) -> None:
        """Ask for a file and open it."""
        folder = str(self.project.folder) if self.project else ""
        text, _ = QFileDialog.getOpenFileName(self.window, "Open", folder, FILTER)
        if text:
            self.open_path(Path(text))

    def open_path(self, path: Path, ask: bool = True) -> None:
        """Open a file; offers unsaved work, and to look at it when another program edits it. Raises FileFault."""
        if ask and not self.window.may_leave():
            return
        if self.window.workspace and self.window.workspace.path.resolve() == path.resolve():
            self.window.workspace.close()
        try:
            document = Document.open(path)
        except InUse as error:
            answer = QMessageBox.question(self.window, "File in use", f"{error}.\n\nOpen it to look at it only?")
            if answer != QMessageBox.StandardButton.Yes:
                return
            document = Document.view(path)
        self.show_document(document)
        if document.is_locked:
            self._offer_unsaved(document)

    def show_document(self, document: Document) -> None:
        """Show a document in the window."""
        self.window.show_workspace(Workspace(document))
        self.window.settings.setValue("last-file", str(document.path))
        folder = document.path.parent
        if (folder / "project.yaml").exists() and (self.project is None or self.project.folder != folder):
            self.project = Project.open(folder)

    def _offer_unsaved(self, document: Document) -> None:
        left = document.find_unsaved()
        if left is None or not left.changes:
            return
        note = "" if left.fits else "\n\nThe file has been changed since; check what you take."
        answer = QMessageBox.question(
            self.window, "Unsaved work found",
            f"The program ended before {len(left.changes)} changes of {left.when[:16].replace('T', ' ')} "
            f"({left.who}) were saved.{note}\n\nTake them back? (You can undo it.)",
        )  # fmt: skip
        if answer == QMessageBox.StandardButton.Yes:
            self._take(left)
        else:
            document.discard_unsaved()

    def _take(self, left: Unsaved) -> None:
        assert self.window.workspace is not None
        wanted = {c.address: c.new for c in left.changes}
        self.window.workspace.edit("Unsaved work", wanted, force="by the program that ended before it saved")

    def save_as(self) -> None:
        """Save under a new name; the original stays as it is on disk."""
        workspace = self.window.workspace
        assert workspace is not None
        path = self._ask_path("Save as", workspace.path)
        if path and path.resolve() == workspace.path.resolve():
            self.window.save_or_tell()
        elif path:
            if path.exists():  # the dialog has asked already
                path.replace(backup_path(path))
            self.show_document(workspace.document.save_as(path))

    def compare(self) -> None:
        """List the differences to another file."""
        workspace = self.window.workspace
        assert workspace is not None
        text, _ = QFileDialog.getOpenFileName(self.window, "Compare with", str(workspace.path.parent), FILTER)
        if text:
            from .compare_dialog import CompareDialog

            other = open_file(Path(text)).file
            if other.schema is not workspace.file.schema:
                raise ValueError(f"{Path(text).name} is for {other.schema.family.name}")
            found = compare(workspace.file.schema, workspace.file.values, other.values)
            CompareDialog(workspace, found, Path(text).name, self.window.go_to, self.window).show()

    def recover(self) -> None:
        """Put the backup of the open file in its place."""
        workspace = self.window.workspace
        assert workspace is not None
        path = workspace.path
        question = f"Replace {path.name} by its backup? What stands there now becomes the backup."
        if QMessageBox.question(self.window, "Recover backup", question) == QMessageBox.StandardButton.Yes:
            recover_backup(path, workspace.document.digest)
            self.open_path(path, ask=False)

    def facts(self) -> None:
        """Edit the notes, revision and application of the open file."""
        workspace = self.window.workspace
        assert workspace is not None
        from .file_dialogs import FactsDialog

        if FactsDialog(workspace.file.header, self.window).exec():
            workspace.save()

    def report(self) -> None:
        """Print the file as PDF, HTML, CSV or text."""
        workspace = self.window.workspace
        assert workspace is not None
        dialog = ReportDialog(workspace.path, self.window)
        if not dialog.exec():
            return
        path, sort, changed_only = dialog.chosen()
        file = workspace.file.copy()

        def work(progress: object, cancel: object) -> Path:
            from amp_studio.report import write_report

            write_report(file, path, sort=sort, changed_only=changed_only, source=workspace.path)
            return path

        ProgressDialog("Report", work, self.window, f"Writing {path.name} …").run()
        self.window.statusBar().showMessage(f"{path} written", 8000)

    # -- projects --------------------------------------------------------------

    def _the_project(self) -> Project:
        if self.project is None:
            raise ValueError("Open a project first (Project > Open Project)")
        return self.project

    def new_project(self) -> None:
        """Make a project folder."""
        dialog = ProjectDialog(None, self.window)
        if dialog.exec():
            folder = QFileDialog.getExistingDirectory(self.window, "Folder of the new project")
            if folder:
                self.project = Project.create(Path(folder), dialog.info())
                self.window.statusBar().showMessage(project_summary(self.project), 8000)

    def open_project(self) -> None:
        """Open a project folder and choose one of its files."""
        folder = QFileDialog.getExistingDirectory(self.window, "Open project")
        if folder:
            self.project = Project.open(Path(folder))
            if self.project.files():
                self.open_of_project()

    def change_project(self) -> None:
        """Change the project information."""
        project = self._the_project()
        dialog = ProjectDialog(project.info, self.window)
        if dialog.exec():
            info = dialog.info()
            project.change(**{k: getattr(info, k) for k in ("name", "application", "machine", "control", "control_name",
                                                            "revision", "notes")})  # fmt: skip

    def _choose(self, title: str, paths: list[Path]) -> Path | None:
        if not paths:
            raise ValueError("the project has no such files")
        names = [p.stem for p in paths]
        name, accepted = QInputDialog.getItem(self.window, title, "File", names, 0, False)
        return paths[names.index(name)] if accepted else None

    def _ask_name(self, title: str, name: str = "") -> str | None:
        text, accepted = QInputDialog.getText(self.window, title, "New name", text=name)
        return text.strip() if accepted and text.strip() else None

    def open_of_project(self) -> None:
        """Open a file of the project."""
        path = self._choose("Open", self._the_project().files())
        if path:
            self.open_path(path)

    def copy(self) -> None:
        """Copy a file of the project under a new name and open the copy."""
        self._copy(self._choose("Copy", self._the_project().files()))

    def copy_from(self) -> None:
        """Copy a file of another project into this one."""
        self._the_project()
        text, _ = QFileDialog.getOpenFileName(self.window, "Copy from another project", "", FILTER)
        self._copy(Path(text) if text else None)

    def _copy(self, source: Path | None) -> None:
        name = source and self._ask_name("Copy", source.stem)
        if source and name:
            self.open_path(self._the_project().copy(source, name))

    def rename(self) -> None:
        """Rename a file of the project that is not open."""
        path = self._choose("Rename", self._the_project().files())
        name = path and self._ask_name("Rename", path.stem)
        if path and name:
            self._the_project().rename(path, name)

    def delete(self) -> None:
        """Delete a file of the project; it can be recovered."""
        path = self._choose("Delete", self._the_project().files())
        if path and QMessageBox.question(self.window, "Delete", f"Delete {path.name}? Its content stays as its backup."
                                         ) == QMessageBox.StandardButton.Yes:  # fmt: skip
            self._the_project().delete(path)

    def recover_of_project(self) -> None:
        """Bring a deleted or older file back."""
        path = self._choose("Recover", self._the_project().backups())
        if path:
            self._the_project().recover(path)
            self.open_path(path)
