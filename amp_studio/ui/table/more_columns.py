"""The strip at the right of a table that is too narrow for its columns: it covers the one that would be cut,
and names the next.
"""

from __future__ import annotations

from PySide6.QtCore import QRect, Qt
from PySide6.QtGui import QMouseEvent, QPainter, QPaintEvent
from PySide6.QtWidgets import QTableView, QWidget

from amp_studio.ui.base.theme import SMALL_ICON, colour, font, paint_icon

from .parameter_table import ParameterTable

STRIP = 26
"""Least width in pixels."""


class MoreColumns(QWidget):
    """A click shows the next column. Keys go there by themselves."""

    def __init__(self, view: QTableView, table: ParameterTable) -> None:
        super().__init__(view)
        self._view, self._table = view, table
        self._next = 0
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        view.horizontalScrollBar().valueChanged.connect(self.place)
        self.hide()

    def place(self, *_: object) -> None:
        """Cover what is not a whole column, and leave where all columns are seen."""
        heads, room = self._view.horizontalHeader(), self._view.viewport().width()
        count = heads.count()
        end = heads.sectionViewportPosition(count - 1) + heads.sectionSize(count - 1) if count else 0
        if end <= room or heads.offset() + room >= heads.length():
            self.hide()
            return
        whole, self._next = 0, 0
        for column in range(count):
            after = heads.sectionViewportPosition(column) + heads.sectionSize(column)
            if after > room - STRIP and heads.sectionViewportPosition(column) > 0:
                self._next = column
                break
            whole = after
        left = self._view.verticalHeader().width() + whole
        self.setGeometry(
            left,
            0,
            self._view.verticalHeader().width() + room - left,
            heads.height() + self._view.viewport().height(),
        )
        name = " ".join(filter(None, self._table.column_head(self._next)))
        self.setToolTip(self.tr("Show {column}").format(column=name))
        self.setAccessibleName(self.toolTip())
        self.show()
        self.raise_()

    def uncover(self, column: int) -> None:
        """Scroll a column out from under the strip."""
        bar = self._view.horizontalScrollBar()
        # Step by step: after each the strip has moved, and with it what it covers.
        while self.isVisible() and column >= self._next and bar.value() < bar.maximum():
            bar.setValue(bar.value() + 1)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        bar = self._view.horizontalScrollBar()
        bar.setValue(bar.value() + 1)

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.fillRect(self.rect(), colour("panel"))
        painter.fillRect(0, 0, 1, self.height(), colour("line2"))
        letter, rest = self._table.column_head(self._next)
        letters = font("text")
        letters.setWeight(letters.Weight.DemiBold)
        painter.setFont(letters)
        painter.setPen(colour("text"))
        head = self._view.horizontalHeader().height()
        strip = QRect(max(0, self.width() - STRIP), 0, min(STRIP, self.width()), head)
        painter.drawText(strip, Qt.AlignmentFlag.AlignCenter, letter or rest[:1])
        middle = strip.translated(0, head).center()
        paint_icon(
            painter,
            QRect(middle.x() - SMALL_ICON // 2, head + 4, SMALL_ICON, SMALL_ICON),
            "caret-right",
            colour("dim"),
        )
