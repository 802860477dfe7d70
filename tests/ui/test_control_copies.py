"""A copy of a control that was kept goes back, from the window."""

from __future__ import annotations

from pathlib import Path

from pytestqt.qtbot import QtBot

from amp_studio.transfer.client import parameters
from amp_studio.ui.main_window import MainWindow

from .at_control import at_control, nearly, sent, settled
from .conftest import User, action
from .test_control import Start


def test_a_kept_copy_goes_back_byte_for_byte_after_a_look_at_what_that_changes(
    window: MainWindow, start_control: Start, user: User, qtbot: QtBot
) -> None:
    control = start_control(file=nearly(window))
    before = parameters.fetch_image(control.address)
    page = sent(window, control.address, qtbot)
    (kept,) = window.workspace.path.parent.glob("mill.before-*.img")
    page.connect_again()
    settled(window, qtbot)
    user.chooses(kept)
    action(window, "Restore Control From Backup").trigger()
    assert page.primary.text() == f"Restore {kept.name}"
    assert len(page.table.rows) == 3
    page.checked.setChecked(True)
    page.press()
    settled(window, qtbot)
    assert "Restore complete and read back equal" in page.empty.text()
    assert parameters.fetch_image(control.address) == before


def test_garbage_that_was_kept_is_shown_to_be_so_before_it_goes_back(
    window: MainWindow, start_control: Start, user: User, path: Path, tmp_path: Path, qtbot: QtBot
) -> None:
    garbage = b"\x00 no image"
    (tmp_path / "control-0").mkdir()
    (tmp_path / "control-0" / "active.img").write_bytes(garbage)
    control = start_control()
    page = at_control(window, control.address, "send", qtbot)
    page.press()
    settled(window, qtbot)
    (kept,) = path.parent.glob("mill.before-*.img")
    page.connect_again()
    settled(window, qtbot)
    user.chooses(kept)
    action(window, "Restore Control From Backup").trigger()
    assert "cannot be shown" in page.bar.text.text()
    assert parameters.fetch_image(control.address) != garbage
    page.press()
    settled(window, qtbot)
    assert parameters.fetch_image(control.address) == garbage


def test_a_copy_that_was_changed_is_not_put_back(window: MainWindow, user: User, tmp_path: Path) -> None:
    copy = tmp_path / "mill.before-1.img"
    copy.write_bytes(b"changed")
    copy.with_name(copy.name + ".sha256").write_text("0" * 64, encoding="ascii")
    user.chooses(copy)
    action(window, "Restore Control From Backup").trigger()
    assert "is not what was kept" in user.reads()
