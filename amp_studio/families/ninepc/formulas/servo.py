"""The position loop and the velocity loop: chapter 7."""

from __future__ import annotations

import math
from collections.abc import Sequence

from amp_studio.validate import finite, not_negative, percent_of, positive, whole

POSITION_GAIN_UNIT = 0.001
"""Following error per unit of feedrate at gain 1 (page 7-25)."""

LARGEST_INERTIA_RATIO = 3
"""The last choice of Load Inertia Ratio is 1 : 3 (page 7-71)."""


# -- chapter 7: position loop


def reversal_first_direction(value: float) -> str:
    """First move that gets Reversal Error Compensation: "positive", "negative" or "none" (page 7-18).

    A negative value is added to the first positive move and a positive value to the first negative one;
    from then on its magnitude is added at every reversal. Zero compensates nothing.
    """
    if finite("Reversal Error Compensation", value) == 0:
        return "none"
    return "positive" if value < 0 else "negative"


def following_error(feedrate: float, gain: float) -> float:
    """Following error at a steady feedrate per minute, in the length unit of the feedrate (page 7-25)."""
    return not_negative("The feedrate", feedrate) * POSITION_GAIN_UNIT / positive("The gain", gain)


def following_error_with_feed_forward(feedrate: float, gain: float, percent: float) -> float:
    """Following error of a ZFE closed loop: 80 % leaves about 20 % of it (page 7-28)."""
    return following_error(feedrate, gain) * (1.0 - percent_of("Feed Forward Percent", percent) / 100.0)


def gain_from_following_error(feedrate: float, following_error: float) -> float:
    """Gain from a measured feedrate per minute and its following error (page 7-25)."""
    error = positive("The following error", following_error)
    return not_negative("The feedrate", feedrate) * POSITION_GAIN_UNIT / error


def gain_time_constant_ms(gain: float) -> float:
    """Initial Gain of Position Loop in the manual's "inverse milliseconds": 60 / gain (page 7-25)."""
    return 60.0 / positive("The gain", gain)


def reduced_gain(gain: float, break_ratio: float) -> float:
    """Gain beyond Gain Break Point; a ratio of 0.5 halves it, 1 leaves it (page 7-27)."""
    if not 0 <= break_ratio <= 1:
        raise ValueError(f"The gain break ratio must be 0 to 1, not {break_ratio!r}.")
    return positive("The gain", gain) * break_ratio


def gain_break_point(max_contouring: float, gain: float) -> float:
    """Typical, and smallest, Gain Break Point for a contouring speed per minute (page 7-22)."""
    return following_error(max_contouring, gain)


def minimum_excess_error(rapid: float, gain: float, break_ratio: float) -> float:
    """Smallest sensible Excess Error: 110 % of the following error at rapid (page 7-20)."""
    reduced = positive("The reduced gain (gain times gain break ratio)", reduced_gain(gain, break_ratio))
    return 1.1 * not_negative("The rapid feedrate", rapid) / (1000.0 * reduced)


def typical_suppression_point(excess_error: float) -> float:
    """Largest typical Feedrate Suppression Point, 10 % below Excess Error (page 7-21)."""
    return 0.9 * not_negative("Excess Error", excess_error)


def suppressed_feedrate(feedrate: float, following_error: float, suppression_point: float) -> float:
    """Feedrate the control makes: half while the following error is above the point (page 7-21).

    Feedrate Suppression Point and Excess Error being equal means "off"; that is the caller's to know.
    """
    point = not_negative("Feedrate Suppression Point", suppression_point)
    above = abs(finite("The following error", following_error)) > point
    return not_negative("The feedrate", feedrate) * (0.5 if above else 1.0)


def analog_voltage(servo_volts: float, motor_amps: float, drive_amps: float) -> float:
    """Analog Servo Voltage in V at which the drive gives the motor's rating (pages 7-41 and 7-43).

    10 V, 9 A and 15 A give 6 V, the positive voltage; -10 V gives -6 V, the negative one. Not for servos
    whose velocity loop the CNC serial drive closes. ValueError when the drive cannot give the motor's
    current.
    """
    if not 0 < abs(servo_volts) <= 10:
        raise ValueError(f"The servo voltage must be up to 10 V of either sign, not {servo_volts!r}.")
    drive = positive("The current of the drive", drive_amps)
    if positive("The current of the motor", motor_amps) > drive:
        raise ValueError(f"A drive of {drive_amps!r} A cannot give the motor {motor_amps!r} A.")
    return servo_volts * motor_amps / drive


# -- chapter 7: velocity loop


def acceleration_command(
    velocity_error: float, error_sum: float, proportional_gain: float, integral_gain: float
) -> float:
    """Acceleration command of the velocity loop, in its inner unit (pages 7-54 and 7-56).

    Velocity error times Velocity Proportional Gain, and the sum of all velocity errors times Velocity
    Integral Gain, added. The manual gives no unit for errors or command.
    """
    proportional = finite("The velocity error", velocity_error) * proportional_gain
    return proportional + finite("The sum of velocity errors", error_sum) * integral_gain


def velocity_gain_bounds(gain: float) -> tuple[float, float]:
    """Smallest and largest Velocity Proportional Gain for a position gain (page 7-54)."""
    return 3277.0 * positive("The gain", gain), 10923.0 * gain


def integral_gain_limit(gain: float) -> float:
    """Velocity Integral Gain must be above 0 and below this (page 7-56)."""
    return 1092.0 * positive("The gain", gain)


def gain_for_inertia(gain_without_load: float, load_ratio: float) -> float:
    """Velocity gain at motor : load inertia 1 : ``load_ratio``, as tables 7.B, 7.C grow (pages 7-54, 7-56).

    Ours, not printed: every column of the tables grows as 1 + load_ratio, but for one number (17460 for the
    B520E at 1 : 1, where 17476 would follow).
    """
    load = not_negative("The load inertia ratio", load_ratio)
    return not_negative("The velocity gain without load", gain_without_load) * (1.0 + load)


def standard_motor_gain(column: Sequence[float], load_ratio: float) -> float:
    """Velocity gain of a standard motor: the row of its column in table 7.B or 7.C (pages 7-54, 7-56).

    ``column`` is what the table prints for the motor at 1 : 0, 1 : 1 and so on, ``load_ratio`` the load's
    side of Load Inertia Ratio.
    """
    row = whole("The load inertia ratio", load_ratio, 0)
    if row >= len(column):
        raise ValueError(f"The column of the motor ends at 1 : {len(column) - 1}, before 1 : {row}.")
    return column[row]


def load_inertia_ratio(motor_inertia: float, load_inertia: float) -> int:
    """Load's side of Load Inertia Ratio for two inertias in one unit: 0 to 3, rounded up (page 7-71).

    "Generally it is better to round up"; above 1 : 3 the closest choice is 1 : 3.
    """
    ratio = not_negative("The inertia of the load", load_inertia) / positive(
        "The inertia of the motor", motor_inertia
    )
    return min(math.ceil(round(ratio, 9)), LARGEST_INERTIA_RATIO)


def continuous_voltage(motor_amps: float, amps_per_volt: float) -> float:
    """Card voltage in V for the motor's continuous current, by the amplifier's A/V (page 7-60)."""
    amplifier = positive("The amplifier output", amps_per_volt)
    return positive("The current of the motor", motor_amps) / amplifier


def peak_current_percent(positive_volts: float, negative_volts: float, continuous_volts: float) -> float:
    """Peak Current as a % of RMS of an analog system (page 7-60).

    The smaller magnitude of Analog Servo Pos. and Neg. Voltage over the voltage for continuous duty.
    (Table A.A of appendix A has "higher"; chapter 7 has "smaller" twice.)
    """
    peak = min(abs(finite("Analog Servo Pos. Voltage", positive_volts)), abs(negative_volts))
    continuous = positive("The voltage for continuous duty", continuous_volts)
    return 100.0 * positive("The smaller analog servo voltage", peak) / continuous


def torque_percent(desired_amps: float, rated_amps: float) -> float:
    """Maximum % Rated Torque: desired over rated motor current (pages 7-61 and 7-62)."""
    rated = positive("The rated current of the motor", rated_amps)
    return 100.0 * not_negative("The desired current of the motor", desired_amps) / rated


def torque_with_offset(demand_percent: float, offset_percent: float, direction: int = 1) -> float:
    """Signed torque the control really asks for, in % of the motor's maximum (page 7-63).

    ``direction`` is Torque Offset Direction, 1 or -1. With 1 % plus, a demand of 3 % becomes 4 %, one of
    -3 % becomes -2 %, and standstill 1 %.
    """
    if direction not in (1, -1):
        raise ValueError(f"Torque Offset Direction must be 1 or -1, not {direction!r}.")
    demand = finite("The torque demand", demand_percent)
    return demand + direction * percent_of("Torque Offset Percentage", offset_percent)


def maximum_servo_acceleration(torque: float, inertia: float) -> float:
    """Largest motor acceleration in rad/s2 from torque in N·m and inertia in N·m·s2/rad (page 7-67)."""
    return positive("The motor torque", torque) / positive("The effective inertia", inertia)


def maximum_motor_speed(
    feedrate: float, lead: float, motor_teeth: float = 1, screw_teeth: float = 1
) -> float:
    """Maximum Motor Speed in rpm: 10 % above what the highest feedrate needs (page 7-74)."""
    motor = whole("The number of motor teeth", motor_teeth)
    screw = whole("The number of screw teeth", screw_teeth)
    screw_rpm = not_negative("The feedrate", feedrate) / positive("Lead Screw Thread Pitch", lead)
    return 1.1 * screw_rpm * screw / motor


def friction_compensation(
    error_counts: float, previous_counts: float, threshold: float, friction: float, stiction: float
) -> float:
    """Torque added against friction in a servo scan, in % of continuous torque (pages 7-85 to 7-89).

    Nothing below the threshold (in feedback counts of following error), ``friction`` from it on, and
    ``stiction`` on top in the one scan in which the threshold is first reached.
    """
    limit = not_negative("Threshold for Friction Comp", threshold)
    moving = percent_of("The friction compensation", friction)
    start = percent_of("The stiction compensation", stiction)
    if abs(finite("The following error", error_counts)) < limit:
        return 0.0
    return moving + (start if abs(finite("The previous following error", previous_counts)) < limit else 0.0)
