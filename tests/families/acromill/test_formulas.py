"""The worked numbers of the AcroMill user's guide, each with the page of its section."""

import cmath
import inspect
import math
import re

import pytest

from amp_studio.families.acromill import formulas as acromill
from amp_studio.schema import load_schema
from amp_studio.validate import formulas

# -- feedback and gains ---------------------------------------------------------------------------


def test_an_encoder_gives_four_pulses_a_line() -> None:
    # Page 113: at least 4000 counts a turn at 4x multiplication; the sign is only the direction (page 114).
    assert acromill.pulses_per_revolution(1000, 4) == acromill.pulses_per_revolution(1000, -4) == 4000
    assert acromill.pulses_per_revolution(1024, 4) == 4096


def test_a_unit_of_one_turn_has_the_pulses_of_a_turn() -> None:
    # Page 114: PPU X4096, EXC AXIS0 4 is four turns; page 60: 10000 pulses a unit.
    assert acromill.pulses_per_unit(4096, 1) == 4096
    assert acromill.pulses_of(4, 4096) == 4 * acromill.pulses_per_revolution(1024, 4)
    assert acromill.pulses_per_unit(4000, 2.5) == 10000
    assert acromill.pulses_of(2 / 10000, 10000) == pytest.approx(2)  # the band of 2 pulses of page 27


def test_ten_volts_for_a_turn_are_the_default_gain() -> None:
    gain = acromill.proportional_gain(10, 4096)
    assert round(gain, 5) == 0.00244  # pages 59 and 128
    assert f"{gain:.9f}" == "0.002441406"  # the Gain screen, page 93
    assert load_schema("acromill").parameter("servo.p_gain").default.value == round(gain, 5)
    assert acromill.proportional_volts(gain, 4096) == 10
    assert acromill.proportional_volts(gain, 2048) == 5


def test_feedforward_takes_the_place_of_the_error() -> None:
    # Page 115, the formula; by hand: what P Gain put out at this error is put out by Vel FFwd at this speed.
    speed = 500 / 60 * 4096
    forward = acromill.velocity_feedforward(0.001, 100, speed)
    assert forward * speed == pytest.approx(acromill.proportional_volts(0.001, 100))
    assert acromill.velocity_feedforward(0.05, 1, speed) == pytest.approx(
        0.0000015, rel=0.03
    )  # the printed result


def test_the_torque_limit_of_a_first_test() -> None:
    # Page 115: 5 % of (10/15) * 6 to 10 % of (10/15) * 6; TLM X4, which is printed for 10 %, is the whole.
    assert acromill.torque_limit(15, 10, 6, 100) == pytest.approx(4)
    assert acromill.torque_limit(15, 10, 6, 5) == pytest.approx(0.2)
    assert acromill.torque_limit(15, 10, 6, 10) == pytest.approx(0.4)


def test_the_gain_of_a_16_bit_output() -> None:
    assert acromill.dac_gain(16, 10) == 3276.8  # page 114
    assert acromill.dac_gain(16, 10) == load_schema("acromill").parameter("tuning.dac_gain").default.value


# -- sampling and filters ---------------------------------------------------------------------------


@pytest.mark.parametrize(("period_us", "rate"), [(500, 2000), (400, 2500), (200, 5000)])
def test_the_servo_update_frequency(period_us: float, rate: float) -> None:
    assert acromill.servo_rate(period_us) == rate  # 500 µs on page 113, 2500 and 5000 Hz on page 128


def test_the_derivative_is_sampled_in_servo_periods() -> None:
    assert acromill.derivative_width(0, 500) == 0  # page 113: zero is every servo period
    assert acromill.derivative_width(2, 500) == 0.001  # twice the servo period
    assert acromill.derivative_width(4, 500) == 0.002  # the typical value of page 59


def test_the_low_pass_filter_keeps_a_tenth_of_the_servo_update_frequency() -> None:
    assert acromill.lopass_limit(5000) == 500  # page 128: 200 Hz is allowed at 5000 Hz
    assert acromill.lopass_limit(2500) < 500  # and the 500 Hz tried at 2500 Hz are not


UNTOUCHED = (1.0, 0.0, 0.0, 0.0, 0.0)


def test_filters_that_are_not_used_let_everything_through() -> None:
    for frequency in (0, 70, 1000, 2500):
        assert acromill.filter_gain([UNTOUCHED, UNTOUCHED], frequency, 5000) == pytest.approx(1)


def test_the_filters_follow_the_equation_of_page_128() -> None:
    # By hand, in powers of 1/z as printed.
    a, b = (0.2, 0.4, 0.2), (0.5, -0.3)
    z = cmath.exp(2j * math.pi * 100 / 5000)
    one = abs((a[0] + a[1] * z**-1 + a[2] * z**-2) / (1 - b[0] * z**-1 - b[1] * z**-2))
    assert acromill.filter_gain([(*a, *b)], 100, 5000) == pytest.approx(one)
    # The same coefficients in both filters, as P12336 to P12340 copied to P12341 to P12345: twice as steep.
    assert acromill.filter_gain([(*a, *b), (*a, *b)], 100, 5000) == pytest.approx(one**2)


def test_a_zero_on_the_unit_circle_takes_its_frequency_out() -> None:
    # By hand: zeros at ±100 Hz of 5000 Hz.
    turn = 2 * math.pi * 100 / 5000
    notch = (1.0, -2 * math.cos(turn), 1.0, 0.0, 0.0)
    assert acromill.filter_gain([notch], 100, 5000) == pytest.approx(0, abs=1e-12)
    with pytest.raises(ValueError, match="a pole at this frequency"):
        acromill.filter_gain([(1.0, 0.0, 0.0, 1.0, 0.0)], 0, 5000)


# -- motion and spindle -----------------------------------------------------------------------------


def test_a_ramp_from_speed_and_time() -> None:
    # Page 115: 0 to 3000 rpm, 50 turns a second, in 0.1 s.
    assert acromill.ramp_for(3000, 0.1) == 500
    assert acromill.ramp_time(3000, 500) == pytest.approx(0.1)
    # The test move runs at 500 rpm with this ramp: not the 100 ms that are expected there.
    assert acromill.ramp_time(500, 500) == pytest.approx(0.0167, abs=1e-4)


def test_the_sine_of_the_filter_test_speeds_up_in_400_ms() -> None:
    assert acromill.ramp_time(1000 * 60, 2500) == pytest.approx(0.4)  # page 128


def test_an_index_of_fifteen_turns() -> None:
    assert acromill.index_time(15, 500) == pytest.approx(1.8)  # page 115
    assert acromill.index_time(-10, 500) == pytest.approx(1.2)  # the shorter one that was run


def test_an_override_multiplies_up_to_the_speed_of_the_machine() -> None:
    # Page 70 and the screens of pages 71 and 74: 100 in/min at 300 % on a machine of 120.
    assert acromill.overridden_feed(12, 50, 120) == 6
    assert acromill.overridden_feed(100, 300, 120) == 120
    assert acromill.overridden_feed(100, 100, 120) == 100


def test_the_scaling_of_a_spindle_of_3000_rpm() -> None:
    scaling = acromill.spindle_scaling(10, 3000)
    assert round(scaling, 5) == 0.00333  # page 77
    assert acromill.spindle_volts(scaling, 3000) == pytest.approx(10)
    assert acromill.spindle_volts(scaling, 1500) == pytest.approx(5)


# -- geometry and ballscrew -------------------------------------------------------------------------


def test_wear_is_added_to_the_radius() -> None:
    assert acromill.compensated_radius(1.6875, -0.03937) == pytest.approx(
        1.64813
    )  # R2 of the screens, page 85


def test_a_gap_of_seven_epsilons_is_no_joint() -> None:
    assert not acromill.is_joined(0.0007, 0.0001)  # so page 61
    assert acromill.is_joined(0.0001, 0.0001)
    assert acromill.is_joined(0.0007, 0.002)  # with the default


def test_a_format_of_three_digits_shows_less_than_a_thousand() -> None:
    assert acromill.largest_position("3.6") == 1000  # page 79
    assert acromill.largest_position("4.5") == 10_000


MEASURED = {
    0: (0, 0, 0, 0),
    1: (0.979, 1.000, 0.997, 0.999),
    2: (1.996, 1.998, 1.995, 1.998),
    3: (2.997, 3.000, 2.997, 2.999),
    4: (4.004, 4.001, 4.004, 4.001),
    40: (39.996, 39.999, 39.996, 39.999),
}
"""The table of page 107."""


@pytest.mark.parametrize(
    ("position", "mean", "difference"),
    [
        (0, 0, 0),
        (1, 0.99375, 0.00625),
        (2, 1.99675, 0.00325),
        (3, 2.99825, 0.00175),
        (4, 4.00250, -0.00250),
        (40, 39.9975, 0.00250),  # printed as 40.9975, with the right difference
    ],
)
def test_what_is_added_at_a_position(position: int, mean: float, difference: float) -> None:
    assert acromill.ballscrew_mean(MEASURED[position]) == pytest.approx(mean, abs=1e-12)
    assert acromill.ballscrew_difference(position, MEASURED[position]) == pytest.approx(difference, abs=1e-12)


def test_the_table_begins_at_home_and_wraps_around() -> None:
    # Page 107: home at 2, 42 words. Positions that are not printed are 0 here.
    printed = {n: acromill.ballscrew_difference(n, values) for n, values in MEASURED.items()}
    words = acromill.ballscrew_words("X", [printed.get(n, 0.0) for n in range(42)], 2).split()
    assert words[:3] == ["X0E.00325", "X1E.00175", "X2E-.00250"]
    assert words[40:] == ["X40E.00000", "X41E.00625"]
    assert words[38] == "X38E.00250"  # position 40; the guide prints X39E.00250
    assert acromill.is_ballscrew_table("X", " ".join(words))
    assert acromill.ballscrew_positions(" ".join(words)) == 42


@pytest.mark.parametrize(
    ("table", "good"),
    [
        ("X0E.00325 X1E.00175 X2E-.00250", True),
        ("X0E.00325\nX1E.00175", True),
        ("", False),
        ("X1E.00325", False),
        ("X0E.00325 X2E.00175", False),
        ("Y0E.00325", False),
        ("X0E0.00325", False),
        ("X0E.0032", False),
        ("X0E.00325 X01E.00175", False),
        ("X0 E.00325", False),
    ],
)
def test_the_form_of_a_table(table: str, good: bool) -> None:
    assert acromill.is_ballscrew_table("X", table) is good


def test_a_figure_of_an_inch_or_more_has_no_form() -> None:
    with pytest.raises(ValueError, match="digits before the point"):
        acromill.ballscrew_words("X", [1.0], 0)
    with pytest.raises(ValueError, match="outside the 2 positions"):
        acromill.ballscrew_words("X", [0.0, 0.1], 2)
    assert acromill.ballscrew_words("X", [-0.000001], 0) == "X0E.00000"


def test_the_compensation_at_work() -> None:
    # Page 107, by hand: P12295 less P12294, less the backlash.
    assert acromill.ballscrew_offset(10.0, 10.0043, 0.001) == pytest.approx(0.0033)
    assert acromill.ballscrew_offset(10.0, 10.0033, 0) == pytest.approx(0.0033)


# -- all of them --------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", formulas("acromill"))
def test_the_first_paragraph_of_a_formula_cites_its_page(name: str) -> None:
    reported = " ".join((inspect.getdoc(formulas("acromill")[name]) or "").partition("\n\n")[0].split())
    assert re.search(r"\(pages? \d{2,3}\b", reported)


@pytest.mark.parametrize(
    ("name", "arguments"),
    [
        ("proportional_gain", (10, 0)),
        ("proportional_volts", (-1, 0)),
        ("velocity_feedforward", (0.1, 10, 0)),
        ("torque_limit", (0, 10, 6, 10)),
        ("pulses_per_revolution", (1000, 0)),
        ("pulses_per_unit", (0, 1)),
        ("pulses_of", (1, -1)),
        ("servo_rate", (0,)),
        ("derivative_width", (0.5, 500)),
        ("lopass_limit", (math.inf,)),
        ("filter_gain", ([UNTOUCHED], -1, 5000)),
        ("ramp_for", (3000, 0)),
        ("ramp_time", (3000, 0)),
        ("index_time", (15, 0)),
        ("overridden_feed", (100, -1, 120)),
        ("spindle_scaling", (10, 0)),
        ("spindle_volts", (-1, 10)),
        ("dac_gain", (0, 10)),
        ("is_joined", (-1, 0)),
        ("largest_position", ("3",)),
        ("compensated_radius", (math.nan, 0)),
        ("ballscrew_mean", ([],)),
        ("ballscrew_difference", (math.nan, [1])),
        ("ballscrew_words", ("x", [0.0], 0)),
        ("ballscrew_offset", (math.nan, 0, 0)),
    ],
)
def test_an_argument_that_makes_no_sense_is_refused(name: str, arguments: tuple[object, ...]) -> None:
    with pytest.raises(ValueError, match=r"\.$"):
        formulas("acromill")[name](*arguments)
