"""The page Live: what a control states of itself, beside the file, and a single value that is written."""

import threading
from collections.abc import Callable
from dataclasses import replace
from datetime import UTC, datetime
from types import SimpleNamespace
from typing import Any

import pytest
from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, Value
from amp_studio.transfer import AxisStatus, ControlIdentity, ControlStatus, known_fault
from amp_studio.transfer.errors import ConnectionCutError, NoConnectionError
from amp_studio.ui.actions.control import state_in_words
from amp_studio.ui.control import readings as live
from amp_studio.ui.control.readings import StatusReadings
from amp_studio.ui.control.session import ControlSession
from amp_studio.ui.live.page import LiveView
from amp_studio.ui.live.rows import CONTROL, NAME, REMARK, TurnedValue
from amp_studio.ui.main_window import MainWindow

from .conftest import WAIT_MS, User

GAIN, ERROR = ("gain.velocity", "X"), ("setup.max_position_error", "X")


class StoppedReadings(QObject):
    """Readings that a test gives, one at a time."""

    read = Signal(object, float)
    failed = Signal(object)

    def __init__(self) -> None:
        super().__init__()
        self.is_running = False

    def start(self) -> None:
        self.is_running = True

    def stop(self) -> None:
        if self.is_running:
            self.is_running = False
            self.failed.emit(None)


class StoppedSession(QObject):
    """A control that contains a file, and takes single values."""

    changed = Signal()
    value_written = Signal(object)

    def __init__(self, file: ParameterFile, *, takes_one: bool = True) -> None:
        super().__init__()
        self.address, self.family = "tcp://bench:1", file.schema.family.family
        self.content = file
        self.seen = SimpleNamespace(takes_one=takes_one)
        self.is_seen_old = self.is_refused = False
        self.phase, self.is_busy, self.error, self.refuses = "ready", False, "", ""
        self.failure = SimpleNamespace(at_control="old")
        self.written: list[tuple[Address, Value | None]] = []

    def present(self, _file: ParameterFile) -> ParameterFile:
        return self.content

    def note_loss(self, error: Exception) -> None:
        self.phase, self.error = "away", str(error)

    def note_answer(self) -> None:
        self.phase, self.error = "ready", ""

    def read(self) -> None:
        self.phase = "ready"
        self.changed.emit()

    def write_one(self, address: Address, file: ParameterFile, _path: object) -> None:
        self.phase = "failed" if self.refuses else "done"
        self.error = self.refuses
        if not self.refuses:
            self.written.append((address, file.get(address)))
            self.content.set(address, file.get(address))
            self.value_written.emit(address)
        self.changed.emit()


def status(*faults: str, error: float = 2.0) -> ControlStatus:
    axes = (
        AxisStatus("X", 1000.0, error, 50.0, "counts", ("axis busy", "control loop enabled")),
        AxisStatus("Y", 0.0),
    )
    found = tuple(known_fault("57c422b", code, "Maximum position error exceeded", "X") for code in faults)
    return ControlStatus("57c422b", "registers", "module", "", axes, found, {"feed": 20.0})


@pytest.fixture
def page(window_with: Callable[..., MainWindow], qtbot: QtBot) -> LiveView:
    """Return the page of the example press, live, with a control that contains the same file."""
    return made(window_with("57c422b-label-press"), qtbot)


def made(window: MainWindow, qtbot: QtBot, *, takes_one: bool = True) -> LiveView:
    workspace = window.workspace_in_front
    view = LiveView(workspace)
    qtbot.addWidget(view)
    session = StoppedSession(workspace.file.copy(), takes_one=takes_one)
    view.use(session, "tcp://bench:1", "bench", readings=StoppedReadings())  # type: ignore[arg-type]  # the parts that it uses
    schema = workspace.file.schema
    view.show_parameters("Gains", [schema.parameters[each[0]] for each in (GAIN, ERROR)], "X")
    view.start()
    view.resize(1300, 700)
    view.show()
    return view


def session_of(page: LiveView) -> StoppedSession:
    found: Any = page.session
    assert isinstance(found, StoppedSession)
    return found


def cell(page: LiveView, row: int, column: int) -> str:
    item = page.rows.item(row, column)
    return item.text() if item else ""


def test_a_reading_shows_position_error_speed_and_the_words_of_the_control(page: LiveView) -> None:
    assert page.panel.figures["position"].text() == "–"
    page.show_status(status())
    figures = [page.panel.figures[name].text() for name in ("position", "error", "velocity")]
    assert figures == ["1000", "2", "50"]
    assert page.panel.units["velocity"].text() == "counts/s"
    assert page.panel.values.text() == "feed 20"
    assert "●&nbsp;axis busy" in page.panel.lamps.text()
    page.axes.buttons["Y"].click()
    assert page.panel.heading.text() == "Live, Y"
    assert page.panel.figures["error"].isHidden()


def test_states_that_are_off_have_an_empty_lamp_and_the_error_is_a_mark_between_its_limits(
    page: LiveView,
) -> None:
    known = ("axis busy", "control loop enabled", "home sequence complete")
    axis = replace(status().axes[0], known_states=known, raw="R72 = 0085H")
    page.show_status(replace(status(), axes=(axis,)))
    assert "○&nbsp;home sequence complete" in page.panel.lamps.text()
    assert page.panel.raw.text() == "R72 = 0085H"
    assert page.panel.bars["error"].share == 0.5005
    assert [label.text() for label in page.panel.bar_words["error"]] == ["Following error −2000", "2000"]
    assert page.panel.bars["position"].isHidden()


def test_a_fault_comes_with_cause_cure_parameters_and_page_and_one_that_is_over_is_history(
    page: LiveView,
) -> None:
    followed: list[str] = []
    page.linked.connect(followed.append)
    page.show_status(status())
    page.show_status(status("R73 bit 4"))
    text = page.panel.faults.text()
    assert "R73 bit 4" in text
    assert "Cause:" in text
    assert "(page " in text
    assert page.is_live
    page.panel.faults.linkActivated.emit("setup.max_position_error")
    assert followed == ["setup.max_position_error"]
    page.show_status(status())
    assert page.panel.faults.isHidden()
    assert "R73 bit 4" in page.panel.events.text()


def test_readings_that_fail_are_no_exchange_that_replaces_anything(page: LiveView, german: None) -> None:
    """It ended in English, with "nothing was replaced in the control"."""
    page._over(NoConnectionError("no connection to the control (tcp://127.0.0.1:1: nothing listens there)"))
    assert page.bar.text.text() == "Keine Verbindung zur Steuerung (tcp://127.0.0.1:1: dort antwortet nichts)"
    assert not page.panel.readings.isEnabled()


def test_without_an_answer_for_two_seconds_the_figures_are_grey_with_their_age(page: LiveView) -> None:
    page.show_status(status())
    page._silent()
    assert page.bar.text.text().startswith("No answer since ")
    assert not page.panel.readings.isEnabled()
    page.show_status(status())
    assert page.bar.isHidden()
    assert page.panel.readings.isEnabled()


def test_a_reading_is_drawn_at_the_time_of_its_answer_however_late_the_window_takes_it(
    page: LiveView,
) -> None:
    """A window that was busy drew several readings at one time."""
    page.readings.read.emit(status(), page._begun + 1.0)
    page.readings.read.emit(status(), page._begun + 1.2)
    times = [at for at, _ in page.recorder._recent.signals["position"]]
    assert times == pytest.approx([1.0, 1.2])


def test_rows_show_the_file_beside_the_control_and_what_differs(page: LiveView) -> None:
    assert (cell(page, 0, NAME), cell(page, 0, REMARK)) == ("Velocity Gain", "")
    session_of(page).content.set(GAIN, Value(104, ""))
    session_of(page).changed.emit()
    assert (cell(page, 0, CONTROL), cell(page, 0, REMARK)) == ("104", "differs from the file")


def test_a_value_is_turned_by_keys_written_after_one_question_and_put_back(
    page: LiveView, user: User
) -> None:
    field = page.frame.field
    assert page.frame.write.text() == "&Write 78 Now"
    assert not page.frame.write.isEnabled()
    QTest.keyClick(field, Qt.Key.Key_Up, Qt.KeyboardModifier.ShiftModifier)
    QTest.keyClick(field, Qt.Key.Key_Up)
    assert (field.text(), page.frame.write.text()) == ("89", "&Write 89 Now")
    user.answers("Cancel")
    QTest.keyClick(field, Qt.Key.Key_Return, Qt.KeyboardModifier.ControlModifier)
    assert session_of(page).written == []
    user.answers("Write Now")
    QTest.keyClick(field, Qt.Key.Key_Return, Qt.KeyboardModifier.ControlModifier)
    assert user.asked[-1].startswith("Write R5 Velocity Gain, X axis = 89 into bench now?")
    assert cell(page, 0, REMARK).startswith("turned, was 78 until ")
    assert page._workspace.file.get(GAIN).value == 78
    QTest.keyClick(field, Qt.Key.Key_Up)
    page.frame.write.click()  # asked once
    assert page.frame.back.text() == "Put 78 &Back"
    QTest.keyClick(field, Qt.Key.Key_Backspace, Qt.KeyboardModifier.ControlModifier)
    assert [value.value for _, value in session_of(page).written if value] == [89, 90, 78]
    assert page.turned == {}
    assert page.is_live


def test_a_value_out_of_range_is_refused_in_the_frame_and_the_control_may_refuse_too(
    page: LiveView, user: User
) -> None:
    field = page.frame.field
    field.setText("99999")
    field.textEdited.emit("99999")
    assert not page.frame.write.isEnabled()
    assert "99\u202f999" in page.frame.hint.text()
    session_of(page).refuses = "the control loop of axis X is on (R65, bit 0): switch it off to download"
    page.frame.step(0)
    field.setText("80")
    field.textEdited.emit("80")
    user.answers("Write Now")
    page.frame.write.click()
    assert page.frame.hint.text().startswith("The control loop of axis X is on")
    assert not page.frame.write.isEnabled()
    assert page.is_live
    page.show_status(status())  # its state is another one: it may take it now
    assert page.frame.write.isEnabled()


def test_a_control_that_takes_no_single_values_has_no_frame_but_the_reason(
    window_with: Callable[..., MainWindow], qtbot: QtBot
) -> None:
    page = made(window_with("57c422b-label-press"), qtbot, takes_one=False)
    assert page.frame.isHidden()
    assert page.reason.text().startswith("Reads only: this control takes no single values")
    assert page.read.isHidden()
    session_of(
        page
    ).is_seen_old = True  # a file was sent meanwhile: what was read before is not there any more
    session_of(page).changed.emit()
    assert cell(page, 0, CONTROL) == "–"
    assert not page.read.isHidden()


@pytest.mark.parametrize(
    ("answer", "contained", "in_file"),
    [("Put Back", 78, 78), ("Take into the File", 89, 89), ("Leave in the Control", 89, 78)],
)
def test_leaving_with_a_value_turned_asks_once(
    page: LiveView, user: User, answer: str, contained: int, in_file: int
) -> None:
    user.answers("Write Now", answer)
    page.write(GAIN, Value(89, ""))
    assert page.may_turn_away()
    assert session_of(page).content.get(GAIN).value == contained
    assert page._workspace.file.get(GAIN).value == in_file
    assert page.may_turn_away()


def test_an_exchange_ends_it_and_it_can_be_started_again(page: LiveView) -> None:
    page.show_status(status())
    session_of(page).is_busy = True
    session_of(page).changed.emit()
    assert page.bar.text.text() == "Live has ended: an exchange is under way."
    assert not page.is_live
    session_of(page).is_busy = False
    session_of(page).changed.emit()
    assert not page.is_live
    page.bar.buttons[0].click()
    assert page.is_live


def test_keys_of_an_emulated_control_are_pressed_and_its_answer_is_an_event(page: LiveView) -> None:
    class Keys(QObject):
        line_shown = Signal(str)

        def send(self, command: str) -> None:
            self.line_shown.emit(f"did {command}")

    keys: Any = Keys()
    page.use(page.session, "tcp://bench:1", "bench", keys)  # type: ignore[arg-type]  # the session of the fixture
    page.panel.keys.setText("jog X+")
    page.panel.keys.returnPressed.emit()
    assert page.happened.events[0].endswith("did jog X+")
    assert page.frame.head.text() == "Writes to the emulated control"


def test_live_is_a_page_of_the_file_and_ends_when_another_page_comes(
    window_with: Callable[..., MainWindow], monkeypatch: pytest.MonkeyPatch, user: User
) -> None:
    monkeypatch.setattr(StatusReadings, "start", lambda self: setattr(self, "_task", self))
    monkeypatch.setattr(
        StatusReadings, "stop", lambda self: (setattr(self, "_task", None), self.failed.emit(None))
    )
    monkeypatch.setattr(LiveView, "_takes_one", lambda _: False)
    window = window_with("57c422b-label-press")
    window.control.exchanges.choose(window.workspace, "tcp://127.0.0.1:1")
    live_action = window.menus["control.live"]
    live_action.trigger()
    page: Any = window.page_in_front.pages["live"]
    assert page.isVisible()
    assert page.is_live
    assert window.control.state_of(window.workspace)[1] == "live"
    page.turned[GAIN] = TurnedValue(Value(78, ""), datetime.now(UTC))
    user.answers("Cancel")
    window.menus["view.values"].trigger()
    assert page.isVisible()
    page.turned.clear()
    window.menus["view.values"].trigger()
    assert not page.isVisible()
    assert not page.is_live
    live_action.trigger()
    live_action.trigger()
    assert window.page_in_front.turned_to == ""


def test_what_begins_between_two_readings_is_an_event(page: LiveView) -> None:
    page.show_status(status())
    axes = (AxisStatus("X", 0.0, 0.0, 0.0, "counts", ("axis done", "control loop enabled")),)
    page.show_status(ControlStatus("57c422b", "registers", "module", "", axes))
    assert [event[9:] for event in page.happened.events] == ["X: axis done"]


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
    seen: list[float] = []
    readings.read.connect(lambda _status, at: seen.append(at))
    readings.start()
    qtbot.waitUntil(lambda: len(seen) >= 3, timeout=WAIT_MS)
    with qtbot.waitSignal(readings.failed, timeout=WAIT_MS):
        readings.stop()
    assert closed.is_set()
    assert seen == sorted(seen)
    assert all(0.1 < wait <= 0.2 for wait in waits)
    qtbot.waitUntil(lambda: not live.Task.running, timeout=WAIT_MS)


def _with_event(begin: Callable[..., None], event: type[threading.Event]) -> Callable[..., None]:
    def init(self: live.Task, *args: object) -> None:
        begin(self, *args)
        self.cancelled = event()

    return init


@pytest.mark.usefixtures("german")
def test_a_german_page_has_the_faults_words_and_notes_in_german(page: LiveView) -> None:
    page.panel._family = "grblhal"
    fault = known_fault("grblhal", "ALARM:9", "The control is locked")
    note = "positions in machine coordinates, in mm unless $13 is on"
    axes = (AxisStatus("X", 1.0, unit="mm"),)
    page.show_status(
        ControlStatus("grblhal", "grbl", "router", "Alarm", axes, (fault,), {"spindle speed": 0.0}, (note,))
    )
    assert "Der Schalter wurde bei der Suche nicht erreicht" in page.panel.faults.text()
    assert ">Maximum travel</a>" in page.panel.faults.text()
    assert page.panel.values.text() == "Alarm, Spindeldrehzahl 0"
    assert page.panel.notes.text().startswith("Positionen in Maschinenkoordinaten")


def test_a_line_that_is_lost_is_called_lost_where_the_control_is_shown_until_it_answers_again(
    page: LiveView,
) -> None:
    """The tool bar had "ready" beside a control whose cable was out, and the frame still wrote."""
    session = ControlSession("tcp://bench:1", "57c422b")
    content = session_of(page).content
    identity = ControlIdentity("57c422b", "bench", "module", "", None)
    session._take_seen(SimpleNamespace(control=identity, takes_one=True, file=content))  # type: ignore[arg-type]  # what a page asks of it
    page.use(session, "tcp://bench:1", "bench", readings=StoppedReadings())  # type: ignore[arg-type]  # the parts that it uses
    page.readings.start()
    page.show_status(status())
    assert (state_in_words(session), page.state) == (("ready", False), ("live", False))
    page.frame.step(1)
    assert page.frame.write.isEnabled()
    page.readings.is_running = False
    page.readings.failed.emit(ConnectionCutError("the line to the control broke (tcp://bench:1: gone)"))
    assert state_in_words(session) == ("connection lost", True)
    assert page.frame.hint.text().startswith("The line to the control broke")
    assert not page.frame.write.isEnabled()
    page.readings.start()
    page.show_status(status())
    assert state_in_words(session) == ("ready", False)
    assert page.frame.write.isEnabled()


def test_a_control_without_an_answer_is_not_called_live(page: LiveView) -> None:
    page.show_status(status())
    states: list[tuple[str, bool]] = []
    page.changed.connect(lambda: states.append(page.state))
    page._silent()
    page.show_status(status())
    assert states == [("no answer", True), ("live", False)]


@pytest.mark.parametrize("why", ["read-only", "not read"])
def test_without_a_way_into_the_file_there_is_a_reason_and_the_page_stays(
    page: LiveView, user: User, monkeypatch: pytest.MonkeyPatch, why: str
) -> None:
    """The page was left without a word, and neither file nor control had what was wanted."""
    user.answers("Write Now", "Take into the File", "Leave in the Control")
    page.write(GAIN, Value(89, ""))
    if why == "read-only":
        monkeypatch.setattr(type(page._workspace), "may_edit", property(lambda _: False))
    else:
        session_of(page).is_seen_old = True
    assert not page.may_turn_away()
    assert "nothing was taken into" in page.bar.text.text()
    assert page._workspace.file.get(GAIN).value == 78
    assert list(page.turned) == [GAIN]
    assert page.may_turn_away()


def test_a_control_that_cannot_be_read_while_it_moves_is_looked_at_all_the_same(page: LiveView) -> None:
    """A Grbl answers $I and $$ at rest alone, and Live of one that moved ended before it had begun."""
    session = session_of(page)
    page.readings.stop()
    session.is_refused, session.phase = True, "away"
    session.error = "the control cannot be read while it moves"
    session.seen = session.content = None  # type: ignore[assignment]  # nothing was read
    page._is_own = True
    session.changed.emit()
    assert page.is_live
    assert page.reason.text() == "The control cannot be read while it moves"
    assert not page.read.isHidden()
