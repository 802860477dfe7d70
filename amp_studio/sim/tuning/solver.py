"""The one solver of gains: the stiffest loop that keeps what an aim asks for.

Stiffest is the loop whose load moves least under a torque that comes at once and stays: at its worst moment,
and in the mean of the first quarter second, so that an integral gain counts for what it is there for. Every
gain that is tried is a value the control can have: within its printed bounds, in its steps, bound by the law
as the file would be, with the file's own filter, delay, sample time and counts. The search does not begin at
the present gains, so that what it finds depends on the machine alone and a second run has nothing to add:
from the inner loop outwards the largest gain that is sound is found by halves, shares of it are taken, and
the best of all is moved about in ever smaller steps (R. Hooke, T. A. Jeeves, "Direct Search" Solution of
Numerical and Statistical Problems, Journal of the ACM 8, 1961).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np

from amp_studio.schema import Value
from amp_studio.sim.law import AxisLaw
from amp_studio.sim.rounding import rounded

from .aims import Aim
from .linear import LawMatrices
from .loops import SOUND, LoopDemand, Loops, spread_of

SHARES = (1.0, 0.87, 0.74, 0.6, 0.45, 0.3, 0.15)
"""Of the largest gain of a loop that are tried with every gain outside of it; 0 as well for an integral
one."""
COARSE = 2.0
"""Factor between two gains on the way down to the first sound one."""
CLOSE = 1.06
"""Factor within which the largest sound gain is found."""
STEPS = (1.25, 1.1, 1.04, 1.015)
"""Factors by which the best gains are moved about."""
STARTS = 3
"""Points, of different innermost gains, from which is moved about:
the best gains of one may be in another valley."""
DIGITS = 3
"""Digits of a gain that is no whole number."""
SMALLEST, LARGEST = 1e-8, 1e5
"""Gains between which is sought where the manual prints no bound."""
WORTH = 1.03
"""Less stiffness than this factor is not worth a change."""
RESERVE = 0.99
"""Share of every limit that is used: what is tried is computed within half a percent."""
FULL_PERCENT = 100.0


class Tried(Protocol):
    """What the solver asks of an axis whose values can be tried (`trial.Trial`)."""

    axis: AxisLaw

    def value(self, parameter: str) -> Value | None:
        """Return the present number of a parameter."""

    def bound(self, numbers: Mapping[str, float]) -> AxisLaw | None:
        """Return the axis with other values."""

    def range_of(self, parameter: str) -> tuple[float | None, float | None]:
        """Return the bounds of a parameter."""

    def decimals(self, parameter: str) -> int | None:
        """Return the decimals that the control keeps of a parameter."""


@dataclass(frozen=True)
class Gain:
    """One gain that is sought."""

    name: str
    """Its figure in `AxisLaw.sources`."""
    parameter: str
    present: float
    low: float
    """The smallest value above 0 that is tried."""
    high: float
    whole: bool
    sign: float
    decimals: int | None
    may_be_none: bool
    """Whether 0 is a value of it: an integral gain."""

    def nearest(self, value: float) -> float:
        """Return the value that the control can have, without its sign."""
        if value <= 0.0:
            return 0.0
        near = float(round(value)) if self.whole else rounded(value, DIGITS)
        near = near if self.decimals is None else round(near, self.decimals)
        return min(max(near, self.low), self.high)


GainPoint = tuple[float, ...]
"""Values of the gains, without their signs."""


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
        full = FULL_PERCENT if self.axis.output_unit == "%" else machine.output_limit
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

    def keeps(self, tried: Candidate, reserve: float = RESERVE) -> bool:
        """Return whether a candidate keeps it."""
        # The cheapest question first: loops on the machines that it may be cost most.
        if tried.axis.position_rate > self.slowest * (1.0 + 1e-9) or tried.jolt > self.jolt:
            return False
        if not tried.loops.sound(_tighter(self.need, reserve)):
            return False
        spread = self.spread
        return spread is None or all(each.sound(_tighter(spread, reserve)) for each in tried.others)


def _tighter(need: LoopDemand, reserve: float) -> LoopDemand:
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


@dataclass(frozen=True)
class Solved:
    """What the solver found."""

    gains: Sequence[Gain]
    aim: Aim
    numbers: Mapping[str, float]
    """Parameter -> value; those of the file where no other is worth a change."""
    before: Candidate
    after: Candidate
    level: int
    """Index of what is kept in `levels_of`; as many as there are where even the last is not."""

    @property
    def to_change(self) -> Mapping[str, float]:
        """The numbers that are others than the present ones."""
        present = {gain.parameter: gain.present for gain in self.gains}
        return {name: number for name, number in self.numbers.items() if number != present[name]}

    @property
    def raised(self) -> list[Gain]:
        """The gains that become larger."""
        return [gain for gain in self.gains if abs(self.numbers[gain.parameter]) > abs(gain.present)]

    @property
    def sound(self) -> bool:
        """Whether a sound axis comes out."""
        return self.after.loops.sound()


def gains_of(trial: Tried) -> list[Gain]:
    """Return the gains of an axis, from the inner loop outwards, that have a value and move its loops."""
    found = []
    for name in trial.axis.gains:
        source = trial.axis.sources.get(name)
        value = trial.value(source.parameter) if source else None
        if source is None or value is None:
            continue
        present = float(value.value)
        low, high = trial.range_of(source.parameter)
        # The sign of a gain is the wiring of a feedback: a search over both signs would try a loop that runs
        # away, so only the size is sought, on the side of zero where it is.
        sign = -1.0 if present < 0.0 else 1.0
        most = min(LARGEST if high is None else high, source.largest) if sign > 0.0 else -(low or -LARGEST)
        least = max(low or 0.0, 0.0) if sign > 0.0 else 0.0
        whole = source.whole or isinstance(value.value, int)
        decimals = trial.decimals(source.parameter)
        smallest = 1.0 if whole else SMALLEST if decimals is None else 10.0**-decimals
        gain = Gain(
            name,
            source.parameter,
            present,
            max(least, smallest),
            most,
            whole,
            sign,
            decimals,
            "integral" in name and least == 0.0,
        )
        if _moves(trial, gain):
            found.append(gain)
    return found


def _moves(trial: Tried, gain: Gain) -> bool:
    """Return whether the gain has a part in the loops: an integral gain that waits at rest has none."""
    tried = [trial.bound({gain.parameter: gain.sign * gain.nearest(each)}) for each in (gain.low, gain.high)]
    laws = [None if axis is None else LawMatrices.of(axis) for axis in tried]
    if laws[0] is None or laws[1] is None:
        return False
    same = np.array_equal(laws[0].position, laws[1].position)
    if laws[0].velocity is None or laws[1].velocity is None:
        return not same
    return not (same and np.array_equal(laws[0].velocity, laws[1].velocity))


class Search:
    """The candidates of one axis, each computed once."""

    def __init__(
        self, trial: Tried, gains: Sequence[Gain], ceiling: Mapping[str, float] | None = None
    ) -> None:
        self._trial, self.gains = trial, gains
        self._known: dict[GainPoint, Candidate | None] = {}
        self._kept: dict[tuple[GainPoint, int], bool] = {}
        self._near: dict[int, float] = {}  # the last largest value of a gain: where the next one is sought
        self._most = [min(gain.high, (ceiling or {}).get(gain.parameter, math.inf)) for gain in gains]

    def candidate(self, point: GainPoint) -> Candidate | None:
        """Return the axis with these gains; None where the control cannot have them."""
        if point not in self._known:
            axis = self._trial.bound(self.numbers(point))
            self._known[point] = None if axis is None else Candidate(axis)
        return self._known[point]

    def numbers(self, point: GainPoint) -> dict[str, float]:
        """Return the values of the parameters."""
        return {
            gain.parameter: gain.sign * value if value else 0.0
            for gain, value in zip(self.gains, point, strict=True)
        }

    def keeps(self, point: GainPoint, levels: Sequence[Level], level: int) -> bool:
        """Return whether the gains keep a level."""
        key = point, level
        if key not in self._kept:
            tried = self.candidate(point)
            self._kept[key] = tried is not None and levels[level].keeps(tried)
        return self._kept[key]

    def yields(self, point: GainPoint) -> float:
        """Return how far a torque moves the load: its largest way and the mean one."""
        tried = self.candidate(point)
        return math.inf if tried is None else sum(tried.loops.yields)

    def best(self, levels: Sequence[Level], level: int) -> GainPoint | None:
        """Return the stiffest gains that keep a level; None where none do."""
        found: list[GainPoint] = []
        self._outwards((), levels, level, found)
        if not found:
            return None
        # The point itself breaks a tie, so that the same axis always gets the same gains.
        ranked = sorted(found, key=lambda point: (self.yields(point), point))
        # The way of steps ends at the nearest hill: several starts, one for each innermost gain, find
        # the highest.
        starts = {point[0]: point for point in reversed(ranked)}  # the best with each innermost gain
        moved = [
            self._moved(point, STEPS[0], levels, level)
            for point in sorted(starts.values(), key=ranked.index)[:STARTS]
        ]
        best = min(moved, key=lambda point: (self.yields(point), point))
        # Ever smaller steps from the best alone: from each start they would cost more and find the
        # same.
        for step in STEPS[1:]:
            best = self._moved(best, step, levels, level)
        return best

    def least_bad(self, levels: Sequence[Level]) -> GainPoint | None:
        """Return, of all that was tried, the stable gains that miss a sound axis by least."""
        stable = [(point, tried) for point, tried in self._known.items() if tried and tried.loops.stable]
        ranked = [(tried.loops.lacks(levels[-1].need), point) for point, tried in stable]
        usable = [each for each in ranked if math.isfinite(each[0])]
        return min(usable)[1] if usable else None

    def _outwards(
        self, inner: GainPoint, levels: Sequence[Level], level: int, found: list[GainPoint]
    ) -> None:
        """Collect points with these inner gains and the largest gains outside of them."""
        index = len(inner)
        gain = self.gains[index]
        largest = self._largest(inner, levels, level)
        if largest is None:
            values: tuple[float, ...] = ()
        elif index == len(self.gains) - 1:
            values = (largest,)
        else:
            values = tuple(gain.nearest(share * largest) for share in SHARES)
        if gain.may_be_none:
            values = (*values, 0.0)
        for value in dict.fromkeys(values):
            point = (*inner, value)
            if len(point) < len(self.gains):
                self._outwards(point, levels, level, found)
            elif self.keeps(point, levels, level):
                found.append(point)

    def _largest(self, inner: GainPoint, levels: Sequence[Level], level: int) -> float | None:
        """Return the largest value of the next gain that keeps the level with the least
        of those outside of it.
        """
        index = len(inner)
        gain, rest = self.gains[index], self._outer(index)

        def good(value: float) -> bool:
            return self.keeps((*inner, gain.nearest(value), *rest), levels, level)

        # The largest value changes little from one inner gain to the next: it is sought where the last
        # one was.
        value, bad = min(self._most[index], self._near.get(index, math.inf)), None
        # Up to where it fails, down to where it is good again, then halving the ratio between the two.
        while value < self._most[index] and good(value):
            value = min(COARSE * value, self._most[index])
        while not good(value):
            bad, value = value, value / COARSE
            if bad <= gain.low:
                return None
            value = max(value, gain.low)
        while bad is not None and bad / value > CLOSE and gain.nearest(bad) != gain.nearest(value):
            middle = math.sqrt(bad * value)
            # The control cannot have anything in between.
            if gain.nearest(middle) in (gain.nearest(bad), gain.nearest(value)):
                break
            value, bad = (middle, bad) if good(middle) else (value, middle)
        self._near[index] = gain.nearest(value)
        return self._near[index]

    def _outer(self, index: int) -> GainPoint:
        """Return the least of the gains outside of one."""
        return tuple(0.0 if gain.may_be_none else gain.nearest(gain.low) for gain in self.gains[index + 1 :])

    def _moved(self, best: GainPoint, step: float, levels: Sequence[Level], level: int) -> GainPoint:
        """Return the best point that single gains and pairs of them lead to in steps of one factor."""
        while True:
            around = [point for point in self._around(best, step) if self.keeps(point, levels, level)]
            better = [(self.yields(point), point) for point in around]
            least = min(better, default=(math.inf, best))
            # A hundredth of a per cent is within the accuracy of the compliance: it would go round in
            # circles.
            if least[0] >= self.yields(best) * (1.0 - 1e-4):
                return best
            best = least[1]

    def _around(self, point: GainPoint, step: float) -> list[GainPoint]:
        """Return the neighbours: each gain and each pair of gains, up and down."""
        count, ways = len(point), (step, 1.0 / step)
        # Along the bound of a margin no single gain can rise: one has to fall for the other, so pairs
        # are tried too.
        moves = [{n: way} for n in range(count) for way in ways]
        moves += [
            {n: first, m: second} for n in range(count) for m in range(n) for first in ways for second in ways
        ]
        found = []
        for move in moves:
            there = tuple(
                min(gain.nearest(value * move.get(n, 1.0)), self._most[n])
                for n, (gain, value) in enumerate(zip(self.gains, point, strict=True))
            )
            if there != point:
                found.append(there)
        return list(dict.fromkeys(found))


def solve(trial: Tried, aim: Aim, *, raising: bool = True, slowest: float = math.inf) -> Solved:
    """Return the gains of an axis for an aim.

    Without ``raising`` no gain becomes larger than it is. ``slowest`` in 1/s is the greatest position gain of
    a contour. Where no gains keep the aim, the machine alone as it is taken to be counts, then what a sound
    axis keeps; where none do that either, the gains that miss it by least, if that is less than now.
    """
    gains = gains_of(trial)
    ceiling = None if raising else {gain.parameter: abs(gain.present) for gain in gains}
    search, levels = Search(trial, gains, ceiling), levels_of(aim, slowest)
    present = tuple(abs(gain.present) for gain in gains)
    before = search.candidate(present) or Candidate(trial.axis)
    # The present gains are judged without the reserve: what is proposed once must not be improved
    # again.
    now = next((n for n, level in enumerate(levels) if level.keeps(before, 1.0)), len(levels))
    best, level = None, len(levels)
    if gains:
        # Never a worse level than the one that the present gains keep.
        for level in range(min(now + 1, len(levels))):
            best = search.best(levels, level)
            if best is not None:
                break
        else:
            level = len(levels)
    # Nothing is sound, now or by other gains: then what misses it by least.
    if best is None and gains and now == len(levels):
        best = search.least_bad(levels)
    chosen = _worth(search, present, best, now, level, levels)
    after = search.candidate(chosen) or before
    numbers = (
        {gain.parameter: gain.present for gain in gains} if chosen == present else search.numbers(chosen)
    )
    return Solved(gains, aim, numbers, _exactly(before), _exactly(after), min(now, level))


def _worth(
    search: Search, present: GainPoint, best: GainPoint | None, now: int, level: int, levels: Sequence[Level]
) -> GainPoint:
    """Return the best gains where they are better than the present ones by more than is worth a change."""
    if best is None:
        return present
    if level == len(levels):
        lacks = [search.candidate(point) for point in (present, best)]
        need = levels[-1].need
        misses = [math.inf if each is None else each.loops.lacks(need) for each in lacks]
        return best if misses[1] < misses[0] / WORTH else present
    least = search.yields(best)
    # A change must be worth a person's time at the machine.
    if level == now and least * WORTH >= search.yields(present):
        return present
    for n, value in enumerate(present):  # what may stay as it is stays
        kept = (*best[:n], value, *best[n + 1 :])
        if search.keeps(kept, levels, level) and search.yields(kept) <= least * WORTH:
            best = kept
    return best


def _exactly(tried: Candidate) -> Candidate:
    return Candidate(tried.axis, exact=True)
