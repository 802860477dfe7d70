"""What the solver asks of an axis whose values can be tried."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from amp_studio.schema import Value
from amp_studio.sim.law import AxisLaw


class Tried(Protocol):
    """An axis, bound with other values of its parameters (`trial.Trial`)."""

    axis: AxisLaw

    def value(self, parameter: str) -> Value | None:
        """Return the present number of a parameter."""

    def bound(self, numbers: Mapping[str, float]) -> AxisLaw | None:
        """Return the axis with other values."""

    def range_of(self, parameter: str) -> tuple[float | None, float | None]:
        """Return the bounds of a parameter."""

    def unit(self, parameter: str) -> str:
        """Return the unit in which a number of a parameter is written."""

    def called(self, parameter: str) -> str:
        """Return what a sentence calls a parameter: its number and name."""

    def decimals(self, parameter: str) -> int | None:
        """Return the decimals that the control keeps of a parameter."""
