"""Two or three sources in one window: rows by group, sides taken, conflicts settled, the result in the file as one step."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QAccessible, QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLineEdit, QMenu
from pytestqt.qtbot import QtBot

from amp_studio.files import Document, backup_path, content_of, new_file, open_file
from amp_studio.schema import Address, Value
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.merge_model import AXIS, BASE, NAME, RESULT, A, B
from amp_studio.ui.merge_sources import MergeSource
from amp_studio.ui.merge_window import MergeWindow

from .conftest import WAIT_MS, Person, action, on_disk
from .test_accessible import nameless

EXCESS = ("servo.excess_error", "1")
CALIBRATION = ("home.calibration", "1")
RAPID = ("feedrate.rapid", "1")


@pytest.fixture
def shown(window: MainWindow) -> MergeWindow:
    """Return the comparison of the open mill with itself."""
    return window.files.comparing.open(window.page)


@pytest.fixture
def three(window: MainWindow, shown: MergeWindow) -> MergeWindow:
    """Return a comparison of three: one conflict, one change of the file, one of the other side."""
    base, other = window.workspace.file.copy(), window.workspace.file.copy()
    window.workspace.edit("mine", {EXCESS: Value(12.0, "mm"), CALIBRATION: Value(1.0, "mm")})
    other.set(EXCESS, Value(13.0, "mm"))
    other.set(RAPID, Value(190.0, "mm/s"))
    now = shown.sources.now()
    shown.show_merge({A: now, B: MergeSource("CNC_1", "", other), BASE: MergeSource("Last saved", "", base)})
    return shown


def show(shown: MergeWindow, address: Address) -> None:
    """Make the row of a parameter the current one."""
    row = next(r for r in shown.merge.rows if r.id.part == "value" and r.address == address)
    shown.tree.show_row(row)
    assert shown.tree.row() is row


def press(shown: MergeWindow, key: str | Qt.Key) -> None:
    """Press a key in the tree."""
    shown.tree.setFocus()
    QTest.keyClick(shown.tree, key)


def click(shown: MergeWindow, address: Address, column: int) -> None:
    """Click on the cell of a parameter."""
    show(shown, address)
    index = shown.tree.currentIndex().siblingAtColumn(column)
    place = shown.tree.visualRect(index)
    QTest.mouseClick(
        shown.tree.viewport(),
        Qt.MouseButton.LeftButton,
        pos=place.topLeft() + QPoint(16, place.height() // 2),
    )


def choose(shown: MergeWindow, column: int, *path: str) -> None:
    """Choose a source in the menu over a column."""
    menu: QMenu | None = shown.head.buttons[column].menu()
    shown.head.buttons[column].fill()
    for name in path:
        assert menu is not None
        found = [a for a in menu.actions() if a.text().replace("&", "") == name]
        assert len(found) == 1, [a.text() for a in menu.actions()]
        menu = found[0].menu()
        if menu is None:
            found[0].trigger()


def is_read(shown: MergeWindow) -> Callable[[], bool]:
    """Return a question: is nothing being read any more."""
    return lambda: not shown._reading  # nothing outside shows the end of what is quick


def merge(shown: MergeWindow, qtbot: QtBot) -> None:
    """Click on Merge as soon as the result has been checked."""
    qtbot.waitUntil(shown.outcome.merge.isEnabled, timeout=WAIT_MS)
    shown.outcome.merge.click()


def result(shown: MergeWindow, address: Address) -> Value | None:
    """Return a value of the result."""
    return shown.merge.result().get(address)


# -- what is shown -----------------------------------------------------------------------------------------------


def test_rows_have_every_source_in_one_unit_and_the_result(three: MergeWindow) -> None:
    rows = {row.address: row for row in three.merge.differing}
    texts = [three.model.text(rows[RAPID], column) for column in range(RESULT + 1)]
    assert texts[AXIS] == "X"
    assert texts[B] == texts[RESULT] == "11\u202f400 mm/min"
    assert texts[NAME].endswith("Rapid Feedrate for Positioning")
    assert three.model.text(rows[EXCESS], RESULT) == "Both changed: choose"
    assert three.head.counts == f"3 differ, {three.merge.same} the same"


def test_a_mask_is_shown_by_its_names_and_typed_as_its_number(shown: MergeWindow) -> None:
    file = new_file("num")
    address, mask = next(
        (a, v) for a, v in file.values.items() if file.schema.parameters[a[0]].bits and v.value
    )
    other = file.copy()
    other.set(address, Value(int(mask.value) ^ 1))
    shown.show_merge({A: MergeSource("a", "", file), B: MergeSource("b", "", other)})
    (row,) = shown.merge.differing
    assert shown.model.cell(row, A).unit == f"0x{mask.value:X}"
    assert shown.model.read(row, shown.model.text_to_edit(row)).value == mask


def test_figures_change_their_unit_for_all_sources(three: MergeWindow) -> None:
    row = next(row for row in three.merge.differing if row.address == EXCESS)
    QTest.keyClick(three, Qt.Key.Key_M, Qt.KeyboardModifier.ControlModifier)
    assert three.model.text(row, A) == "0.472440945 in"


def test_only_differences_are_shown_until_all_are_asked_for_and_a_filter_finds_by_name_and_number(
    three: MergeWindow,
) -> None:
    def count() -> int:
        return sum(len(group.rows) for group in three.model.groups)

    assert count() == 3
    three.view.search.setText("excess 1750")
    assert [row.address for group in three.model.groups for row in group.rows] == [EXCESS]
    three.view.search.clear()
    three.view.only_conflicts.click()
    assert count() == 1
    three.view.only_conflicts.click()
    three.view.only_differences.click()
    assert count() == len(three.merge.rows)


def test_a_row_leads_to_its_value_in_the_table(three: MergeWindow, window: MainWindow) -> None:
    show(three, EXCESS)
    press(three, Qt.Key.Key_Return)
    assert window.selected() == EXCESS


# -- choosing ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("key", "value"), [("0", 11.0), ("a", 12.0), ("b", 13.0)])
def test_a_key_takes_a_source(three: MergeWindow, key: str, value: float) -> None:
    show(three, EXCESS)
    press(three, key)
    assert (result(three, EXCESS), three.merge.open_conflicts) == (Value(value, "mm"), [])
    press(three, Qt.Key.Key_Backspace)
    assert len(three.merge.open_conflicts) == 1


def test_a_click_takes_a_side_for_a_row_and_for_a_group(three: MergeWindow) -> None:
    click(three, EXCESS, B)
    assert result(three, EXCESS) == Value(13.0, "mm")
    show(three, CALIBRATION)
    head = three.tree.currentIndex().parent().siblingAtColumn(B)
    place = three.tree.visualRect(head)
    QTest.mouseClick(three.tree.viewport(), Qt.MouseButton.LeftButton, pos=place.center())
    assert result(three, CALIBRATION) == Value(0.0, "mm")


def test_all_that_is_selected_is_taken_at_once(three: MergeWindow) -> None:
    three.tree.setFocus()
    three.tree.selectAll()
    press(three, "b")
    values = [result(three, address) for address in (EXCESS, CALIBRATION, RAPID)]
    assert values == [Value(13.0, "mm"), Value(0.0, "mm"), Value(190.0, "mm/s")]


def test_keys_go_to_the_next_difference_and_to_the_next_conflict(three: MergeWindow) -> None:
    show(three, CALIBRATION)
    press(three, "c")
    assert three.tree.row().address == EXCESS
    seen = set()
    for _ in range(3):
        three.view.next.click()
        seen.add(three.tree.row().address)
    assert seen == {EXCESS, CALIBRATION, RAPID}


def test_a_value_is_typed_into_the_result_and_a_wrong_one_keeps_the_editor_open(three: MergeWindow) -> None:
    show(three, EXCESS)
    press(three, Qt.Key.Key_F2)
    field = three.tree.findChild(QLineEdit)
    assert field.text() == "12 mm"
    QTest.keyClicks(field, "999999")
    QTest.keyClick(field, Qt.Key.Key_Return)
    assert three.tree.findChild(QLineEdit) is field
    assert "214.1" in field.accessibleDescription()
    field.selectAll()
    QTest.keyClicks(field, "0.5 in")
    QTest.keyClick(field, Qt.Key.Key_Return)
    assert result(three, EXCESS) == Value(0.5, "in")
    row = next(row for row in three.merge.differing if row.address == EXCESS)
    assert three.model.text(row, RESULT) == "12.7 mm"


def test_below_the_tree_each_choice_has_its_value_and_its_findings(three: MergeWindow, qtbot) -> None:
    show(three, EXCESS)
    qtbot.waitUntil(lambda: three.check.is_ready, timeout=WAIT_MS)
    detail = three.detail
    assert [detail.values[key].text() for key in ("base", "a", "b")] == ["11 mm", "12 mm", "13 mm"]
    assert detail.notes["a"].text()
    detail.buttons["b"].click()
    assert result(three, EXCESS) == Value(13.0, "mm")
    detail.other.setText("14")
    detail.other.returnPressed.emit()
    assert result(three, EXCESS) == Value(14.0, "mm")
    detail.other.setText("-1 kg")
    detail.other.returnPressed.emit()
    assert "not a unit" in detail.notes["typed"].text()


def test_swapped_sides_keep_what_was_taken(three: MergeWindow) -> None:
    show(three, EXCESS)
    press(three, "b")
    three.view.swap.click()
    assert (three.chosen[A].title, result(three, EXCESS)) == ("CNC_1", Value(13.0, "mm"))
    assert three.merge.open_conflicts == []


def test_swapped_sources_without_a_base_take_nothing_that_was_not_chosen(
    shown: MergeWindow, window: MainWindow
) -> None:
    other = shown.merge.a.copy()
    other.set(EXCESS, Value(3.0, "mm"))
    shown.use(B, MergeSource("other.amp", "", other))
    shown.view.swap.click()
    assert result(shown, EXCESS) == Value(11.0, "mm")
    assert shown.outcome.merge.toolTip() == "Nothing has been taken yet."
    show(shown, EXCESS)
    press(shown, "a")
    assert result(shown, EXCESS) == Value(3.0, "mm")


def test_the_result_shows_the_figure_in_degrees_of_an_axis_that_begins_to_turn(shown: MergeWindow) -> None:
    other = shown.merge.a.copy()
    other.set_many({("axis.type", "1"): Value("rotary")})
    shown.use(B, MergeSource("other.amp", "", other))
    row = next(row for row in shown.merge.differing if row.address == EXCESS)
    show(shown, ("axis.type", "1"))
    press(shown, "b")
    assert shown.merge.result_of(row) == Value(11.0, "mm")
    assert (shown.model.text(row, RESULT), shown.model.is_refitted(row)) == ("11°", True)
    press(shown, Qt.Key.Key_Backspace)
    assert (shown.model.text(row, RESULT), shown.model.is_refitted(row)) == ("11 mm", False)


def test_rows_are_copied_as_a_spreadsheet_takes_them(three: MergeWindow) -> None:
    show(three, EXCESS)
    press(three, "b")
    QTest.keyClick(three.tree, Qt.Key.Key_C, Qt.KeyboardModifier.ControlModifier)
    assert QGuiApplication.clipboard().text() == "1750 Excess Error\tX\t11 mm\t12 mm\t13 mm\t13 mm"


# -- the result --------------------------------------------------------------------------------------------------


def test_the_result_goes_into_the_file_as_one_step_once_no_conflict_is_left(
    three: MergeWindow, window: MainWindow, qtbot
) -> None:
    file = window.workspace.file
    assert not three.outcome.merge.isEnabled()
    show(three, EXCESS)
    press(three, "b")
    with qtbot.waitSignal(three.destroyed, timeout=WAIT_MS):
        merge(three, qtbot)
    assert [file.get(a) for a in (EXCESS, CALIBRATION, RAPID)] == [
        Value(13.0, "mm"), Value(1.0, "mm"), Value(190.0, "mm/s")
    ]  # fmt: skip
    assert "Merged with CNC_1" in window.page.bar.text.text()
    window.edits.undo.trigger()
    assert (file.get(EXCESS), file.get(RAPID)) == (Value(12.0, "mm"), Value(10000.0, "mm/min"))


def test_header_and_unknown_entries_come_along_and_go_back_with_one_undo(
    window: MainWindow, shown: MergeWindow, qtbot
) -> None:
    file = window.workspace.file
    before = content_of(file)
    other = file.copy()
    other.header.notes, other.unknown["future.thing"] = "new spindle", "7"
    shown.use(B, MergeSource("other.amp", "", other))
    shown.tree.selectAll()
    press(shown, "b")
    merge(shown, qtbot)
    assert (file.header.notes, file.unknown) == ("new spindle", {"future.thing": "7"})
    assert window.workspace.is_dirty
    assert window.save()
    assert on_disk(window.workspace.path).unknown == {"future.thing": "7"}
    window.edits.undo.trigger()
    assert content_of(file) == before


def test_new_errors_are_shown_before_the_file_gets_them(
    window: MainWindow, shown: MergeWindow, qtbot
) -> None:
    other = window.workspace.file.copy()
    other.values[EXCESS] = Value(0.5, "mm")
    shown.use(B, MergeSource("other.amp", "", other))
    show(shown, EXCESS)
    press(shown, "b")
    qtbot.waitUntil(shown.outcome.found.isEnabled, timeout=WAIT_MS)
    assert "1 new error" in shown.outcome.found.text()
    shown.outcome.merge.click()
    assert shown.findings.isVisible()
    assert window.workspace.file.get(EXCESS) == Value(11.0, "mm"), "nothing has been changed yet"
    assert "Anyway" in shown.outcome.merge.text()
    shown.outcome.merge.click()
    assert window.workspace.file.get(EXCESS) == Value(0.5, "mm")


def test_a_result_that_cannot_be_checked_is_not_merged(shown: MergeWindow, monkeypatch, qtbot) -> None:
    def fail(*_: object) -> None:
        raise ValueError("no such rule")

    monkeypatch.setattr("amp_studio.ui.merge_check.ResultCheck", fail)
    other = shown.merge.a.copy()
    other.set(EXCESS, Value(12.0, "mm"))
    shown.use(B, MergeSource("other.amp", "", other))
    shown.model.choose(shown.merge.differing, "b")
    qtbot.waitUntil(shown.message.isVisible, timeout=WAIT_MS)
    assert shown.message.text.text() == "The result cannot be checked, and so not merged: no such rule"
    assert not shown.outcome.merge.isEnabled()


def test_the_result_is_saved_as_a_new_file_and_the_open_one_stays(
    three: MergeWindow, window: MainWindow, person: Person, tmp_path: Path
) -> None:
    show(three, EXCESS)
    press(three, "b")
    mine = window.workspace
    mine.path.write_text(mine.path.read_text().replace("\nvalues:", "\n# by J. Doe\nvalues:", 1))
    person.chooses(tmp_path / "merged.amp")
    three.outcome.save.click()
    merged = on_disk(tmp_path / "merged.amp")
    assert (merged.get(EXCESS), merged.get(CALIBRATION)) == (Value(13.0, "mm"), Value(1.0, "mm"))
    assert "# by J. Doe" in (tmp_path / "merged.amp").read_text(), "remarks stay"
    assert mine.file.get(EXCESS) == Value(12.0, "mm")


def test_the_comparison_is_written_as_a_report(three: MergeWindow, person: Person, tmp_path: Path) -> None:
    person.chooses(tmp_path / "comparison.csv")
    three.outcome.report.click()
    written = (tmp_path / "comparison.csv").read_text("utf-8-sig")
    assert "not settled" in written
    assert "Rapid Feedrate for Positioning" in written
    assert three.message.text.text() == "comparison.csv written."


def test_a_lathe_is_compared_with_a_mill_and_what_exists_there_only_is_named(
    shown: MergeWindow, window: MainWindow, checkout: Path
) -> None:
    lathe = open_file(checkout / "examples" / "lathe-ls176" / "LATHE_LS176.amp").file
    source = shown.sources.other(window.workspace.file, lathe, "LATHE_LS176.amp", "")
    shown.use(B, source)
    assert "another machine type (lathe)" in shown.message.text.text()
    shown.view.only_differences.click()
    only_there = [r for r in shown.merge.differing if r.id.part == "value" and not shown.model.may_type(r)]
    assert only_there
    for row in shown.merge.rows:
        assert all(shown.model.text(row, column) is not None for column in range(RESULT + 1))
    shown.view.only_active.click()
    shown.tree.show_row(only_there[0])
    shown.view.only_active.click()
    shown.tree.show_row(only_there[0])
    assert "not on this machine type" in shown.detail.facts.text()


def test_a_group_that_was_folded_stays_folded(three: MergeWindow, window: MainWindow, qtbot) -> None:
    head = three.model.index(0, NAME)
    three.tree.setExpanded(head, False)
    window.edits.commit(("home.calibration", "2"), "1 mm")
    qtbot.waitUntil(lambda: len(three.merge.differing) == 4, timeout=WAIT_MS)
    folds = [three.tree.isExpanded(three.model.index(n, NAME)) for n in range(len(three.model.groups))]
    assert folds == [False, *[True] * (len(folds) - 1)]


def test_the_machine_type_and_entries_of_others_are_taken_and_not_typed(shown: MergeWindow) -> None:
    other = shown.merge.a.copy()
    other.header.notes, other.header.extra, other.unknown["future.thing"] = "n", {"bay": 7}, "1"
    shown.use(B, MergeSource("other.amp", "", other))
    can = {row.id.key: shown.model.may_type(row) for row in shown.merge.differing}
    assert can == {"notes": True, "extra.bay": False, "future.thing": False}


def test_two_sources_of_which_none_is_the_open_file_are_not_merged_into_it(shown: MergeWindow) -> None:
    other = shown.merge.a.copy()
    other.set(EXCESS, Value(3.0, "mm"))
    shown.show_merge({A: MergeSource("one.amp", "", other), B: MergeSource("two.amp", "", shown.merge.b)})
    assert not shown.outcome.merge.isEnabled()
    assert "Neither A nor B is the open file" in shown.outcome.merge.toolTip()
    assert shown.outcome.save.isEnabled()


def test_the_comparison_follows_an_edit_of_the_file_and_keeps_what_was_chosen(
    three: MergeWindow, window: MainWindow, qtbot
) -> None:
    show(three, EXCESS)
    press(three, "b")
    window.edits.commit(("home.calibration", "2"), "1 mm")
    qtbot.waitUntil(lambda: len(three.merge.differing) == 4, timeout=WAIT_MS)
    assert result(three, EXCESS) == Value(13.0, "mm")
    assert three.tree.row().address == EXCESS


def test_an_edit_just_before_merge_is_not_overwritten(three: MergeWindow, window: MainWindow, qtbot) -> None:
    show(three, EXCESS)
    press(three, "b")
    qtbot.waitUntil(three.outcome.merge.isEnabled, timeout=WAIT_MS)
    window.workspace.edit("just now", {CALIBRATION: Value(5.0, "mm")})
    three.outcome.merge.click()
    assert window.workspace.file.get(EXCESS) == Value(12.0, "mm"), "what is shown is not what would be merged"
    merge(three, qtbot)
    file = window.workspace.file
    assert (file.get(EXCESS), file.get(CALIBRATION)) == (Value(13.0, "mm"), Value(5.0, "mm"))


def test_without_a_base_there_are_no_conflicts_to_show(three: MergeWindow) -> None:
    three.view.only_conflicts.click()
    three.view.two.click()
    assert not three.view.only_conflicts.isChecked()
    assert len(three.model.groups) == len({three.merge.group_title(row) for row in three.merge.differing})
    three.view.three.click()
    assert three.chosen[BASE].title == "Last saved"


def test_it_closes_with_escape_and_with_its_file(shown: MergeWindow, window: MainWindow, qtbot) -> None:
    again = window.files.comparing.open(window.page)
    with qtbot.waitSignal(again.destroyed, timeout=WAIT_MS):
        QTest.keyClick(again, Qt.Key.Key_Escape)
    with qtbot.waitSignal(shown.destroyed, timeout=WAIT_MS):
        window.files.close()


# -- sources -----------------------------------------------------------------------------------------------------


def test_another_file_is_chosen_and_its_axes_are_matched_by_letter(
    shown: MergeWindow, window: MainWindow, person: Person, path: Path, qtbot
) -> None:
    file = new_file("9pc", "mill", ["Y", "X"])
    other = path.with_name("other.amp")
    Document.create(file, other).close()
    person.chooses(other)
    choose(shown, B, "Another File…")
    qtbot.waitUntil(is_read(shown), timeout=WAIT_MS)
    assert shown.chosen[B].title == "other.amp"
    assert "Axis Y is axis 1 in other.amp; it is compared with axis 2 here." in shown.message.text.text()


def test_a_file_of_another_family_is_refused_in_one_sentence(
    shown: MergeWindow, person: Person, path: Path, qtbot
) -> None:
    other = path.with_name("other.amp")
    Document.create(new_file("num"), other).close()
    person.chooses(other)
    choose(shown, B, "Another File…")
    qtbot.waitUntil(is_read(shown), timeout=WAIT_MS)
    assert "only files of one family can be compared" in shown.message.text.text()
    assert shown.chosen[B].is_now


@pytest.mark.parametrize(
    ("names", "excess"),
    [(["As Last Saved"], 5.0), (["As Opened"], 11.0), (["On Disk"], 5.0), (["Backup"], 11.0), (["Default Values"], 203.2)],
)  # fmt: skip
def test_versions_of_the_file_are_sources(
    window: MainWindow, shown: MergeWindow, names: list[str], excess: float, qtbot
) -> None:
    window.edits.commit(EXCESS, "5 mm")
    assert window.save()
    window.edits.commit(EXCESS, "6 mm")
    choose(shown, B, *names)
    qtbot.waitUntil(is_read(shown), timeout=WAIT_MS)
    assert shown.merge.b.get(EXCESS) == Value(excess, "mm")


def test_an_earlier_save_is_a_source(window: MainWindow, shown: MergeWindow, qtbot) -> None:
    window.edits.commit(EXCESS, "5 mm")
    assert window.save()
    shown.head.buttons[B].fill()
    (earlier,) = (a for a in shown.head.buttons[B].menu().actions() if a.text() == "&Earlier Saves")
    earlier.menu().actions()[0].trigger()
    qtbot.waitUntil(is_read(shown), timeout=WAIT_MS)
    assert shown.merge.b.get(EXCESS) == Value(11.0, "mm")


def test_one_axis_is_compared_with_another(shown: MergeWindow, window: MainWindow, qtbot) -> None:
    window.edits.commit(EXCESS, "5 mm")
    choose(shown, B, "Another Axis", "In the Place of Axis X", "Axis Y")
    qtbot.waitUntil(is_read(shown), timeout=WAIT_MS)
    assert shown.merge.b.get(EXCESS) == window.workspace.file.get(("servo.excess_error", "2"))
    assert shown.chosen[B].title == "Axis Y"


def test_a_control_that_does_not_answer_can_be_cancelled_and_the_source_before_it_stays(
    shown: MergeWindow, qtbot
) -> None:
    def read(progress, cancel) -> MergeSource:
        assert cancel.wait(WAIT_MS / 1000)
        raise OSError("stopped")

    shown.read(B, read)
    qtbot.waitUntil(shown.reading.isVisible, timeout=WAIT_MS)
    shown.reading.cancel.click()
    qtbot.waitUntil(is_read(shown), timeout=WAIT_MS)
    assert not shown.reading.isVisible()
    assert (shown.chosen[B].is_now, shown.message.isVisible()) == (True, False)


def test_a_file_without_unsaved_work_is_compared_with_its_backup_first(window: MainWindow, qtbot) -> None:
    window.edits.commit(EXCESS, "5 mm")
    assert window.save()
    assert backup_path(window.workspace.path).is_file()
    action(window, "Compare and Merge With").trigger()
    shown = window.findChild(MergeWindow)
    qtbot.waitUntil(lambda: shown.chosen[B].title == "Backup", timeout=WAIT_MS)
    assert [row.address for row in shown.merge.differing] == [EXCESS]


def test_what_was_taken_from_a_source_is_not_taken_from_the_next_one(three: MergeWindow) -> None:
    show(three, EXCESS)
    press(three, "b")
    other = three.merge.b.copy()
    other.set(EXCESS, Value(2.0, "mm"))
    three.use(B, MergeSource("other.amp", "", other))
    assert [row.address for row in three.merge.open_conflicts] == [EXCESS]


def test_another_open_file_is_a_source(window: MainWindow, shown: MergeWindow, path: Path, qtbot) -> None:
    second = path.with_name("second.amp")
    file = open_file(path).file
    file.set(EXCESS, Value(3.0, "mm"))
    second.write_bytes(content_of(file))
    window.open_first(second)
    choose(shown, B, "second.amp")
    qtbot.waitUntil(is_read(shown), timeout=WAIT_MS)
    assert shown.merge.b.get(EXCESS) == Value(3.0, "mm")


# -- manners -----------------------------------------------------------------------------------------------------


def test_a_screen_reader_is_told_whose_value_it_is_and_whether_the_result_takes_it(
    three: MergeWindow,
) -> None:
    show(three, CALIBRATION)
    index = three.tree.currentIndex()
    said = [
        index.siblingAtColumn(column).data(Qt.ItemDataRole.AccessibleTextRole) for column in (A, B, RESULT)
    ]
    assert said == ["A: 1 mm, taken", "B: 0 mm", "Result: 1 mm"]
    for widget in (three.tree, three.view.search, three.head.buttons[A], three.findings, three.view.swap):
        assert QAccessible.queryAccessibleInterface(widget).text(QAccessible.Text.Name)


def test_every_part_of_the_window_has_a_name(three: MergeWindow) -> None:
    show(three, EXCESS)
    three.outcome.found.setChecked(True)
    assert nameless(three) == []


def test_tab_goes_from_the_filter_over_the_sources_to_the_rows_and_on_to_the_choices(
    three: MergeWindow,
) -> None:
    show(three, EXCESS)
    three.view.search.setFocus()
    seen = []
    for _ in range(12):
        QTest.keyClick(three.focusWidget(), Qt.Key.Key_Tab)
        seen.append(three.focusWidget())
    order = [three.view.next, three.head.buttons[A], three.tree, three.detail.other, three.outcome.report]
    assert [each for each in seen if each in order] == order
