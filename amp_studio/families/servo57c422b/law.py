"""Binds an axis of the 57C422B from its registers: gains, limits and the command,
and an assumed motor behind them.

Pages are those of the manual J-3642-7.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

from amp_studio.files import ParameterFile
from amp_studio.sim import (
    AlarmText,
    AxisLaw,
    AxisParameters,
    Law,
    Machine,
    Prediction,
    Ramp,
    Recommendation,
    SimulationError,
    Source,
    Trace,
    error_at_speed,
)

from . import law_plant as plant
from . import law_sample as loop
from .law_axis import ModuleAxis
from .law_cam_table import CAM
from .law_facts import MOTION, ids
from .law_home import homing, jogging, travel
from .law_machine_tests import machine_tests
from .law_registration import probing
from .law_tune import Scales
from .switch_bits import DRIVE_FAULT

if TYPE_CHECKING:
    from amp_studio.sim import Scenario

_NEEDED = (
    ids.gain_proportional,
    ids.gain_integral,
    ids.gain_velocity,
    ids.gain_feedforward,
    ids.gain_deadband,
    ids.max_voltage,
    ids.command_velocity,
    ids.command_acceleration,
    ids.command_deceleration,
)

_COMMAND_DATA = (
    ids.command_position,
    ids.setup_overtravel_positive,
    ids.setup_overtravel_negative,
    ids.gear_ratio,
    ids.output_backlash,
    ids.cam_points,
    ids.cam_time,
    ids.position_increment,
)
"""What tune commands, gearing, cams and backlash compensation read besides."""

_PER_VOLT = "model.velocity_per_output"
_SCALES = (
    "model.proportional_scale",
    "model.integral_scale",
    "model.feedforward_scale",
    "model.velocity_scale",
)

_WORD = (-32768.0, 32767.0)
"""Range of a register of 16 bits."""

_LOST = (
    "ASSUMED: a cascade with model.proportional_scale = {0:g}, model.integral_scale = {1:g},"
    " model.feedforward_scale = {2:g}, model.velocity_scale = {3:g}; the diagram of the loop and the scales"
    " of the gains are lost with the figures of the manual (sections 4.5 to 4.9), and the two printed"
    " programs (pages 4-48, 5-5) make well damped loops with these."
)
_DIRECTION_NOTE = (
    "The bits of Drive Setup are lost with figure 4.2: polarity is taken to fit, and {0} because Velocity"
    " Gain is {1} (page 5-3)."
)
_DEADBAND = (
    "Deadband Compensation is added to the output in words, in the direction of the output: figure 4.8 is"
    " lost. The linear model of the loop is without it."
)
_S_CURVE = (
    "The S-curve takes twice the time of the trapezoid (page 4-25); its shape is lost. Taken: sine squared,"
    " with the programmed acceleration as its peak."
)
_MATCHED = "The output for a velocity reference is taken to be the wanted velocity at the speed of the drive."
_LINEAR = "Linearization Constants other than -1 are not simulated: their scale is not printed (page 4-18)."


def _faults(read: AxisParameters) -> dict[str, AlarmText]:
    """Return the fault of the drive input, where register 2 has it enabled (4-5, 4-37; bit 8 is inferred)."""
    if not int(read.optional(ids.setup_switches) or 0.0) & DRIVE_FAULT:
        return {}
    text = "The drive fault input has tripped: register 73, the loop is switched off (page 4-37)"
    return {"drive": AlarmText("DRIVE FAULT", text)}


def axes(file: ParameterFile) -> Sequence[str]:
    """Return the axes whose Proportional Gain is set, both where none is."""
    tuned = tuple(axis for axis in MOTION.axes if file.get((ids.gain_proportional, axis)) is not None)
    return tuned or MOTION.axes


def _refuse_no_gain(read: AxisParameters) -> None:
    """Raise SimulationError where the proportional gain is not above 0."""
    gain = read.number(ids.gain_proportional)
    if gain <= 0.0:
        what = "without it the axis does not follow" if gain == 0.0 else "below 0 the axis runs away"
        raise SimulationError(
            f"{read.called(ids.gain_proportional)} of axis {read.axis} is {gain:g}: {what}. Begin with"
            " 100 (page 5-3)",
            ids.gain_proportional,
        )


def bind(read: AxisParameters) -> AxisLaw:
    """Return one axis; raises SimulationError that names every register that has to be set."""
    _refuse_missing(read)
    _refuse_no_gain(read)
    # The bit of Drive Setup is lost; by 5-3 a velocity gain of 0 belongs to a drive that takes a velocity.
    current = read.number(ids.gain_velocity) != 0.0
    per_volt = None if read.value(_PER_VOLT) is None else read.within(_PER_VOLT, 1.0, 1e9)
    machine = plant.machine(current_reference=current, velocity_per_volt=per_volt)
    p, notes = _parameters(read, machine, current)
    assumed = plant.reasons(current_reference=current)
    if per_volt is not None:
        assumed.pop("velocity_per_output", None)
    return ModuleAxis(
        axis=read.axis,
        unit="counts",
        title=f"57C422B: scan of 1.25 ms, drive with {'current' if current else 'velocity'} reference",
        position_sample=loop.position_sample if current else loop.whole_sample,
        velocity_sample=loop.velocity_sample if current else None,
        parameters=p,
        state_size=loop.STATE,
        servo_period=loop.SCAN,
        velocity_period=loop.SCAN,
        machine=machine,
        output_unit="V",
        position_rate=p[loop.PROPORTIONAL] / loop.SCAN,
        feedrate=read.within(ids.command_velocity, 1e-3, 1e9),
        inposition_band=0.0
        if read.value(ids.in_position_tolerance) is None
        else read.within(ids.in_position_tolerance, 0.0, 1e9),
        ramps=_ramps(read),
        monitors=loop.MONITORS,
        alarms=_alarms(read, p),
        faults=_faults(read),
        stops_at="maximum_position_error",
        limits={"maximum_position_error": p[loop.POSITION_ERROR]} if p[loop.POSITION_ERROR] >= 0.0 else {},
        gains=("velocity_gain", "position_gain", "integral_gain"),
        follow=follow,
        sources=_sources(),
        assumptions=tuple(notes),
        assumed=assumed,
        sweep_parameters=_without_faults(p),
        linear_parameters=_linear(p),
        homing=partial(homing, read),
        travel=partial(travel, read, _ramps(read)["linear"]),
        jogging=partial(jogging, read, _ramps(read)["linear"]),
        read=read,
        names={parameter: read.called(parameter) for parameter in _COMMAND_DATA},
        scales=Scales(*(_scale(read, name) for name in _SCALES)),
        settled=_settled,
    )


def _refuse_missing(read: AxisParameters) -> None:
    """Raise SimulationError where a register that the loop needs is not set."""
    missing = [parameter for parameter in _NEEDED if read.value(parameter) is None]
    if missing:
        names = ", ".join(read.called(parameter) for parameter in missing)
        raise SimulationError(
            f"Axis {read.axis} cannot be simulated before these registers are set: {names}. Manual tuning"
            " begins with gains of 100, 0, 25 (0 for a velocity reference) and 0 (page 5-3)",
            missing[0],
        )


def _parameters(read: AxisParameters, machine: Machine, current: bool) -> tuple[list[float], list[str]]:
    """Return the figures of the loop by their places (``law_sample``), and what is assumed of them."""
    scales = [_scale(read, name) for name in _SCALES]
    p = [0.0] * loop.PARAMETERS
    gains = (ids.gain_proportional, ids.gain_integral, ids.gain_feedforward, ids.gain_velocity)
    places = (loop.PROPORTIONAL, loop.INTEGRAL, loop.FEED_FORWARD, loop.VELOCITY)
    for place, gain, scale in zip(places, gains, scales, strict=True):
        p[place] = read.within(gain, *_WORD) / scale
    p[loop.CURRENT_REFERENCE], p[loop.WHOLE_WORDS] = float(current), 1.0
    # So scaled, the output is the speed that the loop asks for, whatever the drive makes of a volt.
    if not current:
        p[loop.VELOCITY] = loop.WORDS_PER_VOLT / (machine.velocity_per_output * loop.SCAN)
    p[loop.DEADBAND] = read.within(ids.gain_deadband, *_WORD)
    p[loop.CLAMP] = read.within(ids.max_voltage, 0.005, 10.0) * loop.WORDS_PER_VOLT
    notes = [_LOST.format(*scales)]
    kind = "a current reference is simulated" if current else "a velocity reference is simulated"
    notes.append(_DIRECTION_NOTE.format(kind, f"{read.number(ids.gain_velocity):g}"))
    notes += [_DEADBAND] * (p[loop.DEADBAND] != 0.0) + [_MATCHED] * (not current) + [_S_CURVE]
    if any(
        read.optional(ids[f"output_linearization_{side}"]) not in (None, -1.0)
        for side in ("positive", "negative")
    ):
        notes.append(_LINEAR)
    for place, parameter, factor in (
        (loop.POSITION_ERROR, ids.max_position_error, 1.0),
        (loop.VELOCITY_ERROR, ids.max_velocity_error, loop.SCAN),
    ):
        limit = None if read.value(parameter) is None else read.within(parameter, 0.0, 1e9)
        p[place] = -1.0 if limit is None else limit * factor
        if limit is None:
            notes.append(f"{read.called(parameter)} is not set: simulated without this fault. Set it.")
    return p, notes


def _scale(read: AxisParameters, name: str) -> float:
    value = read.optional(name)
    if value is None:
        return MOTION.value(name.removeprefix("model."))
    return read.within(name, 1e-6, 1e9)


def _ramps(read: AxisParameters) -> Mapping[str, Ramp]:
    """Return the ramps of an axis in counts and s."""
    up, down = (
        read.within(ids.command_acceleration, -1e12, 1e12),
        read.within(ids.command_deceleration, -1e12, 1e12),
    )
    if up <= 0.0 or down <= 0.0:
        raise SimulationError(
            f"Axis {read.axis} has an acceleration of {up:g} and a deceleration of {down:g} counts/s2: the"
            " module answers a move with an illegal command fault (page 4-38). Both must be above 0",
            ids.command_acceleration if up <= 0.0 else ids.command_deceleration,
        )
    return {"linear": Ramp("linear", up, down), "s-curve": Ramp("sine-squared", up, down), "none": Ramp()}


def _alarms(read: AxisParameters, p: Sequence[float]) -> Mapping[int, AlarmText]:
    """Return number -> text of the alarms that switch the loop off."""
    return {
        1: AlarmText(
            "POSITION ERROR",
            f"The following error exceeds {read.called(ids.max_position_error)},"
            f" {p[loop.POSITION_ERROR]:.6g} counts:"
            " register 73, the loop is switched off (page 4-8)",
        ),
        2: AlarmText(
            "VELOCITY ERROR",
            f"The velocity error exceeds {read.called(ids.max_velocity_error)},"
            f" {p[loop.VELOCITY_ERROR]:.6g} counts a scan:"
            " register 73, the loop is switched off (page 4-9)",
        ),
    }


def _without_faults(p: Sequence[float]) -> list[float]:
    q = list(p)
    q[loop.POSITION_ERROR] = q[loop.VELOCITY_ERROR] = -1.0
    return q


def _linear(p: Sequence[float]) -> list[float]:
    """Return the figures of the linear model: broken words, and no deadband, which is a step."""
    q = list(p)
    q[loop.WHOLE_WORDS] = q[loop.DEADBAND] = 0.0
    return q


def _settled(axis: AxisLaw) -> AxisLaw:
    """Return the axis with what follows from its gains and its machine together."""
    p, machine = axis.parameters, axis.machine
    return replace(
        axis,
        rest_band=_rest_band(p, machine),
        predict=lambda speed: {"steady_following_error": _predicted(p, machine, speed)},
    )


def _rest_band(p: Sequence[float], machine: Machine) -> float:
    """Return how far from its target dry friction may keep the axis, counts;
    0 where the integral brings it there.
    """
    # The integral, or that of the drive, overcomes any friction in time.
    if p[loop.INTEGRAL] > 0.0 or machine.velocity_per_output > 0.0:
        return 0.0
    volts = max(machine.static_friction, machine.coulomb_friction) + abs(machine.gravity)
    return volts * loop.WORDS_PER_VOLT / abs(p[loop.VELOCITY] * p[loop.PROPORTIONAL]) + machine.position_count


def _predicted(p: Sequence[float], machine: Machine, speed: float) -> Prediction:
    """Return the following error at a steady speed in counts/s: none with an integral gain (page 5-4)."""
    commanded = speed * loop.SCAN
    volts = machine.viscous_friction * speed + machine.coulomb_friction + machine.gravity
    if machine.velocity_per_output > 0.0:
        volts = speed / machine.velocity_per_output
    words = volts * loop.WORDS_PER_VOLT
    # At the clamp of register 31 the speed is never reached.
    if words > p[loop.CLAMP]:
        return Prediction(None, "counts", "4-17")
    if p[loop.INTEGRAL] > 0.0:
        return Prediction(0.0, "counts", "5-4")
    left = (words - p[loop.DEADBAND]) / p[loop.VELOCITY] + commanded * (
        p[loop.CURRENT_REFERENCE] - p[loop.FEED_FORWARD]
    )
    return Prediction(abs(left) / p[loop.PROPORTIONAL], "counts", "5-4")


def _sources() -> Mapping[str, Source]:
    """Return from which register and page each figure of the law is."""
    return {
        "position_gain": Source(ids.gain_proportional, whole=True, largest=_WORD[1], page="4-7"),
        "velocity_gain": Source(ids.gain_velocity, whole=True, largest=_WORD[1], page="4-7"),
        "integral_gain": Source(ids.gain_integral, whole=True, largest=_WORD[1], page="4-7"),
        "feed_forward": Source(ids.gain_feedforward, whole=True, page="4-8"),
        "excess_error": Source(ids.max_position_error, whole=True, page="4-8"),
        "inposition_band": Source(ids.in_position_tolerance, whole=True, page="4-10"),
        "feedrate": Source(ids.command_velocity, page="4-13"),
        "linear_acceleration": Source(ids.command_acceleration, page="4-13"),
        "linear_deceleration": Source(ids.command_deceleration, page="4-14"),
    }


def advise(axis: AxisLaw, trace: Trace) -> Sequence[Recommendation]:
    """Return the Feedforward Gain after a move with a steady following error (page 5-4)."""
    error = error_at_speed(trace)
    # Below two counts the error is the encoder's, not the gain's.
    if trace.alarms or error is None or abs(error) < 2.0 or axis.parameters[loop.INTEGRAL] > 0.0:
        return ()
    return follow(axis)


def follow(axis: AxisLaw) -> Sequence[Recommendation]:
    """Return the Feedforward Gain that leaves as small an error as possible at the commanded speed,
    and none below 0 (page 5-4).

    None for a velocity reference: the drive's own velocity loop decides there.
    """
    p, speed = axis.parameters, axis.feedrate
    if not isinstance(axis, ModuleAxis) or not speed or p[loop.CURRENT_REFERENCE] == 0.0:
        return ()
    machine, commanded = axis.machine, speed * loop.SCAN
    words = (
        machine.viscous_friction * speed + machine.coulomb_friction + machine.gravity
    ) * loop.WORDS_PER_VOLT
    share = 1.0 + (words - p[loop.DEADBAND]) / p[loop.VELOCITY] / commanded
    # Rounded down: the error must not become negative (5-4).
    gain = float(math.floor(share * axis.scales.feed_forward))
    if not 0.0 <= gain <= _WORD[1] or abs(gain / axis.scales.feed_forward - p[loop.FEED_FORWARD]) < _SAME:
        return ()
    why = (
        "As small an error at the commanded speed as possible without going negative, with this Velocity Gain"
        " (page 5-4)."
    )
    return (Recommendation(ids.gain_feedforward, gain, "", why, "Overshoot in moves (page 4-30)."),)


_SAME = 5e-4
"""Difference of two feed-forward shares that is not worth a change: 4 of 8192."""


def _own_scenarios() -> dict[str, Scenario]:
    from .law_commands import COMMANDS
    from .law_passive import SCENARIO as PASSIVE

    return {**COMMANDS, PASSIVE.name: PASSIVE}


LAW = Law(
    bind=bind,
    axes=axes,
    advise=advise,
    probing=probing,
    own=_own_scenarios,
    machine_tests=machine_tests,
    cam=CAM,
)
