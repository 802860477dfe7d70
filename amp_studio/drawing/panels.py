"""Scenes of curves: panels over one horizontal axis, and the rings of a ball-bar plot."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from amp_studio.schema import unit_text

from .scene import Curve, Dot, HeatMap, NamedPlace, Point, Polyline, Ring, Scale, Scene, ShapeSort, Text
from .ticks import figure_text, multiple, round_step

if TYPE_CHECKING:
    from .scene import Series

DIVISIONS = 8
"""Of the vertical axis of a recorder."""
_MARGIN = 0.06
"""Share of a range that is free above and below the curves."""
_BASE, _DEVIATION = 2.0, 1.0
"""Radius of the programmed circle and the largest deviation beside it, as they are drawn."""
_TURN = np.linspace(0.0, 2.0 * math.pi, 361)
_DIAGONAL = 0.6
"""Angle in rad from the top at which the rings have their figures, between the axes and their names."""


def panel_of(
    title: str,
    curves: Sequence[Curve],
    x: tuple[str, str],
    unit: str = "",
    *,
    levels: Sequence[NamedPlace] = (),
    marks: Sequence[NamedPlace] = (),
    log: bool = False,
    step: tuple[float, float] = (0.0, 0.0),
    share: float = 1.0,
    without_zero: bool = False,
    subtitle: str = "",
) -> Scene:
    """Return curves over one vertical axis in ``unit``; ``x`` is what is along the other one and its unit.

    ``step`` is the distance of the figures along x and y where it is not a round decimal number.
    """
    first, last = _extent(curves)
    low, high = visible(curves, levels, None)
    if not without_zero:
        # With 0 in it an error is seen in proportion; a position far from 0 is better off without.
        low, high = min(0.0, low), max(0.0, high)
    room = _MARGIN * (high - low)
    return Scene(
        title,
        "",
        title,
        subtitle,
        Scale(*x, first, last, log, step[0]),
        Scale("", unit, low - room, high + room, step=step[1]),
        curves=tuple(curves),
        levels=tuple(levels),
        marks=tuple(marks),
        look="panel",
        share=share,
    )


def linked(panels: Sequence[Scene]) -> tuple[Scene, ...]:
    """Return panels over the whole of their common horizontal axis, whose figures are under the last one."""
    low, high = (
        min((each.x.low for each in panels), default=0.0),
        max((each.x.high for each in panels), default=0.0),
    )
    return tuple(
        replace(each, x=replace(each.x, low=low, high=high, is_written=each is panels[-1])) for each in panels
    )


def zoomed(panel: Scene, span: tuple[float, float]) -> Scene:
    """Return a panel over a part of its horizontal axis; the vertical one follows what is visible."""
    if panel.y.is_fixed:
        return replace(panel, x=replace(panel.x, low=span[0], high=span[1]))
    low, high = visible(panel.curves, panel.levels, span)
    room = _MARGIN * (high - low)
    return replace(
        panel,
        x=replace(panel.x, low=span[0], high=span[1]),
        y=replace(panel.y, low=low - room, high=high + room),
    )


def on_divisions(panel: Scene, per_division: float, middle: float) -> Scene:
    """Return a panel with the vertical scale of a recorder: so much for each of DIVISIONS, with ``middle``
    half way up; zooming keeps it.
    """
    half = 0.5 * DIVISIONS * abs(per_division)
    scale = replace(panel.y, low=middle - half, high=middle + half, step=abs(per_division), is_fixed=True)
    return replace(panel, y=scale)


def round_divisions(panel: Scene) -> Scene:
    """Return a panel with the least round scale on which all of it is seen."""
    # The middle is a multiple too, so it is up to half a division from that of the curves.
    per = round_step((panel.y.high - panel.y.low) / (DIVISIONS - 1))
    return on_divisions(panel, per, multiple(0.5 * (panel.y.low + panel.y.high), per))


def visible(
    curves: Sequence[Curve], levels: Sequence[NamedPlace], span: tuple[float, float] | None
) -> tuple[float, float]:
    """Return least and greatest value of curves between two places (None: everywhere),
    with the levels that are near.
    """
    low, high = math.inf, -math.inf
    for curve in curves:
        inside = curve.y if span is None else curve.y[(curve.x >= span[0]) & (curve.x <= span[1])]
        if len(inside):
            low, high = min(low, float(inside.min())), max(high, float(inside.max()))
    if low > high:
        low = high = 0.0
    # A limit farther away than the curves are high would press them into a flat line: it is not shown.
    room = 1.0 * (high - low)
    near = [level.at for level in levels if span is None or low - room <= level.at <= high + room]
    low, high = min([low, *near]), max([high, *near])
    # A constant curve is drawn half way up, in a range of any height.
    return (low, high) if high > low else (low - 1.0, high + 1.0)


def _extent(curves: Sequence[Curve]) -> tuple[float, float]:
    xs = [curve.x for curve in curves if len(curve.x)]
    return min((float(x.min()) for x in xs), default=0.0), max((float(x.max()) for x in xs), default=1.0)


def map_scene(
    title: str,
    unit: str,
    x: tuple[str, str, Series],
    y: tuple[str, str, Series],
    values: NDArray[np.float64],
    safe: NDArray[np.bool_],
    points: Sequence[tuple[str, Point, ShapeSort]],
) -> Scene:
    """Return a map of a figure over two values (name, unit, the values of the cells),
    with the edge of the safe region and points by name.
    """
    logs = [_is_geometric(side) for side in (x[2], y[2])]
    edges = [_edges(side, log) for side, log in zip((x[2], y[2]), logs, strict=True)]
    cells = HeatMap(unit, edges[0], edges[1], values, safe, _ends(values, safe))
    up = f"{y[0]} ({unit_text(y[1])})" if y[1] else y[0]
    return Scene(
        "map",
        "",
        title,
        f"upwards: {up}; pale cells are not safe",
        Scale(x[0], x[1], float(cells.x[0]), float(cells.x[-1]), logs[0]),
        Scale("", "", float(cells.y[0]), float(cells.y[-1]), logs[1]),
        cells=cells,
        lines=tuple(_safe_edge(cells)),
        look="panel",
        share=2.7,
        dots=tuple(Dot(at, "point", sort) for _, at, sort in points),
        texts=tuple(Text(at, name, anchor="left", sort=sort) for name, at, sort in points),
    )


def _is_geometric(values: Series) -> bool:
    """Return whether values are rather a constant ratio than a constant distance apart."""
    # Equal steps have a ratio of 1 here, and a geometric row of a useful span far more than 4.
    return bool(values[0] > 0.0 and 4.0 * (values[1] - values[0]) < values[-1] - values[-2])


def _edges(values: Series, log: bool) -> Series:
    """Return where cells around values end: half way to the next one, as it is drawn."""
    places = np.log(values) if log else values
    middle = 0.5 * (places[:-1] + places[1:])
    # The outer cells have no neighbour: they end as far outside as inside.
    edges = np.concatenate([[2.0 * places[0] - middle[0]], middle, [2.0 * places[-1] - middle[-1]]])
    return np.exp(edges) if log else edges


def _ends(values: NDArray[np.float64], safe: NDArray[np.bool_]) -> tuple[float, float]:
    """Return least and greatest value; of the safe cells where there are any, so that these differ."""
    known = np.isfinite(values)
    # A loop that is nearly unstable has figures so large that the safe cells would all have one colour.
    chosen = values[known & safe] if (known & safe).any() else values[known]
    if not chosen.size:
        return 0.0, 1.0
    low, high = float(chosen.min()), float(chosen.max())
    return (low, high) if high > low else (low, low + 1.0)


def _safe_edge(cells: HeatMap) -> Iterator[Polyline]:
    """Yield the line between the safe cells and the others, cell by cell."""
    for n, k in zip(*np.nonzero(cells.safe[:, 1:] != cells.safe[:, :-1]), strict=True):
        x = float(cells.x[k + 1])
        yield Polyline(((x, float(cells.y[n])), (x, float(cells.y[n + 1]))))
    for n, k in zip(*np.nonzero(cells.safe[1:] != cells.safe[:-1]), strict=True):
        y = float(cells.y[n + 1])
        yield Polyline(((float(cells.x[k]), y), (float(cells.x[k + 1]), y)))


def ring_scene(rings: Sequence[Ring], unit: str) -> Scene:
    """Return a ball-bar plot: rings of equal deviation, and the paths magnified between them."""
    levels, most = ring_levels(rings)
    scale = _DEVIATION / most
    outer = _BASE + _DEVIATION
    edge = 1.2 * outer
    around = np.column_stack([np.sin(_TURN), np.cos(_TURN)])
    lines = [
        Polyline(_points((_BASE + scale * level) * around), "overlap" if level else "dim") for level in levels
    ]
    lines += [
        Polyline(((-outer, 0.0), (outer, 0.0)), "overlap"),
        Polyline(((0.0, -outer), (0.0, outer)), "overlap"),
    ]
    far = 1.08 * outer
    angles = ((far, 0.0, "0"), (0.0, far, "90"), (-far, 0.0, "180"), (0.0, -far, "270°"))
    names = [Text((x, y), text, anchor="middle", sort="dim") for x, y, text in angles]
    for level in levels:
        at = _BASE + scale * level
        words = f"{figure_text(level)} {unit_text(unit)}".rstrip() if level else "programmed"
        names.append(
            Text((at * math.sin(_DIAGONAL), at * math.cos(_DIAGONAL)), words, anchor="left", sort="dim")
        )
    curves = []
    for ring in rings:
        # Only the deviation is magnified, as ball-bar software does it: a circle of 100 mm and an error of
        # 5 µm could not be drawn on one scale.
        radius = _BASE + scale * ring.deviation
        curves.append(Curve("", radius * np.cos(ring.angle), radius * np.sin(ring.angle), ring.sort))
    across = Scale("", "", -edge, edge, is_written=False)
    return Scene(
        "rings",
        "",
        "",
        "",
        across,
        across,
        equal=True,
        lines=tuple(lines),
        curves=tuple(curves),
        texts=tuple(names),
        look="rings",
        share=4.4,
    )


def _points(places: np.ndarray) -> tuple[Point, ...]:
    return tuple((float(x), float(y)) for x, y in places)


def ring_levels(rings: Sequence[Ring]) -> tuple[list[float], float]:
    """Return the deviations at which a ball-bar plot has rings, and the largest that it shows."""
    # A path without any deviation has rings too: the least is that of a nanometre.
    peak = max((float(np.max(np.abs(r.deviation), initial=0.0)) for r in rings), default=0.0) or 1e-6
    step = round_step(0.5 * peak)
    # Less a hair: a peak on a ring must not get another ring through rounding.
    count = math.ceil(peak / step - 1e-9)
    return [n * step for n in range(-count, count + 1)], count * step
