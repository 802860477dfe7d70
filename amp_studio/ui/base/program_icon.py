"""The program's icon, painted: no picture file is needed."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QIcon, QPainter, QPen, QPixmap, QPolygonF


def program_icon() -> QIcon:
    """Return the program's icon: a step and the axis that follows it."""
    icon = QIcon()
    for size in (16, 32, 64, 128):
        icon.addPixmap(_drawn(size))
    return icon


def _drawn(size: int) -> QPixmap:
    picture = QPixmap(size, size)
    picture.fill(Qt.GlobalColor.transparent)
    painter = QPainter(picture)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.scale(size / 64, size / 64)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(QColor("#1a4f8a"))
    painter.drawRoundedRect(QRectF(2, 2, 60, 60), 12, 12)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    step = [QPointF(9, 48), QPointF(24, 48), QPointF(24, 17), QPointF(55, 17)]
    follow = [QPointF(24, 48), QPointF(29, 36), QPointF(35, 24), QPointF(43, 18), QPointF(55, 17)]
    for points, colour, width in ((step, "#8fb8e8", 4.0), (follow, "#ffb454", 6.0)):
        pen = QPen(QColor(colour), width)
        pen.setCapStyle(Qt.PenCapStyle.RoundCap)
        pen.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
        painter.setPen(pen)
        painter.drawPolyline(QPolygonF(points))
    painter.end()
    return picture
