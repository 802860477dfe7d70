"""The tree of the left panel: places of the file, each with its state,
its findings and how many values it has open.
"""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QRect, QSize, Qt, Signal
from PySide6.QtGui import QFontMetrics, QKeyEvent, QPainter, QPalette
from PySide6.QtWidgets import QStyle, QStyledItemDelegate, QStyleOptionViewItem, QTreeWidget, QWidget

from amp_studio.ui.base.model_index import ModelIndex
from amp_studio.ui.base.theme import (
    GAP,
    GAP2,
    ROW,
    SMALL_ICON,
    Token,
    colour,
    font,
    paint_icon,
    severity_mark,
)

Counts = tuple[tuple[str, int], ...]
"""Findings by severity, the worst first."""
_USER = Qt.ItemDataRole.UserRole
KEY, PICTURE, COUNTS, RIGHT, TOKEN = (Qt.ItemDataRole(_USER + n) for n in range(5))
"""What an item is; its icon (name and ink); its findings (severity, how many); the text at its right;
its ink."""
_BAR = 2
"""Width of the bar at the left of the selected place."""
_MIN_TITLE = 80
"""Width in pixels that a title keeps, or its own: beside hundreds of findings one letter was left."""
_MORE = "…"
"""Instead of the findings that have no room; the tip of a step has all."""


class PlaceTree(QTreeWidget):
    """A tree of one visible column, whose rows go from edge to edge."""

    toggled = Signal(object)
    """Space was pressed on this item."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setHeaderHidden(True)
        self.setUniformRowHeights(True)
        self.setIndentation(GAP2 * 2)
        self.setMouseTracking(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.viewport().setBackgroundRole(QPalette.ColorRole.AlternateBase)
        self.setFrameShape(QTreeWidget.Shape.NoFrame)
        self.setItemDelegate(_PlaceDelegate(self))

    def drawBranches(self, painter: QPainter, rect: QRect, index: ModelIndex) -> None:
        """Paint the ground as far as the left edge, and the caret of a place that has others below it."""
        painter.fillRect(rect, colour(_background(self, index, self._is_hovered(index))))
        if self.selectionModel().isSelected(index):
            painter.fillRect(QRect(rect.left(), rect.top(), _BAR, rect.height()), colour("sel"))
        if self.model().hasChildren(index):
            caret = "caret-down" if self.isExpanded(index) else "caret-right"
            side = QRect(rect.right() - self.indentation() + 1, rect.top(), self.indentation(), rect.height())
            paint_icon(painter, side.adjusted(3, 7, -3, -7), caret, colour("dim"))

    def _is_hovered(self, index: ModelIndex) -> bool:
        return self.indexAt(self.viewport().mapFromGlobal(self.cursor().pos())) == index

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter) and self.currentItem() is not None:
            self.itemActivated.emit(self.currentItem(), 0)
        elif event.key() == Qt.Key.Key_Space and self.currentItem() is not None:
            self.toggled.emit(self.currentItem())
        else:
            super().keyPressEvent(event)


def _background(tree: QTreeWidget, index: ModelIndex, is_hovered: bool) -> Token:
    if tree.selectionModel().isSelected(index):
        # Bright only while it has the keyboard.
        return "selbg" if tree.hasFocus() else "selidle"
    return "hover" if is_hovered else "panel"


def counts_with_room(
    counts: Counts, title: int, room: int, width_of: Callable[[str], int]
) -> tuple[Counts, bool]:
    """Return the findings that are shown in ``room`` pixels beside a title of ``title`` pixels, the worst
    first, and whether some are left out.
    """
    least = min(title, _MIN_TITLE)
    kept = counts
    # The worst severity always stays; the others give room to the title from the least one on.
    while len(kept) > 1:
        used = sum(width_of(str(count)) + 3 + SMALL_ICON + GAP for _, count in kept)
        used += width_of(_MORE) + GAP if kept != counts else 0
        if room - used >= least:
            break
        kept = kept[:-1]
    return kept, kept != counts


class _PlaceDelegate(QStyledItemDelegate):
    """Paints a place: icon, title, findings, count."""

    def __init__(self, tree: PlaceTree) -> None:
        super().__init__(tree)
        self._tree = tree

    def sizeHint(self, option: QStyleOptionViewItem, index: ModelIndex) -> QSize:
        return QSize(120, ROW)

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: ModelIndex) -> None:
        painter.save()
        place: QRect = option.rect
        is_hovered = bool(option.state & QStyle.StateFlag.State_MouseOver)
        painter.fillRect(place, colour(_background(self._tree, index, is_hovered)))
        left, right = place.left() + GAP, place.right() - GAP2
        picture = index.data(PICTURE)
        if picture:
            _icon_at(painter, left, place, *picture)
            left += SMALL_ICON + GAP2
        right = self._right_text(painter, place, right, index.data(RIGHT))
        colour_name: Token = index.data(TOKEN) or "text"
        # A head between places, as "Procedures".
        is_small = colour_name == "dim" and not picture and index.data(KEY) is None
        face, small = font("small") if is_small else font(), QFontMetrics(font("small"))
        title = QFontMetrics(face).horizontalAdvance(index.data() or "")
        counts, is_cut = counts_with_room(
            index.data(COUNTS) or (), title, right - left - GAP, small.horizontalAdvance
        )
        right = self._right_text(painter, place, right, _MORE if is_cut else None, least=0)
        right = self._counts(painter, place, right, counts)
        painter.setFont(face)
        painter.setPen(colour(colour_name))
        room = QRect(left, place.top(), max(0, right - left - GAP), place.height())
        text = painter.fontMetrics().elidedText(index.data() or "", Qt.TextElideMode.ElideRight, room.width())
        painter.drawText(room, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft, text)
        painter.restore()

    def _right_text(
        self, painter: QPainter, place: QRect, right: int, text: str | None, least: int = 22
    ) -> int:
        if not text:
            return right
        painter.setFont(font("small"))
        painter.setPen(colour("dim"))
        width = max(QFontMetrics(font("small")).horizontalAdvance(text), least)
        painter.drawText(
            QRect(right - width, place.top(), width, place.height()),
            Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight,
            text,
        )
        return right - width - GAP

    def _counts(self, painter: QPainter, place: QRect, right: int, counts: Counts) -> int:
        painter.setFont(font("small"))
        for severity, count in reversed(counts):
            name, colour_name = severity_mark(severity)
            text = str(count)
            width = painter.fontMetrics().horizontalAdvance(text)
            painter.setPen(colour(colour_name))
            painter.drawText(
                QRect(right - width, place.top(), width, place.height()),
                Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight,
                text,
            )
            right -= width + 3
            _icon_at(painter, right - SMALL_ICON, place, name, colour_name)
            painter.setFont(font("small"))
            right -= SMALL_ICON + GAP
        return right


def _icon_at(painter: QPainter, left: int, place: QRect, name: str, colour_name: Token) -> None:
    top = place.top() + (place.height() - SMALL_ICON) // 2
    paint_icon(painter, QRect(left, top, SMALL_ICON, SMALL_ICON), name, colour(colour_name))
