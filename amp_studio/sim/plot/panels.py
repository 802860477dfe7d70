"""The parts of a picture of a trace: curves in panels, closed paths, a map."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from amp_studio.sim.series import Series
from amp_studio.sim.tuning.sampled import Matrix

Role = Literal["command", "actual", "other", "output", "before"]


@dataclass(frozen=True, eq=False)
class Curve:
    """One curve; ``dots`` for single measured values, ``held`` for a value that is constant
    between two samples of the control.
    """

    name: str
    x: Series
    y: Series
    role: Role
    dots: bool = False
    held: bool = False
    dense: bool = False
    """Whether it ripples between samples: where it is too dense it is drawn as its mean in the band it fills."""


@dataclass(frozen=True, eq=False)
class Panel:
    """Curves over one vertical axis; ``levels`` are named values on it, ``marks`` named places on the x axis."""

    label: str
    unit: str
    curves: tuple[Curve, ...]
    levels: tuple[tuple[str, float], ...] = ()
    marks: tuple[tuple[str, float], ...] = ()
    height: float = 1.0
    """Share of the height of a picture."""
    step: float = 0.0
    """Distance of the numbers on the axis where round decimal numbers are wrong (degrees); 0 for those."""


@dataclass(frozen=True, eq=False)
class Ring:
    """A closed path of a ball-bar picture: the radius deviation over the angle in rad."""

    name: str
    angle: Series
    deviation: Series
    role: Role


@dataclass(frozen=True, eq=False)
class Field:
    """A figure over two values, as a map: a cell for each pair of them."""

    label: str
    unit: str
    x_label: str
    y_label: str
    x: Series
    y: Series
    values: Matrix
    """(y, x); nan where there is none."""
    safe: npt.NDArray[np.bool_]
    """(y, x)"""
    present: tuple[float, float] | None = None
    best: tuple[float, float] | None = None


@dataclass(frozen=True, eq=False)
class Picture:
    """One picture."""

    title: str
    facts: tuple[str, ...]
    """Figures in words, the most important first."""
    x_label: str
    panels: tuple[Panel, ...]
    x_log: bool = False
    close: Panel | None = None
    """The settling, over a separate time axis."""
    field: Field | None = None
    rings: tuple[Ring, ...] = ()
    ring_unit: str = ""
    alarms: tuple[tuple[str, float], ...] = ()
    assumed: tuple[str, ...] = ()
