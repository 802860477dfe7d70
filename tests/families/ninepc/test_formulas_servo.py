"""Position and velocity loop: the printed examples and tables of chapter 7;
how they are compared is in test_formulas.py.
"""

import pytest

from amp_studio.families.ninepc import formulas as ninepc
from tests.families.ninepc.printed import as_printed

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
    # Page 7-20: 110 % of the largest following error expected; that is the gain equation of 7-25.
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
