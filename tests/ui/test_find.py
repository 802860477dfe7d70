"""The find box: what it shows at each key, and where each row leads."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt, QUrl
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest

from amp_studio.schema import Value
from amp_studio.ui.actions.find_box import FindBox
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.page.message_page import MessageWindow

from .conftest import WAIT_MS, User, action

pytestmark = pytest.mark.shared_window


@pytest.fixture
def box(window: MainWindow, qtbot) -> FindBox:
    """Return the box of a window whose family is indexed."""
    return indexed(window, qtbot)


@pytest.fixture
def shared_box(window_to_read: MainWindow, qtbot) -> FindBox:
    """Return the box of the window of this module, for tests that change nothing."""
    window_to_read.activateWindow()
    assert QTest.qWaitForWindowActive(window_to_read, WAIT_MS)
    return indexed(window_to_read, qtbot)


def indexed(window: MainWindow, qtbot) -> FindBox:
    """Return the box of a window when its family is indexed."""
    window.finder.box.begin("")
    qtbot.waitUntil(lambda: window.finder._finder() is not None, timeout=WAIT_MS)
    return window.finder.box


def heads(box: FindBox) -> list[str]:
    return [row.text for row in box.model.rows if row.is_head]


def typed(box: FindBox, text: str) -> None:
    box.begin("")
    QTest.keyClicks(box, text)


def test_control_f_and_control_k_come_to_the_box_and_control_g_too(window: MainWindow) -> None:
    assert [key.toString() for key in action(window, "Find").shortcuts()] == ["Ctrl+F", "Ctrl+K"]
    action(window, "Go to Number").trigger()
    assert window.focusWidget() is window.finder.box


def test_enter_goes_to_the_best_parameter_and_the_cursor_to_the_table(
    window_to_read: MainWindow, shared_box: FindBox
) -> None:
    typed(shared_box, "exess error y")
    assert (shared_box.is_open, heads(shared_box)[0]) == (True, "Parameters")
    QTest.keyClick(shared_box, Qt.Key.Key_Return)
    assert window_to_read.selected() == ("servo.excess_error", "2")
    assert window_to_read.focusWidget() is window_to_read.table_view
    assert not shared_box.is_open


def test_a_number_a_value_and_a_choice_each_lead_to_their_cell(
    window_to_read: MainWindow, shared_box: FindBox
) -> None:
    for text, address in (
        ("2300", ("home.calibration", "2")),
        ("12.7 mm", ("servo.lead_screw_pitch", "1")),
        ("J3", ("servo.position_port", "3")),
    ):
        typed(shared_box, text)
        QTest.keyClick(shared_box, Qt.Key.Key_Return)
        assert window_to_read.selected() == address, text


def test_a_group_is_shown_on_the_left_with_its_parameters(window: MainWindow, box: FindBox) -> None:
    window.page.left.show_side("steps")
    typed(box, "home parameters")
    row = next(
        n for n, each in enumerate(box.model.rows) if each.hit is not None and each.hit.kind == "group"
    )
    box.list.setCurrentIndex(box.model.index(row))
    QTest.keyClick(box, Qt.Key.Key_Return)
    assert window.page.left.side == "groups"
    assert {row.parameter.id.partition(".")[0] for row in window.table.rows} == {"home"}
    assert window.focusWidget() is window.table_view


def test_a_parameter_is_listed_with_its_value_in_the_current_axis(
    window_to_read: MainWindow, shared_box: FindBox
) -> None:
    window_to_read.go_to(("home.calibration", "4"))
    typed(shared_box, "excess error")
    assert shared_box.model.rows[1].detail.startswith("3.96°   Servo Parameters")
    typed(shared_box, "1750")
    assert shared_box.model.rows[1].detail.startswith("11 mm   ")


def test_heads_are_passed_by_the_keys_and_the_ends_join(shared_box: FindBox) -> None:
    typed(shared_box, "closed loop")
    rows = shared_box.model.rows
    able = [n for n, row in enumerate(rows) if not row.is_head]
    assert len(heads(shared_box)) > 2
    seen = []
    for _ in range(len(able) + 1):
        seen.append(shared_box.list.currentIndex().row())
        QTest.keyClick(shared_box, Qt.Key.Key_Down)
    assert seen == [*able, able[0]]
    QTest.keyClick(shared_box, Qt.Key.Key_Up)
    QTest.keyClick(shared_box, Qt.Key.Key_Up)
    assert shared_box.list.currentIndex().row() == able[-1]
    assert shared_box.window().focusWidget() is shared_box


def test_escape_closes_the_list_and_keeps_the_question(shared_box: FindBox) -> None:
    typed(shared_box, "home")
    QTest.keyClick(shared_box, Qt.Key.Key_Escape)
    assert (shared_box.is_open, shared_box.text(), shared_box.window().focusWidget()) == (
        False,
        "home",
        shared_box,
    )


def test_the_list_closes_when_the_cursor_goes_elsewhere(
    window_to_read: MainWindow, shared_box: FindBox
) -> None:
    typed(shared_box, "home")
    window_to_read.table_view.setFocus()
    assert not shared_box.is_open


def test_nothing_found_offers_the_nearest_and_enter_takes_it(
    window_to_read: MainWindow, shared_box: FindBox
) -> None:
    typed(shared_box, "excccesss")
    nothing, nearest, *ways_on = shared_box.model.rows
    assert [row.text for row in ways_on[-2:]] == [
        "Show all parameters in the table",
        "Copy this question, to report the word",
    ]
    shared_box.chosen.emit(ways_on[-1])
    assert "9pc: find 'excccesss' has no answer" in QGuiApplication.clipboard().text()
    typed(shared_box, "excccesss")
    assert (nothing.text, nearest.instead) == ("Nothing found", "excess")
    QTest.keyClick(shared_box, Qt.Key.Key_Return)
    assert (shared_box.text(), shared_box.is_open) == ("excess", True)
    assert heads(shared_box)[0] == "Parameters"


def test_another_family_that_has_it_is_named_and_shown(
    window: MainWindow, box: FindBox, user: User, qtbot
) -> None:
    typed(box, "debounce")
    qtbot.waitUntil(lambda: any(row.family for row in box.model.rows), timeout=WAIT_MS)
    row = next(row for row in box.model.rows if row.family)
    assert row.text.startswith("In grblHAL and Grbl: ")
    box.chosen.emit(row)
    assert "Id: homing.debounce" in user.reads()


def test_a_german_word_leads_to_the_parameter_whatever_the_language(shared_box: FindBox) -> None:
    typed(shared_box, "Schleppfehler")
    assert shared_box.model.rows[1].hit.key == "servo.excess_error"
    assert shared_box.model.rows[1].right == "'schleppfehler' as 'excess error'"


def test_the_old_question_is_selected_by_the_click_that_comes_back(
    window_to_read: MainWindow, shared_box: FindBox
) -> None:
    typed(shared_box, "home")
    window_to_read.table_view.setFocus()
    shared_box.setFocus(Qt.FocusReason.MouseFocusReason)  # as Qt does before the click
    QTest.mouseClick(shared_box, Qt.MouseButton.LeftButton)
    assert shared_box.selectedText() == "home"
    QTest.mouseClick(shared_box, Qt.MouseButton.LeftButton, pos=shared_box.rect().center())
    assert shared_box.selectedText() == "", "the second click puts the cursor"


def test_a_value_is_found_as_it_was_edited(workspace: Workspace, box: FindBox) -> None:
    address = ("servo.excess_error", "1")
    workspace.edit("edit", {address: workspace.read(address, "17.123 mm")})
    typed(box, "17.123")
    assert box.model.rows[1].hit.address == address


def test_the_other_machine_type_is_searched_once_the_file_is_of_it(
    window: MainWindow, workspace: Workspace, box: FindBox, qtbot
) -> None:
    before = window.finder._finders[window.page]
    workspace.edit("lathe", {("control.type", ""): Value("lathe")})
    after = window.finder._finders[window.page]
    assert (before.machine, after.machine) == ("mill", "lathe")
    workspace.edit("edit", {("servo.excess_error", "1"): Value(12.0, "mm")})
    assert window.finder._finders[window.page] is after
    box.begin("lathe type")
    qtbot.waitUntil(lambda: heads(box)[:1] == ["Parameters"], timeout=WAIT_MS)


def test_a_message_opens_its_page_which_follows_every_edit(
    window: MainWindow, workspace: Workspace, box: FindBox
) -> None:
    typed(box, "servo amp fe limts")
    QTest.keyClick(box, Qt.Key.Key_Return)
    page = window.findChild(MessageWindow)
    assert "Gain Break Point is not below Feedrate Suppression Point" in page.text.toPlainText()
    assert "In this file" not in page.text.toPlainText()
    address = ("servo.gain_break_point", "1")
    workspace.edit("edit", {address: workspace.read(address, "50 mm")})
    assert "In this file" in page.text.toPlainText()
    assert "X 50 mm" in page.text.toPlainText()
    page.text.anchorClicked.emit(QUrl("at:servo.gain_break_point%402"))
    assert window.selected() == ("servo.gain_break_point", "2")
    QTest.keyClick(page, Qt.Key.Key_Escape)
    assert not page.isVisible()


def test_without_a_file_commands_are_found(open_window) -> None:
    window = open_window()
    window.finder.box.begin("new")
    assert any(row.text == "File › New" for row in window.finder.box.model.rows)


def test_without_a_file_the_messages_of_every_family_are_found_and_shown(open_window, qtbot) -> None:
    window = open_window()
    box = window.finder.box
    box.begin("mot-022")
    qtbot.waitUntil(lambda: heads(box) == ["Messages of the control"], timeout=WAIT_MS)
    QTest.keyClick(box, Qt.Key.Key_Return)
    page = window.findChild(MessageWindow)
    assert "Syntec" in page.text.toPlainText()
    assert "Rules that find it" in page.text.toPlainText()


@pytest.mark.own_window
def test_a_closed_file_is_forgotten(window: MainWindow, box: FindBox, qtbot) -> None:
    window.close_page(window.page)
    qtbot.waitUntil(lambda: not window.finder._finders, timeout=WAIT_MS)
    box.begin("home")
    assert "Parameters" not in heads(box)


def test_the_panel_of_a_parameter_leads_to_the_messages_that_name_it(window: MainWindow) -> None:
    window.go_to(("servo.excess_error", "1"))
    assert "EXCESS FOLLOWING ERROR" in window.detail.page.toPlainText()
    window.detail.page.anchorClicked.emit(QUrl("message:excess-following-error"))
    assert window.findChild(MessageWindow).windowTitle() == "EXCESS FOLLOWING ERROR"
