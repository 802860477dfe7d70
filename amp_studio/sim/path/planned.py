"""A whole program, planned: totals, and its rows a stretch at a time. Memory does not grow with a program:
the rows of a long one are in a temporary file, and what follows from them is worked out again where it is
asked for.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from functools import reduce

import numpy as np

from amp_studio.programs import ToolPath
from amp_studio.sim.command.changes import SYMMETRIC
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.path_rules import PathLimit, PathRows, PathRules

from .kept_columns import KeptColumns
from .passes import SpeedRises, bound_by_look_ahead, lowered_backward, lowered_forward
from .planner import (
    CauseTable,
    ProgramPlan,
    ShapedLimits,
    Speeds,
    StretchBounds,
    stretch_bounds,
    stretch_plan,
)
from .stretches import stretches_of
from .summing import LineTimes, PathSample, SpeedCurve, joined_rows

_ROUNDING = 1e-9
"""Share of the time of a program that is only the rounding of sums."""
StretchWatch = Callable[[ProgramPlan], None]


class PlannedProgram:
    """A program under the rules of one file."""

    def __init__(
        self,
        parts: Iterable[ToolPath],
        rules: PathRules,
        progress: Callable[[float], None] = lambda _share: None,
    ) -> None:
        """``progress`` gets the share that is done once the program is read, and may raise to cancel.
        Raises SimulationError.
        """
        # All below uses the mean of both ends as the mean speed of a ramp, which an exponential one has not.
        for ramp in (rules.feed_ramp, rules.rapid_ramp):
            if ramp.kind not in SYMMETRIC:
                raise SimulationError(f"A path with {ramp.kind} ramps is not simulated")
        self._rules, self._progress = rules, progress
        self._table = CauseTable()
        self._rows, self._speeds = KeptColumns(), KeptColumns()
        self._begun: list[float] = []
        """When each stretch begins, s."""
        self._planned: tuple[int, ProgramPlan] | None = None
        self._count = self.moves = 0
        """Of the path that the control makes of the program, with its dwells."""
        self.time, self.wait = 0.0, 0.0
        self._sums = np.zeros(0)
        self.sample, self.speed, self.listed = PathSample(), SpeedCurve(), LineTimes()
        self.path: ToolPath
        """Its last part: what is true of all parts, and how the program ended."""
        for stretch in stretches_of(self._parts_of(parts), rules):
            self._rows.add([*stretch.path.columns, *stretch.bounds])
            self._limits = stretch.limits
            self.moves += len(stretch.path) - (len(self._rows) > 1)
        self._lower()

    def _parts_of(self, parts: Iterable[ToolPath]) -> Iterator[ToolPath]:
        for part in parts:
            self.path = part
            yield part

    def __len__(self) -> int:
        """Return how many stretches it has."""
        return len(self._rows)

    def _lower(self) -> None:
        """Bound the speeds at which rows begin by those of the rows after and before them."""
        found = KeptColumns()
        after, known = 0.0, np.zeros(0)
        for n in reversed(range(len(self))):
            bounds = self._bounds(n)
            known = bound_by_look_ahead(bounds, self._rules, self._table, known)
            entry = lowered_backward(bounds, self._rules, after)
            after = float(entry[0]) if len(entry) else after
            # What the way forward needs too: working out its rows, above all arcs in pieces, takes longer.
            found.add([entry, bounds.entry_by, bounds.geometry.length, bounds.acceleration, bounds.is_rapid])
            self._progress(0.4 * (len(self) - n) / len(self))
        reach = 0.0
        for n in range(len(self)):
            entry, by, length, acceleration, is_rapid = found[len(self) - 1 - n]
            rises = SpeedRises(entry, length, acceleration, is_rapid)
            entry, reach = lowered_forward(rises, self._rules, reach)
            self._speeds.add([entry, by])
            self._count += len(entry)
            self._begun.append(0.0)
            self._progress(0.4 + 0.3 * (n + 1) / len(self))
        firsts = [self._speeds[n] for n in range(len(self))]
        self._firsts = [(float(entry[0]), int(by[0])) if len(entry) else (0.0, -1) for entry, by in firsts]

    def _bounds(self, n: int) -> StretchBounds:
        """Return what bounds the rows of a stretch, with the speeds that an earlier pass has shaped."""
        width = len(self.path.columns)
        columns = self._rows[n]
        path = self.path.with_columns(columns[:width])
        shaped = None
        if columns[width:]:
            numbers = np.array([self._table.number(limit) for limit in self._limits], np.int16)
            speed, by_speed, ramp, by_ramp, joint, by_joint = columns[width:]
            path = replace(path, roundings=path.roundings[:1])

            def shaped(limits: ShapedLimits) -> None:
                limits.lower((speed, numbers[by_speed]), (ramp, numbers[by_ramp]), (joint, numbers[by_joint]))

        return stretch_bounds(path, self._rules, self._table, shaped, continues=n > 0)

    def stretch(self, n: int) -> ProgramPlan:
        """Return the rows of one stretch."""
        if self._planned is None or self._planned[0] != n:
            entry, by = self._speeds[n]
            after = self._firsts[n + 1] if n + 1 < len(self) else (0.0, -1)
            speeds = Speeds(entry, by, *after)
            plan = stretch_plan(self._bounds(n), self._rules, self._table, speeds, self.wait, self._begun[n])
            self._planned = n, plan
        return self._planned[1]

    def __iter__(self) -> Iterator[ProgramPlan]:
        return map(self.stretch, range(len(self)))

    @property
    def rows(self) -> int:
        """How many rows are planned: an arc may have become many."""
        return self._count

    @property
    def whole(self) -> ProgramPlan:
        """All rows at once, for a program that is short."""
        return reduce(joined_rows, self)

    def stretch_at(self, time: float) -> ProgramPlan:
        """Return the rows of the stretch that is run after so many seconds."""
        return self.stretch(max(int(np.searchsorted(self._begun, time, side="right")) - 1, 0))

    def add_up(self, wait: float, watches: Iterable[StretchWatch] = ()) -> None:
        """Work out all times, with the time in s that the axes need to be in position after each exact stop.
        ``watches`` look at each stretch.
        """
        self.wait, self._planned, begun = wait, None, 0.0
        every = (self.sample.look, self.speed.look, self.listed.look, *watches)
        for n in range(len(self)):
            self._begun[n] = begun
            plan = self.stretch(n)
            begun = plan.time if len(plan.start) else begun
            sums = plan.time_by_cause
            sums[: len(self._sums)] += self._sums
            self._sums = sums
            for watch in every:
                watch(plan)
            self._progress(0.7 + 0.3 * (n + 1) / len(self))
        self.time = begun

    @property
    def causes(self) -> tuple[PathLimit, ...]:
        """What limits, as numbered in the rows."""
        return tuple(self._table.limits)

    @property
    def time_by_cause(self) -> PathRows:
        """The time in s of each limit, (causes,); 0 for one whose time is the rounding of a sum."""
        return np.where(self._sums > _ROUNDING * self._sums.sum(), self._sums, 0.0)

    def forget_rows(self) -> None:
        """Keep the totals alone."""
        self._rows = self._speeds = KeptColumns()
        self._planned, self.listed = None, LineTimes()
