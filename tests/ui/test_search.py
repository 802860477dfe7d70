"""Groups and search: by number, by name, by several words."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from amp_studio.files import new_file
from amp_studio.schema import Value
from amp_studio.ui.group_list import GroupList
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.workspace import Workspace

from .conftest import WAIT_MS


@pytest.fixture
def groups(workspace: Workspace) -> GroupList:
    """Return the groups of a workspace, without a window."""
    return GroupList(workspace)


def ids(groups: GroupList, text: str) -> list[str]:
    """Return what a search finds."""
    return [parameter.id for parameter in groups.found(text.casefold().split())]


@pytest.mark.parametrize("number", ["1300", "2300", "8300"])
def test_a_number_of_any_axis_finds_its_parameter(groups: GroupList, number: str) -> None:
    assert ids(groups, number)[0] == "home.calibration"


def test_a_shared_number_finds_both_its_parameters(groups: GroupList) -> None:
    """1013 is a gear on an axis and another one on a spindle."""
    assert {"servo.velocity_gear_teeth", "servo.spindle_motor_teeth"} <= set(ids(groups, "1013"))


def test_a_name_comes_before_what_only_speaks_of_it(groups: GroupList) -> None:
    found = ids(groups, "gain break")
    assert found[:2] == ["servo.gain_break_point", "servo.gain_break_ratio"]
    assert len(found) > 2


def test_every_word_must_be_found_in_any_order_and_case(groups: GroupList) -> None:
    assert ids(groups, "ERROR excess")[0] == "servo.excess_error"
    assert ids(groups, "excess marzipan") == []


def test_an_id_and_a_choice_are_found(groups: GroupList) -> None:
    assert ids(groups, "servo.excess_error") == ["servo.excess_error"]
    assert "servo.hardware_type" in ids(groups, "sercos interface")


def test_searching_shows_what_is_found_and_clearing_the_group_again(window: MainWindow) -> None:
    window.groups.search.setText("excess error")
    assert window.page.list_title.text().startswith("<b>Search: excess error</b>")
    assert window.table.rows[0].parameter.id == "servo.excess_error"

    window.groups.search.setText("marzipan")
    assert window.table.rowCount() == 0
    assert "no parameters" in window.page.list_title.text()
    assert not window.detail.page.toPlainText()
    assert not window.groups.tree.selectedItems()

    window.groups.search.clear()
    assert [item.text(0) for item in window.groups.tree.selectedItems()] == ["Axis Configuration"]
    assert window.page.list_title.text().startswith("<b>Axis Configuration</b>")


def test_enter_in_the_search_goes_to_the_table(window: MainWindow, qtbot) -> None:
    window.show_panel("Groups")
    window.groups.focus_search()
    qtbot.waitUntil(window.groups.search.hasFocus, timeout=WAIT_MS)
    QTest.keyClicks(window.groups.search, "excess error")
    QTest.keyClick(window.groups.search, Qt.Key.Key_Return)
    assert window.table_view.hasFocus()
    assert window.selected() == ("servo.excess_error", "1")


def test_numbers_follow_the_machine_type(workspace: Workspace) -> None:
    """Mill Type and Lathe Type exist on one machine type each."""
    groups = GroupList(workspace)
    before = {p: head for p, (head, _) in groups._texts.items()}
    workspace.edit("lathe", {("control.type", ""): Value("lathe")})
    schema = new_file("9pc", "lathe").schema
    for parameter in schema.parameters.values():
        numbers = schema.on("lathe").numbers(parameter).values()
        assert all(n.casefold() in groups._texts[parameter.id][0] for n in numbers)
    assert len(before) == len(groups._texts)


def test_a_group_counts_its_findings_once(workspace: Workspace, groups: GroupList) -> None:
    """A finding about two parameters of one group is one finding."""
    workspace.edit("force", {("servo.excess_error", "1"): Value(1e9, "mm")}, force="on a day")
    schema = workspace.file.schema
    servo = next(i for i in groups._items if i.text(0) == "Servo")
    keys = {g.key for g in schema.groups if g.name == "Servo Parameters"}
    found = [f for f in workspace.findings if f.severity == "error"]
    count = sum(any(schema.group_of[a[0]].key in keys for a in f.causes) for f in found)
    assert servo.text(1) == str(count)
    assert count >= 1


def test_what_was_changed_from_the_default_is_a_list_that_follows(
    window: MainWindow, workspace: Workspace, qtbot
) -> None:
    window.groups.tree.setCurrentItem(window.groups._items[1])
    rows = {row.parameter.id for row in window.table.rows}
    changed = next(a for a in workspace.file.values if a[0] in rows)
    all_of_it = [a for a in workspace.file.values if a[0] == changed[0]]

    workspace.edit("default", {a: workspace.file.default(a) for a in all_of_it})

    qtbot.waitUntil(lambda: changed[0] not in {row.parameter.id for row in window.table.rows}, timeout=5000)
