"""Spindles: every worked example of chapters 7, 11 to 14 and 27 of the 9/PC manual, with its page in the id.

Numbers that the manual does not print, and that are worked by hand from its words, are marked "by hand".
"""

import math
from collections.abc import Callable

import pytest

from amp_studio.families.ninepc import formulas as ninepc
from tests.families.ninepc.printed import assert_refused

# ------------------------------------------------------------------------- chapters 7, 11 and 16


def test_motor_and_spindle_speed_of_a_1394_spindle_belong_together() -> None:
    # Page 7-82, by hand: 20 teeth on the motor and 40 on the spindle, so the motor turns twice as fast.
    assert ninepc.spindle_motor_speed(1500, 20, 40) == 3000
    assert ninepc.spindle_speed(ninepc.spindle_motor_speed(1500, 20, 40), 20, 40) == 1500
    # Page 7-82: a direct drive is entered as one and one.
    assert ninepc.spindle_motor_speed(3000, 1, 1) == 3000


def test_the_spindle_turns_faster_where_the_radius_is_smaller() -> None:
    # Page 11-1 prints no figures; by hand: 100 m/min on a diameter of 100 mm are 1000 / pi rpm.
    assert ninepc.css_spindle_speed(100, 50, inch=False) == pytest.approx(1000 / math.pi)
    assert ninepc.css_spindle_speed(100, 25, inch=False) == pytest.approx(2000 / math.pi)
    # The same cut in feet and inches: 25.4 mm are 1 in, and 304.8 mm are 1 ft.
    assert ninepc.css_spindle_speed(100 / 0.3048, 50 / 25.4, inch=True) == pytest.approx(1000 / math.pi)


def test_a_feed_per_revolution_becomes_one_per_minute() -> None:
    # Pages 16-7 and 16-10, by hand: a lead of 1.5 mm at 200 rpm.
    assert ninepc.feed_per_minute(1.5, 200) == 300


# -------------------------------------------------------------------------- chapters 12 and 13


def test_the_output_voltage_is_a_share_of_that_at_the_highest_speed() -> None:
    # Page A-4 scales gear 1 to 10 V at 3000 rpm; half the speed by hand.
    assert ninepc.spindle_voltage(3000, 3000, 10) == 10
    assert ninepc.spindle_voltage(1500, 3000, 10) == 5
    assert ninepc.spindle_voltage(1500, 3000, -10) == -5


def test_the_ramp_adds_the_same_in_every_coarse_iteration() -> None:
    # Page 12-3, by hand: 3000 rpm in 300 ms are 200 rpm in each scan of 20 ms.
    assert ninepc.spindle_ramp_step(3000, 300, 20) == 200


def test_a_tolerance_of_20_percent_lets_1000_rpm_be_800_to_1200() -> None:
    # Page 12-5, and again in chapter 13.
    assert ninepc.deviation_band(1000, 20) == (800, 1200)
    assert ninepc.deviation_band(1000, 0) == (1000, 1000)


def test_the_filter_time_is_the_mean_of_a_small_and_the_largest_change() -> None:
    # Page 12-9, and again in chapter 13: 20 ms and 160 ms make 90 ms.
    assert ninepc.deviation_filter_time_ms(20, 160) == 90


@pytest.mark.parametrize(
    ("marker", "calibration", "expected"),
    [
        pytest.param(0, 0, 0, id="12-11 zero where the marker is the zero position"),
        pytest.param(300, 90, 30, id="12-11 by hand: over the turn"),
        pytest.param(30, -90, 300, id="12-11 by hand: a negative angle"),
    ],
)
def test_the_spindle_zero_lies_at_the_marker_plus_calibration(
    marker: float, calibration: float, expected: float
) -> None:
    assert ninepc.spindle_zero_angle(marker, calibration) == expected


@pytest.mark.parametrize(
    ("position", "target", "expected"),
    [(10, 30, 20), (30, 10, -20), (350, 10, 20), (10, 350, -20), (0, 180, 180), (180, 0, 180), (45, 45, 0)],
)
def test_an_orient_takes_the_shortest_way(position: float, target: float, expected: float) -> None:
    # Page 12-13; the angles are ours.
    assert ninepc.orient_turn(position, target) == expected


def test_gain_one_is_a_thousandth_of_a_turn_per_rpm() -> None:
    # Page 12-15: gain in rpm per .001 revolutions, which is 0.36 degrees.
    assert ninepc.spindle_following_error(1, 1) == 0.36
    assert ninepc.spindle_following_error(500, 1) == 180
    assert ninepc.spindle_following_error(500, 2) == 90


# ---------------------------------------------------------------------------------- chapter 14


@pytest.mark.parametrize(
    ("counts", "ratio"),
    [
        pytest.param((2000, 2000), (1, 1), id="14-1 1:1"),
        pytest.param((10_000, 7000), (10, 7), id="14-1 10:7"),
    ],
)
def test_a_simple_feedback_ratio_is_allowed(counts: tuple[int, int], ratio: tuple[int, int]) -> None:
    assert ninepc.synchronized_feedback_ratio(*counts) == ratio


@pytest.mark.parametrize(
    ("counts", "ratio"),
    [
        pytest.param((11_000, 1000), "11:1", id="14-1 11:1 is an error"),
        pytest.param((5000, 12_000), "5:12", id="14-1 5:12 is an error"),
    ],
)
def test_a_side_above_ten_is_an_error(counts: tuple[int, int], ratio: str) -> None:
    with pytest.raises(ValueError, match=f"The feedback ratio {ratio} has a side above 10."):
        ninepc.synchronized_feedback_ratio(*counts)


EXAMPLE_14_1 = [
    ((1000, 3000), (100, 300), 1500, None, None),
    ((1000, 3000), (800, 1500), 1800, (1000, 1500), 1500),
    ((1000, 3000), (1800, 3200), 1500, (1800, 3000), 1800),
]


@pytest.mark.parametrize(
    ("controlling", "follower", "requested", "valid", "speed"),
    [pytest.param(*row, id=f"14-2 example 14.1, row {n}") for n, row in enumerate(EXAMPLE_14_1, 1)],
)
def test_example_14_1(
    controlling: tuple[float, float],
    follower: tuple[float, float],
    requested: float,
    valid: tuple[float, float] | None,
    speed: float | None,
) -> None:
    assert ninepc.synchronized_range(controlling, follower) == valid
    assert ninepc.synchronized_speed(requested, controlling, follower) == speed


def test_a_speed_within_both_gears_is_kept() -> None:
    assert ninepc.synchronized_speed(1200, (1000, 3000), (800, 1500)) == 1200


def test_a_reversed_follower_orients_to_the_mirrored_angle() -> None:
    # Page 14-4: 45 degrees on the controlling spindle are 315 on the follower.
    assert ninepc.mirrored_angle(45) == 315
    assert ninepc.mirrored_angle(0) == 0


def test_the_follower_is_behind_by_the_offset() -> None:
    # Page 14-6: offset 60, controlling spindle at 80: 20, or -20 with the reversed direction.
    assert ninepc.follower_position(80, 60, is_reversed=False) == 20
    assert ninepc.follower_position(80, 60, is_reversed=True) == -20


# ---------------------------------------------------------------------------------- chapter 27


def test_acceleration_time_is_entered_in_seconds() -> None:
    # Page 27-2: enter 0.125 where it takes 125 msec.
    assert ninepc.acceleration_time_s(125) == 0.125


def test_the_tapping_ramp_reaches_the_highest_tapping_speed_in_that_time() -> None:
    # Page 27-2, with the 0.125 s of its example and the 500 rpm of the default (37-3).
    assert ninepc.tapping_ramp(500, 0.125) == 4000


def test_axis_and_spindle_tap_with_the_lower_gain_and_acceleration() -> None:
    # Page 12-15 for the gain, page 27-2 for the acceleration; the figures are ours.
    assert ninepc.tapping_gain(1.0, 0.5) == 0.5
    assert ninepc.tapping_gain(0.8, 2.0) == 0.8
    # 4000 rpm/s on a lead of 1.5 mm are 100 mm/s2.
    assert ninepc.tapping_acceleration(4000, 1.5, 250) == 100
    assert ninepc.tapping_acceleration(4000, 1.5, 25.4) == 25.4


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (
            lambda: ninepc.css_spindle_speed(100, 0, inch=False),
            "The distance from the center must be greater",
        ),
        (lambda: ninepc.spindle_voltage(3001, 3000, 10), "The gear ends at 3000 rpm, below 3001."),
        (lambda: ninepc.spindle_ramp_step(3000, 0, 20), "The duration of the ramp must be greater than zero"),
        (lambda: ninepc.deviation_band(1000, 120), "Spindle Deviation Tolerance must be 0 to 100 %"),
        (lambda: ninepc.spindle_following_error(100, 0), "The gain must be greater than zero"),
        (lambda: ninepc.synchronized_range((3000, 1000), (0, 1)), "A gear cannot go from 3000 to 1000 rpm."),
        (lambda: ninepc.tapping_ramp(500, 0), "Acceleration Time must be greater than zero"),
        (lambda: ninepc.spindle_motor_speed(1, 1.5, 1), "The number of motor teeth must be a whole number"),
    ],
)
def test_nonsense_is_refused_with_one_sentence(call: Callable[[], object], message: str) -> None:
    assert_refused(call, message)
