"""Where axes are home in the picture of the travel: rails with marker and switch, and the home position."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Literal

from amp_studio.drawing import Dot, FilledArea, Handle, Point, Polyline, Text
from amp_studio.files import ParameterFile
from amp_studio.schema import HomePlace, TravelRoles

from .figures import DrawnValue, ValueReader

MARGIN = 0.08
"""Share of the length of the drawing that is left free at each side."""
SWITCH = 0.03
"""How far beyond its marker a switch is drawn whose place is no value of the file."""
ALONG: tuple[Literal["x", "y"], ...] = ("x", "y")


@dataclass
class TravelShapes:
    """The shapes of a picture while it is drawn."""

    areas: list[FilledArea] = field(default_factory=list)
    lines: list[Polyline] = field(default_factory=list)
    dots: list[Dot] = field(default_factory=list)
    texts: list[Text] = field(default_factory=list)
    handles: list[Handle] = field(default_factory=list)


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
    speed: DrawnValue | None = None
    pull_off: DrawnValue | None = None


def read_home(figures: ValueReader, roles: TravelRoles, axis: str, file: ParameterFile) -> Home:
    """Return where an axis is home."""
    role = roles.home
    if role is None:
        return Home()

    def number(parameter: str | None) -> DrawnValue | None:
        return figures.figure(parameter, axis) if parameter else None

    position, calibration, switch = number(role.position), number(role.marker), number(role.switch)
    place = position.number if position else None
    marker = None
    if role.marker and place is not None and calibration and calibration.number is not None:
        marker = place - calibration.number
    towards, off = _directions(figures, role, axis, file)
    pull_off = number(role.pull_off)
    if roles.reach and pull_off and pull_off.number is not None and towards:
        place = -towards * pull_off.number
    speed = figures.figure(role.speed, axis) if role.speed else None
    way = off or (towards and -towards)
    if way and speed is not None and speed.number is not None:
        sign = "plus" if way > 0.0 else "minus"
        figures.note(
            f"{figures.axis(axis)} leaves its switch in {sign} direction at {speed.text}",
            speed.address,
            is_remark=True,
        )
    return Home(position, marker, calibration, switch, place, -off or towards, off, speed, pull_off)


def letters(file: ParameterFile) -> tuple[str, ...]:
    """Return every axis of the family, in the order of the bits of a word."""
    return tuple(file.schema.family.scopes["axis"].instances)


def _directions(figures: ValueReader, role: HomePlace, axis: str, file: ParameterFile) -> tuple[float, float]:
    return figures.direction(role.towards, axis, letters(file)), figures.direction(
        role.off, axis, letters(file)
    )


def draw_rail(
    figures: ValueReader,
    drawing: TravelShapes,
    n: int,
    travel: tuple[float, float],
    home: Home,
    views: list[tuple[float, float]],
) -> None:
    """Draw the travel of an axis as a rail beside the picture, with marker and switch."""
    marker, switch = home.marker, home.switch.number if home.switch else None
    if marker is None and switch is None and home.place is None and not home.side:
        return
    across = views[1 - n]
    level = (
        across[0] + 0.5 * MARGIN * (across[1] - across[0])
        if n == 0
        else across[1] - 0.3 * MARGIN * (across[1] - across[0])
    )

    def at(place: float) -> Point:
        return (place, level) if n == 0 else (level, place)

    low, high = max(travel[0], views[n][0]), min(travel[1], views[n][1])
    drawing.lines.append(Polyline((at(low), at(high)), "rail"))
    length = views[n][1] - views[n][0]
    arrows: tuple[Literal["right", "left", "up", "down"], ...] = (
        ("right", "left") if n == 0 else ("up", "down")
    )
    if home.calibration is not None and marker is not None:
        drawing.dots.append(Dot(at(marker), "marker"))
        drawing.texts.append(
            Text(at(marker), "marker", "", "below" if n == 0 else "right", home.calibration.address, "dim")
        )
        drag = figures.drag(
            home.calibration,
            "x" if n == 0 else "y",
            length,
            lambda place: (home.place or 0.0) - place,
            rises=False,
        )
        drawing.handles.append(figures.handle(home.calibration, at(marker), drag, second=True))
    if switch is not None and home.switch is not None:
        drawing.dots.append(Dot(at(switch), "switch"))
        drawing.texts.append(
            Text(
                at(switch),
                "switch",
                home.switch.text,
                "below" if n == 0 else "right",
                home.switch.address,
                "dim",
            )
        )
        drawing.handles.append(
            figures.handle(
                home.switch,
                at(switch),
                figures.drag(home.switch, "x" if n == 0 else "y", length),
                second=True,
            )
        )
        side = home.side
        place = switch - 2.0 * side * SWITCH * length
    elif home.pull_off is not None and home.side:
        drawing.dots.append(Dot(at(0.0), "switch"))
        drag = figures.drag(
            home.pull_off,
            "x" if n == 0 else "y",
            length,
            lambda place: -home.side * place,
            rises=home.side < 0.0,
        )
        if home.place is not None:
            drawing.handles.append(figures.handle(home.pull_off, at(home.place), drag, second=True))
        side, place = home.side, -2.0 * home.side * SWITCH * length
    elif home.side:
        near = (
            marker
            if marker is not None
            else home.place
            if home.place is not None
            else (high if home.side > 0 else low)
        )
        place = near + home.side * SWITCH * length
        if math.isfinite(place):
            drawing.dots.append(Dot(at(place), "switch"))
            figures.note(
                "Where a home switch lies is no value of this file: it is drawn on its side of the marker.",
                is_remark=True,
            )
        side = home.off
        place = near - home.side * 2.0 * SWITCH * length
    else:
        return
    if side and math.isfinite(place):
        drawing.dots.append(Dot(at(place), arrows[0] if side > 0 else arrows[1]))


def draw_home(
    figures: ValueReader, drawing: TravelShapes, homes: list[Home], views: list[tuple[float, float]]
) -> None:
    """Draw the home position of both axes as one cross."""
    if len(homes) != 2 or any(home.place is None for home in homes):
        return
    x, y = (home.place or 0.0 for home in homes)
    drawing.dots.append(Dot((x, y), "home"))
    named = [home.position or home.pull_off for home in homes]
    drawing.texts.append(
        Text(
            (x, y),
            "Home",
            ", ".join(f.text for f in named if f),
            "corner" if x > 0.5 * sum(views[0]) else "inside",
            named[0].address if named[0] else None,
        )
    )
    if all(home.position is not None for home in homes):
        drags = tuple(
            figures.drag(home.position, along, view[1] - view[0])
            for home, along, view in zip(homes, ALONG, views, strict=True)
            if home.position is not None
        )
        label = ", ".join(home.position.label for home in homes if home.position)
        drawing.handles.append(Handle((x, y), drags, label, drawing.texts[-1].value, second=True))
