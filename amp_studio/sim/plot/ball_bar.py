"""Draws a ball-bar plot as SVG."""

from __future__ import annotations

import math
from collections.abc import Iterator

from amp_studio.sim.plot.panels import Picture
from amp_studio.sim.plot.picture import thinned
from amp_studio.sim.rounding import shown

from .svg_parts import COLOURS, DIM, EDGE, GRID, coordinate, line_svg, text_svg
from .ticks import ring_levels

BALL = 520
"""Side of a ball-bar plot."""


def ball_bar(picture: Picture, top: float, middle: float) -> Iterator[str]:
    """Yield the ball-bar plot: rings of equal deviation, the paths magnified between them."""
    centre, base = top + BALL / 2, 0.32 * BALL
    lines, most = ring_levels(picture.rings)
    scale = 0.16 * BALL / most

    def radius(deviation: float) -> float:
        return base + scale * deviation

    for level in lines:
        r = radius(level)
        width, colour = (1.4, DIM) if level == 0.0 else (1.0, EDGE)
        yield f'<circle cx="{coordinate(middle)}" cy="{coordinate(centre)}" r="{coordinate(r)}" fill="none" stroke="{colour}" stroke-width="{width}"/>'
    reach = radius(most) + 10
    yield line_svg(middle - reach, centre, middle + reach, centre, GRID)
    yield line_svg(middle, centre - reach, middle, centre + reach, GRID)
    for angle, name in ((0, "0"), (90, "90"), (180, "180"), (270, "270 deg")):
        r, turn = radius(most) + 22, math.radians(angle)
        yield text_svg(
            middle + r * math.cos(turn),
            centre - r * math.sin(turn) + 4,
            name,
            anchor="middle",
            size=11,
            fill=DIM,
        )
    for ring in picture.rings:
        angles, deviations = thinned(ring.angle, ring.deviation, 1440)
        points = " ".join(
            f"{coordinate(middle + radius(d) * math.cos(a))},{coordinate(centre - radius(d) * math.sin(a))}"
            for a, d in zip(angles.tolist(), deviations.tolist(), strict=True)
        )
        yield f'<polyline fill="none" stroke="{COLOURS[ring.role]}" stroke-width="1.6" stroke-linejoin="round" points="{points}"/>'
    for level in lines:
        r, words = radius(level), "programmed" if level == 0.0 else shown(level, picture.ring_unit, 3)
        x, y = middle + r * math.sin(0.6) + 3, centre - r * math.cos(0.6) - 3
        yield text_svg(x, y, words.replace("-", "−"), size=10, fill=DIM, over=True)
