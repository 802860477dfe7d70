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

from .aims import Aim
from .filters import Filters, FilterSetting
from .gains import Gain, GainPoint, gains_of
from .levels import Candidate, Level, levels_of
from .tried import Tried

_SHARES = (1.0, 0.87, 0.74, 0.6, 0.45, 0.3, 0.15)
"""Of the largest gain of a loop that are tried with every gain outside of it; 0 as well for an integral
one."""
_COARSE = 2.0
"""Factor between two gains on the way down to the first sound one."""
CLOSE = 1.06
"""Factor within which the largest sound gain is found; the steps that follow are finer than that."""
STEPS = (1.25, 1.1, 1.04, 1.015)
"""Factors by which the best gains are moved about."""
_STARTS = 3
"""Points, of different innermost gains, from which is moved about:
the best gains of one may be in another valley."""
_MIN_BENEFIT = 1.03
"""Less stiffness than this factor is not worth a change."""
_FILTER_BENEFIT = 1.1
"""Less stiffness than this factor is not worth another filter:
it may be set against what the model of the machine does not know."""
_FILTER_SHARES = (4.0, 2.5, 1.6, 1.25, 1.0, 0.8, 0.63)
"""Factors of all gains with which another filter is judged before the gains are sought with it."""
_TRIED_FIRST = 3
"""Of the filters with which there are sound gains at all, where the present ones leave none."""
_SEARCHED = 1
"""Other filters that look best by them, with which the gains are sought: each search takes seconds."""


@dataclass(frozen=True)
class Solved:
    """What the solver found."""

    gains: Sequence[Gain]
    filters: FilterSetting
    """The filters as they are."""
    aim: Aim
    numbers: Mapping[str, float]
    """Parameter -> value, of gains and of filters that are set;
    those of the file where no other is worth a change."""
    before: Candidate
    after: Candidate
    level: int
    """Index of what is kept in `levels_of`; as many as there are where even the last is not."""

    @property
    def to_change(self) -> Mapping[str, float]:
        """The numbers that are others than the present ones."""
        present = {**{gain.parameter: gain.present for gain in self.gains}, **dict(self.filters)}
        return {name: number for name, number in self.numbers.items() if number != present[name]}

    @property
    def sound(self) -> bool:
        """Whether a sound axis comes out."""
        return self.after.loops.sound()


class Search:
    """The candidates of one axis with one setting of its filters, each computed once."""

    def __init__(self, trial: Tried, gains: Sequence[Gain], filters: FilterSetting = ()) -> None:
        self._trial, self.gains, self.filters = trial, gains, filters
        self._known: dict[GainPoint, Candidate | None] = {}
        self._keeps_margins: dict[tuple[GainPoint, int], bool] = {}
        self._best: dict[int, GainPoint | None] = {}
        self._near: dict[int, float] = {}  # the last largest value of a gain: where the next one is sought

    def candidate(self, point: GainPoint) -> Candidate | None:
        """Return the axis with these gains; None where the control cannot have them."""
        if point not in self._known:
            axis = self._trial.bound(self.numbers(point))
            self._known[point] = None if axis is None else Candidate(axis)
        return self._known[point]

    def numbers(self, point: GainPoint) -> dict[str, float]:
        """Return the values of the parameters; a filter that is not set has none."""
        return {name: value for name, value in self.filters if value is not None} | {
            gain.parameter: gain.sign * value if value else 0.0
            for gain, value in zip(self.gains, point, strict=True)
        }

    def keeps(self, point: GainPoint, levels: Sequence[Level], level: int) -> bool:
        """Return whether the gains keep a level."""
        key = point, level
        if key not in self._keeps_margins:
            tried = self.candidate(point)
            self._keeps_margins[key] = tried is not None and levels[level].keeps(tried)
        return self._keeps_margins[key]

    def yields(self, point: GainPoint) -> float:
        """Return how far a torque moves the load: its largest way and the mean one."""
        tried = self.candidate(point)
        return math.inf if tried is None else sum(tried.loops.yields)

    def best(self, levels: Sequence[Level], level: int) -> GainPoint | None:
        """Return the stiffest gains that keep a level; None where none do."""
        key = level
        if key not in self._best:
            self._best[key] = self._sought(levels, level)
        return self._best[key]

    def _sought(self, levels: Sequence[Level], level: int) -> GainPoint | None:
        """Return the stiffest gains of those that keep a level; None where none do."""
        points: list[GainPoint] = []
        self._outwards((), levels, level, points)
        if not points:
            return None
        # The point itself breaks a tie, so that the same axis always gets the same gains.
        ranked = sorted(points, key=lambda point: (self.yields(point), point))
        # The way of steps ends at the nearest hill: several starts, one for each innermost gain, find
        # the highest.
        starts = {point[0]: point for point in reversed(ranked)}  # the best with each innermost gain
        moved = [
            self._moved(point, STEPS[0], levels, level)
            for point in sorted(starts.values(), key=ranked.index)[:_STARTS]
        ]
        best = min(moved, key=lambda point: (self.yields(point), point))
        # Ever smaller steps from the best alone: from each start they would cost more and find the
        # same.
        for step in STEPS[1:]:
            best = self._moved(best, step, levels, level)
        return best

    def scaled(self, point: GainPoint, levels: Sequence[Level], level: int) -> GainPoint | None:
        """Return the largest share of gains that keeps a level here; None where none does."""
        for share in _FILTER_SHARES:
            there = tuple(gain.nearest(share * value) for gain, value in zip(self.gains, point, strict=True))
            if self.keeps(there, levels, level):
                return there
        return None

    def any(self, levels: Sequence[Level], level: int) -> bool:
        """Return whether gains were found that keep a level: the largest inner one with the least outer
        ones.
        """
        return self._largest((), levels, level) is not None

    def least_bad(self, levels: Sequence[Level]) -> GainPoint | None:
        """Return, of all that was tried, the stable gains that miss a sound axis by least."""
        stable = [(point, tried) for point, tried in self._known.items() if tried and tried.loops.stable]
        ranked = [(tried.loops.lacks(levels[-1].need), point) for point, tried in stable]
        usable = [each for each in ranked if math.isfinite(each[0])]
        return min(usable)[1] if usable else None

    def _outwards(
        self, inner: GainPoint, levels: Sequence[Level], level: int, points: list[GainPoint]
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
            values = tuple(gain.nearest(share * largest) for share in _SHARES)
        if gain.may_be_none:
            values = (*values, 0.0)
        for value in dict.fromkeys(values):
            point = (*inner, value)
            if len(point) < len(self.gains):
                self._outwards(point, levels, level, points)
            elif self.keeps(point, levels, level):
                points.append(point)

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
        value, bad = min(gain.high, self._near.get(index, math.inf)), None
        # Up to where it fails, down to where it is good again, then halving the ratio between the two.
        while value < gain.high and good(value):
            value = min(_COARSE * value, gain.high)
        while not good(value):
            bad, value = value, value / _COARSE
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
                gain.nearest(value * move.get(n, 1.0))
                for n, (gain, value) in enumerate(zip(self.gains, point, strict=True))
            )
            if there != point:
                found.append(there)
        return list(dict.fromkeys(found))


def solve(trial: Tried, aim: Aim, *, slowest: float = math.inf) -> Solved:
    """Return the gains of an axis for an aim.

    ``slowest`` in 1/s is the greatest position gain of a contour. Where no gains keep the aim, the machine
    alone as it is taken to be counts, then what a sound axis keeps; where none do that either, the gains that
    miss it by least, if that is less than now.
    """
    gains = gains_of(trial)
    levels, filters = levels_of(aim, slowest), Filters(trial)
    settings = _FilterSearches(trial, gains, filters)
    present = filters.present, tuple(gain.present_size for gain in gains)
    before = settings.candidate(present) or Candidate(trial.axis)
    # The present gains are judged without the reserve: what is proposed once must not be improved
    # again.
    now = next((n for n, level in enumerate(levels) if level.keeps(before, 1.0)), len(levels))
    best, level = None, len(levels)
    if gains:
        # Never a worse level than the one that the present gains keep.
        for level in range(min(now + 1, len(levels))):
            best = settings.best(levels, level)
            if best is not None:
                break
        else:
            level = len(levels)
    # Nothing is sound, now or by other gains: then what misses it by least.
    if best is None and gains and now == len(levels):
        best = settings.least_bad(levels)
    chosen = _clearly_better(settings, present, best, now, level, levels)
    after = settings.candidate(chosen) or before
    numbers = settings.search(chosen[0]).numbers(chosen[1])
    # Not rounded to the steps of the search: the same gains must not look like a change.
    if chosen[1] == present[1]:
        numbers |= {gain.parameter: gain.present for gain in gains}
    return Solved(gains, filters.present, aim, numbers, _exactly(before), _exactly(after), min(now, level))


Chosen = tuple[FilterSetting, GainPoint]
"""Filters and gains."""


class _FilterSearches:
    """The searches of one axis, one for each setting of its filters that is tried."""

    def __init__(self, trial: Tried, gains: Sequence[Gain], filters: Filters) -> None:
        self._trial, self._gains, self._filters = trial, gains, filters
        self._searches: dict[FilterSetting, Search] = {}

    def search(self, setting: FilterSetting) -> Search:
        """Return the search with a setting."""
        if setting not in self._searches:
            self._searches[setting] = Search(self._trial, self._gains, setting)
        return self._searches[setting]

    def candidate(self, chosen: Chosen) -> Candidate | None:
        """Return the axis with filters and gains."""
        return self.search(chosen[0]).candidate(chosen[1])

    def best(self, levels: Sequence[Level], level: int) -> Chosen | None:
        """Return the stiffest loop that keeps a level, by other filters too, where these are worth it.

        It goes on from filters to better ones, so that from where it ends nothing is better: a second run
        begins there and ends there.
        """
        setting = self._filters.present
        point = self.search(setting).best(levels, level)
        # Filters are someone's remedy for what the model may not know: with sound gains they stay, unless
        # the resonance of the machine is known.
        while point is None or self._filters.is_resonance_known:
            better = self._better(setting, point, levels, level)
            if better is None:
                break
            setting, point = better
        return None if point is None else (setting, point)

    def _better(
        self, setting: FilterSetting, point: GainPoint | None, levels: Sequence[Level], level: int
    ) -> Chosen | None:
        """Return filters with which a level is kept by a loop that is stiffer by what a filter is worth."""
        most = math.inf if point is None else self.search(setting).yields(point) / _FILTER_BENEFIT
        found = []
        for other in self._promising(setting, point, levels, level):
            there = self.search(other).best(levels, level)
            if there is not None and self.search(other).yields(there) < most:
                found.append((self.search(other).yields(there), other, there))
        return min(found, key=lambda each: each[0])[1:] if found else None

    def _promising(
        self, setting: FilterSetting, point: GainPoint | None, levels: Sequence[Level], level: int
    ) -> list[FilterSetting]:
        """Return the filters that look best: a search with each of them would take seconds."""
        others = self._filters.others(setting)
        if point is None:
            # No gains keep the level with the present filters: those that have any at all.
            return [other for other in others if self.search(other).any(levels, level)][:_TRIED_FIRST]
        most, found = self.search(setting).yields(point), []
        for other in others:
            search = self.search(other)
            scaled = search.scaled(point, levels, level)
            if scaled is not None and search.yields(scaled) < most:
                found.append((search.yields(scaled), other))
        return [other for _, other in sorted(found, key=lambda each: each[0])[:_SEARCHED]]

    def least_bad(self, levels: Sequence[Level]) -> Chosen | None:
        """Return, of all that was tried, the stable loop that misses a sound axis by least."""
        found = []
        for setting, search in self._searches.items():
            point = search.least_bad(levels)
            tried = None if point is None else search.candidate(point)
            if point is not None and tried is not None:
                found.append((tried.loops.lacks(levels[-1].need), setting, point))
        return min(found, key=lambda each: each[0])[1:] if found else None


def _clearly_better(
    settings: _FilterSearches,
    present: Chosen,
    best: Chosen | None,
    now: int,
    level: int,
    levels: Sequence[Level],
) -> Chosen:
    """Return the best loop where it is better than the present one by more than is worth a change."""
    if best is None:
        return present
    if level == len(levels):
        lacks = [settings.candidate(each) for each in (present, best)]
        need = levels[-1].need
        misses = [math.inf if each is None else each.loops.lacks(need) for each in lacks]
        return best if misses[1] < misses[0] / _MIN_BENEFIT else present
    search, point = settings.search(best[0]), best[1]
    least = search.yields(point)
    # A change must be worth a person's time at the machine.
    if level == now and least * _MIN_BENEFIT >= settings.search(present[0]).yields(present[1]):
        return present
    for n, value in enumerate(present[1]):  # what may stay as it is stays
        kept = (*point[:n], value, *point[n + 1 :])
        if search.keeps(kept, levels, level) and search.yields(kept) <= least * _MIN_BENEFIT:
            point = kept
    return best[0], point


def _exactly(tried: Candidate) -> Candidate:
    return Candidate(tried.axis, exact=True)
