"""Paints a cell of the table. Nothing is asked of the file here:
a frame of a scrolling table has 16 ms for all cells.
"""

from __future__ import annotations

from math import ceil

from PySide6.QtCore import QPoint, QRect, QRectF, Qt
from PySide6.QtGui import QBrush, QColor, QFont, QFontMetricsF, QPainter, QPen

from amp_studio.ui.base.theme import SMALL_ICON, Token, colour, font, is_dark, paint_icon

from .cell_look import CellLook

_SEVERITIES: dict[str, tuple[Token, Token, str]] = {
    "error": ("error", "errorbg", "x-circle-fill"),
    "warning": ("warn", "warnbg", "warning-fill"),
    "advice": ("rec", "recbg", "lightbulb-fill"),
}
_TOKENS: tuple[Token, ...] = (
    "grid",
    "panel",
    "hover",
    "selbg",
    "selidle",
    "sel",
    "edge",
    "text",
    "dim",
    "line",
    "line2",
    "chg",
    "error",
    "errorbg",
    "warn",
    "warnbg",
    "rec",
    "recbg",
)
_ASIDE = 8
"""Room at both ends of a cell."""
_RIGHT, _LEFT = (
    Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter,
    Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter,
)
_NAMES = 44
"""Room that the names of a mask have at least, or its number is left out."""
_MAX_REMEMBERED = 20_000


class CellPainter:
    """Fonts, colours and measured texts of one table."""

    def __init__(self) -> None:
        self.unit_slots: list[int] = []
        """Width of the slot of units of each column: that of its widest unit."""
        self.is_active = True
        """Whether the table has the focus."""
        self._own, self._plain, self._small = font("text", own=True), font("text"), font("small")
        self._italic = QFont(self._plain)
        self._italic.setItalic(True)
        self._metrics = {id(f): QFontMetricsF(f) for f in (self._own, self._plain, self._small, self._italic)}
        self._widths: dict[tuple[int, str], float] = {}
        self._colours: dict[Token, QColor] = {}
        self._is_dark: bool | None = None
        self.take_colours()

    def take_colours(self) -> None:
        """Take the colours of the present theme, where it is another one; asked before each frame."""
        if self._is_dark == is_dark():
            return
        self._is_dark = is_dark()
        self._colours = {colour_name: colour(colour_name) for colour_name in _TOKENS}
        self._hatch = QBrush(self._colours["line2"], Qt.BrushStyle.BDiagPattern)
        self._dots = QPen(self._colours["dim"], 1, Qt.PenStyle.DotLine)

    def slot(self, look: CellLook) -> int:
        """Return the width that the unit of a number needs beside it."""
        has_unit = look.is_number and look.unit and not look.is_unit_in_head
        return ceil(self._width(self._small, look.unit)) if has_unit else 0

    def needed(self, look: CellLook, slot: int, *, is_short: bool = False) -> int:
        """Return the width at which a cell is painted whole, with room for the mark of one finding.

        With ``is_short`` a choice has its shorter text, and the names of a mask what they must have.
        """
        marks = (
            1 + look.is_locked + look.has_note
            if look.is_number
            else bool(look.severity) + look.is_locked + look.has_note
        )
        room = 2 * _ASIDE + marks * (SMALL_ICON + 3) + 1
        if look.kind == "not set":
            return room + ceil(self._width(self._italic, self.not_set))
        letters = self._own if look.is_own else self._plain
        if look.is_number:
            return room + ceil(self._width(letters, look.text)) + (slot + 4 if slot else 0)
        width = self._width(letters, (look.short if is_short else "") or look.text)
        if look.unit:
            return (
                room
                + ceil(min(_NAMES, width) if is_short else width)
                + ceil(self._width(self._small, look.unit))
                + 8
            )
        return room + ceil(width)

    def _width(self, letters: QFont, text: str) -> float:
        key = (id(letters), text)
        found = self._widths.get(key)
        if found is None:
            if len(self._widths) > _MAX_REMEMBERED:
                # Rather all at once than one after the other: it refills in a frame.
                self._widths.clear()
            found = self._widths[key] = self._metrics[id(letters)].horizontalAdvance(text)
        return found

    # -- one cell ----------------------------------------------------------------

    def paint_background(self, painter: QPainter, place: QRect) -> None:
        """Paint a cell that has no value: of another kind of instance, or the head of a section."""
        painter.fillRect(place, self._colours["panel"])

    def grid(self, painter: QPainter, place: QRect, *, is_section: bool = False) -> None:
        """Paint the lines below and right of a cell."""
        line = self._colours["grid"]
        painter.fillRect(place.left(), place.bottom(), place.width(), 1, line)
        if not is_section:
            painter.fillRect(place.right(), place.top(), 1, place.height(), line)

    def paint(
        self,
        painter: QPainter,
        place: QRect,
        look: CellLook,
        slot: int,
        number_room: int = 0,
        *,
        is_selected: bool,
        is_hovered: bool,
    ) -> None:
        """Paint a cell: background, tint, hatch, bar, icon, marks, value, unit in a slot.

        A number is painted in the first ``number_room`` pixels of a cell that is wider than a column.
        """
        if look.kind == "absent":
            self.paint_background(painter, place)
            return
        severity = _SEVERITIES.get(look.severity)
        self._background(painter, place, look, severity, is_selected=is_selected, is_hovered=is_hovered)
        inner = place.adjusted(_ASIDE, 0, -_ASIDE, -1)
        if number_room and (look.is_number or look.kind == "not set"):
            inner.setWidth(number_room - 2 * _ASIDE)
        if severity:
            self._icon(painter, inner, severity[2], severity[0])
        if look.is_locked:
            self._icon(painter, inner, "lock-simple-fill", "dim")
        if look.has_note:
            self._icon(painter, inner, "note-fill", "dim")
        if look.kind == "not set":
            painter.setFont(self._italic)
            painter.setPen(self._colours["dim"])
            painter.drawText(inner, _RIGHT, self.not_set)
        elif look.is_number:
            self._number(painter, inner, look, slot)
        else:
            self._words(painter, inner, look)

    def _background(
        self,
        painter: QPainter,
        place: QRect,
        look: CellLook,
        severity: tuple[Token, Token, str] | None,
        *,
        is_selected: bool,
        is_hovered: bool,
    ) -> None:
        """Paint what is behind a value: selection, tint of its finding or pointer, hatch, bar of a change."""
        colours = self._colours
        if is_selected:
            painter.fillRect(place, colours["selbg" if self.is_active else "selidle"])
        elif severity:
            painter.fillRect(place, colours[severity[1]])
        elif is_hovered:
            painter.fillRect(place, colours["hover"])
        if look.is_inactive:
            # From the cell on: otherwise the hatch would jump while the table scrolls.
            painter.setBrushOrigin(place.topLeft())
            painter.fillRect(place, self._hatch)
        if look.is_changed:
            painter.fillRect(place.left(), place.top(), 3, place.height() - 1, colours["chg"])

    not_set = "not set"
    """What is painted where there is no value, in the language of the window."""

    def _icon(self, painter: QPainter, inner: QRect, name: str, colour_name: Token) -> None:
        top = inner.center().y() - SMALL_ICON // 2 + 1
        paint_icon(
            painter, QRect(inner.left(), top, SMALL_ICON, SMALL_ICON), name, self._colours[colour_name]
        )
        inner.setLeft(inner.left() + SMALL_ICON + 3)

    def _number(self, painter: QPainter, inner: QRect, look: CellLook, slot: int) -> None:
        letters = self._own if look.is_own else self._plain
        text, width = look.text, self._width(letters, look.text)
        own_slot = self.slot(look)
        if width > inner.width() - (slot + 4 if slot else 0):
            slot = own_slot  # whole figures are worth more than units in line
        room = inner.width() - (slot + 4 if slot else 0)
        if width > room:  # a column drawn together by hand: no figure without its last digits or its unit
            text, slot, room = "…", 0, inner.width()
            width = self._width(letters, text)
        if own_slot and slot:
            painter.setFont(self._small)
            painter.setPen(self._colours["dim"])
            left = round(inner.right() + 1 - slot)
            painter.drawText(QRect(left, inner.top(), round(slot) + _ASIDE, inner.height()), _LEFT, look.unit)
        painter.setFont(letters)
        painter.setPen(self._colours["text" if look.is_own else "dim"])
        painter.drawText(QRect(inner.left(), inner.top(), round(room), inner.height()), _RIGHT, text)
        if look.is_unlike:
            self._underline(painter, inner.left() + room - width, width, inner)

    def _words(self, painter: QPainter, inner: QRect, look: CellLook) -> None:
        letters = self._own if look.is_own else self._plain
        room = float(inner.width())
        number = self._width(self._small, look.unit) + 8 if look.unit else 0.0
        if number and room - number >= min(_NAMES, self._width(letters, look.short or look.text)):
            room -= number  # a mask: names, and its number where both have room
            painter.setFont(self._small)
            painter.setPen(self._colours["dim"])
            painter.drawText(inner, _RIGHT, look.unit)
        text = self._fitting(look, letters, room)
        painter.setFont(letters)
        painter.setPen(self._colours["text" if look.is_own else "dim"])
        painter.drawText(inner, _LEFT, text)
        if look.is_unlike:
            self._underline(painter, inner.left(), self._width(letters, text), inner)

    def _fitting(self, look: CellLook, letters: QFont, room: float) -> str:
        """Return the text of a cell that has room: whole, in short, or cut in the middle."""
        if self._width(letters, look.text) <= room:
            return look.text
        text = look.short or look.text
        if self._width(letters, text) <= room:
            return text
        return self._metrics[id(letters)].elidedText(text, Qt.TextElideMode.ElideMiddle, room)

    def _underline(self, painter: QPainter, left: float, width: float, inner: QRect) -> None:
        painter.setPen(self._dots)
        y = inner.center().y() + 8
        painter.drawLine(QPoint(round(left), y), QPoint(round(left + width), y))

    # -- over the cells ------------------------------------------------------------

    def outline(self, painter: QPainter, place: QRect, severity: str) -> None:
        """Paint the outline of a cell that is part of the selected finding."""
        painter.setPen(
            QPen(self._colours[_SEVERITIES[severity][0] if severity in _SEVERITIES else "edge"], 1)
        )
        painter.drawRect(QRectF(place).adjusted(0.5, 0.5, -1.5, -1.5))

    def current(self, painter: QPainter, place: QRect) -> None:
        """Paint the border of the current cell."""
        painter.setPen(QPen(self._colours["sel" if self.is_active else "edge"], 2))
        painter.drawRect(QRectF(place).adjusted(1, 1, -2, -2))

    def range_edge(self, painter: QPainter, place: QRect, handle: QRect) -> None:
        """Paint the edge of the selected range, and its fill handle."""
        painter.setPen(QPen(self._colours["sel" if self.is_active else "edge"], 1))
        painter.drawRect(place.adjusted(0, 0, -1, -1))
        if not handle.isNull():
            painter.fillRect(handle.adjusted(-1, -1, 1, 1), self._colours["panel"])
            painter.fillRect(handle, self._colours["sel"])
