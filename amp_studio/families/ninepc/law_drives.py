"""The three kinds of drive of a 9/PC axis: digital 1394, analog output, third-party SERCOS (7-2, 7-10)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from amp_studio.sim import AxisLaw, AxisParameters, Machine, SimulationError, value_text

from . import law_notes as notes_of
from . import law_samples as samples
from .law_facts import MOTION, ids
from .law_feedback import Feedback
from .law_figures import Loop, predictions
from .law_reading import above_zero, demand, if_set, not_negative
from .law_units import (
    CURRENT_LOOP,
    DELAY,
    NOMINAL,
    OWN_INERTIA,
    OWN_TORQUE,
    VELOCITY_PERIOD,
    Inertia,
    acceleration_for,
    inertia_of,
    lag_of,
    standard_gains,
    torque_for,
)

_RATIOS = ("r0", "r1", "r2", "r3")
FRICTION = {
    ids.friction_threshold: samples.THRESHOLD,
    ids.stiction_torque: samples.STICTION,
    ids.friction_positive: samples.FRICTION_POSITIVE,
    ids.friction_negative: samples.FRICTION_NEGATIVE,
}
_OWN_ACCELERATION, _OWN_GAIN = "model.acceleration_per_output", "model.position_gain"
_OWN_DELAY, _OWN_BANDWIDTH = "model.delay", "model.current_bandwidth"

FILTER_OFF = 10000.0
"""Hz: as high as possible is off (7-69)."""
_BRAKES = 2.0
"""s of regenerative braking after an E-stop (appendix A, overview)."""
VOLTS = 10.0
"""V: the end of the analog output (7-41)."""
_DRIVE_RATIO = MOTION.value("drive_ratio")
"""Velocity loop of an analog drive / position loop (10923 / 65536 per ms to gain / 60 per ms)."""
_USUAL_PITCH = MOTION.value("usual_pitch")
"""mm"""
_USUAL_GAIN = MOTION.value("usual_gain")
"""Initial Gain."""


@dataclass(frozen=True)
class Parts:
    """What every drive has: unit, devices, position loop, its array of parameters, the notes of the result,
    and fields of AxisLaw.
    """

    unit: str
    feedback: Feedback
    loop: Loop
    p: list[float]
    notes: list[str]
    common: dict[str, Any]


def digital(read: AxisParameters, parts: Parts) -> AxisLaw:
    """Return an axis whose velocity loop the 1394 closes: torque in % of rated torque."""
    feedback, loop, p, notes, common = parts.feedback, parts.loop, parts.p, parts.notes, parts.common
    motor = str(read.value(ids.motor_type) or "nonstandard")
    ratio = _inertia_ratio(read)
    proportional, integral = _gains(read, motor, ratio, notes)
    travel = feedback.motor_turn
    inertia = _inertia(read, motor, ratio, travel)
    p[samples.PROPORTIONAL], p[samples.INTEGRAL] = (
        torque_for(proportional, travel),
        torque_for(integral, travel),
    )
    p[samples.TORQUE_UNIT] = torque_for(1.0, travel)
    # A whole number of velocity samples in a SERCOS cycle, next to the inferred 1 ms.
    p[samples.PERIOD] = common["servo_period"] / max(1, round(common["servo_period"] / VELOCITY_PERIOD))
    delay, bandwidth = if_set(read, _OWN_DELAY, 1e3 * DELAY) / 1e3, if_set(read, _OWN_BANDWIDTH, CURRENT_LOOP)
    # ``_torque`` sets limits and filter in ``p``: what follows reads them.
    lag = lag_of(delay, bandwidth, _torque(read, p, notes))
    rate = 0.0 if p[samples.OPEN] else loop.rate
    notes += [notes_of.GAINS, notes_of.VELOCITY_LOOP, notes_of.LIMITS]
    notes += notes_of.gain_notes(proportional, integral, inertia.acceleration, rate, lag, motor)
    _speed(read, common, travel, notes)
    machine = Machine(
        acceleration_per_output=acceleration_for(inertia.acceleration, travel),
        inertia_ratio=float(ratio),
        gravity=p[samples.OFFSET],
        coulomb_friction=_dry(p),
        static_friction=_dry(p) + p[samples.STICTION],
        bandwidth=CURRENT_LOOP,
        delay=DELAY,
        motor_count=feedback.motor_count,
        position_count=feedback.position_count,
        load_sensor=feedback.on_load,
        # Friction is what the control compensates at the motor: all of it is taken to act there.
        motor_friction=1.0,
    )
    assumed = MOTION.reasons(bandwidth="current_loop", delay="delay")
    if inertia.why:
        assumed = {"acceleration_per_output": inertia.why + " All torques depend on it.", **assumed}
    if p[samples.OFFSET]:
        assumed["gravity"] = "The weight is taken as what Torque Offset Percentage balances (7-63)."
    if _dry(p) + p[samples.STICTION]:
        assumed["coulomb_friction"] = (
            "The friction is taken as what friction compensation is set to (7-87 to 7-89)."
        )
        assumed["static_friction"] = "The same with Stiction Comp Torque Percent (7-87)."
    return AxisLaw(
        **common,
        title="9/PC axis: position loop, velocity loop of the 1394, torque to the motor",
        position_sample=samples.position_sample,
        velocity_sample=samples.velocity_sample,
        parameters=p,
        sweep_parameters=_without_faults(p),
        linear_parameters=_linear(p),
        state_size=samples.STATE_SIZE,
        velocity_period=p[samples.PERIOD],
        machine=machine,
        output_unit="%",
        assumptions=tuple(notes),
        assumed=assumed,
        brakes=_BRAKES,
    )


def _inertia(read: AxisParameters, motor: str, ratio: int, travel: float) -> Inertia:
    """Return what the axis accelerates with: as it is set, as its motor is set, or as it is assumed."""
    own = read.optional(_OWN_ACCELERATION)
    if own is not None:
        demand(read, _OWN_ACCELERATION, own, own > 0.0, "must be above 0")
        return Inertia(100.0 * own * 2.0 * math.pi / travel, "")
    torque, inertia = (
        above_zero(read, name) if read.is_overridden(name) else None for name in (OWN_TORQUE, OWN_INERTIA)
    )
    return inertia_of(motor, ratio, read.tables, torque, inertia)


def _without_faults(p: list[float]) -> list[float]:
    """Return the array without limits of the following error and without reversal error compensation."""
    free = list(p)
    # A swept sine goes past them on purpose, and a reversal in every period would distort it.
    free[samples.EXCESS] = free[samples.SUPPRESSION] = math.inf
    free[samples.REVERSAL] = 0.0
    return free


def _linear(p: list[float]) -> list[float]:
    """Return the array of the loop near rest: without limits, gain break, discharge rate,
    offset and friction compensation.
    """
    linear = _without_faults(p)
    linear[samples.BREAK_POINT] = linear[samples.LIMIT_POSITIVE] = linear[samples.LIMIT_NEGATIVE] = math.inf
    linear[samples.VOLTS_LIMIT], linear[samples.DISCHARGE], linear[samples.OFFSET] = math.inf, 1.0, 0.0
    linear[samples.STICTION] = linear[samples.FRICTION_POSITIVE] = linear[samples.FRICTION_NEGATIVE] = 0.0
    return linear


def _inertia_ratio(read: AxisParameters) -> int:
    """Return the load's side of Load Inertia Ratio (7-71)."""
    key = str(read.value(ids.load_inertia_ratio) or "r0")
    if key not in _RATIOS:
        raise SimulationError(
            f"{read.called(ids.load_inertia_ratio)} of axis {read.axis} is '{key}', not one of"
            f" {', '.join(_RATIOS)}",
            ids.load_inertia_ratio,
        )
    return _RATIOS.index(key)


def _gains(read: AxisParameters, motor: str, ratio: int, notes: list[str]) -> tuple[float, float]:
    """Return the gains that the control uses: those of its tables for a standard motor,
    unless one is set by hand (7-6).
    """
    by_hand = read.is_overridden(ids.velocity_proportional_gain) or read.is_overridden(
        ids.velocity_integral_gain
    )
    if (
        read.value(ids.standard_motor_values, everywhere=True) is True
        and motor != "nonstandard"
        and not by_hand
    ):
        notes.append("The control may replace the torque limits for a standard motor (7-61).")
        cells = standard_gains(read.tables, motor, ratio)
        if cells is not None:
            notes.append(
                f"Standard Motor Table Values is Yes: {value_text(cells[0], digits=6)} and"
                f" {value_text(cells[1], digits=6)} of Tables 7.B and 7.C replace the velocity loop "
                "gains of the"
                " file (7-6)."
            )
            return cells
        notes.append(
            "Standard Motor Table Values is Yes, so the control takes the velocity loop gains from its tables"
            " (7-6), where this motor is not printed; the gains of the file are simulated instead."
        )
    return not_negative(read, ids.velocity_proportional_gain), not_negative(read, ids.velocity_integral_gain)


def _torque(read: AxisParameters, p: list[float], notes: list[str]) -> float:
    """Set discharge, limits, offset, filter and friction compensation; return the cutoff of the filter in
    Hz.
    """
    p[samples.DISCHARGE] = read.number(ids.integrator_discharge)
    demand(
        read, ids.integrator_discharge, p[samples.DISCHARGE], p[samples.DISCHARGE] >= 1.0, "must be 1 or more"
    )
    for name, place in (
        (ids.max_torque_positive, samples.LIMIT_POSITIVE),
        (ids.max_torque_negative, samples.LIMIT_NEGATIVE),
    ):
        p[place] = not_negative(read, name)
    offset = if_set(read, ids.torque_offset)
    if offset:
        sign = 1.0 if read.value(ids.torque_offset_direction) == "plus" else -1.0
        p[samples.OFFSET] = sign * offset * _peak(read) / 100.0
        notes.append(notes_of.OFFSET.format(value_text(p[samples.OFFSET])))
    for name, place in FRICTION.items():
        p[place] = if_set(read, name)
    if any(p[place] for place in FRICTION.values()):
        notes.append(notes_of.FRICTION)
    cutoff = read.optional(ids.torque_filter)
    p[samples.FILTER] = 1.0
    if cutoff is None or cutoff >= FILTER_OFF:
        return math.inf
    demand(read, ids.torque_filter, cutoff, cutoff > 0.0, "must be above 0")
    # The share that a first-order filter takes over in one sample, 1 - exp(-w T): exact for any cutoff,
    # also one near the sample rate.
    p[samples.FILTER] = -math.expm1(-2.0 * math.pi * cutoff * p[samples.PERIOD])
    notes.append(notes_of.FILTER)
    return cutoff


def _dry(p: list[float]) -> float:
    """Return the friction in % that friction compensation is set to, the mean of both directions."""
    return 0.5 * (p[samples.FRICTION_POSITIVE] + p[samples.FRICTION_NEGATIVE])


def _speed(read: AxisParameters, common: dict[str, Any], travel: float, notes: list[str]) -> None:
    """Say it where the rapid feedrate needs more than Maximum Motor Speed (7-74)."""
    most, rapid = if_set(read, ids.max_motor_speed), common["feedrate"]
    if most == 0.0 or rapid is None or rapid * 60.0 / travel <= most:
        return
    notes.append(
        f"The rapid feedrate needs {value_text(rapid * 60.0 / travel, 'rpm')} of the motor, more than Maximum"
        f" Motor Speed {value_text(most, 'rpm')} (7-74); the simulation does not limit the speed."
    )


def analog(read: AxisParameters, parts: Parts) -> AxisLaw:
    """Return an axis whose drive takes a voltage as velocity command (7-41 to 7-43)."""
    feedback, p, notes, common = parts.feedback, parts.p, parts.notes, parts.common
    rapid = common["feedrate"]
    if rapid is None:
        raise SimulationError(
            f"{read.called(ids.feedrate_rapid)} is not set for axis {read.axis}. An analog servo is scaled"
            " by it (7-41): set a value",
            ids.feedrate_rapid,
        )
    # The sign of the negative voltage is its direction; the loop needs its size alone.
    positive, negative = (
        _volts(read, ids.analog_positive_voltage, 1.0),
        _volts(read, ids.analog_negative_voltage, -1.0),
    )
    p[samples.VOLTS_POSITIVE], p[samples.VOLTS_NEGATIVE] = positive / rapid, negative / rapid
    p[samples.VOLTS_LIMIT] = VOLTS
    peak = _peak(read)
    acceleration, why = _analog_acceleration(read, parts.unit, feedback, peak)
    notes.append(notes_of.ANALOG)
    machine = Machine(
        acceleration_per_output=acceleration,
        velocity_per_output=rapid / positive,
        velocity_bandwidth=_DRIVE_RATIO * _USUAL_GAIN * 1000.0 / 60.0 / (2.0 * math.pi),
        output_limit=VOLTS,
        torque_limit_positive=peak,
        torque_limit_negative=peak,
        position_count=feedback.position_count,
        load_sensor=feedback.on_load,
    )
    assumed = MOTION.reasons(velocity_bandwidth="drive_ratio")
    if why:
        assumed["acceleration_per_output"] = why
    else:
        notes.append(
            "Maximum Servo Acceleration is the acceleration at peak current (7-67); Peak Current as a % of"
            " RMS (7-60) converts it to rated torque and is the torque limit."
        )
    return AxisLaw(
        **common,
        title="9/PC axis: position loop, voltage to a drive that closes the velocity loop",
        position_sample=samples.analog_sample,
        velocity_sample=None,
        parameters=p,
        sweep_parameters=_without_faults(p),
        linear_parameters=_linear(p),
        state_size=samples.STATE_SIZE,
        velocity_period=common["servo_period"],
        machine=machine,
        output_unit="V",
        assumptions=tuple(notes),
        assumed=assumed,
    )


def _analog_acceleration(
    read: AxisParameters, unit: str, feedback: Feedback, peak: float
) -> tuple[float, str]:
    """Return u/s2 for 1 % of rated torque and why it is assumed ("" where the file has it).

    The printed range and default of Maximum Servo Acceleration are in mm and inches (7-67, 37-3),
    so a rotary axis takes nothing from it.
    """
    if unit == "mm":
        most = above_zero(read, ids.max_acceleration)
        return most / peak, ""
    why = (
        "Maximum Servo Acceleration is printed in mm and inches only (7-67) and not taken for a rotary axis:"
        f" {NOMINAL:.0f} rad/s2 of the motor at rated torque, one turn of it for one of the table."
    )
    return acceleration_for(NOMINAL, feedback.turn), why


def _volts(read: AxisParameters, name: str, sign: float) -> float:
    """Return the size of a voltage at rapid (7-41, 7-43), ``sign`` that of its direction."""
    volts = read.number(name) * sign
    side = "above 0" if sign > 0.0 else "below 0"
    demand(read, name, volts * sign, 0.0 < volts <= VOLTS, f"must be {side} and 10 V at most")
    return volts


def _peak(read: AxisParameters) -> float:
    """Return the peak current in %; the choice is written p300 for 300 %."""
    choice = read.choice(ids.peak_current)
    digits = choice.lstrip("p")
    if not digits.isdigit() or int(digits) == 0:
        raise SimulationError(
            f"{read.called(ids.peak_current)} of axis {read.axis} is '{choice}', not a percentage",
            ids.peak_current,
        )
    return float(digits)


def third_party(read: AxisParameters, unit: str, common: dict[str, Any]) -> AxisLaw:
    """Return an axis with a third-party SERCOS drive: as far as the file goes,
    with the gain of most machines (7-2, 7-25).
    """
    own = read.optional(_OWN_GAIN)
    gain = _USUAL_GAIN if own is None else own
    demand(read, _OWN_GAIN, gain, gain > 0.0, "must be above 0")
    loop = Loop(gain, math.inf, 1.0, 0.0)
    p = [0.0] * samples.SIZE
    p[samples.GAIN], p[samples.BREAK_POINT], p[samples.BREAK_RATIO] = loop.rate, math.inf, 1.0
    p[samples.EXCESS] = p[samples.SUPPRESSION] = p[samples.VOLTS_LIMIT] = math.inf
    # The output is u/s itself: the drive gets velocities as numbers over the ring, without a scale of
    # volts.
    p[samples.VOLTS_POSITIVE] = p[samples.VOLTS_NEGATIVE] = 1.0
    turn = 360.0 if unit == "deg" else _USUAL_PITCH
    why = (
        f"The position gain of the drive is taken as {value_text(gain)}, that of most machines (7-25); set"
        f" {_OWN_GAIN}."
    )
    assumed = MOTION.reasons(velocity_bandwidth="drive_ratio") | {
        "acceleration_per_output": (
            f"Nothing of motor and load is in the file: {NOMINAL:.0f} rad/s2 at rated torque."
        )
    }
    return AxisLaw(
        **common,
        title="9/PC axis: third-party SERCOS drive, its loops assumed",
        position_sample=samples.analog_sample,
        velocity_sample=None,
        parameters=p,
        state_size=samples.STATE_SIZE,
        velocity_period=common["servo_period"],
        position_rate=loop.rate,
        predict=lambda feedrate: predictions(loop, unit, feedrate),
        monitors=[(name, of.replace("u", unit, 1)) for name, of in samples.MONITORS],
        machine=Machine(
            acceleration_per_output=acceleration_for(NOMINAL, turn),
            velocity_per_output=1.0,
            velocity_bandwidth=_DRIVE_RATIO * _USUAL_GAIN * 1000.0 / 60.0 / (2.0 * math.pi),
        ),
        output_unit=f"{unit}/s",
        assumptions=(notes_of.THIRD_PARTY, *((f"ASSUMED: {why}",) if own is None else ())),
        assumed=assumed,
    )
