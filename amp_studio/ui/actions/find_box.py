"""The find box of the tool bar: one question over numbers, names, values, messages and commands,
answered at each key.

The list below it is a part of the window that never takes the focus, so the cursor stays where one types.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Sequence

from PySide6.QtCore import QModelIndex, QPoint, QSize, Qt, Signal
from PySide6.QtGui import (
    QAccessible,
    QAccessibleAnnouncementEvent,
    QFocusEvent,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QResizeEvent,
)
from PySide6.QtWidgets import QFrame, QLabel, QLineEdit, QListView, QWidget

from amp_studio.ui.base.layout import in_column
from amp_studio.ui.base.theme import GAP, GAP2, colour, font, icon

from .find_rows import FindDelegate, FindRow, FindRows

COMMANDS = ">"
"""What a question begins with that is about commands alone."""
_WIDE, _SHARE = 640, 0.7
"""Width of the list, and the part of the window that it may be high."""
_KEY_ROOM = 110
"""Room in pixels for the icon and the key beside the words of an empty box."""
_ICON_ROOM = 72
"""Room in pixels beside the words alone."""
_STEPS = {Qt.Key.Key_Up: -1, Qt.Key.Key_Down: 1, Qt.Key.Key_PageUp: -8, Qt.Key.Key_PageDown: 8}


class FindBox(QLineEdit):
    """Asks at each key; Enter goes to the chosen row, Escape closes the list, and again leaves the box."""

    chosen = Signal(object)
    """The row that was chosen; the list is closed by then."""
    entered = Signal()
    """The cursor came here."""
    left = Signal()
    """Escape in a box whose list is closed: back to the table."""

    def __init__(self, ask: Callable[[str], Sequence[FindRow]], window: QWidget) -> None:
        """Make the box of a window; ``ask`` gives the rows of a question."""
        super().__init__()
        self._ask = ask
        self._show_hint()
        self.setAccessibleName(self.tr("Find"))
        self.setAccessibleDescription(
            self.tr("Type a number, a name, a value or a message of the control; > lists commands")
        )
        self.setToolTip(self.tr("Find (Ctrl+K); > commands (Ctrl+Shift+P)"))
        self.setClearButtonEnabled(True)
        self.addAction(icon("magnifying-glass", "dim"), QLineEdit.ActionPosition.LeadingPosition)
        self.model = FindRows()
        self._popup = QFrame(window)
        self._popup.setObjectName("find-popup")
        self._popup.setFrameShape(QFrame.Shape.NoFrame)
        self._popup.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.list = QListView()
        self.list.setModel(self.model)
        self.list.setItemDelegate(FindDelegate(self.list))
        self.list.setAccessibleName(self.tr("Found"))
        self.list.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.list.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.list.setMouseTracking(True)
        self.list.entered.connect(self.list.setCurrentIndex)
        self.list.clicked.connect(self._choose)
        self._footer = QLabel(self.tr("↑ ↓ choose    Enter go there    Esc close    > commands"))
        self._footer.setFont(font("caption"))
        self._footer.setContentsMargins(GAP2 + GAP, GAP, GAP2, GAP)
        in_column(self.list, self._footer, on=self._popup, margins=(1, GAP, 1, 1), gap=0)
        self._popup.hide()
        self._window = window
        self._selects = False
        """Whether the click that is under way selects the whole question."""
        self._is_to_choose = False
        """Whether Enter was pressed before there was an answer: the best of it is chosen then."""
        self._was_here = False
        """Whether the cursor was here before the click: Qt gives the focus before the click."""
        self.textEdited.connect(self._edited)
        self.textChanged.connect(self._emptied)

    # -- asking ----------------------------------------------------------------------

    def begin(self, text: str | None = None) -> None:
        """Put the cursor here; with a text ask that, else the present question can be typed over."""
        self.setFocus(Qt.FocusReason.ShortcutFocusReason)
        if text is None:
            self.selectAll()
        else:
            self.setText(text)
        if self.text():
            self.search()

    def _edited(self, *_: object) -> None:
        self._is_to_choose = False
        self.search()

    def search(self) -> None:
        """Ask the present question and show the rows; nothing is shown for an empty one."""
        if not self.text().strip():
            self.close_list()
            return
        self.model.show_rows(self._ask(self.text()))
        self._mark(self.model.next_row(-1, 1))
        self._place()
        self._popup.show()
        self._popup.raise_()
        found = sum(not row.is_head for row in self.model.rows)
        self._announce(self.tr("%n found", "", found))
        if self._is_to_choose and not self._waits:
            self._choose()

    @property
    def _waits(self) -> bool:
        return bool(self.model.rows) and self.model.rows[0].waits

    @property
    def is_open(self) -> bool:
        """Whether the list is shown."""
        return not self._popup.isHidden()

    def close_list(self) -> None:
        """Hide the list; the question stays. A window that goes takes the list away
        before this field loses the focus.
        """
        self._is_to_choose = False
        with contextlib.suppress(RuntimeError):
            self._popup.hide()

    def _emptied(self, text: str) -> None:
        if not text:
            self.close_list()

    def _place(self) -> None:
        """Put the list below the box, as high as its rows, within the window."""
        corner = self.mapTo(self._window, QPoint(0, self.height() + 2))
        width = min(max(self.width(), _WIDE), self._window.width() - 2 * GAP2)
        left = max(GAP2, min(corner.x(), self._window.width() - width - GAP2))
        rows = range(self.model.rowCount())
        wanted = (
            sum(self.list.sizeHintForRow(n) for n in rows) + self._footer.sizeHint().height() + 2 * GAP + 4
        )
        most = int(self._window.height() * _SHARE)
        self._popup.setGeometry(left, corner.y(), width, min(wanted, most))

    # -- choosing ----------------------------------------------------------------------

    def _mark(self, row: int) -> None:
        self.list.setCurrentIndex(self.model.index(row) if row >= 0 else QModelIndex())

    def _announce(self, text: str) -> None:
        """Let a screen reader speak a text, as the list never has the focus."""
        if QAccessible.isActive():
            QAccessible.updateAccessibility(QAccessibleAnnouncementEvent(self, text))

    def _choose(self, *_: object) -> None:
        index = self.list.currentIndex()
        row = self.model.rows[index.row()] if index.isValid() and self.is_open else None
        if row is None or row.is_head:
            return
        if row.instead:
            self.begin(row.instead)
            return
        self.close_list()
        self.chosen.emit(row)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Move in the list while the cursor stays here."""
        key = Qt.Key(event.key())
        if key in _STEPS:
            if not self.is_open:
                self.search()
            elif self.model.rows:
                self._mark(self.model.next_row(self.list.currentIndex().row(), _STEPS[key]))
                self._announce(str(self.list.currentIndex().data() or ""))
        elif key in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            if not self.is_open:
                self.search()
            self._is_to_choose = self._waits
            self._choose()
        elif key == Qt.Key.Key_Escape:
            if self.is_open:
                self.close_list()
            else:
                self.clear()
                self.left.emit()
        else:
            super().keyPressEvent(event)

    def focusInEvent(self, event: QFocusEvent) -> None:
        super().focusInEvent(event)
        self._was_here = event.reason() != Qt.FocusReason.MouseFocusReason
        self.entered.emit()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Select the old question at the click that comes here, so that the next is typed over it."""
        is_new = not self._was_here
        super().mousePressEvent(event)
        self._selects, self._was_here = is_new, True

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Leave a selection that was dragged."""
        super().mouseReleaseEvent(event)
        if self._selects and not self.hasSelectedText():
            self.selectAll()
        self._selects = False

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        self._was_here = False
        if event.reason() != Qt.FocusReason.PopupFocusReason:  # the menu of this field
            self.close_list()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep the list below the box, which changes its size with the window."""
        super().resizeEvent(event)
        self._show_hint()
        if self.is_open:
            self._place()

    def _show_hint(self) -> None:
        """Show what can be found here, in one word where there is room for no more."""
        hint = self.tr("Find a parameter, value, message or command")
        is_wide = self.fontMetrics().horizontalAdvance(hint) + _ICON_ROOM <= self.width()
        self.setPlaceholderText(hint if is_wide else self.tr("Find"))

    def sizeHint(self) -> QSize:
        return QSize(320, super().sizeHint().height())

    def minimumSizeHint(self) -> QSize:
        return QSize(120, super().minimumSizeHint().height())

    def paintEvent(self, event: QPaintEvent) -> None:
        """Show the key at the right while nothing is typed."""
        super().paintEvent(event)
        wanted = self.fontMetrics().horizontalAdvance(self.placeholderText()) + _KEY_ROOM
        if self.text() or self.hasFocus() or self.width() < wanted:
            return
        painter = QPainter(self)
        painter.setFont(font("caption"))
        painter.setPen(colour("dim"))
        place = self.rect().adjusted(0, 0, -GAP2, 0)
        painter.drawText(
            place, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter, self.tr("Ctrl K")
        )
        painter.end()
