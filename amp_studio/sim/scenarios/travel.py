"""Scenario `travel`: from a speed against a limit of the travel, and where the axis stops."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from amp_studio.sim.axis.moves import feedrate_of
from amp_studio.sim.axis.moving_axis import MovingAxis, Watch
from amp_studio.sim.command.events import Travel
from amp_studio.sim.engine.kernel import STANDSTILL
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import AxisLaw, Ramp
from amp_studio.sim.model import assumptions
from amp_studio.sim.rounding import value_text
from amp_studio.sim.scenario import Scenario, Settings, above_zero, number, refuse_unknown
from amp_studio.sim.series import Series
from amp_studio.sim.trace import Alarm, Figure, Trace

from .columns import alarms_of, column_units, per_minute
from .plane import SETTINGS as PLANE
from .plane import run_plane
from .step import COAST, RUN_OUT

SETTINGS = {
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


def run_travel(axis: AxisLaw, settings: Settings) -> Trace:
    """Move an axis against the next limit in its way; raises SimulationError where there is none."""
    refuse_unknown(settings, SETTINGS)
    if axis.travel is None:
        raise SimulationError(f"What stops axis {axis.axis} at a limit of its travel is not printed")
    travel, feedrate = axis.travel(), feedrate_of(axis, settings)
    sign = {"plus": 1.0, "minus": -1.0}.get(str(settings.get("move.direction", "plus")))
    if sign is None:
        raise SimulationError("move.direction must be plus or minus", "move.direction")
    ramp = axis.manual_ramp(False) if axis.manual_ramp else next(iter(axis.ramps.values()))
    given = number(settings, "move.start")
    zone = _zone(travel, settings)
    if zone is not None:
        travel = replace(travel, limits=zone, notes=(travel.zone_note, *travel.notes), page=travel.zone_page)
    found = travel.nearest(-sign * math.inf if given is None else given, sign)
    if found is None:
        raise SimulationError(
            f"No limit of the travel is active in the way of axis {axis.axis} (page {travel.page})"
        )
    if given is None:  # from inside of all limits
        far = (sign > 0.0) != (zone is not None)  # a zone is met from outside
        ends = [high if far else low for low, high in travel.limits.values()]
        finite = [edge for edge in ends if math.isfinite(edge)]
        if finite:
            edge = min(finite, key=lambda each: sign * each)
            found = next((name, edge) for name, edges in travel.limits.items() if edge in edges)
    name, edge = found
    run_up = feedrate * (
        5.0 * ramp.time
        + (feedrate / ramp.acceleration if ramp.acceleration else 0.0)
        + 5.0 / axis.position_rate
    )
    start = edge - sign * run_up if given is None else given
    course, limit = MovingAxis(axis, coast=COAST if travel.coasts else 0.0), edge - start
    if travel.refuses:
        seen = None
    else:
        slow = _slowed(travel, settings, sign, start, edge)
        if slow is not None:
            course.go(sign * feedrate, ramp, Watch(slow[0] - start, sign, device=True), abs(limit) + run_up)
        rate = feedrate if slow is None else min(slow[1], feedrate)
        seen = course.go(sign * rate, ramp, Watch(limit, sign, device=True), abs(limit) + run_up)
    if seen is not None and travel.coasts:
        course.switch_off()
    elif seen is not None:
        course.stop(travel.stop or Ramp())
    motion = course.motion()
    columns = {key: each.copy() for key, each in per_minute(motion.columns).items()}
    for key in ("command_position", "position", "measured_position"):
        columns[key] += start
    alarms = () if travel.coasts else alarms_of(axis, motion)
    speed, code = None, travel.alarm
    if sign < 0.0 and travel.alarm_negative:
        code = travel.alarm_negative
    if travel.refuses:
        text = f"A move beyond {name}, {value_text(edge, axis.unit)}, is not begun (page {travel.page})"
        alarms = (*alarms, Alarm(code, 0.0, text))
    hard = number(settings, "move.hard_stop")
    alarms = (*alarms, *_hit(axis, hard, sign, columns))
    if seen is not None:
        at = int(np.searchsorted(motion.columns["time_s"], seen.time))
        speed = abs(float(motion.columns["velocity"][min(at, len(motion.columns["velocity"]) - 1)]))
        how = (
            "the loop is switched off"
            if travel.coasts
            else "the command stops along its ramp"
            if travel.stop
            else "the command stops at once"
        )
        text = f"The axis has passed {name}, {value_text(edge, axis.unit)} (page {travel.page}): {how}"
        alarms = (*alarms, Alarm(code, seen.time, text))
    end = float(columns["position"][-1])
    at_rest = (
        abs(float(motion.columns["velocity"][-1])) < STANDSTILL
        if travel.coasts
        else motion.command_end is not None
    )
    reached = seen is not None and at_rest
    result: dict[str, Figure] = {
        "feedrate": (feedrate * 60.0, f"{axis.unit}/min"),
        "limit": (edge, axis.unit),
        "speed_at_limit": (None if speed is None else speed * 60.0, f"{axis.unit}/min"),
        "stop_position": (end if reached or travel.refuses else None, axis.unit),
        "overrun": (sign * (end - edge) if reached else None, axis.unit),
        "time": (
            float(motion.columns["time_s"][-1]) if travel.coasts else motion.command_end if reached else None,
            "s",
        ),
        "peak_following_error": (float(np.abs(columns["following_error"][motion.driven]).max()), axis.unit),
    }
    if hard is not None:
        result["hard_stop_margin"] = (sign * (hard - end) if reached or travel.refuses else None, axis.unit)
    return Trace(
        scenario="travel",
        axis=axis.axis,
        model=axis.title,
        columns=columns,
        units=column_units(axis),
        result=result,
        alarms=alarms,
        recommendations=(),
        assumptions=(*travel.notes, *([RUN_OUT] if travel.coasts else []), *assumptions(axis)),
        limits={},
        move={"move.start": start, "move.feedrate": feedrate * 60.0},
    )


def _slowed(
    travel: Travel, settings: Settings, sign: float, start: float, edge: float
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


def _zone(travel: Travel, settings: Settings) -> dict[str, tuple[float, float]] | None:
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
    {**PLANE, **SETTINGS},
    run_travel,
    gains=False,
    several=run_plane,
)
