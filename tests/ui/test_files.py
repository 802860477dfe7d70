"""New, save, save as, recover, facts, close: nothing is lost."""

import os
from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtCore import QStandardPaths
from PySide6.QtWidgets import QFileDialog

from amp_studio.files import Document, backup_path, content_of, open_file
from amp_studio.files.example_files import examples
from amp_studio.schema import Value
from amp_studio.ui.dialogs import file_dialogs
from amp_studio.ui.dialogs.new_file_dialog import NewFileDialog
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.merge.window import MergeWindow

from .conftest import WAIT_MS, User, action, on_disk

EXCESS = ("servo.excess_error", "1")
EDITED = Value(3.0, "mm")


def edit(window: MainWindow) -> None:
    """Make one unsaved change."""
    window.edits.commit(EXCESS, "3 mm")


def click(window: MainWindow, name: str) -> None:
    """Click a button of the message bar."""
    (button,) = [b for b in window.page.bar.buttons if b.text().replace("&", "") == name]
    button.click()


# -- saving --------------------------------------------------------------------


def test_save_writes_the_file_and_keeps_the_one_before(
    window: MainWindow, path: Path, example: bytes
) -> None:
    edit(window)
    assert window.isWindowModified()

    action(window, "Save").trigger()

    assert on_disk(path).get(EXCESS) == EDITED
    assert backup_path(path).read_bytes() == example
    assert not window.isWindowModified()
    assert "saved" in window.status.file.text()


def test_undo_after_a_save_is_unsaved_again(window: MainWindow) -> None:
    edit(window)
    assert window.save()
    window.menus["edit.undo"].trigger()
    assert window.isWindowModified()
    window.menus["edit.redo"].trigger()
    assert not window.isWindowModified()


def test_a_file_changed_on_disk_is_not_overwritten(window: MainWindow, path: Path, user: User, qtbot) -> None:
    edit(window)
    path.write_bytes(path.read_bytes() + b"# touched\n")
    touched = path.read_bytes()

    assert not window.save()  # before the watch has noticed

    assert "changed by another program" in window.page.bar.text.text()
    assert path.read_bytes() == touched
    assert window.workspace.file.get(EXCESS) == EDITED


def test_after_a_comparison_with_the_file_on_disk_the_work_can_be_saved_and_neither_is_lost(
    window: MainWindow, path: Path, qtbot
) -> None:
    edit(window)
    other = open_file(path).file
    other.set(("home.calibration", "2"), Value(7.0, "mm"))
    path.write_bytes(content_of(other))
    theirs = path.read_bytes()
    qtbot.waitUntil(window.page.bar.isVisible, timeout=WAIT_MS)

    click(window, "Compare…")
    displayed = window.findChild(MergeWindow)
    kinds = {row.address: row.kind for row in displayed.merge.differing}
    assert kinds == {EXCESS: "a", ("home.calibration", "2"): "b"}, "what was saved last is the base"
    qtbot.waitUntil(displayed.outcome.merge.isEnabled, timeout=WAIT_MS)
    displayed.outcome.merge.click()
    assert window.save()

    saved = on_disk(path)
    assert (saved.get(EXCESS), saved.get(("home.calibration", "2"))) == (EDITED, Value(7.0, "mm"))
    assert backup_path(path).read_bytes() == theirs


def test_a_reload_asks_before_unsaved_changes_are_lost(
    window: MainWindow, path: Path, user: User, qtbot
) -> None:
    edit(window)
    path.write_bytes(path.read_bytes() + b"# touched\n")
    qtbot.waitUntil(window.page.bar.isVisible, timeout=WAIT_MS)
    user.answers("Cancel")

    click(window, "Reload")

    assert "unsaved changes will be lost" in user.asked[0]
    assert window.workspace.file.get(EXCESS) == EDITED


@pytest.mark.parametrize("replace", [True, False], ids=["renamed over", "written in place"])
def test_a_change_on_disk_is_noticed_and_loaded_when_wanted(
    window: MainWindow, path: Path, user: User, qtbot, replace: bool
) -> None:
    window.go_to(("home.calibration", "2"))
    changed = open_file(path).file
    changed.set(EXCESS, EDITED)
    if replace:
        beside = path.with_name("beside")
        beside.write_bytes(content_of(changed))
        beside.replace(path)
    else:
        path.write_bytes(content_of(changed))

    qtbot.waitUntil(window.page.bar.isVisible, timeout=WAIT_MS)
    click(window, "Reload")

    assert window.workspace.file.get(EXCESS) == EDITED
    assert window.selected() == ("home.calibration", "2")
    assert window.workspace.may_edit


def test_a_file_that_was_broken_on_disk_leaves_the_work_open(
    window: MainWindow, path: Path, user: User, qtbot
) -> None:
    edit(window)
    path.write_bytes(b"amp_studio: 1\n")
    qtbot.waitUntil(window.page.bar.isVisible, timeout=WAIT_MS)
    user.answers("Reload")

    click(window, "Reload")

    user.reads()
    assert window.workspace.file.get(EXCESS) == EDITED
    assert window.workspace.may_edit


def test_a_removed_file_is_reported_and_can_be_saved_elsewhere(
    window: MainWindow, path: Path, user: User, qtbot
) -> None:
    path.unlink()
    qtbot.waitUntil(window.page.bar.isVisible, timeout=WAIT_MS)
    assert "was removed" in window.page.bar.text.text()
    user.chooses(path.with_name("again"))
    window.files.save_as()
    assert on_disk(path.with_name("again.amp")).get(EXCESS) == Value(11.0, "mm")


def test_our_own_save_is_no_change_by_another_program(window: MainWindow, user: User, qtbot) -> None:
    edit(window)
    assert window.save()
    qtbot.wait(600)
    assert not window.page.bar.isVisible()


def test_a_full_disk_leaves_the_work_open(
    window: MainWindow, user: User, monkeypatch: pytest.MonkeyPatch
) -> None:
    edit(window)

    def fail(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", fail)
    assert not window.save()
    monkeypatch.undo()

    assert "No space left on device" in user.shown_boxes.pop()
    assert window.workspace.is_dirty
    assert window.workspace._journal.isActive()


def test_save_as_leaves_the_original_and_goes_on_with_the_copy(
    window: MainWindow, path: Path, user: User
) -> None:
    window.go_to(EXCESS)
    edit(window)
    user.chooses(path.with_name("copy"))

    window.files.save_as()

    assert on_disk(path).get(EXCESS) == Value(11.0, "mm")
    assert on_disk(path.with_name("copy.amp")).get(EXCESS) == EDITED
    assert window.workspace.path.name == "copy.amp"
    assert window.workspace.file.header.name == "copy"
    assert window.selected() == EXCESS
    Document.open(path).close()  # its lock is free


def test_save_as_over_a_file_asks_and_keeps_it_as_backup(window: MainWindow, path: Path, user: User) -> None:
    other = path.with_name("other.amp")
    other.write_bytes(path.read_bytes())
    before = other.read_bytes()
    edit(window)
    user.chooses(other, other)
    user.answers("Cancel", "Replace")

    window.files.save_as()
    assert other.read_bytes() == before
    window.files.save_as()

    assert on_disk(other).get(EXCESS) == EDITED
    assert backup_path(other).read_bytes() == before


def test_save_as_over_a_file_another_program_edits_is_refused(
    window: MainWindow, path: Path, user: User
) -> None:
    other = path.with_name("other.amp")
    other.write_bytes(path.read_bytes())
    before = other.read_bytes()
    user.chooses(other)
    user.answers("Replace")
    with Document.open(other):
        window.guarded(window.files.save_as)

    assert "is open in another program" in user.reads()
    assert other.read_bytes() == before
    assert window.workspace.path == path


# -- new, recover, facts, close ------------------------------------------------


def test_a_new_file_has_its_axes_and_is_on_disk(open_window, tmp_path: Path, user: User, accept) -> None:
    window = open_window()

    def fill(dialog: NewFileDialog) -> None:
        dialog.form.set_answer("family", "9pc")
        dialog.form.set_answer("machine", "mill")
        dialog.form.set_answer("axes", "X, Z, S")

    accept(NewFileDialog, fill)
    user.chooses(tmp_path / "new")

    action(window, "New").trigger()

    assert window.table.titles == ["Control", "X 1 linear", "Z 2 linear", "S 3 spindle"]
    assert on_disk(tmp_path / "new.amp").machine == "mill"


def test_an_axis_name_that_is_not_offered_is_named_while_it_is_typed(open_window) -> None:
    dialog = NewFileDialog(open_window(), "9pc")
    dialog.form.set_answer("axes", "X, Q")
    assert "'Q'" in dialog.fault.text()
    assert not dialog.ok.isEnabled()
    dialog.accept()
    assert not dialog.result()
    dialog.form.set_answer("axes", "X, Z")
    assert dialog.ok.isEnabled()


def test_recover_backup_asks_and_shows_what_is_lost(
    window: MainWindow, path: Path, user: User, example: bytes
) -> None:
    window.guarded(window.files.recover)
    assert "has no backup yet" in user.reads()

    edit(window)
    assert window.save()
    window.edits.commit(EXCESS, "4 mm")
    user.answers("Cancel", "Replace")
    window.files.recover()
    assert "Your unsaved changes will be lost" in user.asked[-1]
    assert window.workspace.file.get(EXCESS) == Value(4.0, "mm")
    window.files.recover()

    assert path.read_bytes() == example
    assert window.workspace.file.get(EXCESS) == Value(11.0, "mm")
    assert window.workspace.may_edit


def test_machine_facts_are_a_step_and_save_nothing_by_themselves(
    window: MainWindow, path: Path, example: bytes, accept
) -> None:
    edit(window)
    accept(file_dialogs.FactsDialog, lambda d: d.form.set_answer("notes", "checked by two"))

    window.files.facts()

    assert window.workspace.file.header.notes == "checked by two"
    assert path.read_bytes() == example
    assert window.isWindowModified()
    window.menus["edit.undo"].trigger()
    assert window.workspace.file.header.notes != "checked by two"


def test_close_shows_the_welcome_page_with_the_file(window: MainWindow, path: Path) -> None:
    window.files.close()
    assert window.workspace is None
    assert window.windowTitle() == "AMP Studio"
    assert window.files.recent.paths() == [path]
    page = window.welcome
    assert page.isVisible()
    page.list.itemActivated.emit(page.list.item(0))
    assert window.workspace.path == path


def test_own_rules_beside_the_file_are_checked(open_window, path: Path) -> None:
    """A machine builder's own rules are in the same form beside his files."""
    path.with_name("rules.yaml").write_text(
        "rules:\n"
        "  - id: own.calibration\n"
        "    title: Calibration is never zero here\n"
        "    severity: warning\n"
        '    page: "1"\n'
        "    reads: {calibration: home.calibration}\n"
        "    check: calibration != 0.0\n"
        "    message: the calibration of axis {instance} is zero\n"
    )
    window = open_window(path)
    assert any(f.rule == "own.calibration" for f in window.workspace.findings)


def test_own_rules_that_cannot_be_read_are_a_finding(open_window, path: Path) -> None:
    path.with_name("rules.yaml").write_text("rules:\n  - nonsense\n")
    window = open_window(path)
    assert window.workspace.findings[0].message.startswith("rules.yaml, line 2: ")


def test_the_copy_of_an_example_is_not_offered_among_the_examples(
    open_window: Callable[..., MainWindow], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    offered: list[Path] = []

    def dialog(_parent: object, _title: str, path: str, *_: object, **__: object) -> tuple[str, str]:
        offered.append(Path(path))
        return "", ""

    monkeypatch.setattr(QFileDialog, "getSaveFileName", dialog)
    monkeypatch.setattr(QStandardPaths, "writableLocation", lambda _place: str(tmp_path))
    example = examples()[0].path
    open_window().files.open_example(example)
    open_window(example).files.open_example(example)
    assert offered == [tmp_path / example.name] * 2
