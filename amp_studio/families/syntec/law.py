"""The servo axes of a Syntec control: from the parameters of a file to the law of one axis.

The control sends whole pulses, the drive closes the loop (1.2.4, 1.4). Lengths of the file are counts of the
BLU (1.2.6); here they are mm or deg. Drive and mechanics are not in the file:
what is assumed about them is named in the result.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

from amp_studio.files import ParameterFile, fitted_axes
from amp_studio.sim import (
    AlarmText,
    AxisLaw,
    AxisParameters,
    Law,
    Machine,
    Prediction,
    Ramp,
    SimulationError,
    Source,
    value_text,
)

from . import law_events as events
from . import law_sample as sample
from .formulas import (
    DDA_LIMIT,
    alarm_speed,
    fatal_alarm_speed,
    hardware_basic_time_us,
    interpolation_time_us,
    is_basic_time_printed,
    pulse_length,
    pulses_per_turn,
)
from .formulas.resolution import STANDARD_BLU
from .law_advice import advise
from .law_facts import MOTION, ids
from .law_machine_tests import machine_tests
from .law_zones import zones

if TYPE_CHECKING:
    pass

_SHORTEST, _LONGEST = 1e-4, 0.1
"""s: interpolation times that are simulated."""

_NEEDED = (
    ids.axis_type,
    ids.resolution_encoder,
    ids.resolution_multiplication,
    ids.encoder_type,
    ids.screw_teeth,
    ids.motor_teeth,
    ids.resolution_pitch,
    ids.feed_rapid,
    ids.loop_gain,
)
_ABOVE_ZERO = (
    ids.resolution_encoder,
    ids.screw_teeth,
    ids.motor_teeth,
    ids.resolution_pitch,
    ids.feed_rapid,
    ids.loop_gain,
)
_NEEDED_ONCE = (ids.control_blu, ids.control_series, ids.interpolation_time)


@dataclass(frozen=True)
class _Axis:
    """What the parameters of one axis say, in u and s."""

    unit: str
    pulse: float
    gain: float
    rapid: float
    """u/s"""
    home: float
    """u/s: first homing speed, 0 where it is not set."""
    period: float
    most_pulses: float
    encoder: str

    @property
    def limits(self) -> tuple[float, float]:
        """Return the following errors in u beyond which MOT-019 and MOT-023 come (1.5.3, 1.5.4)."""
        if self.encoder == "none":
            return math.inf, math.inf
        speeds = alarm_speed(self.home, self.rapid), fatal_alarm_speed(self.home, self.rapid)
        return speeds[0] / self.gain, speeds[1] / self.gain


def axes(file: ParameterFile) -> tuple[str, ...]:
    """Return the axes that have a port, or are set to a type while the port is not set."""
    return tuple(a for a in fitted_axes(file) if file.get((ids.axis_port, a)) or file.get((ids.axis_type, a)))


def bind(read: AxisParameters) -> AxisLaw:
    """Return the law of one axis; raises SimulationError naming the parameters that are missing
    or impossible.
    """
    notes: list[str] = []
    _demand(read)
    try:
        axis = _axis(read, notes)
    except SimulationError:
        raise
    except ValueError as error:  # of a formula
        raise SimulationError(f"Axis {read.axis}: {error}") from None
    acceleration = _acceleration(read, axis, notes)
    parameters = _parameters(axis)
    linear = list(parameters)
    linear[sample.WHOLE] = 0.0
    # The linear model has no steps and never stops: limits would bend it.
    linear[sample.MAX_PULSES] = linear[sample.LIMIT] = linear[sample.FATAL_LIMIT] = math.inf
    limits = {"MOT-019": axis.limits[0], "MOT-023": axis.limits[1]}
    return AxisLaw(
        axis=read.axis,
        unit=axis.unit,
        title=(
            "Syntec: whole pulses in every interpolation time, position loop with loop gain, velocity drive"
        ),
        position_sample=sample.position_sample,
        velocity_sample=None,
        parameters=parameters,
        state_size=sample.STATES,
        servo_period=axis.period / sample.PARTS,
        velocity_period=axis.period / sample.PARTS,
        machine=_machine(axis, acceleration),
        output_unit=f"{axis.unit}/min",
        position_rate=axis.gain,
        feedrate=axis.rapid,
        inposition_band=axis.pulse,
        ramps={"linear": Ramp("linear", acceleration=acceleration), "none": Ramp("none")},
        monitors=(("pulses", "pulses"),),
        alarms=_alarms(axis),
        predict=lambda feedrate: predicted(axis, feedrate),
        limits=limits,
        stops_at="MOT-019",
        sources=_sources(read, axis),
        assumptions=(*notes, *_ALWAYS),
        assumed=MOTION.reasons(
            "acceleration_per_output", "velocity_bandwidth", "velocity_integral", "inertia_ratio"
        ),
        linear_parameters=linear,
        homing=partial(events.homing, read, _turn(read, axis)),
        jogging=partial(events.jogging, read),
        travel=partial(events.travel, read),
        handwheel=partial(events.handwheel, read),
    )


def _turn(read: AxisParameters, axis: _Axis) -> float:
    """Return u for a turn of the motor: from index to index."""
    if axis.encoder == "linear":
        return read.number(ids.resolution_pitch) * STANDARD_BLU
    return axis.pulse * pulses_per_turn(
        read.number(ids.resolution_encoder), float(read.choice(ids.resolution_multiplication))
    )


def predicted(axis: _Axis, feedrate: float) -> Mapping[str, Prediction]:
    """Return what the printed equations give for a steady speed in u/s."""
    pulses = abs(feedrate) * axis.period / axis.pulse
    # More pulses than the card can send are an alarm, and no steady error.
    behind = abs(feedrate) / axis.gain if pulses <= axis.most_pulses else None
    most = axis.most_pulses * axis.pulse / axis.period * 60.0
    found = {
        "steady_following_error": Prediction(behind, axis.unit, "1.5.3"),
        "pulses_per_interpolation_time": Prediction(pulses, "pulses", "1.4.1"),
    }
    if math.isfinite(axis.limits[0]):
        found["following_error_limit"] = Prediction(axis.limits[0], axis.unit, "1.5.3")
        found["fatal_following_error_limit"] = Prediction(axis.limits[1], axis.unit, "1.5.4")
    if math.isfinite(most):
        found["dda_feedrate"] = Prediction(most, f"{axis.unit}/min", "1.4.2")
    return found


def _demand(read: AxisParameters) -> None:
    """Raise one SimulationError with all parameters that are not set."""
    of_axis = list(_NEEDED)
    if read.value(ids.acceleration_time, everywhere=True) is None:
        of_axis.append(ids.axis_acceleration)
    read.require([*((name, read.axis) for name in of_axis), *((name, "") for name in _NEEDED_ONCE)])


def _axis(read: AxisParameters, notes: list[str]) -> _Axis:
    """Return what the parameters of one axis are in u and s; raises SimulationError for an impossible one."""
    unit = "mm" if read.choice(ids.axis_type) == "linear" else "deg"
    if read.choice(ids.control_blu, everywhere=True) != "standard":
        raise SimulationError(
            "The length of the BLU is printed for its default alone (1.2.6); this file has another one",
            ids.control_blu,
        )
    for name, everywhere in (*((name, False) for name in _ABOVE_ZERO), (ids.interpolation_time, True)):
        figure = read.number(name, everywhere=everywhere)
        if not (math.isfinite(figure) and figure > 0.0):
            raise SimulationError(
                f"{read.called(name, everywhere=everywhere)} of axis {read.axis} is {figure:g}; it must be"
                " above 0",
                name,
            )
    series = read.choice(ids.control_series, everywhere=True)
    basic = hardware_basic_time_us(series)
    if not is_basic_time_printed(series):
        notes.append(f"ASSUMED: hardware basic time {basic:g} us; for this series none is printed (1.4.1).")
    setting = read.number(ids.interpolation_time, everywhere=True)
    period = interpolation_time_us(setting, basic) * 1e-6
    if not _SHORTEST <= period <= _LONGEST:
        raise SimulationError(
            f"{read.called(ids.interpolation_time, everywhere=True)} is {setting:g}, an interpolation time of"
            f" {period * 1e3:g} ms; simulated are {_SHORTEST * 1e3:g} to {_LONGEST * 1e3:g} ms",
            ids.interpolation_time,
        )
    home = read.optional(ids.first_speed)
    if home is None:
        notes.append(
            "The first homing speed is not set: the alarm limits go by the rapid feedrate alone (1.5.3)."
        )
    return _Axis(
        unit=unit,
        pulse=_pulse(read, unit, notes),
        gain=read.number(ids.loop_gain),
        rapid=read.number(ids.feed_rapid) / 60.0,
        home=(home or 0.0) / 60.0,
        period=period,
        most_pulses=_most_pulses(read, notes),
        encoder=read.choice(ids.encoder_type),
    )


def _pulse(read: AxisParameters, unit: str, notes: list[str]) -> float:
    """Return the length of one pulse in u (1.2.5, 1.2.6)."""
    pulses = pulses_per_turn(
        read.number(ids.resolution_encoder), float(read.choice(ids.resolution_multiplication))
    )
    kind = read.choice(ids.encoder_type)
    if kind == "linear":
        if unit == "deg":
            raise SimulationError(
                f"Axis {read.axis} turns, and a linear encoder has pulses per mm (1.2.5)", ids.encoder_type
            )
        notes.append(
            "ASSUMED: a pulse of the command is one of the linear encoder (1.2.5); the drive is set up"
            " for it."
        )
        return 1.0 / pulses
    if kind == "none":
        notes.append(
            "The axis has no feedback (1.2.7): the control has no following error, and no alarm of it."
        )
    return pulse_length(
        read.number(ids.resolution_pitch) * STANDARD_BLU,
        pulses,
        read.number(ids.screw_teeth),
        read.number(ids.motor_teeth),
    )


def _most_pulses(read: AxisParameters, notes: list[str]) -> float:
    """Return the most pulses in one interpolation time: the DDA is that of generic controllers (1.4.1)."""
    if read.machine != "serial":
        return DDA_LIMIT
    notes.append("A serial controller has no DDA (1.4.1): no limit of pulses, but the same times are taken.")
    return math.inf


def _acceleration(read: AxisParameters, axis: _Axis, notes: list[str]) -> float:
    """Return the acceleration of the ramps in u/s2; what Pr541 and Pr401 mean together is not printed."""
    own = read.optional(ids.axis_acceleration)
    name, word = (ids.axis_acceleration, "Pr541 of the axis")
    if own is None:
        own, name, word = (
            read.number(ids.acceleration_time, everywhere=True),
            ids.acceleration_time,
            "Pr401",
        )
    if not (math.isfinite(own) and own > 0.0):
        raise SimulationError(f"{word} is {own:g}; a simulated axis needs a time above 0", name)
    notes.append(
        f"ASSUMED: {word}, {own:g}, is the time in ms in which a straight ramp reaches the rapid feedrate;"
        " neither unit nor ramp is printed (1.5.3)."
    )
    return axis.rapid / (own / 1000.0)


def _parameters(axis: _Axis) -> list[float]:
    """Return what the sample function takes."""
    p = [0.0] * sample.PARAMETERS
    p[sample.PULSE], p[sample.GAIN], p[sample.MAX_PULSES] = axis.pulse, axis.gain, axis.most_pulses
    p[sample.LIMIT], p[sample.FATAL_LIMIT] = axis.limits
    p[sample.WHOLE] = 1.0
    return p


def _machine(axis: _Axis, acceleration: float) -> Machine:
    """Return the assumed drive and mechanics."""
    return Machine(
        acceleration_per_output=acceleration / MOTION.value("acceleration_per_output"),
        velocity_per_output=1.0 / 60.0,
        velocity_bandwidth=MOTION.value("velocity_bandwidth"),
        velocity_integral=MOTION.value("velocity_integral"),
        torque_limit_positive=MOTION.value("torque_limit"),
        torque_limit_negative=MOTION.value("torque_limit"),
        position_count=axis.pulse,
        load_sensor=axis.encoder == "linear",
    )


def _alarms(axis: _Axis) -> dict[int, AlarmText]:
    """Return the texts of the alarms, with their limits."""
    first, fatal = (value_text(limit, axis.unit) for limit in axis.limits)
    fastest = "the greater of rapid feedrate and first homing speed / loop gain"
    return {
        int(sample.DDA_OVERFLOW): AlarmText(
            "MOT-005",
            f"DDA command overflow: more than {DDA_LIMIT:g} pulses in one interpolation time (1.5.1).",
        ),
        int(sample.EXCESS_ERROR): AlarmText(
            "MOT-019", f"Following error exceed: above {first}, 2 times {fastest} (1.5.3)."
        ),
        int(sample.FATAL_ERROR): AlarmText(
            "MOT-023", f"Fatal following error exceed: above {fatal}, 4 times {fastest} (1.5.4)."
        ),
    }


_ALWAYS = (
    "The BLU is 0.001 mm or deg, as delivered on a metric machine (1.2.6).",
    (
        "In every interpolation time the control sends the whole pulses of what was commanded up to its"
        " start, evenly spread (1.4.1); the following error is counted from the pulses that have left the"
        " card."
    ),
    (
        "Following error = speed / loop gain (1.5.3): the loop is proportional. ASSUMED: it is closed 8 times"
        " in one interpolation time, by drive or card, over the device that the control reads; a drive over"
        " its own where there is none."
    ),
    (
        "The run ends at the first alarm, so MOT-023 follows MOT-019 only where one interpolation time passes"
        " both limits."
    ),
    (
        "Not simulated, because unit or meaning is not printed: feed forward (Pr581), mechanical compensation"
        " (Pr1401), range of loss pulse (Pr561, MOT-008)."
    ),
)


def _sources(read: AxisParameters, axis: _Axis) -> dict[str, Source]:
    """Return the parameters behind the figures, with the factor to the value in the file."""
    setting = read.number(ids.interpolation_time, everywhere=True)
    own = read.value(ids.axis_acceleration) is not None
    ramp = (ids.axis_acceleration, "1.5.4") if own else (ids.acceleration_time, "1.5.3")
    return {
        "position_gain": Source(ids.loop_gain, whole=True, page="1.5.3"),
        "servo_period": Source(
            ids.interpolation_time, setting * sample.PARTS / axis.period, "", True, page="1.4.1"
        ),
        "feedrate": Source(ids.feed_rapid, 60.0, None, True, page="1.5.1"),
        "acceleration": Source(ramp[0], 1.0, "", True, page=ramp[1]),
    }


LAW = Law(
    bind,
    axes,
    advise=advise,
    zones=zones,
    machine_tests=machine_tests,
    path="amp_studio.families.syntec.law_path:path_rules",
)
