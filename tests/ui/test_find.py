"""The find box: what it shows at each key, and where each row leads."""

import threading
from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtCore import Qt, QUrl
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from amp_studio.schema import Value, load_schema
from amp_studio.ui.actions import find
from amp_studio.ui.actions.find_box import FindBox
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.page.message_page import MessageWindow

from .conftest import WAIT_MS, User, action


@pytest.fixture
def box(window: MainWindow, qtbot) -> FindBox:
    """Return the box of a window whose family is indexed."""
    return indexed(window, qtbot)


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
    window: MainWindow, box: FindBox
) -> None:
    typed(box, "exess error y")
    assert (box.is_open, box.model.rows[1].hit.kind) == (True, "parameter")
    QTest.keyClick(box, Qt.Key.Key_Return)
    assert window.selected() == ("servo.excess_error", "2")
    assert window.focusWidget() is window.table_view
    assert not box.is_open


def test_a_number_a_value_and_a_choice_each_lead_to_their_cell(window: MainWindow, box: FindBox) -> None:
    for text, address in (
        ("2300", ("home.calibration", "2")),
        ("12.7 mm", ("servo.lead_screw_pitch", "1")),
        ("J3", ("servo.position_port", "3")),
    ):
        typed(box, text)
        QTest.keyClick(box, Qt.Key.Key_Return)
        assert window.selected() == address, text


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


def test_a_parameter_is_listed_with_its_value_in_the_current_axis(window: MainWindow, box: FindBox) -> None:
    window.go_to(("home.calibration", "4"))
    typed(box, "excess error")
    assert box.model.rows[1].detail.startswith("3.96°   Servo Parameters")
    typed(box, "1750")
    assert box.model.rows[1].detail.startswith("11 mm   ")


def test_heads_are_passed_by_the_keys_and_the_ends_join(box: FindBox) -> None:
    typed(box, "closed loop")
    rows = box.model.rows
    able = [n for n, row in enumerate(rows) if not row.is_head]
    assert len(heads(box)) > 2
    seen = []
    for _ in range(len(able) + 1):
        seen.append(box.list.currentIndex().row())
        QTest.keyClick(box, Qt.Key.Key_Down)
    assert seen == [*able, able[0]]
    QTest.keyClick(box, Qt.Key.Key_Up)
    QTest.keyClick(box, Qt.Key.Key_Up)
    assert box.list.currentIndex().row() == able[-1]
    assert box.window().focusWidget() is box


def test_escape_closes_the_list_and_keeps_the_question(box: FindBox) -> None:
    typed(box, "home")
    QTest.keyClick(box, Qt.Key.Key_Escape)
    assert (box.is_open, box.text(), box.window().focusWidget()) == (False, "home", box)


def test_the_list_closes_when_the_cursor_goes_elsewhere(window: MainWindow, box: FindBox) -> None:
    typed(box, "home")
    window.table_view.setFocus()
    assert not box.is_open


def test_nothing_found_offers_the_nearest_and_enter_takes_it(window: MainWindow, box: FindBox) -> None:
    typed(box, "excccesss")
    nothing, nearest, *ways_on = box.model.rows
    assert [row.text for row in ways_on[-2:]] == [
        "Show all parameters in the table",
        "Copy this question, to report the word",
    ]
    box.chosen.emit(ways_on[-1])
    assert "9pc: find 'excccesss' has no answer" in QGuiApplication.clipboard().text()
    typed(box, "excccesss")
    assert (nothing.text, nearest.instead) == ("Nothing found", "excess")
    QTest.keyClick(box, Qt.Key.Key_Return)
    assert (box.text(), box.is_open) == ("excess", True)
    assert box.model.rows[1].hit.kind == "parameter"


def test_another_family_that_has_it_is_named_and_shown(
    window: MainWindow, box: FindBox, user: User, qtbot
) -> None:
    typed(box, "debounce")
    qtbot.waitUntil(lambda: any(row.family for row in box.model.rows), timeout=WAIT_MS)
    row = next(row for row in box.model.rows if row.family)
    assert row.text.startswith("In grblHAL and Grbl: ")
    box.chosen.emit(row)
    assert "Id: homing.debounce" in user.reads()


def test_the_best_of_each_kind_are_at_the_top(box: FindBox) -> None:
    """The parameter that resets was below six messages of an E-stop, which fit less."""
    box.begin("will not reset")
    best = [row.hit.key for row in box.model.rows[1:4]]
    assert box.model.rows[0].text == "Best"
    assert best[0] == "symptom-stays-in-estop"
    assert box.model.rows[2].text.startswith("68 Control Reset on E-Stop Reset")


def test_a_german_word_leads_to_the_parameter_whatever_the_language(box: FindBox) -> None:
    typed(box, "Schleppfehler")
    assert box.model.rows[1].hit.key == "servo.excess_error"
    assert box.model.rows[1].right == "'schleppfehler' as 'excess error'"


def test_the_old_question_is_selected_by_the_click_that_comes_back(window: MainWindow, box: FindBox) -> None:
    typed(box, "home")
    window.table_view.setFocus()
    box.setFocus(Qt.FocusReason.MouseFocusReason)  # as Qt does before the click
    QTest.mouseClick(box, Qt.MouseButton.LeftButton)
    assert box.selectedText() == "home"
    QTest.mouseClick(box, Qt.MouseButton.LeftButton, pos=box.rect().center())
    assert box.selectedText() == "", "the second click puts the cursor"


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
    qtbot.waitUntil(lambda: box.model.rows[0].is_head and len(box.model.rows) > 1, timeout=WAIT_MS)
    assert box.model.rows[1].hit.kind == "parameter"


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


def test_in_german_what_was_found_is_written_as_its_cell_in_millimetres_and_in_inches(
    german: None, window: MainWindow, workspace: Workspace, box: FindBox
) -> None:
    address = ("servo.excess_error", "1")
    workspace.edit("edit", {address: Value(0.3, "in")})
    for question, system, text in (("7,62 mm", "metric", "7,62 mm"), ("0,3 Zoll", "inch", "0,3 Zoll")):
        workspace.show_in(system)
        typed(box, question)
        row = next(row for row in box.model.rows if row.hit is not None and row.hit.kind == "value")
        assert (row.text, row.hit.address) == (text, address)
        typed(box, "excess following error")
        message = next(row for row in box.model.rows if row.hit is not None and row.hit.kind == "message")
        window.finder._go(message)
        page = window.findChild(MessageWindow)
        assert f"X {text}" in page.text.toPlainText()
        page.close()


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


def test_a_message_is_german_in_its_window_and_in_a_list_without_a_file(
    german: None, open_window: Callable[..., MainWindow], qtbot: QtBot
) -> None:
    """The title of the window and the list were English, scenarios were their ids."""
    window = open_window()
    box = window.finder.box
    symptom = MessageWindow(window, load_schema("9pc"), "symptom-oscillates")
    assert symptom.windowTitle() == "Eine Achse schwingt, brummt oder pfeift"
    assert "Frequenzgang" in symptom.text.toPlainText()
    symptom.close()
    box.begin("alarm:2 soft limit")
    qtbot.waitUntil(lambda: any("ALARM:2 " in row.text for row in box.model.rows), timeout=WAIT_MS)
    (row,) = (row.text for row in box.model.rows if row.text.startswith("ALARM:2 "))
    assert row == "ALARM:2 Softwareendlage"


@pytest.mark.own_window
def test_enter_before_the_words_of_a_file_are_read_goes_there_once_they_are(
    open_window: Callable[..., MainWindow], path: Path, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The first number typed into a file that was just opened found nothing, and Enter did something else."""
    read = threading.Event()
    real = find._make_ready
    monkeypatch.setattr(find, "_make_ready", lambda *given: (read.wait(WAIT_MS / 1000), real(*given)))
    window = open_window(path)
    box = window.finder.box
    box.setFocus()
    box.begin("1740")
    QTest.keyClick(box, Qt.Key.Key_Return)
    assert [row.text for row in box.model.rows] == ["Preparing the search …"]
    read.set()
    qtbot.waitUntil(lambda: not box.is_open, timeout=WAIT_MS)
    assert window.selected() == ("servo.feedrate_suppression", "1")
