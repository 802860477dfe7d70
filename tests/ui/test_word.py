"""Packed words taken apart into ticks and fields, and values as the control contains them."""

from collections.abc import Callable

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QComboBox

from amp_studio.files.stored_text import storage_text
from amp_studio.schema import Value
from amp_studio.ui.forms.number_box import WholeBox
from amp_studio.ui.main_window import MainWindow

DISPLAYED = ("axes.displayed", "")


@pytest.fixture
def num(window_with: Callable[..., MainWindow]) -> MainWindow:
    """Return a window with the NUM example."""
    return window_with("num-1060-mill")


@pytest.fixture
def module(window_with: Callable[..., MainWindow]) -> MainWindow:
    """Return a window with the example of the servo module."""
    return window_with("57c422b-label-press")


def ticked(window: MainWindow) -> list[str]:
    """Return the labels that are ticked."""
    ticks = window.detail.word.ticks
    items = (ticks.item(n) for n in range(ticks.count()))
    return [item.text() for item in items if item.checkState() == Qt.CheckState.Checked]


def test_an_axis_is_ticked_instead_of_typing_the_word(num: MainWindow) -> None:
    num.go_to(DISPLAYED)
    assert ticked(num) == ["Axis 0", "Axis 1", "Axis 2", "Axis 3"]

    num.detail.word.ticks.item(17).setCheckState(Qt.CheckState.Checked)

    assert num.workspace.file.get(DISPLAYED) == Value(0x2000F)
    assert num.table.cell_text(DISPLAYED) == "0x0002000F"
    num.menus["edit.undo"].trigger()
    assert ticked(num) == ["Axis 0", "Axis 1", "Axis 2", "Axis 3"]


def test_a_word_that_is_typed_moves_the_ticks(num: MainWindow) -> None:
    num.go_to(DISPLAYED)
    assert num.edits.commit(DISPLAYED, "0x0003807F")
    assert ticked(num) == [f"Axis {n}" for n in (0, 1, 2, 3, 4, 5, 6, 15, 16, 17)]


def test_a_clock_rate_is_picked_and_a_count_entered(num: MainWindow) -> None:
    sensor = ("measure.sensor", "0")
    num.go_to(sensor)
    bits = {bit.label: bit for bit in num.workspace.file.schema.parameters["measure.sensor"].bits}
    clock = bits["Transmission clock frequency"]
    box = num.detail.word.fields[clock.bit]
    assert isinstance(box, QComboBox)
    row = box.findText("200 kHz")
    box.setCurrentIndex(row)
    box.activated.emit(row)
    raw = next(choice.raw for choice in clock.choices if choice.label == "200 kHz")
    assert num.workspace.file.get(sensor) == Value(raw << clock.bit)

    count = bits["Number of status bits at the end of the frame"]
    field = num.detail.word.fields[count.bit]
    assert isinstance(field, WholeBox)
    field.setValue(3)
    assert num.workspace.file.get(sensor) == Value(raw << clock.bit | 3 << count.bit)


def test_bits_that_only_have_a_number_show_it(module: MainWindow) -> None:
    module.go_to(("control.mode", "X"))
    texts = [module.detail.word.ticks.item(n).text() for n in range(module.detail.word.ticks.count())]
    assert texts[:2] == ["0  Enable Control Loop", "1  Enable Gearing"]
    module.go_to(("cam.mode", "X"))
    third = module.detail.word.ticks.item(2).text()
    assert third.startswith("4  "), "the 4 of figure 4.55 is not the number of the bit"


def test_a_point_of_a_table_is_one_row_for_both_axes(module: MainWindow) -> None:
    points = {("cam.points", axis): Value(3) for axis in "XY"}
    words = {("cam.mode", axis): Value(1) for axis in "XY"}
    module.workspace.edit("points", points | words)
    module.go_to(("cam.time_points", "Y.2"))
    table = module.table
    row = table.index_of(("cam.time_points", "Y.2")).row()
    assert table.row_name(row) == "Cam Data Registers, Words, point 2"
    assert [table.address_at(row, n) for n in range(2)] == [
        ("cam.time_points", "X.2"),
        ("cam.time_points", "Y.2"),
    ]


def test_what_the_control_writes_itself_cannot_be_ticked(module: MainWindow) -> None:
    module.go_to(("status.status", "X"))
    assert not module.detail.word.ticks.item(0).flags() & Qt.ItemFlag.ItemIsUserCheckable


def test_a_plain_number_has_no_ticks(module: MainWindow) -> None:
    module.go_to(("control.mode", "X"))
    assert not module.detail.word.isHidden()
    module.go_to(("command.velocity", "X"))
    assert module.detail.word.isHidden()


def test_engineering_units_are_edited_and_the_registers_seen(module: MainWindow) -> None:
    """40 units/s of 4000 counts are 160000 counts/s: 10485760 in the two registers (page 4-13)."""
    velocity = ("command.velocity", "X")
    module.go_to(velocity)
    assert "10485760: R19 = 160 (0x00A0), R20 = 0 (0x0000)" in module.detail.page.toPlainText()
    assert module.edits.commit(velocity, "1 counts/s")
    assert storage_text(module.workspace.file, velocity) == "66: R19 = 0 (0x0000), R20 = 66 (0x0042)"


def test_the_second_axis_has_its_own_registers(module: MainWindow) -> None:
    assert ": R2067 = " in storage_text(module.workspace.file, ("command.velocity", "Y"))


def test_a_value_that_the_control_contains_as_it_is_shown_shows_nothing_more(num: MainWindow) -> None:
    assert storage_text(num.workspace.file, DISPLAYED) == ""
    assert storage_text(num.workspace.file, ("measure.multi", "7")) == ""


def test_units_cannot_be_switched_where_there_is_one_system(module: MainWindow, num: MainWindow) -> None:
    assert not module.menus["view.switch_units"].isEnabled()
