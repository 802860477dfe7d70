"""The list of a parameter's choices: by letter, as the old editor had it, or by the beginning of a name."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QComboBox, QWidget

from amp_studio.schema import Address

from .workspace import Workspace

_CODE = Qt.ItemDataRole.UserRole + 1


class ChoiceBox(QComboBox):
    """The choices of one address with their letters; ``currentData`` is the label. Typing a letter selects."""

    left = Signal()
    """The open list was closed, with or without a choice."""

    def __init__(self, workspace: Workspace, address: Address, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        choices = workspace.file.schema.parameters[address[0]].choices or ()
        for choice in choices:
            self.addItem(f"({choice.code})  {choice.label}" if choice.code else choice.label, choice.label)
            self.setItemData(self.count() - 1, choice.code or "", _CODE)
            if choice.note:
                self.setItemData(self.count() - 1, choice.note, Qt.ItemDataRole.ToolTipRole)
        value = workspace.file.get(address)
        current = None if value is None else value.value
        key = (
            ""
            if current is None
            else "yes"
            if current is True
            else "no"
            if current is False
            else str(current)
        )
        keys = [c.key for c in choices]
        self.setPlaceholderText(key or "not set")
        self.setCurrentIndex(keys.index(key) if key in keys else -1)
        self.setMaxVisibleItems(20)
        self.view().installEventFilter(self)

    def row_of(self, typed: str) -> int:
        """Return the row of the next choice with this letter or beginning, -1 when there is none."""
        typed, rows, here = typed.casefold(), range(self.count()), self.currentIndex()
        letters = [n for n in rows if str(self.itemData(n, _CODE)).casefold() == typed]
        names = [n for n in rows if str(self.itemData(n)).casefold().startswith(typed)]
        found = letters or names
        return next((n for n in found if n > here), found[0] if found else -1)

    def _select(self, event: QEvent) -> bool:
        if not isinstance(event, QKeyEvent) or not event.text().strip() or not event.text().isprintable():
            return False
        row = self.row_of(event.text())
        if row >= 0:
            self.setCurrentIndex(row)
            self.view().setCurrentIndex(self.model().index(row, 0))
        return True

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Select by letter; Enter is left to the form."""
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            event.ignore()
        elif not self._select(event):
            super().keyPressEvent(event)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Select by letter in the open list too, and notice when it closes, as not every way calls ``hidePopup``."""
        if event.type() == QEvent.Type.KeyPress and self._select(event):
            return True
        if event.type() == QEvent.Type.Hide:
            self.left.emit()
        return super().eventFilter(watched, event)
