"""At the control: compare, send, read and restore with an emulated control in a separate process,
in one page.
"""

import threading
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel
from pytestqt.qtbot import QtBot

from amp_studio.files import ParameterFile, Project, ProjectInfo, content_of, new_file, open_file
from amp_studio.schema import Value
from amp_studio.transfer.client import parameters
from amp_studio.transfer.exchange import Exchange
from amp_studio.ui.actions import project
from amp_studio.ui.actions.control import STATE_ROOM
from amp_studio.ui.base.theme import colour, scheme
from amp_studio.ui.base.translated import set_language
from amp_studio.ui.control.conditions import conditions_of
from amp_studio.ui.control.differences import CONTROL, REMARK
from amp_studio.ui.control.heading import ControlHeading
from amp_studio.ui.control.next_step import PageState, bar_message
from amp_studio.ui.control.session import ControlSession
from amp_studio.ui.main_window import MainWindow

from .at_control import at_control, nearly, sent, settled
from .conftest import WAIT_MS, Control, User, action, on_disk

EXCESS = ("servo.excess_error", "1")
Start = Callable[..., Control]


def test_a_file_is_sent_read_back_and_read_again(
    window: MainWindow, start_control: Start, user: User, qtbot: QtBot, tmp_path: Path
) -> None:
    """What a control gives back is what it was given, and what it contained before is kept beside the
    file.
    """
    control = start_control()
    page = at_control(window, control.address, "send", qtbot)
    count = len(page.table.rows_taking(file=True))
    assert page.primary.text() == f"Send {count} Values to the Control"
    assert count > 100
    assert not page.primary.isEnabled(), "what can be dangerous is not checked"
    page = sent(window, control.address, qtbot)
    assert page.row.detail.text() == "", "no row is listed beside the proof"
    (kept,) = window.workspace.path.parent.glob("mill.before-*.img")
    assert page.session.phase == "done"
    assert "complete and read back equal" in page.empty.text()
    assert str(kept) in page.empty.text()
    page.connect_again()
    settled(window, qtbot)
    assert page.table.rows == {}
    assert "Nothing differs" in page.empty.text()
    assert not page.primary.isEnabled() or page.direction != "send"
    page.turn("read")
    user.chooses(tmp_path / "from-control.amp")
    before = dict(window.workspace.file.values)
    page.press()
    assert window.workspace.path == tmp_path / "from-control.amp"
    assert on_disk(tmp_path / "from-control.amp").values == before
    assert not window.control.is_shown, "the new file is in front"


def test_one_changed_value_takes_two_keys_and_its_row_shows_what_it_was(
    window: MainWindow, start_control: Start, qtbot: QtBot
) -> None:
    control = start_control(file=window.workspace.file)
    at_control(window, control.address, "compare", qtbot)
    window.control.leave()
    address = EXCESS
    window.edits.commit(address, "11.5 mm")
    assert window.save()
    window.control.page.session.read()
    settled(window, qtbot)
    action(window, "Send to the Control").trigger()
    page = settled(window, qtbot)
    assert list(page.table.rows) == [address]
    assert page.primary.text() == "Send 1 Value to the Control"
    page.checked.setChecked(True)
    action(window, "Send to the Control").trigger()
    settled(window, qtbot)
    assert page.session.phase == "done"
    assert parameters.fetch_file(control.address).get(address) == window.workspace.file.get(address)


def test_a_value_of_the_control_is_kept_and_goes_back_unchanged(
    window: MainWindow, start_control: Start, qtbot: QtBot
) -> None:
    control = start_control(file=window.workspace.file)
    at_control(window, control.address, "compare", qtbot)
    window.workspace.edit("two", {EXCESS: Value(12.0, "mm"), (EXCESS[0], "2"): Value(12.5, "mm")})
    assert window.save()
    window.control.page.session.read()
    settled(window, qtbot)
    page = at_control(window, control.address, "send", qtbot)
    page.table.select(EXCESS)
    assert page.row.keep.text() == "Keep 11 mm"
    page.row.keep.click()
    assert page.primary.text() == "Send 1 Value to the Control"
    page.checked.setChecked(True)
    page.press()
    settled(window, qtbot)
    assert "Kept as they were: 1750 Excess Error" in page.empty.text()
    content = parameters.fetch_file(control.address)
    assert [content.get((EXCESS[0], axis)) for axis in "12"] == [Value(11.0, "mm"), Value(12.5, "mm")]
    assert window.workspace.file.get(EXCESS) == Value(12.0, "mm"), "the file keeps its own"


def test_space_changes_the_side_of_a_row_with_ctrl_of_its_group_and_all_follow_the_theme(
    window: MainWindow, start_control: Start, qtbot: QtBot
) -> None:
    page = at_control(window, start_control(file=nearly(window)).address, "send", qtbot)
    first = page.table.topLevelItem(0).child(0)
    page.table.setCurrentItem(first)
    before = len(page.table.rows_taking(file=True))
    QTest.keyClick(page.table, Qt.Key.Key_Space)
    assert len(page.table.rows_taking(file=True)) == before - 1
    QTest.keyClick(page.table, Qt.Key.Key_Space)
    QTest.keyClick(page.table, Qt.Key.Key_Space, Qt.KeyboardModifier.ControlModifier)
    assert len(page.table.rows_taking(file=True)) == before - page.table.topLevelItem(0).childCount()
    choice = scheme().choice
    for theme in ("dark", "light"):
        scheme().choose(theme)
        text = page.conditions.findChildren(QLabel)[1].text()
        assert first.foreground(CONTROL).color() == colour("text"), "a row is in the colours of the moment"
        assert colour("text").name() in text, "the conditions too"
    scheme().choose(choice)


def test_a_change_at_the_control_after_it_was_read_is_not_overwritten(
    window: MainWindow, start_control: Start, qtbot: QtBot
) -> None:
    """Only what was shown is replaced; what came in between stays."""
    control = start_control(file=nearly(window))
    at_control(window, control.address, "send", qtbot)
    other = new_file("9pc", "mill", ["X"])
    parameters.download_file(other, control.address, Exchange(keep=window.workspace.path.parent / "other"))
    page = window.control.page
    page.checked.setChecked(True)
    page.press()
    settled(window, qtbot)
    assert page.session.phase == "failed"
    assert page.bar.text.text().startswith("Nothing was sent to the control.")
    assert "something else than what was approved" in page.bar.text.text()
    assert page.primary.text() == "Connect and Read"
    assert parameters.fetch_file(control.address).values == other.values


def test_garbage_in_the_control_is_shown_kept_and_replaced(
    window: MainWindow, start_control: Start, path: Path, tmp_path: Path, qtbot: QtBot
) -> None:
    garbage = b"\x00 no image"
    memory = tmp_path / "control-0"
    memory.mkdir()
    (memory / "active.img").write_bytes(garbage)
    control = start_control()
    page = at_control(window, control.address, "send", qtbot)
    assert "this is not a control image" in page.empty.text()
    page.press()
    settled(window, qtbot)
    assert page.session.phase == "done"
    kept = list(path.parent.glob("mill.before-*"))
    assert sorted(p.suffix for p in kept) == [".img", ".sha256"]
    assert min(kept).read_bytes() == garbage


def test_a_header_that_differs_is_shown_by_a_comparison(
    window: MainWindow, start_control: Start, qtbot: QtBot
) -> None:
    control = start_control(file=window.workspace.file)
    at_control(window, control.address, "compare", qtbot)
    window.workspace.file.header.revision = "9.99"
    page = window.control.page
    page.connect_again()
    settled(window, qtbot)
    page.turn("compare")
    assert page.empty.text() == "All values are the same; only the header (revision) differs."


def test_e_stop_is_asked_before_anything_is_sent_and_again_until_it_is_pressed(
    window: MainWindow, start_control: Start, qtbot: QtBot
) -> None:
    control = start_control(estop=False, file=nearly(window))
    content = parameters.fetch_file(control.address).values
    page = at_control(window, control.address, "send", qtbot)
    page.checked.setChecked(True)
    assert "E-stop is not pressed" in page.conditions.accessibleDescription()
    assert (page.primary.isEnabled(), page.hint.text()) == (False, "Waiting: E-stop is not pressed")
    assert page.bar.text.text().startswith("Press E-stop at the machine.")
    assert page._asking.isActive(), "it is asked again every 2 s"
    assert window.menus["control.page"].iconText().endswith("not in E-stop")
    control.says("estop on")
    qtbot.waitUntil(lambda: _flags(control.address), timeout=WAIT_MS)
    page.session.ask()
    settled(window, qtbot)
    assert page.primary.isEnabled()
    assert not page._asking.isActive()
    assert page.bar.isHidden()
    assert parameters.fetch_file(control.address).values == content


def slowed(monkeypatch: pytest.MonkeyPatch, act: Callable[[Exchange], object]) -> threading.Event:
    """Have something done when the first part of a download is on its way; returns what is set then."""
    sending = threading.Event()
    real = parameters.download_file

    def slow(file: ParameterFile, address: str, exchange: Exchange, **approved: Any) -> object:
        def report(stage: str, done: int, total: int) -> None:
            exchange.progress(stage, done, total)
            if stage == "download" and not sending.is_set():
                sending.set()
                act(exchange)

        return real(file, address, replace(exchange, progress=report), **approved)

    monkeypatch.setattr(parameters, "download_file", slow)
    return sending


def test_cancel_shows_what_it_leaves_and_leaves_the_control_as_it_was(
    window: MainWindow, start_control: Start, monkeypatch, qtbot: QtBot
) -> None:
    control = start_control(file=nearly(window))
    content = parameters.fetch_file(control.address).values
    page = at_control(window, control.address, "send", qtbot)
    page.checked.setChecked(True)
    sending = slowed(monkeypatch, lambda exchange: exchange.cancel.wait(WAIT_MS / 1000))
    page.press()
    qtbot.waitUntil(sending.is_set, timeout=WAIT_MS)
    assert page.cancel.text() == "Cancel, Keep All Old Values"
    QTest.keyClick(page.table, Qt.Key.Key_Escape)
    settled(window, qtbot)
    assert page.session.phase == "failed"
    assert page.bar.text.text().startswith("The control contains all old values.")
    assert parameters.fetch_file(control.address).values == content


def test_a_line_that_is_pulled_while_sending_ends_with_the_truth_and_one_next_step(
    window: MainWindow, start_control: Start, monkeypatch, qtbot: QtBot
) -> None:
    control = start_control(file=nearly(window))
    page = at_control(window, control.address, "send", qtbot)
    page.checked.setChecked(True)
    sending = slowed(monkeypatch, lambda _: control.stop())
    page.press()
    qtbot.waitUntil(sending.is_set, timeout=WAIT_MS)
    qtbot.waitUntil(lambda: "trying again" in page.hint.text(), timeout=WAIT_MS)
    page.session.cancel()
    settled(window, qtbot)
    assert page.session.phase == "failed"
    assert page.bar.text.text().startswith(("The control contains all old values.", "It is not known"))
    assert page.primary.text() == "Connect and Read"
    page.press()
    settled(window, qtbot)
    assert page.session.phase == "away"
    assert "No connection to the control" in page.bar.text.text()
    assert (page.primary.text(), page.bar.buttons) == ("Try Again", []), "one button does it, not two"


def test_what_differs_and_what_is_sent_add_up_in_what_the_page_states(
    window: MainWindow, start_control: Start, qtbot: QtBot
) -> None:
    """What only the control contains differs and is not sent: its number is beside that of the button."""
    content = nearly(window)
    window.workspace.edit("without", {EXCESS: None})
    assert window.save()
    control = start_control(file=content)
    page = at_control(window, control.address, "compare", qtbot)
    assert page.primary.text() == "Send 2 Values to the Control…"
    assert page.counts.text().startswith("2 differ, ")
    assert page.counts.text().endswith(" are the same, 1 on one side only: stays")
    page.table.select((EXCESS[0], "2"))
    page.table.take([(EXCESS[0], "2")], file=False)
    assert page.primary.text() == "Send 1 Value to the Control…"
    assert page.counts.text().endswith(" are the same, 1 kept, 1 on one side only: stays")


def test_errors_are_shown_in_the_page_before_anything_is_sent_and_what_is_sent_is_saved(
    window: MainWindow, start_control: Start, qtbot: QtBot, path: Path
) -> None:
    control = start_control(file=nearly(window))
    window.edits.commit(EXCESS, "0.001 mm")
    page = at_control(window, control.address, "send", qtbot)
    page.checked.setChecked(True)
    assert (page.primary.isEnabled(), page.hint.text()) == (False, "Waiting: the file has errors")
    page.bar.buttons[0].click()
    assert page.primary.isEnabled()
    assert page.primary.text().startswith("Save and Send ")
    page.press()
    assert on_disk(path).get(EXCESS) == Value(0.001, "mm")
    assert settled(window, qtbot).session.phase == "done"


def test_a_control_that_is_not_there_and_an_address_that_is_none(
    window: MainWindow, user: User, qtbot: QtBot
) -> None:
    page = at_control(window, "tcp://127.0.0.1:1", "compare", qtbot)
    assert "No connection to the control" in page.bar.text.text()
    page.known.field.setText("over there")
    page.known._enter()
    assert "over there" in user.reads()
    assert page.session.address == "tcp://127.0.0.1:1"


def test_values_of_the_control_are_taken_into_the_file_in_one_step(
    window: MainWindow, start_control: Start, qtbot: QtBot
) -> None:
    control = start_control(file=window.workspace.file)
    at_control(window, control.address, "compare", qtbot)
    window.workspace.edit("two", {EXCESS: Value(12.0, "mm"), (EXCESS[0], "2"): Value(12.5, "mm")})
    page = window.control.page
    page.connect_again()
    settled(window, qtbot)
    page.turn("read")
    page.table.take([EXCESS, (EXCESS[0], "2")], file=False)
    assert page.primary.text() == "Take 2 Values into mill"
    steps = window.workspace.undo_stack.count()
    page.press()
    assert window.workspace.file.get(EXCESS) == Value(11.0, "mm")
    assert window.workspace.undo_stack.count() == steps + 1


def test_values_of_the_control_go_to_the_file_that_was_opened_again(
    window: MainWindow, start_control: Start, path: Path, qtbot: QtBot
) -> None:
    """An exchange that outlasted its file ended in an error, and the next one was not shown beside the
    file.
    """
    control = start_control(file=window.workspace.file)
    session = at_control(window, control.address, "compare", qtbot).session
    window.files.close()
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    session.ended.emit("verify", True)
    window.files.open_path(path)
    at_control(window, control.address, "compare", qtbot).connect_again()
    settled(window, qtbot)
    assert window.workspace.control is not None


def test_one_value_is_written_now_where_the_control_takes_it_so(
    start_control: Start, open_window, user: User, tmp_path: Path, qtbot: QtBot
) -> None:
    control = start_control(family="grblhal", machine="grblhal")
    window = open_window()
    page = at_control(window, control.address, "read", qtbot)
    user.chooses(tmp_path / "router.amp")
    page.press()
    travel, other = (window.workspace.file.find(number) for number in ("$130", "$131"))
    window.workspace.edit("travel", {travel: Value(301.5, "mm"), other: Value(302.5, "mm")})
    assert window.save()
    page = at_control(window, control.address, "send", qtbot)
    page.table.select(travel)
    page.row.one.click()
    assert page.bar.text.text() == ("Write this value alone, now? $130 Maximum travel X: 200 mm → 301.5 mm.")
    assert parameters.fetch_file(control.address).get(travel) == Value(200.0, "mm"), "it is asked first"
    page.bar.buttons[0].click()
    settled(window, qtbot)
    content = parameters.fetch_file(control.address)
    assert content.get(travel) == Value(301.5, "mm")
    assert content.get(other) != Value(302.5, "mm")
    assert window.workspace.path.with_name("exchanges.jsonl").exists(), "it is recorded"
    assert "Change complete and read back equal" in page.bar.text.text()
    assert list(page.table.rows) == [other], "the rest is still to be sent"
    assert page.primary.text() == "Send 1 Value to the Control"


@pytest.fixture
def odd_control(start_control: Start, path: Path) -> Control:
    """Return a control that contains a value out of range."""
    control = start_control()
    file = open_file(path).file
    file.set_checked({EXCESS: Value(1e6, "mm")}, force="on a day")
    parameters.download_file(file, control.address, Exchange(keep=path.parent / "odd"))
    return control


def test_an_upload_walks_through_what_is_out_of_range(
    open_window, odd_control: Control, user: User, tmp_path: Path, qtbot: QtBot
) -> None:
    """Continue, edit or quit, for each value; without a file open, too."""
    window = open_window()
    page = at_control(window, odd_control.address, "read", qtbot)
    user.answers("Quit checking")
    page.press()
    assert "1750 Excess Error" in user.asked[-1]
    assert window.workspace is None
    user.types("many", "12 mm")
    user.answers("Edit parameter", "Edit parameter")
    user.chooses(tmp_path / "mended")
    page.press()
    assert "is not a number" in user.reads()
    assert on_disk(tmp_path / "mended.amp").get(EXCESS) == Value(12.0, "mm")


def test_an_upload_is_not_lost_when_it_cannot_be_written(
    open_window, odd_control: Control, user: User, tmp_path: Path, qtbot: QtBot
) -> None:
    window = open_window()
    page = at_control(window, odd_control.address, "read", qtbot)
    user.answers("Continue checking")
    user.chooses(tmp_path / "no folder" / "here.amp", tmp_path / "there.amp")
    page.press()
    assert "Choose another name" in user.reads()
    assert window.workspace.path == tmp_path / "there.amp"
    assert "by an upload" in on_disk(tmp_path / "there.amp").forced[EXCESS]


def test_the_emulated_control_starts_and_ends_with_the_program(window: MainWindow, qtbot: QtBot) -> None:
    emulated = window.control.emulated
    with qtbot.waitSignal(emulated.ready, timeout=WAIT_MS):
        action(window, "Start Emulated Control").trigger()
    assert not action(window, "Start Emulated Control").isEnabled()
    assert action(window, "Emulated Control in E-Stop").isChecked()
    assert window.control.exchanges.address_of(window.workspace) == emulated.address, "it is the chosen one"
    action(window, "Emulated Control in E-Stop").trigger()  # out of E-stop
    qtbot.waitUntil(lambda: _flags(emulated.address) is False, timeout=WAIT_MS)
    page = at_control(window, emulated.address, "send", qtbot)
    assert page.hint.text() == "Waiting: E-stop is not pressed"
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


def test_the_project_names_its_control_and_each_file_remembers_its_own(
    window: MainWindow, path: Path
) -> None:
    info = ProjectInfo(
        name="Mill", family="9pc", machine="mill", control="tcp://10.1.2.3:9600", control_name="CNC_7"
    )
    Project.create(path.parent, info)
    project.notice(window, path.parent)
    exchanges = window.control.exchanges
    assert exchanges.address_of(window.workspace) == "tcp://10.1.2.3:9600"
    assert window.control.state_of(window.workspace)[:2] == ("CNC_7", "not connected")
    exchanges.choose(window.workspace, "tcp://10.1.2.4:9600")
    assert exchanges.address_of(window.workspace) == "tcp://10.1.2.4:9600"
    assert exchanges.known_addresses() == ["tcp://10.1.2.3:9600", "tcp://10.1.2.4:9600"]


def test_the_upload_of_a_file_keeps_its_content(start_control: Start, path: Path) -> None:
    """The emulated control gives back what it was given, byte for byte in the file's own form."""
    control = start_control()
    file = open_file(path).file
    parameters.download_file(file, control.address, Exchange(keep=path.parent / "mill"))
    content = parameters.fetch_file(control.address)
    content.header.name, content.header.notes = file.header.name, file.header.notes
    content.header.units = file.header.units
    assert content_of(content) == content_of(file)


def test_a_control_that_stays_in_estop_stays_so_in_the_menu_and_its_reason_is_shown(
    window: MainWindow,
) -> None:
    estop = window.menus["control.estop"]
    estop.setChecked(False)
    reason = "the control stays in E-stop: 5 axes are configured and the control supports 3 (page 3-1)"
    window.control.emulated.line_shown.emit(f"refused: {reason}")
    assert estop.isChecked()
    assert window.statusBar().currentMessage() == f"Emulated control: refused: {reason}"


def test_why_an_emulated_control_refused_is_german(window: MainWindow) -> None:
    set_language("de")
    try:
        window.control.emulated.line_shown.emit("refused: the registers of this axis make none that can move")
        assert window.statusBar().currentMessage() == (
            "Nachgebildete Steuerung: abgelehnt: mit diesen Registern kann sich die Achse nicht bewegen"
        )
    finally:
        set_language("en")


def test_what_was_asked_before_the_line_was_lost_is_no_longer_known(window: MainWindow) -> None:
    session = ControlSession("tcp://127.0.0.1:9", "9pc")
    control = SimpleNamespace(revision="1", family="9pc", signature="")
    session.seen = SimpleNamespace(
        control=control, abilities=SimpleNamespace(lasting_states=(), maps_numbers=True)
    )
    session.in_estop = True
    assert [c.met for c in conditions_of(session, window.workspace.file)][:3] == [True, True, True]
    session.error = "nothing answers there"
    lost = conditions_of(session, window.workspace.file)
    assert [c.met for c in lost] == [False, None, None, None]
    assert lost[0].text == "Not connected"


def test_what_has_to_be_known_before_sending_is_above_the_table(window: MainWindow) -> None:
    session = ControlSession("folder:mill", "linuxcnc")
    session.seen, session.phase = SimpleNamespace(control=SimpleNamespace(notice="It runs.")), "ready"
    state = PageState("send", None, None, session, None, 0, 0, *[False] * 4)
    found = bar_message(state)
    assert found is not None
    assert (found.text, found.kind) == ("It runs.", "warning")
    assert bar_message(replace(state, direction="read")) is None


def test_controls_of_one_name_have_their_addresses_too(window: MainWindow) -> None:
    here, there = "tcp://10.0.0.1:9600", "tcp://10.0.0.2:9600"
    for address in (here, there):
        window.control.exchanges.remember_contact(
            address, "connect", reached=True, family="9pc", name="CNC_1"
        )
    window.control.exchanges.remember_contact("COM3", "connect", reached=True, family="9pc", name="CNC_2")
    names = [window.control._name_of(address) for address in (here, there, "COM3")]
    assert names == ["CNC_1 (10.0.0.1:9600)", "CNC_1 (10.0.0.2:9600)", "CNC_2"]


def test_a_password_is_asked_in_the_page_until_it_is_right(
    window: MainWindow, start_control: Start, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("amp_studio.transfer.links.password.ROUNDS", 10)
    page = at_control(window, start_control(password="open sesame").address, "compare", qtbot)
    assert page.session.seen is None
    assert page.password.isVisible()
    assert "asks for its password" in page.bar.text.text()
    page.password.setText("open cesame")
    page._enter_password()
    assert page.password.isVisible(), "what is typed on would go to another field"
    settled(window, qtbot)
    assert page.password.isVisible()
    assert not page.password.isReadOnly()
    assert "the password is wrong" in page.bar.text.text()


def test_a_password_that_is_right_opens_the_page_and_is_named_among_the_conditions(
    window: MainWindow, start_control: Start, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("amp_studio.transfer.links.password.ROUNDS", 10)
    page = at_control(window, start_control(password="open sesame").address, "compare", qtbot)
    page.password.setText("open sesame")
    page._enter_password()
    settled(window, qtbot)
    assert page.session.seen is not None
    assert not page.password.isVisible()
    assert "Password accepted" in [c.text for c in conditions_of(page.session, window.workspace.file)]


def test_without_a_control_the_keyboard_is_where_one_is_chosen_or_added(window: MainWindow) -> None:
    window.control.exchanges.remember_contact("COM3", "connect", reached=False, family="57c422b")
    window.settings.keep_control("")
    window.control.show("compare")
    QApplication.processEvents()
    known = window.control.page.known
    assert known.list.hasFocus()
    QTest.keyClicks(known.list, "+")
    assert known.field.hasFocus()


def test_a_file_does_not_take_the_last_control_of_another_family(window: MainWindow) -> None:
    exchanges, here = window.control.exchanges, "tcp://10.0.0.1:9600"
    window.settings.keep_control(here)
    assert exchanges.address_of(window.workspace) == here, "nobody knows what it is"
    exchanges.remember_contact(here, "connect", reached=True, family="57c422b")
    assert exchanges.address_of(window.workspace) == ""


def test_a_file_does_not_take_the_emulated_control_of_another_family_which_is_no_habit_either(
    window: MainWindow,
) -> None:
    exchanges, emulated = window.control.exchanges, window.control.emulated
    window.settings.keep_control("")
    emulated.address, emulated.family = "tcp://127.0.0.1:36211", "grblhal"
    exchanges.choose(None, emulated.address)
    assert exchanges.address_of(window.workspace) == ""
    emulated.family = "9pc"
    assert exchanges.address_of(window.workspace) == emulated.address
    emulated.address = ""
    assert exchanges.address_of(window.workspace) == ""


@pytest.mark.parametrize("address", ["tcp://127.0.0.1:36211", "tcp://a-very-long-name-of-a-control:9600"])
def test_the_tool_bar_never_cuts_not_from_not_connected(window: MainWindow, address: str) -> None:
    window.control.exchanges.choose(window.workspace, address)
    action = window.menus["control.page"]
    window.control.show_state(action)
    assert action.iconText().endswith("  not connected")
    assert window.fontMetrics().horizontalAdvance(action.iconText()) <= STATE_ROOM


def test_values_sent_from_another_page_are_sent_alone_and_what_to_mind_has_a_few_words_and_the_whole_below(
    window: MainWindow, start_control: Start, qtbot: QtBot
) -> None:
    control = start_control(file=nearly(window))
    window.control.exchanges.choose(window.workspace, control.address)
    window.control.show("send", only=[EXCESS])
    page = settled(window, qtbot)
    assert {row.difference.address for row in page.table.rows_taking(file=True)} == {EXCESS}
    assert page.primary.text() == "Send 1 Value to the Control"
    page.table.select(EXCESS)
    assert page.table.currentItem().text(REMARK) == "later stop when it fails"
    assert "This limit guards against damage" in page.row.detail.text()
    page.table.select(("servo.excess_error", "2"))
    page.table.take([("servo.excess_error", "2")], file=True)
    window.control.leave()
    window.control.show("send", only=[EXCESS])
    assert page.primary.text() == "Send 2 Values to the Control", "a choice stays"
    window.control.leave()
    window.control.show("send")
    assert page.primary.text() == "Send 3 Values to the Control", "all of them, as from the tool bar"


def test_the_name_of_a_control_is_never_cut_in_the_head(qtbot: QtBot) -> None:
    """In a window of 1024 pixels it was ``…`` where two controls are called the same."""
    heading = ControlHeading()
    qtbot.addWidget(heading)
    heading.show()  # a hidden widget hears of no size
    letters = heading.fontMetrics()
    heading.show_sides("MILL_1394.amp", "→", "CNC_1 (127.0.0.1:38767)")
    whole = letters.horizontalAdvance(heading.text())
    heading.resize(whole + 2, 24)
    assert heading._elided() == "MILL_1394.amp  →  CNC_1 (127.0.0.1:38767)"
    heading.resize(letters.horizontalAdvance("  →  CNC_1 (127.0.0.1:38767)") + 40, 24)
    assert heading._elided() == "MILL_1394.amp  →  CNC_1"
    assert heading.toolTip() == heading.text()
    heading.resize(letters.horizontalAdvance("MILL_1394.amp  →  CNC_1") - 10, 24)
    assert heading._elided().endswith("  →  CNC_1")
    assert "…" in heading._elided()
