"""Findings of one value by itself: its range, its choices, its unit."""

import pytest
from findings import found, the

from amp_studio.schema import Address, InvalidValueError, Value
from amp_studio.validate import AddressedValue, Finding, Validator

RAPID = ("feedrate.rapid", "1")
CUTTING = ("feedrate.max_cutting", "1")
EXCESS = ("servo.excess_error", "1")


def test_a_value_out_of_range_is_an_error_with_its_range_page_and_fix(mill) -> None:
    mill.set(("home.g28_speed", "1"), Value(10161.0, "mm/min"))
    assert the(mill, "schema.range") == Finding(
        rule="schema.range",
        severity="error",
        causes=(("home.g28_speed", "1"),),
        message="G28 Home Speed 10161 mm/min is outside 0 to 10160 mm/min.",
        fix=(AddressedValue(("home.g28_speed", "1"), Value(10160.0, "mm/min")),),
        page="5-16",
    )


def test_a_negative_speed_is_not_mended_by_an_axis_that_is_still(mill) -> None:
    mill.set(("home.g28_speed", "1"), Value(-5000.0, "mm/min"))
    assert the(mill, "schema.range").fix == ()


def test_a_range_is_checked_in_the_unit_of_entry(mill) -> None:
    mill.set(("home.g28_speed", "1"), Value(400.0, "in/min"))
    assert found(mill, "schema.range") == []
    mill.set(("home.g28_speed", "1"), Value(400.0001, "in/min"))
    finding = the(mill, "schema.range")
    assert finding.message == "G28 Home Speed 400.0001 in/min is outside 0 to 400 in/min."
    assert finding.fix == (AddressedValue(("home.g28_speed", "1"), Value(400.0, "in/min")),)


def test_a_bound_that_another_parameter_sets_is_named(mill) -> None:
    mill.set(CUTTING, Value(12000.00001, "mm/min"))
    finding = the(mill, "schema.range")
    assert (
        finding.message == "Maximum Cutting Feedrate 12000.00001 mm/min is outside 0 to 12000 mm/min "
        "(set by 1203 Rapid Feedrate for Positioning, 12000 mm/min)."
    )
    assert finding.fix == (AddressedValue(CUTTING, Value(12000.0, "mm/min")),)


def test_a_bound_that_moves_is_noticed(mill) -> None:
    validator = Validator(mill)
    validator.run()
    mill.set(RAPID, Value(5000.0, "mm/min"))
    assert [f.addresses for f in validator.update([RAPID]) if f.rule == "schema.range"] == [(CUTTING, RAPID)]


def test_a_code_without_a_choice_is_an_error_that_no_default_mends(mill) -> None:
    """Nobody but the control knows what the code does: a default in its place may turn an axis the other
    way.
    """
    mill.set(("servo.sercos_baud", ""), Value("raw:999"))
    assert the(mill, "schema.choice") == Finding(
        rule="schema.choice",
        severity="error",
        causes=(("servo.sercos_baud", ""),),
        message="999 is no code of Baud Rate for SERCOS.",
        page="7-3",
    )


@pytest.mark.parametrize(
    ("speed", "mended"),
    [
        (243840.1, 243840.0),
        (268224.0, 243840.0),
        (268224.1, None),
        (2438400.0, None),
        (1e300, None),
        (-1.0, None),
    ],
)
def test_a_number_that_just_misses_its_range_goes_to_the_bound_and_one_far_beyond_to_none(
    mill, speed: float, mended: float | None
) -> None:
    """A digit too many means nobody knows what; the bound is the fastest that there is."""
    mill.set(RAPID, Value(speed, "mm/min"))
    finding = next(f for f in Validator(mill).run() if f.rule == "schema.range" and f.causes == (RAPID,))
    assert [setting.value.value for setting in finding.fix] == [mended] * (mended is not None)


@pytest.mark.parametrize(
    ("address", "value", "sentence", "mended"),
    [
        (EXCESS, Value(20.0, "deg"), "Excess Error 20° should be in mm here.", Value(20.0, "mm")),
        (
            ("servo.excess_error", "4"),
            Value(20.0, "mm"),
            "Excess Error 20 mm should be in ° here.",
            Value(20.0, "deg"),
        ),
    ],
)
def test_a_value_in_a_unit_that_measures_something_else_is_an_error(
    mill, address: Address, value: Value, sentence: str, mended: Value
) -> None:
    mill.set(address, value)
    finding = the(mill, "schema.range")
    assert finding.message == sentence
    assert finding.fix == (AddressedValue(address, mended),), "the control knows the figure only"


@pytest.mark.parametrize(
    ("address", "value", "sentence"),
    [
        (EXCESS, Value(20.0), "Excess Error is given in mm, not in a bare number"),
        (EXCESS, Value(20.0, "rpm"), "Excess Error is given in mm, not in rpm"),
        (
            ("servo.initial_gain", "1"),
            Value(1.0, "mm"),
            "Initial Gain of Position Loop is given in a bare number, not in mm",
        ),
    ],
)
def test_a_value_that_no_file_can_contain_is_refused_at_once(
    mill, address: Address, value: Value, sentence: str
) -> None:
    before = mill.get(address)
    with pytest.raises(InvalidValueError, match=f"^{sentence}$"):
        mill.set(address, value)
    assert mill.get(address) == before


def test_an_axis_that_turns_needs_degrees(mill) -> None:
    validator = Validator(mill)
    validator.run()
    mill.set(("axis.type", "1"), Value("rotary"))
    wrong = {f.addresses[0] for f in validator.update([("axis.type", "1")]) if f.rule == "schema.range"}
    assert EXCESS in wrong
    assert {address[1] for address in wrong} == {"1"}


def test_the_lead_of_a_spindle_is_a_length_and_one_in_degrees_is_offered_as_the_same_figure(mill) -> None:
    """Page 7-17 prints mm and in. alone; files have had degrees on a spindle."""
    mill.set(("axis.type", "1"), Value("spindle"))
    mill.set(("servo.lead_screw_pitch", "1"), Value(2.54, "deg"))
    finding = next(f for f in found(mill, "schema.range") if f.causes[0][0] == "servo.lead_screw_pitch")
    assert finding.message == "Lead Screw Thread Pitch 2.54° should be in mm here."
    assert finding.fix == (AddressedValue(("servo.lead_screw_pitch", "1"), Value(2.54, "mm")),)


def test_a_lead_becomes_an_angle_on_an_axis_made_rotary_and_a_length_again_on_a_spindle(mill) -> None:
    pitch, kind = ("servo.lead_screw_pitch", "5"), ("axis.type", "5")
    mill.set(pitch, Value(4.0, "mm"))
    units = []
    for key in ("rotary", "spindle", "linear"):
        mill.refit_turned([c for c in [mill.set(kind, Value(key))] if c])
        units.append(mill.values[pitch])
    assert units == [Value(4.0, "deg"), Value(4.0, "mm"), Value(4.0, "mm")]


def test_a_fix_that_would_be_wrong_too_is_not_offered(mill) -> None:
    positive, negative = ("zone.overtravel_positive", "1"), ("zone.overtravel_negative", "1")
    mill.set(negative, Value(2540001.0, "mm"))
    offered = {f.addresses[0]: [r.value for r in f.fix] for f in found(mill, "schema.range")}
    assert offered == {positive: [], negative: []}


def test_a_value_set_out_of_range_on_purpose_shows_it(mill) -> None:
    mill.set_checked({EXCESS: Value(500.0, "mm")}, force="by J. Fitter on 2026-07-01")
    assert (
        the(mill, "schema.range").message
        == "Excess Error 500 mm is outside 0 to 214.1 mm. It was forced by J. Fitter on 2026-07-01."
    )
