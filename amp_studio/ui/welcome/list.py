"""A list of rows with two lines: what something is, and beside it counts, a time, a star."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from PySide6.QtCore import QRect, QSize, Qt, Signal
from PySide6.QtGui import QKeyEvent, QMouseEvent, QPainter
from PySide6.QtWidgets import (
    QFrame,
    QListWidget,
    QListWidgetItem,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QWidget,
)

from amp_studio.ui.base.model_index import ModelIndex
from amp_studio.ui.base.theme import (
    GAP2,
    GAP3,
    ICON,
    SMALL_ICON,
    TWO_LINE_ROW,
    colour,
    font,
    paint_icon,
    severity_colour,
    severity_icon,
)

ROW, KEY = Qt.ItemDataRole.UserRole, Qt.ItemDataRole.UserRole + 1
_ONE_LINE = 29
_SEVERITIES = ("error", "warning", "advice")


@dataclass(frozen=True)
class WelcomeRow:
    """What is painted of one entry."""

    title: str
    second: str = ""
    middle: str = ""
    right: str = ""
    counts: Mapping[str, int] | None = None
    """Severity -> how many; None while it is not known."""
    status: str = ""
    """In the place of the counts: ``no findings``, ``cannot be read``."""
    star: bool | None = None
    """Whether it is pinned; None where nothing can be."""
    opens: bool = False
    """Whether an arrow shows that more comes."""
    words: tuple[str, ...] = field(default=())
    """What is read of it besides."""

    def accessible_text(self) -> str:
        """Return the row as a screen reader reads it."""
        counted = [f"{n} {s}" for s, n in (self.counts or {}).items()]
        return ", ".join(
            filter(
                None, (self.title, self.second, self.middle, *counted, self.status, self.right, *self.words)
            )
        )


class WelcomeList(QListWidget):
    """Rows that are opened by Enter or a click; as high as its rows, the page around it scrolls."""

    star_clicked = Signal(QListWidgetItem)

    def __init__(self, name: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAccessibleName(name)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setItemDelegate(_RowDelegate(self))
        self.setMouseTracking(True)
        self.setVerticalScrollMode(QListWidget.ScrollMode.ScrollPerPixel)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.viewport().setAutoFillBackground(False)

    def add(self, key: object, row: WelcomeRow) -> QListWidgetItem:
        """Add an entry."""
        item = QListWidgetItem()
        item.setData(KEY, key)
        self.show_row(item, row)
        self.addItem(item)
        return item

    def show_row(self, item: QListWidgetItem, row: WelcomeRow) -> None:
        """Show an entry as it is now."""
        item.setData(ROW, row)
        item.setData(Qt.ItemDataRole.AccessibleTextRole, row.accessible_text())
        item.setData(Qt.ItemDataRole.ToolTipRole, "\n".join(row.words))

    def show_rows(self, rows: Iterable[tuple[object, WelcomeRow]]) -> None:
        """Show other entries in the place of those that are there, the current one as before."""
        current = self.currentRow()
        self.clear()
        for key, row in rows:
            self.add(key, row)
        self.setCurrentRow(current)
        self.fit()

    def fit(self) -> None:
        """Be as high as the rows that are shown."""
        heights = (self.sizeHintForRow(n) for n in range(self.count()) if not self.item(n).isHidden())
        self.setFixedHeight(sum(heights) + 1)
        if self.count() and self.currentRow() < 0:
            self.setCurrentRow(0)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Enter opens on every system; the rest is the list's own."""
        # On macOS Enter edits an item and activates none.
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter) and self.currentItem() is not None:
            self.itemActivated.emit(self.currentItem())
            return
        super().keyPressEvent(event)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """A click opens; one on the star pins."""
        super().mouseReleaseEvent(event)
        item = self.itemAt(event.position().toPoint())
        if item is None or event.button() != Qt.MouseButton.LeftButton:
            return
        row: WelcomeRow = item.data(ROW)
        # A larger place than the star, which is hard to hit.
        star = star_place(inner(self.visualItemRect(item)), row).adjusted(-6, -10, 6, 10)
        is_star = row.star is not None and star.contains(event.position().toPoint())
        (self.star_clicked if is_star else self.itemActivated).emit(item)


class _RowDelegate(QStyledItemDelegate):
    """Paints a ``WelcomeRow``."""

    def sizeHint(self, option: QStyleOptionViewItem, index: ModelIndex) -> QSize:
        row: WelcomeRow = index.data(ROW)
        return QSize(120, TWO_LINE_ROW if row.second else _ONE_LINE)

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: ModelIndex) -> None:
        row: WelcomeRow = index.data(ROW)
        place = QRect(option.rect)
        painter.save()
        self._paint_background(painter, option, place)
        place = inner(place)
        place.setRight(self._right(painter, place, row))
        self._left(painter, place, row)
        painter.restore()

    def _paint_background(self, painter: QPainter, option: QStyleOptionViewItem, place: QRect) -> None:
        state = option.state
        # Only with the focus: each of the lists on the page has a current row.
        focused = bool(state & QStyle.StateFlag.State_Selected) and option.widget.hasFocus()
        if focused:
            painter.fillRect(place, colour("selbg"))
            painter.fillRect(QRect(place.left(), place.top(), 2, place.height()), colour("sel"))
        elif state & QStyle.StateFlag.State_MouseOver:
            painter.fillRect(place, colour("hover"))
        painter.setPen(colour("line"))
        painter.drawLine(place.bottomLeft(), place.bottomRight())

    def _right(self, painter: QPainter, place: QRect, row: WelcomeRow) -> int:
        """Paint from the right edge inwards; returns where the left part must end."""
        x = place.right()
        if row.opens:
            paint_icon(
                painter,
                QRect(x - SMALL_ICON, place.center().y() - 7, SMALL_ICON, SMALL_ICON),
                "caret-right",
                colour("dim"),
            )
            x -= SMALL_ICON + GAP2
        if row.star is not None:
            name, colour_name = ("star-fill", colour("text")) if row.star else ("star", colour("dim"))
            paint_icon(painter, star_place(place, row), name, colour_name)
            x -= ICON + GAP3
        painter.setFont(font("small"))
        painter.setPen(colour("dim"))
        if row.right:
            # A column of times: what is left of them begins at the same place in each row.
            width = max(painter.fontMetrics().horizontalAdvance(row.right), 96 if row.star is not None else 0)
            painter.drawText(QRect(x - width, place.top(), width, place.height()), _RIGHT, row.right)
            x -= width + GAP3
        if row.status:
            width = painter.fontMetrics().horizontalAdvance(row.status)
            painter.drawText(QRect(x - width, place.top(), width, place.height()), _RIGHT, row.status)
            x -= width + GAP3
        # From the right edge inwards, so the last one painted is the first one read: errors.
        for severity in reversed(_SEVERITIES):
            if count := (row.counts or {}).get(severity, 0):
                x = _count(painter, x, place, severity, count)
        return x

    def _left(self, painter: QPainter, place: QRect, row: WelcomeRow) -> None:
        middle = place.left() + place.width() * 11 // 20 if row.middle else place.right()
        painter.setPen(colour("text"))
        painter.setFont(font("text", own=bool(row.second)))
        width = middle - place.left() - GAP2
        if row.second:
            upper = QRect(place.left(), place.top() + 4, width, 18)
            painter.drawText(upper, _LEFT, _elided(painter, row.title, width))
            painter.setFont(font("small"))
            painter.setPen(colour("dim"))
            painter.drawText(upper.translated(0, 17), _LEFT, _elided(painter, row.second, width))
        else:
            painter.drawText(
                QRect(place.left(), place.top(), width, place.height()),
                _LEFT,
                _elided(painter, row.title, width),
            )
        if row.middle:
            painter.setFont(font("small"))
            painter.setPen(colour("dim"))
            rest = QRect(middle, place.top(), place.right() - middle, place.height())
            painter.drawText(rest, _LEFT, _elided(painter, row.middle, rest.width()))


_LEFT = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
_RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter


def inner(place: QRect) -> QRect:
    """Return a row without its margins."""
    return place.adjusted(GAP3 - 2, 0, -GAP2, 0)


def star_place(place: QRect, row: WelcomeRow) -> QRect:
    """Return where the star of a row is."""
    x = place.right() - (SMALL_ICON + GAP2 if row.opens else 0)
    return QRect(x - ICON, place.center().y() - ICON // 2, ICON, ICON)


def _count(painter: QPainter, x: int, place: QRect, severity: str, count: int) -> int:
    text = str(count)
    width = painter.fontMetrics().horizontalAdvance(text)
    painter.setPen(severity_colour(severity))
    painter.drawText(QRect(x - width, place.top(), width, place.height()), _RIGHT, text)
    x -= width + 5
    severity_icon(severity).paint(
        painter, QRect(x - SMALL_ICON, place.center().y() - 7, SMALL_ICON, SMALL_ICON)
    )
    return x - SMALL_ICON - GAP2


def _elided(painter: QPainter, text: str, width: int) -> str:
    return painter.fontMetrics().elidedText(text, Qt.TextElideMode.ElideRight, max(width, 0))
