"""Draws a picture as SVG: panels with a common axis, a close look at the settling, or a ball-bar plot."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from html import escape

import numpy as np

from .picture import Curve, Panel, Picture, Ring, banded, limits_outside, picture_of, thinned, unheld
from .rounding import shown
from .series import Series
from .trace import Trace

WIDTH = 960
LEFT, TOP = 84, 84
MARGIN = 30
"""Room at the right."""
UNIT, GAP = 132, 34
"""Height of a panel of share 1, and between two panels."""
BALL = 520
"""Side of a ball-bar plot."""
INK, DIM, GRID, EDGE = "#1a1e23", "#58606b", "#e8eaee", "#c5cad2"
ERROR = "#b3261e"
COLOURS = {
    "command": "#58606b",
    "actual": "#1d5bcb",
    "other": "#0a6a72",
    "output": "#b25a00",
    "before": "#a3a9b3",
}
"""Colours that colour-blind readers can distinguish; the command is dashed as well."""
DASH = "6 4"
LABEL = 13.0
"""Height of a label; closer labels share one line."""
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
    y = float(TOP)
    if picture.rings:
        parts += _ball(picture, y, right)
        y += BALL + GAP + 14
    for n, panel in enumerate(picture.panels):
        frame = _Frame(panel, y, unit, picture.x_log, right)
        parts += frame.drawn(picture.alarms, numbered=n == len(picture.panels) - 1)
        if panel.label == "following error" and (outside := limits_outside(trace)):
            words = "above the plot: " + ", ".join(
                f"{name} {level}" for name, level in outside.items()
            ).replace("_", " ")
            parts.append(_text(right, frame.top - 6, words, anchor="end", size=11, fill=DIM))
        y += frame.height + GAP
        if n == len(picture.panels) - 1:
            parts.append(
                _text((LEFT + right) / 2, y - 2, picture.x_label, anchor="middle", size=11, fill=DIM)
            )
    if picture.close is not None:
        y += 28
        frame = _Frame(picture.close, y, unit, False, right)
        parts += frame.drawn((), numbered=True)
        y += frame.height + GAP
        parts.append(
            _text(
                (LEFT + right) / 2, y - 2, "time (s), the end of the move", anchor="middle", size=11, fill=DIM
            )
        )
    y += 18
    for line in _small_print(picture) if small_print else ():
        parts.append(_text(LEFT, y, line, size=10.5, fill=DIM))
        y += 14
    return "\n".join([*_head(picture, width, math.ceil(y + 6)), *parts, "</svg>"]) + "\n"


def _head(picture: Picture, width: int, height: int) -> Iterator[str]:
    yield (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}"'
        f' height="{height}" font-family="Inter, Helvetica, Arial, DejaVu Sans, sans-serif" font-size="12">'
    )
    yield f'<rect width="{width}" height="{height}" fill="#ffffff"/>'
    yield _text(LEFT, 28, picture.title, size=17, weight="bold")
    colour = ERROR if picture.alarms else DIM
    yield _text(LEFT, 48, _elided(" · ".join(picture.facts), round(WRAP * width / WIDTH) - 14), fill=colour)


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


def _elided(text: str, length: int) -> str:
    return text if len(text) <= length else text[: length - 1].rstrip() + "…"


def ticks(low: float, high: float, about: int = 5) -> list[float]:
    """Return round numbers (1, 2 or 5 times a power of ten apart) from low to high."""
    if not high > low:
        return [low]
    return multiples(round_step((high - low) / about), low, high)


def round_step(least: float) -> float:
    """Return the smallest of 1, 2 and 5 times the powers of ten that is not below a number."""
    power = 10.0 ** math.floor(math.log10(least))
    return next(power * n for n in (1.0, 2.0, 5.0, 10.0) if power * n >= least * 0.999)


def multiples(step: float, low: float, high: float) -> list[float]:
    """Return the multiples of a step from low to high."""
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    return [n * step for n in range(first, last + 1)]


def decades(low: float, high: float) -> list[float]:
    """Return 1, 2 and 5 times the powers of ten from low to high."""
    exponents = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    every = [n * 10.0**e for e in exponents for n in (1.0, 2.0, 5.0)]
    return [value for value in every if low * 0.999 <= value <= high * 1.001]


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
            yield _line(self.x(at), self.top, self.x(at), self.top + self.height, ERROR, width=1.2)
        for _, level in self.panel.levels:
            yield _line(LEFT, self.y(level), self.right, self.y(level), DIM, dash="2 3")
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
            yield _line(self.x(place), self.top, self.x(place), bottom, GRID)
            if numbered:
                yield _text(self.x(place), bottom + 14, _number(place), anchor="middle", size=11, fill=DIM)
        step = self.panel.step
        about = max(4, round(self.height / 32))
        values = multiples(step, self.low, self.high) if step else ticks(self.low, self.high, about)
        for value in values:
            yield _line(LEFT, self.y(value), self.right, self.y(value), GRID)
            yield _text(LEFT - 7, self.y(value) + 4, _number(value), anchor="end", size=11, fill=DIM)
        if self.low < 0.0 < self.high:
            yield _line(LEFT, self.y(0.0), self.right, self.y(0.0), EDGE)
        yield (
            f'<rect x="{LEFT}" y="{_n(self.top)}" width="{self.right - LEFT}" height="{_n(self.height)}" fill="none"'
            f' stroke="{EDGE}"/>'
        )
        unit = f" ({self.panel.unit})" if self.panel.unit else ""
        yield _text(LEFT, self.top - 8, f"{self.panel.label}{unit}", size=12, weight="bold")

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
            yield _text(
                self.right - 6, y + 12 if below else y - 4, words, anchor="end", size=11, fill=DIM, over=True
            )

    def _marks(self) -> Iterator[str]:
        for n, (name, at) in enumerate(sorted(self.panel.marks, key=lambda mark: mark[1])):
            if not self.first <= at <= self.last:
                continue
            x = self.x(at)
            yield _line(x, self.top, x, self.top + self.height, DIM, dash="5 3")
            if self.log:
                yield _text(
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
            yield _dot(self.x(x), self.y(y), colour)

    def _path(self, x: Series, y: Series, colour: str, dash: str) -> str:
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        return (
            f'<polyline fill="none" stroke="{colour}" stroke-width="1.5" stroke-linejoin="round"{dashes}'
            f' points="{self._points(x, y)}"/>'
        )

    def _points(self, x: Series, y: Series) -> str:
        return " ".join(f"{_n(self.x(float(a)))},{_n(self.y(float(b)))}" for a, b in zip(x, y, strict=True))

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
                yield _dot(x + 14, y - 4, COLOURS[curve.role])
            else:
                yield _line(x, y - 4, x + 22, y - 4, COLOURS[curve.role], width=2, dash=dash)
            yield _text(x + 28, y, curve.name, size=11)
            x += wide * _width(curve.name)


def _width(words: str) -> float:
    return 44.0 + 6.6 * len(words)


# -- ball-bar ----------------------------------------------------------------


def _ball(picture: Picture, top: float, right: float) -> Iterator[str]:
    """Yield the ball-bar plot: rings of equal deviation, the paths magnified between them."""
    middle, centre, base = (LEFT + right) / 2, top + BALL / 2, 0.32 * BALL
    lines, most = ring_levels(picture.rings)
    scale = 0.16 * BALL / most

    def radius(deviation: float) -> float:
        return base + scale * deviation

    for level in lines:
        r = radius(level)
        width, colour = (1.4, DIM) if level == 0.0 else (1.0, EDGE)
        yield f'<circle cx="{_n(middle)}" cy="{_n(centre)}" r="{_n(r)}" fill="none" stroke="{colour}" stroke-width="{width}"/>'
    reach = radius(most) + 10
    yield _line(middle - reach, centre, middle + reach, centre, GRID)
    yield _line(middle, centre - reach, middle, centre + reach, GRID)
    for angle, name in ((0, "0"), (90, "90"), (180, "180"), (270, "270 deg")):
        r, turn = radius(most) + 22, math.radians(angle)
        yield _text(
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
            f"{_n(middle + radius(d) * math.cos(a))},{_n(centre - radius(d) * math.sin(a))}"
            for a, d in zip(angles.tolist(), deviations.tolist(), strict=True)
        )
        yield f'<polyline fill="none" stroke="{COLOURS[ring.role]}" stroke-width="1.6" stroke-linejoin="round" points="{points}"/>'
    for level in lines:
        r, words = radius(level), "programmed" if level == 0.0 else shown(level, picture.ring_unit, 3)
        x, y = middle + r * math.sin(0.6) + 3, centre - r * math.cos(0.6) - 3
        yield _text(x, y, words.replace("-", "−"), size=10, fill=DIM, over=True)


def ring_levels(rings: Sequence[Ring]) -> tuple[list[float], float]:
    """Return the deviations at which a ball-bar plot has rings, and the largest that it shows."""
    peak = max((float(np.max(np.abs(r.deviation), initial=0.0)) for r in rings), default=0.0) or 1e-6
    step = round_step(0.5 * peak)
    count = math.ceil(peak / step - 1e-9)
    return [n * step for n in range(-count, count + 1)], count * step


# -- parts -------------------------------------------------------------------


def _n(value: float) -> str:
    """Return a coordinate with one decimal at most."""
    return f"{value:.1f}".removesuffix(".0")


def _line(
    x1: float, y1: float, x2: float, y2: float, colour: str, *, width: float = 1.0, dash: str = ""
) -> str:
    dashes = f' stroke-dasharray="{dash}"' if dash else ""
    return f'<line x1="{_n(x1)}" y1="{_n(y1)}" x2="{_n(x2)}" y2="{_n(y2)}" stroke="{colour}" stroke-width="{width}"{dashes}/>'


def _dot(x: float, y: float, colour: str) -> str:
    return f'<circle cx="{_n(x)}" cy="{_n(y)}" r="2.6" fill="#ffffff" stroke="{colour}" stroke-width="1.4"/>'


def _text(
    x: float,
    y: float,
    words: str,
    *,
    anchor: str = "start",
    size: float = 12,
    weight: str = "normal",
    fill: str = INK,
    over: bool = False,
) -> str:
    """Return words; ``over`` curves with a white rim, so that they can be read."""
    rim = ' stroke="#ffffff" stroke-width="4" stroke-linejoin="round" paint-order="stroke"' if over else ""
    return (
        f'<text x="{_n(x)}" y="{_n(y)}" text-anchor="{anchor}" font-size="{size}" font-weight="{weight}"'
        f' fill="{fill}"{rim}>{escape(words)}</text>'
    )


def _number(value: float) -> str:
    return shown(value, digits=6).replace("-", "−")
