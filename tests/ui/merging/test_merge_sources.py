"""What can be compared: files, versions, axes, controls, and what was taken when a source changes."""

from pathlib import Path

import pytest

from amp_studio.files import Document, backup_path, content_of, new_file, open_file
from amp_studio.schema import Value
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.merge.columns import B
from amp_studio.ui.merge.sources import MergeSource
from amp_studio.ui.merge.window import MergeWindow
from tests.ui.conftest import WAIT_MS, User, action

from .steps import EXCESS, choose, is_read, press, show


def test_another_file_is_chosen_and_its_axes_are_matched_by_letter(
    displayed: MergeWindow, window: MainWindow, user: User, path: Path, qtbot
) -> None:
    file = new_file("9pc", "mill", ["Y", "X"])
    other = path.with_name("other.amp")
    Document.create(file, other).close()
    user.chooses(other)
    choose(displayed, B, "Another File…")
    qtbot.waitUntil(is_read(displayed), timeout=WAIT_MS)
    assert displayed.chosen[B].title == "other.amp"
    assert "Axis Y is axis 1 in other.amp; it is compared with axis 2 here." in displayed.message.text.text()


def test_a_file_of_another_family_is_refused_in_one_sentence(
    displayed: MergeWindow, user: User, path: Path, qtbot
) -> None:
    other = path.with_name("other.amp")
    Document.create(new_file("num"), other).close()
    user.chooses(other)
    choose(displayed, B, "Another File…")
    qtbot.waitUntil(is_read(displayed), timeout=WAIT_MS)
    assert "only files of one family can be compared" in displayed.message.text.text()
    assert displayed.chosen[B].is_now


@pytest.mark.parametrize(
    ("names", "excess"),
    [
        (["As Last Saved"], 5.0),
        (["As Opened"], 11.0),
        (["On Disk"], 5.0),
        (["Backup"], 11.0),
        (["Default Values"], 203.2),
    ],
)
def test_versions_of_the_file_are_sources(
    window: MainWindow, displayed: MergeWindow, names: list[str], excess: float, qtbot
) -> None:
    window.edits.commit(EXCESS, "5 mm")
    assert window.save()
    window.edits.commit(EXCESS, "6 mm")
    choose(displayed, B, *names)
    qtbot.waitUntil(is_read(displayed), timeout=WAIT_MS)
    assert displayed.merge.b.get(EXCESS) == Value(excess, "mm")


def test_the_menu_of_sources_has_a_head_over_each_part(displayed: MergeWindow) -> None:
    displayed.head.buttons[B].fill()
    rows = displayed.head.buttons[B].menu().actions()
    heads = [a.text() for a in rows if not a.isEnabled() and not a.isSeparator()]
    assert heads == ["This File", "Other Files", "Control"]
    assert not any(a.text() for a in rows if a.isSeparator())  # a style sheet shows no text there


def test_an_earlier_save_is_a_source(window: MainWindow, displayed: MergeWindow, qtbot) -> None:
    window.edits.commit(EXCESS, "5 mm")
    assert window.save()
    displayed.head.buttons[B].fill()
    (earlier,) = (a for a in displayed.head.buttons[B].menu().actions() if a.text() == "&Earlier Saves")
    earlier.menu().actions()[0].trigger()
    qtbot.waitUntil(is_read(displayed), timeout=WAIT_MS)
    assert displayed.merge.b.get(EXCESS) == Value(11.0, "mm")


def test_one_axis_is_compared_with_another(displayed: MergeWindow, window: MainWindow, qtbot) -> None:
    window.edits.commit(EXCESS, "5 mm")
    choose(displayed, B, "Another Axis", "In the Place of Axis X", "Axis Y")
    qtbot.waitUntil(is_read(displayed), timeout=WAIT_MS)
    assert displayed.merge.b.get(EXCESS) == window.workspace.file.get(("servo.excess_error", "2"))
    assert displayed.chosen[B].title == "Axis Y"


def test_a_control_that_does_not_answer_can_be_cancelled_and_the_source_before_it_stays(
    displayed: MergeWindow, qtbot
) -> None:
    def read(progress, cancel) -> MergeSource:
        assert cancel.wait(WAIT_MS / 1000)
        raise OSError("stopped")

    displayed.read(B, read)
    qtbot.waitUntil(displayed.reading.isVisible, timeout=WAIT_MS)
    displayed.reading.cancel.click()
    qtbot.waitUntil(is_read(displayed), timeout=WAIT_MS)
    assert not displayed.reading.isVisible()
    assert (displayed.chosen[B].is_now, displayed.message.isVisible()) == (True, False)


def test_a_file_without_unsaved_work_is_compared_with_its_backup_first(window: MainWindow, qtbot) -> None:
    window.edits.commit(EXCESS, "5 mm")
    assert window.save()
    assert backup_path(window.workspace.path).is_file()
    action(window, "Compare and Merge With").trigger()
    displayed = window.findChild(MergeWindow)
    qtbot.waitUntil(lambda: displayed.chosen[B].title == "Backup", timeout=WAIT_MS)
    assert [row.address for row in displayed.merge.differing] == [EXCESS]


def test_what_was_taken_from_a_source_is_not_taken_from_the_next_one(three: MergeWindow) -> None:
    show(three, EXCESS)
    press(three, "b")
    other = three.merge.b.copy()
    other.set(EXCESS, Value(2.0, "mm"))
    three.use(B, MergeSource("other.amp", "", other))
    assert [row.address for row in three.merge.open_conflicts] == [EXCESS]


def test_another_open_file_is_a_source(window: MainWindow, displayed: MergeWindow, path: Path, qtbot) -> None:
    second = path.with_name("second.amp")
    file = open_file(path).file
    file.set(EXCESS, Value(3.0, "mm"))
    second.write_bytes(content_of(file))
    window.open_first(second)
    choose(displayed, B, "second.amp")
    qtbot.waitUntil(is_read(displayed), timeout=WAIT_MS)
    assert displayed.merge.b.get(EXCESS) == Value(3.0, "mm")
