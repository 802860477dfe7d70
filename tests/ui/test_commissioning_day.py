"""The day of an integrator through the one real window: from a new machine to a control that has it,
and a report.
"""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from amp_studio.files import ParameterFile
from amp_studio.files.example_files import examples
from amp_studio.schema import Value
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.dialogs.file_dialogs import ReportDialog
from amp_studio.ui.dialogs.new_file_dialog import NewFileDialog
from amp_studio.ui.dialogs.note_dialog import NoteDialog
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.merge.columns import B
from amp_studio.ui.merge.window import MergeWindow
from amp_studio.ui.motion.tuning_page import TuningView
from amp_studio.ui.table.block_preview import BlockPreview

from .at_control import at_control, settled
from .conftest import WAIT_MS, Control, User, action, editor, on_disk

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


@dataclass
class Day:
    """What the steps of the day share: the window, who answers its questions, and the file the day is
    about.
    """

    window: MainWindow
    user: User
    accept: Callable[..., None]
    qtbot: QtBot
    path: Path
    example: Path

    @property
    def workspace(self) -> Workspace:
        assert self.window.workspace is not None
        return self.window.workspace

    @property
    def file(self) -> ParameterFile:
        return self.workspace.file

    def do(self, name: str) -> None:
        """Choose a command of the menus."""
        action(self.window, name).trigger()


def a_new_machine_like_the_example(day: Day) -> None:
    def like_the_example(dialog: NewFileDialog) -> None:
        dialog.form.set_answer("like", day.example)
        dialog.form.set_answer("name", "DAY")

    day.accept(NewFileDialog, like_the_example)
    day.user.chooses(day.path)
    day.window.files.new("9pc")
    assert day.file.header.name == "DAY"


def the_guide_goes_to_the_next_value_that_is_not_set(day: Day) -> None:
    day.do("Next Not Set")
    first = day.window.selected()
    assert first is not None
    assert day.file.get(first) is None
    assert day.window.page.left.side == "steps"


def a_block_of_a_spreadsheet_is_checked_first(day: Day) -> None:
    day.window.go_to(EXCESS)
    QGuiApplication.clipboard().setText("12\t13\t14")
    blocks: list[str] = []
    day.accept(BlockPreview, lambda dialog: blocks.append(dialog.summary.text()))
    day.do("Paste")
    assert blocks == ["3 cells: 3 change, 0 the same, 0 refused"]
    assert [day.file.get((EXCESS[0], a)) for a in "123"] == [Value(v, "mm") for v in (12.0, 13.0, 14.0)]


def an_expression_is_calculated_and_a_refusal_stays_in_its_cell(day: Day) -> None:
    type_into(day.window, EXCESS, "25.4/2 mm")
    assert day.file.get(EXCESS) == Value(12.7, "mm")
    type_into(day.window, EXCESS, "99999 mm")
    assert "is outside" in editor(day.window).refusal_text
    assert day.file.get(EXCESS) == Value(12.7, "mm")
    is_typed_over(day.window, "12 mm")
    assert day.file.get(EXCESS) == Value(12.0, "mm")


def two_mistakes_are_mended_together(day: Day) -> None:
    workspace = day.workspace
    workspace.show_later(True)
    workspace.edit("mistakes", {("servo.feedrate_suppression", a): Value(60.0, "mm") for a in "12"})
    broken = [f for f in workspace.listed if f.fix]
    assert len(broken) > 1
    day.window.edits.fix_all(broken)
    assert not {f.key for f in broken} & {f.key for f in workspace.listed}


def a_handle_of_a_picture_is_dragged(day: Day) -> None:
    day.do("Pictures")
    pictures = day.window.page.pictures
    pictures.show_picture("travel")
    pictures.grab()
    canvas, before = pictures.chosen_card.canvas, day.file.get(RIGHT)
    (handle,) = [h for h in canvas.scene.handles if [d.address for d in h.drags] == [RIGHT]]
    start = QPointF(*canvas.place.at(handle.at)).toPoint()
    QTest.mousePress(canvas, Qt.MouseButton.LeftButton, pos=start)
    QTest.mouseMove(canvas, start + QPoint(6, 0))
    QTest.mouseRelease(canvas, Qt.MouseButton.LeftButton, pos=start + QPoint(6, 0))
    assert day.file.get(RIGHT) != before
    day.do("Pictures")


def what_is_on_the_screen_of_the_control_leads_to_its_parameters(day: Day) -> None:
    box = day.window.finder.box
    box.begin("servo amp fe limits")
    day.qtbot.waitUntil(lambda: day.window.finder._finder() is not None, timeout=WAIT_MS)
    box.search()
    first = next(row for row in box.model.rows if not row.is_head)
    assert "SERVO AMP" in first.text.upper(), first.text
    QTest.keyClick(box, Qt.Key.Key_Escape)


def bookmark_filter_note_and_save(day: Day) -> None:
    window = day.window
    window.go_to(EXCESS)
    day.do("Bookmark")
    window.page.filters.choose("bookmarked", True)
    assert [row.parameter.id for row in window.table.rows] == [EXCESS[0]]
    window.page.filters.clear()
    day.accept(NoteDialog, lambda dialog: dialog.form.set_answer("note", "measured with the new drives"))
    window.edits.edit_notes()
    assert window.save()
    assert "measured with the new drives" in day.path.read_text(encoding="utf-8")


def one_value_of_the_example_is_taken_back(day: Day) -> None:
    window, wait = day.window, day.qtbot.waitUntil
    displayed = window.files.comparing.open(window.page)
    assert isinstance(displayed, MergeWindow)
    displayed.start(B, lambda: displayed.sources.from_copy(displayed.sources.other_file, day.example))
    wait(lambda: not displayed._reading and bool(displayed.merge.rows), timeout=WAIT_MS)
    row = next(r for r in displayed.merge.rows if r.id.part == "value" and r.address == EXCESS)
    displayed.tree.show_row(row)
    displayed.tree.setFocus()
    QTest.keyClick(displayed.tree, Qt.Key.Key_B)
    wait(displayed.outcome.merge.isEnabled, timeout=WAIT_MS)
    displayed.outcome.merge.click()
    displayed.close()
    assert day.file.get(EXCESS) == Value(11.0, "mm")


def the_reversal_error_is_tuned(day: Day) -> None:
    day.do("Tuning")
    tuning = day.window.findChildren(TuningView)[-1]
    values = next(p for p in tuning.values if p.page.key == "reversal")
    values.table.setCurrentCell(values.addresses().index(REVERSAL), 2)
    values.increase.click()
    assert day.file.get(REVERSAL) == Value(0.001, "mm")
    day.do("Values")
    assert day.window.save()


def the_control_gets_it_after_a_look_at_what_changes(day: Day, control: Control) -> None:
    page = at_control(day.window, control.address, "send", day.qtbot)
    assert len(page.table.rows_taking(file=True)) > 100
    page.checked.setChecked(True)
    for answer in page.bar.buttons:
        answer.click()
    page.press()
    settled(day.window, day.qtbot)
    assert "Download complete and read back equal" in page.empty.text()
    page.connect_again()
    settled(day.window, day.qtbot)
    assert "Nothing differs" in page.empty.text()
    day.window.control.leave()


def the_report_for_the_cabinet_is_written(day: Day) -> None:
    report = day.path.with_suffix(".csv")
    day.accept(ReportDialog, lambda dialog: dialog.form.set_answer("path", str(report)))
    day.do("Report")
    assert "Excess Error" in report.read_text(encoding="utf-8")


def test_a_whole_commissioning_day(
    open_window: Callable[..., MainWindow],
    start_control: Callable[..., Control],
    user: User,
    accept: Callable[..., None],
    tmp_path: Path,
    qtbot: QtBot,
) -> None:
    mill = next(e.path for e in examples() if e.family == "9pc" and e.path.name == "MILL_1394.amp")
    day = Day(open_window(), user, accept, qtbot, tmp_path / "DAY.amp", mill)
    a_new_machine_like_the_example(day)
    the_guide_goes_to_the_next_value_that_is_not_set(day)
    a_block_of_a_spreadsheet_is_checked_first(day)
    an_expression_is_calculated_and_a_refusal_stays_in_its_cell(day)
    two_mistakes_are_mended_together(day)
    a_handle_of_a_picture_is_dragged(day)
    what_is_on_the_screen_of_the_control_leads_to_its_parameters(day)
    bookmark_filter_note_and_save(day)
    one_value_of_the_example_is_taken_back(day)
    the_reversal_error_is_tuned(day)
    the_control_gets_it_after_a_look_at_what_changes(day, start_control())
    the_report_for_the_cabinet_is_written(day)
    assert not day.workspace.is_dirty, "nothing is left to save"
    assert on_disk(day.path).get(EXCESS) == Value(11.0, "mm")
