"""A scene as SVG, as reports print it."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from html import escape

from .frame import Placement
from .labels import Label, labels_of
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
LETTER, CAPITAL, STRONG = 6.6, 7.4, 1.1
"""Width of a letter, about, in points; a strong text is so many times as wide."""
_LETTERS = {
    **dict.fromkeys("ijl.,:;'|!\u202f", 3.5),
    **dict.fromkeys('frt ()[]-/"', 4.4),
    **dict.fromkeys("mwMW%@", 10.0),
}
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
        *_texts(frame, width, drawn),
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
    right, bottom = frame.left + frame.width, frame.top + frame.height
    for x, _ in frame.ticks("x"):
        yield f'<path d="M{x:.1f} {frame.top:.1f}V{bottom:.1f}" stroke="{GRID}"/>'
    for y, _ in frame.ticks("y"):
        yield f'<path d="M{frame.left:.1f} {y:.1f}H{right:.1f}" stroke="{GRID}"/>'


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


@lru_cache(4096)
def measured(text: str, strong: bool) -> float:
    """Return how wide a text is in the widest of the fonts that an SVG names, about, in points."""
    wide = sum(_LETTERS.get(letter, CAPITAL if letter.isupper() else LETTER) for letter in text)
    return wide * STRONG if strong else wide


def _texts(frame: Placement, width: float, height: float) -> Iterator[str]:
    """Yield the texts of a scene where each has room; one that has none is shown under the pointer."""
    found = labels_of(frame, width, height, measured, LINE)
    for at, text in found.left_out:
        yield f'<circle cx="{at[0]:.1f}" cy="{at[1]:.1f}" r="9" fill="{BASE}" fill-opacity="0"><title>{escape(text)}</title></circle>'
    for label in found.shown:
        if label.leader:
            (x1, y1), (x2, y2) = label.leader
            yield f'<path d="M{x1:.1f} {y1:.1f}L{x2:.1f} {y2:.1f}" stroke="{INKS["second"]}" stroke-width="0.75"/>'
    for label in found.shown:
        if label.strong:
            box = label.box
            yield f'<rect x="{box.left:.1f}" y="{box.top:.1f}" width="{box.width:.1f}" height="{box.height:.1f}" fill="{BASE}" fill-opacity="0.8"/>'
        yield _label(label)


def _label(label: Label) -> str:
    box, value = label.box, ""
    if label.value:
        value = f' <tspan fill="{DIM}" font-weight="400">{escape(label.value)}</tspan>'
    weight = ' font-weight="600"' if label.strong else ""
    x = box.left + 0.5 * box.width  # an estimated width is wrong by as much on both sides
    return f'<text x="{x:.1f}" y="{box.top + 0.8 * box.height:.1f}" fill="{INKS[label.sort]}" text-anchor="middle"{weight}>{escape(label.text)}{value}</text>'
