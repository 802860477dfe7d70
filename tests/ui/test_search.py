"""Groups, and the rows of a search in the table."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from amp_studio.schema import Value
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.page.group_list import GroupList

from .conftest import WAIT_MS


@pytest.fixture
def groups(workspace: Workspace) -> GroupList:
    """Return the groups of a workspace, without a window."""
    return GroupList(workspace)


def test_all_that_is_found_can_be_shown_in_the_table_and_a_group_again(window: MainWindow, qtbot) -> None:
    window.finder.box.begin("")
    qtbot.waitUntil(lambda: window.finder._finder() is not None, timeout=WAIT_MS)
    window.page.left.show_side("groups")
    window.groups.tree.setCurrentItem(window.groups._items[0])
    box = window.finder.box
    box.begin("gain break")
    assert box.model.rows[-1].text.startswith("Show ")
    QTest.keyClick(box, Qt.Key.Key_Up)
    QTest.keyClick(box, Qt.Key.Key_Return)
    assert window.page.list_title.text().startswith("<b>Found: gain break</b>")
    assert [row.parameter.id for row in window.table.rows[:2]] == [
        "servo.gain_break_point",
        "servo.gain_break_ratio",
    ]
    assert not window.groups.tree.selectedItems()
    assert window.focusWidget() is window.table_view

    window.page.show_found("<u>gain", ["servo.initial_gain"])
    assert window.page.list_title.text().startswith("<b>Found: &lt;u&gt;gain</b>")

    window.groups.choose_group_of("servo.excess_error")
    assert window.page.list_title.text().startswith("<b>Position Loop")
    assert len(window.groups.tree.selectedItems()) == 1


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
