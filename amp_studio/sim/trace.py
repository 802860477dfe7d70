"""What a scenario hands back: the motion, its figures, the alarms, the advice and what was assumed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Figure = tuple[float | None, str]
"""A value and its unit; None where the motion never showed it."""


@dataclass(frozen=True)
class Alarm:
    """A message the control would show, and when."""

    code: str
    time_s: float
    message: str


@dataclass(frozen=True)
class Advice:
    """One change worth making: the value, and why in one line with its price."""

    parameter: str
    """Id of the parameter, or the name of the axis' figure where no parameter is known."""
    value: float
    unit: str
    why: str


@dataclass(frozen=True, eq=False)
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
    alarms: tuple[Alarm, ...]
    advice: tuple[Advice, ...]
    assumptions: tuple[str, ...]
    limits: Mapping[str, Figure]
    """Named levels of following error to draw beside the curves."""

    @property
    def rows(self) -> int:
        """Number of rows of every column."""
        return len(next(iter(self.columns.values())))
