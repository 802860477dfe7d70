"""Where the texts of a scene are, none on another: the same for a screen, which measures its font,
and for paper.

Figures of the scales come first, then the names of parameters, then figures at points. A name that has no
room beside its point, or none clear of the lines, goes further away and gets a line to it, then it loses its
value; what has no room at all is left out, and a tip has it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

from amp_studio.schema import Address, unit_text

from .frame import Placement
from .scene import Curve, Point, Scene, ShapeSort, Text

Measure = Callable[[str, bool], float]
"""Text, whether it is strong -> width in points."""
_Align = Literal["start", "middle", "end"]
ANCHORS: dict[str, tuple[_Align, float, float]] = {
    "left": ("start", 6.0, -6.0),
    "inside": ("start", 6.0, 15.0),
    "corner": ("end", -12.0, 22.0),
    "right": ("end", -6.0, -6.0),
    "middle": ("middle", 0.0, 4.0),
    "above": ("middle", 0.0, -10.0),
    "below": ("middle", 0.0, 20.0),
    "beside": ("start", 6.0, 4.0),
}
"""Anchor -> which end of a text is there, and how far its base line is from its point."""
_SHARES: dict[_Align, float] = {"start": 0.0, "middle": 0.5, "end": 1.0}
_OTHERS = tuple(ANCHORS[anchor] for anchor in ("left", "right", "inside", "corner", "above", "below"))
_SIDES: tuple[tuple[_Align, float], ...] = (("start", 8.0), ("end", -8.0), ("middle", 0.0))
_NEAR, _FAR = 3, 9
"""Lines that a name goes away from its point: if possible, and at most."""
_LED = 16.0
"""Distance in points from which a line leads from a point to its text."""
_MIN_ROW = 30.0
"""Height of a row that has room for figures at its points; in lower ones only the first has them."""
SAMPLE = 22.0
"""Length of the sample of a curve before its name."""
_BETWEEN = 6.0
"""Between a sample and its name; two of them between names."""
_HALF = 6.0
"""Half the side of a handle or of a symbol, and a bit."""


@dataclass(frozen=True)
class Box:
    """A rectangle in points, y downwards."""

    left: float
    top: float
    width: float
    height: float

    def overlaps(self, other: Box) -> bool:
        """Return whether both have a place in common."""
        return (
            self.left < other.left + other.width
            and other.left < self.left + self.width
            and self.top < other.top + other.height
            and other.top < self.top + self.height
        )

    def is_crossed(self, start: Point, end: Point) -> bool:
        """Return whether a straight line goes through it."""
        (x, y), (to_x, to_y), right, bottom = start, end, self.left + self.width, self.top + self.height
        # Most pass by: of every text, every line is asked.
        if (x < self.left and to_x < self.left) or (x > right and to_x > right):
            return False
        if (y < self.top and to_y < self.top) or (y > bottom and to_y > bottom):
            return False
        # Of a line that passes by, all corners are on one side.
        sides = [
            (to_x - x) * (each_y - y) - (to_y - y) * (each_x - x)
            for each_x in (self.left, right)
            for each_y in (self.top, bottom)
        ]
        return min(sides) < 0.0 < max(sides)

    def nearest(self, point: Point) -> Point:
        """Return the place of the rectangle that is nearest to a point."""
        x = min(max(point[0], self.left), self.left + self.width)
        return x, min(max(point[1], self.top), self.top + self.height)


@dataclass(frozen=True)
class Label:
    """A text in its place."""

    box: Box
    text: str
    value: str = ""
    """What follows in second ink."""
    strong: bool = False
    sort: ShapeSort = "dim"
    address: Address | None = None
    """The parameter it names."""
    leader: tuple[Point, Point] | None = None
    """From its point to it, where it is far away."""
    over: bool = False
    """Whether it lies on curves: on a light background."""
    chip: bool = False
    """Whether it is a letter in a filled square."""


@dataclass(frozen=True)
class Labels:
    """All texts of a scene on a sheet."""

    placed: tuple[Label, ...]
    left_out: tuple[tuple[Point, str], ...]
    """Where there was no room, and the text: for tips."""


LEFT_EDGE = 8.0
"""Where a text at the left edge of a sheet begins."""


def labels_of(frame: Placement, width: float, height: float, measure: Measure, line: float) -> Labels:
    """Return where the texts of a scene are on a sheet of a width and a height, in lines of a height."""
    placing = _Placing(frame, width, height, measure, line)
    # Whatever comes later keeps clear of what is there: the order is that of what must not be missing.
    placing.scales()
    placing.levels()
    placing.marks()
    placing.texts()
    return Labels(tuple(placing.placed), tuple(placing.left_out))


def axis_text(scene: Scene, axis: str) -> str:
    """Return what is measured along an axis: ``X, mm``; a panel has what is up its own in its heading."""
    scale = scene.x if axis == "x" else scene.y
    if scale.rows or not scale.is_written or (axis == "y" and scene.look == "panel"):
        return ""
    return ", ".join(part for part in (scale.label, unit_text(scale.unit)) if part)


@dataclass(frozen=True)
class Heading:
    """A piece of the heading of a panel: words, behind the sample of a curve where they are its name."""

    x: float
    line: int
    """Lines below the first one."""
    text: str
    strong: bool = False
    curve: Curve | None = None


def heading_of(panel: Scene, left: float, right: float, measure: Measure) -> list[Heading]:
    """Return what a panel shows, and its curves by name where it has several, from left to right:
    no name is left out.
    """
    # In the heading: a panel is too low for a text along its vertical axis.
    unit = panel.cells.unit if panel.cells else panel.y.unit
    title = f"{panel.title} ({unit_text(unit)})" if unit else panel.title
    pieces = [Heading(left, 0, title, strong=True)]
    x, line = left + measure(title, True) + 2.0 * _BETWEEN, 0
    if panel.subtitle:
        pieces.append(Heading(x, 0, panel.subtitle))
        x += measure(panel.subtitle, False) + 2.0 * _BETWEEN
    named = [curve for curve in panel.curves if curve.name and len(curve.x)]
    # A single curve is what the title names.
    if len(named) < 2:
        return pieces
    widths = [SAMPLE + _BETWEEN + measure(curve.name, False) + 2.0 * _BETWEEN for curve in named]
    # All fit into the line of the title: at its right end, where the eye finds them clear of the title.
    if x + sum(widths) <= right:
        x = right - sum(widths)
    for curve, width in zip(named, widths, strict=True):
        if x + width > right + 1.0 and x > left:
            x, line = left, line + 1
        pieces.append(Heading(x, line, curve.name, curve=curve))
        x += width
    return pieces


class _Placing:
    def __init__(self, frame: Placement, width: float, height: float, measure: Measure, line: float) -> None:
        self._frame, self._measure, self._line = frame, measure, line
        self._width, self._height = width, height
        self.placed: list[Label] = []
        self.left_out: list[tuple[Point, str]] = []
        symbols = [*(h.at for h in frame.scene.handles), *(d.at for d in frame.scene.dots)]
        self._symbols = [
            Box(x - _HALF, y - _HALF, 2 * _HALF, 2 * _HALF) for x, y in (frame.at(at) for at in symbols)
        ]
        lines = (tuple(map(frame.at, line.points)) for line in frame.scene.lines)
        self._strokes = [stroke for line in lines for stroke in pairwise(line)]

    def _box(self, x: float, base: float, text: Text, value: str, align: _Align) -> Box:
        """Return the place of a text whose base line begins, has its middle or ends at x."""
        wide = self._measure(text.text, bool(text.value)) + (
            self._measure(f" {value}", False) if value else 0.0
        )
        wide = max(wide + 4.0, self._line) if text.chip else wide
        return Box(x - _SHARES[align] * wide, base - 0.8 * self._line, wide, self._line)

    def _kept_inside(self, box: Box) -> Box:
        left = min(box.left, self._width - 2.0 - box.width)
        top = min(box.top, self._height - self._line)
        return Box(max(left, 2.0), max(top, 0.0), box.width, box.height)

    def _is_free(self, box: Box, *, symbols: bool = False, clear: bool = False) -> bool:
        if box.left + box.width > self._width or box.top + box.height > self._height:
            return False
        if any(label.box.overlaps(box) for label in self.placed):
            return False
        if symbols and any(symbol.overlaps(box) for symbol in self._symbols):
            return False
        return not clear or self._is_clear(box)

    def _is_clear(self, box: Box) -> bool:
        """Return whether no line goes through a place, which is within the frame of a diagram."""
        frame = self._frame
        beyond = box.top < frame.top or box.top + box.height > frame.top + frame.height
        if beyond and not frame.scene.equal:
            return False
        return not any(box.is_crossed(*stroke) for stroke in self._strokes)

    # -- scales --------------------------------------------------------------------

    def scales(self) -> None:
        """Place what is measured and the figures along both axes; a figure without room is left out."""
        frame, scene, base = self._frame, self._frame.scene, 0.35 * self._line
        right, bottom = frame.left + frame.width, frame.top + frame.height
        upright = axis_text(scene, "y")
        # A word is longer in another language (speed, Geschwindigkeit): half as long again must fit.
        fits = 1.5 * self._measure(upright, False) < frame.left - LEFT_EDGE
        if fits:
            self._figure(frame.left - 8.0, frame.top - 12.0, upright, "end")
        else:
            self._figure(LEFT_EDGE, frame.top - 12.0, upright, "start")
        self._figure(right, bottom + 29.0, axis_text(scene, "x"), "end")
        for level, text in frame.ticks("y") if scene.y.is_written else ():
            self._figure(frame.left - 8.0, level + base, text, "end")
        for x, text in frame.ticks("x") if scene.x.is_written else ():
            self._figure(x, bottom + 15.0, text, "middle")
        for at_row, _, unit in scene.y.rows:
            self._figure(right + 8.0, frame.at((scene.x.low, at_row))[1] + base, unit, "start")

    def _figure(self, x: float, base: float, text: str, align: _Align) -> None:
        box = self._kept_inside(self._box(x, base, Text((x, base), text), "", align))
        if text and self._is_free(box):
            self.placed.append(Label(box, text))

    # -- lines across ------------------------------------------------------------------

    def levels(self) -> None:
        """Name levels at the right end of their lines; those that would overlap share one text."""
        frame = self._frame
        x, found = frame.left + frame.width - 6.0, list[tuple[float, float, str]]()
        for mark in sorted(frame.scene.levels, key=lambda each: each.at):
            y, name = frame.at((0.0, mark.at))[1], mark.name
            if not name or not frame.top <= y <= frame.top + frame.height:
                continue
            # One at the very top is named below its line, or its name would be in the heading of the panel.
            base = y + 0.9 * self._line if y - frame.top < self._line + 4.0 else y - 4.0
            # From the bottom up: one that is less than a line above the one before shares its text.
            if found and found[-1][0] - base < self._line:
                base, y, before = found.pop()
                name = f"{before}, {name}"
            found.append((base, y, name))
        for base, y, name in found:
            self.placed.append(Label(self._box(x, base, Text((x, y), name), "", "end"), name, over=True))

    def marks(self) -> None:
        """Name marks beside their lines, near the bottom, in turns of two heights."""
        frame = self._frame
        for n, mark in enumerate(sorted(frame.scene.marks, key=lambda each: each.at)):
            x = frame.at((mark.at, 0.0))[0]
            if mark.name and frame.left <= x <= frame.left + frame.width:
                base = frame.top + frame.height - 8.0 - self._line * (n % 2)
                # At the left edge there is no room before the line: that name is behind it.
                at_left = x - self._measure(mark.name, False) - 4.0 > frame.left
                box = self._box(
                    x - 4.0 if at_left else x + 4.0,
                    base,
                    Text((x, base), mark.name),
                    "",
                    "end" if at_left else "start",
                )
                self.placed.append(Label(box, mark.name, over=True))

    # -- texts at points -------------------------------------------------------------

    def texts(self) -> None:
        """Place the texts at points, names before figures."""
        scene = self._frame.scene
        rows = scene.y.rows
        is_dense = len(rows) > 1 and self._frame.height / len(rows) < _MIN_ROW
        # A text with a value names a parameter; a bare figure can be read off the scale where it has no room.
        for text in sorted(scene.texts, key=lambda each: not each.value):
            point = self._frame.at(text.at)
            # Tips have the figures of the other rows.
            is_first = not is_dense or (text.at[1] == rows[0][0] and text.anchor == "above")
            label = self._placed(text, point) if is_first else None
            if label is None:
                self.left_out.append((point, f"{text.text} {text.value}".strip()))
            else:
                self.placed.append(label)

    def _placed(self, text: Text, point: Point) -> Label | None:
        """Return a text where it is free; None without room.

        The name of a line goes far away rather than without its value, that of an area stays near.
        """
        if not text.value and not any(letter.isalpha() for letter in text.text):
            box = self._free_box(text, point, "", 0, symbols=False)  # a figure belongs to its point
            return self._label(text, point, box, "")
        if text.chip:
            # A letter is there several times: one that is far from its piece is worse than none.
            return self._label(text, point, self._beside(text, point), "")
        is_area = text.anchor in ("above", "inside", "corner")
        tries = [(text.value, _NEAR, True, False), ("", _NEAR, True, False), (text.value, _FAR, True, False)]
        for value, far, symbols, clear in (
            *([] if text.anchor == "middle" else [(text.value, _NEAR, True, True)]),
            *(tries if is_area else tries[::2]),
            (text.value, _FAR, False, False),
            ("", _FAR, False, False),
        ):
            box = self._free_box(text, point, value, far, symbols=symbols, clear=clear)
            if box is not None:
                return self._label(text, point, box, value)
        return None

    def _label(self, text: Text, point: Point, box: Box | None, value: str) -> Label | None:
        if box is None:
            return None
        end = box.nearest(point)
        # Without a line the reader could not see which of several points a text so far away belongs to.
        far = max(abs(end[0] - point[0]), abs(end[1] - point[1]))
        leader = (point, end) if far > _LED else None
        return Label(box, text.text, value, bool(text.value), text.sort, text.address, leader, chip=text.chip)

    def _free_box(
        self, text: Text, point: Point, value: str, far: int, *, symbols: bool, clear: bool = False
    ) -> Box | None:
        """Return the first free place of a text within so many lines; where it belongs at all, first."""
        around = self._around(text, point, value, far)
        first = self._kept_inside(next(around))
        # Most are free where they belong: no other place is asked for.
        if self._is_free(first, symbols=symbols, clear=clear):
            return first
        places = [(box, self._kept_inside(box)) for box in around]
        # A place that had to be pushed back onto the sheet is no longer where it belongs to its point: those
        # are tried last.
        for box in (*(box for box, kept in places if kept == box), *(kept for _, kept in places)):
            if self._is_free(box, symbols=symbols, clear=clear):
                return box
        return None

    def _beside(self, text: Text, point: Point) -> Box | None:
        """Return the first free place right beside the point of a letter, clear of lines if possible."""
        places = [
            self._box(point[0] + dx, point[1] + dy, text, "", align)
            for align, dx, dy in (ANCHORS[text.anchor], *_OTHERS)
        ]
        kept = [box for box in places if self._kept_inside(box) == box and self._is_free(box, symbols=True)]
        return next(filter(self._is_clear, kept), kept[0] if kept else None)

    def _around(self, text: Text, point: Point, value: str, far: int) -> Iterator[Box]:
        """Yield the places of a text, the wanted one first, then further and further away."""
        align, dx, dy = ANCHORS[text.anchor]
        if text.anchor == "above" and text.value:
            align = "start"
        yield self._box(point[0] + dx, point[1] + dy, text, value, align)
        if far:
            for align, dx, dy in _OTHERS:
                yield self._box(point[0] + dx, point[1] + dy, text, value, align)
        for lines in range(1, far + 1):
            for symbol in _turns(point[1] > 0.5 * self._height):
                base = point[1] + symbol * lines * self._line + 4.0
                for align, dx in _SIDES:
                    yield self._box(point[0] + dx, base, text, value, align)


def _turns(is_low: bool) -> Sequence[int]:
    """Return in which direction to look first, down or up: towards the middle of the sheet."""
    return (-1, 1) if is_low else (1, -1)
