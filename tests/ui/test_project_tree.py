"""The tree of the project in the left panel: what is in the folder, with marks, and what is done with it."""

from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtCore import QFile, QMimeData, QPointF, Qt, QUrl
from PySide6.QtGui import QDropEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QTreeWidgetItem
from pytestqt.qtbot import QtBot

from amp_studio.files import Project, ProjectInfo, content_of, new_file
from amp_studio.schema import Value
from amp_studio.transfer.client.record import add_exchange, exchange_now
from amp_studio.ui.forms.place_tree import COUNTS, KEY, PICTURE, RIGHT
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.merge.window import MergeWindow
from amp_studio.ui.project.tree import ProjectTree

from .alt_letters import doubled
from .conftest import WAIT_MS, User


@pytest.fixture
def folder(path: Path) -> Path:
    """Return a project folder: the mill with a backup and a copy of a control, a second file with errors,
    rules, a deleted file.
    """
    here = path.parent
    Project.create(here, ProjectInfo("Workshop", "9pc", control_name="CNC_1", notes="two mills"))
    path.with_name("mill.amp.bak").write_bytes(path.read_bytes())
    path.with_name("mill.before-20260101-120000.img").write_bytes(b"what it was")
    second = new_file("9pc", "mill", ["X", "Y"], "second")
    second.set(("home.calibration", "1"), Value(1e9, "mm"))
    path.with_name("second.amp").write_bytes(content_of(second))
    path.with_name("gone.amp.bak").write_bytes(path.read_bytes())
    path.with_name("rules.yaml").write_text("rules: []\n")
    add_exchange(path, exchange_now("download", path, "9pc", "tcp://10.0.0.1:9600"))
    return here


@pytest.fixture
def tree(folder: Path, path: Path, open_window: Callable[..., MainWindow], qtbot: QtBot) -> ProjectTree:
    """Return the tree of the project, shown beside the mill."""
    window = open_window(path)
    window.page.left.show_side("project")
    found = window.page.left.findChild(ProjectTree)
    qtbot.waitUntil(lambda: found.tree.topLevelItemCount() > 0, timeout=WAIT_MS)
    return found


def row(tree: ProjectTree, kind: str, name: str = "") -> QTreeWidgetItem:
    """Return the row of a kind, of a name if there are several."""
    rows = [i for i in tree._by_key.values() if i.data(0, KEY)[0] == kind and name in str(i.data(0, KEY)[1])]
    assert len(rows) == 1, (kind, name, [i.text(0) for i in tree._by_key.values()])
    return rows[0]


def test_it_has_everything_that_belongs_to_the_project(tree: ProjectTree, qtbot: QtBot) -> None:
    top = tree.tree.topLevelItem(0)
    assert (top.text(0), top.data(0, RIGHT)) == ("Workshop", "9/PC")
    assert [top.child(n).text(0) for n in range(top.childCount())] == [
        "mill",
        "second",
        "Own rules",
        "Notes and control",
        "gone.amp",
    ]
    mill = row(tree, "file", "mill.amp")
    assert [mill.child(n).text(0) for n in range(mill.childCount())] == [
        "Backup",
        "Control before the download",
    ]
    assert "download: tcp://10.0.0.1:9600, today" in mill.toolTip(0)
    assert mill.data(0, RIGHT) == "10.0.0.1:9600"
    assert tree.tree.currentItem() is mill


def test_findings_of_closed_files_and_unsaved_work_are_marked(tree: ProjectTree, qtbot: QtBot) -> None:
    second = row(tree, "file", "second.amp")
    qtbot.waitUntil(lambda: bool(second.data(0, COUNTS)), timeout=WAIT_MS)
    assert dict(second.data(0, COUNTS))["error"] >= 1
    mill = row(tree, "file", "mill.amp")
    assert mill.data(0, PICTURE) == ("file", "text")
    tree._window.edits.commit(("servo.excess_error", "1"), "3 mm")
    assert mill.data(0, PICTURE) == ("circle-fill", "chg")
    assert "not saved" in mill.data(0, Qt.ItemDataRole.AccessibleTextRole)


def test_enter_opens_a_file_and_the_other_tree_shows_it(tree: ProjectTree, folder: Path) -> None:
    tree.tree.setCurrentItem(row(tree, "file", "second.amp"))
    QTest.keyClick(tree.tree, Qt.Key.Key_Return)
    assert tree._window.workspace.path == folder / "second.amp"


def test_a_backup_is_compared_with_the_file(tree: ProjectTree) -> None:
    tree.tree.itemActivated.emit(row(tree, "backup"), 0)
    displayed = tree._window.findChildren(MergeWindow)
    assert len(displayed) == 1
    displayed[0].close()


def test_it_follows_the_disk(tree: ProjectTree, folder: Path, path: Path, qtbot: QtBot) -> None:
    tree._settle.setInterval(0)
    (folder / "third.amp").write_bytes(path.read_bytes())
    qtbot.waitUntil(lambda: any(i.text(0) == "third" for i in tree._by_key.values()), timeout=WAIT_MS)
    (folder / "third.amp").unlink()
    qtbot.waitUntil(lambda: not any(i.text(0) == "third" for i in tree._by_key.values()), timeout=WAIT_MS)
    assert tree.tree.currentItem().text(0) == "mill", "what was selected stays so"


def test_a_file_goes_to_the_trash_only_after_a_question(
    tree: ProjectTree, folder: Path, user: User, monkeypatch: pytest.MonkeyPatch
) -> None:
    trashed: list[str] = []
    monkeypatch.setattr(QFile, "moveToTrash", lambda name: (trashed.append(Path(name).name), (True, ""))[1])
    tree.tree.setCurrentItem(row(tree, "file", "second.amp"))
    user.answers("Cancel")
    QTest.keyClick(tree.tree, Qt.Key.Key_Delete)
    assert trashed == []
    user.answers("Move to Trash")
    QTest.keyClick(tree.tree, Qt.Key.Key_Delete)
    assert trashed == ["second.amp"]


def test_where_there_is_no_trash_nothing_is_removed(
    tree: ProjectTree, folder: Path, user: User, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(QFile, "moveToTrash", lambda _: (False, ""))
    user.answers("Move to Trash")
    tree._remove(folder / "second.amp")
    assert "was not removed" in user.reads()
    assert (folder / "second.amp").exists()


def test_an_open_file_with_unsaved_work_is_asked_about_first(
    tree: ProjectTree, path: Path, user: User
) -> None:
    tree._window.edits.commit(("servo.excess_error", "1"), "3 mm")
    user.answers("Move to Trash", "Cancel")
    tree._remove(path)
    assert path.exists()
    assert tree._window.page_of(path) is not None


def test_a_file_is_added_by_a_copy_and_by_a_drop(
    tree: ProjectTree, folder: Path, tmp_path: Path, user: User
) -> None:
    outside = tmp_path / "other.amp"
    outside.write_bytes(content_of(new_file("9pc", "mill", ["X"], "other")))
    user.chooses(outside)
    tree._add()
    assert tree._window.workspace.path == folder / "other.amp"
    dropped = tmp_path / "dropped.amp"
    dropped.write_bytes(outside.read_bytes())
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(dropped))])
    buttons, keys = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
    tree.dropEvent(QDropEvent(QPointF(1, 1), Qt.DropAction.CopyAction, data, buttons, keys))
    assert (folder / "dropped.amp").exists()
    assert outside.exists()


def test_what_is_no_parameter_file_is_not_added(
    tree: ProjectTree, folder: Path, tmp_path: Path, user: User
) -> None:
    (tmp_path / "text.amp").write_text("hello")
    user.chooses(tmp_path / "text.amp")
    tree._add()
    assert "text.amp" in user.reads()
    assert not (folder / "text.amp").exists()


def test_a_name_that_is_taken_is_not_replaced(
    tree: ProjectTree, folder: Path, tmp_path: Path, user: User
) -> None:
    before = (folder / "second.amp").read_bytes()
    (tmp_path / "second.amp").write_bytes(b"another")
    user.chooses(tmp_path / "second.amp")
    tree._add()
    assert user.reads() == "second.amp is in the folder already."
    assert (folder / "second.amp").read_bytes() == before


def test_a_deleted_file_is_recovered(tree: ProjectTree, folder: Path) -> None:
    tree.tree.itemActivated.emit(row(tree, "deleted"), 0)
    assert tree._window.workspace.path == folder / "gone.amp"


def test_recent_projects_are_listed_without_the_open_one(
    tree: ProjectTree, tmp_path: Path, qtbot: QtBot
) -> None:
    other = tmp_path / "other project"
    Project.create(other, ProjectInfo("Other", "num"))
    tree._window.settings.keep_projects([*tree._window.settings.projects(), other])
    tree._content = None
    tree.refresh()
    qtbot.waitUntil(
        lambda: any(i.data(0, KEY)[0] == "project" for i in tree._by_key.values()), timeout=WAIT_MS
    )
    assert row(tree, "project").text(0) == "other project"


def test_the_menu_of_every_row_has_each_letter_once(tree: ProjectTree) -> None:
    for item in tree._by_key.values():
        assert doubled(a.text() for a in tree.menu_of(item).actions()) == {}


def test_a_folder_that_is_no_project_is_shown_all_the_same(open_window, path: Path, qtbot: QtBot) -> None:
    window = open_window(path)
    window.page.left.show_side("project")
    found = window.page.left.findChild(ProjectTree)
    qtbot.waitUntil(lambda: found.tree.topLevelItemCount() > 0, timeout=WAIT_MS)
    assert found.tree.topLevelItem(0).text(0) == "machine"
    assert row(found, "file", "mill.amp").text(0) == "mill"


def test_rows_whose_file_stays_as_it_is_are_not_written_again(tree: ProjectTree, qtbot: QtBot) -> None:
    """In a folder of a thousand files each change of the tab wrote 5,000 marks."""
    second = row(tree, "file", "second.amp")
    qtbot.waitUntil(lambda: bool(second.data(0, COUNTS)), timeout=WAIT_MS)
    changed: list[object] = []
    tree.tree.model().dataChanged.connect(lambda *given: changed.append(given))
    tree._mark_all()
    assert changed == []
    tree._page.workspace.edit("rapid", {("feedrate.rapid", "1"): Value(100.0, "mm/s")})
    assert changed != [], "the mill is not saved now"
