"""The page at the control in a test: a control is chosen, and what is under way comes to its end."""

from pytestqt.qtbot import QtBot

from amp_studio.files import ParameterFile
from amp_studio.schema import Value
from amp_studio.ui.control.next_step import ExchangeDirection
from amp_studio.ui.control.page import ControlPage
from amp_studio.ui.main_window import MainWindow

from .conftest import WAIT_MS


def at_control(window: MainWindow, address: str, direction: ExchangeDirection, qtbot: QtBot) -> ControlPage:
    """Return the page in a direction, after the control was read or was not reached."""
    window.control.exchanges.choose(window.workspace, address)
    window.control.show(direction, address)
    return settled(window, qtbot)


def settled(window: MainWindow, qtbot: QtBot) -> ControlPage:
    """Return the page once nothing is under way."""
    page = window.control.page
    qtbot.waitUntil(lambda: page.session is not None and not page.session.is_busy, timeout=WAIT_MS)
    return page


def sent(window: MainWindow, address: str, qtbot: QtBot) -> ControlPage:
    """Return the page after the file in front was sent, dangers checked."""
    page = at_control(window, address, "send", qtbot)
    page.checked.setChecked(True)
    assert page.primary.isEnabled(), page.hint.text()
    page.press()
    return settled(window, qtbot)


def nearly(window: MainWindow) -> ParameterFile:
    """Return the file in front with one value of each linear axis another one, for a control to contain."""
    assert window.workspace is not None
    file = window.workspace.file.copy()
    for axis in "123":
        file.set(("servo.excess_error", axis), Value(10.0, "mm"))
    return file
