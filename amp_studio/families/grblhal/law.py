"""Binds an axis of a Grbl or grblHAL: rates, acceleration, homing and soft limits; no servo.
Sources are those of the grblHAL core.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING

from amp_studio.files import ParameterFile
from amp_studio.sim import (
    AlarmText,
    AxisLaw,
    AxisParameters,
    Failure,
    Homing,
    Jogging,
    Law,
    Machine,
    Prediction,
    Ramp,
    SimulationError,
    Source,
    Travel,
)

from . import law_sample as loop
from .law_facts import MOTION, ids
from .law_spindle import probing, spindle

if TYPE_CHECKING:
    pass

COMMON = (ids.seek_rate, ids.locate_rate)
_OWN = (ids.homing_seek_rate, ids.homing_locate_rate)
_ENABLED, _ORIGIN, _PER_AXIS = 1 << 0, 1 << 3, 1 << 9
_PHASES = 6
"""Of a homing of all axes: $44 to $49."""
SEARCH = 1.5
"""Times the travel in which a switch is searched (config.h, HOMING_AXIS_SEARCH_SCALAR)."""

SAMPLE = MOTION.value("sample")
"""s"""
GAIN = MOTION.value("position_gain")
"""1/s"""

_FOLLOWS = (
    "ASSUMED: the motor follows its steps; a stepper has no servo loop, and steps that it loses under load"
    " are not simulated."
)
_SOURCE = "grblHAL machine_limits.c"
_HOMED = (
    (
        "At the seek rate to the switch, at once at rest, back by the pull-off at the seek rate, at the"
        f" locate rate to the switch again, and back by the pull-off ({_SOURCE}, homing_cycle). ASSUMED: the"
        " axis is homed alone, and the debounce delay passes at rest."
    ),
    (
        "The travel lies on the other side of the switch, whatever $23 is: no value shows on which side of"
        " the machine the switch is. Look at the first move of $H."
    ),
)
_LIMITED = (
    "A move beyond the travel is refused before it begins, with ALARM:2; a jog is refused with error:15, or"
    " ends at the travel with $40 (machine_limits.c)."
)


def axes(file: ParameterFile) -> Sequence[str]:
    """Return the axes that have steps."""
    named = file.machine_schema.instances(file.schema.parameters[ids.axis_steps])
    return tuple(
        axis
        for axis in named
        if file.get((ids.axis_steps, axis)) is not None
        and file.evaluation.state((ids.axis_steps, axis)).is_active
    )


def bind(read: AxisParameters) -> AxisLaw:
    """Return one axis; raises SimulationError naming the setting that is missing or impossible."""
    steps, rate, acceleration = (
        read.above_zero(name) for name in (ids.axis_steps, ids.max_rate, ids.axis_acceleration)
    )
    # $376 has a bit for each axis from A on.
    unit = "deg" if _bit(read, ids.rotary_axes, MOTION.axes.index(read.axis) - 3) else "mm"
    ramp = Ramp("linear", acceleration=acceleration)
    return AxisLaw(
        axis=read.axis,
        unit=unit,
        title="Grbl: steps at the commanded speed, straight ramps, no servo loop",
        position_sample=loop.position_sample,
        velocity_sample=None,
        parameters=[GAIN, steps],
        state_size=1,
        servo_period=SAMPLE,
        velocity_period=SAMPLE,
        machine=Machine(
            # High on purpose: a stepper follows its steps, or loses them, which is not simulated.
            acceleration_per_output=1e4,
            velocity_per_output=1.0 / 60.0,
            velocity_bandwidth=MOTION.value("velocity_bandwidth"),
        ),
        output_unit=f"{unit}/min",
        position_rate=GAIN,
        feedrate=rate / 60.0,
        inposition_band=1.0 / steps,
        ramps={"linear": ramp, "none": Ramp()},
        monitors=(("step_rate", "Hz"),),
        faults={"drive": AlarmText("ALARM:17", "A motor driver reports a fault (A34)")},
        predict=lambda speed: {"step_rate": Prediction(abs(speed) * steps, "Hz", "protocol")},
        sources={"feedrate": Source(ids.max_rate, 60.0), "acceleration": Source(ids.axis_acceleration)},
        assumptions=(_FOLLOWS,),
        homing=partial(homing, read),
        jogging=lambda: Jogging(
            {"max": rate / 60.0},
            page="jog",
            notes=("A sender chooses the speed of a jog; at most $110 of the axis.",),
        ),
        travel=partial(travel, read),
    )


def _bit(read: AxisParameters, name: str, bit: int) -> bool:
    return bit >= 0 and bool(int(read.optional(name, everywhere=True) or 0.0) >> bit & 1)


def homing(read: AxisParameters) -> Homing:
    """Return the homing cycle of one axis; raises SimulationError where it is off."""
    cycle = int(read.optional(ids.homing_cycle, everywhere=True) or 0.0)
    if not cycle & _ENABLED:
        raise SimulationError("Homing is off ($22): $H is answered with error:5", ids.homing_cycle)
    sign = -1.0 if _bit(read, ids.invert_direction, MOTION.axes.index(read.axis)) else 1.0
    rates = _OWN if cycle & _PER_AXIS else COMMON
    seek, locate = (read.optional(name, everywhere=rates is COMMON) or 0.0 for name in rates)
    if not (seek > 0.0 and locate > 0.0):
        raise SimulationError(
            f"The homing rates of axis {read.axis} are {seek:g} and {locate:g}; both must be above 0",
            COMMON[0],
        )
    back, travelled = read.number(ids.pull_off, everywhere=True), read.number(ids.max_travel)
    if not back > 0.0:
        raise SimulationError(f"Homing pull-off ($27) is {back:g}; it must be above 0", ids.pull_off)
    home = 0.0 if cycle & _ORIGIN else back - travelled if sign < 0.0 else -back
    none = f"the switch has not been found ({_SOURCE}, homing_cycle)"
    return Homing(
        approach=sign * seek / 60.0,
        leave=-sign * seek / 60.0,
        marker="none",
        turn=back,
        coordinate=home,
        final=seek / 60.0,
        offset=-sign * back,
        again=locate / 60.0,
        pull_off=back,
        passes=int(read.optional(ids.homing_passes, everywhere=True) or 1.0),
        stops_by_switch=True,
        failures={
            "switch": Failure(
                "ALARM:9", f"Homing fail: within {SEARCH:g} times the travel {none}", SEARCH * travelled
            ),
            "stuck": Failure(
                "ALARM:8", f"Homing fail: the switch is still on after the pull-off ({_SOURCE}, homing_cycle)"
            ),
        },
        order=_phase(read),
        speeds={"approach": rates[0], "back": rates[0], "again": rates[1], "final": rates[0]},
        page=_SOURCE,
        notes=_HOMED,
    )


def _phase(read: AxisParameters) -> int | None:
    """Return the phase of $H in which an axis is homed, from 1; None for a control whose file has none."""
    place = MOTION.axes.index(read.axis)
    return next((n for n in range(1, _PHASES + 1) if _bit(read, ids[f"homing_phase_{n}"], place)), None)


def travel(read: AxisParameters) -> Travel:
    """Return the soft limits of a homed axis (machine_limits.c, limits_set_work_envelope)."""
    if read.value(ids.limits_soft, everywhere=True) not in (True, "yes"):
        return Travel({}, "ALARM:2", _SOURCE, ("Soft limits are off ($20): only switches stop an axis.",))
    length, cycle = read.number(ids.max_travel), int(read.optional(ids.homing_cycle, everywhere=True) or 0.0)
    # The pull-off is taken off the travel only where hard limits would trip at its end.
    back = (read.optional(ids.pull_off, everywhere=True) or 0.0) if _bit(read, ids.limits_hard, 0) else 0.0
    low, high = back - length, -back
    if cycle & _ORIGIN:
        negative = _bit(read, ids.invert_direction, MOTION.axes.index(read.axis))
        low, high = (0.0, length - back) if negative else (back - length, 0.0)
    edges = (low, high) if math.isfinite(length) else (-math.inf, math.inf)
    return Travel({"the soft limit": edges}, "ALARM:2", _SOURCE, (_LIMITED,), refuses=True)


LAW = Law(
    bind, axes, spindle=spindle, probing=probing, path="amp_studio.families.grblhal.law_path:path_rules"
)
