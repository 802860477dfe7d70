"""Which variations the file does not allow, and why: all of them, before anything is computed, or some."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

import numpy as np

from amp_studio.schema import limits
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.rounding import value_text
from amp_studio.sim.tuning.sampled import Matrix

from .job import Axes, SweepJob, axes_of
from .plan import Varied, typed

FIGURE = re.compile(r"[-+]?[0-9]+(?:[.,][0-9]+)?")
_STRETCHES = 6
"""Stretches of values that are named at most."""
_TRIED = 64
"""Points spread over all of them that are tried before a sweep is refused."""


def refuse_if_none(job: SweepJob, points: Matrix) -> None:
    """Raise SimulationError with the reason of the first point if it is the reason of all.

    It is where a varied parameter stays beyond its range, and where the corners and points between them all
    have the very same sentence, which then depends on none of the varied figures.
    """
    axes = axes_of(job)
    if not len(points):
        return
    first = axes.refusal(points[0].tolist())
    if first is None:
        return
    if any(_stays_beyond(axes, each, points[:, n]) for n, each in enumerate(job.varied)) or all(
        axes.refusal(point) == first for point in _spread(points)
    ):
        raise SimulationError(first)


def _spread(points: Matrix) -> Iterator[list[float]]:
    """Yield points of the corners of what is varied, as far as there are any, and others between them."""
    at_corner = np.all((points == points.min(axis=0)) | (points == points.max(axis=0)), axis=1)
    yield from points[at_corner][:_TRIED].tolist()
    # Not each n-th row of a grid, which may be one column of it.
    yield from np.random.default_rng(1).permutation(points)[:_TRIED].tolist()


def _stays_beyond(axes: Axes, varied: Varied, numbers: Matrix) -> bool:
    """Return whether all numbers of a parameter are beyond the same bound, one that is not varied itself."""
    if varied.address is None:
        return False
    ends = [typed(varied, axes.file, float(number)) for number in (numbers.min(), numbers.max())]
    allowed = limits(axes.file.evaluation, varied.address, ends[0].unit)
    own = {each.address for each in axes.job.varied}
    if allowed is None or own & {allowed.low_from, allowed.high_from} - {None}:
        return False
    low, high = (float(each.value) for each in ends)
    return (allowed.high is not None and low > allowed.high) or (
        allowed.low is not None and high < allowed.low
    )


def refused_in_words(job: SweepJob, points: Matrix, matrix: Matrix) -> Iterator[str]:
    """Yield how many variations are not possible, which, and why; nothing where all are.

    Raises SimulationError where none is.
    """
    refused = points[np.isnan(matrix).all(axis=1)]
    if not len(refused):
        return
    axes = axes_of(job)
    reasons = [axes.refusal(point) or "" for point in (refused[0].tolist(), refused[-1].tolist())]
    if len(refused) == len(points):
        raise SimulationError(reasons[0])
    which = ", ".join(_which(job.varied, points, refused))
    yield f"{len(refused)} of {len(points)} variations are not possible ({which}): {reasons[0]}"
    if FIGURE.sub("", reasons[1]) != FIGURE.sub("", reasons[0]):
        yield f"The last of the variations that are not possible: {reasons[1]}"


def _which(varied: Sequence[Varied], points: Matrix, refused: Matrix) -> Iterator[str]:
    """Yield with which values none is possible; if there is no such value, with which one is refused."""
    alone, bounds = [], []
    for n, each in enumerate(varied):
        there, counts = np.unique(points[:, n], return_counts=True)
        own, own_counts = np.unique(refused[:, n], return_counts=True)
        bounds.append(_stretch(each, own))
        none = np.isin(there, own[own_counts == counts[np.searchsorted(there, own)]])
        # Of samples hardly a value repeats, so that one with none is no limit.
        if none.any() and not none.all() and (len(there) < len(points) or len(varied) == 1):
            edges = np.flatnonzero(np.diff(none)) + 1
            parts = zip(np.split(there, edges), np.split(none, edges), strict=True)
            alone += [_stretch(each, part) for part, is_none in parts if is_none[0]]
    yield from alone[:_STRETCHES] or bounds


def _stretch(varied: Varied, numbers: Matrix) -> str:
    ends = dict.fromkeys(value_text(float(number)) for number in (numbers[0], numbers[-1]))
    return f"{varied.name} {' … '.join(ends)}"
