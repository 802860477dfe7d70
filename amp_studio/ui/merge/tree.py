"""The tree of a comparison: a click or a key takes a source for a row, for a group, for all that is
selected.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from itertools import chain

from PySide6.QtCore import QItemSelectionModel, QModelIndex, QPersistentModelIndex, QSignalBlocker, Qt, Signal
from PySide6.QtGui import QAction, QGuiApplication, QKeySequence, QResizeEvent
from PySide6.QtWidgets import QAbstractItemView, QTreeView

from amp_studio.files import Row, Side, text_cell

from .columns import AXIS, BASE, NAME, RESULT, SIDES, A, B
from .delegate import MergeDelegate
from .header import MergeHeader
from .model import MergeModel

_MANY = 40
"""From so many rows on a group is folded at first, unless it has conflicts."""
_SHARES = {NAME: 28, AXIS: 4, BASE: 12, A: 19, B: 19}
"""Column -> per cent of the width; the result has the rest."""


class MergeTree(QTreeView):
    """Rows are selected whole; the model does what is chosen."""

    went_to = Signal(object)
    """An address that is to be shown in the table of the file."""
    current_row = Signal(object)
    """The row that is current now; None for the head of a group and for nothing."""

    def __init__(self, model: MergeModel, header: Callable[[QTreeView], MergeHeader]) -> None:
        super().__init__()
        self.setAccessibleName(self.tr("Differences"))
        self.rows = model
        self.setModel(model)
        self.head = header(self)
        self.setHeader(self.head)
        self.delegate = MergeDelegate(model, self)
        self.setItemDelegate(self.delegate)
        self.setUniformRowHeights(True)
        self.setSelectionMode(QAbstractItemView.SelectionMode.ExtendedSelection)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setIndentation(16)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.ActionsContextMenu)
        self._unfolded: dict[str, bool] = {}
        """Title of a group -> whether a person opened or folded it."""
        self.expanded.connect(partial(self._fold, True))
        self.collapsed.connect(partial(self._fold, False))
        self.clicked.connect(self._click)
        self.doubleClicked.connect(self._double_click)
        self.selectionModel().currentChanged.connect(lambda *_: self.current_row.emit(self.row()))
        for text, keys, act in (
            (self.tr("Take Source &0"), ["0"], partial(self.take, "base")),
            (self.tr("Take Source &A"), ["A", "Alt+Left"], partial(self.take, "a")),
            (self.tr("Take Source &B"), ["B", "Alt+Right"], partial(self.take, "b")),
            (self.tr("&Type a Value"), ["F2"], self.type_value),
            (self.tr("Take &Back the Choice"), ["Backspace"], partial(self.take, None)),
            (self.tr("&Next Difference"), ["Alt+Down"], partial(self.step, 1)),
            (self.tr("&Previous Difference"), ["Alt+Up"], partial(self.step, -1)),
            (self.tr("Next &Conflict"), ["C"], partial(self.step, 1, conflicts=True)),
            (self.tr("Pre&vious Conflict"), ["Shift+C"], partial(self.step, -1, conflicts=True)),
            (self.tr("&Show in the Table"), ["Return", self.tr("Enter")], self.go),
            (self.tr("Cop&y Rows"), ["Ctrl+C"], self.copy),
        ):
            action = QAction(text, self)
            action.setShortcuts([QKeySequence(key) for key in keys])
            action.setShortcutContext(Qt.ShortcutContext.WidgetShortcut)
            action.triggered.connect(lambda *_, act=act: act())
            self.addAction(action)

    # -- what is shown -----------------------------------------------------------------

    def unfold(self) -> None:
        """Show the rows of each group; long ones without a conflict stay folded.
        What a person folded or opened stays so.
        """
        total = sum(len(group.rows) for group in self.rows.groups)
        with QSignalBlocker(self):
            for n, group in enumerate(self.rows.groups):
                is_short = len(group.rows) <= _MANY or total <= 2 * _MANY
                is_open = self._unfolded.get(group.title, is_short or bool(group.conflicts))
                self.setExpanded(self.rows.index(n, NAME), is_open)

    def _fold(self, is_open: bool, index: QModelIndex) -> None:
        if (group := self.rows.group_at(index)) is not None:
            self._unfolded[group.title] = is_open

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self.fit()

    def fit(self) -> None:
        """Share the width among the columns."""
        width = self.viewport().width()
        hidden = _SHARES[BASE] if self.isColumnHidden(BASE) else 0
        for column, share in _SHARES.items():
            more = hidden // 3 if column in (A, B) else 0
            self.setColumnWidth(column, max(34, width * (share + more) // 100))

    # -- where the person is -------------------------------------------------------------

    def row(self) -> Row | None:
        """Return the current row."""
        return self.rows.row_at(self.currentIndex())

    def selected(self) -> list[Row]:
        """Return the selected rows; the head of a group means all of its rows."""
        found: dict[object, Row] = {}
        for index in self.selectionModel().selectedRows():
            row, group = self.rows.row_at(index), self.rows.group_at(index)
            for each in [row] if row else group.rows if group else ():
                found[each.id] = each
        return list(found.values())

    def show_row(self, row: Row) -> None:
        """Make a row the current one."""
        self._make_current(self.rows.index_of(row.id))

    def _make_current(self, index: QModelIndex) -> None:
        if index.isValid():
            self.setExpanded(index.parent(), True)
            flags = QItemSelectionModel.SelectionFlag.ClearAndSelect | QItemSelectionModel.SelectionFlag.Rows
            self.selectionModel().setCurrentIndex(index, flags)
            self.scrollTo(index)

    def step(self, step: int, *, conflicts: bool = False) -> None:
        """Go to the next or previous row that differs, or that is a conflict that is not settled;
        round at the end.
        """
        every = [*chain.from_iterable(group.rows for group in self.rows.groups)]
        if conflicts:
            rows = [row for row in every if self.rows.merge.choice(row) is None]
        else:
            rows = [row for row in every if row.kind != "same"]
        if not rows:
            return
        places = {row.id: n for n, row in enumerate(every)}
        here = places.get(current.id, -1) if (current := self.row()) else -1
        ahead = [row for row in rows if (places[row.id] - here) * step > 0] or rows
        self.show_row(ahead[0 if step > 0 else -1])

    # -- choosing ------------------------------------------------------------------------

    def take(self, side: Side | None) -> None:
        """Take a source for the selected rows; None takes the choice back."""
        self.rows.choose(self.selected(), side)

    def type_value(self) -> None:
        """Open the editor of the current row's result."""
        index = self.currentIndex().siblingAtColumn(RESULT)
        if self.rows.flags(index) & Qt.ItemFlag.ItemIsEditable:
            self.selectionModel().setCurrentIndex(index, QItemSelectionModel.SelectionFlag.NoUpdate)
            self.edit(index)

    def _click(self, index: QModelIndex | QPersistentModelIndex) -> None:
        row, group = self.rows.row_at(index), self.rows.group_at(index)
        if index.column() in (A, B):
            rows = [row] if row else list(group.rows) if group else []
            self.rows.choose(rows, SIDES[index.column()])

    def _double_click(self, index: QModelIndex) -> None:
        if index.column() == RESULT:
            self.type_value()
        elif index.column() in (NAME, AXIS):
            self.go()

    def go(self) -> None:
        """Show the current value in the table of the file."""
        row = self.row()
        if row is not None and row.id.part == "value":
            self.went_to.emit(row.address)

    def keyboardSearch(self, search: str) -> None:
        """Leave letters to the keys that take a source."""

    def copy(self) -> None:
        """Copy the selected rows as a spreadsheet takes them."""
        columns = [c for c in range(RESULT + 1) if not self.isColumnHidden(c)]
        lines = (
            "\t".join(text_cell(" ".join(self.rows.text(row, column).split())) for column in columns)
            for row in self.selected()
        )
        QGuiApplication.clipboard().setText("\n".join(lines))
