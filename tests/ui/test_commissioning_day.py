"""The day of an integrator through the one real window: from a new machine to a control that has it, and a report."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from amp_studio.files.examples import examples
from amp_studio.schema import Value
from amp_studio.ui.control.download_preview import DownloadPreview
from amp_studio.ui.dialogs.file_dialogs import ReportDialog
from amp_studio.ui.dialogs.new_file_dialog import NewFileDialog
from amp_studio.ui.dialogs.note_dialog import NoteDialog
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.merge.model import B
from amp_studio.ui.merge.window import MergeWindow
from amp_studio.ui.motion.tuning_window import TuningWindow
from amp_studio.ui.table.block_preview import BlockPreview

from .conftest import WAIT_MS, Control, Person, action, editor, on_disk

EXCESS, CALIBRATION = ("servo.excess_error", "1"), ("home.calibration", "1")
REVERSAL, RIGHT = ("servo.reversal_error", "1"), ("zone.limit3_max", "1")


def type_into(window: MainWindow, address: tuple[str, str], text: str) -> None:
    """Type into a cell of the table, and Enter."""
    window.go_to(address)
    QTest.keyClick(window.table_view, Qt.Key.Key_F2)
    field = editor(window)
    QTest.keyClick(field, Qt.Key.Key_A, Qt.KeyboardModifier.ControlModifier)
    QTest.keyClicks(field, text)
    QTest.keyClick(field, Qt.Key.Key_Return)


def is_typed_over(window: MainWindow, text: str) -> QWidget:
    """Type over the refused text that is still in its cell, and Enter."""
    field = editor(window)
    QTest.keyClick(field, Qt.Key.Key_A, Qt.KeyboardModifier.ControlModifier)
    QTest.keyClicks(field, text)
    QTest.keyClick(field, Qt.Key.Key_Return)
    return field


def test_a_whole_commissioning_day(
    open_window: Callable[..., MainWindow],
    start_control: Callable[..., Control],
    person: Person,
    accept: Callable[..., None],
    tmp_path: Path,
    qtbot: QtBot,
) -> None:
    window, path = open_window(), tmp_path / "DAY.amp"
    mill = next(e for e in examples() if e.family == "9pc" and e.path.name == "MILL_1394.amp")

    # A new machine like the example.
    def like_the_example(dialog: NewFileDialog) -> None:
        dialog.like.setCurrentIndex(dialog.like.findData(mill.path))
        dialog.name.setText("DAY")

    accept(NewFileDialog, like_the_example)
    person.chooses(path)
    window.files.new("9pc")
    workspace = window.workspace
    assert workspace is not None
    file = workspace.file
    assert file.header.name == "DAY"

    # The guide goes to the next value that is not set.
    action(window, "Next Not Set").trigger()
    first = window.selected()
    assert first is not None
    assert file.get(first) is None
    assert window.page.left.side == "steps"

    # A block from a spreadsheet, checked first.
    window.go_to(EXCESS)
    QGuiApplication.clipboard().setText("12\t13\t14")
    blocks: list[str] = []
    accept(BlockPreview, lambda dialog: blocks.append(dialog.summary.text()))
    action(window, "Paste").trigger()
    assert blocks == ["3 cells: 3 change, 0 the same, 0 refused"]
    assert [file.get((EXCESS[0], a)) for a in "123"] == [Value(v, "mm") for v in (12.0, 13.0, 14.0)]

    # An expression; and a refusal that stays in its cell until it is typed over.
    type_into(window, EXCESS, "25.4/2 mm")
    assert file.get(EXCESS) == Value(12.7, "mm")
    type_into(window, EXCESS, "99999 mm")
    assert "is outside" in editor(window).refusal_text
    assert file.get(EXCESS) == Value(12.7, "mm")
    is_typed_over(window, "12 mm")
    assert file.get(EXCESS) == Value(12.0, "mm")

    # Two mistakes, mended together from the list of findings.
    workspace.show_later(True)
    workspace.edit("mistakes", {("servo.feedrate_suppression", a): Value(60.0, "mm") for a in "12"})
    broken = [f for f in workspace.listed if f.fix]
    assert len(broken) > 1
    window.edits.fix_all(broken)
    assert not {f.key for f in broken} & {f.key for f in workspace.listed}

    # A handle of a picture.
    action(window, "Pictures").trigger()
    pictures = window.page.pictures
    pictures.show_picture("travel")
    pictures.grab()
    canvas, before = pictures.chosen_card.canvas, file.get(RIGHT)
    (handle,) = [h for h in canvas.scene.handles if [d.address for d in h.drags] == [RIGHT]]
    start = QPointF(*canvas.place.at(handle.at)).toPoint()
    QTest.mousePress(canvas, Qt.MouseButton.LeftButton, pos=start)
    QTest.mouseMove(canvas, start + QPoint(6, 0))
    QTest.mouseRelease(canvas, Qt.MouseButton.LeftButton, pos=start + QPoint(6, 0))
    assert file.get(RIGHT) != before
    action(window, "Pictures").trigger()

    # What is on the control's screen leads to its parameters.
    box = window.finder.box
    box.begin("servo amp fe limits")
    qtbot.waitUntil(lambda: window.finder._finder() is not None, timeout=WAIT_MS)
    box.search()
    assert next(row.text for row in box.model.rows if row.is_head) == "Messages of the control"
    QTest.keyClick(box, Qt.Key.Key_Escape)

    # Bookmark, filter, note, save.
    window.go_to(EXCESS)
    action(window, "Bookmark").trigger()
    window.page.filters.choose("bookmarked", True)
    assert [row.parameter.id for row in window.table.rows] == [EXCESS[0]]
    window.page.filters.clear()
    accept(NoteDialog, lambda dialog: dialog.text.setPlainText("measured with the new drives"))
    window.edits.note()
    assert window.save()
    assert "measured with the new drives" in path.read_text(encoding="utf-8")

    # One value of the example is taken back.
    shown = window.files.comparing.open(window.page)
    assert isinstance(shown, MergeWindow)
    shown.start(B, lambda: shown.sources.from_copy(shown.sources.other_file, mill.path))
    qtbot.waitUntil(lambda: not shown._reading and bool(shown.merge.rows), timeout=WAIT_MS)
    row = next(r for r in shown.merge.rows if r.id.part == "value" and r.address == EXCESS)
    shown.tree.show_row(row)
    shown.tree.setFocus()
    QTest.keyClick(shown.tree, Qt.Key.Key_B)
    qtbot.waitUntil(shown.outcome.merge.isEnabled, timeout=WAIT_MS)
    shown.outcome.merge.click()
    shown.close()
    assert file.get(EXCESS) == Value(11.0, "mm")

    # The reversal error is tuned, as one more step of undo.
    action(window, "Tuning").trigger()
    tuning = window.findChildren(TuningWindow)[-1]
    values = next(p for p in tuning.values if p.page.key == "reversal")
    values.table.setCurrentCell(values.addresses().index(REVERSAL), 2)
    values.increase.click()
    assert file.get(REVERSAL) == Value(0.001, "mm")
    tuning.close()
    assert window.save()

    # The control gets it after a look at what changes, and has it.
    control = start_control()
    changes: list[int] = []
    accept(DownloadPreview, lambda dialog: changes.append(len(dialog.list.items)))
    person.types(control.address)
    if workspace.count("error"):
        person.answers("Download")
    action(window, "Download to Control").trigger()
    assert person.reads().startswith("Download complete and read back equal")
    assert changes[0] > 100
    person.types(control.address)
    action(window, "Verify With Control").trigger()
    assert person.reads().startswith("Nothing differs")

    # The report for the cabinet; and nothing is left to save.
    report = tmp_path / "DAY.csv"
    accept(ReportDialog, lambda dialog: dialog.path.setText(str(report)))
    action(window, "Report").trigger()
    assert "Excess Error" in report.read_text(encoding="utf-8")
    assert not workspace.is_dirty
    assert on_disk(path).get(EXCESS) == Value(11.0, "mm")
