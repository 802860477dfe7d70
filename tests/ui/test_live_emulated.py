"""Live of the emulated control that the window itself starts: the one with the machine of the family behind
it."""

from collections.abc import Callable
from typing import Any

from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from amp_studio.transfer import ControlStatus
from amp_studio.transfer.client.record import read_exchanges
from amp_studio.ui.base.emulated_control import EmulatedControl
from amp_studio.ui.control.readings import StatusReadings
from amp_studio.ui.main_window import MainWindow

from .conftest import WAIT_MS, User

GAIN = ("gain.velocity", "X")


def first_reading(qtbot: QtBot, family: str, machine: str) -> ControlStatus:
    """Return what an emulated control that is started as the window does shows first."""
    emulated = EmulatedControl(QApplication.instance())
    with qtbot.waitSignal(emulated.ready, timeout=3 * WAIT_MS):
        emulated.start(family, machine)
    readings = StatusReadings(emulated.screen or emulated.address, family)
    with qtbot.waitSignal(readings.read, timeout=WAIT_MS) as first:
        readings.start()
    with qtbot.waitSignal(readings.failed, timeout=WAIT_MS):
        readings.stop()
    emulated.stop(wait=True)
    assert first.args is not None
    found = first.args[0]
    assert isinstance(found, ControlStatus)
    return found


def test_the_emulated_57c422b_of_the_window_shows_its_axes(qtbot: QtBot) -> None:
    """It was that of a gateway, behind which there is no machine: Live had no axis and no fault."""
    found = first_reading(qtbot, "57c422b", "module")
    assert [axis.axis for axis in found.axes] == ["X", "Y"]
    assert found.faults[0].text == "System fault"


def test_a_value_is_written_into_the_emulated_57c422b_read_back_and_recorded(
    qtbot: QtBot, window_with: Callable[..., MainWindow], user: User
) -> None:
    window = window_with("57c422b-label-press")
    window.control.start_emulated()
    qtbot.waitUntil(lambda: bool(window.control.emulated.address), timeout=3 * WAIT_MS)
    window.go_to(GAIN)
    window.menus["control.live"].trigger()
    page: Any = window.page_in_front.pages["live"]
    qtbot.waitUntil(lambda: page._status is not None, timeout=2 * WAIT_MS)
    assert page.rows.address == GAIN  # that of the table
    user.answers("Write Now", "Leave in the Control")
    page.frame.step(2)
    page.frame.write.click()
    qtbot.waitUntil(lambda: GAIN in page.turned and page.is_live, timeout=2 * WAIT_MS)
    assert page._present().get(GAIN).value == 2  # 0 after power-on, two steps up
    workspace = window.workspace_in_front
    (last,) = read_exchanges(workspace.path.parent)[-1:]
    assert (last.verb, last.control) == ("tune", window.control.emulated.address)
    with qtbot.waitSignal(page.readings.failed, timeout=WAIT_MS):
        window.menus["control.live"].trigger()
    window.control.emulated.stop(wait=True)
