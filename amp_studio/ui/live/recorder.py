"""The recorder of Live: readings of an axis as dots, from a trigger on, and under them the simulation of the
same move with the values that the control contains.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QComboBox,
    QLabel,
    QLineEdit,
    QMenu,
    QPushButton,
    QSizePolicy,
    QToolButton,
    QWidget,
)

from amp_studio.drawing import Picture, picture_svg
from amp_studio.files import ParameterFile, write_atomic
from amp_studio.schema import read_bare_number
from amp_studio.sim import LiveRecorder, SignalRecord, SimulationError, Trace, read_recording, write_recording
from amp_studio.ui.base.ask_path import ask_to_open, ask_to_save
from amp_studio.ui.base.figures import written
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.plot import Plot
from amp_studio.ui.base.task import Task
from amp_studio.ui.base.theme import GAP2, GAP3, HEAD, colour, font, icon, scheme
from amp_studio.ui.base.translated import sentenced, unit_in_words, worded
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.control.readings import AxisReadings
from amp_studio.ui.control.rows import side_by_side
from amp_studio.ui.forms.channel_scales import ChannelScales
from amp_studio.ui.forms.icon_button import icon_button
from amp_studio.ui.motion.run import AskedMotion, SimulatedMotion, run_motion

from .record_picture import SIGNALS, move_of, record_picture, signals_of

if TYPE_CHECKING:
    from amp_studio.transfer import AxisStatus

_AFTER_FAULT = 0.5
"""s that are recorded after a fault: what led to it is kept."""
_DRAWN_EVERY = 2
"""Readings from one picture to the next while nothing is recorded: to paint one costs more than to read."""
_FIELD, _TABLE = 52, 300
_MIN_PLOT = 80


class LiveRecording(QWidget):
    """What is drawn below the rows: the last half minute, a record that is made, or one that is there."""

    def __init__(self, workspace: Workspace, present: Callable[[], ParameterFile | None]) -> None:
        """``present`` gives what the control contains, with which a recorded move is simulated; None for not
        known: then it is the file.
        """
        super().__init__()
        self._workspace, self._present = workspace, present
        self._family = workspace.file.schema.family.family
        self._axis = ""
        self._recent = AxisReadings()
        self._last: AxisStatus | None = None
        self._count = 0
        self._recorder: LiveRecorder | None = None
        self._ends_at: float | None = None
        self.record: SignalRecord | None = None
        self._fired: float | None = None
        self.trace: Trace | None = None
        self._task: Task | None = None
        self._remark = self._problem = ""
        self._whole: Picture | None = None
        """What is there to draw, with all signals."""
        self._missing: tuple[str, ...] = ()
        self._reasons: Mapping[str, str] = {}
        self._build()
        scheme().changed.connect(self._show_footer)
        workspace.closed.connect(self._abandon_run)

    def _build(self) -> None:
        title = QLabel(self.tr("Recorder"))
        title.setFont(font("text", own=True))
        self.state = QLabel()
        self.state.setFont(font("small"))
        self.state.setAccessibleName(self.tr("State of the recorder"))
        self.state.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self.trigger = QComboBox()
        self.trigger.setAccessibleName(self.tr("Trigger"))
        self.trigger.setToolTip(self.tr("What the record begins with"))
        for key, words in (
            ("", self.tr("by hand")),
            ("move", self.tr("the axis moves")),
            ("error", self.tr("error above")),
            ("fault", self.tr("fault")),
        ):
            self.trigger.addItem(words, key)
        self.level, self.before = QLineEdit(), QLineEdit("0.5")
        self.level.setAccessibleName(self.tr("Level of the trigger"))
        self.before.setAccessibleName(self.tr("Seconds that are kept ahead of the trigger"))
        self.before_label = QLabel(self.tr("before (s)"))
        for field in (self.level, self.before):
            field.setFixedWidth(_FIELD)
        self.open = icon_button("folder-open", self.tr("Lay a record from a file over (CSV)"), is_flat=True)
        self.export = icon_button("export", self.tr("Export the record: CSV or SVG"), is_flat=True)
        self.export.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        menu = QMenu(self.export)
        self.to_csv = menu.addAction(self.tr("Record as &CSV…"), partial(self._save, "csv"))
        self.to_svg = menu.addAction(self.tr("Picture as &SVG…"), partial(self._save, "svg"))
        self.export.setMenu(menu)
        self.channels = ChannelScales(is_divided=True, unticked=_beside_two)
        self.channels.setFixedWidth(_TABLE)
        self.channels.hide()
        self.scales = icon_button(
            "sliders-horizontal", self.tr("Signals, scale and middle of each"), is_flat=True
        )
        self.scales.setCheckable(True)
        self.toggle = QPushButton()
        self.toggle.setToolTip(self.tr("Space starts and stops the record"))
        self.plot = Plot()
        self.plot.setAccessibleName(self.tr("Readings over time, a dot for each"))
        self.plot.setMinimumHeight(_MIN_PLOT)
        self.footer = QLabel()
        self.footer.setFont(font("small"))
        self.footer.setWordWrap(True)
        self.footer.setTextFormat(Qt.TextFormat.PlainText)
        self.footer.setContentsMargins(GAP3, 0, GAP3, GAP2)
        self.footer.setAccessibleName(self.tr("Figures of the record"))
        head = side_by_side(
            HEAD,
            title,
            self.state,
            self.trigger,
            self.level,
            self.before_label,
            self.before,
            self.scales,
            self.open,
            self.export,
            self.toggle,
        )
        row = head.layout()
        assert row is not None
        row.setStretch(1, 1)  # type: ignore[attr-defined]  # a row of boxes
        in_column(head, (in_row((self.plot, 1), self.channels), 1), self.footer, on=self, margins=0, gap=0)
        self.toggle.clicked.connect(self.start_or_stop)
        self.scales.toggled.connect(self.channels.setVisible)
        self.channels.rescaled.connect(self._redraw)
        self.open.clicked.connect(self._ask)
        self.trigger.currentIndexChanged.connect(lambda _: self._show_state())
        self.plot.read.connect(lambda _: self._show_footer())
        self._show_state()

    # -- readings ----------------------------------------------------------------

    @property
    def is_recording(self) -> bool:
        """Whether readings are being kept."""
        return self._recorder is not None

    def show_axis(self, axis: str) -> None:
        """Draw another axis: a record is of one alone."""
        if axis != self._axis:
            self.stop()
            self._axis, self._recent, self._last = axis, AxisReadings(), None
            self._forget()
            self._whole = None
            self.plot.clear_picture()
            self._show_state()

    def take(
        self,
        seconds: float,
        axis: AxisStatus,
        *,
        is_fault: bool = False,
        reasons: Mapping[str, str] | None = None,
    ) -> None:
        """Take a reading at a time in s, with why signals are not in it; a new fault ends a record half a
        second later.
        """
        self._reasons = reasons or {}
        self._recent.add(seconds, axis)
        last, self._last = self._last, axis
        figures = axis.signals()
        self._missing = tuple(name for name in ("following_error", "velocity") if figures[name][0] is None)
        if self._recorder is None:
            self._show_recent(is_first=last is None)
            return
        self._recorder.add(seconds, figures)
        if not self._recorder.has_fired and self._fires(last, axis, is_fault):
            self._recorder.fire(seconds)
        # The stop of the axis after a fault belongs to the record, which then ends by itself.
        if is_fault and self._recorder.has_fired and self._ends_at is None:
            self._ends_at = seconds + _AFTER_FAULT
        if self._recorder.is_done or (self._ends_at is not None and seconds >= self._ends_at):
            self.stop()
        elif self._recorder.count > 1:
            self._show(record_picture(self._recorder.recording(axis.axis), self._recorder.fired_after))
            self._show_state()

    def _show_recent(self, *, is_first: bool) -> None:
        """Show the last readings while no record is made or kept; not each one, which would only paint."""
        self._count += 1
        is_due = self._count % _DRAWN_EVERY == 0 or is_first
        if self.record is None and is_due and (picture := self._recent.picture()):
            self._show(picture)
            self._show_footer()

    def _fires(self, last: AxisStatus | None, axis: AxisStatus, is_fault: bool) -> bool:
        match self.trigger.currentData():
            case "move":
                # Of a control that reports no speed the position alone shows that it moves.
                moved = last is not None and axis.position is not None and axis.position != last.position
                return bool(axis.velocity) or moved
            case "error":
                return axis.following_error is not None and abs(axis.following_error) > self._level()
            case "fault":
                return is_fault
        return False

    def _level(self) -> float:
        return read_bare_number(self.level.text().strip() or "0")

    # -- a record ----------------------------------------------------------------

    def start_or_stop(self) -> None:
        """Begin a record, or end the one that is made."""
        if self._recorder is not None:
            self.stop()
            return
        try:
            self._level()
            # Read before the record begins: a typing error in a field must not cost the move.
            before = read_bare_number(self.before.text().strip() or "0", "s")
        except ValueError as error:
            self._problem = sentenced(str(error))
            self._show_footer()
            return
        self._forget()
        waits = bool(self.trigger.currentData())
        self._recorder = LiveRecorder(by_event=waits, before=max(before, 0.0) if waits else 0.0)
        self._ends_at = None
        self._show_state()

    def stop(self) -> None:
        """End a record that is made and keep it; one reading is none."""
        recorder, self._recorder = self._recorder, None
        # A record that only waited for its trigger has nothing of the move.
        if recorder is not None and recorder.count > 1 and recorder.has_fired:
            self.record, self._fired = recorder.recording(self._axis), recorder.fired_after
            self._begin_with_record()
        self._show_state()

    def _begin_with_record(self) -> None:
        self._simulate()
        self._draw()
        self.plot.zoom(None)  # both cursors on it

    def _forget(self) -> None:
        self.record = self.trace = self._fired = None
        self._remark = self._problem = ""

    def _ask(self) -> None:
        """Lay a record of the machine from a table over in the same way."""
        kinds = self.tr("Records (*.csv *.txt);;All files (*)")
        path = ask_to_open(self, self.tr("Record of the Machine"), self._workspace.path.parent, kinds)
        if path is None:
            return
        self.stop()
        self._forget()
        try:
            self.record = read_recording(path)
        except (OSError, SimulationError) as error:
            self._problem = sentenced(str(error))
        else:
            self._begin_with_record()
        self._show_state()

    # -- the simulation of it ------------------------------------------------------

    def _simulate(self) -> None:
        """Simulate the move that the record shows, in a thread."""
        assert self.record is not None
        present, record = self._present(), self.record
        # With what the control contains if it is known: with that the machine has moved, not with the file.
        file = (present or self._workspace.file).copy()
        try:
            zeroed, settings, words = move_of(file, record)
        except SimulationError as error:
            self._remark = sentenced(str(error))
            return
        whose = (
            self.tr("with the values of the control") if present else self.tr("with the values of the file")
        )
        self._remark = f"{words}, {whose}"
        asked = AskedMotion("step", self._instance(file), settings, file, None, None, zeroed)
        # Of two runs the later one counts.
        self._abandon_run()
        self._task = Task(partial(run_motion, asked))
        self._task.done.connect(self._simulated)
        self._task.failed.connect(self._not_simulated)
        self._task.begin()

    def _instance(self, file: ParameterFile) -> str | None:
        from amp_studio.files import axis_instances, axis_letter

        found = (each for each in axis_instances(file) if self._axis in (each, axis_letter(file, each)))
        return next(found, None)

    def _simulated(self, ran: SimulatedMotion) -> None:
        self._task = None
        if ran.record_error or self.record is None:
            self._remark = sentenced(ran.record_error, self._family)
        else:
            self.trace = ran.trace
        self._draw()
        self._show_state()

    def _not_simulated(self, error: Exception) -> None:
        self._task = None
        self._remark = self.tr("Not simulated: {why}").format(why=sentenced(str(error), self._family))
        self._show_footer()

    def _abandon_run(self) -> None:
        """Ignore the result of a run that has not finished."""
        if self._task is not None:
            self._task.done.disconnect(self._simulated)
            self._task.failed.disconnect(self._not_simulated)
            self._task = None

    # -- what is shown -------------------------------------------------------------

    def _draw(self) -> None:
        if self.record is not None:
            self._show(record_picture(self.record, self._fired, self.trace))
        self._show_footer()

    def _show(self, picture: Picture) -> None:
        """Draw a picture with the signals that are ticked, on their scales."""
        self._whole = picture
        self.plot.draw(self.channels.scaled(picture))

    def _redraw(self) -> None:
        if self._whole is not None:
            self._show(self._whole)
            self._show_footer()

    def _show_state(self) -> None:
        recorder, key = self._recorder, self.trigger.currentData()
        self.toggle.setText(self.tr("St&op") if recorder is not None else self.tr("&Record"))
        self.toggle.setIcon(icon("stop" if recorder is not None else "record"))
        self.level.setVisible(key == "error")
        for part in (self.before_label, self.before):
            part.setVisible(bool(key))
        for each in (self.trigger, self.level, self.before, self.open):
            each.setEnabled(recorder is None)
        self.export.setEnabled(recorder is None and self.record is not None)
        text = ""
        if recorder is not None and not recorder.has_fired:
            text = self.tr("waits: {trigger}").format(
                trigger=f"{self.trigger.currentText()} {self.level.text() if key == 'error' else ''}".strip()
            )
        elif recorder is not None:
            text = self.tr("%n readings", "", recorder.count)
        elif self.record is not None:
            text = self.tr("○ machine   — simulated") if self.trace else self.tr("○ machine")
        self.state.setText(text)
        self.state.setToolTip(text)
        self._show_footer()

    def _show_footer(self) -> None:
        parts = [self._problem] if self._problem else []
        if self.record is not None:
            parts += self._figures(self.record)
            parts.append(self._remark)
        parts += map(self._why_missing, self._missing)
        parts.append(self.tr("dots are readings, nothing is known between them"))
        sheet = f"color: {colour('error' if self._problem else 'dim').name()};"
        if self.footer.styleSheet() != sheet:  # Qt styles and paints again for the same one too
            self.footer.setStyleSheet(sheet)
        self.footer.setText(" · ".join(filter(None, parts)))

    def _why_missing(self, signal: str) -> str:
        """Return that a signal is not drawn, with the reason where the control has one."""
        name, why = worded(signal.replace("_", " ")).capitalize(), self._reasons.get(signal, "")
        if why:
            return self.tr("{signal}: not shown by this control: {why}").format(
                signal=name, why=sentenced(why, self._family)
            )
        return self.tr("{signal}: not shown by this control, so nothing is drawn").format(signal=name)

    def _figures(self, record: SignalRecord) -> list[str]:
        """Return what the cursors read, and how far the simulation is away."""
        a, b = self.plot.cursors
        parts = [self.tr("A to B {time} s").format(time=written(f"{abs(b - a):.3f}"))]
        for signal in signals_of(record):
            values, unit = record.signals[signal], unit_in_words(record.units.get(signal, ""))
            # The nearest reading, not one between two: nothing is known there.
            one, two = (float(values[int(np.argmin(np.abs(record.time - at)))]) for at in (a, b))
            words = worded(signal.replace("_", " "))
            parts.append(f"{words} {written(f'{one:.5g}')} → {written(f'{two:.5g}')} {unit}")
        if self.trace is None:
            return parts
        for signal in signals_of(record):
            value, unit = self.trace.result.get(f"difference_rms_{signal}", (None, ""))
            if value is not None:
                parts.append(
                    self.tr("RMS machine − simulated {value}").format(
                        value=f"{written(f'{value:.4g}')} {unit_in_words(unit)}"
                    )
                )
                break
        lag = self.trace.result["record_lag"][0]
        if lag is not None:
            parts.append(self.tr("shifted by {lag} s to fit").format(lag=written(f"{lag:.3f}")))
        return parts

    # -- files -----------------------------------------------------------------------

    def _save(self, ending: str) -> None:
        """Write the record as a table, or its picture."""
        record, path = self.record, self._workspace.path
        if record is None or self.plot.picture is None:
            return
        near = path.with_name(f"{path.stem}-{self._axis}.{ending}")
        kind = {"csv": "CSV (*.csv)", "svg": "SVG (*.svg)"}[ending]
        target = ask_to_save(self, self.tr("Export"), near, kind)
        if target is None:
            return
        try:
            if ending == "csv":
                write_recording(record, target)
            else:
                named = replace(self.plot.picture, title=f"{self._workspace.path.stem} {self._axis}")
                write_atomic(target, picture_svg(named).encode())
        except OSError as error:
            self._problem = sentenced(str(error))
        self._show_footer()


def _beside_two(titles: Collection[str]) -> Collection[str]:
    """Return the signal that is not drawn at first: beside error and speed there is little room."""
    error, position, speed = (each.replace("_", " ") for each in SIGNALS)
    return (position,) if {error, speed} <= set(titles) else ()
