"""Machines side by side in the window."""

import threading
from collections.abc import Callable
from pathlib import Path

import pytest
from openpyxl import load_workbook
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFileDialog

from amp_studio.files import Project, ProjectInfo, new_file, open_file
from amp_studio.files.storage import save_file
from amp_studio.schema import Value
from amp_studio.ui.base.task import TaskProgress
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.merge import machines_dialog
from amp_studio.ui.merge.machines_dialog import MachinesDialog

from .alt_letters import doubled, texts_of
from .conftest import User, action

RATE = ("axis.max_rate", "X")


@pytest.fixture
def hall(tmp_path: Path) -> Path:
    """Return the folder of a project: three routers, of which one is quicker, and a file that is none."""
    folder = tmp_path / "hall"
    folder.mkdir()
    Project.create(folder, ProjectInfo("HALL", "grblhal"))
    for name, rate in (("ROUTER_1", 500.0), ("ROUTER_2", 500.0), ("ROUTER_3", 800.0)):
        file = new_file("grblhal", "grblhal", ["X", "Y", "Z"])
        file.set(RATE, Value(rate, "mm/min"))
        save_file(file, folder / f"{name}.amp")
    (folder / "WORN.amp").write_text("worn")
    return folder


@pytest.fixture
def dialog(open_window: Callable[..., MainWindow], hall: Path) -> MachinesDialog:
    """Return the comparison, with the second router open and changed."""
    window = open_window(hall / "ROUTER_2.amp")
    window.workspace.edit("quicker", {RATE: Value(600.0, "mm/min")})
    action(window, "Compare Machines").trigger()
    found = window.findChild(MachinesDialog)
    assert isinstance(found, MachinesDialog)
    return found


def displayed(dialog: MachinesDialog) -> list[list[object]]:
    """Return the rows that are seen: name, then each machine."""
    rows, role = dialog.rows, Qt.ItemDataRole.DisplayRole
    return [
        [
            rows.headerData(row, Qt.Orientation.Vertical, role),
            *(rows.index(row, column).data() for column in range(rows.columnCount())),
        ]
        for row in range(rows.rowCount())
    ]


def choose(dialog: MachinesDialog, name: str, wanted: bool) -> None:
    (item,) = dialog.list.findItems(name, Qt.MatchFlag.MatchStartsWith)
    item.setCheckState(Qt.CheckState.Checked if wanted else Qt.CheckState.Unchecked)


def test_what_differs_is_a_row_with_each_machine_as_it_is_now(dialog: MachinesDialog) -> None:
    assert [dialog.list.item(n).text() for n in range(4)] == [
        "ROUTER_2",
        "ROUTER_1",
        "ROUTER_3",
        "WORN (cannot be read)",
    ]
    assert displayed(dialog) == [["$110   Maximum rate, X", "600 mm/min", "500 mm/min", "800 mm/min"]]
    assert dialog.count.text().startswith("Different: 1; the same: ")
    assert doubled(texts_of(dialog)) == {}
    choose(dialog, "ROUTER_3", False)
    assert displayed(dialog) == [["$110   Maximum rate, X", "600 mm/min", "500 mm/min"]]
    choose(dialog, "ROUTER_1", False)
    assert dialog.empty.text() == "Choose two machines or more."
    assert not dialog.export_button.isEnabled()


def test_the_filter_and_also_what_is_the_same(dialog: MachinesDialog) -> None:
    dialog.everything.click()
    assert len(displayed(dialog)) > 50
    dialog.filter.setText("RATE 800")
    assert [row[0] for row in displayed(dialog)] == ["$110   Maximum rate, X"]
    assert dialog.count.text().endswith("; shown: 1")


def test_an_edit_in_the_window_and_the_way_to_a_value(
    dialog: MachinesDialog, hall: Path, open_window: Callable[..., MainWindow]
) -> None:
    window = dialog.parent()
    assert isinstance(window, MainWindow)
    window.workspace.edit("as the first", {RATE: Value(500.0, "mm/min")})
    dialog.compare()
    (row,) = displayed(dialog)
    assert row[1:] == ["500 mm/min", "500 mm/min", "800 mm/min"]
    assert (
        dialog.rows.index(0, 2).data(Qt.ItemDataRole.AccessibleTextRole)
        == "ROUTER_3: 800 mm/min, unlike most"
    )
    dialog.table.activated.emit(dialog.rows.index(0, 2))
    assert window.workspace.path == hall / "ROUTER_3.amp"
    assert window.selected() == RATE


def test_the_table_is_exported_and_no_machine_is_written_over(
    dialog: MachinesDialog, hall: Path, user: User
) -> None:
    for ending in ("xlsx", "html", "pdf"):
        user.chooses(hall / f"machines.{ending}")
        dialog.export()
        assert dialog.bar.text.text() == f"{hall / f'machines.{ending}'} written"
    cells = [[cell.value for cell in row] for row in load_workbook(hall / "machines.xlsx").worksheets[0].rows]
    assert cells[0] == ["Number", "Parameter", "Belongs to", "ROUTER_2", "ROUTER_1", "ROUTER_3"]
    assert cells[1][3:] == ["600 mm/min", "500 mm/min", "800 mm/min"]
    before = (hall / "ROUTER_1.amp").read_bytes()
    user.chooses(hall / "ROUTER_1.amp")
    dialog.export()
    assert (hall / "ROUTER_1.amp").read_bytes() == before
    assert str(hall / "ROUTER_1.amp") in dialog.bar.text.text()


def test_files_from_elsewhere_are_added_and_other_families_refused_in_words(
    dialog: MachinesDialog, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    save_file(new_file("9pc", "mill", ["X"]), tmp_path / "MILL.amp")
    same = new_file("grblhal", "grblhal", ["X", "Y", "Z"])
    save_file(same, tmp_path / "ROUTER_1.amp")
    asked = iter([[str(tmp_path / "ROUTER_1.amp")], [str(tmp_path / "MILL.amp")]])
    monkeypatch.setattr(QFileDialog, "getOpenFileNames", lambda *_: (next(asked), ""))
    dialog.add()
    heads = [dialog.model.headerData(n, Qt.Orientation.Horizontal) for n in range(4)]
    assert heads == ["ROUTER_2", "ROUTER_1 (2)", "ROUTER_3", "ROUTER_1 (4)"]
    dialog.add()
    assert dialog.bar.text.text().startswith("files of different control families cannot be compared")
    assert displayed(dialog) == []
    choose(dialog, "MILL", False)
    assert len(displayed(dialog)) == 1
    assert open_file(tmp_path / "ROUTER_1.amp").file.values == same.values


def test_without_a_file_there_is_nothing_to_compare_yet(open_window: Callable[..., MainWindow]) -> None:
    window = open_window()
    action(window, "Compare Machines").trigger()
    assert window.findChild(MachinesDialog).empty.text() == "Choose two machines or more."


def test_reading_the_machines_can_be_cancelled(
    open_window: Callable[..., MainWindow], hall: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The files of a project of a thousand were all read, whatever one pressed."""
    read = machines_dialog._read

    def cancel_after_two(
        machines: list[machines_dialog._Machine], progress: TaskProgress, cancelled: threading.Event
    ) -> list[machines_dialog._Machine]:
        def count(name: str, done: int, total: int) -> None:
            progress(name, done, total)
            if done == 1:
                cancelled.set()

        return read(machines, count, cancelled)

    monkeypatch.setattr(machines_dialog, "_read", cancel_after_two)
    window = open_window(hall / "ROUTER_2.amp")
    action(window, "Compare Machines").trigger()
    dialog = window.findChild(MachinesDialog)
    assert [dialog.list.item(n).text() for n in range(dialog.list.count())] == ["ROUTER_2", "ROUTER_1"]
    assert dialog.bar.text.text() == "Cancelled: 2 files not read."
    assert dialog.bar.isVisible()
    assert dialog.empty.text() == "Nothing differs."
