"""Draws a picture as SVG: panels with a common axis, a close look at the settling, or a ball-bar plot."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from textwrap import wrap

import numpy as np

from amp_studio.sim.plot.panels import Curve, Panel, Picture
from amp_studio.sim.plot.picture import banded, limits_outside, picture_of, thinned, unheld
from amp_studio.sim.plot.svg_field import HEIGHT, field_svg
from amp_studio.sim.rounding import shown
from amp_studio.sim.series import Series
from amp_studio.sim.trace import Trace

from .ball_bar import BALL, ball_bar
from .svg_parts import COLOURS, DIM, EDGE, ERROR, GRID, coordinate, dot_svg, line_svg, number, text_svg
from .ticks import decades, multiples, ticks

WIDTH = 960
LEFT, TOP = 84, 84
MARGIN = 30
"""Room at the right."""
UNIT, GAP = 132, 34
"""Height of a panel of share 1, and between two panels."""
DASH = "6 4"
LABEL = 13.0
"""Height of a label; closer labels share one line."""
FACT = 16
"""Height of a line of facts below the title."""
WRAP = 150
"""Characters in a line of small print."""


def plot_svg(
    trace: Trace,
    before: Trace | None = None,
    *,
    width: int = WIDTH,
    unit: int = UNIT,
    small_print: bool = True,
) -> str:
    """Return the SVG text of a trace, with the trace before a change under it; ``unit`` is
    the height of a panel of share 1, ``small_print`` what was assumed.
    """
    right = width - MARGIN
    picture = picture_of(trace, before)
    parts: list[str] = []
    facts = _fact_lines(picture.facts, round(WRAP * width / WIDTH) - 14)
    y = TOP + float(FACT * max(0, len(facts) - 1))
    if picture.rings:
        parts += ball_bar(picture, y, (LEFT + right) / 2)
        y += BALL + GAP + 14
    if picture.field is not None:
        y += 22
        parts += field_svg(picture.field, LEFT, y, right)
        y += HEIGHT + GAP + 34
    for n, panel in enumerate(picture.panels):
        frame = _Frame(panel, y, unit, picture.x_log, right)
        parts += frame.drawn(picture.alarms, numbered=n == len(picture.panels) - 1)
        if panel.label == "following error" and (outside := limits_outside(trace)):
            words = "above the plot: " + ", ".join(
                f"{name} {level}" for name, level in outside.items()
            ).replace("_", " ")
            parts.append(text_svg(right, frame.top - 6, words, anchor="end", size=11, fill=DIM))
        y += frame.height + GAP
        if n == len(picture.panels) - 1:
            parts.append(
                text_svg((LEFT + right) / 2, y - 2, picture.x_label, anchor="middle", size=11, fill=DIM)
            )
    if picture.close is not None:
        y += 28
        frame = _Frame(picture.close, y, unit, False, right)
        parts += frame.drawn((), numbered=True)
        y += frame.height + GAP
        parts.append(
            text_svg(
                (LEFT + right) / 2, y - 2, "time (s), the end of the move", anchor="middle", size=11, fill=DIM
            )
        )
    y += 18
    for line in _small_print(picture) if small_print else ():
        parts.append(text_svg(LEFT, y, line, size=10.5, fill=DIM))
        y += 14
    return "\n".join([*_head(picture, facts, width, math.ceil(y + 6)), *parts, "</svg>"]) + "\n"


def _head(picture: Picture, facts: Sequence[str], width: int, height: int) -> Iterator[str]:
    yield (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}"'
        f' height="{height}" font-family="Inter, Helvetica, Arial, DejaVu Sans, sans-serif" font-size="12">'
    )
    yield f'<rect width="{width}" height="{height}" fill="#ffffff"/>'
    yield text_svg(LEFT, 28, picture.title, size=17, weight="bold")
    colour = ERROR if picture.alarms else DIM
    for n, line in enumerate(facts):
        yield text_svg(LEFT, 48 + FACT * n, line, fill=colour)


def _small_print(picture: Picture) -> list[str]:
    """Return what was assumed, in lines."""
    lines: list[str] = []
    for n, text in enumerate(picture.assumed):
        line = "Assumed: " if n == 0 else ""
        for word in text.split():
            if len(line) + len(word) > WRAP:
                lines.append(line)
                line = ""
            line += word + " "
        lines.append(line.rstrip())
    return lines


def _fact_lines(facts: Sequence[str], length: int) -> list[str]:
    """Return the facts in lines of a length, each fact whole where it is no longer than a line."""
    lines: list[str] = []
    for fact in facts:
        joined = f"{lines[-1]} · {fact}" if lines else fact
        lines[-1:] = [joined] if not lines or len(joined) <= length else [lines[-1], fact]
    return [part for line in lines for part in wrap(line, length)]


class _Frame:
    """One panel: its place and the ranges it shows."""

    def __init__(self, panel: Panel, top: float, unit: int, log: bool, right: float) -> None:
        self.panel, self.top, self.log, self.right = panel, top, log, right
        self.height = unit * panel.height
        xs = [c.x for c in panel.curves if len(c.x)]
        first = min((float(x[0]) for x in xs), default=0.0)
        last = max((float(x[-1]) for x in xs), default=1.0)
        self.first, self.last = (max(first, 1e-9), last) if log else (first, max(last, first + 1e-9))
        if log and not self.last > self.first:
            self.last = 10.0 * self.first
        self.low, self.high = self._range()

    def _range(self) -> tuple[float, float]:
        ys = [c.y for c in self.panel.curves if len(c.y)]
        low = min((float(y.min()) for y in ys), default=0.0)
        high = max((float(y.max()) for y in ys), default=0.0)
        if self.panel.label != "phase":
            low, high = min(0.0, low), max(0.0, high)
        for _, level in self.panel.levels:
            low, high = min(low, level), max(high, level)
        if not high > low:
            low, high = low - 1.0, high + 1.0
        margin = 0.06 * (high - low)
        return low - margin, high + margin

    def x(self, value: float) -> float:
        share = (
            math.log(value / self.first) / math.log(self.last / self.first)
            if self.log
            else (value - self.first) / (self.last - self.first)
        )
        return LEFT + share * (self.right - LEFT)

    def y(self, value: float) -> float:
        return self.top + (self.high - value) / (self.high - self.low) * self.height

    def drawn(self, alarms: Sequence[tuple[str, float]], numbered: bool) -> Iterator[str]:
        """Yield the whole panel, ``numbered`` with the numbers of the x axis."""
        yield from self._grid(numbered)
        for _, at in alarms:
            yield line_svg(self.x(at), self.top, self.x(at), self.top + self.height, ERROR, width=1.2)
        for _, level in self.panel.levels:
            yield line_svg(LEFT, self.y(level), self.right, self.y(level), DIM, dash="2 3")
        for curve in self.panel.curves:
            yield from self._curve(curve)
        yield from self._levels()
        yield from self._marks()
        yield from self._legend()

    def _grid(self, numbered: bool) -> Iterator[str]:
        bottom = self.top + self.height
        places = decades(self.first, self.last) if self.log else ticks(self.first, self.last, 10)
        if self.panel.label == "radius deviation":
            places = multiples(45.0, self.first, self.last)
        for place in places:
            yield line_svg(self.x(place), self.top, self.x(place), bottom, GRID)
            if numbered:
                yield text_svg(self.x(place), bottom + 14, number(place), anchor="middle", size=11, fill=DIM)
        step = self.panel.step
        about = max(4, round(self.height / 32))
        values = multiples(step, self.low, self.high) if step else ticks(self.low, self.high, about)
        for value in values:
            yield line_svg(LEFT, self.y(value), self.right, self.y(value), GRID)
            yield text_svg(LEFT - 7, self.y(value) + 4, number(value), anchor="end", size=11, fill=DIM)
        if self.low < 0.0 < self.high:
            yield line_svg(LEFT, self.y(0.0), self.right, self.y(0.0), EDGE)
        yield (
            f'<rect x="{LEFT}" y="{coordinate(self.top)}" width="{self.right - LEFT}" height="{coordinate(self.height)}" fill="none"'
            f' stroke="{EDGE}"/>'
        )
        unit = f" ({self.panel.unit})" if self.panel.unit else ""
        yield text_svg(LEFT, self.top - 8, f"{self.panel.label}{unit}", size=12, weight="bold")

    def _levels(self) -> Iterator[str]:
        """Yield the names of the levels, over the curves."""
        labels: list[tuple[float, str]] = []
        for name, level in sorted(self.panel.levels, key=lambda each: each[1]):
            y = self.y(level)
            if not name:
                continue
            words = (
                name
                if self.log or any(c.isdigit() for c in name)
                else f"{name} {shown(abs(level), self.panel.unit)}"
            )
            if labels and abs(labels[-1][0] - y) < LABEL:
                y, words = labels[-1][0], f"{labels.pop()[1]}, {words}"
            labels.append((y, words))
        for y, words in labels:
            below = y - self.top < LABEL + 4  # no room above the line
            yield text_svg(
                self.right - 6, y + 12 if below else y - 4, words, anchor="end", size=11, fill=DIM, over=True
            )

    def _marks(self) -> Iterator[str]:
        for n, (name, at) in enumerate(sorted(self.panel.marks, key=lambda mark: mark[1])):
            if not self.first <= at <= self.last:
                continue
            x = self.x(at)
            yield line_svg(x, self.top, x, self.top + self.height, DIM, dash="5 3")
            if self.log:
                yield text_svg(
                    x - 4,
                    self.top + self.height - 8 - 14 * (n % 2),
                    name,
                    anchor="end",
                    size=11,
                    fill=DIM,
                    over=True,
                )

    def _curve(self, curve: Curve) -> Iterator[str]:
        colour = COLOURS[curve.role]
        if curve.dots:
            yield from self._dots(curve, colour)
            return
        dash = DASH if curve.role == "command" else ""
        columns = int(self.right - LEFT)
        x, y = unheld(curve.x, curve.y) if curve.held else (curve.x, curve.y)
        if (curve.held or curve.dense) and len(x) > 2 * columns:
            x, y, least, most = banded(x, y, columns)
            outline = self._points(np.concatenate([x, x[::-1]]), np.concatenate([most, least[::-1]]))
            yield (
                f'<polygon fill="{colour}" fill-opacity="0.25" stroke="{colour}" stroke-opacity="0.4"'
                f' stroke-width="0.6" points="{outline}"/>'
            )
        else:
            x, y = thinned(x, y, columns)
        yield self._path(x, y, colour, dash)

    def _dots(self, curve: Curve, colour: str) -> Iterator[str]:
        for x, y in zip(curve.x.tolist(), curve.y.tolist(), strict=True):
            yield dot_svg(self.x(x), self.y(y), colour)

    def _path(self, x: Series, y: Series, colour: str, dash: str) -> str:
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        return (
            f'<polyline fill="none" stroke="{colour}" stroke-width="1.5" stroke-linejoin="round"{dashes}'
            f' points="{self._points(x, y)}"/>'
        )

    def _points(self, x: Series, y: Series) -> str:
        return " ".join(
            f"{coordinate(self.x(float(a)))},{coordinate(self.y(float(b)))}"
            for a, b in zip(x, y, strict=True)
        )

    def _legend(self) -> Iterator[str]:
        named = [c for c in self.panel.curves if c.name and len(c.x)]
        if len(named) < 2:
            return
        x, y, wide = self.right - sum(_width(c.name) for c in named), self.top - 8, 1.0
        if x < LEFT + _width(self.panel.label):  # beside the label there is no room: above it, once
            if self.top > TOP:
                return
            x, y, wide = float(LEFT), self.top - 24, 0.82
        for curve in named:
            dash = DASH if curve.role == "command" else ""
            if curve.dots:
                yield dot_svg(x + 14, y - 4, COLOURS[curve.role])
            else:
                yield line_svg(x, y - 4, x + 22, y - 4, COLOURS[curve.role], width=2, dash=dash)
            yield text_svg(x + 28, y, curve.name, size=11)
            x += wide * _width(curve.name)


def _width(words: str) -> float:
    return 44.0 + 6.6 * len(words)
