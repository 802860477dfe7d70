"""Servos, coupled axes, OCI and tuning: the worked examples and tables of chapters 7, 10,
31 to 36 and the appendices.

The page is with each case. Numbers that the manual does not print, and that are worked by hand from its
words, are marked "by hand".
"""

from collections.abc import Callable

import pytest

from amp_studio.families.ninepc import formulas as ninepc
from amp_studio.families.ninepc.formulas.oci import DATA_TYPE_BYTES, OVERHEAD_BYTES
from amp_studio.families.ninepc.formulas.tuning import DAC_FUNCTIONS
from amp_studio.schema import load_schema
from tests.families.ninepc.printed import assert_refused

SCHEMA = load_schema("9pc")

# ------------------------------------------------------------------------------- chapters 7 and 10


@pytest.mark.parametrize(
    ("moves_positive", "counts_up", "expected"),
    [
        pytest.param(True, True, 1, id="7-36 positive, up: plus"),
        pytest.param(True, False, -1, id="7-36 positive, down: minus"),
        pytest.param(False, False, 1, id="7-36 negative, down: plus"),
        pytest.param(False, True, -1, id="7-36 negative, up: minus"),
    ],
)
def test_the_sign_of_feedback(moves_positive: bool, counts_up: bool, expected: int) -> None:
    assert ninepc.feedback_sign(moves_positive, counts_up) == expected


def test_a_series_of_gears_becomes_one_pair() -> None:
    # Page 7-38: 44:40 is reduced to 11:10. A second pair by hand.
    assert ninepc.gear_train([(44, 40)]) == (11, 10)
    assert ninepc.gear_train([(44, 40), (1, 2)]) == (11, 20)


def test_the_velocity_device_turns_more_often_behind_a_larger_screw_wheel() -> None:
    # Page 7-52, by hand; the reciprocal of the position ratio of page 7-38 for the same wheels.
    assert ninepc.feedback_revolutions_per_screw_revolution(20, 40) == 2
    assert ninepc.screw_revolutions_per_feedback_revolution(20, 40) == 0.5


def test_a_fine_scale_needs_a_smaller_pitch() -> None:
    # Page B-2; the scale is that of page 7-33, with four counts a line, the limit that of the same page.
    pitch = ninepc.largest_scale_pitch(5000, 0.5)
    assert pitch == 104.8576
    assert ninepc.scale_counts_per_cycle(5000, 0.5, pitch) == 4_194_304


def test_the_acceleration_command_adds_error_and_sum() -> None:
    # Pages 7-54 and 7-56, by hand, with the defaults 17408 and 82 of page 37-3.
    assert ninepc.acceleration_command(2, 10, 17408, 82) == 2 * 17408 + 10 * 82


@pytest.mark.parametrize("table", ["7.B", "7.C"])
def test_every_standard_motor_has_its_printed_gains(table: str) -> None:
    printed = SCHEMA.tables[table]
    for place, motors in enumerate(printed.head[1:], 1):
        column = [float(row[place]) for row in printed.rows]
        assert printed.column(motors.split(", ")[0]) == tuple(column)
        for ratio, value in enumerate(column):
            assert ninepc.standard_motor_gain(column, ratio) == value
            # What we say of the tables in gain_for_inertia, and the one figure that falls out (7-54).
            grown = ninepc.gain_for_inertia(column[0], ratio)
            assert value == (17460 if grown == 17476 else grown)


def test_gains_are_looked_up_by_motor() -> None:
    # Pages 7-54 and 7-56: the row 1 : 2 of the B515E.
    gains = [SCHEMA.tables[table].column("B515E") for table in ("7.B", "7.C")]
    assert [ninepc.standard_motor_gain(column, 2) for column in gains if column] == [22500, 900]


@pytest.mark.parametrize(
    ("motor", "load", "expected"), [(1, 0, 0), (1, 1, 1), (2, 2.2, 2), (0.1, 0.3, 3), (1, 7, 3)]
)
def test_the_inertia_ratio_is_rounded_up(motor: float, load: float, expected: int) -> None:
    # Page 7-71; the inertias are ours.
    assert ninepc.load_inertia_ratio(motor, load) == expected


def test_a_deceleration_ramp_of_zero_is_that_of_acceleration() -> None:
    # Pages 10-10 and 10-13.
    assert ninepc.deceleration_in_force(0, 25.4) == 25.4
    assert ninepc.deceleration_in_force(50, 25.4) == 50


# ------------------------------------------------------------------------------- chapters 31 and 32


def test_a_dual_group_has_the_limits_of_its_slowest_axis() -> None:
    # Page 31-2; the feedrates are ours.
    assert ninepc.dual_group_limit([2540, 2000, 3000]) == 2000


def test_different_gains_make_a_skew() -> None:
    # Pages 32-1 and 7-25, by hand: at 1000 mm/min the gains 1 and 0.8 leave 1 and 1.25 mm.
    assert ninepc.split_axis_skew(1, 1.25) == ninepc.split_axis_skew(1.25, 1) == 0.25
    assert ninepc.split_axis_skew_at(1000, 1, 0.8) == pytest.approx(0.25)
    assert ninepc.split_axis_skew_at(1000, 1, 1) == 0


# ------------------------------------------------------------------------------- chapters 33 and 34


def test_the_default_password_in_ascii() -> None:
    # Page 33-12: AB-D4, with the blank, 32, as the sixth character.
    assert ninepc.password_codes("AB-D4") == (65, 66, 45, 68, 52, 32)


def test_a_watchlist_is_the_sum_of_its_items() -> None:
    # Page 34-4, by hand: 28 + 1, 28 + 10 x 8 and 28 + 128 bytes.
    assert ninepc.watchlist_bytes([("BOOL", 1)]) == 29
    assert ninepc.watchlist_bytes([("BOOL", 1), ("LREAL", 10), ("STRNG", 1)]) == 29 + 108 + 156
    assert ninepc.watchlist_bytes([]) == 0


def test_the_data_types_are_those_of_the_printed_table() -> None:
    printed = dict(SCHEMA.tables["watchlist-bytes"].rows)
    assert printed.pop("Overhead per item") == OVERHEAD_BYTES
    assert printed.pop("All Command Requests") == 0
    assert printed == DATA_TYPE_BYTES


# ------------------------------------------------------------------------- chapter 36 and appendix A


def test_a_calibration_point_is_at_most_two_percent_of_the_way() -> None:
    # Page 36-7: 2 % of the way between two points; the largest way is 84 inches. By hand.
    assert ninepc.calibration_limit(84, 0) == pytest.approx(1.68)
    assert ninepc.calibration_limit(-100, 100) == 4
    # Page 36-7: negative where the actual position is on the negative side.
    assert ninepc.calibration_deviation(100, 99.98) == pytest.approx(-0.02)
    # Page 36-7: the corrections of a roll-over axis add up to zero.
    assert ninepc.net_correction([0.1, 0.2, -0.3]) == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize(
    ("function", "axis", "code"),
    [
        pytest.param(200, 4, 204, id="A-6 following error of the fourth axis"),
        pytest.param(500, 4, 504, id="A-6 coarse IPCs of the fourth axis"),
        *(pytest.param(f, 1, f + 1, id=f"A-7 table A.C, {f + 1}") for f in DAC_FUNCTIONS),
    ],
)
def test_the_code_of_the_dac_monitor(function: int, axis: int, code: int) -> None:
    assert ninepc.dac_monitor_code(function, axis) == code
    assert ninepc.dac_monitor_function(code) == (function, axis)


def test_the_functions_are_those_of_table_a_b() -> None:
    assert SCHEMA.tables["A.B"].column("Function Code") == DAC_FUNCTIONS


def test_the_scales_to_begin_with_are_those_of_table_a_c() -> None:
    table = SCHEMA.tables["A.C"]
    for pitch, head in ((0.1, "Pitch 0.1 in."), (0.5, "Pitch 0.5 in.")):
        found = [ninepc.dac_starting_scale(function, pitch) for function in DAC_FUNCTIONS]
        assert found == [float(each) for each in table.column(head)]


def test_a_tuned_integral_gain_is_5_to_10_times_smaller() -> None:
    # Page A-10; the gain is the default of page 37-3.
    assert ninepc.typical_integral_gain(17408) == (1740.8, 3481.6)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: ninepc.gear_train([]), "A gear train needs at least one pair of wheels."),
        (lambda: ninepc.gear_train([(44, 0)]), "The number of teeth must be a whole number of at least 1"),
        (
            lambda: ninepc.standard_motor_gain([1000, 2000], 2),
            "The column of the motor ends at 1 : 1, before 1 : 2.",
        ),
        (
            lambda: ninepc.standard_motor_gain([1000], -1),
            "The load inertia ratio must be a whole number of at least 0",
        ),
        (lambda: ninepc.load_inertia_ratio(0, 1), "The inertia of the motor must be greater than zero"),
        (lambda: ninepc.dual_group_limit([1000]), "A dual group has at least two axes."),
        (lambda: ninepc.split_axis_skew_at(1000, 1, 0), "The gain must be greater than zero"),
        (lambda: ninepc.password_codes("AB-D4567"), "The master password is up to six characters"),
        (lambda: ninepc.password_codes("ab"), "of ASCII 32 to 95, without small letters."),
        (lambda: ninepc.watchlist_bytes([("FLOAT", 1)]), "'FLOAT' is no data type of the watchlist"),
        (lambda: ninepc.watchlist_bytes([("BOOL", 0)]), "The number of array indices must be a whole number"),
        (lambda: ninepc.dac_monitor_code(150, 1), "A function code of the DAC monitor is 100, 200 to 600"),
        (lambda: ninepc.dac_monitor_code(100, 9), "The axis number must be 1 to 8, not 9."),
        (lambda: ninepc.dac_monitor_function(200), "The axis number must be a whole number of at least 1"),
        (lambda: ninepc.dac_monitor_function(704), "A function code of the DAC monitor is"),
        (
            lambda: ninepc.dac_starting_scale(700, 0.1),
            "A function code of the DAC monitor is 100, 200 to 600",
        ),
        (lambda: ninepc.dac_starting_scale(100, 0.2), "a scale for 0.2 in is not printed"),
    ],
)
def test_nonsense_is_refused_with_one_sentence(call: Callable[[], object], message: str) -> None:
    assert_refused(call, message)
