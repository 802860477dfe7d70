"""Live of the emulated control that the window itself starts: the one with the machine of the family behind it."""

from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from amp_studio.transfer import ControlStatus
from amp_studio.ui.base.emulated_control import EmulatedControl
from amp_studio.ui.control.readings import StatusReadings

from .conftest import WAIT_MS


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
