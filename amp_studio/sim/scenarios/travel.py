"""Scenario `travel`: from a speed against a limit of the travel, and where the axis stops."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from amp_studio.sim.axis.motion import Motion
from amp_studio.sim.axis.moves import feedrate_of, run_up
from amp_studio.sim.axis.moving_axis import MovingAxis
from amp_studio.sim.axis.orders import Seen, Watch
from amp_studio.sim.command.events import Travel
from amp_studio.sim.engine.kernel import STANDSTILL
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import AxisLaw, Ramp
from amp_studio.sim.model import assumptions
from amp_studio.sim.rounding import page_text, value_text
from amp_studio.sim.scenario import Scenario, ScenarioSettings, above_zero, direction, number, refuse_unknown
from amp_studio.sim.series import Series
from amp_studio.sim.trace import Alarm, Figure, Trace

from .columns import alarms_of, column_units, per_minute
from .plane import SETTINGS as PLANE
from .plane import run_plane
from .step import COAST, RUN_OUT

_SETTINGS = {
    "move.start": (
        "where the axis starts in the coordinates of the machine (mm or deg); default: as near to the limit"
        " as it reaches its speed"
    ),
    "move.zone": "a programmable zone that is on, by its number; default: the limits of the travel alone",
    "move.direction": "plus or minus; default: plus",
    "move.feedrate": "feedrate against the limit (mm/min or deg/min); default: the rapid feedrate",
    "move.hard_stop": "where the axis meets its hard stop (mm or deg); default: not checked",
    "move.slow_from": "where a switch requests external deceleration (mm or deg); default: none does",
    "move.slow_feedrate": "feedrate behind that switch (mm/min or deg/min); default: that of the file",
}


@dataclass(frozen=True)
class _Approach:
    """How an axis goes against a limit: u and u/s in the coordinates of the machine."""

    travel: Travel
    """With the zone as its limits, where one is asked for."""
    feedrate: float
    sign: float
    """1.0 or -1.0."""
    ramp: Ramp
    name: str
    edge: float
    run_up: float
    """From rest until the axis follows its command."""
    start: float

    @property
    def limit(self) -> float:
        """How far the limit is from the start."""
        return self.edge - self.start


def _run_travel(axis: AxisLaw, settings: ScenarioSettings) -> Trace:
    """Move an axis against the next limit in its way; raises SimulationError where there is none."""
    refuse_unknown(settings, _SETTINGS)
    approach = _approach(axis, settings)
    travel, start = approach.travel, approach.start
    course = MovingAxis(axis, coast=COAST if travel.coasts else 0.0)
    seen = None if travel.refuses else _driven(course, approach, settings)
    motion = course.motion()
    columns = {key: each.copy() for key, each in per_minute(motion.columns).items()}
    for key in ("command_position", "position", "measured_position"):
        columns[key] += start
    hard = number(settings, "move.hard_stop")
    alarms = (
        *(() if travel.coasts else alarms_of(axis, motion)),
        *_refused(axis, approach),
        *_hit(axis, hard, approach.sign, columns),
        *_passed(axis, approach, seen),
    )
    return Trace(
        scenario="travel",
        axis=axis.axis,
        model=axis.title,
        columns=columns,
        units=column_units(axis),
        result=_figures(axis, approach, seen, motion, hard),
        alarms=alarms,
        assumptions=(*travel.notes, *([RUN_OUT] if travel.coasts else []), *assumptions(axis)),
        move={"move.start": start, "move.feedrate": approach.feedrate * 60.0},
    )


def _approach(axis: AxisLaw, settings: ScenarioSettings) -> _Approach:
    """Return how the axis goes against the next limit; raises SimulationError where there is none."""
    if axis.travel is None:
        raise SimulationError(f"What stops axis {axis.axis} at a limit of its travel is not printed")
    travel, feedrate = axis.travel(), feedrate_of(axis, settings)
    sign = direction(settings) or 1.0
    ramp = axis.manual_ramp(False) if axis.manual_ramp else next(iter(axis.ramps.values()))
    given = number(settings, "move.start")
    zone = _zone(travel, settings)
    if zone is not None:
        travel = replace(travel, limits=zone, notes=(travel.zone_note, *travel.notes), page=travel.zone_page)
    # Without a start from as far off as can be: then any limit in that direction is ahead.
    found = travel.nearest(-sign * math.inf if given is None else given, sign)
    if found is None:
        raise SimulationError(
            f"No limit of the travel is active in the way of axis {axis.axis} ({page_text(travel.page)})"
        )
    if given is None:
        found = _met_from_far(travel, sign, is_zone=zone is not None) or found
    way, (name, edge) = run_up(axis, feedrate, ramp), found
    start = (
        _start(travel, name, edge - sign * way, sign, is_zone=zone is not None) if given is None else given
    )
    return _Approach(travel, feedrate, sign, ramp, name, edge, way, start)


def _start(travel: Travel, name: str, start: float, sign: float, *, is_zone: bool) -> float:
    """Return where an axis starts that goes against a limit at its speed: no farther off than the other
    end of its travel.
    """
    low, high = travel.limits[name]
    return start if is_zone else max(start, low) if sign > 0.0 else min(start, high)


def _met_from_far(travel: Travel, sign: float, *, is_zone: bool) -> tuple[str, float] | None:
    """Return the first limit that an axis meets which starts inside of all limits, or outside of a zone."""
    # A limit of the travel is met at its far end, a forbidden zone at its near one.
    is_high = (sign > 0.0) != is_zone
    ends = ((name, high if is_high else low) for name, (low, high) in travel.limits.items())
    finite = [end for end in ends if math.isfinite(end[1])]
    return min(finite, key=lambda end: sign * end[1], default=None)


def _driven(course: MovingAxis, approach: _Approach, settings: ScenarioSettings) -> Seen | None:
    """Drive the axis over its limit and let the control stop it; returns the sample that noticed it."""
    travel, sign, ramp = approach.travel, approach.sign, approach.ramp
    farthest = abs(approach.limit) + approach.run_up
    rate = approach.feedrate
    slow = _slowed(travel, settings, sign, approach.start, approach.edge)
    if slow is not None:
        course.go(sign * rate, ramp, Watch(slow[0] - approach.start, sign, device=True), farthest)
        rate = min(slow[1], rate)
    seen = course.go(sign * rate, ramp, Watch(approach.limit, sign, device=True), farthest)
    if seen is not None and travel.coasts:
        course.switch_off()
    elif seen is not None:
        course.stop(travel.stop or Ramp())
    return seen


def _refused(axis: AxisLaw, approach: _Approach) -> tuple[Alarm, ...]:
    """Return the alarm of a control that does not begin a move beyond the limit."""
    travel = approach.travel
    if not travel.refuses:
        return ()
    end = value_text(approach.edge, axis.unit)
    text = f"A move beyond {approach.name}, {end}, is refused: it does not begin ({page_text(travel.page)})"
    return (Alarm(_code(approach), 0.0, text),)


def _passed(axis: AxisLaw, approach: _Approach, seen: Seen | None) -> tuple[Alarm, ...]:
    """Return the alarm of a control that notices the limit once it is passed."""
    if seen is None:
        return ()
    travel = approach.travel
    how = "the command stops along its ramp" if travel.stop else "the command stops at once"
    if travel.coasts:
        how = "the loop is switched off"
    end = value_text(approach.edge, axis.unit)
    text = f"The axis has passed {approach.name}, {end} ({page_text(travel.page)}): {how}"
    return (Alarm(_code(approach), seen.time, text),)


def _code(approach: _Approach) -> str:
    """Return the alarm of the limit in the direction of the move."""
    is_negative = approach.sign < 0.0 and approach.travel.alarm_negative
    return approach.travel.alarm_negative if is_negative else approach.travel.alarm


def _figures(
    axis: AxisLaw, approach: _Approach, seen: Seen | None, motion: Motion, hard: float | None
) -> dict[str, Figure]:
    """Return the figures of the result; those of a stop are None where the axis did not come to rest, and
    a move that is refused has none.
    """
    travel, sign, edge = approach.travel, approach.sign, approach.edge
    result: dict[str, Figure] = {
        "feedrate": (approach.feedrate * 60.0, f"{axis.unit}/min"),
        "limit": (edge, axis.unit),
    }
    if travel.refuses:
        return result
    velocities, times = motion.columns["velocity"], motion.columns["time_s"]
    speed = None
    if seen is not None:
        at = min(int(np.searchsorted(times, seen.time)), len(velocities) - 1)
        speed = abs(float(velocities[at])) * 60.0
    # An axis whose loop is switched off has no command that ends: only its velocity shows it at rest.
    coasted = abs(float(velocities[-1])) < STANDSTILL
    reached = seen is not None and (coasted if travel.coasts else motion.command_end is not None)
    end = float(motion.columns["position"][-1]) + approach.start
    time = motion.command_end if reached else None
    error = np.abs(motion.columns["following_error"][motion.driven]).max()
    result |= {
        "speed_at_limit": (speed, f"{axis.unit}/min"),
        "stop_position": (end if reached else None, axis.unit),
        "overrun": (sign * (end - edge) if reached else None, axis.unit),
        "time": (float(times[-1]) if travel.coasts else time, "s"),
        "peak_following_error": (float(error), axis.unit),
    }
    if hard is not None:
        result["hard_stop_margin"] = (sign * (hard - end) if reached else None, axis.unit)
    return result


def _slowed(
    travel: Travel, settings: ScenarioSettings, sign: float, start: float, edge: float
) -> tuple[float, float] | None:
    """Return where an external deceleration is requested, and the feedrate behind it in u/s;
    None where nothing requests it.
    """
    place = number(settings, "move.slow_from")
    if place is None:
        return None
    given = above_zero(settings, "move.slow_feedrate")
    rate = travel.slow if given is None else given / 60.0
    if not rate:
        raise SimulationError(
            "No feedrate of an external deceleration is in the file: give move.slow_feedrate",
            "move.slow_feedrate",
        )
    if not sign * start < sign * place < sign * edge:
        raise SimulationError("move.slow_from must be between the start and the limit", "move.slow_from")
    return place, rate


def _hit(axis: AxisLaw, hard: float | None, sign: float, columns: dict[str, Series]) -> tuple[Alarm, ...]:
    """Return the alarm of an axis that meets its hard stop, which no control notices by itself."""
    if hard is None:
        return ()
    beyond = np.flatnonzero(sign * (columns["position"] - hard) >= 0.0)
    if not beyond.size:
        return ()
    at = int(beyond[0])
    speed = value_text(abs(float(columns["velocity"][at])), f"{axis.unit}/min")
    text = (
        f"The axis meets its hard stop at {value_text(hard, axis.unit)} with {speed}: move the limit "
        "away from it,"
        " or slow down before it"
    )
    return (Alarm("HARD STOP", float(columns["time_s"][at]), text),)


def _zone(travel: Travel, settings: ScenarioSettings) -> dict[str, tuple[float, float]] | None:
    """Return the zone that is asked for; raises SimulationError for one that is not set."""
    wanted = settings.get("move.zone")
    if wanted is None:
        return None
    if travel.zones is None:
        raise SimulationError(
            "Programmable zones of this family are not simulated, only the limits of the travel", "move.zone"
        )
    name = f"{wanted:g}" if isinstance(wanted, float) else str(wanted)
    if name not in travel.zones:
        known = f"; set are: {', '.join(travel.zones)}" if travel.zones else ""
        raise SimulationError(f"Zone {name} of this axis is not set{known}", "move.zone")
    return {f"programmable zone {name}": travel.zones[name]}


SCENARIO = Scenario(
    "travel",
    "Against a limit of the travel: where the axis stops; axes X,Y past zones to move.to",
    {**PLANE, **_SETTINGS},
    _run_travel,
    gains=False,
    several=run_plane,
    part="travel",
    headline="overrun",
    checked=("limit", "stop_position", "overrun"),
    opposite={"move.direction": "minus"},
)
