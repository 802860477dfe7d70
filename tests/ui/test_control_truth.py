"""What the page at the control states of an exchange is what happened: of a file that is edited meanwhile, of
a value alone, of a stop after the commit, of a password that is asked for later.
"""

import socket
from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from amp_studio.files import content_of, new_file
from amp_studio.schema import Value
from amp_studio.transfer.client import parameters
from amp_studio.transfer.errors import Confirmed, TransferError
from amp_studio.transfer.links import enter_password, parse_endpoint
from amp_studio.transfer.links.password import Gate
from amp_studio.ui.base.translated import message_in_words
from amp_studio.ui.control.differences import REMARK
from amp_studio.ui.control.session import ControlSession, SentChanges
from amp_studio.ui.control.session_words import text_of_failure
from amp_studio.ui.main_window import MainWindow

from .at_control import at_control, nearly, sent, settled
from .conftest import WAIT_MS, Control, User
from .test_control import EXCESS, slowed

OTHER = (EXCESS[0], "2")
HARMLESS = ("home.g28_speed", "1")
Start = Callable[..., Control]


def test_what_was_sent_is_what_is_proven_though_the_file_is_edited_meanwhile(
    window: MainWindow, start_control: Start, monkeypatch, user: User, tmp_path: Path, qtbot: QtBot
) -> None:
    """The proof listed values that were never sent, the steps counted them, and they were beside the file as
    those of the control.
    """
    content = window.workspace.file.copy()
    control = start_control(file=content)
    window.workspace.edit("one", {EXCESS: Value(11.5, "mm")})
    page = at_control(window, control.address, "send", qtbot)
    page.checked.setChecked(True)
    sending = slowed(monkeypatch, lambda _: None)
    page.press()
    qtbot.waitUntil(sending.is_set, timeout=WAIT_MS)
    window.workspace.edit("another", {OTHER: Value(12.5, "mm")})
    settled(window, qtbot)
    page.turn("compare")
    page.turn("send")
    assert page.session.phase == "done"
    assert page.steps._lines[2][0].text() == "✓ Write 1 value"
    user.chooses(tmp_path / "proof.txt")
    page.proof.click()
    proof = (tmp_path / "proof.txt").read_text()
    assert proof.endswith("\n1750 Excess Error X: 11 mm → 11.5 mm\n")
    assert "Excess Error Y" not in proof
    values, _ = window.workspace.control
    assert [values[each] for each in (EXCESS, OTHER)] == [Value(11.5, "mm"), content.get(OTHER)]


def test_the_next_value_needs_two_clicks_and_one_look(
    window: MainWindow, start_control: Start, qtbot: QtBot
) -> None:
    """After an exchange the page showed its proof again, and had to be asked to read."""
    control = start_control(file=nearly(window))
    page = sent(window, control.address, qtbot)
    QTest.mouseClick(page.primary, Qt.MouseButton.LeftButton)
    assert not window.control.is_shown
    window.workspace.edit("one", {HARMLESS: Value(2400.0, "mm/min")})
    clicks: list[QWidget] = []

    def click(button: QWidget) -> None:
        clicks.append(button)
        QTest.mouseClick(button, Qt.MouseButton.LeftButton)

    click(window.tools.widgetForAction(window.menus["control.page"]))
    settled(window, qtbot)
    assert list(page.table.rows) == [HARMLESS], "the look"
    assert page.primary.text() == "Save and Send 1 Value to the Control"
    click(page.primary)
    settled(window, qtbot)
    assert (page.session.phase, len(clicks)) == ("done", 2)
    assert parameters.fetch_file(control.address).get(HARMLESS) == Value(2400.0, "mm/min")


def test_what_a_backup_put_back_is_what_the_control_contains(
    window: MainWindow, start_control: Start, qtbot: QtBot
) -> None:
    """What was there before it was put back was beside the file afterwards."""
    control = start_control(file=nearly(window))
    page = sent(window, control.address, qtbot)
    window.control.recorded()
    page.history.restore.click()
    settled(window, qtbot)
    page.checked.setChecked(True)
    page.press()
    settled(window, qtbot)
    assert page.session.phase == "done"
    values, _ = window.workspace.control
    assert values[EXCESS] == Value(10.0, "mm")


def test_after_a_break_that_leaves_it_open_no_values_of_the_control_are_shown(
    window: MainWindow, start_control: Start, monkeypatch, qtbot: QtBot
) -> None:
    control = start_control(file=nearly(window))
    page = at_control(window, control.address, "send", qtbot)
    assert window.workspace.control is not None
    page.checked.setChecked(True)

    def breaks(*_: object, **__: object) -> None:
        raise TransferError("the line broke", "unknown", "mill.before-1.img")

    monkeypatch.setattr(parameters, "download_file", breaks)
    page.press()
    settled(window, qtbot)
    assert window.workspace.control is None
    assert page.counts.text() == "", "how much differs is not known"
    assert page.bar.text.text() == (
        "It is not known what the control contains. Do not move the machine before it was read. The line"
        " broke. What it contained before is kept in mill.before-1.img."
    ), "the button below is the next step, not a command"
    page.turn("read")
    assert page.primary.text() == "Connect and Read"


def test_stopping_after_the_commit_does_not_promise_the_old_values(
    window: MainWindow, start_control: Start, qtbot: QtBot
) -> None:
    control = start_control(file=nearly(window))
    page = at_control(window, control.address, "send", qtbot)
    session, texts = page.session, []
    session.progressed.connect(lambda *_: texts.append((session.stage, page.cancel.text())))
    page.checked.setChecked(True)
    page.press()
    settled(window, qtbot)
    of = dict(texts)
    assert of["download"] == "Cancel, Keep All Old Values"
    assert of["commit"] == "Cancel"
    assert of["verify"] == "Cancel, Keep All New Values"


@pytest.mark.parametrize(
    ("error", "is_one", "text"),
    [
        (
            TransferError("stopped", "mixed", "a.img", ("$3", "$25")),
            False,
            (
                "The control contains some of both: new and old values. Do not move the machine before it"
                " was read. Stopped; 2 of 5 values were confirmed. New, as far as is known: $3, $25. What it"
                " contained before is kept in a.img."
            ),
        ),
        (
            TransferError("it is silent", "defaults"),
            False,
            (
                "The control has lost its memory and contains its defaults. Do not move the machine before"
                " it was read. It is silent."
            ),
        ),
        (
            TransferError("stopped", "new"),
            True,
            "The control contains the new value. Stopped. It was not read back.",
        ),
        (TransferError("refused"), True, "Nothing was sent to the control. Refused."),
        (TransferError("refused", "old", "a.img"), True, "The control contains the old value. Refused."),
    ],
)
def test_how_an_exchange_failed_is_stated_once(error: TransferError, is_one: bool, text: str) -> None:
    session = ControlSession("tcp://127.0.0.1:1", "grblhal")
    session.failure, session.error, session.phase = error, str(error), "failed"
    session.sent = SentChanges(is_one=is_one)
    if error.at_control == "mixed":
        error.confirmed = Confirmed(2, 5)
    assert text_of_failure(session) == text


def test_a_password_that_is_asked_for_later_has_its_field_too(
    window: MainWindow, start_control: Start, tmp_path: Path, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A control that was read, and was started again with a password, could not be reached any more."""
    monkeypatch.setattr("amp_studio.transfer.links.password.ROUNDS", 10)
    # The time does not go on: the wait after a wrong password does not end on a slow machine.
    monkeypatch.setattr(
        "amp_studio.transfer.links.password.Gate", lambda password: Gate(password, clock=lambda: 0.0)
    )
    control = start_control(password="open sesame")
    page = at_control(window, control.address, "send", qtbot)
    page.password.setText("open sesame")
    page._enter_password()
    settled(window, qtbot)
    enter_password(parse_endpoint(control.address), "")
    page.again.click()
    settled(window, qtbot)
    assert not page.password.isHidden()
    assert page.primary.isHidden(), "the same without a password would fail once more"
    page.password.setText("open cesame")
    page._enter_password()
    settled(window, qtbot)
    page.password.setText("open sesame")
    page._enter_password()
    settled(window, qtbot)
    assert "too many wrong passwords" in page.bar.text.text()
    assert page.primary.text() == "Try Again", "it may be right: it need not be typed once more"


def test_a_control_of_another_family_is_recognised_and_a_silent_one_gets_a_question(
    window: MainWindow, start_control: Start, qtbot: QtBot
) -> None:
    """Both were "The control does not answer", with no way on but to try the same again."""
    other = start_control(family="grblhal", machine="grblhal").address.partition("?")[0]
    page = at_control(window, other, "compare", qtbot)
    assert page.bar.text.text() == (
        "The control does not answer. What answers there speaks grbl: another file or another address is"
        " needed."
    )
    with socket.create_server(("127.0.0.1", 0)) as silent:
        page = at_control(window, f"tcp://127.0.0.1:{silent.getsockname()[1]}", "compare", qtbot)
    assert page.bar.text.text().startswith("The control does not answer. Is it switched on, and are cable")


def test_reading_takes_what_the_control_contains_unless_another_side_is_chosen(
    window: MainWindow, start_control: Start, qtbot: QtBot
) -> None:
    """Each value had to be taken one by one; without that the button saved a new file."""
    page = at_control(window, start_control(file=nearly(window)).address, "read", qtbot)
    assert page.primary.text() == "Take 3 Values into mill"
    assert not page.as_new.isHidden()
    assert page.table.currentItem().text(REMARK) == ""
    page.table.take([EXCESS], file=True)
    assert page.table.currentItem().text(REMARK) == "the file's value stays"
    assert page.primary.text() == "Take 2 Values into mill"
    page.turn("send")
    assert page.primary.text() == "Send 3 Values to the Control"
    page.turn("read")
    page.press()
    assert window.workspace.file.get(OTHER) == Value(10.0, "mm")
    assert window.workspace.file.get(EXCESS) == Value(11.0, "mm")


def test_a_window_that_is_closed_while_sending_shows_what_the_control_contains(
    start_control: Start, open_window, path: Path, monkeypatch, user: User, qtbot: QtBot
) -> None:
    """It was gone, and only the record had how the exchange ended."""
    window = open_window(path)
    control = start_control(file=nearly(window))
    page = at_control(window, control.address, "send", qtbot)
    page.checked.setChecked(True)
    sending = slowed(monkeypatch, lambda exchange: exchange.cancel.wait(WAIT_MS / 1000))
    page.press()
    qtbot.waitUntil(sending.is_set, timeout=WAIT_MS)
    user.answers("Stop and Close")
    window.close()
    assert window.isVisible(), "until it is known"
    qtbot.waitUntil(lambda: not window.isVisible(), timeout=WAIT_MS)
    assert user.reads() == "CNC_1: The control contains all old values. Stopped."


def test_a_tick_is_for_the_dangers_that_were_shown_and_for_no_other(
    window: MainWindow, start_control: Start, qtbot: QtBot
) -> None:
    """Ticked once, it was for every value after that, and at every control."""
    control = start_control(file=nearly(window))
    page = at_control(window, control.address, "send", qtbot)
    page.checked.setChecked(True)
    page.table.take([EXCESS], file=False)
    assert page.checked.isChecked(), "less than was checked"
    page.again.click()
    settled(window, qtbot)
    assert page.checked.isChecked(), "the same as was checked"
    window.workspace.edit("wider", {OTHER: Value(12.5, "mm")})
    page.connect_again()
    settled(window, qtbot)
    assert not page.checked.isChecked()
    assert page.hint.text() == "Waiting: what can be dangerous is not checked"


def test_the_sides_chosen_at_one_control_are_not_those_of_another(
    window: MainWindow, start_control: Start, qtbot: QtBot
) -> None:
    """A value kept at one was kept at the next, and its dangers were listed before that was read."""
    page = at_control(window, start_control(file=nearly(window)).address, "send", qtbot)
    page.table.take([EXCESS], file=False)
    page = at_control(window, "tcp://127.0.0.1:1", "send", qtbot)
    assert page.steps.list.count() == 0
    page = at_control(window, start_control(file=nearly(window)).address, "send", qtbot)
    assert page.primary.text() == "Send 3 Values to the Control"


def test_what_a_control_does_not_have_is_shown_before_the_rest_is_sent(
    window_with: Callable[..., MainWindow], start_control: Start, qtbot: QtBot
) -> None:
    """Only the proof named the values of an axis that the control does not have."""
    control = start_control(family="grblhal", machine="grblhal")
    window = window_with(content_of(new_file("grblhal", "grblhal", list("XYZA"))))
    page = at_control(window, control.address, "send", qtbot)
    assert not page.primary.isEnabled(), "0 values could be sent"
    window.workspace.edit("travel", {window.workspace.file.find("$130"): Value(301.5, "mm")})
    page.turn("send")
    assert page.primary.text() == "Save and Send 1 Value to the Control"
    assert page.bar.text.text() == (
        "A part of the file is not sent: the control does not have $47, $103, $113, $123, $133, $538, $701."
    )


def test_what_was_read_before_the_line_was_lost_has_its_time(
    window: MainWindow, start_control: Start, qtbot: QtBot
) -> None:
    """How many differ was there as before, though the control was off."""
    control = start_control(file=nearly(window))
    page = at_control(window, control.address, "compare", qtbot)
    assert page.counts.text().startswith("3 differ, ")
    control.stop()
    page.connect_again()
    settled(window, qtbot)
    assert page.counts.text().startswith("Read at today ")
    assert ": 3 differ, " in page.counts.text()


@pytest.mark.usefixtures("german")
@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("the control has not answered for 8 s", "die Steuerung hat nicht geantwortet (seit 8 s)"),
        (
            (
                "Download complete and read back equal. Axis X has taken its setups over (change default"
                " setups, acknowledged). The card has saved it (ESAVE). What it contained before is kept"
                " in a.img."
            ),
            (
                "Übertragung fertig, und das Zurückgelesene ist gleich. Die Achse X hat ihre Einstellungen"
                " übernommen (change default setups, bestätigt). Die Karte hat es gespeichert (ESAVE). Was"
                " sie vorher enthielt, liegt in a.img."
            ),
        ),
        (
            "no connection to the control (serial:/dev/ttyS0: another program has this port open)",
            (
                "keine Verbindung zur Steuerung (serial:/dev/ttyS0: ein anderes Programm hat diesen Anschluss"
                " geöffnet)"
            ),
        ),
        (
            "what the control contains could not be kept (a.sha256: No space left on device)",
            "was die Steuerung enthält, ließ sich nicht aufbewahren (a.sha256: No space left on device)",
        ),
        (
            (
                "the control contains something else than what was approved to be replaced (sha256 22…,"
                " approved 45…)"
            ),
            "die Steuerung enthält etwas anderes als das, was gezeigt wurde (SHA-256 22…, gezeigt 45…)",
        ),
        (
            "the control refuses $20=1 (Soft limits enable) (error 10); 4 of 5 values were confirmed",
            "die Steuerung lehnt $20=1 (Soft limits enable) ab (Fehler 10); 4 von 5 Werten sind bestätigt",
        ),
        (
            (
                "Change complete and read back equal. What it contained before is kept in a b.img. Not sent:"
                " the control does not have $47."
            ),
            (
                "Geändert und zurückgelesen: gleich. Was sie vorher enthielt, liegt in a b.img. Nicht"
                " gesendet: die Steuerung hat nicht: $47."
            ),
        ),
    ],
)
def test_how_an_exchange_ends_is_german_in_a_german_window(text: str, words: str) -> None:
    assert message_in_words(text) == words


def test_a_control_that_two_files_have_is_listed_in_the_state_that_the_page_shows(
    window: MainWindow, start_control: Start, qtbot: QtBot
) -> None:
    """The file that had asked first was listed: "not reached" beside a page that was ready."""
    control = start_control(file=nearly(window))
    window.control._session_of(control.address, None).error = "no connection to the control"
    at_control(window, control.address, "compare", qtbot)
    assert window.control._listed(control.address).state == "ready"


def test_a_control_of_another_family_than_the_file_is_listed_with_the_name_of_its_family(
    window: MainWindow,
) -> None:
    """It was listed with the id of its family: "57c422b"."""
    for family, address in (("57c422b", "tcp://10.0.0.1:9600"), ("of a plugin", "tcp://10.0.0.2:9600")):
        window.control.exchanges.remember_contact(address, "connect", reached=True, family=family)
    listed = [window.control._listed(f"tcp://10.0.0.{n}:9600").family for n in (1, 2)]
    assert listed == ["57C422B", "of a plugin"]


def test_a_family_without_an_emulated_control_starts_none(window_with: Callable[..., MainWindow]) -> None:
    """A process began and ended with a sentence for who writes the facts of a family."""
    window = window_with("linuxcnc-mill")
    window.menus["control.start"].trigger()
    assert not window.control.emulated.is_running
    assert window.statusBar().currentMessage() == "There is no emulated control of LinuxCNC."
