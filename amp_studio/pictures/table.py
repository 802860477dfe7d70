"""A compensation over the position, whose points are dragged, put in and taken out."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from amp_studio.drawing import Drag, Handle, Point, Polyline, Scale, Scene, Text, multiple, round_step
from amp_studio.files import ParameterFile
from amp_studio.schema import Address, TableRoles, Value, load_part, registration_of

from .figures import STEPS, ValueReader
from .shapes import SceneShapes

Points = Sequence[Point]


@dataclass(frozen=True)
class CurveText:
    """How a family writes a table of (position, compensation)
    in one text (``curve="module:NAME"`` of its record).

    ``read``      letter of the axis, text -> the points; raises ValueError for a text that is no table
    ``write``     letter, points, the text before ("" for a new table), unit of a new one -> the text; raises
                  ValueError for
                  points that the control does not take, with the reason
    ``unit``      text -> the unit of its figures; "" for that of the axis
    ``put_in``    points, point -> the points with one more; raises ValueError where none can be
    ``remove_point``  points, index -> the points without it; raises ValueError where it cannot be missing
    ``grain``     the smallest compensation
    """

    read: Callable[[str, str], list[Point]]
    write: Callable[[str, Points, str, str], str]
    unit: Callable[[str], str]
    put_in: Callable[[Points, Point], list[Point]]
    remove_point: Callable[[Points, int], list[Point]]
    grain: float


def _curve_text(file: ParameterFile) -> CurveText | None:
    """Return how the family of a file writes its tables; None where it has none."""
    place = registration_of(file.schema.family.family).curve
    found = load_part(place) if place else None
    return found if isinstance(found, CurveText) else None


def draw_table(file: ParameterFile, roles: TableRoles, axis: str, like: Scene | None = None) -> Scene:
    """Return the curve of one table."""
    figures, form = ValueReader(file), _curve_text(file)
    address = (roles.param, axis)
    figures.read[address] = None
    value, letter, label = file.get(address), figures.axis(axis), figures.label(address)
    unit_at = figures.address(roles.unit_from, axis)
    state = figures.evaluation.state(address)
    if not state.is_active:
        figures.add_note(f"{label}: inactive, {state.why}", address)
    text = str(value.value) if value else ""
    points, own_unit = _points(figures, form, address, text if value else None)
    unit = own_unit or (figures.unit(unit_at) if unit_at else "")
    x, y = (like.x, like.y) if like else _scales(points, unit)
    shapes = SceneShapes(figures)
    shapes.lines.append(Polyline(((x.low, 0.0), (x.high, 0.0)), "dim", dashed=True))
    if points and form:
        known = (address, letter, label, text)
        shapes.handles += [_handle(form, known, points, n, y) for n in range(len(points))]
        shapes.lines.append(Polyline(tuple(points), "now"))
    shapes.texts.append(Text((x.low, y.high), label, "", "left", address, "dim"))

    def with_point(at: Point) -> tuple[Address, Value] | None:
        # A text that cannot be read is not replaced by one point.
        if form is None or (value is not None and not points):
            return None
        more = form.put_in(points, (at[0], multiple(at[1], form.grain)))
        return address, Value(form.write(letter, more, text, unit))

    subtitle = f"{letter}, {len(points)} points"
    return shapes.scene("calibration", axis, roles.name, subtitle, x, y, with_point=with_point)


def _points(
    figures: ValueReader, form: CurveText | None, address: Address, text: str | None
) -> tuple[list[Point], str]:
    """Return the points of a table and the unit that it names; none, with a note, where it has none to
    read.
    """
    label = figures.label(address)
    if text is None or form is None:
        figures.add_note(f"{label}: not set", address)
        return [], ""
    try:
        return form.read(figures.axis(address[1]), text), form.unit(text)
    except ValueError as error:
        figures.add_note(f"{label}: {error}", address, wrong=True)
        return [], ""


def _scales(points: Sequence[Point], unit: str) -> tuple[Scale, Scale]:
    """Return the scales of position and compensation, with room around the points."""
    low, high = (f([y for _, y in points] or [0.0]) for f in (min, max))
    # Equal points have no height of their own; a scale without length cannot be drawn.
    margin = 0.25 * (high - low) or abs(high) or 0.01
    first, last = 0.0, 1.0
    if points:
        first, last = points[0][0] - 0.02 * _span(points), points[-1][0] + 0.08 * _span(points)
    return (
        Scale("position", unit, first, last),
        Scale("compensation", unit, min(low - margin, 0.0), max(high + margin, 0.0)),
    )


def _span(points: Points) -> float:
    return points[-1][0] - points[0][0] or 1.0


def _handle(
    form: CurveText, table: tuple[Address, str, str, str], points: Points, n: int, y: Scale
) -> Handle:
    """Return the handle of one point: its compensation follows, its position stays.

    ``table`` is the address, the letter of the axis, what is written beside the handle, and the text.
    """
    address, letter, label, text = table
    step = max(form.grain, round_step((y.high - y.low) / STEPS))

    def value_at(level: float) -> Value | None:
        # Up and down only: the positions are those at which the points were measured.
        changed = [*points[:n], (points[n][0], multiple(level, step)), *points[n + 1 :]]
        return Value(form.write(letter, changed, text, ""))

    try:
        # Tried now, so that a point that must stay is not offered for removal.
        without = address, Value(form.write(letter, form.remove_point(points, n), text, ""))
    except ValueError:
        without = None
    at = points[n]
    drag = Drag(address, "y", value_at, step)
    return Handle(at, (drag,), f"{label}, at {at[0]:g}", f"{at[1]:g}", second=True, without=without)
