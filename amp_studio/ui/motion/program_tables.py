"""Tables of a program that are read."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtWidgets import QHeaderView, QTableWidget, QTableWidgetItem


def read_table(name: str, heads: Sequence[str], wide: int = 0) -> QTableWidget:
    """Return a table that is read; the column ``wide`` has the room that is left."""
    table = QTableWidget(0, len(heads))
    table.setAccessibleName(name)
    table.setHorizontalHeaderLabels(list(heads))
    table.setEditTriggers(QTableWidget.EditTrigger.NoEditTriggers)
    table.setSelectionBehavior(QTableWidget.SelectionBehavior.SelectRows)
    table.verticalHeader().hide()
    table.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
    table.horizontalHeader().setSectionResizeMode(wide, QHeaderView.ResizeMode.Stretch)
    return table


def fill(table: QTableWidget, rows: Sequence[Sequence[str]], *, add: bool = False) -> None:
    """Show rows of texts, or ``add`` them."""
    first = table.rowCount() if add else 0
    table.setRowCount(first + len(rows))
    for n, row in enumerate(rows, first):
        for column, text in enumerate(row):
            item = QTableWidgetItem(text)
            item.setToolTip(text)
            table.setItem(n, column, item)
        if any("\n" in text for text in row):
            table.resizeRowToContents(n)
