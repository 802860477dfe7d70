"""Machines of different families side by side: by what their parameters mean, axis by axis."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from amp_studio.files import ParameterFile

from .description import OF_AXIS, OF_MACHINE, AxisMeaning, ConceptValue, MachineMeaning
from .reading import read_meaning

_SAME = 1e-6
"""Part by which two figures may differ and count as the same: what rounding inwards has taken away."""
_UNITS = {
    "travel.low": "",
    "travel.high": "",
    "rollover": "",
    "error.limit": "",
    "backlash": "",
    "home.coordinate": "",
    "home.offset": "",
    "home.second": "",
    "rapid": "/min",
    "feed.ceiling": "/min",
    "jog": "/min",
    "home.search": "/min",
    "home.leave": "/min",
    "acceleration": "/s2",
    "jerk": "/s3",
}
"""Concepts in mm or degrees, and what of time is behind it."""


@dataclass(frozen=True)
class MeaningRow:
    """One concept of one axis ("" for the machine) on each machine;
    None where a machine has none or it is not known.
    """

    concept: str
    axis: str
    values: tuple[ConceptValue, ...]
    unit: str

    @property
    def is_same(self) -> bool:
        """Whether all machines have the same."""
        # With the first alone: equality within a part of a millionth does not go on from one to the next.
        first = self.values[0]
        return all(_is_same(first, other) for other in self.values[1:])

    def texts(self) -> list[str]:
        """Return the values as a person reads them."""
        return [_text(value, self.unit) for value in self.values]


def compare_meanings(files: Sequence[ParameterFile]) -> list[MeaningRow]:
    """Return every concept that one of the machines has; raises MeaningError."""
    machines = [read_meaning(file) for file in files]
    rows = [*_rows_of_axes(machines), *_rows_of_machine(machines)]
    return [row for row in rows if any(value is not None for value in row.values)]


def _rows_of_axes(machines: Sequence[MachineMeaning]) -> Iterator[MeaningRow]:
    """Yield the concepts of the axes, those of one letter together."""
    for letter in dict.fromkeys(axis.letter for machine in machines for axis in machine.axes):
        axes = [_axis_of(machine, letter) for machine in machines]
        turns = any(axis is not None and axis.turns for axis in axes)
        for concept in OF_AXIS:
            values = tuple(_value_of(axis, concept) for axis in axes)
            yield MeaningRow(concept, letter, values, _unit(concept, turns=turns))


def _value_of(axis: AxisMeaning | None, concept: str) -> ConceptValue | None:
    figure = axis.figures.get(concept) if axis else None
    return figure.value if figure else None


def _axis_of(machine: MachineMeaning, letter: str) -> AxisMeaning | None:
    return next((axis for axis in machine.axes if axis.letter == letter), None)


def _rows_of_machine(machines: Sequence[MachineMeaning]) -> Iterator[MeaningRow]:
    """Yield the concepts of the machines as a whole."""
    for concept in OF_MACHINE:
        figures = [machine.figures.get(concept) for machine in machines]
        values = tuple(_whole(concept, figure.value) if figure else None for figure in figures)
        yield MeaningRow(concept, "", values, "rpm" if concept.startswith("spindle") else "")


def _whole(concept: str, value: object) -> ConceptValue:
    """Return one figure of a list: the speeds of the gears together."""
    if not isinstance(value, list):
        return value if isinstance(value, (float, str, bool)) else None
    speeds = [float(v) for v in value if isinstance(v, (int, float))]
    return (max if concept.endswith("greatest") else min)(speeds) if speeds else None


def _unit(concept: str, *, turns: bool) -> str:
    return f"{'deg' if turns else 'mm'}{_UNITS[concept]}" if concept in _UNITS else ""


def _is_same(first: ConceptValue, other: ConceptValue) -> bool:
    if isinstance(first, float) and isinstance(other, float):
        # An absolute part too: beside 0 nothing is relatively close.
        return math.isclose(first, other, rel_tol=_SAME, abs_tol=_SAME)
    return first == other


def _text(value: ConceptValue, unit: str) -> str:
    if value is None:
        return "-"
    return f"{value:.9g} {unit}".strip() if isinstance(value, float) else str(value)
