"""Between what values an axis may be, as the file has them: for a page that shows where it is now."""

from __future__ import annotations

from dataclasses import dataclass

from amp_studio.files import ParameterFile
from amp_studio.schema import ParameterId, convert, dimension

from .figures import DrawnValue, ValueReader
from .parts import every_axis


@dataclass(frozen=True)
class LiveLimits:
    """Ends of the travel and the largest following error of an axis, None for what is not set."""

    low: float | None = None
    high: float | None = None
    error: float | None = None


def axis_limits(file: ParameterFile, letter: str, unit: str) -> LiveLimits:
    """Return the limits of the axis that a person calls so, in a unit; what has another dimension is None."""
    figures, roles = ValueReader(file), file.schema.pictures
    instance = next((each for each in every_axis(file) if letter in (each, figures.axis(each))), None)
    if instance is None:
        return LiveLimits()

    def number(parameter: ParameterId) -> float | None:
        return _in_unit(figures.figure(parameter, instance, quiet=True), unit)

    span = roles.travel.spans[0] if roles.travel and roles.travel.spans else None
    errors = [found for each in (roles.error.limits if roles.error else ()) if (found := number(each))]
    low, high = (number(span.low), number(span.high)) if span else (None, None)
    return LiveLimits(low, high, max(errors, default=None))


def _in_unit(figure: DrawnValue | None, unit: str) -> float | None:
    if figure is None or figure.number is None or dimension(figure.unit) != dimension(unit):
        return None
    return convert(figure.number, figure.unit, unit)
