"""A value between its limits, as a bar: where it is, and how near to an end."""

from __future__ import annotations

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from amp_studio.ui.base.theme import colour

_HEIGHT, _TRACK, _THUMB = 18, 6, 4
"""px: of the bar, of its track, and how wide the mark of the value is."""
_BEYOND = 0.06
"""Share of the bar on each side for a value that is past its limit."""


class LimitBar(QWidget):
    """The value is a mark on the track, its limits are lines across it; past a limit the mark is red."""

    def __init__(self, name: str) -> None:
        super().__init__()
        self._value, self._low, self._high = 0.0, 0.0, 1.0
        self.setAccessibleName(name)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    def show_value(self, value: float, low: float, high: float) -> None:
        """Show a value between two limits, ``low`` below ``high``."""
        self._value, self._low, self._high = value, low, high
        self.update()

    @property
    def share(self) -> float:
        """Where the value is between its limits, 0 to 1; beyond them less or more."""
        return (self._value - self._low) / (self._high - self._low)

    def sizeHint(self) -> QSize:
        return QSize(200, _HEIGHT)

    def paintEvent(self, event: QPaintEvent) -> None:  # Qt's name
        painter, width, middle = QPainter(self), float(self.width()), 0.5 * self.height()
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(colour("line"))
        painter.drawRect(QRectF(0.0, middle - 0.5 * _TRACK, width, float(_TRACK)))
        inside = width * (1.0 - 2.0 * _BEYOND)
        painter.setBrush(colour("error"))
        for place in (_BEYOND * width, (1.0 - _BEYOND) * width):
            painter.drawRect(QRectF(place - 0.5, 2.0, 1.0, self.height() - 4.0))
        share = min(max(self.share, -_BEYOND), 1.0 + _BEYOND)
        painter.setBrush(colour("text" if 0.0 <= self.share <= 1.0 else "error"))
        place = _BEYOND * width + share * inside
        painter.drawRect(QRectF(place - 0.5 * _THUMB, 2.0, float(_THUMB), self.height() - 4.0))
        painter.end()
