"""What once broke while somebody worked with the window, each driven through the real one."""

import threading
from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtCore import QEvent, QFile, Qt, QTimer
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QComboBox, QDialog, QWidget
from pytestqt.qtbot import QtBot

from amp_studio.files import Merge, Project, ProjectInfo
from amp_studio.files.example_files import examples
from amp_studio.pictures import pictures_of
from amp_studio.schema import Value
from amp_studio.ui import _hook
from amp_studio.ui.actions import project, view
from amp_studio.ui.base.modal import AskerGoneError, is_alive, run_dialog
from amp_studio.ui.base.task import ProgressDialog, Task, run_with_progress
from amp_studio.ui.dialogs.axis_dialogs import AxisDialog
from amp_studio.ui.forms.choice_box import ChoiceBox
from amp_studio.ui.forms.message_bar import MessageBar
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.merge.axis_comparison import AxisComparison
from amp_studio.ui.merge.report import save_merge_report
from amp_studio.ui.project.files import to_trash

from .conftest import WAIT_MS, User, action, editor

SIDE_WINDOWS = (
    "Compare and Merge With",
    "Calculator",
    "Tables of the Manual",
    "Compare Axes",
    "Quick Edit by Number",
    "Machine Facts",
    "Name Axis",
    "Add Axis",
    "Copy Axis",
    "History of Steps",
    "New",
    "Check All Files",
)


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
    window: MainWindow, path: Path, name: str, user: User, monkeypatch: pytest.MonkeyPatch, qtbot: QtBot
) -> None:
    Project.create(path.parent, ProjectInfo("Workshop", "9pc"))
    project.notice(window, path.parent)
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


@pytest.mark.own_window
def test_tab_down_tab_down_chooses_both_types_of_a_servo(window: MainWindow) -> None:
    file = window.workspace.file
    for parameter in ("servo.hardware_type", "servo.loop_type"):
        file.set((parameter, "1"), None)
    dialog = AxisDialog(window.workspace, "Configure Servo", "1", window)
    dialog.ask_for(["servo.hardware_type", "servo.loop_type"])
    dialog.show()
    dialog.form.editor("axis", QComboBox).setFocus()
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
    message = [record.message for record in qtlog.records if "plugin does not support" not in record.message]
    assert [text for text in message if "ditor" in text or "QAbstractItemView" in text] == []


def test_an_edit_in_progress_survives_a_change_of_the_group(window: MainWindow, qtlog) -> None:
    window.go_to(("servo.excess_error", "1"))
    window.table_view.edit(window.table_view.currentIndex())
    QTest.keyClicks(editor(window), "12")
    window.go_to(("home.calibration", "1"))
    QApplication.processEvents()
    assert [r.message for r in qtlog.records if "ditor" in r.message] == []
    assert window.workspace.file.get(("servo.excess_error", "1")) in (Value(12.0, "mm"), Value(11.0, "mm"))


# -- what a monkey found


def test_units_and_control_types_are_not_offered_without_a_file(window: MainWindow) -> None:
    offered = [a for key in ("view.units", "view.machine") for a in window.menus.menu(key).actions()]
    assert all(each.isEnabled() for each in offered)
    window.close_page(window.page)
    assert not any(each.isEnabled() for each in offered)


def test_a_clipboard_that_never_had_a_content_is_refused_in_words(
    window: MainWindow, user: User, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Empty:
        @staticmethod
        def mimeData() -> None:  # noqa: N802  # as Qt calls it
            return None

    monkeypatch.setattr(QGuiApplication, "clipboard", Empty)
    window.go_to(("servo.excess_error", "1"))
    action(window, "Paste").trigger()
    assert user.reads() == "There is no text to paste."


def test_the_preview_outlives_the_page_that_it_shows(window: MainWindow, path: Path, qtbot: QtBot) -> None:
    other = path.with_name("other.amp")
    other.write_bytes(path.read_bytes())
    action(window, "Report Preview").trigger()
    qtbot.waitUntil(lambda: window.preview.panel is not None, timeout=WAIT_MS)
    panel, first = window.preview.panel, window.page
    panel.show_page(first)
    window.open_first(other)
    panel.show_page(first)
    window.close_page(first)
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    panel.show_page(window.page)
    assert panel._page is window.page


def test_the_find_box_forgets_commands_of_a_menu_that_was_made_again(
    window: MainWindow, tmp_path: Path
) -> None:
    window.finder.rows("> control type")
    (example,) = [each.path for each in examples() if each.family == "grblhal"]
    path = tmp_path / example.name
    path.write_bytes(example.read_bytes())
    window.files.open_path(path)
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    assert any("grbl" in row.text.casefold() for row in window.finder.rows("> control type"))


def test_pictures_that_another_control_type_does_not_have_leave_the_page(
    window_with: Callable[..., MainWindow],
) -> None:
    window = window_with("grblhal-router")
    action(window, "Pictures").trigger()
    page, machine = window.page.pictures, window.workspace.file.machine
    names = list(page._pictures)
    page._front = "gears"
    view.set_machine(window, "grbl-0.9")
    assert "gears" not in page._pictures
    assert all(picture.parts for picture in pictures_of(window.workspace.file))
    view.set_machine(window, machine)
    assert list(page._pictures) == names


def test_the_comparison_of_axes_follows_axes_that_come_and_go(window: MainWindow) -> None:
    comparison = AxisComparison(window.page, "1", window)
    assert comparison.first.count() == 5
    types = {a: v for a, v in window.workspace.file.values.items() if a[0] == "axis.type"}
    window.workspace.edit("one", dict.fromkeys([a for a in types if a[1] != "1"], Value("unfitted")))
    comparison.refresh()
    assert comparison.axes() == ("1", "1")
    window.workspace.edit("none", dict.fromkeys(types, Value("unfitted")))
    comparison.refresh()
    assert not comparison.isVisible()


def test_a_report_of_a_comparison_outlives_its_window(
    window: MainWindow, user: User, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    bar = MessageBar()

    def work_and_close(_parent: object, _title: str, _work: object) -> None:
        bar.deleteLater()
        QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)

    monkeypatch.setattr("amp_studio.ui.merge.report.in_background", work_and_close)
    user.chooses(tmp_path / "c.pdf")
    file = window.workspace.file
    save_merge_report(window, Merge(file, file, None), {}, tmp_path / "a.amp", bar)
    assert not is_alive(bar)


def close_at_once(asker: QWidget) -> None:
    """Delete a window as soon as an event loop runs."""
    QTimer.singleShot(0, asker, asker.deleteLater)


def test_what_follows_a_dialog_is_left_out_when_its_window_is_gone(qtbot: QtBot) -> None:
    asker = QWidget()
    close_at_once(asker)
    with pytest.raises(AskerGoneError):
        run_dialog(QDialog(asker))


@pytest.mark.parametrize("is_patient", [False, True])
def test_what_follows_work_is_left_out_when_its_window_is_gone(qtbot: QtBot, is_patient: bool) -> None:
    asker, go_on = QWidget(), threading.Event()
    close_at_once(asker)
    QTimer.singleShot(100, go_on.set)
    run = run_with_progress if is_patient else lambda *asked: ProgressDialog(*asked).run()
    with pytest.raises(AskerGoneError):
        run("Work", lambda *_: go_on.wait(10), asker)
    go_on.set()
    Task.end_all()


def test_a_gone_window_is_no_internal_error(window: MainWindow, user: User) -> None:
    _hook(window)(AskerGoneError, AskerGoneError(), None)
    QApplication.processEvents()
    assert user.shown_boxes == []


def test_a_trash_that_refuses_is_reported_and_the_file_stays(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Qt gives False alone, and a pair where it moves the file."""
    path = tmp_path / "a.amp"
    path.write_bytes(b"x")
    for answer in (False, (False, "")):
        monkeypatch.setattr(QFile, "moveToTrash", lambda _, answer=answer: answer)
        with pytest.raises(OSError, match="no trash"):
            to_trash(path)
