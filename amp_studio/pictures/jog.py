"""Jog speeds and increments of the axes as a ladder, a row for each axis."""

from __future__ import annotations

from typing import Literal

from amp_studio.drawing import Dot, Polyline, Scale, Scene, ShapeSort, Text
from amp_studio.files import ParameterFile
from amp_studio.schema import JogRoles, ParameterId, unit_text

from .figures import DrawnValue, ValueReader
from .parts import axes_with
from .shapes import SceneShapes

TITLES = {"jog": "Jog speeds", "increments": "Jog increments"}


def draw_jog(
    file: ParameterFile, roles: JogRoles, name: Literal["jog", "increments"], like: Scene | None = None
) -> Scene:
    """Return the ladder of the speeds, or of the increments, of all axes, over a scale of powers of ten."""
    figures = ValueReader(file)
    own: tuple[ParameterId, ...] = roles.speeds if name == "jog" else roles.increments
    bounds = roles.limits if name == "jog" else ()
    axes = axes_with(file, (*own, *bounds))
    rows = [[each for p in own if (each := figures.figure(p, axis))] for axis in axes]
    limits = [[each for p in bounds if (each := figures.figure(p, axis))] for axis in axes]
    every = [[*row, *bound] for row, bound in zip(rows, limits, strict=True)]
    numbers = (each.number for row in every for each in row)
    x = like.x if like else _decades([number for number in numbers if number is not None and number > 0.0])
    heads = tuple(
        (-float(n), figures.axis(axis), next((each.unit for each in every[n]), ""))
        for n, axis in enumerate(axes)
    )
    shapes = SceneShapes(figures)
    for n, (row, bound) in enumerate(zip(rows, limits, strict=True)):
        _draw_row(shapes, row, bound, -float(n))
    subtitle = f"bars: {file.schema.parameters[bounds[0]].name}" if any(limits) else ""
    y = Scale("", "", -len(axes) + 0.4, 0.6, rows=heads)
    return shapes.scene(name, "", TITLES[name], subtitle, x, y)


def _draw_row(shapes: SceneShapes, row: list[DrawnValue], bounds: list[DrawnValue], level: float) -> None:
    """Draw the speeds of one axis as steps on a rail that reaches to its limits."""
    figures = shapes.figures
    found = [each for each in row if figures.is_on_decades(each)]
    ends = [each.number or 0.0 for each in (*found, *filter(figures.is_on_decades, bounds))]
    if ends:
        shapes.lines.append(Polyline(((min(ends), level), (max(ends), level)), "rail"))
    highest = max((b.number for b in bounds if b.number), default=None)
    for each in found:
        number = each.number or 0.0
        beyond = highest is not None and number > highest
        if beyond:
            figures.add_note(
                f"{each.label}: {each.text} is above {bounds[0].label}, {bounds[0].text}",
                each.address,
                wrong=True,
            )
        sort: ShapeSort = "error" if each.wrong or beyond else "dim"
        shapes.texts.append(Text((number, level), _plain(each), "", "above", each.address, sort))
        if any(handle.drags[0].address == each.address for handle in shapes.handles):
            shapes.dots.append(Dot((number, level)))  # one value of all axes has its handle on the first
        else:
            drag = figures.drag(each, "x", 10.0 * number)
            shapes.handles.append(figures.handle(each, (number, level), drag, second=True))
    for each in bounds:
        if each.number is not None and each.number > 0.0:
            shapes.dots.append(Dot((each.number, level), "end"))
            shapes.texts.append(Text((each.number, level), _plain(each), "", "below", each.address, "dim"))


def _plain(each: DrawnValue) -> str:
    """Return the number without its unit."""
    return each.text.removesuffix(unit_text(each.unit)).strip() if each.unit else each.text


def _decades(numbers: list[float]) -> Scale:
    """Return a scale of powers of ten around numbers."""
    if not numbers:
        return Scale("", "", 1.0, 10.0, log=True)
    return Scale("", "", min(numbers) / 2.0, max(numbers) * 2.0, log=True)
