"""Units as people write them, exact conversions, and the units that a family brings."""

import math
from decimal import Decimal
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from amp_studio.schema import (
    DatabaseError,
    UnitError,
    Value,
    angular,
    canonical,
    canonical_unit,
    convert,
    dimension,
    load_schema,
    same_value,
    unit_named,
    unit_text,
    write_number,
)
from amp_studio.schema.load import compile_family, load_compiled
from amp_studio.schema.units import ALIASES, UNITS


@pytest.mark.parametrize("unit", [unit for unit in UNITS if unit])
def test_every_unit_is_understood_as_written_as_shown_and_in_capitals(unit: str) -> None:
    assert unit == unit_named(unit) == unit_named(unit_text(unit)) == unit_named(f" {unit} ")
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
    """0.3 * 25.4 is 7.619999999999999 in doubles; the length is 7.62 mm anyway."""
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
    [
        ("mm", "deg"),
        ("in", "deg"),
        ("mm/min", "deg/min"),
        ("in/s2", "deg/s2"),
        ("in/min/s", "deg/min/s"),
        ("mm/s3", "deg/s3"),
        ("ms", "ms"),
        ("", ""),
        ("deg", "deg"),
        ("rpm", "rpm"),
    ],
)
def test_lengths_become_angles_where_an_axis_turns(unit: str, expected: str) -> None:
    assert expected == angular(unit)


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
    assert (convert(2.0, "league", "mm"), unit_text("league")) == (402336.0, "lea.")


def test_the_units_of_a_family_are_known_when_its_facts_come_out_of_the_cache(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    load_schema("grblhal")  # the cache is there
    monkeypatch.delitem(UNITS, "steps/mm")
    load_compiled.__wrapped__("grblhal")
    assert "steps/mm" in UNITS
