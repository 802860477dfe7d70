"""A picture as data: shapes in world units, labels of parameters, and handles that move their values.

World units are those in which the file shows the values (mm, in, deg, mm/min, V, …); what becomes of them on
paper or on a screen is the business of ``frame``.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal, NamedTuple

from amp_studio.schema import Address, Value

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Series = NDArray[np.float64]
    """Values of a curve, (n,)."""

Point = tuple[float, float]
ShapeSort = Literal[
    "ink",
    "dim",
    "limit",
    "now",
    "second",
    "error",
    "forbidden",
    "either",
    "outside",
    "travel",
    "rail",
    "overlap",
    "gap",
    "output",
    "before",
]
"""What a shape means; the colour follows from it."""
DotKind = Literal["point", "home", "switch", "marker", "left", "right", "up", "down", "end", "tick"]
"""``left`` to ``down`` are arrows, ``end`` is a short bar across."""


MIN_DRAWN, MAX_DRAWN = 1e-9, 1e12
"""Figures between which something is drawn; 0 is drawn too."""


@dataclass(frozen=True)
class Polyline:
    """A line through points."""

    points: tuple[Point, ...]
    sort: ShapeSort = "ink"
    dashed: bool = False
    dotted: bool = False
    wide: bool = False
    """A band of colours along an axis."""


@dataclass(frozen=True, eq=False)
class Curve:
    """A course of any number of values: how many of its points are drawn depends on the room for them."""

    name: str
    x: Series
    y: Series
    sort: ShapeSort = "now"
    dashed: bool = False
    dots: bool = False
    """Single measured values, each a ring."""
    is_stepped: bool = False
    """Whether a value is constant between two samples of the control."""
    dense: bool = False
    """Whether it ripples between samples: where it is too dense it is drawn as its mean in the band it
    fills."""

    @property
    def is_before(self) -> bool:
        """Whether it shows what was before a change."""
        return self.sort == "before"


@dataclass(frozen=True, eq=False)
class HeatMap:
    """A figure over two values: a cell for each pair of them, pale where it is not safe."""

    unit: str
    x: Series
    """Edges of the columns, (n + 1,)."""
    y: Series
    """Edges of the rows, (m + 1,)."""
    values: NDArray[np.float64]
    """(m, n); nan where there is none."""
    safe: NDArray[np.bool_]
    """(m, n)"""
    ends: tuple[float, float]
    """The values at both ends of the scale of colours."""


class NamedPlace(NamedTuple):
    """A named value of a scale, drawn as a line across the whole drawing."""

    name: str
    at: float
    sort: ShapeSort = "dim"


@dataclass(frozen=True)
class FilledArea:
    """A rectangle; infinite sides end at the edge of the picture."""

    left: float
    bottom: float
    right: float
    top: float
    sort: ShapeSort
    name: str = ""


@dataclass(frozen=True)
class Dot:
    """A symbol of fixed size at a point."""

    at: Point
    kind: DotKind = "point"
    sort: ShapeSort = "ink"


@dataclass(frozen=True)
class Text:
    """A text beside a point; ``anchor`` is the side of the text that lies at the point (``inside``: in a box
    below its corner, ``corner``: below at the left, ``beside``: at the right, half way up).
    """

    at: Point
    text: str
    value: str = ""
    """What follows in second ink."""
    anchor: Literal["left", "right", "middle", "above", "below", "inside", "corner", "beside"] = "left"
    address: Address | None = None
    """The parameter it names."""
    sort: ShapeSort = "ink"
    chip: bool = False
    """A letter in a filled square of its colour; left out where it has no room."""


@dataclass(frozen=True)
class PictureNote:
    """What a picture does not draw, or draws in spite of being wrong, and why: a sentence."""

    text: str
    address: Address | None = None
    wrong: bool = False
    """A value that is not allowed; otherwise one that is not set or inactive."""
    is_remark: bool = False
    """Nothing is missing or wrong: what a drawing shows, and what it assumes."""

    @property
    def order(self) -> tuple[bool, bool]:
        """What is wrong comes first, remarks come last."""
        return not self.wrong, self.is_remark


@dataclass(frozen=True)
class Drag:
    """How one value follows a handle."""

    address: Address
    along: Literal["x", "y"]
    value_at: Callable[[float], Value | None] = field(compare=False)
    """World coordinate -> the value, as exact as the parameter stores it; None where there is none.

    Raises ValueError with the reason where a table does not take its point there.
    """
    step: float
    """What a key changes the value by, in the unit of entry."""
    rises: bool = True
    """Whether the value grows with the coordinate."""
    low: float | None = None
    """Allowed range in the unit of entry."""
    high: float | None = None
    unit: str = ""
    """Unit of entry."""


@dataclass(frozen=True)
class Handle:
    """What can be dragged: one value, or at a corner two."""

    at: Point
    drags: tuple[Drag, ...]
    label: str
    """Number, name and axis of what it moves."""
    value: str
    """As a person reads it."""
    second: bool = False
    """A value of less weight: drawn round."""
    without: tuple[Address, Value] | None = None
    """What is set to take its point out of a table."""


@dataclass(frozen=True)
class Scale:
    """One axis of the drawing."""

    label: str
    unit: str
    low: float
    high: float
    log: bool = False
    step: float = 0.0
    """Distance of the figures where round decimal numbers are wrong (degrees); 0 for those."""
    is_written: bool = True
    """Whether there are figures; a panel leaves those along x to the last one below it."""
    is_fixed: bool = False
    """Whether it was chosen: it stays whatever is visible."""
    rows: tuple[tuple[float, str, str], ...] = ()
    """In place of figures: where, name at the left and at the right end."""

    def __post_init__(self) -> None:
        """Give a scale without length one, so that whatever a file sets can be drawn."""
        low, high = sorted((self.low, self.high))
        # From a file any number may come, 0 and negative ones too.
        if self.log:
            low = max(low, MIN_DRAWN)
        # Relative: next to a large number a shorter scale has no room for two floats, and its ticks would
        # never end.
        least = MIN_DRAWN * max(abs(low), abs(high), 1.0)
        if high - low < least and not (self.log and high > low):
            high = low * 10.0 if self.log else low + least
        object.__setattr__(self, "low", low)
        object.__setattr__(self, "high", high)


@dataclass(frozen=True)
class Scene:
    """One picture of one part of a file."""

    name: str
    part: str
    title: str
    subtitle: str
    x: Scale
    y: Scale
    equal: bool = False
    """Whether both axes have one scale."""
    areas: tuple[FilledArea, ...] = ()
    lines: tuple[Polyline, ...] = ()
    dots: tuple[Dot, ...] = ()
    texts: tuple[Text, ...] = ()
    handles: tuple[Handle, ...] = ()
    notes: tuple[PictureNote, ...] = ()
    drawn_from: tuple[Address, ...] = ()
    """Every parameter that was read."""
    with_point: Callable[[Point], tuple[Address, Value] | None] | None = field(default=None, compare=False)
    """What is set to put a point into a table; None where nothing can be put in."""
    curves: tuple[Curve, ...] = ()
    cells: HeatMap | None = None
    levels: tuple[NamedPlace, ...] = ()
    """Values of y."""
    marks: tuple[NamedPlace, ...] = ()
    """Places of x."""
    look: Literal["picture", "panel", "rings"] = "picture"
    """A ``panel`` of several has a frame and above it what it shows and its curves by name;
    ``rings``, and a diagram of boxes, have no scales."""
    share: float = 1.0
    """Share of a panel in the height of its picture."""
    rows: int = 0
    """Lines of text below each other, for which it has to be high enough; 0 where texts find their places."""
    fixed: float | None = None
    """What stays the same while a handle is dragged: the length of a move."""


class Ring(NamedTuple):
    """A closed path around a circle: the radius deviation over the angle in rad."""

    angle: Series
    deviation: Series
    sort: ShapeSort


@dataclass(frozen=True)
class Picture:
    """Panels below each other over one horizontal axis."""

    title: str
    facts: tuple[str, ...]
    """Figures in words, the most important first."""
    panels: tuple[Scene, ...]
    above: Scene | None = None
    """A drawing above the panels, over other axes: a path around a circle, a map."""
    close: Scene | None = None
    """A close look at the end, over a separate axis."""
    has_alarm: bool = False
    assumed: tuple[str, ...] = ()
