"""Download, verify and upload against an emulated control in a separate process."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from PySide6.QtWidgets import QDialogButtonBox
from pytestqt.qtbot import QtBot

from amp_studio.files import ParameterFile, content_of, new_file, open_file
from amp_studio.schema import Value
from amp_studio.transfer.client import parameters
from amp_studio.transfer.exchange import Exchange
from amp_studio.ui.base.task import ProgressDialog
from amp_studio.ui.control.download_preview import DownloadPreview
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.merge.model import BASE, B
from amp_studio.ui.merge.window import MergeWindow

from .conftest import WAIT_MS, Control, Person, action, during, on_disk

EXCESS = ("servo.excess_error", "1")
Start = Callable[..., Control]


def download(window: MainWindow, person: Person, control: Control) -> str:
    """Download the open file and return what is reported at the end."""
    person.types(control.address)
    action(window, "Download to Control").trigger()
    return person.reads()


def test_download_verify_upload(
    window: MainWindow, start_control: Start, person: Person, accept, tmp_path: Path
) -> None:
    """What a control gives back is what it was given, and what it contained before is kept beside the file."""
    control = start_control()
    previews = []
    accept(DownloadPreview, lambda dialog: previews.append(len(dialog.list.items)))

    said = download(window, person, control)

    assert said.startswith("Download complete and read back equal")
    assert previews[0] > 100
    kept = list(window.workspace.path.parent.glob("mill.before-*.img"))
    assert len(kept) == 1
    assert str(kept[0]) in said

    person.types(control.address)
    action(window, "Verify With Control").trigger()
    assert person.reads() == (
        f"Nothing differs: {len(window.workspace.file.values)} values and every byte are the same."
    )

    person.types(control.address)
    person.chooses(tmp_path / "from-control.amp")
    before = dict(window.workspace.file.values)
    action(window, "Upload From Control").trigger()
    assert window.workspace.path == tmp_path / "from-control.amp"
    assert window.workspace.file.values == before
    assert on_disk(tmp_path / "from-control.amp").values == before


def test_a_control_that_takes_single_settings_is_served_like_any_other(
    window: MainWindow, start_control: Start, person: Person, accept, tmp_path: Path
) -> None:
    control = start_control(family="grblhal", machine="grblhal")
    previews = []
    accept(DownloadPreview, lambda dialog: previews.append(len(dialog.list.items)))
    person.types(control.address)
    person.chooses(tmp_path / "router.amp")
    action(window, "Upload From Control").trigger()
    window.workspace.edit("travel", {window.workspace.file.find("$130"): Value(301.5, "mm")})
    assert window.save()

    assert download(window, person, control).startswith(
        "Download complete and read back equal. What it contained"
    )

    assert previews == [1]
    held = parameters.fetch_file(control.address)
    assert held.values[held.find("$130")] == Value(301.5, "mm")


def test_what_a_download_would_change_is_shown_first_and_can_be_left(
    window: MainWindow, start_control: Start, person: Person, monkeypatch
) -> None:
    control = start_control()
    held = parameters.fetch_file(control.address).values
    monkeypatch.setattr(DownloadPreview, "exec", lambda dialog: 0)
    person.types(control.address)

    action(window, "Download to Control").trigger()

    assert parameters.fetch_file(control.address).values == held
    assert list(window.workspace.path.parent.glob("*.before-*")) == []


def test_a_change_at_the_control_after_the_preview_is_not_overwritten(
    window: MainWindow, start_control: Start, person: Person, accept
) -> None:
    """Only what was shown and approved is replaced; what came in between stays."""
    control = start_control()
    other = new_file("9pc", "mill", ["X"])

    def somebody_else(dialog: DownloadPreview) -> None:
        parameters.download_file(
            other, control.address, Exchange(keep=window.workspace.path.parent / "other")
        )

    accept(DownloadPreview, somebody_else)

    said = download(window, person, control)

    assert said.startswith(
        "the control contains something else than what was approved to be replaced (sha256 "
    )
    assert said.endswith("; nothing was replaced in the control")
    assert parameters.fetch_file(control.address).values == other.values


def test_garbage_in_the_control_is_asked_about_kept_and_replaced(
    window: MainWindow, start_control: Start, person: Person, path: Path, tmp_path: Path
) -> None:
    garbage = b"\x00 no image"
    memory = tmp_path / "control-0"
    memory.mkdir()
    (memory / "active.img").write_bytes(garbage)
    control = start_control()
    person.answers("Download")

    said = download(window, person, control)

    assert "this is not a control image" in person.asked[0]
    assert said.startswith("Download complete and read back equal")
    kept = list(path.parent.glob("mill.before-*"))
    assert sorted(p.suffix for p in kept) == [".img", ".sha256"]
    assert min(kept).read_bytes() == garbage


def test_a_header_that_differs_is_told_by_verify(
    window: MainWindow, start_control: Start, person: Person, accept
) -> None:
    control = start_control()
    accept(DownloadPreview)
    download(window, person, control)
    window.workspace.file.header.revision = "9.99"
    person.types(control.address)

    action(window, "Verify With Control").trigger()

    assert person.reads() == "All values are the same; only the header (revision) differs."


def test_differences_to_the_control_are_listed_with_its_last_download_and_shown_beside_the_value(
    window: MainWindow, start_control: Start, person: Person, accept, qtbot: QtBot
) -> None:
    control = start_control()
    accept(DownloadPreview)
    download(window, person, control)
    window.edits.commit(EXCESS, "3 mm")

    person.types(control.address)
    action(window, "Verify With Control").trigger()

    shown = window.findChild(MergeWindow)
    assert [(row.address, row.a, row.b) for row in shown.merge.differing] == [
        (EXCESS, Value(3.0, "mm"), Value(11.0, "mm"))
    ]
    assert shown.chosen[B].title == control.address
    person.types(control.address)
    for name in ("Control Now…", "Last Download"):
        shown.head.buttons[BASE].fill()
        offers = {a.text().replace("&", ""): a for a in shown.head.buttons[BASE].menu().actions()}
        shown.use_base(None)
        offers[name].trigger()
        qtbot.waitUntil(lambda: BASE in shown.chosen, timeout=WAIT_MS)
        assert [(row.address, row.kind) for row in shown.merge.differing] == [(EXCESS, "a")], name
    window.go_to(EXCESS)
    lines = window.detail.page.toPlainText().split("\n")
    heads = [n for n, line in enumerate(lines) if line.startswith("In the control")]
    assert [lines[n + 1] for n in heads] == ["11 mm"]


def test_not_in_e_stop_gives_the_one_sentence(
    window: MainWindow, start_control: Start, person: Person, accept
) -> None:
    control = start_control("--no-estop")
    held = parameters.fetch_file(control.address).values
    accept(DownloadPreview)

    said = download(window, person, control)

    assert said == "please place the control in E-stop to download; nothing was replaced in the control"
    assert parameters.fetch_file(control.address).values == held


def test_cancel_in_the_middle_leaves_the_control_as_it_was(
    window: MainWindow, start_control: Start, person: Person, accept, monkeypatch, qtbot: QtBot
) -> None:
    control = start_control()
    held = parameters.fetch_file(control.address).values
    accept(DownloadPreview)
    sending = threading.Event()
    real = parameters.download_file

    def slow(file: ParameterFile, address: str, exchange: Exchange, **approved: Any) -> object:
        def tell(stage: str, done: int, total: int) -> None:
            exchange.progress(stage, done, total)
            if stage == "download":  # as if the line were slow
                sending.set()
                assert exchange.cancel is not None
                exchange.cancel.wait(WAIT_MS / 1000)

        return real(file, address, replace(exchange, progress=tell), **approved)

    monkeypatch.setattr(parameters, "download_file", slow)

    def cancel(dialog: ProgressDialog) -> None:
        qtbot.waitUntil(lambda: dialog.text.text() == "Sending the file …", timeout=WAIT_MS)
        dialog.buttons.button(QDialogButtonBox.StandardButton.Cancel).click()
        assert dialog.text.text() == "Stopping at the next safe point …"

    during(cancel, sending.is_set)
    said = download(window, person, control)

    assert said.endswith("nothing was replaced in the control")
    assert parameters.fetch_file(control.address).values == held


def test_errors_are_asked_about_before_a_download(
    open_window, path: Path, bare: bytes, person: Person
) -> None:
    path.write_bytes(bare)
    window = open_window(path)
    person.answers("Cancel")
    action(window, "Download to Control").trigger()
    assert "Download it anyway?" in person.asked[0]


def test_only_what_is_saved_is_downloaded(window: MainWindow, person: Person, path: Path) -> None:
    window.edits.commit(EXCESS, "3 mm")
    person.answers("Cancel")
    action(window, "Download to Control").trigger()
    assert "unsaved changes" in person.asked[0]
    assert on_disk(path).get(EXCESS) == Value(11.0, "mm")


def test_a_control_that_is_not_there_is_told(window: MainWindow, person: Person) -> None:
    person.types("tcp://127.0.0.1:1")
    action(window, "Verify With Control").trigger()
    assert "no connection to the control" in person.reads()


def test_an_address_that_is_none_is_told(window: MainWindow, person: Person) -> None:
    person.types("over there")
    action(window, "Verify With Control").trigger()
    assert "over there" in person.reads()


@pytest.fixture
def odd_control(start_control: Start, path: Path) -> Control:
    """Return a control that contains a value out of range."""
    control = start_control()
    file = open_file(path).file
    file.set_many({EXCESS: Value(1e6, "mm")}, force="on a day")
    parameters.download_file(file, control.address, Exchange(keep=path.parent / "odd"))
    return control


def test_an_upload_walks_through_what_is_out_of_range(
    open_window, odd_control: Control, person: Person, tmp_path: Path
) -> None:
    """Continue, edit or quit, for each value; without a file open, too."""
    window = open_window()
    person.types(odd_control.address)
    person.answers("Quit checking")
    action(window, "Upload From Control").trigger()
    assert "1750 Excess Error" in person.asked[-1]
    assert window.workspace is None

    person.types(odd_control.address, "many", "12 mm")
    person.answers("Edit parameter", "Edit parameter")
    person.chooses(tmp_path / "mended")
    action(window, "Upload From Control").trigger()
    assert "is not a number" in person.reads()
    assert on_disk(tmp_path / "mended.amp").get(EXCESS) == Value(12.0, "mm")

    person.types(odd_control.address)
    person.answers("Continue checking")
    person.chooses(tmp_path / "marked")
    action(window, "Upload From Control").trigger()
    assert "by an upload" in on_disk(tmp_path / "marked.amp").forced[EXCESS]


def test_an_upload_is_not_lost_when_it_cannot_be_written(
    open_window, odd_control: Control, person: Person, tmp_path: Path
) -> None:
    window = open_window()
    person.types(odd_control.address)
    person.answers("Continue checking")
    person.chooses(tmp_path / "no folder" / "here.amp", tmp_path / "there.amp")
    action(window, "Upload From Control").trigger()
    assert "Choose another name" in person.reads()
    assert window.workspace.path == tmp_path / "there.amp"


def test_the_emulated_control_starts_and_ends_with_the_program(
    window: MainWindow, qtbot: QtBot, person: Person, accept
) -> None:
    emulated = window.control.emulated
    with qtbot.waitSignal(emulated.ready, timeout=WAIT_MS):
        action(window, "Start Emulated Control").trigger()
    assert not action(window, "Start Emulated Control").isEnabled()
    assert action(window, "Emulated Control in E-Stop").isChecked()

    action(window, "Emulated Control in E-Stop").trigger()  # out of E-stop
    accept(DownloadPreview)
    person.types(emulated.address)
    qtbot.waitUntil(lambda: _flags(emulated.address) is False, timeout=WAIT_MS)
    action(window, "Download to Control").trigger()
    assert "place the control in E-stop" in person.reads()

    with qtbot.waitSignal(emulated.ended, timeout=WAIT_MS):
        action(window, "Stop Emulated Control").trigger()
    assert "stopped" in window.statusBar().currentMessage()
    with qtbot.waitSignal(emulated.ready, timeout=WAIT_MS):
        action(window, "Start Emulated Control").trigger()
    assert action(window, "Emulated Control in E-Stop").isChecked(), "it begins in E-stop again"
    window.close()
    assert not emulated.is_running


def _flags(address: str) -> bool:
    """Return whether the control is in E-stop."""
    from amp_studio.transfer.house.message import Flags
    from amp_studio.transfer.house.session import Session

    with Session.at(address) as session:
        return bool(session.hello().flags & Flags.ESTOP)


def test_the_project_names_its_control(window: MainWindow, person: Person, path: Path, monkeypatch) -> None:
    from PySide6.QtWidgets import QInputDialog

    from amp_studio.files import Project, ProjectInfo

    Project.create(
        path.parent, ProjectInfo(name="Mill", family="9pc", machine="mill", control="tcp://10.1.2.3:9600")
    )
    window.projects.notice(path.parent)
    offered = []
    monkeypatch.setattr(QInputDialog, "getItem", lambda *a: (offered.extend(a[3]), ("", False))[1])
    action(window, "Verify With Control").trigger()
    assert offered[0] == "tcp://10.1.2.3:9600"


def test_the_upload_of_a_file_keeps_its_content(start_control: Start, path: Path) -> None:
    """The emulated control gives back what it was given, byte for byte in the file's own form."""
    control = start_control()
    file = open_file(path).file
    parameters.download_file(file, control.address, Exchange(keep=path.parent / "mill"))
    held = parameters.fetch_file(control.address)
    held.header.name, held.header.notes = file.header.name, file.header.notes
    held.header.units = file.header.units
    assert content_of(held) == content_of(file)


def test_a_control_that_stays_in_estop_stays_so_in_the_menu_and_its_reason_is_shown(
    window: MainWindow,
) -> None:
    estop = window.control.estop_action
    estop.setChecked(False)
    reason = "the control stays in E-stop: 5 axes are configured and the control supports 3 (page 3-1)"
    window.control.emulated.shown.emit(f"refused: {reason}")
    assert estop.isChecked()
    assert window.statusBar().currentMessage() == f"Emulated control: refused: {reason}"
