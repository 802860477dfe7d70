"""The sheet of values to key in, on the screen: ticks and what the control shows are kept as they are made."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from PySide6.QtCore import Qt

from amp_studio.files import content_of, open_file
from amp_studio.ui.control.sheet_dialog import SheetDialog
from amp_studio.ui.main_window import MainWindow

from .conftest import WAIT_MS, Person, action


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


def opened(window: MainWindow, other: Path, person: Person) -> SheetDialog:
    person.answers("A File")
    person.chooses(other)
    action(window, "Enter Values by Hand").trigger()
    return window.findChild(SheetDialog)


@pytest.fixture
def dialog(window: MainWindow, other: Path, person: Person) -> SheetDialog:
    """Return the open sheet."""
    return opened(window, other, person)


def cells(dialog: SheetDialog) -> list[list[str]]:
    return [[item.text(n) for n in range(5)] for item in dialog.items()]


def test_the_entries_are_in_a_safe_order_and_what_is_not_on_it_has_a_page(dialog: SheetDialog) -> None:
    assert cells(dialog) == [["1", "1750", "11", "mm", "8"], ["2", "1740", "11", "mm", "7"]]
    assert dialog.left_out.toPlainText().startswith(
        "2030  Servo Hardware Type Axis 2: Patch AMP does not offer it"
    )
    assert "E-Stop" in dialog.around.toPlainText()
    dialog.list.setCurrentItem(dialog.items()[0])
    assert "page 7-20" in dialog.details.text()


def test_a_tick_is_beside_the_file_at_once_and_there_when_the_sheet_is_opened_again(
    dialog: SheetDialog, window: MainWindow, other: Path, person: Person, path: Path
) -> None:
    dialog.items()[0].setCheckState(0, Qt.CheckState.Checked)
    kept = json.loads(path.with_name(path.name + ".ticks.json").read_bytes())["ticks"]
    assert [(tick["number"], tick["ticked"]) for tick in kept] == [("1750", True)]
    dialog.deleteLater()
    dialog.setParent(None)
    again = opened(window, other, person)
    assert [item.checkState(0) for item in again.items()] == [Qt.CheckState.Checked, Qt.CheckState.Unchecked]
    assert again.text.text().startswith("1 of 2 keyed in")


@pytest.mark.parametrize(
    ("shown", "result"),
    [("11.00000", "as keyed in"), ("8", "still the old value"), ("11.1", "another value"), ("", "")],
)
def test_what_the_screen_shows_is_typed_in_and_compared(dialog: SheetDialog, shown: str, result: str) -> None:
    item = dialog.items()[0]
    item.setText(6, "1")
    item.setText(6, shown)
    assert item.text(7) == result


def test_the_sheet_says_that_the_file_has_changed_and_is_made_again(
    dialog: SheetDialog, window: MainWindow
) -> None:
    assert not dialog.update_button.isEnabled()
    window.edits.commit(("servo.excess_error", "1"), "8 mm")
    assert dialog.text.text().startswith("The file has changed")
    dialog.update_button.click()
    assert [row[1] for row in cells(dialog)] == ["1740"]


def test_a_file_that_has_become_one_of_another_machine_type_gets_no_sheet(
    dialog: SheetDialog, window: MainWindow
) -> None:
    before = cells(dialog)
    window.edits.commit(("control.type", ""), "lathe")
    dialog.update_button.click()
    assert dialog.text.text().startswith(
        "The file is for the machine type lathe, and the control contains one for mill"
    )
    assert cells(dialog) == before


def test_ticks_that_cannot_be_kept_are_not_silent(dialog: SheetDialog, person: Person, path: Path) -> None:
    path.with_name(path.name + ".ticks.json").mkdir()
    dialog.items()[0].setCheckState(0, Qt.CheckState.Checked)
    assert person.reads().startswith("The tick is not kept")


def test_the_sheet_is_saved_in_the_format_of_its_name(
    dialog: SheetDialog, person: Person, tmp_path: Path
) -> None:
    person.chooses(tmp_path / "sheet.txt")
    dialog.save_button.click()
    assert "1750" in (tmp_path / "sheet.txt").read_text("utf-8")


def test_it_closes_with_its_file(dialog: SheetDialog, window: MainWindow, qtbot) -> None:
    with qtbot.waitSignal(dialog.destroyed, timeout=WAIT_MS):
        window.files.close()
