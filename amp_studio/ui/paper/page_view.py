"""The pages of a document one below the other, as they lie on paper, with the place of a value marked."""

from __future__ import annotations

import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from PySide6.QtCore import QEvent, QPointF, QRect, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QImage,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPixmap,
    QResizeEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QAbstractScrollArea

from amp_studio.report import PrintedPlace
from amp_studio.schema import Address
from amp_studio.ui.base.single_shot import single_shot
from amp_studio.ui.base.theme import GAP, GAP3, colour, font

POINTS = 72
"""Points to the inch."""
_ZOOM_STEP, _MIN_ZOOM, _MAX_ZOOM = 1.2, 0.25, 4.0
"""Zoom is in pixels to the point; 96 / 72 is the size of the paper."""
_LINE_ABOVE, _LINE_BELOW = 2.0, 9.5
"""Points of a line of a table above and below the place of its value."""
_REACH = 24.0
"""Points up to which a click belongs to the line above it."""
_AHEAD = 1
"""Pages beside those that are seen whose pictures are kept."""
_MAX_PIXELS = 64_000_000
"""Of a page that is scaled beforehand: a template makes pages of any size."""
_PAPER = QColor(255, 255, 255)
_MARK = QColor(29, 91, 203)
"""Paper is white in the dark too, and so is what is marked on it."""


@dataclass(frozen=True, slots=True)
class Spot:
    """What is at the top of the view: a page, and the share of it above the edge."""

    page: int
    share: float


class PageView(QAbstractScrollArea):
    """Shows pages that are given as PNG. A page is decoded when it is seen, one in a turn of the event
    loop.
    """

    turned = Signal(int)
    """The page that is read is another one; counted from 1."""
    value_clicked = Signal(object)
    """The address of the value that was clicked."""
    zoomed = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.setAccessibleName(self.tr("Pages of the report"))
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setFrameShape(self.Shape.NoFrame)
        self.viewport().setMouseTracking(True)
        self.pages: Sequence[bytes] = ()
        self.places: Mapping[Address, PrintedPlace] = {}
        self.zoom: float | None = None
        """Pixels to the point; None fits each page into the width."""
        self.empty = ""
        """The text while there is no page."""
        self._ppi = POINTS
        self._sizes: list[tuple[float, float]] = []
        self._tops: list[int] = []
        self._drawn: dict[int, tuple[bytes, int, QPixmap]] = {}
        self._marked: Address | None = None
        self._page = 0
        self._preparing = single_shot(self, self._prepare)
        self.verticalScrollBar().valueChanged.connect(self._emit_page)

    # -- what is shown ---------------------------------------------------------------------

    def show_pages(self, pages: Sequence[bytes], ppi: int, spot: Spot | None = None) -> None:
        """Show other pages at the same spot, or at another one. Places stay until they are known again."""
        # A report that is made again stays where it is read, also with other pages.
        spot = spot or self.spot()
        self.pages, self._ppi = pages, ppi
        # By the heads of the images: decoding all pages would take seconds before the first is seen.
        self._sizes = [_size(page, ppi) for page in pages]
        for n in [n for n in self._drawn if n >= len(pages)]:
            del self._drawn[n]
        self._arrange(spot)
        self._emit_page()

    def show_places(self, places: Mapping[Address, PrintedPlace]) -> None:
        """Learn where the values of these pages are."""
        self.places = places
        self.viewport().update()

    def spot(self) -> Spot:
        """Return what is at the top."""
        top = self.verticalScrollBar().value()
        page = max((n for n, at in enumerate(self._tops) if at <= top + GAP3), default=0)
        if not self._tops:
            return Spot(0, 0.0)
        return Spot(page, (top - self._tops[page]) / max(self._of(page).height(), 1))

    @property
    def page(self) -> int:
        """The page that is read, counted from 1: it is not the one that ends at the top.
        0 while there is none.
        """
        # A third down: the page that ends at the top is read no more.
        middle = self.verticalScrollBar().value() + self.viewport().height() // 3
        return max((n for n, at in enumerate(self._tops, 1) if at <= middle), default=min(len(self._tops), 1))

    def go_to_page(self, page: int) -> None:
        """Show the top of a page; counted from 1."""
        if 1 <= page <= len(self._tops):
            self.verticalScrollBar().setValue(self._tops[page - 1] - GAP)

    def highlight(self, address: Address | None, *, scroll: bool) -> bool:
        """Mark the place of a value and let it be seen; returns whether it has one."""
        self._marked = address
        place = self.places.get(address) if address is not None else None
        self.viewport().update()
        if place is None or place.page > len(self.pages):
            return False
        if scroll:
            band = self._band(place)
            bar, height = self.verticalScrollBar(), self.viewport().height()
            # What is seen already does not move under the eye.
            if not (bar.value() <= band.top() and band.bottom() <= bar.value() + height):
                bar.setValue(int(band.center().y() - height / 3))
            across = self.horizontalScrollBar()
            left = self._left(place.page - 1) + place.x * self._scale(place.page - 1)
            if not across.value() <= left <= across.value() + self.viewport().width() - 60:
                across.setValue(int(left - self.viewport().width() / 2))
        return True

    def set_zoom(self, zoom: float | None) -> None:
        """Show the pages in a scale, or each as wide as there is room (None)."""
        wanted = None if zoom is None else min(max(zoom, _MIN_ZOOM), _MAX_ZOOM)
        if wanted != self.zoom:
            spot = self.spot()
            self.zoom = wanted
            self._arrange(spot)
            self.zoomed.emit()

    def step_zoom(self, by: int) -> None:
        """Show the pages larger or smaller."""
        self.set_zoom(self.scale() * _ZOOM_STEP**by)

    def scale(self) -> float:
        """Return the pixels to the point of the page at the top."""
        return self._scale(self.spot().page) if self._sizes else 1.0

    # -- geometry --------------------------------------------------------------------------

    def _scale(self, page: int) -> float:
        if self.zoom is not None:
            return self.zoom
        wanted = (self.viewport().width() - 2 * GAP3) / max(self._sizes[page][0], 1.0)
        return min(max(wanted, _MIN_ZOOM), _MAX_ZOOM)

    def _of(self, page: int) -> QSize:
        """Return the size of a page in pixels."""
        width, height = self._sizes[page]
        scale = self._scale(page)
        return QSize(round(width * scale), round(height * scale))

    def _left(self, page: int) -> int:
        return max((self.viewport().width() - self._of(page).width()) // 2, GAP3)

    def _arrange(self, spot: Spot) -> None:
        """Lay the pages out, with this spot at the top."""
        self._tops, at = [], GAP3
        for n in range(len(self._sizes)):
            self._tops.append(at)
            at += self._of(n).height() + GAP3
        widest = max((self._of(n).width() for n in range(len(self._sizes))), default=0)
        room, bar, across = self.viewport().size(), self.verticalScrollBar(), self.horizontalScrollBar()
        bar.setRange(0, max(at - room.height(), 0))
        bar.setPageStep(room.height())
        bar.setSingleStep(40)
        across.setRange(0, max(widest + 2 * GAP3 - room.width(), 0))
        across.setPageStep(room.width())
        if self._tops:
            page = min(spot.page, len(self._tops) - 1)
            bar.setValue(round(self._tops[page] + spot.share * self._of(page).height()))
        self.viewport().update()

    def _rect(self, page: int) -> QRect:
        """Return where a page lies in the viewport."""
        left = self._left(page) - self.horizontalScrollBar().value()
        return QRect(left, self._tops[page] - self.verticalScrollBar().value(), *self._of(page).toTuple())

    def _seen(self) -> list[int]:
        height = self.viewport().height()
        rects = ((n, self._rect(n)) for n in range(len(self._tops)))
        return [n for n, rect in rects if rect.bottom() >= 0 and rect.top() <= height]

    def _band(self, place: PrintedPlace) -> QRectF:
        """Return the line of a value, from the top of the first page."""
        page = place.page - 1
        scale = self._scale(page)
        return QRectF(
            self._left(page),
            self._tops[page] + (place.y - _LINE_ABOVE) * scale,
            self._of(page).width(),
            (_LINE_ABOVE + _LINE_BELOW) * scale,
        )

    def value_at(self, at: QPointF) -> Address | None:
        """Return the value whose line is at a point of the viewport: that of the column to its left."""
        for n in self._seen():
            rect = self._rect(n)
            if rect.contains(at.toPoint()):
                scale = self._scale(n)
                return self._value_on(n, (at.x() - rect.left()) / scale, (at.y() - rect.top()) / scale)
        return None

    def _value_on(self, n: int, x: float, y: float) -> Address | None:
        """Return the value at a place of a page, from 0."""
        here = [(p, a) for a, p in self.places.items() if p.page == n + 1]
        lines = [p.y for p, _ in here if p.y - _LINE_ABOVE <= y <= p.y + _REACH]
        if not lines:
            return None
        # The lowest of the lines in reach: the one just above the point.
        row = sorted((p.x, a) for p, a in here if p.y == max(lines))
        return max((each for each in row if each[0] <= x + GAP), default=row[0])[1]

    # -- painting --------------------------------------------------------------------------

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self.viewport())
        painter.fillRect(self.viewport().rect(), colour("window"))
        if not self.pages:
            painter.setFont(font("text"))
            painter.setPen(colour("dim"))
            room = self.viewport().rect().adjusted(GAP3, GAP3, -GAP3, -GAP3)
            painter.drawText(
                room, int(Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap.value), self.empty
            )
            return
        missing = False
        for n in self._seen():
            rect = self._rect(n)
            painter.setPen(colour("line2"))
            painter.setBrush(_PAPER)
            painter.drawRect(rect.adjusted(-1, -1, 0, 0))
            drawn = self._drawn.get(n)
            if drawn is not None:
                painter.drawPixmap(rect, drawn[2])
            # An old picture of the page, in another size, is better than none until the new one is decoded.
            missing = missing or not self._is_drawn(n)
        place = self.places.get(self._marked) if self._marked is not None else None
        if place is not None and place.page <= len(self.pages):
            self._paint_mark(painter, place)
        if missing:
            self._preparing.start(0)

    def _paint_mark(self, painter: QPainter, place: PrintedPlace) -> None:
        """Tint the line of a value, with a bar at its own figure."""
        band = self._band(place).translated(
            -self.horizontalScrollBar().value(), -self.verticalScrollBar().value()
        )
        tint = QColor(_MARK)
        tint.setAlpha(36)
        painter.fillRect(band, tint)
        scale = self._scale(place.page - 1)
        painter.fillRect(
            QRectF(band.left() + (place.x - 3) * scale, band.top(), max(2.0, scale * 1.6), band.height()),
            _MARK,
        )

    def _is_drawn(self, page: int) -> bool:
        drawn = self._drawn.get(page)
        return drawn is not None and drawn[0] is self.pages[page] and drawn[1] == self._of(page).width()

    def _prepare(self) -> None:
        """Decode one page that is seen and not yet drawn as it is now; forget those far away."""
        seen = self._seen()
        if not seen:
            return
        for n in [n for n in self._drawn if not seen[0] - _AHEAD <= n <= seen[-1] + _AHEAD]:
            del self._drawn[n]
        missing = next((n for n in seen if not self._is_drawn(n)), None)
        if missing is None:
            return
        size, ratio = self._of(missing), self.devicePixelRatioF()
        smooth = Qt.TransformationMode.SmoothTransformation
        image, wanted = QImage.fromData(self.pages[missing]), size * ratio
        # Above that the painter scales the page as it is: a pixmap of that size may not fit into memory.
        if not image.isNull() and wanted.width() * wanted.height() <= _MAX_PIXELS:
            image = image.scaled(wanted, Qt.AspectRatioMode.IgnoreAspectRatio, smooth)
            image.setDevicePixelRatio(ratio)
        self._drawn[missing] = self.pages[missing], size.width(), QPixmap.fromImage(image)
        self.viewport().update()

    # -- hands -----------------------------------------------------------------------------

    def _emit_page(self, *_: object) -> None:
        page = self.page
        if page != self._page:
            self._page = page
            self.setAccessibleDescription(
                self.tr("Page {page} of {count}").format(page=page, count=len(self.pages))
            )
            self.turned.emit(page)

    def resizeEvent(self, event: QResizeEvent) -> None:
        spot = self.spot()
        super().resizeEvent(event)
        self._arrange(spot)

    def wheelEvent(self, event: QWheelEvent) -> None:
        if event.modifiers() & Qt.KeyboardModifier.ControlModifier:
            self.step_zoom(1 if event.angleDelta().y() > 0 else -1)
            event.accept()
            return
        super().wheelEvent(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Turn by pages with Page Up and Page Down at the ends, zoom with plus, minus and 0."""
        keys, bar = Qt.Key, self.verticalScrollBar()
        if event.key() in (keys.Key_Home, keys.Key_End):
            bar.setValue(bar.minimum() if event.key() == keys.Key_Home else bar.maximum())
        elif event.text() in ("+", "-"):
            self.step_zoom(1 if event.text() == "+" else -1)
        elif event.text() == "0":
            self.set_zoom(None)
        else:
            super().keyPressEvent(event)

    def viewportEvent(self, event: QEvent) -> bool:
        if isinstance(event, QMouseEvent) and event.type() == QEvent.Type.MouseMove:
            over = self.value_at(event.position()) is not None
            self.viewport().setCursor(
                Qt.CursorShape.PointingHandCursor if over else Qt.CursorShape.ArrowCursor
            )
        return super().viewportEvent(event)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Take the person to the value that was clicked."""
        address = self.value_at(event.position())
        if event.button() == Qt.MouseButton.LeftButton and address is not None:
            self.value_clicked.emit(address)


def _size(page: bytes, ppi: int) -> tuple[float, float]:
    """Return width and height of a page in points, from the head of its PNG."""
    width, height = struct.unpack(">II", page[16:24])
    return width * POINTS / ppi, height * POINTS / ppi
