"""Scenario `travel` of several axes: a straight way past zones and limits, and where the axes stop."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from amp_studio.schema import InvalidValueError, read_number
from amp_studio.sim.axis.moving_axis import MoveOrder, MovingAxis, StopOrder, one
from amp_studio.sim.command.events import Ramp
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import AxisLaw, BoundMachine
from amp_studio.sim.model import assumptions
from amp_studio.sim.rounding import value_text
from amp_studio.sim.scenario import Settings, above_zero, refuse_unknown
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
MOST_PERIODS = 50
"""Servo samples between two looks at the zones, far from their edges."""
WAIT = 20.0
"""s at most after the command."""
BY_LINE = (
    "ASSUMED: the axes go in a straight line, each with its share of speed and ramp, and are checked once in"
    " a servo sample, on the measured positions."
)
AT_ONCE = "ASSUMED: the command of every axis stops at once where no stop is printed."


def run_plane(machine: BoundMachine, settings: Settings) -> Trace:
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
    for zone in zones:
        if zone.broken(start):
            raise SimulationError(
                f"The start is not allowed by {zone.name}: give another move.start", "move.start"
            )
    return _travelled(machine, axes, start, to, zones, settings, is_program=mode == "program")


def _point(settings: Settings, name: str, axes: Mapping[str, AxisLaw]) -> AxisPoint | None:
    """Return a point, a figure for each axis, separated by commas or semicolons."""
    given = settings.get(name)
    if given is None:
        return None
    text = f"{given!r}" if isinstance(given, float) else str(given)
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


def _active(machine: BoundMachine, axes: Mapping[str, AxisLaw], settings: Settings) -> list[Zone]:
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
        numbered = [zone for zone in zones if f" {number.strip()}" in zone.name.partition(",")[0]]
        if not numbered:
            raise SimulationError(f"Zone {number.strip()} is not set for these axes", "move.zone")
        found += numbered
    return found


def _limits(machine: BoundMachine, axes: Mapping[str, AxisLaw]) -> Iterator[Zone]:
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
    inside: list[tuple[float, float]] = []
    for axis, (low, high) in zone.sides.items():
        if axis not in to:
            continue
        way = to[axis] - start[axis]
        if way == 0.0:
            inside.append((-math.inf, math.inf) if low < start[axis] < high else (math.inf, -math.inf))
            continue
        ends = sorted(((low - start[axis]) / way, (high - start[axis]) / way))
        inside.append((ends[0], ends[1]))
    if zone.guard == "inside":
        first = min(end for begin, end in inside if begin <= end) if inside else math.inf
        return first if first < 1.0 - 1e-12 else None
    if not inside:
        return None
    begin, end = max(each[0] for each in inside), min(each[1] for each in inside)
    return max(begin, 0.0) if begin < end and end > 0.0 and begin < 1.0 - 1e-12 else None


def _travelled(
    machine: BoundMachine,
    axes: Mapping[str, AxisLaw],
    start: AxisPoint,
    to: AxisPoint,
    zones: Sequence[Zone],
    settings: Settings,
    *,
    is_program: bool,
) -> Trace:
    ways = {name: to[name] - start[name] for name in axes}
    far = math.sqrt(sum(way * way for way in ways.values()))
    crossed = [(share, zone) for zone in zones if (share := crossing(zone, start, to)) is not None]
    first = min(crossed, key=lambda each: each[0], default=None)
    feed = _feedrate(axes, ways, far, settings)
    refused = first is not None and (first[1].refuses or (is_program and bool(first[1].reads_ahead)))
    courses: dict[str, MovingAxis] = {}
    hit: tuple[Zone, float] | None = None
    if not refused:
        courses, hit = _moved(axes, start, ways, far, feed, zones)
    columns = _columns(machine, axes, courses, start)
    last = {name: float(columns[f"position_{machine.letter(name) or name}"][-1]) for name in axes}
    gone = math.sqrt(sum((last[name] - start[name]) ** 2 for name in axes))
    alarms = []
    if first is not None and refused:
        code = first[1].reads_ahead or first[1].code
        text = (
            f"The way would break {first[1].name} after {value_text(first[0] * far, _unit(axes))}: "
            "the block is"
            f" not begun (page {first[1].page})"
        )
        alarms.append(Alarm(code, 0.0, text))
    elif hit is not None:
        zone, moment = hit
        point = {
            name: start[name] + ways[name] * min((first[0] if first else 1.0) + 1e-6, 1.0) for name in axes
        }
        code = zone.broken(point) or zone.code
        alarms.append(Alarm(code, moment, f"The axes have reached {zone.name} (page {zone.page})"))
    edge = None if first is None else first[0] * far
    unit = _unit(axes)
    result: dict[str, Figure] = {
        "feedrate": (feed * 60.0, f"{unit}/min"),
        "distance": (far, unit),
        "limit": (edge, unit),
        "stop_position": (gone, unit),
        "overrun": (gone - edge if hit is not None and edge is not None else None, unit),
        "time": (float(columns["time_s"][-1]), "s"),
        "reaches_target": (float(not alarms), ""),
    }
    result |= {f"stop_position_{machine.letter(name) or name}": (last[name], unit) for name in axes}
    notes = dict.fromkeys(note for zone in zones for note in zone.notes)
    if open_axes := sorted(
        {machine.letter(axis) or axis for zone in zones for axis in zone.sides if axis not in axes}
    ):
        notes[
            f"ASSUMED: {', '.join(open_axes)} is where the zones are: give it with --axis to have its place"
            " checked."
        ] = None
    return Trace(
        scenario="travel",
        axis=",".join(axes),
        model=" + ".join(f"{machine.letter(name) or name}" for name in axes)
        + f": {next(iter(axes.values())).title}",
        columns=columns,
        units={name: "s" if name == "time_s" else unit for name in columns},
        result=result,
        alarms=tuple(alarms),
        recommendations=(),
        assumptions=(*notes, BY_LINE, AT_ONCE, *assumptions(next(iter(axes.values())))),
        limits={},
        areas=tuple(_areas(zones, tuple(axes)[:2], start, to)),
    )


def _unit(axes: Mapping[str, AxisLaw]) -> str:
    return next(iter(axes.values())).unit


def _feedrate(axes: Mapping[str, AxisLaw], ways: AxisPoint, far: float, settings: Settings) -> float:
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
    axes: Mapping[str, AxisLaw],
    start: AxisPoint,
    ways: AxisPoint,
    far: float,
    feed: float,
    zones: Sequence[Zone],
) -> tuple[dict[str, MovingAxis], tuple[Zone, float] | None]:
    """Step all axes along the line; returns them, and the zone that stopped them with its moment."""
    courses = {name: MovingAxis(axis) for name, axis in axes.items()}
    ramps = {name: next(iter(axis.ramps.values())) for name, axis in axes.items()}
    rates = [
        ramps[name].acceleration * far / abs(way)
        for name, way in ways.items()
        if way and ramps[name].acceleration
    ]
    for name, way in ways.items():
        share = abs(way) / far
        if share:
            ramp = Ramp("linear", min(rates) * share) if rates else ramps[name]
            courses[name].begin(one(MoveOrder(way, feed * share, ramp)))
    period = max(axis.servo_period for axis in axes.values())
    hit: tuple[Zone, float] | None = None
    while any(course.is_busy for course in courses.values()):
        here = {name: start[name] + course.measured for name, course in courses.items()}
        room = min((zone.room(here) for zone in zones), default=math.inf)
        periods = (
            1
            if hit
            else (
                max(1, min(MOST_PERIODS, int(0.5 * room / (feed * period))))
                if math.isfinite(room)
                else MOST_PERIODS
            )
        )
        for course in courses.values():
            course.advance(periods * period)
        here = {name: start[name] + course.measured for name, course in courses.items()}
        broken = None if hit else next((zone for zone in zones if zone.broken(here)), None)
        if broken is not None:
            hit = broken, max(course.time for course in courses.values())
            for course in courses.values():
                course.begin(one(StopOrder(broken.stop or Ramp())))
        if any(course.is_over for course in courses.values()):
            break
    return courses, hit


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
    for zone in zones:
        if not any(name in zone.sides for name in pair):
            continue
        spans = []
        for name in pair:
            low, high = zone.sides.get(name, (-math.inf, math.inf))
            least, most = reach[name][0] - margin, reach[name][1] + margin
            spans.append((max(low, least), min(high, most)))
        if all(low < high for low, high in spans):
            yield PlaneArea(zone.name, spans[0], spans[1])
