"""Scenario `home`: onto the switch, off it, to the marker and to the home position, as the control does it."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from amp_studio.sim.errors import SimulationError
from amp_studio.sim.events import Homing
from amp_studio.sim.law import AxisLaw, Ramp
from amp_studio.sim.model import assumptions
from amp_studio.sim.motion import Motion
from amp_studio.sim.moving_axis import MovingAxis, Seen, Watch
from amp_studio.sim.rounding import rounded_up, shown
from amp_studio.sim.scenario import Scenario, Settings, above_zero, number, refuse_unknown
from amp_studio.sim.trace import Alarm, Figure, Trace

from .columns import alarms_of, column_units, per_minute

SETTINGS = {
    "move.direction": "plus or minus, where the direction is not in the file; default: plus",
    "move.switch": "distance from the start to the home switch (mm or deg); default: enough to reach the homing speed",
    "move.switch_length": "how long the switch stays on (mm or deg); default: to the end of the travel",
    "move.marker": "distance from the end of the switch to a marker, in the direction off the switch (mm or deg); default: a quarter turn",
}
QUARTER = 0.25
DOUBTFUL = 0.45
"""Share of a turn between switch and nearest marker from which a sample more or less may take another marker."""
MOST_TURNS = 100.0
"""Turns from the switch to the marker that is given."""
MARKERS = 5.0
"""Turns after which a marker that does not come is none."""
SEEN = "ASSUMED: switch and marker are seen at the servo sample after they change; logic and input filters, which no manual here times, come later."


@dataclass
class _Found:
    """What a homing has met so far, in u from the start."""

    switch: float | None = None
    """How far the start is from the switch."""
    overrun: float | None = None
    """How far beyond the edge of the switch the axis stops."""
    left: Seen | None = None
    marker: float | None = None
    home: float | None = None
    alarm: str = ""
    why: str = ""


def run_home(axis: AxisLaw, settings: Settings) -> Trace:
    """Home an axis; raises SimulationError for impossible settings."""
    refuse_unknown(settings, SETTINGS)
    if axis.homing is None:
        raise SimulationError(f"Axis {axis.axis} is not homed by a sequence that is printed")
    homing = axis.homing()
    if homing.direction_lost:
        homing = _turned(homing, settings)
    elif settings.get("move.direction") is not None:
        raise SimulationError(
            "The direction of homing is in the file: leave out move.direction", "move.direction"
        )
    ramp = homing.ramp or (axis.manual_ramp(True) if axis.manual_ramp else next(iter(axis.ramps.values())))
    course, found = MovingAxis(axis), _Found()
    _search(course, homing, ramp, settings, found)
    motion = course.motion()
    alarms = alarms_of(axis, motion)
    if found.alarm:
        alarms = (Alarm(found.alarm, float(motion.columns["time_s"][-1]), found.why),)
    notes = [SEEN, *homing.notes, *assumptions(axis)]
    length = number(settings, "move.switch_length")
    if length is not None and found.overrun is not None and found.overrun > length and not found.alarm:
        notes.insert(
            0,
            f"ASSUMED: the axis runs {shown(found.overrun, axis.unit)} over a switch of {shown(length, axis.unit)}, stops behind it and comes back over it; the"
            " control waits until it goes off again.",
        )
    if homing.marker == "nearest" and found.left and found.marker is not None:
        away = abs(found.marker - found.left.measured) / homing.turn
        if away > DOUBTFUL:
            notes.insert(
                0,
                f"The marker is {shown(away, digits=2)} turns from where the switch goes off: half a turn away it may be another one each time"
                f" (page {homing.page}). Move the switch or the encoder.",
            )
    return Trace(
        scenario="home",
        axis=axis.axis,
        model=axis.title,
        columns=per_minute(motion.columns),
        units=column_units(axis),
        result=_figures(axis, homing, found, motion, bool(alarms)),
        alarms=alarms,
        recommendations=(),
        assumptions=tuple(notes),
        limits={"inposition band": (axis.inposition_band, axis.unit)},
        move={} if found.switch is None else {"move.switch": found.switch},
    )


def _turned(homing: Homing, settings: Settings) -> Homing:
    """Return the sequence in the direction that is asked for."""
    sign = {"plus": 1.0, "minus": -1.0}.get(str(settings.get("move.direction", "plus")))
    if sign is None:
        raise SimulationError("move.direction must be plus or minus", "move.direction")
    return replace(homing, approach=sign * homing.approach, leave=sign * homing.leave)


def _search(course: MovingAxis, homing: Homing, ramp: Ramp, settings: Settings, found: _Found) -> None:
    """Run the sequence as far as it comes."""
    edge, length = 0.0, number(settings, "move.switch_length")
    if length is not None and length <= 0.0:
        raise SimulationError(f"move.switch_length is {length:g}; it must be above 0", "move.switch_length")
    if homing.approach:
        sign = math.copysign(1.0, homing.approach)
        found.switch = above_zero(settings, "move.switch") or _default(course.axis, homing.approach, ramp)
        edge = sign * found.switch
        far = abs(edge) + 2.0 * homing.turn
        if course.go(homing.approach, ramp, Watch(edge, sign), far) is None:
            return
        course.stop(ramp)
        found.overrun = course.passed(edge, sign)
        end = edge + sign * (math.inf if length is None else length)
        if math.copysign(1.0, homing.leave) == sign:
            if length is None:
                raise SimulationError(
                    "The axis leaves the switch in the direction in which it came: give move.switch_length",
                    "move.switch_length",
                )
            if found.overrun is not None and found.overrun > length:
                found.alarm, found.why = (
                    homing.too_fast or "HOME",
                    (
                        f"The axis passed the whole switch of {shown(abs(end - edge), course.axis.unit)} before it stopped: it is too fast for it"
                        f" (page {homing.page})"
                    ),
                )
                return
            edge = end
    _leave(course, homing, ramp, settings, found, edge)


def _leave(
    course: MovingAxis, homing: Homing, ramp: Ramp, settings: Settings, found: _Found, edge: float
) -> None:
    """Leave the switch whose end is at ``edge``, go to the marker and to the home position."""
    sign, far = math.copysign(1.0, homing.leave), MARKERS * homing.turn
    given = number(settings, "move.marker")
    if given is not None and abs(given) > MOST_TURNS * homing.turn:
        raise SimulationError(
            f"move.marker is {given:g}; give the distance to a marker near the switch, a turn is {shown(homing.turn, course.axis.unit)}",
            "move.marker",
        )
    first = edge + sign * (QUARTER * homing.turn if given is None else given)
    if homing.approach:
        way = abs(course.position - edge) + far
        found.left = course.go(homing.leave, ramp, Watch(edge, sign), way)
        if found.left is None:
            return
    start = found.left.measured if found.left else 0.0
    if homing.marker == "nearest":
        course.stop(ramp)
        found.marker = first + homing.turn * round((start - first) / homing.turn)
    elif homing.marker == "next":
        least = start + sign * homing.skipped * homing.turn
        turns = math.floor(sign * (least - first) / homing.turn) + 1
        marker = found.marker = first + sign * turns * homing.turn
        speed = math.copysign(homing.search or abs(homing.leave), homing.leave)
        if course.go(speed, ramp, Watch(marker, sign, device=True), far) is None:
            return
        course.stop(ramp)
    else:
        found.marker = start
        course.stop(ramp)
    found.home = found.marker + homing.offset
    if homing.final:
        course.to(found.home, homing.final, ramp)


def _default(axis: AxisLaw, velocity: float, ramp: Ramp) -> float:
    """Return a distance in u over which the axis reaches a velocity and follows it."""
    speed = abs(velocity)
    time = 5.0 * ramp.time + (speed / ramp.acceleration if ramp.acceleration else 0.0)
    return rounded_up(speed * (time + 3.0 / axis.position_rate + 0.2), 2)


def _figures(
    axis: AxisLaw, homing: Homing, found: _Found, motion: Motion, alarmed: bool
) -> dict[str, Figure]:
    """Return the named figures; none of the home position where it was not reached."""
    u, columns = axis.unit, motion.columns
    reached = found.home is not None and not alarmed
    figures: dict[str, Figure] = {}
    if homing.approach:
        figures["approach_feedrate"] = (abs(homing.approach) * 60.0, f"{u}/min")
        figures["switch_overrun"] = (found.overrun, u)
    figures["leave_feedrate"] = (abs(homing.leave) * 60.0, f"{u}/min")
    if homing.marker != "none":
        from_end = None if found.marker is None or found.left is None else found.marker - found.left.measured
        figures["marker_distance"] = (from_end, u)
    off = None if not reached or found.home is None else float(columns["position"][-1]) - found.home
    figures |= {
        "home_position": (homing.coordinate if reached else None, u),
        "home_from_start": (found.home if reached else None, u),
        "stop_position": (None if off is None else homing.coordinate + off, u),
        "time": (motion.command_end if reached else None, "s"),
        "peak_following_error": (float(np.abs(columns["following_error"][motion.driven]).max()), u),
    }
    return figures


SCENARIO = Scenario("home", "Homing: switch, marker and home position", SETTINGS, run_home, gains=False)
