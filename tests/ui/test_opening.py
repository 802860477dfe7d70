"""Opening: two programs on one file notice each other, and the work of a killed one is offered."""

import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from amp_studio.files import Document
from amp_studio.schema import Value
from amp_studio.ui.main_window import MainWindow

from .conftest import WAIT_MS, User, action, on_disk
from .killed import kill_editor

EXCESS = ("servo.excess_error", "1")
EDITED = Value(3.0, "mm")

OTHER_PROGRAM = """
import sys
from pathlib import Path
from amp_studio.files import Document
from amp_studio.files import Document
from amp_studio.schema import Value
document = Document.open(Path(sys.argv[1]))
if "edit" in sys.argv:
    document.file.set(("servo.excess_error", "1"), Value(3.0, "mm"))
    document.file.set(("home.calibration", "2"), None)
    document.unsaved_writer()()
print("ready", flush=True)
sys.stdin.read()
"""


@pytest.fixture
def other_program(path: Path) -> Iterator[Callable[..., subprocess.Popen[str]]]:
    """Return what starts another program on the file; it has the lock until it is killed."""
    started: list[subprocess.Popen[str]] = []

    def start(*options: str) -> subprocess.Popen[str]:
        command = [sys.executable, "-c", OTHER_PROGRAM, str(path), *options]
        process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        started.append(process)
        assert process.stdout is not None
        assert process.stdout.readline() == "ready\n"
        return process

    yield start
    for process in started:
        process.kill()
        process.communicate()


def edit(window: MainWindow) -> None:
    """Make one unsaved change."""
    window.edits.commit(EXCESS, "3 mm")


def test_a_file_that_is_none_is_reported_and_the_open_one_stays(
    window: MainWindow, tmp_path: Path, user: User
) -> None:
    bad = tmp_path / "bad.amp"
    bad.write_text("nonsense")
    user.chooses(bad)

    action(window, "Open").trigger()

    assert "bad.amp" in user.reads()
    assert window.workspace.may_edit


def test_unsaved_changes_are_asked_about_before_a_file_is_closed(
    window: MainWindow, path: Path, user: User
) -> None:
    edit(window)
    user.answers("Cancel", "Discard")

    window.files.close()
    assert window.workspace.path == path
    window.files.close()
    assert window.workspace is None
    assert on_disk(path).get(EXCESS) == Value(11.0, "mm")


def test_a_file_in_use_can_be_looked_at_only(open_window, path: Path, user: User, other_program) -> None:
    other_program()
    user.answers("Open Read-Only")

    window = open_window(path)

    assert "is open in another program" in user.asked[0]
    assert "[read-only]" in window.windowTitle()
    assert not action(window, "Save").isEnabled()
    assert not action(window, "Delete Axis").isEnabled()
    assert not action(window, "Clear (Not Set)").isEnabled()
    assert action(window, "Save As").isEnabled()
    index = window.table.index_of(("control.type", ""))
    from PySide6.QtCore import Qt

    assert not index.flags() & Qt.ItemFlag.ItemIsEditable
    user.chooses(path.with_name("mine"))
    window.files.save_as()
    assert window.workspace.may_edit


def test_a_file_in_use_need_not_be_opened(open_window, path: Path, user: User, other_program) -> None:
    other_program()
    user.answers("Cancel")
    assert open_window(path).workspace is None


def test_the_work_of_a_killed_program_is_offered_and_can_be_undone(
    open_window, path: Path, user: User, other_program
) -> None:
    killed = other_program("edit")
    killed.send_signal(signal.SIGKILL)
    killed.wait()
    user.answers("Recover")

    window = open_window(path)

    assert "2 changes" in user.asked[0]
    assert window.workspace.file.get(EXCESS) == EDITED
    assert window.workspace.file.get(("home.calibration", "2")) is None
    assert window.workspace.is_dirty
    window.menus["edit.undo"].trigger()
    assert window.workspace.file.values == on_disk(path).values


def test_the_work_of_a_killed_program_can_be_thrown_away_or_left(
    open_window, path: Path, user: User, other_program
) -> None:
    killed = other_program("edit")
    killed.kill()
    killed.wait()
    user.answers("Decide Later", "Discard")

    window = open_window(path)
    assert window.workspace is None
    window.open_first(path)
    assert window.workspace.file.get(EXCESS) == Value(11.0, "mm")
    window.open_first(path)
    assert len(user.asked) == 2


def test_unsaved_work_is_kept_beside_the_file_while_one_types(window: MainWindow, path: Path, qtbot) -> None:
    """Also by who never pauses: the next edit does not put it off."""
    journal = window.workspace.document.journal_path
    edit(window)
    deadline = window.workspace._journal.remainingTime()
    window.edits.commit(EXCESS, "4 mm")
    assert window.workspace._journal.remainingTime() <= deadline
    qtbot.waitUntil(journal.exists, timeout=WAIT_MS)
    assert window.save()
    assert not journal.exists()


def test_nothing_entered_more_than_a_second_before_a_kill_is_lost(path: Path) -> None:
    """Values, the name of the machine and the notes."""
    assert kill_editor(path, seed=12) == []


def test_notes_and_name_of_a_killed_program_are_offered_too(open_window, path: Path, user: User) -> None:
    document = Document.open(path)
    document.file.header.notes, document.file.header.name = "new belt", "the other mill"
    document.unsaved_writer()()
    document._lock.release()  # as the system does when the program is killed
    user.answers("Recover")

    window = open_window(path)

    assert "2 changes" in user.asked[0]
    header = window.workspace.file.header
    assert (header.notes, header.name) == ("new belt", "the other mill")
    assert window.workspace.is_dirty
    assert window.save()
    assert (on_disk(path).header.notes, on_disk(path).header.name) == ("new belt", "the other mill")
