"""A calibration table changed by hand, as at the control's screen: insert, replace, delete,
and what it comes to.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from .compensation import CalibrationTable
from .errors import CalibrationError


def inserted(table: CalibrationTable, at: Fraction, error: Fraction) -> CalibrationTable:
    """Return a table with one more point; the first one has no error, as at the control.
    Raises CalibrationError.
    """
    if any(position == at for position, _ in table.points):
        raise CalibrationError(f"there is a point at {_text(at)} already: replace it")
    if not table.points and error:
        raise CalibrationError("the first point has the deviation 0: it is where the table starts")
    return replace(table, points=tuple(sorted((*table.points, (at, error)))))


def replaced(table: CalibrationTable, at: Fraction, error: Fraction) -> CalibrationTable:
    """Return a table with another error at a point; raises CalibrationError where there is none."""
    _demand(table, at)
    return replace(table, points=tuple((p, error if p == at else by) for p, by in table.points))


def deleted(table: CalibrationTable, at: Fraction) -> CalibrationTable:
    """Return a table without a point; raises CalibrationError where there is none."""
    _demand(table, at)
    return replace(table, points=tuple(point for point in table.points if point[0] != at))


def rechosen(table: CalibrationTable, input_: str, start: str) -> CalibrationTable:
    """Return a table with another input or start,
    which the control asks only while there are no points (page 36-6).
    """
    if table.points and (input_ != table.input or start != table.start):
        raise CalibrationError("input and start can be chosen again when all points of the axis are deleted")
    return replace(table, input=input_, start=start)


def left_over(table: CalibrationTable, at: Fraction, error: Fraction) -> Fraction:
    """Return the whole error of a position where ``error`` was measured with the table switched
    on (page 36-10).
    """
    return error + table.curve.at(at)


def _demand(table: CalibrationTable, at: Fraction) -> None:
    if all(position != at for position, _ in table.points):
        near = min((p for p, _ in table.points), key=lambda p: abs(p - at), default=None)
        nearest = "the table is empty" if near is None else f"the nearest is at {_text(near)}"
        raise CalibrationError(f"there is no point at {_text(at)}; {nearest}")


def _text(number: Fraction) -> str:
    return f"{float(number):.5f}".rstrip("0").rstrip(".")
