"""Start and end of the program: quick, with nothing heavy loaded, nothing lost and nothing left running."""

import gc
import os
import subprocess
import sys
import threading
from pathlib import Path
from typing import ClassVar

import pytest
from PySide6.QtCore import QEvent, QTimer
from PySide6.QtWidgets import QApplication, QDockWidget, QWidget

from amp_studio.schema import Value
from amp_studio.ui.base import garbage
from amp_studio.ui.base.task import ProgressDialog, Task
from amp_studio.ui.main_window import MainWindow

from .conftest import User, during, on_disk

EXCESS = ("servo.excess_error", "1")

LATE = ("numpy", "numba", "typst", "serial", "jinja2", "amp_studio.sim", "amp_studio.transfer")
"""What a start must not wait for."""

STARTED = f"""
import sys
from pathlib import Path
from PySide6.QtWidgets import QApplication
from amp_studio.ui.main_window import MainWindow
application = QApplication([])
window = MainWindow()
window.show()
window.open_first(Path(sys.argv[1]))
window.grab()  # painted, before any timer of what comes later is due
assert window.workspace is not None
print([name for name in {LATE!r} if name in sys.modules])
application.processEvents()
window.menus['view.motion'].trigger()
window.close()
"""

OPENED = """
import sys
from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication
from amp_studio.ui import main
from amp_studio.ui.main_window import MainWindow
def show(window):
    QTimer.singleShot(0, QApplication.quit)
MainWindow.show = show
main(sys.argv[1:])
"""

CLOSED = """
import gc, sys, weakref
from pathlib import Path
from PySide6.QtCore import QEvent, QTimer
from PySide6.QtWidgets import QApplication
from amp_studio.ui.actions import pages
from amp_studio.ui.base import garbage
from amp_studio.ui.base.task import Task
from amp_studio.ui.main_window import MainWindow
application = QApplication([])
window = MainWindow()
window.open_first(Path(sys.argv[1]))
assert gc.get_freeze_count() > 10_000
for turn in (pages.open_check, pages.open_program, pages.open_tuning):
    turn(window)
left = [weakref.ref(each) for each in (window.workspace.validator, *window.page.pages.values())]
assert len(left) == 4
window.visited.menu.aboutToShow.emit()
assert window.visited.menu.actions()[0].isEnabled(), "the menu of places has one of this file"
window.close_page(window.page)
Task.end_all()
QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
rest = application.findChild(QTimer, garbage._REST)
assert rest.isActive() and rest.isSingleShot()
garbage.set_apart(window)
assert rest.interval() > garbage.REST_MS, "a file was opened: its first seconds are left in peace"
garbage.collect_closed()
assert [each() for each in left] == [None] * 4
assert gc.get_freeze_count() > 10_000, "what is left is set apart again"
"""


def test_a_start_loads_nothing_that_it_does_not_show_and_ends_without_a_word_of_complaint(path: Path) -> None:
    """No thread is destroyed while it runs, no timer is stopped from another thread, no exception is lost."""
    done = subprocess.run(
        [sys.executable, "-X", "faulthandler", "-c", STARTED, str(path)],
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip() == "[]"
    assert [line for line in done.stderr.splitlines() if "plugin does not support" not in line] == []


def test_a_fault_of_the_program_itself_is_reported_in_a_sentence(path: Path) -> None:
    code = """
import sys
from PySide6.QtCore import QMimeData, QTimer
from PySide6.QtWidgets import QApplication, QMessageBox
from amp_studio.ui import main
application = QApplication([])
copied = QMimeData()  # as cells are copied: deleted after Python's end it would end in a fault
copied.setText("1")
application.clipboard().setMimeData(copied)
del copied
def told(box):
    print(box.text().splitlines()[0])
    application.exit(0)
QMessageBox.exec = told
QTimer.singleShot(0, lambda: 1 / 0)
main([])
"""
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=False, env=os.environ
    )
    assert done.stdout.startswith("AMP Studio has an internal error: ZeroDivisionError"), done.stderr
    assert done.returncode == 0, "an end that does not come from the window waits for its threads too"
    assert "Traceback" in done.stderr


def test_closing_asks_about_unsaved_changes(window: MainWindow, path: Path, user: User) -> None:
    window.edits.commit(EXCESS, "3 mm")
    user.answers("Cancel", "Save")
    assert not window.close()
    assert window.isVisible()
    assert window.close()
    assert on_disk(path).get(EXCESS) == Value(3.0, "mm")


def test_discarded_work_is_not_offered_again(window: MainWindow, path: Path, user: User, open_window) -> None:
    window.edits.commit(EXCESS, "3 mm")
    window.workspace._keep_unsaved()
    window.workspace._end_keeping()
    assert window.workspace.document.journal_path.exists()
    user.answers("Discard")
    assert window.close()
    assert [p.name for p in path.parent.iterdir()] == ["mill.amp"]
    assert open_window(path).workspace.file.get(EXCESS) == Value(11.0, "mm")


def test_closing_without_changes_asks_nothing(window: MainWindow, user: User) -> None:
    window.edits.commit(EXCESS, "3 mm")
    window.menus["edit.undo"].trigger()
    assert window.close()
    assert user.asked == []


def test_a_save_that_fails_at_the_end_keeps_the_program_open(
    window: MainWindow, path: Path, user: User
) -> None:
    window.edits.commit(EXCESS, "3 mm")
    path.write_bytes(path.read_bytes() + b"# touched\n")
    user.answers("Save")
    assert not window.close()
    assert window.page.bar.isVisible()


def test_the_layout_is_remembered(window: MainWindow, path: Path) -> None:
    window.findChild(QDockWidget, "Findings").close()
    window.files.close()
    window.files.open_path(path)
    assert not window.findings.isVisible()


def test_escape_cancels_a_task_and_waits_for_its_end(window: MainWindow) -> None:
    def work(progress, cancel):
        progress("begun", 1, 2)
        assert cancel.wait(20)
        return "ended"

    during(lambda dialog: dialog.reject())
    assert ProgressDialog("Work", work, window).run() == "ended"
    assert not Task.running


class Closed:
    """What is left of a closed window: garbage in a cycle, that notes which thread it ends in."""

    ended_in: ClassVar[list[int]] = []

    def __init__(self) -> None:
        self.itself = self

    def __del__(self) -> None:
        self.ended_in.append(threading.get_ident())


def test_a_closed_window_is_never_collected_by_the_thread_of_a_task(
    window: MainWindow, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Closed, "ended_in", [])
    timer = QApplication.instance().findChild(QTimer, "garbage")
    timer.setInterval(10)

    def work(progress, cancel):
        for _ in range(50):
            Closed()
            assert [[] for _ in range(1000)]  # enough to make Python collect
        while not Closed.ended_in:
            cancel.wait(0.01)
        return threading.get_ident()

    before = gc.get_threshold()
    gc.set_threshold(100, 1, 1)
    try:
        worker = ProgressDialog("Work", work, window).run()
    finally:
        gc.set_threshold(*before)
        timer.setInterval(garbage.COLLECT_MS)
    assert worker not in Closed.ended_in


class Waste:
    """What is left of a closed window, that is in the way of what Qt does."""

    def __init__(self) -> None:
        self.itself, self.widget = self, QWidget()


def test_garbage_is_collected_by_the_event_loop_alone(window: MainWindow) -> None:
    """Collected while Qt destroys another object, a window waits for a lock for ever."""
    seen: list[str] = []
    gc.callbacks.append(note := lambda phase, _: seen.append(phase))
    before = gc.get_threshold()
    gc.set_threshold(10, 1, 1)
    try:
        for _ in range(20):
            Waste()
            QWidget(window).deleteLater()
        QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
        assert seen == []
        garbage.collect()
        assert seen == ["start", "stop"]
    finally:
        gc.set_threshold(*before)
        gc.callbacks.remove(note)


def test_after_an_opening_only_the_youngest_garbage_is_looked_at(window: MainWindow) -> None:
    """What a file needs has just been made and stays: a look at all of it costs a frame of a scrolling
    table.
    """
    seen: list[int] = []
    gc.callbacks.append(
        note := lambda phase, about: seen.append(about["generation"]) if phase == "stop" else None
    )
    before = gc.get_threshold()
    gc.set_threshold(10, 1, 1)
    try:
        for remaining in (60_000, 0):
            garbage.set_apart(window)
            garbage._opening.setRemainingTime(remaining)
            gc.collect(0), gc.collect(0)
            seen.clear()
            kept = [[] for _ in range(1000)]
            garbage.collect()
            assert (len(kept), seen) == (1000, [0 if remaining else 1])
    finally:
        gc.set_threshold(*before)
        gc.callbacks.remove(note)


def test_a_thread_lets_the_window_have_its_turn_within_a_millisecond(window: MainWindow) -> None:
    """Python's own five are paid several times while one frame is painted."""
    assert ProgressDialog("Work", lambda *_: sys.getswitchinterval(), window).run() <= 0.001


def test_a_silence_is_shown_below_what_is_waited_for_and_goes(window: MainWindow) -> None:
    texts: list[str] = []

    def work(progress, cancel):
        progress("keep", 1, 2)
        progress("silent", 2, 20)
        assert cancel.wait(20)
        progress("silent", 3, 20)
        progress("silent", 0, 20)

    dialog = ProgressDialog("Work", work, window, "Waiting …", {"keep": "Reading …"})

    def note(*_: object) -> None:
        texts.append(dialog.text.text())
        if len(texts) == 2:
            dialog.reject()

    dialog.task.progressed.connect(note)
    dialog.run()
    assert texts == [
        "Reading …",
        "Reading …\nNo answer for 2 s, trying again …",
        "Stopping at the next safe point …\nNo answer for 3 s, trying again …",
        "Stopping at the next safe point …",
    ]
    assert (dialog.bar.value(), dialog.bar.maximum()) == (1, 2), "the bar stands where it was"


def test_what_goes_wrong_in_a_task_is_raised_to_whoever_waits(window: MainWindow, user: User) -> None:
    def work(progress, cancel):
        raise OSError("the disk is on fire")

    window.guarded(lambda: ProgressDialog("Work", work, window).run())
    assert user.reads() == "the disk is on fire"


def test_a_task_that_cannot_be_cancelled_ignores_escape(window: MainWindow) -> None:
    def work(progress, cancel):
        assert not cancel.wait(0.2)
        return "whole"

    during(lambda dialog: dialog.reject())
    assert ProgressDialog("Work", work, window, cancellable=False).run() == "whole"


def test_a_closed_file_leaves_nothing_behind_once_the_window_rests(path: Path) -> None:
    """What belongs to an open file is left out of collections. What follows the signals of a workspace, and
    with it all that was made for its file, was kept for good. A separate program has few objects to go
    through: those of all tests take seconds.
    """
    done = subprocess.run(
        [sys.executable, "-c", CLOSED, str(path)], capture_output=True, text=True, timeout=60, check=False
    )
    assert (done.returncode, done.stdout) == (0, ""), done.stderr


@pytest.mark.skipif(sys.platform != "linux", reason="names are bytes on Linux")
def test_a_name_that_is_no_text_of_the_locale_ends_nothing(path: Path, tmp_path: Path) -> None:
    """It was handed to Qt, which ended with a segmentation fault."""
    odd = tmp_path / os.fsdecode(b"m\xfcl.amp")
    odd.write_bytes(path.read_bytes())
    done = subprocess.run([sys.executable, "-c", OPENED, odd], capture_output=True, check=False)
    assert (done.returncode, b"Traceback" in done.stderr) == (0, False)
