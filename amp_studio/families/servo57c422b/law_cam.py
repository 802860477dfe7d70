"""Cam profiles of the 57C422B: the commanded position of the axis (pages 4-49 to 4-56).

A time cam contains travel for one interval after another; a position cam contains positions over those of a
master. How the module spreads a travel over the scans of its interval is not printed;
taken is a constant speed.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import chain, cycle, islice

from amp_studio.sim import SimulationError

from .law_facts import ids


def time_cam_order(
    points: int, *, reverse: bool = False, mirror: bool = False, continuous: bool = False, loop_back: int = 0
) -> Iterator[int]:
    """Yield the numbers of the points in the order in which a time cam takes them (pages 4-54 to 4-56).

    Once, it goes through the table, with ``mirror`` also back to the first point. ``continuous`` goes on
    without end: after the last point from the loop back point again, mirrored between both.
    ``reverse`` begins at the last point.
    """
    if not 0 <= loop_back < points:
        raise SimulationError(
            f"The loop back point {loop_back} is not one of the {points} points of the cam, 0 to"
            f" {points - 1}",
            ids.loop_back,
        )
    forward = range(points)
    if not continuous:
        loop: chain[int] | range = chain(forward, reversed(forward)) if mirror else forward
        return iter(loop) if not reverse else (points - 1 - k for k in loop)
    again = range(loop_back, points)
    turn = (*reversed(again), *again) if mirror else tuple(again)
    order = chain(forward, cycle(turn))
    return order if not reverse else (points - 1 - k for k in order)


def time_cam(
    values: Sequence[int], scans: int, order: Iterator[int], intervals: int, *, negative: bool = False
) -> list[float]:
    """Return the commanded position in counts after each scan of ``intervals`` intervals
    of ``scans`` scans each.

    ``negative`` is the motion direction bit: against the sign of the points (page 4-55).
    """
    if scans < 1:
        raise SimulationError("The time between two points of a cam is at least 1 scan", ids.cam_time)
    sign, position, positions = -1.0 if negative else 1.0, 0.0, [0.0]
    for point in islice(order, intervals):
        start = position
        position += sign * values[point]
        # From the start of the interval, not scan by scan: so rounding does not add up over a long cam.
        positions += [start + (position - start) * (k + 1) / scans for k in range(scans)]
    return positions


def position_cam(table: Sequence[int], increment: int, travelled: float, base: float = 0.0) -> float:
    """Return the commanded position for a master that has ``travelled`` counts past its reference position.

    ``base`` is where the axis was when the master passed it (page 4-51). Straight lines between the points;
    behind the reference position the axis is where it was, past the end where the table ends.
    """
    if increment < 1 or len(table) < 2:
        raise SimulationError(
            "A position cam needs two points or more and a master increment of at least 1 count",
            ids.position_increment,
        )
    step = min(max(travelled / increment, 0.0), len(table) - 1.0)
    # At the last point the line before it is gone to its end.
    point = min(int(step), len(table) - 2)
    return base + table[point] + (table[point + 1] - table[point]) * (step - point)
