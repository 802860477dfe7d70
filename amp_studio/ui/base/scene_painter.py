"""Paints a scene: the same shapes as its SVG, in the colours of the window."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import QBrush, QColor, QFont, QFontMetricsF, QPainter, QPen, QPolygonF

from amp_studio.drawing import (
    ARROWS,
    BAR,
    BAR_STEPS,
    PALE,
    PLAIN,
    SAMPLE,
    Curve,
    Dot,
    FilledArea,
    Heading,
    HeatMap,
    Label,
    Labels,
    Placement,
    Polyline,
    Scene,
    ShapeSort,
    bar_figures,
    heading_of,
    labels_of,
)
from amp_studio.schema import Address

from .figures import with_figures, with_groups
from .theme import Token, colour, font

if TYPE_CHECKING:
    from amp_studio.drawing import Series

TOKENS: dict[ShapeSort, Token] = {
    "ink": "text",
    "dim": "dim",
    "limit": "edge",
    "now": "sel",
    "second": "edge",
    "error": "error",
    "forbidden": "edge",
    "either": "edge",
    "outside": "rec",
    "travel": "text",
    "rail": "edge",
    "overlap": "line",
    "gap": "warnbg",
    "output": "warn",
    "before": "edge",
}
_TEXT_TOKENS: dict[ShapeSort, Token] = {
    "now": "sel",
    "error": "error",
    "dim": "dim",
    "second": "dim",
    "outside": "rec",
    "output": "warn",
}

RING, RING_LINE, SMALL = 6.6, 1.4, 3.2
"""px: how wide a single value is, its line, and how wide one of many is."""
_MAX_WIDE_POINTS, _MAX_RIPPLE = 1000, 30.0
"""Points of lines, and heights of its frame that a curve goes up and down, that are painted wider than a
point: that takes ten times as long."""
_MAX_RINGS = 60
"""Values of a curve that are rings; more of them would lie on each other."""


class ScenePainter:
    """Paints one scene in one place, and remembers where the names of parameters are."""

    def __init__(self, painter: QPainter, place: Placement, size: QSizeF) -> None:
        """Paint with a painter on a sheet of a size in points."""
        self._painter, self._place, self._scene = painter, place, place.scene
        self._caption, self._strong = caption_fonts()
        self.labels = painted_labels(place, size)
        # Qt strokes wide lines in software: a long path would take ten times as long for half a point more.
        self._is_fine = (
            sum(len(line.points) for line in place.scene.lines if not line.wide) > _MAX_WIDE_POINTS
        )
        self.named: list[tuple[QRectF, Address]] = []
        """Where a name is that leads to its parameter."""

    def paint(self) -> None:
        """Paint all of the scene but its handles."""
        painter = self._painter
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setFont(self._caption)
        self._grid()
        for area in self._scene.areas:
            self._area(area)
        if self._scene.cells is not None:
            self._cells(self._scene.cells)
        for line in self._scene.lines:
            self._line(line)
        self._across()
        # Over areas, lines and levels, and below the dots: a measured curve is never hidden by a limit.
        for curve in self._scene.curves:
            self._curve(curve)
        for dot in self._scene.dots:
            self._dot(dot)
        painter.setPen(QPen(colour("edge"), 1))
        for label in self.labels.placed:
            if label.leader is not None:
                painter.drawLine(QPointF(*label.leader[0]), QPointF(*label.leader[1]))
        # Texts last, over everything that is drawn.
        for label in self.labels.placed:
            self._label(label)

    def _at(self, point: tuple[float, float]) -> QPointF:
        return QPointF(*self._place.at(point))

    def _grid(self) -> None:
        if self._scene.look == "rings":
            return
        painter, inner = self._painter, self._inner()
        place = self._place
        painter.setPen(QPen(colour("grid"), 1))
        for x, _ in place.ticks("x"):
            painter.drawLine(QPointF(x, inner.top()), QPointF(x, inner.bottom()))
        for y, _ in place.ticks("y"):
            painter.drawLine(QPointF(inner.left(), y), QPointF(inner.right(), y))
        if self._scene.look == "panel":
            painter.setPen(QPen(colour("line2"), 1))
            if self._scene.y.low < 0.0 < self._scene.y.high:
                zero = place.at((0.0, 0.0))[1]
                painter.drawLine(QPointF(inner.left(), zero), QPointF(inner.right(), zero))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawRect(inner)

    def _inner(self) -> QRectF:
        return QRectF(self._place.left, self._place.top, self._place.width, self._place.height)

    def _across(self) -> None:
        """Paint levels and marks, those that are within the frame."""
        painter, inner, scene = self._painter, self._inner(), self._scene
        for level in scene.levels:
            if scene.y.low <= level.at <= scene.y.high:
                y = self._place.at((0.0, level.at))[1]
                painter.setPen(QPen(colour(TOKENS[level.sort]), 1, Qt.PenStyle.DotLine))
                painter.drawLine(QPointF(inner.left(), y), QPointF(inner.right(), y))
        for mark in scene.marks:
            if scene.x.low <= mark.at <= scene.x.high:
                x = self._place.at((mark.at, 0.0))[0]
                style = Qt.PenStyle.SolidLine if mark.sort == "error" else Qt.PenStyle.DashLine
                painter.setPen(QPen(colour(TOKENS[mark.sort]), 1, style))
                painter.drawLine(QPointF(x, inner.top()), QPointF(x, inner.bottom()))

    def _curve(self, curve: Curve) -> None:
        from amp_studio.drawing import strokes_of  # numpy, which a picture without curves does not need

        painter, shade = self._painter, colour(TOKENS[curve.sort])
        line, band = strokes_of(self._place, curve)
        painter.save()
        # A point more than the frame: half of a line along its edge would be cut off.
        painter.setClipRect(self._inner().adjusted(-1, -1, 1, 1))
        if curve.dots:
            _paint_values(painter, _polygon(line), shade)
        else:
            if band is not None:
                light = QColor(shade)
                light.setAlphaF(0.25)
                painter.setPen(Qt.PenStyle.NoPen)
                painter.setBrush(light)
                painter.drawPolygon(_polygon(band))
            pen = _curve_pen(curve)
            if float(abs(line[1:, 1] - line[:-1, 1]).sum()) > _MAX_RIPPLE * self._place.height:
                pen.setWidthF(1.0)
            painter.setPen(pen)
            painter.drawPolyline(_polygon(line))
        painter.restore()

    def _cells(self, cells: HeatMap) -> None:
        from amp_studio.drawing import cell_boxes  # numpy, see above

        painter, place = self._painter, self._place
        # Smoothed edges of cells beside each other leave a light grid.
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        for left, top, width, height, share, is_safe in cell_boxes(place, cells):
            shade = _mixed(share)
            shade.setAlphaF(1.0 if is_safe else PALE)
            painter.fillRect(QRectF(left, top, width, height), shade)
        left, step = place.left + place.width + 22.0, place.height / BAR_STEPS
        for n in range(BAR_STEPS):
            # Half a point over the next one, so that no gap is seen between the steps.
            box = QRectF(left, place.top + place.height - (n + 1) * step, BAR, step + 0.5)
            painter.fillRect(box, _mixed((n + 0.5) / BAR_STEPS))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(colour("dim"))
        for y, text in bar_figures(place, cells):
            painter.drawText(QPointF(left + BAR + 5.0, y + 4.0), with_figures(text))

    def _area(self, area: FilledArea) -> None:
        box = QRectF(self._at((area.left, area.top)), self._at((area.right, area.bottom))).normalized()
        shade = colour(TOKENS[area.sort])
        if area.sort in PLAIN:
            self._painter.fillRect(box, shade)
            return
        if area.sort != "outside":
            hatch = QColor(shade)
            hatch.setAlphaF(0.35)
            self._painter.fillRect(box, QBrush(hatch, Qt.BrushStyle.BDiagPattern))
        self._painter.setBrush(Qt.BrushStyle.NoBrush)
        self._painter.setPen(QPen(shade, 1))
        self._painter.drawRect(box)

    def _line(self, line: Polyline) -> None:
        width = 6.0 if line.sort == "rail" else 2.0 if line.sort in ("now", "error") else 1.25
        shade = colour(TOKENS[line.sort])
        if line.sort == "rail":
            shade.setAlphaF(0.5)
        pen = QPen(shade, 4.0 if line.wide else 1.0 if self._is_fine else width)
        # A round end would reach half its width beyond the place where the line ends.
        pen.setCapStyle(Qt.PenCapStyle.FlatCap)
        pen.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
        if line.dashed or line.dotted:
            pen.setDashPattern([4.0, 3.0] if line.dashed else [1.0, 1.5])
        self._painter.setPen(pen)
        self._painter.drawPolyline(QPolygonF([self._at(point) for point in line.points]))

    def _dot(self, dot: Dot) -> None:
        painter, at = self._painter, self._at(dot.at)
        shade = colour("error" if dot.sort == "error" else "text")
        painter.setPen(QPen(shade, 1.5))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        x, y = at.x(), at.y()
        if dot.kind == "home":
            painter.drawEllipse(at, 6.0, 6.0)
            painter.drawLine(QPointF(x - 10, y), QPointF(x + 10, y))
            painter.drawLine(QPointF(x, y - 10), QPointF(x, y + 10))
        elif dot.kind == "switch":
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(shade)
            painter.drawRoundedRect(QRectF(x - 6, y - 6, 12, 12), 2, 2)
        elif dot.kind in ARROWS:
            self._arrow(x, y, *ARROWS[dot.kind])
        elif dot.kind in ("marker", "end"):
            painter.setPen(QPen(colour("sel") if dot.kind == "marker" else shade, 2))
            painter.drawLine(QPointF(x, y - 8), QPointF(x, y + 8))
        else:
            painter.setBrush(colour("base"))
            painter.drawEllipse(at, 3.5, 3.5)

    def _arrow(self, x: float, y: float, dx: int, dy: int) -> None:
        x, y = x + 14.0 * abs(dy), y - 14.0 * abs(dx)
        tip = QPointF(x + 11.0 * dx, y + 11.0 * dy)
        self._painter.drawLine(QPointF(x - 11.0 * dx, y - 11.0 * dy), tip)
        for side in (1, -1):
            end = QPointF(tip.x() - 5.0 * dx - 4.0 * side * dy, tip.y() - 5.0 * dy - 4.0 * side * dx)
            self._painter.drawLine(tip, end)

    def _label(self, label: Label) -> None:
        painter = self._painter
        box = QRectF(label.box.left, label.box.top, label.box.width, label.box.height)
        if label.address is not None:
            self.named.append((box, label.address))
        if label.chip:
            paint_chip(painter, box, label.text, colour(TOKENS[label.sort]))
            painter.setFont(self._caption)
            return
        if label.strong or label.over:
            background = colour("base")
            # Not quite covered: a line below a text is still seen to go on.
            background.setAlphaF(0.8)
            painter.fillRect(box, background)
        named = self._strong if label.strong else self._caption
        measure = QFontMetricsF(named)
        base = QPointF(box.left(), box.top() + measure.ascent())
        painter.setFont(named)
        painter.setPen(colour(_TEXT_TOKENS.get(label.sort, "text")))
        # A name begins with the number of its parameter, which is none to be read in groups.
        text = (with_figures if label.strong else with_groups)(label.text)
        painter.drawText(base, text)
        painter.setFont(self._caption)
        if label.value:
            painter.setPen(colour("dim"))
            painter.drawText(
                QPointF(base.x() + measure.horizontalAdvance(text), base.y()), f" {with_groups(label.value)}"
            )


def paint_chip(painter: QPainter, box: QRectF, letter: str, shade: QColor) -> None:
    """Paint a letter in a filled square."""
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(shade)
    painter.drawRoundedRect(box, 3.0, 3.0)
    painter.setPen(colour("base"))
    painter.setFont(font("small", own=True))
    painter.drawText(box, Qt.AlignmentFlag.AlignCenter, letter)


def _mixed(share: float) -> QColor:
    """Return the colour of a value of a map by its place between the smallest and the largest one."""
    low, high, part = colour("base"), colour("sel"), 0.12 + 0.88 * share
    return QColor.fromRgbF(
        low.redF() + part * (high.redF() - low.redF()),
        low.greenF() + part * (high.greenF() - low.greenF()),
        low.blueF() + part * (high.blueF() - low.blueF()),
    )


def _curve_pen(curve: Curve) -> QPen:
    """Return how a curve is drawn: a dashed one with a pattern that is as long as in print."""
    pen = QPen(colour(TOKENS[curve.sort]), 1.5)
    pen.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
    if curve.dashed:
        pen.setDashPattern([4.0, 2.7])
    return pen


def _paint_values(painter: QPainter, at: QPolygonF, shade: QColor) -> None:
    """Paint single measured values: rings, or small points where many are beside each other; in few strokes,
    for a page that follows a control is painted five times a second.
    """
    strokes = ((RING, shade), (RING - 2.0 * RING_LINE, colour("base")))
    for size, fill in strokes if at.size() <= _MAX_RINGS else ((SMALL, shade),):
        pen = QPen(fill, size)
        pen.setCapStyle(Qt.PenCapStyle.RoundCap)
        painter.setPen(pen)
        painter.drawPoints(at)


def _polygon(points: Series) -> QPolygonF:
    return QPolygonF([QPointF(x, y) for x, y in points.tolist()])


def panel_heading(panel: Scene, left: float, right: float) -> list[Heading]:
    """Return the heading of a panel in the font of the window."""
    plain, bold = caption_fonts()
    measures = QFontMetricsF(plain), QFontMetricsF(bold)
    return heading_of(
        panel, left, right, lambda text, is_strong: measures[is_strong].horizontalAdvance(text) + 1.0
    )


def paint_heading(painter: QPainter, pieces: Sequence[Heading], top: float) -> None:
    """Paint the heading of a panel, its last line just above it."""
    plain, bold = caption_fonts()
    height = QFontMetricsF(bold).height()
    last = max((piece.line for piece in pieces), default=0)
    for piece in pieces:
        x, base = piece.x, top - 5.0 - height * (last - piece.line)
        if piece.curve is not None:
            if piece.curve.dots:
                sample = QPolygonF([QPointF(x + 0.5 * SAMPLE, base - 4.0)])
                _paint_values(painter, sample, colour(TOKENS[piece.curve.sort]))
            else:
                painter.setPen(_curve_pen(piece.curve))
                painter.drawLine(QPointF(x, base - 4.0), QPointF(x + SAMPLE, base - 4.0))
            x += SAMPLE + 6.0
        painter.setFont(bold if piece.strong else plain)
        painter.setPen(colour("text" if piece.strong or piece.curve else "dim"))
        painter.drawText(QPointF(x, base), with_figures(piece.text))


def caption_fonts() -> tuple[QFont, QFont]:
    """Return the font of the texts of a scene, and of its names."""
    plain, bold = font("caption"), font("caption")
    bold.setWeight(QFont.Weight.DemiBold)
    return plain, bold


def painted_labels(place: Placement, size: QSizeF) -> Labels:
    """Return where the texts of a scene are in the font of the window, on a sheet of a size in points."""
    caption, strong = caption_fonts()
    plain, bold = QFontMetricsF(caption), QFontMetricsF(strong)

    def measure(text: str, is_strong: bool) -> float:
        # As it is painted: with groups and a minus, which are wider.
        return (bold if is_strong else plain).horizontalAdvance(with_groups(text)) + 1.0

    return labels_of(place, size.width(), size.height(), measure, max(plain.height(), bold.height()))
