"""The list of a parameter's choices: by the beginning of a name, or by letter, as the old editor had it."""

from __future__ import annotations

import re
import unicodedata

from PySide6.QtCore import QElapsedTimer, QEvent, QObject, QPoint, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QComboBox, QListView, QToolTip, QWidget

from amp_studio.schema import Address, Value
from amp_studio.ui.base.workspace import Workspace

_CODE = Qt.ItemDataRole.UserRole + 1
_WORDS = re.compile(r"[\W_]+")
_NO_RANK = 4
"""Rank of a row that does not fit."""
_PAUSE_MS = 1_000
"""Milliseconds after which a typed letter begins a new word."""


def folded(text: str) -> str:
    """Return a text without case and accents."""
    parts = unicodedata.normalize("NFKD", text.casefold())
    return "".join(letter for letter in parts if not unicodedata.combining(letter))


class ChoiceBox(QComboBox):
    """The choices of one address with their letters; ``currentData`` is the label.

    Typing selects and leaves in the open list only what fits. Letters add up, in the open list until
    Backspace takes them away; the same letter again goes to the next one that fits.
    A text that nothing fits leaves the value as it is.
    """

    tabbed = Signal(bool)
    """Tab was pressed in the open list (Shift+Tab: False): the choice is kept."""
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
        key = "" if value is None else _key_of(value)
        keys = [c.key for c in choices]
        self.setPlaceholderText(key or self.tr("not set"))
        self._own = keys.index(key) if key in keys else -1
        """The row of the value."""
        self.setCurrentIndex(self._own)
        self.setMaxVisibleItems(20)
        self._typed, self._since = "", QElapsedTimer()
        self.view().installEventFilter(self)

    def rows_of(self, typed: str) -> list[int]:
        """Return the rows that fit a typed text, best first: beginning of a label, of a word in it, letter,
        part of a label.
        """
        typed, rows = folded(typed), range(self.count())
        ranks = {n: self._rank(n, typed) for n in rows}
        return sorted((n for n in rows if ranks[n] < _NO_RANK), key=ranks.__getitem__)

    def _rank(self, row: int, typed: str) -> int:
        """Return how well a row fits a typed text, 0 best."""
        label = folded(str(self.itemData(row)))
        fits = (
            label.startswith(typed),
            any(word.startswith(typed) for word in _WORDS.split(label)),
            folded(str(self.itemData(row, _CODE))) == typed,
            len(typed) > 1 and typed in label,
        )
        return fits.index(True) if any(fits) else _NO_RANK

    def _typed_so_far(self, letter: str) -> tuple[str, list[int]]:
        """Return what is typed with this letter, and the rows that it is for, the best first."""
        again = bool(self._typed) and (self.view().isVisible() or self._since.elapsed() < _PAUSE_MS)
        typed = self._typed + letter if again else letter
        found = self.rows_of(typed)
        if not found and again and set(folded(typed)) == {folded(letter)}:  # asked for the next one
            typed, found = letter, self.rows_of(letter)
            found.sort(key=lambda n: n <= self.currentIndex())  # those behind it come first
        return typed, found

    def _type(self, letter: str) -> None:
        typed, found = self._typed_so_far(letter)
        self._typed = typed
        self._since.start()
        self.setCurrentIndex(found[0] if found else self._own)  # a typing error never chooses another one
        self._show_only(set(found) if found else None)
        if self.view().isVisible():
            tip = typed if found else self.tr("{typed}: no choice").format(typed=typed)
            QToolTip.showText(self.mapToGlobal(QPoint(0, -30)), tip, self)

    def _show_only(self, rows: set[int] | None) -> None:
        """Leave these rows in the open list; None for all."""
        view = self.view()
        if isinstance(view, QListView):
            for n in range(self.count()):
                view.setRowHidden(n, rows is not None and n not in rows)
        view.setCurrentIndex(self.model().index(self.currentIndex(), 0))
        frame = view.parentWidget()
        if frame is not None and view.isVisible():  # the list is as high as what is left in it
            count = self.count() if rows is None else len(rows)
            height = max(1, min(count, self.maxVisibleItems())) * view.sizeHintForRow(
                max(0, self.currentIndex())
            )
            frame.setFixedHeight(height + 2 * view.frameWidth() + frame.height() - view.height())

    def _select(self, event: QEvent) -> bool:
        if not isinstance(event, QKeyEvent):
            return False
        if event.key() == Qt.Key.Key_Backspace and self._typed:
            typed, self._typed = self._typed[:-1], ""
            self._since.invalidate()
            self.setCurrentIndex(self._own)
            self._show_only(None)
            for letter in typed:
                self._type(letter)
            return True
        if not event.text().isprintable() or not event.text() or (event.text() == " " and not self._typed):
            return False
        self._type(event.text())
        return True

    def _leave_by_tab(self, event: QEvent) -> bool:
        """Take the choice of the open list by Tab, and go on as Tab does."""
        tabs = {Qt.Key.Key_Tab: True, Qt.Key.Key_Backtab: False}
        if not isinstance(event, QKeyEvent) or event.key() not in tabs:
            return False
        chosen = self.view().currentIndex()
        if chosen.isValid() and not self.view().isRowHidden(chosen.row()):  # type: ignore[attr-defined]  # a list
            self.setCurrentIndex(chosen.row())
        self.hidePopup()
        self.tabbed.emit(tabs[Qt.Key(event.key())])
        return True

    def showPopup(self) -> None:
        """Open the list with what fits the letters that were typed just now."""
        super().showPopup()
        if self._typed and self._since.isValid() and self._since.elapsed() < _PAUSE_MS:
            self._show_only(set(self.rows_of(self._typed)) or None)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Select by letter; Enter is left to the form."""
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            event.ignore()
        elif not self._select(event):
            super().keyPressEvent(event)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Select by letter in the open list too, and notice when it closes,
        as not every way calls ``hidePopup``.
        """
        if event.type() == QEvent.Type.KeyPress and (self._leave_by_tab(event) or self._select(event)):
            return True
        if event.type() == QEvent.Type.Hide:
            self.left.emit()
        return super().eventFilter(watched, event)


def _key_of(value: Value) -> str:
    """Return the key of the choice that a value is."""
    if isinstance(value.value, bool):
        return "yes" if value.value else "no"
    return str(value.value)
