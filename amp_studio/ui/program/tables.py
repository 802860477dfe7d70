"""Tables of a program that are read: rows without a grid, figures at the right, limits in the colours of the
path.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, QRect, QRectF, Qt
from PySide6.QtGui import QPainter
from PySide6.QtWidgets import (
    QHeaderView,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QTableView,
    QTableWidget,
    QTableWidgetItem,
)

from amp_studio.sim import limit_sort
from amp_studio.ui.base.scene_painter import TOKENS, paint_chip
from amp_studio.ui.base.theme import GAP2, colour

ROW = 26
"""Height in pixels of a row with one line."""
_CHIP, _BAR = 16, 4
"""Side of the square with a letter, and width of the bar at the left of a row."""


@dataclass(frozen=True)
class TableLook:
    """How the columns of a table are drawn."""

    wide: int = 0
    """The column that has the room that is left."""
    figures: Collection[int] = ()
    """Columns of figures, at the right."""
    chips: int | None = None
    """The column with the letter of a limit, drawn as a square in its colour."""
    bars: int | None = None
    """The column with the letter whose colour is at the left edge of the row."""


class LimitRowDelegate(QStyledItemDelegate):
    """Draws the cells of a table with its look."""

    def __init__(self, look: TableLook, table: QTableView) -> None:
        super().__init__(table)
        self._look = look

    def initStyleOption(
        self, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> None:
        super().initStyleOption(option, index)
        if index.column() in self._look.figures:
            option.displayAlignment = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        if index.column() == self._look.chips:
            option.text = ""

    def paint(
        self, painter: QPainter, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> None:
        look, place = self._look, QRect(option.rect)
        if index.column() == 0 and look.bars is not None:
            option.rect.adjust(_BAR, 0, 0, 0)
        super().paint(painter, option, index)
        if index.column() == look.chips and index.data():
            side = QRectF(place.left() + GAP2, place.center().y() - _CHIP // 2 + 1, _CHIP, _CHIP)
            paint_chip(painter, side, index.data(), colour(TOKENS[limit_sort(index.data())]))
        if index.column() == 0 and look.bars is not None:
            letter = index.siblingAtColumn(look.bars).data()
            if letter:
                painter.fillRect(
                    place.left(), place.top(), _BAR, place.height(), colour(TOKENS[limit_sort(letter)])
                )


def read_table(name: str, heads: Sequence[str], look: TableLook) -> QTableWidget:
    """Return a table that is read."""
    table = QTableWidget(0, len(heads))
    table.setAccessibleName(name)
    table.setHorizontalHeaderLabels(list(heads))
    table.setEditTriggers(QTableWidget.EditTrigger.NoEditTriggers)
    table.setSelectionBehavior(QTableWidget.SelectionBehavior.SelectRows)
    table.setShowGrid(False)
    table.setWordWrap(False)
    table.setItemDelegate(LimitRowDelegate(look, table))
    table.verticalHeader().hide()
    table.verticalHeader().setDefaultSectionSize(ROW)
    head = table.horizontalHeader()
    head.setHighlightSections(False)
    head.setDefaultAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
    head.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
    head.setSectionResizeMode(look.wide, QHeaderView.ResizeMode.Stretch)
    for column in look.figures:
        table.horizontalHeaderItem(column).setTextAlignment(
            Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        )
    return table


def fill(table: QTableWidget, rows: Sequence[Sequence[str]], *, add: bool = False) -> None:
    """Show rows of texts, or ``add`` them."""
    first = table.rowCount() if add else 0
    head = table.horizontalHeader()
    modes = [head.sectionResizeMode(column) for column in range(head.count())]
    # A column as wide as its texts would be measured again, over a thousand rows, with each text that is set.
    head.setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
    table.setRowCount(first + len(rows))
    for n, row in enumerate(rows, first):
        for column, text in enumerate(row):
            item = QTableWidgetItem(text)
            item.setToolTip(text)
            table.setItem(n, column, item)
        if any("\n" in text for text in row):
            table.resizeRowToContents(n)
    for column, mode in enumerate(modes):
        head.setSectionResizeMode(column, mode)
