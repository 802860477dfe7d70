"""The page of the tests at the machine: programs, steps with what must be seen, and ticks."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFileDialog
from pytestqt.qtbot import QtBot

from amp_studio.files import Document
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.motion.tests_page import DONE, TEST, MachineTestsPage

MILL = Path(__file__).parents[2] / "examples" / "num-1060-mill" / "MILL_1060.amp"


@pytest.fixture
def page(qapp: object, qtbot: QtBot) -> Iterator[MachineTestsPage]:
    workspace = Workspace(Document.view(MILL))
    made = MachineTestsPage(workspace, print)
    qtbot.addWidget(made)
    made.fill()
    yield made
    workspace.close()


def row_of(page: MachineTestsPage, test: str) -> int:
    return [each.id for each in page.tests].index(test)


def test_a_test_has_its_program_and_what_must_be_seen(page: MachineTestsPage) -> None:
    page.list.setCurrentItem(page.list.topLevelItem(row_of(page, "slow@0")))
    text = page.steps.toPlainText()
    assert "N20 G79 N10" in text  # 11-3
    assert "Must be seen:" in text
    assert page.save.isEnabled()


def test_a_tick_is_kept_in_the_file_and_undone(page: MachineTestsPage) -> None:
    row = row_of(page, "servo-loop@1")
    page.list.topLevelItem(row).setCheckState(TEST, Qt.CheckState.Checked)
    file = page._workspace.file
    assert " by " in file.header.done["servo-loop@1"]
    assert page.summary.text().startswith("1 of ")
    assert page.list.topLevelItem(row).text(DONE)
    page._workspace.undo_stack.undo()
    assert "servo-loop@1" not in file.header.done


def test_a_program_is_saved_as_the_control_reads_it(
    page: MachineTestsPage, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    target = tmp_path / "slow.nc"
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(target), ""))
    page.list.setCurrentItem(page.list.topLevelItem(row_of(page, "slow@0")))
    page.save.click()
    assert target.read_text("ascii").splitlines()[-1] == "N25 M02"
