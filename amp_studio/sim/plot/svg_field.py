"""A map of a figure over two values as SVG: cells, the edge of the safe region, the present and the best point."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from amp_studio.sim.rounding import shown

from .panels import Field
from .svg_parts import DIM, EDGE, ERROR, INK, coordinate, line_svg, text_svg

HEIGHT = 360.0
BAR = 14.0
"""Width of the scale of colours beside the map."""
LIGHT, DARK = (236, 243, 252), (20, 60, 130)
"""Colours of the smallest and the largest value."""
UNSAFE = 0.35
"""Opacity of a cell outside of the safe region."""
MOST_NUMBERS = 8
ROOM = 90.0


def shade(share: float) -> str:
    """Return the colour of a value by its place between the smallest and the largest one."""
    return "#" + "".join(
        f"{round(low + share * (high - low)):02x}" for low, high in zip(LIGHT, DARK, strict=True)
    )


def levels_of(field: Field) -> tuple[float, float]:
    """Return the values at both ends of the scale; of the safe cells where there are any, so that these differ."""
    known = np.isfinite(field.values)
    chosen = field.values[known & field.safe] if (known & field.safe).any() else field.values[known]
    if not chosen.size:
        return 0.0, 1.0
    low, high = float(chosen.min()), float(chosen.max())
    return (low, high) if high > low else (low, low + 1.0)


def field_svg(field: Field, left: float, top: float, right: float) -> Iterator[str]:
    """Yield the map between ``left`` and ``right``, HEIGHT high, and its numbers."""
    right -= ROOM
    wide, high = (right - left) / len(field.x), HEIGHT / len(field.y)
    unit = f" ({field.unit})" if field.unit else ""
    yield text_svg(left, top - 8, f"{field.label}{unit}; pale cells are not safe", size=12, weight="bold")
    least, most = levels_of(field)
    for n, row in enumerate(field.values.tolist()):
        for k, value in enumerate(row):
            if math.isnan(value):
                continue
            share = min(max((value - least) / (most - least), 0.0), 1.0)
            pale = "" if field.safe[n, k] else f' fill-opacity="{UNSAFE}"'
            y = top + HEIGHT - (n + 1) * high
            yield (
                f'<rect x="{coordinate(left + k * wide)}" y="{coordinate(y)}" width="{coordinate(wide + 0.3)}"'
                f' height="{coordinate(high + 0.3)}" fill="{shade(share)}"{pale}/>'
            )
    yield from _edge(field, left, top, wide, high)
    yield f'<rect x="{coordinate(left)}" y="{coordinate(top)}" width="{coordinate(right - left)}" height="{HEIGHT}" fill="none" stroke="{EDGE}"/>'
    yield from _numbers(field, left, top, wide, high)
    for name, point, colour in (("present", field.present, ERROR), ("best", field.best, "#0a6a72")):
        if point is not None:
            x = left + (_place(field.x, point[0]) + 0.5) * wide
            y = top + HEIGHT - (_place(field.y, point[1]) + 0.5) * high
            yield f'<circle cx="{coordinate(x)}" cy="{coordinate(y)}" r="5" fill="none" stroke="{colour}" stroke-width="2.4"/>'
            yield text_svg(x + 9, y + 4, name, size=11, fill=INK, over=True)
    yield from _scale(least, most, right + 22.0, top)


def _place(values: np.ndarray, value: float) -> float:
    """Return the place of a value among the cells, between two of them too."""
    return float(np.interp(value, values, np.arange(len(values))))


def _edge(field: Field, left: float, top: float, wide: float, high: float) -> Iterator[str]:
    """Yield the line between the safe cells and the others."""
    rows, columns = field.safe.shape
    for n in range(rows):
        for k in range(columns):
            x, y = left + (k + 1) * wide, top + HEIGHT - (n + 1) * high
            if k + 1 < columns and field.safe[n, k] != field.safe[n, k + 1]:
                yield line_svg(x, y, x, y + high, INK, width=1.6)
            if n + 1 < rows and field.safe[n, k] != field.safe[n + 1, k]:
                yield line_svg(x - wide, y, x, y, INK, width=1.6)


def _numbers(field: Field, left: float, top: float, wide: float, high: float) -> Iterator[str]:
    every = max(1, -(-len(field.x) // MOST_NUMBERS))
    for k in range(0, len(field.x), every):
        yield text_svg(
            left + (k + 0.5) * wide,
            top + HEIGHT + 14,
            shown(float(field.x[k]), digits=3),
            anchor="middle",
            size=11,
            fill=DIM,
        )
    every = max(1, -(-len(field.y) // (2 * MOST_NUMBERS)))
    for n in range(0, len(field.y), every):
        yield text_svg(
            left - 7,
            top + HEIGHT - (n + 0.5) * high + 4,
            shown(float(field.y[n]), digits=3),
            anchor="end",
            size=11,
            fill=DIM,
        )
    yield text_svg(
        left + 0.5 * wide * len(field.x), top + HEIGHT + 30, field.x_label, anchor="middle", size=11, fill=DIM
    )
    yield text_svg(left, top - 24, f"upwards: {field.y_label}", size=11, fill=DIM)


def _scale(least: float, most: float, x: float, top: float) -> Iterator[str]:
    steps = 24
    for n in range(steps):
        y = top + HEIGHT * (1.0 - (n + 1) / steps)
        yield f'<rect x="{x}" y="{coordinate(y)}" width="{BAR}" height="{coordinate(HEIGHT / steps + 0.5)}" fill="{shade((n + 0.5) / steps)}"/>'
    for value, y in ((most, top + 9), (0.5 * (least + most), top + HEIGHT / 2 + 4), (least, top + HEIGHT)):
        yield text_svg(x + BAR + 5, y, shown(value, "", 3), size=11, fill=DIM)
