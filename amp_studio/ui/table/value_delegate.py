"""Paints the cells of the table, and edits them: a list for a choice,
a field that understands units for a number.
"""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QAbstractItemModel, QEvent, QObject, QPoint, QRect, Qt, QTimer, Signal
from PySide6.QtGui import QKeyEvent, QPainter
from PySide6.QtWidgets import (
    QAbstractItemView,
    QApplication,
    QLineEdit,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QWidget,
)

from amp_studio.schema import Address, InvalidValueError, Limits, Value, fault, limits, write_value
from amp_studio.ui.base.figures import range_in_words, sentence, show_value
from amp_studio.ui.base.model_index import ModelIndex
from amp_studio.ui.base.translated import unit_in_words
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.forms.choice_box import ChoiceBox
from amp_studio.ui.forms.mask_list import MaskList

from .cell_editor import CellEditor, Preview, Refusal
from .cell_painter import CellPainter
from .parameter_table import AddressRole, ParameterTable

_NARROWEST_EDITOR = 130


def _limits_of(workspace: Workspace, address: Address) -> Limits | None:
    """Return the bounds of an address in the unit in which it is typed."""
    return limits(workspace.file.evaluation, address, workspace.typed_unit(address))


def allowed_text(workspace: Workspace, address: Address) -> str:
    """Return the allowed values of an address: ``0 to 214.1 mm``, or the unit alone; empty for a choice."""
    if workspace.file.schema.parameters[address[0]].choices:
        return ""
    found = _limits_of(workspace, address)
    return range_in_words(found) if found else unit_in_words(workspace.typed_unit(address))


class ValueDelegate(QStyledItemDelegate):
    """Paints from the looks of the model. Edits pass their text to ``commit``;
    the model itself is never written.
    """

    ended = Signal(int, object)
    """An editor took its text by Enter, with these modifiers; the view goes on from there."""

    def __init__(
        self, table: ParameterTable, commit: Callable[[Address, str], Refusal | None], parent: QObject
    ) -> None:
        super().__init__(parent)
        self._table, self._workspace, self._commit = table, table.workspace, commit
        self.painter = CellPainter()
        self.painter.not_set = self.tr("not set")
        self.number_room = 0
        """Width of the numbers in the block of the whole control; 0 without it."""
        self.refusal: Refusal | None = None
        """Why the last text was refused."""
        self.to_reopen: tuple[Address, str, Refusal] | None = None
        """A text that was refused; the next editor of its address begins with it."""

    # -- painting ----------------------------------------------------------------

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: ModelIndex) -> None:
        row, column, place = index.row(), index.column(), option.rect
        look = self._table.look(row, column)
        if look is not None:
            state = option.state
            self.painter.paint(
                painter,
                place,
                look,
                self.painter.unit_slots[column] if column < len(self.painter.unit_slots) else 0,
                self.number_room if self._table.is_in_block(row) else 0,
                is_selected=bool(state & QStyle.StateFlag.State_Selected),
                is_hovered=bool(state & QStyle.StateFlag.State_MouseOver),
            )
        elif column >= len(self._table.columns):
            super().paint(painter, option, index)
        else:
            self.painter.paint_background(painter, place)
        self.painter.grid(painter, place, is_section=bool(self._table.rows[row].section))

    def cell_place(self, place: QRect, index: ModelIndex) -> QRect:
        """Return where the value of a cell is; a number of the whole control has not the whole width of its
        cell.
        """
        row = index.row()
        look = self._table.look(row, index.column()) if self._table.is_in_block(row) else None
        is_number = look is not None and (look.is_number or look.kind == "not set")
        return (
            QRect(place.topLeft(), place.bottomLeft() + QPoint(self.number_room - 1, 0))
            if is_number
            else place
        )

    # -- editors -----------------------------------------------------------------

    def createEditor(self, parent: QWidget, option: QStyleOptionViewItem, index: ModelIndex) -> QWidget:
        address: Address = index.data(AddressRole)
        parameter = self._workspace.file.schema.parameters[address[0]]
        if parameter.choices:
            box = ChoiceBox(self._workspace, address, parent)
            box.activated.connect(self._choose)
            box.left.connect(self._close_later)
            box.tabbed.connect(self._tab)
            # After Qt has placed the editor: the list opens below it, not at the corner of the table.
            QTimer.singleShot(0, box, box.showPopup)
            return box
        field = CellEditor(parent, lambda text: self._preview(address, text))
        field.setAccessibleName(self._workspace.file.machine_schema.label(address))
        if parameter.type in ("real", "integer", "format"):
            field.setAlignment(Qt.AlignmentFlag.AlignRight)
        if self._workspace.is_masked(address):
            field.setEchoMode(QLineEdit.EchoMode.Password)
        allowed = allowed_text(self._workspace, address)
        field.setPlaceholderText(allowed)
        if allowed:
            field.setToolTip(self.tr("Allowed here: {range}").format(range=allowed))
        field.keys = self._keys(address)
        return field

    def _keys(self, address: Address) -> tuple[tuple[str, str], ...]:
        view = self.parent()
        count = len(view.cells.addresses()) if hasattr(view, "cells") else 1
        kept = "" if self._workspace.is_masked(address) else self._table.shown_value(address)
        keys = [
            ("Esc", self.tr("keep {value}").format(value=kept)),
            (self.tr("Ctrl+Shift+Enter"), self.tr("force and mark")),
        ]
        fill = [(self.tr("Ctrl+Enter"), self.tr("fill %n cells", "", count))] if count > 1 else []
        return tuple(fill + keys)

    def _preview(self, address: Address, text: str) -> Preview:
        """Return what a text comes to while it is typed;
        what is not readable yet is refused only when it is entered.
        """
        file = self._workspace.file
        try:
            entered = self._workspace.entered(address, text)
        except InvalidValueError:
            return Preview()
        if entered.value is None:
            return Preview()
        result = show_value(file.schema.parameters[address[0]], entered.value) if entered.expression else ""
        problem = fault(file.evaluation, address, entered.value)
        return Preview(result, self.out_of_range(address, problem) if problem else None)

    def out_of_range(self, address: Address, problem: str) -> Refusal:
        """Return the refusal of a value that is out of range: what is allowed, and what the rules want."""
        fixes = (s for f in self._workspace.findings_of(address) for s in f.fix if s.address == address)
        fix = next(fixes, None)
        wanted = ""
        if fix is not None:
            text = show_value(self._workspace.file.schema.parameters[address[0]], fix.value)
            wanted = self.tr("Rules want {value}.").format(value=text)
        can_force = self._workspace.file.schema.parameters[address[0]].access != "read"
        return Refusal(sentence(problem), "", wanted, can_force)

    def _choose(self) -> None:
        box = self.sender()
        assert isinstance(box, ChoiceBox)
        self.commitData.emit(box)
        self._close(box)

    def _tab(self, forward: bool) -> None:
        """Take the choice of an open list and go to the next cell, which opens no list by itself."""
        box, view = self.sender(), self.parent()
        assert isinstance(box, ChoiceBox)
        self.commitData.emit(box)
        self._close(box)
        if isinstance(view, QAbstractItemView):
            key = Qt.Key.Key_Tab if forward else Qt.Key.Key_Backtab
            QApplication.sendEvent(view, QKeyEvent(QEvent.Type.KeyPress, key, Qt.KeyboardModifier.NoModifier))

    def _close_later(self) -> None:
        """Close the editor with its list; a choice is committed before that."""
        box = self.sender()
        assert isinstance(box, ChoiceBox)
        QTimer.singleShot(0, box, lambda: self._close(box))

    def _close(self, box: ChoiceBox) -> None:
        """Close a list that its view has not closed before."""
        view = box.parent().parent()
        if isinstance(view, QAbstractItemView) and view.indexWidget(view.currentIndex()) is box:
            self.closeEditor.emit(box)

    def setEditorData(self, editor: QWidget, index: ModelIndex) -> None:
        if not isinstance(editor, CellEditor) or editor.property("filled"):
            return  # an outside change does not touch what is typed
        editor.setProperty("filled", True)
        refused, self.to_reopen = self.to_reopen, None
        if refused is not None and refused[0] == index.data(AddressRole):
            editor.setText(refused[1])
            # After Qt has placed the editor, below which the frame is.
            QTimer.singleShot(0, editor, lambda: editor.show_refusal(refused[2]))
        else:
            editor.setText(str(index.data(Qt.ItemDataRole.EditRole) or ""))
        self._show_bits(editor, index.data(AddressRole))
        editor.selectAll()

    def _show_bits(self, editor: CellEditor, address: Address) -> None:
        """Show the bits of a word below its editor."""
        parameter, view = self._workspace.file.schema.parameters[address[0]], self.parent()
        if not parameter.bits or not isinstance(view, QWidget):
            return

        def word_of(text: str) -> int | None:
            try:
                value = self._workspace.entered(address, text or "0").value
            except InvalidValueError:
                return None
            return value.value if value is not None and isinstance(value.value, int) else None

        mask = MaskList(parameter, view)
        editor.attach(mask, word_of, lambda word: write_value(parameter, Value(word)))
        QTimer.singleShot(0, editor, lambda: mask.place_below(_place_in(editor, view)))

    def updateEditorGeometry(self, editor: QWidget, option: QStyleOptionViewItem, index: ModelIndex) -> None:
        """Make a list as wide as its longest choice, and a field as wide as its text."""
        rectangle = self.cell_place(option.rect, index)
        wanted = editor.sizeHint().width() if isinstance(editor, ChoiceBox) else _NARROWEST_EDITOR
        rectangle.setWidth(max(rectangle.width(), wanted))
        editor.setGeometry(rectangle)

    def setModelData(self, editor: QWidget, model: QAbstractItemModel, index: ModelIndex) -> None:
        address: Address | None = index.data(AddressRole)
        self.refusal = None
        if address is None:
            return
        if isinstance(editor, ChoiceBox):
            if editor.currentIndex() >= 0:
                self.refusal = self._commit(address, str(editor.currentData()))
        elif isinstance(editor, CellEditor) and editor.text() != str(
            index.data(Qt.ItemDataRole.EditRole) or ""
        ):
            self.refusal = self._commit(address, editor.text())

    def eventFilter(self, editor: QObject, event: QEvent) -> bool:
        if isinstance(editor, ChoiceBox):
            return self._filter_of_choice(editor, event)
        if isinstance(editor, CellEditor) and editor.is_gone:
            return False
        if isinstance(editor, CellEditor) and event.type() == QEvent.Type.KeyPress:
            assert isinstance(event, QKeyEvent)
            if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
                self.ended.emit(event.modifiers().value, editor)
                return True
            if event.key() in (Qt.Key.Key_Tab, Qt.Key.Key_Backtab):
                # Qt goes on to the next cell only where the text was taken.
                return not self.take(editor) or super().eventFilter(editor, event)
        return super().eventFilter(editor, event)

    def _filter_of_choice(self, editor: ChoiceBox, event: QEvent) -> bool:
        if event.type() == QEvent.Type.FocusOut and editor.view().isVisible():
            return False  # the open list takes the focus; the editor must stay
        keys = (Qt.Key.Key_Return, Qt.Key.Key_Enter)
        if event.type() == QEvent.Type.KeyPress and isinstance(event, QKeyEvent) and event.key() in keys:
            self.commitData.emit(editor)  # Qt would do so after the event, when the list may have closed it
            self._close(editor)
            return True
        return super().eventFilter(editor, event)

    def take(self, editor: CellEditor) -> bool:
        """Commit the text of an editor, which stays open with the reason where it is refused;
        returns whether it was taken.
        """
        self.refusal = None
        self.commitData.emit(editor)  # which comes to setModelData
        refusal = self._last_refusal()
        if refusal is not None:
            editor.show_refusal(refusal)
            editor.selectAll()
        return refusal is None

    def _last_refusal(self) -> Refusal | None:
        return self.refusal


def _place_in(editor: QWidget, view: QWidget) -> QRect:
    return QRect(editor.mapTo(view, editor.rect().topLeft()), editor.size())
