"""A curve of any number of points as the line that is drawn of it, in a width of so many points."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from .frame import Placement
from .scene import Curve, HeatMap

if TYPE_CHECKING:
    from .scene import Series

_UNSEEN = 0.25
"""Height in points that cannot be seen: it looks like a straight line."""


def strokes_of(frame: Placement, curve: Curve) -> tuple[Series, Series | None]:
    """Return the line (n, 2) of a curve in points of the sheet, and the outline (m, 2)
    of the band that it fills, if so.

    What lies beyond the edges of the frame is there too where a line leads to it:
    the drawing is to be clipped.
    """
    x, y, band = drawn_values(frame, curve)
    if band is None:
        return _placed(frame, x, y), None
    least, most = band
    outline = np.concatenate([x, x[::-1]]), np.concatenate([most, least[::-1]])
    return _placed(frame, x, y), _placed(frame, *outline)


def drawn_values(frame: Placement, curve: Curve) -> tuple[Series, Series, tuple[Series, Series] | None]:
    """Return the values (n,) that are drawn of a curve, and the least and the greatest ones (n,) of its band,
    if it fills one.
    """
    x, y = _inside(frame, curve)
    columns = max(int(frame.width), 2)
    if curve.is_stepped:
        x, y = without_stairs(x, y)
    # More than two samples in a column of the screen: as a line they would be a solid block.
    if (curve.is_stepped or curve.dense) and len(x) > 2 * columns:
        x, y, least, most = banded(x, y, columns)
        return x, y, (least, most)
    unseen = _UNSEEN * (frame.scene.y.high - frame.scene.y.low) / frame.height
    return (x, y, None) if curve.dots else (*thinned(x, y, columns, unseen), None)


def cell_boxes(frame: Placement, cells: HeatMap) -> Iterator[tuple[float, float, float, float, float, bool]]:
    """Yield left, top, width and height of each cell in points, its share of the scale of colours,
    and whether it is safe.
    """
    least, most = cells.ends
    xs = [frame.at((float(x), 0.0))[0] for x in cells.x]
    ys = [frame.at((0.0, float(y)))[1] for y in cells.y]
    shares = np.clip((cells.values - least) / (most - least), 0.0, 1.0)
    for n, k in zip(*np.nonzero(np.isfinite(cells.values)), strict=True):
        # A bit more than the cell, or the background shows between two of them.
        wide, high = xs[k + 1] - xs[k] + 0.3, ys[n] - ys[n + 1] + 0.3
        yield xs[k], ys[n + 1], wide, high, float(shares[n, k]), bool(cells.safe[n, k])


def _inside(frame: Placement, curve: Curve) -> tuple[Series, Series]:
    """Return the part of a curve that its scale shows, with one point more on both sides."""
    x, scale = curve.x, frame.scene.x
    # A ring or a path does not rise along x: it cannot be cut between two indices.
    if not len(x) or (scale.low <= x[0] and x[-1] <= scale.high) or np.any(np.diff(x) < 0.0):
        return x, curve.y
    # One point more, or the line would end short of the edge of the frame.
    first = max(int(np.searchsorted(x, scale.low)) - 1, 0)
    last = int(np.searchsorted(x, scale.high, side="right")) + 1
    return x[first:last], curve.y[first:last]


def _placed(frame: Placement, x: Series, y: Series) -> Series:
    """Return values as points of the drawing, a row for each."""
    scale, height = frame.scene.x, frame.scene.y
    across = (
        # The spectrum begins at 0 Hz, which has no logarithm.
        np.log(np.maximum(x, 1e-300) / scale.low) / np.log(scale.high / scale.low)
        if scale.log
        else (x - scale.low) / (scale.high - scale.low)
    )
    up = (y - height.low) / (height.high - height.low)
    return np.column_stack([frame.left + frame.width * across, frame.top + frame.height * (1.0 - up)])


def thinned(x: Series, y: Series, columns: int, unseen: float = 0.0) -> tuple[Series, Series]:
    """Return first, least, greatest and last point of each of ``columns`` stretches: the line as it is drawn.

    No peak is lost and no edge moves (U. Jugel et al., M4, Proceedings of the VLDB Endowment 7, 2014). A
    stretch that rises or falls by less than ``unseen`` is its first point alone:
    three of four points of a smooth curve.
    """
    # Four points of a column are kept: fewer points than that lose nothing by being drawn.
    if len(x) <= 4 * columns:
        return x, y
    count = len(x) // columns
    even = y[: count * columns].reshape(columns, count)
    starts = count * np.arange(columns)
    uneven = starts[even.max(axis=1) - even.min(axis=1) > unseen]
    own = y[uneven[:, None] + np.arange(count)]
    # What is left over is shorter than a stretch for each column, and is drawn as it is.
    index = np.unique(
        np.concatenate(
            [
                starts,
                uneven + own.argmin(axis=1),
                uneven + own.argmax(axis=1),
                uneven + count - 1,
                np.arange(count * columns, len(x)),
            ]
        )
    )
    return x[index], y[index]


def without_stairs(x: Series, y: Series) -> tuple[Series, Series]:
    """Return a value that is constant between samples as the line through its samples, without the stairs.

    A sample that stays much longer than the others keeps its end, so that a pause stays level.
    """
    changes = np.flatnonzero(np.diff(y)) + 1
    # Without two changes there is no period to compare a pause with.
    if len(changes) < 2:
        return x, y
    # Median: pauses, which are long, must not count as the period of the samples.
    period = float(np.median(np.diff(changes)))
    gaps = np.diff(np.concatenate([[0], changes]))
    ends = changes[gaps > 1.5 * period] - 1
    index = np.unique(np.concatenate([[0], ends, changes, [len(x) - 1]]))
    return x[index], y[index]


def banded(x: Series, y: Series, columns: int) -> tuple[Series, Series, Series, Series]:
    """Return (x, mean, least, greatest) of each of ``columns`` stretches,
    for a value that jumps at every sample.
    """
    # No more columns than samples: of an empty one ``reduceat`` would return the sample after it.
    edges = np.linspace(0, len(x), min(columns, len(x)) + 1).astype(np.int64)
    starts = edges[:-1]
    counts = np.diff(edges)
    middle = x[starts + counts // 2]
    mean = np.add.reduceat(y, starts) / counts
    return middle, mean, np.minimum.reduceat(y, starts), np.maximum.reduceat(y, starts)
