"""The blocks of a program as a list: what limits each and its time, like blocks folded, one limit alone."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice

import numpy as np
import numpy.typing as npt
from PySide6.QtCore import QAbstractTableModel, QModelIndex, QPersistentModelIndex, Qt, Signal
from PySide6.QtGui import QKeyEvent, QMouseEvent
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableView

from amp_studio.sim import value_text
from amp_studio.ui.base.figures import written
from amp_studio.ui.base.theme import colour
from amp_studio.ui.base.translated import tr

from .tables import ROW, LimitRowDelegate, TableLook

_SHOWN, _MIN_FOLDED = 6, 3
"""Of blocks that are alike so many are listed; so many are worth a fold at least."""
MAX_LISTED = 200_000
"""Blocks that are listed; the rest is computed too."""
_SHAPE = re.compile(r"N\s*[0-9.]+|[^A-Z]+", re.ASCII)
AnyIndex = QModelIndex | QPersistentModelIndex
LineKinds = npt.NDArray[np.int64]


@dataclass(frozen=True)
class BlockTable:
    """The blocks of a program with what is shown beside them."""

    lines: Sequence[str]
    letters: npt.NDArray[np.str_]
    """By line from 1: the letter of what limits it, "" where it moves nothing."""
    times: npt.NDArray[np.float64]
    """By line from 1, s."""
    alike: LineKinds
    """(lines,): a number for each kind of block; -1 for those that are never folded."""
    faults: Mapping[int, str]
    """Line from 1 -> the message of the control."""
    lines_of: Callable[[str], Collection[int]] = lambda _letter: ()
    """lines_of(letter of a limit, or `NOT_GOOD`) -> the lines that it has a part of."""


def kinds_of(lines: Iterable[str], letters: npt.NDArray[np.str_]) -> LineKinds:
    """Return a number for each of some lines: equal for blocks of the same words that one thing limits."""
    known: dict[str, int] = {}
    pairs = zip(islice(lines, MAX_LISTED), letters[1:].tolist(), strict=False)
    found = [
        known.setdefault(letter + _SHAPE.sub("", line.upper()), len(known)) if letter else -1
        for line, letter in pairs
    ]
    return np.array(found, np.int64)


class BlockModel(QAbstractTableModel):
    """Rows of blocks and of folds; texts are read where they are seen."""

    def __init__(self) -> None:
        super().__init__()
        self.rows = BlockTable((), np.full(1, ""), np.zeros(1), np.zeros(0, np.int64), {})
        self.only = ""
        self._open: set[int] = set()
        """First lines of the folds that are open."""
        self._first, self._count = np.zeros(0, np.int64), np.zeros(0, np.int64)
        """Of each row: its first line from 0, and how many it folds; 0 for a block."""

    def show_rows(self, rows: BlockTable) -> None:
        """Show other blocks, all of them, folded."""
        self.rows, self.only = rows, ""
        self._open.clear()
        self._list_rows()

    def show_only(self, letter: str) -> None:
        """Show the blocks of one limit, or what is not good, alone; all of them for ""."""
        self.only = letter
        self._list_rows()

    def _list_rows(self) -> None:
        self.beginResetModel()
        if self.only:
            own = np.array(sorted(self.rows.lines_of(self.only)), np.int64)
            self._first = own[(own > 0) & (own <= len(self.rows.alike))] - 1
            self._count = np.zeros(len(self._first), np.int64)
        else:
            self._first, self._count = self._folded()
        self.endResetModel()

    def _folded(self) -> tuple[LineKinds, LineKinds]:
        """Return the rows with folds."""
        alike = self.rows.alike
        edges = np.flatnonzero(np.diff(alike, prepend=-2)) if len(alike) else np.zeros(0, np.int64)
        ends = np.append(edges[1:], len(alike))
        long = (
            (ends - edges >= _SHOWN + _MIN_FOLDED) & (alike[edges] >= 0) if len(edges) else np.zeros(0, bool)
        )
        is_seen = np.ones(len(alike), bool)
        heads: list[tuple[int, int]] = []
        for first, end in zip((edges[long] + _SHOWN).tolist(), ends[long].tolist(), strict=True):
            is_seen[first:end] = first in self._open
            heads.append((first, end - first))
        blocks = np.flatnonzero(is_seen)
        if not heads:
            return blocks, np.zeros(len(blocks), np.int64)
        folds = np.array(heads, np.int64)
        first = np.concatenate([blocks, folds[:, 0]])
        count = np.concatenate([np.zeros(len(blocks), np.int64), folds[:, 1]])
        # The head of a fold is before its first block.
        order = np.lexsort((-count, first))
        return first[order], count[order]

    # -- rows and lines ------------------------------------------------------------

    def line_of(self, row: int) -> int:
        """Return the line of a row, from 1; of a fold its first."""
        return int(self._first[row]) + 1

    def fold_of(self, row: int) -> int:
        """Return how many blocks a row folds; 0 for a block."""
        return int(self._count[row]) if 0 <= row < len(self._count) else 0

    def row_of(self, line: int) -> int:
        """Return the row with a line, or the fold that it is in; -1 where it is not listed."""
        row = int(np.searchsorted(self._first, line - 1, "right")) - 1
        if row < 0:
            return -1
        own = int(self._first[row])
        is_inside = own == line - 1 or own <= line - 1 < own + int(self._count[row])
        return row if is_inside else -1

    def toggle(self, row: int) -> int:
        """Open or close a fold; returns its row."""
        first = int(self._first[row])
        self._open ^= {first}
        self._list_rows()
        return int(np.searchsorted(self._first, first))

    def open_at(self, line: int) -> int:
        """Open the fold that a line is in; returns the row of the line, -1 where it is not listed."""
        row = self.row_of(line)
        if row >= 0 and self.fold_of(row):
            self.toggle(row)
            row = self.row_of(line)
        return row

    # -- what Qt asks ---------------------------------------------------------------

    def rowCount(self, parent: AnyIndex = QModelIndex()) -> int:  # noqa: B008  # as Qt declares it
        return 0 if parent.isValid() else len(self._first)

    def columnCount(self, parent: AnyIndex = QModelIndex()) -> int:  # noqa: B008  # as Qt declares it
        return 0 if parent.isValid() else 3

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = 0) -> object:
        if orientation != Qt.Orientation.Horizontal:
            return None
        if role == Qt.ItemDataRole.TextAlignmentRole and section == 2:
            return Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        if role in (Qt.ItemDataRole.ToolTipRole, Qt.ItemDataRole.AccessibleTextRole):
            return (tr("Block"), tr("Limit"), tr("s"))[section]
        # The column of letters is as narrow as they are: blocks need the room.
        return (tr("Block"), "", tr("s"))[section] if role == Qt.ItemDataRole.DisplayRole else None

    def data(self, index: AnyIndex, role: int = 0) -> object:
        row, column = index.row(), index.column()
        line = self.line_of(row)
        if role == Qt.ItemDataRole.ToolTipRole:
            return self.rows.faults.get(line) or self._text(row, 0)
        if role == Qt.ItemDataRole.ForegroundRole:
            return colour("error") if line in self.rows.faults and not self.fold_of(row) else None
        return self._text(row, column) if role == Qt.ItemDataRole.DisplayRole else None

    def _text(self, row: int, column: int) -> str:
        line, count = self.line_of(row), self.fold_of(row)
        letter = str(self.rows.letters[line])
        if column == 0 and count:
            sign = "\u25be" if line - 1 in self._open else "\u25b8"
            return f"{sign} " + tr("+%n blocks like these", "", count)
        if column == 0:
            return self.rows.lines[line - 1]
        if column == 1:
            return letter
        time = float(self.rows.times[line : line + max(count, 1)].sum())
        return written(value_text(time, "", 3)) if letter else ""


class BlockView(QTableView):
    """The list; Enter, a double click or Left and Right open and close a fold."""

    picked = Signal(int)
    """A line was chosen by a person."""

    def __init__(self, name: str) -> None:
        super().__init__()
        self.blocks = BlockModel()
        self.setModel(self.blocks)
        self.setAccessibleName(name)
        self.setItemDelegate(LimitRowDelegate(TableLook(figures=(2,), bars=1), self))
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setShowGrid(False)
        self.setWordWrap(False)
        self.verticalHeader().hide()
        self.verticalHeader().setDefaultSectionSize(ROW)
        self.verticalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        head = self.horizontalHeader()
        head.setHighlightSections(False)
        head.setDefaultAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        # Fixed: a width by the texts would be measured over a hundred thousand rows.
        head.setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        head.setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        measure = self.fontMetrics()
        self.setColumnWidth(1, measure.horizontalAdvance("W") + 14)
        self.setColumnWidth(2, measure.horizontalAdvance("00.000") + 12)
        self.doubleClicked.connect(lambda index: self._toggle(index.row()))

    def show_line(self, line: int, *, is_asked: bool = True) -> bool:
        """Select a line, whose fold is opened where it ``is_asked`` for; returns whether it is listed."""
        row = self.blocks.open_at(line) if is_asked else self.blocks.row_of(line)
        if row < 0:
            return False
        self.selectRow(row)
        self.scrollTo(self.blocks.index(row, 0))
        return True

    def line(self) -> int:
        """Return the selected line, from 1; 0 without one."""
        row = self.currentIndex().row()
        return self.blocks.line_of(row) if row >= 0 else 0

    def _toggle(self, row: int) -> None:
        if self.blocks.fold_of(row):
            self.selectRow(self.blocks.toggle(row))

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        super().mouseReleaseEvent(event)
        index = self.indexAt(event.position().toPoint())
        if event.button() == Qt.MouseButton.LeftButton and index.isValid():
            self.picked.emit(self.blocks.line_of(index.row()))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Go to the next block by Right, to the one before by Left; Enter opens and closes a fold."""
        key, before = Qt.Key(event.key()), self.currentIndex().row()
        if key in (Qt.Key.Key_Return, Qt.Key.Key_Enter) and self.blocks.fold_of(before):
            self._toggle(before)
            return
        if key in (Qt.Key.Key_Left, Qt.Key.Key_Right):
            step = 1 if key == Qt.Key.Key_Right else -1
            row = min(max(before + step, 0), self.blocks.rowCount() - 1)
            self.selectRow(row)
            self.scrollTo(self.blocks.index(row, 0))
        else:
            super().keyPressEvent(event)
        if self.currentIndex().row() != before and self.line():
            self.picked.emit(self.line())
