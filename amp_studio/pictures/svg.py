"""A scene as SVG, as reports print it."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape

from .frame import BOTTOM, Placement
from .scene import Dot, FilledArea, Point, Polyline, Scene, ShapeSort

WIDTH, HEIGHT = 720.0, 480.0
HEAD, NOTE = 34.0, 15.0
"""Height of the title and of a line of notes, in points."""
INKS: dict[ShapeSort, str] = {
    "ink": "#1a1e23", "dim": "#58606b", "limit": "#58606b", "now": "#1d5bcb", "second": "#7f8792", "error": "#b3261e",
    "forbidden": "#7f8792", "either": "#1d5bcb", "outside": "#0a6a72", "travel": "#1a1e23", "rail": "#7f8792", "overlap": "#c5cad2",
}  # fmt: skip
GRID, BASE, TEXT, DIM = "#e8eaee", "#ffffff", "#1a1e23", "#58606b"
FILLS: dict[ShapeSort, str] = {
    "forbidden": "url(#hatch)",
    "either": "url(#either)",
    "outside": "none",
    "error": "url(#wrong)",
    "overlap": "#e8eaee",
}
LETTER = 6.0
"""Width of a letter, about, in points."""
LINE = 13.0
"""Height of a line of text, in points."""
WRAP = 118
"""Letters in a line of notes."""


def scene_svg(scene: Scene, width: float = WIDTH, drawn: float = HEIGHT, *, notes: bool = True) -> str:
    """Return the SVG text of a scene in a width and, without title and notes, a height in points; ``notes`` are under it."""
    shown = sorted(scene.notes, key=lambda note: note.order) if notes else []
    lines = [line for note in shown for line in _wrapped(("! " if note.wrong else "") + note.text)]
    height = HEAD + drawn + NOTE * len(lines) + (8.0 if lines else 0.0)
    frame = Placement.within(scene, width, drawn)
    parts = [
        _opened(width, height),
        _patterns(),
        f'<rect width="{width:g}" height="{height:g}" fill="{BASE}"/>',
        _title(scene),
        f'<g transform="translate(0 {HEAD:g})">',
        *_grid(frame),
        *(_area(frame, area) for area in scene.areas),
        *(_line(frame, line) for line in scene.lines),
        *(_dot(frame, dot) for dot in scene.dots),
        *(
            _handle_dot(frame.at(handle.at))
            for handle in scene.handles
            if handle.second and len(handle.drags) == 1
        ),
        *_texts(frame, width),
        "</g>",
        *(
            f'<text x="16" y="{HEAD + drawn + NOTE * (n + 0.7):g}" fill="{INKS["error"] if line.startswith("! ") else DIM}">{escape(line.removeprefix("! "))}</text>'
            for n, line in enumerate(lines)
        ),
        "</svg>",
    ]
    return "\n".join(parts) + "\n"


def _opened(width: float, height: float) -> str:
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:g} {height:g}" width="{width:g}"'
        f' height="{height:g}" font-family="Inter, Helvetica, Arial, DejaVu Sans, sans-serif" font-size="11">'
    )


def _title(scene: Scene) -> str:
    return (
        f'<text x="16" y="22" fill="{TEXT}" font-size="15" font-weight="600">{escape(scene.title)} '
        f'<tspan fill="{DIM}" font-size="11" font-weight="400">{escape(scene.subtitle)}</tspan></text>'
    )


def _wrapped(text: str) -> Iterator[str]:
    line = ""
    for word in text.split():
        if len(line) + len(word) > WRAP:
            yield line.rstrip()
            line = "! " if text.startswith("! ") else ""
        line += word + " "
    yield line.rstrip()


def _patterns() -> str:
    hatches = (("hatch", INKS["forbidden"]), ("either", INKS["either"]), ("wrong", INKS["error"]))
    made = "".join(
        f'<pattern id="{name}" width="7" height="7" patternUnits="userSpaceOnUse" patternTransform="rotate(45)">'
        f'<line x1="0" y1="0" x2="0" y2="7" stroke="{ink}" stroke-opacity="0.45"/></pattern>'
        for name, ink in hatches
    )
    return f"<defs>{made}</defs>"


def _grid(frame: Placement) -> Iterator[str]:
    scene = frame.scene
    right, bottom = frame.left + frame.width, frame.top + frame.height
    for x, text in frame.ticks("x"):
        yield f'<path d="M{x:.1f} {frame.top:.1f}V{bottom:.1f}" stroke="{GRID}"/>'
        yield f'<text x="{x:.1f}" y="{bottom + 15:.1f}" fill="{DIM}" text-anchor="middle">{escape(text)}</text>'
    for y, text in frame.ticks("y"):
        yield f'<path d="M{frame.left:.1f} {y:.1f}H{right:.1f}" stroke="{GRID}"/>'
        yield f'<text x="{frame.left - 8:.1f}" y="{y + 4:.1f}" fill="{DIM}" text-anchor="end">{escape(text)}</text>'
    for at, _, unit in scene.y.rows:
        yield f'<text x="{right + 10:.1f}" y="{frame.at((scene.x.low, at))[1] + 4:.1f}" fill="{DIM}">{escape(unit)}</text>'
    yield f'<text x="{right:.1f}" y="{bottom + BOTTOM - 5:.1f}" fill="{DIM}" text-anchor="end">{escape(axis_text(scene, "x"))}</text>'
    upright = axis_text(scene, "y")
    fits = LETTER * len(upright) < frame.left - 8
    x, anchor = (frame.left - 8, "end") if fits else (8.0, "start")
    yield f'<text x="{x:.1f}" y="{frame.top - 10:.1f}" fill="{DIM}" text-anchor="{anchor}">{escape(upright)}</text>'


def axis_text(scene: Scene, axis: str) -> str:
    """Return what is measured along an axis: ``X, mm``."""
    scale = scene.x if axis == "x" else scene.y
    return ", ".join(part for part in (scale.label, scale.unit) if part) if not scale.rows else ""


def _area(frame: Placement, area: FilledArea) -> str:
    left, top = frame.at((area.left, area.top))
    right, bottom = frame.at((area.right, area.bottom))
    stroke = "none" if area.sort == "overlap" else INKS[area.sort]
    return f'<rect x="{left:.1f}" y="{top:.1f}" width="{right - left:.1f}" height="{bottom - top:.1f}" fill="{FILLS.get(area.sort, "none")}" stroke="{stroke}"/>'


def _line(frame: Placement, line: Polyline) -> str:
    points = " ".join(f"{x:.1f},{y:.1f}" for x, y in map(frame.at, line.points))
    dash = ' stroke-dasharray="5 4"' if line.dashed else ""
    width = 6.0 if line.sort == "rail" else 2.0 if line.sort in ("now", "error") else 1.2
    return f'<polyline points="{points}" fill="none" stroke="{INKS[line.sort]}" stroke-width="{width:g}" stroke-opacity="{0.5 if line.sort == "rail" else 1:g}"{dash}/>'


def _handle_dot(at: Point) -> str:
    return f'<circle cx="{at[0]:.1f}" cy="{at[1]:.1f}" r="3" fill="{BASE}" stroke="{INKS["ink"]}"/>'


def _dot(frame: Placement, dot: Dot) -> str:
    x, y = frame.at(dot.at)
    ink = INKS[dot.sort]
    if dot.kind == "home":
        return f'<path d="M{x - 10:.1f} {y:.1f}h20M{x:.1f} {y - 10:.1f}v20" stroke="{ink}" stroke-width="1.5"/><circle cx="{x:.1f}" cy="{y:.1f}" r="6" fill="none" stroke="{ink}" stroke-width="1.5"/>'
    if dot.kind == "switch":
        return f'<rect x="{x - 6:.1f}" y="{y - 6:.1f}" width="12" height="12" rx="2" fill="{ink}"/>'
    if dot.kind in ARROWS:
        return f'<path d="{_arrow(x, y, dot.kind)}" fill="none" stroke="{ink}" stroke-width="1.5"/>'
    if dot.kind in ("marker", "end"):
        return f'<path d="M{x:.1f} {y - 8:.1f}v16" stroke="{INKS["now"] if dot.kind == "marker" else ink}" stroke-width="2"/>'
    return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5" fill="{BASE}" stroke="{ink}" stroke-width="1.5"/>'


ARROWS = {"right": (1, 0), "left": (-1, 0), "up": (0, -1), "down": (0, 1)}
"""Where an arrow points, y downwards."""


def _arrow(x: float, y: float, kind: str) -> str:
    dx, dy = ARROWS[kind]
    x, y = x + 14.0 * abs(dy), y - 14.0 * abs(dx)
    tip = x + 11.0 * dx, y + 11.0 * dy
    sides = [(tip[0] - 5.0 * dx - 4.0 * s * dy, tip[1] - 5.0 * dy - 4.0 * s * dx) for s in (1, -1)]
    shaft = f"M{x - 11.0 * dx:.1f} {y - 11.0 * dy:.1f}L{tip[0]:.1f} {tip[1]:.1f}"
    return shaft + "".join(f"M{tip[0]:.1f} {tip[1]:.1f}L{a:.1f} {b:.1f}" for a, b in sides)


ANCHORS = {
    "left": ("start", 6.0, -6.0),
    "inside": ("start", 6.0, 15.0),
    "corner": ("end", -12.0, 22.0),
    "right": ("end", -6.0, -6.0),
    "middle": ("middle", 0.0, 4.0),
    "above": ("middle", 0.0, -10.0),
    "below": ("middle", 0.0, 20.0),
}
"""Anchor -> that of SVG, and how far a text lies from its point."""


def _texts(frame: Placement, width: float) -> Iterator[str]:
    """Yield the texts of a scene; one that would lie on another moves down by its height, a figure alone is left out."""
    taken: list[tuple[float, float, float]] = []
    for text in frame.scene.texts:
        x, y = frame.at(text.at)
        anchor, dx, dy = ANCHORS[text.anchor]
        if text.anchor == "above" and text.value:
            anchor = "start"
        long = LETTER * (len(text.text) + len(text.value) + 1)
        share = {"start": 0.0, "middle": 0.5, "end": 1.0}[anchor]
        left = x + dx - share * long
        left, y = max(min(left, width - long), 2.0), y + dy
        while any(abs(y - at) < LINE and left < right and left + long > start for start, right, at in taken):
            y += LINE
            if not text.value:
                break
        else:
            taken.append((left, left + long, y))
            value = (
                f'<tspan fill="{DIM}" font-weight="400">{escape(text.value)}</tspan>' if text.value else ""
            )
            weight = ' font-weight="600"' if text.value else ""
            at = left + share * long
            yield f'<rect x="{left:.1f}" y="{y - 9.5:.1f}" width="{long:.1f}" height="12" fill="{BASE}" fill-opacity="0.8"/>'
            yield f'<text x="{at:.1f}" y="{y:.1f}" fill="{INKS[text.sort]}" text-anchor="{anchor}"{weight}>{escape(text.text)} {value}</text>'
