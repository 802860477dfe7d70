"""Scenario `travel` of several axes: a straight way past zones and limits, and where the axes stop."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from amp_studio.schema import InvalidValueError, read_number
from amp_studio.sim.axis.moving_axis import MovingAxis
from amp_studio.sim.axis.orders import MoveOrder, StopOrder, one
from amp_studio.sim.command.events import Ramp
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import AxisLaw, BoundMachine
from amp_studio.sim.model import assumptions
from amp_studio.sim.rounding import page_text, value_text
from amp_studio.sim.scenario import ScenarioSettings, above_zero, refuse_unknown
from amp_studio.sim.series import Series
from amp_studio.sim.trace import Alarm, Figure, PlaneArea, Trace
from amp_studio.sim.zones import Zone

SETTINGS = {
    "move.start": "where the axes start, a figure for each (mm or deg); default: 0 for each",
    "move.to": "where they are sent, a figure for each (mm or deg)",
    "move.feedrate": (
        "feedrate along the way (mm/min or deg/min); default: the lowest rapid feedrate of the axes"
    ),
    "move.zone": "zones that are switched on, by their numbers, or none; default: those of power-up",
    "move.mode": "jog or program; default: jog",
}
AxisPoint = dict[str, float]
MAX_PERIODS = 50
"""Servo samples between two looks at the zones, far from their edges."""
BY_LINE = (
    "ASSUMED: the axes go in a straight line, each with its share of speed and ramp, and are checked once in"
    " a servo sample, on the measured positions."
)
AT_ONCE = "ASSUMED: the command of every axis stops at once where no stop is printed."


def run_plane(machine: BoundMachine, settings: ScenarioSettings) -> Trace:
    """Send several axes along a line; raises SimulationError for a point that is none
    or not allowed at the start.
    """
    refuse_unknown(settings, SETTINGS)
    axes = {name: machine.bind(name, {}) for name in machine.chosen}
    if len({axis.unit for axis in axes.values()}) > 1:
        raise SimulationError("The axes do not move in one unit: give those that do")
    start = _point(settings, "move.start", axes) or dict.fromkeys(axes, 0.0)
    to = _point(settings, "move.to", axes)
    if to is None or to == start:
        raise SimulationError("Give where the axes are sent, as move.to=3,6", "move.to")
    mode = settings.get("move.mode", "jog")
    if mode not in ("jog", "program"):
        raise SimulationError("move.mode must be jog or program", "move.mode")
    zones = [zone.settled(start) for zone in _active(machine, axes, settings)]
    for broken in (zone for zone in zones if zone.broken(start)):
        raise SimulationError(
            f"The start is not allowed by {broken.name}: give another move.start", "move.start"
        )
    return _travelled(machine, axes, start, to, zones, settings, is_program=mode == "program")


def _point(settings: ScenarioSettings, name: str, axes: Mapping[str, AxisLaw]) -> AxisPoint | None:
    """Return a point, a figure for each axis, separated by commas or semicolons."""
    given = settings.get(name)
    if given is None:
        return None
    text = f"{given!r}" if isinstance(given, float) else str(given)
    # Between semicolons a comma is a decimal one.
    parts = text.split(";") if ";" in text else text.split(",")
    if len(parts) != len(axes):
        raise SimulationError(f"{name} is '{text}'; it takes {len(axes)} figures, as 3,6", name)
    found: AxisPoint = {}
    for axis, part in zip(axes, parts, strict=True):
        try:
            value, rest = read_number(part.strip())
        except InvalidValueError as error:
            raise SimulationError(f"{name}: {error}", name) from None
        unit = rest.strip()
        if unit not in ("", axes[axis].unit, "in"):
            raise SimulationError(f"{name} is given in {unit}; axis {axis} moves in {axes[axis].unit}", name)
        found[axis] = value * (25.4 if unit == "in" else 1.0)
    return found


def _active(machine: BoundMachine, axes: Mapping[str, AxisLaw], settings: ScenarioSettings) -> list[Zone]:
    """Return the limits of the axes and the zones that are on;
    raises SimulationError for one that is not set.
    """
    found = list(_limits(machine, axes))
    zones = tuple(machine.law.zones(machine, tuple(axes))) if machine.law.zones else ()
    wanted = settings.get("move.zone")
    if wanted is None:
        return [*found, *(zone for zone in zones if zone.is_on)]
    if wanted == "none":
        return found
    text = f"{wanted:g}" if isinstance(wanted, float) else str(wanted)
    for number in text.replace(";", ",").split(","):
        found += _numbered(zones, number.strip())
    return found


def _numbered(zones: Sequence[Zone], number: str) -> list[Zone]:
    """Return the zones with a number; raises SimulationError where there is none."""
    found = [zone for zone in zones if zone.has_number(number)]
    if not found:
        raise SimulationError(f"Zone {number} is not set for these axes", "move.zone")
    return found


def _limits(machine: BoundMachine, axes: Mapping[str, AxisLaw]) -> Iterator[Zone]:
    """Yield the travel limits of the axes as zones that the tool must stay inside of."""
    for name, axis in axes.items():
        if axis.travel is None:
            continue
        travel = axis.travel()
        for title, edges in travel.limits.items():
            yield Zone(
                f"{title} of {machine.letter(name) or name}",
                {name: edges},
                "inside",
                is_on=True,
                code=travel.alarm,
                code_minus=travel.alarm_negative,
                page=travel.page,
                notes=travel.notes,
                stop=travel.stop,
                reads_ahead=travel.reads_ahead or (travel.alarm if travel.refuses else ""),
                refuses=travel.refuses,
            )


def crossing(zone: Zone, start: AxisPoint, to: AxisPoint) -> float | None:
    """Return the share of a straight way at which a zone is broken; None where it is not."""
    inside = [
        _share_inside(sides, start[axis], to[axis] - start[axis])
        for axis, sides in zone.sides.items()
        if axis in to
    ]
    if not inside:
        return None
    return _left_at(inside) if zone.guard == "inside" else _entered_at(inside)


def _first_broken(zones: Sequence[Zone], start: AxisPoint, to: AxisPoint) -> tuple[float, Zone] | None:
    """Return the zone that a straight way breaks first, and the share of the way at which it does."""
    broken = [(share, zone) for zone in zones if (share := crossing(zone, start, to)) is not None]
    return min(broken, key=lambda each: each[0], default=None)


ALMOST_THERE = 1.0 - 1e-12
"""A way that ends on an edge does not break it: the last digits of its share are those of the division."""


def _left_at(inside: Sequence[tuple[float, float]]) -> float | None:
    """Return where the first axis leaves its sides."""
    # An axis that rests on an edge is not between its sides and leaves them nowhere.
    first = min((end for begin, end in inside if begin <= end), default=math.inf)
    return first if first < ALMOST_THERE else None


def _entered_at(inside: Sequence[tuple[float, float]]) -> float | None:
    """Return where all axes are between their sides."""
    begin, end = max(each[0] for each in inside), min(each[1] for each in inside)
    return max(begin, 0.0) if begin < end and end > 0.0 and begin < ALMOST_THERE else None


def _share_inside(sides: tuple[float, float], start: float, way: float) -> tuple[float, float]:
    """Return from which share of its way to which an axis is between two sides;
    the first is above the second where it never is.
    """
    low, high = sides
    if way == 0.0:
        return (-math.inf, math.inf) if low < start < high else (math.inf, -math.inf)
    first, last = sorted(((low - start) / way, (high - start) / way))
    return first, last


@dataclass(frozen=True)
class _Line:
    """A straight way of several axes, in u of the machine."""

    start: AxisPoint
    to: AxisPoint
    feed: float
    """u/s along the way."""

    @property
    def ways(self) -> AxisPoint:
        return {name: self.to[name] - self.start[name] for name in self.to}

    @property
    def length(self) -> float:
        return math.sqrt(sum(way * way for way in self.ways.values()))

    def point(self, share: float) -> AxisPoint:
        """Return the point at a share of the way."""
        return {name: self.start[name] + way * share for name, way in self.ways.items()}


def _travelled(
    machine: BoundMachine,
    axes: Mapping[str, AxisLaw],
    start: AxisPoint,
    to: AxisPoint,
    zones: Sequence[Zone],
    settings: ScenarioSettings,
    *,
    is_program: bool,
) -> Trace:
    """Return the trace of one straight way past the zones."""
    line = _Line(start, to, 0.0)
    line = replace(line, feed=_feedrate(axes, line.ways, line.length, settings))
    first = _first_broken(zones, start, to)
    refused = first is not None and _is_refused(first[1], is_program)
    courses: dict[str, MovingAxis] = {}
    hit: tuple[Zone, float] | None = None
    if not refused:
        courses, hit = _moved(axes, line, zones)
    columns = _columns(machine, axes, courses, start)
    unit = _unit(axes)
    alarms = _alarms(line, first, hit, unit, refused=refused)
    letters = {name: machine.letter(name) or name for name in axes}
    stops = {name: float(columns[f"position_{letter}"][-1]) for name, letter in letters.items()}
    edge = first[0] * line.length if first else None
    result: dict[str, Figure] = {
        "feedrate": (line.feed * 60.0, f"{unit}/min"),
        "distance": (line.length, unit),
        "limit": (edge, unit),
        "reaches_target": (float(not alarms), ""),
    }
    if not refused:
        result |= _stopped(
            line, edge, stops, float(columns["time_s"][-1]), unit, is_past_edge=hit is not None
        )
        result |= {f"stop_position_{letter}": (stops[name], unit) for name, letter in letters.items()}
    first_axis = next(iter(axes.values()))
    return Trace(
        scenario="travel",
        axis=",".join(axes),
        model=f"{' + '.join(letters.values())}: {first_axis.title}",
        columns=columns,
        units={name: "s" if name == "time_s" else unit for name in columns},
        result=result,
        alarms=alarms,
        assumptions=(*_notes(machine, axes, zones), BY_LINE, AT_ONCE, *assumptions(first_axis)),
        areas=tuple(_areas(zones, tuple(axes)[:2], start, to)),
    )


def _is_refused(zone: Zone, is_program: bool) -> bool:
    """Return whether a block that breaks a zone is not begun: of a program also where it is read ahead."""
    return zone.refuses or (is_program and bool(zone.reads_ahead))


def _stopped(
    line: _Line, edge: float | None, stops: AxisPoint, time: float, unit: str, *, is_past_edge: bool
) -> dict[str, Figure]:
    """Return where a way along a line ended; ``edge`` is how far along it the first zone is."""
    gone = math.sqrt(sum((stop - line.start[name]) ** 2 for name, stop in stops.items()))
    return {
        "stop_position": (gone, unit),
        "overrun": (gone - edge if is_past_edge and edge is not None else None, unit),
        "time": (time, "s"),
    }


def _alarms(
    line: _Line, first: tuple[float, Zone] | None, hit: tuple[Zone, float] | None, unit: str, *, refused: bool
) -> tuple[Alarm, ...]:
    """Return the alarm of a block that is not begun, or of the zone that stopped the axes."""
    if not refused and hit is None:
        return ()
    share = first[0] if first else 1.0
    if hit is not None:
        zone, moment = hit
        # A hair beyond its edge, the zone itself knows in which direction it was broken.
        code = zone.broken(line.point(min(share + 1e-6, 1.0))) or zone.code
        return (Alarm(code, moment, f"The axes have reached {zone.name} ({page_text(zone.page)})"),)
    assert first is not None
    zone = first[1]
    text = (
        f"The way would break {zone.name} after {value_text(share * line.length, unit)}: the block is"
        f" refused and does not begin ({page_text(zone.page)})"
    )
    return (Alarm(zone.reads_ahead or zone.code, 0.0, text),)


def _notes(machine: BoundMachine, axes: Mapping[str, AxisLaw], zones: Sequence[Zone]) -> Iterator[str]:
    """Yield what the zones assume, and the axes of zones that are not among those that move."""
    yield from dict.fromkeys(note for zone in zones for note in zone.notes)
    others = {axis for zone in zones for axis in zone.sides if axis not in axes}
    if others:
        names = ", ".join(sorted(machine.letter(axis) or axis for axis in others))
        yield f"ASSUMED: {names} is where the zones are: choose it too to have its place checked."


def _unit(axes: Mapping[str, AxisLaw]) -> str:
    return next(iter(axes.values())).unit


def _feedrate(axes: Mapping[str, AxisLaw], ways: AxisPoint, far: float, settings: ScenarioSettings) -> float:
    """Return the feedrate on the path, u/s: the one that is given, else the rapid of the slowest axis."""
    given = above_zero(settings, "move.feedrate")
    if given is not None:
        return given / 60.0
    shares = [axes[name].feedrate or math.inf for name, way in ways.items() if way]
    least = min(
        rate * far / abs(way) for rate, way in zip(shares, (w for w in ways.values() if w), strict=True)
    )
    if not math.isfinite(least):
        raise SimulationError("No rapid feedrate of these axes is set: give move.feedrate", "move.feedrate")
    return least


def _moved(
    axes: Mapping[str, AxisLaw], line: _Line, zones: Sequence[Zone]
) -> tuple[dict[str, MovingAxis], tuple[Zone, float] | None]:
    """Step all axes along the line; returns them, and the zone that stopped them with its moment."""
    courses = _begun(axes, line)
    # Axes may have other servo periods: in steps of the longest one they stay together.
    period = max(axis.servo_period for axis in axes.values())

    def place() -> AxisPoint:
        return {name: line.start[name] + course.measured for name, course in courses.items()}

    hit: tuple[Zone, float] | None = None
    while _is_going(courses):
        periods = 1 if hit else _periods_to_next_look(zones, place(), line.feed * period)
        for course in courses.values():
            course.advance(periods * period)
        here = place()
        broken = None if hit else next((zone for zone in zones if zone.broken(here)), None)
        if broken is not None:
            hit = broken, max(course.time for course in courses.values())
            _stop(courses, broken)
    return courses, hit


def _stop(courses: Mapping[str, MovingAxis], zone: Zone) -> None:
    """Stop all axes as a zone does; without a ramp of its stop their commands end at once."""
    for course in courses.values():
        course.begin(one(StopOrder(zone.stop or Ramp())))


def _is_going(courses: Mapping[str, MovingAxis]) -> bool:
    """Return whether an axis is still moving, and none has ended in an alarm."""
    return any(course.is_busy for course in courses.values()) and not any(
        course.is_over for course in courses.values()
    )


def _periods_to_next_look(zones: Sequence[Zone], here: AxisPoint, step: float) -> int:
    """Return how many servo samples pass until the zones are checked again: at most half of the way to
    the nearest edge, so that no zone is passed in between; ``step`` is the way in one sample.
    """
    room = min((zone.room(here) for zone in zones), default=math.inf)
    return max(1, min(MAX_PERIODS, int(0.5 * room / step))) if math.isfinite(room) else MAX_PERIODS


def _begun(axes: Mapping[str, AxisLaw], line: _Line) -> dict[str, MovingAxis]:
    """Return the axes on their way, each with its share of speed and ramp."""
    courses = {name: MovingAxis(axis) for name, axis in axes.items()}
    ramps = {name: next(iter(axis.ramps.values())) for name, axis in axes.items()}
    far = line.length
    # The weakest axis sets the acceleration along the line.
    rates = [
        ramps[name].acceleration * far / abs(way)
        for name, way in line.ways.items()
        if way and ramps[name].acceleration
    ]
    for name, way in line.ways.items():
        share = abs(way) / far
        if share:
            ramp = Ramp("linear", min(rates) * share) if rates else ramps[name]
            courses[name].begin(one(MoveOrder(way, line.feed * share, ramp)))
    return courses


def _columns(
    machine: BoundMachine, axes: Mapping[str, AxisLaw], courses: Mapping[str, MovingAxis], start: AxisPoint
) -> dict[str, Series]:
    """Return time, commanded and actual positions of all axes over the rows of the one that took longest."""
    motions = {name: course.motion() for name, course in courses.items()}
    if not motions:
        time = np.array([0.0, 0.0])
    else:
        time = max(
            (motion.columns["time_s"] for motion in motions.values()), key=lambda each: float(each[-1])
        )
    found: dict[str, Series] = {"time_s": time}
    for name in axes:
        letter = machine.letter(name) or name
        for column, title in (("command_position", "command"), ("position", "position")):
            place = np.zeros_like(time)
            if name in motions:
                place = np.interp(time, motions[name].columns["time_s"], motions[name].columns[column])
            found[f"{title}_{letter}"] = start[name] + place
    return found


def _areas(
    zones: Sequence[Zone], pair: Sequence[str], start: AxisPoint, to: AxisPoint
) -> Iterator[PlaneArea]:
    """Yield the zones in the plane of two axes, open sides as far as the picture goes."""
    if len(pair) < 2:
        return
    reach = {name: (min(start[name], to[name]), max(start[name], to[name])) for name in pair}
    margin = max(high - low for low, high in reach.values()) or 1.0
    seen = {name: (low - margin, high + margin) for name, (low, high) in reach.items()}
    for zone in zones:
        if zone.sides.keys().isdisjoint(pair):
            continue
        sides = {**dict.fromkeys(pair, (-math.inf, math.inf)), **zone.sides}
        spans = [(max(sides[n][0], least), min(sides[n][1], most)) for n, (least, most) in seen.items()]
        if all(low < high for low, high in spans):
            yield PlaneArea(zone.name, spans[0], spans[1])
