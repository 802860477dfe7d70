"""Differences to another file: missing here, missing there, different, same, with counts; what is ticked is taken."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtCore import Qt

from amp_studio.files import content_of, open_file
from amp_studio.schema import Value
from amp_studio.ui.compare_dialog import CompareDialog
from amp_studio.ui.main_window import MainWindow

from .conftest import Person, action

EXCESS = ("servo.excess_error", "1")
CALIBRATION = ("home.calibration", "1")
PITCH = ("servo.lead_screw_pitch", "1")


@pytest.fixture
def other(path: Path) -> Path:
    """Return a file that differs in three values, one of them missing here, one there, and one in its unit only."""
    file = open_file(path).file
    file.set(EXCESS, Value(3.0, "mm"))
    file.set(CALIBRATION, None)
    file.set(("axis.incremental_name", "1"), Value("u"))
    file.set(PITCH, Value(file.values[PITCH].value / 25.4, "in"))
    other = path.with_name("other.amp")
    other.write_bytes(content_of(file))
    return other


@pytest.fixture
def dialog(window: MainWindow, other: Path, person: Person) -> CompareDialog:
    """Return the open list of differences."""
    person.chooses(other)
    action(window, "Compare With").trigger()
    return window.findChild(CompareDialog)


def test_differences_by_kind_with_their_counts(dialog: CompareDialog, window: MainWindow) -> None:
    rows = {item.text(0).partition(" ")[0]: [item.text(n) for n in range(1, 5)] for item in dialog.list.items}
    assert rows["1750"] == ["Axis 1", "different", "11 mm", "3 mm"]
    assert rows["1300"] == ["Axis 1", "only in this file", "0 mm", "not set"]
    assert [row for row in rows.values() if row[1] == "not in this file"]
    same = len(window.workspace.file.values) - len(rows) + 1
    assert (
        dialog.text.text() == f"1 different, {same} the same, 1 not set in this file, 1 not set in other.amp."
    )


def test_what_is_ticked_is_taken_as_one_step(dialog: CompareDialog, window: MainWindow) -> None:
    for item in dialog.list.items:
        if item.text(0).startswith(("1750", "1300")):
            item.setCheckState(0, Qt.CheckState.Checked)

    dialog.take_button.click()

    file = window.workspace.file
    assert file.get(EXCESS) == Value(3.0, "mm")
    assert file.get(CALIBRATION) is None
    assert len(dialog.list.items) == 1
    window.edits.undo.trigger()
    assert file.get(EXCESS) == Value(11.0, "mm")
    assert len(dialog.list.items) == 3


def test_ticks_stay_when_the_file_is_edited(dialog: CompareDialog, window: MainWindow) -> None:
    dialog.every.click()
    window.edits.commit(("home.calibration", "2"), "1 mm")
    assert next(d.address for d in dialog.list.ticked()) is not None
    assert len(dialog.list.ticked()) == 3
    assert len(dialog.list.items) == 4


def test_a_row_leads_to_its_value(dialog: CompareDialog, window: MainWindow) -> None:
    item = next(i for i in dialog.list.items if i.text(0).startswith("1750"))
    dialog.list.itemActivated.emit(item, 0)
    assert window.selected() == EXCESS


def test_it_closes_with_its_file(dialog: CompareDialog, window: MainWindow, qtbot) -> None:
    with qtbot.waitSignal(dialog.destroyed, timeout=5000):
        window.files.close()
