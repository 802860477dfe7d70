"""What was measured on an axis: runs over target positions,
and what a person has to answer before they are used.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

SIGNS = ("measured-target", "target-measured")
"""What an error is: measured less target, as in ISO 230-2, or the correction, which is the opposite."""
POSITION_UNITS = ("mm", "in", "um", "deg", "counts")
ERROR_UNITS = (*POSITION_UNITS, "arcsec")
DECIMALS = ("point", "comma")

MeasuredPoints = tuple[tuple[Fraction, Fraction], ...]


@dataclass(frozen=True)
class MeasurementAnswers:
    """What only the person who measured knows for certain; "" where the file is to answer.

    ``unit`` of the positions, ``error_unit`` of the errors, ``sign`` one of ``SIGNS``,
    ``decimal`` one of ``DECIMALS``.
    """

    unit: str = ""
    error_unit: str = ""
    sign: str = ""
    decimal: str = ""


@dataclass(frozen=True)
class MeasuredRun:
    """One pass over the targets: position and error (measured less target) in the unit of the measurement."""

    rising: bool
    points: MeasuredPoints


@dataclass(frozen=True)
class Measurement:
    """All runs of one file.

    ``unit``     of positions and errors: mm, deg or counts
    ``answers``  what was used, with what the file itself has answered
    ``assumed``  names of the answers that neither the file nor a person gave: to be asked before anything is
                 written
    ``notes``    sentences that a person has to know
    ``is_circle``  runs are circles of a ball-bar: positions are degrees, errors those of the radius,
                   rising is counterclockwise
    """

    runs: tuple[MeasuredRun, ...]
    unit: str
    answers: MeasurementAnswers
    assumed: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    is_circle: bool = False

    @property
    def targets(self) -> tuple[Fraction, ...]:
        """The target positions of all runs, rising."""
        return tuple(sorted({at for run in self.runs for at, _ in run.points}))

    def errors(self, *, rising: bool) -> dict[Fraction, list[Fraction]]:
        """Return target -> errors of the runs in one direction, in the order of the runs."""
        found: dict[Fraction, list[Fraction]] = {}
        for run in self.runs:
            if run.rising == rising:
                for at, by in run.points:
                    found.setdefault(at, []).append(by)
        return dict(sorted(found.items()))
