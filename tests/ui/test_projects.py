"""The files of a project: open, copy (also from another project), rename, delete, recover."""

import threading
from pathlib import Path

import pytest

from amp_studio.files import Document, Project, ProjectInfo
from amp_studio.schema import Value
from amp_studio.ui.base.task import TaskProgress
from amp_studio.ui.dialogs import file_dialogs
from amp_studio.ui.dialogs.new_file_dialog import NewFileDialog
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.project import check as project_check
from amp_studio.ui.project.check import ProjectCheckDialog

from .conftest import User, action, on_disk

pytestmark = pytest.mark.own_window

EXCESS = ("servo.excess_error", "1")


@pytest.fixture
def project(path: Path) -> Project:
    """Return a project round the file, with a second file in it."""
    project = Project.create(
        path.parent, ProjectInfo(name="Mill", family="9pc", machine="mill", control="tcp://127.0.0.1:9")
    )
    project.copy(path, "second")
    return project


@pytest.fixture
def window(open_window, project: Project, path: Path) -> MainWindow:
    """Return a window with the project's first file open."""
    return open_window(path)


def test_opening_a_file_opens_its_project(window: MainWindow) -> None:
    assert window.project.info.name == "Mill"
    assert "Mill" in window.windowTitle()
    assert action(window, "Rename File").isEnabled()


def test_without_a_project_its_commands_are_off(open_window) -> None:
    window = open_window()
    assert not action(window, "Rename File").isEnabled()
    assert action(window, "Open Project").isEnabled()


def test_open_a_project_and_one_of_its_files(open_window, project: Project, user: User) -> None:
    window = open_window()
    user.chooses(project.folder)
    user.types("second")
    action(window, "Open Project").trigger()
    assert window.workspace.path.stem == "second"


def test_copy_opens_the_copy(window: MainWindow, project: Project, user: User) -> None:
    user.types("mill", "third")
    action(window, "Copy File").trigger()
    assert window.workspace.path == project.path("third")
    assert on_disk(project.path("third")).values == on_disk(project.path("mill")).values


def test_copy_from_another_project(window: MainWindow, project: Project, user: User, tmp_path: Path) -> None:
    other = Project.create(tmp_path / "other", ProjectInfo(name="Other", family="9pc", machine="mill"))
    theirs = other.copy(project.path("mill"), "theirs")
    user.chooses(theirs)
    user.types("ours")
    action(window, "Copy from Another Project").trigger()
    assert window.workspace.path == project.path("ours")
    assert theirs.exists()


def test_a_name_that_is_taken_is_reported(window: MainWindow, user: User) -> None:
    user.types("mill", "SECOND")
    action(window, "Copy File").trigger()
    assert "there is a file 'second' already" in user.reads().lower()


def test_rename_a_file_that_is_not_open(window: MainWindow, project: Project, path: Path, user: User) -> None:
    user.types("second", "renamed")
    action(window, "Rename File").trigger()
    assert {p.stem for p in project.files()} == {"mill", "renamed"}
    assert window.workspace.path == path


def test_rename_the_open_file_keeps_it_open(window: MainWindow, project: Project, user: User) -> None:
    window.edits.commit(EXCESS, "3 mm")
    user.types("mill", "renamed")
    user.answers("Save")
    action(window, "Rename File").trigger()
    assert {p.stem for p in project.files()} == {"renamed", "second"}
    assert window.workspace.path == project.path("renamed")
    assert window.workspace.may_edit
    assert window.workspace.file.get(EXCESS) == Value(3.0, "mm")


def test_a_rename_that_fails_leaves_the_file_open(window: MainWindow, project: Project, user: User) -> None:
    user.types("mill", "second")
    action(window, "Rename File").trigger()
    assert "already" in user.reads()
    assert window.workspace.path == project.path("mill")
    assert window.workspace.may_edit


def test_delete_asks_and_can_be_recovered(window: MainWindow, project: Project, user: User) -> None:
    user.types("second", "second", "second")
    user.answers("Cancel", "Delete")
    action(window, "Delete File").trigger()
    assert project.path("second").exists()
    action(window, "Delete File").trigger()
    assert not project.path("second").exists()

    action(window, "Recover a Deleted or Older File").trigger()
    assert window.workspace.path == project.path("second")


def test_deleting_the_open_file_closes_it(window: MainWindow, project: Project, user: User) -> None:
    user.types("mill")
    user.answers("Delete")
    action(window, "Delete File").trigger()
    assert window.workspace is None
    assert not project.path("mill").exists()


def test_a_file_in_use_elsewhere_is_not_deleted(window: MainWindow, project: Project, user: User) -> None:
    user.types("second")
    user.answers("Delete")
    with Document.open(project.path("second")):
        action(window, "Delete File").trigger()
    assert "is open in another program" in user.reads()
    assert project.path("second").exists()


def test_a_new_file_goes_into_the_project(window: MainWindow, project: Project, accept) -> None:
    accept(NewFileDialog, lambda d: d.form.set_answer("name", "fresh"))
    action(window, "New").trigger()
    assert window.workspace.path == project.path("fresh")

    faults: list[str] = []
    accept(NewFileDialog, lambda d: (d.form.set_answer("name", "mill"), faults.append(d.fault.text())))
    action(window, "New").trigger()
    assert faults == ["The project already has a file 'mill'. Choose another name."]
    assert window.workspace.path == project.path("fresh")


def test_a_new_project_and_its_information(open_window, tmp_path: Path, accept, user: User) -> None:
    window = open_window()
    accept(file_dialogs.ProjectDialog, lambda d: d.form.set_answer("name", "Lathe"))
    user.chooses(tmp_path)
    action(window, "New Project").trigger()
    assert Project.open(tmp_path).info.name == "Lathe"

    accept(file_dialogs.ProjectDialog, lambda d: d.form.set_answer("control", "tcp://10.0.0.1:9600"))
    action(window, "Project Information").trigger()
    assert Project.open(tmp_path).info.control == "tcp://10.0.0.1:9600"


def test_a_project_needs_a_name(open_window) -> None:
    dialog = file_dialogs.ProjectDialog(None, open_window())
    dialog.accept()
    assert dialog.fault.text() == "Type a name for the project."
    assert not dialog.result()


def test_a_broken_project_file_does_not_hide_the_parameters(open_window, path: Path) -> None:
    (path.parent / "project.yaml").write_text("nonsense: [")
    window = open_window(path)
    assert window.workspace is not None
    assert window.project is None


def test_a_folder_that_is_no_project_opens_its_machine(
    open_window, path: Path, tmp_path: Path, user: User
) -> None:
    """``amp-studio FOLDER``: it was "project.yaml: cannot be read: No such file or directory"."""
    assert open_window(path.parent).workspace.path == path
    empty = tmp_path / "empty"
    empty.mkdir()
    assert open_window(empty).workspace is None
    assert user.reads() == f"{empty} has no parameter files and is no project."


def test_all_files_are_checked_and_a_finding_is_shown_in_its_file(
    window: MainWindow, project: Project
) -> None:
    with Document.open(project.path("second")) as second:
        second.file.set_checked({EXCESS: Value(1e9, "mm")}, force="by a test")
        second.save()
    project.path("third").write_text("family: 9pc\n", encoding="utf-8")
    action(window, "Check All Files").trigger()
    dialog = window.findChild(ProjectCheckDialog)
    branches = {item.text(0): item for item in map(dialog.tree.topLevelItem, range(3))}
    assert list(branches) == ["mill.amp", "second.amp", "third.amp"]
    assert branches["third.amp"].text(4).startswith(str(project.path("third")))
    assert "1 cannot be read" in dialog.text.text()
    assert int(branches["second.amp"].text(1)) > int(branches["mill.amp"].text(1))
    assert branches["second.amp"].childCount() == 0, (
        "a hundred thousand lines are not made before they are seen"
    )
    dialog.tree.expandItem(branches["second.amp"])
    assert branches["second.amp"].childCount() == sum(
        int(branches["second.amp"].text(column)) for column in (1, 2, 3)
    )
    (leaf,) = (
        leaf
        for leaf in map(branches["second.amp"].child, range(branches["second.amp"].childCount()))
        if "Excess Error 1\u202f000\u202f000\u202f000 mm is outside" in leaf.text(4)
    )
    dialog.tree.itemActivated.emit(leaf, 0)
    assert (window.workspace.path, window.selected()) == (project.path("second"), EXCESS)


def test_a_cancelled_check_of_all_files_names_how_many_are_left(
    window: MainWindow, project: Project, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It listed the first files as if they were all."""
    check = project_check.check_files

    def cancel_after_one(paths: list[Path], progress: TaskProgress, cancelled: threading.Event) -> object:
        def count(name: str, done: int, total: int) -> None:
            progress(name, done, total)
            cancelled.set()

        return check(paths, count, cancelled)

    monkeypatch.setattr(project_check, "check_files", cancel_after_one)
    action(window, "Check All Files").trigger()
    dialog = window.findChild(ProjectCheckDialog)
    assert dialog.tree.topLevelItemCount() == 1
    assert dialog.text.text().startswith("Cancelled: 1 file not checked. 1 file as saved on disk: ")
