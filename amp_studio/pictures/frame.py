"""Where a scene lies on paper or on a screen: world units to points, and the figures along its axes."""

from __future__ import annotations

import math
from dataclasses import dataclass

from .figures import multiple, nice
from .scene import Point, Scale, Scene

LEFT, RIGHT, TOP, BOTTOM = 64.0, 20.0, 28.0, 34.0
"""Room for figures and texts around a drawing, in points."""


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
        right = RIGHT + (44.0 if any(row[2] for row in scene.y.rows) else 0.0)
        inner = max(width - LEFT - right, 10.0), max(height - TOP - BOTTOM, 10.0)
        if not scene.equal:
            return cls(scene, LEFT, TOP, *inner)
        spans = scene.x.high - scene.x.low, scene.y.high - scene.y.low
        unit = min(inner[0] / spans[0], inner[1] / spans[1])
        size = spans[0] * unit, spans[1] * unit
        return cls(scene, LEFT + 0.5 * (inner[0] - size[0]), TOP + 0.5 * (inner[1] - size[1]), *size)

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
            room = (self.width if horizontal else self.height) / (72.0 if horizontal else 40.0)
            marks = [(value, figure_text(value)) for value in _values(scale, room)]
        return [(self.at((v, v))[0 if horizontal else 1], text) for v, text in marks]


def _share(scale: Scale, value: float) -> float:
    if scale.log:
        if value <= 0.0:
            return 0.0
        share = math.log(value / scale.low) / math.log(scale.high / scale.low)
    else:
        share = (value - scale.low) / (scale.high - scale.low)
    return min(max(share, -0.02), 1.02)


def _of_share(scale: Scale, share: float) -> float:
    if scale.log:
        return float(scale.low * (scale.high / scale.low) ** share)
    return scale.low + share * (scale.high - scale.low)


def _values(scale: Scale, about: float) -> list[float]:
    """Return round numbers along a scale."""
    if scale.log:
        exponents = range(math.floor(math.log10(scale.low)), math.ceil(math.log10(scale.high)) + 1)
        steps = (
            (1.0,) if len(exponents) > about else (1.0, 2.0, 5.0) if 2 * len(exponents) < about else (1.0,)
        )
        every = [n * 10.0**e for e in exponents for n in steps]
        return [multiple(v, 10.0 ** math.floor(math.log10(v))) for v in every if scale.low <= v <= scale.high]
    step = nice((scale.high - scale.low) / max(about, 2.0))
    first, last = math.ceil(scale.low / step - 1e-9), math.floor(scale.high / step + 1e-9)
    return [multiple(n * step, step) for n in range(first, last + 1)]


def figure_text(value: float) -> str:
    """Write a number beside an axis: grouped by narrow spaces from five digits on, with a real minus."""
    text = f"{value:.10g}"
    if "e-" in text:
        text = f"{value:.12f}".rstrip("0").rstrip(".")
    sign, digits = ("−", text[1:]) if text.startswith("-") else ("", text)
    whole, point, decimals = digits.partition(".")
    if len(whole) > 4 and whole.isdigit():
        whole = f"{int(whole):,}".replace(",", "\u202f")
    return sign + whole + point + decimals
