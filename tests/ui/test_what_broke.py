"""What once broke while somebody worked with the window, each driven through the real one."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDialog, QWidget
from pytestqt.qtbot import QtBot

from amp_studio.files import Project, ProjectInfo
from amp_studio.schema import Value
from amp_studio.ui.axis_dialogs import AxisDialog
from amp_studio.ui.choice_box import ChoiceBox
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.task import ProgressDialog

from .conftest import WAIT_MS, Person, action, editor

SIDE_WINDOWS = (
    "Compare and Merge With", "Calculator", "Tables of the Manual", "Compare Axes", "Motion", "Exchanges of This File",
    "Tuning", "Several Controls", "Quick Edit by Number", "Machine Facts", "Name Axis", "Add Axis",
    "Copy Axis", "History of Steps", "New", "Check All Files",
)  # fmt: skip


def opened_beside(window: MainWindow) -> list[QWidget]:
    """Return the windows that are seen beside the main one."""
    return [
        w
        for w in QApplication.topLevelWidgets()
        if w is not window
        and w.isVisible()
        and w.windowType() != Qt.WindowType.ToolTip
        and not isinstance(w, ProgressDialog)
    ]


@pytest.mark.parametrize("name", SIDE_WINDOWS)
def test_escape_closes_every_side_window(
    window: MainWindow, path: Path, name: str, person: Person, monkeypatch: pytest.MonkeyPatch, qtbot: QtBot
) -> None:
    Project.create(path.parent, ProjectInfo("Workshop", "9pc"))
    window.projects.notice(path.parent)
    run = QDialog.exec  # progress is waited for: it takes a while on a slow machine
    monkeypatch.setattr(
        QDialog,
        "exec",
        lambda dialog: run(dialog) if isinstance(dialog, ProgressDialog) else dialog.show() or 0,
    )
    window.go_to(("servo.excess_error", "1"))
    action(window, name).trigger()
    qtbot.waitUntil(lambda: bool(opened_beside(window)), timeout=WAIT_MS)
    (beside,) = opened_beside(window)
    with qtbot.waitActive(beside, timeout=WAIT_MS):
        beside.activateWindow()
    with qtbot.waitExposed(beside, timeout=WAIT_MS):
        beside.raise_()
    QTest.keyClick(QApplication.focusWidget() or beside, Qt.Key.Key_Escape)
    qtbot.waitUntil(lambda: opened_beside(window) == [], timeout=WAIT_MS)
    assert window.isVisible()


def test_letters_typed_on_a_choice_are_those_of_its_label(window: MainWindow) -> None:
    """``d`` is the code letter of SERCOS, and ``dig`` is the beginning of Digital."""
    box = ChoiceBox(window.workspace, ("servo.loop_type", "1"))
    for key in (Qt.Key.Key_D, Qt.Key.Key_I, Qt.Key.Key_G):
        QTest.keyClick(box, key)
    assert box.currentData() == "Digital or Digital Spindle"
    box.deleteLater()


def test_tab_down_tab_down_chooses_both_types_of_a_servo(window: MainWindow) -> None:
    file = window.workspace.file
    for parameter in ("servo.hardware_type", "servo.loop_type"):
        file.set((parameter, "1"), None)
    dialog = AxisDialog(window.workspace, "Configure servo", "1", window)
    dialog.ask_for(["servo.hardware_type", "servo.loop_type"])
    dialog.show()
    dialog.axis_box.setFocus()
    for _ in range(2):
        QTest.keyClick(dialog.focusWidget(), Qt.Key.Key_Tab)
        QTest.keyClick(dialog.focusWidget(), Qt.Key.Key_Down)
    texts = dialog.texts()
    assert len(texts) == 2
    assert all(texts.values()), "none is left without a type"
    dialog.close()


def test_only_the_cell_that_caused_a_finding_is_tinted(window: MainWindow) -> None:
    window.edits.commit(("servo.excess_error", "1"), "3 mm")
    causes = {a for f in window.workspace.findings if f.severity != "advice" for a in f.causes}
    touched = {a for f in window.workspace.findings if f.severity != "advice" for a in f.addresses}
    assert touched - causes, "the finding reads more values than those that cause it"
    tinted = {a for a, severity in window.table.values.worst.items() if severity != "advice"}
    assert tinted == causes


def test_an_answer_of_the_find_box_moves_the_left_panel_too(window: MainWindow, qtbot: QtBot) -> None:
    window.page.left.show_side("groups")
    box = window.finder.box
    box.begin("")
    qtbot.waitUntil(lambda: window.finder._finder() is not None, timeout=WAIT_MS)
    QTest.keyClicks(box, "1300")
    QTest.keyClick(box, Qt.Key.Key_Return)
    assert window.selected()[0] == "home.calibration"
    item = window.page.groups.tree.currentItem()
    assert "home" in item.text(0).casefold()


@pytest.mark.parametrize(
    "keys", [[Qt.Key.Key_Return], [Qt.Key.Key_Escape], [Qt.Key.Key_Tab]], ids=["enter", "escape", "tab"]
)
def test_an_editor_closes_without_a_word_on_the_terminal(
    window: MainWindow, qtlog, keys: list[Qt.Key]
) -> None:
    for address in (("servo.excess_error", "1"), ("servo.loop_type", "1")):
        window.go_to(address)
        window.table_view.edit(window.table_view.currentIndex())
        for key in keys:
            QTest.keyClick(editor(window), key)
        QApplication.processEvents()
    said = [record.message for record in qtlog.records if "plugin does not support" not in record.message]
    assert [text for text in said if "ditor" in text or "QAbstractItemView" in text] == []


def test_an_edit_in_progress_survives_a_change_of_the_group(window: MainWindow, qtlog) -> None:
    window.go_to(("servo.excess_error", "1"))
    window.table_view.edit(window.table_view.currentIndex())
    QTest.keyClicks(editor(window), "12")
    window.go_to(("home.calibration", "1"))
    QApplication.processEvents()
    assert [r.message for r in qtlog.records if "ditor" in r.message] == []
    assert window.workspace.file.get(("servo.excess_error", "1")) in (Value(12.0, "mm"), Value(11.0, "mm"))
