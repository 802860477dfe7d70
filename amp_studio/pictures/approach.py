"""A simulated way against the limits of the travel and past the zones, in the plan of two axes."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from amp_studio.drawing import Dot, PictureNote, Point, Polyline, Scale, Scene, ShapeSort, Text
from amp_studio.sim import SimulationError, Trace, bind_axis, law_of, simulate, value_text

from .figures import ValueReader
from .file_pictures import FilePicture, travel_ends
from .homing import read_home

_ACROSS = 0.8
"""Where across its travel the first axis is: near one side, as zones are in the middle more often."""
SEEN = 1e-5
"""Share of the picture from which a way behind a limit has its length."""
_BEYOND = 0.12
"""How far behind the limit an axis is sent, in lengths of the travel."""


@dataclass(frozen=True)
class PlaneWay:
    """From where to where axes are sent, in the units of the picture; along x alone for one axis."""

    start: Point
    to: Point


def usual_way(picture: FilePicture, part: str) -> PlaneWay | None:
    """Return a way along the travel against the upper limit of the second axis, or of the only
    one; None where no limit is set.
    """
    scene = picture.scene(part)
    ends = travel_ends(picture.file, _axes(picture, scene, part))
    shares = (_ACROSS, 0.5) if len(ends) == 2 else (0.5,)
    # Without two ends there is no middle: from 0, which every axis has.
    start = [
        low + share * (high - low) if _is_finite(low, high) else 0.0
        for (low, high), share in zip(ends, shares, strict=True)
    ]
    to = list(start)
    # The first axis only where the second one has no limit.
    for n in reversed(range(len(ends))):
        low, high = ends[n]
        if math.isfinite(high):
            to[n] = high + _BEYOND * (high - low if _is_finite(low, high) else abs(high) or 1.0)
            return PlaneWay(_point(start), _point(to))
    return None


def _is_finite(low: float, high: float) -> bool:
    return math.isfinite(low) and math.isfinite(high)


def _point(places: list[float]) -> Point:
    return places[0], places[1] if len(places) > 1 else 0.0


def _axes(picture: FilePicture, scene: Scene, part: str) -> list[str]:
    """Return the axes along x and y of a picture, which may have turned them."""
    axes = picture.key(part).split("+")
    # A turned picture keeps its part: only its scales are in the other order.
    is_turned = len(axes) == 2 and scene.x.label == picture.axis(axes[1])
    return axes[::-1] if is_turned else axes


def run_way(picture: FilePicture, part: str, way: PlaneWay) -> Trace:
    """Simulate a way; raises SimulationError where the axes cannot go it."""
    scene = picture.scene(part)
    axes = _axes(picture, scene, part)
    way = _shifted(way, *_shift(picture, axes))
    if len(axes) == 1:
        direction = "plus" if way.to[0] >= way.start[0] else "minus"
        settings = {"move.start": _written(scene.x, way.start[0]), "move.direction": direction}
        return simulate(picture.file, "travel", axes[0], settings, advise=False)
    scales = (scene.x, scene.y)
    start, to = (
        ";".join(_written(scale, place) for scale, place in zip(scales, point, strict=True))
        for point in (way.start, way.to)
    )
    names = ",".join(axes)
    return simulate(picture.file, "travel", names, {"move.start": start, "move.to": to}, advise=False)


def _shift(picture: FilePicture, axes: list[str]) -> list[float]:
    """Return what is added to a place of the picture for that of the machine: where the picture counts from
    the home switch, both have the home position.
    """
    roles = picture.file.schema.pictures.travel
    found = [0.0, 0.0]
    if roles is None or roles.reach is None:
        return found
    law = law_of(picture.file.schema.family.family)
    figures = ValueReader(picture.file)
    for n, axis in enumerate(axes):
        place = read_home(figures, roles, axis, picture.file).place
        if place is not None and (homing := bind_axis(picture.file, law, axis).homing) is not None:
            found[n] = homing().coordinate - place
    return found


def _shifted(way: PlaneWay, x: float, y: float) -> PlaneWay:
    return PlaneWay(*((point[0] + x, point[1] + y) for point in (way.start, way.to)))


def _written(scale: Scale, place: float) -> str:
    # A setting without a unit is in that of the law, mm or degrees.
    return f"{place!r} in" if scale.unit == "in" else repr(place)


def draw_approach(
    picture: FilePicture,
    part: str,
    way: PlaneWay | None = None,
    trace: Trace | None = None,
    hard: float | None = None,
) -> Scene:
    """Return the plan of a part with a way and where the axes stop on it, run before as ``trace``.

    ``hard`` is how far behind the limits the hard stops are; None where it was not given.
    """
    base = picture.scene(part)
    axes = _axes(picture, base, part)
    # Switches and markers beside the travel are another question, and the scales have the figures.
    lines = [line for line in base.lines if line.sort != "rail"]
    dots = [dot for dot in base.dots if dot.kind == "home"]
    texts = [
        replace(text, value="") if text.anchor == "above" else text
        for text in base.texts
        if text.sort != "dim"
    ]
    notes = list(base.notes)
    if hard is not None:
        lines += _hard_stops(picture, axes, base, hard)
    if way is not None:
        x, y = _shift(picture, axes) if trace is not None else (0.0, 0.0)
        stop, past, text = _stopped(trace, axes, way, (x, y))
        lines.append(Polyline((way.start, way.to), "before", dashed=True))
        lines.append(Polyline((way.start, past or stop), "now"))
        dots.append(Dot(stop, "point", "now"))
        if past is not None:
            beyond, words = _past_limit(base, stop, past, hard)
            lines.append(beyond)
            texts.append(words)
        texts += _speed(trace, _between(way.start, stop))
        notes += [PictureNote(text, wrong=bool(trace and trace.alarms), is_remark=True)] if text else []
    return replace(
        base,
        x=_wider(base.x),
        y=base.y if base.y.rows else _wider(base.y),
        lines=tuple(lines),
        dots=tuple(dots),
        texts=tuple(texts),
        notes=tuple(notes),
        handles=(),
    )


def _speed(trace: Trace | None, at: Point) -> list[Text]:
    """Return the feedrate of a run as a text beside its way; none before it has run."""
    feed, unit = (None, "") if trace is None else trace.result.get("feedrate", (None, ""))
    return [] if feed is None else [Text(at, value_text(feed, unit), "", "right", None, "now")]


def _past_limit(base: Scene, stop: Point, past: Point, hard: float | None) -> tuple[Polyline, Text]:
    """Return the piece of a way behind the limit that it passed, and how long it is; as an error where it
    meets a hard stop.
    """
    gap = _gap(stop, past)
    is_hit = hard is not None and gap >= hard
    sort: ShapeSort = "error" if is_hit else "output"
    words = (
        f"{value_text(gap, base.x.unit, 3)} past"
        if gap > SEEN * (base.x.high - base.x.low)
        else "stops at the limit"
    )
    text = f"{words}, meets the hard stop" if is_hit else words
    return Polyline((past, stop), sort), Text(stop, text, "", "left", None, sort)


def _wider(scale: Scale) -> Scale:
    room = _BEYOND * (scale.high - scale.low)
    return replace(scale, low=scale.low - room, high=scale.high + room)


def _gap(one: Point, other: Point) -> float:
    return math.hypot(one[0] - other[0], one[1] - other[1])


def _between(one: Point, other: Point) -> Point:
    return 0.5 * (one[0] + other[0]), 0.5 * (one[1] + other[1])


def _hard_stops(picture: FilePicture, axes: list[str], base: Scene, hard: float) -> list[Polyline]:
    """Return the edges behind the finite limits, dashed."""
    views = ((base.x.low, base.x.high), (base.y.low, base.y.high))
    ends = [(low - hard, high + hard) for low, high in travel_ends(picture.file, axes)]
    # A picture of one axis has no travel across: from edge to edge.
    ends += [views[1]] * (2 - len(ends))
    (left, right), (low, high) = [
        (max(end[0], view[0] - hard), min(end[1], view[1] + hard))
        for end, view in zip(ends, views, strict=True)
    ]
    corners = ((left, low), (right, low), (right, high), (left, high), (left, low))
    return [Polyline(corners, "limit", dashed=True)]


def _stopped(
    trace: Trace | None, axes: list[str], way: PlaneWay, shift: Point
) -> tuple[Point, Point | None, str]:
    """Return where the axes stop, where they pass what stops them, and why, in a sentence; the machine has
    ``shift`` more than the picture.
    """
    if trace is None:
        return way.start, None, ""
    figure = {name: value for name, (value, _) in trace.result.items()}
    text = trace.alarms[-1].message if trace.alarms else ""
    if len(axes) == 1:
        stop, limit = figure.get("stop_position"), figure.get("limit")
        if stop is None or limit is None:
            return way.start, None, text
        return (stop - shift[0], 0.0), (limit - shift[0], 0.0), text
    names = [name for name in trace.columns if name.startswith("position_")]
    x, y = (float(trace.columns[name][-1]) - by for name, by in zip(names, shift, strict=False))
    overrun, limit, distance = (figure.get(name) for name in ("overrun", "limit", "distance"))
    if overrun is None or limit is None or not distance:
        return (x, y), None, text
    # The axes move together on a straight line, so that one share of it is that of both.
    share = limit / distance
    past = (
        way.start[0] + share * (way.to[0] - way.start[0]),
        way.start[1] + share * (way.to[1] - way.start[1]),
    )
    return (x, y), past, text


def draw_usual_approach(picture: FilePicture, part: str) -> Scene:
    """Return the plan of a part with its usual way, or with the reason why the axes cannot go it."""
    way = usual_way(picture, part)
    if way is None:
        return draw_approach(picture, part)
    try:
        return draw_approach(picture, part, way, run_way(picture, part, way))
    except SimulationError as error:
        # Without a way the limits are still drawn, and the sentence names what is missing.
        plan = draw_approach(picture, part)
        return replace(plan, notes=(*plan.notes, PictureNote(error.what, is_remark=True)))
