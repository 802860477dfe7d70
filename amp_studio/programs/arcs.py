"""Arcs of a plane: center and sweep from the words of a block."""

from __future__ import annotations

import math
from dataclasses import dataclass

from amp_studio.schema import ArcTolerance

from .words import ProgramBlockError

CLOSED = 1e-9
"""mm: ends that are nearer are one point."""
_OFF_CIRCLE = 0.01
"""mm by which the end may miss the circle where no tolerance is printed."""


@dataclass(frozen=True)
class Arc:
    """Center and radius in mm, sweep in rad: above 0 from the first axis to the second."""

    first: float
    second: float
    radius: float
    sweep: float


def arc_by_center(
    x0: float,
    y0: float,
    x1: float,
    y1: float,
    first: float,
    second: float,
    tolerance: ArcTolerance | None,
    *,
    clockwise: bool,
) -> Arc:
    """Return the arc from a point to another around a center; raises ProgramBlockError
    where the end is off the circle by more than the control takes.
    """
    radius, other = math.hypot(x0 - first, y0 - second), math.hypot(x1 - first, y1 - second)
    if radius < max(CLOSED, tolerance.least if tolerance else 0.0):
        raise ProgramBlockError("An arc around the point where it begins has no radius", "arc-radius")
    off = abs(radius - other)
    _refuse_off_circle(off, radius, tolerance)
    chord = math.hypot(x1 - x0, y1 - y0)
    if off > 0.0 and chord > CLOSED:
        # The nearest center with the same distance to both ends: the arc then ends where it shall.
        u, v = (x1 - x0) / chord, (y1 - y0) / chord
        along = (first - x0) * u + (second - y0) * v - 0.5 * chord
        first, second = first - along * u, second - along * v
        radius = math.hypot(x0 - first, y0 - second)
    if chord <= CLOSED:
        return Arc(first, second, radius, -2.0 * math.pi if clockwise else 2.0 * math.pi)
    sweep = math.atan2(y1 - second, x1 - first) - math.atan2(y0 - second, x0 - first)
    return Arc(first, second, radius, _turned(sweep, clockwise=clockwise))


def _refuse_off_circle(off: float, radius: float, tolerance: ArcTolerance | None) -> None:
    """Refuse an end that is ``off`` mm beside the circle: by the printed tolerance, or by ours where none
    is.
    """
    if tolerance is None:
        if off > _OFF_CIRCLE:
            raise ProgramBlockError(
                f"The end of the arc is {off:.4g} mm off its circle; how they are joined is not printed",
                "arc-radius",
            )
    elif off > tolerance.most or (off > tolerance.free and off > tolerance.share * radius):
        raise ProgramBlockError(
            f"The end of the arc is {off:.4g} mm off its circle (page {tolerance.page})", "arc-radius"
        )


def arc_by_radius(
    x0: float,
    y0: float,
    x1: float,
    y1: float,
    radius: float,
    tolerance: ArcTolerance | None = None,
    *,
    clockwise: bool,
) -> Arc:
    """Return the arc of a radius between two points: the longer one of a negative radius.
    Raises ProgramBlockError where the points are farther apart than a circle is wide.
    """
    chord = math.hypot(x1 - x0, y1 - y0)
    if chord <= CLOSED:
        raise ProgramBlockError("An arc by R has to end somewhere else", "arc-radius")
    size = abs(radius)
    if tolerance and size < 0.5 * chord <= size + tolerance.reach:
        size = 0.5 * chord
    inside = size * size - 0.25 * chord * chord
    # A half circle of rounded figures is a little below 0: that is no fault of the program.
    if inside < -1e-9 * size * size:
        raise ProgramBlockError(
            f"The ends of the arc are {chord:.6g} mm apart: no circle of R {size:.6g}", "arc-too-wide"
        )
    height = math.sqrt(max(inside, 0.0))
    # Two circles of this radius go through both points: R below 0 takes the one with the longer arc.
    side = -1.0 if clockwise == (radius > 0.0) else 1.0
    first = 0.5 * (x0 + x1) - side * height * (y1 - y0) / chord
    second = 0.5 * (y0 + y1) + side * height * (x1 - x0) / chord
    sweep = math.atan2(y1 - second, x1 - first) - math.atan2(y0 - second, x0 - first)
    return Arc(first, second, size, _turned(sweep, clockwise=clockwise))


def _turned(sweep: float, *, clockwise: bool) -> float:
    whole = 2.0 * math.pi
    if clockwise:
        # A sweep of 0 is a full circle here: an arc that goes nowhere is not programmed.
        return sweep % whole - whole if sweep % whole > 0.0 else -whole
    return sweep % whole or whole
