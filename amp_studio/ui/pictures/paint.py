"""Paints what a picture has beside its scene: handles, the tag of one,
and what is shown where nothing is drawn.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QFontMetricsF, QPainter, QPen

from amp_studio.drawing import Handle, Placement, Scene
from amp_studio.ui.base.theme import GAP, GAP2, RADIUS, colour, font, severity_colour

_MAX_REASON = 380.0
"""Width of a reason in a tag, in logical pixels; the findings have the whole of it."""
_HANDLE = 9.0
"""Side of a handle in logical pixels."""


def paint_handles(painter: QPainter, place: Placement, handles: Iterator[tuple[Handle, bool, str]]) -> None:
    """Paint handles, each with whether it has the focus and the severity of its finding.

    A square for one value, a circle for one of less weight, a small square for those of a corner;
    filled where it has the focus.
    """
    half = 0.5 * _HANDLE
    for handle, is_active, severity in handles:
        at = QPointF(*place.at(handle.at))
        shade = severity_colour(severity) if severity else colour("sel" if is_active else "text")
        painter.setPen(QPen(shade, 1.5))
        painter.setBrush(shade if is_active else colour("base"))
        if len(handle.drags) > 1:
            painter.setPen(QPen(shade if is_active or severity else colour("edge"), 1))
            painter.drawRect(QRectF(at.x() - 3, at.y() - 3, 6, 6))
        elif handle.second:
            painter.drawEllipse(at, half - 0.5, half - 0.5)
        else:
            painter.drawRoundedRect(QRectF(at.x() - half, at.y() - half, _HANDLE, _HANDLE), 1.5, 1.5)


class Tag(NamedTuple):
    """What a handle is and has."""

    name: str
    value: str
    old: str = ""
    """``was −150 mm``"""
    reason: str = ""
    """Why it goes no further, or what is found there."""
    severity: str = ""


def paint_tag(painter: QPainter, place: Placement, at: tuple[float, float], tag: Tag) -> None:
    """Paint a tag beside its handle, where the picture has room."""
    caption, strong = font("caption"), font("small")
    strong.setWeight(strong.Weight.DemiBold)
    small, large = QFontMetricsF(caption), QFontMetricsF(strong)
    reason = small.elidedText(tag.reason, Qt.TextElideMode.ElideRight, _MAX_REASON)
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
    shade = severity_colour(tag.severity) if tag.severity else colour("sel")
    painter.setPen(QPen(shade, 1))
    painter.setBrush(colour("raised"))
    painter.drawRoundedRect(box, RADIUS, RADIUS)
    inner = box.left() + GAP2
    first = box.top() + GAP + small.ascent()
    second = first + small.descent() + large.ascent()
    painter.setFont(caption)
    painter.setPen(colour("dim"))
    painter.drawText(QPointF(inner, first), tag.name)
    painter.drawText(QPointF(inner + large.horizontalAdvance(tag.value) + GAP2, second), tag.old)
    painter.setPen(shade)
    painter.drawText(QPointF(inner, second + large.descent() + small.ascent()), reason)
    painter.setFont(strong)
    painter.setPen(colour("text"))
    painter.drawText(QPointF(inner, second), tag.value)


def empty_text(scene: Scene) -> str:
    """Return what is shown instead of a scene in which nothing is drawn."""
    return scene.notes[0].text if scene.notes and not scene.lines else ""
