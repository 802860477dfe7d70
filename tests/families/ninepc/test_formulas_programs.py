"""Programs, tools, cycles and probes: the worked examples of chapters 8, 15, 21, 22, 24, 26, 29 and 30.

The page is with each case. Numbers that the manual does not print, and that are worked by hand from its
words, are marked "by hand".
"""

from collections.abc import Callable
from typing import Literal

import pytest

from amp_studio.families.ninepc import formulas as ninepc
from tests.families.ninepc.printed import assert_refused

# ------------------------------------------------------------------------------- chapters 8 and 15


@pytest.mark.parametrize(
    ("jogged", "limit", "expected"),
    [
        pytest.param("XXX", 15, 1, id="8-13 three jogs in the same axis are one move"),
        pytest.param("XXXX", 15, 1, id="8-13 four jogs in the same axis are one move"),
        pytest.param("XXZX", 15, 3, id="8-13 the moves of all axes are counted together"),
        pytest.param("XZXZX", 3, 3, id="8-13 no more than the specified number"),
        pytest.param("", 15, 0, id="8-13 no jog, no move"),
    ],
)
def test_jogs_of_one_axis_are_one_retract_move(jogged: str, limit: int, expected: int) -> None:
    assert ninepc.remembered_retract_moves(list(jogged), limit) == expected


@pytest.mark.parametrize(
    ("word", "suppressed", "expected"),
    [
        pytest.param("01", "leading", 0.001, id="15-3 X01 is X0000.001"),
        pytest.param("2790", "leading", 2.790, id="15-3 X2790 is X0002.790"),
        pytest.param("01", "trailing", 100.0, id="15-3 X01 is X0100.000"),
        pytest.param("279", "trailing", 2790.0, id="15-3 X279 is X2790.000"),
        pytest.param("-2790", "leading", -2.790, id="15-3 by hand: the sign is no digit"),
        pytest.param("-279", "trailing", -2790.0, id="15-3 by hand: nor is it on the left"),
    ],
)
def test_suppressed_zeros_are_filled_in(
    word: str, suppressed: Literal["leading", "trailing"], expected: float
) -> None:
    assert ninepc.word_value(word, "4.3", False, suppressed) == expected


def test_inch_and_metric_digits_are_counted_by_themselves() -> None:
    # The format 3.4 inch and 4.3 metric (15-1), by hand.
    assert ninepc.word_value("2790", "3.4-4.3", True, "leading") == 0.279
    assert ninepc.word_value("2790", "3.4-4.3", False, "leading") == 2.79


def test_a_tool_number_of_six_digits_ends_at_999999() -> None:
    # Page 16-17: the formats of the T-word are printed without a point.
    assert ninepc.largest_word("6", inch=True) == ninepc.largest_word("6.0", inch=False) == 999_999


# -------------------------------------------------------------------------------------- chapter 21


@pytest.mark.parametrize(
    ("word", "digits", "as_wear", "expected"),
    [
        # The six formats of the table on page 21-2; the T-words are ours.
        pytest.param(1203, 1, True, (120, 3, 3), id="21-2 (1) 1 digit Geom + Wear"),
        pytest.param(1203, 2, True, (12, 3, 3), id="21-2 (2) 2 digit Geom + Wear"),
        pytest.param(1203, 3, True, (1, 203, 203), id="21-2 (3) 3 digit Geom + Wear"),
        pytest.param(1203, 1, False, (120, 3, 120), id="21-2 (4) 1 digit Wear"),
        pytest.param(1203, 2, False, (12, 3, 12), id="21-2 (5) 2 digit Wear"),
        pytest.param(1203, 3, False, (1, 203, 1), id="21-2 (6) 3 digit Wear"),
    ],
)
def test_a_t_word_is_divided_by_its_format(
    word: int, digits: int, as_wear: bool, expected: tuple[int, int, int]
) -> None:
    assert ninepc.split_t_word(word, digits, as_wear) == expected


@pytest.mark.parametrize(
    ("word", "expected"),
    [
        pytest.param(21, 1, id="21-14 T21 calls a tool of group 1"),
        pytest.param(19, None, id="21-14 T19 simply calls tool 19"),
        pytest.param(20, 0, id="21-14 T20 is no ordinary tool (erratum e-131-group0)"),
    ],
)
def test_the_boundary_divides_tools_and_groups(word: int, expected: int | None) -> None:
    assert ninepc.tool_life_group(word, 20) == expected


def test_a_gauging_cycle_finds_programmed_less_actual() -> None:
    # Page 21-10, by hand: contact at 99.6 on the way to 100, with 12.5 in the table.
    difference = ninepc.gauge_difference(100, 99.6)
    assert difference == pytest.approx(0.4)
    assert ninepc.gauged_offset(12.5, difference, add=True) == pytest.approx(12.9)
    assert ninepc.gauged_offset(12.5, difference, add=False) == pytest.approx(0.4)


def test_a_signal_counts_within_the_tolerance_on_either_side() -> None:
    # Pages 21-9 and 29-5, by hand: the band is twice as wide as the value.
    low, high = ninepc.tolerance_band(100, 1.5)
    assert (low, high) == (98.5, 101.5)
    assert high - low == 2 * 1.5


@pytest.mark.parametrize(
    ("here", "there", "expected"), [(1, 3, 2), (1, 10, 1), (3, 8, 5), (8, 2, 4), (5, 5, 0)]
)
def test_a_magazine_takes_the_shorter_way_round(here: int, there: int, expected: int) -> None:
    # The magazine of figure 21.2 has 10 pockets (page 21-13); the pockets are ours.
    assert ninepc.fewest_pockets(here, there, 10) == expected


def test_an_offset_may_change_so_far_unless_one_value_is_zero() -> None:
    # Pages 21-16 and 21-17, by hand.
    assert ninepc.offset_change_allowed(5.0, 5.5, 0.5)
    assert not ninepc.offset_change_allowed(5.0, 5.6, 0.5)
    assert ninepc.offset_change_allowed(0.0, 100.0, 0.5)
    assert ninepc.offset_change_allowed(100.0, 0.0, 0.5)


# -------------------------------------------------------------------------------------- chapter 22


def test_a_diameter_counts_half() -> None:
    # Page 22-3.
    assert ninepc.compensation_radius(20, is_diameter=True) == 10
    assert ninepc.compensation_radius(20, is_diameter=False) == 20


def test_a_generated_block_below_the_minimum_is_left_out() -> None:
    # Page 22-4: with .75 inch a generated block of 0.5 inch is ignored.
    assert not ninepc.is_block_generated(0.5, 0.75)
    assert ninepc.is_block_generated(0.75, 0.75)


def test_the_feedrate_on_an_inside_arc_is_not_reduced_below_its_share() -> None:
    # Page 22-5: 120 mm/min are needed of 200; allowed with 50 %, raised to 160 with 80 %.
    assert ninepc.compensated_feedrate(120, 200, 50) == 120
    assert ninepc.compensated_feedrate(120, 200, 80) == 160
    # Page 22-5: 100 % switches the reduction off.
    assert ninepc.compensated_feedrate(120, 200, 100) == 200


def test_the_override_acts_on_the_lowest_feedrate() -> None:
    # Erratum e-405-example: page 22-5 makes 180 and 144 of an override of 80 %. 180 are 90 % of 200,
    assert ninepc.lowest_compensated_feedrate(200, 80, 90) == 144
    # and 80 % by the rule of page 22-10 leave 160, of which 80 % are 128.
    assert ninepc.lowest_compensated_feedrate(200, 80, 80) == 128


def test_the_feedrate_in_a_corner() -> None:
    # Page 22-10: 60 % of 100 mm/min; with an override of 80 % it is 60 % of 80.
    assert ninepc.corner_feedrate(100, 60) == 60
    assert ninepc.corner_feedrate(100, 60, 80) == 48


# ------------------------------------------------------------------------------- chapters 24 and 26


def test_a_tool_draws_back_by_the_amount() -> None:
    # Pages 24-2, 24-5 and 24-15, by hand, with the defaults of page 37-3.
    assert ninepc.retracted_depth(30, 25.4) == pytest.approx(4.6)
    assert ninepc.retracted_depth(10, 0.254) == 9.746


def test_the_chamfer_of_a_thread_is_as_long_as_so_many_threads() -> None:
    # Page 24-9: a function of the thread lead, in tenths of a thread; by hand.
    assert ninepc.chamfer_length(2.5, 2) == 5
    assert ninepc.chamfer_length(0, 2) == 0


def test_the_lead_is_that_of_the_longer_axis() -> None:
    # Page 16-10, by hand: a taper of 10 on 40 with a lead of 2.
    assert ninepc.lead_along(2, 40, 40) == 2
    assert ninepc.lead_along(2, 10, 40) == 0.5
    # Page 33-5: with Num of Threads/Inch the word is the number of threads.
    assert ninepc.lead_from_threads_per_inch(8) == 0.125


def test_a_threading_pass_is_not_smaller_than_the_minimum() -> None:
    # Page 24-12, by hand.
    assert ninepc.threading_infeed(0.05, 0.1) == 0.1
    assert ninepc.threading_infeed(0.3, 0.1) == 0.3


def test_the_last_pass_but_one_leaves_the_finishing_allowance() -> None:
    # Page 24-13, by hand.
    assert ninepc.depth_before_finish(1.5, 0.25) == 1.25
    assert ninepc.depth_before_finish(1.5, 0) == 1.5


@pytest.mark.parametrize(
    ("programmed", "percent", "threshold", "expected"),
    [
        pytest.param(4, 100, 0, 4, id="26-2 100 % is the full depth of the D-word"),
        pytest.param(4, 50, 0, 2, id="26-2 by hand: the percentage times the D-word"),
        pytest.param(4, 255, 0, 10.2, id="26-2 by hand: the largest percentage"),
        pytest.param(0.5, 100, 1, 1, id="26-4 by hand: a smaller depth is increased to the threshold"),
    ],
)
def test_depth_of_a_roughing_pass(
    programmed: float, percent: float, threshold: float, expected: float
) -> None:
    assert ninepc.depth_of_pass(programmed, percent, threshold) == pytest.approx(expected)


# ------------------------------------------------------------------------------- chapters 29 and 30


def test_half_the_diameter_of_the_tip_is_entered() -> None:
    # Page 29-2.
    assert ninepc.probe_radius(6) == 3


def test_the_approach_ends_so_far_from_the_start() -> None:
    # Page 29-4, by hand, in both directions.
    assert ninepc.approach_end(0, 50, 40) == 40
    assert ninepc.approach_end(50, 0, 40) == 10


def test_adaptive_feed_answers_the_error_and_its_sum() -> None:
    # Pages 30-1 and 30-2, with the defaults 0.1 and 0.5 of page 37-3; the errors are ours.
    assert ninepc.feedrate_change_percent(10, 4, 0.1, 0.5) == 3
    assert ninepc.feedrate_change_percent(-10, -4, 0.1, 0.5) == -3


@pytest.mark.parametrize(
    ("before", "further_in", "expected"),
    [
        pytest.param(10, 5, -1, id="30-9 from Z10 to Z5 into the part: minus"),
        pytest.param(5, 10, 1, id="30-9 from Z5 to Z10 into the part: plus"),
    ],
)
def test_the_trigger_direction_points_into_the_part(before: float, further_in: float, expected: int) -> None:
    assert ninepc.trigger_direction(before, further_in) == expected


def test_a_large_tolerance_leaves_little_way_to_stop() -> None:
    # Page 30-10: a tolerance of 20 mm and a G26 of 21 mm leave 1 mm.
    assert ninepc.deceleration_room(21, 20) == 1


def test_a_depressed_zero_takes_from_the_travel_of_the_probe() -> None:
    # Page 30-11, by hand.
    assert ninepc.probe_travel_limit(25, 5) == 20


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: ninepc.remembered_retract_moves(["X"], 0), "Max Jogs in Retracts must be a whole number"),
        (lambda: ninepc.word_value("2.79", "4.3", False, "leading"), "has up to 7 digits, not '2.79'."),
        (lambda: ninepc.word_value("12345678", "4.3", False, "leading"), "has up to 7 digits"),
        (lambda: ninepc.word_value("1", "4.3", False, "both"), "are the leading or the trailing ones"),
        (
            lambda: ninepc.word_value("1", "6-5.1", False, "leading"),
            "A word format is digits before and behind",
        ),
        (lambda: ninepc.split_t_word(1203, 4, True), "takes 1 to 3 digits for the offset, not 4."),
        (lambda: ninepc.tool_life_group(-1, 20), "The T-word must be a whole number of at least 0"),
        (lambda: ninepc.tolerance_band(1, -1), "The tolerance must not be negative"),
        (lambda: ninepc.fewest_pockets(1, 11, 10), "The magazine has 10 pockets, not 11."),
        (lambda: ninepc.corner_feedrate(100, 101), "Corner Override % must be 0 to 100 %"),
        (lambda: ninepc.lowest_compensated_feedrate(100, 101), "Minimum Feed Reduction % must be 0 to 100 %"),
        (lambda: ninepc.chamfer_length(1, 0), "The thread lead must be greater than zero"),
        (lambda: ninepc.lead_along(2, 50, 40), "The largest distance of the cut is 40, less than 50."),
        (lambda: ninepc.depth_before_finish(1, 2), "A thread 1 deep has no 2 to leave for finishing."),
        (lambda: ninepc.depth_of_pass(1, 256), "Percent of Cutting Depth must be 0 to 255 %, not 256."),
        (lambda: ninepc.trigger_direction(5, 5), "A move without length has no direction."),
        (
            lambda: ninepc.deceleration_room(19, 20),
            "A move of 19 ends before the probe has given 20 to trip.",
        ),
        (
            lambda: ninepc.probe_travel_limit(5, 5),
            "A probe depressed by 5 has nothing left of a travel of 5.",
        ),
    ],
)
def test_nonsense_is_refused_with_one_sentence(call: Callable[[], object], message: str) -> None:
    assert_refused(call, message)
