"""What a control family offers against the errors of an axis; found by the family's registration.

``compensation_of`` returns the record of a family, or one that offers nothing. Positions are those that the
control reads and errors are measured less target, whatever the sign of the family's own table.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from typing import Protocol

from amp_studio.files import ParameterFile
from amp_studio.schema import load_part, registration_of

from .curve import ErrorCurve
from .measurement import MeasuredPoints


@dataclass(frozen=True)
class CalibrationTable:
    """The table of one axis: points with rising positions in ``unit``,
    each with the error that it takes away.

    ``input`` and ``start`` are those of the control's screen, "" where there is nothing to choose.
    """

    unit: str
    points: MeasuredPoints
    input: str = ""
    start: str = ""

    @property
    def curve(self) -> ErrorCurve:
        """The errors that the table takes away."""
        return ErrorCurve(self.points)


@dataclass(frozen=True)
class FittedTable:
    """A table within the limits of the control, and what had to be done for it."""

    table: CalibrationTable
    notes: tuple[str, ...] = ()


class TableForm(Protocol):
    """The calibration table of a family: a text parameter of each axis."""

    parameter: str
    inputs: tuple[str, ...]
    starts: tuple[str, ...]
    is_even: bool
    """Its positions are fixed: only figures are changed."""
    decimals: int
    """Of a figure in the unit of the table."""
    switching: str
    """How the table is switched on and off at the control, in a sentence with its page."""

    def read(self, file: ParameterFile, axis: str, text: str) -> CalibrationTable:
        """Return a table; raises CalibrationError."""

    def write(self, file: ParameterFile, axis: str, table: CalibrationTable) -> str:
        """Return the text of a table; raises CalibrationError for what the control would not take."""

    def empty(self, file: ParameterFile, axis: str, input_: str, start: str) -> CalibrationTable:
        """Return the table that a person begins with; raises CalibrationError where there is no empty one."""

    def fit(self, file: ParameterFile, axis: str, errors: ErrorCurve, input_: str, start: str) -> FittedTable:
        """Return the table that takes these errors away best; raises CalibrationError where none can."""

    def figure(self, table: CalibrationTable, at: Fraction, error: Fraction) -> Fraction:
        """Return what the control's screen has beside a position: the error,
        the measured position or the correction.
        """

    def error(self, table: CalibrationTable, at: Fraction, figure: Fraction) -> Fraction:
        """Return the error that a figure of the screen means."""

    def remarks(self, file: ParameterFile, axis: str, table: CalibrationTable) -> tuple[str, ...]:
        """Return what the control would warn of and takes anyway, as sentences."""

    def limits(self, file: ParameterFile, axis: str) -> tuple[str, ...]:
        """Return the limits of the control as sentences, with how many points are left."""


@dataclass(frozen=True)
class TuningPage:
    """One page of values that are tuned at the machine: its title,
    the manual's page and its parameters in order.
    """

    key: str
    title: str
    page: str
    params: tuple[str, ...]
    note: str = ""


@dataclass(frozen=True)
class Compensation:
    """What a family offers.

    ``reversal``   id of the parameter with the lost motion at a reversal; "" for none
    ``is_signed``  its sign means which way motion is lost; else the sign that is there is kept
    ``table``      its calibration table; None for none
    ``pages``      what is tuned at the machine besides
    ``follow``     values that the control changes by itself after one of them is changed: id -> (id,
                   choice or text)
    """

    reversal: str = ""
    is_signed: bool = False
    table: TableForm | None = None
    pages: tuple[TuningPage, ...] = ()
    follow: dict[str, tuple[str, str]] = field(default_factory=dict)


def compensation_of(family: str) -> Compensation:
    """Return the record of a family; one without anything for a family that has none."""
    place = registration_of(family).compensation
    found = load_part(place) if place else Compensation()
    assert isinstance(found, Compensation)
    return found
