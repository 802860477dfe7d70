"""The table is edited by keyboard alone, and what is typed is not lost."""

import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLineEdit

from amp_studio.files import ParameterFile
from amp_studio.schema import Value
from amp_studio.ui.forms.choice_box import ChoiceBox, folded
from amp_studio.ui.main_window import MainWindow

from .conftest import WAIT_MS, action, editor, on_disk

EXCESS = ("servo.excess_error", "1")
LOOP = ("servo.position_loop_type", "1")
KEY = Qt.Key


def press(window: MainWindow, key: Qt.Key) -> None:
    """Press a key in the table."""
    QTest.keyClick(window.table_view, key)


@pytest.mark.parametrize("key", [KEY.Key_F2, KEY.Key_Return, KEY.Key_Enter])
def test_a_key_starts_editing_and_enter_takes_the_value(
    window: MainWindow, file: ParameterFile, key: Qt.Key, qtbot
) -> None:
    window.go_to(EXCESS)

    press(window, key)
    field = editor(window)
    assert field.text() == "11 mm"
    assert field.selectedText() == "11 mm"
    QTest.keyClicks(field, "3,25")
    QTest.keyClick(field, KEY.Key_Return)

    qtbot.waitUntil(lambda: file.get(EXCESS) == Value(3.25, "mm"), timeout=WAIT_MS)
    below = window.table.index_of(EXCESS).row() + 1
    assert window.selected() == window.table.address_at(below, 0), "Enter goes down"


def test_typing_starts_editing_and_escape_leaves_the_value(window: MainWindow, file: ParameterFile) -> None:
    window.go_to(EXCESS)
    press(window, KEY.Key_7)
    field = editor(window)
    assert field.text() == "7"

    QTest.keyClick(field, KEY.Key_Escape)

    assert file.get(EXCESS) == Value(11.0, "mm")


def test_the_field_reports_the_range_while_it_is_open(window: MainWindow) -> None:
    window.go_to(EXCESS)
    press(window, KEY.Key_F2)
    field = editor(window)
    assert field.toolTip() == "Allowed here: 0 to 214.1 mm" or field.toolTip().startswith("Allowed here: 0")
    assert field.placeholderText() in field.toolTip()


def test_tab_goes_on_to_the_next_axis(window: MainWindow, file: ParameterFile) -> None:
    window.go_to(EXCESS)
    for text in ("4", "5"):
        if text == "4":
            press(window, KEY.Key_F2)
        field = editor(window)
        QTest.keyClicks(field, text)
        QTest.keyClick(field, KEY.Key_Tab)
        QApplication.processEvents()

    assert [file.get(("servo.excess_error", a)) for a in "12"] == [Value(4.0, "mm"), Value(5.0, "mm")]
    assert window.selected() == ("servo.excess_error", "3")


def test_delete_unsets(window: MainWindow, file: ParameterFile) -> None:
    window.go_to(EXCESS)
    window.table_view.setFocus()
    press(window, KEY.Key_Delete)
    assert file.get(EXCESS) is None
    assert window.table.index_of(EXCESS).data() == "not set"


def test_delete_in_a_field_deletes_a_letter(window: MainWindow, file: ParameterFile) -> None:
    window.go_to(EXCESS)
    press(window, KEY.Key_F2)
    field = editor(window)
    field.home(False)
    QTest.keyClick(field, KEY.Key_Delete)
    assert field.text() == "1 mm"
    assert file.get(EXCESS) == Value(11.0, "mm")


def test_a_refused_value_stays_in_its_editor_with_the_range_and_no_box(
    window: MainWindow, file: ParameterFile, user
) -> None:
    window.go_to(EXCESS)
    press(window, KEY.Key_F2)
    field = editor(window)
    QTest.keyClicks(field, "99999")
    assert "is outside 0 to 214.1 mm" in field.refusal_text, "shown while it is typed"

    QTest.keyClick(field, KEY.Key_Return)

    assert editor(window) is field
    assert field.text() == "99999"
    assert user.asked == []
    assert file.get(EXCESS) == Value(11.0, "mm")
    QTest.keyClicks(field, "12")
    assert field.refusal_text == ""
    QTest.keyClick(field, KEY.Key_Return)
    assert file.get(EXCESS) == Value(12.0, "mm")


def test_a_refused_value_can_be_forced_by_its_key(window: MainWindow, file: ParameterFile) -> None:
    window.go_to(EXCESS)
    press(window, KEY.Key_F2)
    QTest.keyClicks(editor(window), "300")
    keys = Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier
    QTest.keyClick(editor(window), KEY.Key_Return, keys)
    assert file.get(EXCESS) == Value(300.0, "mm")
    assert "in the studio" in file.forced[EXCESS]


def test_a_refused_text_comes_back_when_its_field_loses_the_focus(
    window: MainWindow, file: ParameterFile, qtbot
) -> None:
    window.go_to(EXCESS)
    press(window, KEY.Key_F2)
    QTest.keyClicks(editor(window), "many")
    window.finder.box.setFocus()
    qtbot.waitUntil(lambda: editor(window).refusal_text != "", timeout=WAIT_MS)
    assert editor(window).text() == "many"
    assert "is not a number" in editor(window).refusal_text
    QTest.keyClick(editor(window), KEY.Key_Escape)
    assert file.get(EXCESS) == Value(11.0, "mm")


def test_the_result_of_an_expression_is_shown_while_it_is_typed(
    window: MainWindow, file: ParameterFile
) -> None:
    window.go_to(EXCESS)
    press(window, KEY.Key_F2)
    field = editor(window)
    QTest.keyClicks(field, "25.4/5")
    assert field.result_text == "5.08 mm"
    QTest.keyClick(field, KEY.Key_Return)
    assert file.get(EXCESS) == Value(5.08, "mm")
    assert window.workspace.undo_stack.undoText() == "Set 1750 Excess Error, X to 5.08 mm (25.4/5)"


def test_one_key_opens_the_list_of_choices_and_a_letter_chooses(
    window: MainWindow, file: ParameterFile, qtbot
) -> None:
    window.go_to(LOOP)
    press(window, KEY.Key_Return)
    box = editor(window)
    qtbot.waitUntil(lambda: box.view().isVisible(), timeout=WAIT_MS)

    QTest.keyClick(box.view(), KEY.Key_O)
    assert box.currentData() == "Open Loop"
    QTest.keyClick(box.view(), KEY.Key_Return)

    qtbot.waitUntil(lambda: file.get(LOOP) == Value("open"), timeout=WAIT_MS)
    assert window.selected() == LOOP


def test_escape_closes_the_list_and_leaves_the_choice(window: MainWindow, file: ParameterFile, qtbot) -> None:
    window.go_to(LOOP)
    press(window, KEY.Key_F2)
    box = editor(window)
    qtbot.waitUntil(lambda: box.view().isVisible(), timeout=WAIT_MS)

    QTest.keyClick(box.view(), KEY.Key_Escape)

    qtbot.waitUntil(lambda: not window.table_view.viewport().findChildren(ChoiceBox), timeout=WAIT_MS)
    assert file.get(LOOP) == Value("closed")


def test_typing_a_letter_on_a_choice_opens_the_list_at_it(window: MainWindow, qtbot) -> None:
    window.go_to(LOOP)
    press(window, KEY.Key_O)
    box = editor(window)
    qtbot.waitUntil(lambda: box.view().isVisible(), timeout=WAIT_MS)
    assert box.currentData() == "Open Loop"
    box.hidePopup()


def typed(window: MainWindow, qtbot, text: str):
    """Type on a choice that shows SERCOS among others; returns the open list."""
    window.go_to(("servo.loop_type", "1"))
    QTest.keyClick(window.table_view, text[0])
    box = editor(window)
    qtbot.waitUntil(lambda: box.view().isVisible(), timeout=WAIT_MS)
    for letter in text[1:]:
        QTest.keyClick(box.view(), letter)
    return box


def test_letters_add_up_and_a_label_goes_before_a_code(window: MainWindow, qtbot) -> None:
    """The code letter of another choice is not meant by the beginning of a word."""
    labels = [c.label for c in window.workspace.file.schema.parameters["servo.loop_type"].choices]
    wanted = next(label for label in labels if label.lower().startswith("dig"))
    box = typed(window, qtbot, "dig")
    assert box.currentData() == wanted
    displayed = [box.itemData(n) for n in range(box.count()) if not box.view().isRowHidden(n)]
    assert displayed == [label for label in labels if "dig" in label.lower()]
    QTest.keyClick(box.view(), KEY.Key_Backspace)
    assert box.currentData() == next(label for label in labels if label.lower().startswith("di"))
    box.hidePopup()


def test_a_text_that_no_choice_fits_leaves_the_value_and_backspace_leads_back(
    window: MainWindow, qtbot
) -> None:
    """``g`` is the letter of another choice; a typing error must not set it."""
    box = typed(window, qtbot, "digx")
    value = window.workspace.file.get(("servo.loop_type", "1")).value
    keys = [c.key for c in window.workspace.file.schema.parameters["servo.loop_type"].choices]
    assert keys[box.currentIndex()] == value
    assert not any(box.view().isRowHidden(n) for n in range(box.count()))
    QTest.keyClick(box.view(), KEY.Key_Backspace)
    assert [n for n in range(box.count()) if not box.view().isRowHidden(n)] == [box.currentIndex()]
    QTest.keyClick(box.view(), KEY.Key_Escape)
    assert window.workspace.undo_stack.count() == 0


def test_tab_in_an_open_list_takes_the_choice_and_goes_on(window: MainWindow, qtbot) -> None:
    file = window.workspace.file
    box = typed(window, qtbot, "ser")
    QTest.keyClick(box.view(), KEY.Key_Tab)
    qtbot.waitUntil(lambda: file.get(("servo.loop_type", "1")) == Value("sercos"), timeout=WAIT_MS)
    assert window.selected() == ("servo.loop_type", "2")


def test_a_list_of_choices_forgives_accents() -> None:
    assert folded("Größe É") == "grosse e"


def test_no_list_is_closed_twice(window: MainWindow, qtbot, qtlog) -> None:
    for key in (KEY.Key_Return, KEY.Key_Escape):
        box = typed(window, qtbot, "dig")
        QTest.keyClick(box.view(), key)
        qtbot.waitUntil(lambda: not window.table_view.viewport().findChildren(ChoiceBox), timeout=WAIT_MS)
    window.table_view.edit(window.table_view.currentIndex())
    window.table_view.finish()
    QApplication.processEvents()
    assert not [record.message for record in qtlog.records if "closeEditor" in record.message]


def test_a_click_on_a_name_selects_the_row(window: MainWindow) -> None:
    window.go_to(EXCESS)
    row = window.table.index_of(("servo.lead_screw_pitch", "1")).row()
    window.table_view.verticalHeader().sectionClicked.emit(row)
    assert window.selected() == ("servo.lead_screw_pitch", "1")


def test_a_key_that_is_no_letter_goes_through(window: MainWindow) -> None:
    window.go_to(EXCESS)
    event = QKeyEvent(QEvent.Type.KeyPress, KEY.Key_Down, Qt.KeyboardModifier.NoModifier)
    window.table_view.keyPressEvent(event)
    assert window.selected() != EXCESS
    assert not window.table_view.viewport().findChildren(QLineEdit)


def test_saving_takes_what_is_in_an_open_field(window: MainWindow, path) -> None:
    window.go_to(EXCESS)
    press(window, KEY.Key_F2)
    QTest.keyClicks(editor(window), "3,5")

    action(window, "Save").trigger()

    assert on_disk(path).get(EXCESS) == Value(3.5, "mm")


def test_an_action_waits_for_a_field_that_cannot_be_taken(window: MainWindow, path) -> None:
    window.edits.commit(EXCESS, "3 mm")
    window.go_to(EXCESS)
    press(window, KEY.Key_F2)
    QTest.keyClicks(editor(window), "three")

    action(window, "Save").trigger()

    assert "is not a number" in editor(window).refusal_text
    assert on_disk(path).get(EXCESS) == Value(11.0, "mm")
    assert editor(window).text() == "three"
    QTest.keyClick(editor(window), KEY.Key_Escape)


def test_closing_asks_about_what_is_in_an_open_field(window: MainWindow, path, user) -> None:
    window.go_to(EXCESS)
    press(window, KEY.Key_F2)
    QTest.keyClicks(editor(window), "3,5")
    user.answers("Save")

    assert window.close()

    assert on_disk(path).get(EXCESS) == Value(3.5, "mm")


def test_closing_with_an_open_list_ends_well(window: MainWindow, file: ParameterFile, qtbot) -> None:
    window.go_to(LOOP)
    press(window, KEY.Key_F2)
    box = editor(window)
    qtbot.waitUntil(lambda: box.view().isVisible(), timeout=WAIT_MS)
    assert window.close()
