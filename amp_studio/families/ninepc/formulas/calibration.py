"""Axis calibration on line: chapter 36. The table of an axis is one text,
its points as the control's screen has them.

``deviation - mm 0:0 100:0.004``: how points are given (``measurement`` or ``deviation``), at which end the
table starts (``-`` or ``+``), the unit, and for each point the position that the control reads and the figure
beside it, the most negative first. A deviation is the actual position less the reading (page 36-7). Five
decimals are assumed; none are printed.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from itertools import pairwise

from amp_studio.errors import AmpStudioError

MAX_POINTS = 1001
"""Of all axes together (page 36-10)."""
LONGEST_INTERVAL = {"mm": Fraction("2133.6"), "deg": Fraction("2133.6"), "in": Fraction(84)}
"""Between neighbouring points (page 36-7); of degrees the control knows only the figure."""
STEEPEST = Fraction(2, 100)
"""Largest deviation at a point, of the distance from the point before it (page 36-7)."""
DECIMALS = 5
INPUTS = ("measurement", "deviation")
STARTS = ("+", "-")
_POINT = re.compile(r"(-?[0-9]{1,6}(?:\.[0-9]{1,5})?):(-?[0-9]{1,6}(?:\.[0-9]{1,5})?)")


class CalibrationTextError(AmpStudioError, ValueError):
    """A text that is no calibration table of this control; the reason is one clause."""


@dataclass(frozen=True)
class CalibrationText:
    """A table as the control has it; ``points`` are positions and deviations,
    the most negative position first.
    """

    input: str
    start: str
    unit: str
    points: tuple[tuple[Fraction, Fraction], ...]

    def written(self) -> str:
        """Return the text of the table."""
        figures = (
            f"{_figure(at)}:{_figure(at + by if self.input == 'measurement' else by)}"
            for at, by in self.points
        )
        return " ".join((self.input, self.start, self.unit, *figures))


@lru_cache(maxsize=64)
def read_calibration(text: str) -> CalibrationText:
    """Read a table; raises CalibrationTextError for what has not its form or breaks a limit of the screen."""
    words = text.split()
    if len(words) < 4 or words[0] not in INPUTS or words[1] not in STARTS or words[2] not in LONGEST_INTERVAL:
        raise CalibrationTextError(
            "it begins with measurement or deviation, - or +, and mm, in or deg, followed by points as"
            " 100:0.004"
        )
    points = []
    for word in words[3:]:
        match = _POINT.fullmatch(word)
        if match is None:
            raise CalibrationTextError(f"'{word[:40]}' is no point such as 100:0.004")
        at, by = Fraction(match[1]), Fraction(match[2])
        points.append((at, by - at if words[0] == "measurement" else by))
    table = CalibrationText(words[0], words[1], words[2], tuple(points))
    _check(table)
    return table


def _check(table: CalibrationText) -> None:
    """Raise CalibrationTextError for a table that the screen of the control would refuse."""
    # The screen checks in the order of entry, which begins at the start of the table (36-7).
    entered = table.points if table.start == "-" else table.points[::-1]
    if len(entered) > MAX_POINTS:
        raise CalibrationTextError(f"it has {len(entered)} points, and {MAX_POINTS} are the most")
    if entered[0][1]:
        raise CalibrationTextError(
            f"the first point that is entered, {_figure(entered[0][0])}, has the deviation 0"
        )
    for (low, _), (high, _) in pairwise(table.points):
        if high <= low:
            raise CalibrationTextError(
                f"{_figure(high)} follows {_figure(low)}: positions rise from point to point"
            )
    longest = LONGEST_INTERVAL[table.unit]
    for (before, _), (at, by) in pairwise(entered):
        distance = abs(at - before)
        if distance > longest:
            raise CalibrationTextError(
                f"from {_figure(before)} to {_figure(at)} is more than {_figure(longest)} {table.unit}, "
                "the most between two points"
            )
        if abs(by) > STEEPEST * distance:
            raise CalibrationTextError(
                f"the deviation {_figure(by)} at {_figure(at)} is more than 2 % of the {_figure(distance)}"
                f" {table.unit} from the point before it (PARAMETER OUT OF RANGE)"
            )


def calibration_fault(table: str, turns: bool) -> str:
    """Return why a text is no calibration table of an axis that turns or not, as a clause;
    "" if it is one (page 36-7).
    """
    try:
        read = read_calibration(table)
    except CalibrationTextError as error:
        return str(error)
    if (read.unit == "deg") != turns:
        return f"its unit is {read.unit} and the axis {'turns' if turns else 'moves straight'}"
    return ""


def calibration_points(tables: Sequence[str | None]) -> float:
    """Number of points in all tables together, of which the control stores 1001 (page 36-10)."""
    # Three words come before the points; not read, as it counts tables that have faults as well.
    return float(sum(max(len(table.split()) - 3, 0) for table in tables if table))


def calibration_net(table: str) -> float:
    """Net correction from the first point of a table to its last, zero over one turn (page 36-7)."""
    points = read_calibration(table).points
    return float(points[-1][1] - points[0][1])


def _figure(number: Fraction) -> str:
    text = f"{float(number):.{DECIMALS}f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text
