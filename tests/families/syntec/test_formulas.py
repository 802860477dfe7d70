"""Every worked number of the Syntec slides that a formula must give back.

The id of each case begins with the section, counted as in ``parameter_db/syntec/family.yaml``. Comparisons
are exact or marked. Where a printed number leaves a step out,
the formula is asserted and what is printed is beside it.
"""

import math
from collections.abc import Callable, Sequence

import pytest

from amp_studio.families.syntec import formulas as syntec
from amp_studio.families.syntec.formulas.resolution import STANDARD_BLU
from amp_studio.schema import Value, load_schema
from amp_studio.schema.scales import unit_size
from amp_studio.validate import calculate

# -------------------------------------------------------------------------------------- resolution


@pytest.mark.parametrize(
    ("programmed", "is_diameter", "expected"),
    [
        pytest.param(10, False, 10, id="1.2.3 G0 G91 X10. with radius moves 10"),
        pytest.param(10, True, 5, id="1.2.3 G0 G91 X10. with diameter moves 5"),
    ],
)
def test_a_diameter_axis_moves_half(programmed: float, is_diameter: bool, expected: float) -> None:
    assert syntec.axis_move(programmed, is_diameter) == expected


@pytest.mark.parametrize(
    ("pulses", "multiplication", "expected"),
    [
        pytest.param(1000, 4, 250, id="1.2.5 linear encoder of 1 um a pulse: 1000/4=250"),
        pytest.param(10000, 4, 2500, id="1.3.1 Pr.61=2500, Pr.81=4"),
        pytest.param(1048576, 4, 262144, id="1.3.2 Pr.61=262144, Pr.81=4"),
    ],
)
def test_the_resolution_is_that_before_multiplication(
    pulses: float, multiplication: float, expected: float
) -> None:
    assert syntec.encoder_resolution(pulses, multiplication) == expected
    assert syntec.pulses_per_turn(expected, multiplication) == pulses


def test_a_pulse_of_the_linear_encoder_is_a_micrometre() -> None:
    """Section 1.2.5: 1um/pulse (1mm/1000 pulse), Pr8x=4, Pr.61=250."""
    assert syntec.scale_pulse_length(250, 4) == 1.0


def test_the_motor_turns_twice_for_a_gear_of_two_to_one() -> None:
    """Section 1.2.6: screw side : motor side = 2 : 1 means screw speed : motor speed = 1 : 2."""
    assert syntec.motor_turns_per_screw_turn(2, 1) == 2
    assert syntec.travel_per_motor_turn(10000, 2, 1) == 5000


def test_a_pulse_of_the_setting_example_is_a_micrometre_without_its_gear() -> None:
    """Section 1.3.1 asks for 1 µ/pulse and leaves the gear out;
    with it the pulse is half as long (e-61-example).
    """
    assert syntec.pulse_length(10000, 10000) == 1.0
    assert syntec.pulse_length(10000, 10000, 2, 1) == 0.5


@pytest.mark.parametrize(
    ("length", "expected"),
    [
        pytest.param(10, 10000, id="1.3.1 Pitch=10mm, Pr.161=10000"),
        pytest.param(25, 25000, id="3.5 Pr2501 = 25000 is X25."),
        pytest.param(10, 10000, id="3.5 Pr2502 = 10000 is X10."),
        pytest.param(30, 30000, id="3.5 Pr2503 = 30000 is Y30."),
        pytest.param(15, 15000, id="3.5 Pr2504 = 15000 is Y15."),
        pytest.param(20, 20000, id="3.5 Pr2505 = 20000 is Z20."),
        pytest.param(0, 0, id="3.5 Pr2506 = 0 is Z0."),
        pytest.param(0.3, 300, id="no figure of the text: the count is a whole number"),
    ],
)
def test_lengths_are_counts_of_a_thousandth(length: float, expected: float) -> None:
    assert syntec.blu_count(length) == expected
    assert math.isclose(syntec.blu_length(expected), length)


def test_the_blu_of_the_formulas_is_that_of_the_facts() -> None:
    scale = load_schema("syntec").family.scales["BLU"]
    for entry, unit in ((scale.length, "mm"), (scale.angle, "deg")):
        size = unit_size(entry, Value("standard"))
        assert size is not None
        assert (float(size[0]), size[1]) == (STANDARD_BLU, unit)


def test_the_linear_and_the_angular_blu_have_the_same_figure_and_the_inch_another() -> None:
    """Section 1.2.6: 0.0001inch / 0.001mm / 0.001deg."""
    assert syntec.blu_count(360.0) == 360000
    assert syntec.blu_count(1.0, 0.0001) == 10000


# --------------------------------------------------------------------------------------------- DDA


@pytest.mark.parametrize(
    ("series", "expected"),
    [
        pytest.param("super", 983, id="1.4.1 Super series is 983 usec"),
        pytest.param("a10", 819, id="1.4.1 10/11 series:819 usec"),
        pytest.param("b10", 819, id="1.4.1 10/11 series:819 usec, B"),
    ],
)
def test_the_hardware_basic_time_goes_by_the_series(series: str, expected: float) -> None:
    assert syntec.hardware_basic_time_us(series) == expected
    assert syntec.is_basic_time_printed(series)


def test_the_series_are_those_of_the_parameter_and_of_its_printed_table() -> None:
    schema = load_schema("syntec")
    notes = {c.key: c.note for c in schema.parameter("control.series").choices}
    reported = {
        key: f"hardware basic time {time:.0f} µs" for key, time in syntec.dda.PRINTED_BASIC_TIMES_US.items()
    } | dict.fromkeys(syntec.dda.WITHOUT_PRINTED_TIME, "no time is printed, 983 µs is assumed")
    assert {key: note for key, note in notes.items() if note} == reported
    assert schema.tables["hardware-basic-time"].column("Hardware basic time")[:2] == (983.0, 819.0)


@pytest.mark.parametrize("series", ["s20", "s21", "s6", "ez"])
def test_without_a_printed_time_the_longest_one_counts(series: str) -> None:
    """Section 1.4.1: the 20/21 series refer to Pr3203; the others are not named."""
    assert syntec.hardware_basic_time_us(series) == 983
    assert not syntec.is_basic_time_printed(series)


def test_a_series_that_does_not_exist_has_no_time() -> None:
    with pytest.raises(ValueError, match="series must be one of super, a10, b10, s20, s21, s6, ez"):
        syntec.hardware_basic_time_us("s30")


def test_the_interpolation_time_of_the_example() -> None:
    """Section 1.4.2: 1966usec (Pr 3203=2000, 2 x 983usec)."""
    assert syntec.interpolation_time_us(2000, 983) == 1966
    assert syntec.interpolation_time_us(1000, 819) == 819


def test_the_highest_feedrate_of_the_example() -> None:
    """Section 1.4.2: 2047 / 1966e-6 x 60 pulses a minute, / 10000 rpm, x 10 mm = 62.472 m/min."""
    assert math.isclose(syntec.dda_pulses_per_minute(1966), 2047 / (1966e-6) * 60)
    assert math.isclose(syntec.dda_motor_speed(1966, 10000), 2047 / (1966e-6) * 60 / 10000)
    assert f"{syntec.dda_feedrate(1966, 10000, 10) / 1000:.3f}" == "62.472"


def test_a_gear_lowers_the_feedrate_that_the_printed_formula_gives() -> None:
    """Section 1.4.2 leaves the gear out; with 2 : 1 the screw turns half as fast (1.2.6, e-121-dda)."""
    plain = syntec.dda_feedrate(1966, 10000, 10)
    assert math.isclose(syntec.dda_feedrate(1966, 10000, 10, 2, 1), plain / 2)


def test_at_the_limit_2047_pulses_fall_into_one_interpolation_time() -> None:
    """Section 1.5.1: out of 2047 pulses in the one interpolation time interval, and the alarm appears."""
    for gear in ((1, 1), (2, 1), (3, 7)):
        highest = syntec.dda_feedrate(1966, 10000, 10, *gear)
        assert math.isclose(syntec.commands_per_interpolation(highest, 1966, 10000, 10, *gear), 2047)
    assert syntec.commands_per_interpolation(0, 1966, 10000, 10) == 0


# --------------------------------------------------------------------------------- following error


def test_the_following_error_of_the_example() -> None:
    """Section 1.5.3: 1000 * 1000 / 60 / 30 = 555, its decimals cut off (e-gain-555)."""
    error = syntec.following_error(1000, 30)
    assert math.floor(error) == 555
    assert math.isclose(error, 1000 * 1000 / 60 / 30)


@pytest.mark.parametrize(
    ("limit", "factor"),
    [
        pytest.param(syntec.following_error_limit, 2, id="1.5.3 MOT-019: max(homing, G00) / Kp * 2"),
        pytest.param(syntec.fatal_following_error_limit, 4, id="1.5.4 MOT-023: max(homing, G00) / Kp * 4"),
    ],
)
def test_the_alarms_come_at_twice_and_four_times_the_error_of_the_faster_speed(
    limit: Callable[..., float], factor: float
) -> None:
    assert math.isclose(limit(1000, 400, 30), factor * 1000 * 1000 / 60 / 30)
    assert limit(1000, 400, 30) == limit(400, 1000, 30)
    assert math.isclose(limit(1000, 400, 30, 0.0001), 10 * limit(1000, 400, 30))


@pytest.mark.parametrize("gain", [1, 30, 47.5])
def test_the_speed_of_an_alarm_does_not_depend_on_the_loop_gain(gain: float) -> None:
    """Sections 1.5.3 and 1.5.4: the gain is on both sides."""
    for speed, limit in (
        (syntec.alarm_speed(3000, 10000), syntec.following_error_limit(3000, 10000, gain)),
        (syntec.fatal_alarm_speed(3000, 10000), syntec.fatal_following_error_limit(3000, 10000, gain)),
    ):
        assert math.isclose(syntec.following_error(speed, gain), limit)


# -------------------------------------------------------------------------------------------- home


@pytest.mark.parametrize(
    ("turns", "expected"),
    [
        pytest.param(0.25, 25, id="2.2.4.1 25 equivalent to 1/4 turn"),
        pytest.param(0.5, 50, id="2.2.4.1 50 equivalent to half turn"),
    ],
)
def test_the_home_grid_is_a_percentage_of_a_turn(turns: float, expected: float) -> None:
    assert syntec.home_grid(turns) == expected


@pytest.mark.parametrize(
    ("grid", "expected"),
    [
        pytest.param(19.9, True, id="2.2.4.1 less than 20"),
        pytest.param(20, False, id="2.2.4.1 20 is not less"),
        pytest.param(80, False, id="2.2.4.1 80 is not greater"),
        pytest.param(80.1, True, id="2.2.4.1 greater than 80"),
    ],
)
def test_the_home_grid_function_is_advised_close_to_an_index(grid: float, expected: bool) -> None:
    assert syntec.is_home_grid_advised(grid) is expected


@pytest.mark.parametrize(
    ("grid", "enabled", "expected"),
    [
        pytest.param(49.9, True, True, id="2.2.4.1 smaller than 50 (half turn)"),
        pytest.param(50, True, False, id="2.2.4.1 50 is not smaller"),
        pytest.param(10, False, False, id="2.2.4.1 only when Pr941 ~ 960 set 1"),
    ],
)
def test_an_index_within_half_a_turn_is_passed_over(grid: float, enabled: bool, expected: bool) -> None:
    assert syntec.is_index_ignored(grid, enabled) is expected


@pytest.mark.parametrize(
    ("first", "later", "expected"),
    [
        pytest.param(30, 40, False, id="2.2.5.1 0.1 turn is not over 0.1 turn"),
        pytest.param(30, 40.1, True, id="2.2.5.1 over 0.1 turn"),
        pytest.param(40.1, 30, True, id="2.2.5.1 over 0.1 turn, the other way"),
        pytest.param(60.1, 70.1, False, id="2.2.5.1 0.1 turn in doubles"),
    ],
)
def test_a_home_grid_that_wanders_is_an_alarm(first: float, later: float, expected: bool) -> None:
    assert syntec.is_home_inaccurate(first, later) is expected


def test_the_search_of_the_index_ends_after_five_pitches() -> None:
    """Sections 2.2.5.2 and 2.2.5.4: more than 5 pitches; 10000 is the pitch of 1.3.1."""
    assert syntec.homing_search_limit(10000) == 50000


# ------------------------------------------------------------------------------------------ limits


@pytest.mark.parametrize(
    ("first", "second", "expected"),
    [
        pytest.param(100, 200, (100, 200), id="3.4 G22 X100. I200."),
        pytest.param(200, 100, (100, 200), id="3.4 G22 X200. I100 is the same"),
        pytest.param(0, 0, None, id="3.4 G22X0 I0 is disabled"),
        pytest.param(10, 10, None, id="3.4 G22X10 I10 is disabled"),
        pytest.param(0, 10, (0, 10), id="3.4 G22X0 I10 represents X0 ~ X10"),
        pytest.param(10, 0, (0, 10), id="3.4 G22X10 I0 represents X0 ~ X10"),
    ],
)
def test_the_ends_of_g22_may_be_exchanged(
    first: float, second: float, expected: tuple[float, float] | None
) -> None:
    assert syntec.protected_range(first, second) == expected


BLOCK = ((25, 30, 20), (10, 15, 0))
"""Section 3.5: X10. to X25., Y15. to Y30., Z0. to Z20."""
WITH_Z2 = ((100, 100, 100, 100), (0, 0, 0, 10))
"""Section 3.5: X, Y, Z 0 to 100 and Z2 10. to 100."""


@pytest.mark.parametrize(
    ("positions", "ends", "expected"),
    [
        pytest.param((12, 20, 5), BLOCK, True, id="3.5 inside all three"),
        pytest.param((9.999, 20, 5), BLOCK, False, id="3.5 X short of X10."),
        pytest.param((12, 30.001, 5), BLOCK, False, id="3.5 Y beyond Y30."),
        pytest.param((12, 20, 0), BLOCK, True, id="3.5 Z0. itself, a range that ends at 0"),
        pytest.param((50, 50, 50, 0), WITH_Z2, False, id="3.5 X50 Y50 Z50 Z2= 0. is not protected"),
        pytest.param((50, 50, 50, 10), WITH_Z2, True, id="3.5 with Z2 inside its own range it is"),
        pytest.param((0, 5), ((0, 10), (0, 0)), True, id="3.4 an axis whose range is disabled takes no part"),
        pytest.param(
            (0, 0), ((0, 10), (0, 10)), False, id="3.4 with every range disabled nothing is protected"
        ),
    ],
)
def test_the_protected_block_is_where_all_axes_are_inside(
    positions: Sequence[float], ends: tuple[Sequence[float], Sequence[float]], expected: bool
) -> None:
    assert syntec.is_inside_protection(positions, *ends) is expected


# --------------------------------------------------------------------------------- what makes no sense


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: syntec.encoder_resolution(0, 4), "pulses must be greater than zero"),
        (lambda: syntec.travel_per_motor_turn(10000, 0), "screw_teeth must be greater than zero"),
        (lambda: syntec.dda_feedrate(0, 10000, 10), "time_us must be greater than zero"),
        (lambda: syntec.following_error(1000, 0), "gain must be greater than zero"),
        (lambda: syntec.following_error(-1, 30), "speed must not be negative"),
        (lambda: syntec.alarm_speed(-1, -1), "speed must not be negative"),
        (lambda: syntec.home_grid(-0.1), "turns must not be negative"),
        (lambda: syntec.blu_count(math.nan), "length must be a finite number"),
        (lambda: syntec.is_inside_protection([1], [2, 3], [0, 0]), "must be as many"),
    ],
)
def test_an_argument_that_makes_no_sense_is_named(call: Callable[[], float], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        call()


def test_the_formulas_work_as_calculators() -> None:
    texts = {"time_us": "1966", "pulses": "10000", "pitch": "10"}
    assert calculate("syntec", "dda_feedrate", texts) == syntec.dda_feedrate(1966, 10000, 10)
    texts = {"positions": "12, 20, 5", "positives": "25, 30, 20", "negatives": "10, 15, 0"}
    assert calculate("syntec", "is_inside_protection", texts) is True
    assert calculate("syntec", "hardware_basic_time_us", {"series": "super"}) == 983
