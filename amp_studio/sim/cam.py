"""Cam profiles of a control: points over time or over the position of a master, what they ask of the axis,
and the values of the file that contain them.

How a control stores a cam is its family's (`CamForm`, in its `Law`); reading points and drawing a profile are
the same for all.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

import numpy as np

from amp_studio.drawing import Curve, NamedPlace, Picture, panel_of
from amp_studio.files import ParameterFile, text_of_name
from amp_studio.schema import Address, UnitError, Value, canonical, read_table_text, unit_named

from .errors import SimulationError
from .identification.drive_record import named_columns, read_number_table
from .series import Series
from .trace import Figure

MOST_POINTS = 100_000
_COLUMNS = {
    "time": "time|t|zeit",
    "master": "master( position)?|leitachse",
    "position": "position|pos|axis|slave|weg",
}


@dataclass(frozen=True)
class CamPoints:
    """Points that somebody wants: s from the start or counts of the master, and positions of the axis in
    counts.
    """

    over: Literal["time", "master"]
    x: Series
    position: Series


@dataclass(frozen=True)
class CamProfile:
    """A cam as the control goes through it, in counts."""

    over: Literal["time", "master"]
    x: Series
    """s, or counts of the master, at each point; equally far apart."""
    position: Series
    """counts, 0 at the first point."""
    limits: Mapping[str, float] = field(default_factory=dict)
    """``speed`` in counts/s and ``acceleration`` in counts/s2 that the file allows, where it does."""
    figures: Mapping[str, Figure] = field(default_factory=dict)
    """What the control stores: points, time between them."""
    doubts: tuple[str, ...] = ()
    """What will not run well, each a sentence with its page."""
    settings: Mapping[Address, Value | None] = field(default_factory=dict)
    """Values that make the file contain it."""


@dataclass(frozen=True)
class CamForm:
    """How a family's files contain cams.

    ``present``  present(file, axis) -> the cam that the file contains; raises SimulationError for none
    ``make``     make(file, axis, points, scans between two points, 0 for as few as fit) -> a cam of points;
                 raises SimulationError for points that the control cannot take
    """

    present: Callable[[ParameterFile, str], CamProfile]
    make: Callable[[ParameterFile, str, CamPoints, int], CamProfile]


def read_cam_points(path: Path) -> CamPoints:
    """Return the points of a table with a column of time (s without a unit) or of the master, and one of the
    position, both in counts; raises SimulationError, OSError.
    """
    name, text = text_of_name(path.name), read_table_text(path)
    places = named_columns(text, _COLUMNS)
    over: Literal["time", "master"] = "master" if "master" in places else "time"
    if over not in places or "position" not in places:
        raise SimulationError(f"{name}: it needs the columns position and time, or position and master")
    x, position = read_number_table(text, [places[over][0], places["position"][0]])
    if not 2 <= len(x) <= MOST_POINTS:
        raise SimulationError(f"{name}: a cam has 2 to {MOST_POINTS} points, not {len(x)}")
    if not (np.diff(x) > 0.0).all():
        raise SimulationError(f"{name}: its {over} does not rise from row to row")
    for column in (over, "position") if over == "master" else ("position",):
        if places[column][1] not in ("", "counts"):
            raise SimulationError(f"{name}: the {column} is in {places[column][1]}; it must be in counts")
    try:
        factor = canonical(1.0, unit_named(places[over][1] or "s")) / canonical(1.0, "s")
    except UnitError as error:
        if over == "time":
            raise SimulationError(f"{name}: {error}") from None
        factor = 1.0
    return CamPoints(over, (x - x[0]) * (factor if over == "time" else 1.0), position - position[0])


def cam_figures(cam: CamProfile) -> dict[str, Figure]:
    """Return what a cam is and asks for: travel, length, greatest speed and acceleration of a time cam,
    greatest slope of one over a master.
    """
    speed, acceleration = derivatives(cam)
    found = {**cam.figures, "travel": (float(np.ptp(cam.position)), "counts")}
    if cam.over == "master":
        return {
            **found,
            "master_travel": (float(cam.x[-1]), "counts"),
            "greatest_slope": (float(np.abs(speed).max()), "counts/count"),
        }
    return {
        **found,
        "cycle_time": (float(cam.x[-1]), "s"),
        "greatest_speed": (float(np.abs(speed).max()), "counts/s"),
        "greatest_acceleration": (float(np.abs(acceleration).max(initial=0.0)), "counts/s2"),
    }


def derivatives(cam: CamProfile) -> tuple[Series, Series]:
    """Return speed between the points and acceleration at the points between, over time or the master."""
    step = np.diff(cam.x)
    speed = np.diff(cam.position) / step
    return speed, np.diff(speed) / step[1:]


def cam_picture(cam: CamProfile) -> Picture:
    """Return position, speed and acceleration of a cam over time, or position and slope over the master."""
    speed, acceleration = derivatives(cam)
    x = ("time", "s") if cam.over == "time" else ("master", "counts")
    per, unit = ("s", "s2") if cam.over == "time" else ("count", "count2")
    position = panel_of("position counts", (Curve("", cam.x, cam.position, "now", dots=False),), x)
    steps = Curve("", cam.x, np.append(speed, speed[-1]), "now", is_stepped=True)
    panels = [position, panel_of(f"speed counts/{per}", (steps,), x, levels=_levels(cam, "speed"))]
    if acceleration.size:
        at = Curve("", cam.x[1:-1], acceleration, "now")
        title = f"acceleration counts/{unit}"
        panels.append(panel_of(title, (at,), x, levels=_levels(cam, "acceleration")))
    return Picture("Cam profile", cam.doubts, tuple(panels))


def _levels(cam: CamProfile, name: str) -> tuple[NamedPlace, ...]:
    limit = cam.limits.get(name)
    return () if limit is None else tuple(NamedPlace(name, sign * limit, "limit") for sign in (1.0, -1.0))
