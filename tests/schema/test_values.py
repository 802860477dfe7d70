"""Values of parameters: what a person writes is read, and what is written or shown can be read back."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from amp_studio.schema import (
    InvalidValueError,
    Value,
    label_of,
    read_value,
    show_value,
    write_figure,
    write_value,
)
from amp_studio.schema.values import read_number

finite = st.floats(allow_nan=False, allow_infinity=False)


def test_every_choice_of_the_real_family_is_read_back_from_what_is_written(ninepc) -> None:
    for parameter in ninepc.parameters.values():
        for choice in parameter.choices or ():
            value = Value(choice.key == "yes" if parameter.type == "boolean" else choice.key)
            assert value == read_value(parameter, write_value(parameter, value), "")
            assert value == read_value(parameter, f"  {choice.label.upper()} ", ""), parameter.id
            assert choice.label == show_value(parameter, value) == label_of(parameter, choice.key)
            if choice.raw is not None:
                assert value == read_value(parameter, f"raw:{choice.raw}", ""), parameter.id


def test_the_letter_of_a_choice_counts_unless_it_is_another_choice_s_label(ninepc) -> None:
    for parameter in ninepc.parameters.values():
        labels = {choice.label.casefold(): choice for choice in parameter.choices or ()}
        for choice in parameter.choices or ():
            if choice.code is not None:
                wanted = labels.get(choice.code.casefold(), choice)
                expected = Value(wanted.key == "yes" if parameter.type == "boolean" else wanted.key)
                assert expected == read_value(parameter, choice.code, ""), parameter.id


def test_a_letter_of_axis_name_that_is_a_name_is_that_name(ninepc) -> None:
    """Axis Name (page 4-2): letter d is before U; u is U, and c is C although letter c is before it."""
    name = ninepc.parameter("axis.name")
    assert [Value("u"), Value("u"), Value("c"), Value("dollar-b")] == [
        read_value(name, t, "") for t in ("d", "U", "c", "$b")
    ]


@given(number=finite, index=st.integers(min_value=0))
def test_every_number_of_the_real_family_is_read_back_from_what_is_written(
    ninepc, number: float, index: int
) -> None:
    numbers = (p for p in ninepc.parameters.values() if p.type in ("real", "integer") and not p.choices)
    numeric = [p for p in numbers if not p.secret]  # a secret is shown as a mask
    parameter = numeric[index % len(numeric)]
    for unit in ninepc.units_of(parameter):
        whole = parameter.type == "integer"
        value = Value(int(max(1.0 - 2.0**53, min(2.0**53 - 1.0, number))) if whole else number, unit)
        assert value == read_value(parameter, write_value(parameter, value), unit)
        assert value == read_value(parameter, show_value(parameter, value), unit)


def test_a_code_nobody_knows_is_kept_as_it_is(ninepc) -> None:
    parameter = ninepc.parameter("axis.type")
    assert Value("raw:-7") == read_value(parameter, "raw:-7", "") == read_value(parameter, "RAW: -7", "")
    assert write_value(parameter, Value("raw:-7")) == "raw:-7"
    with pytest.raises(InvalidValueError, match="is not 'raw:' and a whole number"):
        read_value(parameter, "raw:x", "")


@pytest.mark.parametrize("word", ["yes", "Yes", "TRUE", "on", "1", "a", "raw:1"])
def test_yes_is_said_in_many_ways(ninepc, word: str) -> None:
    assert Value(True) == read_value(ninepc.parameter("zone.overtravel_used"), word, "")


@pytest.mark.parametrize("word", ["no", "No", "false", "off", "0", "b", "raw:0"])
def test_no_is_said_in_many_ways(ninepc, word: str) -> None:
    assert Value(False) == read_value(ninepc.parameter("zone.overtravel_used"), word, "")


def test_a_word_that_is_no_choice_is_refused_with_all_there_are(ninepc) -> None:
    with pytest.raises(InvalidValueError) as refused:
        read_value(ninepc.parameter("axis.type"), "turret", "")
    assert (
        str(refused.value)
        == "'turret' is not a choice of Axis Type: linear (a), rotary (b), spindle (c), unfitted (d)"
    )


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("5 kg", "'kg' is not a unit; Home Calibration is given in mm"),
        ("5 mm/min", "Home Calibration is given in mm, not in mm/min"),
        ("5 deg", "Home Calibration is given in mm, not in °"),
        ("five", "'five' is not a number"),
        ("", "'' is not a number"),
    ],
)
def test_a_value_in_a_wrong_unit_is_refused_with_the_right_one(ninepc, text: str, said: str) -> None:
    with pytest.raises(InvalidValueError) as refused:
        read_value(ninepc.parameter("home.calibration"), text, "mm")
    assert said == str(refused.value)


@pytest.mark.parametrize(
    ("number", "text"),
    [
        (4.002087499998666, "4.00209"),
        (0.4724409449, "0.472441"),
        (16777216.0, "16777216"),
        (1234567.89, "1234568"),
        (-62472.123, "-62472.1"),
        (9999.9000004, "9999.9"),
        (3.05184e-05, "3.05184e-05"),
        (13.2, "13.2"),
        (7, "7"),
        (0.0, "0"),
        (1e300, "1e+300"),
        (math.inf, "inf"),
    ],
)
def test_a_calculated_figure_has_six_digits_that_matter_and_its_whole_part(number: float, text: str) -> None:
    assert write_figure(number) == text


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("5", Value(5.0, "mm")),
        ("5 in", Value(5.0, "in")),
        ("5in", Value(5.0, "in")),
        ('5"', Value(5.0, "in")),
        ("5 Inches", Value(5.0, "in")),
        ("5000 µm", Value(5000.0, "um")),
    ],
)
def test_a_value_keeps_the_unit_it_was_entered_in(ninepc, text: str, expected: Value) -> None:
    assert expected == read_value(ninepc.parameter("home.calibration"), text, "mm")


def test_a_whole_number_takes_no_fraction(ninepc) -> None:
    parameter = ninepc.parameter("servo.velocity_gear_teeth")
    assert Value(3) == read_value(parameter, "3.0", "") == read_value(parameter, "0x3", "")
    with pytest.raises(InvalidValueError, match=r"takes whole numbers, not 3\.5"):
        read_value(parameter, "3.5", "")
    with pytest.raises(InvalidValueError, match="too large for Teeth"):
        read_value(parameter, "9007199254740993.0e1", "")


def test_a_number_with_an_exponent_of_twenty_digits_is_read_or_refused_like_any_other() -> None:
    assert read_number("0e99999999999999999999 mm") == (0.0, "mm")
    assert read_number("-0.0E-99999999999999999999") == (0.0, "")
    for text, said in (("1e-99999999999999999999", "too small"), ("1e99999999999999999999", "too large")):
        with pytest.raises(InvalidValueError, match=said):
            read_number(text)
