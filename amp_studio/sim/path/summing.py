"""What is kept of a long program while it is planned, bounded: rows for its picture, its speed over time, and
the times of the lines that are listed.
"""

from __future__ import annotations

import math
from dataclasses import fields, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from amp_studio.sim.path_rules import Causes, Geometry, Indices, PathRows, row_sums

from .planner import ProgramPlan

SAMPLE = 10_000
"""Rows that are drawn of a program of several stretches, chosen by chance: each n-th one would miss what a
program repeats."""
PARTS = 512
"""Of a stretch, whose least and greatest speed are drawn where there are several."""
_LISTED = 200_000
"""Lines of a program whose time and limit are kept: 25 bytes for each."""


PART = 0.1
"""Of the time of a row, from which a limit belongs to it."""
LAST_BIT = 31
Masks = npt.NDArray[np.uint32]


class PathSample:
    """Rows in the place of all: those of the only stretch, or some that are chosen by chance."""

    def __init__(self) -> None:
        self._kept: ProgramPlan | None = None
        self._order = np.zeros(0)
        """By which the rows are chosen, the least first."""
        self._chance = np.random.default_rng(0)

    @property
    def plan(self) -> ProgramPlan:
        """The rows."""
        assert self._kept is not None
        return self._kept

    def look(self, plan: ProgramPlan) -> None:
        """Take rows of one more stretch."""
        if self._kept is None:
            self._kept = plan
            return
        if not len(self._order):
            first, self._kept = self._kept, None
            self._choose(first)
        self._choose(plan)

    def _choose(self, plan: ProgramPlan) -> None:
        moving = np.flatnonzero(plan.geometry.length > 0.0)
        order = np.concatenate([self._order, self._chance.random(len(moving))])
        if self._kept is None:
            order[:1] = -1.0  # where the path begins
        chosen = np.arange(len(order))
        if len(order) > SAMPLE:
            among = order <= np.partition(order, SAMPLE - 2)[SAMPLE - 2]
            among[-1] = True  # where it ends so far
            chosen = np.flatnonzero(among)
        before = chosen[chosen < len(self._order)]
        # Rows are taken once they are chosen: those of an arc in pieces are hundreds for each that is.
        own = rows_of(plan, moving[chosen[len(before) :] - len(self._order)])
        self._kept = own if self._kept is None else _joined(rows_of(self._kept, before), own)
        self._order = order[chosen]


def rows_of(plan: ProgramPlan, rows: Indices) -> ProgramPlan:
    """Return some rows of a plan, each with its own row of the path."""
    *columns, start = plan.path.columns
    path = plan.path.with_columns([*(each[plan.geometry.row[rows]] for each in columns), start])
    geometry = {each.name: getattr(plan.geometry, each.name)[rows] for each in fields(Geometry)}
    own: dict[str, Any] = {name: getattr(plan, name)[rows] for name in _OF_ROWS}
    numbered = Geometry(**{**geometry, "row": np.arange(len(rows))})
    return replace(plan, path=path, geometry=numbered, **own)


_OF_ROWS = (
    "entry",
    "peak",
    "leave",
    "acceleration",
    "deceleration",
    "times",
    "rest",
    "start",
    "faster_by",
    "even_by",
    "slower_by",
    "rest_by",
    "is_rapid",
    "programmed",
)


def joined_rows(one: ProgramPlan, other: ProgramPlan) -> ProgramPlan:
    """Return the rows of a plan and those after it as one, each row with its own of the path."""
    return _joined(*(rows_of(each, np.arange(len(each.start))) for each in (one, other)))


def _joined(one: ProgramPlan, other: ProgramPlan) -> ProgramPlan:
    """Return two stretches that follow each other as one."""
    *columns, start = one.path.columns
    pairs = zip(columns, other.path.columns[:-1], strict=True)
    path = other.path.with_columns([*map(np.concatenate, pairs), start])
    geometry = {
        each.name: np.concatenate([getattr(one.geometry, each.name), getattr(other.geometry, each.name)])
        for each in fields(Geometry)
    }
    numbered = Geometry(**{**geometry, "row": np.arange(len(geometry["row"]))})
    own: dict[str, Any] = {
        name: np.concatenate([getattr(one, name), getattr(other, name)]) for name in _OF_ROWS
    }
    return replace(other, path=path, geometry=numbered, **own)


class SpeedCurve:
    """The speed along the path over time: every row of the only stretch, or the least and the greatest of
    short parts.
    """

    def __init__(self) -> None:
        self._first: ProgramPlan | None = None
        self._time: list[PathRows] = []
        self._speed: list[PathRows] = []
        self._end = 0.0

    def look(self, plan: ProgramPlan) -> None:
        """Take one more stretch."""
        if not len(plan.start):
            return
        self._end = plan.time
        if self._first is None and not self._time:
            self._first = plan
            return
        for each in filter(None, (self._first, plan)):
            time, least, most = _least_and_most(each)
            self._time.append(time)
            self._speed.append(np.column_stack([least, most]).ravel())
        self._first = None

    @property
    def points(self) -> tuple[PathRows, PathRows]:
        """Moments in s and speeds u/s."""
        if self._first is None:
            return np.concatenate([*self._time, [self._end]]), np.concatenate([*self._speed, [0.0]])
        plan, start, times = self._first, self._first.start, self._first.times
        moments = np.column_stack([start, start + times[:, 0], start + times[:, 0] + times[:, 1]])
        speeds = np.column_stack([plan.entry, plan.peak, plan.peak])
        return np.append(moments.ravel(), plan.time), np.append(speeds.ravel(), 0.0)


def _least_and_most(plan: ProgramPlan) -> tuple[PathRows, PathRows, PathRows]:
    """Return two moments of each part of a stretch, flat, and its least and greatest speed."""
    begins = np.unique(np.linspace(0, len(plan.start), PARTS, endpoint=False).astype(np.int64))
    start = plan.start[begins]
    after = np.append(start[1:], plan.time)
    return (
        np.column_stack([start, 0.5 * (start + after)]).ravel(),
        np.minimum.reduceat(plan.entry, begins),
        np.maximum.reduceat(plan.peak, begins),
    )


class LineTimes:
    """Time of each of the first lines, when it first begins, and of its longest row what limits it."""

    def __init__(self) -> None:
        self._time, self._begin = np.zeros(1), np.full(1, math.inf)
        self._longest = np.full(1, -1.0, np.float32)
        self._cause, self._rapid = np.full(1, -1, np.int16), np.zeros(1, bool)
        self._causes = np.zeros(1, np.uint32)

    def _extend(self, last: int) -> None:
        """Make the lists of blocks long enough for a block."""
        # In leaps: a short program needs little, and a long one few copies.
        more = min(max(last + 1, 2 * len(self._time)), _LISTED + 1) - len(self._time)
        if last < len(self._time):
            return
        self._time = np.pad(self._time, (0, more))
        self._begin = np.pad(self._begin, (0, more), constant_values=math.inf)
        self._longest = np.pad(self._longest, (0, more), constant_values=-1.0)
        self._cause = np.pad(self._cause, (0, more), constant_values=-1)
        self._rapid = np.pad(self._rapid, (0, more))
        self._causes = np.pad(self._causes, (0, more))

    def look(self, plan: ProgramPlan) -> None:
        """Take one more stretch."""
        lines = plan.lines
        rows = np.flatnonzero(lines <= _LISTED)
        if not len(rows):
            return
        lines, times = lines[rows], row_sums(plan.times[rows]).astype(np.float32)
        self._extend(int(lines.max()))
        self._time += np.bincount(lines, plan.whole[rows], len(self._time))
        np.bitwise_or.at(self._causes, lines, causes_of(plan, rows))
        begun, first = np.unique(lines, return_index=True)
        self._begin[begun] = np.minimum(self._begin[begun], plan.start[rows[first]])
        order = np.lexsort((-times, lines))
        own, first = np.unique(lines[order], return_index=True)
        longest, time = rows[order[first]], times[order[first]]
        longer = time > self._longest[own]
        own, longest = own[longer], longest[longer]
        self._longest[own], self._rapid[own] = time[longer], plan.is_rapid[longest]
        self._cause[own] = main_cause(plan, longest)

    def begin(self, line: int) -> float | None:
        """Return when a line begins, in s from the start; None for one that moves nothing or is not kept."""
        found = float(self._begin[line]) if 0 <= line < len(self._begin) else math.inf
        return found if math.isfinite(found) else None

    def causes(self, most: int) -> Masks:
        """Return the causes of each line up to ``most`` as bits, as `causes_of`, by its number."""
        found = np.zeros(most + 1, np.uint32)
        own = self._causes[: most + 1]
        found[: len(own)] = own
        return found

    def columns(self, most: int) -> tuple[Indices, Causes, npt.NDArray[np.bool_], PathRows]:
        """Return lines up to ``most``, cause of most of the time of the longest row of each, whether that is
        rapid, and the time of the line in s.
        """
        lines = np.flatnonzero(self._longest[: most + 1] >= 0.0)
        return lines, self._cause[lines], self._rapid[lines], self._time[lines]


def causes_of(plan: ProgramPlan, rows: Indices) -> Masks:
    """Return for some rows the causes of at least `PART` of their time, as bits (rows,); those from the last
    bit on share it.
    """
    times = plan.times[rows]
    least = PART * row_sums(times)
    found = np.zeros(len(rows), np.uint32)
    for n, by in enumerate((plan.faster_by, plan.even_by, plan.slower_by)):
        bits = np.left_shift(np.uint32(1), np.clip(by[rows], 0, LAST_BIT).astype(np.uint32))
        found |= np.where((times[:, n] > 0.0) & (times[:, n] >= least), bits, np.uint32(0))
    return found


def main_cause(plan: ProgramPlan, rows: Indices) -> Indices:
    """Return for some rows the cause of most of their time, (rows,)."""
    causes = np.column_stack([plan.faster_by[rows], plan.even_by[rows], plan.slower_by[rows]]).astype(
        np.int64
    )
    times = plan.times[rows]
    # A ramp up and down by the same limit is one share of the row.
    same = causes[:, 0] == causes[:, 2]
    times[same, 0] += times[same, 2]
    chosen: Indices = causes[np.arange(len(causes)), np.argmax(times, axis=1)]
    return chosen
