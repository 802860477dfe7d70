"""Travel and zones of two axes, with home, switch and marker."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import product, starmap
from typing import Literal

from amp_studio.drawing import Drag, FilledArea, Handle, Point, Polyline, Scale, Scene, ShapeSort, Text
from amp_studio.files import ParameterFile
from amp_studio.schema import SpanRole, TravelRoles, ZoneRole

from .figures import DrawnValue, ValueReader
from .homing import MARGIN, Home, draw_home, draw_rail, letters, read_home
from .parts import part_name
from .shapes import SceneShapes

_TALL = 1.5
"""How many times as long as the travel along x that along y is at most."""
_FORBIDDEN_SIDE = {
    "inside": "entry not allowed",
    "either": "no entry from outside, no exit from inside",
    "outside": "exit not allowed",
}
_SORTS: dict[str, ShapeSort] = {"inside": "forbidden", "either": "either", "outside": "outside"}


@dataclass
class _Ends:
    """Two ends on one axis; a figure for each end that a parameter sets."""

    low: float
    high: float
    figures: tuple[DrawnValue | None, DrawnValue | None] = (None, None)
    turned: float = 0.0
    """For a length from the switch: the direction of the switch, 0 for ends that are coordinates."""

    @property
    def wrong(self) -> bool:
        return any(each is not None and each.wrong for each in self.figures)

    @property
    def is_finite(self) -> bool:
        return math.isfinite(self.low) and math.isfinite(self.high)


def draw_travel(
    file: ParameterFile, roles: TravelRoles, axes: tuple[str, ...], like: Scene | None = None
) -> Scene:
    """Return the picture of a pair of axes (or of one);
    ``like`` gives the view that stays while a handle is dragged.

    A travel that is much longer than the other one lies along x.
    """
    back = axes[::-1]
    if like is not None:
        # While it is dragged the picture keeps the way it lies, even where the travel becomes the shorter
        # one.
        is_turned = len(axes) == 2 and like.x.label == ValueReader(file).axis(back[0])
        return replace(_drawn(file, roles, back if is_turned else axes, like), part="+".join(axes))
    scene = _drawn(file, roles, axes, None)
    # Only with one scale for both axes does a long y make a narrow picture.
    if not scene.equal or scene.y.high - scene.y.low < _TALL * (scene.x.high - scene.x.low):
        return scene
    return replace(_drawn(file, roles, back, None), part="+".join(axes))


def _drawn(file: ParameterFile, roles: TravelRoles, axes: tuple[str, ...], like: Scene | None) -> Scene:
    """Return the picture of axes in this order; ``like`` gives the scales that stay."""
    figures = ValueReader(file)
    drawing = SceneShapes(figures)
    named = _travels(figures, roles, axes, file)
    travel = [_inner([row[n] for _, row in named]) for n in range(len(axes))]
    zones = [(zone, box) for zone in roles.zones for box in _boxes(figures, zone, axes, travel)]
    homes = [read_home(figures, roles, axis, file) for axis in axes]
    units = [_unit(figures, roles, axis) for axis in axes]
    if like is not None:
        scales = [like.x, like.y]
    else:
        scales = _scales(figures, axes, units, [row for _, row in (*named, *zones)], homes)
    views = [(scale.low, scale.high) for scale in scales]
    for zone, box in zones:
        _draw_zone(figures, drawing, zone, box, views, len(axes))
    for name, row in named:
        _draw_box(figures, drawing, row, views, "travel")
        _name_travel(figures, drawing, name, row, axes, views)
    _draw_homes(figures, drawing, travel, homes, views)
    subtitle = f"{part_name(figures, axes)}, drawn from {len(figures.read)} parameters"
    x, y = scales
    equal = len(axes) == 2 and len(set(units)) == 1 and _are_alike(scales)
    return drawing.scene("travel", "+".join(axes), "Travel and zones", subtitle, x, y, equal=equal)


def ends_of_travel(
    file: ParameterFile, roles: TravelRoles, axes: tuple[str, ...]
) -> list[tuple[float, float]]:
    """Return what the travels of a family leave each axis."""
    rows = _travels(ValueReader(file), roles, axes, file)
    return [_inner([row[n] for _, row in rows]) for n in range(len(axes))]


def _scales(
    figures: ValueReader, axes: tuple[str, ...], units: list[str], rows: list[list[_Ends]], homes: list[Home]
) -> list[Scale]:
    scales = [_scale(figures, axis, units[n], rows, homes[n], n) for n, axis in enumerate(axes)]
    return scales + [Scale("", "", -1.0, 1.0, rows=((0.0, "", ""),))] * (2 - len(axes))


def _draw_homes(
    figures: ValueReader,
    drawing: SceneShapes,
    travel: list[tuple[float, float]],
    homes: list[Home],
    views: list[tuple[float, float]],
) -> None:
    """Draw the rail of each axis, and the home position of two axes."""
    for n, home in enumerate(homes):
        draw_rail(drawing, n, travel[n], home, views)
    if len(homes) == 2:
        draw_home(figures, drawing, homes, views)


def _travels(
    figures: ValueReader, roles: TravelRoles, axes: tuple[str, ...], file: ParameterFile
) -> list[tuple[str, list[_Ends]]]:
    """Return name and ends on each axis of the travels that the family has."""
    found = [(span.name, [_span(figures, span, axis) for axis in axes]) for span in roles.spans]
    if roles.reach:
        found.append((roles.reach.name, [_reach(figures, roles, axis, file) for axis in axes]))
    return found


def _are_alike(scales: list[Scale]) -> bool:
    """Return whether both axes can have one scale without one of them becoming a line."""
    ranges = [scale.high - scale.low for scale in scales]
    return max(ranges) < 20.0 * min(ranges) and not any(scale.rows for scale in scales)


def _unit(figures: ValueReader, roles: TravelRoles, axis: str) -> str:
    parameter = roles.spans[0].low if roles.spans else roles.reach.length if roles.reach else ""
    address = figures.address(parameter, axis) if parameter else None
    return figures.unit(address) if address else ""


# -- what is read ----------------------------------------------------------------


def _span(figures: ValueReader, span: SpanRole, axis: str) -> _Ends:
    """Return the ends of a span; infinite where one cannot be drawn, or is the value for none."""
    found = [figures.figure(parameter, axis) for parameter in (span.low, span.high)]
    ends = []
    for n, figure in enumerate(found):
        none = (-math.inf, math.inf)[n]
        value = figures.file.get(figure.address) if figure else None
        # As entered: the control writes "no limit" as its greatest number, ±999999999 (Syntec 3.2).
        if figure is not None and value is not None and span.none is not None and value.value == span.none[n]:
            figures.add_note(f"{figure.label}: {figure.text} is no limit", figure.address, is_remark=True)
            found[n] = None
            ends.append(none)
        else:
            ends.append(none if figure is None or figure.number is None else figure.number)
    return _Ends(ends[0], ends[1], (found[0], found[1]))


def _reach(figures: ValueReader, roles: TravelRoles, axis: str, file: ParameterFile) -> _Ends:
    """Return the travel from the switch at 0 to the other end."""
    assert roles.reach is not None
    found = figures.figure(roles.reach.length, axis)
    sign = figures.direction(roles.home.towards if roles.home else None, axis, letters(file))
    if found is None or found.number is None or not sign:
        return _Ends(-math.inf, math.inf)
    # The switch is at 0, and the axis moves away from it against the direction of the search.
    far = -sign * found.number
    figures.add_note("Coordinates are counted from the home switch.", is_remark=True)
    return _Ends(far, 0.0, (found, None), sign) if far <= 0.0 else _Ends(0.0, far, (None, found), sign)


def _inner(ends: list[_Ends]) -> tuple[float, float]:
    """Return what all spans of an axis leave."""
    # Each span stops the axis, so the narrowest does.
    return max((e.low for e in ends), default=-math.inf), min((e.high for e in ends), default=math.inf)


def _boxes(
    figures: ValueReader, zone: ZoneRole, axes: tuple[str, ...], travel: list[tuple[float, float]]
) -> list[list[_Ends]]:
    """Return the bodies that a zone is: one for each group of axes,
    over the whole travel of an axis that is not in it.
    """
    groups = _groups(figures, zone, axes)
    if not groups:
        figures.add_note(f"{zone.name}: no axis of this picture belongs to a group")
    boxes = []
    for members in groups:
        if all(_is_not_set(figures, zone, axis) for axis in members):
            figures.add_note(f"{zone.name} is not set", figures.address(zone.low, members[0]))
            continue
        box = [
            _span(figures, zone, axis) if axis in members else _Ends(*travel[n])
            for n, axis in enumerate(axes)
        ]
        # With one end missing a zone has no body to draw.
        if all(ends.is_finite for ends, axis in zip(box, axes, strict=True) if axis in members):
            boxes.append(box)
    return boxes


def _groups(figures: ValueReader, zone: ZoneRole, axes: tuple[str, ...]) -> list[list[str]]:
    """Return the axes of each group that a zone is for; all axes where it knows no groups."""
    if zone.group is None:
        return [list(axes)]
    groups: dict[object, list[str]] = {}
    for axis in axes:
        address = figures.address(zone.group, axis)
        value = figures.file.get(address) if address else None
        if address:
            figures.read[address] = None
        if value is not None and value.value != zone.group_none:
            groups.setdefault(value.value, []).append(axis)
    return list(groups.values())


def _is_not_set(figures: ValueReader, zone: ZoneRole, axis: str) -> bool:
    found = [figures.figure(parameter, axis, quiet=True) for parameter in (zone.low, zone.high)]
    return all(each is None or each.problem == "not set" for each in found)


def _scale(figures: ValueReader, axis: str, unit: str, rows: list[list[_Ends]], home: Home, n: int) -> Scale:
    """Return the scale of an axis over all that is drawn on it."""
    numbers = [edge for row in rows for edge in (row[n].low, row[n].high) if math.isfinite(edge)]
    numbers += home.places
    if has_reach := any(row[n].turned for row in rows):
        numbers.append(0.0)
    # All limits 0, as in a new file: there is no length to draw.
    if not has_reach and not any(numbers):
        return Scale(figures.axis(axis), unit, -1.0, 1.0, rows=((0.0, figures.axis(axis), ""),))
    low, high = min(numbers), max(numbers)
    margin = MARGIN * (high - low) or abs(high) * MARGIN or 1.0
    # Below it is room for the rail with marker and switch.
    return Scale(figures.axis(axis), unit, low - 2.0 * margin, high + margin)


# -- what is drawn ---------------------------------------------------------------


def _shown_edges(ends: _Ends, view: tuple[float, float]) -> tuple[float, float]:
    return max(ends.low, view[0]), min(ends.high, view[1])


def _draw_box(
    figures: ValueReader,
    drawing: SceneShapes,
    row: list[_Ends],
    views: list[tuple[float, float]],
    sort: ShapeSort,
) -> None:
    """Draw the finite edges of a box, and the handles on them and at its corners."""
    full = [*row, *(_Ends(-math.inf, math.inf) for _ in range(2 - len(row)))]
    sides = [_shown_edges(ends, view) for ends, view in zip(full, views, strict=True)]
    paint = _paint(row, sort)
    handles: dict[tuple[int, int], Handle] = {}
    for n, ends in enumerate(row):
        low, high = sides[1 - n]
        for k, edge in enumerate((ends.low, ends.high)):
            if not math.isfinite(edge):
                continue
            start, middle, end = (_point(n, edge, across) for across in (low, 0.5 * (low + high), high))
            drawing.lines.append(Polyline((start, end), paint))
            if (figure := ends.figures[k]) is not None:
                drag = _edge_drag(figures, figure, ends, n, views[n])
                handles[n, k] = figures.handle(figure, middle, drag)
    drawing.handles += handles.values()
    along_x, along_y = ([handles[key] for key in handles if key[0] == n] for n in (0, 1))
    drawing.handles += starmap(_corner, product(along_x, along_y))


def _paint(row: list[_Ends], sort: ShapeSort) -> ShapeSort:
    if any(ends.wrong for ends in row):
        return "error"
    return "ink" if sort == "travel" else "second"


def _point(n: int, along: float, across: float) -> Point:
    """Return the point at a place of the ``n``-th axis."""
    return (along, across) if n == 0 else (across, along)


def _corner(along_x: Handle, along_y: Handle) -> Handle:
    """Return the handle that moves two edges at once."""
    pair = (along_x, along_y)
    at, drags = (along_x.at[0], along_y.at[1]), (*along_x.drags, *along_y.drags)
    label, text = ", ".join(each.label for each in pair), ", ".join(each.value for each in pair)
    return Handle(at, drags, label, text, second=True)


def _edge_drag(
    figures: ValueReader, figure: DrawnValue, ends: _Ends, n: int, view: tuple[float, float]
) -> Drag:
    """Return how an end follows the pointer; of a length from the switch, by its distance from 0."""
    along: Literal["x", "y"] = "x" if n == 0 else "y"
    if ends.turned:
        sign = -ends.turned
        return figures.drag(
            figure, along, view[1] - view[0], lambda at: max(sign * at, 0.0), rises=sign > 0.0
        )
    return figures.drag(figure, along, view[1] - view[0])


def _draw_zone(
    figures: ValueReader,
    drawing: SceneShapes,
    zone: ZoneRole,
    box: list[_Ends],
    views: list[tuple[float, float]],
    count: int,
) -> None:
    """Draw a body with what it forbids."""
    side = zone.forbidden or _side(figures, zone)
    (left, right), *more = [_shown_edges(ends, view) for ends, view in zip(box, views, strict=False)]
    bottom, top = more[0] if more else views[1]
    # Ends in the wrong order are a finding, and still a body to draw.
    left, right, bottom, top = min(left, right), max(left, right), min(bottom, top), max(bottom, top)
    sort: ShapeSort = "error" if any(ends.wrong for ends in box) else _SORTS.get(side, "dim")
    drawing.areas.append(FilledArea(left, bottom, right, top, sort, zone.name))
    drawing.texts.append(
        Text(
            (left, top),
            zone.name,
            _FORBIDDEN_SIDE.get(side, "which side is forbidden is not set"),
            "inside",
            box[0].figures[0].address if box[0].figures[0] else None,
        )
    )
    _draw_box(figures, drawing, box[:count], views, sort)


def _side(figures: ValueReader, zone: ZoneRole) -> str:
    """Return which side of a zone is forbidden, by what the file chooses; "" with a note where it is not
    set.
    """
    role = zone.forbidden_by
    address = figures.address(role.param, "", "global") if role else None
    if role is None or address is None:
        return ""
    figures.read[address] = None
    value = figures.file.get(address)
    if value is not None and value.value in role.inside:
        return "inside"
    if value is not None and value.value in role.outside:
        return "outside"
    figures.add_note(
        f"{figures.label(address)}: not set, so {zone.name} is drawn without what it forbids", address
    )
    return ""


def _end_texts(ends: _Ends) -> list[str]:
    """Return the values of both ends, of those that are set."""
    return [figure.text for figure in ends.figures if figure is not None and figure.number is not None]


def _name_travel(
    figures: ValueReader,
    drawing: SceneShapes,
    name: str,
    row: list[_Ends],
    axes: tuple[str, ...],
    views: list[tuple[float, float]],
) -> None:
    """Write the name of a travel with its ends at its upper left corner."""
    texts = {axis: _end_texts(ends) for ends, axis in zip(row, axes, strict=True)}
    parts = [f"{figures.axis(axis)} {' to '.join(of_axis)}" for axis, of_axis in texts.items() if of_axis]
    if not parts:
        return
    left = _shown_edges(row[0], views[0])[0]
    top = _shown_edges(row[1], views[1])[1] if len(row) > 1 else views[1][1]
    first = next((f for ends in row for f in ends.figures if f is not None), None)
    drawing.texts.append(Text((left, top), name, ", ".join(parts), "above", first.address if first else None))
