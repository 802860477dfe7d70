"""Where axes are home in the picture of the travel: rails with marker and switch, and the home position."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from amp_studio.drawing import Dot, Handle, Point, Polyline, Text
from amp_studio.files import ParameterFile
from amp_studio.schema import Address, HomePlace, TravelRoles

from .figures import DrawnValue, ValueReader, number_of
from .shapes import SceneShapes

MARGIN = 0.08
"""Share of the length of the drawing that is left free at each side."""
SWITCH = 0.03
"""How far beyond its marker a switch is drawn whose place is no value of the file."""
_ALONG: tuple[Literal["x", "y"], ...] = ("x", "y")


@dataclass(frozen=True)
class Home:
    """Where one axis is home, as far as the file contains it."""

    position: DrawnValue | None = None
    marker: float | None = None
    calibration: DrawnValue | None = None
    switch: DrawnValue | None = None
    place: float | None = None
    """Of the home position."""
    side: float = 0.0
    """On which side of the marker the switch lies; 0 if that is not known."""
    off: float = 0.0
    """The direction in which the axis leaves the switch; 0 if that is not known."""
    speed: DrawnValue | None = None
    pull_off: DrawnValue | None = None

    @property
    def switch_place(self) -> float | None:
        """Where the switch is, if a value of the file places it."""
        return number_of(self.switch)

    @property
    def places(self) -> list[float]:
        """What is known of home position, marker and switch."""
        return [place for place in (self.place, self.marker, self.switch_place) if place is not None]


def read_home(figures: ValueReader, roles: TravelRoles, axis: str, file: ParameterFile) -> Home:
    """Return where an axis is home."""
    role = roles.home
    if role is None:
        return Home()
    own = (role.position, role.marker, role.switch)
    position, calibration, switch = (figures.figure(parameter, axis) for parameter in own)
    place, before = number_of(position), number_of(calibration)
    # A calibration is how far the home position lies beyond the marker.
    marker = None if place is None or before is None else place - before
    towards, off = _directions(figures, role, axis, file)
    pull_off = figures.figure(role.pull_off, axis)
    back = number_of(pull_off)
    if roles.reach and back is not None and towards:
        # Measured from the switch at 0: the axis pulls off it against the direction of the search.
        place = -towards * back
    speed = figures.figure(role.speed, axis)
    _note_way_off(figures, axis, off or -towards, speed)
    # Left in one direction, the switch lies on the other side of the marker.
    return Home(position, marker, calibration, switch, place, -off or towards, off, speed, pull_off)


def _note_way_off(figures: ValueReader, axis: str, way: float, speed: DrawnValue | None) -> None:
    """Note in which direction and how fast an axis leaves its switch; ``way`` 0 is not known."""
    if way and speed is not None and speed.number is not None:
        sign = "plus" if way > 0.0 else "minus"
        figures.add_note(
            f"{figures.axis(axis)} leaves its switch in {sign} direction at {speed.text}",
            speed.address,
            is_remark=True,
        )


def letters(file: ParameterFile) -> tuple[str, ...]:
    """Return every axis of the family, in the order of the bits of a word."""
    return tuple(file.schema.family.scopes["axis"].instances)


def _directions(figures: ValueReader, role: HomePlace, axis: str, file: ParameterFile) -> tuple[float, float]:
    return figures.direction(role.towards, axis, letters(file)), figures.direction(
        role.off, axis, letters(file)
    )


@dataclass(frozen=True)
class _Rail:
    """The travel of one axis as a line beside the picture: along x where ``n`` is 0, else along y."""

    shapes: SceneShapes
    n: int
    level: float
    length: float
    """Of the picture along the axis."""

    def at(self, place: float) -> Point:
        return (place, self.level) if self.n == 0 else (self.level, place)

    def name(self, place: float, name: str, text: str, about: Address) -> None:
        side: Literal["below", "right"] = "below" if self.n == 0 else "right"
        self.shapes.texts.append(Text(self.at(place), name, text, side, about, "dim"))

    def handle(
        self,
        figure: DrawnValue,
        place: float,
        inverse: Callable[[float], float] = lambda at: at,
        *,
        rises: bool = True,
    ) -> None:
        figures = self.shapes.figures
        drag = figures.drag(figure, "x" if self.n == 0 else "y", self.length, inverse, rises=rises)
        self.shapes.handles.append(figures.handle(figure, self.at(place), drag, second=True))

    def arrow(self, place: float, side: float) -> None:
        """Draw in which direction the axis moves at a place."""
        if not side or not math.isfinite(place):
            return
        forward: Literal["right", "up"] = "right" if self.n == 0 else "up"
        back: Literal["left", "down"] = "left" if self.n == 0 else "down"
        self.shapes.dots.append(Dot(self.at(place), forward if side > 0 else back))


def draw_rail(
    drawing: SceneShapes, n: int, travel: tuple[float, float], home: Home, views: list[tuple[float, float]]
) -> None:
    """Draw the travel of an axis as a rail beside the picture, with marker and switch."""
    if home.marker is None and home.switch_place is None and home.place is None and not home.side:
        return
    across = views[1 - n]
    margin = MARGIN * (across[1] - across[0])
    # In the margin, beside what is drawn of the travel itself.
    level = across[0] + 0.5 * margin if n == 0 else across[1] - 0.3 * margin
    rail = _Rail(drawing, n, level, views[n][1] - views[n][0])
    low, high = max(travel[0], views[n][0]), min(travel[1], views[n][1])
    drawing.lines.append(Polyline((rail.at(low), rail.at(high)), "rail"))
    if home.calibration is not None and home.marker is not None:
        drawing.dots.append(Dot(rail.at(home.marker), "marker"))
        rail.name(home.marker, "marker", "", home.calibration.address)
        # The home position stays, as zones and limits are counted from it: the marker moves.
        rail.handle(home.calibration, home.marker, lambda place: (home.place or 0.0) - place, rises=False)
    _draw_switch(rail, home, (low, high))


def _draw_switch(rail: _Rail, home: Home, ends: tuple[float, float]) -> None:
    """Draw the home switch where it is, or where it is assumed: beyond what it is nearest to."""
    dots, beyond, (low, high) = rail.shapes.dots, SWITCH * rail.length, ends
    if home.switch is not None and home.switch_place is not None:
        dots.append(Dot(rail.at(home.switch_place), "switch"))
        rail.name(home.switch_place, "switch", home.switch.text, home.switch.address)
        rail.handle(home.switch, home.switch_place)
        rail.arrow(home.switch_place - 2.0 * home.side * beyond, home.side)
    # Places are counted from this switch, so it is at 0 and stays; the home position beside it is
    # dragged.
    elif home.pull_off is not None and home.side:
        dots.append(Dot(rail.at(0.0), "switch"))
        if home.place is not None:
            rail.handle(home.pull_off, home.place, lambda place: -home.side * place, rises=home.side < 0.0)
        rail.arrow(-2.0 * home.side * beyond, home.side)
    elif home.side:
        places = (place for place in (home.marker, home.place) if place is not None)
        near = next(places, high if home.side > 0 else low)
        _assumed_switch(rail, near + home.side * beyond)
        rail.arrow(near - home.side * 2.0 * beyond, home.off)


def _assumed_switch(rail: _Rail, place: float) -> None:
    """Draw a switch whose place is not known on its side of the marker."""
    if math.isfinite(place):
        rail.shapes.dots.append(Dot(rail.at(place), "switch"))
        rail.shapes.figures.add_note(
            "Where a home switch lies is no value of this file: it is drawn on its side of the marker.",
            is_remark=True,
        )


def draw_home(
    figures: ValueReader, drawing: SceneShapes, homes: list[Home], views: list[tuple[float, float]]
) -> None:
    """Draw the home position of two axes as one cross."""
    x, y = (home.place for home in homes)
    if x is None or y is None:
        return
    drawing.dots.append(Dot((x, y), "home"))
    named = [home.position or home.pull_off for home in homes]
    text = ", ".join(f.text for f in named if f)
    side: Literal["corner", "inside"] = "corner" if x > 0.5 * sum(views[0]) else "inside"
    about = named[0].address if named[0] else None
    drawing.texts.append(Text((x, y), "Home", text, side, about))
    along_x, along_y = (home.position for home in homes)
    if along_x and along_y:
        drags = tuple(
            figures.drag(position, along, view[1] - view[0])
            for position, along, view in zip((along_x, along_y), _ALONG, views, strict=True)
        )
        label = f"{along_x.label}, {along_y.label}"
        drawing.handles.append(Handle((x, y), drags, label, text, second=True))
