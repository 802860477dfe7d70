"""The servo axes of a NUM 1020, 1040 or 1060: from the words of a parameter file to the law of one axis.

An axis is an address that P2 and P3 both declare (4-14) and that neither a spindle (P6) nor a handwheel (P14)
takes. Lengths of the file are internal units of P4 (4-18); here they are mm or deg. The drive is not in the
file: it is a velocity drive with its top speed (P30) at 9 V (6-14),
and all else of it is assumed and can be set.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
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
    SimulationError,
    Source,
)

from . import law_events as events
from . import law_sample as sample
from .formulas import approach_speed, circle_speed, increments_per_sample, measured_step
from .formulas.servo import FOLLOWING_ERROR_MARGIN
from .law_advice import advise, follow
from .law_facts import MOTION, ids
from .law_loop import LARGEST, loop
from .law_machine_tests import machine_tests
from .law_pair import drive_axis, is_synchronised, refuse_chain, synchronised
from .law_spindle import spindle, tapping
from .law_words import Words, above, read_words

if TYPE_CHECKING:
    from amp_studio.sim import Scenario

_ALWAYS = (
    (
        "A unit is what P11 makes of the counts: lead and lines of the encoder, of which it is made (5-6),"
        " are in no parameter. Measure the first move with a rule."
    ),
    (
        "The reference is KVAR / 1000 points for each internal unit of following error, in whole points of a"
        " converter with 32768 points at 10 V, and ends at 10 V (6-14)."
    ),
    (
        "The share of the speed reference that is added (6-26) is turned into a following error by the time"
        " constant of P66 or P56 (6-40); where it fits the gain, 100 % leaves no following error. The figures"
        " of 6-26 and 6-48 are lost."
    ),
    (
        "ASSUMED: position, reference and checks belong to the same moment of a sampling period; times of"
        " computation are not printed (set model.delay)."
    ),
    "Directions (P10, P20) are taken to fit the wiring.",
)

_CLAMPED = (
    "The axis has a clamp (P8): its reference comes only when the PLC has reported the end of unclamping"
    " (CRM), and the program goes on only when it has reported clamping (4-23). How long that takes is not"
    " in the file and is left out of the times here."
)
_NOT_SIMULATED = ("Not simulated: interaxis calibration, QVN and DISC loops (P70 to P87).",)


SCALE = "model.scale"


def axes(file: ParameterFile) -> tuple[str, ...]:
    """Return the addresses of the servo-controlled axes."""

    def word(parameter: str) -> int:
        value = file.evaluation.canonical((parameter, ""))
        return int(value) if isinstance(value, float) else 0

    # Measuring inputs 24 to 27 are of spindles, 28 to 31 of handwheels: P6 and P14 have a bit for each
    # (4-8).
    taken = (word(ids.spindle_measured) & 15) << 24 | (word(ids.axes_handwheels) & 15) << 28
    declared = word(ids.axes_measured) & word(ids.axes_servoed) & ~taken
    return tuple(str(address) for address in range(32) if declared >> address & 1)


def bind(read: AxisParameters) -> AxisLaw:
    """Return the law of one axis; raises SimulationError naming the words that are missing or impossible."""
    law, length = _alone(read)
    address = drive_axis(read)
    if address is None:
        return law
    if not is_synchronised(read):
        note = (
            f"The axis copies the reference of drive axis {address} (P27) without a correction (P28); its own"
            " words move it here."
        )
        return replace(law, assumptions=(*law.assumptions, note))
    leader = read.of(address)
    # Before the leader is bound: a chain would go round.
    refuse_chain(read, leader)
    return synchronised(law, read, _alone(leader)[0], length)


_FEEDBACK = (
    "Poor signal or channel loss of the encoder: the error of this axis is 210 and its address, {0}"
    " (page 5-18)"
)


def _alone(read: AxisParameters) -> tuple[AxisLaw, float]:
    """Return one axis without its drive axis, and its internal unit in u."""
    notes: list[str] = []
    try:
        words = read_words(read, notes)
        parameters, alarms, limits = loop(read, words, notes)
        machine = _machine(read, words)
    except SimulationError:
        raise
    except ValueError as error:  # of a formula
        raise SimulationError(f"Axis {read.axis}: {error}") from None
    ramps = _ramps(read, words.acceleration, notes)
    linear = list(parameters)
    # The linear model has no steps, no dry friction, no check and no limit: none of them has a transfer
    # function.
    linear[sample.WHOLE], linear[sample.FRICTION], linear[sample.TOLERANCE] = 0.0, 0.0, -1.0
    linear[sample.EMAX], linear[sample.BACKLASH] = math.inf, 0.0
    swept = list(parameters)
    # The check would end a swept sine, which no loop follows at its upper frequencies.
    swept[sample.TOLERANCE] = -1.0
    law = AxisLaw(
        axis=read.axis,
        unit=words.unit,
        title=(
            "NUM 1020/1040/1060: position loop with KVAR and speed anticipation, reference of 15 bits,"
            " velocity drive"
        ),
        position_sample=sample.position_sample,
        velocity_sample=None,
        parameters=parameters,
        state_size=sample.STATES,
        servo_period=words.period,
        velocity_period=words.period,
        machine=machine,
        output_unit="V",
        position_rate=words.rate,
        feedrate=words.top,
        inposition_band=read.number(ids.in_position_window) * words.length,
        ramps=ramps,
        monitors=(
            ("reference_points", "points"),
            ("theoretical_speed", f"{words.unit}/s"),
            ("measured_speed", f"{words.unit}/s"),
            ("synchronisation_error", words.unit),
        ),
        alarms=alarms,
        faults={"feedback": AlarmText("210 to 241", _FEEDBACK.format(read.axis))},
        predict=lambda feedrate: predicted(words, feedrate),
        circle_feedrate=lambda radius: circle_feedrate(words, radius),
        limits=limits,
        stops_at=LARGEST,
        sources=_sources(read, words),
        follow=follow,
        assumptions=(*notes, *_clamped(read), *_ALWAYS, *_NOT_SIMULATED),
        assumed=MOTION.reasons(
            "acceleration_per_output", "velocity_bandwidth", "velocity_integral", "inertia_ratio"
        ),
        linear_parameters=linear,
        sweep_parameters=swept,
        homing=partial(events.homing, read, words.length),
        jogging=partial(events.jogging, read, words.unit),
        travel=partial(events.travel, read, words.length),
        handwheel=partial(events.handwheel, read, words),
    )
    return law, words.length


def _clamped(read: AxisParameters) -> tuple[str, ...]:
    """Return what a clamp means for the times of an axis; nothing for one without."""
    word = int(read.optional(ids.axes_clamped, everywhere=True) or 0.0)
    return (_CLAMPED,) if word >> int(read.axis) & 1 else ()


def predicted(words: Words, feedrate: float) -> Mapping[str, Prediction]:
    """Return what the equations of chapter 6 give for a steady speed in u/s."""
    behind = abs(feedrate) * (1.0 / words.rate - words.anticipated)
    volts = words.voltage * abs(feedrate) / words.top
    increments = increments_per_sample(abs(feedrate) * 60.0, words.period * 1000.0, words.length)
    approach = {}
    if words.work_acceleration and words.curve_constant:
        speed = approach_speed(words.work_acceleration, words.curve_constant * 1000.0)
        approach["approach_speed"] = Prediction(speed, f"{words.unit}/min", "6-36")
    return {
        # Above 10 V the reference ends and the following error grows without end: there is no steady one.
        "steady_following_error": Prediction(behind if volts <= 10.0 else None, words.unit, "6-14"),
        "time_constant_following_error": Prediction(
            abs(feedrate) * words.constant * (1.0 - words.share), words.unit, "6-18"
        ),
        "reference": Prediction(volts if volts <= 10.0 else None, "V", "6-14"),
        "increments_per_sample": Prediction(increments, "increments", "6-6"),
        "maximum_following_error": Prediction(
            FOLLOWING_ERROR_MARGIN * words.top * words.constant, words.unit, "6-22"
        ),
        **approach,
    }


def circle_feedrate(words: Words, radius: float) -> float | None:
    """Return the speed in u/s to which the control lowers that on a circle:
    the root of 2 R x error over T (6-32).
    """
    if not (words.curve_error and words.curve_constant):
        return None
    return circle_speed(words.curve_error, words.curve_constant * 1000.0, radius) / 60.0


def _ramps(read: AxisParameters, acceleration: float, notes: list[str]) -> dict[str, Ramp]:
    """Return the ramps: in S (sin²) where bit 5 of P7N1 is set (9-6), else straight,
    with the fast acceleration of P32.
    """
    functions = read.optional(ids.functions_more, everywhere=True)
    least = read.optional(ids.acceleration_least_time, everywhere=True)
    if functions is None:
        notes.append("P7N1 is not set: the ramps are straight, as with bit 5 at 0 (9-6).")
    if least is None:
        notes.append("P53N0 is not set: 0 is taken, the sin² ramps of older software (6-38).")
    sine = Ramp("sine-squared", acceleration=acceleration, time=(least or 0.0) / 1000.0)
    straight = Ramp("linear", acceleration=acceleration)
    notes.append(
        "Bit 5 of P7N1 (speed variation in S, 9-6) chooses the sin² ramps of 6-38: acceleration sin², on"
        " average half of the greatest one, which is that of fast moves (G0, second word of P32, 6-10)."
        " ASSUMED: without it the ramp is straight with the whole of it; the figure of 6-10 is lost."
    )
    own = [sine, straight] if functions is not None and int(functions) >> 5 & 1 else [straight, sine]
    return {ramp.kind: ramp for ramp in (*own, Ramp("none"))}


def _machine(read: AxisParameters, words: Words) -> Machine:
    """Return the machine behind an axis: its measuring system by the file, drive and motor as assumed."""
    sensor = read.optional(ids.measure_sensor) or 0.0
    scale = read.optional(SCALE)
    if scale is not None and scale not in (0.0, 1.0):
        raise SimulationError(f"{SCALE} is {scale:g}; it is 0 or 1", SCALE)
    step = measured_step(read.number(ids.measure_multi), read.number(ids.measure_divi), sensor)
    above(step, ids.measure_multi, f"MULTI / DIVI (P11) of axis {read.axis}")
    ruled = int(sensor) >> 25 & 3 == 3
    return Machine(
        acceleration_per_output=words.acceleration / MOTION.value("acceleration_per_output"),
        velocity_per_output=words.top / words.voltage,
        velocity_bandwidth=MOTION.value("velocity_bandwidth"),
        velocity_integral=MOTION.value("velocity_integral"),
        output_limit=10.0,
        torque_limit_positive=MOTION.value("torque_limit"),
        torque_limit_negative=MOTION.value("torque_limit"),
        position_count=step * words.length,
        load_sensor=ruled if scale is None else scale == 1.0,
    )


def _sources(read: AxisParameters, words: Words) -> dict[str, Source]:
    """Return the words behind the figures, with the factor to the value in the file."""
    iu = 1.0 / words.length
    return {
        "position_gain": Source(
            ids.loop_gain, read.number(ids.loop_gain) / words.rate, "", True, page="6-14"
        ),
        "servo_period": Source(ids.sampling_period, 1e6, "us", True, page="9-10"),
        "excess_error": Source(ids.max_following_error, iu, "iu", True, page="6-22"),
        "inposition_band": Source(ids.in_position_window, iu, "iu", True, page="6-20"),
        "dynamic_check": Source(ids.movement_tolerance, 1000.0, "um/sample", True, page="6-24"),
        "feedrate": Source(ids.max_speed, 60.0, None, True, page="6-6"),
        "acceleration": Source(ids.acceleration_fast, 1.0, None, True, page="6-10"),
    }


def _own_scenarios() -> Mapping[str, Scenario]:
    from .law_clamp import SCENARIO as CLAMP

    return {CLAMP.name: CLAMP}


LAW = Law(
    bind,
    axes,
    advise=advise,
    own=_own_scenarios,
    spindle=spindle,
    tapping=tapping,
    machine_tests=machine_tests,
    path="amp_studio.families.num.law_path:path_rules",
)
