"""A copy of a control that was kept goes back, from the window."""

from __future__ import annotations

from pathlib import Path

from amp_studio.transfer.client import parameters
from amp_studio.ui.control.download_preview import DownloadPreview
from amp_studio.ui.main_window import MainWindow

from .conftest import Person, action
from .test_control import Start, download


def test_a_kept_copy_goes_back_byte_for_byte_after_a_look_at_what_that_changes(
    window: MainWindow, start_control: Start, person: Person, accept
) -> None:
    control = start_control()
    before = parameters.fetch_image(control.address)
    previews = []
    accept(DownloadPreview, lambda dialog: previews.append((dialog.windowTitle(), len(dialog.list.items))))
    download(window, person, control)
    (kept,) = window.workspace.path.parent.glob("mill.before-*.img")

    person.chooses(kept)
    person.types(control.address)
    action(window, "Restore Control From Backup").trigger()

    assert person.reads().startswith("Restore complete and read back equal")
    assert parameters.fetch_image(control.address) == before
    assert [title for title, _ in previews] == ["Download", "Restore"]
    assert previews[1][1] > 100


def test_garbage_that_was_kept_is_asked_about_before_it_goes_back(
    window: MainWindow, start_control: Start, person: Person, accept, path: Path, tmp_path: Path
) -> None:
    garbage = b"\x00 no image"
    (tmp_path / "control-0").mkdir()
    (tmp_path / "control-0" / "active.img").write_bytes(garbage)
    control = start_control()
    accept(DownloadPreview)
    person.answers("Download")
    download(window, person, control)
    (kept,) = path.parent.glob("mill.before-*.img")
    person.asked.clear()

    for answer, held in (("Cancel", False), ("Restore", True)):
        person.chooses(kept)
        person.types(control.address)
        person.answers(answer)
        action(window, "Restore Control From Backup").trigger()
        assert "cannot be shown" in person.asked[-1]
        assert (parameters.fetch_image(control.address) == garbage) is held
    assert person.reads().startswith("Restore complete and read back equal")


def test_a_copy_that_was_changed_is_not_put_back(window: MainWindow, person: Person, tmp_path: Path) -> None:
    copy = tmp_path / "mill.before-1.img"
    copy.write_bytes(b"changed")
    copy.with_name(copy.name + ".sha256").write_text("0" * 64, encoding="ascii")
    person.chooses(copy)
    action(window, "Restore Control From Backup").trigger()
    assert "is not what was kept" in person.reads()
