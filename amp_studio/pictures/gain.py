"""Gain of the position loop over the following error, with its break and the limits of the error."""

from __future__ import annotations

from amp_studio.drawing import Handle, Polyline, Scale, Scene, Text
from amp_studio.files import ParameterFile
from amp_studio.schema import ErrorRoles

from .figures import DrawnValue, ValueReader


def draw_gain(file: ParameterFile, roles: ErrorRoles, axis: str, like: Scene | None = None) -> Scene:
    """Return the gain of an axis over its following error; beyond the break it is the gain times the
    ratio.
    """
    figures = ValueReader(file)
    gain = figures.figure(roles.gain, axis)
    ratio = figures.figure(roles.ratio, axis) if roles.ratio else None
    found = [each for p in roles.limits if (each := figures.figure(p, axis))]
    at = figures.figure(roles.break_at, axis) if roles.break_at else None
    drawn = [each for each in (at, *found) if each is not None and _on_scale(figures, each)]
    places = [each.number or 1.0 for each in drawn]
    unit = drawn[0].unit if drawn else found[0].unit if found else ""
    x = (
        like.x
        if like
        else Scale(
            "following error", unit, min(places, default=1.0) / 3.0, max(places, default=3.0) * 3.0, log=True
        )
    )
    top = gain.number if gain and gain.number else 1.0
    y = like.y if like else Scale("gain", gain.unit if gain else "", 0.0, 1.3 * top)
    lines: list[Polyline] = []
    texts: list[Text] = []
    handles: list[Handle] = []
    if gain is not None and gain.number is not None:
        _draw_gain(figures, gain, at if at in drawn else None, ratio, (x, y), lines, handles)
        texts.append(
            Text(
                (x.low, gain.number),
                gain.label,
                gain.text,
                "left",
                gain.address,
                "error" if gain.wrong else "now",
            )
        )
    for n, each in enumerate(drawn):
        place = each.number or 1.0
        level = y.high * (0.24 + 0.12 * (n % 4))
        lines.append(
            Polyline(((place, y.low), (place, y.high)), "error" if each.wrong else "limit", dashed=True)
        )
        texts.append(
            Text(
                (place, level),
                each.label,
                each.text,
                "right" if place * place > x.low * x.high else "left",
                each.address,
                "dim",
            )
        )
        if all(
            handle.drags[0].address != each.address for handle in handles
        ):  # the break has one on its step
            drag = figures.drag(each, "x", 2.0 * place)
            handles.append(figures.handle(each, (place, 0.92 * y.high), drag, second=True))
    if at is not None and at in drawn:
        _say_order(figures, at, drawn)
    return Scene(
        "error",
        axis,
        "Error limits",
        f"{figures.axis(axis)}, gain over following error",
        x,
        y,
        lines=tuple(lines),
        texts=tuple(texts),
        handles=tuple(handles),
        notes=tuple(figures.notes.values()),
        drawn_from=tuple(figures.read),
    )


def _on_scale(figures: ValueReader, each: DrawnValue) -> bool:
    if each.number is None:
        return False
    if each.number <= 0.0:
        figures.note(f"{each.label}: {each.text} has no place on this scale", each.address, wrong=each.wrong)
        return False
    return True


def _draw_gain(
    figures: ValueReader,
    gain: DrawnValue,
    at: DrawnValue | None,
    ratio: DrawnValue | None,
    scales: tuple[Scale, Scale],
    lines: list[Polyline],
    handles: list[Handle],
) -> None:
    """Draw the gain up to the break, and the reduced gain beyond it."""
    x, y = scales
    level, place = gain.number or 0.0, (at.number if at else None)
    share = ratio.number if ratio and ratio.number is not None else None
    sort = "error" if any(each is not None and each.wrong for each in (gain, at, ratio)) else "now"
    if at is None or place is None or share is None:
        lines.append(Polyline(((x.low, level), (x.high, level)), "error" if sort == "error" else "now"))
        middle = (x.low * x.high) ** 0.5
        handles.append(figures.handle(gain, (middle, level), figures.drag(gain, "y", y.high)))
        return
    reduced = level * share
    points = ((x.low, level), (place, level), (place, reduced), (x.high, reduced))
    lines.append(Polyline(points, "error" if sort == "error" else "now"))
    handles.append(figures.handle(gain, ((x.low * place) ** 0.5, level), figures.drag(gain, "y", y.high)))
    handles.append(figures.handle(at, (place, 0.5 * (level + reduced)), figures.drag(at, "x", 2.0 * place)))
    if ratio is not None and level:
        drag = figures.drag(ratio, "y", 1.0, lambda y_at: y_at / level)
        handles.append(figures.handle(ratio, ((place * x.high) ** 0.5, reduced), drag))


def _say_order(figures: ValueReader, at: DrawnValue, drawn: list[DrawnValue]) -> None:
    """Note a break that lies above the last limit of the error."""
    number = at.number or 0.0
    last = drawn[-1]
    if last is not at and (last.number or 0.0) < number:
        figures.note(
            f"{at.label}: {at.text} is above {last.label}, {last.text}: the break is never reached",
            at.address,
            wrong=True,
        )
