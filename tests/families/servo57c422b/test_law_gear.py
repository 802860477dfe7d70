"""Electronic gearing and cams of the 57C422B, each with the page of its manual."""

from itertools import islice

import pytest

from amp_studio.families.servo57c422b.formulas.motion import backlash_moves
from amp_studio.families.servo57c422b.law_cam import position_cam, time_cam, time_cam_order
from amp_studio.families.servo57c422b.law_gear import gear_fraction, geared
from amp_studio.sim import SimulationError

# -- gearing ---------------------------------------------------------------------------------------


def test_a_third_as_two_numbers_loses_no_count_over_a_million_turns() -> None:
    # Page 4-15: the module keeps track of all remainders.
    one_third = gear_fraction(None, 1, 3)
    *_, end = geared(range(0, 3_000_001, 1000), *one_third)
    assert end == 1_000_000


def test_a_third_as_a_32_bit_number_falls_behind_by_its_rounding() -> None:
    upper, lower = gear_fraction(1 / 3, None, None)
    assert (upper, lower) == (5592405, 16777216)  # times 16777216, page 4-15
    *_, end = geared((0, 4_000_000_000), upper, lower)
    assert end == 1_333_333_253  # 1333333333 would be a third


def test_a_geared_axis_comes_back_with_its_master() -> None:
    assert list(geared((0, 100, -50, 0), 2, 3)) == [0, 66, -34, 0]


def test_the_gear_of_one_is_16777216() -> None:
    assert gear_fraction(1.0, None, None) == (16777216, 16777216)  # the program of page 5-5


@pytest.mark.parametrize(
    ("ratio", "numerator", "denominator"),
    [(127.1, None, None), (0.0, None, None), (None, 1, 32768), (None, 1, 0), (None, 1, -2)],
)
def test_outside_127_to_1_and_1_to_32767_gearing_is_not_enabled(
    ratio: float | None, numerator: float | None, denominator: float | None
) -> None:
    with pytest.raises(SimulationError, match="gearing is not enabled"):
        gear_fraction(ratio, numerator, denominator)


# -- backlash --------------------------------------------------------------------------------------


def test_a_move_against_the_backlash_compensation_overruns_and_comes_back() -> None:
    # Page 4-21: +20, a move of 100 counts and one of -100.
    assert backlash_moves(100, 20) == (100,)
    assert backlash_moves(-100, 20) == (-120, 20)
    assert backlash_moves(100, -20) == (120, -20)


# -- time cams -------------------------------------------------------------------------------------


def test_a_time_cam_moves_by_its_values_in_equal_times() -> None:
    # Pages 4-49 and 4-54: relative change of position, one interval of 2 scans for each point.
    assert time_cam((10, 20, -30), 2, time_cam_order(3), 3) == [0, 5, 10, 20, 30, 15, 0]
    assert time_cam((10, 20), 1, time_cam_order(2), 2, negative=True) == [0, -10, -30]


def test_a_time_cam_runs_once_backwards_mirrored_and_without_end() -> None:
    # Pages 4-55 and 4-56; the points before the loop back point are run through only once.
    assert list(time_cam_order(3)) == [0, 1, 2]
    assert list(time_cam_order(3, reverse=True)) == [2, 1, 0]
    assert list(time_cam_order(3, mirror=True)) == [0, 1, 2, 2, 1, 0]
    assert list(islice(time_cam_order(4, continuous=True, loop_back=2), 8)) == [0, 1, 2, 3, 2, 3, 2, 3]
    mirrored = time_cam_order(4, continuous=True, mirror=True, loop_back=2)
    assert list(islice(mirrored, 10)) == [0, 1, 2, 3, 3, 2, 2, 3, 3, 2]


def test_a_loop_back_point_outside_the_table_is_refused() -> None:
    with pytest.raises(SimulationError, match="loop back point 3 is not one of the 3 points"):
        time_cam_order(3, continuous=True, loop_back=3)
    with pytest.raises(SimulationError, match="at least 1 scan"):
        time_cam((1,), 0, time_cam_order(1), 1)  # page 4-54


# -- position cams ---------------------------------------------------------------------------------


def test_a_position_cam_goes_in_straight_lines_between_its_points() -> None:
    table = (0, 100, 50)
    assert [position_cam(table, 10, travelled) for travelled in (0, 5, 10, 15, 20)] == [0, 50, 100, 75, 50]
    assert position_cam(table, 10, 5, base=1000) == 1050  # page 4-51: added to the base position


def test_a_position_cam_is_before_its_reference_and_after_its_end() -> None:
    assert position_cam((0, 100, 50), 10, -3) == 0
    assert position_cam((0, 100, 50), 10, 99) == 50


def test_a_position_cam_needs_two_points_and_an_increment() -> None:
    for table, increment in (((5,), 10), ((0, 1), 0)):
        with pytest.raises(SimulationError, match="needs two points"):
            position_cam(table, increment, 3)
