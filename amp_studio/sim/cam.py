"""Cam profiles of a control: points over time or over the position of a master, what they ask of the axis,
and the values of the file that contain them (points from a table: `cam_reading.py`).

How a control stores a cam is its family's (`CamForm`, in its `Law`); reading points and drawing a profile are
the same for all.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from amp_studio.drawing import Curve, NamedPlace, Picture, panel_of
from amp_studio.files import ParameterFile
from amp_studio.schema import Address, Value

from .series import Series
from .trace import Figure


@dataclass(frozen=True)
class CamPoints:
    """Points of a wanted cam: s from the start or counts of the master, and positions of the axis in
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


def cam_figures(cam: CamProfile) -> dict[str, Figure]:
    """Return what a cam is and asks for: travel, length, greatest speed and acceleration of a time cam,
    greatest slope of one over a master.
    """
    speed, acceleration = _derivatives(cam)
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


def _derivatives(cam: CamProfile) -> tuple[Series, Series]:
    """Return speed between the points and acceleration at the points between, over time or the master."""
    step = np.diff(cam.x)
    speed = np.diff(cam.position) / step
    # The points are equally far apart, so either of two neighbouring steps is right.
    return speed, np.diff(speed) / step[1:]


def cam_picture(cam: CamProfile) -> Picture:
    """Return position, speed and acceleration of a cam over time, or position and slope over the master."""
    speed, acceleration = _derivatives(cam)
    x = ("time", "s") if cam.over == "time" else ("master", "counts")
    per, unit = ("s", "s²") if cam.over == "time" else ("count", "count²")
    position = panel_of("position counts", (Curve("", cam.x, cam.position, "now", dots=False),), x)
    # One speed less than points: a stepped curve needs a value at the last one too.
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
