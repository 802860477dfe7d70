"""Draws a trace as SVG: three panels with a common time axis."""

from __future__ import annotations

import math
from collections.abc import Sequence
from html import escape
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from .rounding import shown
from .trace import Trace

WIDTH, HEIGHT = 960, 760
LEFT, RIGHT, TOP, PANEL, GAP = 92, 868, 66, 188, 38
COMMAND, ACTUAL, THIRD, LIMIT = "#0072b2", "#d55e00", "#009e73", "#666666"
"""Colours that colour-blind readers can distinguish (Okabe, Ito, Color Universal Design, 2008); no pure red
and
green together."""
LABEL = 14.0
"""Height of a label; closer labels share one line."""
FAR = 1.6
"""A limit below this multiple of the peak is drawn as a line; a higher one is given as text."""

Series = npt.NDArray[np.float64]


def plot_svg(trace: Trace) -> str:
    """Return the SVG text: position, following error with its limits, velocity with torque."""
    time = trace.columns["time_s"]
    parts = [
        (
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}"'
            f' height="{HEIGHT}"'
            ' font-family="Helvetica, Arial, DejaVu Sans, sans-serif" font-size="13">'
        ),
        f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#ffffff"/>',
        _text(LEFT, 26, _title(trace), size=17, weight="bold"),
        _text(LEFT, 46, _subtitle(trace), fill="#444444"),
    ]
    parts += _position(trace, time, 0)
    parts += _error(trace, time, 1)
    parts += _speed(trace, time, 2)
    parts.append(_text((LEFT + RIGHT) / 2, HEIGHT - 14, "time (s)", anchor="middle"))
    parts.append("</svg>")
    return "\n".join(parts) + "\n"


def ticks(low: float, high: float, about: int = 5) -> list[float]:
    """Return round numbers (1, 2 or 5 times a power of ten apart) from low to high."""
    if not high > low:
        return [low]
    rough = (high - low) / about
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(power * n for n in (1.0, 2.0, 5.0, 10.0) if power * n >= rough * 0.999)
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    return [n * step for n in range(first, last + 1)]


def thinned(x: Series, y: Series, columns: int) -> tuple[Series, Series]:
    """Return the least and greatest value of each of ``columns`` stretches, so that no peak is lost."""
    if len(x) <= 4 * columns:
        return x, y
    edges = np.linspace(0, len(x), columns + 1).astype(np.int64)
    keep = {0, len(x) - 1}
    for start, end in pairwise(edges):
        keep.add(int(start + np.argmin(y[start:end])))
        keep.add(int(start + np.argmax(y[start:end])))
    index = np.array(sorted(keep))
    return x[index], y[index]


def _title(trace: Trace) -> str:
    axis = f", axis {trace.axis}" if trace.axis else ""
    return f"{trace.scenario}{axis}: {_figure(trace, 'distance')} at {_figure(trace, 'feedrate')}"


def _figure(trace: Trace, name: str) -> str:
    figure, unit = trace.result.get(name, (None, ""))
    return "-" if figure is None else shown(figure, unit)


def _subtitle(trace: Trace) -> str:
    parts = [
        (
            f"following error {_figure(trace, 'steady_following_error')}"
            f" (predicted {_figure(trace, 'predicted_following_error')})"
        ),
        f"peak torque {_figure(trace, 'peak_torque')}",
        f"in position after {_figure(trace, 'in_position_time')}",
    ]
    parts += [f"{alarm.code} at {shown(alarm.time_s, 's')}" for alarm in trace.alarms]
    return ", ".join(parts)


class _Panel:
    """One panel: its place and the two ranges it shows."""

    def __init__(self, number: int, time: Series, low: float, high: float) -> None:
        self.top = TOP + number * (PANEL + GAP)
        self.first, self.last = float(time[0]), max(float(time[-1]), float(time[0]) + 1e-9)
        if not high > low:
            low, high = low - 1.0, high + 1.0
        margin = 0.06 * (high - low)
        self.low, self.high = low - margin, high + margin

    def x(self, moment: float) -> float:
        return LEFT + (moment - self.first) / (self.last - self.first) * (RIGHT - LEFT)

    def y(self, value: float) -> float:
        return self.top + (self.high - value) / (self.high - self.low) * PANEL

    def frame(self, label: str) -> list[str]:
        """Return grid, numbers and the label of the left axis."""
        parts = [
            (
                f'<rect x="{LEFT}" y="{self.top}" width="{RIGHT - LEFT}" height="{PANEL}" fill="none"'
                ' stroke="#888888"/>'
            )
        ]
        for moment in ticks(self.first, self.last, 8):
            x = self.x(moment)
            parts.append(_line(x, self.top, x, self.top + PANEL, "#e2e2e2"))
            parts.append(_text(x, self.top + PANEL + 15, _number(moment), anchor="middle", size=11))
        for value in ticks(self.low, self.high):
            y = self.y(value)
            parts.append(_line(LEFT, y, RIGHT, y, "#e2e2e2"))
            parts.append(_text(LEFT - 6, y + 4, _number(value), anchor="end", size=11))
        middle = self.top + PANEL / 2
        parts.append(_text(20, middle, label, anchor="middle", turn=True))
        return parts

    def curve(self, time: Series, values: Series, colour: str, *, dashed: bool = False) -> str:
        xs, ys = thinned(time, values, RIGHT - LEFT)
        points = " ".join(
            f"{round(self.x(float(x)), 1)},{round(self.y(float(y)), 1)}" for x, y in zip(xs, ys, strict=True)
        )
        dash = ' stroke-dasharray="7 4"' if dashed else ""
        return f'<polyline fill="none" stroke="{colour}" stroke-width="1.6"{dash} points="{points}"/>'


def _position(trace: Trace, time: Series, number: int) -> list[str]:
    command, actual = trace.columns["command_position"], trace.columns["position"]
    panel = _Panel(number, time, *_range(command, actual))
    return [
        *panel.frame(f"position ({trace.units['position']})"),
        panel.curve(time, command, COMMAND, dashed=True),
        panel.curve(time, actual, ACTUAL),
        *_legend(panel, (("command", COMMAND), ("actual", ACTUAL))),
    ]


def _error(trace: Trace, time: Series, number: int) -> list[str]:
    error, unit = trace.columns["following_error"], trace.units["following_error"]
    low, high = _range(error)
    peak = max(abs(low), abs(high))
    sign = -1.0 if abs(low) > abs(high) else 1.0
    levels = [(name, level) for name, (level, _) in trace.limits.items() if level is not None]
    near = [(name, level) for name, level in levels if level <= FAR * peak]
    far = [(name, level) for name, level in levels if level > FAR * peak]
    for _, level in near:
        low, high = min(low, sign * level), max(high, sign * level)
    panel = _Panel(number, time, low, high)
    parts = [*panel.frame(f"following error ({unit})"), panel.curve(time, error, ACTUAL)]
    labels: list[tuple[float, str]] = []
    for name, level in sorted(near, key=lambda limit: limit[1]):
        y, words = panel.y(sign * level), f"{name} {shown(level, unit)}"
        parts.append(_line(LEFT, y, RIGHT, y, LIMIT, dash="3 3"))
        if labels and abs(labels[-1][0] - y) < LABEL:
            y, words = labels[-1][0], f"{labels.pop()[1]}, {words}"
        labels.append((y, words))
    for y, words in labels:
        below = y - panel.top < LABEL + 4  # no room above the line
        parts.append(_text(RIGHT - 6, y + 13 if below else y - 4, words, anchor="end", size=11, fill=LIMIT))
    if far:
        words = "outside the plot: " + ", ".join(f"{name} {shown(level, unit)}" for name, level in far)
        parts.append(_text(LEFT, panel.top - 6, words, size=11, fill=LIMIT))
    return parts


def _speed(trace: Trace, time: Series, number: int) -> list[str]:
    """Return the panel of velocities (left axis) and torque (right axis)."""
    command, actual = trace.columns["command_velocity"], trace.columns["velocity"]
    torque = trace.columns["torque_percent"]
    panel = _Panel(number, time, *_range(command, actual))
    right = _Panel(number, time, *_range(torque))
    parts = [*panel.frame(f"velocity ({trace.units['velocity']})"), right.curve(time, torque, THIRD)]
    parts += [
        _text(RIGHT + 6, right.y(value) + 4, _number(value), size=11, fill=THIRD)
        for value in ticks(right.low, right.high)
    ]
    parts += [
        _text(
            WIDTH - 14, panel.top + PANEL / 2, "torque (% of rated)", anchor="middle", turn=True, fill=THIRD
        ),
        panel.curve(time, command, COMMAND, dashed=True),
        panel.curve(time, actual, ACTUAL),
    ]
    return parts + _legend(panel, (("command", COMMAND), ("actual", ACTUAL), ("torque", THIRD)))


def _range(*series: Series) -> tuple[float, float]:
    return min(0.0, *(float(s.min()) for s in series)), max(0.0, *(float(s.max()) for s in series))


def _legend(panel: _Panel, entries: Sequence[tuple[str, str]]) -> list[str]:
    parts: list[str] = []
    x = RIGHT - 100.0 * len(entries) + 22.0
    for name, colour in entries:
        dash = "7 4" if colour == COMMAND else ""
        parts.append(_line(x, panel.top - 10, x + 24, panel.top - 10, colour, width=2.5, dash=dash))
        parts.append(_text(x + 30, panel.top - 6, name, size=11))
        x += 100.0
    return parts


def _line(
    x1: float, y1: float, x2: float, y2: float, colour: str, *, width: float = 1.0, dash: str = ""
) -> str:
    dashes = f' stroke-dasharray="{dash}"' if dash else ""
    return (
        f'<line x1="{round(x1, 1)}" y1="{round(y1, 1)}" x2="{round(x2, 1)}" y2="{round(y2, 1)}"'
        f' stroke="{colour}" stroke-width="{width}"{dashes}/>'
    )


def _text(
    x: float,
    y: float,
    words: str,
    *,
    anchor: str = "start",
    size: int = 13,
    weight: str = "normal",
    fill: str = "#111111",
    turn: bool = False,
) -> str:
    x, y = round(x, 1), round(y, 1)
    turned = f' transform="rotate(-90 {x} {y})"' if turn else ""
    return (
        f'<text x="{x}" y="{y}" text-anchor="{anchor}" font-size="{size}" font-weight="{weight}"'
        f' fill="{fill}"{turned}>{escape(words)}</text>'
    )


def _number(value: float) -> str:
    return shown(value, digits=6)
