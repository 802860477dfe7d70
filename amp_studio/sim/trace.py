"""The result of a scenario: motion, figures, alarms, recommendations and assumptions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, NamedTuple

from amp_studio.schema import write_figure

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

Figure = tuple[float | None, str]
"""A value and its unit; None if the motion did not reach it."""


def titled(axis: str, letter: str) -> str:
    """Return an axis with its letter: ``1 (X)``."""
    return f"{axis} ({letter})" if letter and letter != axis else axis


@dataclass(frozen=True)
class Alarm:
    """An alarm of the control and its time."""

    code: str
    """As the control shows it; after a colon at its end comes the name of the axis."""
    time_s: float
    message: str

    def of_axis(self, name: str) -> Alarm:
        """Return the alarm with the name of its axis, where the control shows that."""
        return replace(self, code=f"{self.code} {name}") if self.code.endswith(":") else self


@dataclass(frozen=True)
class PlaneArea:
    """A zone in the plane of two axes, from least to greatest of each."""

    name: str
    x: tuple[float, float]
    y: tuple[float, float]


class HomingStage(NamedTuple):
    """One part of a homing, from one order to the next."""

    name: str
    """approach, leave, search, back, again or final."""
    begin: float
    """s"""
    speed: float
    """Of the command, u/min."""
    parameter: str
    """Id of what sets the speed; "" where none does."""


@dataclass(frozen=True)
class HomingCourse:
    """What a homing met on its way: places in u from its start, in the direction of the machine."""

    stages: tuple[HomingStage, ...]
    switch: tuple[float, float] | None
    """Where the switch comes on and goes off on the way over it, the second infinite where it stays on; None
    for a homing without one."""
    marker: float | None
    """One of the markers; None where none counts."""
    turn: float
    """From one marker to the next."""
    home: float | None
    coordinate: float
    """What the axis is called at ``home``."""
    unit: str


@dataclass(frozen=True)
class Recommendation:
    """A recommended value, with the reason in one line."""

    parameter: str
    """Id of the parameter, or the name of the axis' figure without one."""
    value: float
    unit: str
    why: str
    price: str = ""
    """What it costs, in a sentence."""


@dataclass(frozen=True, eq=False, repr=False)
class Trace:
    """One scenario run on one axis."""

    scenario: str
    axis: str
    model: str
    """The model in one line."""
    columns: Mapping[str, npt.NDArray[np.float64]]
    """Name -> (rows,) float64, all of the same length; the first is the time."""
    units: Mapping[str, str]
    """Name of a column -> its unit."""
    result: Mapping[str, Figure]
    assumptions: tuple[str, ...]
    alarms: tuple[Alarm, ...] = ()
    recommendations: tuple[Recommendation, ...] = ()
    limits: Mapping[str, Figure] = field(default_factory=dict)
    """Named limits of the following error, to draw beside the curves."""
    letter: str = ""
    """The letter that the file gives the axis, where it is another than ``axis``."""
    move: Mapping[str, float] = field(default_factory=dict)
    """Settings that the scenario chose by the axis or was given, in mm or deg:
    with them another axis makes the same move."""
    areas: tuple[PlaneArea, ...] = ()
    """Zones to draw in the plane of the first two axes."""
    course: HomingCourse | None = None
    """Of a homing."""
    doubts: tuple[str, ...] = ()
    """What is wrong or doubtful about the values that the axis was made of, each a sentence."""

    over: tuple[str, ...] = ()
    """Columns that are what a sweep varies; their present values are its limits."""
    called: Mapping[str, str] = field(default_factory=dict)
    """Of those that are parameters: column -> number and name."""
    figure: str = ""
    """The column that a sweep is about."""

    def __repr__(self) -> str:
        """Its figures; the rows of the columns would be thousands of numbers."""
        figures = ", ".join(
            f"{name} {'–' if value is None else write_figure(value)} {unit}".rstrip()
            for name, (value, unit) in self.result.items()
        )
        return f"<Trace {self.scenario}, axis {self.axis_title}, {self.rows} rows: {figures}>"

    @property
    def axis_title(self) -> str:
        """The axis as a person knows it: ``1 (X)``."""
        return titled(self.axis, self.letter)

    @property
    def rows(self) -> int:
        """Number of rows of every column."""
        return len(next(iter(self.columns.values())))
