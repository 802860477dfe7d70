"""The ramps of an axis as speed over time: pieces as the simulator's moves have them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

from amp_studio.drawing import Handle, Point, Polyline, Scale, Scene, ShapeSort, Text, figure_text, round_step
from amp_studio.files import ParameterFile
from amp_studio.schema import RampKind, RampRoles, TimeOf, UnitError, convert, unit_text
from amp_studio.sim import Piece, Ramp, SimulationError, change, exponential_pieces, leg, length

from .figures import DrawnValue, ValueReader, number_of
from .shapes import SceneShapes

_RAMP_MULTIPLE = 1.8
"""A move is about so many times as long as its ramps."""
_SAMPLES = 24
"""Points of a curved piece."""
_FADED = 1e-3
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
    # While it is dragged the move stays as long as it was: only the ramp changes.
    distance = like.fixed if like and like.fixed else _distance(kinds, speed)
    end = _draw_moves(shapes, roles, kinds, axis, (feed.number, speed, distance))
    bounds = [feed, *_bounds(figures, roles, feed, axis)]
    x = like.x if like else Scale("", "s", 0.0, 1.08 * (end or distance / speed))
    y = like.y if like else Scale("", feed.unit, 0.0, 1.18 * max(map(_number_or_0, bounds)))
    for bound in bounds:
        ends = ((x.low, _number_or_0(bound)), (x.high, _number_or_0(bound)))
        shapes.limit(ends, bound)
        shapes.texts.append(Text(ends[1], bound.label, bound.text, "right", bound.address, "dim"))
    drag = figures.drag(feed, "y", y.high)
    shapes.handles.append(figures.handle(feed, (0.97 * x.high, feed.number), drag, second=True))
    subtitle = f"{figures.axis(axis)}, speed over time, {figure_text(distance)} {base}"
    return shapes.scene("ramps", axis, "Ramps", subtitle, x, y, fixed=distance)


def _distance(kinds: Sequence[_Drawn], speed: float) -> float:
    """Return a round distance on which each kind of ramp reaches the speed."""
    ways = [way for each in kinds if (way := _way(each.ramp, speed)) > 0.0]
    return round_step(_RAMP_MULTIPLE * max(ways, default=speed))


def _draw_moves(
    shapes: SceneShapes,
    roles: RampRoles,
    kinds: Sequence[_Drawn],
    axis: str,
    move: tuple[float, float, float],
) -> float:
    """Draw the move with each kind of ramp; ``move`` is its feedrate as entered and in units a second,
    and its distance. Returns the s at which the last one ends.
    """
    figures, (feedrate, speed, distance) = shapes.figures, move
    used = _mode(figures, roles, axis)
    longest = 0.0
    for n, each in enumerate(kinds):
        try:
            pieces = _pieces(each.ramp, speed, distance)
        except SimulationError as error:
            figures.add_note(f"{each.role.name}: {error}", wrong=True)
            continue
        # Without a choice in the file, moves have the first kind that can be drawn.
        is_used = used in each.role.modes if roles.mode else not shapes.lines
        end = _draw_move(shapes, each, pieces, feedrate, feedrate / speed, n, is_used=is_used)
        shapes.handles += _handles(figures, each, speed, feedrate / speed, distance, pieces)
        longest = max(longest, end)
    return longest


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
    step = _number_or_0(figures.figure(role.step, axis, f"{base}/s"))
    up = figures.figure(role.acceleration, axis, f"{base}/s2")
    down = figures.figure(role.deceleration, axis, f"{base}/s2")
    jerk = figures.figure(role.jerk, axis, f"{base}/s3")
    given, slower = _number_or_0(jerk), _number_or_0(down)
    if up is None or up.number is None or (role.jerk and not given):
        return None
    if _is_impossible(figures, up, jerk) or slower < 0.0:
        return None
    used = _within_scans(figures, role, axis, up.number, jerk, given)
    return replace(
        drawn,
        ramp=Ramp(role.kind, up.number, slower or up.number, used, least, step),
        acceleration=up,
        deceleration=down if slower else None,
        jerk=jerk if used == given else None,
    )


def _is_impossible(figures: ValueReader, up: DrawnValue, jerk: DrawnValue | None) -> bool:
    """Return whether no ramp has this acceleration or jerk, which is noted."""
    if _number_or_0(up) <= 0.0:
        figures.add_note(f"{up.label}: {up.text} is no ramp", up.address, wrong=up.wrong)
        return True
    if jerk is not None and _number_or_0(jerk) < 0.0:
        figures.add_note(f"{jerk.label}: {jerk.text} is no ramp", jerk.address, wrong=True)
        return True
    return False


def _number_or_0(figure: DrawnValue | None) -> float:
    return number_of(figure) or 0.0


def _by_rise(figures: ValueReader, role: RampKind, axis: str, speed: float) -> _Drawn | None:
    """Return a ramp that is given by the time in ms in which it reaches the feedrate."""
    own = [figures.figure(parameter, axis, quiet=True) for parameter in role.rise]
    found = next((each for each in own if number_of(each) is not None), None)
    time = number_of(found) or 0.0
    if time > 0.0:
        slope = speed / (time / 1000.0)
        return _Drawn(role, Ramp(role.kind, slope, slope), rise=found, factor=0.001)
    if named := found or own[0]:
        text = named.problem or f"{named.text} is no time"
        figures.add_note(f"{named.label}: {text}", named.address, wrong=found is not None)
    return None


def _time(figures: ValueReader, role: TimeOf | None, axis: str) -> tuple[DrawnValue | None, float]:
    """Return the number to drag and the s that one of it is; None where a needed one is not set."""
    if role is None:
        return None, 1.0
    found = [(p, figures.figure(p, axis, quiet=p not in role.needed)) for p in role.params]
    if any(p in role.needed and number_of(each) is None for p, each in found):
        return None, 1.0
    numbers = (number_of(each) for _, each in found[1:])
    factor = 0.001 if role.unit == "ms" else 1.0
    return found[0][1], math.prod((number for number in numbers if number is not None), start=factor)


def _within_scans(
    figures: ValueReader, role: RampKind, axis: str, up: float, jerk: DrawnValue | None, given: float
) -> float:
    """Return the jerk that the control uses: a ramp of acceleration has its bounds in scans."""
    if role.jerk_scans is None or jerk is None or not given:
        return given
    first, factor = _time(figures, role.jerk_scans.scan, axis)
    if first is None or not first.number:
        return given
    scan = first.number * factor
    if scan <= 0.0:
        figures.add_note(
            f"{first.label}: without a scan above 0 the bounds of the jerk are not known", first.address
        )
        return given
    # acceleration / jerk is the time in which the acceleration is reached: so many scans at least and at
    # most.
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
        return exponential_pieces(distance, [(0.0, speed)], ramp, _FADED * distance)
    return leg(distance, speed, ramp)


def _way(ramp: Ramp, speed: float) -> float:
    """Return how far the axis goes while its speed changes."""
    if ramp.kind == "exponential":
        # An exponential has no end: after five time constants 0.7 % of the speed is left.
        return 5.0 * ramp.time * speed
    return length(change(ramp, 0.0, speed)) + length(change(ramp, speed, 0.0))


def sampled(pieces: Sequence[Piece]) -> list[Point]:
    """Return (time, velocity) along pieces, from rest to rest."""
    points: list[Point] = [(0.0, 0.0)]
    start = 0.0
    for piece in pieces:
        # Of a straight piece the ends are enough.
        straight = piece.kind == 0.0 and piece.jerk == 0.0
        count = 1 if straight else _SAMPLES
        points += [
            (start + piece.duration * k / count, piece.velocity_after(piece.duration * k / count))
            for k in range(count + 1)
        ]
        start += piece.duration
    # An exponential only comes near to rest.
    return [*points, (start, 0.0)]


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
) -> Iterator[Handle]:
    """Yield the handles of a ramp: each lies where its figure shows, and follows the pointer in time."""
    ramp = each.ramp
    top = max((piece.end for piece in pieces), default=0.0)
    risen, end = _rise_time(each, pieces), math.fsum(piece.duration for piece in pieces)

    def handle(
        figure: DrawnValue,
        at: Point,
        inverse: Callable[[float], float | None],
        span: float,
        *,
        rises: bool = False,
        second: bool = False,
    ) -> Handle:
        drag = figures.drag(figure, "x", span, inverse, rises=rises)
        return figures.handle(figure, (at[0], at[1] * scale), drag, second=second)

    def time_at(t: float) -> float:
        return t / each.factor

    if each.time is not None and each.time.number and ramp.kind == "exponential":
        # After one time constant 63 % of the speed is reached.
        at = (ramp.time, speed * -math.expm1(-1.0))
        yield handle(each.time, at, time_at, end / each.factor, rises=True, second=True)
    elif each.rise is not None:
        yield handle(each.rise, (risen, top), time_at, end / each.factor, rises=True)
    elif each.acceleration is not None and ramp.acceleration > 0.0:
        is_s_curve, span = ramp.kind == "s-curve", 2.0 * ramp.acceleration
        yield handle(each.acceleration, (risen, top), _acceleration_at(ramp, top), span, second=is_s_curve)
        # Where the speed is not reached, the end of the move depends on both slopes.
        if each.deceleration and ramp.kind == "linear" and top >= speed * (1.0 - 1e-9):
            inverse = _deceleration_at(speed, distance / speed + 0.5 * risen)
            yield handle(each.deceleration, (end, 0.0), inverse, 2.0 * ramp.deceleration)
        if each.jerk and is_s_curve:
            # Where the speed is too low the acceleration is never reached, and the jerk turns before it.
            slope = min(ramp.acceleration / ramp.jerk, math.sqrt(top / ramp.jerk))
            at, inverse = (slope, 0.5 * ramp.jerk * slope**2), _jerk_at(ramp)
            yield handle(each.jerk, at, inverse, 2.0 * ramp.jerk, second=True)


def _deceleration_at(speed: float, rest: float) -> Callable[[float], float | None]:
    # A move of fixed length ends at rest + v / (2 d), at `rest` with an endless deceleration.
    return lambda t: speed / (2.0 * (t - rest)) if t > rest else None


def _jerk_at(ramp: Ramp) -> Callable[[float], float | None]:
    return lambda t: ramp.acceleration / t if t > 0.0 else None


def _acceleration_at(ramp: Ramp, top: float) -> Callable[[float], float | None]:
    """Return time to speed -> acceleration, for one kind of ramp."""

    def straight(t: float) -> float | None:
        return top / t if t > 0.0 else None

    def sine(t: float) -> float | None:
        # A sine-squared ramp has its greatest acceleration in the middle, twice the mean.
        return 2.0 * top / t if t > 0.0 else None

    def curved(t: float) -> float | None:
        # From t = v/a + a/j: below twice the root of v/j no acceleration is quick enough.
        square = (ramp.jerk * t) ** 2 - 4.0 * top * ramp.jerk
        return (
            0.5 * (ramp.jerk * t - math.sqrt(square))
            if square > 0.0 and t > 0.0
            else math.sqrt(top * ramp.jerk)
        )

    return {"sine-squared": sine, "s-curve": curved}.get(ramp.kind, straight)
