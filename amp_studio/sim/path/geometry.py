"""Lengths, directions and radii of the rows of a path."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from amp_studio.programs import ARC, PLANES, ToolPath
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.path_rules import Geometry, Indices, PathRows, row_sums

MAX_PIECES = 8_000_000
"""Rows of a program after its arcs have become straight pieces."""
_MAX_ARC_PIECES = 500_000
"""Of one arc: a circle of 100 km with the finest tolerance of a control has so many."""


def places_of(path: ToolPath, row: int) -> tuple[int, int]:
    """Return the columns of the two axes of a row's plane."""
    first, second, _ = PLANES[int(path.plane[row])]
    return path.axes.index("XYZ"[first]), path.axes.index("XYZ"[second])


def plane_columns(path: ToolPath) -> Indices:
    """Return the columns of the two axes of each plane, (planes, 2); 0 for an axis that the path has not."""
    columns = {letter: n for n, letter in enumerate(path.axes)}
    return np.array([[columns.get("XYZ"[n], 0) for n in axes[:2]] for axes in PLANES])


def geometry_of(path: ToolPath, chord: float | None) -> Geometry:
    """Return the geometry of a path, with its arcs as straight pieces that are at most ``chord`` off."""
    count = len(path)
    begins = _begins(path)
    arcs = np.flatnonzero(path.kind == ARC)
    if chord is not None and len(arcs):
        return _chorded(path, begins, arcs, chord)
    delta = path.ends - begins
    length = np.sqrt(row_sums(delta * delta))
    radius, is_arc = np.full(count, math.inf), path.kind == ARC
    first = _unit(delta, length)
    last, share = first.copy() if len(arcs) else first, np.abs(first)
    for plane in range(3):
        rows = arcs[path.plane[arcs] == plane]
        # A plane without arcs may have an axis that the path has not.
        if not len(rows):
            continue
        a, b = places_of(path, int(rows[0]))
        x, y = begins[rows, a] - path.center[rows, 0], begins[rows, b] - path.center[rows, 1]
        r, sweep = np.hypot(x, y), path.sweep[rows]
        # A helix: what is left beside the plane is its rise, the same all along.
        along = delta[rows].copy()
        along[:, a] = along[:, b] = 0.0
        whole = np.sqrt((r * sweep) ** 2 + row_sums(along * along))
        sign, begun = np.sign(sweep), np.arctan2(y, x)
        planar = r * np.abs(sweep) / whole
        # The tangent follows the sine of the angle in the first axis and the cosine in the second.
        for tangents, angle in ((first, begun), (last, begun + sweep)):
            tangents[rows] = along / whole[:, None]
            tangents[rows, a] = -sign * np.sin(angle) * planar
            tangents[rows, b] = sign * np.cos(angle) * planar
        # The greatest share that an axis has anywhere on the arc, so that one bound for the row is true on
        # all of it.
        share[rows] = np.abs(along) / whole[:, None]
        share[rows, a] = planar * _most_sine(begun, sweep)
        share[rows, b] = planar * _most_sine(begun + 0.5 * math.pi, sweep)
        length[rows], radius[rows] = whole, r
    return Geometry(np.arange(count), begins, path.ends, length, first, last, share, radius, is_arc)


def _most_sine(begun: PathRows, sweep: PathRows) -> PathRows:
    """Return the greatest |sin| over an arc of angles."""
    low, high = np.minimum(begun, begun + sweep), np.maximum(begun, begun + sweep)
    # |sin| is 1 at the odd multiples of 90°; ``top`` is the first of them that is not before the arc.
    top = np.ceil((low - 0.5 * math.pi) / math.pi) * math.pi + 0.5 * math.pi
    ends = np.maximum(np.abs(np.sin(low)), np.abs(np.sin(high)))
    most: PathRows = np.where(top <= high, 1.0, ends)
    return most


def _unit(delta: PathRows, length: PathRows) -> PathRows:
    # A row without a way has no direction: zeros, no division by 0.
    unit: PathRows = delta / np.where(length > 0.0, length, 1.0)[:, None]
    return unit


def _begins(path: ToolPath) -> PathRows:
    """Return where each row begins, (rows, axes)."""
    return np.vstack([path.start[None, :], path.ends[:-1]]) if len(path) else np.zeros((0, len(path.axes)))


def pieces_of(path: ToolPath, chord: float | None) -> Indices:
    """Return of how many straight pieces each row is made, as grblHAL's mc_arc makes them of arcs."""
    pieces = np.ones(len(path), np.int64)
    arcs = np.flatnonzero(path.kind == ARC)
    if chord is None or not len(arcs):
        return pieces
    columns = plane_columns(path)[path.plane[arcs]]
    begun = np.take_along_axis(_begins(path)[arcs], columns, axis=1) - path.center[arcs]
    radius = np.hypot(begun[:, 0], begun[:, 1])
    # mc_arc: floor(|sweep r / 2| / sqrt(tolerance (2 r - tolerance))); an arc smaller than the tolerance is
    # one piece.
    inside = np.maximum(chord * (2.0 * radius - chord), 0.0)
    wanted = np.abs(0.5 * path.sweep[arcs] * radius) / np.sqrt(np.where(inside > 0.0, inside, math.inf))
    if wanted.max() > _MAX_ARC_PIECES:
        line = int(path.line[arcs[np.argmax(wanted > _MAX_ARC_PIECES)]])
        raise SimulationError(
            f"Line {line}: an arc of more than {_MAX_ARC_PIECES} straight pieces is not planned"
        )
    pieces[arcs] = np.maximum(1, np.floor(wanted))
    return pieces


def _chorded(path: ToolPath, begins: PathRows, arcs: npt.NDArray[np.int64], chord: float) -> Geometry:
    """Return straight rows, arcs as pieces whose ends are on them: as many as grblHAL's mc_arc makes."""
    pieces = pieces_of(path, chord)
    row = np.repeat(np.arange(len(path)), pieces)
    last = np.cumsum(pieces) - 1
    share = (np.arange(len(row)) - np.repeat(last - pieces, pieces)) / np.repeat(pieces, pieces)
    # Repeated a column at a time: to pick from all columns by numbers takes twice as long.
    ends = np.repeat(begins, pieces, axis=0)
    ends += share[:, None] * np.repeat(path.ends - begins, pieces, axis=0)
    angle = share * np.repeat(path.sweep, pieces)
    cosine, sine = np.cos(angle), np.sin(angle)
    columns = plane_columns(path)
    for plane in np.unique(path.plane[arcs]):
        (first, second), here = columns[plane], (path.kind == ARC) & (path.plane == plane)
        x, y = (np.repeat(begins[:, n] - path.center[:, k], pieces) for k, n in enumerate(columns[plane]))
        inside = np.repeat(here, pieces)
        np.copyto(ends[:, first], np.repeat(path.center[:, 0], pieces) + x * cosine - y * sine, where=inside)
        np.copyto(ends[:, second], np.repeat(path.center[:, 1], pieces) + x * sine + y * cosine, where=inside)
    # The last piece keeps the programmed end, free of the rounding of sines.
    ends[last] = path.ends
    starts = np.vstack([path.start[None, :], ends[:-1]])
    delta = ends - starts
    length = np.sqrt(row_sums(delta * delta))
    unit = _unit(delta, length)
    none = np.zeros(len(row), bool)
    return Geometry(row, starts, ends, length, unit, unit, np.abs(unit), np.full(len(row), math.inf), none)
