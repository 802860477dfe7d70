"""Ballscrew table and backlash of AcroMill (pages 87 and 107), and the gains that are tuned on its screen."""

from __future__ import annotations

import re
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

from .formulas.ballscrew import is_ballscrew_table

_INCH = Fraction("25.4")
_WORD = re.compile(r"[A-Z][0-9]+E(-?\.[0-9]{5})")
_MAX_WORDS = 10_000
"""Ten thousand whole positions are far more than any travel; the guide prints no limit."""


class _BallscrewTable:
    """A word for each whole position from home on; what lies before home is at the end (page 107).

    A word has the correction: target less the mean of what was measured.
    """

    parameter = "ballscrew.table"
    inputs: tuple[str, ...] = ()
    starts: tuple[str, ...] = ()
    is_even = True
    decimals = 5
    switching = (
        "The controller uses the table once its command file was read (page 91); AcroMill NT 2.00 does not"
        " (page 86)."
    )

    def read(self, file: ParameterFile, axis: str, text: str) -> CalibrationTable:
        """Return the table in mm; raises CalibrationError."""
        letter = _letter(file, axis)
        if not is_ballscrew_table(letter, text):
            raise CalibrationError(f"the ballscrew table of the axis is no table for {letter} (page 107)")
        figures = [Fraction(match[1]) for word in text.split() if (match := _WORD.fullmatch(word))]
        first = self._first(file, axis, len(figures))
        size, home, count = _unit(file), _home(file, axis), len(figures)
        return CalibrationTable(
            "mm", tuple(((n + home) * size, -figures[n % count] * size) for n in range(first, first + count))
        )

    def write(self, file: ParameterFile, axis: str, table: CalibrationTable) -> str:
        """Return the text; raises CalibrationError for what has no form."""
        letter, size, home = _letter(file, axis), _unit(file), _home(file, axis)
        if len(table.points) > _MAX_WORDS:
            raise CalibrationError(f"{len(table.points)} positions are too many for a ballscrew table")
        count = len(table.points)
        words = {}
        for at, by in table.points:
            # Fractions: whether a place is whole must not depend on rounding.
            place = at / size - home
            if place.denominator != 1:
                raise CalibrationError("a ballscrew table has a word for each whole position and no other")
            # Places before home wrap to the end of the table (107).
            words[int(place) % count] = _figure(-by / size)
        if sorted(words) != list(range(count)):
            raise CalibrationError("a ballscrew table has a word for each whole position, without a gap")
        return " ".join(f"{letter}{n}E{words[n]}" for n in range(count))

    def empty(self, file: ParameterFile, axis: str, input_: str, start: str) -> CalibrationTable:  # noqa: ARG002  # other forms need them
        """Return a table without corrections, as long as the travel between the soft limits."""
        size, home = _unit(file), _home(file, axis)
        low, high = self._travel(file, axis)
        return CalibrationTable("mm", tuple(((n + home) * size, Fraction(0)) for n in range(low, high + 1)))

    def fit(self, file: ParameterFile, axis: str, errors: ErrorCurve, input_: str, start: str) -> FittedTable:  # noqa: ARG002  # other forms need them
        """Return the words of every whole position of the travel;
        raises CalibrationError where it was not measured.
        """
        size, home = _unit(file), _home(file, axis)
        low, high = self._travel(file, axis)
        first, last = errors.points[0][0], errors.points[-1][0]
        if (low + home) * size < first or (high + home) * size > last:
            raise CalibrationError(
                f"the table needs every whole position from {_point_text((low + home) * size, size)} to"
                f" {_point_text((high + home) * size, size)}, and {_point_text(first, size)} to "
                f"{_point_text(last, size)}"
                " was measured"
            )
        positions = [(n + home) * size for n in range(low, high + 1)]
        measured = {at for at, _ in errors.points}
        notes = []
        if missing := sum(at not in measured for at in positions):
            notes.append(
                f"{missing} of {len(positions)} whole positions were not measured and lie on the line between"
                " those that were"
            )
        step = size / 10**self.decimals
        return FittedTable(
            CalibrationTable("mm", tuple((at, round(errors.at(at) / step) * step) for at in positions)),
            tuple(notes),
        )

    def figure(self, table: CalibrationTable, at: Fraction, error: Fraction) -> Fraction:  # noqa: ARG002  # other forms need them
        """Return the correction, in mm."""
        return -error

    def error(self, table: CalibrationTable, at: Fraction, figure: Fraction) -> Fraction:  # noqa: ARG002  # other forms need them
        """Return the error that a correction takes away."""
        return -figure

    def remarks(self, file: ParameterFile, axis: str, table: CalibrationTable) -> tuple[str, ...]:  # noqa: ARG002  # other forms need them
        """Return nothing: the controller warns of nothing."""
        return ()

    def limits(self, file: ParameterFile, axis: str) -> tuple[str, ...]:
        """Return what the form of the file demands."""
        low, high = self._travel(file, axis)
        return (
            (
                f"A word for each whole position of the travel, {high - low + 1} here, the first one home"
                " (page 107)."
            ),
            "Corrections below 1 with five decimals (page 107).",
        )

    def _travel(self, file: ParameterFile, axis: str) -> tuple[int, int]:
        """Return the whole positions between the soft limits, counted from home."""
        found = []
        for name in ("axes.soft_limit_minus", "axes.soft_limit_plus"):
            value = file.evaluation.canonical((name, axis))
            if not isinstance(value, float):
                raise CalibrationError(
                    "the soft limits of the axis are not set: they give the length of the table"
                )
            found.append(Fraction(repr(value)) / _unit(file))
        # Towards home on both sides: a word beyond a soft limit is never used.
        low, high = -int(max(-found[0], Fraction(0))), int(max(found[1], Fraction(0)))
        if high - low >= _MAX_WORDS:
            raise CalibrationError(f"{high - low + 1} positions are too many for a ballscrew table")
        return low, high

    def _first(self, file: ParameterFile, axis: str, count: int) -> int:
        """Return the lowest position of a table of so many words, counted from home."""
        try:
            low, high = self._travel(file, axis)
        except CalibrationError:
            return 0
        # A table of another length than the travel does not show where it wraps: it is taken to begin at
        # home.
        return low if high - low + 1 == count else 0


def _letter(file: ParameterFile, axis: str) -> str:
    value = file.evaluation.canonical(("axes.name", axis))
    return str(value).upper() if isinstance(value, str) else axis


def _unit(file: ParameterFile) -> Fraction:
    """Return the size of a whole position in mm: an inch, or a millimetre."""
    return _INCH if file.evaluation.canonical(("control.default_units", "")) == "inch" else Fraction(1)


def _home(file: ParameterFile, axis: str) -> Fraction:
    """Return the position that the display shows at home, in whole positions;
    the table counts from home (page 107).
    """
    value = file.evaluation.canonical(("home.preset", axis))
    return Fraction(repr(value)) / _unit(file) if isinstance(value, float) else Fraction(0)


def _figure(correction: Fraction) -> str:
    text = f"{float(abs(correction)):.5f}"
    if not text.startswith("0."):
        raise CalibrationError(
            f"a correction of {float(correction):.5f} has digits before the point, for which there is no form"
        )
    # No minus before a correction that is rounded to nothing.
    return ("-" if correction < 0 and text != "0.00000" else "") + text[1:]


def _point_text(at: Fraction, size: Fraction) -> str:
    return f"{float(at / size):g} {'in' if size == _INCH else 'mm'}"


COMPENSATION = Compensation(
    reversal="backlash.amount",
    table=_BallscrewTable(),
    pages=(
        TuningPage("reversal", "Backlash", "87", ("backlash.amount",)),
        TuningPage(
            "servo",
            "Gains",
            "93",
            (
                "servo.p_gain",
                "servo.i_gain",
                "servo.i_delay",
                "servo.i_limit",
                "servo.d_gain",
                "servo.d_time",
                "servo.acc_ffwd",
                "servo.vel_ffwd",
                "servo.torque_limits",
            ),
        ),
        TuningPage(
            "filters",
            "Filters",
            "128",
            ("tuning.lopass_frequency", "tuning.notch_frequency", "tuning.notch_width", "tuning.fbvel"),
        ),
        TuningPage(
            "home",
            "Homing",
            "65",
            (
                "home.fast_speed",
                "home.slow_speed",
                "home.marker_speed",
                "home.acceleration",
                "home.deceleration",
                "home.preset",
            ),
        ),
        TuningPage("spindle", "Spindle", "77", ("spindle.scaling",)),
    ),
)
