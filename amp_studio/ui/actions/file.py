"""What the file menu does: new, open, save as, recover, facts."""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import partial
from pathlib import Path

from PySide6.QtCore import QStandardPaths
from PySide6.QtWidgets import QFileDialog

from amp_studio.files import (
    Document,
    EditLock,
    InUseError,
    Unsaved,
    backup_path,
    examples_folder,
    open_file,
    real_path,
    record_origin,
    recover_backup,
    same_file,
    write_atomic,
)
from amp_studio.ui.base.ask_path import ask_to_open
from amp_studio.ui.base.modal import run_dialog
from amp_studio.ui.base.questions import ask
from amp_studio.ui.base.task import in_background
from amp_studio.ui.base.time_words import stored_in_words
from amp_studio.ui.base.translated import Translated, counted, message_in_words
from amp_studio.ui.base.workspace import Workspace, earlier_of
from amp_studio.ui.merge.comparisons import Comparisons, parameter_files
from amp_studio.ui.page.file_page import FilePage
from amp_studio.ui.window.recent_files import RecentFiles
from amp_studio.ui.window.studio_window import StudioWindow
from amp_studio.validate import Validator, rules_beside

from .format import TextFormats

CheckedDocument = tuple[Document, Validator]
"""A document and its validator, already run."""

Show = Callable[[Workspace, FilePage | None], FilePage]
"""Shows a workspace in a new tab, or in the place of a page."""


class Files(Translated):
    """Everything that opens, saves or prints the open file."""

    def __init__(self, window: StudioWindow, show: Show) -> None:
        self.window, self._show_in_tab = window, show
        self.recent = RecentFiles(window, self.open_path)
        self.comparing = Comparisons(window, self.ask_path, self.write_new)
        self.formats = TextFormats(window, self.ask_path, self.write_new)
        self.last_session: list[Path] = window.settings.session()
        """The files that were open when the program was left; none once they have been opened again."""

    # -- opening ---------------------------------------------------------------

    def new(self, family: str = "") -> None:
        """Make a new file from the family's defaults, or like another one."""
        from amp_studio.ui.dialogs.new_file_dialog import NewFileDialog, read_families

        project, workspace = self.window.project, self.window.workspace
        now = project.info.family if project else workspace.file.schema.family.family if workspace else ""
        in_background(
            self.window, self.tr("Reading the families"), read_families
        )  # the dialog offers all of them
        dialog = NewFileDialog(self.window, family or now, project=project, recent=self.recent.paths())
        if not run_dialog(dialog):
            return
        file, origin = (
            dialog.make(),
            dialog.source(),
        )  # before the next question: nothing is asked of a closed dialog
        path = dialog.path() or self.ask_path(
            self.tr("New parameter file"), Path(file.header.name or "machine")
        )
        if path:
            if origin is not None:
                record_origin(file, path, origin)
            self.write_new(path, lambda: Document.create(file, path))

    def open_example(self, example: Path) -> None:
        """Open a copy of an example; the example itself is never edited."""
        path = self.ask_path(self.tr("Copy of an example"), Path(example.name))
        if path is None:
            return
        content = example.read_bytes()

        def write() -> Document:
            write_atomic(path, content, None)
            return Document.open(path)

        self.write_new(path, write)

    def ask_path(self, title: str, near: Path) -> Path | None:
        """Ask where to save; adds the file extension and asks before a file is replaced."""
        text, _ = QFileDialog.getSaveFileName(
            self.window,
            title,
            str(self._own_folder() / near.with_suffix(".amp")),
            parameter_files(),
            options=QFileDialog.Option.DontConfirmOverwrite,
        )
        if not text:
            return None
        path = Path(text)
        path = path if path.suffix else path.with_suffix(".amp")
        question = self.tr("{name} already exists. Replace it? The existing file becomes its backup.").format(
            name=path.name
        )
        if path.exists() and ask(
            self.window, title, question, self.tr("&Replace"), self.tr("Cancel"), default=1
        ) != self.tr("&Replace"):
            return None
        return real_path(path) if path.exists() else path  # of a link it is the file that is replaced

    def _own_folder(self) -> Path:
        """Return the folder of the file in front, or the user's documents;
        never that of the program's examples.
        """
        workspace = self.window.workspace
        if workspace and examples_folder() not in real_path(workspace.path).parents:
            return workspace.path.parent
        return Path(QStandardPaths.writableLocation(QStandardPaths.StandardLocation.DocumentsLocation))

    def write_new(self, path: Path, write: Callable[[], Document], instead: FilePage | None = None) -> None:
        """Show the document that ``write`` makes, in the place of a page if one is given;
        an existing file is backed up first.

        Raises ValueError for a file that is open here.
        """
        if self.window.page_of(path) is not None:
            raise ValueError(
                self.tr("{name} is open in a tab. Close it first, or choose another name.").format(
                    name=path.name
                )
            )

        def work() -> CheckedDocument:
            if not path.exists():
                document = write()
            else:
                with EditLock(path):  # raises InUseError while a program edits it
                    os.replace(path, backup_path(path))
                try:
                    document = write()
                except BaseException:
                    if not path.exists():
                        os.replace(backup_path(path), path)
                    raise
            return document, checked(document)

        self._show(in_background(self.window, self.tr("Saving"), work), instead)

    def open(self) -> None:
        """Ask for a file and open it."""
        project, workspace = self.window.project, self.window.workspace
        folder = workspace.path.parent if workspace else project.folder if project else ""
        if path := ask_to_open(self.window, self.tr("Open"), folder, parameter_files()):
            self.open_path(path)

    def open_path(self, path: Path) -> None:
        """Open a file, or come back to it where it is open; offers unsaved work,
        and to look at it when another program edits it.

        Raises ParameterFileError.
        """
        page = self.window.page_of(path)
        if page is not None:
            self.window.tabs.bring(page)
            return
        try:
            opened = in_background(self.window, self.tr("Opening"), lambda: _opened(Document.open, path))
        except InUseError as error:
            question = self.tr("{error}.\n\nOpen it read-only?").format(error=message_in_words(str(error)))
            if ask(
                self.window, self.tr("Read-Only"), question, self.tr("&Open Read-Only"), self.tr("Cancel")
            ) != self.tr("&Open Read-Only"):
                return
            opened = in_background(self.window, self.tr("Opening"), lambda: _opened(Document.view, path))
        self._show(opened)

    def reload(self, page: FilePage) -> None:
        """Open a file again in the place of its page; what cannot be read replaces nothing. Shows errors."""

        def work() -> None:
            path, here = page.workspace.path, page.table_view.address()
            in_background(self.window, self.tr("Opening"), lambda: open_file(path))
            page.workspace.release()
            again = self._show(
                in_background(self.window, self.tr("Opening"), lambda: _opened(Document.open, path)), page
            )
            if here and again:
                again.go_to(here)

        self.window.guarded(work, self.tr("Open"))

    def restore_session(self) -> None:
        """Open the files that were open when the program was left; what cannot be opened is named."""
        missing, self.last_session = [], []
        tabs, paths = self.window.tabs, self.window.settings.session()
        for path in paths:
            try:
                try:
                    opened = in_background(
                        self.window, self.tr("Opening"), partial(_opened, Document.open, path)
                    )
                except InUseError:
                    opened = in_background(
                        self.window, self.tr("Opening"), partial(_opened, Document.view, path)
                    )
            except (OSError, ValueError):
                missing.append(path.name)
            else:
                self._show(opened)
        for path in self.window.settings.beside():
            page = self.window.page_of(path)
            if page is not None and page in tabs.pages_of(0):
                tabs.move_across(page)
        last = self.window.page_of(paths[-1]) if paths else None
        if last is not None:
            tabs.bring(last)
        if missing:
            self.window.show_status(self.tr("Not opened again: {list}").format(list=", ".join(missing)))

    def keep_session(self) -> None:
        """Store which files are open, the one in front last, and which are on the second side."""
        tabs = self.window.tabs
        pages = sorted(tabs.pages(), key=lambda page: page is self.window.page)
        self.window.settings.keep_session(
            (p.workspace.path.absolute() for p in pages),
            (p.workspace.path.absolute() for p in tabs.pages_of(1)),
        )

    def _show(self, opened: CheckedDocument, instead: FilePage | None = None) -> FilePage | None:
        """Show a document; returns its page, None where it was closed again."""
        document, validator = opened
        page = self._show_in_tab(Workspace(document, validator), instead)
        self.recent.remember(document.path)
        if document.is_locked:
            self._offer_unsaved(page)
        return page if page in self.window.tabs.pages() else None

    def _offer_unsaved(self, page: FilePage) -> None:
        document = page.workspace.document
        unsaved = document.find_unsaved()
        if unsaved is None or not (unsaved.changes or unsaved.header):
            return
        note = (
            ""
            if unsaved.fits
            else self.tr("\n\nThe file was changed since then. Check the recovered values.")
        )
        changes = len(unsaved.changes) + len(unsaved.header)
        count = counted(changes, "change")
        text = self.tr(
            "The program ended before {count} from {day_and_time} ({who}) could be saved.{note}\n\nRecover"
            " the unsaved work? You can undo this."
        ).format(count=count, day_and_time=stored_in_words(unsaved.when), who=unsaved.who, note=note)
        answer = ask(
            self.window,
            self.tr("Unsaved work found"),
            text,
            self.tr("&Recover"),
            self.tr("&Discard"),
            self.tr("Decide &Later"),
        )
        if answer == self.tr("&Recover"):
            self._recover_unsaved(page.workspace, unsaved)
        elif answer == self.tr("&Discard"):
            document.discard_unsaved()
        else:
            self.window.close_page(page)  # the first edit would write over it

    def _recover_unsaved(self, workspace: Workspace, unsaved: Unsaved) -> None:
        file = workspace.file
        changes = {c.address: c.new for c in unsaved.changes}

        def recover() -> None:
            file.set_checked(changes, force="recovered from unsaved work")
            vars(file.header).update(unsaved.header)

        workspace.do(self.tr("Recover unsaved work"), recover)

    # -- the open file ---------------------------------------------------------

    def close(self, page: FilePage | None = None) -> None:
        """Close a file, the one in front by default, after a question about unsaved work."""
        page = page or self.window.page
        if page is not None and self.window.may_leave(page):
            self.window.close_page(page)

    def save_as(self) -> None:
        """Save under a new name; the original file is not changed."""
        page, workspace, here = self.window.page, self.window.workspace_in_front, self.window.selected()
        path = self.ask_path(self.tr("Save as"), workspace.path)
        if path is None:
            return
        if same_file(path, workspace.path):
            self.window.save()
            return
        self.write_new(path, lambda: workspace.document.save_as(path), page)
        if here:
            self.window.go_to(here)

    def recover(self) -> None:
        """Replace the open file by its backup."""
        workspace = self.window.workspace_in_front
        path = workspace.path
        if not backup_path(path).is_file():
            raise FileNotFoundError(
                self.tr("{name} has no backup yet. The first save makes one.").format(name=path.name)
            )
        lost = self.tr(" Your unsaved changes will be lost.") if workspace.is_dirty else ""
        question = self.tr(
            "Replace {name} by its backup? The present content becomes the backup.{lost}"
        ).format(name=path.name, lost=lost)
        if ask(
            self.window,
            self.tr("Recover backup"),
            question,
            self.tr("&Replace"),
            self.tr("Cancel"),
            default=1,
        ) == self.tr("&Replace"):
            in_background(
                self.window, self.tr("Recovering"), lambda: recover_backup(path, workspace.document.digest)
            )
            self.reload(self.window.page_in_front)

    def facts(self) -> None:
        """Edit name, revision, application and notes of the open file."""
        from amp_studio.ui.dialogs.file_dialogs import FactsDialog

        workspace = self.window.workspace_in_front
        dialog = FactsDialog(workspace.file.header, self.window)
        if run_dialog(dialog):
            texts = dialog.form.answers()
            workspace.do(self.tr("Machine facts"), lambda: vars(workspace.file.header).update(texts))


def _opened(how: Callable[[Path], Document], path: Path) -> CheckedDocument:
    document = how(path)
    return document, checked(document)


def checked(document: Document) -> Validator:
    """Return the validator of a document, already run,
    with the builder's rules beside the file and what it was.
    """
    own = rules_beside(document.path, document.file)
    validator = Validator(document.file, own, earlier_of(document))
    validator.run()
    return validator
