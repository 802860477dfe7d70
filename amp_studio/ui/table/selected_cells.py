"""The selected cells of a table as blocks of addresses: the range, what it is pasted over,
what it is filled from.
"""

from __future__ import annotations

from PySide6.QtCore import QModelIndex
from PySide6.QtWidgets import QTableView

from amp_studio.schema import Address

from .parameter_table import ParameterTable


class SelectedCells:
    """The selection of a view of the parameter table. Heads of sections are in no block,
    and what does not exist is None.
    """

    def __init__(self, view: QTableView, table: ParameterTable) -> None:
        self._view, self._table = view, table

    def addresses(self) -> list[Address]:
        """Return the addresses of the selected cells, row by row; those that do not exist are left out."""
        return [address for row in self.block() for address in row if address is not None]

    @property
    def is_block(self) -> bool:
        """Whether the selected cells are one block without gaps; cells that Ctrl+click added may be
        anywhere.
        """
        # Qt has a range for each Ctrl+click.
        return self._view.selectionModel().selection().count() < 2

    def block(self) -> list[list[Address | None]]:
        """Return the selected cells as rows; None where a cell does not exist, without the heads of
        sections.
        """
        ends = self.ends()
        if ends is None:
            return []
        first, last = ends
        rows = range(first.row(), last.row() + 1)
        columns = range(first.column(), min(last.column(), len(self._table.columns) - 1) + 1)
        here = self._view.selectionModel().isSelected
        is_block, index = self.is_block, self._table.index
        return [
            [self.existing(r, c) if is_block or here(index(r, c)) else None for c in columns]
            for r in rows
            if not self._table.rows[r].section
        ]

    def block_from(self, rows: int, columns: int) -> list[list[Address | None]]:
        """Return a block of cells that begins at the first selected one, as far as the table goes."""
        ends = self.ends()
        if ends is None:
            return []
        first = ends[0]
        below = (r for r in range(first.row(), len(self._table.rows)) if not self._table.rows[r].section)
        across = range(first.column(), min(first.column() + columns, len(self._table.columns)))
        return [[self.existing(r, c) for c in across] for r, _ in zip(below, range(rows), strict=False)]

    def block_to_fill(self, *, down: bool) -> list[list[Address | None]]:
        """Return the selected cells with the line they are filled from: a single row gets the one above, a
        single column the one before.
        """
        ends = self.ends()
        if ends is None:
            return []
        first, last = ends
        rows = [r for r in range(first.row(), last.row() + 1) if not self._table.rows[r].section]
        columns = list(range(first.column(), min(last.column(), len(self._table.columns) - 1) + 1))
        if down and len(rows) == 1:
            above = (r for r in range(first.row() - 1, -1, -1) if not self._table.rows[r].section)
            rows = [*([r] if (r := next(above, None)) is not None else []), *rows]
        if not down and len(columns) == 1 and columns[0] > 0:
            columns.insert(0, columns[0] - 1)
        return [[self.existing(r, c) for c in columns] for r in rows]

    def repeated(self, first: QModelIndex, last: QModelIndex, end: QModelIndex) -> dict[Address, Address]:
        """Return target -> source where the block from ``first`` to ``last`` is repeated up to ``end``."""
        rows, columns = last.row() - first.row() + 1, last.column() - first.column() + 1
        found: dict[Address, Address] = {}
        for r in range(first.row(), end.row() + 1):
            for c in range(first.column(), end.column() + 1):
                above, before = (r - first.row()) % rows, (c - first.column()) % columns
                source = self.existing(first.row() + above, first.column() + before)
                target = self.existing(r, c)
                if target is not None and source is not None and target != source:
                    found[target] = source
        return found

    def existing(self, row: int, column: int) -> Address | None:
        address = self._table.address_at(row, column)
        return address if address is not None and self._table.values.exists(address) else None

    def ends(self) -> tuple[QModelIndex, QModelIndex] | None:
        """Return the first and the last cell of the selected range, the current cell where there is none."""
        selection = self._view.selectionModel().selection()
        if selection.isEmpty():
            here = self._view.currentIndex()
            return (here, here) if here.isValid() else None
        ranges = [selection.at(n) for n in range(selection.count())]
        rows = [n for s in ranges for n in (s.top(), s.bottom())]
        columns = [n for s in ranges for n in (s.left(), s.right())]
        return self._table.index(min(rows), min(columns)), self._table.index(max(rows), max(columns))
