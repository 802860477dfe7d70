"""Several files of several families in one window: tabs, two sides, drops, and the session that comes
back.
"""

from pathlib import Path

import pytest
from PySide6.QtCore import QEvent, QMimeData, QPointF, Qt, QUrl
from PySide6.QtGui import QDropEvent
from PySide6.QtWidgets import QApplication, QDockWidget
from pytestqt.qtbot import QtBot

from amp_studio.files import Document, content_of, new_file
from amp_studio.schema import Value
from amp_studio.ui.dialogs.calculator_dialog import CalculatorDialog
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.table.quick_edit import QuickEdit

from .conftest import WAIT_MS, User, action, on_disk

EXCESS = ("servo.excess_error", "1")


@pytest.fixture
def other(path: Path) -> Path:
    """Return a second file of the same family."""
    other = path.with_name("other.amp")
    other.write_bytes(path.read_bytes())
    return other


@pytest.fixture
def num(path: Path) -> Path:
    """Return a file of another family."""
    num = path.with_name("lathe.amp")
    num.write_bytes(content_of(new_file("num", "cnc", [], "lathe")))
    return num


def names(window: MainWindow) -> list[str]:
    """Return the names on the tabs."""
    return [page.title for page in window.tabs.pages()]


def test_a_second_file_opens_in_a_tab_and_the_first_keeps_its_work(window: MainWindow, num: Path) -> None:
    window.edits.commit(EXCESS, "3 mm")
    window.files.open_path(num)
    assert names(window) == ["mill.amp*", "lathe.amp"]
    assert window.workspace.file.schema.family.family == "num"

    window.tabs.turn(1)

    assert window.workspace.file.get(EXCESS) == Value(3.0, "mm")
    window.menus["edit.undo"].trigger()
    assert names(window) == ["mill.amp", "lathe.amp"]


def test_the_docks_show_the_file_in_front(window: MainWindow, num: Path, qtbot: QtBot) -> None:
    first = window.page
    window.files.open_path(num)
    second = window.page
    qtbot.waitUntil(second.left.isVisible, timeout=WAIT_MS)
    assert not first.left.isVisible()
    window.tabs.bring(first)
    assert first.left.isVisible()
    assert not second.left.isVisible()


def test_the_table_keeps_its_width_when_a_second_file_opens(
    window: MainWindow, other: Path, qtbot: QtBot
) -> None:
    QApplication.processEvents()
    before = window.table_view.width()
    window.files.open_path(other)
    QApplication.processEvents()
    assert window.table_view.width() == before


def test_a_file_that_is_open_comes_to_the_front_by_any_of_its_names(
    window: MainWindow, path: Path, other: Path
) -> None:
    window.edits.commit(EXCESS, "3 mm")
    link = path.with_name("link.amp")
    link.symlink_to(path)
    window.files.open_path(other)
    window.files.open_path(link)
    assert window.workspace.path == path
    assert names(window) == ["mill.amp*", "other.amp"]


def test_a_tool_that_was_opened_on_a_file_writes_into_that_file(
    window: MainWindow, path: Path, other: Path
) -> None:
    window.go_to(EXCESS)
    window.edits.quick_edit()
    window.edits.calculator()
    first = window.workspace
    window.files.open_path(other)

    for tool in (window.findChild(QuickEdit), window.findChild(CalculatorDialog)):
        tool._commit(EXCESS, "5 mm")
        assert first.file.get(EXCESS) == Value(5.0, "mm")
        first.undo_stack.undo()
    assert window.workspace.file.get(EXCESS) == Value(11.0, "mm")


def test_a_file_that_is_saved_as_one_that_is_open_is_refused(
    window: MainWindow, path: Path, other: Path, user: User
) -> None:
    before = other.read_bytes()
    window.files.open_path(other)
    window.files.open_path(path)
    user.chooses(other)
    user.answers("Replace")

    action(window, "Save As").trigger()

    assert "is open in a tab" in user.reads()
    assert other.read_bytes() == before


def test_closing_the_window_asks_about_each_file_with_unsaved_work(
    window: MainWindow, path: Path, other: Path, user: User
) -> None:
    window.edits.commit(EXCESS, "3 mm")
    window.files.open_path(other)
    window.edits.commit(EXCESS, "4 mm")
    user.answers("Save", "Cancel")

    assert not window.close()

    assert on_disk(path).get(EXCESS) == Value(3.0, "mm")
    assert on_disk(other).get(EXCESS) == Value(11.0, "mm")
    assert len(window.tabs.pages()) == 2


def test_a_change_on_disk_is_shown_on_the_page_of_its_file(
    window: MainWindow, path: Path, other: Path, qtbot: QtBot
) -> None:
    first = window.page
    window.files.open_path(other)
    path.write_bytes(path.read_bytes() + b"# touched\n")
    qtbot.waitUntil(lambda: not first.bar.isHidden(), timeout=WAIT_MS)
    assert "mill.amp" in first.bar.text.text()
    assert window.page.bar.isHidden()


def test_two_files_are_seen_beside_each_other_and_the_panels_follow_the_focus(
    window: MainWindow, num: Path, qtbot: QtBot
) -> None:
    first = window.page
    window.files.open_path(num)
    second = window.page
    action(window, "Show File Beside").trigger()
    assert first.table_view.isVisible()
    assert second.table_view.isVisible()

    first.table_view.setFocus()
    assert window.page is first
    assert first.detail.isVisible()
    second.table_view.setFocus()
    assert window.page is second

    window.files.close()
    assert window.page is first
    assert not window.tabs.sides[1].isVisible()


def test_the_left_side_is_never_empty(window: MainWindow, num: Path) -> None:
    first = window.page
    window.files.open_path(num)
    action(window, "Show File Beside").trigger()
    window.close_page(first)
    assert [side.count() for side in window.tabs.sides] == [1, 0]
    assert window.workspace.file.schema.family.family == "num"


def test_files_are_dropped_into_the_window(open_window, path: Path, other: Path) -> None:
    window: MainWindow = open_window()
    backup = other.rename(path.with_name("other.amp.bak"))
    dropped = QMimeData()
    dropped.setUrls([QUrl.fromLocalFile(str(path)), QUrl.fromLocalFile(str(backup))])
    event = QDropEvent(
        QPointF(50, 50),
        Qt.DropAction.CopyAction,
        dropped,
        Qt.MouseButton.LeftButton,
        Qt.KeyboardModifier.NoModifier,
        QEvent.Type.Drop,
    )
    window.dropEvent(event)
    assert names(window) == ["mill.amp", "other.amp.bak"]


def test_the_text_of_a_control_is_imported_whatever_it_is_called(
    open_window, user: User, tmp_path: Path
) -> None:
    window: MainWindow = open_window()
    for name in ("backup.nc", "backup"):
        listing, made = tmp_path / name, tmp_path / f"{name}.amp"
        listing.write_text("".join(f"${n}=100\n" for n in (100, 101, 102, 110, 111, 112)), "utf-8")
        user.chooses(made)
        user.types("grblHAL")
        window.open_first(listing)
        assert window.workspace.path == made


def test_texts_of_controls_are_imported_where_they_are_dropped(
    open_window, user: User, tmp_path: Path
) -> None:
    texts = {
        "backup.txt": "".join(f"${n}=100\n" for n in (100, 101, 102, 110, 111, 112)),
        "mill.ini": "[EMC]\nVERSION = 1.1\n[JOINT_0]\nMAX_VELOCITY = 5\n[TRAJ]\nCOORDINATES = X\n",
        "values.csv": "id,instance,value,unit\nservo.jog_slow,,100,mm/min\nmisc.backup_blocks,,20,\n",
        "start.acr": 'PROG0\nATTACH SLAVE0 AXIS0 "X"\nPPU X1000 Y1000\nACC 100\nVEL 50\n',
    }
    dropped = QMimeData()
    dropped.setUrls([QUrl.fromLocalFile(str(tmp_path / name)) for name in texts])
    for name, text in texts.items():
        (tmp_path / name).write_text(text, "utf-8")
        user.chooses(tmp_path / f"{name}.amp")
    user.types("grblHAL")
    window: MainWindow = open_window()
    at, keys = QPointF(50, 50), Qt.KeyboardModifier.NoModifier
    window.dropEvent(QDropEvent(at, Qt.DropAction.CopyAction, dropped, Qt.MouseButton.LeftButton, keys))
    assert names(window) == [f"{name}.amp" for name in texts]
    assert [page.workspace.file.schema.family.family for page in window.tabs.pages()] == [
        "grblhal",
        "linuxcnc",
        "num",
        "acromill",
    ]


def test_the_files_of_the_last_time_are_opened_again(open_window, path: Path, other: Path, num: Path) -> None:
    window: MainWindow = open_window(path)
    window.files.open_path(other)
    window.files.open_path(num)
    window.files.open_path(path)
    window.close()
    other.unlink()

    again = MainWindow()
    again.show()
    again.files.restore_session()

    assert names(again) == ["lathe.amp", "mill.amp"]
    assert again.workspace.path == path
    assert "Not opened again: other.amp" in again.statusBar().currentMessage()
    again.close()
    again.deleteLater()


def test_a_file_of_the_last_time_that_is_in_use_is_looked_at(open_window, path: Path) -> None:
    window: MainWindow = open_window(path)
    window.close()
    with Document.open(path):
        again = MainWindow()
        again.show()
        again.files.restore_session()
        assert not again.workspace.may_edit
        again.close()
        again.deleteLater()


def test_the_layout_can_be_reset(window: MainWindow, qtbot: QtBot) -> None:
    for name in ("Groups", "Findings"):
        window.findChild(QDockWidget, name).close()
    action(window, "Reset Layout").trigger()
    for name, width in (("Groups", 212), ("Parameter", 240)):
        dock = window.findChild(QDockWidget, name)
        qtbot.waitUntil(dock.isVisible, timeout=WAIT_MS)
        QApplication.processEvents()
        assert abs(dock.width() - width) < 30, name


def test_a_kept_layout_that_leaves_no_room_for_the_table_is_not_used(open_window, path: Path) -> None:
    window: MainWindow = open_window(path)
    window.resizeDocks(
        [window.findChild(QDockWidget, name) for name in ("Groups", "Parameter")],
        [500, 420],
        Qt.Orientation.Horizontal,
    )
    QApplication.processEvents()
    window.close()

    again: MainWindow = MainWindow()
    again.resize(1200, 640)
    again.show()
    again.files.open_path(path)
    QApplication.processEvents()

    assert again.table_view.width() >= 300
    again.close()
    again.deleteLater()


def test_five_families_on_two_sides_are_there_again_after_a_restart(
    open_window, checkout: Path, tmp_path: Path, qtbot: QtBot
) -> None:
    window: MainWindow = open_window()
    window.resize(1440, 900)
    examples = ("mill-1394", "num-1060-mill", "syntec-mill", "acromill-router", "57c422b-label-press")
    paths = []
    for name in examples:
        (source,) = (checkout / "examples" / name).glob("*.amp")
        paths.append(tmp_path / source.name)
        paths[-1].write_bytes(source.read_bytes())
        window.files.open_path(paths[-1])
    for path in paths[1:3]:
        window.tabs.move_across(window.page_of(path))
    window.tabs.bring(window.page_of(paths[3]))
    window.close()

    again = MainWindow()
    again.show()
    again.files.restore_session()
    QApplication.processEvents()
    assert [p.workspace.path for p in again.tabs.pages_of(1)] == paths[1:3]
    assert {p.workspace.path for p in again.tabs.pages_of(0)} == {paths[0], *paths[3:]}
    assert again.workspace.path == paths[3], "the one in front"
    assert [side.isVisible() for side in again.tabs.sides] == [True, True]
    assert min(side.width() for side in again.tabs.sides) >= 300
    assert all(p.table_view.width() >= 300 for p in again.tabs.pages() if p.isVisible())
    again.close()
    again.deleteLater()


def test_the_name_on_a_tab_is_read_however_many_there_are(
    window: MainWindow, path: Path, tmp_path: Path
) -> None:
    long = tmp_path / "a_machine_with_a_name_that_is_longer_than_a_tab.amp"
    long.write_bytes(path.read_bytes())
    for n in range(4):
        copy = tmp_path / f"machine_{n}.amp"
        copy.write_bytes(path.read_bytes())
        window.files.open_path(copy)
    window.files.open_path(long)
    bar = window.tabs.sides[0].tabBar()
    texts = [bar.tabText(n) for n in range(bar.count())]
    assert texts[:2] == ["mill", "machine_0"]
    assert texts[-1] == "a_machine_with…nger_than_a_tab"[:15] + "onger_than_a_tab"[-14:]
    for n in range(bar.count()):
        assert bar.tabRect(n).width() >= bar.fontMetrics().horizontalAdvance(bar.tabText(n))
