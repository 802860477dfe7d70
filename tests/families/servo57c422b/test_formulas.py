"""The worked numbers of the 57C422B manual, each with its page."""

import pytest

from amp_studio.families.servo57c422b.formulas import (
    acceleration_word,
    backlash_moves,
    bytes_word,
    cam_jump,
    cam_largest_value,
    cam_master_travel,
    cam_points,
    cam_step_time,
    cam_time_between_points,
    commands_set,
    counts_per_revolution,
    counts_per_second,
    counts_per_second_squared,
    deceleration_ratio,
    double_of,
    double_words,
    gear_ratio,
    gear_ratio_of_units,
    gear_ratio_word,
    highest_count_rate,
    home_speeds,
    measured_velocity,
    needs_words,
    position_counts,
    s_curve_time,
    scans,
    unwind_constant,
    velocity_error_word,
    velocity_word,
    voltage_word,
    word_bytes,
)
from amp_studio.validate import formulas

# -- encoder ------------------------------------------------------------------------------------------


def test_a_thousand_lines_with_four_edges_are_four_thousand_counts() -> None:
    """Page 4-48: the raw feedback is 1000 counts per revolution, *4 quadrature, FDBK_SCALING=4000."""
    assert counts_per_revolution(1000, 4) == 4000
    assert 0.5 * counts_per_revolution(1000, 4) == 2000  # MAX_FOLL_ERR%, half an axis revolution


def test_the_unwind_constant_is_the_counts_of_a_revolution() -> None:
    """Page 4-19, and 5-5 for the first; page 4-48 has 1600000
    on an axis whose encoder turns once (e-r34-sample).
    """
    assert unwind_constant(4000, 1) == 4000
    assert unwind_constant(4000, 400) == 1600000
    assert unwind_constant(4000, 1, 4) == 1000


def test_an_encoder_channel_takes_250_khz() -> None:
    """Page A-1."""
    assert [highest_count_rate(q) for q in (1, 2, 4)] == [250000, 500000, 1000000]


# -- motion -------------------------------------------------------------------------------------------


def test_the_index_move_of_the_printed_program() -> None:
    """Page 4-48: FDBK_SCALING=4000, DISTANCE=20, SPD=40.0, ACCEL=50.0; CMD_ACC! takes a quarter of ACCEL."""
    assert position_counts(20, 4000) == 80000
    assert counts_per_second(40, 4000) == 160000
    assert velocity_word(counts_per_second(40, 4000)) == 10485760
    assert counts_per_second_squared(50 / 4, 4000) == 50000
    assert acceleration_word(counts_per_second_squared(50 / 4, 4000)) == pytest.approx(3276.8, abs=1e-9)


def test_the_speeds_of_homing() -> None:
    """Page 5-6: SPD/100 slow, SPD/10 fast."""
    assert home_speeds(40.0) == (0.4, 4.0)


def test_the_largest_speed_does_not_fit_a_register_pair() -> None:
    """Page 4-13: 65,536,000 counts/sec times 65.536 is 2 to the 32 (erratum e-r19-limit)."""
    assert velocity_word(65536000) == 2**32


def test_the_largest_acceleration_is_that_of_a_register_pair_with_a_sign() -> None:
    """Page 4-13: 3.28 x 10^10, to three figures (erratum e-r21-limit)."""
    assert acceleration_word(3.28e10) == pytest.approx(2149580800)
    assert f"{(2**31 - 1) / 0.065536:.2e}" == "3.28e+10"


@pytest.mark.parametrize(("deceleration", "ratio"), [(10000, 0.2), (50000, 1.0), (250000, 5.0)])
def test_deceleration_over_acceleration_from_one_fifth_to_five(deceleration: float, ratio: float) -> None:
    """Page 4-14."""
    assert deceleration_ratio(50000, deceleration) == ratio


def test_the_s_curve_takes_twice_the_time() -> None:
    """Page 4-25."""
    assert s_curve_time(0.2) == 0.4


def test_a_velocity_error_is_counts_in_a_scan() -> None:
    """Page 4-9: times .00125; pages 5-5 and 4-48 write 8 and 4000."""
    assert velocity_error_word(6400) == 8
    assert velocity_error_word(3200000) == 4000


def test_the_current_velocity_is_counts_in_its_period() -> None:
    """Page 4-41: scans of 1.25 msec, by default 1."""
    assert measured_velocity(1, 1.25) == pytest.approx(800)
    assert measured_velocity(10, 100) == pytest.approx(100)
    assert scans(1.25) == 1
    assert scans(100) == 80


def test_gear_ratios() -> None:
    """Page 4-15: times 16777216, from 127:1 to 1:32767; page 5-5: 1:1; page 5-8: *65536.*256."""
    assert gear_ratio_word(gear_ratio(1, 1)) == 16777216
    assert 65536 * 256 == 16777216
    assert gear_ratio_word(127) == 2130706432 < 2**31
    assert round(gear_ratio_word(gear_ratio(1, 32767))) == 512
    assert gear_ratio_of_units(2, 4000, 1000) == 8


def test_ten_volts_are_1984() -> None:
    """Pages 4-16 and 4-17."""
    assert [voltage_word(volts) for volts in (-10, 0, 10)] == [-1984, 0, 1984]


def test_backlash_is_taken_up_on_one_side() -> None:
    """Page 4-21: +20; 100 counts stay 100, -100 become -120 and +20."""
    assert backlash_moves(100, 20) == (100,)
    assert backlash_moves(-100, 20) == (-120, 20)
    assert backlash_moves(100, -20) == (120, -20)
    assert backlash_moves(-100, -20) == (-100,)
    assert backlash_moves(-100, 0) == (-100,)


# -- registers ----------------------------------------------------------------------------------------


def test_double_precision_numbers_have_their_upper_half_first() -> None:
    """Pages 4-48 and 4-49: INT_ENA_X! over registers 68 and 69."""
    assert double_words(0x00010000) == (1, 0)  # bit 0 of register 68, axis done
    assert double_words(0x80000000) == (0x8000, 0)  # bit 15 of register 68, command acknowledge
    assert double_words(-1) == (0xFFFF, 0xFFFF)
    assert double_of(0xFFFF, 0xFFFF) == -1
    assert [double_of(*double_words(n)) for n in (0, 16777216, -1600000, 2**31 - 1, -(2**31))] == [
        0,
        16777216,
        -1600000,
        2**31 - 1,
        -(2**31),
    ]


def test_only_one_command_may_be_set() -> None:
    """Page 4-27; 0200H is change default setups (page 5-5), 8 change gear ratio (page 5-8)."""
    assert [commands_set(0, 0), commands_set(0x200, 0), commands_set(0x200, 8), commands_set(3, 0)] == [
        0,
        1,
        2,
        2,
    ]


# -- cam ----------------------------------------------------------------------------------------------


def test_what_fits_a_byte() -> None:
    """Page 4-50: speed * encoder * time * .00125; beyond 127 the table is in words."""
    assert cam_largest_value(40, 4000, 1) == 200
    assert needs_words(cam_largest_value(40, 4000, 1))
    assert cam_largest_value(25.4, 4000, 1) == pytest.approx(127)
    assert not needs_words(127)
    assert not needs_words(-127)
    assert needs_words(-127.5)


def test_two_bytes_share_a_register() -> None:
    """Page 4-49: the lower numbered byte is the least significant one; -128 to 127."""
    assert bytes_word(1, 2) == 0x0201
    assert bytes_word(-1, 127) == 0x7FFF
    assert word_bytes(0x80FF) == (-1, -128)
    assert [word_bytes(bytes_word(a, b)) for a, b in ((-128, 127), (0, -1), (5, -6))] == [
        (-128, 127),
        (0, -1),
        (5, -6),
    ]


def test_the_table_contains_1915_words_or_3830_bytes() -> None:
    """Page 4-57: registers 132 to 2046; 956 positions where 957 pairs would fit (erratum e-cam-positions)."""
    assert 2046 - 132 + 1 == 1915
    assert 2 * 1915 == 3830
    assert (2044 - 132) / 2 + 1 == 957


def test_time_between_points() -> None:
    """Page 4-54."""
    assert cam_time_between_points(0.2, 16) == pytest.approx(10)
    assert cam_time_between_points(1915 * 0.00125, 1915) == pytest.approx(1)


def test_the_printed_program_shares_a_cycle_out() -> None:
    """Page 5-10, lines 9000 to 9015."""
    assert cam_step_time(2.0) == 1
    assert cam_points(2.0, 1) == 1600
    assert cam_step_time(1915 * 0.00125) == 1
    assert cam_points(1915 * 0.00125, 1) == 1915
    assert cam_step_time(10.0) == 5
    assert cam_points(10.0, 5) == 1600
    assert cam_points(10.0, 1) == 1915


def test_the_jump_to_the_loop_back_point() -> None:
    """Page 4-56: the change of speed within a step, as an acceleration:
    100 counts in 12.5 ms are 640000 counts/s2.
    """
    assert cam_jump(0, 100, 12.5) == pytest.approx(640000)
    assert cam_jump(100, 0, 12.5) == pytest.approx(-640000)


def test_the_master_goes_one_increment_from_point_to_point() -> None:
    """Page 4-53."""
    assert cam_master_travel(5, 1000) == 4000
    assert cam_master_travel(1, 1000) == 0


# -- what makes no sense ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "arguments", "message"),
    [
        ("counts_per_revolution", (1000, 3), "quadrature must be 1, 2 or 4"),
        ("counts_per_revolution", (0, 4), "lines of the encoder"),
        ("unwind_constant", (4000, 1, 0), "turns of the axis"),
        ("position_counts", (1, 0), "counts of a unit"),
        ("gear_ratio", (1, 0), "gearing reference"),
        ("gear_ratio_word", (0,), "ratio"),
        ("gear_ratio_of_units", (1, 1, -1), "gearing counts"),
        ("deceleration_ratio", (0, 1), "acceleration"),
        ("s_curve_time", (-1,), "trapezoid"),
        ("measured_velocity", (1, 0), "period"),
        ("home_speeds", (0,), "speed"),
        ("backlash_moves", (0.5, 20), "whole number"),
        ("double_words", (2**32,), "32 bits"),
        ("double_of", (65536, 0), "16 bits"),
        ("commands_set", (-1, 0), "command register"),
        ("bytes_word", (128, 0), "-128 to 127"),
        ("bytes_word", (-129, 0), "at least -128"),
        ("word_bytes", (65536,), "16 bits"),
        ("cam_points", (1, 0.5), "time between points"),
        ("cam_step_time", (0,), "cycle"),
        ("cam_time_between_points", (1, 0), "number of points"),
        ("cam_largest_value", (1, 1, 0), "time between points"),
        ("cam_jump", (0, 1, 0), "time between points"),
        ("cam_master_travel", (0, 1), "number of points"),
        ("velocity_word", (float("nan"),), "speed"),
    ],
)
def test_an_argument_that_makes_no_sense_is_named(
    name: str, arguments: tuple[float, ...], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        formulas("57c422b")[name](*arguments)
