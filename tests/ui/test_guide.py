"""Commissioning in the window: steps beside the table, the next value that is not set,
findings that wait for their step.
"""

from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QMenu, QTreeWidgetItem
from pytestqt.qtbot import QtBot

from amp_studio.files import content_of, new_file
from amp_studio.guide import SetupStep
from amp_studio.schema import Value
from amp_studio.ui.forms.place_tree import COUNTS, KEY, PICTURE, RIGHT
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.page.steps_panel import StepsPanel

from .conftest import WAIT_MS, action


@pytest.fixture(scope="module")
def begun() -> bytes:
    """Return the content of a new mill of three axes that have servos."""
    file = new_file("9pc", "mill", ["X", "Y", "Z"])
    for axis in "123":
        file.set(("servo.hardware_type", axis), Value("sercos"))
        file.set(("servo.loop_type", axis), Value("digital"))
    return content_of(file)


@pytest.fixture
def fresh(window_with: Callable[[bytes], MainWindow], begun: bytes) -> MainWindow:
    """Return a window with that new mill."""
    return window_with(begun)


def item(steps: StepsPanel, step_id: str) -> QTreeWidgetItem:
    """Return the place of a step."""
    found = [steps.tree.topLevelItem(n) for n in range(steps.tree.topLevelItemCount())]
    return next(i for i in found if isinstance(i.data(0, KEY), SetupStep) and i.data(0, KEY).id == step_id)


def listed(window: MainWindow) -> set[object]:
    """Return which findings the panel lists."""
    return {f.key for group in window.findings.model.groups for f in group.findings}


def test_a_new_file_opens_at_its_steps_and_a_complete_one_at_its_groups(
    fresh: MainWindow, path: Path
) -> None:
    assert fresh.page.left.side == "steps"
    assert "Step 2 › Axis names and rollover" in fresh.page.list_title.text()
    fresh.open_first(path)
    assert fresh.page.left.side == "groups"


def test_the_bar_and_the_steps_show_how_far_the_file_is(fresh: MainWindow) -> None:
    steps = fresh.page.left.steps
    assert steps.steps_done.text() == "1 of 22 steps"
    total = fresh.workspace.progress.total
    assert steps.values_set.text() == f"3 of {total} set"
    assert item(steps, "control").data(0, PICTURE)[0] == "check-circle-fill"
    assert item(steps, "axis").data(0, PICTURE)[0] == "circle"
    assert item(steps, "axis").data(0, RIGHT) == "3"
    assert "3 values not set" in item(steps, "axis").data(0, Qt.ItemDataRole.AccessibleTextRole)


def test_the_open_values_are_under_the_present_step_with_their_axes(fresh: MainWindow) -> None:
    here = item(fresh.page.left.steps, "axis")
    assert here.isExpanded()
    assert [(here.child(n).text(0), here.child(n).data(0, RIGHT)) for n in range(here.childCount())] == [
        ("185 Axis Integrand Name", "X Y Z")
    ]
    fresh.page.left.steps.tree.setCurrentItem(here.child(0))
    assert fresh.selected() == ("axis.integrand_name", "1")


def test_a_key_goes_from_one_open_value_to_the_next_and_names_what_it_passes(fresh: MainWindow) -> None:
    fresh.go_to(("control.type", ""))
    seen = []
    for _ in range(4):
        action(fresh, "Next Not Set").trigger()
        seen.append(fresh.selected())
    assert seen == [*(("axis.integrand_name", axis) for axis in "123"), ("home.g28_direction", "1")]
    assert fresh.table_view.hasFocus()
    assert "not yet homed starts to look for its home switch" in fresh.detail.page.toPlainText()
    last_zone = fresh.workspace.progress.steps[3].open[-1]
    fresh.go_to(last_zone)
    action(fresh, "Next Not Set").trigger()
    assert fresh.selected()[0] == "jog.speed_lowest"
    assert (
        fresh.statusBar().currentMessage()
        == "All at their defaults, check them too: SERCOS ring and servos, Position loop, Velocity loop,"
        " Motors and amplifiers"
    )


def test_an_edit_is_followed_and_taken_back(fresh: MainWindow, qtbot: QtBot) -> None:
    steps = fresh.page.left.steps
    wanted = {("axis.integrand_name", axis): Value(letter) for axis, letter in zip("123", "ijk", strict=True)}
    fresh.workspace.edit("names", wanted)
    qtbot.waitUntil(lambda: item(steps, "axis").data(0, PICTURE)[0] == "check-circle-fill", timeout=WAIT_MS)
    assert item(steps, "axis").data(0, RIGHT) == ""
    fresh.menus["edit.undo"].trigger()
    qtbot.waitUntil(lambda: item(steps, "axis").data(0, RIGHT) == "3", timeout=WAIT_MS)


def test_findings_of_later_steps_wait_until_they_are_asked_for(fresh: MainWindow, qtbot: QtBot) -> None:
    workspace, steps = fresh.workspace, fresh.page.left.steps
    later = len(workspace.progress.deferred)
    assert later > 20
    assert steps.later.text() == f"{later} later findings held back"
    assert listed(fresh) == {f.key for f in workspace.listed if f.rule != "schema.unset"}
    assert len(workspace.listed) == len(workspace.findings) - later
    assert workspace.count("error") == 0
    steps.show_later.click()
    assert listed(fresh) == {f.key for f in workspace.findings if f.rule != "schema.unset"}
    assert workspace.count("error") > 10
    qtbot.waitUntil(lambda: steps.show_later.text() == "Hide", timeout=WAIT_MS)
    assert action(fresh, "Show Later Findings").isChecked()
    action(fresh, "Show Later Findings").trigger()
    assert workspace.count("error") == 0


def test_the_findings_of_a_step_come_when_it_is_reached(fresh: MainWindow, qtbot: QtBot) -> None:
    steps = fresh.page.left.steps
    while fresh.workspace.progress.current.step.id in ("axis", "home", "zone"):
        address = fresh.workspace.progress.current.open[0]
        parameter = fresh.workspace.file.schema.parameters[address[0]]
        first = parameter.choices[0].key if parameter.choices else ""
        text = {"integer": "0", "real": str(-len(fresh.workspace.validator.not_set))}.get(
            parameter.type, first
        )
        value = fresh.workspace.read(address, text)
        fresh.workspace.edit("one", {address: value}, force="a test")
        if fresh.workspace.progress.current.open == ():
            break
    fresh.page.left.steps.show_progress()
    displayed = [
        severity for severity, _ in item(steps, fresh.workspace.progress.current.step.id).data(0, COUNTS)
    ]
    assert "error" in displayed


def test_a_step_is_ticked_and_the_tick_is_undone_and_saved(fresh: MainWindow) -> None:
    fresh.go_to(("dual.group", "1"))
    action(fresh, "Mark Step as Done").trigger()
    assert fresh.workspace.progress.steps[18].state == "done"
    fresh.menus["edit.undo"].trigger()
    assert fresh.workspace.progress.steps[18].state == "not begun"
    fresh.menus["edit.redo"].trigger()
    assert fresh.workspace.is_dirty
    assert fresh.save()
    assert "done:\n  dual: " in fresh.workspace.path.read_text("utf-8")
    action(fresh, "Mark Step as Done").trigger()
    assert fresh.workspace.file.header.done == {}


def test_space_ticks_the_step_in_the_list_and_its_tip_has_who_did_it(fresh: MainWindow, qtbot: QtBot) -> None:
    steps = fresh.page.left.steps
    steps.tree.setCurrentItem(item(steps, "dual"))
    QTest.keyClick(steps.tree, Qt.Key.Key_Space)
    qtbot.waitUntil(lambda: item(steps, "dual").data(0, PICTURE)[0] == "check-circle-fill", timeout=WAIT_MS)
    assert "7 at the default, ticked 20" in item(steps, "dual").toolTip(0)
    QTest.keyClick(steps.tree, Qt.Key.Key_Space)
    assert fresh.workspace.file.header.done == {}


def test_a_step_has_a_menu_that_acts_on_it_and_not_on_the_selected_value(fresh: MainWindow) -> None:
    steps = fresh.page.left.steps
    fresh.go_to(("axis.integrand_name", "1"))
    steps._menu(item(steps, "oci"))
    menu = steps.findChildren(QMenu)[-1]
    assert [a.text().replace("&", "") for a in menu.actions()] == [
        "Mark as Done",
        "Keep Defaults of This Step",
    ]
    menu.actions()[0].trigger()
    menu.close()
    assert set(fresh.workspace.file.header.done) == {"oci"}


def test_a_tick_on_an_unfinished_step_shows_what_is_left(fresh: MainWindow) -> None:
    fresh.go_to(("axis.integrand_name", "1"))
    action(fresh, "Mark Step as Done").trigger()
    assert (
        fresh.statusBar().currentMessage()
        == "Axis names and rollover is ticked. Left: 3 values not set, 0 errors."
    )


def test_the_defaults_of_a_step_are_kept_in_one_step_of_undo(fresh: MainWindow) -> None:
    workspace = fresh.workspace
    gone = [("feedrate.rapid", "1"), ("feedrate.max_cutting", "2")]
    workspace.edit("clear", dict.fromkeys(gone))
    fresh.go_to(gone[0])
    action(fresh, "Keep Defaults of This Step").trigger()
    assert [workspace.file.is_default(address) for address in gone] == [True, True]
    fresh.menus["edit.undo"].trigger()
    assert [workspace.file.get(address) for address in gone] == [None, None]


def test_the_check_list_is_written_where_the_user_needs_it(
    fresh: MainWindow, user, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("amp_studio.ui.dialogs.check_list_dialog.QDesktopServices.openUrl", lambda _: True)
    user.chooses(tmp_path / "list.html")
    fresh.page.left.steps.print.click()
    assert "Axis Integrand Name" in (tmp_path / "list.html").read_text("utf-8")


def test_groups_stand_under_their_areas_and_areas_are_no_pages(fresh: MainWindow) -> None:
    groups = fresh.page.groups
    heads = [i for i in groups._items if i.text(0) in ("Machine", "Drives", "Motion")]
    assert [head.flags() & Qt.ItemFlag.ItemIsSelectable for head in heads] == [Qt.ItemFlag(0)] * 3
    drives = heads[1]
    assert [drives.child(n).text(0) for n in range(drives.childCount())] == ["Servo", "Axis Calibration"]
    assert drives.child(0).childCount() == 6
    jog = next(i for i in groups._items if i.text(0) == "Jog")
    assert jog.parent() is heads[2]
    assert jog.data(0, RIGHT) == "35"


def test_all_parameters_have_the_counts_of_every_group(fresh: MainWindow) -> None:
    every = fresh.page.groups._items[0]
    missing = len(fresh.workspace.validator.not_set)
    assert (every.text(0), every.data(0, RIGHT)) == ("All parameters", str(missing))
    fresh.workspace.show_later(True)
    fresh.page.left.show_side("groups")
    counts = dict(every.data(0, COUNTS))
    assert counts["error"] == fresh.workspace.count("error") > 10


def test_findings_are_filtered_to_the_step_in_front(fresh: MainWindow) -> None:
    assert fresh.findings.scope.buttons["shown"].text() == "Step"
    QTest.mouseClick(fresh.page.left.segment.buttons["groups"], Qt.MouseButton.LeftButton)
    assert fresh.findings.scope.buttons["shown"].text() == "Group"


def test_the_side_that_was_chosen_last_is_that_of_the_next_file(fresh: MainWindow, path: Path) -> None:
    assert not fresh.page.left.groups.isVisible(), "the steps of a fresh file are over nothing else"
    QTest.mouseClick(fresh.page.left.segment.buttons["groups"], Qt.MouseButton.LeftButton)
    assert "Axis Configuration" in fresh.page.list_title.text()
    QTest.mouseClick(fresh.page.left.segment.buttons["steps"], Qt.MouseButton.LeftButton)
    assert "Step 2" in fresh.page.list_title.text()
    fresh.open_first(path)
    assert fresh.page.left.side == "steps"


@pytest.mark.own_window
def test_what_the_left_panel_shows_is_made_when_a_user_looks(window: MainWindow) -> None:
    left, made = window.page.left, []
    left.take_project(lambda: made.append(QLabel("the machines")) or made[0])
    assert "steps" not in vars(left)
    assert left.groups.isVisible()
    assert not made
    QTest.mouseClick(left.segment.buttons["project"], Qt.MouseButton.LeftButton)
    assert made[0].isVisible()
    QTest.mouseClick(left.segment.buttons["steps"], Qt.MouseButton.LeftButton)
    QTest.mouseClick(left.segment.buttons["project"], Qt.MouseButton.LeftButton)
    assert made[0].isVisible()
    assert [left.groups.isVisible(), left.steps.isVisible(), len(made)] == [False, False, 1]


def test_a_fresh_file_is_calm_wherever_one_looks(window_with: Callable[[bytes], MainWindow]) -> None:
    """What is wrong with printed defaults is a state: no finding, no mark in a cell;
    the parameter panel has it.
    """
    window, hardware = (
        window_with(content_of(new_file("9pc", "mill", ["X", "Y", "Z"]))),
        ("servo.hardware_type", "1"),
    )
    window.go_to(hardware)
    assert window.workspace.count("error") == 0
    assert window.table.values.worst == {}
    assert "as delivered, to be set in steps" in window.findings.hint.text()
    assert "As delivered:" in window.detail.page.toPlainText()
    window.workspace.edit("begin", {("home.position", "1"): Value(1.0, "mm")})
    assert window.workspace.count("error") == 6
    assert window.table.values.worst[hardware] == "error"


def test_the_tip_of_a_step_has_its_findings(window: MainWindow) -> None:
    window.workspace.edit("loops", {("servo.position_loop_type", a): Value("open") for a in "123"})
    steps = window.page.left.steps
    tips = [item.toolTip(0) for item in steps._items.values()]
    assert any("warnings" in tip.splitlines()[-1] for tip in tips)
