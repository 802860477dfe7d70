"""A value in its range, painted: the printed range, the part that rules allow,
the default and the value itself.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QFontMetrics, QPainter, QPaintEvent, QPolygonF
from PySide6.QtWidgets import QSizePolicy, QWidget

from amp_studio.schema import write_number
from amp_studio.ui.base.figures import written
from amp_studio.ui.base.theme import GAP, RADIUS, Token, colour, font
from amp_studio.ui.base.translated import unit_in_words

_BAR, _TOP, _SIDE = 8, 22, 12


@dataclass(frozen=True)
class ValueInRange:
    """Numbers of one value in one unit."""

    low: float
    high: float
    unit: str
    value: float | None
    default: float | None
    severity: str = ""
    """The worst finding about the value; empty for none."""


class RangeBar(QWidget):
    """Everything that it paints is also its accessible description."""

    def __init__(self) -> None:
        super().__init__()
        self.setAccessibleName(self.tr("Range"))
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self._range: ValueInRange | None = None
        self._allowed: tuple[float, float] | None = None
        self.words = ""
        """What the rules allow, in words; empty where it is the whole range or not known."""
        self._short = ""
        """The same in a small room."""

    def sizeHint(self) -> QSize:
        """Return the height of the bar with a line of text above and below."""
        return QSize(200, _TOP + _BAR + GAP + QFontMetrics(font("caption")).height() + GAP)

    def show_range(self, found: ValueInRange | None) -> None:
        """Show a value in its range; None hides the bar. What the rules allow is not known yet."""
        self._range, self._allowed, self.words, self._short = found, None, "", ""
        self.setVisible(found is not None)
        self._describe()

    def show_allowed(self, allowed: tuple[float, float] | None) -> None:
        """Show the part of the range that the rules allow."""
        found = self._range
        if found is None:
            return
        self._allowed, self.words, self._short = allowed, "", ""
        if allowed is not None:
            # Less than a pixel of the bar: no limit that a person should be shown.
            least = (found.high - found.low) * 2e-3
            low, high = allowed[0] - found.low > least, found.high - allowed[1] > least
            texts = [written(write_number(_inwards(allowed[n], 1 - 2 * n))) for n in (0, 1)]
            if low and high:
                both = self.tr("rules allow {low} to {high}"), "{low}–{high}"
            elif low:
                both = self.tr("rules allow from {low}"), "≥ {low}"
            else:
                both = (self.tr("rules allow up to {high}"), "≤ {high}") if high else ("", "")
            self.words, self._short = (text.format(low=texts[0], high=texts[1]) for text in both)
        self._describe()

    def _describe(self) -> None:
        found = self._range
        if found is not None:
            ends = self.tr("{low} to {high} {unit}").format(
                low=written(write_number(found.low)),
                high=written(write_number(found.high)),
                unit=unit_in_words(found.unit),
            )
            self.setAccessibleDescription(", ".join(filter(None, (ends, self.words))))
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        found = self._range
        if found is None:
            return
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(Qt.PenStyle.NoPen)
        whole = QRectF(_SIDE, _TOP, self.width() - 2 * _SIDE, _BAR)
        painter.setBrush(colour("line"))
        painter.drawRoundedRect(whole, RADIUS, RADIUS)
        if self._allowed is not None:
            left, right = (self._at(x, whole) for x in self._allowed)
            painter.setBrush(colour("edge"))
            painter.drawRect(QRectF(left, _TOP, max(2.0, right - left), _BAR))
        letters = font("caption")
        painter.setFont(letters)
        metrics = QFontMetrics(letters)
        below = int(_TOP + _BAR + GAP)
        ends = (
            written(write_number(found.low)),
            f"{written(write_number(found.high))} {unit_in_words(found.unit)}".rstrip(),
        )
        painter.setPen(colour("dim"))
        painter.drawText(QPointF(_SIDE, below + metrics.ascent()), ends[0])
        right_at = self.width() - _SIDE - metrics.horizontalAdvance(ends[1])
        painter.drawText(QPointF(right_at, below + metrics.ascent()), ends[1])
        if self.words:
            start = _SIDE + metrics.horizontalAdvance(ends[0]) + 2 * GAP
            fitting = (
                text
                for text in (self.words, self._short)
                if metrics.horizontalAdvance(text) <= right_at - start - 2 * GAP
            )
            painter.drawText(QPointF(start, below + metrics.ascent()), next(fitting, ""))  # no digit is cut
        self._paint_default(painter, whole, metrics, self._paint_value(painter, whole, metrics))
        painter.end()

    def _paint_default(self, painter: QPainter, whole: QRectF, metrics: QFontMetrics, value: QRectF) -> None:
        """Paint the default; its text where it has room beside that of the ``value``."""
        found = self._range
        if found is None or found.default is None:
            return
        x = self._at(found.default, whole)
        painter.fillRect(QRectF(x - 1, _TOP - 4, 2, _BAR + 8), colour("text"))
        text = self.tr("default {value}").format(value=written(write_number(found.default)))
        place = self._above(x, text, metrics, right=True)
        if not place.intersects(value):
            painter.setPen(colour("dim"))
            painter.drawText(place.bottomLeft(), text)

    def _paint_value(self, painter: QPainter, whole: QRectF, metrics: QFontMetrics) -> QRectF:
        """Paint the value, and return where its text is, with what has to be clear beside it."""
        found = self._range
        if found is None or found.value is None:
            return QRectF()
        tokens: dict[str, Token] = {"error": "error", "warning": "warn", "advice": "rec"}
        colour_name = tokens.get(found.severity, "sel")
        x = self._at(found.value, whole)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(colour(colour_name))
        painter.drawPolygon(QPolygonF([QPointF(x - 5, _TOP - 7), QPointF(x + 5, _TOP - 7), QPointF(x, _TOP)]))
        painter.drawRect(QRectF(x - 0.5, _TOP, 1, _BAR))
        # Both at one place would be written over each other.
        if found.value == found.default:
            return QRectF()
        text = written(write_number(found.value))
        place = self._above(x + 9, text, metrics, right=False)
        painter.setPen(colour(colour_name))
        painter.drawText(place.bottomLeft(), text)
        return place.adjusted(-2 * GAP, 0, 2 * GAP, 0)

    def _above(self, x: float, text: str, metrics: QFontMetrics, *, right: bool) -> QRectF:
        """Return where a text above the bar is, at the side of ``x`` where there is room;
        the lower edge is the base of its letters.
        """
        width = metrics.horizontalAdvance(text)
        left = x - width if right else x
        left = min(max(left, float(_SIDE)), self.width() - _SIDE - width)
        height = metrics.ascent()
        return QRectF(left, _TOP - 8 - height, width, height)

    def _at(self, number: float, whole: QRectF) -> float:
        """Return where a number is; one outside of the range is at its end."""
        found = self._range
        assert found is not None
        share = (number - found.low) / (found.high - found.low)
        return whole.left() + whole.width() * min(max(share, 0.0), 1.0)


def _inwards(end: float, towards: int) -> float:
    """Return an end with five digits, rounded into what is allowed: up for 1, down for -1."""
    rounded = float(f"{end:.5g}")
    if (rounded - end) * towards >= 0 or end == 0:
        return rounded
    # One more in the fifth digit: a shown limit that is itself not allowed would be worse than a coarse
    # one.
    return rounded + towards * 10.0 ** (math.floor(math.log10(abs(end))) - 4)
