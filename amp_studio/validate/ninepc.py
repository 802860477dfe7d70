"""The named formulas of the 9/PC AMP reference manual, chapters 3 to 7, 9, 10, 33 and appendix B.

Every function is pure. Unless its text says otherwise, lengths may be in any one unit (mm, inch or
degree), speeds are that unit per minute, accelerations that unit per second squared, and a gain is
the number of parameter 1710: gain 1 means 0.001 units of following error per unit per minute.

An argument that makes no sense raises ValueError with one sentence that names it. Where the manual
contradicts itself the formula is taken, not the printed number; the text of the function says so.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

COUNTS_PER_LINE = 4
"""Quadrature: each line of an encoder gives four counts (page 7-33)."""

COUNTS_PER_INCH_LIMIT = 4_194_304
"""More feedback counts per inch than this may hold the system in E-Stop (page 7-33)."""

POSITION_GAIN_UNIT = 0.001
"""Following error per unit of feedrate at gain 1 (page 7-25)."""

SERCOS_CYCLE_MS = (1, 30)
"""Range of Cycle Time for SERCOS (page 7-4)."""

JERK_SCANS = (2, 60)
"""Shortest and longest S-curve in coarse scans (page 10-19)."""


def _finite(what: str, value: float) -> float:
    if not math.isfinite(value):
        raise ValueError(f"{what} must be a finite number, not {value!r}.")
    return value


def _positive(what: str, value: float) -> float:
    if not (math.isfinite(value) and value > 0):
        raise ValueError(f"{what} must be greater than zero, not {value!r}.")
    return value


def _not_negative(what: str, value: float) -> float:
    if not (math.isfinite(value) and value >= 0):
        raise ValueError(f"{what} must not be negative, not {value!r}.")
    return value


def _whole(what: str, value: float) -> int:
    """A whole number of at least 1; doubles that hold one are welcome, CEL knows no others."""
    if not (math.isfinite(value) and value >= 1 and value == int(value)):
        raise ValueError(f"{what} must be a whole number of at least 1, not {value!r}.")
    return int(value)


def _percent(what: str, value: float, most: float = 100.0) -> float:
    if not (math.isfinite(value) and 0 <= value <= most):
        raise ValueError(f"{what} must be 0 to {most:g} %, not {value!r}.")
    return value


# ---------------------------------------------------------------- chapters 4 to 6: axis, home, zones


def rollover_position(position: float, move: float, rollover: float = 360.0) -> float:
    """Position of a rotary axis, in degrees, after a move; 0 switches rollover off (page 4-6)."""
    target = _finite("The position", position) + _finite("The move", move)
    return target % rollover if _not_negative("The rollover value", rollover) else target


def home_distance(marker_distance: float, calibration: float) -> float:
    """Signed way from the end of the home switch to home: nearest marker plus calibration (page 5-2)."""
    return _finite("The distance to the marker", marker_distance) + _finite("Home Calibration", calibration)


def dcm_position(scale_position: float, machine_position_at_zero: float) -> float:
    """Absolute axis position on a scale with distance-coded markers (page 5-6)."""
    zero = _finite("Machine Position at DCM Scale 0", machine_position_at_zero)
    return _finite("The position on the scale", scale_position) + zero


def inside_zone(position: Sequence[float], limits: Sequence[tuple[float, float]]) -> bool:
    """Whether a position lies in the block of one zone group (page 6-4).

    ``position`` and ``limits`` (minimum, maximum) hold the axes of the group only, in machine
    coordinates; an axis outside the group does not count. The manual says "between", so a position
    on a limit is not inside.
    """
    if len(position) != len(limits) or not limits:
        raise ValueError("A zone group needs at least one axis, and one pair of limits for each position.")
    if any(low > high for low, high in limits):
        raise ValueError("The minimum of a zone must not be above its maximum.")
    return all(low < value < high for value, (low, high) in zip(position, limits, strict=True))


# ---------------------------------------------------------------------------- chapter 7: SERCOS ring


def sercos_ring_baud(drives_mhz: Sequence[float]) -> float:
    """Baud rate of the ring in MHz: that of its slowest drive (page 7-3)."""
    if not drives_mhz:
        raise ValueError("A SERCOS ring needs at least one drive.")
    return min(_positive("The baud rate of a drive", rate) for rate in drives_mhz)


def sercos_ring_cycle(drives_ms: Sequence[float]) -> float:
    """Cycle time of the ring in ms: that of the drive with the slowest update (page 7-4)."""
    if not drives_ms:
        raise ValueError("A SERCOS ring needs at least one drive.")
    return max(_positive("The cycle time of a drive", cycle) for cycle in drives_ms)


def sercos_cycles(scan_ms: float) -> tuple[int, ...]:
    """SERCOS cycle times in ms that divide a system scan time evenly, within 1 to 30 ms (page 7-4)."""
    scan = _whole("The system scan time in ms", scan_ms)
    low, high = SERCOS_CYCLE_MS
    return tuple(cycle for cycle in range(low, min(scan, high) + 1) if scan % cycle == 0)


def sercos_servos(cycle_ms: float, baud_mhz: float) -> int | None:
    """Largest recommended number of servos on the ring (page 7-4).

    4 at 1 ms and 2 MHz, 8 from 2 ms on; None at 1 ms and 4 MHz, where the manual only says "more".
    """
    _positive("The baud rate", baud_mhz)
    if _whole("The SERCOS cycle time in ms", cycle_ms) >= 2:
        return 8
    return 4 if baud_mhz <= 2 else None


# ----------------------------------------------------------------- chapter 7, appendix B: feedback


def counts_per_cycle(lines: float) -> int:
    """Feedback counts per electrical cycle of an encoder with that many lines (page 7-33)."""
    return COUNTS_PER_LINE * _whole("The number of lines", lines)


def counts_per_revolution(counts_per_cycle: float, markers: float = 1) -> float:
    """Counts per encoder revolution; with two markers a cycle is half a revolution (page 7-33)."""
    counts = _positive("The number of counts per cycle", counts_per_cycle)
    return counts * _whole("The number of markers", markers)


def dcm_counts_per_cycle(signal_period_mm: float, interpolation: float, small_period_mm: float) -> int:
    """Counts over the smaller marker distance of a distance-coded scale (pages 7-33 and B-2).

    ``interpolation`` is the number of A-quad-B cycles per signal period of the grating. LS176:
    0.02 mm, 5 and 20 mm give 20,000. ValueError when the distance is no whole number of counts.
    """
    period = _positive("The signal period", signal_period_mm)
    cycles = _whole("The number of A-quad-B cycles per signal period", interpolation)
    counts = _positive("The smaller marker distance", small_period_mm) * cycles * COUNTS_PER_LINE / period
    if round(counts) < 1 or abs(counts - round(counts)) > 1e-6 * counts:
        raise ValueError(f"The smaller marker distance is {counts!r} counts, which is not a whole number.")
    return round(counts)


def scale_counts_per_cycle(lines: float, length: float, pitch: float) -> float:
    """Counts of a linear scale over one Lead Screw Thread Pitch (pages 7-33 and B-2).

    The scale has ``lines`` lines on ``length``. With 5000 lines on 0.5 inch and a pitch of 0.5 inch
    this is 20,000: the manual's own 5000 at that place leaves out the four counts of a line.
    """
    per_length = counts_per_cycle(lines) / _positive("The length of the lines", length)
    return per_length * _positive("Lead Screw Thread Pitch", pitch)


def lead_from_threads_per_inch(threads: float) -> float:
    """Lead Screw Thread Pitch in inches of a single-start screw (page 7-17)."""
    return 1.0 / _positive("The number of threads per inch", threads)


def screw_revolutions_per_feedback_revolution(gear_teeth: float, screw_teeth: float) -> float:
    """Gear ratio between position feedback device and lead screw (page 7-38).

    ``gear_teeth`` sit on the feedback device (1026), ``screw_teeth`` on the screw (1027). The same
    number of teeth passes on both wheels, so the screw makes gear / screw turns while the device makes one.
    """
    return _whole("The number of gear teeth", gear_teeth) / _whole("The number of screw teeth", screw_teeth)


def counts_per_length(counts_per_cycle: float, gear_teeth: float, screw_teeth: float, lead: float) -> float:
    """Feedback counts per unit of axis travel, in the unit of ``lead`` (pages 7-38 and 7-40)."""
    counts = _positive("The number of counts per cycle", counts_per_cycle)
    per_screw = counts / screw_revolutions_per_feedback_revolution(gear_teeth, screw_teeth)
    return per_screw / _positive("Lead Screw Thread Pitch", lead)


def counts_per_inch(counts_per_cycle: float, gear_teeth: float, screw_teeth: float, lead_mm: float) -> float:
    """Feedback counts per inch of travel with the lead in mm; see COUNTS_PER_INCH_LIMIT (page 7-33)."""
    return counts_per_length(counts_per_cycle, gear_teeth, screw_teeth, lead_mm) * 25.4


def lowest_terms(teeth_a: float, teeth_b: float) -> tuple[int, int]:
    """The gear ratio as an upload gives it back: 44:40 becomes 11:10 (page 7-38)."""
    a = _whole("The number of teeth", teeth_a)
    b = _whole("The number of teeth", teeth_b)
    divisor = math.gcd(a, b)
    return a // divisor, b // divisor


# ----------------------------------------------------------------------- chapter 7: position loop


def reversal_first_direction(value: float) -> str:
    """First move that gets Reversal Error Compensation: "positive", "negative" or "none" (page 7-18).

    A negative value is added to the first positive move and a positive value to the first negative one;
    from then on its magnitude is added at every reversal. Zero compensates nothing.
    """
    if _finite("Reversal Error Compensation", value) == 0:
        return "none"
    return "positive" if value < 0 else "negative"


def following_error(feedrate: float, gain: float) -> float:
    """Following error at a steady feedrate per minute, in the length unit of the feedrate (page 7-25)."""
    return _not_negative("The feedrate", feedrate) * POSITION_GAIN_UNIT / _positive("The gain", gain)


def following_error_with_feed_forward(feedrate: float, gain: float, percent: float) -> float:
    """Following error of a ZFE closed loop: 80 % leaves about 20 % of it (page 7-28)."""
    return following_error(feedrate, gain) * (1.0 - _percent("Feed Forward Percent", percent) / 100.0)


def gain_from_following_error(feedrate: float, following_error: float) -> float:
    """Gain from a measured feedrate per minute and its following error (page 7-25)."""
    error = _positive("The following error", following_error)
    return _not_negative("The feedrate", feedrate) * POSITION_GAIN_UNIT / error


def gain_time_constant_ms(gain: float) -> float:
    """Initial Gain of Position Loop in the manual's "inverse milliseconds": 60 / gain (page 7-25)."""
    return 60.0 / _positive("The gain", gain)


def reduced_gain(gain: float, break_ratio: float) -> float:
    """Gain beyond Gain Break Point; a ratio of 0.5 halves it, 1 leaves it (page 7-27)."""
    if not 0 <= break_ratio <= 1:
        raise ValueError(f"The gain break ratio must be 0 to 1, not {break_ratio!r}.")
    return _positive("The gain", gain) * break_ratio


def gain_break_point(max_contouring: float, gain: float) -> float:
    """Typical, and smallest, Gain Break Point for a contouring speed per minute (page 7-22)."""
    return following_error(max_contouring, gain)


def minimum_excess_error(rapid: float, gain: float, break_ratio: float) -> float:
    """Smallest sensible Excess Error: 110 % of the following error at rapid (page 7-20)."""
    reduced = _positive("The reduced gain (gain times gain break ratio)", reduced_gain(gain, break_ratio))
    return 1.1 * _not_negative("The rapid feedrate", rapid) / (1000.0 * reduced)


def typical_suppression_point(excess_error: float) -> float:
    """Largest typical Feedrate Suppression Point, 10 % below Excess Error (page 7-21)."""
    return 0.9 * _not_negative("Excess Error", excess_error)


def suppressed_feedrate(feedrate: float, following_error: float, suppression_point: float) -> float:
    """Feedrate the control makes: half while the following error is above the point (page 7-21).

    Feedrate Suppression Point and Excess Error being equal means "off"; that is the caller's to know.
    """
    point = _not_negative("Feedrate Suppression Point", suppression_point)
    above = abs(_finite("The following error", following_error)) > point
    return _not_negative("The feedrate", feedrate) * (0.5 if above else 1.0)


def analog_voltage(servo_volts: float, motor_amps: float, drive_amps: float) -> float:
    """Analog Servo Pos. or Neg. Voltage: card voltage at which the drive gives the motor's rating.

    10 V, 9 A and 15 A give 6 V; -10 V gives -6 V (pages 7-41 and 7-43). Not for servos whose velocity
    loop the CNC serial drive closes. ValueError when the drive cannot give the motor's current.
    """
    if not 0 < abs(servo_volts) <= 10:
        raise ValueError(f"The servo voltage must be up to 10 V of either sign, not {servo_volts!r}.")
    drive = _positive("The current of the drive", drive_amps)
    if _positive("The current of the motor", motor_amps) > drive:
        raise ValueError(f"A drive of {drive_amps!r} A cannot give the motor {motor_amps!r} A.")
    return servo_volts * motor_amps / drive


# ----------------------------------------------------------------------- chapter 7: velocity loop


def velocity_gain_bounds(gain: float) -> tuple[float, float]:
    """Smallest and largest Velocity Proportional Gain for a position gain (page 7-54)."""
    return 3277.0 * _positive("The gain", gain), 10923.0 * gain


def integral_gain_limit(gain: float) -> float:
    """Velocity Integral Gain must be above 0 and below this (page 7-56)."""
    return 1092.0 * _positive("The gain", gain)


def gain_for_inertia(gain_without_load: float, load_ratio: float) -> float:
    """Velocity gain of a standard motor for motor : load inertia of 1 : ``load_ratio``.

    Ours, not printed: every column of tables 7.B and 7.C (pages 7-54 and 7-56) grows as 1 + load_ratio,
    but for one number (17460 for the B520E at 1 : 1, where 17476 would follow).
    """
    load = _not_negative("The load inertia ratio", load_ratio)
    return _not_negative("The velocity gain without load", gain_without_load) * (1.0 + load)


def continuous_voltage(motor_amps: float, amps_per_volt: float) -> float:
    """Card voltage in V for the motor's continuous current, by the amplifier's A/V (page 7-60)."""
    amplifier = _positive("The amplifier output", amps_per_volt)
    return _positive("The current of the motor", motor_amps) / amplifier


def peak_current_percent(positive_volts: float, negative_volts: float, continuous_volts: float) -> float:
    """Peak Current as a % of RMS of an analog system (page 7-60).

    The smaller magnitude of Analog Servo Pos. and Neg. Voltage over the voltage for continuous duty.
    (Table A.A of appendix A says "higher"; chapter 7 says "smaller" twice.)
    """
    peak = min(abs(_finite("Analog Servo Pos. Voltage", positive_volts)), abs(negative_volts))
    continuous = _positive("The voltage for continuous duty", continuous_volts)
    return 100.0 * _positive("The smaller analog servo voltage", peak) / continuous


def torque_percent(desired_amps: float, rated_amps: float) -> float:
    """Maximum % Rated Torque: desired over rated motor current (pages 7-61 and 7-62)."""
    rated = _positive("The rated current of the motor", rated_amps)
    return 100.0 * _not_negative("The desired current of the motor", desired_amps) / rated


def torque_with_offset(demand_percent: float, offset_percent: float, direction: int = 1) -> float:
    """Signed torque the control really asks for, in % of the motor's maximum (page 7-63).

    ``direction`` is Torque Offset Direction, 1 or -1. With 1 % plus, a demand of 3 % becomes 4 %, one of
    -3 % becomes -2 %, and standstill 1 %.
    """
    if direction not in (1, -1):
        raise ValueError(f"Torque Offset Direction must be 1 or -1, not {direction!r}.")
    demand = _finite("The torque demand", demand_percent)
    return demand + direction * _percent("Torque Offset Percentage", offset_percent)


def maximum_servo_acceleration(torque: float, inertia: float) -> float:
    """Largest motor acceleration in rad/s2 from torque in N·m and inertia in N·m·s2/rad (page 7-67)."""
    return _positive("The motor torque", torque) / _positive("The effective inertia", inertia)


def maximum_motor_speed(
    feedrate: float, lead: float, motor_teeth: float = 1, screw_teeth: float = 1
) -> float:
    """Maximum Motor Speed in rpm: 10 % above what the highest feedrate needs (page 7-74)."""
    motor = _whole("The number of motor teeth", motor_teeth)
    screw = _whole("The number of screw teeth", screw_teeth)
    screw_rpm = _not_negative("The feedrate", feedrate) / _positive("Lead Screw Thread Pitch", lead)
    return 1.1 * screw_rpm * screw / motor


def friction_compensation(
    error_counts: float, previous_counts: float, threshold: float, friction: float, stiction: float
) -> float:
    """Torque added against friction in one servo scan, in % of the motor's continuous torque.

    Nothing below the threshold (in feedback counts of following error), ``friction`` from it on, and
    ``stiction`` on top in the one scan in which the threshold is first reached (pages 7-85 to 7-89).
    """
    limit = _not_negative("Threshold for Friction Comp", threshold)
    moving = _percent("The friction compensation", friction)
    start = _percent("The stiction compensation", stiction)
    if abs(_finite("The following error", error_counts)) < limit:
        return 0.0
    return moving + (start if abs(_finite("The previous following error", previous_counts)) < limit else 0.0)


def spindle_speed(motor_rpm: float, motor_teeth: float, shaft_teeth: float) -> float:
    """Spindle rpm behind the gear of a 1394 spindle (pages 7-82 and 7-83)."""
    motor = _whole("The number of motor teeth", motor_teeth)
    return _finite("The motor speed", motor_rpm) * motor / _whole("The number of shaft teeth", shaft_teeth)


# ------------------------------------------------------------------------------ chapter 9: feedrates


def vector_feedrate_limit(distances: Sequence[float], limits: Sequence[float]) -> float:
    """Highest path feedrate of a straight move at which no axis exceeds its own limit (pages 9-1, 9-2).

    ``limits`` are the rapid or maximum cutting feedrates of the axes whose ``distances`` are given.
    """
    if len(distances) != len(limits):
        raise ValueError("Every axis of the move needs its distance and its feedrate limit.")
    length = math.hypot(*(_finite("A distance", distance) for distance in distances))
    if length == 0:
        raise ValueError("A move without length has no feedrate.")
    pairs = zip(distances, limits, strict=True)
    return min(_not_negative("A feedrate limit", top) * length / abs(way) for way, top in pairs if way)


def f1_rapid(rapid: float, percent: float) -> float:
    """Rapid feedrate with the rapid override switch on F1; 0 % stands still (page 9-5)."""
    share = _percent("F1 Rapid Override Percent", percent) / 100.0
    return _not_negative("The rapid feedrate", rapid) * share


def arc_radius_error(
    start: tuple[float, float], end: tuple[float, float], center: tuple[float, float]
) -> float:
    """Difference of start and end radius, to compare with Circular Error Tolerance Limit (page 9-9)."""
    return abs(math.dist(start, center) - math.dist(end, center))


def arc_reaches(start: tuple[float, float], end: tuple[float, float], radius: float) -> bool:
    """Whether an arc given by R exists: start and end at most twice the radius apart (page 9-9)."""
    if _finite("The radius", radius) == 0:
        raise ValueError("The radius of an arc must not be zero.")
    return math.dist(start, end) <= 2.0 * abs(radius)


# ------------------------------------------------------------------------------- chapter 10: acc/dec


def response_time_ms(gain: float) -> float:
    """Time of the servo from one steady speed to another: 120 ms / gain (page 10-2).

    The table on that page prints 30 and 15 ms for the gains 3 and 4; the equation gives 40 and 30.
    """
    return 120.0 / _positive("The gain", gain)


def linear_ramp_per_ms(speed: float, response_ms: float) -> float:
    """Linear Acc/Dec ramp as the manual prints it: speed per minute, gained per ms (page 10-2)."""
    return _not_negative("The contouring speed", speed) / _positive("The response time", response_ms)


def linear_ramp(speed: float, response_ms: float) -> float:
    """The same ramp per second squared, as 1210 and 1211 want it: times 1000 ms/s over 60 s/min.

    ``speed`` per minute is the highest contouring speed, with ZFE Closed Loop the rapid feedrate (page 10-2).
    """
    return linear_ramp_per_ms(speed, response_ms) * 1000.0 / 60.0


def is_velocity_step(feedrate: float, next_feedrate: float, step: float) -> bool:
    """Whether the change between two blocks is made at once, without Acc/Dec (page 10-7).

    True up to and including Velocity Step for ACC/DEC; all three in one speed unit.
    """
    change = abs(_finite("The next feedrate", next_feedrate) - _finite("The feedrate", feedrate))
    return change <= _not_negative("Velocity Step for ACC/DEC", step)


def exponential_speed(
    start: float, commanded: float, elapsed_s: float, delay_constant: float, scan_ms: float
) -> float:
    """Axis speed a time after an exponential speed change began; up and down alike (page 10-14).

    start + (commanded - start)(1 - e^-x) with x = (1000 / scan_ms) elapsed_s / delay_constant; all speeds
    in one unit, ``elapsed_s`` in s, ``delay_constant`` in coarse scans, ``scan_ms`` in ms.
    """
    scans = 1000.0 / _positive("The system scan time", scan_ms) * _not_negative("The elapsed time", elapsed_s)
    x = scans / _positive("The delay constant", delay_constant)
    change = _finite("The commanded speed", commanded) - _finite("The start speed", start)
    return start - change * math.expm1(-x)


def exponential_time_ms(delay_constant: float, scan_ms: float) -> float:
    """Whole time of an exponential speed change in ms: five time constants (pages 10-14, 10-17)."""
    return 5.0 * _positive("The delay constant", delay_constant) * _positive("The system scan time", scan_ms)


def scurve_time(ramp: float, jerk: float) -> float:
    """S-curve time in s from a ramp and a jerk in units of one second: T = R / J (page 10-19)."""
    return _not_negative("The ramp", ramp) / _positive("The jerk", jerk)


def jerk_limits(ramp: float, scan_ms: float) -> tuple[float, float]:
    """Smallest and largest Axis Jerk for a ramp and the coarse scan time in ms (page 10-19).

    J = R / T with T of 60 and of 2 scans, per second: a ramp in mm/s2 gives mm/s3, one in in/min/s gives
    in/min/s2. (The second footnote on page 10-22 has the two scan counts exchanged.)
    """
    scan_s = _positive("The coarse scan time", scan_ms) / 1000.0
    shortest, longest = JERK_SCANS
    return _not_negative("The ramp", ramp) / (longest * scan_s), ramp / (shortest * scan_s)


# ----------------------------------------------------------------------------- chapter 33: timing


def fine_foreground_minimum_ms(axes_on_largest_drive: float) -> int:
    """Smallest Fine Foreground Scan Time: 7 ms and 1 ms per axis of the fullest drive (page 33-20)."""
    return 7 + _whole("The number of axes on the largest drive", axes_on_largest_drive)


def coarse_scan_ms(fine_ms: float, fine_scans: float) -> float:
    """Coarse scan time, which is the logic foreground interval, in ms (page 33-14)."""
    return _positive("Fine Foreground Scan Time", fine_ms) * _whole("Fine Scans per Logic Scan", fine_scans)


def fine_foreground_from_maximum_ms(fine_maximum_ms: float) -> int:
    """Fine Foreground Scan Time from the screen's maximum: twice that, rounded up to a ms (page 33-22)."""
    return math.ceil(2.0 * _positive("The maximum fine scan time", fine_maximum_ms))


def fine_scans_per_logic_scan(
    fine_ms: float, fine_maximum_ms: float, activation_maximum_ms: float, logic_maximum_ms: float
) -> int:
    """Fine Scans per Logic Scan from the maxima of the timing screen, all in ms (page 33-22).

    The larger of block activation interval and foreground logic time, plus the maximum fine scan time,
    over the fine scan time that was set; rounded up.
    """
    longer = max(
        _not_negative("The maximum block activation interval", activation_maximum_ms),
        _not_negative("The maximum foreground logic time", logic_maximum_ms),
    )
    needed = longer + _positive("The maximum fine scan time", fine_maximum_ms)
    return math.ceil(round(needed / _positive("Fine Foreground Scan Time", fine_ms), 9))
