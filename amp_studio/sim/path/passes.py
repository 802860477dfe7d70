"""The speeds at which rows begin, a stretch of the path at a time.

Backward, every row gets the highest speed from which the rows after it can be kept to; forward, the highest
that the rows before it let it reach (J. Huang, L.-M. Zhu, Feed scheduling of a path in two passes, as every
planner of short blocks does it). What a row leaves over is run at its own limit. What goes from a stretch to
the next one is a speed, so that the passes are exact however a path is parted.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from amp_studio.sim.command.changes import reached
from amp_studio.sim.path_rules import PathRows, PathRules

from .planner import CauseTable, StretchBounds, lowered

_MAX_SPEED_SQUARED = 1e300
"""u²/s² that no speed has; of an infinite one the root would be no number."""


def bound_by_look_ahead(
    bounds: StretchBounds, rules: PathRules, table: CauseTable, after: PathRows
) -> PathRows:
    """Lower the speeds at which rows begin to those from which the rows that are known are enough to stop.
    ``after`` is by how much v² falls in each row after the stretch, as far as they are known; that from the
    stretch on is returned.
    """
    # Braking ways add up as v² = 2 a s with straight ramps only.
    if rules.look_ahead is None or not _is_straight(rules):
        return after
    # That bound is all a shorter look-ahead changes, as every bound of a row farther ahead is higher than it.
    known, count = max(1, int(rules.look_ahead.value)), len(bounds.entry)
    # Finite, as the difference of two infinite sums is no number.
    braking = np.where(np.isfinite(bounds.deceleration), bounds.deceleration, 1e12)
    falls = np.concatenate([2.0 * braking * bounds.geometry.length, after])
    gain = np.concatenate([[0.0], np.cumsum(falls)])
    room = gain[np.minimum(np.arange(count) + known, len(falls))] - gain[:count]
    lowered(bounds.entry, bounds.entry_by, np.sqrt(room), table.number(rules.look_ahead))
    return falls[:known]


def _is_straight(rules: PathRules) -> bool:
    return all(ramp.kind in ("none", "linear") for ramp in (rules.feed_ramp, rules.rapid_ramp))


def lowered_backward(bounds: StretchBounds, rules: PathRules, after: float) -> PathRows:
    """Return the speeds at which rows begin so that each can brake to the next one; ``after`` is the speed at
    which the stretch is left.
    """
    most, length = bounds.entry, bounds.geometry.length
    if not len(most):
        return most
    if _is_straight(rules):
        bound = most * most
        falls = _gains(bounds.deceleration, length, bound)
        square = lowest_sums(np.append(after * after, bound[::-1]), falls[::-1])[:0:-1]
        return np.where(square < bound, np.sqrt(square), most)
    speeds, ways, slower = most.tolist(), length.tolist(), bounds.deceleration.tolist()
    for n in range(len(most) - 1, -1, -1):
        ramp = rules.rapid_ramp if bounds.is_rapid[n] else rules.feed_ramp
        can = reached(ramp, after, ways[n], slower[n]) if ways[n] else after
        after = speeds[n] = min(speeds[n], can)
    return np.array(speeds)


@dataclass(frozen=True)
class SpeedRises:
    """How fast each row of a stretch can become, (rows,)."""

    entry: PathRows
    """The highest speed u/s at which it may begin."""
    length: PathRows
    acceleration: PathRows
    is_rapid: npt.NDArray[np.bool_]


def lowered_forward(rises: SpeedRises, rules: PathRules, reach: float) -> tuple[PathRows, float]:
    """Return the speeds at which rows begin so that the one before can accelerate to each, and that which the
    last one can reach; ``reach`` is what the row before the stretch can. What is lowered here is never below
    the beginning of its row, so that no row has to brake for it.
    """
    entry, length = rises.entry, rises.length
    if not len(entry):
        return entry, reach
    if _is_straight(rules):
        bound = entry * entry
        gains = _gains(rises.acceleration, length, bound)
        square = lowest_sums(np.append(min(bound[0], reach * reach), bound[1:]), gains[:-1])
        speeds = np.where(square < bound, np.sqrt(square), entry)
        way, slope = float(length[-1]), float(rises.acceleration[-1])
        more = 2.0 * slope * way if way or math.isfinite(slope) else math.inf
        return speeds, math.sqrt(min(float(square[-1]) + more, _MAX_SPEED_SQUARED))
    found, ways, faster = entry.tolist(), length.tolist(), rises.acceleration.tolist()
    for n in range(len(found)):
        found[n] = min(found[n], reach)
        ramp = rules.rapid_ramp if rises.is_rapid[n] else rules.feed_ramp
        reach = reached(ramp, found[n], ways[n], faster[n]) if ways[n] else found[n]
    return np.array(found), reach


def _gains(slope: PathRows, length: PathRows, bound: PathRows) -> PathRows:
    """Return by how much v² can change in each row."""
    # More than the greatest square lowers nothing: so is a ramp without an end, whatever its way is.
    most = bound.max(initial=0.0)
    with np.errstate(invalid="ignore"):
        gains: PathRows = np.nan_to_num(np.minimum(2.0 * slope * length, most), nan=most)
    return gains


_CHUNK = 512
"""Rows whose sums are taken together: few enough to keep them exact, many enough to be fast."""


def lowest_sums(bound: PathRows, gain: PathRows) -> PathRows:
    """Return the highest values of which none is above its ``bound`` (n), nor above the one before it by more
    than ``gain`` (n - 1). A value at its bound is that bound, bit for bit.

    Each is the lowest of all bounds before it plus the gains from there on, so that no loop is needed.
    """
    count = len(bound)
    chunks = max(-(-count // _CHUNK), 1)
    most, step = np.full((2, chunks * _CHUNK), [[math.inf], [0.0]])
    most[:count], step[1:count] = bound, gain
    most, step = most.reshape(chunks, _CHUNK), step.reshape(chunks, _CHUNK)
    way = np.cumsum(step, axis=1)
    low = np.minimum.accumulate(most - way, axis=1)
    before, last = np.empty(chunks), math.inf
    for n, (own, whole) in enumerate(zip(low[:, -1].tolist(), way[:, -1].tolist(), strict=True)):
        before[n] = last
        last = min(own, last) + whole
    earlier = np.minimum(np.hstack([before[:, None], low[:, :-1]]), before[:, None])
    found: PathRows = np.minimum(most, earlier + way).ravel()[:count]
    return found
