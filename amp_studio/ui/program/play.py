"""Below a program's path: where its time goes, as a bar, and a moment of it that a person moves or plays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QElapsedTimer, QRectF, QSignalBlocker, QSize, Qt, QTimer, Signal
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QLabel, QPushButton, QSizePolicy, QSlider, QWidget

from amp_studio.drawing import ShapeSort
from amp_studio.sim import value_text
from amp_studio.ui.base.figures import written
from amp_studio.ui.base.layout import in_row
from amp_studio.ui.base.scene_painter import TOKENS
from amp_studio.ui.base.theme import GAP2, colour, font, scheme

STEPS = 10_000
"""Places of the slider."""
_EVERY_MS = 60
_HEIGHT = 22


@dataclass(frozen=True)
class TimePart:
    """A part of the bar."""

    letter: str
    name: str
    seconds: float
    sort: ShapeSort


class TimeBar(QWidget):
    """The time of a program by what limits it, the longest first."""

    def __init__(self) -> None:
        super().__init__()
        self.parts: Sequence[TimePart] = ()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setAccessibleName(self.tr("Where the time goes"))
        scheme().changed.connect(self.update)

    def sizeHint(self) -> QSize:
        return QSize(200, _HEIGHT)

    def show_parts(self, parts: Sequence[TimePart]) -> None:
        """Show other parts."""
        self.parts = parts
        words = "\n".join(
            f"{each.letter} {each.name}: {written(value_text(each.seconds, 's', 3))}" for each in parts
        )
        self.setToolTip(words)
        self.setAccessibleDescription(words)
        self.update()

    def paintEvent(self, _event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setFont(font("text"))
        whole = sum(each.seconds for each in self.parts)
        left = 0.0
        for part in self.parts:
            wide = self.width() * part.seconds / whole
            # Less a pixel, so that two parts of one colour are seen as two; but never less than one.
            box = QRectF(left, 0.0, max(wide - 1.0, 1.0), self.height())
            painter.fillRect(box, colour(TOKENS[part.sort]))
            painter.setPen(colour("base"))
            for text in (f"{part.letter} {written(value_text(part.seconds, 's', 2))}", part.letter):
                if painter.fontMetrics().horizontalAdvance(text) + 8 < wide:
                    painter.drawText(box, Qt.AlignmentFlag.AlignCenter, text)
                    break
            left += wide
        painter.end()


class PlayBar(QWidget):
    """A moment of a program: a slider, and a button that lets the time pass."""

    moved = Signal(float)
    """Seconds from the start."""

    def __init__(self) -> None:
        super().__init__()
        self._whole = 0.0
        self._exact: float | None = None
        """The moment that was gone to; None where the slider was moved since."""
        self._begun = 0.0
        self._clock, self._timer = QElapsedTimer(), QTimer(self)
        self._timer.setInterval(_EVERY_MS)
        self._timer.timeout.connect(self._pass)
        self.button = QPushButton(self.tr("&Play"))
        self.button.setEnabled(False)
        self.button.clicked.connect(self.toggle)
        self.slider = QSlider(Qt.Orientation.Horizontal)
        self.slider.setRange(0, STEPS)
        self.slider.setEnabled(False)
        self.slider.setAccessibleName(self.tr("Moment of the program"))
        self.slider.valueChanged.connect(self._follow_slider)
        self.time = QLabel()
        in_row(self.button, (self.slider, 1), self.time, on=self, margins=0, gap=GAP2)

    def show_program(self, seconds: float) -> None:
        """Begin at the start of a program that takes so many seconds."""
        self.pause()
        self._whole = seconds
        self.button.setEnabled(seconds > 0.0)
        self.slider.setEnabled(seconds > 0.0)
        self.slider.setValue(0)
        self._follow_slider(0)

    @property
    def moment(self) -> float:
        """Seconds from the start."""
        return self._whole * self.slider.value() / STEPS if self._exact is None else self._exact

    def go_to(self, seconds: float) -> None:
        """Show a moment: exactly, where the slider has a place for a ten thousandth."""
        if self._whole > 0.0:
            self.pause()
            self._exact = min(max(seconds, 0.0), self._whole)
            with QSignalBlocker(self.slider):
                self.slider.setValue(round(STEPS * self._exact / self._whole))
            self._show_time()

    def toggle(self) -> None:
        """Play, or pause."""
        if self._timer.isActive():
            self.pause()
            return
        if self.slider.value() == STEPS:
            self.slider.setValue(0)
        self._begun = self.moment
        self._clock.start()
        self._timer.start()
        self.button.setText(self.tr("&Pause"))

    def pause(self) -> None:
        """Stop where it is."""
        self._timer.stop()
        self.button.setText(self.tr("&Play"))

    def _pass(self) -> None:
        # By the clock, not by counting ticks: a slow picture must not slow the program down.
        now = self._begun + self._clock.elapsed() / 1000.0
        self.slider.setValue(min(round(STEPS * now / self._whole), STEPS))
        if now >= self._whole:
            self.pause()

    def _follow_slider(self, _place: int) -> None:
        self._exact = None
        self._show_time()

    def _show_time(self) -> None:
        self.time.setText(written(value_text(self.moment, "s", 3)))
        self.moved.emit(self.moment)
