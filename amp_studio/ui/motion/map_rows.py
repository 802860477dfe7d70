"""The rows of a sweep of two gains as points of its map."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from amp_studio.sim import Trace


def nearest_row(trace: Trace, place: Sequence[float]) -> int:
    """Return the row of a sweep that is nearest to values of what it varies, as its map is drawn."""
    away = np.zeros(trace.rows)
    for name, at in zip(trace.over, place, strict=True):
        side = trace.columns[name]
        drawn = np.log if side.min() > 0.0 < at else np.asarray
        away += ((drawn(side) - drawn(at)) / (np.ptp(drawn(side)) or 1.0)) ** 2
    return int(np.argmin(away))


def row_beside(trace: Trace, row: int | None, steps: Sequence[int]) -> int:
    """Return the row that many steps to the right and upwards of one; None is where the present gains are."""
    if row is None:
        row = nearest_row(trace, [trace.limits[name][0] or 0.0 for name in trace.over])
    place = []
    for name, step in zip(trace.over, steps, strict=True):
        side = np.unique(trace.columns[name])
        at = int(np.searchsorted(side, trace.columns[name][row])) + step
        place.append(float(side[min(max(at, 0), len(side) - 1)]))
    return nearest_row(trace, place)
