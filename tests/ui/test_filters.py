"""Chips above the table: which rows they leave, that counts are right after every edit,
and that nothing moves meanwhile.
"""

import hashlib
from pathlib import Path

import pytest

from amp_studio.schema import Address, Value
from amp_studio.transfer.client.record import add_exchange, changes_of, exchange_now
from amp_studio.transfer.image import encode_image
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.table.filter_bar import FilterBar

from .conftest import WAIT_MS, action

EXCESS: Address = ("servo.excess_error", "1")
BREAK: Address = ("servo.gain_break_point", "1")


@pytest.fixture
def filters(window: MainWindow) -> FilterBar:
    """Return the filters over the position loop."""
    window.page.left.show_side("groups")
    window.groups.choose_group_of("servo.excess_error")
    return window.page.filters


def ids(window: MainWindow) -> set[str]:
    return {row.parameter.id for row in window.table.rows if not row.section}


def number(filters: FilterBar, mark: str) -> int:
    return int(filters.chips[mark].text().rpartition(" ")[2])


def test_a_chip_leaves_the_rows_that_have_the_mark_and_all_brings_the_others_back(
    window: MainWindow, filters: FilterBar
) -> None:
    every = ids(window)
    filters.chips["axes-differ"].click()
    assert ids(window) < every
    assert {"servo.position_port", "servo.position_loop_type"} <= ids(window)
    assert (filters.all.isChecked(), filters.chips["axes-differ"].isChecked()) == (False, True)
    filters.all.click()
    assert ids(window) == every


def test_filters_combine_with_each_other_and_with_the_group(
    window: MainWindow, workspace: Workspace, filters: FilterBar
) -> None:
    workspace.edit("edit", {BREAK: Value(4.0, "mm")})
    filters.choose("changed", True)
    assert {"servo.excess_error", "servo.gain_break_point"} < ids(window)
    filters.choose("unsaved", True)
    assert ids(window) == {"servo.gain_break_point"}
    window.groups.choose_group_of("home.calibration")
    assert filters.active == {"changed", "unsaved"}
    assert ids(window) == set()
    assert window.page.list_title.text().endswith(", filtered (Ctrl+0 shows all)")


def test_counts_follow_every_edit_undo_and_save(
    window: MainWindow, workspace: Workspace, filters: FilterBar, qtbot
) -> None:
    qtbot.waitUntil(lambda: not filters._is_stale, timeout=WAIT_MS)
    before = {mark: number(filters, mark) for mark in filters.chips}
    workspace.edit("edit", {EXCESS: None, BREAK: Value(12.0, "mm")})
    qtbot.waitUntil(lambda: not filters._is_stale, timeout=WAIT_MS)
    assert number(filters, "not-set") == before["not-set"] + 1
    assert number(filters, "changed") == before["changed"] - 1
    assert number(filters, "findings") > before["findings"]
    workspace.undo_stack.undo()
    qtbot.waitUntil(lambda: not filters._is_stale, timeout=WAIT_MS)
    assert {mark: number(filters, mark) for mark in filters.chips} == before


def test_a_row_stays_while_it_is_worked_on_and_goes_when_the_filter_is_chosen_again(
    window: MainWindow, workspace: Workspace, filters: FilterBar
) -> None:
    workspace.edit("clear", {EXCESS: None})
    filters.choose("not-set", True)
    assert ids(window) == {"servo.excess_error"}
    workspace.edit("set", {EXCESS: Value(11.0, "mm")})
    assert ids(window) == {"servo.excess_error"}
    filters.choose("not-set", False)
    filters.choose("not-set", True)
    assert ids(window) == set()


@pytest.mark.own_window
def test_what_is_not_saved_and_what_was_edited_lately_is_in_the_funnel(
    window: MainWindow, workspace: Workspace, filters: FilterBar
) -> None:
    workspace.edit("edit", {BREAK: Value(4.0, "mm")})
    action(window, "Not saved").trigger()
    assert (ids(window), filters.funnel.text()) == ({"servo.gain_break_point"}, "Not saved")
    workspace.save()
    action(window, "All Rows").trigger()
    action(window, "Not saved").trigger()
    assert ids(window) == set()
    action(window, "Not saved").trigger()
    action(window, "Recently edited").trigger()
    assert ids(window) == {"servo.gain_break_point"}


def test_bookmarks_are_a_persons_and_stay(window: MainWindow, path: Path, filters: FilterBar) -> None:
    window.go_to(EXCESS)
    action(window, "Bookmark").trigger()
    action(window, "Bookmarked").trigger()
    assert ids(window) == {"servo.excess_error"}
    assert window.settings.bookmarks(path) == {"servo.excess_error"}
    assert path.read_bytes().count(b"bookmark") == 0
    window.go_to(EXCESS)
    action(window, "Bookmark").trigger()
    assert window.settings.bookmarks(path) == set()


def test_without_a_download_the_page_shows_it_and_shows_everything(
    window: MainWindow, filters: FilterBar
) -> None:
    every = ids(window)
    action(window, "Changed since download").trigger()
    assert "No download of mill.amp is recorded" in window.page.bar.text.text()
    assert (ids(window), filters.active) == (every, set())


def test_what_was_changed_since_the_download_is_listed(
    window: MainWindow, workspace: Workspace, filters: FilterBar
) -> None:
    image = encode_image(workspace.file)
    add_exchange(
        workspace.path,
        exchange_now(
            "download",
            workspace.path,
            "9pc",
            "tcp://cnc:9600",
            before="",
            state="new",
            kept="",
            after=hashlib.sha256(image).hexdigest(),
            changes=changes_of(b"", image),
        ),
    )
    action(window, "Changed since download").trigger()
    assert ids(window) == set()
    workspace.edit("edit", {BREAK: Value(4.0, "mm")})
    assert ids(window) == {"servo.gain_break_point"}


def test_going_to_a_value_that_a_filter_hides_takes_the_filter_away(
    window: MainWindow, filters: FilterBar
) -> None:
    filters.choose("not-set", True)
    window.go_to(EXCESS)
    assert window.selected() == EXCESS
    assert filters.active == set()


def test_a_narrow_window_has_all_filters_in_the_funnel(window: MainWindow, filters: FilterBar) -> None:
    window.page.filters.resize(400, 30)
    assert filters.all.isHidden()
    assert filters.funnel.text() == "All"
    assert filters.actions_of["changed"].isVisible()
    filters.choose("changed", True)
    assert filters.funnel.text() == "Changed"
