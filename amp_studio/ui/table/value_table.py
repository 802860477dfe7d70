"""The view of the table: names that stay while the axes scroll, ranges of cells, editing with one key,
a fill handle.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from PySide6.QtCore import (
    QEvent,
    QItemSelection,
    QItemSelectionModel,
    QModelIndex,
    QPersistentModelIndex,
    QPoint,
    QRect,
    Qt,
    QTimer,
    Signal,
)
from PySide6.QtGui import QAction, QFocusEvent, QKeyEvent, QMouseEvent, QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QAbstractItemView, QApplication, QTableView, QWidget

from amp_studio.files import RangeError
from amp_studio.schema import Address, InvalidValueError, Parameter
from amp_studio.ui.base.figures import sentence
from amp_studio.ui.base.theme import font

from .cell_editor import CellEditor, Refusal
from .column_widths import MIN_NAMES, ColumnWidths, ContentWidths, column_widths, content_widths, widened
from .more_columns import MoreColumns
from .parameter_table import AddressRole, ParameterTable
from .selected_cells import SelectedCells
from .table_heads import AxisHeads, Corner, RowHeads
from .value_delegate import ValueDelegate, allowed_text

_MARGIN = 18
"""Room for the scroll bar."""
_HANDLE = 6


class ValueTable(QTableView):
    """Shows a ``ParameterTable``; the selected cells stay selected when the model changes."""

    selected = Signal(object)
    """The address of the current cell; None where the list is empty."""
    range_changed = Signal()
    """Other cells are selected."""
    reset_requested = Signal(list)
    """The mark of a row was clicked: its values that are not their default."""
    fill_requested = Signal(object)
    """The fill handle was dragged: target -> the address that it gets its value from."""

    def __init__(
        self, model: ParameterTable, actions: Iterable[QAction] = (), parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self._table = model
        self._is_fitting = self._is_dragged = False
        self._filling: tuple[QModelIndex, QModelIndex] | None = None
        self._content: ContentWidths | None = None
        """What the contents need, until they or the font change."""
        """First and last cell of the range from which the fill handle is dragged."""
        self.last: Address | None = None
        self._parameters: list[Parameter] = []
        self._chosen: list[Address] = []
        self._was_block = True
        self._top = 0
        names = RowHeads(model, self)
        names.reset_requested.connect(self.reset_requested)
        self.setVerticalHeader(names)
        self.setHorizontalHeader(AxisHeads(model, self))
        self._corner = Corner(self)
        self._more = MoreColumns(self, model)
        self.setModel(model)
        self.cells = SelectedCells(self, model)
        self._delegate = ValueDelegate(model, self._commit, self)
        self._delegate.ended.connect(self._end_editing)
        self.setItemDelegate(self._delegate)
        self.setFont(font("text"))
        self.setAccessibleName(self.tr("Values"))
        self.setShowGrid(False)
        self.setFrameShape(QTableView.Shape.NoFrame)
        self.setCornerButtonEnabled(False)
        self.setSelectionMode(QAbstractItemView.SelectionMode.ExtendedSelection)
        self.setHorizontalScrollMode(QAbstractItemView.ScrollMode.ScrollPerItem)  # a column is shown whole
        self.setWordWrap(False)
        self.viewport().setMouseTracking(True)
        triggers = QAbstractItemView.EditTrigger
        self.setEditTriggers(triggers.DoubleClicked | triggers.EditKeyPressed | triggers.AnyKeyPressed)
        self.verticalHeader().setFixedWidth(MIN_NAMES)
        self.verticalHeader().sectionClicked.connect(self._select_row)
        self.horizontalHeader().sectionResized.connect(self._keep_widths)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.ActionsContextMenu)
        self.addActions(list(actions))
        self.selectionModel().currentChanged.connect(self._emit_selected)
        self.selectionModel().selectionChanged.connect(self._emit_range)
        model.modelAboutToBeReset.connect(self._before_reset)
        model.modelReset.connect(self._after_reset)
        model.values_changed.connect(self._widen_columns)

    def selectionCommand(
        self, index: QModelIndex | QPersistentModelIndex, event: QEvent | None = None
    ) -> QItemSelectionModel.SelectionFlag:
        """Return what becomes selected: a cell that the program chooses is so alone,
        also while the Ctrl of a shortcut is down.
        """
        if event is None and QApplication.keyboardModifiers() & Qt.KeyboardModifier.ControlModifier:
            return QItemSelectionModel.SelectionFlag.ClearAndSelect
        return super().selectionCommand(index, event)

    def address(self) -> Address | None:
        """Return the address of the current cell."""
        found: Address | None = self.currentIndex().data(AddressRole)
        return found

    def _emit_selected(self, index: QModelIndex) -> None:
        address = index.data(AddressRole)
        if address is not None:
            self.last = address
            self.selected.emit(address)
        self._more.uncover(index.column())
        self.verticalHeader().viewport().update()
        self.horizontalHeader().viewport().update()
        self.viewport().update()

    def _emit_range(self) -> None:
        self.viewport().update()  # the edge of the range is painted over cells that stay selected
        self.range_changed.emit()

    # -- editing ---------------------------------------------------------------

    def finish(self) -> bool:
        """Commit an open editor; returns False when its text was refused, and it stays open with the
        reason.
        """
        editor: QWidget | None = self.indexWidget(self.currentIndex())
        if editor is None:
            return True
        if isinstance(editor, CellEditor):
            if not self._delegate.take(editor):
                return False
        else:
            self.commitData(editor)
        self.closeEditor(editor, ValueDelegate.EndEditHint.NoHint)
        return True

    def _commit(self, address: Address, text: str) -> Refusal | None:
        """Set a value from typed text; returns why it is refused."""
        workspace = self._table.workspace
        try:
            workspace.enter(address, text)
        except RangeError as error:
            return self._delegate.out_of_range(address, str(error))
        except InvalidValueError as error:
            return Refusal(sentence(str(error)), allowed_text(workspace, address))
        return None

    def _end_editing(self, modifiers: int, editor: CellEditor) -> None:
        """Take a text by Enter and go down; with Ctrl into every selected cell,
        with Ctrl and Shift out of range too.
        """
        pressed = Qt.KeyboardModifier(modifiers) & ~Qt.KeyboardModifier.KeypadModifier
        control, shift = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
        here, address = self.currentIndex(), self.address()
        if pressed & control and address is not None:
            refusal = (
                self._force(address, editor.text()) if pressed & shift else self._fill_typed(editor.text())
            )
            if refusal is not None:
                editor.show_refusal(refusal)
                return
            editor.setText(self._table.typed_value(address))  # it is taken: closing commits nothing more
            self.closeEditor(editor, ValueDelegate.EndEditHint.RevertModelCache)
            return
        if self._delegate.take(editor):
            self.closeEditor(editor, ValueDelegate.EndEditHint.NoHint)
            move = self.CursorAction.MoveUp if pressed & shift else self.CursorAction.MoveDown
            # A value that changes the rows has moved the current cell already.
            if self.currentIndex() == here:
                self.setCurrentIndex(self.moveCursor(move, Qt.KeyboardModifier.NoModifier))

    def _force(self, address: Address, text: str) -> Refusal | None:
        try:
            self._table.workspace.enter(address, text, force=True)
        except InvalidValueError as error:
            return Refusal(sentence(str(error)), allowed_text(self._table.workspace, address))
        return None

    def _fill_typed(self, text: str) -> Refusal | None:
        """Set every selected cell from one typed text, all or none."""
        refused = self._table.workspace.enter_all(dict.fromkeys(self.cells.addresses(), text))
        return Refusal("; ".join(refused[:3]) + (" …" if len(refused) > 3 else "")) if refused else None

    def closeEditor(self, editor: QWidget, hint: ValueDelegate.EndEditHint) -> None:
        """Close an editor; one that lost the focus with a refused text opens again with it."""
        refusal, address = self._delegate.refusal, self.address()
        if isinstance(editor, CellEditor):
            if editor.is_gone:
                return
            editor.is_gone = True
            if refusal is not None and hint == ValueDelegate.EndEditHint.NoHint and address is not None:
                text = editor.text()
                # Only when this one is closed: a cell has one editor.
                QTimer.singleShot(0, self, lambda: self._reopen_editor(address, text, refusal))
            editor.close_frame()
        self._delegate.refusal = None
        super().closeEditor(editor, hint)

    def reset(self) -> None:
        """Give up open editors: a value may change which rows there are while it is committed."""
        for editor in self.viewport().findChildren(CellEditor):
            editor.is_gone = True
            editor.close_frame()
        super().reset()

    def edit_current(self) -> None:
        """Open the editor of the current cell, if it can be edited."""
        index = self.currentIndex()
        if index.flags() & Qt.ItemFlag.ItemIsEditable and self.indexWidget(index) is None:
            self.edit(index)

    def _reopen_editor(self, address: Address, text: str, refusal: Refusal) -> None:
        """Open the editor again with a refused text."""
        index = self._table.index_of(address)
        if index.isValid() and self.indexWidget(index) is None:
            self.setCurrentIndex(index)
            self._delegate.to_reopen = (address, text, refusal)
            self.edit_current()

    def _select_row(self, row: int) -> None:
        if self._table.rows[row].section:
            return
        here = self._table.index(row, self.currentIndex().column())
        current = here if here.flags() & Qt.ItemFlag.ItemIsEnabled else self._table.first_of(row)
        if current.isValid():
            whole = QItemSelection(
                self._table.index(row, 0), self._table.index(row, max(0, len(self._table.columns) - 1))
            )
            self.setCurrentIndex(current)
            self.selectionModel().select(whole, QItemSelectionModel.SelectionFlag.ClearAndSelect)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Enter edits the cell, as F2 and typing do; Tab leaves the table behind its last cell."""
        is_enter = event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter)
        editing = self.state() == QAbstractItemView.State.EditingState
        if is_enter and not editing and self.currentIndex().flags() & Qt.ItemFlag.ItemIsEditable:
            self.edit_current()
        elif event.key() == Qt.Key.Key_Tab and not editing and self._is_end(self.CursorAction.MoveNext):
            self._leave_by_tab(forward=True)
        elif (
            event.key() == Qt.Key.Key_Backtab and not editing and self._is_end(self.CursorAction.MovePrevious)
        ):
            self._leave_by_tab(forward=False)
        else:
            super().keyPressEvent(event)

    def _leave_by_tab(self, *, forward: bool) -> None:
        self.setTabKeyNavigation(False)  # with it Qt would give the key to this table again
        self.focusNextChild() if forward else self.focusPreviousChild()
        self.setTabKeyNavigation(True)

    def keyboardSearch(self, search: str) -> None:
        """Look for nothing: letters are for values, and the find box looks through all of the file."""

    def moveCursor(self, move: QAbstractItemView.CursorAction, modifiers: Qt.KeyboardModifier) -> QModelIndex:
        """Go on below the block of the whole control in the first axis, and from there up into it again."""
        here, found = self.currentIndex(), super().moveCursor(move, modifiers)
        by = {self.CursorAction.MoveDown: 1, self.CursorAction.MoveUp: -1}.get(move, 0)
        if by and self._table.has_block and here.isValid() and found.row() == here.row():
            rows = range(here.row() + by, len(self._table.rows) if by > 0 else -1, by)
            beyond = (index for row in rows if (index := self._table.first_of(row)).isValid())
            return next(beyond, found)
        return found

    def _is_end(self, move: QAbstractItemView.CursorAction) -> bool:
        """Return whether Tab would begin again at the other end."""
        here, there = self.currentIndex(), self.moveCursor(move, Qt.KeyboardModifier.NoModifier)
        if not here.isValid() or not there.isValid() or here == there:
            return True
        # Qt begins again at the other end: a next cell that lies before this one means the end.
        is_before = (there.row(), there.column()) < (here.row(), here.column())
        return is_before == (move == self.CursorAction.MoveNext)

    # -- painting ---------------------------------------------------------------

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = self._delegate.painter
        painter.is_active = self.hasFocus()
        painter.take_colours()
        super().paintEvent(event)
        over = QPainter(self.viewport())
        for address in self._table.outlined:
            index = self._table.index_of(address)
            if index.isValid():
                painter.outline(over, self.visualRect(index), self._table.outline_severity)
        ends = self.cells.ends()
        if ends is not None and ends[0] != ends[1] and self.cells.is_block:
            handle = self._handle() if self._table.workspace.may_edit else QRect()
            painter.range_edge(over, self._place_of(*ends), handle)
        if self.currentIndex().isValid():
            painter.current(
                over, self._delegate.cell_place(self.visualRect(self.currentIndex()), self.currentIndex())
            )
        over.end()

    def _place_of(self, first: QModelIndex, last: QModelIndex) -> QRect:
        heads, names = self.horizontalHeader(), self.verticalHeader()
        left, top = heads.sectionViewportPosition(first.column()), names.sectionViewportPosition(first.row())
        right = heads.sectionViewportPosition(last.column()) + heads.sectionSize(last.column())
        bottom = names.sectionViewportPosition(last.row()) + names.sectionSize(last.row())
        return QRect(QPoint(left, top), QPoint(right - 1, bottom - 1))

    def _handle(self) -> QRect:
        """Return the place of the fill handle."""
        ends = self.cells.ends()
        if ends is None or not self.cells.is_block:
            return QRect()
        corner = self._place_of(*ends).bottomRight()
        return QRect(corner.x() - _HANDLE + 1, corner.y() - _HANDLE + 1, _HANDLE, _HANDLE)

    def focusInEvent(self, event: QFocusEvent) -> None:
        super().focusInEvent(event)
        self.viewport().update()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        self.viewport().update()

    # -- the fill handle ---------------------------------------------------------

    def mousePressEvent(self, event: QMouseEvent) -> None:
        is_handle = self._handle().adjusted(-5, -5, 5, 5).contains(event.position().toPoint())
        if event.button() == Qt.MouseButton.LeftButton and is_handle and self._table.workspace.may_edit:
            self._filling = self.cells.ends()
            return
        super().mousePressEvent(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        place = event.position().toPoint()
        if self._filling is None:
            is_handle = self._handle().adjusted(-3, -3, 3, 3).contains(place)
            self.viewport().setCursor(Qt.CursorShape.CrossCursor if is_handle else Qt.CursorShape.ArrowCursor)
            super().mouseMoveEvent(event)
            return
        first, last = self._filling
        over = self.indexAt(place)
        if over.isValid():
            down, across = over.row() - last.row(), over.column() - last.column()
            is_down = down * self.rowHeight(last.row()) > across * self.columnWidth(last.column())
            row = max(over.row(), last.row()) if is_down else last.row()
            column = last.column() if is_down else max(over.column(), last.column())
            self._select(first, self._table.index(row, column))

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        if self._filling is None:
            super().mouseReleaseEvent(event)
            return
        (first, last), self._filling = self._filling, None
        found = self.cells.repeated(first, last, (self.cells.ends() or (first, last))[1])
        if found:
            self.fill_requested.emit(found)

    def _select(self, first: QModelIndex, last: QModelIndex) -> None:
        self.selectionModel().select(
            QItemSelection(first, last), QItemSelectionModel.SelectionFlag.ClearAndSelect
        )

    # -- widths ------------------------------------------------------------------

    def _before_reset(self) -> None:
        self._parameters = self._table.asked
        self._top = self.verticalScrollBar().value()
        self._chosen, self._was_block = self.cells.addresses(), self.cells.is_block

    def _after_reset(self) -> None:
        """Show the new list; one that is the old one with other rows stays where it was,
        with what was selected.
        """
        is_same = self._parameters is self._table.asked
        self._is_dragged = self._is_dragged and is_same
        self._span_block_columns()
        self._content = None
        self._fit_columns()
        index = self._table.index_of(self.last) if self.last else QModelIndex()
        if not index.isValid() or not index.flags() & Qt.ItemFlag.ItemIsEnabled:
            index = next(
                (i for row in range(len(self._table.rows)) if (i := self._table.first_of(row)).isValid()),
                QModelIndex(),
            )
        self.setCurrentIndex(index)
        if not index.isValid():
            self.selected.emit(None)
        elif is_same:
            self._select_again()
            self.verticalScrollBar().setValue(self._top)
            self.scrollTo(index)

    def _select_again(self) -> None:
        """Select the range again that was selected before the list changed."""
        if len(self._chosen) > 1 and self._was_block:
            ends = [self._table.index_of(a) for a in (self._chosen[0], self._chosen[-1])]
            if all(end.isValid() for end in ends):
                self._select(*ends)
        elif len(self._chosen) > 1:
            for index in map(self._table.index_of, self._chosen):
                self.selectionModel().select(index, QItemSelectionModel.SelectionFlag.Select)

    def _fit_columns(self) -> None:
        """Make each column as wide as its contents, as far as there is room;
        the rest of the room stays empty at the right.
        """
        if self._is_dragged:
            return
        room = self.width() - _MARGIN
        self._take_widths(self._widths(room))

    def _widths(self, room: int) -> ColumnWidths:
        """Return the widths for a room; the contents are measured when they have changed,
        not whenever the room has.
        """
        if self._content is None:
            self._content = content_widths(self._table, self._delegate.painter)
        return column_widths(self._content, room)

    def _take_widths(self, widths: ColumnWidths) -> None:
        self._is_fitting = True
        heads, names = self.horizontalHeader(), self.verticalHeader()
        assert isinstance(names, RowHeads)
        painter = self._delegate.painter
        if (painter.unit_slots, self._delegate.number_room) != (widths.slots, widths.block):
            painter.unit_slots, self._delegate.number_room = widths.slots, widths.block
            self.viewport().update()  # numbers of rows that have not changed move too
        for column, width in enumerate(widths.columns):
            heads.resizeSection(column, width)
        names.number_width = self._corner.number_width = widths.number
        is_same = names.minimumWidth() == widths.frozen == self.viewportMargins().left()
        names.setFixedWidth(widths.frozen)
        self._corner.place_words()
        self._is_fitting = False
        if not is_same:  # else the first column lies below the names until something else moves
            self.updateGeometries()

    def _span_block_columns(self) -> None:
        """Let the values of the whole control have the width of all columns."""
        self.clearSpans()
        if self._table.has_block:
            for row in range(len(self._table.rows)):
                if self._table.is_in_block(row):
                    self.setSpan(row, 0, 1, self._table.columnCount())

    def _widen_columns(self, changed: list[Address]) -> None:
        """Widen the columns for which a new value is too wide; none becomes narrower under the hand."""
        content, self._content = self._content, None
        if content is not None and changed:
            looked_at = (*changed, *self._table.values.worst)  # a mark of a finding needs room too
            rows = {i.row() for a in looked_at if (i := self._table.index_of(a)).isValid()}
            self._content = widened(content, self._table, self._delegate.painter, rows)
        if self._is_dragged or not self._table.rows:
            return
        wanted = self._widths(self.width() - _MARGIN)
        present = [self.horizontalHeader().sectionSize(n) for n in range(len(wanted.columns))]
        columns = [max(now, new) for now, new in zip(present, wanted.columns, strict=True)]
        frozen = max(self.verticalHeader().width(), wanted.frozen)
        self._take_widths(replace(wanted, columns=columns, frozen=frozen))
        self._more.place()

    def _keep_widths(self, *_: object) -> None:
        """Keep the widths when the user has set one, until another list is shown."""
        self._is_dragged = self._is_dragged or not self._is_fitting

    def updateGeometries(self) -> None:
        super().updateGeometries()
        heads = self.horizontalHeader()
        self._corner.setGeometry(0, 0, self.verticalHeader().width(), heads.height())
        self._corner.raise_()
        self._more.place()

    def changeEvent(self, event: QEvent) -> None:
        if event.type() in (QEvent.Type.FontChange, QEvent.Type.StyleChange, QEvent.Type.LanguageChange):
            self._content = None
        super().changeEvent(event)

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        if event.size().width() != event.oldSize().width():
            self._fit_columns()
