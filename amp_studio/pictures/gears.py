"""Gears of a spindle on a line of speed, with what the control puts out."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

from amp_studio.drawing import FilledArea, Handle, Polyline, Scale, Scene, ShapeSort, Text
from amp_studio.files import ParameterFile
from amp_studio.schema import GearRoles

from .figures import DrawnValue, ValueReader, number_of
from .shapes import SceneShapes


def spindles(file: ParameterFile, roles: GearRoles) -> tuple[str, ...]:
    """Return the spindles that have a gear with a value; the first one where none has."""
    parameter = roles.high or roles.scaling or ""
    instances = file.machine_schema.instances(file.schema.parameters[parameter])
    found = dict.fromkeys(i.partition(".")[0] for i in instances if _has_gear(file, parameter, i))
    return tuple(found) or tuple(dict.fromkeys(i.partition(".")[0] for i in instances))[:1]


def _has_gear(file: ParameterFile, parameter: str, instance: str) -> bool:
    value = file.get((parameter, instance))
    return value is not None and value.value != 0 and file.evaluation.state((parameter, instance)).is_active


def draw_gears(file: ParameterFile, roles: GearRoles, spindle: str, like: Scene | None = None) -> Scene:
    """Return the picture of one spindle's gears."""
    figures = ValueReader(file)
    found = _gears_of(figures, roles, spindle)
    x, y = (like.x, like.y) if like else _scales(found, roles.unit)
    shapes = SceneShapes(figures)
    for a, b in pairwise(found):
        if b.low < a.high:
            shapes.areas.append(FilledArea(b.low, y.low, a.high, y.high, "overlap", ""))
        elif b.low > a.high:
            about = b.figures[0].address if b.figures[0] else None
            figures.add_note(f"No gear has the speeds from {a.high:g} to {b.low:g} rpm", about)
    for n, gear in enumerate(found):
        _draw_gear(shapes, gear, is_first=n == 0)
        shapes.handles += _handles(figures, roles, gear, x.high, y.high)
    unit = "volts" if roles.unit == "V" else roles.unit
    subtitle = f"{f'spindle {spindle}, ' if spindle else ''}{unit} over speed"
    return shapes.scene("gears", spindle, "Spindle gears", subtitle, x, y)


def _gears_of(figures: ValueReader, roles: GearRoles, spindle: str) -> list[_Gear]:
    """Return the gears that can be drawn."""
    if roles.scaling:
        return [*filter(None, [_scaled(figures, roles)])]
    return [gear for i in _gears(figures, roles, spindle) if (gear := _gear(figures, roles, i))]


def _scales(gears: Sequence[_Gear], unit: str) -> tuple[Scale, Scale]:
    outputs = [gear.output for gear in gears]
    low, high = min([0.0, *outputs]), max([0.0, *outputs]) or (0.0 if outputs else 10.0)
    x = Scale("", "rpm", 0.0, 1.12 * max((gear.high for gear in gears), default=1000.0))
    return x, Scale("", unit, 1.2 * low, 1.2 * high or 1.0)


def _draw_gear(shapes: SceneShapes, gear: _Gear, *, is_first: bool) -> None:
    """Draw the output of a gear over its speeds, and dashed how it gets there from rest."""
    wrong = any(f is not None and f.wrong for f in gear.figures)
    sort: ShapeSort = "error" if wrong else "now" if is_first else "ink"
    low, high = (gear.low, gear.output_low), (gear.high, gear.output)
    shapes.lines.append(Polyline(((0.0, gear.at_standstill), low), "dim", dashed=True))
    shapes.lines.append(Polyline((low, high), sort))
    about = gear.figures[1].address if gear.figures[1] else None
    shapes.texts.append(Text(high, gear.name, f"{gear.high:g}", "above", about))


def _gears(figures: ValueReader, roles: GearRoles, spindle: str) -> list[str]:
    """Return the instances of the gears that are used."""
    assert roles.high is not None
    file = figures.file
    every = [
        i
        for i in file.machine_schema.instances(file.schema.parameters[roles.high])
        if i.partition(".")[0] == spindle
    ]
    # Without a number of gears in the file, those are used whose highest speed is not 0.
    if roles.count is None:
        return [i for i in every if len(every) == 1 or _has_gear(file, roles.high, i)] or every[:1]
    return every[: int(number_of(figures.figure(roles.count, spindle)) or 0)]


class _Gear:
    """One gear: speeds in rpm and the output at them."""

    def __init__(
        self,
        name: str,
        low: float,
        high: float,
        output: float,
        output_low: float,
        figures: tuple[DrawnValue | None, ...],
        at_standstill: float = 0.0,
    ) -> None:
        self.name, self.low, self.high, self.output, self.output_low = name, low, high, output, output_low
        self.figures, self.at_standstill = figures, at_standstill
        """Low, high, output, output at low, limit; what is put out at standstill."""


def _gear(figures: ValueReader, roles: GearRoles, instance: str) -> _Gear | None:
    """Return a gear; None where a figure is missing that it needs."""
    own = (roles.low, roles.high, roles.output, roles.output_low)
    low, high, output, output_low = (figures.figure(parameter, instance) for parameter in own)
    limit = figures.figure(roles.limit, _beside(figures, roles, instance))
    lowest, highest, top = number_of(low), number_of(high), number_of(output)
    if not roles.output:
        top = roles.full
    if highest is None or lowest is None or top is None:
        return None
    bottom = number_of(output_low)
    if bottom is None:
        # Without an output of its low end the output is in proportion to the speed.
        bottom = top * (lowest / highest if highest else 0.0)
    name = f"gear {instance.partition('.')[2]}" if "." in instance else "spindle"
    at_standstill = bottom if roles.output_low else 0.0
    return _Gear(name, lowest, highest, top, bottom, (low, high, output, output_low, limit), at_standstill)


def _beside(figures: ValueReader, roles: GearRoles, instance: str) -> str:
    """Return the instance of the limit of the same gear: the one at the same place in the list."""
    if roles.high is None or roles.limit is None:
        return instance
    parameters, machine = figures.file.schema.parameters, figures.file.machine_schema
    own, others = machine.instances(parameters[roles.high]), machine.instances(parameters[roles.limit])
    return others[own.index(instance)] if len(others) == len(own) else instance


def _scaled(figures: ValueReader, roles: GearRoles) -> _Gear | None:
    """Return the line of a scaling: output for a unit of speed."""
    assert roles.scaling is not None
    found = figures.figure(roles.scaling, "")
    if found is None or found.number is None or roles.full is None:
        return None
    if found.number <= 0.0:
        figures.add_note(f"{found.label}: {found.text} puts nothing out at any speed", found.address)
        return None
    return _Gear(
        "full output", 0.0, roles.full / found.number, roles.full, 0.0, (None, found, None, None, None)
    )


def _handles(figures: ValueReader, roles: GearRoles, gear: _Gear, across: float, top: float) -> list[Handle]:
    """Return the handles of speeds and output; ``across`` and ``top`` are the spans of the picture."""
    low, high, output, output_low, limit = gear.figures
    if roles.scaling and high is not None:
        return [_scaling_handle(figures, high, gear, roles.full or 10.0)]
    handles: list[Handle] = []
    if high is not None:
        handles.append(figures.handle(high, (gear.high, gear.output), figures.drag(high, "x", across)))
    if limit is not None and limit.number:  # 0 is the highest speed
        at = (limit.number, gear.output * limit.number / gear.high if gear.high else 0.0)
        handles.append(figures.handle(limit, at, figures.drag(limit, "x", across), second=True))
    if low is not None:
        handles.append(figures.handle(low, (gear.low, gear.output_low), figures.drag(low, "x", across)))
    if output is not None:
        handles += _output_handles(figures, gear, output, output_low, top)
    return handles


def _scaling_handle(figures: ValueReader, scaling: DrawnValue, gear: _Gear, full: float) -> Handle:
    def scaling_at(speed: float) -> float | None:
        # At the left edge the scaling would be infinite: the value stays.
        return full / speed if speed > 0.0 else None

    drag = figures.drag(scaling, "x", 2.0 * (scaling.number or 1.0), scaling_at, rises=False)
    return figures.handle(scaling, (gear.high, gear.output), drag)


def _output_handles(
    figures: ValueReader, gear: _Gear, output: DrawnValue, output_low: DrawnValue | None, top: float
) -> Iterator[Handle]:
    """Yield the handles of what is put out: on the middle of the line, or near each of its ends."""
    if output_low is None:
        if not gear.high:
            return
        middle = 0.5 * (gear.low + gear.high)
        share = middle / gear.high or 1.0
        drag = figures.drag(output, "y", top, lambda level: level / share)
        yield figures.handle(output, (middle, gear.output * share), drag, second=True)
        return
    for figure, share in ((output, 0.8), (output_low, 0.2)):
        place = gear.low + share * (gear.high - gear.low)
        level = gear.output_low + share * (gear.output - gear.output_low)
        other = gear.output_low if figure is output else gear.output
        weight = share if figure is output else 1.0 - share
        # Extended from the handle to the end of the line: the other end stays where it is.
        drag = figures.drag(figure, "y", top, lambda y, o=other, w=weight: o + (y - o) / w)  # type: ignore[misc]  # the defaults bind the figures of this turn
        yield figures.handle(figure, (place, level), drag, second=True)
