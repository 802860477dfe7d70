"""The axis calibration table as a curve: deviations over the positions that the control reads (page 36-7)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

from amp_studio.drawing import Point
from amp_studio.pictures import CurveText

from .formulas.calibration import DECIMALS, CalibrationText, read_calibration


def read(_letter: str, text: str) -> list[Point]:
    """Return positions and deviations; raises ValueError for a text that is no table."""
    return [(float(at), float(by)) for at, by in read_calibration(text).points]


def write(_letter: str, points: Sequence[Point], text: str, unit: str) -> str:
    """Return the text of points, given as those before were;
    raises ValueError where the control refuses one (36-7).
    """
    before = read_calibration(text) if text else CalibrationText("deviation", "-", unit, ())
    written = replace(before, points=tuple((_exact(at), _exact(by)) for at, by in points)).written()
    read_calibration(written)  # raises for a point that breaks a limit of the screen
    return written


def _exact(number: float) -> Fraction:
    return Fraction(f"{number:.{DECIMALS}f}")


def unit(text: str) -> str:
    """Return mm, in or deg."""
    return read_calibration(text).unit


def put_in(points: Sequence[Point], at: Point) -> list[Point]:
    """Return a table with one more position; the first of all has no deviation."""
    return sorted([*points, at]) if points else [(at[0], 0.0)]


def remove_point(points: Sequence[Point], index: int) -> list[Point]:
    """Return a table without a position; raises ValueError for the last one left."""
    if len(points) == 1:
        raise ValueError("A table has one point at least: set it to nothing to take it away")
    return [*points[:index], *points[index + 1 :]]


CURVE = CurveText(read, write, unit, put_in, remove_point, grain=0.00001)
