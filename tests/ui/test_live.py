"""The live page: figures, faults with cause and cure, and what ends it."""

import threading
from collections.abc import Callable
from dataclasses import replace

import pytest
from PySide6.QtCore import QObject, Signal
from pytestqt.qtbot import QtBot

from amp_studio.pictures import LiveLimits
from amp_studio.transfer import AxisStatus, ControlStatus, known_fault
from amp_studio.transfer.errors import NoConnectionError
from amp_studio.ui.control import readings as live
from amp_studio.ui.control.live import LivePage
from amp_studio.ui.control.readings import StatusReadings

from .conftest import WAIT_MS


class StoppedReadings(QObject):
    """Readings that a test gives, one at a time."""

    read = Signal(object)
    failed = Signal(object)

    def __init__(self) -> None:
        super().__init__()
        self.is_running = False

    def start(self) -> None:
        self.is_running = True

    def stop(self) -> None:
        self.is_running = False
        self.failed.emit(None)


def status(*faults: str, error: float = 2.0) -> ControlStatus:
    axes = (
        AxisStatus("X", 1000.0, error, 50.0, "counts", ("axis busy", "control loop enabled")),
        AxisStatus("Y", 0.0),
    )
    found = tuple(known_fault("57c422b", code, "Maximum position error exceeded", "X") for code in faults)
    return ControlStatus("57c422b", "registers", "module", "", axes, found, {"feed": 20.0})


@pytest.fixture
def followed() -> list[str]:
    """Return the parameters whose links were followed."""
    return []


@pytest.fixture
def page(qtbot: QtBot, followed: list[str]) -> LivePage:
    displayed = LivePage("tcp://bench:1", "57c422b", followed.append, readings=StoppedReadings())  # type: ignore[arg-type]  # the part that it uses
    qtbot.addWidget(displayed)
    displayed.start()
    return displayed


def cell(page: LivePage, row: int, column: int) -> str:
    item = page.axes.item(row, column)
    return item.text() if item else ""


def test_a_reading_shows_position_error_speed_and_the_words_of_the_control(page: LivePage) -> None:
    page.show_status(status())
    assert [cell(page, 0, n) for n in range(5)] == [
        "X",
        "1000 counts",
        "2 counts",
        "50 counts/s",
        "axis busy, control loop enabled",
    ]
    assert cell(page, 1, 2) == "–"
    assert page.figures.text() == "1000 counts"
    assert "feed 20" in page.values.text()
    assert page.toggle.text() == "&Stop"


def test_states_are_lamps_and_the_axis_is_a_mark_between_its_limits(qtbot: QtBot) -> None:
    """What the control knows and is not so has an empty lamp; without limits in the file there is no bar."""
    asked: list[tuple[str, str]] = []

    def limits(axis: str, unit: str) -> LiveLimits:
        asked.append((axis, unit))
        return LiveLimits(0.0, 4000.0, 2000.0) if axis == "X" else LiveLimits()

    page = LivePage("tcp://bench:1", "57c422b", print, readings=StoppedReadings(), limits=limits)  # type: ignore[arg-type]  # the parts that it uses
    qtbot.addWidget(page)
    known = ("axis busy", "control loop enabled", "home sequence complete")
    axis = replace(status().axes[0], known_states=known)
    page.show_status(replace(status(), axes=(axis, status().axes[1])))
    assert page.lamps.text().split("   ") == [
        "●\u00a0axis busy",
        "●\u00a0control loop enabled",
        "○\u00a0home sequence complete",
    ]
    assert (page.bars["position"].share, page.bars["error"].share) == (0.25, 0.5005)
    assert page.bar_words["error"].text() == "Following error -2000 … 2000 counts"
    assert not page.bars["position"].isHidden()
    page.chosen.setCurrentIndex(1)
    assert page.bars["position"].isHidden()
    assert asked[0] == ("X", "counts")


def test_a_fault_comes_with_cause_cure_parameters_and_page_and_stops_the_readings(
    page: LivePage, followed: list[str]
) -> None:
    page.show_status(status())
    page.show_status(status("R73 bit 4"))
    text = page.faults.text()
    assert "R73 bit 4" in text
    assert "Cause:" in text
    assert "(page " in text
    assert not page.readings.is_running
    assert page.state.text() == "Stopped: the control has a fault."
    page.faults.linkActivated.emit("setup.max_position_error")
    assert followed == ["setup.max_position_error"]


def test_readings_that_fail_are_no_exchange_that_replaces_anything(page: LivePage, german: None) -> None:
    """It ended in English, with "nothing was replaced in the control"."""
    page._over(NoConnectionError("no connection to the control (tcp://127.0.0.1:1: nothing listens there)"))
    assert page.state.text() == "Keine Verbindung zur Steuerung (tcp://127.0.0.1:1: dort antwortet nichts)"


def test_a_control_without_a_following_error_is_drawn_by_its_position(page: LivePage) -> None:
    axes = (AxisStatus("X", 264.0, None, None, "mm", ("limit switch",)),)
    page.show_status(ControlStatus("grblhal", "grbl", "grblHAL", "Idle", axes))
    assert page.plot.picture is not None
    assert [panel.title for panel in page.plot.picture.panels] == ["position mm"]
    assert "not shown by this control" in page.notes.text()


def test_what_begins_between_two_readings_is_an_event(page: LivePage) -> None:
    page.show_status(status())
    axes = (AxisStatus("X", 0.0, 0.0, 0.0, "counts", ("axis done", "control loop enabled")),)
    page.show_status(ControlStatus("57c422b", "registers", "module", "", axes))
    assert [event[9:] for event in page.happened.events] == ["X: axis done"]


def test_keys_of_an_emulated_control_are_pressed_and_its_answer_is_an_event(qtbot: QtBot) -> None:
    class Keys(QObject):
        line_shown = Signal(str)

        def send(self, command: str) -> None:
            self.line_shown.emit(f"did {command}")

    readings = StoppedReadings()
    page = LivePage("tcp://bench:1", "9pc", print, readings=readings, emulated=Keys())  # type: ignore[arg-type]  # the parts that it uses
    qtbot.addWidget(page)
    page.keys.setText("jog X+")
    page.keys.returnPressed.emit()
    assert page.happened.events[0].endswith("did jog X+")
    assert readings.is_running


def test_a_fault_that_is_over_goes_to_the_history(page: LivePage) -> None:
    page.show_status(status("R73 bit 4"))
    page.start()
    page.show_status(status())
    assert len(page.happened.events) == 1
    assert "R73 bit 4" in page.happened.events[0]
    assert page.happened.events[0] in page.events.text()
    assert page.readings.is_running


def test_an_exchange_ends_it_and_it_can_be_started_again(page: LivePage) -> None:
    page.show_status(status())
    page.stop("Stopped: an exchange is under way.")
    assert page.state.text() == "Stopped: an exchange is under way."
    assert not page.axes.isEnabled()
    page.toggle.click()
    page.show_status(status())
    assert page.axes.isEnabled()


def test_a_control_is_asked_at_most_five_times_a_second_and_the_line_is_closed(
    qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    waits: list[float] = []
    closed = threading.Event()

    class Reader:
        def __init__(self, _address: str, _family: str) -> None:
            pass

        def read(self) -> ControlStatus:
            return status()

        def close(self) -> None:
            closed.set()

    class Cancelled(threading.Event):
        def wait(self, timeout: float | None = None) -> bool:
            waits.append(timeout or 0.0)
            return super().wait(0.001)

    monkeypatch.setattr("amp_studio.transfer.client.StatusReader", Reader)
    monkeypatch.setattr(live.Task, "__init__", _with_event(live.Task.__init__, Cancelled))
    readings = StatusReadings("tcp://bench:1", "57c422b")
    seen: list[object] = []
    readings.read.connect(seen.append)
    readings.start()
    qtbot.waitUntil(lambda: len(seen) >= 3, timeout=WAIT_MS)
    with qtbot.waitSignal(readings.failed, timeout=WAIT_MS):
        readings.stop()
    assert closed.is_set()
    assert all(0.1 < wait <= 0.2 for wait in waits)
    qtbot.waitUntil(lambda: not live.Task.running, timeout=WAIT_MS)


def _with_event(begin: Callable[..., None], event: type[threading.Event]) -> Callable[..., None]:
    def init(self: live.Task, *args: object) -> None:
        begin(self, *args)
        self.cancelled = event()

    return init


@pytest.mark.usefixtures("german")
def test_a_german_page_has_the_faults_words_and_notes_in_german_and_no_columns_of_dashes(
    qtbot: QtBot,
) -> None:
    displayed = LivePage("tcp://bench:1", "grblhal", print, readings=StoppedReadings())  # type: ignore[arg-type]  # the part that it uses
    qtbot.addWidget(displayed)
    fault = known_fault("grblhal", "ALARM:9", "The control is locked")
    note = "positions in machine coordinates, in mm unless $13 is on"
    axes = (AxisStatus("X", 1.0, unit="mm"),)
    displayed.show_status(
        ControlStatus("grblhal", "grbl", "router", "Alarm", axes, (fault,), {"spindle speed": 0.0}, (note,))
    )
    assert "Der Schalter wurde bei der Suche nicht erreicht" in displayed.faults.text()
    assert ">Maximum travel</a>" in displayed.faults.text()
    assert displayed.values.text() == "Spindeldrehzahl 0"
    assert displayed.notes.text().startswith("Positionen in Maschinenkoordinaten")
    assert [n for n in range(5) if displayed.axes.isColumnHidden(n)] == [2, 3, 4]
