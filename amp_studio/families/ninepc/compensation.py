"""Axis calibration, reversal error and what else the 9/PC tunes on line: chapter 36."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from amp_studio.calibration import (
    CalibrationError,
    CalibrationTable,
    Compensation,
    ErrorCurve,
    FittedTable,
    TuningPage,
)
from amp_studio.files import ParameterFile

from .formulas.calibration import (
    DECIMALS,
    INPUTS,
    LONGEST_INTERVAL,
    MAX_POINTS,
    STARTS,
    STEEPEST,
    CalibrationText,
    CalibrationTextError,
    calibration_points,
    read_calibration,
)

_FARTHEST = 10**6
_STEP = Fraction(1, 10**DECIMALS)


class _NinePcTable:
    """The points of an axis with their deviations, which are measured less target (page 36-7)."""

    parameter = "calibration.table"
    inputs: tuple[str, ...] = INPUTS
    starts: tuple[str, ...] = STARTS
    is_even = False
    decimals = DECIMALS
    switching = (
        "Homing the axis switches its calibration on; the softkey CAL STATUS switches it off until it is"
        " homed again (page 36-10). That is a state of the control and not in a file."
    )

    def read(self, file: ParameterFile, axis: str, text: str) -> CalibrationTable:  # noqa: ARG002  # other forms need them
        """Return a table in mm, in or deg; raises CalibrationError."""
        try:
            found = read_calibration(text)
        except CalibrationTextError as error:
            raise CalibrationError(f"the calibration table of the axis cannot be used: {error}") from None
        points = found.points
        if found.unit == "in":
            points = tuple((at * Fraction("25.4"), by * Fraction("25.4")) for at, by in points)
        return CalibrationTable("deg" if found.unit == "deg" else "mm", points, found.input, found.start)

    def write(self, file: ParameterFile, axis: str, table: CalibrationTable) -> str:
        """Return the text; raises CalibrationError for what the control's screen would refuse."""
        left = self._left(file, axis)
        if len(table.points) > left:
            raise CalibrationError(
                f"MEASUREMENT POINT OVERFLOW: {len(table.points)} points are too many; of {MAX_POINTS} for"
                f" all axes {left} are left for this one (page 36-10)"
            )
        points = tuple((_rounded(at), _rounded(by)) for at, by in table.points)
        text = CalibrationText(table.input, table.start, table.unit, points).written()
        # A table without points is nothing in the file; there is no text to check.
        if points:
            try:
                read_calibration(text)
            except CalibrationTextError as error:
                raise CalibrationError(f"the control would not take the table: {error} (page 36-7)") from None
        return text if points else ""

    def empty(self, file: ParameterFile, axis: str, input_: str, start: str) -> CalibrationTable:
        """Return a table without points; the control proposes measurement
        and the most positive end (page 36-6).
        """
        unit = "deg" if file.evaluation.turns((self.parameter, axis)) else "mm"
        return CalibrationTable(unit, (), input_ or INPUTS[0], start or STARTS[0])

    def fit(self, file: ParameterFile, axis: str, errors: ErrorCurve, input_: str, start: str) -> FittedTable:
        """Return points that leave the least error within the limits of the screen; raises
        CalibrationError.
        """
        table = self.empty(file, axis, input_ or "deviation", start or "-")
        notes: list[str] = []
        if any(abs(at) >= _FARTHEST for at, _ in errors.points):
            raise CalibrationError(
                "a calibration point has at most six digits before the point: check the units"
            )
        # Only the positions yet: deviations are rounded after the shift, so that no rounding is made twice.
        points = [(_rounded(at), by) for at, by in _filled(errors, LONGEST_INTERVAL[table.unit]).points]
        # The end at which the screen begins, whose deviation the control takes as 0 (36-7).
        first = 0 if table.start == "-" else -1
        origin = points[first][1]
        if origin:
            notes.append(
                "the point at the start has no deviation, so all positions are shifted by"
                f" {float(origin):.5f} {table.unit}"
            )
        shifted = [(at, by - origin) for at, by in points]
        shifted = _closed(_rollover(file, axis), shifted, table.start, notes)
        kept = _thinned(shifted, self._left(file, axis))
        if len(kept) < len(shifted):
            notes.append(f"{len(kept)} of {len(shifted)} points fit into the table of the control")
        # After thinning: the 2 % count over the way from the point before, which is longer then.
        steep = _gentle(kept, reverse=table.start == "+")
        if len(steep) < len(kept):
            notes.append(
                f"{len(kept) - len(steep)} points are left out because their deviation is above 2 % of the"
                " way from the one before"
            )
        made = replace(table, points=tuple((at, _rounded(by)) for at, by in steep))
        # What was made here must pass the check of what a person enters.
        self.write(file, axis, made)
        return FittedTable(made, tuple(notes))

    def figure(self, table: CalibrationTable, at: Fraction, error: Fraction) -> Fraction:
        """Return what the second column of the screen has: MEASURE or DEVIATION."""
        return at + error if table.input == "measurement" else error

    def error(self, table: CalibrationTable, at: Fraction, figure: Fraction) -> Fraction:
        """Return the deviation that a figure of the second column means."""
        return figure - at if table.input == "measurement" else figure

    def remarks(self, file: ParameterFile, axis: str, table: CalibrationTable) -> tuple[str, ...]:
        """Return the message about a turn whose net correction is not zero."""
        if not _rollover(file, axis) or not table.points:
            return ()
        net = table.points[-1][1] - table.points[0][1]
        return (
            (f"NET CORRECTION IS NOT ZERO: it is {float(net):.5f} deg over a turn (page 36-7).",)
            if net
            else ()
        )

    def limits(self, file: ParameterFile, axis: str) -> tuple[str, ...]:
        """Return the limits of the screen and the room that is left."""
        turns = file.evaluation.turns((self.parameter, axis))
        unit = "deg" if turns else "mm"
        rollover = _rollover(file, axis)
        lines = [
            f"At most {MAX_POINTS} points for all axes; {self._left(file, axis)} for this one (page 36-10).",
            f"At most {float(LONGEST_INTERVAL[unit]):g} {unit} from point to point (page 36-7).",
            (
                "No deviation above 2 % of the way from the point entered before; the first one is 0 (page"
                " 36-7)."
            ),
        ]
        if rollover:
            lines.append(
                f"The axis rolls over at {float(rollover):g} deg: its net correction over a turn is zero"
                " (page 36-7)."
            )
        return tuple(lines)

    def _left(self, file: ParameterFile, axis: str) -> int:
        """Return how many points the other axes leave for this one."""
        others = [
            str(value.value) for a, value in file.values.items() if a[0] == self.parameter and a[1] != axis
        ]
        return max(MAX_POINTS - int(calibration_points(others)), 0)


def _closed(
    turn: Fraction, points: list[tuple[Fraction, Fraction]], start: str, notes: list[str]
) -> list[tuple[Fraction, Fraction]]:
    """Return points whose net correction over a turn is zero;
    as they are on an axis that does not roll over (0).
    """
    if not turn:
        return points
    (low, first), (high, last) = points[0], points[-1]
    if high - low > turn:
        raise CalibrationError(
            f"the points reach over {float(high - low):g} deg, and the axis rolls over at {float(turn):g}"
        )
    if high - low < turn:
        # At the end entered last: the other one is where the deviation is 0.
        end = (low + turn, first) if start == "-" else (high - turn, last)
        notes.append(
            f"the turn is closed with a point at {float(end[0]):g} deg that has the deviation of the start"
        )
        return [*points, end] if start == "-" else [end, *points]
    if last != first:
        notes.append(
            f"the errors at both ends of the turn differ by {float(last - first):.5f} deg; the end gets that"
            " of the start, for a net correction of zero"
        )
    return [*points[:-1], (high, first)] if start == "-" else [(low, last), *points[1:]]


def _rollover(file: ParameterFile, axis: str) -> Fraction:
    """Return the angle at which an axis rolls over; 0 where it does not."""
    address = ("axis.rollover", axis)
    value = file.evaluation.canonical(address)
    # 0 switches rollover off (4-6).
    if not isinstance(value, float) or value <= 0 or not file.evaluation.state(address).is_active:
        return Fraction(0)
    return Fraction(repr(value))


def _rounded(value: Fraction) -> Fraction:
    """Round to the last decimal of the table, half to even."""
    return round(value / _STEP) * _STEP


def _filled(errors: ErrorCurve, longest: Fraction) -> ErrorCurve:
    """Return a curve with further points of its lines where two lie further apart than the control takes."""
    points = list(errors.points[:1])
    for at, by in errors.points[1:]:
        low = points[-1][0]
        # Rounded up, in fractions: a float could leave a piece a hair too long.
        pieces = -int(-(at - low) // longest) if at - low > longest else 1
        points += [(p, errors.at(p)) for p in (low + (at - low) * n / pieces for n in range(1, pieces))]
        points.append((at, by))
    return ErrorCurve(tuple(points))


def _thinned(points: list[tuple[Fraction, Fraction]], most: int) -> list[tuple[Fraction, Fraction]]:
    """Return at most so many points, those kept that the lines between the others miss most."""
    if most < 2:
        raise CalibrationError(
            "MEASUREMENT POINT OVERFLOW: the tables of the other axes leave no points (page 36-10)"
        )
    if len(points) <= most:
        return points
    rough = [(float(at), float(by)) for at, by in points]  # only to choose: what is kept stays exact
    kept = [0, len(points) - 1]
    worst = [(*_farthest(rough, 0, len(points) - 1), 0, len(points) - 1)]
    while len(kept) < most and worst:
        _, at, low, high = worst.pop(worst.index(max(worst)))
        kept.append(at)
        for one, other in ((low, at), (at, high)):
            # Between neighbours there is no point to miss.
            if other - one > 1:
                worst.append((*_farthest(rough, one, other), one, other))
    return [points[n] for n in sorted(kept)]


def _farthest(points: list[tuple[float, float]], low: int, high: int) -> tuple[float, int]:
    """Return by how much the line between two points misses the point between them that it misses most,
    and which it is.
    """
    (x, y), (far, above) = points[low], points[high]
    slope = (above - y) / (far - x)
    return max((abs(points[n][1] - y - slope * (points[n][0] - x)), n) for n in range(low + 1, high))


def _gentle(points: list[tuple[Fraction, Fraction]], *, reverse: bool) -> list[tuple[Fraction, Fraction]]:
    """Return points whose deviations the control takes: those too close to the one before are left out."""
    entered = points[::-1] if reverse else points
    kept = entered[:1]
    for at, by in entered[1:]:
        if abs(_rounded(by)) <= STEEPEST * abs(at - kept[-1][0]):
            kept.append((at, by))
    while kept[-1] != entered[-1] and len(kept) > 1:  # the end of the travel has to be in the table
        # The end is too steep from there: points before it make way until it is not.
        kept.pop()
        at, by = entered[-1]
        if abs(_rounded(by)) <= STEEPEST * abs(at - kept[-1][0]):
            kept.append(entered[-1])
    if kept[-1] != entered[-1]:
        raise CalibrationError(
            f"the error {float(entered[-1][1]):.5f} at {float(entered[-1][0]):g} is above 2 % of the whole"
            " travel: check units and sign (page 36-7)"
        )
    return kept[::-1] if reverse else kept


COMPENSATION = Compensation(
    reversal="servo.reversal_error",
    table=_NinePcTable(),
    pages=(
        TuningPage(
            "reversal",
            "Reversal Error",
            "36-2",
            ("servo.reversal_error",),
            "The control has to be in E-Stop.",
        ),
        TuningPage(
            "home", "Home Calibration", "36-4", ("home.calibration",), "The control has to be in E-Stop."
        ),
        TuningPage(
            "servo",
            "Servo",
            "36-11",
            (
                "servo.max_torque_positive",
                "servo.velocity_proportional_gain",
                "servo.velocity_integral_gain",
                "servo.initial_gain",
            ),
            "On 1394 CNC serial drives only. After a change of a velocity loop gain the control sets Standard"
            " Motor Table Values to No.",
        ),
        TuningPage("spindle", "Spindle", "36-12", ("spindle.voltage_at_max",)),
    ),
    follow={
        "servo.velocity_proportional_gain": ("servo.standard_motor_values", "no"),
        "servo.velocity_integral_gain": ("servo.standard_motor_values", "no"),
    },
)
