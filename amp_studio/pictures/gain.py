"""Gain of the position loop over the following error, with its break and the limits of the error."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

from amp_studio.drawing import Polyline, Scale, Scene, ShapeSort, Text
from amp_studio.files import ParameterFile
from amp_studio.schema import ErrorRoles

from .figures import DrawnValue, ValueReader, number_of
from .shapes import SceneShapes


def draw_gain(file: ParameterFile, roles: ErrorRoles, axis: str, like: Scene | None = None) -> Scene:
    """Return the gain of an axis over its following error; beyond the break it is the gain times the
    ratio.
    """
    figures = ValueReader(file)
    gain, ratio = figures.figure(roles.gain, axis), figures.figure(roles.ratio, axis)
    found, at = figures.figures(roles.limits, axis), figures.figure(roles.break_at, axis)
    drawn = [*filter(figures.is_on_decades, (at, *found))]
    x, y = (like.x, like.y) if like else _scales(gain, drawn, found)
    shapes = SceneShapes(figures)
    if gain is not None and gain.number is not None:
        _draw_gain(shapes, gain, at if at in drawn else None, ratio, (x, y))
        sort: ShapeSort = "error" if gain.wrong else "now"
        shapes.texts.append(Text((x.low, gain.number), gain.label, gain.text, "left", gain.address, sort))
    for n, each in enumerate(drawn):
        _draw_limit(shapes, each, n, (x, y))
    if at is not None and at in drawn:
        _note_order(figures, at, drawn)
    subtitle = f"{figures.axis(axis)}, gain over following error"
    return shapes.scene("error", axis, "Error limits", subtitle, x, y)


def _scales(
    gain: DrawnValue | None, drawn: Sequence[DrawnValue], found: Sequence[DrawnValue]
) -> tuple[Scale, Scale]:
    """Return the scales of error and gain, with room around what is drawn."""
    # Three times beyond the outermost on either side: half a decade of a logarithmic scale.
    places = [each.number or 1.0 for each in drawn]
    unit = next((each.unit for each in (*drawn, *found)), "")
    low, high = min(places, default=1.0) / 3.0, max(places, default=3.0) * 3.0
    x = Scale("following error", unit, low, high, log=True)
    return x, Scale("gain", gain.unit if gain else "", 0.0, 1.3 * (number_of(gain) or 1.0))


def _draw_limit(shapes: SceneShapes, each: DrawnValue, n: int, scales: tuple[Scale, Scale]) -> None:
    """Draw the ``n``-th limit of the error across the picture, its name at a height beside the others."""
    x, y = scales
    place, level = each.number or 1.0, y.high * (0.24 + 0.12 * (n % 4))
    shapes.limit(((place, y.low), (place, y.high)), each)
    # The geometric mean is the middle of a logarithmic scale.
    side: Literal["left", "right"] = "right" if place * place > x.low * x.high else "left"
    shapes.texts.append(Text((place, level), each.label, each.text, side, each.address, "dim"))
    # Two handles of one value would lie on each other.
    if all(handle.drags[0].address != each.address for handle in shapes.handles):  # the break has one already
        drag = shapes.figures.drag(each, "x", 2.0 * place)
        shapes.handles.append(shapes.figures.handle(each, (place, 0.92 * y.high), drag, second=True))


def _draw_gain(
    shapes: SceneShapes,
    gain: DrawnValue,
    at: DrawnValue | None,
    ratio: DrawnValue | None,
    scales: tuple[Scale, Scale],
) -> None:
    """Draw the gain up to the break, and the reduced gain beyond it."""
    x, y = scales
    figures = shapes.figures
    level, place, share = gain.number or 0.0, number_of(at), number_of(ratio)
    sort: ShapeSort = "error" if any(each is not None and each.wrong for each in (gain, at, ratio)) else "now"
    if at is None or place is None or share is None:
        shapes.lines.append(Polyline(((x.low, level), (x.high, level)), sort))
        middle = (x.low * x.high) ** 0.5
        shapes.handles.append(figures.handle(gain, (middle, level), figures.drag(gain, "y", y.high)))
        return
    reduced = level * share
    points = ((x.low, level), (place, level), (place, reduced), (x.high, reduced))
    shapes.lines.append(Polyline(points, sort))
    drag = figures.drag(gain, "y", y.high)
    shapes.handles.append(figures.handle(gain, ((x.low * place) ** 0.5, level), drag))
    drag = figures.drag(at, "x", 2.0 * place)
    shapes.handles.append(figures.handle(at, (place, 0.5 * (level + reduced)), drag))
    if ratio is not None and level:
        # Dragged is the reduced gain; the value is its share of the gain, which stays.
        drag = figures.drag(ratio, "y", 1.0, lambda y_at: y_at / level)
        shapes.handles.append(figures.handle(ratio, ((place * x.high) ** 0.5, reduced), drag))


def _note_order(figures: ValueReader, at: DrawnValue, drawn: list[DrawnValue]) -> None:
    """Note a break that lies above the last limit of the error."""
    number = at.number or 0.0
    last = drawn[-1]
    if last is not at and (last.number or 0.0) < number:
        figures.add_note(
            f"{at.label}: {at.text} is above {last.label}, {last.text}: the break is never reached",
            at.address,
            wrong=True,
        )
