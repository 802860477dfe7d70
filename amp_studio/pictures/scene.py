"""A picture as data: shapes in world units, labels of parameters, and handles that move their values.

World units are those in which the file shows the values (mm, in, deg, mm/min, V, …); what becomes of them on paper or on a
screen is the business of ``frame``.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Literal

from amp_studio.schema import Address, Value

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
]
"""What a shape means; the colour follows from it."""
DotKind = Literal["point", "home", "switch", "marker", "left", "right", "up", "down", "end", "tick"]
"""``left`` to ``down`` are arrows, ``end`` is a short bar across."""


LEAST, MOST = 1e-9, 1e12
"""Figures between which something is drawn; 0 is drawn too."""


@dataclass(frozen=True)
class Polyline:
    """A line through points."""

    points: tuple[Point, ...]
    sort: ShapeSort = "ink"
    dashed: bool = False


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
    """A sign of fixed size at a point."""

    at: Point
    kind: DotKind = "point"
    sort: ShapeSort = "ink"


@dataclass(frozen=True)
class Text:
    """A text beside a point; ``anchor`` is the side of the text that lies at the point (``inside``: in a box below its corner,
    ``corner``: below at the left).
    """

    at: Point
    text: str
    value: str = ""
    """What follows in second ink."""
    anchor: Literal["left", "right", "middle", "above", "below", "inside", "corner"] = "left"
    address: Address | None = None
    """The parameter it names."""
    sort: ShapeSort = "ink"


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
    rows: tuple[tuple[float, str, str], ...] = ()
    """In place of figures: where, name at the left and at the right end."""

    def __post_init__(self) -> None:
        """Give a scale without length one, so that whatever a file sets can be drawn."""
        low, high = sorted((self.low, self.high))
        if self.log:
            low = max(low, LEAST)
        least = LEAST * max(abs(low), abs(high), 1.0)
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
    fixed: float | None = None
    """What stays the same while a handle is dragged: the length of a move."""
