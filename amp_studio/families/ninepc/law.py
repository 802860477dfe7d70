"""The servo axis of an Allen-Bradley 9/PC: the parameters it uses, and their meaning.

The only module of the simulator with ids of the 9/PC. Pages are those of the 9/PC AMP manual.

The unit of the velocity loop gains is an inference; the manual prints none. It bounds Velocity Proportional
Gain by 3277 to 10923 times the position gain (7-54) and Velocity Integral Gain by 1092 times it (7-56), and
states that the constants convert to inverse milliseconds, in which the position gain is 60 / gain (7-25). 65536
/ 3277 = 20, 65536 / 10923 = 6 and 65536 / 1092 = 60: read as value / 65536 per ms, the bounds say that the
velocity loop shall be 3 to 10 times as fast as the position loop, and its integral slower than the position
loop, at every gain. This is the textbook design of a cascade, and 65536 is the full scale of the 16-bit
value. The integral is taken in series with the proportional gain, a* = kp (e + ki sum(e)): then the 5 to 10
times between both gains at the end of the tuning procedure (appendix A, from A-8 on) are a damping of 1.1 to
1.6; added in parallel, per ms, they would be one of 0.25 to 0.65.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

from amp_studio.schema import Table, canonical, load_schema
from amp_studio.sim.axis_parameters import AxisParameters
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import Source
from amp_studio.sim.rigid.law import Law, MotorGains
from amp_studio.sim.rigid.servo import AxisServo
from amp_studio.sim.rounding import shown

MODEL = "9/PC axis"
PER_MS = 65536.0
"""Velocity loop gain for 1 per ms."""
RATE = 1000.0 / PER_MS
"""1/s for a velocity loop gain of 1."""
ANALOG_RATIO = 10923.0 * 60.0 / PER_MS
"""Ratio of velocity loop rate to position loop rate at the upper end of the printed bounds: 10."""

HARDWARE, LOOP, POSITION_LOOP = "servo.hardware_type", "servo.loop_type", "servo.position_loop_type"
FEEDBACK, COUNTS, PITCH = "servo.position_feedback_type", "servo.position_counts", "servo.lead_screw_pitch"
PERIOD = "servo.dcm_small_period"
PROPORTIONAL, INTEGRAL = "servo.velocity_proportional_gain", "servo.velocity_integral_gain"
TABLES, MOTOR, INERTIA = "servo.standard_motor_values", "servo.motor_type", "servo.load_inertia_ratio"
PEAK, MAX_ACCELERATION, CYCLE = "servo.peak_current", "servo.max_acceleration", "servo.sercos_cycle"
DELAY, SCAN, SCANS = "accdec.programmed_delay", "timing.fine_foreground", "timing.scans_per_logic"
OWN_ACCELERATION, VISCOUS, COULOMB, OWN_TRAVEL = (
    "model.acceleration_at_rated",
    "model.viscous_friction",
    "model.coulomb_friction",
    "model.travel_per_turn",
)

MODEL_SETTINGS = {
    OWN_ACCELERATION: "acceleration at 100 % of rated torque (mm/s2 or deg/s2)",
    VISCOUS: "friction at 1000 mm/min or deg/min (% of rated torque)",
    COULOMB: "dry friction (% of rated torque)",
    OWN_TRAVEL: "travel for one turn of the lead screw or table (mm or deg)",
}
"""Settings of the model that are not parameters of the control."""

_ALWAYS_READ = {
    "position_gain": Source("servo.initial_gain", page="7-25"),
    "inposition_band": Source("servo.inposition_band", page="7-24"),
    "feedrate_suppression": Source("servo.feedrate_suppression", page="7-21"),
    "excess_error": Source("servo.excess_error", page="7-20"),
    "linear_acceleration": Source("accdec.linear_acceleration", page="10-8"),
    "linear_deceleration": Source("accdec.linear_deceleration", page="10-10"),
}
_BREAK = {
    "gain_break_point": Source("servo.gain_break_point", page="7-22"),
    "gain_break_ratio": Source("servo.gain_break_ratio", page="7-27"),
}
_DIGITAL = {
    "velocity_rate": Source(PROPORTIONAL, 1.0 / RATE, "", True, page="7-54"),
    "integral_rate": Source(INTEGRAL, 1.0 / RATE, "", True, page="7-56"),
    "integrator_discharge": Source("servo.integrator_discharge", 1.0, "", True, page="7-58"),
    "torque_limit_positive": Source("servo.max_torque_positive", page="7-62"),
    "torque_limit_negative": Source("servo.max_torque_negative", page="7-61"),
}
_OTHERS = {
    "servo_period": Source(CYCLE, page="7-4"),
    "feedback_counts": Source(COUNTS, page="7-33"),
    "gear_teeth": Source("servo.position_gear_teeth", page="7-38"),
    "screw_teeth": Source("servo.position_screw_teeth", page="7-40"),
    "feed_forward": Source("servo.feed_forward", page="7-28"),
    "rapid_feedrate": Source("feedrate.rapid", page="9-1"),
    "cutting_feedrate": Source("feedrate.max_cutting", page="9-2"),
    "acceleration_at_rated": Source(OWN_ACCELERATION),
    "viscous_friction": Source(VISCOUS),
    "coulomb_friction": Source(COULOMB),
}

_NO_LOOP = {
    "open": "an open loop axis has no position loop",
    "off": "the servo is off",
    "detached": "the servo is detached",
    "depth-probe": "a depth probe is not moved by a servo",
}


def axis_servo(read: AxisParameters, motor_gains: MotorGains | None = None) -> AxisServo:
    """Return the servo of one axis from its parameters.

    ``motor_gains`` looks up the standard motor tables (Tables 7.B and 7.C); without it the gains of the file
    are used, with an assumption. Raises SimulationError for an axis whose loop the control does not
    close, and for a required parameter that is not set.
    """
    unit, loop, zfe = _kind(read)
    notes: list[str] = []
    needed = {**_ALWAYS_READ, **_BREAK}
    figures: dict[str, float] = {}
    for name, source in needed.items():
        # A ZFE axis does not use the gain break, but its place among the limits still counts (7-22).
        if not (zfe and name in _BREAK and read.value(source.parameter) is None):
            figures[name] = read.number(source.parameter)
    figures["servo_period"] = read.number(CYCLE, everywhere=True)
    sources = {**needed, **_OTHERS, "travel": _feedback(read, unit, figures, notes)}
    if loop == "digital":
        _digital(read, unit, figures, notes, motor_gains)
        sources.update(_DIGITAL)
    else:
        _analog(read, figures, notes)
    if zfe:
        figures["feed_forward"] = read.number("servo.feed_forward")
    figures["viscous_friction"] = read.optional(VISCOUS) or 0.0
    figures["coulomb_friction"] = read.optional(COULOMB) or 0.0
    time, scan = _exponential(read, notes)
    sources["exponential_time"] = Source(DELAY, 1.0 / scan if scan else 1.0, "", True, page="10-17")
    mode = read.value("accdec.positioning_mode", everywhere=True)
    return AxisServo(
        **figures,
        zero_following_error=zfe,
        ideal_feedback=False,
        exponential_time=time,
        positioning_ramp="linear" if mode is None else str(mode),
        rapid_feedrate=read.optional("feedrate.rapid") or None,
        cutting_feedrate=read.optional("feedrate.max_cutting") or None,
        unit=unit,
        axis=read.axis,
        model=MODEL,
        sources={
            name: replace(source, largest=_largest(source.parameter, unit))
            for name, source in sources.items()
        },
        assumptions=(*notes, *(_ZFE if zfe else _CLOSED), *_ALWAYS),
    )


def _largest(parameter_id: str, unit: str) -> float:
    """Return the upper bound that is printed for a parameter of an axis that moves in ``unit``, in canonical units."""
    parameter = load_schema("9pc").parameters.get(parameter_id)
    if parameter is None:
        return math.inf  # a setting of the model
    turning = (v.ranges for v in parameter.range_variants if v.when == "rotary_axis" and unit == "deg")
    ranges = next(turning, parameter.ranges or {})
    metric = ((printed, high) for printed, (_, high) in ranges.items() if not printed.startswith("in"))
    printed, high = next(metric, ("", None))
    return canonical(high, printed) if isinstance(high, float) else math.inf


def _printed_acceleration() -> float:
    """Return the printed default of Maximum Servo Acceleration in mm/s2 (Patch AMP values from 37-3 on)."""
    default = load_schema("9pc").parameters[MAX_ACCELERATION].default
    assert default is not None
    return canonical(float(default.value), default.unit)


def _kind(read: AxisParameters) -> tuple[str, str, bool]:
    """Return (unit, loop type, zero following error); raises SimulationError for an unsupported axis."""
    axis, kind = read.axis, read.choice("axis.type")
    if kind == "unfitted":
        raise SimulationError(f"Axis {axis} is unfitted. Choose another axis", "axis.type")
    if kind == "spindle":
        raise SimulationError(
            f"Axis {axis} is a spindle. Spindles are not simulated",
            "axis.type",
        )
    loop = read.choice(LOOP)
    if loop == "sercos":
        raise SimulationError(
            f"Axis {axis} has a third-party SERCOS drive. This drive closes both loops with settings"
            " that are not in this file",
            LOOP,
        )
    if loop not in ("digital", "analog") or read.value(HARDWARE) == "none":
        raise SimulationError(f"Axis {axis} has no servo. First set its servo hardware and loop type", LOOP)
    position = read.choice(POSITION_LOOP)
    if position not in ("closed", "zfe"):
        what = _NO_LOOP.get(position, f"loop type '{position}' has no closed position loop")
        raise SimulationError(f"Axis {axis} cannot be simulated: {what}", POSITION_LOOP)
    return ("deg" if kind == "rotary" else "mm"), loop, position == "zfe"


def _feedback(read: AxisParameters, unit: str, figures: dict[str, float], notes: list[str]) -> Source:
    """Set counts and travel of one cycle (7-33, 7-38, 7-40; coded markers of a scale: 7-33, B-2).

    Returns the source of the travel.
    """
    device = read.choice(FEEDBACK)
    if device == "none":
        raise SimulationError(f"Axis {read.axis} has no position feedback", FEEDBACK)
    figures["feedback_counts"] = read.number(COUNTS)
    own = read.optional(OWN_TRAVEL)
    if device == "dcm":
        figures["travel"] = read.number(PERIOD) if own is None else own
        return Source(PERIOD, page="7-44") if own is None else Source(OWN_TRAVEL)
    figures["gear_teeth"] = read.number("servo.position_gear_teeth")
    figures["screw_teeth"] = read.number("servo.position_screw_teeth")
    notes.append("One electrical cycle of the feedback device is taken as one turn: one marker (7-33).")
    if own is not None or unit == "deg":
        figures["travel"] = 360.0 if own is None else own
    if own is None and unit == "deg":
        notes.append(
            "The manual prints Lead Screw Thread Pitch in mm and inches only (7-17): one turn behind the"
            f" gears of this rotary axis is assumed to be 360 deg; set {OWN_TRAVEL} for another value."
        )
    if "travel" in figures:
        return Source(OWN_TRAVEL)
    figures["travel"] = read.number(PITCH)
    return Source(PITCH, page="7-17")


def _digital(
    read: AxisParameters,
    unit: str,
    figures: dict[str, float],
    notes: list[str],
    motor_gains: MotorGains | None,
) -> None:
    """Set the figures of a velocity loop that is closed by the 1394 drive."""
    proportional, integral = read.number(PROPORTIONAL), read.number(INTEGRAL)
    motor = read.value(MOTOR)
    by_hand = read.given(PROPORTIONAL) or read.given(INTEGRAL)
    if read.value(TABLES, everywhere=True) is True and motor not in (None, "nonstandard") and not by_hand:
        gains = motor_gains(str(motor), str(read.value(INERTIA))) if motor_gains else None
        if gains:
            proportional, integral = gains
            notes.append(
                f"Standard Motor Table Values is Yes: {shown(proportional, digits=6)} and {shown(integral, digits=6)} of Tables 7.B and 7.C"
                " replace the velocity loop gains of the file (7-6)."
            )
        else:
            notes.append(
                "Standard Motor Table Values is Yes, so the control takes the velocity loop gains from its"
                " tables (7-6); the gains of the file are simulated instead."
            )
        notes.append("The control may replace the torque limits for a standard motor (7-61).")
    figures["velocity_rate"], figures["integral_rate"] = proportional * RATE, integral * RATE
    for name in ("integrator_discharge", "torque_limit_positive", "torque_limit_negative"):
        figures[name] = read.number(_DIGITAL[name].parameter)
    notes.append(
        "Velocity Proportional Gain and Velocity Integral Gain act as value / 65536 per ms: an inference from"
        " the bounds of 7-54 and 7-56; the manual prints no unit."
    )
    own = read.optional(OWN_ACCELERATION)
    figures["acceleration_at_rated"] = _printed_acceleration() if own is None else own
    if own is None:
        notes.append(
            f"ASSUMED: {shown(_printed_acceleration(), digits=6)} {unit}/s2 at 100 % of rated torque. It is the printed default"
            " of Maximum Servo Acceleration (Patch AMP values, 37-3), a figure for peak current (7-67) that a"
            f" digital axis does not have; all torque results depend on it. Set {OWN_ACCELERATION}:"
            " rated torque / inertia, at the axis."
        )


def _analog(read: AxisParameters, figures: dict[str, float], notes: list[str]) -> None:
    """Set the figures of a velocity loop that is closed in an analog drive, with settings that are not in the file (7-2)."""
    figures["velocity_rate"] = ANALOG_RATIO * figures["position_gain"] * 1000.0 / 60.0
    notes.append(
        "ASSUMED: the drive closes the velocity loop itself (7-2), ten times as fast as the position loop and"
        " without an integral part, the upper end of the bounds of 7-54."
    )
    peak = _peak(read)
    figures["torque_limit_positive"] = figures["torque_limit_negative"] = peak
    own = read.optional(OWN_ACCELERATION)
    if own is None:
        figures["acceleration_at_rated"] = read.number(MAX_ACCELERATION) * 100.0 / peak
        notes.append(
            "Maximum Servo Acceleration is the acceleration at peak current (7-67); Peak Current as a % of"
            " RMS (7-60) converts it to rated torque and is the torque limit."
        )
    else:
        figures["acceleration_at_rated"] = own


def _peak(read: AxisParameters) -> float:
    choice = read.choice(PEAK)
    digits = choice.lstrip("p")
    if not digits.isdigit() or int(digits) == 0:
        raise SimulationError(f"{PEAK} of axis {read.axis} is '{choice}', not a percentage", PEAK)
    return float(digits)


def _exponential(read: AxisParameters, notes: list[str]) -> tuple[float | None, float | None]:
    """Return (time constant in ms, system scan time in ms) of exponential positioning, None if not set."""
    delay, fine = read.optional(DELAY, everywhere=True), read.optional(SCAN, everywhere=True)
    scans = read.optional(SCANS, everywhere=True)
    if delay is None or fine is None:
        return None, None
    scan = fine * (1.0 if scans is None else scans)
    notes.append(
        "One coarse iteration of Programmed Delay Constant (10-17) is assumed to be Fine Foreground Scan Time"
        f" times Fine Scans per Logic Scan (33-19), {scan:g} ms."
    )
    if not (math.isfinite(scan) and scan > 0.0):
        raise SimulationError(f"{SCAN} times {SCANS} is {scan:g} ms; it must be above 0", SCAN)
    return delay * scan, scan


_CLOSED = (
    (
        "The velocity command is proportional to the following error (7-14, 7-25); the part beyond the gain"
        " break point counts only gain break ratio times (7-22, 7-27), without a step (the"
        " figure of 7-23 was not legible)."
    ),
)
_ZFE = (
    (
        "Feed Forward Percent of the command velocity is added to the velocity command (7-15,"
        " 7-28); the gain break is not used (7-22, 7-27)."
    ),
)
_ALWAYS = (
    "The position loop runs at the SERCOS cycle, the servo update rate (7-4).",
    (
        "The PI velocity loop forms an acceleration command (7-54, 7-56); its integral discharges Discharge Rate"
        " times faster than it charges (7-58)."
    ),
    "Max % rated torque (+) and (-) limit the torque by its sign, not by the direction of travel (7-61, 7-62).",
    (
        "Torque filter, torque offset, friction compensation, reversal error and S-curve ramps are not"
        " simulated."
    ),
    (
        "A linear ramp of 0 means no ramp (10-8), a deceleration of 0 means the acceleration (10-10);"
        " Velocity Step for Acc/Dec is not used."
    ),
    "Excess error and feedrate suppression are checked once in each servo cycle (7-20, 7-21).",
)


def standard_gains(tables: Mapping[str, Table]) -> MotorGains | None:
    """Return a look-up in Tables 7.B and 7.C (pages 7-55, 7-56) by motor and inertia ratio keys."""
    proportional, integral = tables.get("7.B"), tables.get("7.C")
    if proportional is None or integral is None:
        return None

    def gains(motor: str, ratio: str) -> tuple[float, float] | None:
        row = int(ratio.removeprefix("r"))
        columns = proportional.column(motor.upper()), integral.column(motor.upper())
        if columns[0] is None or columns[1] is None:
            return None
        return float(columns[0][row]), float(columns[1][row])

    return gains


LAW = Law(axis_servo, MODEL_SETTINGS, standard_gains)
