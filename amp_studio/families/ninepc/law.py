"""The servo axis of an Allen-Bradley 9/PC: which parameters make its loops, its machine and its ramps.

Pages are those of the 9/PC AMP manual. `law_samples.py` is the control at work, `law_units.py` the unit of
its gains, `law_notes.py` what is assumed.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache, partial
from typing import TYPE_CHECKING

from amp_studio.schema import canonical, load_schema
from amp_studio.sim import (
    AlarmText,
    AxisLaw,
    AxisParameters,
    Law,
    LoopFilter,
    Ramp,
    SimulationError,
    Source,
    value_text,
)

from . import law_dac as dac
from . import law_dual as dual
from . import law_events as events
from . import law_notes as notes_of
from . import law_samples as samples
from . import law_split as split
from .law_advice import advise, follow
from .law_drives import FILTER_OFF, Parts, analog, digital, third_party
from .law_facts import ids
from .law_feedback import Feedback, feedback_of
from .law_figures import Loop, predictions
from .law_machine_tests import machine_tests
from .law_probing import probing
from .law_ramps import ramps_of
from .law_reading import above_zero, demand, if_set, not_negative
from .law_spindle import spindle, tapping
from .law_zones import zones

if TYPE_CHECKING:
    from amp_studio.sim import Scenario

_LOWEST_FILTER = 40.0
"""Hz: a torque filter below it leaves no velocity loop that is of use."""
_LONGEST_CYCLE = 1000.0
"""ms; 30 is the longest one printed (7-4)."""

_SOURCES = {
    "position_gain": Source(ids.initial_gain, page="7-25"),
    "inposition_band": Source(ids.inposition_band, page="7-24"),
    "gain_break_point": Source(ids.gain_break_point, page="7-22"),
    "gain_break_ratio": Source(ids.gain_break_ratio, page="7-27"),
    "feed_forward": Source(ids.feed_forward, page="7-28"),
    "feedrate_suppression": Source(ids.feedrate_suppression, page="7-21"),
    "excess_error": Source(ids.excess_error, page="7-20"),
    "linear_acceleration": Source(ids.linear_acceleration, page="10-8"),
    "linear_deceleration": Source(ids.linear_deceleration, page="10-10"),
    "exponential_time": Source(ids.programmed_delay, whole=True, page="10-17"),
    "feedrate": Source(ids.feedrate_rapid, page="9-1"),
    "cutting_feedrate": Source(ids.max_cutting, page="9-2"),
    "servo_period": Source(ids.sercos_cycle, page="7-4"),
    "velocity_proportional_gain": Source(ids.velocity_proportional_gain, unit="", whole=True, page="7-54"),
    "velocity_integral_gain": Source(ids.velocity_integral_gain, unit="", whole=True, page="7-56"),
    "integrator_discharge": Source(ids.integrator_discharge, unit="", whole=True, page="7-58"),
    "torque_limit_positive": Source(ids.max_torque_positive, page="7-62"),
    "torque_limit_negative": Source(ids.max_torque_negative, page="7-61"),
    "torque_filter": Source(ids.torque_filter, unit="Hz", whole=True, page="7-69"),
}

AMPLIFIER = AlarmText(
    "SERVO AMPLIFIER FAULT",
    "The amplifier has a fault (the text is printed on page 10-3, for one case). ASSUMED: the control goes"
    " into E-STOP",
)

_NO_LOOP = {
    "off": "the servo is off",
    "detached": "the servo is detached",
    "depth-probe": "a depth probe is not moved by a servo",
}


@dataclass(frozen=True)
class Kind:
    """What kind of axis it is."""

    unit: str
    drive: str
    """digital, analog or sercos."""
    loop: str
    """open, closed or zfe."""


def bind(read: AxisParameters) -> AxisLaw:
    """Return one axis; raises SimulationError for an axis that no loop moves,
    a value that is not set or impossible.

    The slave of a split axis goes with its master (chapter 32).
    """
    slave = split.slave_of(read)
    # Its loops are in the drive: nothing of a split axis is known of it.
    if _kind(read).drive == "sercos":
        return dual.grouped(_alone(read), read)
    if slave is None:
        return dual.grouped(_leading(read), read)
    master = read.of(slave.master)
    # A chain would make each of them wait for the motion of another.
    if split.slave_of(master) is not None:
        raise SimulationError(f"The master of axis {read.axis} is a slave itself", split.SETS[0][0])
    law, unit, stiffness = _alone(read, master), _kind(read).unit, split.coupling_of(read)
    texts = (split.SLAVE.format(slave.master, unit), split.JOINED if stiffness else split.LOOSE.format(unit))
    law = replace(law, assumptions=(*law.assumptions, *texts), ordered_by=(slave.master, "32-7"))
    return split.coupled(law, slave, _alone(master), stiffness)


def _leading(read: AxisParameters) -> AxisLaw:
    """Return an axis that is no slave; with a coupling a master feels its slave."""
    law, partner = _alone(read), split.slave_named(read)
    if partner is None:
        return law
    stiffness, other = split.coupling_of(read), read.of(partner)
    own = split.slave_of(other)
    # Nothing of the slave reaches the master: it is simulated alone.
    if own is None or not stiffness:
        return replace(law, assumptions=(*law.assumptions, split.LOOSE.format(law.unit)))
    law = replace(law, assumptions=(*law.assumptions, split.JOINED))
    return split.leading(law, _alone(other, read), own, stiffness)


def _alone(read: AxisParameters, master: AxisParameters | None = None) -> AxisLaw:
    """Return one axis without its partner; ramps and feedrates are those of its master, if it has one
    (32-4).
    """
    kind = _kind(read)
    if kind.drive == "sercos":
        return third_party(read, kind.unit, _common(read, kind))
    notes: list[str] = []
    feedback = feedback_of(read, kind.unit, digital=kind.drive == "digital", notes=notes)
    loop = _loop(read, kind)
    parameters = _position_parameters(read, kind, loop, feedback, notes)
    common = _common(read, kind, notes, master)
    shown_in_volts = dac.columns(read, kind.drive, parameters, notes)
    common |= {
        "inposition_band": not_negative(read, ids.inposition_band),
        "position_rate": loop.rate,
        "predict": partial(predictions, loop, kind.unit) if kind.loop != "open" else _nothing,
        "limits": _limits(parameters, read, loop) if kind.loop != "open" else {},
        "stops_at": "excess error",
        "alarms": _alarms(read, kind, parameters),
        "faults": {"drive": AMPLIFIER},
        "monitors": (
            [(name, unit.replace("u", kind.unit, 1)) for name, unit in samples.MONITORS] + shown_in_volts
        ),
    }
    if kind.loop != "open":
        common["homing"] = partial(events.homing, read, feedback)
    linear = common["ramps"]["linear"]  # type: ignore[index]  # it is a dictionary there
    common |= {
        "manual_ramp": partial(events.manual_ramp, read, linear),
        "jogging": partial(events.jogging, read),
        "travel": partial(events.travel, read),
    }
    partner = split.slave_named(read)
    if partner is not None:
        notes.append(split.MASTER.format(partner))
    notes.append({"closed": notes_of.CLOSED, "zfe": notes_of.ZFE, "open": notes_of.OPEN}[kind.loop])
    build = digital if kind.drive == "digital" else analog
    return build(read, Parts(kind.unit, feedback, loop, parameters, notes, common))


def _nothing(_feedrate: float) -> dict[str, object]:
    return {}


def _kind(read: AxisParameters) -> Kind:
    """Return the kind; raises SimulationError for an axis without a servo that moves it."""
    axis, kind = read.axis, read.choice(ids.axis_type)
    if kind == "unfitted":
        raise SimulationError(f"Axis {axis} is unfitted. Choose another axis", ids.axis_type)
    if kind == "spindle":
        raise SimulationError(f"Axis {axis} is a spindle: scenarios of axes leave it out", ids.axis_type)
    drive = read.choice(ids.loop_type)
    if drive not in ("digital", "analog", "sercos") or read.value(ids.hardware_type) == "none":
        raise SimulationError(
            f"Axis {axis} has no servo. First set its servo hardware and loop type", ids.loop_type
        )
    position = read.choice(ids.position_loop_type)
    if position not in ("open", "closed", "zfe"):
        what = _NO_LOOP.get(position, f"loop type '{position}' has no position loop")
        raise SimulationError(f"Axis {axis} cannot be simulated: {what}", ids.position_loop_type)
    return Kind("deg" if kind == "rotary" else "mm", drive, position)


def _loop(read: AxisParameters, kind: Kind) -> Loop:
    """Return the position loop; with ZFE the gain break is not used (7-22, 7-27)."""
    gain = above_zero(read, ids.initial_gain)
    if kind.loop == "zfe":
        share = not_negative(read, ids.feed_forward, most=100.0, unit=" %")
        return Loop(gain, math.inf, 1.0, share / 100.0)
    ratio = not_negative(read, ids.gain_break_ratio, most=1.0)
    return Loop(gain, not_negative(read, ids.gain_break_point), ratio, 0.0)


def _position_parameters(
    read: AxisParameters, kind: Kind, loop: Loop, feedback: Feedback, notes: list[str]
) -> list[float]:
    """Return the figures of the position loop in an array for `law_samples.py`."""
    p = [0.0] * samples.SIZE
    p[samples.GAIN], p[samples.FEED_FORWARD] = loop.rate, loop.feed_forward
    p[samples.BREAK_POINT], p[samples.BREAK_RATIO] = loop.break_point, loop.break_ratio
    p[samples.OPEN] = 1.0 if kind.loop == "open" else 0.0
    p[samples.EXCESS], p[samples.SUPPRESSION] = (
        not_negative(read, ids.excess_error),
        not_negative(read, ids.feedrate_suppression),
    )
    p[samples.COUNT] = feedback.position_count
    p[samples.CUTTING] = if_set(dual.slowest(read, ids.max_cutting), ids.max_cutting) / 60.0
    reversal = read.optional(ids.reversal_error) or 0.0
    demand(read, ids.reversal_error, reversal, not math.isnan(reversal), "must be a number")
    if reversal and feedback.on_load:
        notes.append(notes_of.REVERSAL_ON_SCALE)
    elif reversal:
        p[samples.REVERSAL], p[samples.FIRST] = abs(reversal), math.copysign(1.0, reversal)
        notes.append(notes_of.REVERSAL)
    return p


def _common(
    read: AxisParameters, kind: Kind, notes: list[str] | None = None, master: AxisParameters | None = None
) -> dict[str, object]:
    """Return what every kind of axis has, as fields of AxisLaw."""
    assumptions = notes if notes is not None else []
    cycle = above_zero(read, ids.sercos_cycle, everywhere=True)
    demand(
        read,
        ids.sercos_cycle,
        cycle,
        cycle <= _LONGEST_CYCLE,
        f"must be {_LONGEST_CYCLE:g} ms or less",
        everywhere=True,
    )
    ramps: dict[str, Ramp] = ramps_of(master or read, kind.unit, assumptions)
    for member in dual.group_of(read):
        ramps = dual.slower(ramps, ramps_of(member, kind.unit, []))
    rapid = if_set(dual.slowest(master or read, ids.feedrate_rapid), ids.feedrate_rapid)
    assumptions += [notes_of.SAMPLED, notes_of.RAMPS]
    return {
        "axis": read.axis,
        "unit": kind.unit,
        "servo_period": cycle / 1000.0,
        "feedrate": rapid / 60.0 if rapid else None,
        "ramps": ramps,
        "follow": follow,
        "gains": ("velocity_proportional_gain", "velocity_integral_gain", "position_gain"),
        "filters": (LoopFilter("torque_filter", FILTER_OFF, _LOWEST_FILTER),),
        "sources": {name: _bounded(source, kind.unit) for name, source in _SOURCES.items()},
    }


def _limits(parameters: list[float], read: AxisParameters, loop: Loop) -> dict[str, float]:
    """Return the levels of the following error at which the control does something, in units of the axis."""
    limits = {
        "excess error": parameters[samples.EXCESS],
        "feedrate suppression": parameters[samples.SUPPRESSION],
        "inposition band": not_negative(read, ids.inposition_band),
    }
    # At a ratio of 1 the gain does not change there: the point is no limit of anything.
    if loop.break_ratio < 1.0:
        limits["gain break point"] = loop.break_point
    return limits


def _alarms(read: AxisParameters, kind: Kind, parameters: list[float]) -> dict[int, AlarmText]:
    limit = value_text(parameters[samples.EXCESS], kind.unit)
    text = f"Following error above {limit} ({read.called(ids.excess_error)}): the control goes into E-STOP"
    return {int(samples.EXCESS_ERROR_ALARM): AlarmText("EXCESS FOLLOWING ERROR", text)}


@lru_cache(maxsize=256)
def _bounded(source: Source, unit: str) -> Source:
    """Return the source with the bound that is printed for an axis that moves in ``unit``,
    in canonical units.
    """
    parameter = load_schema("9pc").parameters[source.parameter]
    turning = (v.ranges for v in parameter.range_variants if v.when == "rotary_axis" and unit == "deg")
    ranges = next(turning, parameter.ranges or {})
    # Bounds are printed in two units: those in inches are the same ones, rounded otherwise.
    metric = ((printed, high) for printed, (_, high) in ranges.items() if not printed.startswith("in"))
    printed, high = next(metric, ("", None))
    largest = canonical(high, printed) if isinstance(high, float) else math.inf
    return Source(source.parameter, source.scale, source.unit, source.whole, largest, source.page)


def _own_scenarios() -> dict[str, Scenario]:
    from .law_adaptive import SCENARIO as ADAPTIVE_FEED
    from .law_hard_stop import SCENARIO as HARD_STOP
    from .law_sync import SCENARIO as SYNCHRONIZE
    from .law_tune import SCENARIO as PROCEDURE

    return {each.name: each for each in (PROCEDURE, HARD_STOP, ADAPTIVE_FEED, SYNCHRONIZE)}


LAW = Law(
    bind,
    advise=advise,
    own=_own_scenarios,
    spindle=spindle,
    tapping=tapping,
    probing=probing,
    zones=zones,
    machine_tests=machine_tests,
    path="amp_studio.families.ninepc.law_path:path_rules",
)
