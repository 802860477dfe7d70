"""The simulated answer of an axis to a step, with the values that are tuned and with those from before."""

from __future__ import annotations

from dataclasses import replace

from PySide6.QtCore import QSignalBlocker, Qt
from PySide6.QtWidgets import QComboBox, QLabel, QPushButton, QWidget

from amp_studio.drawing import linked
from amp_studio.schema import axis_name
from amp_studio.sim import SimulationError, Trace, picture_of, simulate, simulated_axes
from amp_studio.ui.base.figures import written
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.places import sentenced_with_letters
from amp_studio.ui.base.plot import Plot
from amp_studio.ui.base.single_shot import single_shot
from amp_studio.ui.base.theme import GAP
from amp_studio.ui.base.translated import sentenced, unit_in_words

from .latest_work import LatestWork
from .tuning_target import TuningTarget

_SHOWN = slice(1, 3)
"""Of the panels of a step those below the position: following error and velocity.
Each takes its time to draw."""
_SETTLE_MS = 150
"""Milliseconds without a further change before it is simulated again."""


class StepAnswer(QWidget):
    """A step of one axis; the first answer stays under the present one."""

    def __init__(self) -> None:
        super().__init__()
        self._target: TuningTarget | None = None
        self._latest = LatestWork()
        self.trace: Trace | None = None
        self.before: Trace | None = None
        self.axis, self.plot, self.text = QComboBox(), Plot(), QLabel()
        self.axis.setAccessibleName(self.tr("Simulated axis"))
        self.plot.setAccessibleName(self.tr("Simulated answer to a step"))
        self.text.setWordWrap(True)
        self.text.setContentsMargins(0, GAP, 0, GAP)  # else the plot lies over the dots of an Ü
        self.text.setTextFormat(Qt.TextFormat.PlainText)
        self.keep = QPushButton(self.tr("&Keep as Before"))
        self.keep.clicked.connect(self._keep)
        label = QLabel(self.tr("Simulated ste&p of axis"))
        label.setBuddy(self.axis)
        in_column(in_row(label, self.axis, self.keep, 0), (self.plot, 1), self.text, on=self, margins=0)
        self._timer = single_shot(self, self.run, _SETTLE_MS)
        self._latest.done.connect(self._receive)
        self.axis.currentIndexChanged.connect(lambda *_: self._start_over())

    def show_target(self, target: TuningTarget) -> None:
        """Simulate a file, or what a control contains."""
        if self._target is not None:
            self._target.changed.disconnect(self._changed)
        self._target = target
        target.changed.connect(self._changed)
        file = target.file
        with QSignalBlocker(self.axis):
            self.axis.clear()
            for axis in simulated_axes(file):
                letter = axis_name(file.evaluation, axis)
                self.axis.addItem(f"{axis} {letter}" if letter and letter != axis else axis, axis)
        self._start_over()

    def choose(self, axis: str) -> None:
        """Simulate another axis, where it can be."""
        at = self.axis.findData(axis)
        if at >= 0:
            self.axis.setCurrentIndex(at)

    def _changed(self, *_: object) -> None:
        self._timer.start()

    def _start_over(self) -> None:
        self.before = None
        self.run()

    def _keep(self) -> None:
        self.before = self.trace
        self._draw()

    def run(self) -> None:
        """Simulate in the background; of what changes meanwhile the newest values are shown."""
        if self._target is None or not self.isVisible():
            return
        file, axis = self._target.simulated(), self.axis.currentData()
        if axis is None:
            self.text.setText(self.tr("No axis of this file can be simulated."))
            return
        self._latest.ask(lambda: simulate(file, "step", axis, {}, file.header.units))

    def showEvent(self, event: object) -> None:
        """Simulate once it is seen."""
        super().showEvent(event)  # type: ignore[arg-type]  # Qt gives the event of this kind
        self._timer.start()

    def _receive(self, trace: Trace | SimulationError) -> None:
        if isinstance(trace, SimulationError):
            self._failed(trace)
            return
        # In other units the old curve would lie wrong in the picture.
        if self.before is None or self.before.units != trace.units:
            self.before = trace
        self.trace = trace
        self._draw()

    def _draw(self) -> None:
        if self.trace is None:
            return
        picture = picture_of(self.trace, self.before if self.before is not self.trace else None)
        self.plot.draw(replace(picture, panels=linked(picture.panels[_SHOWN])))
        self.text.setText(self._figures())

    def _figures(self) -> str:
        """Return the figures of the step, with those from before where they differ."""
        assert self.trace is not None
        names = {
            "overshoot": self.tr("Overshoot"),
            "settle_time": self.tr("Settling time"),
            "peak_following_error": self.tr("Peak following error"),
        }
        parts = []
        for key, name in names.items():
            now, unit = self.trace.result.get(key, (None, ""))
            old = self.before.result.get(key, (None, ""))[0] if self.before is not None else None
            if now is None:
                continue
            text = f"{name} {written(f'{now:.4g}')} {unit_in_words(unit)}"
            if old is not None and f"{old:.4g}" != f"{now:.4g}":
                text += self.tr(" (before {value})").format(value=written(f"{old:.4g}"))
            parts.append(text)
        return "; ".join(parts)

    def _failed(self, error: Exception) -> None:
        self.plot.clear_picture()
        self.trace = None
        file = self._target.file if self._target else None
        self.text.setText(sentenced_with_letters(file, str(error)) if file else sentenced(str(error)))
