"""What gains have to keep: an axis with gains that are tried, and how much of an aim its loops keep."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

from amp_studio.sim.law import AxisLaw

from .aims import Aim
from .linear import LawMatrices
from .loops import SOUND, LoopDemand, Loops, spread_of

_RESERVE = 0.99
"""Share of every limit that is used: what is tried is computed within half a percent."""
_FULL_PERCENT = 100.0


class Candidate:
    """An axis with gains that are tried."""

    def __init__(self, axis: AxisLaw, *, exact: bool = False) -> None:
        self.axis, self._exact = axis, exact
        self.law = LawMatrices.of(axis)

    @cached_property
    def loops(self) -> Loops:
        """The loops on the machine as it is taken to be."""
        return Loops(self.axis, self.law, exact=self._exact)

    @cached_property
    def others(self) -> list[Loops]:
        """The loops on the machines that it may be."""
        return [Loops(axis, self.law, exact=self._exact) for axis in spread_of(self.axis)]

    @cached_property
    def jolt(self) -> float:
        """By which share of its range one count of the feedback moves the output."""
        machine = self.axis.machine
        full = _FULL_PERCENT if self.axis.output_unit == "%" else machine.output_limit
        # The coarser device moves the output most.
        count = max(machine.motor_count, machine.position_count)
        return self.law.jolt() * count / full if math.isfinite(full) else 0.0


@dataclass(frozen=True)
class Level:
    """How much of an aim is kept; the first one is all of it."""

    need: LoopDemand
    spread: LoopDemand | None
    jolt: float
    slowest: float = math.inf
    """1/s: the greatest position gain."""

    def keeps(self, tried: Candidate, reserve: float = _RESERVE) -> bool:
        """Return whether a candidate keeps it."""
        # The cheapest question first: loops on the machines that it may be cost most.
        if tried.axis.position_rate > self.slowest * (1.0 + 1e-9) or tried.jolt > self.jolt:
            return False
        if not tried.loops.sound(_tighter(self.need, reserve)):
            return False
        spread = self.spread
        return spread is None or all(each.sound(_tighter(spread, reserve)) for each in tried.others)


def _tighter(need: LoopDemand, reserve: float) -> LoopDemand:
    # The peak of the sensitivity is 1 for a loop that does nothing: only what is above that can be kept free.
    return LoopDemand(
        1.0 + (need.sensitivity - 1.0) * reserve,
        need.phase / reserve,
        need.inner_phase / reserve,
        need.gain / reserve,
        need.damping,
    )


def levels_of(aim: Aim, slowest: float = math.inf) -> list[Level]:
    """Return all of an aim; without its counts; on the machine as it is taken to be alone;
    what a sound axis keeps.
    """
    return [
        Level(aim.need, aim.spread, aim.jolt, slowest),
        Level(aim.need, aim.spread, math.inf, slowest),
        Level(aim.need, None, math.inf, slowest),
        Level(SOUND, None, math.inf, slowest),
    ]
