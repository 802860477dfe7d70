"""The sheet of values to key in, on the screen: ticks and what the control shows are kept as they are
made.
"""

import json
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from amp_studio.files import content_of, open_file
from amp_studio.ui.control.hand_sheet import HandSheet
from amp_studio.ui.main_window import MainWindow

from .at_control import nearly, sent, settled
from .conftest import User, action


@pytest.fixture
def other(path: Path) -> Path:
    """Return what the control contains: two limits of axis 1 are narrower there."""
    file = open_file(path).file
    for number, text in (("1750", "8 mm"), ("1740", "7 mm"), ("2030", "a")):
        address = file.find(number)
        file.set(address, file.read(address, text))
    other = path.with_name("control.amp")
    other.write_bytes(content_of(file))
    return other


def opened(window: MainWindow, other: Path, user: User) -> HandSheet:
    user.chooses(other)
    action(window, "Enter Values by Hand").trigger()
    sheet = window.control.page.hand
    assert "Where is that known from?" in sheet.text.text()
    assert not sheet.save_button.isEnabled()
    sheet.file_button.click()
    return sheet


@pytest.fixture
def sheet(window: MainWindow, other: Path, user: User) -> HandSheet:
    """Return the open sheet."""
    return opened(window, other, user)


def cells(sheet: HandSheet) -> list[list[str]]:
    return [[item.text(n) for n in range(5)] for item in sheet.items()]


def test_the_entries_are_in_a_safe_order_and_what_is_not_on_it_has_a_page(sheet: HandSheet) -> None:
    assert cells(sheet) == [["1", "1750", "11", "mm", "8"], ["2", "1740", "11", "mm", "7"]]
    assert sheet.left_out.toPlainText().startswith(
        "2030  Servo Hardware Type Axis Y: Patch AMP does not offer it"
    )
    assert "E-Stop" in sheet.around.toPlainText()
    sheet.list.setCurrentItem(sheet.items()[0])
    assert "page 7-20" in sheet.details.text()


def test_a_row_is_read_whole_with_the_letter_of_its_axis_and_has_room_for_its_tick(sheet: HandSheet) -> None:
    assert [item.text(5) for item in sheet.items()] == [
        "Excess Error, X axis",
        "Feedrate Suppression Point, X axis",
    ]
    sheet.items()[0].setText(5, "Rapid Feedrate for Positioning, X axis = " + 9 * "10 000 mm/min ")
    QApplication.processEvents()
    assert sheet.list.sizeHintForColumn(5) <= sheet.list.columnWidth(5)
    assert all(sheet.list.visualItemRect(item).height() >= 22 for item in sheet.items())


def test_a_tick_is_beside_the_file_at_once_and_there_when_the_sheet_is_opened_again(
    sheet: HandSheet, window: MainWindow, other: Path, user: User, path: Path
) -> None:
    sheet.items()[0].setCheckState(0, Qt.CheckState.Checked)
    kept = json.loads(path.with_name(path.name + ".ticks.json").read_bytes())["ticks"]
    assert [(tick["number"], tick["ticked"]) for tick in kept] == [("1750", True)]
    user.chooses(other)
    sheet.file_button.click()
    again = window.control.page.hand
    assert [item.checkState(0) for item in again.items()] == [Qt.CheckState.Checked, Qt.CheckState.Unchecked]
    assert again.text.text().startswith("1 of 2 keyed in")


@pytest.mark.parametrize(
    ("displayed", "result"),
    [("11.00000", "as keyed in"), ("8", "still the old value"), ("11.1", "another value"), ("", "")],
)
def test_what_the_screen_shows_is_typed_in_and_compared(
    sheet: HandSheet, displayed: str, result: str
) -> None:
    item = sheet.items()[0]
    item.setText(6, "1")
    item.setText(6, displayed)
    assert item.text(7) == result


def test_the_sheet_shows_that_the_file_has_changed_and_is_made_again(
    sheet: HandSheet, window: MainWindow
) -> None:
    assert not sheet.update_button.isEnabled()
    window.edits.commit(("servo.excess_error", "1"), "8 mm")
    assert sheet.bar.text.text().startswith("The file has changed")
    sheet.update_button.click()
    assert [row[1] for row in cells(sheet)] == ["1740"]


def test_a_file_that_has_become_one_of_another_machine_type_gets_no_sheet(
    sheet: HandSheet, window: MainWindow
) -> None:
    before = cells(sheet)
    window.edits.commit(("control.type", ""), "lathe")
    sheet.update_button.click()
    assert sheet.bar.text.text().startswith(
        "The file is for the machine type lathe, and the control contains one for mill"
    )
    assert cells(sheet) == before


def test_ticks_that_cannot_be_kept_are_not_silent(sheet: HandSheet, path: Path) -> None:
    path.with_name(path.name + ".ticks.json").mkdir()
    sheet.items()[0].setCheckState(0, Qt.CheckState.Checked)
    assert sheet.bar.text.text().startswith("The tick is not kept")


def test_the_sheet_is_saved_in_the_format_of_its_name(sheet: HandSheet, user: User, tmp_path: Path) -> None:
    user.chooses(tmp_path / "sheet.txt")
    sheet.save_button.click()
    assert "1750" in (tmp_path / "sheet.txt").read_text("utf-8")


def test_it_goes_with_its_file(sheet: HandSheet, window: MainWindow) -> None:
    window.files.close()
    assert sheet.sheet is None
    assert sheet.items() == []


def test_it_is_made_against_the_control_that_is_chosen_and_read_for_it(
    window: MainWindow, start_control, qtbot: QtBot
) -> None:
    page = sent(window, start_control(file=nearly(window)).address, qtbot)
    window.edits.commit(("servo.excess_error", "1"), "8 mm")
    page.directions.buttons["hand"].click()
    assert page.hand.sheet is None, "what the control contains is not read since it was sent to"
    page.hand.control_button.click()
    settled(window, qtbot)
    assert [row[1] for row in cells(page.hand)] == ["1750"]
    window.edits.commit(("servo.excess_error", "1"), "7 mm")
    page.connect_again()
    settled(window, qtbot)
    page.directions.buttons["hand"].click()
    assert cells(page.hand) == [["1", "1750", "7", "mm", "11"]]
