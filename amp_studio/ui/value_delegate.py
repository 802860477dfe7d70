"""Editors in the table's cells: a list for a choice, a field that understands units for a number."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QAbstractItemModel, QEvent, QModelIndex, QObject, QPersistentModelIndex, Qt
from PySide6.QtWidgets import QComboBox, QLineEdit, QStyledItemDelegate, QStyleOptionViewItem, QWidget

from amp_studio.schema import Address

from .parameter_table import AddressRole
from .workspace import Workspace

Index = QModelIndex | QPersistentModelIndex


def choice_box(workspace: Workspace, address: Address, parent: QWidget | None = None) -> QComboBox:
    """Return a list of the choices of an address, with letters and stored codes, the present one selected."""
    box = QComboBox(parent)
    parameter = workspace.file.schema.parameters[address[0]]
    for choice in parameter.choices or ():
        code = f"({choice.code})  " if choice.code else ""
        box.addItem(f"{code}{choice.label}", choice.label)
        if choice.note:
            box.setItemData(box.count() - 1, choice.note, Qt.ItemDataRole.ToolTipRole)
    value = workspace.file.get(address)
    key = None if value is None else ("yes" if value.value is True else "no" if value.value is False else value.value)
    keys = [c.key for c in parameter.choices or ()]
    box.setCurrentIndex(keys.index(str(key)) if key in keys else -1)
    return box


class ValueDelegate(QStyledItemDelegate):
    """Edits a cell by handing the text to ``commit(address, text)``; the model itself is never written."""

    def __init__(self, workspace: Workspace, commit: Callable[[Address, str], None], parent: QObject) -> None:
        super().__init__(parent)
        self._workspace, self._commit = workspace, commit

    def createEditor(self, parent: QWidget, option: QStyleOptionViewItem, index: Index) -> QWidget:
        address: Address = index.data(AddressRole)
        if self._workspace.file.schema.parameters[address[0]].choices:
            box = choice_box(self._workspace, address, parent)
            box.activated.connect(lambda _: (self.commitData.emit(box), self.closeEditor.emit(box)))
            return box
        return QLineEdit(parent)

    def setEditorData(self, editor: QWidget, index: Index) -> None:
        if isinstance(editor, QLineEdit):
            editor.setText(str(index.data(Qt.ItemDataRole.EditRole) or ""))
            editor.selectAll()

    def setModelData(self, editor: QWidget, model: QAbstractItemModel, index: Index) -> None:
        address: Address = index.data(AddressRole)
        if isinstance(editor, QComboBox):
            if editor.currentIndex() >= 0:
                self._commit(address, str(editor.currentData()))
        elif isinstance(editor, QLineEdit) and editor.text() != str(index.data(Qt.ItemDataRole.EditRole) or ""):
            self._commit(address, editor.text())

    def eventFilter(self, editor: QObject, event: QEvent) -> bool:
        if isinstance(editor, QComboBox) and event.type() == QEvent.Type.FocusOut and editor.view().isVisible():
            return False  # the open list takes the focus; the editor must stay
        return super().eventFilter(editor, event)
