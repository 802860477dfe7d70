"""The view of the table: fixed names while the axes scroll, editing with one key, one selected cell."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from heapq import nlargest

from PySide6.QtCore import QModelIndex, Qt, QTimer, Signal
from PySide6.QtGui import QAction, QFontMetrics, QKeyEvent, QResizeEvent
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableView, QWidget

from amp_studio.schema import Address

from .parameter_table import AddressRole, ParameterTable
from .value_delegate import ValueDelegate

_NAMES = (256, 330)
"""Least width of the names in a narrow table, and in one wider than four times the larger of these."""
_MEASURED = 12
"""Number of the longest texts of a column that are measured."""
_MARGIN = 24
"""Room for the scroll bar and the frame."""
_NARROWEST, _WIDEST = 92, 240
_CHOICES = (200, 160, 118)
"""Widths that long choices may have, depending on the room."""


class ValueTable(QTableView):
    """Shows a ``ParameterTable``; the selected cell stays selected when the model changes."""

    selected = Signal(object)
    """The address of the current cell; None where the list is empty."""

    def __init__(
        self,
        model: ParameterTable,
        commit: Callable[[Address, str], bool],
        actions: Iterable[QAction] = (),
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self._table = model
        self._is_fitting = self._is_dragged = self._refused = False
        self.last: Address | None = None
        self.setModel(model)
        self._take = commit
        self._delegate = ValueDelegate(model.workspace, self._commit, self)
        self.setItemDelegate(self._delegate)
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
        names.setFixedWidth(_NAMES[0])
        names.setHighlightSections(False)
        names.setSectionsClickable(True)
        names.sectionClicked.connect(self._select_row)
        heads.setHighlightSections(True)
        heads.setMinimumSectionSize(48)
        heads.sectionResized.connect(self._note_drag)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.ActionsContextMenu)
        self.addActions(list(actions))
        self.selectionModel().currentChanged.connect(self._emit_selected)
        model.modelReset.connect(self._after_reset)

    def address(self) -> Address | None:
        """Return the address of the current cell."""
        found: Address | None = self.currentIndex().data(AddressRole)
        return found

    def _emit_selected(self, index: QModelIndex) -> None:
        address = index.data(AddressRole)
        if address is not None:
            self.last = address
            self.selected.emit(address)

    def finish(self) -> bool:
        """Commit an open editor; returns False when its value was refused."""
        editor: QWidget | None = self.indexWidget(self.currentIndex())
        if editor is None:
            return True
        self._refused = False
        self.commitData(editor)
        self.closeEditor(editor, ValueDelegate.EndEditHint.NoHint)
        return not self._refused

    def _commit(self, address: Address, text: str) -> bool:
        if self._take(address, text):
            return True
        self._refused = True
        QTimer.singleShot(0, self, lambda: self._mend(address, text))
        return False

    def _mend(self, address: Address, text: str) -> None:
        """Open the editor again with a refused text."""
        index = self._table.index_of(address)
        if index.isValid() and not self._table.rows[index.row()].parameter.choices:
            self.setCurrentIndex(index)
            self._delegate.to_mend = (address, text)
            self.edit(index)

    def _select_row(self, row: int) -> None:
        here = self._table.index(row, self.currentIndex().column())
        self.setCurrentIndex(here if here.data(AddressRole) else self._table.first_of(row))

    def _after_reset(self) -> None:
        self._is_dragged = False
        self._fit_columns()
        index = self._table.index_of(self.last) if self.last else QModelIndex()
        if not index.isValid():
            index = next(
                (i for row in range(len(self._table.rows)) if (i := self._table.first_of(row)).isValid()),
                index,
            )
        self.setCurrentIndex(index)
        if not index.isValid():
            self.selected.emit(None)

    def _fit_columns(self) -> None:
        """Make each column as wide as its values and head; when they do not all fit, long choices are cut off."""
        if self._is_dragged:
            return
        self._is_fitting = True
        wanted = [self._wanted(column) for column in range(len(self._table.columns))]
        widths = [max(pair) for pair in wanted]
        for most in _CHOICES:
            if sum(widths) <= self.viewport().width():
                break
            widths = [max(figures, min(most, choices)) for figures, choices in wanted]
        if self._table.shows_commands:
            texts = map(self._table.command, range(len(self._table.rows)))
            widths.append(round(max(_NARROWEST, _widest(QFontMetrics(self.font()), texts) + 16)))
        for column, width in enumerate(widths):
            self.setColumnWidth(column, width)
        self._fit_names(sum(widths))
        self._is_fitting = False

    def _fit_names(self, values: int) -> None:
        """Make the names as wide as they need, as far as the values leave room: the gear is at their end."""
        metrics = QFontMetrics(self.verticalHeader().font())
        wanted = round(_widest(metrics, map(self._table.head, range(len(self._table.rows))))) + 16
        least = _NAMES[self.width() > 4 * _NAMES[1]]
        self.verticalHeader().setFixedWidth(max(least, min(wanted, self.width() - values - _MARGIN)))

    def _wanted(self, column: int) -> tuple[int, int]:
        """Return the width of the numbers and head of a column, and that of its choices."""
        table, texts = self._table, QFontMetrics(self.font())
        head = QFontMetrics(self.horizontalHeader().font()).horizontalAdvance(
            table.column_title(table.columns[column])
        )
        shown: dict[bool, set[str]] = {False: set(), True: set()}
        for n, row in enumerate(table.rows):
            address = table.address_at(n, column)
            if address is not None:
                shown[bool(row.parameter.choices)].add(table.cell_text(address))
        figures, choices = (1.1 * _widest(texts, shown[kind]) + 14 for kind in (False, True))
        return round(max(_NARROWEST, 1.1 * head + 24, min(_WIDEST, figures))), round(
            min(_WIDEST, choices)
        )  # bold is wider

    def _note_drag(self, *_: object) -> None:
        """Keep the widths when the user has set one, until another list is shown."""
        self._is_dragged = self._is_dragged or not self._is_fitting

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        if event.size().width() != event.oldSize().width():
            self._fit_columns()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Enter edits the cell, as F2 and typing do."""
        is_enter = event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter)
        editing = self.state() == QAbstractItemView.State.EditingState
        if is_enter and not editing and self.currentIndex().flags() & Qt.ItemFlag.ItemIsEditable:
            self.edit(self.currentIndex())
        else:
            super().keyPressEvent(event)


def _widest(metrics: QFontMetrics, texts: Iterable[str]) -> float:
    """Return the width of the widest text; only the longest are measured, as measuring is slow."""
    return max(map(metrics.horizontalAdvance, nlargest(_MEASURED, texts, len)), default=0)
