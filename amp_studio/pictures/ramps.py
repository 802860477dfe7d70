"""The ramps of an axis as speed over time: pieces as the simulator's moves have them."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from amp_studio.drawing import Handle, Point, Polyline, Scale, Scene, ShapeSort, Text, figure_text, round_step
from amp_studio.files import ParameterFile
from amp_studio.schema import RampKind, RampRoles, TimeOf, UnitError, convert, unit_text
from amp_studio.sim import Piece, Ramp, SimulationError, change, exponential_pieces, leg, length

from .figures import DrawnValue, ValueReader
from .shapes import SceneShapes

RAMP_MULTIPLE = 1.8
"""A move is about so many times as long as its ramps."""
SAMPLES = 24
"""Points of a curved piece."""
FADED = 1e-3
"""An exponential ramp is drawn until so much of the move is left."""


@dataclass(frozen=True)
class _Drawn:
    """One kind of ramp with the figures it is made of; lengths in the unit of the axis, times in s."""

    role: RampKind
    ramp: Ramp
    acceleration: DrawnValue | None = None
    deceleration: DrawnValue | None = None
    jerk: DrawnValue | None = None
    time: DrawnValue | None = None
    factor: float = 1.0
    """s for a unit of ``time``."""
    rise: DrawnValue | None = None


def ramp_of(file: ParameterFile, role: RampKind, axis: str, feedrate: float, base: str) -> Ramp | None:
    """Return one kind of ramp of an axis as the simulator takes it: in ``base`` (mm, in, deg, counts) and s;
    None where it is not set.
    """
    found = _drawn(ValueReader(file), role, axis, feedrate, base)
    return found.ramp if found else None


def draw_ramps(file: ParameterFile, roles: RampRoles, axis: str, like: Scene | None = None) -> Scene:
    """Return the picture of a move of one axis from rest to rest, for each kind of ramp that is set."""
    figures = ValueReader(file)
    feed = figures.figure(roles.feedrate, axis)
    speed = _speed(figures, feed)
    shapes = SceneShapes(figures)
    if feed is None or feed.number is None or speed is None:
        x, y = Scale("", "s", 0.0, 1.0), Scale("", feed.unit if feed else "", 0.0, 1.0)
        return shapes.scene("ramps", axis, "Ramps", figures.axis(axis), x, y)
    base = feed.unit.split("/")[0]
    kinds = [found for role in roles.kinds if (found := _drawn(figures, role, axis, speed, base))]
    ways = [way for each in kinds if (way := _way(each.ramp, speed)) > 0.0]
    distance = like.fixed if like and like.fixed else round_step(RAMP_MULTIPLE * max(ways, default=speed))
    used = _mode(figures, roles, axis)
    longest = 0.0
    for n, each in enumerate(kinds):
        try:
            pieces = _pieces(each.ramp, speed, distance)
        except SimulationError as error:
            figures.add_note(f"{each.role.name}: {error}", wrong=True)
            continue
        is_used = used in each.role.modes if roles.mode else not shapes.lines
        end = _draw_move(shapes, each, pieces, feed.number, feed.number / speed, n, is_used=is_used)
        shapes.handles += _handles(figures, each, speed, feed.number / speed, distance, pieces)
        longest = max(longest, end)
    x = like.x if like else Scale("", "s", 0.0, 1.08 * (longest or distance / speed))
    bounds = [feed, *_bounds(figures, roles, feed, axis)]
    y = like.y if like else Scale("", feed.unit, 0.0, 1.18 * max(each.number or 0.0 for each in bounds))
    for bound in bounds:
        ends = ((x.low, bound.number or 0.0), (x.high, bound.number or 0.0))
        shapes.limit(ends, bound)
        shapes.texts.append(Text(ends[1], bound.label, bound.text, "right", bound.address, "dim"))
    drag = figures.drag(feed, "y", y.high)
    shapes.handles.append(figures.handle(feed, (0.97 * x.high, feed.number), drag, second=True))
    subtitle = f"{figures.axis(axis)}, speed over time, {figure_text(distance)} {base}"
    return shapes.scene("ramps", axis, "Ramps", subtitle, x, y, fixed=distance)


def _draw_move(
    shapes: SceneShapes,
    each: _Drawn,
    pieces: Sequence[Piece],
    top: float,
    scale: float,
    n: int,
    *,
    is_used: bool,
) -> float:
    """Draw the ``n``-th kind of ramp as speed over time, its name at a height beside the others;
    returns the s at which the move ends.
    """
    curve = [(t, v * scale) for t, v in sampled(pieces)]
    sort: ShapeSort = "now" if is_used else "second"
    shapes.lines.append(Polyline(tuple(curve), sort))
    about = next((f.address for f in (each.rise, each.acceleration, each.time) if f is not None), None)
    at = (0.45 * curve[-1][0], (0.25 + 0.12 * n) * top)
    shapes.texts.append(Text(at, each.role.name, _described(each, pieces), "left", about, sort))
    if each.role.note:
        shapes.figures.add_note(each.role.note, is_remark=True)
    return curve[-1][0]


def _speed(figures: ValueReader, feed: DrawnValue | None) -> float | None:
    """Return the feedrate in units a second; None, with a note, where it is no speed to ramp to."""
    if feed is None or feed.number is None:
        return None
    try:
        speed = convert(feed.number, feed.unit, f"{feed.unit.split('/')[0]}/s")
    except (KeyError, UnitError):
        speed = 0.0
    if speed > 0.0:
        return speed
    figures.add_note(f"{feed.label}: {feed.text} is no speed to ramp to", feed.address, wrong=True)
    return None


def _mode(figures: ValueReader, roles: RampRoles, axis: str) -> str | None:
    """Return what the file chooses between the kinds: the key of a choice, 0 or 1 of a bit;
    None where it is not set.
    """
    address = figures.address(roles.mode, axis) if roles.mode else None
    value = figures.file.get(address) if address else None
    if address is None:
        return None
    figures.read[address] = None
    if value is None:
        figures.add_note(f"{figures.label(address)}: not set, so the ramp of moves is not marked", address)
        return None
    if roles.mode_bit is None or isinstance(value.value, str):
        return str(value.value)
    return str(int(value.value) >> roles.mode_bit & 1)


def _bounds(figures: ValueReader, roles: RampRoles, feed: DrawnValue, axis: str) -> list[DrawnValue]:
    """Return the other speeds to compare with."""
    found = (figures.figure(parameter, axis, feed.unit) for parameter in roles.limits)
    return [each for each in found if each is not None and each.number is not None]


# -- the ramps ---------------------------------------------------------------------


def _drawn(figures: ValueReader, role: RampKind, axis: str, speed: float, base: str) -> _Drawn | None:
    """Return a kind of ramp with its figures; None where one that it needs is not set or impossible."""
    if role.rise:
        return _by_rise(figures, role, axis, speed)
    time, factor = _time(figures, role.time, axis)
    least = time.number * factor if time and time.number else 0.0
    if role.kind == "exponential":
        if least <= 0.0:
            return None
        return _Drawn(role, Ramp("exponential", time=least), time=time, factor=factor)
    return _by_slopes(figures, role, axis, base, _Drawn(role, Ramp(), time=time, factor=factor), least)


def _by_slopes(
    figures: ValueReader, role: RampKind, axis: str, base: str, drawn: _Drawn, least: float
) -> _Drawn | None:
    """Return a ramp that is given by its accelerations and its jerk; ``least`` s it takes at least."""

    def number(parameter: str | None, unit: str) -> DrawnValue | None:
        return figures.figure(parameter, axis, unit) if parameter else None

    step = _number_of(number(role.step, f"{base}/s"))
    up, down = number(role.acceleration, f"{base}/s2"), number(role.deceleration, f"{base}/s2")
    jerk = number(role.jerk, f"{base}/s3")
    if up is None or up.number is None or (role.jerk and not _number_of(jerk)):
        return None
    if up.number <= 0.0:
        figures.add_note(f"{up.label}: {up.text} is no ramp", up.address, wrong=up.wrong)
        return None
    given = _number_of(jerk)
    if jerk is not None and given < 0.0:
        figures.add_note(f"{jerk.label}: {jerk.text} is no ramp", jerk.address, wrong=True)
        return None
    slower = _number_of(down)
    if slower < 0.0:
        return None
    used = given
    if role.jerk_scans and jerk and given:
        used = _within_scans(figures, role, axis, up.number, jerk, given)
    return replace(
        drawn,
        ramp=Ramp(role.kind, up.number, slower or up.number, used, least, step),
        acceleration=up,
        deceleration=down if slower else None,
        jerk=jerk if used == given else None,
    )


def _number_of(figure: DrawnValue | None) -> float:
    """Return the number of a figure; 0 where it is not set."""
    return figure.number if figure and figure.number else 0.0


def _by_rise(figures: ValueReader, role: RampKind, axis: str, speed: float) -> _Drawn | None:
    """Return a ramp that is given by the time in ms in which it reaches the feedrate."""
    own = [figures.figure(parameter, axis, quiet=True) for parameter in role.rise]
    found = next((each for each in own if each is not None and each.number is not None), None)
    time = (found and found.number) or 0.0
    if found is None or time <= 0.0:
        if named := found or own[0]:
            text = named.problem or f"{named.text} is no time"
            figures.add_note(f"{named.label}: {text}", named.address, wrong=found is not None)
        return None
    slope = speed / (time / 1000.0)
    return _Drawn(role, Ramp(role.kind, slope, slope), rise=found, factor=0.001)


def _time(figures: ValueReader, role: TimeOf | None, axis: str) -> tuple[DrawnValue | None, float]:
    """Return the number to drag and the s that one of it is; None where a needed one is not set."""
    if role is None:
        return None, 1.0
    found = [(p, figures.figure(p, axis, quiet=p not in role.needed)) for p in role.params]
    if any(p in role.needed and (each is None or each.number is None) for p, each in found):
        return None, 1.0
    factor = 0.001 if role.unit == "ms" else 1.0
    for _, each in found[1:]:
        factor *= each.number if each is not None and each.number is not None else 1.0
    return found[0][1], factor


def _within_scans(
    figures: ValueReader, role: RampKind, axis: str, up: float, jerk: DrawnValue, given: float
) -> float:
    """Return the jerk that the control uses: a ramp of acceleration has its bounds in scans."""
    assert role.jerk_scans is not None
    first, factor = _time(figures, role.jerk_scans.scan, axis)
    if first is None or not first.number:
        return given
    scan = first.number * factor
    if scan <= 0.0:
        figures.add_note(
            f"{first.label}: without a scan above 0 the bounds of the jerk are not known", first.address
        )
        return given
    used = min(max(given, up / (role.jerk_scans.most * scan)), up / (role.jerk_scans.least * scan))
    if used != given:
        figures.add_note(
            f"{jerk.label}: {jerk.text} is outside {role.jerk_scans.least:g} to {role.jerk_scans.most:g}"
            f" scans, drawn with {used:.6g} {unit_text(jerk.unit)}",
            jerk.address,
            wrong=True,
        )
    return used


def _pieces(ramp: Ramp, speed: float, distance: float) -> list[Piece]:
    if ramp.kind == "exponential":
        return exponential_pieces(distance, [(0.0, speed)], ramp, FADED * distance)
    return leg(distance, speed, ramp)


def _way(ramp: Ramp, speed: float) -> float:
    """Return how far the axis goes while its speed changes."""
    if ramp.kind == "exponential":
        return 5.0 * ramp.time * speed
    return length(change(ramp, 0.0, speed)) + length(change(ramp, speed, 0.0))


def sampled(pieces: Sequence[Piece]) -> list[Point]:
    """Return (time, velocity) along pieces, from rest to rest."""
    found: list[Point] = [(0.0, 0.0)]
    start = 0.0
    for piece in pieces:
        straight = piece.kind == 0.0 and piece.jerk == 0.0
        count = 1 if straight else SAMPLES
        found += [
            (start + piece.duration * k / count, piece.velocity_after(piece.duration * k / count))
            for k in range(count + 1)
        ]
        start += piece.duration
    return [*found, (start, 0.0)]


# -- the handles ---------------------------------------------------------------------


def _described(each: _Drawn, pieces: Sequence[Piece]) -> str:
    figures = [f for f in (each.rise, each.acceleration, each.jerk, each.time) if f is not None and f.number]
    return f"{', '.join(f.text for f in figures[:2])}; {_rise_time(each, pieces):.3g} s"


def _rise_time(each: _Drawn, pieces: Sequence[Piece]) -> float:
    """Return the time to the greatest speed; of an exponential ramp, its time constant."""
    if each.ramp.kind == "exponential":
        return each.ramp.time
    top = max((piece.end for piece in pieces), default=0.0)
    passed = 0.0
    for piece in pieces:
        if piece.velocity >= top * (1.0 - 1e-9):
            break
        passed += piece.duration
    return passed


def _handles(
    figures: ValueReader, each: _Drawn, speed: float, scale: float, distance: float, pieces: Sequence[Piece]
) -> list[Handle]:
    """Return the handles of a ramp: each lies where its figure shows, and follows the pointer in time."""
    ramp = each.ramp
    top = max((piece.end for piece in pieces), default=0.0)
    risen, end = _rise_time(each, pieces), math.fsum(piece.duration for piece in pieces)
    short = top < speed * (1.0 - 1e-9)
    found: list[Handle] = []

    def put(
        figure: DrawnValue,
        at: Point,
        inverse: Callable[[float], float | None],
        span: float,
        *,
        rises: bool = False,
        second: bool = False,
    ) -> None:
        drag = figures.drag(figure, "x", span, inverse, rises=rises)
        found.append(figures.handle(figure, (at[0], at[1] * scale), drag, second=second))

    if each.time is not None and each.time.number and ramp.kind == "exponential":
        put(
            each.time,
            (ramp.time, speed * -math.expm1(-1.0)),
            lambda t: t / each.factor,
            end / each.factor,
            rises=True,
            second=True,
        )
        return found
    if each.rise is not None:
        put(each.rise, (risen, top), lambda t: t / each.factor, end / each.factor, rises=True)
        return found
    if each.acceleration is None or ramp.acceleration <= 0.0:
        return found
    put(
        each.acceleration,
        (risen, top),
        _acceleration_at(ramp, top),
        2.0 * ramp.acceleration,
        second=ramp.kind == "s-curve",
    )
    if each.deceleration is not None and ramp.kind == "linear" and not short:
        rest = distance / speed + 0.5 * risen
        put(
            each.deceleration,
            (end, 0.0),
            lambda t: speed / (2.0 * (t - rest)) if t > rest else None,
            2.0 * ramp.deceleration,
        )
    if each.jerk is not None and ramp.kind == "s-curve":
        slope = min(ramp.acceleration / ramp.jerk, math.sqrt(top / ramp.jerk))
        put(
            each.jerk,
            (slope, 0.5 * ramp.jerk * slope**2),
            lambda t: ramp.acceleration / t if t > 0.0 else None,
            2.0 * ramp.jerk,
            second=True,
        )
    return found


def _acceleration_at(ramp: Ramp, top: float) -> Callable[[float], float | None]:
    """Return time to speed -> acceleration, for one kind of ramp."""

    def straight(t: float) -> float | None:
        return top / t if t > 0.0 else None

    def sine(t: float) -> float | None:
        return 2.0 * top / t if t > 0.0 else None

    def curved(t: float) -> float | None:
        square = (ramp.jerk * t) ** 2 - 4.0 * top * ramp.jerk
        return (
            0.5 * (ramp.jerk * t - math.sqrt(square))
            if square > 0.0 and t > 0.0
            else math.sqrt(top * ramp.jerk)
        )

    return {"sine-squared": sine, "s-curve": curved}.get(ramp.kind, straight)
