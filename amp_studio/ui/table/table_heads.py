"""The heads of the parameter table: number and name of each row, which stay while the axes scroll,
and the letter of each axis.
"""

from __future__ import annotations

from PySide6.QtCore import QEvent, QModelIndex, QRect, QSize, Qt, Signal
from PySide6.QtGui import QFontMetrics, QMouseEvent, QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QHeaderView, QLabel, QTableView, QWidget

from amp_studio.ui.base.theme import COLUMN_HEAD, GAP3, ROW, SMALL_ICON, colour, font, paint_icon
from amp_studio.ui.forms.telling_cut import telling_cut

from .parameter_table import ParameterTable

_MAX_REMEMBERED = 10_000
_LEFT = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter


class RowHeads(QHeaderView):
    """Two columns, No. and Parameter; the name of a section over both. A row with values that are not their
    default has a mark at its beginning, which becomes the way back below the pointer.
    """

    reset_requested = Signal(list)
    """The mark of a row was clicked: its values that are not their default."""

    def __init__(self, table: ParameterTable, parent: QWidget) -> None:
        super().__init__(Qt.Orientation.Vertical, parent)
        self._table = table
        head = font("small")
        head.setWeight(head.Weight.DemiBold)
        fonts = {"head": head, "text": font("text"), "dim": font("small")}
        self._fonts = {
            colour_name: (letters, QFontMetrics(letters)) for colour_name, letters in fonts.items()
        }
        # Eliding measures a text several times: once for each text and width, not in every frame.
        self._elided: dict[tuple[str, str, int], str] = {}
        self._names: frozenset[str] = frozenset()
        """Of the parameters in the table; one is not cut to look like another."""
        self.number_width = 0
        """Width of the column of numbers; 0 where no row has one."""
        self._pointed = -1
        """The row below the pointer."""
        self.row_height = max(ROW, QFontMetrics(font("text")).height() + 6)
        self.setMinimumSectionSize(self.row_height)
        self.setDefaultSectionSize(self.row_height)
        self.setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        self.setSectionsClickable(True)
        self.setHighlightSections(False)
        self.setAccessibleName(self.tr("Parameters"))
        self.setMouseTracking(True)
        table.dataChanged.connect(self._follow)
        table.modelReset.connect(self._forget)

    def _follow(self, first: QModelIndex, last: QModelIndex) -> None:
        """Paint the heads of rows with other values again: a head has the unit of its values."""
        top = self.sectionViewportPosition(first.row())
        end = self.sectionViewportPosition(last.row()) + self.sectionSize(last.row())
        self.viewport().update(0, top, self.viewport().width(), end - top)

    def _forget(self) -> None:
        self._elided.clear()
        self._names = frozenset()

    def sizeHint(self) -> QSize:
        """Return the width that the view has set: Qt would measure a thousand heads after each change."""
        return QSize(self.width(), 0)

    def sectionSizeFromContents(self, section: int) -> QSize:
        return QSize(self.width(), self.row_height)

    def paintSection(self, painter: QPainter, rect: QRect, section: int) -> None:
        table, view = self._table, self.parent()
        assert isinstance(view, QTableView)
        is_section = bool(table.rows[section].section)
        is_current = not is_section and view.currentIndex().row() == section
        background = colour("panel" if is_section else "selidle" if is_current else "base")
        painter.fillRect(rect, background)
        painter.fillRect(rect.left(), rect.bottom(), rect.width(), 1, colour("grid"))
        place = rect.adjusted(GAP3, 0, -6, -1)
        if not is_section and table.off_default(section):
            self._mark(painter, rect, section)
        if is_section:
            self._write(painter, place, table.rows[section].section, "dim", is_head=True)
            return
        painter.fillRect(rect.right(), rect.top(), 1, rect.height(), colour("line"))
        number = QRect(place.left(), place.top(), self.number_width, place.height())
        if self.number_width:
            self._write(painter, number, table.number(section), "dim")
        name = place.adjusted(self.number_width, 0, 0, 0)
        if unit := table.unit_of_row(section):
            wide = self._fonts["dim"][1].horizontalAdvance(unit)
            self._write(painter, QRect(name.right() - wide, name.top(), wide + 1, name.height()), unit, "dim")
            # The unit is written whole: without it the figures of the row have no meaning.
            name.setRight(name.right() - wide - GAP3)
        self._write(painter, name, table.row_name(section), "text")

    def _mark(self, painter: QPainter, rect: QRect, section: int) -> None:
        if section != self._pointed or not self._table.workspace.may_edit:
            painter.fillRect(rect.left(), rect.top(), 3, rect.height() - 1, colour("dim"))
            return
        top = rect.center().y() - SMALL_ICON // 2
        paint_icon(painter, QRect(rect.left(), top, SMALL_ICON, SMALL_ICON), "arrow-u-up-left", colour("sel"))

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        super().mouseMoveEvent(event)
        self._point_at(self.logicalIndexAt(event.position().toPoint()))

    def leaveEvent(self, event: QEvent) -> None:
        super().leaveEvent(event)
        self._point_at(-1)

    def _point_at(self, row: int) -> None:
        # Painted again only when the pointer changes its row, not with each of its moves.
        if row != self._pointed:
            self._pointed = row
            self.viewport().update()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Offer the way back at the mark of a row; elsewhere the row is selected."""
        place = event.position().toPoint()
        # Within the margin that has the mark: a click on a name selects its row.
        row = self.logicalIndexAt(place) if place.x() < GAP3 and self._table.workspace.may_edit else -1
        is_click = event.button() == Qt.MouseButton.LeftButton and row >= 0
        if is_click and (found := self._table.off_default(row)):
            self.reset_requested.emit(found)
            return
        super().mousePressEvent(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        super().paintEvent(event)
        end = self.length() - self.offset()
        if end < self.viewport().height():
            QPainter(self.viewport()).fillRect(
                0, end, self.width(), self.viewport().height() - end, colour("base")
            )

    def _write(
        self, painter: QPainter, place: QRect, text: str, colour_name: str, *, is_head: bool = False
    ) -> None:
        letters, metrics = self._fonts["head" if is_head else colour_name]
        painter.setFont(letters)
        painter.setPen(colour("text" if colour_name == "text" else "dim"))
        key = colour_name, text, place.width()
        elided = self._elided.get(key)
        if elided is None:
            if len(self._elided) > _MAX_REMEMBERED:
                self._elided.clear()
            names = self._names = self._names or frozenset(
                map(self._table.row_name, range(len(self._table.rows)))
            )
            elided = telling_cut(metrics, text, names, place.width())
            self._elided[key] = elided
        painter.drawText(place, _LEFT, elided)


class AxisHeads(QHeaderView):
    """The letter of each axis, and behind it its number and how it moves; a line under the current one."""

    def __init__(self, table: ParameterTable, parent: QWidget) -> None:
        super().__init__(Qt.Orientation.Horizontal, parent)
        self._table = table
        self.setSectionsClickable(True)
        self.setHighlightSections(True)
        self._height = max(COLUMN_HEAD, QFontMetrics(font("text")).height() + 10)
        self.setMinimumSectionSize(56)
        self.setAccessibleName(self.tr("Axes"))

    def sectionSizeFromContents(self, section: int) -> QSize:
        return QSize(self.minimumSectionSize(), self._height)

    def sizeHint(self) -> QSize:
        return QSize(super().sizeHint().width(), self._height)

    def paintSection(self, painter: QPainter, rect: QRect, section: int) -> None:
        view = self.parent()
        assert isinstance(view, QTableView)
        painter.fillRect(rect, colour("panel"))
        painter.fillRect(rect.left(), rect.bottom(), rect.width(), 1, colour("line2"))
        painter.fillRect(rect.right(), rect.top(), 1, rect.height(), colour("grid"))
        if view.currentIndex().column() == section:
            painter.fillRect(rect.left(), rect.bottom() - 1, rect.width() - 1, 2, colour("sel"))
        letter, rest = self._table.column_head(section)
        place = rect.adjusted(8, 0, -6, -2)
        if letter:
            letters = font("text")
            letters.setWeight(letters.Weight.DemiBold)
            painter.setFont(letters)
            painter.setPen(colour("text"))
            elided = QFontMetrics(letters).elidedText(letter, Qt.TextElideMode.ElideRight, place.width())
            painter.drawText(place, _LEFT, elided)
            place.setLeft(place.left() + QFontMetrics(letters).horizontalAdvance(elided) + 6)
        small = font("caption")
        painter.setFont(small)
        painter.setPen(colour("dim"))
        painter.drawText(
            place, _LEFT, QFontMetrics(small).elidedText(rest, Qt.TextElideMode.ElideRight, place.width())
        )


class Corner(QWidget):
    """The heads of the columns No. and Parameter, over the heads of the rows."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.number_width = 0
        self._number, self._name = QLabel(self.tr("No."), self), QLabel(self.tr("Parameter"), self)
        for label in (self._number, self._name):
            label.setFont(font("caption"))
            label.setForegroundRole(self.foregroundRole())
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)

    def paintEvent(self, event: object) -> None:
        painter = QPainter(self)
        painter.fillRect(self.rect(), colour("panel"))
        painter.fillRect(0, self.height() - 1, self.width(), 1, colour("line2"))
        painter.fillRect(self.width() - 1, 0, 1, self.height(), colour("line"))

    def place_words(self) -> None:
        """Put the words over their columns; that of the numbers is there where any row has one."""
        self._number.setVisible(self.number_width > 0)
        self._number.setGeometry(GAP3, 0, self.number_width, self.height() - 1)
        left = GAP3 + self.number_width
        self._name.setGeometry(left, 0, max(0, self.width() - left), self.height() - 1)

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self.place_words()
