"""Scenario `home`: onto the switch, off it, to the marker and to the home position, as the control does
it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from amp_studio.sim.axis.homing import NOT_IN_POSITION, Homed, home_axis
from amp_studio.sim.axis.motion import Motion
from amp_studio.sim.axis.moving_axis import MovingAxis
from amp_studio.sim.axis.simulated_machine import switch_ahead
from amp_studio.sim.command.events import Homing, Surroundings
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import AxisLaw, Ramp
from amp_studio.sim.model import assumptions
from amp_studio.sim.rounding import page_text, rounded_down, value_text
from amp_studio.sim.scenario import Scenario, ScenarioSettings, above_zero, direction, number, refuse_unknown
from amp_studio.sim.trace import Alarm, Figure, HomingCourse, HomingStage, Recommendation, Trace

from .columns import alarms_of, column_units, per_minute

_SETTINGS = {
    "move.direction": (
        "plus or minus, where no printed parameter gives the direction; default: that of the file, or plus"
    ),
    "move.switch": (
        "distance from the start to the home switch (mm or deg); default: enough to reach the homing speed,"
        " at most half of the way that is searched"
    ),
    "move.switch_length": "how long the switch stays on (mm or deg); default: to the end of the travel",
    "move.marker": (
        "distance from the end of the switch to a marker, in the direction off the switch (mm or deg), or"
        " none; default: a quarter turn"
    ),
    "move.turn": "from one marker to the next (mm or deg); default: that of the file, or the assumed one",
    "move.dog": "stuck for a switch that never goes off; default: one that works",
    "move.travel": (
        "how far the axis can go from the start towards the switch (mm or deg); default: as far as the switch"
    ),
    "move.scale": "place of the start on a distance-coded scale (mm or deg); default: 5.3 periods",
    "move.homings": "how often the axis is homed, for the repeatability; default: 1",
    "move.scatter": (
        "by how much the switch comes on at another place each time, at most (mm or deg); default: 0"
    ),
}
_OF_SWITCH = ("move.switch", "move.switch_length", "move.dog")
_SETTLE = 8.0
"""Time constants of the position loop after the last order, as for a tap."""
_QUARTER = 0.25
DOUBTFUL = 0.45
"""Share of a turn between switch and nearest marker from which a sample more or less may take another
marker."""
_MAX_TURNS = 100.0
"""Turns from the switch to the marker that is given."""
_MAX_HOMINGS = 100
_ON_SCALE = 5.3
"""Periods of a coded scale from its zero to the start."""
_HALVINGS = 7
"""Of the speed at which an axis passes its switch: 1 % of it is near enough."""
_OF_THE_SWITCH = 0.8
"""Share of the switch on which the axis stops at the speed that is recommended."""
_GOLDEN = 0.6180339887498949
"""Shares of the scatter come evenly: the multiples of the golden ratio without their whole part (van der
Corput's idea)."""
SEEN = (
    "ASSUMED: switch and marker are seen at the servo sample after they change; logic and input filters,"
    " which no manual here times, come later."
)


def _run_home(axis: AxisLaw, settings: ScenarioSettings) -> Trace:
    """Home an axis, as often as asked; raises SimulationError for impossible settings."""
    refuse_unknown(settings, _SETTINGS)
    if axis.homing is None:
        raise SimulationError(f"Axis {axis.axis} is not homed by a sequence that is printed")
    homing = axis.homing()
    turn = above_zero(settings, "move.turn")
    homing = homing if turn is None else replace(homing, turn=turn)
    if homing.direction_lost:
        homing = _turned(homing, settings)
    elif settings.get("move.direction") is not None:
        raise SimulationError(
            "The direction of homing is in the file: leave out move.direction", "move.direction"
        )
    _refuse_switch(axis, homing, settings)
    ramp = homing.ramp or _usual_ramp(axis)
    around = _around(axis, homing, ramp, settings)
    moving, found = _homed(axis, homing, ramp, around)
    motion = moving.motion()
    alarms = alarms_of(axis, motion)
    others = [_homed(axis, homing, ramp, each)[1] for each in _scattered(around, homing, settings)]
    if not found.alarm:
        _compare(homing, found, others)
    if not alarms and found.home is None and not found.alarm:
        found.alarm, found.why = "HOME", NOT_IN_POSITION.format(value_text(axis.inposition_band, axis.unit))
    if found.alarm:
        alarms = (Alarm(found.alarm, float(motion.columns["time_s"][-1]), found.why), *alarms)
    return Trace(
        scenario="home",
        axis=axis.axis,
        model=axis.title,
        columns=per_minute(motion.columns),
        units=column_units(axis),
        result=_figures(axis, homing, found, others, motion, bool(alarms)),
        alarms=alarms,
        recommendations=tuple(_slower(axis, homing, ramp, around, found)),
        assumptions=(*_doubts(axis, homing, around, found), SEEN, *homing.notes, *assumptions(axis)),
        limits={"inposition band": (axis.inposition_band, axis.unit)},
        move={"move.switch": abs(around.switch)} if homing.approach else {},
        course=_course(axis, homing, around, found),
    )


def _course(axis: AxisLaw, homing: Homing, around: Surroundings, found: Homed) -> HomingCourse:
    """Return what was on the way, for the picture."""
    sign = math.copysign(1.0, homing.approach)
    switch = around.switch, math.inf if around.is_stuck else around.switch + sign * around.length
    counts = homing.marker != "none" and around.has_markers and homing.scale is None
    return HomingCourse(
        stages=tuple(
            HomingStage(name, begin, speed * 60.0, homing.speeds.get(name) or _as_left(homing, name))
            for name, begin, speed in found.stages
        ),
        switch=switch if homing.approach else None,
        marker=around.marker if counts else None,
        turn=homing.turn,
        home=found.home,
        coordinate=homing.coordinate,
        unit=axis.unit,
    )


def _as_left(homing: Homing, stage: str) -> str:
    """Return what sets the speed of a search that goes on as the axis left, or came over, its switch."""
    if stage != "search" or homing.search:
        return ""
    return homing.speeds.get("leave", "")


def _slower(
    axis: AxisLaw, homing: Homing, ramp: Ramp, around: Surroundings, found: Homed
) -> Iterator[Recommendation]:
    """Yield the approach at which an axis that passed its whole switch stops on it."""
    parameter = homing.speeds.get("approach")
    if parameter is None or not found.alarm or found.overrun is None or found.overrun <= around.length:
        return
    slow, fast = 0.0, abs(homing.approach)
    # Halved again and again: the overrun grows with the speed, but by no formula that every ramp has.
    for _ in range(_HALVINGS):
        middle = 0.5 * (slow + fast)
        tried = _homed(axis, replace(homing, approach=math.copysign(middle, homing.approach)), ramp, around)[
            1
        ]
        stops = tried.overrun is not None and tried.overrun <= _OF_THE_SWITCH * around.length
        slow, fast = (middle, fast) if stops else (slow, middle)
    if slow > 0.0:
        long = value_text(around.length, axis.unit)
        why = f"At this speed the axis stops on its switch of {long} with a fifth of it to spare"
        yield Recommendation(parameter, rounded_down(slow * 60.0, 2), f"{axis.unit}/min", why)


def _refuse_switch(axis: AxisLaw, homing: Homing, settings: ScenarioSettings) -> None:
    """Raise SimulationError for a setting of a switch that the sequence does not go to."""
    for name in _OF_SWITCH:
        if settings.get(name) is not None and not homing.approach:
            raise SimulationError(
                f"Axis {axis.axis} is homed without a switch ({page_text(homing.page)}): leave out {name}",
                name,
            )


def _usual_ramp(axis: AxisLaw) -> Ramp:
    return axis.manual_ramp(True) if axis.manual_ramp else next(iter(axis.ramps.values()))


def _homed(axis: AxisLaw, homing: Homing, ramp: Ramp, around: Surroundings) -> tuple[MovingAxis, Homed]:
    moving, found = MovingAxis(axis), Homed()
    moving.follow(home_axis(moving, homing, ramp, around, found))
    found.ended = moving.time
    if (
        not moving.is_over
    ):  # in position is not yet at rest: a wide window ends a homing counts before its place
        moving.advance(_SETTLE / axis.position_rate)
    return moving, found


def _turned(homing: Homing, settings: ScenarioSettings) -> Homing:
    """Return the sequence in the direction that is asked for."""
    sign = direction(settings)
    is_other = sign is not None and ((homing.approach or homing.leave) < 0.0) != (sign < 0.0)
    return homing.turned() if is_other else homing


def _around(axis: AxisLaw, homing: Homing, ramp: Ramp, settings: ScenarioSettings) -> Surroundings:
    """Return where switch, markers and the end of the way are, from the start;
    raises SimulationError for impossible ones.
    """
    length, travel = above_zero(settings, "move.switch_length"), above_zero(settings, "move.travel")
    given, has_markers = _marker(axis, homing, settings)
    if settings.get("move.dog") not in (None, "stuck"):
        raise SimulationError("move.dog must be stuck, or be left out", "move.dog")
    sign = math.copysign(1.0, homing.approach or homing.leave or 1.0)
    around = Surroundings(
        length=length or math.inf,
        has_markers=has_markers,
        is_stuck=settings.get("move.dog") == "stuck",
        scale=_on_scale(homing, settings),
        low=-math.inf if travel is None or sign > 0.0 else -travel,
        high=math.inf if travel is None or sign < 0.0 else travel,
    )
    if homing.approach:
        asked = above_zero(settings, "move.switch")
        around = replace(around, switch=sign * (asked or switch_ahead(axis, homing, ramp)))
    edge = _left_edge(homing, around, sign) if homing.approach else 0.0
    off = math.copysign(1.0, homing.leave)
    return replace(around, marker=edge + off * (_QUARTER * homing.turn if given is None else given))


def _left_edge(homing: Homing, around: Surroundings, sign: float) -> float:
    """Return the edge of the switch at which the axis leaves it: the nearer one, or that behind its length;
    raises SimulationError where that length is not given.
    """
    if math.copysign(1.0, homing.leave) != sign or homing.through or homing.again:
        return around.switch
    if around.length == math.inf:
        raise SimulationError(
            "The axis leaves the switch in the direction in which it came: give move.switch_length",
            "move.switch_length",
        )
    return around.switch + sign * around.length


def _marker(axis: AxisLaw, homing: Homing, settings: ScenarioSettings) -> tuple[float | None, bool]:
    """Return the distance to a marker, None if none is given, and whether there are markers."""
    if settings.get("move.marker") == "none":
        return None, False
    given = number(settings, "move.marker")
    if given is not None and abs(given) > _MAX_TURNS * homing.turn:
        raise SimulationError(
            f"move.marker is {given:g}; give the distance to a marker near the switch, a turn is"
            f" {value_text(homing.turn, axis.unit)}",
            "move.marker",
        )
    return given, True


def _on_scale(homing: Homing, settings: ScenarioSettings) -> float:
    given = number(settings, "move.scale")
    if homing.scale is None:
        if given is not None:
            raise SimulationError("This axis has no distance-coded scale: leave out move.scale", "move.scale")
        return 0.0
    return _ON_SCALE * homing.scale.small if given is None else given


def _scattered(around: Surroundings, homing: Homing, settings: ScenarioSettings) -> list[Surroundings]:
    """Return what is around the axis at the further homings: the switch at another place within its
    scatter.
    """
    times, scatter = number(settings, "move.homings") or 1.0, number(settings, "move.scatter") or 0.0
    if not (times == int(times) and 1 <= times <= _MAX_HOMINGS):
        raise SimulationError(
            f"move.homings is {times:g}; it must be a whole number from 1 to {_MAX_HOMINGS}", "move.homings"
        )
    if not (0.0 <= scatter < math.inf) or (scatter and not homing.approach):
        raise SimulationError(
            "move.scatter must not be negative, and is of an axis with a home switch", "move.scatter"
        )
    # Spread evenly however many there are, and the same each time, which random ones are not.
    shares = [(n * _GOLDEN) % 1.0 - 0.5 for n in range(1, int(times))]
    return [replace(around, switch=around.switch + scatter * share) for share in shares]


def _compare(homing: Homing, homed: Homed, others: Sequence[Homed]) -> None:
    """Have the control compare the turn between switch and marker with that of the first homing,
    where it does.
    """
    failure, first = homing.failures.get("scatter"), _grid(homing, homed)
    for other in others:
        again = _grid(homing, other)
        # The reach of this failure is a share of a turn, the grid is in %.
        if failure and first is not None and again is not None and abs(again - first) > failure.reach * 100.0:
            homed.fail(failure)
            return


def _grid(homing: Homing, homed: Homed) -> float | None:
    """Return the way from switch to marker in % of a turn."""
    if homing.marker == "none" or homed.marker is None or homed.left is None:
        return None
    return abs(homed.marker - homed.left.measured) / homing.turn * 100.0


def _doubts(axis: AxisLaw, homing: Homing, around: Surroundings, homed: Homed) -> list[str]:
    """Return what is doubtful about this homing."""
    notes = []
    if homing.marker == "nearest" and homed.left and homed.marker is not None:
        away = abs(homed.marker - homed.left.measured) / homing.turn
        if away > DOUBTFUL:
            notes.append(
                f"The marker is {value_text(away, digits=2)} turns from where the switch goes off: "
                f"half a turn away it may be another one each time ({page_text(homing.page)}). "
                "Move the switch or the encoder."
            )
    if homed.overrun is not None and homed.overrun > around.length and not homed.alarm:
        notes.append(
            f"ASSUMED: the axis runs {value_text(homed.overrun, axis.unit)} over a switch of"
            f" {value_text(around.length, axis.unit)}, stops behind it and comes back over it; the "
            "control waits"
            " until it goes off again."
        )
    return notes


def _on_the_way(axis: AxisLaw, homing: Homing, homed: Homed) -> dict[str, Figure]:
    """Return the figures of switch and marker, as far as the sequence has them."""
    u = axis.unit
    figures: dict[str, Figure] = {}
    if homing.approach:
        figures["approach_feedrate"] = (abs(homing.approach) * 60.0, f"{u}/min")
        if not homing.through:
            figures["switch_overrun"] = (homed.overrun, u)
    if homing.leave:
        figures["leave_feedrate"] = (abs(homing.leave) * 60.0, f"{u}/min")
    if homing.marker != "none" and homing.scale is None and homing.leave:
        from_end = None if homed.marker is None or homed.left is None else homed.marker - homed.left.measured
        figures["marker_distance"] = (from_end, u)
        figures["home_grid"] = (_grid(homing, homed), "%")
    return figures


def _figures(
    axis: AxisLaw, homing: Homing, homed: Homed, others: Sequence[Homed], motion: Motion, alarmed: bool
) -> dict[str, Figure]:
    """Return the named figures; none of the home position where it was not reached."""
    u, columns = axis.unit, motion.columns
    reached = homed.home is not None and not alarmed
    figures = _on_the_way(axis, homing, homed)
    off = None if not reached or homed.home is None else float(columns["position"][-1]) - homed.home
    figures |= {
        "home_position": (homing.coordinate if reached else None, u),
        "home_from_start": (homed.home if reached else None, u),
        "stop_position": (None if off is None else homing.coordinate + off, u),
        "time": (homed.ended if reached else None, "s"),
        "peak_following_error": (float(np.abs(columns["following_error"][motion.driven]).max()), u),
    }
    if homing.order is not None:
        figures["home_order"] = (float(homing.order), "")
    if others:
        places = [each.home for each in (homed, *others) if each.home is not None]
        whole = reached and len(places) == len(others) + 1
        figures["repeatability"] = (max(places) - min(places) if whole else None, u)
    return figures


SCENARIO = Scenario(
    "home",
    "Homing: switch, marker and home position",
    _SETTINGS,
    _run_home,
    gains=False,
    part="homing",
    headline="home_grid",
    checked=("home_position", "home_grid", "switch_overrun", "time"),
)
