"""Scenes as SVG: one alone, as reports print pictures, or a plot of several panels."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache
from html import escape
from textwrap import wrap
from typing import Any

from .frame import Placement
from .labels import LEFT_EDGE, SAMPLE, Heading, Label, heading_of, labels_of
from .scene import Curve, Dot, FilledArea, HeatMap, Picture, Point, Polyline, Scene, ShapeSort
from .ticks import figure_text

WIDTH, HEIGHT = 720.0, 480.0
HEAD, NOTE = 34.0, 15.0
"""Height of the title and of a line of notes, in points."""
COLOURS: dict[ShapeSort, str] = {
    "ink": "#1a1e23",
    "dim": "#58606b",
    "limit": "#58606b",
    "now": "#1d5bcb",
    "second": "#7f8792",
    "error": "#b3261e",
    "forbidden": "#7f8792",
    "either": "#1d5bcb",
    "outside": "#0a6a72",
    "travel": "#1a1e23",
    "rail": "#7f8792",
    "overlap": "#c5cad2",
    "gap": "#b25a00",
    "output": "#b25a00",
    "before": "#a3a9b3",
}
"""Colours that colour-blind readers can distinguish; a command is dashed as well."""
_DASH = ' stroke-dasharray="6 4"'
GRID, BASE, TEXT, DIM = "#e8eaee", "#ffffff", "#1a1e23", "#58606b"
FILLS: dict[ShapeSort, str] = {
    "forbidden": "url(#hatch)",
    "either": "url(#either)",
    "outside": "none",
    "error": "url(#wrong)",
    "overlap": "#e8eaee",
    "gap": "#fff1d0",
}
PLAIN = ("overlap", "gap")
"""Areas without an edge."""
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
PLOT_WIDTH, PLOT_UNIT = 960, 132
"""Width of a plot, and the height of a panel of share 1."""
PLOT_LEFT, PLOT_RIGHT, PLOT_TOP, PLOT_GAP = 84.0, 30.0, 76.0, 34.0
"""Room around the panels of a plot and between two of them."""
FACT, SMALL_PRINT = 16.0, 14.0
"""Height of a line of facts, and of the small print."""
BAR, BAR_ROOM, BAR_STEPS = 14.0, 90.0, 24
"""Width of the scale of colours beside a map, the room for it with its figures, and its steps."""
LIGHT, DARK = (236, 243, 252), (20, 60, 130)
"""Colours of the smallest and the largest value of a map."""
PALE = 0.35
"""Opacity of a cell that is not safe."""
PLOT_WRAP = 150
"""Letters in a line of small print of a plot of the usual width."""


def scene_svg(scene: Scene, width: float = WIDTH, drawn: float = HEIGHT, *, notes: bool = True) -> str:
    """Return the SVG text of a scene in a width and, without title and notes, a height in points;
    ``notes`` are under it.
    """
    ordered = sorted(scene.notes, key=lambda note: note.order) if notes else []
    lines = [line for note in ordered for line in _wrapped(("! " if note.wrong else "") + note.text)]
    height = HEAD + drawn + NOTE * len(lines) + (8.0 if lines else 0.0)
    frame = Placement.within(scene, width, drawn)
    parts = [
        _opened(width, height),
        _patterns(),
        f'<rect width="{width:g}" height="{height:g}" fill="{BASE}"/>',
        _title(scene),
        f'<g transform="translate(0 {HEAD:g})">',
        *_shapes(frame),
        *_texts(frame, width, drawn),
        "</g>",
        *(
            f'<text x="16" y="{HEAD + drawn + NOTE * (n + 0.7):g}"'
            f' fill="{COLOURS["error"] if line.startswith("! ") else DIM}">'
            f"{escape(line.removeprefix('! '))}</text>"
            for n, line in enumerate(lines)
        ),
        "</svg>",
    ]
    return "\n".join(parts) + "\n"


def picture_svg(
    picture: Picture, *, width: int = PLOT_WIDTH, unit: int = PLOT_UNIT, small_print: bool = True
) -> str:
    """Return the SVG text of panels below each other; ``unit`` is the height in points of a panel of share 1,
    ``small_print`` what was assumed.
    """
    letters = round(PLOT_WRAP * width / PLOT_WIDTH)
    # Facts are in larger letters than the small print: fewer go into a line.
    facts = _fact_lines(picture.facts, letters - 14)
    y = PLOT_TOP + FACT * max(0, len(facts) - 1)
    scenes = (*filter(None, [picture.above]), *picture.panels, *filter(None, [picture.close]))
    parts: list[str] = []
    for scene in scenes:
        right = width - PLOT_RIGHT
        heading = heading_of(scene, PLOT_LEFT, right, _with_room) if scene.look == "panel" else []
        y += LINE * max((piece.line for piece in heading), default=0)
        height = scene.share * unit
        frame = _place_of(scene, right, y, height)
        parts += [*_heading(heading, y), *_shapes(frame), *_texts(frame, width, y + height + PLOT_GAP)]
        y += height + PLOT_GAP + (20.0 if scene.x.is_written else 0.0)
    for line in _assumed_lines(picture, letters) if small_print else ():
        y += SMALL_PRINT
        parts.append(f'<text x="{PLOT_LEFT:g}" y="{y:g}" fill="{DIM}" font-size="10.5">{escape(line)}</text>')
    head = [
        _opened(width, y + 12.0),
        f'<rect width="{width}" height="{y + 12.0:g}" fill="{BASE}"/>',
        (
            f'<text x="{PLOT_LEFT:g}" y="28" fill="{TEXT}" font-size="17"'
            f' font-weight="600">{escape(picture.title)}</text>'
        ),
    ]
    colour = COLOURS["error"] if picture.has_alarm else DIM
    for n, line in enumerate(facts):
        head.append(
            f'<text x="{PLOT_LEFT:g}" y="{48 + FACT * n:g}" fill="{colour}"'
            f' font-size="12">{escape(line)}</text>'
        )
    return "\n".join([*head, *parts, "</svg>"]) + "\n"


def panels_json(picture: Picture, *, width: int = PLOT_WIDTH, unit: int = PLOT_UNIT) -> list[dict[str, Any]]:
    """Return the panels that ``picture_svg`` draws as plain data: of each curve the values that are drawn."""
    scenes = (*picture.panels, *filter(None, [picture.close]))
    places = (_place_of(scene, width - PLOT_RIGHT, 0.0, scene.share * unit) for scene in scenes)
    return [_panel_json(place) for place in places]


def _panel_json(frame: Placement) -> dict[str, Any]:
    """Return a panel as plain data: its scales, levels and the values of its curves."""
    from .strokes import drawn_values  # numpy, as below

    scene, curves = frame.scene, []
    for curve in scene.curves:
        x, y, band = drawn_values(frame, curve)
        columns = {"x": x, "y": y, **dict(zip(("least", "most"), band or (), strict=False))}
        # Six digits: more than a drawing shows, and a third of the size.
        curves.append({"name": curve.name, **{n: [float(f"{v:.6g}") for v in c] for n, c in columns.items()}})
    return {
        "title": scene.title,
        "x": {"name": scene.x.label, "unit": scene.x.unit or None, "log": scene.x.log},
        "unit": scene.y.unit or None,
        "levels": [{"name": level.name, "value": level.at} for level in scene.levels],
        "curves": curves,
    }


def _place_of(scene: Scene, right: float, top: float, height: float) -> Placement:
    """Return the place of a panel from the left margin to ``right``, or of rings in the middle of it."""
    width = right - PLOT_LEFT - (BAR_ROOM if scene.cells else 0.0)
    if not scene.equal:
        return Placement(scene, PLOT_LEFT, top, width, height)
    return Placement.equal_in(scene, PLOT_LEFT, top, width, height)


def _fact_lines(facts: Sequence[str], length: int) -> list[str]:
    """Return the facts in lines of a length, each fact whole where it is no longer than a line."""
    lines: list[str] = []
    for fact in facts:
        joined = f"{lines[-1]} · {fact}" if lines else fact
        lines[-1:] = [joined] if not lines or len(joined) <= length else [lines[-1], fact]
    return [part for line in lines for part in wrap(line, length)]


def _assumed_lines(picture: Picture, letters: int) -> list[str]:
    texts = [("Assumed: " if n == 0 else "") + text for n, text in enumerate(picture.assumed)]
    return [line for text in texts for line in wrap(text, letters)]


def _heading(pieces: Sequence[Heading], top: float) -> Iterator[str]:
    """Yield the heading of a panel, its last line just above it."""
    last = max((piece.line for piece in pieces), default=0)
    for piece in pieces:
        x, base = piece.x, top - 8.0 - LINE * (last - piece.line)
        if piece.curve is not None:
            yield _sample(piece.curve, x, base - 4.0)
            x += SAMPLE + 6.0
        look = (
            f'fill="{TEXT}" font-weight="600"' if piece.strong else f'fill="{TEXT if piece.curve else DIM}"'
        )
        yield f'<text x="{x:.1f}" y="{base:.1f}" {look}>{escape(piece.text)}</text>'


def _sample(curve: Curve, x: float, y: float) -> str:
    stroke = COLOURS[curve.sort]
    if curve.dots:
        return _ring(x + 0.5 * SAMPLE, y, stroke)
    return (
        f'<path d="M{x:.1f} {y:.1f}h{SAMPLE:g}" stroke="{stroke}"'
        f' stroke-width="2"{_DASH if curve.dashed else ""}/>'
    )


def _shapes(frame: Placement) -> Iterator[str]:
    """Yield all of a scene but its texts."""
    scene = frame.scene
    yield from _grid(frame)
    yield from (_area(frame, area) for area in scene.areas)
    if scene.cells is not None:
        yield from _cells(frame, scene.cells)
    yield from (_line(frame, line) for line in scene.lines)
    yield from _across(frame)
    for curve in scene.curves:
        yield from _curve(frame, curve)
    yield from (_dot(frame, dot) for dot in scene.dots)
    for handle in scene.handles:
        if handle.second and len(handle.drags) == 1:
            yield _handle_dot(frame.at(handle.at))


def _across(frame: Placement) -> Iterator[str]:
    """Yield levels and marks."""
    right, bottom = frame.left + frame.width, frame.top + frame.height
    for level in frame.scene.levels:
        y = frame.at((0.0, level.at))[1]
        yield (
            f'<path d="M{frame.left:.1f} {y:.1f}H{right:.1f}" stroke="{COLOURS[level.sort]}"'
            f' stroke-dasharray="2'
            ' 3"/>'
        )
    for mark in frame.scene.marks:
        x, dash = frame.at((mark.at, 0.0))[0], "" if mark.sort == "error" else ' stroke-dasharray="5 3"'
        yield f'<path d="M{x:.1f} {frame.top:.1f}V{bottom:.1f}" stroke="{COLOURS[mark.sort]}"{dash}/>'


def _cells(frame: Placement, cells: HeatMap) -> Iterator[str]:
    """Yield the rectangles of a map and the bar with its scale at the right."""
    from .strokes import cell_boxes  # see below

    for left, top, width, height, share, is_safe in cell_boxes(frame, cells):
        pale = "" if is_safe else f' fill-opacity="{PALE}"'
        yield (
            f'<rect x="{_short(left)}" y="{_short(top)}" width="{_short(width)}" height="{_short(height)}"'
            f' fill="{_shade(share)}"{pale}/>'
        )
    left, step = frame.left + frame.width + 22.0, frame.height / BAR_STEPS
    for n in range(BAR_STEPS):
        top = frame.top + frame.height - (n + 1) * step
        yield (
            # Half a point higher than the step: viewers leave hair lines between rectangles that only
            # touch.
            f'<rect x="{left:.1f}" y="{top:.1f}" width="{BAR:g}" height="{step + 0.5:.1f}"'
            f' fill="{_shade((n + 0.5) / BAR_STEPS)}"/>'
        )
    for y, text in bar_figures(frame, cells):
        yield f'<text x="{left + BAR + 5:.1f}" y="{y + 4:.1f}" fill="{DIM}">{escape(text)}</text>'


def bar_figures(frame: Placement, cells: HeatMap) -> list[tuple[float, str]]:
    """Return the figures beside the scale of colours: where, and what."""
    least, most = cells.ends
    return [
        (
            # Moved in by half a line, or the outer two figures would jut out above and below the bar.
            frame.top + (1.0 - share) * (frame.height - 8.0) + 4.0,
            figure_text(float(f"{least + share * (most - least):.3g}")),
        )
        for share in (0.0, 0.5, 1.0)
    ]


def _shade(share: float) -> str:
    """Return the colour of a value by its place between the smallest and the largest one."""
    mixed = (round(low + share * (high - low)) for low, high in zip(LIGHT, DARK, strict=True))
    return "#" + "".join(f"{part:02x}" for part in mixed)


def _curve(frame: Placement, curve: Curve) -> Iterator[str]:
    """Yield a curve: rings, or a line over its band."""
    from .strokes import strokes_of  # numpy, which a picture without curves does not need

    stroke = COLOURS[curve.sort]
    line, band = strokes_of(frame, curve)
    if curve.dots:
        yield from (_ring(x, y, stroke) for x, y in line.tolist())
        return
    if band is not None:
        yield (
            f'<polygon fill="{stroke}" fill-opacity="0.25" stroke="{stroke}" stroke-opacity="0.4"'
            f' stroke-width="0.6" points="{_joined(band.tolist())}"/>'
        )
    dash = _DASH if curve.dashed else ""
    yield (
        f'<polyline fill="none" stroke="{stroke}" stroke-width="1.5" stroke-linejoin="round"{dash}'
        f' points="{_joined(line.tolist())}"/>'
    )


def _joined(points: Sequence[Sequence[float]]) -> str:
    """Return points in the coordinates of ``_short``: thousands of a curve, shortened all at once."""
    text = " ".join([f"{x:.1f},{y:.1f}" for x, y in points])
    return text.replace(".0,", ",").replace(".0 ", " ").removesuffix(".0")


def _short(value: float) -> str:
    """Return a coordinate with one decimal at most."""
    return f"{value:.1f}".removesuffix(".0")


def _ring(x: float, y: float, stroke: str) -> str:
    return (
        f'<circle cx="{_short(x)}" cy="{_short(y)}" r="2.6" fill="{BASE}"'
        f' stroke="{stroke}" stroke-width="1.4"/>'
    )


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
    """Yield the lines of a note, of at most `WRAP` characters."""
    line = ""
    for word in text.split():
        if len(line) + len(word) > WRAP:
            yield line.rstrip()
            # Each line of a note carries the mark: the colour of a line is chosen by it alone.
            line = "! " if text.startswith("! ") else ""
        line += word + " "
    yield line.rstrip()


def _patterns() -> str:
    """Return the hatches with which areas are filled."""
    hatches = (("hatch", COLOURS["forbidden"]), ("either", COLOURS["either"]), ("wrong", COLOURS["error"]))
    made = "".join(
        f'<pattern id="{name}" width="7" height="7" patternUnits="userSpaceOnUse"'
        f' patternTransform="rotate(45)"><line x1="0" y1="0" x2="0" y2="7" stroke="{stroke}"'
        ' stroke-opacity="0.45"/></pattern>'
        for name, stroke in hatches
    )
    return f"<defs>{made}</defs>"


def _grid(frame: Placement) -> Iterator[str]:
    """Yield the lines of the scales; a panel has its zero and a frame, rings have neither."""
    right, bottom = frame.left + frame.width, frame.top + frame.height
    if frame.scene.look == "rings":
        return
    for x, _ in frame.ticks("x"):
        yield f'<path d="M{x:.1f} {frame.top:.1f}V{bottom:.1f}" stroke="{GRID}"/>'
    for y, _ in frame.ticks("y"):
        yield f'<path d="M{frame.left:.1f} {y:.1f}H{right:.1f}" stroke="{GRID}"/>'
    if frame.scene.look == "panel":
        if frame.scene.y.low < 0.0 < frame.scene.y.high:
            zero = frame.at((0.0, 0.0))[1]
            yield f'<path d="M{frame.left:.1f} {zero:.1f}H{right:.1f}" stroke="{COLOURS["overlap"]}"/>'
        yield (
            f'<rect x="{frame.left:.1f}" y="{frame.top:.1f}" width="{frame.width:.1f}"'
            f' height="{frame.height:.1f}" fill="none" stroke="{COLOURS["overlap"]}"/>'
        )


def _area(frame: Placement, area: FilledArea) -> str:
    left, top = frame.at((area.left, area.top))
    right, bottom = frame.at((area.right, area.bottom))
    stroke = "none" if area.sort in PLAIN else COLOURS[area.sort]
    return (
        f'<rect x="{left:.1f}" y="{top:.1f}" width="{right - left:.1f}" height="{bottom - top:.1f}"'
        f' fill="{FILLS.get(area.sort, "none")}" stroke="{stroke}"/>'
    )


def _line(frame: Placement, line: Polyline) -> str:
    """Return a line by its sort: now and error are wide."""
    points = " ".join(f"{x:.1f},{y:.1f}" for x, y in map(frame.at, line.points))
    dash = ' stroke-dasharray="5 4"' if line.dashed else ' stroke-dasharray="2 3"' if line.dotted else ""
    # The rail is what the axis moves on: wide and pale, so that what lies on it remains visible.
    width = 6.0 if line.sort == "rail" else 2.0 if line.sort in ("now", "error") else 1.2
    width = 4.0 if line.wide else width
    return (
        f'<polyline points="{points}" fill="none" stroke="{COLOURS[line.sort]}" stroke-width="{width:g}"'
        f' stroke-opacity="{0.5 if line.sort == "rail" else 1:g}"{dash}/>'
    )


def _handle_dot(at: Point) -> str:
    return f'<circle cx="{at[0]:.1f}" cy="{at[1]:.1f}" r="3" fill="{BASE}" stroke="{COLOURS["ink"]}"/>'


def _dot(frame: Placement, dot: Dot) -> str:
    """Return the symbol of a point."""
    x, y = frame.at(dot.at)
    stroke = COLOURS[dot.sort]
    if dot.kind == "home":
        return (
            f'<path d="M{x - 10:.1f} {y:.1f}h20M{x:.1f} {y - 10:.1f}v20" stroke="{stroke}"'
            f' stroke-width="1.5"/><circle cx="{x:.1f}" cy="{y:.1f}" r="6" fill="none" stroke="{stroke}"'
            ' stroke-width="1.5"/>'
        )
    if dot.kind == "switch":
        return f'<rect x="{x - 6:.1f}" y="{y - 6:.1f}" width="12" height="12" rx="2" fill="{stroke}"/>'
    if dot.kind in ARROWS:
        return f'<path d="{_arrow(x, y, dot.kind)}" fill="none" stroke="{stroke}" stroke-width="1.5"/>'
    if dot.kind in ("marker", "end"):
        return (
            f'<path d="M{x:.1f} {y - 8:.1f}v16" stroke="{COLOURS["now"] if dot.kind == "marker" else stroke}"'
            ' stroke-width="2"/>'
        )
    return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5" fill="{BASE}" stroke="{stroke}" stroke-width="1.5"/>'


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


def _with_room(text: str, strong: bool) -> float:
    """Return how wide a text of a heading may become: a document puts it into its language later."""
    return 1.3 * measured(text, strong)


def _texts(frame: Placement, width: float, height: float) -> Iterator[str]:
    """Yield the texts of a scene where each has room; one that has none is shown under the pointer."""
    found = labels_of(frame, width, height, measured, LINE)
    for at, text in found.left_out:
        yield (
            f'<circle cx="{at[0]:.1f}" cy="{at[1]:.1f}" r="9" fill="{BASE}"'
            f' fill-opacity="0"><title>{escape(text)}</title></circle>'
        )
    for label in found.placed:
        if label.leader:
            (x1, y1), (x2, y2) = label.leader
            yield (
                f'<path d="M{x1:.1f} {y1:.1f}L{x2:.1f} {y2:.1f}" stroke="{COLOURS["second"]}"'
                ' stroke-width="0.75"/>'
            )
    for label in found.placed:
        if label.chip:
            yield _chip(label)
            continue
        if label.strong or label.over:
            box = label.box
            yield (
                f'<rect x="{box.left:.1f}" y="{box.top:.1f}" width="{box.width:.1f}"'
                f' height="{box.height:.1f}" fill="{BASE}" fill-opacity="0.8"/>'
            )
        yield _label(label)


def _chip(label: Label) -> str:
    box = label.box
    return (
        f'<rect x="{box.left:.1f}" y="{box.top:.1f}" width="{box.width:.1f}" height="{box.height:.1f}" rx="2"'
        f' fill="{COLOURS[label.sort]}"/><text x="{box.left + 0.5 * box.width:.1f}"'
        f' y="{box.top + 0.8 * box.height:.1f}" fill="{BASE}" font-weight="600"'
        f' text-anchor="middle">{escape(label.text)}</text>'
    )


def _label(label: Label) -> str:
    """Return the text of a label, its value in second ink."""
    box, value = label.box, ""
    if label.value:
        value = f' <tspan fill="{DIM}" font-weight="400">{escape(label.value)}</tspan>'
    weight = ' font-weight="600"' if label.strong else ""
    # An estimated width is wrong by as much on both sides; at the edge there is no room but to the right.
    at_edge = box.left <= LEFT_EDGE
    x = box.left if at_edge else box.left + 0.5 * box.width
    return (
        f'<text x="{x:.1f}" y="{box.top + 0.8 * box.height:.1f}" fill="{COLOURS[label.sort]}"'
        f' text-anchor="{"start" if at_edge else "middle"}"{weight}>{escape(label.text)}{value}</text>'
    )
