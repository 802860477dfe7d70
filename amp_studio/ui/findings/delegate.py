"""Paints the rows of the findings: plain words first, axes as tags, the fix as a button,
the rule's name last.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal, NamedTuple

from PySide6.QtCore import QAbstractItemModel, QEvent, QModelIndex, QPoint, QRect, QSize, Qt
from PySide6.QtGui import QColor, QFont, QFontMetrics, QMouseEvent, QPainter, QPen
from PySide6.QtWidgets import QStyle, QStyledItemDelegate, QStyleOptionViewItem, QTreeView

from amp_studio.ui.base.model_index import ModelIndex
from amp_studio.ui.base.theme import (
    FINDING_ROW,
    GAP,
    GAP2,
    GAP3,
    RADIUS,
    ROW,
    SMALL_CONTROL,
    SMALL_ICON,
    Token,
    colour,
    font,
    paint_icon,
    severity_icon,
)
from amp_studio.ui.base.translated import worded
from amp_studio.validate import family_of_rule

from .model import FindingsModel

Part = Literal["fix", "why", "go", "more"]
_WIDEST_FIX, _WIDEST_RULE, _PAGE, _MORE, _INDENT = 300, 320, 76, 22, 22
_WRAP = int(Qt.TextFlag.TextWordWrap | Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft)


class _Layout(NamedTuple):
    """Where the parts of a row are; a part that the row does not have is empty."""

    icon: QRect
    text: QRect
    tags: QRect
    rule: QRect
    page: QRect
    parts: dict[Part, QRect]


class FindingsDelegate(QStyledItemDelegate):
    """Rows grow with their words, so that no word is left out in a narrow window."""

    def __init__(
        self, view: QTreeView, model: FindingsModel, act: Callable[[Part, QModelIndex], object]
    ) -> None:
        """Make a delegate that calls ``act`` with what was clicked."""
        super().__init__(view)
        self._view, self._model, self._act = view, model, act
        self.may_edit = True
        self._names: dict[Part, str] = {"why": self.tr("Why"), "go": self.tr("Go to")}
        self._text, self._small = font("text"), font("small")

    # -- where everything is ---------------------------------------------------------

    def _layout(self, rect: QRect, index: ModelIndex) -> _Layout:
        small, text = QFontMetrics(self._small), QFontMetrics(self._text)
        is_rule = not index.internalId()
        # Buttons keep the height of one line at the top, however many lines the words need.
        right, line = rect.right() - GAP, min(rect.height(), FINDING_ROW if is_rule else ROW)
        top = rect.top()
        parts: dict[Part, QRect] = {}

        def take(width: int, gap: int = GAP2) -> QRect:
            nonlocal right
            place = QRect(right - width, top, width, line)
            right -= width + gap
            return place

        page = rule = QRect()
        if is_rule:
            parts["more"] = take(_MORE)
            page = take(_PAGE)
            if fix := self._model.fix_of(index):
                width = min(text.horizontalAdvance(fix) + 20, _WIDEST_FIX, rect.width() // 3)
                parts["fix"] = take(width).adjusted(
                    0, (line - SMALL_CONTROL) // 2, 0, (SMALL_CONTROL - line) // 2
                )
        else:
            # Rows of findings have no such button; their links end where those of the rules do.
            right -= _MORE
            for part in ("go", "why"):
                parts[part] = take(small.horizontalAdvance(self._names[part]))
            # The first finding of a rule has its title, for all of them.
            if index.row() == 0:
                title = worded(self._model.group(index).title)
                rule = take(min(small.horizontalAdvance(title) + 2, _WIDEST_RULE, rect.width() // 4))
        left, tags = rect.left() + GAP, QRect()
        if axes := self._model.axes_of(index):
            width = sum(self._tag_width(axis) + GAP for axis in axes)
            tags = take(width, GAP3) if is_rule else QRect(left, top, width, line)
            left += 0 if is_rule else width + GAP
        icon = QRect(left, top + (line - SMALL_ICON) // 2, SMALL_ICON, SMALL_ICON) if is_rule else QRect()
        left += SMALL_ICON + GAP2 if is_rule else 0
        return _Layout(icon, QRect(left, top, max(40, right - left), rect.height()), tags, rule, page, parts)

    def _tag_width(self, axis: str) -> int:
        return max(18, QFontMetrics(self._small).horizontalAdvance(axis) + 10)

    def sizeHint(self, option: QStyleOptionViewItem, index: ModelIndex) -> QSize:
        """Return the height that the words need in the present width of the list."""
        is_rule = not index.internalId()
        width = self._view.viewport().width() - _INDENT * (1 if is_rule else 2)
        # Any height that is more than a line: only the width that is left for the words counts.
        place = self._layout(QRect(0, 0, width, 1000), index).text
        metrics = QFontMetrics(self._text if is_rule else self._small)
        words = metrics.boundingRect(QRect(0, 0, place.width(), 10_000), _WRAP, self._model.text_of(index))
        least, space = (FINDING_ROW, 12) if is_rule else (ROW, 6)
        return QSize(200, max(least, words.height() + space))

    # -- painting --------------------------------------------------------------------

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: ModelIndex) -> None:
        place, group = self._layout(option.rect, index), self._model.group(index)
        is_rule = not index.internalId()
        painter.save()
        if is_rule:
            severity_icon(group.severity).paint(painter, place.icon)
        painter.setFont(self._text if is_rule else self._small)
        painter.setPen(colour("text"))
        painter.drawText(place.text, _WRAP, self._model.text_of(index))
        is_selected = bool(option.state & QStyle.StateFlag.State_Selected)
        self._paint_tags(painter, place.tags, self._model.axes_of(index), is_selected)
        painter.setFont(self._small)
        painter.setPen(colour("dim"))
        if is_rule:
            right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
            painter.drawText(
                place.page,
                right,
                self._elided(
                    self._small,
                    _source(worded(group.cited, family_of_rule(group.findings[0].rule))),
                    place.page.width(),
                ),
            )
            paint_icon(painter, place.parts["more"].adjusted(3, 0, -3, 0), "dots-three", colour("dim"))
        elif not place.rule.isEmpty():
            title = self._elided(self._small, worded(group.title), place.rule.width())
            painter.drawText(place.rule, Qt.AlignmentFlag.AlignVCenter, title)
        painter.setPen(colour("sel"))
        for part, name in self._names.items():
            if part in place.parts:
                painter.drawText(place.parts[part], Qt.AlignmentFlag.AlignVCenter, name)
        if "fix" in place.parts:
            self._paint_button(painter, place.parts["fix"], self._model.fix_of(index), is_selected)
        painter.restore()

    def _paint_tags(self, painter: QPainter, place: QRect, axes: tuple[str, ...], is_selected: bool) -> None:
        left, top = place.left(), place.top() + (place.height() - 18) // 2
        painter.setFont(self._small)
        for axis in axes:
            box = QRect(left, top, self._tag_width(axis), 18)
            self._box(painter, box, "base" if is_selected else "selidle", None)
            painter.setPen(colour("text"))
            painter.drawText(box, Qt.AlignmentFlag.AlignCenter, axis)
            left += box.width() + GAP

    def _paint_button(self, painter: QPainter, place: QRect, text: str, is_primary: bool) -> None:
        """Paint the fix: the one primary button of the list is that of the selected row."""
        primary = is_primary and self.may_edit
        self._box(painter, place, "sel" if primary else "raised", "sel" if primary else "line2")
        painter.setFont(self._text)
        painter.setPen(colour("onsel" if primary else "text" if self.may_edit else "off"))
        painter.drawText(
            place, Qt.AlignmentFlag.AlignCenter, self._elided(self._text, text, place.width() - 12)
        )

    @staticmethod
    def _box(painter: QPainter, place: QRect, background: Token, edge: Token | None) -> None:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setBrush(colour(background))
        painter.setPen(QPen(colour(edge)) if edge else QPen(QColor(Qt.GlobalColor.transparent)))
        painter.drawRoundedRect(place.adjusted(0, 0, -1, -1), RADIUS, RADIUS)

    @staticmethod
    def _elided(letters: QFont, text: str, width: int) -> str:
        return QFontMetrics(letters).elidedText(text, Qt.TextElideMode.ElideMiddle, width)

    # -- the mouse -------------------------------------------------------------------

    def part_at(self, index: QModelIndex, place: QPoint) -> Part | None:
        """Return the button or link of a row at a place of the list."""
        # Computed again from the same layout as painted, so that a click meets what is seen.
        found = self._layout(self._view.visualRect(index), index).parts
        return next((part for part, rect in found.items() if rect.contains(place)), None)

    def editorEvent(  # type: ignore[override]  # Qt gives no other index here
        self, event: QEvent, model: QAbstractItemModel, option: QStyleOptionViewItem, index: QModelIndex
    ) -> bool:
        if event.type() == QEvent.Type.MouseButtonRelease and isinstance(event, QMouseEvent):
            part = self.part_at(index, event.position().toPoint())
            if part is not None and event.button() == Qt.MouseButton.LeftButton:
                self._act(part, index)
                return True
        return False


def _source(cited: str) -> str:
    """Return where a finding is from in a few words: of experience, without what it is."""
    return cited.split(",", maxsplit=1)[0].split(":", maxsplit=1)[0]
