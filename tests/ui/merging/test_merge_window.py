"""Two or three sources in one window: rows by group, sides taken, what a person sees and hears."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAccessible, QFont, QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLineEdit

from amp_studio.files import new_file
from amp_studio.schema import Value
from amp_studio.ui.base.theme import colour, scheme
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.merge.columns import AXIS, NAME, RESULT, A, B
from amp_studio.ui.merge.delegate import MergeDelegate
from amp_studio.ui.merge.sources import MergeSource
from amp_studio.ui.merge.window import MergeWindow
from tests.ui.conftest import WAIT_MS
from tests.ui.test_accessible import nameless

from .steps import CALIBRATION, EXCESS, RAPID, click, press, result, show

OPAQUE = 255


def test_rows_have_every_source_in_one_unit_and_the_result(three: MergeWindow) -> None:
    rows = {row.address: row for row in three.merge.differing}
    texts = [three.model.text(rows[RAPID], column) for column in range(RESULT + 1)]
    assert texts[AXIS] == "X"
    assert texts[B] == texts[RESULT] == "11\u202f400 mm/min"
    assert texts[NAME].endswith("Rapid Feedrate for Positioning")
    assert three.model.text(rows[EXCESS], RESULT) == "Both changed: choose"
    assert three.head.counts == f"3 differ, {three.merge.same} the same"


def test_a_mask_is_shown_by_its_names_and_typed_as_its_number(displayed: MergeWindow) -> None:
    file = new_file("num")
    address, mask = next(
        (a, v) for a, v in file.values.items() if file.schema.parameters[a[0]].bits and v.value
    )
    other = file.copy()
    other.set(address, Value(int(mask.value) ^ 1))
    displayed.show_merge({A: MergeSource("a", "", file), B: MergeSource("b", "", other)})
    (row,) = displayed.merge.differing
    assert displayed.model.cell(row, A).unit == f"0x{mask.value:X}"
    assert displayed.model.read(row, displayed.model.text_to_edit(row)).value == mask


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


def test_the_mark_of_the_conflicts_has_the_colours_of_a_theme_that_is_chosen_later(
    three: MergeWindow,
) -> None:
    mark, chosen = three.outcome.mark, scheme().choice

    def colours() -> set[str]:
        image = mark.pixmap().toImage()
        pixels = (image.pixelColor(x, y) for x in range(image.width()) for y in range(image.height()))
        return {pixel.name() for pixel in pixels if pixel.alpha() == OPAQUE}

    try:
        for theme in ("light", "dark"):
            scheme().choose(theme)
            assert colour("warn").name() in colours(), theme
    finally:
        scheme().choose(chosen)


def test_the_head_of_a_group_has_its_counts_where_there_is_little_room(three: MergeWindow) -> None:
    three.resize(1024, 700)
    painted: list[str] = []
    write = MergeDelegate._elided

    def noted(face: QFont, text: str, width: int) -> str:
        painted.append(write(face, text, width))
        return painted[-1]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(MergeDelegate, "_elided", staticmethod(noted))
        for column in range(three.tree.header().count()):
            three.tree.header().resizeSection(column, 110)
        three.tree.viewport().grab()
    assert "1 differs, 1 conflict" in painted
    assert "Position Loop Parameters" in painted


# -- choosing


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
    displayed: MergeWindow, window: MainWindow
) -> None:
    other = displayed.merge.a.copy()
    other.set(EXCESS, Value(3.0, "mm"))
    displayed.use(B, MergeSource("other.amp", "", other))
    displayed.view.swap.click()
    assert result(displayed, EXCESS) == Value(11.0, "mm")
    assert displayed.outcome.merge.toolTip() == "Nothing has been taken yet."
    show(displayed, EXCESS)
    press(displayed, "a")
    assert result(displayed, EXCESS) == Value(3.0, "mm")


def test_the_result_shows_the_figure_in_degrees_of_an_axis_that_begins_to_turn(
    displayed: MergeWindow,
) -> None:
    other = displayed.merge.a.copy()
    other.set_checked({("axis.type", "1"): Value("rotary")})
    displayed.use(B, MergeSource("other.amp", "", other))
    row = next(row for row in displayed.merge.differing if row.address == EXCESS)
    show(displayed, ("axis.type", "1"))
    press(displayed, "b")
    assert displayed.merge.result_of(row) == Value(11.0, "mm")
    assert (displayed.model.text(row, RESULT), displayed.model.is_refitted(row)) == ("11°", True)
    press(displayed, Qt.Key.Key_Backspace)
    assert (displayed.model.text(row, RESULT), displayed.model.is_refitted(row)) == ("11 mm", False)


def test_rows_are_copied_as_a_spreadsheet_takes_them(three: MergeWindow) -> None:
    show(three, EXCESS)
    press(three, "b")
    QTest.keyClick(three.tree, Qt.Key.Key_C, Qt.KeyboardModifier.ControlModifier)
    assert QGuiApplication.clipboard().text() == "1750 Excess Error\tX\t11 mm\t12 mm\t13 mm\t13 mm"


# -- manners


def test_a_screen_reader_is_reported_whose_value_it_is_and_whether_the_result_takes_it(
    three: MergeWindow,
) -> None:
    show(three, CALIBRATION)
    index = three.tree.currentIndex()
    message = [
        index.siblingAtColumn(column).data(Qt.ItemDataRole.AccessibleTextRole) for column in (A, B, RESULT)
    ]
    assert message == ["A: 1 mm, taken", "B: 0 mm", "Result: 1 mm"]
    for widget in (three.tree, three.view.search, three.head.buttons[A], three.findings, three.view.swap):
        assert QAccessible.queryAccessibleInterface(widget).text(QAccessible.Text.Name)


def test_every_part_of_the_window_has_a_name(three: MergeWindow) -> None:
    show(three, EXCESS)
    three.outcome.findings_button.setChecked(True)
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
