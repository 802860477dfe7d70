"""Areas over one or more axes that a control guards: outside of which, or inside of which,
the axes have to stay.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Literal

from .command.events import Ramp

Guard = Literal["outside", "inside", "by start"]
"""The axes must stay outside; inside; or where they are when the area is switched on."""
EPSILON = 1e-9
"""u: an axis on the edge is not beyond it."""


@dataclass(frozen=True)
class Zone:
    """One box; axes without a side in it are open."""

    name: str
    sides: Mapping[str, tuple[float, float]]
    """Axis -> (least, greatest) u."""
    guard: Guard
    is_on: bool
    """Whether it is on at power-up."""
    code: str
    """Of entering it."""
    code_plus: str = ""
    """Of leaving it at its greater side, and below at its lesser one; "" for ``code``."""
    code_minus: str = ""
    page: str = ""
    notes: tuple[str, ...] = ()
    stop: Ramp | None = None
    """How the command stops there; None for at once."""
    reads_ahead: str = ""
    """Code with which a programmed block that would break it is not begun; "" where it is begun."""
    refuses: bool = False
    """Whether every motion that would break it is not begun."""

    def has_number(self, number: str) -> bool:
        """Return whether its name, without the group that it is of, has a number."""
        return number in self.name.partition(",")[0].split()

    def contains(self, point: Mapping[str, float]) -> bool:
        """Return whether a point is in the box, its edges not;
        an axis that the point does not have counts as in it.
        """
        return all(
            low + EPSILON < point[axis] < high - EPSILON
            for axis, (low, high) in self.sides.items()
            if axis in point
        )

    def settled(self, start: Mapping[str, float]) -> Zone:
        """Return the same area, switched on at a point."""
        if self.guard != "by start":
            return self
        return replace(self, guard="inside" if self.contains(start) else "outside")

    def broken(self, point: Mapping[str, float]) -> str:
        """Return the code of a point that is not allowed; "" for one that is."""
        if self.guard == "inside":
            for axis, (low, high) in self.sides.items():
                if axis in point and point[axis] > high + EPSILON:
                    return self.code_plus or self.code
                if axis in point and point[axis] < low - EPSILON:
                    return self.code_minus or self.code
            return ""
        return self.code if self.contains(point) else ""

    def room(self, point: Mapping[str, float]) -> float:
        """Return how far, at least, a point is from an edge of the area in any axis, u."""
        gaps = [
            min(abs(point[axis] - low), abs(point[axis] - high))
            for axis, (low, high) in self.sides.items()
            if axis in point
        ]
        if not gaps:
            return math.inf
        if self.guard == "inside":
            return min(gaps)
        outside = [
            max(low - point[axis], point[axis] - high)
            for axis, (low, high) in self.sides.items()
            if axis in point
        ]
        return max(0.0, *outside)
