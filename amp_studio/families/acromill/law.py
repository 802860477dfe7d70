"""Binds an axis of AcroMill from a file: the gains of the Servo tab and of appendix C,
and the machine behind them.

Pages are those of the User's Guide.
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
    LoopFilter,
    Machine,
    Prediction,
    Ramp,
    Recommendation,
    SimulationError,
    Source,
    Trace,
    error_at_speed,
)

from . import law_events as events
from . import law_plant as plant
from . import law_sample as loop
from .law_facts import MOTION, ids
from .law_filters import PASS, Biquad, lopass, notch
from .law_machine_tests import machine_tests
from .law_spindle import probing, spindle

if TYPE_CHECKING:
    pass

_NORMAL_DAC_GAIN = 3276.8
"""Words of the converter for 1 V (page 114)."""

_GAINS = {
    loop.P_GAIN: ids.p_gain,
    loop.I_GAIN: ids.i_gain,
    loop.D_GAIN: ids.d_gain,
    loop.I_LIMIT: ids.i_limit,
    loop.VEL_FFWD: ids.vel_ffwd,
    loop.ACC_FFWD: ids.acc_ffwd,
    loop.FBVEL: ids.tuning_fbvel,
}
_MILLISECONDS = 1e-3
_MAX_LOPASS, _MAX_NOTCH = 0.1, 0.45
"""Share of the servo update frequency: up to a tenth of it LOPASS is of use (page 128); a notch must be below
the half."""
_SMALLEST_GAIN, _LARGEST_GAIN = 1e-9, 1e6

_NOTES = (
    (
        "Dac Polarity, the sign of DAC GAIN and that of Encoder Mult are taken to fit each other (page 114):"
        " with a wrong sign the motor runs away."
    ),
    (
        "The picture of the servo loop (page 95) and all traces of appendix C are lost. Taken: I Delay stops"
        " the integral, the derivative is constant between its samples, the output is rounded to words of"
        " 1/3276.8 V."
    ),
)
_FILTER_NOTE = (
    "How LOPASS and NOTCH fill the coefficients of their filters is not printed (page 128). Taken:"
    " second-order filters, 3 dB less at the frequency of LOPASS; at that of NOTCH the share 1 - width /"
    " frequency is left."
)


def axes(file: ParameterFile) -> Sequence[str]:
    """Return the axes of the machine: as many as in Number of Axes, all eight if it is not set (page 102)."""
    count = file.evaluation.canonical((ids.number_of_axes, ""))
    return MOTION.axes if not isinstance(count, float) else MOTION.axes[: max(0, int(count))]


def bind(read: AxisParameters) -> AxisLaw:
    """Return one axis; raises SimulationError naming the parameter that is missing or impossible."""
    pulses = read.within(ids.pulses_per_unit, 0.001, 1e9)
    period = read.within(ids.servo_period, 0.01, 100.0, everywhere=True) * _MILLISECONDS
    notes = list(_NOTES)
    p = _parameters(read, pulses, period, notes)
    excess, band = _or(read, ids.excess_error_band, 1e9), _or(read, ids.inposition_band, 1e9)
    p[loop.EXCESS] = excess * pulses
    if excess <= 0.0:
        notes.append(
            f"{read.called(ids.excess_error_band)} is 0, so every error would be too large (page 60):"
            " simulated without this limit. Set it."
        )
    machine = Machine(
        acceleration_per_output=plant.ACCELERATION / pulses,
        viscous_friction=plant.VISCOUS * pulses,
        coulomb_friction=plant.COULOMB,
        delay=plant.DELAY,
        output_limit=loop.FULL_VOLTS,
        motor_count=1.0 / pulses,
        position_count=1.0 / pulses,
        # Velocity feedback needs a second encoder, at the motor (135): the position is that of the load then.
        load_sensor=p[loop.FBVEL] != 0.0,
    )
    rapid = _or(read, ids.speeds_rapid, 1e9, everywhere=True)
    feedrate = rapid or _or(read, ids.max_machine, 1e9, everywhere=True)
    ramp = _or(read, ids.rapid_acc_dec, 1e12, everywhere=True)
    return AxisLaw(
        axis=read.axis,
        unit="mm",
        title=f"ACR controller: PID in volts every {period * 1e6:g} µs, amplifier in torque mode",
        position_sample=loop.position_sample,
        velocity_sample=None,
        parameters=p,
        state_size=loop.STATE,
        servo_period=period,
        velocity_period=period,
        machine=machine,
        output_unit="V",
        position_rate=1.0,  # and the rest band: `_settled`, with the machine that is going to move
        feedrate=feedrate / 60.0 if feedrate else None,
        inposition_band=band,
        ramps={"linear": Ramp("linear", ramp), "none": Ramp()},
        monitors=loop.MONITORS,
        alarms={1: AlarmText("EXCESS ERROR", _excess(excess))},
        homing=partial(events.homing, read, pulses),
        jogging=partial(events.jogging, read),
        travel=partial(events.travel, read),
        undamped=_UNDAMPED if p[loop.D_GAIN] == p[loop.FBVEL] == 0.0 else "",
        limits={"excess_error": excess} if excess > 0.0 else {},
        stops_at="excess_error",
        gains=("derivative_gain", "position_gain", "integral_gain"),
        filters=(
            LoopFilter("lopass", _MAX_LOPASS / period),
            LoopFilter("notch", _MAX_NOTCH / period, width="notch_width"),
        ),
        follow=follow,
        sources=_sources(pulses, ids.speeds_rapid if rapid else ids.max_machine),
        assumptions=tuple(notes),
        assumed=plant.REASONS,
        # A swept sine passes the limit of the error on purpose.
        sweep_parameters=[*p[: loop.EXCESS], 0.0, *p[loop.EXCESS + 1 :]],
        linear_parameters=_linear(p),
        settled=_settled,
    )


_UNDAMPED = (
    "D Gain is 0, as in a new file (page 59): nothing damps an axis in torque mode. Set D Gain first, then P"
    " Gain (page 115, steps 8 to 10)"
)


def _excess(band: float) -> str:
    return (
        f"The following error exceeds ExcessErr Band, {band:.6g} mm: the bit for not excess error goes off"
        " (page 114)"
    )


def _or(read: AxisParameters, parameter: str, most: float, *, everywhere: bool = False) -> float:
    """Return a figure from 0 to ``most``, 0 where it is not set."""
    if read.value(parameter, everywhere=everywhere) is None:
        return 0.0
    return read.within(parameter, 0.0, most, everywhere=everywhere)


def _parameters(read: AxisParameters, pulses: float, period: float, notes: list[str]) -> list[float]:
    """Return the figures of the loop by their places (``law_sample``); ``notes`` gets what is assumed."""
    p = [0.0] * loop.PARAMETERS
    for place, parameter in _GAINS.items():
        p[place] = read.within(parameter, -_LARGEST_GAIN, _LARGEST_GAIN)
    if abs(p[loop.P_GAIN]) < _SMALLEST_GAIN:
        raise SimulationError(
            f"{read.called(ids.p_gain)} of axis {read.axis} is {p[loop.P_GAIN]:g}: the loop is open and"
            " the axis would not follow (page 115)",
            ids.p_gain,
        )
    p[loop.PULSES], p[loop.PERIOD] = pulses, period
    p[loop.TORQUE_LIMIT] = read.within(ids.torque_limits, 0.001, 1000.0)
    p[loop.I_DELAY] = read.within(ids.i_delay, 0.0, 1e9) * _MILLISECONDS
    if p[loop.I_LIMIT] <= 0.0:  # no room to work in (page 59)
        p[loop.I_LIMIT] = p[loop.I_GAIN] = 0.0
    # D Time is sampled in whole servo periods; 0 means each of them (113).
    p[loop.D_PERIODS] = max(1.0, round(read.within(ids.d_time, 0.0, 1e6) * _MILLISECONDS / period))
    p[loop.DAC_SHARE] = _dac_share(read)
    p[loop.DAC_WORDS] = _NORMAL_DAC_GAIN
    sections = _filters(read, 1.0 / period)
    if sections != (PASS, PASS):
        notes.append(_FILTER_NOTE)
    p[loop.FILTERS :] = [figure for section in sections for figure in section]
    return p


def _dac_share(read: AxisParameters) -> float:
    """Return the volts put out for 1 V."""
    gain = read.number(ids.dac_gain)
    if not 1.0 <= abs(gain) <= 1e6:
        raise SimulationError(
            f"{read.called(ids.dac_gain)} of axis {read.axis} is {gain:g}: the output has no use. 3276.8"
            " is normal (page 114)",
            ids.dac_gain,
        )
    return abs(gain) / _NORMAL_DAC_GAIN


def _filters(read: AxisParameters, servo_hz: float) -> tuple[Biquad, Biquad]:
    low, middle = read.optional(ids.lopass_frequency), read.optional(ids.notch_frequency)
    width = read.optional(ids.notch_width)
    if (middle is None) != (width is None):
        raise SimulationError("NOTCH takes a frequency and a width: set both or none", ids.notch_width)
    first = PASS if low is None else lopass(low, servo_hz)
    return first, PASS if middle is None or width is None else notch(middle, width, servo_hz)


def _linear(p: Sequence[float]) -> list[float]:
    """Return the figures of the linear model: an ideal converter, every derivative sampled,
    the integral while it works.
    """
    q = list(p)
    q[loop.DAC_WORDS], q[loop.D_PERIODS] = 0.0, 1.0
    if q[loop.I_DELAY] > 0.0:  # it does not work in motion
        q[loop.I_GAIN] = 0.0
    return q


def _rate(p: Sequence[float], machine: Machine) -> float:
    """Return the rate in 1/s at which the loop follows: of the spring that P Gain is,
    or slower where D Gain brakes it.
    """
    volts = machine.acceleration_per_output * p[loop.DAC_SHARE] * p[loop.PULSES]
    stiffness = volts * abs(p[loop.P_GAIN])
    brake = (
        volts * abs(p[loop.D_GAIN] + p[loop.FBVEL])
        + machine.acceleration_per_output * machine.viscous_friction
    )
    undamped = math.sqrt(stiffness)
    # Overdamped, the slow pole is spring over brake: the axis creeps at that rate.
    return min(undamped, stiffness / brake) if brake > 0.0 else undamped


def _settled(axis: AxisLaw) -> AxisLaw:
    """Return the axis with what follows from its gains and its machine together."""
    p, machine = axis.parameters, axis.machine
    return replace(
        axis,
        position_rate=_rate(p, machine),
        rest_band=_rest_band(p, machine),
        predict=lambda speed: {"steady_following_error": _predicted(p, machine, speed)},
    )


def _rest_band(p: Sequence[float], machine: Machine) -> float:
    """Return how far from its target dry friction may keep the axis, u; 0 where the integral brings it
    there.
    """
    if p[loop.I_GAIN] > 0.0:
        return 0.0
    # P Gain alone stops pushing where its volts equal the friction: a count more, as the encoder rounds.
    volts = max(machine.static_friction, machine.coulomb_friction) + abs(machine.gravity)
    return volts / abs(p[loop.P_GAIN] * p[loop.PULSES] * p[loop.DAC_SHARE]) + machine.position_count


def _predicted(p: Sequence[float], machine: Machine, speed: float) -> Prediction:
    """Return the following error at a steady speed in u/s: what is left for P Gain,
    the equation of page 115 turned round.

    Vel FFwd = P Gain × error / speed is the Vel FFwd that leaves nothing.
    """
    pulses = speed * p[loop.PULSES]
    needed = machine.viscous_friction * speed + machine.coulomb_friction + machine.gravity
    # The torque cannot keep the speed: the following error grows without end.
    if needed > p[loop.TORQUE_LIMIT] * p[loop.DAC_SHARE]:
        return Prediction(None, "mm", "59")
    left = needed / p[loop.DAC_SHARE] + (p[loop.FBVEL] - p[loop.VEL_FFWD]) * pulses
    if p[loop.I_DELAY] == 0.0 and p[loop.I_GAIN] > 0.0:
        # The integral takes all that its limit allows; P Gain has the rest.
        left -= min(max(left, -p[loop.I_LIMIT]), p[loop.I_LIMIT])
    return Prediction(abs(left / p[loop.P_GAIN]) / p[loop.PULSES], "mm", "115")


def _sources(pulses: float, feedrate: str) -> Mapping[str, Source]:
    """Return from which parameter and page each figure of the law is."""
    return {
        "position_gain": Source(ids.p_gain, page="59"),
        "derivative_gain": Source(ids.d_gain, page="59"),
        "integral_gain": Source(ids.i_gain, page="59"),
        "feed_forward": Source(ids.vel_ffwd, page="59"),
        "excess_error": Source(ids.excess_error_band, page="60"),
        "inposition_band": Source(ids.inposition_band, page="60"),
        "lopass": Source(ids.lopass_frequency, page="128"),
        "notch": Source(ids.notch_frequency, page="128"),
        "notch_width": Source(ids.notch_width, page="128"),
        "feedrate": Source(feedrate, page="74"),
        "linear_acceleration": Source(ids.rapid_acc_dec, page="74"),
        "servo_period": Source(ids.servo_period, page="113"),
        "feedback_counts": Source(ids.pulses_per_unit, pulses, page="60"),
    }


def advise(axis: AxisLaw, trace: Trace) -> Sequence[Recommendation]:
    """Return the Vel FFwd after a move with a steady error (page 115)."""
    error, p = error_at_speed(trace), axis.parameters
    # With the integral at work there is no steady error that a feed-forward could take away.
    if trace.alarms or error is None or p[loop.I_DELAY] == 0.0 < p[loop.I_GAIN]:
        return ()
    return follow(axis) if abs(error * p[loop.PULSES]) >= 2.0 else ()


def follow(axis: AxisLaw) -> Sequence[Recommendation]:
    """Return the Vel FFwd that takes the steady error of the rapid feedrate away:
    P Gain x error / speed (page 115).
    """
    p, speed, machine = axis.parameters, axis.feedrate, axis.machine
    if not speed:
        return ()
    volts = machine.viscous_friction * speed + machine.coulomb_friction + machine.gravity
    # Three digits, as a person keys them in.
    wanted = float(f"{volts / p[loop.DAC_SHARE] / (speed * p[loop.PULSES]) + p[loop.FBVEL]:.3g}")
    if wanted < 0.0 or abs(wanted - p[loop.VEL_FFWD]) <= _SAME * wanted:
        return ()
    return (
        Recommendation(
            ids.vel_ffwd,
            wanted,
            "Vs/count",
            "No steady error at the rapid feedrate: what viscous and dry friction take there, for a pulse a"
            " second (page 115).",
            "The part that is dry friction is paid back at other speeds.",
        ),
    )


_SAME = 0.005
"""Share of the Vel FFwd by which another one is the same."""


LAW = Law(
    bind=bind,
    axes=axes,
    advise=advise,
    spindle=spindle,
    probing=probing,
    machine_tests=machine_tests,
    path="amp_studio.families.acromill.law_path:path_rules",
)
