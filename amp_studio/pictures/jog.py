"""Jog speeds and increments of the axes as a ladder, a row for each axis."""

from __future__ import annotations

from typing import Literal

from amp_studio.drawing import Dot, Handle, PictureNote, Polyline, Scale, Scene, Text
from amp_studio.files import ParameterFile
from amp_studio.schema import JogRoles, ParameterId, unit_text

from .figures import DrawnValue, ValueReader
from .parts import axes_with

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
    drawn = [
        each.number
        for row in (*rows, *limits)
        for each in row
        if each.number is not None and each.number > 0.0
    ]
    x = like.x if like else _decades(drawn)
    y = Scale(
        "",
        "",
        -len(axes) + 0.4,
        0.6,
        rows=tuple(
            (-float(n), figures.axis(axis), next((each.unit for each in (*rows[n], *limits[n])), ""))
            for n, axis in enumerate(axes)
        ),
    )
    lines: list[Polyline] = []
    dots: list[Dot] = []
    texts: list[Text] = []
    handles: list[Handle] = []
    given: set[object] = set()
    for n, (row, bound) in enumerate(zip(rows, limits, strict=True)):
        level = -float(n)
        found = [each for each in row if _drawable(figures, each)]
        ends = [each.number or 0.0 for each in (*found, *(b for b in bound if _drawable(figures, b)))]
        if ends:
            lines.append(Polyline(((min(ends), level), (max(ends), level)), "rail"))
        highest = max((b.number for b in bound if b.number), default=None)
        for each in found:
            number = each.number or 0.0
            beyond = highest is not None and number > highest
            if beyond:
                figures.note(
                    f"{each.label}: {each.text} is above {bound[0].label}, {bound[0].text}",
                    each.address,
                    wrong=True,
                )
            texts.append(
                Text(
                    (number, level),
                    _plain(each),
                    "",
                    "above",
                    each.address,
                    "error" if each.wrong or beyond else "dim",
                )
            )
            if each.address in given:
                dots.append(Dot((number, level)))
                continue
            given.add(each.address)
            drag = figures.drag(each, "x", 10.0 * number)
            handles.append(figures.handle(each, (number, level), drag, second=True))
        for each in bound:
            if each.number is not None and each.number > 0.0:
                dots.append(Dot((each.number, level), "end"))
                texts.append(Text((each.number, level), _plain(each), "", "below", each.address, "dim"))
    what = ", ".join(dict.fromkeys(b.label.rpartition(", ")[0] or b.label for row in limits for b in row))
    return Scene(
        name,
        "",
        TITLES[name],
        f"bars: {file.schema.parameters[bounds[0]].name}" if what else "",
        x,
        y,
        lines=tuple(lines),
        dots=tuple(dots),
        texts=tuple(texts),
        handles=tuple(handles),
        notes=tuple(figures.notes.values()),
        drawn_from=tuple(figures.read),
    )


def _drawable(figures: ValueReader, each: DrawnValue) -> bool:
    """Return whether a figure has a place on a scale of powers of ten."""
    if each.number is None:
        return False
    if each.number <= 0.0:
        figures.notes.setdefault(
            each.label,
            PictureNote(f"{each.label}: {each.text} has no place on this scale", each.address, each.wrong),
        )
        return False
    return True


def _plain(each: DrawnValue) -> str:
    """Return the number without its unit."""
    return each.text.removesuffix(unit_text(each.unit)).strip() if each.unit else each.text


def _decades(numbers: list[float]) -> Scale:
    """Return a scale of powers of ten around numbers."""
    if not numbers:
        return Scale("", "", 1.0, 10.0, log=True)
    return Scale("", "", min(numbers) / 2.0, max(numbers) * 2.0, log=True)
