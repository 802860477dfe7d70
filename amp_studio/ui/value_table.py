"""The table's view: names that stay while the axes scroll, editing with one key, one cell selected."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from PySide6.QtCore import QModelIndex, Qt, Signal
from PySide6.QtGui import QAction, QFontMetrics, QKeyEvent
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableView, QWidget

from amp_studio.schema import Address

from .parameter_table import AddressRole, ParameterTable
from .value_delegate import ValueDelegate

_NAMES = 256
_NARROWEST, _WIDEST = 92, 140


class ValueTable(QTableView):
    """Shows a ``ParameterTable``; the cell that was selected stays selected whatever the model does."""

    selected = Signal(object)
    """The address of the current cell."""

    def __init__(
        self,
        model: ParameterTable,
        commit: Callable[[Address, str], bool],
        actions: Iterable[QAction] = (),
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self._table = model
        self.last: Address | None = None
        self.setModel(model)
        self.setItemDelegate(ValueDelegate(model.workspace, commit, self))
        self.setAlternatingRowColors(True)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setHorizontalScrollMode(QAbstractItemView.ScrollMode.ScrollPerPixel)
        self.setWordWrap(False)
        triggers = QAbstractItemView.EditTrigger
        self.setEditTriggers(triggers.DoubleClicked | triggers.EditKeyPressed | triggers.AnyKeyPressed)
        names, heads = self.verticalHeader(), self.horizontalHeader()
        names.setDefaultSectionSize(24)
        names.setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        names.setTextElideMode(Qt.TextElideMode.ElideRight)
        names.setFixedWidth(_NAMES)
        names.setHighlightSections(False)
        names.setSectionsClickable(True)
        names.sectionClicked.connect(self._select_row)
        heads.setHighlightSections(True)
        heads.setMinimumSectionSize(48)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.ActionsContextMenu)
        self.addActions(list(actions))
        self.selectionModel().currentChanged.connect(self._tell)
        model.modelReset.connect(self._after_reset)

    def address(self) -> Address | None:
        """Return the address of the current cell."""
        found: Address | None = self.currentIndex().data(AddressRole)
        return found

    def _tell(self, index: QModelIndex) -> None:
        address = index.data(AddressRole)
        if address is not None:
            self.last = address
            self.selected.emit(address)

    def _select_row(self, row: int) -> None:
        here = self._table.index(row, self.currentIndex().column())
        self.setCurrentIndex(here if here.data(AddressRole) else self._table.first_of(row))

    def _after_reset(self) -> None:
        self._fit_columns()
        index = self._table.index_of(self.last) if self.last else QModelIndex()
        if not index.isValid():
            index = next(
                (i for row in range(len(self._table.rows)) if (i := self._table.first_of(row)).isValid()),
                index,
            )
        self.setCurrentIndex(index)

    def _fit_columns(self) -> None:
        """Make each column as wide as its values, within bounds; asks the model for texts only."""
        table, texts = self._table, QFontMetrics(self.font())
        heads = QFontMetrics(self.horizontalHeader().font())
        for column, what in enumerate(table.columns):
            cells = (table.address_at(row, column) for row in range(len(table.rows)))
            widest = max(
                (texts.horizontalAdvance(t) for t in {table.shown_value(a) for a in cells if a}), default=0
            )
            wanted = max(
                int(1.08 * widest) + 18, heads.horizontalAdvance(table.column_title(what)) + 24
            )  # bold is wider
            self.setColumnWidth(column, max(_NARROWEST, min(_WIDEST, wanted)))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Enter edits the cell, as F2 and typing do."""
        is_enter = event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter)
        editing = self.state() == QAbstractItemView.State.EditingState
        if is_enter and not editing and self.currentIndex().flags() & Qt.ItemFlag.ItemIsEditable:
            self.edit(self.currentIndex())
        else:
            super().keyPressEvent(event)
