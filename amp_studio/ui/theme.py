"""Colours, icons and number widths for light and dark desktops."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QGuiApplication, QIcon, QPainter, QPalette, QPen, QPixmap, QPolygonF
from PySide6.QtWidgets import QApplication, QStyle

FIGURE_SPACE = "\u2007"
"""A space as wide as a digit, to align numbers of different length."""


def is_dark() -> bool:
    """Return whether the desktop uses a dark palette."""
    return QGuiApplication.palette().color(QPalette.ColorRole.Window).lightness() < 128


def severity_colour(severity: str | None) -> QColor:
    """Return the background that marks a cell with a finding."""
    light = {"error": "#ffd6d2", "warning": "#ffeec2", "advice": "#dcebff"}
    dark = {"error": "#6b2b28", "warning": "#5c4a17", "advice": "#1f3d5e"}
    return QColor((dark if is_dark() else light).get(severity or "", "#00000000"))


def severity_ink(severity: str) -> QColor:
    """Return the text colour of a severity."""
    light = {"error": "#b3261e", "warning": "#8a5a00", "advice": "#1a5fb4"}
    dark = {"error": "#ff8a80", "warning": "#ffd166", "advice": "#8ab4f8"}
    return QColor((dark if is_dark() else light)[severity])


def severity_icon(severity: str) -> QIcon:
    """Return the icon of a severity."""
    icons = QStyle.StandardPixmap
    found = {"error": icons.SP_MessageBoxCritical, "warning": icons.SP_MessageBoxWarning}
    return standard_icon(found.get(severity, icons.SP_MessageBoxInformation))


def state_colour() -> QColor:
    """Return the text colour of an inactive parameter."""
    return QColor("#a0a0a0" if is_dark() else "#6e6e6e")


def standard_icon(icon: QStyle.StandardPixmap) -> QIcon:
    """Return a standard icon of the style; a black one is drawn in the text colour on a dark desktop."""
    found = QApplication.style().standardIcon(icon)
    return _in_ink(found) if is_dark() else found


def _in_ink(icon: QIcon) -> QIcon:
    picture = icon.pixmap(32, 32)
    image = picture.toImage()
    spots = [image.pixelColor(x, y) for x in range(0, image.width(), 2) for y in range(0, image.height(), 2)]
    solid = [spot for spot in spots if spot.alpha() > 128]
    if not solid or sum(spot.lightness() for spot in solid) / len(solid) > 70:
        return icon
    painter = QPainter(picture)
    painter.setCompositionMode(QPainter.CompositionMode.CompositionMode_SourceIn)
    painter.fillRect(picture.rect(), QGuiApplication.palette().color(QPalette.ColorRole.WindowText))
    painter.end()
    return QIcon(picture)


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
