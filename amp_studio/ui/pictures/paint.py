"""Paints a scene: the same shapes as its SVG, in the colours of the window."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from PySide6.QtCore import QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import QBrush, QColor, QFont, QFontMetricsF, QPainter, QPen, QPolygonF

from amp_studio.pictures import (
    ARROWS,
    Dot,
    FilledArea,
    Handle,
    Label,
    Labels,
    Placement,
    Polyline,
    Scene,
    ShapeSort,
    labels_of,
)
from amp_studio.schema import Address
from amp_studio.ui.base.theme import GAP, GAP2, RADIUS, Token, colour, font, severity_ink

INKS: dict[ShapeSort, Token] = {
    "ink": "text", "dim": "dim", "limit": "edge", "now": "sel", "second": "edge", "error": "error", "forbidden": "edge",
    "either": "edge", "outside": "rec", "travel": "text", "rail": "edge", "overlap": "line",
}  # fmt: skip
TEXT_INKS: dict[ShapeSort, Token] = {
    "now": "sel",
    "error": "error",
    "dim": "dim",
    "second": "dim",
    "outside": "rec",
}
MOST_REASON = 380.0
"""Width of a reason in a tag, in logical pixels; the findings have the whole of it."""
HANDLE = 9.0
"""Side of a handle in logical pixels."""


class ScenePainter:
    """Paints one scene in one place, and remembers where the names of parameters are."""

    def __init__(self, painter: QPainter, place: Placement, size: QSizeF) -> None:
        """Paint with a painter on a sheet of a size in points."""
        self._painter, self._place, self._scene = painter, place, place.scene
        self._caption, self._strong = font("caption"), font("caption")
        self._strong.setWeight(QFont.Weight.DemiBold)
        self.labels = painted_labels(place, size)
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
        for line in self._scene.lines:
            self._line(line)
        for dot in self._scene.dots:
            self._dot(dot)
        painter.setPen(QPen(colour("edge"), 1))
        for label in self.labels.shown:
            if label.leader is not None:
                painter.drawLine(QPointF(*label.leader[0]), QPointF(*label.leader[1]))
        for label in self.labels.shown:
            self._label(label)

    def _at(self, point: tuple[float, float]) -> QPointF:
        return QPointF(*self._place.at(point))

    def _grid(self) -> None:
        painter, place = self._painter, self._place
        inner = QRectF(place.left, place.top, place.width, place.height)
        painter.setPen(QPen(colour("grid"), 1))
        for x, _ in place.ticks("x"):
            painter.drawLine(QPointF(x, inner.top()), QPointF(x, inner.bottom()))
        for y, _ in place.ticks("y"):
            painter.drawLine(QPointF(inner.left(), y), QPointF(inner.right(), y))

    def _area(self, area: FilledArea) -> None:
        box = QRectF(self._at((area.left, area.top)), self._at((area.right, area.bottom))).normalized()
        ink = colour(INKS[area.sort])
        if area.sort == "overlap":
            self._painter.fillRect(box, ink)
            return
        if area.sort != "outside":
            hatch = QColor(ink)
            hatch.setAlphaF(0.35)
            self._painter.fillRect(box, QBrush(hatch, Qt.BrushStyle.BDiagPattern))
        self._painter.setBrush(Qt.BrushStyle.NoBrush)
        self._painter.setPen(QPen(ink, 1))
        self._painter.drawRect(box)

    def _line(self, line: Polyline) -> None:
        width = 6.0 if line.sort == "rail" else 2.0 if line.sort in ("now", "error") else 1.25
        ink = colour(INKS[line.sort])
        if line.sort == "rail":
            ink.setAlphaF(0.5)
        pen = QPen(ink, width)
        pen.setCapStyle(Qt.PenCapStyle.FlatCap)
        pen.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
        if line.dashed:
            pen.setDashPattern([4.0, 3.0])
        self._painter.setPen(pen)
        self._painter.drawPolyline(QPolygonF([self._at(point) for point in line.points]))

    def _dot(self, dot: Dot) -> None:
        painter, at = self._painter, self._at(dot.at)
        ink = colour("error" if dot.sort == "error" else "text")
        painter.setPen(QPen(ink, 1.5))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        x, y = at.x(), at.y()
        if dot.kind == "home":
            painter.drawEllipse(at, 6.0, 6.0)
            painter.drawLine(QPointF(x - 10, y), QPointF(x + 10, y))
            painter.drawLine(QPointF(x, y - 10), QPointF(x, y + 10))
        elif dot.kind == "switch":
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(ink)
            painter.drawRoundedRect(QRectF(x - 6, y - 6, 12, 12), 2, 2)
        elif dot.kind in ARROWS:
            self._arrow(x, y, *ARROWS[dot.kind])
        elif dot.kind in ("marker", "end"):
            painter.setPen(QPen(colour("sel") if dot.kind == "marker" else ink, 2))
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
        if label.strong:
            ground = colour("base")
            ground.setAlphaF(0.8)
            painter.fillRect(box, ground)
        named = self._strong if label.strong else self._caption
        measure = QFontMetricsF(named)
        base = QPointF(box.left(), box.top() + measure.ascent())
        painter.setFont(named)
        painter.setPen(colour(TEXT_INKS.get(label.sort, "text")))
        painter.drawText(base, label.text)
        painter.setFont(self._caption)
        if label.value:
            painter.setPen(colour("dim"))
            painter.drawText(
                QPointF(base.x() + measure.horizontalAdvance(label.text), base.y()), f" {label.value}"
            )


def painted_labels(place: Placement, size: QSizeF) -> Labels:
    """Return where the texts of a scene are in the font of the window, on a sheet of a size in points."""
    caption, strong = font("caption"), font("caption")
    strong.setWeight(QFont.Weight.DemiBold)
    plain, bold = QFontMetricsF(caption), QFontMetricsF(strong)

    def measure(text: str, is_strong: bool) -> float:
        return (bold if is_strong else plain).horizontalAdvance(text) + 1.0

    return labels_of(place, size.width(), size.height(), measure, max(plain.height(), bold.height()))


def paint_handles(painter: QPainter, place: Placement, handles: Iterator[tuple[Handle, bool, str]]) -> None:
    """Paint handles, each with whether it has the focus and the severity of its finding.

    A square for one value, a circle for one of less weight, a small square for those of a corner; filled where it has the focus.
    """
    half = 0.5 * HANDLE
    for handle, is_active, severity in handles:
        at = QPointF(*place.at(handle.at))
        ink = severity_ink(severity) if severity else colour("sel" if is_active else "text")
        painter.setPen(QPen(ink, 1.5))
        painter.setBrush(ink if is_active else colour("base"))
        if len(handle.drags) > 1:
            painter.setPen(QPen(ink if is_active or severity else colour("edge"), 1))
            painter.drawRect(QRectF(at.x() - 3, at.y() - 3, 6, 6))
        elif handle.second:
            painter.drawEllipse(at, half - 0.5, half - 0.5)
        else:
            painter.drawRoundedRect(QRectF(at.x() - half, at.y() - half, HANDLE, HANDLE), 1.5, 1.5)


class Tag(NamedTuple):
    """What a handle is and has."""

    name: str
    value: str
    old: str = ""
    """``was -150 mm``"""
    reason: str = ""
    """Why it goes no further, or what is found there."""
    severity: str = ""


def paint_tag(painter: QPainter, place: Placement, at: tuple[float, float], tag: Tag) -> None:
    """Paint a tag beside its handle, where the picture has room."""
    caption, strong = font("caption"), font("small")
    strong.setWeight(strong.Weight.DemiBold)
    small, large = QFontMetricsF(caption), QFontMetricsF(strong)
    reason = small.elidedText(tag.reason, Qt.TextElideMode.ElideRight, MOST_REASON)
    beside = large.horizontalAdvance(tag.value) + (
        GAP2 + small.horizontalAdvance(tag.old) if tag.old else 0.0
    )
    width = max(small.horizontalAdvance(tag.name), beside, small.horizontalAdvance(reason)) + 2 * GAP2
    height = small.height() * (2 if reason else 1) + large.height() + GAP2
    x, y = place.at(at)
    edge = place.left + place.width + 20.0
    left = x + 12.0 if x + 12.0 + width <= edge else max(x - 12.0 - width, 2.0)
    top = y - height - GAP2 if y - height - GAP2 > 2.0 else y + GAP2
    box = QRectF(left, top, width, height)
    ink = severity_ink(tag.severity) if tag.severity else colour("sel")
    painter.setPen(QPen(ink, 1))
    painter.setBrush(colour("raised"))
    painter.drawRoundedRect(box, RADIUS, RADIUS)
    inner = box.left() + GAP2
    first = box.top() + GAP + small.ascent()
    second = first + small.descent() + large.ascent()
    painter.setFont(caption)
    painter.setPen(colour("dim"))
    painter.drawText(QPointF(inner, first), tag.name)
    painter.drawText(QPointF(inner + large.horizontalAdvance(tag.value) + GAP2, second), tag.old)
    painter.setPen(ink)
    painter.drawText(QPointF(inner, second + large.descent() + small.ascent()), reason)
    painter.setFont(strong)
    painter.setPen(colour("text"))
    painter.drawText(QPointF(inner, second), tag.value)


def empty_text(scene: Scene) -> str:
    """Return what is shown instead of a scene in which nothing is drawn."""
    return scene.notes[0].text if scene.notes and not scene.lines else ""
