"""The findings below the table."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from amp_studio.schema import Value
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.workspace import Workspace

from .conftest import WAIT_MS

EXCESS = ("servo.excess_error", "1")


@pytest.fixture
def wrong(window: MainWindow) -> MainWindow:
    """Return a window with three values out of range."""
    axes = "123"
    wanted = {("servo.excess_error", a): Value(1e6, "mm") for a in axes}
    window.workspace.edit("force", wanted, force="on a day")
    return window


def test_errors_come_first_and_are_counted(wrong: MainWindow) -> None:
    model = wrong.findings.model
    assert model.index(0, 0).data() == "error"
    errors = wrong.workspace.count("error")
    assert errors >= 3
    assert wrong.findings.counts.text().startswith(f"{errors} errors, ")
    assert f"{errors} errors" in wrong.file_status.text()
    assert not model.index(0, 0).data(Qt.ItemDataRole.DecorationRole).isNull()


def test_the_selected_finding_stays_selected(wrong: MainWindow) -> None:
    finding = next(f for f in wrong.workspace.findings if f.addresses[0] == ("servo.excess_error", "3"))
    wrong.findings.view.selectRow(wrong.workspace.findings.index(finding))

    wrong.workspace.edit("mend", {EXCESS: Value(11.0, "mm")})

    assert wrong.findings.current().addresses == finding.addresses


def test_enter_shows_the_parameter_of_a_finding(wrong: MainWindow) -> None:
    finding = next(f for f in wrong.workspace.findings if f.addresses[0] == ("servo.excess_error", "2"))
    wrong.findings.view.selectRow(wrong.workspace.findings.index(finding))
    wrong.show_panel("Findings")
    assert wrong.findings.view.hasFocus()

    QTest.keyClick(wrong.findings.view, Qt.Key.Key_Return)

    assert wrong.selected() == ("servo.excess_error", "2")
    assert wrong.table_view.hasFocus()


def test_the_repair_button_repairs_and_only_where_there_is_a_repair(path, bare: bytes, open_window) -> None:
    path.write_bytes(bare)
    wrong = open_window(path)
    findings = wrong.workspace.findings
    able = next(n for n, f in enumerate(findings) if f.repairs)
    unable = next(n for n, f in enumerate(findings) if not f.repairs)
    wrong.findings.view.selectRow(unable)
    assert not wrong.findings.repair_button.isEnabled()

    wrong.findings.view.selectRow(able)
    assert wrong.findings.repair_button.isEnabled()
    repair = findings[able].repairs[0]
    wrong.findings.repair_button.click()
    assert wrong.workspace.file.get(repair.address) == repair.value


def test_a_finding_without_a_repair_says_so(path, bare: bytes, open_window, person) -> None:
    path.write_bytes(bare)
    wrong = open_window(path)
    unable = next(n for n, f in enumerate(wrong.workspace.findings) if not f.repairs)
    wrong.findings.view.selectRow(unable)
    wrong.guarded(wrong.edits._repair)
    assert "has no repair" in person.reads()


def test_rows_are_as_high_as_their_words_need(wrong: MainWindow, qtbot) -> None:
    """Also when the window becomes narrower."""
    view = wrong.findings.view
    rows = range(len(wrong.workspace.findings))
    for width in (1700, 900, 1300):
        wrong.resize(width, 900)
        qtbot.waitUntil(
            lambda: [view.rowHeight(n) for n in rows] == [view.sizeHintForRow(n) for n in rows],
            timeout=WAIT_MS,
        )


def test_a_hidden_parameter_of_a_finding_can_be_shown(window: MainWindow, workspace: Workspace) -> None:
    """Going to what does not exist for this configuration turns the option on."""
    hidden = ("control.lathe_type", "")  # page 3-9: on a lathe only
    window.go_to(hidden)
    assert window.view.hidden_too.isChecked()
    assert window.selected() == hidden


def test_an_unfitted_axis_can_be_shown(window: MainWindow) -> None:
    window.go_to(("axis.type", "7"))
    assert window.view.all_axes.isChecked()
    assert window.selected() == ("axis.type", "7")
