"""A plot on the screen: panels over one axis with two cursors through all of them, a Bode or a ball-bar
plot.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, QSizeF, Qt, Signal
from PySide6.QtGui import (
    QFontMetricsF,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QPixmap,
    QResizeEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QSizePolicy, QWidget

from amp_studio.drawing import (
    BAR_ROOM,
    Curve,
    Picture,
    Placement,
    Scene,
    figure_text,
    linked,
    scene_in_words,
    zoomed,
)

from .figures import written
from .scene_painter import ScenePainter, caption_fonts, paint_heading, panel_heading
from .theme import colour, scheme
from .translated import sentenced, unit_in_words

_LEFT, _RIGHT, _GAP = 70.0, 14.0, 6.0
"""Room in logical pixels beside the panels, and above the heading of each."""
MIN_PANEL = 16.0
"""Height from which a curve is seen."""
_GRIP = 6.0
"""Distance within which a cursor is taken hold of."""
_MIN_SPAN = 1e-6
"""Of the whole axis what is shown at least: the numbers beside it would be equal."""
_WHEEL = 0.8
"""What is visible after a step of the wheel, of what was."""


_MAP_STEPS = {
    Qt.Key.Key_Left: (-1, 0),
    Qt.Key.Key_Right: (1, 0),
    Qt.Key.Key_Down: (0, -1),
    Qt.Key.Key_Up: (0, 1),
}


class Plot(QWidget):
    """One picture; the wheel zooms in around the pointer, dragging moves what is visible,
    a double click shows all of it.
    """

    read = Signal(str)
    """What the cursors read, as HTML; empty without a picture."""
    pointed = Signal(float, float)
    """A place of the map above the panels that was clicked or dragged to, in its units."""
    timed = Signal(float)
    """A place along the axis of the panels that was clicked, of a plot without cursors."""
    stepped = Signal(int, int)
    """Steps to the right and upwards that the arrow keys take on the map."""

    def __init__(self, *, has_cursors: bool = True, is_pointed: bool = False) -> None:
        """``is_pointed``: a click on the drawing above the panels is reported, as one on a map is."""
        super().__init__()
        self._has_cursors, self._is_pointed = has_cursors, is_pointed
        self.picture: Picture | None = None
        self.panels: tuple[Scene, ...] = ()
        """What is visible of the panels of the picture, in the language of the window."""
        self.cursors: tuple[float, float] = (0.0, 0.0)
        """Places along the horizontal axis."""
        self.left_out: tuple[str, ...] = ()
        """The panels for which there is no room."""
        self._frames: list[Placement] = []
        self._map: Placement | None = None
        self._is_on_map = False  # the mouse was pressed there and is dragged
        self._marked: tuple[str, tuple[float, float]] | None = None
        self._now: tuple[float, str] | None = None
        """A place along the axis of the panels, and what is read there."""
        self._pressed: float | None = None
        self._painted: QPixmap | None = None
        """All but the cursors; None where it is to be painted again."""
        self._grip: int | tuple[float, tuple[float, float]] | None = None
        """What is dragged: a cursor by its number, or the place that was pressed with what was visible
        then."""
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMouseTracking(True)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        scheme().changed.connect(self._paint_again)  # a method: a plot that is gone is not asked

    def sizeHint(self) -> QSize:
        return QSize(480, 360)

    def minimumSizeHint(self) -> QSize:
        return QSize(200, 120)

    # -- what is shown -----------------------------------------------------------

    def draw(self, picture: Picture) -> None:
        """Show a picture; the cursors stay where the axis is the same and they are on it."""
        same = self.picture is not None and self.picture.panels[0].x.label == picture.panels[0].x.label
        self.picture = replace(
            picture,
            panels=linked([scene_in_words(panel, sentenced, unit_in_words) for panel in picture.panels]),
            above=picture.above and scene_in_words(picture.above, sentenced, unit_in_words),
        )
        self.panels, self._marked, self._now = self.picture.panels, None, None
        low, high = self.span
        if not same or not all(low <= place <= high for place in self.cursors):
            self._spread_cursors()
        self._paint_again()
        self._emit_values()

    def clear_picture(self) -> None:
        """Show nothing."""
        self.picture, self.panels = None, ()
        self._paint_again()
        self.read.emit("")

    def mark(self, name: str, place: tuple[float, float]) -> None:
        """Mark a place of the map by name; the next picture has none."""
        self._marked = name, place
        self.update()

    def show_now(self, name: str, place: tuple[float, float], at: float, reading: str) -> None:
        """Mark a place above by name, and one along the axis of the panels with what is read there; nothing
        else is painted again.
        """
        self._marked, self._now = (name, place), (at, reading)
        self.update()

    @property
    def span(self) -> tuple[float, float]:
        """What is visible of the horizontal axis."""
        scale = self.panels[0].x
        return scale.low, scale.high

    def zoom(self, span: tuple[float, float] | None) -> None:
        """Show a part of the horizontal axis with both cursors, or all of it;
        the vertical axes follow what is visible.
        """
        if self.picture is None:
            return
        self._show(span)
        self._spread_cursors()
        self._emit_values()

    def _show(self, span: tuple[float, float] | None) -> None:
        if self.picture is None:
            return
        whole = self.picture.panels
        self.panels = whole if span is None else tuple(zoomed(panel, span) for panel in whole)
        self._paint_again()

    def _spread_cursors(self) -> None:
        self.cursors = self._at_share(0.25), self._at_share(0.75)

    # -- painting ----------------------------------------------------------------

    def _paint_again(self) -> None:
        self._painted = None
        self.update()

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._paint_again()

    def paintEvent(self, event: QPaintEvent) -> None:
        if self._painted is None or self._painted.devicePixelRatio() != self.devicePixelRatioF():
            ratio = self.devicePixelRatioF()
            self._painted = QPixmap(self.size() * ratio)
            self._painted.setDevicePixelRatio(ratio)
            self._painted.fill(colour("base"))
            with QPainter(self._painted) as painter:
                self._paint_scenes(painter)
        with QPainter(self) as painter:
            painter.drawPixmap(0, 0, self._painted)
            if self._frames and self._has_cursors:
                self._paint_cursors(painter)
            if self._map is not None and self._marked is not None:
                self._paint_marked(painter, *self._marked, self._map)
            if self._now is not None and self._frames:
                self._paint_now(painter, *self._now)

    def _paint_marked(
        self, painter: QPainter, name: str, place: tuple[float, float], place_of: Placement
    ) -> None:
        at = QPointF(*place_of.at(place))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setFont(caption_fonts()[1 if self._is_pointed else 0])
        painter.setPen(QPen(colour("sel"), 2))
        if self._is_pointed:
            painter.setPen(QPen(colour("base"), 2))
            painter.setBrush(colour("sel"))
        painter.drawEllipse(at, _GRIP, _GRIP)
        size = painter.fontMetrics().boundingRect(name).size()
        # Where there is no room at the right it is at the left.
        is_left = at.x() + _GRIP + 4.0 + size.width() > self.width()
        x = at.x() - _GRIP - 4.0 - size.width() if is_left else at.x() + _GRIP + 4.0
        y = max(at.y() - _GRIP, size.height() + 2.0)
        if self._is_pointed:
            painter.fillRect(
                QRectF(x - 2.0, y - size.height(), size.width() + 4.0, size.height() + 4.0), colour("base")
            )
        painter.setPen(colour("sel"))
        painter.drawText(QPointF(x, y), name)

    def _paint_now(self, painter: QPainter, at: float, reading: str) -> None:
        first, end = self.span
        if not first <= at <= end:
            return
        painter.setPen(QPen(colour("sel"), 1))
        for frame in self._frames:
            x = frame.at((at, 0.0))[0]
            painter.drawLine(QPointF(x, frame.top), QPointF(x, frame.top + frame.height))
        painter.setFont(caption_fonts()[1])
        painter.drawText(self.reading_box(at, reading), Qt.AlignmentFlag.AlignCenter, reading)

    def reading_box(self, at: float, reading: str) -> QRectF:
        """Return where the reading of a moment is: in the heading of the last panel, behind its title; within
        the panel are its curves and limits.
        """
        last, right = self._frames[-1], self.width() - _RIGHT
        measure = QFontMetricsF(caption_fonts()[1])
        wide, high = measure.horizontalAdvance(reading) + 4.0, measure.height()
        pieces = panel_heading(last.scene, _LEFT, right)
        end = max(piece.x + measure.horizontalAdvance(piece.text) for piece in pieces)
        left = max(end + 2.0 * _GAP, min(last.at((at, 0.0))[0] - 0.5 * wide, right - wide))
        return QRectF(left, last.top - 5.0 - measure.ascent(), wide, high)

    def _paint_scenes(self, painter: QPainter) -> None:
        """Paint the panels below each other in the height that there is, each with its heading."""
        self._frames, self._map, self.left_out = [], None, ()
        if self.picture is None:
            return
        scenes = [*filter(None, [self.picture.above]), *self.panels]
        self._paint_below_each_other(painter, scenes)

    def _paint_below_each_other(self, painter: QPainter, scenes: Sequence[Scene]) -> None:
        """Paint scenes; the last ones are left out where all would have no room, and named below."""
        assert self.picture is not None
        right, line = self.width() - _RIGHT, QFontMetricsF(caption_fonts()[1]).height()
        headings = [panel_heading(each, _LEFT, right) if each.look == "panel" else [] for each in scenes]
        heads = [
            _GAP + line * (1 + max((piece.line for piece in pieces), default=-1)) + 4.0 for pieces in headings
        ]
        # Rings are lower than in print, where they have the whole of a page.
        shares = [min(scene.share, 2.0 * self.panels[0].share) for scene in scenes]
        room = self.height() - sum(heads) - (4.8 if _has_figures_below(self.picture.above) else 2.4) * line
        has_several = len(scenes) > 1 and scenes[-2] is not self.picture.above
        if has_several and room < MIN_PANEL * len(scenes):
            fewer = scenes[:-1]
            # The figures along the axis are under the last panel that is painted.
            last = replace(fewer[-1], x=replace(fewer[-1].x, is_written=True))
            self.left_out = (scenes[-1].title, *self.left_out)
            self._paint_below_each_other(painter, [*fewer[:-1], last])
            return
        room = max(room, 10.0)
        self._paint_left_out(painter)
        top = 0.0
        for scene, pieces, head, share in zip(scenes, headings, heads, shares, strict=True):
            height = room * share / sum(shares)
            frame = _place_of(scene, right, top + head, height)
            painter.save()
            ScenePainter(painter, frame, QSizeF(self.width(), self.height())).paint()
            painter.restore()
            paint_heading(painter, pieces, frame.top)
            top += head + height
            if scene is not self.picture.above:
                self._frames.append(frame)
                continue
            self._map = frame if scene.cells is not None or self._is_pointed else self._map
            top += 2.4 * line if _has_figures_below(scene) else 0.0

    def _paint_left_out(self, painter: QPainter) -> None:
        """Name the panels that have no room, in the last line."""
        if self.left_out:
            painter.setFont(caption_fonts()[0])
            painter.setPen(colour("dim"))
            text = self.tr("without room: {names}").format(names=", ".join(self.left_out))
            painter.drawText(QPointF(_LEFT, self.height() - 4.0), text)

    def _paint_cursors(self, painter: QPainter) -> None:
        painter.setFont(caption_fonts()[0])
        for name, place in zip("AB", self.cursors, strict=True):
            low, high = self.span
            if not low <= place <= high:
                continue
            is_gripped = self._grip == "AB".index(name)
            painter.setPen(QPen(colour("sel" if is_gripped else "dim"), 2 if is_gripped else 1))
            for frame in self._frames:
                x = frame.at((place, 0.0))[0]
                painter.drawLine(QPointF(x, frame.top), QPointF(x, frame.top + frame.height))
            first = self._frames[0]
            box = QRectF(first.at((place, 0.0))[0] + 2.0, first.top + 2.0, 12.0, 14.0)
            painter.fillRect(box, colour("base"))
            painter.drawText(box, Qt.AlignmentFlag.AlignCenter, name)

    # -- the mouse and the keys ----------------------------------------------------

    def _share_of(self, x: float) -> float:
        return (x - self._frames[0].left) / self._frames[0].width

    def _at_share(self, share: float) -> float:
        """Return the place at a share of what is visible, evenly as it is drawn."""
        (low, high), log = self.span, self.panels[0].x.log
        return float(low * (high / low) ** share) if log else low + share * (high - low)

    def _cursor_at(self, x: float) -> int | None:
        if not self._frames or not self._has_cursors:
            return None
        far = [abs(self._frames[0].at((place, 0.0))[0] - x) for place in self.cursors]
        return far.index(min(far)) if min(far) <= _GRIP else None

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton and self._frames:
            x = event.position().x()
            place = self._map
            if place is not None and place.top <= event.position().y() <= place.top + place.height:
                if place.left <= x <= place.left + place.width:
                    self._is_on_map = True
                    self._point(event)
                return
            cursor, self._pressed = self._cursor_at(x), x
            self._grip = cursor if cursor is not None else (x, self.span)
            self.update()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        x = event.position().x()
        if self._is_on_map:
            self._point(event)
        elif isinstance(self._grip, int):
            self.move_cursor(self._grip, self._at_share(min(max(self._share_of(x), 0.0), 1.0)))
        elif self._grip is not None:
            pressed, span = self._grip
            self._show(self._within(*_shifted(span, (pressed - x) / self._frames[0].width, self._is_log)))
        else:
            over = self._cursor_at(x) is not None
            self.setCursor(Qt.CursorShape.SplitHCursor if over else Qt.CursorShape.ArrowCursor)

    def _point(self, event: QMouseEvent) -> None:
        """Point to the place of the map that is nearest to the pointer."""
        if (place := self._map) is not None:
            x = min(max(event.position().x(), place.left), place.left + place.width)
            y = min(max(event.position().y(), place.top), place.top + place.height)
            self.pointed.emit(*place.world(x, y))

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        is_click = self._pressed is not None and abs(event.position().x() - self._pressed) < _GRIP
        if is_click and not self._has_cursors and self._frames and not self._is_on_map:
            self.timed.emit(self._at_share(min(max(self._share_of(event.position().x()), 0.0), 1.0)))
        self._grip, self._is_on_map, self._pressed = None, False, None
        self.update()

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        self._show(None)

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Show less or more around the pointer."""
        if self._frames and event.angleDelta().y():
            self._zoom_around(
                self._share_of(event.position().x()), _WHEEL ** (event.angleDelta().y() / 120.0)
            )

    def _zoom_around(self, share: float, times: float) -> None:
        share = min(max(share, 0.0), 1.0)
        low, high = self._at_share(share - share * times), self._at_share(share + (1.0 - share) * times)
        self._show(self._within(low, high))

    @property
    def _is_log(self) -> bool:
        return self.panels[0].x.log

    def _within(self, low: float, high: float) -> tuple[float, float] | None:
        """Return a span within the picture, None for all of it; one that is too small is what is visible
        now.
        """
        if self.picture is None:
            return None
        whole = self.picture.panels[0].x
        if low <= whole.low and high >= whole.high:
            return None
        least = _MIN_SPAN * (whole.high - whole.low) if not whole.log else _MIN_SPAN * low
        low, high = max(low, whole.low), min(high, whole.high)
        return (low, high) if high - low > least else self.span

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Move cursor A with the arrow keys, cursor B with Shift, by a hundredth of what is visible;
        + and - zoom, Home shows all. Without cursors the arrow keys step on the map.
        """
        key = Qt.Key(event.key())
        if key in _MAP_STEPS and self._map is not None and not self._has_cursors:
            self.stepped.emit(*_MAP_STEPS[key])
            return
        way = {Qt.Key.Key_Left: -0.01, Qt.Key.Key_Right: 0.01}.get(key)
        times = {Qt.Key.Key_Plus: _WHEEL, Qt.Key.Key_Minus: 1.0 / _WHEEL}.get(key)
        way = way if self._has_cursors else None
        if self.picture is None or (way is None and times is None and key != Qt.Key.Key_Home):
            super().keyPressEvent(event)
        elif way is not None:
            number = 1 if event.modifiers() & Qt.KeyboardModifier.ShiftModifier else 0
            self.move_cursor(number, _shifted((self.cursors[number],) * 2, way, self._is_log, self.span)[0])
        elif times is not None:
            self._zoom_around(0.5, times)
        else:
            self._show(None)

    # -- cursors -----------------------------------------------------------------

    def move_cursor(self, number: int, place: float) -> None:
        """Move one cursor."""
        a, b = self.cursors
        self.cursors = (place, b) if number == 0 else (a, place)
        self.update()
        self._emit_values()

    def _emit_values(self) -> None:
        if self.picture is not None:
            self.read.emit("".join(_reading(self.picture, *self.cursors)))


def _has_figures_below(above: Scene | None) -> bool:
    """Return whether a drawing above the panels has a scale that needs room: rings have none."""
    return above is not None and above.look != "rings"


def _place_of(scene: Scene, right: float, top: float, height: float) -> Placement:
    width = max(right - _LEFT - (BAR_ROOM if scene.cells else 0.0), 10.0)
    if not scene.equal:
        return Placement(scene, _LEFT, top, width, height)
    return Placement.equal_in(scene, _LEFT, top, width, height)


def _shifted(
    places: tuple[float, float], share: float, log: bool, span: tuple[float, float] | None = None
) -> tuple[float, float]:
    """Return places further along an axis by a share of a span (of themselves, by default)."""
    low, high = span or places
    if log:
        times = (high / low) ** share
        return places[0] * times, places[1] * times
    by = share * (high - low)
    return places[0] + by, places[1] + by


def _five_digits(value: float) -> str:
    """Return a figure of a curve as it is read at a cursor; a dash where the curve has none."""
    return written(figure_text(float(f"{value:.5g}"))) if math.isfinite(value) else "–"


def _reading(picture: Picture, one: float, two: float) -> Iterator[str]:
    """Yield a table: a row for each curve with its value at both cursors and the difference."""
    along = picture.panels[0].x
    cell = "<td align=right>&nbsp;&nbsp;{}</td>"
    yield "<table cellspacing=0 cellpadding=1><tr><td></td>"
    yield "".join(cell.format(f"<b>{head}</b>") for head in ("A", "B", "B − A")) + "</tr>"
    for words, unit, a, b in ((along.label, along.unit, one, two), *_values_at(picture, one, two)):
        values = "".join(cell.format(_five_digits(value)) for value in (a, b, b - a))
        yield f"<tr><td>{words}</td>{values}<td>&nbsp;{unit}</td></tr>"
    yield "</table>"


def _values_at(picture: Picture, one: float, two: float) -> Iterator[tuple[str, str, float, float]]:
    """Yield name and unit of each curve, and its values at two places."""
    for panel in picture.panels:
        curves = [curve for curve in panel.curves if not curve.is_before]
        alone = sum(bool(curve.name) for curve in curves) < 2
        for curve in curves:
            if len(curve.x):
                words = panel.title if alone else f"{panel.title}, {curve.name}"
                yield words, panel.y.unit, _value_at(curve, one), _value_at(curve, two)


def _value_at(curve: Curve, place: float) -> float:
    """Return the value of a curve at a place; of single readings that of the nearest one."""
    if curve.dots:
        return float(curve.y[int(np.argmin(np.abs(curve.x - place)))])
    return float(np.interp(place, curve.x, curve.y))
