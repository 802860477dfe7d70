"""The head of a comparison: over each column its source, with a button that offers others."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from PySide6.QtCore import QRect, QSize, Qt
from PySide6.QtGui import QFontMetrics, QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QHeaderView, QMenu, QStyle, QStyleOptionToolButton, QToolButton, QWidget

from amp_studio.ui.base.theme import RADIUS, SMALL_ICON, TWO_LINE_ROW, colour, font, paint_icon

from .columns import BASE, NAME, RESULT, SIDES, A, B
from .sources import MergeSource, Offer, ReadSource

_LETTERS = {BASE: "0", A: "A", B: "B"}
"""Column -> what its source is called."""
_BOX = 18
_GAP = 10


class _SourceButton(QToolButton):
    """Shows a source in two lines; a click offers the others. ``offers`` is asked each time."""

    def __init__(
        self,
        letter: str,
        offers: Callable[[], list[tuple[str, list[Offer]]]],
        choose: Callable[[Callable[[], ReadSource | None]], object],
        parent: QWidget,
    ) -> None:
        super().__init__(parent)
        self.letter, self._offers, self._choose = letter, offers, choose
        self.source: MergeSource | None = None
        self.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        menu = QMenu(self)
        # Filled when it opens: files are opened and copies are made meanwhile.
        menu.aboutToShow.connect(self.fill)
        self.setMenu(menu)
        self.show_source(None)

    def show_source(self, source: MergeSource | None) -> None:
        """Show a source; None while there is none."""
        self.source = source
        title, detail = (source.title, source.detail) if source else (self.tr("Choose…"), "")
        self.setAccessibleName(self.tr("Source {letter}: {title}").format(letter=self.letter, title=title))
        self.setAccessibleDescription(detail)
        self.setToolTip("\n".join(text for text in (title, detail, source.remark if source else "") if text))
        self.update()

    def fill(self) -> None:
        """Fill the menu with what can be chosen now."""
        menu = self.menu()
        menu.clear()
        for title, offers in self._offers():
            menu.addSeparator()
            menu.addAction(title).setEnabled(False)  # the style sheet leaves the text of a section out
            self._add(menu, offers)

    def _add(self, menu: QMenu, offers: list[Offer] | tuple[Offer, ...]) -> None:
        for offer in offers:
            if offer.inner:
                self._add(menu.addMenu(offer.text), offer.inner)
            elif offer.start is not None:
                start = offer.start
                menu.addAction(offer.text).triggered.connect(lambda *_, start=start: self._choose(start))

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        option = QStyleOptionToolButton()
        self.initStyleOption(option)
        is_over = bool(option.state & QStyle.StateFlag.State_MouseOver)
        painter.fillRect(self.rect(), colour("hover" if is_over or self.isDown() else "panel"))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        middle = self.height() // 2
        box = QRect(_GAP, middle - _BOX // 2, _BOX, _BOX)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(colour("text"))
        painter.drawRoundedRect(box, RADIUS, RADIUS)
        painter.setPen(colour("base"))
        painter.setFont(font("small", own=True))
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, self.letter)
        caret = QRect(self.width() - SMALL_ICON - 6, middle - SMALL_ICON // 2, SMALL_ICON, SMALL_ICON)
        paint_icon(painter, caret, "caret-down", colour("dim"))
        room = QRect(box.right() + 8, 0, caret.left() - box.right() - 12, self.height())
        source = self.source
        _two_lines(
            painter, room, source.title if source else self.tr("Choose…"), source.detail if source else ""
        )
        # By hand, as all of the button: the style has no part in it.
        if self.hasFocus():
            painter.setPen(colour("sel"))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawRoundedRect(self.rect().adjusted(1, 1, -2, -2), RADIUS, RADIUS)


def _two_lines(painter: QPainter, room: QRect, title: str, detail: str) -> None:
    """Paint a name and below it, smaller, what there is to say about it."""
    own, small = font("text", own=True), font("small")
    upper = room.adjusted(0, 6, 0, -room.height() // 2) if detail else room
    painter.setFont(own)
    painter.setPen(colour("text"))
    elide = Qt.TextElideMode.ElideRight
    where = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
    painter.drawText(upper, where, QFontMetrics(own).elidedText(title, elide, room.width()))
    if detail:
        painter.setFont(small)
        painter.setPen(colour("dim"))
        lower = room.adjusted(0, room.height() // 2 - 2, 0, -5)
        painter.drawText(lower, where, QFontMetrics(small).elidedText(detail, elide, room.width()))


class MergeHeader(QHeaderView):
    """The head of the tree, with a button for each source."""

    def __init__(
        self,
        offers: Callable[[], list[tuple[str, list[Offer]]]],
        choose: Callable[[int, Callable[[], ReadSource | None]], object],
        parent: QWidget,
    ) -> None:
        super().__init__(Qt.Orientation.Horizontal, parent)
        self.counts = ""
        self.target = ""
        self.buttons = {
            column: _SourceButton(letter, offers, partial(choose, column), self)
            for column, letter in _LETTERS.items()
        }
        self.setStretchLastSection(True)
        self.setMinimumSectionSize(34)
        self.setSectionsMovable(False)
        self.sectionResized.connect(lambda *_: self.place())
        self.geometriesChanged.connect(self.place)

    def sizeHint(self) -> QSize:
        return QSize(super().sizeHint().width(), TWO_LINE_ROW)

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self.place()

    def place(self) -> None:
        """Put each button over its column."""
        for column, button in self.buttons.items():
            button.setVisible(not self.isSectionHidden(column))
            left, width = self.sectionViewportPosition(column), self.sectionSize(column)
            button.setGeometry(left, 0, width - 1, self.height() - 1)

    def paintSection(self, painter: QPainter, rect: QRect, section: int) -> None:
        painter.save()
        painter.fillRect(rect, colour("panel"))
        painter.setPen(colour("line"))
        painter.drawLine(rect.bottomLeft(), rect.bottomRight())
        painter.setPen(colour("grid"))
        painter.drawLine(rect.topRight(), rect.bottomRight())
        room = rect.adjusted(_GAP, 0, -6, 0)
        if section == NAME:
            painter.setFont(font("small"))
            painter.setPen(colour("dim"))
            text = QFontMetrics(font("small")).elidedText(
                self.counts, Qt.TextElideMode.ElideRight, room.width()
            )
            painter.drawText(room, Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter, text)
        elif section == RESULT:
            _two_lines(painter, room, self.tr("Result"), self.target)
        painter.restore()


assert set(SIDES) == set(_LETTERS)
