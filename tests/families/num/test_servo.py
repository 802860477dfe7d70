"""Every worked number of chapter 6 of the NUM manual, Servo-Control,
and what chapter 11 adds to its parameters.

Speeds are per minute, as the words of P30 hold them; the manual's examples give them per second.
"""

import math

import pytest

from amp_studio.families.num import formulas as num

UM, TEN_THOUSANDTH = 0.001, 0.0001
"""Lengths of internal units: a micrometre and a ten-thousandth of a degree (page 6-14)."""
V_MAX = 100 * 60.0
"""The top speed of the examples on pages 6-14 and 6-22: 100 mm/s."""


def printed(value: float, decimals: int) -> str:
    """Write a number with so many decimals, the rest cut off, as the manual does with 4915.16 and 16.66."""
    return f"{math.floor(value * 10**decimals) / 10**decimals:.{decimals}f}"


# ------------------------------------------------------------------------------------- gain and following
# error


def test_6_14_a_gain_of_1_m_per_min_per_mm_is_16_66_per_second_and_60_ms() -> None:
    assert printed(num.loop_gain_per_second(1.0), 2) == "16.66"
    assert num.loop_time_constant(1.0) == pytest.approx(60.0)
    assert num.loop_time_constant(2.0) == pytest.approx(30.0)


def test_6_18_one_mm_of_following_error_at_1_m_per_min_is_60_ms() -> None:
    assert num.measured_time_constant(1000.0, 1.0) == 60.0
    assert num.steady_following_error(1000.0, 60.0) == pytest.approx(1.0)


@pytest.mark.parametrize(("volts", "points"), [(10, 32768), (9, 29491), (0, 0)])
def test_6_14_points_of_the_converter(volts: float, points: float) -> None:
    assert num.reference_points(volts) == points


def test_6_14_kvar_of_the_example_is_4915_16_and_entered_as_4915() -> None:
    """VMAX = 100 mm/s, T = 60 ms, internal unit µm."""
    kvar = num.loop_gain_coefficient(V_MAX, 60.0, UM)
    assert printed(kvar, 2) == "4915.16"
    assert math.floor(kvar) == 4915


@pytest.mark.parametrize(("unit", "k"), [(0.1, 100), (0.01, 10), (0.001, 1), (0.0001, 0.1), (0.00001, 0.01)])
def test_6_14_and_6_22_coefficient_k_by_internal_unit(unit: float, k: float) -> None:
    """1/10 mm, 1/100 mm, µm, 1/10 µm, 1/100 µm; 1/10000 degree is the fourth one with degrees."""
    plain = num.loop_gain_coefficient(V_MAX, 60.0, UM)
    assert num.loop_gain_coefficient(V_MAX, 60.0, unit) == pytest.approx(plain * k)
    assert num.max_following_error(V_MAX, 60.0, unit) == pytest.approx(6600 / k)


def test_6_44_another_reference_voltage_takes_the_place_of_9_v() -> None:
    kvar = num.loop_gain_coefficient(V_MAX, 60.0, UM, 10.0)
    assert kvar == pytest.approx(32768 / 6)


def test_the_reference_at_top_speed_is_what_the_coefficient_was_worked_out_for() -> None:
    """Page 6-14: max speed reference = KVAR x max Ep."""
    for unit in (0.1, UM, TEN_THOUSANDTH):
        kvar = num.loop_gain_coefficient(V_MAX, 60.0, unit)
        assert num.reference_voltage(kvar, V_MAX, 60.0, unit) == pytest.approx(9.0)
    assert num.reference_voltage(4915, V_MAX, 60.0, UM) == pytest.approx(9.0, abs=0.001)
    assert num.reference_voltage(0, V_MAX, 60.0, UM) == 0.0


def test_6_22_emax_of_the_example_is_6600() -> None:
    """100 x 60 x 1 x 11/10; at top speed the error settles at VMAX x T, 6000 (page 11-4)."""
    assert num.max_following_error(V_MAX, 60.0, UM) == 6600
    assert num.to_internal(num.steady_following_error(V_MAX, 60.0), UM) == 6000


def test_6_24_a_following_error_gives_two_speeds() -> None:
    """The multipliers of the loop gain are 1.125 and 0.875."""
    assert num.theoretical_speeds(6.0, 60.0) == pytest.approx((0.875 * V_MAX, 1.125 * V_MAX))


def test_4_24_the_group_of_an_axis_is_the_left_digit_of_its_word_of_p9() -> None:
    """02 is Z of group 1, 28 is C of group 3, FF is none."""
    constants = [60.0, 50.0, 40.0, None, None, None, None, None]
    assert [num.of_group(constants, word) for word in (0x02, 0x28)] == [60.0, 40.0]
    for word in (0x30, 0xFF):
        with pytest.raises(ValueError, match="belongs to no group"):
            num.of_group(constants, word)


def test_6_40_an_axis_without_a_time_constant_has_that_of_its_group() -> None:
    assert num.axis_time_constant(0.0, 60.0) == 60.0
    assert num.axis_time_constant(50.0, 60.0) == 50.0


# ------------------------------------------------------------------------------------- speeds and
# accelerations


def test_6_6_at_most_30000_increments_per_sample() -> None:
    """5000 µs (page 9-10) and µm: 30 mm in 5 ms."""
    limit = num.largest_traverse_rate(5.0, UM)
    assert limit == pytest.approx(360000.0)
    assert num.increments_per_sample(limit, 5.0, UM) == pytest.approx(30000.0)
    assert num.largest_traverse_rate(6.0, UM) == pytest.approx(300000.0)
    assert num.largest_traverse_rate(5.0, TEN_THOUSANDTH) == pytest.approx(36000.0)


def test_6_10_an_acceleration_is_more_than_1_increment_per_sample_squared() -> None:
    assert num.smallest_acceleration(5.0, UM) == pytest.approx(40.0)
    assert num.smallest_acceleration(10.0, UM) == pytest.approx(10.0)
    assert num.smallest_acceleration(5.0, TEN_THOUSANDTH) == pytest.approx(4.0)


def test_6_43_acceleration_from_speed_and_buildup_time() -> None:
    """DDM = VITMAX / TV: 100 mm/s in 200 ms are 500 mm/s² (the printed units give another figure,
    e-p32-formula).
    """
    assert num.buildup_acceleration(V_MAX, 200.0) == pytest.approx(500.0)


def test_6_42_fast_jog_is_the_speed_of_the_slowest_axis() -> None:
    speeds = [12000.0, 8000.0, None, 100.0, 0.0] + [None] * 27
    assert num.slowest_axis(speeds, 0b10111, 0b11011) == 8000.0
    with pytest.raises(ValueError, match="No servo-controlled axis"):
        num.slowest_axis(speeds, 0b00100, 0b11111)


@pytest.mark.parametrize(
    ("change", "average"),
    [
        pytest.param(0.0, 0.0, id="none"),
        pytest.param(25.0, 250.0, id="25 mm/s in the least time of 100 ms"),
        pytest.param(50.0, 500.0, id="just half the greatest acceleration"),
        pytest.param(80.0, 500.0, id="more takes longer"),
    ],
)
def test_6_38_small_changes_of_speed_take_the_least_time(change: float, average: float) -> None:
    assert num.average_acceleration(change * 60, 100.0, 1000.0) == pytest.approx(average)


def test_6_38_without_a_least_time_it_is_always_half() -> None:
    assert num.average_acceleration(0.6, 0.0, 1000.0) == 500.0


def test_6_36_the_approach_speed_of_the_example_is_3600_mm_per_min() -> None:
    """1000 mm/s² and 60 ms are 60 mm/s; with very high speed machining about a ninth of it."""
    assert num.approach_speed(1000.0, 60.0) == pytest.approx(3600.0)
    assert num.approach_speed(1000.0, 60.0) / 60 == pytest.approx(60.0)
    assert num.approach_speed(1000.0, 60.0, 9.0) == pytest.approx(400.0)


def test_6_36_a_whole_approach_speed_loses_nothing() -> None:
    """P33 is a whole number of mm/min, which the last bits of the arithmetic must not push over its limit."""
    for constant in range(10, 121):
        assert num.approach_speed(1500.0, constant) == 90 * constant


# ------------------------------------------------------------------------------------- circles and tolerances


def test_6_32_speed_on_the_circle_of_the_example() -> None:
    """50 µm, 60 ms and 50 mm give 0.037 m/s, that is 2.236 m/min."""
    speed = num.circle_speed(50.0, 60.0, 50.0)
    assert printed(speed / 60000, 3) == "0.037"
    assert printed(speed / 1000, 3) == "2.236"
    assert num.circle_error(speed, 60.0, 50.0) == pytest.approx(0.050)


def test_11_7_the_window_is_twice_the_standing_error() -> None:
    assert num.in_position_window(5.0) == 10.0


def test_11_8_the_tolerance_is_2_to_4_windows() -> None:
    assert num.movement_tolerances(10.0) == (20.0, 40.0)


# ------------------------------------------------------------------------------------- very high speed
# machining


@pytest.mark.parametrize(("word", "used"), [(0, 0), (50, 50), (100, 100), (101, 100), (65535, 100)])
def test_6_26_more_than_100_percent_counts_as_100(word: float, used: float) -> None:
    assert num.effective_anticipation(word) == used


def test_6_26_the_filter_averages_the_last_terms_as_its_running_sum_does() -> None:
    """R'i = (sum of the step before + Ri - R(i-2j-1)) / (2j+1), with 2j+1 = 5."""
    references = [3.0, 1.0, 4.0, 1.0, 5.0, 9.0, 2.0]
    running = math.fsum(references[:5])
    assert num.filtered_reference(references[:5], 5) == running / 5
    for i in (5, 6):
        running += references[i] - references[i - 5]
        assert num.filtered_reference(references[: i + 1], 5) == pytest.approx(running / 5)
    with pytest.raises(ValueError, match="need as many references"):
        num.filtered_reference(references[:4], 5)


def test_6_34_the_friction_correction_dies_away() -> None:
    """5 ms and the usual 50 ms: a tenth goes in every sample; a reversal adds the whole change."""
    assert num.friction_correction([10.0], 5.0, 50.0) == 10.0
    assert num.friction_correction([10.0] * 3, 5.0, 50.0) == pytest.approx(8.1)
    assert num.friction_correction([10.0, 10.0, -10.0], 5.0, 50.0) == pytest.approx(-20.0 + 8.1)
    assert num.friction_correction([], 5.0, 50.0) == 0.0


# ------------------------------------------------------------------------------------- which unit an axis has


@pytest.mark.parametrize(
    ("axis", "assignment", "turns"),
    [
        pytest.param(0, 0x00, False, id="X"),
        pytest.param(3, 0x00, True, id="modulo in P1N0"),
        pytest.param(4, 0x00, True, id="limited in P1N1"),
        pytest.param(0, 0x06, True, id="A"),
        pytest.param(0, 0x27, True, id="B of group 3"),
        pytest.param(0, 0x08, True, id="C"),
        pytest.param(0, 0x05, False, id="W"),
        pytest.param(0, 0xFF, False, id="no name"),
    ],
)
def test_4_12_an_axis_turns_by_p1_or_by_its_name(axis: int, assignment: int, turns: bool) -> None:
    assert num.axis_turns(axis, 0b01000, 0b10000, assignment) is turns
    assert num.axis_unit(axis, 0b01000, 0b10000, assignment, 2, 3) == (0.001 if turns else 0.01)


@pytest.mark.parametrize(
    "asked",
    [
        lambda: num.loop_gain_coefficient(0.0, 60.0, UM),
        lambda: num.loop_gain_coefficient(V_MAX, 0.0, UM),
        lambda: num.loop_gain_coefficient(V_MAX, 60.0, 0.0),
        lambda: num.reference_points(10.5),
        lambda: num.reference_points(-1.0),
        lambda: num.largest_traverse_rate(0.0, UM),
        lambda: num.smallest_acceleration(5.0, 0.0),
        lambda: num.buildup_acceleration(V_MAX, 0.0),
        lambda: num.measured_time_constant(1000.0, 0.0),
        lambda: num.circle_speed(50.0, 0.0, 50.0),
        lambda: num.circle_error(V_MAX, 60.0, 0.0),
        lambda: num.friction_correction([1.0], 5.0, 0.0),
        lambda: num.effective_anticipation(-1.0),
        lambda: num.steady_following_error(math.nan, 60.0),
    ],
)
def test_an_argument_that_makes_no_sense_is_refused(asked) -> None:
    with pytest.raises(ValueError, match=r"must (not )?be|longer than nothing"):
        asked()
