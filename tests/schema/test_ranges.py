"""Ranges: the edges as printed, in the unit as printed."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from amp_studio.schema import Value, clip, fault, limits
from amp_studio.schema.constraint import Limits

LINEAR = {"axis.type@1": Value("linear"), "axis.type@2": Value("rotary"), "axis.type@3": Value("spindle")}


@pytest.fixture
def here(ninepc, machine):
    """Return a 9/PC with a linear axis 1, a rotary axis 2 and a spindle 3."""
    return machine(ninepc, LINEAR)


def allowed(here, name: str, value: Value) -> bool:
    """Return whether a value is allowed."""
    return fault(here.evaluation, tuple(name.split("@")), value) is None


@pytest.mark.parametrize(
    ("inside", "outside"),
    [
        (Value(999999.99, "mm"), Value(1000000.0, "mm")),
        (Value(-999999.99, "mm"), Value(-999999.9900000001, "mm")),
        (Value(39370.07835, "in"), Value(39370.07836, "in")),
        (Value(-39370.07835, "in"), Value(-39370.078351, "in")),
    ],
)
def test_the_printed_edge_is_inside_and_the_next_figure_outside(here, inside: Value, outside: Value) -> None:
    """Home Calibration: -999999.99 to 999999.99 mm, -39370.07835 to 39370.07835 in (page 5-10)."""
    assert (allowed(here, "home.calibration@1", inside), allowed(here, "home.calibration@1", outside)) == (
        True,
        False,
    )


def test_inch_and_metric_edges_differ_in_the_last_digit_and_each_holds_in_its_own_unit(here) -> None:
    """Rapid feedrates: 10160.00004 mm/min is not 400 in/min, which are 10160 mm/min (page 10-7)."""
    assert allowed(here, "accdec.velocity_step@1", Value(10160.00004, "mm/min"))
    assert not allowed(here, "accdec.velocity_step@1", Value(10160.00005, "mm/min"))
    assert allowed(here, "accdec.velocity_step@1", Value(400.0, "in/min"))
    assert not allowed(here, "accdec.velocity_step@1", Value(400.000001, "in/min")), (
        "10160.00003 mm/min would be inside"
    )


def test_a_unit_without_a_printed_range_takes_the_one_of_its_own_system(here) -> None:
    found = limits(here.evaluation, ("accdec.velocity_step", "1"), "in/s")
    assert (found.low, found.high) == (0.0, 400 / 60)
    found = limits(here.evaluation, ("accdec.velocity_step", "1"), "mm/s")
    assert (found.low, pytest.approx(found.high, abs=1e-12)) == (0.0, 10160.00004 / 60)


def test_degrees_are_borrowed_from_the_metric_figures_where_none_are_printed(here) -> None:
    found = limits(here.evaluation, ("home.calibration", "2"), "deg")
    assert (found.low, found.high, found.borrowed) == (-999999.99, 999999.99, True)
    assert not allowed(here, "home.calibration@2", Value(1e6, "deg"))
    printed = limits(here.evaluation, ("accdec.linear_acceleration", "2"), "deg/s2")
    assert (printed.high, printed.borrowed) == (20000.0, False)


def test_borrowed_speeds_keep_their_time(here) -> None:
    found = limits(here.evaluation, ("accdec.velocity_step", "2"), "deg/s")
    assert (True, pytest.approx(10160.00004 / 60, abs=1e-12)) == (found.borrowed, found.high)


@pytest.mark.parametrize(
    ("axis", "unit", "high"), [("1", "mm", 214.1), ("2", "deg", 214.0), ("3", "deg", 1440.0)]
)
def test_excess_error_has_three_limits_by_axis_type(here, axis: str, unit: str, high: float) -> None:
    """Page 7-20: 214.1 mm linear, 214 degrees rotary, 1440 degrees on a spindle."""
    assert high == limits(here.evaluation, ("servo.excess_error", axis), unit).high
    assert allowed(here, f"servo.excess_error@{axis}", Value(high, unit))
    assert not allowed(here, f"servo.excess_error@{axis}", Value(high + 0.00001, unit))


def test_an_edge_that_another_parameter_sets_moves_with_it(here) -> None:
    """Positive Software Overtravel runs from Negative Software Overtravel to 2540000 mm (page 6-10)."""
    here.set("zone.overtravel_negative@1", Value(1.0, "in"))
    said = fault(here.evaluation, ("zone.overtravel_positive", "1"), Value(25.3, "mm"))
    named = "1330 Negative Software Overtravel"
    assert (
        f"Positive Software Overtravel 25.3 mm is outside 25.4 to 2540000 mm (set by {named}, 1 in)" == said
    )
    assert allowed(here, "zone.overtravel_positive@1", Value(25.4, "mm"))
    here.set("zone.overtravel_negative@1", Value(-5.0, "mm"))
    assert allowed(here, "zone.overtravel_positive@1", Value(0.0, "mm"))


def test_an_unset_edge_bounds_nothing_and_is_not_blamed(here) -> None:
    said = fault(here.evaluation, ("zone.overtravel_positive", "1"), Value(3e6, "mm"))
    assert said == "Positive Software Overtravel 3000000 mm is outside at most 2540000 mm"


@given(st.floats(min_value=-1e5, max_value=1e5))
def test_a_value_equal_to_its_bound_is_inside_in_either_unit(ninepc, machine, bound: float) -> None:
    here = machine(ninepc, LINEAR | {"zone.overtravel_negative@1": Value(bound, "in")})
    address = ("zone.overtravel_positive", "1")
    assert fault(here.evaluation, address, Value(bound, "in")) is None
    found = limits(here.evaluation, address, "mm")
    assert fault(here.evaluation, address, Value(found.low, "mm")) is None


@given(st.sampled_from(["mm", "in"]), st.floats(min_value=-1e9, max_value=1e9))
def test_what_is_mended_is_inside_and_what_is_inside_is_not_touched(
    ninepc, machine, unit: str, number: float
) -> None:
    here, address = machine(ninepc, LINEAR), ("home.calibration", "1")
    value = Value(number, unit)
    mended = clip(here.evaluation, address, value)
    assert fault(here.evaluation, address, mended) is None
    assert (mended == value) == (fault(here.evaluation, address, value) is None)
    assert unit == mended.unit


def test_choices_and_texts_have_no_range_to_be_mended_into(here) -> None:
    for name, value in (("axis.type", Value("linear")), ("zone.overtravel_used", Value(True))):
        assert value == clip(here.evaluation, (name, "1"), value)
        assert fault(here.evaluation, (name, "1"), value) is None
    assert fault(here.evaluation, ("axis.type", "1"), Value("raw:9")) == "9 is no code of Axis Type"


@pytest.mark.parametrize(
    ("text", "name", "unit"),
    [
        ("-999999.99 to 999999.99 mm", "home.calibration", "mm"),
        ("1 to 32767", "servo.velocity_gear_teeth", ""),
        ("0 to 9999 °", "axis.rollover", "deg"),
    ],
)
def test_a_range_is_told_as_printed(here, text: str, name: str, unit: str) -> None:
    assert text == limits(here.evaluation, (name, "1"), unit).text()


@pytest.mark.parametrize(
    ("value", "inside"),
    [
        (Value(6000.0000000054, "mm/min"), True),
        (Value(6000.0000000066, "mm/min"), False),
        (Value(6000.00001, "mm/min"), False),
        (Value(6000.001, "mm/min"), False),
        (Value(6000.0 / 25.4, "in/min"), True),
        (Value(236.220473, "in/min"), False),
    ],
)
def test_a_bound_of_another_parameter_forgives_a_change_of_unit_and_no_more(
    ninepc, machine, value: Value, inside: bool
) -> None:
    """Maximum Cutting Feedrate is at most rapid (page 9-2): to the last digits of a double, 1e-12 of it."""
    here = machine(ninepc, LINEAR | {"feedrate.rapid@1": Value(100.0, "mm/s")})
    assert allowed(here, "feedrate.max_cutting@1", value) is inside


@pytest.mark.parametrize(
    ("value", "inside"),
    [
        (Value(5999.9999999946, "mm/min"), True),
        (Value(5999.9999999934, "mm/min"), False),
        (Value(5999.999, "mm/min"), False),
    ],
)
def test_a_lower_bound_of_another_parameter_forgives_no_more_either(
    ninepc, machine, value: Value, inside: bool
) -> None:
    """Jog speeds increase or stay the same (page 8-1)."""
    here = machine(ninepc, LINEAR | {"jog.speed_lowest@1": Value(100.0, "mm/s")})
    assert allowed(here, "jog.speed_second@1", value) is inside


def test_a_converted_bound_is_read_by_a_person_and_may_be_typed(here) -> None:
    """It was 169.33333333333334 mm/s, and rounded up it would have been refused."""
    speed = ("home.speed_off_switch", "1")
    found = limits(here.evaluation, speed, "mm/s")
    assert found is not None
    assert found.text() == "0.0001 to 169.3333333 mm/s"
    assert fault(here.evaluation, speed, Value(169.3333333, "mm/s")) is None
    assert Limits(-0.1 / 3, 0.1 / 3, "mm").text() == "-0.03333333333 to 0.03333333333 mm"
    assert Limits(0.0, 2097152.0, "").text() == "0 to 2097152"
