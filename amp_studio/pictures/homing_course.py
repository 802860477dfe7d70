"""The course of a simulated homing: speed over position, with switch, markers, stages and home position."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from statistics import fmean
from typing import Literal

import numpy as np

from amp_studio.drawing import Dot, FilledArea, PictureNote, Point, Polyline, Scale, Scene, Text
from amp_studio.files import ParameterFile
from amp_studio.sim import HomingCourse, HomingStage, Trace, address_of, value_text

Anchor = Literal["left", "right", "middle", "above", "below"]
_STAGES = {
    "approach": "to the switch",
    "back": "back off the switch",
    "again": "slowly onto the switch",
    "leave": "off the switch",
    "search": "to the marker",
    "final": "to the home position",
}
_MARGIN = 0.06
"""Share of the picture that is left free at each side."""
_MAX_POINTS, _MAX_MARKERS = 120, 60
"""Points of a stage, and markers, that a picture has room for."""
FREE = 0.3
"""How far a switch that stays on is drawn, in lengths of the way."""


@dataclass(frozen=True)
class _Way:
    """A homing from where its switch comes on, or from its start without one."""

    trace: Trace
    course: HomingCourse

    @property
    def origin(self) -> float:
        return self.course.switch[0] if self.course.switch else 0.0

    @cached_property
    def points(self) -> list[Point]:
        """Position and speed of every row."""
        place, speed = (self.trace.columns[name] for name in ("position", "velocity"))
        return list(zip((place - self.origin).tolist(), speed.tolist(), strict=True))

    @property
    def sign(self) -> float:
        """The direction in which the axis comes onto its switch."""
        return -1.0 if self.course.switch and self.course.switch[0] < 0.0 else 1.0

    @property
    def length(self) -> float:
        """Of the switch, on the way over it; infinite where it stays on."""
        switch = self.course.switch
        return abs(switch[1] - switch[0]) if switch else math.inf

    @property
    def past(self) -> float:
        """How far the axis comes over the edge at which the switch comes on."""
        return max(self.sign * place for place, _ in self.points)

    def stage(self, n: int) -> list[Point]:
        """Return the points of a stage, and the first one of the next."""
        begins = [stage.begin for stage in self.course.stages] + [math.inf]
        time = self.trace.columns["time_s"]
        # One row earlier and one later: the lines of two stages meet.
        first, last = (int(np.searchsorted(time, begins[k])) for k in (n, n + 1))
        found = self.points[max(first - 1, 0) : last + 1]
        step = max(1, len(found) // _MAX_POINTS)
        # The mean of some rows: one of them would show the counts of its position device as a ripple.
        means = [
            (fmean(place for place, _ in some), fmean(speed for _, speed in some))
            for some in (found[k : k + step] for k in range(1, len(found), step))
        ]
        return [*found[:1], *means, *found[-1:]]


def draw_homing(file: ParameterFile, trace: Trace) -> Scene:
    """Return the picture of a trace of `home`; raises ValueError for another one."""
    course = trace.course
    if course is None:
        raise ValueError(f"{trace.scenario} is no homing")
    way = _Way(trace, course)
    x, y = _scales(way)
    shapes = _Shapes(way, x, y)
    grid = trace.result.get("home_grid", (None, ""))[0]
    parts = ["speed over position"]
    if grid is not None:
        parts.append(f"marker {grid:.0f} % of a turn from the switch")
    return Scene(
        "home",
        trace.axis,
        f"Homing {trace.letter or trace.axis}",
        ", ".join(parts),
        x,
        y,
        areas=tuple(shapes.areas()),
        lines=tuple(shapes.lines()),
        dots=tuple(shapes.dots()),
        texts=tuple(shapes.texts(file)),
        notes=tuple(_notes(way)),
    )


def _scales(way: _Way) -> tuple[Scale, Scale]:
    """Return the scales of position and speed, with room for the switch and the home position."""
    course, unit = way.course, way.course.unit
    places = [place for place, _ in way.points]
    speeds = [speed for _, speed in way.points]
    long = max(places) - min(places) or 1.0
    if course.switch:
        places += [0.0, way.sign * min(way.length, way.past + FREE * long)]
    if course.home is not None:
        places.append(course.home - way.origin)
    low, high = min(places), max(places)
    tall = max(speeds) - min(speeds) or 1.0
    label = "position from the switch" if course.switch else "position from the start"
    return (
        Scale(label, unit, low - _MARGIN * (high - low), high + _MARGIN * (high - low)),
        Scale("speed", f"{unit}/min", min(0.0, *speeds) - 0.2 * tall, max(0.0, *speeds) + 0.2 * tall),
    )


@dataclass(frozen=True)
class _Shapes:
    way: _Way
    x: Scale
    y: Scale

    def areas(self) -> Iterator[FilledArea]:
        if self.way.course.switch:
            end = self.x.high if self.way.sign > 0.0 else self.x.low
            left, right = sorted((0.0, self._end if math.isfinite(self.way.length) else end))
            yield FilledArea(left, self.y.low, right, self.y.high, "overlap")

    @property
    def _end(self) -> float:
        return self.way.sign * self.way.length

    def _upright(self, at: float) -> tuple[Point, Point]:
        return (at, self.y.low), (at, self.y.high)

    def lines(self) -> Iterator[Polyline]:
        yield Polyline(((self.x.low, 0.0), (self.x.high, 0.0)), "limit")
        if self.way.course.switch:
            yield Polyline(self._upright(0.0))
            if math.isfinite(self.way.length):
                yield Polyline(self._upright(self._end))
        if self.way.past > self.way.length:
            yield Polyline(self._upright(self.way.sign * self.way.past), "error", dashed=True)
        for n in range(len(self.way.course.stages)):
            yield Polyline(tuple(self.way.stage(n)), "now", dashed=n == 1, dotted=n > 1)

    def markers(self) -> list[float]:
        """Return the markers in the picture, at most those nearest to the way home."""
        course = self.way.course
        if course.marker is None or not course.turn:
            return []
        first = course.marker - self.way.origin
        low, high = (
            math.ceil((self.x.low - first) / course.turn),
            math.floor((self.x.high - first) / course.turn),
        )
        # A short turn has thousands of markers in a long picture; number 0 is the one of the homing.
        if high - low >= _MAX_MARKERS:
            low, high = max(low, -_MAX_MARKERS // 2), min(high, _MAX_MARKERS // 2)
        return [first + n * course.turn for n in range(low, high + 1)]

    def dots(self) -> Iterator[Dot]:
        for at in self.markers():
            yield Dot((at, 0.0), "end")
        if self.way.course.home is not None:
            yield Dot((self.way.course.home - self.way.origin, 0.0), "home")

    def texts(self, file: ParameterFile) -> Iterator[Text]:
        course, unit = self.way.course, self.way.course.unit
        if course.home is not None:
            at = course.home - self.way.origin
            yield Text((at, 0.0), "home", value_text(course.coordinate, unit), "below")
        numbers: dict[str, int] = {}
        for n, stage in enumerate(course.stages):
            # A stage that comes again, as in a homing of two passes, has its name and number once.
            if stage.name not in numbers:
                numbers[stage.name] = len(numbers) + 1
                yield self._of_stage(file, stage, n, numbers[stage.name])
        if self.way.past > self.way.length:
            past = value_text(self.way.past - self.way.length, unit, 3)
            yield Text(
                (self.way.sign * self.way.past, 0.8 * self.y.high), "past it", past, "left", None, "error"
            )
        if course.switch:
            known = math.isfinite(self.way.length)
            long = value_text(self.way.length, unit) if known else "stays on"
            middle = 0.5 * self._end if known else 0.0
            beside: Anchor = "middle" if known else "left" if self.way.sign > 0.0 else "right"
            yield Text((middle, 0.93 * self.y.high), "switch", long, beside)
        if markers := self.markers():
            about = f"one a turn of {value_text(course.turn, unit)}"
            yield Text((markers[len(markers) // 2], 0.0), "marker", about, "below", None, "dim")

    def _of_stage(self, file: ParameterFile, stage: HomingStage, n: int, number: int) -> Text:
        """Return the text of a stage, at the middle of where it is at its speed."""
        points = self.way.stage(n)
        fastest = max(abs(speed) for _, speed in points)
        # Where the speed is even there is a place for a text, and its figure is that of the line.
        even = [point for point in points if abs(point[1]) >= 0.95 * fastest]
        at = even[len(even) // 2]
        speed = value_text(stage.speed, f"{self.way.course.unit}/min")
        address = address_of(file, stage.parameter, self.way.trace.axis) if stage.parameter else None
        called = file.machine_schema.number(address) if address else ""
        detail = f"{called} at {speed}" if called else speed
        side: Anchor = "above" if at[1] >= 0.0 else "below"
        return Text(at, f"{number} {_STAGES[stage.name]}", detail, side, address, "now")


def _notes(way: _Way) -> Iterator[PictureNote]:
    if way.course.switch and not math.isfinite(way.length):
        yield PictureNote("How long the switch stays on is no value of this file.", is_remark=True)
    for alarm in way.trace.alarms:
        yield PictureNote(alarm.message, wrong=True)
