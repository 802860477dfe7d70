"""The table of differences with a control: numbers are seen, and neither side is beyond the edge."""

import pytest
from pytestqt.qtbot import QtBot

from amp_studio.files import compare, new_file
from amp_studio.schema import Value
from amp_studio.ui.control.conditions import ConditionLine, ControlCondition
from amp_studio.ui.control.differences import CONTROL, FILE, NAME, NUMBER, DifferenceTable


@pytest.mark.parametrize("width", [555, 960])
def test_both_sides_are_seen_and_numbers_are_not_below_the_branches(qtbot: QtBot, width: int) -> None:
    file, other = new_file("9pc", "mill", ["X", "Y"]), new_file("9pc", "mill", ["X", "Y"])
    file.set(("home.calibration", "1"), Value(1.5, "mm"))
    file.set(("servo.lead_screw_pitch", "1"), Value(5.0, "mm"))
    table = DifferenceTable()
    qtbot.addWidget(table)
    table.resize(width, 300)
    found = compare(file.schema, file.values, other.values).differences
    table.show_differences(file, found, to_control=True, secrets=False)
    table.show()
    rows = [table.topLevelItem(0).child(0), table.topLevelItem(1).child(0)]
    assert {row.text(NUMBER) for row in rows} == {"1300", "1590"}
    ends = table.columnViewportPosition(FILE) + table.columnWidth(FILE)
    assert ends < table.viewport().width()
    assert table.columnWidth(NUMBER) >= 2 * table.indentation() + 30
    assert min(table.columnWidth(column) for column in (NAME, CONTROL, FILE)) >= 96


def test_the_names_of_both_sides_are_read_whole_where_there_is_room(qtbot: QtBot) -> None:
    file, other = new_file("9pc", "mill", ["X"]), new_file("9pc", "mill", ["X"])
    file.set(("home.calibration", "1"), Value(1.5, "mm"))
    table = DifferenceTable()
    qtbot.addWidget(table)
    found = compare(file.schema, file.values, other.values).differences
    table.show_differences(file, found, to_control=True, secrets=False)
    table.show_sides("CNC_1 (192.168.100.20:44547)", "mill.amp")
    for width, is_whole in ((1400, True), (555, False)):
        table.resize(width, 300)
        table.show()
        assert (table.columnWidth(CONTROL) >= table.header().sectionSizeHint(CONTROL)) is is_whole
        assert table.columnWidth(CONTROL) == table.columnWidth(FILE)


def test_a_value_is_whole_while_the_last_column_has_room_to_spare(qtbot: QtBot) -> None:
    """``Belongs to no gro…`` was beside 900 pixels of white on a large screen."""
    file, other = new_file("9pc", "mill", ["X"]), new_file("9pc", "mill", ["X"])
    file.set(("zone.group", "1"), Value("none"))
    other.set(("zone.group", "1"), Value("g1"))
    table = DifferenceTable()
    qtbot.addWidget(table)
    table.resize(1900, 300)
    found = compare(file.schema, file.values, other.values).differences
    table.show_differences(file, found, to_control=True, secrets=False)
    table.show()
    row = table.topLevelItem(0).child(0)
    assert row.text(FILE) == "Belongs to no groups"
    wide = table.fontMetrics().horizontalAdvance(row.text(FILE))
    assert table.columnWidth(FILE) >= wide + 32, "with its mark and the margins"


def test_conditions_leave_their_details_out_before_a_word_is_cut(qtbot: QtBot) -> None:
    line = ConditionLine()
    qtbot.addWidget(line)
    conditions = [ControlCondition("The same machine", True, "ce5702f60"), ControlCondition("E-stop", None)]
    line.resize(600, 34)
    line.show_conditions(conditions)
    assert "ce5702f60" in line._made[0][1].text()
    line.resize(200, 34)
    line.show()
    assert "ce5702f60" not in line._made[0][1].text()
    assert line._made[0][1].toolTip() == "The same machine ce5702f60"


def test_a_look_at_reading_takes_nothing_from_what_is_sent(qtbot: QtBot) -> None:
    """What the control does not contain stays while it is read, and is sent afterwards anyway."""
    file, empty = new_file("9pc", "mill", ["X"]), new_file("9pc", "mill", ["X"])
    pitch = ("servo.lead_screw_pitch", "1")
    file.set(pitch, Value(5.0, "mm"))
    empty.set(pitch, None)
    found = compare(file.schema, file.values, empty.values).differences
    table = DifferenceTable()
    qtbot.addWidget(table)
    for to_control, sent in ((True, True), (False, False), (True, True)):
        table.show_differences(file, found, to_control=to_control, secrets=False)
        assert table.rows[pitch].takes_file is sent
        assert table.rows[pitch].is_fixed is not sent


def test_a_table_that_forgot_its_file_takes_another_width(qtbot: QtBot) -> None:
    """Its rows were gone and their items were still asked for."""
    file, other = new_file("9pc", "mill", ["X"]), new_file("9pc", "mill", ["X"])
    file.set(("servo.lead_screw_pitch", "1"), Value(5.0, "mm"))
    table = DifferenceTable()
    qtbot.addWidget(table)
    found = compare(file.schema, file.values, other.values).differences
    table.show_differences(file, found, to_control=True, secrets=False)
    table.show_nothing()
    table.show_short_words(True)
    assert (table.topLevelItemCount(), table.rows) == (0, {})
