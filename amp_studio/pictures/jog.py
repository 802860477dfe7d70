"""Jog speeds and increments of the axes as a ladder, a row for each axis."""

from __future__ import annotations

import math
import operator
from collections.abc import Iterable
from itertools import chain
from typing import Literal

from amp_studio.drawing import Dot, Point, Polyline, Scale, Scene, ShapeSort, Text
from amp_studio.files import ParameterFile
from amp_studio.schema import JogRoles, unit_text

from .figures import DrawnValue, ValueReader
from .parts import axes_with
from .shapes import SceneShapes

TITLES = {"jog": "Jog speeds", "increments": "Jog increments"}


def draw_jog(
    file: ParameterFile, roles: JogRoles, name: Literal["jog", "increments"], like: Scene | None = None
) -> Scene:
    """Return the ladder of the speeds, or of the increments, of all axes, over a scale of powers of ten."""
    figures = ValueReader(file)
    own, bounds = (roles.speeds, roles.limits) if name == "jog" else (roles.increments, ())
    axes = axes_with(file, (*own, *bounds))
    rows = [figures.figures(own, axis) for axis in axes]
    limits = [figures.figures(bounds, axis) for axis in axes]
    every = [*map(operator.add, rows, limits)]
    x = like.x if like else _decades(chain.from_iterable(every))
    heads = tuple(
        (-float(n), figures.axis(axis), unit_text((bound or row)[0].unit) if bound or row else "")
        for n, (axis, row, bound) in enumerate(zip(axes, rows, limits, strict=True))
    )
    shapes = SceneShapes(figures)
    for n, (row, bound) in enumerate(zip(rows, limits, strict=True)):
        _draw_row(shapes, row, bound, -float(n))
    texts = dict[tuple[Point, str], Text]()
    for text in shapes.texts:  # a step at the limit has its figure once
        texts.setdefault((text.at, text.text), text)
    shapes.texts[:] = texts.values()
    subtitle = f"bars: {file.schema.parameters[bounds[0]].name}" if any(limits) else ""
    y = Scale("", "", -len(axes) + 0.4, 0.6, rows=heads)
    return shapes.scene(name, "", TITLES[name], subtitle, x, y)


def _draw_row(shapes: SceneShapes, row: list[DrawnValue], bounds: list[DrawnValue], level: float) -> None:
    """Draw the speeds of one axis as steps on a rail that reaches to its limits."""
    found = [*filter(shapes.figures.is_on_decades, row)]
    ends = [each.number or 0.0 for each in (*found, *filter(shapes.figures.is_on_decades, bounds))]
    if ends:
        shapes.lines.append(Polyline(((min(ends), level), (max(ends), level)), "rail"))
    for each in found:
        _draw_speed(shapes, each, level, bounds)
    for each in bounds:
        if each.number is not None and each.number > 0.0:
            shapes.dots.append(Dot((each.number, level), "end"))
            shapes.texts.append(Text((each.number, level), _plain(each), "", "below", each.address, "dim"))


def _draw_speed(shapes: SceneShapes, each: DrawnValue, level: float, bounds: list[DrawnValue]) -> None:
    """Draw one step; above the greatest of the bounds it is an error."""
    figures, number = shapes.figures, each.number or 0.0
    beyond = number > max((b.number for b in bounds if b.number), default=math.inf)
    if beyond:
        text = f"{each.label}: {each.text} is above {bounds[0].label}, {bounds[0].text}"
        figures.add_note(text, each.address, wrong=True)
    sort: ShapeSort = "error" if each.wrong or beyond else "dim"
    shapes.texts.append(Text((number, level), _plain(each), "", "above", each.address, sort))
    if any(handle.drags[0].address == each.address for handle in shapes.handles):
        shapes.dots.append(Dot((number, level)))  # one value of all axes has its handle on the first
    else:
        drag = figures.drag(each, "x", 10.0 * number)
        shapes.handles.append(figures.handle(each, (number, level), drag, second=True))


def _plain(each: DrawnValue) -> str:
    """Return the number without its unit."""
    return each.text.removesuffix(unit_text(each.unit)).strip() if each.unit else each.text


def _decades(figures: Iterable[DrawnValue]) -> Scale:
    """Return a scale of powers of ten around the numbers above 0."""
    numbers = [each.number for each in figures if each.number is not None and each.number > 0.0]
    if not numbers:
        return Scale("", "", 1.0, 10.0, log=True)
    return Scale("", "", min(numbers) / 2.0, max(numbers) * 2.0, log=True)
