"""The result of a comparison goes into the file as one step, into a new file, or on paper."""

import gc
import weakref
from pathlib import Path

from PySide6.QtCore import QEvent, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from amp_studio.files import content_of, open_file
from amp_studio.schema import Value
from amp_studio.ui.base.task import Task
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.merge.columns import BASE, NAME, RESULT, A, B
from amp_studio.ui.merge.sources import MergeSource
from amp_studio.ui.merge.window import MergeWindow
from tests.ui.conftest import WAIT_MS, User, on_disk

from .steps import CALIBRATION, EXCESS, RAPID, is_read, merge, press, result, show


def test_the_result_goes_into_the_file_as_one_step_once_no_conflict_is_left(
    three: MergeWindow, window: MainWindow, qtbot
) -> None:
    file = window.workspace.file
    assert not three.outcome.merge.isEnabled()
    show(three, EXCESS)
    press(three, "b")
    with qtbot.waitSignal(three.destroyed, timeout=WAIT_MS):
        merge(three, qtbot)
    assert [file.get(a) for a in (EXCESS, CALIBRATION, RAPID)] == [
        Value(13.0, "mm"),
        Value(1.0, "mm"),
        Value(190.0, "mm/s"),
    ]
    assert "Merged with CNC_1" in window.page.bar.text.text()
    window.menus["edit.undo"].trigger()
    assert (file.get(EXCESS), file.get(RAPID)) == (Value(12.0, "mm"), Value(10000.0, "mm/min"))


def test_header_and_unknown_entries_come_along_and_go_back_with_one_undo(
    window: MainWindow, displayed: MergeWindow, qtbot
) -> None:
    file = window.workspace.file
    before = content_of(file)
    other = file.copy()
    other.header.notes, other.unknown["future.thing"] = "new spindle", "7"
    displayed.use(B, MergeSource("other.amp", "", other))
    displayed.tree.selectAll()
    press(displayed, "b")
    merge(displayed, qtbot)
    assert (file.header.notes, file.unknown) == ("new spindle", {"future.thing": "7"})
    assert window.workspace.is_dirty
    assert window.save()
    assert on_disk(window.workspace.path).unknown == {"future.thing": "7"}
    window.menus["edit.undo"].trigger()
    assert content_of(file) == before


def test_new_errors_are_shown_before_the_file_gets_them(
    window: MainWindow, displayed: MergeWindow, qtbot
) -> None:
    other = window.workspace.file.copy()
    other.values[EXCESS] = Value(0.5, "mm")
    displayed.use(B, MergeSource("other.amp", "", other))
    show(displayed, EXCESS)
    press(displayed, "b")
    qtbot.waitUntil(displayed.outcome.findings_button.isEnabled, timeout=WAIT_MS)
    assert "1 new error" in displayed.outcome.findings_button.text()
    displayed.outcome.merge.click()
    assert displayed.findings.isVisible()
    assert window.workspace.file.get(EXCESS) == Value(11.0, "mm"), "nothing has been changed yet"
    assert "Anyway" in displayed.outcome.merge.text()
    displayed.outcome.merge.click()
    assert window.workspace.file.get(EXCESS) == Value(0.5, "mm")


def test_a_result_that_cannot_be_checked_is_not_merged(displayed: MergeWindow, monkeypatch, qtbot) -> None:
    def fail(*_: object) -> None:
        raise ValueError("no such rule")

    monkeypatch.setattr("amp_studio.ui.merge.check.ResultCheck", fail)
    other = displayed.merge.a.copy()
    other.set(EXCESS, Value(12.0, "mm"))
    displayed.use(B, MergeSource("other.amp", "", other))
    displayed.model.choose(displayed.merge.differing, "b")
    qtbot.waitUntil(displayed.message.isVisible, timeout=WAIT_MS)
    assert displayed.message.text.text() == "The result cannot be checked, and so not merged: no such rule"
    assert not displayed.outcome.merge.isEnabled()


def test_the_result_is_saved_as_a_new_file_and_the_open_one_stays(
    three: MergeWindow, window: MainWindow, user: User, tmp_path: Path
) -> None:
    show(three, EXCESS)
    press(three, "b")
    mine = window.workspace
    mine.path.write_text(mine.path.read_text().replace("\nvalues:", "\n# by J. Doe\nvalues:", 1))
    user.chooses(tmp_path / "merged.amp")
    three.outcome.save.click()
    merged = on_disk(tmp_path / "merged.amp")
    assert (merged.get(EXCESS), merged.get(CALIBRATION)) == (Value(13.0, "mm"), Value(1.0, "mm"))
    assert "# by J. Doe" in (tmp_path / "merged.amp").read_text(), "remarks stay"
    assert mine.file.get(EXCESS) == Value(12.0, "mm")


def test_the_comparison_is_written_as_a_report(three: MergeWindow, user: User, tmp_path: Path) -> None:
    user.chooses(tmp_path / "comparison.csv")
    three.outcome.report.click()
    written = (tmp_path / "comparison.csv").read_text("utf-8-sig")
    assert "not settled" in written
    assert "Rapid Feedrate for Positioning" in written
    assert three.message.text.text() == "comparison.csv written."


def test_a_lathe_is_compared_with_a_mill_and_what_exists_there_only_is_named(
    displayed: MergeWindow, window: MainWindow, checkout: Path
) -> None:
    lathe = open_file(checkout / "examples" / "lathe-ls176" / "LATHE_LS176.amp").file
    source = displayed.sources.other(window.workspace.file, lathe, "LATHE_LS176.amp", "")
    displayed.use(B, source)
    assert "another machine type (lathe)" in displayed.message.text.text()
    displayed.view.only_differences.click()
    only_there = [
        r for r in displayed.merge.differing if r.id.part == "value" and not displayed.model.may_type(r)
    ]
    assert only_there
    for row in displayed.merge.rows:
        assert all(displayed.model.text(row, column) is not None for column in range(RESULT + 1))
    displayed.view.only_active.click()
    displayed.tree.show_row(only_there[0])
    displayed.view.only_active.click()
    displayed.tree.show_row(only_there[0])
    assert "not on this machine type" in displayed.detail.facts.text()


def test_a_group_that_was_folded_stays_folded(three: MergeWindow, window: MainWindow, qtbot) -> None:
    head = three.model.index(0, NAME)
    three.tree.setExpanded(head, False)
    window.edits.commit(("home.calibration", "2"), "1 mm")
    qtbot.waitUntil(lambda: len(three.merge.differing) == 4, timeout=WAIT_MS)
    folds = [three.tree.isExpanded(three.model.index(n, NAME)) for n in range(len(three.model.groups))]
    assert folds == [False, *[True] * (len(folds) - 1)]


def test_the_machine_type_and_entries_of_others_are_taken_and_not_typed(displayed: MergeWindow) -> None:
    other = displayed.merge.a.copy()
    other.header.notes, other.header.extra, other.unknown["future.thing"] = "n", {"bay": 7}, "1"
    displayed.use(B, MergeSource("other.amp", "", other))
    can = {row.id.key: displayed.model.may_type(row) for row in displayed.merge.differing}
    assert can == {"notes": True, "extra.bay": False, "future.thing": False}


def test_two_sources_of_which_none_is_the_open_file_are_not_merged_into_it(displayed: MergeWindow) -> None:
    other = displayed.merge.a.copy()
    other.set(EXCESS, Value(3.0, "mm"))
    displayed.show_merge(
        {A: MergeSource("one.amp", "", other), B: MergeSource("two.amp", "", displayed.merge.b)}
    )
    assert not displayed.outcome.merge.isEnabled()
    assert "Neither A nor B is the open file" in displayed.outcome.merge.toolTip()
    assert displayed.outcome.save.isEnabled()


def test_the_comparison_follows_an_edit_of_the_file_and_keeps_what_was_chosen(
    three: MergeWindow, window: MainWindow, qtbot
) -> None:
    show(three, EXCESS)
    press(three, "b")
    window.edits.commit(("home.calibration", "2"), "1 mm")
    qtbot.waitUntil(lambda: len(three.merge.differing) == 4, timeout=WAIT_MS)
    assert result(three, EXCESS) == Value(13.0, "mm")
    assert three.tree.row().address == EXCESS


def test_an_edit_just_before_merge_is_not_overwritten(three: MergeWindow, window: MainWindow, qtbot) -> None:
    show(three, EXCESS)
    press(three, "b")
    qtbot.waitUntil(three.outcome.merge.isEnabled, timeout=WAIT_MS)
    window.workspace.edit("just now", {CALIBRATION: Value(5.0, "mm")})
    three.outcome.merge.click()
    assert window.workspace.file.get(EXCESS) == Value(12.0, "mm"), "what is shown is not what would be merged"
    merge(three, qtbot)
    file = window.workspace.file
    assert (file.get(EXCESS), file.get(CALIBRATION)) == (Value(13.0, "mm"), Value(5.0, "mm"))


def test_without_a_base_there_are_no_conflicts_to_show(three: MergeWindow) -> None:
    three.view.only_conflicts.click()
    three.view.two.click()
    assert not three.view.only_conflicts.isChecked()
    assert len(three.model.groups) == len({three.merge.group_title(row) for row in three.merge.differing})
    three.view.three.click()
    assert three.chosen[BASE].title == "Last saved"


def test_it_closes_with_escape_and_with_its_file(three: MergeWindow, window: MainWindow, qtbot) -> None:
    three.merge.take("b")
    again = window.files.comparing.open(window.page)
    with qtbot.waitSignal(again.destroyed, timeout=WAIT_MS):
        QTest.keyClick(again, Qt.Key.Key_Escape)
    with qtbot.waitSignal(three.destroyed, timeout=WAIT_MS):
        window.close_page(window.page)


def test_a_comparison_that_has_read_a_source_is_freed(window: MainWindow, qtbot) -> None:
    """A connection of its task that leads to the task keeps the window, with both files."""
    displayed = window.files.comparing.open(window.page)
    displayed.start(B, displayed.sources.defaults)
    qtbot.waitUntil(is_read(displayed), timeout=WAIT_MS)
    qtbot.waitUntil(lambda: not Task.running, timeout=WAIT_MS)
    kept = weakref.ref(displayed.merge)
    displayed.close()
    del displayed
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    qtbot.waitUntil(lambda: gc.collect(1) >= 0 and kept() is None, timeout=WAIT_MS)


def test_another_comparison_takes_the_place_of_one_without_choices(
    three: MergeWindow, window: MainWindow, qtbot
) -> None:
    comparing = window.files.comparing
    with qtbot.waitSignal(three.destroyed, timeout=WAIT_MS):
        second = comparing.open(window.page)
    other = window.workspace.file.copy()
    other.set(EXCESS, Value(14.0, "mm"))
    second.use(B, MergeSource("CNC_1", "", other))
    second.merge.take("b")
    comparing.compare()
    comparing.open(window.page).close()
    assert window.beside.of(MergeWindow, window.workspace) == [second], "with what was chosen in it"
