"""A path in stretches that are planned one at a time: those that a control shapes as it shapes them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt

from amp_studio.programs import ToolPath
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.path_rules import PathLimit, PathRules, ShapedPath

from .geometry import MAX_PIECES, geometry_of, pieces_of

STRETCH = 16_384
"""Rows that are in memory at once."""


@dataclass(frozen=True)
class Stretch:
    """Rows; from the second stretch on, the last one of the stretch before comes first."""

    path: ToolPath
    bounds: Sequence[npt.NDArray[Any]] = ()
    """Of a shaped path: speeds u/s and by what, accelerations u/s2 and by what, joints u/s and by what."""
    limits: Sequence[PathLimit] = ()
    """By what."""


def stretches_of(parts: Iterable[ToolPath], rules: PathRules) -> Iterator[Stretch]:
    """Yield the stretches of a path, at least one; raises SimulationError."""
    made = _shaped(parts, rules) if rules.shape else map(Stretch, parts)
    before: Stretch | None = None
    own: Stretch | None = None
    pieces = 0
    for each in made:
        count = pieces_of(each.path, rules.chord.value if rules.chord else None)
        pieces += int(count.sum())
        if pieces > MAX_PIECES:
            raise SimulationError("The arcs of the program become more straight pieces than can be planned")
        for first, last in _cuts(count):
            own = _rows(each, first, last)
            if not len(own.path):
                continue
            if before is None:
                yield own
            else:
                yield _joined(_rows(before, len(before.path) - 1, len(before.path)), own)
            before = own
    if before is None and own is not None:
        yield own


def _cuts(pieces: npt.NDArray[np.int64]) -> list[tuple[int, int]]:
    """Return (first, last) of rows that have together as many pieces as a stretch."""
    if pieces.sum() <= STRETCH:
        return [(0, len(pieces))]
    number = (np.cumsum(pieces) - pieces) // STRETCH
    return list(pairwise([0, *(np.flatnonzero(np.diff(number)) + 1).tolist(), len(pieces)]))


def _rows(each: Stretch, first: int, last: int) -> Stretch:
    return Stretch(each.path.rows(first, last), [column[first:last] for column in each.bounds], each.limits)


def _joined(one: Stretch, other: Stretch) -> Stretch:
    path = _joined_paths(one.path, other.path)
    bounds = [np.concatenate(pair) for pair in zip(one.bounds, other.bounds, strict=True)]
    return Stretch(path, bounds, other.limits)


def _joined_paths(one: ToolPath, other: ToolPath) -> ToolPath:
    """Return the rows of two paths of which one goes on where the other ends."""
    *first, start = one.columns
    pairs = zip(first, other.columns[:-1], strict=True)
    return other.with_columns([*map(np.concatenate, pairs), start])


def _shaped(parts: Iterable[ToolPath], rules: PathRules) -> Iterator[Stretch]:
    """Yield what the control makes of a path, part by part.

    A move is known when the two after it are; the rows of the program from the move before the first one that
    is not known are taken again with the next part.
    """
    assert rules.shape is not None
    left: ToolPath | None = None
    is_first = True
    coming = iter(parts)
    part = next(coming, None)
    while part is not None:
        after = next(coming, None)
        path = part if left is None else _joined_paths(left, part)
        shaped = rules.shape(path, geometry_of(path, None), after is None)
        first = 0 if is_first else int(np.searchsorted(shaped.move, 1))
        if after is None:
            yield _of_shaped(shaped, first, len(shaped.path))
            return
        # The last move that begins with a row of the program and has two behind it.
        begins = np.flatnonzero(shaped.begins[: max(len(shaped.begins) - 2, 0)] >= 0)
        again = int(begins[-1]) if len(begins) else 0
        left = path
        if again > 0:
            last = int(np.searchsorted(shaped.move, again + 1))
            left = path.rows(int(shaped.begins[again]), len(path))
            yield _of_shaped(shaped, first, last)
            is_first = False
        part = after


def _of_shaped(shaped: ShapedPath, first: int, last: int) -> Stretch:
    every = (shaped.speed, shaped.acceleration, shaped.joint)
    columns = [column[first:last] for each in every for column in (each.value, each.by)]
    return Stretch(shaped.path.rows(first, last), columns, shaped.limits)
