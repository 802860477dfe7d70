"""Spindles: every worked example of chapter 8 of the NUM manual, with its page.

Numbers that the manual does not print, and that are worked by hand from its words, are marked "by hand".
"""

from collections.abc import Callable

import pytest

from amp_studio.families.num import formulas as num
from amp_studio.schema import load_schema

EXAMPLE = ([10, 80, 400, 0, 0, 0], [100, 500, 2000, 0, 0, 0])
"""Speed ranges M40 to M42 of pages 8-16, 8-18, 8-20 and 8-22; M43 to M45 do not exist."""
NO_LIMITS = [0] * 6


# ------------------------------------------------------------------------------------- measurement of the
# angle


@pytest.mark.parametrize(
    ("points", "modulo"),
    [
        pytest.param(2000, 4096, id="8-13"),
        pytest.param(5000, 8192, id="8-13"),
        pytest.param(20000, 32768, id="8-13"),
        pytest.param(65536, 65536, id="8-13"),
        pytest.param(1, 4096, id="8-12 never below 4096"),
        pytest.param(4096, 4096, id="8-12 by hand: equal"),
        pytest.param(4097, 8192, id="8-12 by hand: just above"),
    ],
)
def test_the_modulo_is_the_power_of_two_at_or_above_the_points(points: int, modulo: int) -> None:
    assert num.spindle_modulo(points) == modulo
    assert num.spindle_increment(points) == 360 / modulo


def test_the_printed_table_of_moduli_is_what_the_formula_gives() -> None:
    # Page 8-13.
    table = load_schema("num").tables["spindle-modulo"]
    assert [num.spindle_modulo(row[0]) for row in table.rows] == [row[1] for row in table.rows]
    assert [f"360/{num.spindle_modulo(row[0])} deg" for row in table.rows] == [row[2] for row in table.rows]


def test_an_offset_is_counted_in_increments() -> None:
    # Page 8-5: offset x 4096 / 360, for the stop at 45 degrees of the example M19C45.
    assert num.spindle_offset(45, 2000) == 45 * 4096 / 360 == 512
    # By hand: the same angle with 20000 points, where a revolution has 32768 increments.
    assert num.spindle_offset(45, 20000) == 4096
    assert num.spindle_offset(1, 1024) == 11


def test_the_fastest_spindle_that_can_be_measured_makes_96000_rpm() -> None:
    # Page 8-11: P50 = 5000 and P40 below 4096.
    assert num.largest_measured_speed(2000, 5000) == 96000
    # By hand: sixteen times the increments, a sixteenth of the speed.
    assert num.largest_measured_speed(65536, 5000) == 6000


# --------------------------------------------------------------------------------------------------- indexing


def test_the_indexing_reference_is_error_by_gain_up_to_the_limit() -> None:
    # Page 8-6 prints no figures; by hand: a tenth of a revolution at 500 rpm/rev.
    assert num.indexing_reference(0.1, 500, 100) == 50
    assert num.indexing_reference(0.5, 500, 100) == 100
    assert num.indexing_reference(-0.5, 500, 100) == -100


def test_an_indexed_spindle_is_below_3_of_4096_revolutions_in_a_sample() -> None:
    # Page 8-5; by hand: 12000 samples a minute at 5000 µs.
    assert num.indexing_standstill(5000) == pytest.approx(3 / 4096 * 12000)
    assert num.indexing_standstill(6000) == pytest.approx(7.32421875)


# ----------------------------------------------------------------------------------------------- speed ranges


@pytest.mark.parametrize(
    ("speed", "ranges"),
    [
        (9, []),
        (10, [40]),
        (79, [40]),
        (80, [40, 41]),
        (100, [40, 41]),
        (101, [41]),
        (399, [41]),
        (400, [41, 42]),
        (500, [41, 42]),
        (2000, [42]),
        (2001, []),
    ],
)
def test_a_speed_belongs_to_the_ranges_of_the_printed_example(speed: int, ranges: list[int]) -> None:
    # Page 8-16: M40 10 to 100, M41 80 to 500, M42 400 to 2000.
    assert num.ranges_for_speed(speed, *EXAMPLE, NO_LIMITS) == ranges


def test_a_speed_above_the_limit_speed_does_not_belong_to_the_range() -> None:
    # Page 8-16: it is refused with error 29, or another range is looked for.
    assert num.ranges_for_speed(450, *EXAMPLE, [0, 420, 0, 0, 0, 0]) == [42]
    assert num.ranges_for_speed(1900, *EXAMPLE, [0, 0, 1800, 0, 0, 0]) == []
    assert num.ranges_for_speed(1800, *EXAMPLE, [0, 0, 1800, 0, 0, 0]) == [42]


def test_no_speed_is_lost_between_the_ranges_of_the_printed_example() -> None:
    # Page 8-16; the next speed after 500 is 501 rpm.
    assert num.speed_gap(*EXAMPLE, NO_LIMITS) == 0
    assert num.speed_gap([10, 101, 501, 0, 0, 0], EXAMPLE[1], NO_LIMITS) == 0
    assert num.speed_gap([10, 80, 502, 0, 0, 0], EXAMPLE[1], NO_LIMITS) == 500
    assert num.speed_gap([10, 102, 502, 0, 0, 0], EXAMPLE[1], NO_LIMITS) == 100
    assert num.speed_gap([0] * 6, [0] * 6, NO_LIMITS) == 0


def test_a_limit_speed_ends_its_range() -> None:
    # Page 8-16: above it another range is looked for, which M42 with 400 and more is not.
    assert num.speed_gap(*EXAMPLE, [0, 398, 0, 0, 0, 0]) == 398
    assert num.speed_gap(*EXAMPLE, [0, 399, 1000, 0, 0, 0]) == 0
    assert num.speed_gap(*EXAMPLE, [9, 0, 0, 0, 0, 0]) == 0
    assert num.speed_gap(*EXAMPLE, [10, 0, 0, 0, 0, 0]) == 10
    assert num.speed_gap([None, 80, 400], [None, 500, 2000], [None, None, 0]) == 0
    assert num.speed_gap([10, None, 400], [100, 500, 2000], [0, 0, 0]) == 100


def test_the_highest_speed_of_a_range_is_10_volts() -> None:
    # Page 8-16.
    assert num.spindle_reference_volts(2000, 2000) == 10
    assert num.spindle_reference_volts(500, 2000) == 2.5


def test_29491_points_are_9_volts_and_32768_are_10() -> None:
    # Page 6-14, with the range M42 of page 8-16: 1800 of 2000 rpm are 9 V.
    assert num.spindle_reference_points(1800, 2000) == 29491
    assert num.spindle_reference_points(2000, 2000) == 32768


# ---------------------------------------------------------------------------------------------- rigid tapping


def test_a_tap_slows_down_from_a_distance_that_grows_with_the_square_of_the_speed() -> None:
    # Page 8-32 with the A of 10 that page 8-35 begins with; by hand: 10 rev/s from 600 rpm take 1 s and 5
    # turns.
    assert num.tapping_deceleration_distance(1.5, 600, 10) == 7.5
    assert num.tapping_deceleration_distance(1.5, 1200, 10) == 30
    assert num.tapping_deceleration_distance(1.5, 600, 20) == 3.75


def test_100_millivolts_are_a_hundredth_of_the_range() -> None:
    # Pages 8-32 and 8-16: 50 to 100 mV of 10 V.
    assert num.hole_bottom_speed(100, 2000) == 20
    assert num.hole_bottom_speed(50, 2000) == 10


def test_the_integration_constant_is_500_at_most() -> None:
    # Page 8-34: 1000 / Ti with Ti at least 2.
    assert num.integration_constant(2) == 500
    assert num.integration_constant(10) == 100
    with pytest.raises(ValueError, match="at least 2 samples, not 1"):
        num.integration_constant(1)


def test_the_position_anticipation_is_the_time_constant_in_samples_times_a_thousand() -> None:
    # Page 8-35; with the basic 60 ms of page 6-18 and the periods of page 9-10.
    assert num.position_anticipation(60, 6000) == 10000
    assert num.position_anticipation(60, 5000) == 12000 == 1000 * 60 / 5


def test_the_zero_crossing_anticipation_is_the_time_of_the_ramp_in_samples() -> None:
    # Page 8-35, by hand: 50 mm/s at 500 mm/s² take 0.1 s, which are 20 samples of 5 ms.
    assert num.zero_crossing_anticipation(50, 500, 5000) == 20
    assert num.zero_crossing_anticipation(50, 1000, 5000) == 10


@pytest.mark.parametrize(
    ("formula", "arguments", "message"),
    [
        (num.spindle_modulo, (0,), "The number of encoder points"),
        (num.largest_measured_speed, (2000, 0), "The sampling period"),
        (num.indexing_reference, (0.1, -1, 100), "The gain"),
        (num.indexing_reference, (0.1, 1, -100), "The limit speed"),
        (num.indexing_standstill, (0,), "The sampling period"),
        (num.ranges_for_speed, (-1, *EXAMPLE, NO_LIMITS), "The spindle speed"),
        (num.ranges_for_speed, (10, [10], [100], [0, 0]), "there are 1, 1, 2 of them"),
        (num.speed_gap, ([10, 80], [100], [0]), "there are 2, 1, 1 of them"),
        (num.spindle_reference_volts, (100, 0), "The highest speed of the range"),
        (num.spindle_reference_volts, (2001, 2000), "The range ends at 2000 rpm, below 2001"),
        (num.tapping_deceleration_distance, (1.5, 600, 0), "A must"),
        (num.tapping_deceleration_distance, (0, 600, 10), "The pitch"),
        (num.hole_bottom_speed, (-1, 2000), "The reference"),
        (num.position_anticipation, (-1, 5000), "The time constant"),
        (num.zero_crossing_anticipation, (50, 0, 5000), "The acceleration"),
    ],
)
def test_what_makes_no_sense_is_reported(
    formula: Callable[..., float], arguments: tuple[float, ...], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        formula(*arguments)
