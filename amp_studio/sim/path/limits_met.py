"""Where a program meets limits of travel, and zones that are on."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass

import numpy as np

from amp_studio.programs import ToolPath
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import AxisLaw, BoundMachine
from amp_studio.sim.path_rules import Indices, PathRows
from amp_studio.sim.rounding import page_text
from amp_studio.sim.zones import EPSILON, Zone

from .geometry import plane_columns
from .planner import ProgramPlan
from .profiles import path_points

_BEYOND = 1e-6
"""u: an axis on its limit is not beyond it."""
_QUARTER = 0.5 * math.pi
_ON_ARC = 1e-3
"""u between an arc and the straight pieces that are checked against zones."""


@dataclass(frozen=True)
class PathAlarm:
    """Where a program meets a limit, or the control stops it."""

    line: int
    time_s: float
    code: str
    message: str


class LimitsWatch:
    """Finds the first row of a path that leaves each limit of travel, a stretch after the other."""

    def __init__(self, axes: Sequence[AxisLaw]) -> None:
        self._axes = axes
        self._met: dict[tuple[int, str], PathAlarm] = {}
        """Axis and limit -> its alarm."""

    @property
    def alarms(self) -> list[PathAlarm]:
        """What was met, axis by axis."""
        return [self._met[key] for key in sorted(self._met, key=lambda key: key[0])]

    def look(self, plan: ProgramPlan) -> None:
        """Look at one more stretch."""
        least, most = _extent(plan, plan.path)
        for n, axis in enumerate(self._axes):
            if axis.travel is None or not len(least) or not plan.path.zero_known:
                continue
            # The limits of an axis whose figures are missing are not known; the others are checked.
            with suppress(SimulationError):
                for title, alarm in _beyond(plan, axis, n, (least[:, n], most[:, n])):
                    self._met.setdefault((n, title), alarm)


def _beyond(
    plan: ProgramPlan, axis: AxisLaw, n: int, extent: tuple[PathRows, PathRows]
) -> Iterator[tuple[str, PathAlarm]]:
    """Yield each limit of an axis that a stretch leaves, and its alarm; raises SimulationError."""
    assert axis.travel is not None
    travel, path, (least, most) = axis.travel(), plan.path, extent
    for title, (low, high) in travel.limits.items():
        beyond = (least < low - _BEYOND) | (most > high + _BEYOND)
        if beyond.any():
            row = int(np.argmax(beyond))
            is_low = bool(least[row] < low - _BEYOND)
            edge, place = (low, least[row]) if is_low else (high, most[row])
            ends_inside = low - _BEYOND <= plan.geometry.ends[row, n] <= high + _BEYOND
            is_refused = (travel.refuses or travel.reads_ahead) and not (travel.begins_arcs and ends_inside)
            begun = "the block is not begun" if is_refused else "the axis stops there"
            # A control that reads ahead refuses the block: it has another alarm than an axis that arrives
            # at a limit.
            code = travel.reads_ahead or (travel.alarm_negative if is_low else "") or travel.alarm
            yield (
                title,
                PathAlarm(
                    int(path.line[plan.geometry.row[row]]),
                    float(plan.start[row]),
                    code,
                    f"{path.axes[n]} would go to {place:.6g} {axis.unit}, beyond {title} at {edge:.6g}"
                    f" {axis.unit}: {begun} ({page_text(travel.page)})",
                ),
            )


def _extent(plan: ProgramPlan, path: ToolPath) -> tuple[PathRows, PathRows]:
    """Return the least and the greatest place of every axis in every row."""
    geometry = plan.geometry
    least, most = np.minimum(geometry.begins, geometry.ends), np.maximum(geometry.begins, geometry.ends)
    arcs = np.flatnonzero(geometry.is_arc)
    if not len(arcs):
        return least, most
    rows = geometry.row[arcs]
    columns = plane_columns(path)[path.plane[rows]]
    begins = np.take_along_axis(geometry.begins[arcs], columns, axis=1) - path.center[rows]
    begun = np.arctan2(begins[:, 1], begins[:, 0])
    sweep = path.sweep[rows]
    low, high = np.minimum(begun, begun + sweep), np.maximum(begun, begun + sweep)
    # An arc is farthest out at one of its ends or where it is parallel to an axis: at the multiples of 90°
    # that it passes, of which a whole turn has five at most.
    quarters = np.ceil(low / _QUARTER)[:, None] + np.arange(5)
    turned = _QUARTER * quarters
    is_passed = quarters <= np.floor(high / _QUARTER)[:, None]
    for n, way in enumerate((np.cos(turned), np.sin(turned))):
        place = path.center[rows, n, None] + geometry.radius[arcs, None] * way
        at = arcs, columns[:, n]
        least[at] = np.minimum(least[at], np.where(is_passed, place, math.inf).min(axis=1))
        most[at] = np.maximum(most[at], np.where(is_passed, place, -math.inf).max(axis=1))
    return least, most


@dataclass(frozen=True)
class GuardedBox:
    """A zone, or the limits of travel, in the axes of a path."""

    name: str
    sides: dict[str, tuple[float, float]]
    """Letter of an axis -> (least, greatest) u."""
    keeps_in: bool
    """Whether it is the limits of travel."""


def guarded_boxes(path: ToolPath, machine: BoundMachine, axes: Sequence[AxisLaw]) -> tuple[GuardedBox, ...]:
    """Return the limits of travel, and the zones that are on at power-up or in the program."""
    if not path.zero_known:
        return ()
    boxes: list[GuardedBox] = []
    for letter, axis in zip(path.axes, axes, strict=True):
        with suppress(SimulationError):
            limits = axis.travel().limits if axis.travel is not None else {}
            boxes += [GuardedBox(title, {letter: edges}, keeps_in=True) for title, edges in limits.items()]
    return (*boxes, *_zone_boxes(path, machine))


def _zone_boxes(path: ToolPath, machine: BoundMachine) -> Iterator[GuardedBox]:
    for zone in machine.law.zones(machine, machine.fitted) if machine.law.zones else ():
        if any(_is_on(zone, numbers) for numbers in path.zone_sets):
            sides = {machine.letter(axis) or axis: side for axis, side in zone.sides.items()}
            yield GuardedBox(zone.name, sides, keeps_in=False)


class ZonesWatch:
    """Finds the first place where a path breaks each zone that is on there, a stretch after the other."""

    def __init__(self, machine: BoundMachine) -> None:
        self._machine = machine
        self._zones = tuple(machine.law.zones(machine, machine.fitted)) if machine.law.zones else ()
        self._met: dict[int, PathAlarm] = {}
        self._guards: dict[int, str] = {}
        """Zone -> what it guards since it was switched on; none while it is off."""

    @property
    def alarms(self) -> list[PathAlarm]:
        """What was met, zone by zone."""
        return [self._met[n] for n in sorted(self._met)]

    def look(self, plan: ProgramPlan) -> None:
        """Look at one more stretch."""
        if not self._zones or not plan.path.zero_known or not len(plan.start):
            return
        points, rows = path_points(plan, _ON_ARC)
        for n, zone in enumerate(self._zones):
            if n not in self._met:
                self._look_at(n, zone, plan, (points, rows))

    def _look_at(self, n: int, zone: Zone, plan: ProgramPlan, outline: tuple[PathRows, Indices]) -> None:
        path, (points, rows) = plan.path, outline
        sides = {
            path.axes.index(letter): side
            for axis, side in zone.sides.items()
            if (letter := self._machine.letter(axis) or axis) in path.axes
        }
        if not sides:
            return
        is_on = np.array([_is_on(zone, numbers) for numbers in path.zone_sets])[
            path.zones[plan.geometry.row[rows]]
        ][1:]
        for first, last in _stretches(is_on):
            # A zone that was on at the end of the stretch before guards what it has guarded.
            guard = self._guards.get(n) if first == 0 else None
            guard = guard or _guard_at(zone, {str(axis): float(points[first, axis]) for axis in sides}, sides)
            self._guards[n] = guard
            ends = points[first : last + 1]
            enters = _entered(sides, ends[:-1], ends[1:], keeps_in=guard == "inside")
            hit = np.flatnonzero(enters <= 1.0)
            if len(hit):
                piece = first + int(hit[0])
                place = points[piece] + float(enters[hit[0]]) * (points[piece + 1] - points[piece])
                self._met[n] = _zone_alarm(plan, zone, int(rows[piece + 1]), {a: place[a] for a in sides})
                return
        if not is_on[-1]:
            self._guards.pop(n, None)


def _guard_at(zone: Zone, begin: dict[str, float], sides: dict[int, tuple[float, float]]) -> str:
    """Return what a zone that is switched on at a place guards."""
    named = {str(axis): side for axis, side in sides.items()}
    return Zone(zone.name, named, zone.guard, True, zone.code).settled(begin).guard


def _zone_alarm(plan: ProgramPlan, zone: Zone, row: int, place: dict[int, float]) -> PathAlarm:
    where = ", ".join(f"{plan.path.axes[axis]} {each:.6g}" for axis, each in place.items())
    effect = "the block is not begun" if zone.reads_ahead or zone.refuses else "the axes stop there"
    return PathAlarm(
        int(plan.path.line[plan.geometry.row[row]]),
        float(plan.start[row]),
        zone.reads_ahead or zone.code,
        f"{zone.name} is met at {where}: {effect} ({page_text(zone.page)})",
    )


def _is_on(zone: Zone, numbers: tuple[str, ...] | None) -> bool:
    """Return whether a zone is on; without numbers of the program as at power-up."""
    if numbers is None:
        return zone.is_on
    return any(zone.has_number(number) for number in numbers)


def _stretches(is_on: np.ndarray) -> Iterator[tuple[int, int]]:
    """Yield (first, last) point of each run of pieces in which a zone is on."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], is_on, [False]]).astype(np.int8)))
    yield from zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True)


def _entered(
    sides: dict[int, tuple[float, float]], begins: PathRows, ends: PathRows, *, keeps_in: bool
) -> PathRows:
    """Return at which share of each piece it breaks a box, above 1 where it does not."""
    # The slabs of a box, side by side: a piece is in it from where it has entered the last slab to where it
    # leaves the first. Out of reach is 2.0 for a share that is never met and -1.0 for one that is always
    # over; an axis that rests is in its slab for the whole piece, or never.
    low_share, high_share = np.zeros(len(begins)), np.ones(len(begins))
    left = np.full(len(begins), math.inf)
    for n, (low, high) in sides.items():
        begin, way = begins[:, n], ends[:, n] - begins[:, n]
        moves = np.abs(way) > EPSILON
        scale = np.where(moves, way, 1.0)
        # A hair inside both sides: a path along the side of a zone is not in it.
        one, two = (low + EPSILON - begin) / scale, (high - EPSILON - begin) / scale
        inside = (begin > low + EPSILON) & (begin < high - EPSILON)
        enters = np.where(moves, np.minimum(one, two), np.where(inside, 0.0, 2.0))
        leaves = np.where(moves, np.maximum(one, two), np.where(inside, 1.0, -1.0))
        low_share, high_share = np.maximum(low_share, enters), np.minimum(high_share, leaves)
        # Limits of travel keep the axes in: broken by a piece that ends beyond, where it leaves the side.
        beyond = (ends[:, n] < low - _BEYOND) | (ends[:, n] > high + _BEYOND)
        left = np.where(beyond, np.minimum(left, np.clip(leaves, 0.0, 1.0)), left)
    rows: PathRows = left if keeps_in else np.where(low_share < high_share, low_share, 2.0)
    return rows
