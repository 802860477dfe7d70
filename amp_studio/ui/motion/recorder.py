"""The recorder of the motion page: a record of the machine, from a table or live from a control, its trigger,
and the scale of each channel.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QLabel, QPushButton, QWidget

from amp_studio.drawing import Picture
from amp_studio.schema import read_bare_number
from amp_studio.sim import (
    RECORDED_SIGNALS,
    LiveRecorder,
    SignalRecord,
    SimulationError,
    Trace,
    Trigger,
    read_recording,
    recording_picture,
    unit_factor,
    write_recording,
)
from amp_studio.ui.base.ask_path import ask_to_open
from amp_studio.ui.base.figures import written
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.theme import GAP2, colour
from amp_studio.ui.base.translated import sentenced, unit_in_words, worded
from amp_studio.ui.forms.channel_scales import ChannelScales
from amp_studio.ui.forms.form import Field, FieldForm

if TYPE_CHECKING:
    from amp_studio.transfer import AxisStatus, ControlStatus
    from amp_studio.ui.control.readings import StatusReadings

_DRAWN_EVERY = 5
"""Readings from one picture of a live record to the next, once there are many."""


class RecorderPage(QWidget):
    """What is laid over the simulation, and how it is seen."""

    changed = Signal()
    """Another record, or another trigger: the move is simulated and laid over again."""
    live = Signal(object)
    """The picture of a record that is being made."""

    def __init__(
        self, path: Callable[[], Path], axis: Callable[[], tuple[str, str]], control: Callable[[], str | None]
    ) -> None:
        """``axis`` gives the number and letter of the axis that is shown, ``control`` the address where its
        control is read.
        """
        super().__init__()
        self._path, self._axis, self._control = path, axis, control
        self.recording: SignalRecord | None = None
        self._recorder: LiveRecorder | None = None
        self._readings: StatusReadings | None = None
        self._trace: Trace | None = None
        self._began = 0.0
        self.open, self.record = QPushButton(self.tr("&Lay Record Over…")), QPushButton()
        self.open.setToolTip(
            self.tr("The record of the machine (CSV) over the simulation, with the difference; none ends it")
        )
        self.record.setToolTip(self.tr("Readings of the control, each at its time; nothing is written to it"))
        self.state = QLabel()
        self.state.setWordWrap(True)
        self.state.setAccessibleName(self.tr("State of the recorder"))
        self.trigger = FieldForm(self._fields())
        self.channels = ChannelScales()
        self._arrange()
        self.open.clicked.connect(self._ask)
        self.record.clicked.connect(self._start_or_stop)
        self.trigger.entered.connect(lambda _: self._retriggered())
        self._show_state()

    def _fields(self) -> tuple[Field, ...]:
        signals = [(each, worded(each.replace("_", " "))) for each in RECORDED_SIGNALS]
        ways = (
            (">", self.tr("passes the level upwards")),
            ("<", self.tr("passes the level downwards")),
            (">=", self.tr("is at the level or above")),
            ("<=", self.tr("is at the level or below")),
        )
        return (
            Field("signal", self.tr("&Trigger"), "choice", "", (("", self.tr("none: best lag")), *signals)),
            Field("way", self.tr("Fires &where it"), "choice", ">", ways, visible=_has_trigger),
            Field("level", self.tr("Le&vel"), "line", "", visible=_has_trigger),
            Field("before", self.tr("&Before it (s)"), "line", "", hint="0", visible=_has_trigger),
            Field("span", self.tr("Live for (&s)"), "line", "", hint=self.tr("until Stop")),
        )

    def _arrange(self) -> None:
        buttons = in_row(self.open, self.record, 0)
        in_column(buttons, self.state, self.trigger, (self.channels, 1), on=self, margins=(0, GAP2, 0, 0))

    # -- the trigger ---------------------------------------------------------------

    def chosen_trigger(self) -> Trigger | None:
        """Return the trigger that is filled in, in the unit of the simulation; raises ValueError."""
        given = self.trigger.answers()
        if not given["signal"]:
            return None
        before = _seconds(str(given["before"])) or 0.0
        level = read_bare_number(str(given["level"]).strip() or "0")
        way = str(given["way"])
        return Trigger(str(given["signal"]), way[0] == ">", level, before, way.endswith("="))

    def _retriggered(self) -> None:
        if self.recording is not None and self._recorder is None:
            self.changed.emit()

    # -- a record from a table -----------------------------------------------------

    def _ask(self) -> None:
        """Ask for a record of the machine and lay it over the simulation; without one as it was."""
        kinds = self.tr("Records (*.csv *.txt);;All files (*)")
        path = ask_to_open(self, self.tr("Record of the Machine"), self._path().parent, kinds)
        try:
            self.recording = read_recording(path) if path else None
        except (OSError, SimulationError) as error:
            self._say(error)
            return
        self._show_state()
        self.changed.emit()

    # -- live ------------------------------------------------------------------------

    @property
    def is_recording(self) -> bool:
        """Whether readings of a control are being gathered."""
        return self._recorder is not None

    def _start_or_stop(self) -> None:
        if self._recorder is not None:
            self._finish()
            return
        try:
            trigger, span = self.chosen_trigger(), _seconds(str(self.trigger.answers()["span"]))
            address = self._control()
        except ValueError as error:
            self._say(error)
            return
        if address is None:
            return
        from amp_studio.ui.control.readings import StatusReadings

        self._recorder, self._began = LiveRecorder(trigger, span), time.monotonic()
        self._readings = StatusReadings(address, "")
        self._readings.read.connect(self.take)
        self._readings.failed.connect(self._ended)
        self._readings.start()
        self._show_state()

    def take(self, status: ControlStatus, at: float | None = None) -> None:
        """Take a reading of the control, of now or of a time, into the record that is being made."""
        if self._recorder is None:
            return
        try:
            axis = self._axis_of(status)
            at = time.monotonic() if at is None else at
            self._recorder.add(at - self._began, self._in_units(axis))
        except SimulationError as error:
            self._finish()
            self._say(error)
            return
        self._show_state()
        count = self._recorder.count
        if self._recorder.is_done:
            self._finish()
        elif count > 1 and (count < 10 * _DRAWN_EVERY or count % _DRAWN_EVERY == 0):
            self.live.emit(recording_picture(self._recorder.recording(axis.axis)))

    def _axis_of(self, status: ControlStatus) -> AxisStatus:
        # By number or letter: controls name their axes one way or the other.
        names = [each.casefold() for each in self._axis() if each]
        for axis in status.axes:
            if axis.axis.casefold() in names:
                return axis
        known = ", ".join(axis.axis for axis in status.axes) or "–"
        wanted = " ".join(filter(None, self._axis()))
        raise SimulationError(
            self.tr("The control shows no axis {axis}: {known}").format(axis=wanted, known=known)
        )

    def _in_units(self, axis: AxisStatus) -> dict[str, tuple[float | None, str]]:
        """Return what a reading has, in the units of the simulation where that has the signal too."""
        found = axis.signals()
        for signal, (value, unit) in axis.signals().items():
            wanted = self._trace.units.get(signal, "") if self._trace else ""
            if value is not None and wanted:
                found[signal] = value * unit_factor(axis.axis, signal, unit, wanted), wanted
        return found

    def _ended(self, error: object) -> None:
        """The control is no longer read: what there is, is kept."""
        if self._recorder is not None:
            self._finish()
            if isinstance(error, Exception):
                self._say(error)

    def _finish(self) -> None:
        """End a live record and keep it beside the file."""
        recorder, readings = self._recorder, self._readings
        # Before anything else: readings that are still on their way are not of this record any more.
        self._recorder = self._readings = None
        if readings is not None:
            readings.stop()
        # One reading is no record: it has no rate.
        if recorder is None or recorder.count < 2:
            self._show_state()
            return
        now = datetime.now().astimezone()
        letter = next(filter(None, reversed(self._axis())), "")
        path = self._path().with_name(f"{self._path().stem}-{letter}-{now:%Y%m%d-%H%M%S}.csv")
        # Kept in the window first: a disk that is full must not lose the record.
        self.recording = recorder.recording(path.name)
        self._show_state()
        try:
            write_recording(self.recording, path)
        except OSError as error:
            self._say(error)
        self.changed.emit()

    def end(self) -> None:
        """Keep what is being recorded: the file is closed."""
        if self._recorder is not None:
            self._finish()

    # -- what is shown -------------------------------------------------------------

    def show_trace(self, trace: Trace | None, error: str = "") -> None:
        """Follow the simulation that the record lies over; ``error`` is why it does not."""
        self._trace = trace
        if error:
            self._say(error)
        elif self._recorder is None:
            self._show_state()

    def alone(self) -> Picture | None:
        """Return the record without a simulation, from its trigger on; None where there is none."""
        if self.recording is None or self.is_recording:
            return None
        try:
            trigger = self.chosen_trigger()
            return recording_picture(*(self.recording.triggered(trigger) if trigger else (self.recording,)))
        except (ValueError, SimulationError) as error:
            self._say(error)
            return recording_picture(self.recording)

    def _say(self, error: object) -> None:
        self.record.setText(self.tr("&Record at the Control"))
        self.state.setText(sentenced(str(error)))
        self.state.setStyleSheet(f"color: {colour('error').name()}")

    def _show_state(self) -> None:
        """Show what is recorded, at which rate, and where it lies."""
        is_live = self._recorder is not None
        self.record.setText(self.tr("Stop &Recording") if is_live else self.tr("&Record at the Control"))
        self.open.setEnabled(not is_live)
        self.state.setStyleSheet("")
        self.state.setText(self._live_text() if is_live else self._record_text())

    def _live_text(self) -> str:
        recorder = self._recorder
        assert recorder is not None
        count, passed = recorder.count, time.monotonic() - self._began
        text = self.tr("%n readings", "", count)
        if count > 1:
            rate = written(f"{count / max(passed, 1e-3):.1f}") if recorder.has_fired else ""
            text += self.tr(", {rate} a second").format(rate=rate) if rate else ""
        if not recorder.has_fired and recorder.trigger is not None:
            text += self.tr("; waits for {trigger}").format(trigger=recorder.trigger)
        return text

    def _record_text(self) -> str:
        if self.recording is None:
            return self.tr("No record. Scales are those of the picture.")
        rows, signals = (
            len(self.recording.time),
            ", ".join(worded(each.replace("_", " ")) for each in self.recording.signals),
        )
        text = self.tr("{name}: {rows} rows, {rate} a second: {signals}.").format(
            name=self.recording.name, rows=rows, rate=written(f"{self.recording.rate:.4g}"), signals=signals
        )
        if self._trace is None:
            text += " " + self.tr("It is alone: nothing is simulated.")
        lag = self._trace.result.get("record_lag") if self._trace else None
        if lag is not None and lag[0] is not None:
            text += " " + self.tr("Shifted by {lag} s.").format(lag=written(f"{lag[0]:.4g}"))
            text += self._differences()
        return text

    def _differences(self) -> str:
        """Return the root mean square of each difference, with its unit."""
        assert self._trace is not None
        key, parts = "difference_rms_", []
        for name, (value, unit) in self._trace.result.items():
            if name.startswith(key) and value is not None:
                words = worded(name.removeprefix(key).replace("_", " "))
                parts.append(f"{words} {written(f'{value:.4g}')} {unit_in_words(unit)}")
        return (
            " " + self.tr("RMS of the difference: {parts}.").format(parts=", ".join(parts)) if parts else ""
        )


def _has_trigger(answers: object) -> bool:
    return bool(answers["signal"])  # type: ignore[index]  # a mapping, as the form gives it


def _seconds(text: str) -> float | None:
    """Return a time in s; None for an empty text. Raises ValueError."""
    if not text.strip():
        return None
    value = read_bare_number(text, "s")
    if value < 0.0:
        raise ValueError(worded("A time is a number of seconds, 0 or more"))
    return value
