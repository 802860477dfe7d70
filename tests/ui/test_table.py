"""The table: a row a parameter, a column an axis, and editing by keyboard alone."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLineEdit

from amp_studio.files import ParameterFile
from amp_studio.schema import Value
from amp_studio.ui.cell_look import CellLook
from amp_studio.ui.choice_box import ChoiceBox
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.parameter_table import AddressRole, ParameterTable
from amp_studio.ui.workspace import Workspace

from .conftest import WAIT_MS, action, editor, on_disk

EXCESS = ("servo.excess_error", "1")
LOOP = ("servo.position_loop_type", "1")
KEY = Qt.Key


@pytest.fixture
def table(workspace: Workspace) -> ParameterTable:
    """Return a table of all parameters, without a window."""
    table = ParameterTable(workspace)
    table.show_parameters(list(workspace.file.schema.parameters.values()))
    return table


def press(window: MainWindow, key: Qt.Key) -> None:
    """Press a key in the table."""
    QTest.keyClick(window.table_view, key)


def look(table: ParameterTable, address: tuple[str, str]) -> CellLook:
    """Return how a cell is painted."""
    index = table.index_of(address)
    return table.look(index.row(), index.column())


# -- what is shown -------------------------------------------------------------


def test_a_column_an_axis_and_one_for_the_control(table: ParameterTable) -> None:
    titles = [table.headerData(n, Qt.Orientation.Horizontal) for n in range(table.columnCount())]
    assert titles[:6] == ["Control", "X 1 linear", "Y 2 linear", "Z 3 linear", "B 4 rotary", "S 5 spindle"]


def test_a_row_a_process_a_gear_and_a_macro_call(table: ParameterTable) -> None:
    """Process 1 is not axis 1, and fifteen macro calls side by side would fit no screen."""
    rows = {table.number(n): table.row_name(n) for n in range(table.rowCount())}
    assert rows["20020"] == "Number of Limit 2,3 Groups, Process 1"
    assert rows["901"].endswith(", Spindle 1, Gear 2")
    assert rows["742"].endswith(", Macro call 15")
    assert rows["1300"] == "Home Calibration", "its axes are columns"
    assert rows["1020"] == "Software Overtravel Used", "page 7-46 prints it for another parameter by mistake"


def test_every_cell_leads_to_its_address_and_back(table: ParameterTable, file: ParameterFile) -> None:
    shown = {table.address_at(r, c) for r in range(table.rowCount()) for c in range(table.columnCount())} - {
        None
    }
    for address in shown:
        assert table.index_of(address).data(AddressRole) == address
    existing = {a for a in file.addresses() if file.evaluation.state(a).state != "hidden"}
    unfitted = {a for a in existing if a[1] in "678" and file.evaluation.scope(a) == "axis"}
    assert existing - unfitted <= shown


def test_unfitted_axes_and_hidden_parameters_are_options(window: MainWindow) -> None:
    table = window.table
    window.groups.tree.setCurrentItem(window.groups._items[0])
    assert "8" not in table.columns
    hidden, rows = table.hidden_rows, table.count
    assert hidden > 0
    assert f"{hidden} hidden" in window.page.list_title.text()

    window.view.all_axes.trigger()
    window.view.hidden_too.trigger()

    assert "8" in table.columns
    assert table.count == rows + hidden
    assert "hidden" not in window.page.list_title.text()


def test_a_row_comes_and_goes_with_what_makes_it_exist(window: MainWindow, workspace: Workspace) -> None:
    """Mill Type exists on a mill only (page 3-9); the cell that was selected stays selected as long as it exists."""
    window.groups.tree.setCurrentItem(window.groups._items[0])
    only_mill = ("control.mill_type", "")
    assert window.table.index_of(only_mill).isValid()
    window.go_to(EXCESS)

    workspace.edit("lathe", {("control.type", ""): Value("lathe")})
    assert not window.table.index_of(only_mill).isValid()
    assert window.selected() == EXCESS

    workspace.undo_stack.undo()
    assert window.table.index_of(only_mill).isValid()
    assert window.selected() == EXCESS


def test_what_is_not_for_this_configuration_cannot_be_edited(
    table: ParameterTable, file: ParameterFile
) -> None:
    hidden = next(
        a
        for a in file.addresses()
        if file.evaluation.state(a).state == "hidden" and table.index_of(a).isValid()
    )
    index = table.index_of(hidden)
    assert index.data() == ""
    assert table.look(index.row(), index.column()).kind == "absent"
    assert not index.flags() & Qt.ItemFlag.ItemIsEditable

    table.hidden_too = True
    table.show_again()
    assert table.index_of(hidden).flags() & Qt.ItemFlag.ItemIsEditable


def test_a_finding_colours_its_cells_and_tells_itself(table: ParameterTable, workspace: Workspace) -> None:
    plain = look(table, EXCESS)
    workspace.edit("force", {EXCESS: Value(1e9, "mm")}, force="on a day")

    index = table.index_of(EXCESS)
    assert plain.severity == ""
    assert look(table, EXCESS).severity == "error"
    assert "is outside" in index.data(Qt.ItemDataRole.ToolTipRole)
    assert "Forced on a day" in index.data(Qt.ItemDataRole.ToolTipRole)


def test_what_a_wrong_value_was_compared_with_is_not_coloured(table: ParameterTable) -> None:
    """Maximum Cutting Feedrate must not be above Rapid Feedrate for Positioning, which is as it should be."""
    cutting, rapid = ("feedrate.max_cutting", "1"), ("feedrate.rapid", "1")
    before = look(table, rapid).severity
    table.workspace.edit("force", {cutting: Value(1e5, "mm/min")}, force="on a day")
    assert look(table, cutting).severity
    assert look(table, rapid).severity == before
    assert any(rapid in finding.compared for finding in table.workspace.findings_of(cutting))


def test_an_own_value_is_loud_and_a_default_is_not(table: ParameterTable, workspace: Workspace) -> None:
    default = workspace.file.default(EXCESS)
    assert look(table, EXCESS).is_own
    workspace.edit("default", {EXCESS: default})
    assert not look(table, EXCESS).is_own


# -- by keyboard ---------------------------------------------------------------


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


def test_the_field_tells_the_range_while_it_is_open(window: MainWindow) -> None:
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
    window: MainWindow, file: ParameterFile, person
) -> None:
    window.go_to(EXCESS)
    press(window, KEY.Key_F2)
    field = editor(window)
    QTest.keyClicks(field, "99999")
    assert "is outside 0 to 214.1 mm" in field.refusal_text, "shown while it is typed"

    QTest.keyClick(field, KEY.Key_Return)

    assert editor(window) is field
    assert field.text() == "99999"
    assert person.asked == []
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
    shown = [box.itemData(n) for n in range(box.count()) if not box.view().isRowHidden(n)]
    assert shown == [label for label in labels if "dig" in label.lower()]
    QTest.keyClick(box.view(), KEY.Key_Backspace)
    assert box.currentData() == next(label for label in labels if label.lower().startswith("di"))
    box.hidePopup()


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


def test_the_text_of_a_choice_that_is_cut_off_is_in_its_tip(table: ParameterTable) -> None:
    index = table.index_of(("servo.position_feedback_type", "1"))
    assert index.data() in index.data(Qt.ItemDataRole.ToolTipRole)


def test_a_key_that_is_no_letter_goes_through(window: MainWindow) -> None:
    window.go_to(EXCESS)
    event = QKeyEvent(QEvent.Type.KeyPress, KEY.Key_Down, Qt.KeyboardModifier.NoModifier)
    window.table_view.keyPressEvent(event)
    assert window.selected() != EXCESS
    assert not window.table_view.viewport().findChildren(QLineEdit)


# -- what is typed is not lost -------------------------------------------------


def test_saving_takes_what_stands_in_an_open_field(window: MainWindow, path) -> None:
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


def test_closing_asks_about_what_stands_in_an_open_field(window: MainWindow, path, person) -> None:
    window.go_to(EXCESS)
    press(window, KEY.Key_F2)
    QTest.keyClicks(editor(window), "3,5")
    person.answers("Save")

    assert window.close()

    assert on_disk(path).get(EXCESS) == Value(3.5, "mm")


def test_closing_with_an_open_list_ends_well(window: MainWindow, file: ParameterFile, qtbot) -> None:
    window.go_to(LOOP)
    press(window, KEY.Key_F2)
    box = editor(window)
    qtbot.waitUntil(lambda: box.view().isVisible(), timeout=WAIT_MS)
    assert window.close()


def test_the_other_cells_of_the_selected_finding_are_outlined(
    window: MainWindow, workspace: Workspace
) -> None:
    """Gain Break Point 12 mm is not below Feedrate Suppression Point 11 mm, which is not at fault."""
    workspace.edit("raise", {("servo.gain_break_point", "1"): Value(12.0, "mm")})
    finding = next(f for f in workspace.findings if ("servo.gain_break_point", "1") in f.causes)
    window.findings.select(finding)
    assert window.table.outlined == frozenset({("servo.feedrate_suppression", "1")})
    assert window.table.outline_severity == finding.severity
