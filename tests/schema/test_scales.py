"""Units whose size another parameter sets: what a count is in mm or degrees, and a length as a count."""

from pathlib import Path

import pytest

from amp_studio.files import ParameterFile, open_file
from amp_studio.schema import InvalidValueError, Value, real_value
from amp_studio.schema.load import DatabaseError

SCALED = """
  - id: control.size
    name: Size
    type: real
    unit: mm
    help: {what: How long one count is.}
    page: "1"
  - id: axis.limit
    name: Limit
    scope: axis
    type: integer
    unit: iu
    help: {what: Where it ends.}
    page: "2"
"""


@pytest.fixture
def num(checkout: Path) -> ParameterFile:
    return open_file(checkout / "examples" / "num-1060-mill" / "MILL_1060.amp").file


def real(file: ParameterFile, number: str) -> Value | None:
    address = file.find(number)
    return real_value(file.evaluation, address, file.get(address))


def test_an_internal_unit_is_as_long_as_p4_shows_on_straight_axes_and_on_those_that_turn(num) -> None:
    assert real(num, "P17N1") == Value(600.0, "mm")
    assert real(num, "P23N3") == Value(6.6, "deg"), "66000 of 0.0001 degrees"
    num.set(num.find("P4N2"), Value(4))
    assert real(num, "P17N1") == Value(60.0, "mm")
    num.set(num.find("P4N2"), Value(9))
    assert real(num, "P17N1") == Value(600.0, "mm"), "any other number is taken for 3"


def test_of_an_unknown_size_nothing_is_shown(num) -> None:
    num.set(num.find("P4N2"), None)
    assert real(num, "P17N1") is None
    num.set(num.find("P4N4"), Value(7))
    assert real(num, "P23N3") is None, "the manual prints no divider 7"
    assert real(num, "P24N32") is None, "of no axis: it may be a length or an angle"


def test_a_length_is_counted_exactly(num) -> None:
    limit = num.find("P17N1")
    assert num.read(limit, "600.001 mm") == Value(600001, "iu")
    assert num.read(limit, "25,4 mm") == Value(25400, "iu")
    assert num.read(limit, "-1 in") == Value(-25400, "iu")
    assert num.read(limit, "600") == Value(600, "iu"), "a bare figure is a count"
    turning = num.find("P23N3")
    assert num.read(turning, "6.6 deg") == Value(66000, "iu")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("0.0005 mm", "0.0005 mm is no whole number of iu, each 0.001 mm"),
        ("1e300 mm", "1e300 mm is too many iu, each 0.001 mm"),
        ("1 deg", "is given in iu, not in °"),
        ("1 mm/min", "is given in iu, not in mm/min"),
        ("1,234 mm", "can be read two ways"),
    ],
)
def test_what_is_no_count_is_refused(num, text, message) -> None:
    with pytest.raises(InvalidValueError, match=message):
        num.read(num.find("P17N1"), text)


def test_a_parameter_may_hold_the_size_itself(facts, head, machine) -> None:
    scales = "scales: {iu: {length: {param: control.size}}}\n"
    here = machine(facts.schema(SCALED, head + scales), {"axis.limit@1": Value(3, "iu")})
    limit = ("axis.limit", "1")
    assert real_value(here.evaluation, limit, here.values[limit]) is None
    for size, length in ((Value(0.1, "mm"), Value(0.3, "mm")), (Value(0.1, "in"), Value(0.3, "in"))):
        here.set("control.size", size)
        assert real_value(here.evaluation, limit, here.values[limit]) == length
    for nothing in (Value(0.0, "mm"), Value(-1.0, "mm"), Value(float("inf"), "mm"), Value("mm")):
        here.set("control.size", nothing)
        assert real_value(here.evaluation, limit, here.values[limit]) is None


@pytest.mark.parametrize(
    ("scales", "message"),
    [
        ("{iu: {length: {param: control.length}}}", "there is no parameter 'control.length'"),
        ("{iu: {length: {param: control.size, sizes: {a: 1 parsec}}}}", "'1 parsec' is no size"),
        ("{iu: {length: {param: control.size, sizes: {a: 0 mm}}}}", "'0 mm' is no size"),
        (
            "{iu: {length: {param: control.size, otherwise: 1 mm}}}",
            "'otherwise' is for values without an entry",
        ),
        ("{parsec: {length: {param: control.size}}}", "parsec"),
    ],
)
def test_a_scale_that_cannot_be_understood_is_refused_with_its_line(facts, head, scales, message) -> None:
    with pytest.raises(DatabaseError, match=message):
        facts.schema(SCALED, f"{head}scales: {scales}\n")
