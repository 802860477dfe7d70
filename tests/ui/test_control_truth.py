"""What the page at the control states of an exchange is what happened: of a file that is edited meanwhile, of
a value alone, of a stop after the commit, of a password that is asked for later.
"""

from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from amp_studio.schema import Value
from amp_studio.transfer.client import parameters
from amp_studio.transfer.errors import Confirmed, TransferError
from amp_studio.transfer.links import enter_password, parse_endpoint
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
        (TransferError("stopped", "new"), True, "The control contains the new value. Stopped."),
        (TransferError("refused"), True, "The control contains the old value. Refused."),
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
