"""How an axis is homed: the one sequence of orders for the scenario `home` and
for the machine behind an emulated control.
"""

from __future__ import annotations

import math
from collections.abc import Generator
from dataclasses import dataclass, field

from amp_studio.sim.command.events import CodedScale, Failure, Homing, Ramp, Surroundings
from amp_studio.sim.rounding import page_text, value_text

from .moving_axis import MovingAxis
from .orders import GoOrder, MoveOrder, Order, Orders, PauseOrder, Seen, StopOrder, Watch

_MARKERS = 5.0
"""Turns after which a marker that does not come is none, where no alarm gives the number."""
_REST_AFTER = 0.1
"""s after the stop on the switch at which the following error is compared with the window
of zero speed (MOT-030)."""
_LOCATE = 5.0
"""Pull-offs in which a second approach searches the switch (grblHAL config.h, HOMING_AXIS_LOCATE_SCALAR)."""
NOT_IN_POSITION = (
    "The axis is never in position: its following error at rest stays above the in-position band, {0};"
    " no alarm is printed for it"
)
_FAR = 1e5
"""Turns in which a coded scale is searched for its next markers."""


@dataclass
class Homed:
    """What a homing has met so far, in u of the machine."""

    left: Seen | None = None
    """Where the switch went off, or came on where the axis goes on over it."""
    overrun: float | None = None
    """How far beyond the edge of the switch the axis stops."""
    marker: float | None = None
    home: float | None = None
    coordinate: float | None = None
    """What the axis is called at ``home``; None where the homing failed."""
    ended: float = 0.0
    """When the last order of a scenario was done, s."""
    alarm: str = ""
    why: str = ""
    stages: list[tuple[str, float, float]] = field(default_factory=list)
    """What was begun, when in s, and how fast in u/s."""

    def begin(self, name: str, axis: MovingAxis, speed: float) -> None:
        """Note that a part of the homing begins now."""
        self.stages.append((name, axis.time, abs(speed)))

    def fail(self, failure: Failure) -> None:
        """Note why it failed."""
        self.alarm, self.why, self.home, self.coordinate = failure.code, failure.message, None, None


def home_axis(axis: MovingAxis, homing: Homing, ramp: Ramp, around: Surroundings, homed: Homed) -> Orders:
    """Yield the orders of a homing from where the axis is at rest; ``homed`` is filled on the way."""
    if homing.scale is not None:
        yield from _coded(axis, homing, homing.scale, ramp, around, homed)
        return
    edge = 0.0
    if homing.approach:
        edge = yield from _onto(axis, homing, ramp, around, homed)
        if homed.alarm or axis.is_over:
            return
    if homing.leave == 0.0:
        homed.marker = axis.measured
        yield from _home(axis, homing, ramp, homed)
        return
    yield from _off(axis, homing, ramp, around, homed, edge)


EdgeFound = Generator[Order, Seen | None, float]


def _onto(axis: MovingAxis, homing: Homing, ramp: Ramp, around: Surroundings, homed: Homed) -> EdgeFound:
    """Go onto the switch; returns the edge over which it is left."""
    sign, edge = math.copysign(1.0, homing.approach), around.switch
    end = edge + sign * around.length
    # An axis that is on its switch already goes straight to leaving it.
    if not sign * (axis.load - edge) >= 0.0 or homing.through:
        none = homing.failures.get("switch")
        way = min(_way(axis, around, sign, homing.turn), none.reach if none else math.inf)
        place = edge
        if (
            sign * (edge - axis.position) > way
        ):  # the axis is at the end of its way when the command has ended
            place, way = sign * math.inf, max(way - axis.behind(homing.approach), 0.0)
        homed.begin("approach", axis, homing.approach)
        seen = yield GoOrder(homing.approach, ramp, Watch(place, sign), way)
        if seen is None:
            if not axis.is_over:
                yield from _failed(
                    homing, "switch", ramp, homed, "No switch comes before the axis is at the end of its way"
                )
            return edge
        if homing.through:
            homed.left = seen
            return edge
    # A control that looks at the following error a moment after the stop does not wait until the axis
    # is in position.
    yield StopOrder(Ramp() if homing.stops_by_switch else ramp, waits=not math.isfinite(homing.rest_window))
    if math.isfinite(homing.rest_window):
        yield PauseOrder(_REST_AFTER)
        if not axis.is_over and abs(axis.position - axis.measured) > homing.rest_window:
            yield from _failed(homing, "moving", ramp, homed, "The axis does not come to rest on the switch")
            return edge
    if homing.pause:
        yield PauseOrder(homing.pause)
    if axis.is_over:
        return edge
    homed.overrun = axis.passed(edge, sign)
    if homing.again:
        yield from _again(axis, homing, ramp, around, homed, edge)
        return edge
    # Back over the edge it came from; only an axis that goes on needs the other one, and a switch long
    # enough.
    if math.copysign(1.0, homing.leave) != sign:
        return edge
    if homed.overrun > around.length:
        text = (
            f"The axis passed the whole switch of {value_text(around.length, axis.axis.unit)} before "
            "it stopped:"
            f" it is too fast for it ({page_text(homing.page)})"
        )
        yield from _failed(homing, "fast", ramp, homed, text)
    return end


def _again(
    axis: MovingAxis, homing: Homing, ramp: Ramp, around: Surroundings, homed: Homed, edge: float
) -> Orders:
    """Back off and come onto the switch slowly, as often as asked; after a pull-off stop there at once."""
    sign, back = math.copysign(1.0, homing.approach), homing.pull_off
    far = _LOCATE * back if back else abs(axis.position - edge) + _MARKERS * homing.turn
    for _ in range(homing.passes):
        homed.begin("back", axis, homing.approach)
        if back:
            yield MoveOrder(axis.position - sign * back, abs(homing.approach), ramp)
        else:
            off_at = sign * -math.inf if around.is_stuck else edge
            yield GoOrder(-homing.approach, ramp, Watch(off_at, -sign), far)
            yield StopOrder(ramp)
            yield PauseOrder(homing.pause)
        if around.is_stuck or sign * (axis.load - edge) >= 0.0:
            off = f"The switch does not go off within {value_text(back or far, axis.axis.unit)}"
            # A later pass replaces the edge that an earlier one found.
            yield from _failed(homing, "stuck", ramp, homed, off)
            return
        homed.begin("again", axis, homing.again)
        homed.left = yield GoOrder(sign * abs(homing.again), ramp, Watch(edge, sign), far)
        if homed.left is None:
            yield from _failed(homing, "switch", ramp, homed, "The switch does not come on again")
            return
        if back:
            yield StopOrder(Ramp())


def _off(
    axis: MovingAxis, homing: Homing, ramp: Ramp, around: Surroundings, homed: Homed, edge: float
) -> Orders:
    """Leave the switch over ``edge``, go to the marker and to the home position."""
    if homing.approach and homed.left is None:
        yield from _left(axis, homing, ramp, around, homed, edge)
        if homed.left is None:
            return
    # The place where the switch went off, not where the axis is by now.
    start = homed.left.measured if homed.left else axis.measured
    if homing.marker == "nearest":
        yield StopOrder(ramp)
        if not around.has_markers:
            yield from _failed(homing, "marker", ramp, homed, "No marker is near the end of the switch")
            return
        homed.marker = around.marker + homing.turn * round((start - around.marker) / homing.turn)
    elif homing.marker == "next":
        yield from _next_marker(axis, homing, ramp, around, homed, start)
        if homed.marker is None:
            return
    elif homing.again and homing.pull_off:
        homed.marker = axis.position
    else:
        homed.marker = start
        yield StopOrder(ramp)
    yield from _home(axis, homing, ramp, homed)


def _home(axis: MovingAxis, homing: Homing, ramp: Ramp, homed: Homed) -> Orders:
    """Go from the marker, or the place that counts as one, to the home position."""
    assert homed.marker is not None
    homed.home = homed.marker + homing.offset
    if homing.final:
        homed.begin("final", axis, homing.final)
        yield MoveOrder(homed.home, homing.final, ramp)
    homed.coordinate = homing.coordinate


def _left(
    axis: MovingAxis, homing: Homing, ramp: Ramp, around: Surroundings, homed: Homed, edge: float
) -> Orders:
    """Leave the switch; ``found.left`` stays None where it does not go off."""
    sign, stuck = math.copysign(1.0, homing.leave), homing.failures.get("stuck")
    reach = min(_way(axis, around, sign, homing.turn), stuck.reach if stuck else math.inf)
    # The edge is known here: the axis goes a little past it; a stuck switch is left for as far as
    # the control tries.
    way = reach if around.is_stuck else abs(axis.position - edge) + _MARKERS * homing.turn
    if not around.is_stuck and stuck and abs(axis.position - edge) > stuck.reach:
        way = stuck.reach
    place = sign * math.inf if around.is_stuck else edge
    homed.begin("leave", axis, homing.leave)
    homed.left = yield GoOrder(homing.leave, ramp, Watch(place, sign), way)
    if homed.left is None and not axis.is_over:
        yield from _failed(homing, "stuck", ramp, homed, "The axis does not leave the switch")


def _next_marker(
    axis: MovingAxis, homing: Homing, ramp: Ramp, around: Surroundings, homed: Homed, start: float
) -> Orders:
    """Go on to the next marker and stop; ``found.marker`` stays None where none comes."""
    sign, turn, missing = math.copysign(1.0, homing.leave), homing.turn, homing.failures.get("marker")
    least = start + sign * homing.skipped * turn
    # The first marker strictly beyond: one exactly at the edge has been passed.
    turns = math.floor(sign * (least - around.marker) / turn) + 1
    marker = around.marker + sign * turns * turn
    far = min(missing.reach if missing else _MARKERS * turn, _way(axis, around, sign, turn))
    # A marker that the control would not wait for never comes for it.
    place = marker if around.has_markers and sign * (marker - start) <= far else sign * math.inf
    speed = math.copysign(homing.search or abs(homing.leave), homing.leave)
    homed.begin("search", axis, speed)
    if (yield GoOrder(speed, ramp, Watch(place, sign, device=True), far)) is not None:
        homed.marker = marker
        yield StopOrder(ramp)
    elif not axis.is_over:
        yield from _failed(homing, "marker", ramp, homed, "No marker comes")


def _coded(
    axis: MovingAxis, homing: Homing, scale: CodedScale, ramp: Ramp, around: Surroundings, homed: Homed
) -> Orders:
    """Pass three markers of a coded scale, stop, take its position, and go to the home position (5-5,
    5-14).
    """
    sign = math.copysign(1.0, homing.leave)
    here = around.scale + axis.measured
    passed = markers_ahead(scale, here, sign)[scale.markers - 1]
    place = passed - around.scale
    if sign * (place - (around.high if sign > 0.0 else around.low)) > 0.0 or not around.has_markers:
        place = sign * math.inf
    # In each period there is a marker, so that one more period than markers is enough.
    way = min(_way(axis, around, sign, scale.large), (scale.markers + 1) * scale.large)
    homed.begin("search", axis, homing.leave)
    seen = yield GoOrder(homing.leave, ramp, Watch(place, sign, device=True), way)
    if seen is None:
        if not axis.is_over:
            yield from _failed(
                homing, "marker", ramp, homed, f"The axis does not pass {scale.markers} markers in a row"
            )
        return
    homed.marker = place
    yield StopOrder(ramp)
    homed.home = homing.coordinate - scale.zero - around.scale
    if homing.final:
        homed.begin("final", axis, homing.final)
        yield MoveOrder(homed.home, homing.final, ramp)
    homed.coordinate = homing.coordinate


def markers_ahead(scale: CodedScale, here: float, sign: float) -> list[float]:
    """Return the next markers of a coded scale beyond a place, in u of the scale: odd and even ones in
    turn.
    """
    # Four periods back and six on are enough: three or four markers are two periods at most.
    around = math.floor(here / scale.large)
    places = [
        place
        for i in range(around - 4, around + 6)
        for place in (i * scale.small, scale.first + i * scale.large)
        if sign * (place - here) > 0.0
    ]
    return sorted(places, key=lambda place: sign * place)


def _way(axis: MovingAxis, around: Surroundings, sign: float, turn: float) -> float:
    """Return how far the axis can go in a direction, u."""
    end = around.high if sign > 0.0 else around.low
    if math.isfinite(end):
        return max(sign * (end - axis.position), 0.0)
    # No end of the way is known: a little beyond the switch, or as far as a coded scale is searched.
    return abs(around.switch - axis.position) + 2.0 * turn if math.isfinite(around.switch) else _FAR * turn


def _failed(homing: Homing, which: str, ramp: Ramp, homed: Homed, text: str) -> Orders:
    """StopOrder, and note the alarm of the control for it."""
    yield StopOrder(ramp)
    homed.fail(homing.failures.get(which, Failure("HOME", f"{text}: no alarm is printed for it")))
