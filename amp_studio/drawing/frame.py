"""Where a scene lies on paper or on a screen: world units to points, and the figures along its axes."""

from __future__ import annotations

import math
from dataclasses import dataclass

from .scene import Point, Scale, Scene
from .ticks import decades, figure_text, ticks

LEFT, RIGHT, TOP, BOTTOM = 64.0, 20.0, 28.0, 34.0
"""Room for figures and texts around a drawing, in points."""
_BARE = 12.0
"""Room above and below a diagram, whose axes are not written."""
EDGE = 8.0
"""The same around a diagram of boxes."""


@dataclass(frozen=True)
class Placement:
    """The place of a drawing: ``left``, ``top``, ``width`` and ``height`` in points, y downwards."""

    scene: Scene
    left: float
    top: float
    width: float
    height: float

    @classmethod
    def within(cls, scene: Scene, width: float, height: float) -> Placement:
        """Return the largest place in a sheet; with one scale for both axes in the middle of it."""
        if scene.rows:  # a diagram of boxes: no figures are around it
            return cls(scene, EDGE, EDGE, max(width - 2.0 * EDGE, 10.0), max(height - 2.0 * EDGE, 10.0))
        # Rows have their units at the right end, outside the frame.
        right = RIGHT + (44.0 if any(row[2] for row in scene.y.rows) else 0.0)
        # Beside axes that are not written nothing is: a diagram has the room for its own texts.
        top, bottom = (TOP, BOTTOM) if scene.x.is_written or scene.y.is_written else (_BARE, _BARE)
        inner = max(width - LEFT - right, 10.0), max(height - top - bottom, 10.0)
        if not scene.equal:
            return cls(scene, LEFT, top, *inner)
        return cls.equal_in(scene, LEFT, top, *inner)

    @classmethod
    def equal_in(cls, scene: Scene, left: float, top: float, width: float, height: float) -> Placement:
        """Return the largest place in a box where both axes have one scale, in the middle of it."""
        spans = scene.x.high - scene.x.low, scene.y.high - scene.y.low
        # The tighter of both: a circle must stay a circle, whatever the shape of the sheet.
        unit = min(width / spans[0], height / spans[1])
        size = spans[0] * unit, spans[1] * unit
        return cls(scene, left + 0.5 * (width - size[0]), top + 0.5 * (height - size[1]), *size)

    def at(self, point: Point) -> Point:
        """Return where a world point lies; a place beyond the edge is at the edge."""
        x = self.left + self.width * _share(self.scene.x, point[0])
        y = self.top + self.height * (1.0 - _share(self.scene.y, point[1]))
        return x, y

    def world(self, x: float, y: float) -> Point:
        """Return the world point at a place."""
        return (
            _of_share(self.scene.x, (x - self.left) / self.width),
            _of_share(self.scene.y, 1.0 - (y - self.top) / self.height),
        )

    def ticks(self, axis: str) -> list[tuple[float, str]]:
        """Return where the figures along x or y are, in points, with their text."""
        scale, horizontal = (self.scene.x, True) if axis == "x" else (self.scene.y, False)
        if scale.rows:
            marks = [(at, name) for at, name, _ in scale.rows]
        else:
            gap = _gap(self.scene, horizontal)
            room = (self.width if horizontal else self.height) / gap
            found = (
                decades(scale.low, scale.high, room)
                if scale.log
                else ticks(scale.low, scale.high, room, scale.step)
            )
            marks = [(value, figure_text(value)) for value in found]
        return [(self.at((v, v))[0 if horizontal else 1], text) for v, text in marks]


def _gap(scene: Scene, horizontal: bool) -> float:
    """Return the least distance of two figures in points: panels are low,
    and a logarithmic scale has its figures unevenly.
    """
    if scene.look == "panel":
        return 44.0 if horizontal and scene.x.log else 72.0 if horizontal else 30.0
    return 72.0 if horizontal else 40.0


def _share(scale: Scale, value: float) -> float:
    """Return how far along a scale a value is: 0 to 1, a hair more for one beyond an end."""
    if scale.log:
        # A logarithmic scale has no place for it: a frequency or a gain of 0 is drawn at its lower end.
        if value <= 0.0:
            return 0.0
        share = math.log(value / scale.low) / math.log(scale.high / scale.low)
    else:
        share = (value - scale.low) / (scale.high - scale.low)
    # A hair beyond the edge, so that a line is seen to leave the drawing; no farther, as infinite sides
    # come here too.
    return min(max(share, -0.02), 1.02)


def _of_share(scale: Scale, share: float) -> float:
    if scale.log:
        return float(scale.low * (scale.high / scale.low) ** share)
    return scale.low + share * (scale.high - scale.low)
