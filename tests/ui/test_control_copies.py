"""A copy of a control that was kept goes back, from the window."""

from pathlib import Path

from pytestqt.qtbot import QtBot

from amp_studio.transfer.client import parameters
from amp_studio.transfer.image import encode_image
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
    assert f"contains what is in {kept.name}." in page.empty.text()
    assert parameters.fetch_image(control.address) == before


def test_nothing_of_a_control_can_be_kept_while_a_copy_goes_back_as_a_whole(
    window: MainWindow, start_control: Start, user: User, qtbot: QtBot
) -> None:
    """A copy goes back byte for byte: a value that seemed to be kept was replaced."""
    file = nearly(window)
    pitch = ("servo.lead_screw_pitch", "1")
    control = start_control(file=file)
    kept = window.workspace.path.with_name("mill.before-1.img")
    file.set(pitch, None)
    kept.write_bytes(encode_image(file))
    page = at_control(window, control.address, "compare", qtbot)
    user.chooses(kept)
    action(window, "Restore Control From Backup").trigger()
    row = page.table.rows[pitch]
    assert (row.takes_file, row.is_fixed, page.row.keep.isHidden()) == (True, True, True)
    page.table.take([pitch], file=False)
    assert page.table.rows[pitch].takes_file
    assert "stay" not in page.counts.text()
    page.turn("compare")
    assert not page.table.rows[("servo.excess_error", "1")].is_fixed, "values of a file are chosen again"


def test_the_end_of_a_restore_names_the_copy_and_calls_no_old_value_new(
    window: MainWindow, start_control: Start, user: User, path: Path, qtbot: QtBot
) -> None:
    control = start_control(file=nearly(window))
    page = sent(window, control.address, qtbot)
    (kept,) = path.parent.glob("mill.before-*.img")
    user.chooses(kept)
    action(window, "Restore Control From Backup").trigger()
    settled(window, qtbot)
    control.stop()
    page.checked.setChecked(True)
    page.press()
    settled(window, qtbot)
    assert page.bar.text.text().startswith("Nothing was sent to the control.")


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
