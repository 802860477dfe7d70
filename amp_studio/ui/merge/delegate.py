"""Paints the tree of a comparison: circles that take a side, bars and words of conflicts, units apart;
edits the result.
"""

from __future__ import annotations

from PySide6.QtCore import QAbstractItemModel, QEvent, QObject, QRect, QSize, Qt, Signal
from PySide6.QtGui import QFont, QFontMetrics, QKeyEvent, QPainter
from PySide6.QtWidgets import (
    QAbstractItemDelegate,
    QCompleter,
    QLineEdit,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QToolTip,
    QTreeView,
    QWidget,
)

from amp_studio.files import Row, RowGroup, Typed
from amp_studio.ui.base.model_index import ModelIndex
from amp_studio.ui.base.theme import ROW, SMALL_ICON, Token, colour, font, paint_icon

from .columns import AXIS, BASE, NAME, RESULT, SIDES, A, B
from .model import MergeModel

_LEFT = 10
_MARK = 24
"""Room for the circle of a side."""
_DONE = (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Tab)


class MergeDelegate(QStyledItemDelegate):
    """Paints groups and rows; a value that is refused keeps its editor open and shows what is allowed."""

    typed = Signal(object, object)
    """A row and what was typed for its result."""
    refused = Signal(str)
    """Why a typed text cannot be the result."""

    def __init__(self, model: MergeModel, parent: QTreeView) -> None:
        super().__init__(parent)
        self._model, self._view = model, parent
        self._plain, self._small, self._own = font("text"), font("small"), font("text", own=True)
        self._head = QFont(self._small)
        self._head.setWeight(QFont.Weight.DemiBold)

    def sizeHint(self, option: QStyleOptionViewItem, index: ModelIndex) -> QSize:
        return QSize(40, ROW)

    # -- painting --------------------------------------------------------------------

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: ModelIndex) -> None:
        painter.save()
        place = QRect(option.rect)
        row, group = self._model.row_at(index), self._model.group_at(index)
        is_selected = bool(option.state & QStyle.StateFlag.State_Selected)
        is_active = bool(option.state & QStyle.StateFlag.State_Active)
        background: Token = (
            ("selbg" if is_active else "selidle") if is_selected else "panel" if group else "base"
        )
        painter.fillRect(place, colour(background))
        painter.setPen(colour("grid"))
        painter.drawLine(place.bottomLeft(), place.bottomRight())
        if group is not None:
            self._paint_group(painter, place, group, index.column())
        elif row is not None:
            painter.drawLine(place.topRight(), place.bottomRight())
            self._paint_row(painter, place, row, index.column())
        painter.restore()

    def _paint_group(self, painter: QPainter, place: QRect, group: RowGroup, column: int) -> None:
        if column in (NAME, AXIS, BASE):  # one text over what is left free by columns without a value
            painter.setClipRect(place)
            head = self._view.header()
            end = head.sectionViewportPosition(A) - 8
            start = head.sectionViewportPosition(NAME) + self._view.indentation() + 2
            room = QRect(start, place.top(), max(end - start, 0), place.height())
            title, _, counts = self._model.group_text(group).rpartition("  ")
            # The counts differ from group to group: a title without room loses the area before its own name.
            wide = QFontMetrics(self._small).horizontalAdvance(counts) + 8
            if QFontMetrics(self._head).horizontalAdvance(title) + wide > room.width():
                title = title.rpartition(": ")[2]
            used = self._write(painter, room.adjusted(0, 0, -wide, 0), title, self._head, "text")
            self._write(painter, room.adjusted(used + 8, 0, 0, 0), counts, self._small, "dim")
        elif column in (A, B) and any(row.kind != "same" for row in group.rows):
            self._write(painter, place.adjusted(_LEFT, 0, -4, 0), self.tr("Take all"), self._small, "sel")

    def _paint_row(self, painter: QPainter, place: QRect, row: Row, column: int) -> None:
        is_open = self._model.merge.choice(row) is None
        if column == NAME:
            if is_open:
                painter.fillRect(QRect(0, place.top(), 3, place.height() - 1), colour("warn"))
            number = self._model.number(row)
            room = place.adjusted(4, 0, -4, 0)
            taken = max(self._write(painter, room, number, self._small, "dim"), 52) if number else 0
            self._write(painter, room.adjusted(taken, 0, 0, 0), self._model.name(row), self._plain, "text")
        elif column == AXIS:
            self._paint_tag(painter, place, self._model.axis(row))
        elif column == RESULT:
            self._paint_result(painter, place, row, is_open)
        else:
            self._paint_side(painter, place, row, column)

    def _paint_tag(self, painter: QPainter, place: QRect, text: str) -> None:
        if not text:
            return
        width = QFontMetrics(self._head).horizontalAdvance(text) + 10
        tag = QRect(place.left() + 6, place.top() + 4, min(width, place.width() - 10), place.height() - 9)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(colour("hover"))
        painter.drawRoundedRect(tag, 3, 3)
        painter.setPen(colour("text"))
        painter.setFont(self._head)
        painter.drawText(tag, Qt.AlignmentFlag.AlignCenter, self._elided(self._head, text, tag.width() - 4))

    def _paint_side(self, painter: QPainter, place: QRect, row: Row, column: int) -> None:
        merge, side = self._model.merge, SIDES[column]
        differs, is_of_base = row.kind != "same", column == BASE
        is_taken = differs and merge.choice(row) == side
        if differs and (is_taken or not is_of_base):
            circle = QRect(place.left() + _LEFT, place.top(), SMALL_ICON, place.height())
            name, tint = ("check-circle-fill", colour("sel")) if is_taken else ("circle", colour("dim"))
            paint_icon(painter, _square(circle), name, tint)
        left = _LEFT if is_of_base and not is_taken else _LEFT + _MARK
        is_own = differs and not is_of_base and self._changed(row, column)
        cell = self._model.cell(row, column)
        self._value(
            painter,
            place.adjusted(left, 0, -6, 0),
            cell.text,
            cell.unit,
            "text" if is_own else "dim",
            own=is_own,
        )

    def _changed(self, row: Row, column: int) -> bool:
        """Return whether a side changed its value; without a base both did."""
        own = {A: ("a", "both", "conflict", "different"), B: ("b", "both", "conflict", "different")}
        return row.kind in own[column] or self._model.merge.base is None

    def _paint_result(self, painter: QPainter, place: QRect, row: Row, is_open: bool) -> None:
        room = place.adjusted(_LEFT, 0, -6, 0)
        if is_open:
            mark = QRect(room.left(), room.top(), SMALL_ICON, room.height())
            paint_icon(painter, _square(mark), "warning-fill", colour("warn"))
            text = self.tr("Both changed: choose")
            self._write(painter, room.adjusted(SMALL_ICON + 6, 0, 0, 0), text, self._own, "warn")
            return
        cell = self._model.cell(row, RESULT)
        is_own = row.kind != "same"
        left = self._value(painter, room, cell.text, cell.unit, "text" if is_own else "dim", own=is_own)
        choice = self._model.merge.choice(row)
        note = self.tr("typed") if isinstance(choice, Typed) else ""
        if row.kind == "conflict":
            note = self.tr("conflict settled") if not note else self.tr("typed, conflict settled")
        if self._model.is_refitted(row):
            note = self.tr("unit follows the axis")
        self._write(painter, room.adjusted(left + 10, 0, 0, 0), note, self._small, "dim")

    def _value(
        self, painter: QPainter, room: QRect, text: str, unit: str, colour_name: Token, *, own: bool
    ) -> int:
        """Paint a value with its unit in the second ink; returns how wide it is."""
        gap = 0 if unit == "°" else 4
        kept = gap + QFontMetrics(self._small).horizontalAdvance(unit) + 3 if unit else 0
        if kept > room.width() // 2:
            kept = 0
        used = self._write(
            painter, room.adjusted(0, 0, -kept, 0), text, self._own if own else self._plain, colour_name
        )
        if kept:
            used += gap + self._write(painter, room.adjusted(used + gap, 0, 0, 0), unit, self._small, "dim")
        return used

    def _write(self, painter: QPainter, room: QRect, text: str, face: QFont, colour_name: Token) -> int:
        """Paint a text, elided where there is no room; returns how wide it is."""
        if not text or room.width() < 8:
            return 0
        text = self._elided(face, text, room.width())
        painter.setFont(face)
        painter.setPen(colour(colour_name))
        painter.drawText(room, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft, text)
        return QFontMetrics(face).horizontalAdvance(text)

    @staticmethod
    def _elided(face: QFont, text: str, width: int) -> str:
        return QFontMetrics(face).elidedText(" ".join(text.split("\n")), Qt.TextElideMode.ElideRight, width)

    # -- editing the result ------------------------------------------------------------

    def createEditor(self, parent: QWidget, option: QStyleOptionViewItem, index: ModelIndex) -> QWidget:
        row = self._model.row_at(index)
        field = QLineEdit(parent)
        field.setAccessibleName(self.tr("Result"))
        if row is not None and row.id.part == "value":
            parameter = self._model.merge.a.schema.parameters[row.address[0]]
            if parameter.secret and not self._model.secrets:
                field.setEchoMode(QLineEdit.EchoMode.Password)
            if parameter.choices:
                completer = QCompleter([choice.label for choice in parameter.choices], field)
                completer.setCaseSensitivity(Qt.CaseSensitivity.CaseInsensitive)
                completer.setFilterMode(Qt.MatchFlag.MatchContains)
                completer.setCompletionMode(QCompleter.CompletionMode.PopupCompletion)
                field.setCompleter(completer)
        return field

    def setEditorData(self, editor: QWidget, index: ModelIndex) -> None:
        if isinstance(editor, QLineEdit):
            editor.setText(str(index.data(Qt.ItemDataRole.EditRole) or ""))
            editor.selectAll()

    def setModelData(self, editor: QWidget, model: QAbstractItemModel, index: ModelIndex) -> None:
        row = self._model.row_at(index)
        if isinstance(editor, QLineEdit) and row is not None and editor.isModified():
            try:
                self.typed.emit(row, self._model.read(row, editor.text()))
            except ValueError:
                return  # it was refused in words, and the person left it

    def eventFilter(self, editor: QObject, event: QEvent) -> bool:
        """Keep the editor open for a value that is refused, and show why; Escape keeps the old one."""
        is_done = (
            isinstance(event, QKeyEvent) and event.type() == QEvent.Type.KeyPress and event.key() in _DONE
        )
        if not (is_done and isinstance(editor, QLineEdit)):
            return super().eventFilter(editor, event)
        refused = self._refusal(editor.text()) if editor.isModified() else ""
        if refused:
            QToolTip.showText(editor.mapToGlobal(editor.rect().bottomLeft()), refused, editor)
            editor.setAccessibleDescription(refused)
            self.refused.emit(refused)
            return True
        self.commitData.emit(editor)
        self.closeEditor.emit(editor, QAbstractItemDelegate.EndEditHint.NoHint)
        return True

    def _refusal(self, text: str) -> str:
        """Return why a text cannot be the result of the row that is edited; empty where it can."""
        row = self._model.row_at(self._view.currentIndex())
        if row is None:
            return ""
        try:
            self._model.read(row, text)
        except ValueError as error:
            return str(error)
        return ""


def _square(place: QRect) -> QRect:
    """Return the square in the middle of a narrow rectangle."""
    return QRect(place.left(), place.center().y() - SMALL_ICON // 2, SMALL_ICON, SMALL_ICON)
