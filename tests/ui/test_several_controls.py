"""Several controls on the page at the control, and the exchanges that were recorded."""

from pathlib import Path

import pytest
from pytestqt.qtbot import QtBot

from amp_studio.ui.control.several import SeveralControls
from amp_studio.ui.main_window import MainWindow

from .at_control import at_control, nearly, sent, settled
from .conftest import WAIT_MS, User, action

DEAD = "tcp://127.0.0.1:1"


@pytest.fixture
def several(window: MainWindow) -> SeveralControls:
    """Return the state of the page, shown."""
    action(window, "Several Controls").trigger()
    return window.control.page.several


def ticked(window: MainWindow, *addresses: str) -> None:
    """Tick controls, as they are typed into the field at the left."""
    for address in addresses:
        window.control.page.known.field.setText(address)
        window.control.page.known.field.returnPressed.emit()


def results(several: SeveralControls, qtbot: QtBot) -> list[tuple[str, str]]:
    """Return the address and the result of each ticked row once all have ended."""
    qtbot.waitUntil(lambda: not several.is_busy, timeout=WAIT_MS)
    return [(i.text(1), i.text(2)) for i in several._items() if i.text(1) in several.ticked]


def test_a_file_goes_to_several_controls_and_each_exchange_is_recorded(
    window: MainWindow, several: SeveralControls, path: Path, start_control, user: User, qtbot: QtBot
) -> None:
    one, two = start_control().address, start_control().address
    ticked(window, one, f"  {two} ")
    page = window.control.page
    page.directions.buttons["send"].click()
    assert several.primary.text() == "Send to 2 Controls"
    assert not several.primary.isEnabled(), "that all is replaced is not checked"
    several.checked.click()
    several.primary.click()
    assert window.control.is_sending
    assert results(several, qtbot) == [(one, "done"), (two, "done")]
    assert not several.checked.isChecked(), "asked again for the next time"
    page.directions.buttons["compare"].click()
    several.press()
    assert results(several, qtbot) == [(one, "same"), (two, "same")]
    table = path.with_name("table.html")
    user.chooses(table)
    several.save_button.click()
    assert one in table.read_text()

    action(window, "Exchanges of This File").trigger()
    listed = page.history.tree
    assert page.states.currentWidget() is page.history
    verbs = [listed.topLevelItem(n).text(2) for n in range(listed.topLevelItemCount())]
    assert verbs == ["verify", "verify", "download", "download"]
    assert listed.topLevelItem(3).childCount() > 0, "what the download changed"
    assert not page.history.restore.isEnabled(), "a comparison replaced nothing"
    page.past.click()
    assert page.states.currentWidget() is several


def test_a_backup_is_put_back_from_the_exchange_that_made_it(
    window: MainWindow, start_control, qtbot: QtBot
) -> None:
    control = start_control(file=nearly(window))
    sent(window, control.address, qtbot)
    window.edits.commit(("servo.excess_error", "1"), "12 mm")
    assert window.save()
    sent(window, control.address, qtbot)
    window.control.recorded()
    page = window.control.page
    page.history.restore.click()
    settled(window, qtbot)
    assert page.backup is not None
    assert page.primary.text().startswith("Restore mill.before-")
    assert at_control(window, control.address, "compare", qtbot).backup is None


def test_after_a_failure_the_next_control_is_not_begun(
    window: MainWindow, several: SeveralControls, start_control, qtbot: QtBot
) -> None:
    control = start_control().address
    ticked(window, DEAD, control)
    several.primary.click()
    assert results(several, qtbot) == [(DEAD, "failed"), (control, "not tried")]
    assert several.bar.text.text() == "0 of 2 without a failure"


def test_what_cannot_be_exchanged_is_shown_before_anything_is(
    window: MainWindow, several: SeveralControls, user: User
) -> None:
    assert several.primary.text() == "Compare With 0 Controls"
    assert "Tick the controls" in several.hint.text()
    ticked(window, "x")
    assert "is no address" in user.reads()
    ticked(window, DEAD, "tcp://127.0.0.1:1?protocol=house")
    window.edits.commit(("servo.excess_error", "1"), "12 mm")
    window.control.page.turn("send")
    assert several.hint.text() == "Waiting: the file is not saved"
    several.bar.buttons[0].click()
    assert several.hint.text() == "Waiting: what is replaced is not checked"
