"""The parts of a plot as SVG: lines, dots and words, and their colours."""

from __future__ import annotations

from html import escape

from amp_studio.sim.rounding import shown

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

LETTER = 0.5
"""Width of a letter, about, in parts of its size."""


def coordinate(value: float) -> str:
    """Return a coordinate with one decimal at most."""
    return f"{value:.1f}".removesuffix(".0")


def line_svg(
    x1: float, y1: float, x2: float, y2: float, colour: str, *, width: float = 1.0, dash: str = ""
) -> str:
    """Return a straight line."""
    dashes = f' stroke-dasharray="{dash}"' if dash else ""
    return f'<line x1="{coordinate(x1)}" y1="{coordinate(y1)}" x2="{coordinate(x2)}" y2="{coordinate(y2)}" stroke="{colour}" stroke-width="{width}"{dashes}/>'


def dot_svg(x: float, y: float, colour: str) -> str:
    """Return a small ring."""
    return f'<circle cx="{coordinate(x)}" cy="{coordinate(y)}" r="2.6" fill="#ffffff" stroke="{colour}" stroke-width="1.4"/>'


def text_svg(
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
    """Return words; ``over`` curves on a light ground, so that they can be read: the rim of a letter would lie on the one before."""
    long = LETTER * size * len(words)
    left = x - {"start": 0.0, "middle": 0.5, "end": 1.0}[anchor] * long
    ground = (
        f'<rect x="{coordinate(left)}" y="{coordinate(y - 0.8 * size)}" width="{coordinate(long)}"'
        f' height="{coordinate(size)}" fill="#ffffff" fill-opacity="0.7"/>'
    )
    return (ground if over else "") + (
        f'<text x="{coordinate(x)}" y="{coordinate(y)}" text-anchor="{anchor}" font-size="{size}" font-weight="{weight}"'
        f' fill="{fill}">{escape(words)}</text>'
    )


def number(value: float) -> str:
    """Return a number of an axis, with a true minus sign."""
    return shown(value, digits=6).replace("-", "−")
