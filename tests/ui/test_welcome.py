"""The welcome page: families, examples that are copied, recent files with their machine and findings."""

import os
from collections.abc import Callable
from datetime import UTC, datetime
from pathlib import Path

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QFileDialog
from pytestqt.qtbot import QtBot

from amp_studio.files import content_of
from amp_studio.files.example_files import examples, examples_folder
from amp_studio.schema import Value, family_ids
from amp_studio.ui.base.time_words import in_words
from amp_studio.ui.dialogs.new_file_dialog import NewFileDialog
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.welcome.list import KEY, ROW, WelcomeList, WelcomeRow, inner, star_place
from amp_studio.ui.welcome.page import WelcomePage
from amp_studio.ui.window.settings import UserSettings

from .conftest import WAIT_MS, User, on_disk


def rows(view: WelcomeList) -> list[WelcomeRow]:
    """Return the rows that are shown."""
    return [view.item(n).data(ROW) for n in range(view.count()) if not view.item(n).isHidden()]


@pytest.fixture
def two(path: Path, tmp_path: Path, open_window: Callable[..., MainWindow]) -> Callable[[], WelcomePage]:
    """Return what opens a window with two recent files: the example mill, and one that cannot be read."""
    broken = tmp_path / "broken.amp"
    broken.write_text("nothing: [")

    def open_it() -> WelcomePage:
        UserSettings().keep_recent([broken, path])
        window = open_window()
        UserSettings().keep_recent([broken, path])
        window.welcome.show_recent(window.files.recent.paths())
        return window.welcome

    return open_it


def read_all(page: WelcomePage, qtbot: QtBot) -> None:
    """Wait until everything is known."""
    qtbot.waitUntil(lambda: page.has_facts and page._reading is None, timeout=WAIT_MS)
    displayed = [page.list.item(n).data(KEY) for n in range(page.list.count())]
    qtbot.waitUntil(lambda: all(page._summaries.of(path) is not None for path in displayed), timeout=WAIT_MS)


def test_every_family_is_there_with_what_it_is_for(open_window, qtbot: QtBot) -> None:
    page = open_window().welcome
    read_all(page, qtbot)
    found = {
        page.families.item(n).data(KEY): page.families.item(n).data(ROW) for n in range(page.families.count())
    }
    assert set(found) == set(family_ids())
    assert all(row.second and int(row.right) > 40 for row in found.values())
    assert len(rows(page.examples)) == len(examples()) == 8


def test_a_family_opens_the_dialog_for_a_new_file_of_it(open_window, qtbot: QtBot, monkeypatch) -> None:
    page = open_window().welcome
    read_all(page, qtbot)
    asked: list[str] = []
    monkeypatch.setattr(NewFileDialog, "exec", lambda d: asked.append(d.form.answer("family")) or 0)
    page.families.setCurrentRow(2)
    QTest.keyClick(page.families, Qt.Key.Key_Return)
    assert asked == [page.families.item(2).data(KEY)]


def test_an_example_is_copied_and_never_edited(open_window, qtbot: QtBot, tmp_path: Path, user: User) -> None:
    window = open_window()
    read_all(window.welcome, qtbot)
    item = window.welcome.examples.item(0)
    original = item.data(KEY).path
    before = original.read_bytes()
    user.chooses(tmp_path / "mine.amp")
    window.welcome.examples.itemActivated.emit(item)
    assert window.workspace.path == tmp_path / "mine.amp"
    assert (tmp_path / "mine.amp").read_bytes() == before, "comments too"
    window.edits.commit(("setup.in_position_tolerance", "X"), "77")
    assert window.save()
    assert original.read_bytes() == before


def test_the_copy_of_an_example_is_proposed_among_the_users_own_files(
    open_window, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    window = open_window()
    read_all(window.welcome, qtbot)
    item = window.welcome.examples.item(0)
    proposed = []
    monkeypatch.setattr(
        QFileDialog, "getSaveFileName", lambda *given, **_: (proposed.append(given[2]), ("", ""))[1]
    )
    window.files.open_example(item.data(KEY).path)
    assert examples_folder() not in Path(proposed[0]).parents
    assert Path(proposed[0]).name == item.data(KEY).path.name


def test_recent_files_show_machine_and_findings_once_the_page_is_at_rest(two, qtbot: QtBot) -> None:
    page = two()
    assert [row.second for row in rows(page.list)] == ["…", "…"]
    read_all(page, qtbot)
    broken, mill = rows(page.list)
    assert (mill.second, mill.status, mill.counts) == ("MILL_1394, 9/PC, Mill, X Y Z B S", "no findings", {})
    assert broken.status == "cannot be read"
    assert mill.right.startswith("today ")


def test_findings_of_a_file_that_has_changed_are_counted_again(open_window, qtbot: QtBot, path: Path) -> None:
    window = open_window()
    window.settings.keep_recent([path])
    window.welcome.show_recent(window.files.recent.paths())
    read_all(window.welcome, qtbot)
    file = on_disk(path)
    file.set(("servo.excess_error", "1"), Value(0.01, "mm"))
    path.write_bytes(content_of(file))
    os.utime(path, (1, 1))
    window.welcome.show_recent(window.files.recent.paths())
    assert rows(window.welcome.list)[0].second == "…"
    window.welcome._pause.start(0)
    qtbot.waitUntil(lambda: bool(rows(window.welcome.list)[0].counts), timeout=WAIT_MS)
    assert rows(window.welcome.list)[0].counts["error"] >= 1


def test_a_file_is_pinned_by_its_star_and_taken_off_the_list_by_delete(two, path: Path, qtbot: QtBot) -> None:
    page = two()
    item = page.list.item(1)
    where = star_place(inner(page.list.visualItemRect(item)), item.data(ROW)).center()
    QTest.mouseClick(page.list.viewport(), Qt.MouseButton.LeftButton, pos=QPoint(where))
    assert page._window.workspace is None, "the star opens nothing"
    assert [row.title for row in rows(page.list)] == ["mill.amp", "broken.amp"]
    assert rows(page.list)[0].star
    page.list.setCurrentRow(1)
    page.list.setFocus()
    QTest.keyClick(page.list, Qt.Key.Key_Delete)
    assert page._files.recent.paths() == [path]
    QTest.keyClick(page.list, Qt.Key.Key_B, Qt.KeyboardModifier.ControlModifier)
    assert page._window.settings.pinned() == []


def test_a_pinned_file_stays_when_many_others_were_opened(two, path: Path, tmp_path: Path) -> None:
    page = two()
    page._files.recent.pin(path)
    others = [tmp_path / f"{n}.amp" for n in range(40)]
    for other in others:
        other.touch()
        page._files.recent.remember(other)
    assert page._files.recent.paths()[0] == path
    assert len(page._files.recent.paths()) == 25


def test_the_filter_finds_by_name_folder_and_machine(two, qtbot: QtBot) -> None:
    page = two()
    read_all(page, qtbot)
    page.filter.setText("x y z b")
    assert [row.title for row in rows(page.list)] == ["mill.amp"]
    page.filter.setText("nothing like it")
    assert rows(page.list) == []
    assert "'nothing like it'" in page.none.text()
    page.filter.clear()
    assert len(rows(page.list)) == 2
    assert not page.none.isVisible()


def test_enter_opens_and_a_click_opens(two, path: Path) -> None:
    page = two()
    page.list.setCurrentRow(1)
    QTest.keyClick(page.list, Qt.Key.Key_Return)
    assert page._window.workspace.path == path
    page._files.close()
    row = next(n for n in range(page.list.count()) if page.list.item(n).data(KEY) == path)
    QTest.mouseClick(
        page.list.viewport(),
        Qt.MouseButton.LeftButton,
        pos=page.list.visualItemRect(page.list.item(row)).topLeft() + QPoint(30, 10),
    )
    assert page._window.workspace.path == path


def test_what_was_open_the_last_time_is_offered(open_window, path: Path) -> None:
    first = open_window()
    first.settings.keep_session([path])
    window = MainWindow()
    window.show()
    try:
        page = window.welcome
        assert page.message.isVisible()
        assert "mill" in page.message.text.text()
        page.message.buttons[0].click()
        assert window.workspace.path == path
    finally:
        window.close()
        window.deleteLater()


def test_with_nothing_there_yet_it_shows_where_to_begin(open_window) -> None:
    page = open_window().welcome
    assert "No file has been opened yet" in page.none.text()
    assert page.none.isVisible()
    assert not page.message.isVisible()


def test_it_is_never_empty_and_no_row_moves_once_more_is_known(open_window, qtbot: QtBot) -> None:
    """New file and Examples were heads without a row until every family was read: seconds under load."""
    page = open_window().welcome
    assert not page.has_facts
    assert [page.families.item(n).data(KEY) for n in range(page.families.count())] == list(family_ids())
    assert page.examples.count() == len(examples())
    before = [page.families.geometry(), page.examples.geometry()]
    read_all(page, qtbot)
    assert [page.families.geometry(), page.examples.geometry()] == before
    assert page.families.item(0).data(ROW).second != "…"


@pytest.mark.parametrize(
    ("moment", "message"),
    [
        (datetime(2026, 3, 9, 14, 35, tzinfo=UTC), "today 14:35"),
        (datetime(2026, 3, 8, 0, 5, tzinfo=UTC), "yesterday 00:05"),
        (datetime(2026, 3, 7, 9, 12, tzinfo=UTC), "7 Mar 09:12"),
        (datetime(2024, 12, 31, 9, 12, tzinfo=UTC), "31 Dec 2024"),
    ],
)
def test_times_are_shown_as_a_user_shows_them(qapp, moment: datetime, message: str) -> None:
    assert in_words(moment, datetime(2026, 3, 9, 15, 0, tzinfo=UTC)) == message


def test_tab_goes_through_the_page_in_reading_order(two, qtbot: QtBot) -> None:
    page = two()
    read_all(page, qtbot)
    page.families.setFocus()
    passed = []
    for _ in range(6):
        passed.append(page.window().focusWidget())
        QTest.keyClick(page.window().focusWidget(), Qt.Key.Key_Tab)
    assert passed[0] is page.families
    assert [w for w in passed if w in (page.examples, page.filter, page.list)] == [
        page.examples,
        page.filter,
        page.list,
    ]


def test_a_window_that_begins_with_a_file_makes_the_page_when_that_is_closed(window: MainWindow) -> None:
    assert "welcome" not in vars(window)
    window.close_page(window.page)
    assert window.centre.currentWidget() is window.welcome
    assert window.welcome.isVisible()
