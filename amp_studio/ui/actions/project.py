"""What the project menu does: the folder of one machine, and its files."""

from __future__ import annotations

import contextlib
from functools import partial
from pathlib import Path

from PySide6.QtWidgets import QFileDialog

from amp_studio.files import ParameterFileError, Project, is_there, parameter_files_in
from amp_studio.schema import Address
from amp_studio.ui.base.ask_path import ask_to_open
from amp_studio.ui.base.modal import run_dialog
from amp_studio.ui.base.questions import ask, choose, type_text
from amp_studio.ui.base.task import in_background, run_with_progress
from amp_studio.ui.base.translated import counted, tr
from amp_studio.ui.merge.comparisons import parameter_files
from amp_studio.ui.window.studio_window import StudioWindow


def notice(window: StudioWindow, folder: Path) -> None:
    """Use the project of a folder, if it is one, because one of its files was opened."""
    if (folder / "project.yaml").exists() and (window.project is None or window.project.folder != folder):
        with contextlib.suppress(
            ParameterFileError
        ):  # an unreadable project file does not prevent work on the parameters
            window.project = Project.open(folder)


def name_of(window: StudioWindow, path: Path) -> str:
    """Return the name of the project a file belongs to."""
    return window.project.info.name if window.project and window.project.folder == path.parent else ""


def _the_project(window: StudioWindow) -> Project:
    if window.project is None:
        raise ValueError(tr("Open a project first: Project > Open Project."))
    return window.project


def _show(window: StudioWindow, project: Project) -> None:
    window.project = project
    files = len(project.files())
    window.show_status(
        tr("Project {name}: {count} in {folder}").format(
            name=project.info.name, count=counted(files, "file", none="no"), folder=project.folder
        )
    )


# -- the project -----------------------------------------------------------


def new(window: StudioWindow) -> None:
    """Create a project folder."""
    from amp_studio.ui.dialogs.file_dialogs import ProjectDialog

    dialog = ProjectDialog(None, window)
    if run_dialog(dialog):
        info = dialog.info()
        folder = QFileDialog.getExistingDirectory(window, tr("Folder of the new project"))
        if folder:
            _show(window, Project.create(Path(folder), info))


def open_project(window: StudioWindow) -> None:
    """Ask for a project folder and choose one of its files."""
    folder = QFileDialog.getExistingDirectory(window, tr("Open project"))
    if folder:
        open_folder(window, Path(folder))


def open_folder(window: StudioWindow, folder: Path) -> None:
    """Open a project, or a folder that is none, and choose one of its files. Raises ParameterFileError."""
    if is_there(folder / "project.yaml"):
        _show(window, Project.open(folder))
    files = parameter_files_in(folder)
    if not files and not is_there(folder / "project.yaml"):
        raise ValueError(tr("{folder} has no parameter files and is no project.").format(folder=folder))
    if files and (path := files[0] if len(files) == 1 else _choose(window, tr("Open"), files)):
        window.open_path(path)


def change(window: StudioWindow) -> None:
    """Change the project information."""
    from amp_studio.ui.dialogs.file_dialogs import ProjectDialog

    project = _the_project(window)
    dialog = ProjectDialog(project.info, window)
    if run_dialog(dialog):
        info = dialog.info()
        keys = ("name", "application", "machine", "control", "control_name", "revision", "notes")
        project.change(**{key: getattr(info, key) for key in keys})
        window.project = project


# -- its files -------------------------------------------------------------


def _choose(window: StudioWindow, title: str, paths: list[Path]) -> Path | None:
    if not paths:
        raise ValueError(tr("The project has no files of this kind."))
    names, workspace = [p.stem for p in paths], window.workspace
    here = names.index(workspace.path.stem) if workspace and workspace.path in paths else 0
    chosen = choose(window, title, tr("File"), names, title, here)
    return None if chosen is None else paths[chosen]


def _ask_name(window: StudioWindow, title: str, name: str = "") -> str:
    return (type_text(window, title, tr("New name"), title, name) or "").strip()


def _close_for_move(window: StudioWindow, path: Path) -> bool:
    """Close a file if it is open, asking about unsaved work; returns whether it may be moved."""
    page = window.page_of(path)
    if page is None or not page.workspace.may_edit:
        return True
    if not window.may_leave(page):
        return False
    window.close_page(page)
    return True


def open_file(window: StudioWindow) -> None:
    """Open a file of the project."""
    path = _choose(window, tr("Open"), _the_project(window).files())
    if path:
        window.open_path(path)


def check(window: StudioWindow) -> None:
    """Check every file of the project as it is on disk, and list the findings."""
    from amp_studio.ui.project.check import ProjectCheckDialog, check_files

    paths = _the_project(window).files()
    if not paths:
        raise ValueError(tr("The project has no files yet."))
    found = run_with_progress(
        tr("Check All Files"), lambda progress, cancelled: check_files(paths, progress, cancelled), window
    )
    window.beside.show(ProjectCheckDialog(found, partial(show_at, window), window, len(paths)))


def compare(window: StudioWindow) -> None:
    """Show what differs between files of the project and those that are open."""
    from amp_studio.ui.merge.machines_dialog import MachinesDialog

    project, pages = window.project, window.tabs.pages()
    front = [window.workspace] if window.workspace is not None else []
    opened = list(dict.fromkeys([*front, *(page.workspace for page in pages)]))
    paths = project.files() if project is not None else []
    asked = (opened, paths)
    if window.beside.again(MachinesDialog, asked=asked) is not None:
        return
    dialog = MachinesDialog(
        opened, paths, partial(show_at, window), window, window.report_options.contents.language
    )
    window.beside.show(dialog, asked=asked)
    dialog.begin()


def show_at(window: StudioWindow, path: Path, address: Address | None) -> None:
    """Select an address in a file of the project; opens the file if necessary."""

    def show() -> None:
        window.open_path(path)
        page = window.page_of(path)
        if address is not None and page is not None:
            page.go_to(address)

    window.guarded(show, tr("Open"))


def copy(window: StudioWindow) -> None:
    """Copy a file of the project under a new name and open the copy."""
    _copy(window, _choose(window, tr("Copy"), _the_project(window).files()))


def copy_from(window: StudioWindow) -> None:
    """Copy a file of another project into this one."""
    folder = _the_project(window).folder.parent
    _copy(window, ask_to_open(window, tr("Copy from another project"), folder, parameter_files()))


def _copy(window: StudioWindow, source: Path | None) -> None:
    name = _ask_name(window, tr("Copy"), source.stem) if source else ""
    if source and name:
        project = _the_project(window)
        path = in_background(window, tr("Copying"), lambda: project.copy(source, name))
        window.open_path(path)


def rename(window: StudioWindow) -> None:
    """Rename a file of the project; the open one stays open under its new name."""
    project = _the_project(window)
    path = _choose(window, tr("Rename"), project.files())
    name = _ask_name(window, tr("Rename"), path.stem) if path else ""
    if path is None or not name:
        return
    was_open = window.page_of(path) is not None
    if _close_for_move(window, path):
        try:
            path = project.rename(path, name)
        finally:
            if was_open:
                window.open_path(path)


def delete(window: StudioWindow) -> None:
    """Delete a file of the project; it can be recovered."""
    project = _the_project(window)
    path = _choose(window, tr("Delete"), project.files())
    question = (
        tr("Delete {name}? It is kept as a backup and can be recovered.").format(name=path.name)
        if path
        else ""
    )
    if path is None or ask(window, tr("Delete"), question, tr("&Delete"), tr("Cancel"), default=1) != tr(
        "&Delete"
    ):
        return
    if _close_for_move(window, path):
        project.delete(path)
        window.show_status(tr("{name} deleted").format(name=path.name))


def recover(window: StudioWindow) -> None:
    """Recover a deleted file or an older version."""
    project = _the_project(window)
    path = _choose(window, tr("Recover"), project.backups())
    if path and _close_for_move(window, path):
        project.recover(path)
        window.open_path(path)
