"""Editors in the table's cells: a list for a choice, a field that understands units for a number."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import (
    QAbstractItemModel,
    QEvent,
    QModelIndex,
    QObject,
    QPersistentModelIndex,
    QPoint,
    Qt,
    QTimer,
)
from PySide6.QtWidgets import (
    QAbstractItemView,
    QLineEdit,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QToolTip,
    QWidget,
)

from amp_studio.schema import Address, Limits, limits, shown

from .choice_box import ChoiceBox
from .parameter_table import AddressRole
from .workspace import Workspace

Index = QModelIndex | QPersistentModelIndex


def limits_of(workspace: Workspace, address: Address) -> Limits | None:
    """Return the bounds of an address in the unit in which it is typed."""
    return limits(workspace.file.evaluation, address, workspace.typed_unit(address))


def allowed_text(workspace: Workspace, address: Address) -> str:
    """Return the allowed values of an address: ``0 to 214.1 mm``, or the unit alone; empty for a choice."""
    if workspace.file.schema.parameters[address[0]].choices:
        return ""
    found = limits_of(workspace, address)
    return found.text() if found else shown(workspace.typed_unit(address))


class ValueDelegate(QStyledItemDelegate):
    """Edits a cell and passes the text to ``commit(address, text)``; the model itself is never written."""

    def __init__(self, workspace: Workspace, commit: Callable[[Address, str], bool], parent: QObject) -> None:
        super().__init__(parent)
        self._workspace, self._commit = workspace, commit
        self._asking = False
        self.to_mend: tuple[Address, str] | None = None
        """A text that was refused; the next editor of its address begins with it."""

    def createEditor(self, parent: QWidget, option: QStyleOptionViewItem, index: Index) -> QWidget:
        address: Address = index.data(AddressRole)
        if self._workspace.file.schema.parameters[address[0]].choices:
            box = ChoiceBox(self._workspace, address, parent)
            box.activated.connect(self._choose)
            box.left.connect(self._leave)
            QTimer.singleShot(0, box, box.showPopup)
            return box
        field = QLineEdit(parent)
        field.setFrame(False)
        if self._workspace.is_masked(address):
            field.setEchoMode(QLineEdit.EchoMode.Password)
        allowed = allowed_text(self._workspace, address)
        field.setPlaceholderText(allowed)
        if allowed:
            field.setToolTip(f"Allowed here: {allowed}")
            QTimer.singleShot(0, field, lambda: _show_tip_below(field))
        return field

    def _choose(self) -> None:
        box = self.sender()
        assert isinstance(box, ChoiceBox)
        self.commitData.emit(box)
        self._close(box)

    def _leave(self) -> None:
        """Close the editor with its list; a choice is committed before that."""
        box = self.sender()
        assert isinstance(box, ChoiceBox)
        QTimer.singleShot(0, box, lambda: self._close(box))

    def _close(self, box: ChoiceBox) -> None:
        """Close a list that its view has not closed before."""
        view = box.parent().parent()
        if isinstance(view, QAbstractItemView) and view.indexWidget(view.currentIndex()) is box:
            self.closeEditor.emit(box)

    def setEditorData(self, editor: QWidget, index: Index) -> None:
        if isinstance(editor, QLineEdit):
            refused, self.to_mend = self.to_mend, None
            is_refused = refused is not None and refused[0] == index.data(AddressRole)
            editor.setText(
                refused[1] if refused and is_refused else str(index.data(Qt.ItemDataRole.EditRole) or "")
            )
            editor.selectAll()

    def updateEditorGeometry(self, editor: QWidget, option: QStyleOptionViewItem, index: Index) -> None:
        """Make a list as wide as its longest choice, and a field as wide as its text."""
        rectangle = option.rect
        wanted = editor.sizeHint().width() if isinstance(editor, ChoiceBox) else 130
        rectangle.setWidth(max(rectangle.width(), wanted))
        editor.setGeometry(rectangle)

    def setModelData(self, editor: QWidget, model: QAbstractItemModel, index: Index) -> None:
        """Commit once: a question of the commit takes the focus from the editor, which would commit again."""
        address: Address = index.data(AddressRole)
        if self._asking or address is None:
            return
        self._asking = True
        try:
            if isinstance(editor, ChoiceBox):
                if editor.currentIndex() >= 0:
                    self._commit(address, str(editor.currentData()))
            elif isinstance(editor, QLineEdit) and editor.text() != str(
                index.data(Qt.ItemDataRole.EditRole) or ""
            ):
                self._commit(address, editor.text())
        finally:
            self._asking = False

    def eventFilter(self, editor: QObject, event: QEvent) -> bool:
        if (
            isinstance(editor, ChoiceBox)
            and event.type() == QEvent.Type.FocusOut
            and editor.view().isVisible()
        ):
            return False  # the open list takes the focus; the editor must stay
        return super().eventFilter(editor, event)


def _show_tip_below(field: QLineEdit) -> None:
    if field.isVisible():
        QToolTip.showText(field.mapToGlobal(QPoint(0, field.height() - 12)), field.toolTip(), field)
