"""Every worked example and printed table value of the 9/PC manual that a formula must give back.

Chapters 3 to 7, 9, 10, 33 and appendix B, with the page in the id of each case; further chapters have files of
their own beside this one. A number printed with n decimals is compared with the result rounded half up to n
decimals; all other comparisons are exact, or say so. Chapter 3 holds no arithmetic. Where a printed number
contradicts its own formula the formula is asserted and the misprint stands beside it.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from decimal import ROUND_HALF_UP, Decimal

import pytest

from amp_studio.families.ninepc import formulas as ninepc


def as_printed(value: float, decimals: int = 0) -> float:
    """The value as the manual would print it: rounded half up to so many decimals."""
    # Twelve significant digits first, so that 0.1 + 0.2 counts as the 0.3 it stands for.
    plain = Decimal(f"{value:.12g}")
    return float(plain.quantize(Decimal(1).scaleb(-decimals), rounding=ROUND_HALF_UP))


# -------------------------------------------------------------------------- chapters 4, 5 and 6


@pytest.mark.parametrize(
    ("position", "move", "rollover", "expected"),
    [
        pytest.param(270, 180, 360, 90, id="4-6 from 270 deg, 180 deg clockwise end at 90, not at 450"),
        pytest.param(270, 90, 360, 0, id="4-6 the position becomes zero at the rollover point"),
        pytest.param(270, 180, 0, 450, id="4-6 a rollover value of 0 switches rollover off"),
    ],
)
def test_a_rotary_axis_rolls_over(position: float, move: float, rollover: float, expected: float) -> None:
    assert ninepc.rollover_position(position, move, rollover) == expected


@pytest.mark.parametrize(
    ("marker", "calibration", "expected"),
    [
        pytest.param(3.0, 1.5, 4.5, id="5-2 step 8: marker distance plus Home Calibration"),
        pytest.param(3.0, -4.0, -1.0, id="5-2 step 9: the sum may point in either direction"),
    ],
)
def test_home_lies_at_the_marker_plus_calibration(marker: float, calibration: float, expected: float) -> None:
    assert ninepc.home_distance(marker, calibration) == expected


@pytest.mark.parametrize(
    ("scale", "zero", "expected"),
    [
        pytest.param(0, -5, -5, id="5-18 with -5 the zero marker of the scale is position -5"),
        pytest.param(120.5, -5, 115.5, id="5-6 new position = scale position + position at scale 0"),
        pytest.param(120.5, 0, 120.5, id="B-2 the LS176 example leaves it at 0"),
    ],
)
def test_a_coded_scale_is_shifted_by_its_zero(scale: float, zero: float, expected: float) -> None:
    assert ninepc.dcm_position(scale, zero) == expected


@pytest.mark.parametrize(
    ("position", "limits", "expected"),
    [
        pytest.param([10.5], [(10, 11)], True, id="6-4 group 1: Z between +10 and +11 is forbidden"),
        pytest.param([9.5], [(10, 11)], False, id="6-4 group 1: Z below +10 is free"),
        pytest.param([11.5], [(10, 11)], False, id="6-4 group 1: Z above +11 is free"),
        pytest.param([3, 4], [(2, 5), (2, 5)], True, id="6-4 group 2: X and Y both between +2 and +5"),
        pytest.param([3, 6], [(2, 5), (2, 5)], False, id="6-4 group 2: Y outside frees X"),
        pytest.param([1, 4], [(2, 5), (2, 5)], False, id="6-4 group 2: X outside frees Y"),
    ],
)
def test_a_zone_is_the_block_its_axes_enclose(
    position: list[float], limits: list[tuple[float, float]], expected: bool
) -> None:
    assert ninepc.inside_zone(position, limits) is expected


# ----------------------------------------------------------------------------- chapter 7: SERCOS


def test_the_slowest_drive_sets_the_ring() -> None:
    # Page 7-3: three drives with 4 MHz and one with 2 MHz make a ring of 2 MHz.
    assert ninepc.sercos_ring_baud([4, 4, 4, 2]) == 2
    # Page 7-4: three drives with 1 ms and one with 2 ms make a cycle of 2 ms.
    assert ninepc.sercos_ring_cycle([1, 1, 1, 2]) == 2


@pytest.mark.parametrize(
    ("scan_ms", "expected"),
    [
        pytest.param(6, (1, 2, 3, 6), id="7-4 a system scan of 6 ms allows 1, 2, 3 and 6 ms"),
        pytest.param(8, (1, 2, 4, 8), id="7-4 a system scan of 8 ms allows 1, 2, 4 and 8 ms"),
        pytest.param(6.0, (1, 2, 3, 6), id="7-4 the same with the doubles that a CEL rule hands over"),
        pytest.param(40, (1, 2, 4, 5, 8, 10, 20), id="7-4 40 ms divides itself but the range ends at 30"),
    ],
)
def test_sercos_cycles_divide_the_system_scan(scan_ms: float, expected: tuple[int, ...]) -> None:
    assert ninepc.sercos_cycles(scan_ms) == expected


@pytest.mark.parametrize(
    ("cycle_ms", "baud_mhz", "expected"),
    [
        pytest.param(1, 2, 4, id="7-4 not more than four servos at 1 ms and 2 MHz"),
        pytest.param(2, 2, 8, id="7-4 eight servos at 2 ms"),
        pytest.param(3, 2, 8, id="7-4 eight servos when slower than 2 ms"),
        pytest.param(1, 4, None, id="7-4 more are possible at 1 ms and 4 MHz, no number is given"),
    ],
)
def test_the_ring_holds_so_many_servos(cycle_ms: float, baud_mhz: float, expected: int | None) -> None:
    assert ninepc.sercos_servos(cycle_ms, baud_mhz) == expected


# ------------------------------------------------------------- chapter 7 and appendix B: feedback


def test_an_encoder_gives_four_counts_a_line() -> None:
    # Page 7-33: counts per cycle = 4 x lines per electrical cycle (7-49 the same for velocity).
    assert ninepc.counts_per_cycle(500) == 2000
    # The range on pages 7-33 and 7-49 begins at 4 counts, which is one line.
    assert ninepc.counts_per_cycle(1) == 4


@pytest.mark.parametrize(
    ("markers", "expected"),
    [
        pytest.param(1, 2000, id="7-33 with one marker a cycle is one revolution"),
        pytest.param(2, 4000, id="7-33 with two markers a cycle is half a revolution"),
    ],
)
def test_counts_of_a_revolution(markers: int, expected: float) -> None:
    assert ninepc.counts_per_revolution(2000, markers) == expected


def test_the_ls176_scale_gives_20000_counts() -> None:
    # Page 7-33: 0.02 mm / 5 = 0.004 mm a cycle, / 4 = 0.001 mm a count, 20 mm / 0.001 mm = 20,000.
    # Page B-2, table B.1, prints the same 20,000 for the grating of 20 um and the smaller period of 20 mm.
    assert ninepc.dcm_counts_per_cycle(0.02, 5, 20) == 20_000
    # The steps on the way: one A-quad-B cycle, and one count.
    assert ninepc.dcm_counts_per_cycle(0.02, 5, 0.004) == 4
    assert ninepc.dcm_counts_per_cycle(0.02, 5, 0.001) == 1


def test_the_larger_period_is_one_grating_longer() -> None:
    # Page B-2: 20.02 mm against 20 mm; 20 counts of 0.001 mm tell the markers apart.
    assert ninepc.dcm_counts_per_cycle(0.02, 5, 20.02) == 20_020


@pytest.mark.parametrize(
    ("lines", "length", "pitch", "expected"),
    [
        # Misprint on pages 7-33, 7-38 and 7-40: "5000 lines per .5 inch, enter 5000". A line gives four
        # counts (7-33), and page B-2 asks for counts over the pitch.
        pytest.param(5000, 0.5, 0.5, 20_000, id="7-33 a scale of 5000 lines in 0.5 inch, 5000 is printed"),
        pytest.param(5000, 0.5, 1.0, 40_000, id="B-2 counts over an entered pitch of one inch"),
        pytest.param(5000, 0.5, 0.25, 10_000, id="B-2 a smaller pitch brings the counts into the range"),
    ],
)
def test_a_plain_scale_counts_over_its_pitch(
    lines: int, length: float, pitch: float, expected: float
) -> None:
    assert ninepc.scale_counts_per_cycle(lines, length, pitch) == expected


def test_five_threads_per_inch_are_a_pitch_of_020_inch() -> None:
    # Page 7-17: 1 inch / 5 threads = .20 inch.
    assert ninepc.lead_from_threads_per_inch(5) == 0.20


@pytest.mark.parametrize(
    ("teeth", "expected"),
    [
        pytest.param((44, 40), (11, 10), id="7-38 and 7-40 a ratio of 44:40 comes back as 11:10"),
        pytest.param((1, 1), (1, 1), id="7-33 and B-2 one to one for a linear scale"),
        pytest.param((11, 10), (11, 10), id="7-38 what is reduced stays as it is"),
    ],
)
def test_gear_teeth_are_reduced(teeth: tuple[int, int], expected: tuple[int, int]) -> None:
    assert ninepc.lowest_terms(*teeth) == expected


def test_a_larger_screw_wheel_means_more_counts() -> None:
    # Pages 7-38 and 7-40: the ratio is screw revolutions between feedback revolutions. A device with 20
    # teeth on a screw with 40 teeth turns twice per screw turn, so the screw makes 0.5 turns.
    assert ninepc.screw_revolutions_per_feedback_revolution(20, 40) == 0.5
    # 2000 counts a turn, two turns on a lead of 5 mm: 800 counts per mm.
    assert ninepc.counts_per_length(2000, 20, 40, 5) == 800
    assert ninepc.counts_per_length(2000, 40, 20, 5) == 200


@pytest.mark.parametrize(
    ("counts", "pitch", "expected"),
    [
        pytest.param(2000, 1.0, 2000, id="30-6 depth probe with 2000 counts in 1 inch"),
        pytest.param(3000, 0.5, 6000, id="30-6 depth probe with 3000 counts in 0.5 inch"),
    ],
)
def test_counts_per_length_of_a_depth_probe(counts: float, pitch: float, expected: float) -> None:
    assert ninepc.counts_per_length(counts, 1, 1, pitch) == expected


@pytest.mark.parametrize(
    ("counts", "lead_mm", "expected"),
    [
        pytest.param(1_048_576, 12.7, 2_097_152, id="7-33 HR absolute on 0.5 inch stays below the limit"),
        pytest.param(2_097_152, 12.7, 4_194_304, id="7-33 HR incremental on 0.5 inch meets the limit"),
        pytest.param(2_097_152, 5.08, 10_485_760, id="7-33 HR incremental on 0.20 inch exceeds it"),
    ],
)
def test_counts_per_inch_of_the_high_resolution_devices(
    counts: float, lead_mm: float, expected: float
) -> None:
    # Both factors are printed (7-33); the product is ours, so rounding noise of the division is allowed.
    assert as_printed(ninepc.counts_per_inch(counts, 1, 1, lead_mm)) == expected
    assert (expected > ninepc.COUNTS_PER_INCH_LIMIT) == (lead_mm < 12)


# ------------------------------------------------------------------------ chapter 7: position loop


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        pytest.param(-0.02, "positive", id="7-18 a negative value joins the first positive move"),
        pytest.param(0.02, "negative", id="7-18 a positive value joins the first negative move"),
        pytest.param(0.0, "none", id="7-18 zero compensates nothing"),
    ],
)
def test_the_sign_of_reversal_error_picks_the_first_move(value: float, expected: str) -> None:
    assert ninepc.reversal_first_direction(value) == expected


def test_gain_one_is_a_thousandth_per_unit_of_feedrate() -> None:
    # Page 7-25: gain 1 is 0.001 mm of following error for each 1 mm/min.
    assert ninepc.following_error(1, 1) == 0.001
    # The same equation turned round: gain = feedrate / following error in thousandths.
    assert ninepc.gain_from_following_error(1, 0.001) == 1


TABLE_7A = [(0.25, 0.0040, 240), (0.50, 0.0020, 120), (1.00, 0.0010, 60), (2.00, 0.0005, 30)]


@pytest.mark.parametrize(
    ("gain", "error_mm", "inverse_ms"),
    [pytest.param(*row, id=f"7-25 table 7.A, gain {row[0]}") for row in TABLE_7A],
)
def test_table_7a(gain: float, error_mm: float, inverse_ms: float) -> None:
    # Printed with four decimals: following error in mm per mm/min.
    assert as_printed(ninepc.following_error(1, gain), 4) == error_mm
    assert as_printed(ninepc.gain_from_following_error(1, error_mm), 2) == gain
    assert ninepc.gain_time_constant_ms(gain) == inverse_ms


@pytest.mark.parametrize(
    ("ratio", "expected"),
    [
        pytest.param(1.0, 2.0, id="7-27 a ratio of one is no gain break"),
        pytest.param(0.5, 1.0, id="7-27 a ratio of .5 halves the gain"),
    ],
)
def test_the_gain_breaks_by_its_ratio(ratio: float, expected: float) -> None:
    assert ninepc.reduced_gain(2.0, ratio) == expected


@pytest.mark.parametrize(
    ("percent", "share"),
    [
        pytest.param(80, 0.20, id="7-28 80 % leave about 20 % of the following error"),
        pytest.param(0, 1.00, id="7-28 0 % is a plain closed loop"),
        pytest.param(100, 0.00, id="7-28 100 % leaves next to nothing at constant speed"),
    ],
)
def test_feed_forward_leaves_the_rest(percent: float, share: float) -> None:
    left = ninepc.following_error_with_feed_forward(1000, 1, percent)
    # 1000 mm/min at gain 1 have a following error of 1 mm, so the share reads in mm.
    assert as_printed(left, 2) == share


@pytest.mark.parametrize(
    ("rapid", "gain", "ratio", "expected"),
    [
        # rapid x 1.1 / (gain x 1000 x ratio); the manual prints no numbers, these are worked by hand.
        pytest.param(10_000, 1, 1, 11.0, id="7-20 10 m/min at gain 1 without gain break"),
        pytest.param(10_000, 1, 0.5, 22.0, id="7-20 half the gain at rapid doubles the following error"),
        pytest.param(10_000, 2, 1, 5.5, id="7-20 twice the gain halves it"),
        pytest.param(400, 1, 1, 0.44, id="7-20 in inches: 400 in/min need 0.44 inch"),
    ],
)
def test_minimum_excess_error(rapid: float, gain: float, ratio: float, expected: float) -> None:
    assert as_printed(ninepc.minimum_excess_error(rapid, gain, ratio), 4) == expected


def test_minimum_excess_error_is_110_percent_of_the_following_error() -> None:
    # Page 7-20 says 110 % of the largest following error expected; that is the gain equation of 7-25.
    assert ninepc.minimum_excess_error(10_160, 1, 1) == pytest.approx(1.1 * ninepc.following_error(10_160, 1))


def test_gain_break_point_is_the_error_at_contouring_speed() -> None:
    # Page 7-22: contouring speed x .001 / gain.
    assert ninepc.gain_break_point(2540, 1) == 2.54
    assert ninepc.gain_break_point(2540, 2) == 1.27


def test_feedrate_suppression() -> None:
    # Page 7-21: the feedrate falls by 50 % above the point, and returns below it.
    assert ninepc.suppressed_feedrate(1000, 5.1, 5.0) == 500
    assert ninepc.suppressed_feedrate(1000, -5.1, 5.0) == 500
    assert ninepc.suppressed_feedrate(1000, 4.9, 5.0) == 1000
    # Page 7-21: a usual value is at least 10 % below Excess Error.
    assert ninepc.typical_suppression_point(10.0) == 9.0


@pytest.mark.parametrize(
    ("volts", "expected"),
    [
        pytest.param(10, 6, id="7-41 10 V x 9 A / 15 A = 6 V"),
        pytest.param(-10, -6, id="7-43 -10 V x 9 A / 15 A = -6 V"),
    ],
)
def test_analog_servo_voltage(volts: float, expected: float) -> None:
    assert ninepc.analog_voltage(volts, 9, 15) == expected


# ------------------------------------------------------------------------ chapter 7: velocity loop


def test_velocity_gain_bounds() -> None:
    # Page 7-54: gain x 3277 <= Velocity Proportional Gain <= gain x 10923.
    assert ninepc.velocity_gain_bounds(1) == (3277, 10923)
    assert ninepc.velocity_gain_bounds(2) == (6554, 21846)
    # Erratum: the default 17408 (37-4) and the 17400 of the screen (7-1) break it at the default gain 1.
    assert all(printed > ninepc.velocity_gain_bounds(1)[1] for printed in (17408, 17400))
    # Erratum: the 1500 to begin tuning with keeps it only below gain 0.458.
    assert as_printed(1500 / ninepc.velocity_gain_bounds(1)[0], 3) == 0.458


def test_integral_gain_limit() -> None:
    # Page 7-56: 0 < Velocity Integral Gain < gain x 1092; default 82 (37-4) and screen 112 (7-1) keep it.
    assert ninepc.integral_gain_limit(1) == 1092
    assert all(printed < ninepc.integral_gain_limit(1) for printed in (82, 112))


TABLE_7B = {
    "B410G B410J": [1000, 2000, 3000, 4000],
    "B420E B420H": [2000, 4000, 6000, 8000],
    "B430E B430G B740E": [3000, 6000, 9000, 12000],
    "B515E B515G": [7500, 15000, 22500, 30000],
    # Misprint on page 7-54: 17460 at 1 : 1. The other two loads of this motor are 3 and 4 times 8738.
    "B520E": [8738, 17476, 26214, 34952],
    "B520F": [6000, 12000, 18000, 24000],
    "B530E": [10000, 20000, 30000, 40000],
    "B720E": [3600, 7200, 10800, 14400],
    "B730E": [22000, 44000, 66000, 88000],
}
TABLE_7C = {
    "B410G B410J": [70, 140, 210, 280],
    "B420E B520H B730E": [100, 200, 300, 400],
    "B430E B430G": [150, 300, 450, 600],
    "B515E B515G": [300, 600, 900, 1200],
    "B520E B520F": [400, 800, 1200, 1600],
    "B530E": [500, 1000, 1500, 2000],
    "B720E": [30, 60, 90, 120],
    "B740E": [20, 40, 60, 80],
}


@pytest.mark.parametrize(
    "column",
    [
        *(pytest.param(column, id=f"7-54 table 7.B {motor}") for motor, column in TABLE_7B.items()),
        *(pytest.param(column, id=f"7-56 table 7.C {motor}") for motor, column in TABLE_7C.items()),
    ],
)
def test_standard_motor_gains_grow_with_the_load(column: list[float]) -> None:
    assert [ninepc.gain_for_inertia(column[0], load) for load in (0, 1, 2, 3)] == column


def test_peak_current_of_an_analog_system() -> None:
    # Page 7-60: continuous current over A/V is the voltage for continuous duty ...
    assert ninepc.continuous_voltage(4.5, 1.5) == 3
    # ... and the smaller analog voltage over it is the percentage; 200 % and 300 % are what can be chosen.
    assert ninepc.peak_current_percent(6, -6, 3) == 200
    assert ninepc.peak_current_percent(9, -9.5, 3) == 300


def test_rated_torque_is_a_share_of_the_rated_current() -> None:
    # Pages 7-61 and 7-62: desired over rated motor current; the default is 200 %, the range ends at 300 %.
    assert ninepc.torque_percent(6, 3) == 200
    assert ninepc.torque_percent(9, 3) == 300


@pytest.mark.parametrize(
    ("demand", "expected"),
    [
        pytest.param(3, 4, id="7-63 1 % plus: 3 % in the positive direction becomes 4 %"),
        pytest.param(-3, -2, id="7-63 1 % plus: 3 % in the negative direction becomes 2 %"),
        pytest.param(0, 1, id="7-63 1 % plus: at standstill 1 % in the positive direction"),
    ],
)
def test_torque_offset(demand: float, expected: float) -> None:
    assert ninepc.torque_with_offset(demand, 1) == expected


def test_torque_offset_minus_works_the_other_way() -> None:
    # Page 7-64: the direction is the one in which the offset adds.
    assert ninepc.torque_with_offset(3, 1, -1) == 2
    assert ninepc.torque_with_offset(-3, 1, -1) == -4


def test_maximum_servo_acceleration() -> None:
    # Page 7-67: torque over effective inertia; 12 N·m on 0.004 N·m·s2/rad turn up by 3000 rad/s2.
    assert ninepc.maximum_servo_acceleration(12, 0.004) == 3000


def test_maximum_motor_speed_has_ten_percent_in_hand() -> None:
    # Page 7-74: about 10 % above what the highest feedrate needs. 10,000 mm/min on 5 mm are 2000 rpm.
    assert as_printed(ninepc.maximum_motor_speed(10_000, 5)) == 2200
    # A motor wheel of 20 teeth on a screw wheel of 40 has to turn twice as fast.
    assert as_printed(ninepc.maximum_motor_speed(10_000, 5, 20, 40)) == 4400


def test_spindle_gear() -> None:
    # Page 7-82: a direct drive is entered as one and one; 20 teeth on 40 halve the speed.
    assert ninepc.spindle_speed(3000, 1, 1) == 3000
    assert ninepc.spindle_speed(3000, 20, 40) == 1500


@pytest.mark.parametrize(
    ("counts", "previous", "expected"),
    [
        *(pytest.param(n, n, 0, id=f"7-85 threshold 10: nothing at {n} counts") for n in range(10)),
        pytest.param(10, 9, 13, id="7-85 threshold 10: stiction and friction in the scan that reaches it"),
        pytest.param(25, 9, 13, id="7-85 threshold 10: or exceeds it"),
        pytest.param(10, 10, 5, id="7-85 threshold 10: friction alone from the next scan on"),
        pytest.param(-11, -10, 5, id="7-85 threshold 10: the same in the negative direction"),
        pytest.param(9, 10, 0, id="7-85 threshold 10: nothing again when the error falls below"),
    ],
)
def test_friction_threshold(counts: float, previous: float, expected: float) -> None:
    # 5 % friction and 8 % stiction; the manual's example has a threshold of 10 counts and no percentages.
    assert ninepc.friction_compensation(counts, previous, 10, friction=5, stiction=8) == expected


# -------------------------------------------------------------------------------------- chapter 9


@pytest.mark.parametrize(
    ("percent", "expected"),
    [
        pytest.param(0, 0, id="9-5 0 % stops positioning as in feedhold"),
        pytest.param(25, 2540, id="9-5 rapid feedrate times the percentage"),
        pytest.param(100, 10160, id="9-5 100 % leaves rapid as it is"),
    ],
)
def test_rapid_at_f1(percent: float, expected: float) -> None:
    assert ninepc.f1_rapid(10160, percent) == expected


@pytest.mark.parametrize(
    ("distances", "limits", "expected"),
    [
        pytest.param([10, 0], [1000, 500], 1000, id="9-2 one axis: its own limit"),
        pytest.param([30, 40], [600, 1000], 1000, id="9-2 3-4-5 move: 1000 keeps X at its 600"),
        pytest.param([30, 40], [600, 400], 500, id="9-2 3-4-5 move: the slower Y decides"),
        pytest.param([-30, 40], [600, 1000], 1000, id="9-1 the direction of an axis does not matter"),
    ],
)
def test_no_axis_exceeds_its_limit_on_a_path(
    distances: list[float], limits: list[float], expected: float
) -> None:
    assert ninepc.vector_feedrate_limit(distances, limits) == expected


def test_circular_error() -> None:
    # Page 9-9: start to center against end to center.
    assert ninepc.arc_radius_error((10, 0), (0, 10), (0, 0)) == 0
    assert ninepc.arc_radius_error((10, 0), (0, 12), (0, 0)) == 2
    # Page 9-9: with R the only fault is an end point more than twice the radius away.
    assert ninepc.arc_reaches((0, 0), (20, 0), 10)
    assert not ninepc.arc_reaches((0, 0), (20.1, 0), 10)


# ------------------------------------------------------------------------------------- chapter 10


@pytest.mark.parametrize(
    ("gain", "expected"),
    [
        pytest.param(0.5, 240, id="10-2 gain 1/2"),
        pytest.param(1, 120, id="10-2 gain 1"),
        pytest.param(2, 60, id="10-2 gain 2"),
        # Erratum e-1210-response: the table prints 30 and 15 ms, against its own equation 120 / gain.
        pytest.param(3, 40, id="10-2 gain 3, 30 is printed"),
        pytest.param(4, 30, id="10-2 gain 4, 15 is printed"),
    ],
)
def test_response_time(gain: float, expected: float) -> None:
    assert ninepc.response_time_ms(gain) == expected


def test_linear_ramp() -> None:
    # Page 10-2: contouring speed over response time, in in/min per ms; 240 in/min at gain 1 are 2 of them.
    assert ninepc.linear_ramp_per_ms(240, ninepc.response_time_ms(1)) == 2
    # 2 in/min per ms are 2000 in/min per s, and 33.333 in/s2.
    assert as_printed(ninepc.linear_ramp(240, 120), 3) == 33.333
    # The help of 1210: 10,000 mm/min at gain 1 give 1389 mm/s2.
    assert as_printed(ninepc.linear_ramp(10_000, 120)) == 1389


@pytest.mark.parametrize(
    ("feedrate", "after", "expected"),
    [
        pytest.param(100, 150, True, id="10-7 a change equal to 50 mm/min is a step"),
        pytest.param(150, 110, True, id="10-7 a smaller change is a step"),
        pytest.param(100, 150.1, False, id="10-7 a larger change is ramped"),
    ],
)
def test_velocity_step(feedrate: float, after: float, expected: bool) -> None:
    assert ninepc.is_velocity_step(feedrate, after, 50) is expected


@pytest.mark.parametrize(
    ("start", "commanded", "elapsed_s", "delay", "expected"),
    [
        pytest.param(0, 100, 0.2, 10, 63, id="10-14 figure 10.8 after one time constant, 63 ipm"),
        pytest.param(0, 100, 0.4, 10, 86, id="10-14 figure 10.8 after 0.4 s, 86 ipm"),
        pytest.param(200, 100, 0.16, 8, 137, id="10-14 figure 10.9 after one time constant, 137 ipm"),
        pytest.param(200, 100, 0.32, 8, 114, id="10-14 figure 10.9 after 0.32 s, 114 ipm"),
        pytest.param(0, 100, 0.0, 10, 0, id="10-14 the change begins at the initial speed"),
    ],
)
def test_exponential_speed(
    start: float, commanded: float, elapsed_s: float, delay: float, expected: float
) -> None:
    # All four examples have a system scan of 20 ms; speeds are printed without decimals.
    assert as_printed(ninepc.exponential_speed(start, commanded, elapsed_s, delay, 20)) == expected


@pytest.mark.parametrize("elapsed_s", [0.0, 0.05, 0.16, 0.32, 1.0])
def test_both_printed_exponential_equations_are_one(elapsed_s: float) -> None:
    # Page 10-14 prints one equation for speeding up and one for slowing down.
    x = (1000 / 20) * elapsed_s / 8
    slowing = 200 - (200 - 100) * (1 - math.exp(-x))
    assert ninepc.exponential_speed(200, 100, elapsed_s, 8, 20) == pytest.approx(slowing, rel=1e-12)


def test_exponential_time_is_five_time_constants() -> None:
    # Page 10-14: the constant x 20 ms x 5, so 10 takes 1 s; page 10-17: x the system scan time x 5.
    assert ninepc.exponential_time_ms(10, 20) == 1000
    assert ninepc.exponential_time_ms(10, 14) == 700
    # Page 10-14: after five time constants the change is complete for all practical purposes (99 %).
    assert as_printed(ninepc.exponential_speed(0, 100, 1.0, 10, 20)) == 99


JERK_TABLE = [
    (1000, 20, 0.04, 25_000),
    (1000, 20, 1.20, 833),
    (1000, 20, 0.16, 6_250),
    (2500, 14, 0.028, 89_286),
    (2500, 14, 0.84, 2_976),
    (2500, 14, 0.112, 22_321),
]


@pytest.mark.parametrize(
    ("ramp", "scan_ms", "time_s", "jerk"),
    [
        # The table is printed twice, on pages 10-19 ff. and 10-22, with the same numbers.
        pytest.param(*row, id=f"10-19 and 10-22 {row[0]} ipm/s in {row[2]} s at {row[1]} ms")
        for row in JERK_TABLE
    ],
)
def test_jerk_table(ramp: float, scan_ms: float, time_s: float, jerk: float) -> None:
    # J = R / T, printed without decimals.
    assert as_printed(ramp / time_s) == jerk
    # And back: T = R / J, printed with up to three decimals.
    assert as_printed(ninepc.scurve_time(ramp, jerk), 3) == time_s
    # The rows marked max. and min. are the limits of that scan time; the example lies between.
    low, high = ninepc.jerk_limits(ramp, scan_ms)
    assert as_printed(low) <= jerk <= as_printed(high)


@pytest.mark.parametrize(
    ("ramp", "scan_ms", "low", "high"),
    [
        pytest.param(1000, 20, 833, 25_000, id="10-19 at 20 ms: 60 scans are 1.20 s, 2 scans 0.04 s"),
        pytest.param(2500, 14, 2_976, 89_286, id="10-19 at 14 ms: 60 scans are 0.84 s, 2 scans 0.028 s"),
        # Erratum e-1214-default: ramps of 25.4 mm/s2 need 21.17 to 635, and 5.08 is printed (37-4).
        pytest.param(25.4, 20, 21, 635, id="37-4 the default ramp"),
    ],
)
def test_jerk_limits(ramp: float, scan_ms: float, low: float, high: float) -> None:
    # Erratum e-1214-footnote: page 10-22 has the counts of scans exchanged; 60 is the longer time.
    assert tuple(as_printed(limit) for limit in ninepc.jerk_limits(ramp, scan_ms)) == (low, high)


def test_the_default_jerk_is_too_small_for_the_default_ramp() -> None:
    # Page 37-4 gives 25.4 mm/s2 and 5.08 mm/s3: 5.0 s, while 1.20 s is the longest S-curve (10-19).
    assert ninepc.scurve_time(25.4, 5.08) == 5.0
    assert ninepc.jerk_limits(25.4, 20)[0] > 5.08


# ------------------------------------------------------------------------------------- chapter 33


@pytest.mark.parametrize(
    ("axes", "expected"),
    [
        pytest.param(4, 11, id="33-20 four axes on drive 1, three on drive 2"),
        pytest.param(6, 13, id="33-20 one axis on drive 1, six on drive 2"),
    ],
)
def test_fine_foreground_minimum(axes: int, expected: int) -> None:
    assert ninepc.fine_foreground_minimum_ms(axes) == expected


def test_the_timing_procedure() -> None:
    # Page 33-22 step 1: 36 ms and 1 fine scan make a logic foreground interval of 36 ms.
    assert ninepc.coarse_scan_ms(36, 1) == 36
    # Step 3: twice the maximum of 4.3 ms is 8.6, entered as 9 ms.
    assert ninepc.fine_foreground_from_maximum_ms(4.3) == 9
    # Steps 4 and 5: 5.8 + 4.3 = 10.1 ms is more than 2.8 + 4.3 = 7.1 ms; 10.1 / 9 = 1.12 makes 2 scans.
    assert ninepc.fine_scans_per_logic_scan(9, 4.3, 5.8, 2.8) == 2
    # Step 6: the warning time is at least 9 ms x 2 = 18 ms.
    assert ninepc.coarse_scan_ms(9, 2) == 18


# ------------------------------------------------------------------------- chapter 15: word formats


@pytest.mark.parametrize(
    ("form", "inch", "expected"),
    [
        ("3.4-4.3", True, 999.9999),  # The table of page 15-1: 3 and 4 digits in inch mode,
        ("3.4-4.3", False, 9999.999),  # 4 and 3 in metric mode.
        ("5.3-6.2", True, 99999.999),
        ("5.3-6.2", False, 999999.99),
        ("6.1-7.0", False, 9999999.0),
        ("3.1", True, 999.9),  # Rotary formats are the same in both.
        ("3.1", False, 999.9),
    ],
)
def test_a_word_format_ends_at_all_nines(form: str, inch: bool, expected: float) -> None:
    assert ninepc.largest_word(form, inch) == expected


# -------------------------------------------------------------------- arguments that make no sense


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: ninepc.rollover_position(0, 90, -360), "The rollover value must not be negative"),
        (lambda: ninepc.inside_zone([], []), "A zone group needs at least one axis"),
        (lambda: ninepc.inside_zone([1], [(5, 2)]), "The minimum of a zone must not be above its maximum"),
        (lambda: ninepc.sercos_ring_baud([]), "A SERCOS ring needs at least one drive"),
        (lambda: ninepc.sercos_ring_cycle([]), "A SERCOS ring needs at least one drive"),
        (lambda: ninepc.sercos_cycles(8.6), "The system scan time in ms must be a whole number"),
        (lambda: ninepc.counts_per_cycle(0), "The number of lines must be a whole number"),
        (lambda: ninepc.counts_per_cycle(12.5), "The number of lines must be a whole number"),
        (lambda: ninepc.dcm_counts_per_cycle(0, 5, 20), "The signal period must be greater than zero"),
        (lambda: ninepc.dcm_counts_per_cycle(0.02, 5, 0.0015), "not a whole number"),
        (lambda: ninepc.lead_from_threads_per_inch(0), "threads per inch must be greater than zero"),
        (lambda: ninepc.counts_per_length(2000, 0, 1, 5), "The number of gear teeth must be a whole number"),
        (lambda: ninepc.counts_per_length(2000, 1, 1, 0), "Lead Screw Thread Pitch must be greater than"),
        (lambda: ninepc.lowest_terms(44, -40), "The number of teeth must be a whole number"),
        (lambda: ninepc.following_error(1000, 0), "The gain must be greater than zero"),
        (lambda: ninepc.following_error(math.nan, 1), "The feedrate must not be negative"),
        (lambda: ninepc.following_error_with_feed_forward(1, 1, 120), "must be 0 to 100 %"),
        (lambda: ninepc.gain_from_following_error(1, 0), "The following error must be greater than zero"),
        (lambda: ninepc.reversal_first_direction(math.inf), "Reversal Error Compensation must be a finite"),
        (lambda: ninepc.reduced_gain(1, 1.5), "The gain break ratio must be 0 to 1"),
        (lambda: ninepc.minimum_excess_error(1000, 1, 0), "The reduced gain"),
        (lambda: ninepc.analog_voltage(10, 20, 15), "A drive of 15 A cannot give the motor 20 A"),
        (lambda: ninepc.analog_voltage(12, 9, 15), "up to 10 V of either sign"),
        (lambda: ninepc.velocity_gain_bounds(-1), "The gain must be greater than zero"),
        (lambda: ninepc.integral_gain_limit(0), "The gain must be greater than zero"),
        (lambda: ninepc.peak_current_percent(6, 0, 3), "The smaller analog servo voltage must be greater"),
        (lambda: ninepc.torque_percent(6, 0), "The rated current of the motor must be greater than zero"),
        (lambda: ninepc.torque_with_offset(3, 1, 0), "Torque Offset Direction must be 1 or -1"),
        (lambda: ninepc.maximum_servo_acceleration(12, 0), "The effective inertia must be greater than"),
        (lambda: ninepc.friction_compensation(1, 0, -1, 5, 8), "Threshold for Friction Comp must not be"),
        (lambda: ninepc.vector_feedrate_limit([0, 0], [1, 1]), "A move without length has no feedrate"),
        (lambda: ninepc.vector_feedrate_limit([1], [1, 1]), "Every axis of the move needs its distance"),
        (lambda: ninepc.arc_reaches((0, 0), (1, 1), 0), "The radius of an arc must not be zero"),
        (lambda: ninepc.f1_rapid(1000, 101), "F1 Rapid Override Percent must be 0 to 100 %"),
        (lambda: ninepc.response_time_ms(0), "The gain must be greater than zero"),
        (lambda: ninepc.linear_ramp(1000, 0), "The response time must be greater than zero"),
        (lambda: ninepc.exponential_speed(0, 100, -1, 10, 20), "The elapsed time must not be negative"),
        (lambda: ninepc.exponential_time_ms(0, 20), "The delay constant must be greater than zero"),
        (lambda: ninepc.jerk_limits(1000, 0), "The coarse scan time must be greater than zero"),
        (lambda: ninepc.scurve_time(1000, 0), "The jerk must be greater than zero"),
        (lambda: ninepc.fine_foreground_minimum_ms(0), "The number of axes on the largest drive must be"),
        (
            lambda: ninepc.largest_word("3.4 inch", True),
            "A word format is digits before and behind the point",
        ),
    ],
)
def test_nonsense_is_refused_with_one_sentence(call: Callable[[], object], message: str) -> None:
    with pytest.raises(ValueError) as error:  # noqa: PT011  (its text is compared below)
        call()
    text = str(error.value)
    assert message in text
    assert text.endswith(".")
    assert "\n" not in text
