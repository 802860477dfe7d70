"""A line of text that ends with … where there is no room for all of it; the tooltip has the whole."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QFontMetrics, QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QLabel

_MIN_WIDTH = 20


class ElidedLabel(QLabel):
    """A label of one line that never keeps its place wide."""

    cut = Qt.TextElideMode.ElideRight
    """Where it is cut: in the middle what is at its end is read too."""

    def minimumSizeHint(self) -> QSize:
        return QSize(_MIN_WIDTH, super().minimumSizeHint().height())

    def setText(self, text: str) -> None:
        """Show a text."""
        super().setText(text)
        self._show_tip()

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._show_tip()

    def _elided(self) -> str:
        measure = QFontMetrics(self.font())
        return measure.elidedText(self.text(), self.cut, self.contentsRect().width())

    def _show_tip(self) -> None:
        self.setToolTip("" if self._elided() == self.text() else self.text())

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setPen(self.palette().color(self.foregroundRole()))
        painter.drawText(self.contentsRect(), self.alignment(), self._elided())
