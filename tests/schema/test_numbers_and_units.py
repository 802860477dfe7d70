"""Numbers as people write them, units, and that whatever is written can be read back."""

from __future__ import annotations

import math
from decimal import Decimal
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from amp_studio.schema import (
    DatabaseError,
    InvalidValueError,
    UnitError,
    Value,
    angular,
    canonical,
    canonical_unit,
    convert,
    dimension,
    label_of,
    read_number,
    read_value,
    same_value,
    show_value,
    shown,
    unit_named,
    write_number,
    write_value,
)
from amp_studio.schema.load import compile_family
from amp_studio.schema.units import ALIASES, UNITS

# -- numbers ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("0.5", (0.5, "")),
        ("0,5", (0.5, "")),
        (",5", (0.5, "")),
        ("-12,75 mm", (-12.75, "mm")),
        ("1.234", (1.234, "")),
        ("0,125", (0.125, "")),
        ("1,2345", (1.2345, "")),
        ("1234,567", (1234.567, "")),
        ("1,234.5", (1234.5, "")),
        ("1.234,5", (1234.5, "")),
        ("1,234,567", (1234567.0, "")),
        ("1.234.567,8", (1234567.8, "")),
        ("12 345,678", (12345.678, "")),
        ("12 345.6 mm", (12345.6, "mm")),
        ("12'345", (12345.0, "")),
        ("12_345", (12345.0, "")),
        ("1e3", (1000.0, "")),
        ("1,5e-3 in", (0.0015, "in")),
        ("+7", (7.0, "")),
        ("3000 1/min", (3000.0, "1/min")),
        ("10mm/min", (10.0, "mm/min")),
        ('2.5"', (2.5, '"')),
        ("  4  ", (4.0, "")),
    ],
)
def test_a_number_is_read_with_comma_or_point(text: str, expected: tuple[float, str]) -> None:
    assert expected == read_number(text)


@pytest.mark.parametrize("text", ["1,234", "-1,234", "+999,000", "12,345 mm", "123,456e3"])
def test_a_comma_that_could_be_either_is_refused_with_both_ways(text: str) -> None:
    with pytest.raises(InvalidValueError, match=r"can be read two ways: write .* or .*"):
        read_number(text)


def test_the_two_ways_of_an_ambiguous_number_are_those_a_person_can_write() -> None:
    with pytest.raises(InvalidValueError) as refused:
        read_number("1,234e2")
    assert str(refused.value) == "'1,234e2' can be read two ways: write 1234e2 or 1.234e2"


@pytest.mark.parametrize(
    "text",
    [
        "",
        "mm",
        "-",
        ".",
        ",",
        "1..5",
        "1,,5",
        "--5",
        "1.2.3",
        "12,34,567",
        "1,2.3,4",
        "1_0",
        "1'2",
        "12'34",
        "_5",
        "e5",
        "nan",
        "inf",
        "1,23.4",
        "٣",
    ],
)
def test_what_is_no_number_is_refused(text: str) -> None:
    with pytest.raises(InvalidValueError, match="is not a number"):
        read_number(text)


def test_a_number_that_no_double_holds_is_refused() -> None:
    with pytest.raises(InvalidValueError, match="too large"):
        read_number("1e400")


def test_blanks_between_digits_are_no_number() -> None:
    assert read_number("1 2") == (1.0, "2"), "what follows is told as an unknown unit, not read as 12"


def read_or_refused(text: str) -> tuple[float, str] | str:
    """Return the number and what follows it, or the sentence by which the text is refused."""
    try:
        return read_number(text)
    except InvalidValueError as refused:
        return str(refused)


finite = st.floats(allow_nan=False, allow_infinity=False)


@given(finite)
def test_a_number_is_written_so_that_it_reads_back_exactly(number: float) -> None:
    assert (number, "") == read_number(write_number(number))


@given(st.integers(min_value=1 - 2**53, max_value=2**53 - 1))
def test_a_whole_number_is_written_without_a_point(number: int) -> None:
    assert str(number) == write_number(number)
    assert (float(number), "") == read_number(write_number(number))


@given(finite)
def test_a_comma_in_place_of_the_point_is_the_same_number_or_refused(number: float) -> None:
    text = write_number(number).replace(".", ",")
    found = read_or_refused(text)
    assert found == (number, "") or "can be read two ways" in found


@given(st.text(max_size=12))
def test_reading_any_text_gives_a_finite_number_or_one_sentence(text: str) -> None:
    found = read_or_refused(text)
    if isinstance(found, str):
        assert len(found.replace(text.strip(), "").splitlines()) == 1
    else:
        assert math.isfinite(found[0])


@given(st.text(alphabet="0123456789.,' _eE+-m", max_size=14))
def test_reading_digits_in_disorder_never_breaks(text: str) -> None:
    found = read_or_refused(text)
    assert isinstance(found, str) or math.isfinite(found[0])


# -- units --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("unit", [unit for unit in UNITS if unit])
def test_every_unit_is_understood_as_written_as_shown_and_in_capitals(unit: str) -> None:
    assert unit == unit_named(unit) == unit_named(shown(unit)) == unit_named(f" {unit} ")
    assert dimension(unit) == dimension(unit_named(unit.upper()))


@pytest.mark.parametrize("word", ["kg", "mm/h", "", "m m m", "1"])
def test_a_word_that_is_no_unit_is_refused(word: str) -> None:
    if word == "":
        assert unit_named(word) == ""
    else:
        with pytest.raises(UnitError, match="is not a unit"):
            unit_named(word)


def test_every_spelling_leads_to_a_unit() -> None:
    assert set() == {unit for unit in ALIASES.values() if unit not in UNITS}


@pytest.mark.parametrize(
    ("value", "unit", "to", "expected"),
    [
        (1.0, "in", "mm", 25.4),
        (0.3, "in", "mm", 7.62),
        (0.1, "in", "mm", 2.54),
        (1.0, "in/s", "mm/min", 1524.0),
        (169.33333, "mm/s", "mm/min", 10159.9998),
        (599999.994, "mm/min/s", "mm/s2", 9999.9999),
        (1.0, "s", "ms", 1000.0),
        (62.5, "us", "ms", 0.0625),
        (1.0, "um", "in", 1 / 25400),
        (360.0, "deg/s", "deg/min", 21600.0),
    ],
)
def test_a_conversion_is_exact(value: float, unit: str, to: str, expected: float) -> None:
    assert expected == convert(value, unit, to)


def test_the_canonical_figure_is_rounded_once() -> None:
    """0.3 * 25.4 is 7.619999999999999 in doubles; the length is 7.62 mm all the same."""
    assert canonical(0.3, "in") == 7.62
    assert same_value(Value(0.3, "in"), Value(7.62, "mm"))


decimals = st.decimals(
    min_value=-(10**6), max_value=10**6, places=5, allow_nan=False, allow_infinity=False
).map(float)
same_dimension = st.sampled_from([(a, b) for a in UNITS for b in UNITS if dimension(a) == dimension(b)])


@given(decimals)
def test_inches_survive_the_way_to_millimetres_and_back(value: float) -> None:
    assert value == convert(convert(value, "in", "mm"), "mm", "in")


@given(decimals)
def test_millimetres_come_back_from_inches_to_the_last_digit_of_a_double(value: float) -> None:
    back = convert(convert(value, "mm", "in"), "in", "mm")
    assert abs(back - value) <= 2 * math.ulp(value), "25.4 divides no decimal without rest"
    assert value == round(back, 5), "and exactly in every printed decimal"


@given(st.floats(min_value=-1e30, max_value=1e30), same_dimension)
def test_every_conversion_is_the_nearest_double_of_the_true_figure(
    value: float, units: tuple[str, str]
) -> None:
    unit, to = units
    true = Fraction(Decimal(repr(value))) * UNITS[unit][1] / UNITS[to][1]
    expected = value if unit == to else float(true)
    assert expected == convert(value, unit, to)
    assert float(Fraction(Decimal(repr(value))) * UNITS[unit][1]) == canonical(value, unit)


def test_a_figure_too_large_for_the_other_unit_is_infinite_and_breaks_nothing() -> None:
    assert (math.inf, -math.inf) == (canonical(1e308, "in"), convert(-1e308, "in", "mm"))
    assert write_number(math.inf) == "inf"


def test_a_length_is_not_given_in_seconds() -> None:
    with pytest.raises(UnitError, match="mm cannot be given in s"):
        convert(1.0, "mm", "s")
    with pytest.raises(UnitError, match="a bare number cannot be given in mm"):
        convert(1.0, "", "mm")
    assert not same_value(Value(5.0, "mm"), Value(5.0, "deg"))


@pytest.mark.parametrize("unit", list(UNITS))
def test_the_canonical_unit_measures_the_same_by_factor_one(unit: str) -> None:
    assert dimension(unit) == dimension(canonical_unit(unit))
    assert canonical(3.5, canonical_unit(unit)) == 3.5


@pytest.mark.parametrize(
    ("unit", "expected"),
    [("mm", "deg"), ("in", "deg"), ("mm/min", "deg/min"), ("in/s2", "deg/s2"), ("in/min/s", "deg/min/s"),
     ("mm/s3", "deg/s3"), ("ms", "ms"), ("", ""), ("deg", "deg"), ("rpm", "rpm")],
)  # fmt: skip
def test_lengths_become_angles_where_an_axis_turns(unit: str, expected: str) -> None:
    assert expected == angular(unit)


# -- values of parameters -------------------------------------------------------------------------------


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
                meant = labels.get(choice.code.casefold(), choice)
                expected = Value(meant.key == "yes" if parameter.type == "boolean" else meant.key)
                assert expected == read_value(parameter, choice.code, ""), parameter.id


def test_a_letter_of_axis_name_that_is_a_name_is_that_name(ninepc) -> None:
    """Axis Name (page 4-2): letter d stands before U; u is U, and c is C although letter c stands before it."""
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
    ("text", "expected"),
    [("5", Value(5.0, "mm")), ("5 in", Value(5.0, "in")), ("5in", Value(5.0, "in")), ('5"', Value(5.0, "in")),
     ("5 Inches", Value(5.0, "in")), ("5000 µm", Value(5000.0, "um"))],
)  # fmt: skip
def test_a_value_keeps_the_unit_it_was_entered_in(ninepc, text: str, expected: Value) -> None:
    assert expected == read_value(ninepc.parameter("home.calibration"), text, "mm")


def test_a_whole_number_takes_no_fraction(ninepc) -> None:
    parameter = ninepc.parameter("servo.velocity_gear_teeth")
    assert Value(3) == read_value(parameter, "3.0", "") == read_value(parameter, "0x3", "")
    with pytest.raises(InvalidValueError, match=r"takes whole numbers, not 3\.5"):
        read_value(parameter, "3.5", "")
    with pytest.raises(InvalidValueError, match="too large for Teeth"):
        read_value(parameter, "9007199254740993.0e1", "")


@pytest.mark.parametrize(
    ("own", "said"),
    [
        ("mm: {measures: step}", "'mm' measures length already, with the factor 1"),
        ("blu: {measures: step}", "'blu' is how people write BLU"),
        ("steps/dm: {measures: step density, factor: 1/100}", "no unit of step density has the factor 1"),
        ("steps/dm: {measures: length, factor: -1/2}", "must be above 0"),
        ("steps/dm: {measures: length, factor: 1/0}", "'1/0' is no factor"),
        ("steps/dm: {measures: length, factor: ten}", "Invalid literal for Fraction: 'ten'"),
        ('"1 mm": {measures: length}', "'1 mm' is no name of a unit"),
        ("cubit: {measures: cubits, also: [ell, inches]}", "'inches' is how people write in already"),
        ("cubit: {measures: cubits, shown: mm}", "'mm' is how people write mm already"),
    ],
)
def test_a_unit_of_a_family_contradicts_no_other(facts, head: str, own: str, said: str) -> None:
    with pytest.raises(DatabaseError) as caught:
        facts.schema("", f"own_units:\n  {own}\n{head}")
    assert said in str(caught.value)
    assert not {"ell", "cubit"} & {*UNITS, *ALIASES}, "nothing of it is known"


def test_a_unit_of_a_family_is_written_and_shown_in_its_own_ways(facts, head: str) -> None:
    own = "own_units:\n  league: {measures: length, factor: '201168', shown: lea., also: [leagues]}\n"
    facts.write("family.yaml", f"{own}{head}")
    facts.write("groups/all.yaml", 'key: all\nname: All\nchapter: "1"\nparameters: []\n')
    compile_family(facts.folder)
    assert {unit_named(text) for text in ("league", "leagues", "lea.", "Leagues")} == {"league"}
    assert (convert(2.0, "league", "mm"), shown("league")) == (402336.0, "lea.")
