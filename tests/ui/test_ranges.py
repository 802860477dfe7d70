"""Ranges of cells: selected by keys, copied, pasted with a preview, filled, set to default.
One step to undo each.
"""

import pytest
from PySide6.QtCore import QItemSelection, QItemSelectionModel, QMimeData, QPoint, Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest

from amp_studio.files import ParameterFile
from amp_studio.files.notes import set_value_note, value_note
from amp_studio.schema import Value
from amp_studio.ui.dialogs.note_dialog import NoteDialog
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.table.block_preview import BlockPreview

from .conftest import action, editor

EXCESS, SUPPRESSION, BREAK = ("servo.excess_error", "servo.feedrate_suppression", "servo.gain_break_point")
KEY, SHIFT = Qt.Key, Qt.KeyboardModifier.ShiftModifier


def select(window: MainWindow, first: tuple[str, str], last: tuple[str, str]) -> None:
    """Select the cells from one address to another."""
    window.go_to(first)
    ends = QItemSelection(window.table.index_of(first), window.table.index_of(last))
    window.table_view.selectionModel().select(ends, QItemSelectionModel.SelectionFlag.ClearAndSelect)


def clip(text: str = "", html: str = "") -> None:
    """Put a text into the clipboard, as another program does."""
    data = QMimeData()
    data.setText(text)
    if html:
        data.setHtml(html)
    QGuiApplication.clipboard().setMimeData(data)


def of(file: ParameterFile, parameter: str, axes: str = "123") -> list[Value | None]:
    """Return the values of a parameter on some axes."""
    return [file.get((parameter, axis)) for axis in axes]


# -- selecting -------------------------------------------------------------------


def test_shift_and_arrows_select_a_range_and_the_status_bar_sums_it_up(window: MainWindow) -> None:
    window.go_to((EXCESS, "1"))
    for _ in range(2):
        QTest.keyClick(window.table_view, KEY.Key_Right, SHIFT)
    assert window.table_view.cells.addresses() == [(EXCESS, axis) for axis in "123"]
    assert window.page.address_text() == "3 cells of 1750 Excess Error, X to Z   min 11 mm   max 11 mm"


def test_the_sum_in_the_status_bar_follows_an_undo(window: MainWindow) -> None:
    select(window, (EXCESS, "1"), (EXCESS, "3"))
    before = window.status.value.text()
    window.workspace.edit("more", {(EXCESS, "1"): Value(77.0, "mm")})
    assert "max 77 mm" in window.status.value.text()
    window.workspace.undo_stack.undo()
    assert window.status.value.text() == before


def test_keys_pass_over_what_does_not_exist(window: MainWindow) -> None:
    """The feedback ports of the first axes have no analog voltage, which only the spindle has."""
    window.go_to((EXCESS, "1"))
    voltage = window.table.index_of(("servo.analog_positive_voltage", "5"))
    assert not window.table.index(voltage.row(), 0).flags() & Qt.ItemFlag.ItemIsEnabled
    window.table_view.setCurrentIndex(window.table.index(voltage.row() - 1, 0))
    QTest.keyClick(window.table_view, KEY.Key_Down)
    assert window.table_view.currentIndex() == window.table.index(voltage.row() - 1, 0)
    window.table_view.setCurrentIndex(voltage)
    QTest.keyClick(window.table_view, KEY.Key_Left)
    assert window.table_view.currentIndex() == voltage


def test_ctrl_a_selects_all_values(window: MainWindow) -> None:
    window.go_to((EXCESS, "1"))
    QTest.keyClick(window.table_view, KEY.Key_A, Qt.KeyboardModifier.ControlModifier)
    assert len(window.table_view.cells.block()) == window.table.count


def test_tab_leaves_the_table_behind_its_last_cell(window: MainWindow) -> None:
    view, table = window.table_view, window.table
    last = max(
        (r, c)
        for r in range(table.rowCount())
        for c in range(len(table.columns))
        if view.cells.existing(r, c)
    )
    view.setFocus()
    view.setCurrentIndex(table.index(*last))
    QTest.keyClick(view, KEY.Key_Tab)
    assert view.currentIndex() == table.index(*last)
    assert not view.hasFocus()


# -- copying -----------------------------------------------------------------------


def test_a_block_is_copied_plain_and_exact_with_units(window: MainWindow) -> None:
    select(window, (EXCESS, "1"), (SUPPRESSION, "2"))
    window.edits.range.copy()
    data = QGuiApplication.clipboard().mimeData()
    assert data.text() == "11 mm\t11 mm\n11 mm\t11 mm"
    assert data.html().count("<td") == 4
    select(window, ("servo.position_counts", "1"), ("servo.position_counts", "1"))
    window.edits.range.copy()
    assert "\u202f" not in QGuiApplication.clipboard().text(), "groups of digits are for the screen"


def test_one_number_without_a_unit_is_a_number_to_a_spreadsheet_of_any_language(window: MainWindow) -> None:
    """LibreOffice in German takes the text 2.5 for a text: seen with its real clipboard."""
    window.edits.commit(("servo.initial_gain", "1"), "2.5")
    for address, is_number in ((("servo.initial_gain", "1"), True), ((EXCESS, "1"), False)):
        select(window, address, address)
        window.edits.range.copy()
        data = QGuiApplication.clipboard().mimeData()
        assert ('sdval="2.5"' in data.html()) is is_number
    assert (data.text(), data.hasHtml()) == ("11 mm", False)


def test_names_go_along_when_asked_for_and_lead_back_to_their_rows(
    window: MainWindow, file: ParameterFile, accept
) -> None:
    select(window, (EXCESS, "1"), (BREAK, "2"))
    window.edits.range.copy_with_names()
    text = QGuiApplication.clipboard().text()
    lines = [line.split("\t") for line in text.split("\n")]
    assert lines[0] == ["No.", "Parameter", "X 1 linear", "Y 2 linear"]
    assert ["1750", "Excess Error", "11 mm", "11 mm"] in lines

    clip(
        "\n".join(
            "\t".join(line)
            for line in [
                ["No.", "Parameter", "X 7 linear"],
                ["1750", "Excess Error", "9 mm"],
                ["1", "Gone", "1"],
            ]
        )
    )
    window.go_to(("servo.position_loop_type", "1"))
    displayed: list[str] = []
    accept(BlockPreview, lambda dialog: displayed.extend([dialog.summary.text()]))
    window.edits.range.paste()
    assert displayed == ["1 cell: 1 changes, 0 the same, 0 refused"]
    assert of(file, EXCESS) == [Value(9.0, "mm"), Value(11.0, "mm"), Value(11.0, "mm")]


# -- pasting -----------------------------------------------------------------------


def test_a_block_is_shown_before_it_changes_anything_and_refused_cells_stay(
    window: MainWindow, file: ParameterFile, accept
) -> None:
    window.go_to((SUPPRESSION, "1"))
    clip("12 mm\t0.433 in\t99999\n")
    seen: list[object] = []

    def look(dialog: BlockPreview) -> None:
        seen.append(dialog.summary.text())
        seen.extend(dialog.list.topLevelItem(n).text(2) for n in range(dialog.list.topLevelItemCount()))
        assert of(file, SUPPRESSION) == [Value(11.0, "mm")] * 3

    accept(BlockPreview, look)
    window.edits.range.paste()

    assert seen[0] == "3 cells: 2 change, 0 the same, 1 refused"
    assert "is outside" in seen[1]
    assert seen[2:] == ["12 mm", "0.433 in"]
    assert of(file, SUPPRESSION) == [Value(12.0, "mm"), Value(0.433, "in"), Value(11.0, "mm")]
    window.workspace.undo_stack.undo()
    assert of(file, SUPPRESSION) == [Value(11.0, "mm")] * 3


def test_one_cell_fills_the_selected_range_and_a_block_repeats(
    window: MainWindow, file: ParameterFile, accept
) -> None:
    accept(BlockPreview)
    select(window, (EXCESS, "1"), (EXCESS, "3"))
    clip("8")
    window.edits.range.paste()
    assert of(file, EXCESS) == [Value(8.0, "mm")] * 3
    select(window, (EXCESS, "1"), (EXCESS, "2"))
    clip("7\t6")
    window.edits.range.paste()
    assert of(file, EXCESS) == [Value(7.0, "mm"), Value(6.0, "mm"), Value(8.0, "mm")]


def test_what_a_spreadsheet_shows_is_not_guessed(window: MainWindow, file: ParameterFile, accept) -> None:
    """1.234 beside 0,5 may be a thousand, and a date is no difference of three numbers."""
    seen: list[str] = []

    def look(dialog: BlockPreview) -> None:
        seen.extend(dialog.list.topLevelItem(n).text(2) for n in range(dialog.list.topLevelItemCount()))

    accept(BlockPreview, look)
    window.go_to((EXCESS, "1"))
    clip("0,5\t1.234\t2026-10-06")
    window.edits.range.paste()
    assert "two ways" in seen[0]
    assert "'-10-06' is not a unit" in seen[1]
    assert of(file, EXCESS) == [Value(0.5, "mm"), Value(11.0, "mm"), Value(11.0, "mm")]


def test_the_number_of_a_sheet_counts_and_not_how_it_is_shown(
    window: MainWindow, file: ParameterFile, accept
) -> None:
    accept(BlockPreview)
    window.go_to((EXCESS, "1"))
    clip("0,43\t11,3 mm", '<table><tr><td sdval="0.433">0,43</td><td sdval="11.25">11,3 mm</td></tr></table>')
    window.edits.range.paste()
    assert of(file, EXCESS) == [Value(0.433, "mm"), Value(11.25, "mm"), Value(11.0, "mm")]


def test_a_single_cell_is_pasted_at_once_and_its_refusal_is_no_box(
    window: MainWindow, file: ParameterFile
) -> None:
    window.go_to((EXCESS, "1"))
    clip("9 mm")
    window.edits.range.paste()
    assert file.get((EXCESS, "1")) == Value(9.0, "mm")
    clip("99999")
    window.edits.range.paste()
    assert "is outside" in window.page.bar.text.text()
    assert file.get((EXCESS, "1")) == Value(9.0, "mm")


def test_cells_beyond_the_table_are_counted(window: MainWindow, accept) -> None:
    notes: list[str] = []
    accept(BlockPreview, lambda dialog: notes.append(dialog.layout().itemAt(1).widget().text()))
    window.go_to((EXCESS, "5"))
    clip("1 deg\t2\t3")
    window.edits.range.paste()
    assert notes == ["2 cells are beyond the table."]


# -- filling -----------------------------------------------------------------------


def test_a_value_is_filled_across_axes_and_down(window: MainWindow, file: ParameterFile) -> None:
    window.edits.commit((EXCESS, "1"), "9 mm")
    select(window, (EXCESS, "1"), (EXCESS, "3"))
    window.edits.range.fill_across()
    assert of(file, EXCESS) == [Value(9.0, "mm")] * 3
    assert window.workspace.undo_stack.undoText() == "Set 2 values of 2750 Excess Error"
    window.go_to((SUPPRESSION, "1"))
    assert window.table_view.currentIndex().row() == window.table.index_of((EXCESS, "1")).row() + 1
    window.edits.range.fill_down()
    assert file.get((SUPPRESSION, "1")) == Value(9.0, "mm"), "a single cell gets the one above"


def test_a_fill_that_one_axis_refuses_changes_none(window: MainWindow, file: ParameterFile) -> None:
    """The fourth axis turns: it takes no millimetres."""
    window.edits.commit((EXCESS, "1"), "9 mm")
    before = dict(file.values)
    select(window, (EXCESS, "1"), (EXCESS, "4"))
    window.edits.range.fill_across()
    assert file.values == before
    assert "Excess Error is given in °, not in mm" in window.page.bar.text.text()


def test_ctrl_enter_fills_the_range_with_what_is_typed(window: MainWindow, file: ParameterFile) -> None:
    select(window, (EXCESS, "1"), (EXCESS, "3"))
    QTest.keyClick(window.table_view, KEY.Key_8)
    QTest.keyClick(editor(window), KEY.Key_Return, Qt.KeyboardModifier.ControlModifier)
    assert of(file, EXCESS) == [Value(8.0, "mm")] * 3
    assert window.workspace.undo_stack.count() == 1


def test_the_fill_handle_is_dragged(window: MainWindow, file: ParameterFile) -> None:
    window.edits.commit((EXCESS, "1"), "9 mm")
    window.go_to((EXCESS, "1"))
    view, port = window.table_view, window.table_view.viewport()
    start = view._handle().center()
    end = view.visualRect(window.table.index_of((EXCESS, "3"))).center()
    QTest.mousePress(port, Qt.MouseButton.LeftButton, pos=start)
    for point in (QPoint((start.x() + end.x()) // 2, start.y()), end):
        QTest.mouseMove(port, point)
    QTest.mouseRelease(port, Qt.MouseButton.LeftButton, pos=end)
    assert of(file, EXCESS) == [Value(9.0, "mm")] * 3


# -- default and not set -------------------------------------------------------------


def test_a_changed_value_names_the_saved_one_under_the_pointer_and_goes_back_to_it(
    window: MainWindow,
) -> None:
    excess = ("servo.excess_error", "1")
    saved = window.workspace.file.get(excess)
    window.edits.commit(excess, "12 mm")
    window.go_to(excess)
    assert "Saved: 11 mm (Ctrl+Shift+Backspace goes back)" in window.table.values.tip(excess)
    action(window, "Back to What Was Saved").trigger()
    assert window.workspace.file.get(excess) == saved
    assert "Saved:" not in window.table.values.tip(excess)


def test_several_values_go_to_default_and_to_not_set_in_one_step(
    window: MainWindow, file: ParameterFile
) -> None:
    select(window, (EXCESS, "1"), (EXCESS, "3"))
    action(window, "Back to Default").trigger()
    assert of(file, EXCESS) == [file.default((EXCESS, axis)) for axis in "123"]
    action(window, "Clear (Not Set)").trigger()
    assert of(file, EXCESS) == [None] * 3
    assert window.workspace.undo_stack.count() == 2


def test_the_list_of_steps_is_in_words_and_leads_back(window: MainWindow, file: ParameterFile) -> None:
    window.edits.commit((EXCESS, "1"), "9 mm")
    window.edits.commit((EXCESS, "1"), "=Y*2")
    window.edits.steps()
    from amp_studio.ui.page.step_list import StepList

    steps = window.findChild(StepList)
    stack = window.workspace.undo_stack
    assert [stack.text(n) for n in range(2)] == [
        "Set 1750 Excess Error, X to 9 mm",
        "Set 1750 Excess Error, X to 22 mm (Y*2)",
    ]
    steps.view.setCurrentIndex(steps.view.model().index(1, 0))
    assert file.get((EXCESS, "1")) == Value(9.0, "mm")
    steps.close()


@pytest.mark.parametrize("key", ["Ctrl+D", "Ctrl+R", "Ctrl+Backspace"])
def test_each_key_belongs_to_one_command(window: MainWindow, key: str) -> None:
    from amp_studio.ui.base.menu_commands import commands

    found = [name for name, act in commands(window.menuBar()) if act.shortcut().toString() == key]
    assert len(found) == 1


# -- notes -----------------------------------------------------------------------------


def test_a_note_is_marked_in_its_cell_shown_in_its_tip_and_undone(
    window: MainWindow, file: ParameterFile, accept
) -> None:
    window.go_to((EXCESS, "1"))
    accept(NoteDialog, lambda dialog: dialog.form.set_answer("note", "long spindle"))
    window.edits.edit_notes()
    index = window.table.index_of((EXCESS, "1"))
    assert value_note(file, (EXCESS, "1")) == "long spindle"
    assert window.table.look(index.row(), index.column()).has_note
    assert "Note: long spindle" in index.data(Qt.ItemDataRole.ToolTipRole)
    assert window.workspace.is_dirty
    assert window.workspace.undo_stack.undoText() == "Note about 1750 Excess Error, X"
    window.workspace.undo_stack.undo()
    assert value_note(file, (EXCESS, "1")) == ""
    assert not window.workspace.is_dirty


def test_notes_are_in_the_parameter_panel(window: MainWindow, file: ParameterFile) -> None:
    window.go_to((EXCESS, "1"))
    window.workspace.do("note", lambda: set_value_note(file, (EXCESS, "1"), "long <spindle>"))
    assert "long <spindle>" in window.detail.page.toPlainText()


# -- masks -----------------------------------------------------------------------------


def test_the_bits_of_a_word_are_checked_below_its_cell(window_with) -> None:
    window = window_with("num-1060-mill")
    file = window.workspace.file
    address = file.find("P2N0")
    window.go_to(address)
    index = window.table.index_of(address)
    assert window.table.look(index.row(), index.column()).text == "Axis 0, Axis 1, Axis 2, Axis 3"
    assert window.table.look(index.row(), index.column()).unit == "0xF"

    QTest.keyClick(window.table_view, KEY.Key_F2)
    field = editor(window)
    for key in (KEY.Key_Down, KEY.Key_Down, KEY.Key_Space):
        QTest.keyClick(field, key)
    assert field.text() == "0x0000000D"
    field.selectAll()
    QTest.keyClicks(field, "0x3")
    checked = [
        n
        for n in range(field.bits.list.count())
        if field.bits.list.item(n).checkState() == Qt.CheckState.Checked
    ]
    assert checked == [0, 1], "what is typed is shown in the list"
    QTest.keyClick(field, KEY.Key_Escape)
    assert file.get(address) == Value(0xF)


def test_what_was_copied_and_is_pasted_back_changes_nothing_in_any_unit_system(
    window: MainWindow, file: ParameterFile, accept
) -> None:
    seen: list[str] = []
    accept(BlockPreview, lambda dialog: seen.append(dialog.summary.text()))
    before = dict(file.values)
    window.table.show_parameters(list(file.schema.parameters.values()))
    for system in ("inch", "metric"):
        window.workspace.show_in(system)
        window.table_view.selectAll()
        window.edits.range.copy()
        window.edits.range.paste()
    assert [text.partition(": ")[2].split(",")[0] for text in seen] == ["0 change", "0 change"]
    assert all(text.endswith("0 refused") for text in seen)
    assert file.values == before
