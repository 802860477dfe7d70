"""The part of a range that the rules allow for one value, all others as they are."""

import pytest

from amp_studio.files import ParameterFile, open_file
from amp_studio.schema import Value
from amp_studio.validate import Validator

EXCESS, BREAK, JERK = ("servo.excess_error", "1"), ("servo.gain_break_point", "1"), ("accdec.jerk", "1")


@pytest.fixture
def mill(checkout) -> ParameterFile:
    """Return the example mill: rapid 10000 mm/min, Excess Error 11 mm."""
    return open_file(checkout / "examples" / "mill-1394" / "MILL_1394.amp").file


def allowed(file: ParameterFile, address, unit: str, low: float, high: float, *near: float):
    validator = Validator(file)
    validator.run()
    return validator.allowed(address, unit).around(low, high, near)


def test_an_excess_error_is_allowed_from_a_tenth_more_than_the_axis_trails(mill: ParameterFile) -> None:
    """At 10000 mm/min the axis trails by 10 mm (page 7-20)."""
    assert allowed(mill, EXCESS, "mm", 0.0, 214.1, 11.0) == (11.0, 214.1)


def test_it_is_found_from_a_value_that_is_not_allowed(mill: ParameterFile) -> None:
    mill.set(EXCESS, Value(5.0, "mm"))
    assert allowed(mill, EXCESS, "mm", 0.0, 214.1, 5.0) == (11.0, 214.1)


def test_a_limit_that_is_not_reached_itself_is_left_out(mill: ParameterFile) -> None:
    """Gain Break Point is below the Feedrate Suppression Point, 11 mm (page 7-22)."""
    found = allowed(mill, BREAK, "mm", 0.0, 214.1, 5.0)
    assert found is not None
    assert 10.99 < found[1] < 11.0


def test_a_window_has_both_ends(mill: ParameterFile) -> None:
    low, high = allowed(mill, JERK, "mm/s3", 0.0, 1e6, 7233.0) or (0.0, 0.0)
    assert low == 965.0
    assert 28950 < high < 28962.3


def test_a_rule_that_this_value_alone_cannot_meet_does_not_count(mill: ParameterFile) -> None:
    """With such a ramp the jerk is wrong whatever it is; the bar is not left empty for that."""
    mill.set(("accdec.scurve_acceleration", "1"), Value(1e9, "mm/s2"))
    assert allowed(mill, JERK, "mm/s3", 0.0, 1e4, 7233.0) is not None


def test_the_file_is_left_as_it_was(mill: ParameterFile) -> None:
    before = dict(mill.values)
    allowed(mill, EXCESS, "mm", 0.0, 214.1, 11.0)
    assert mill.values == before


def test_a_parameter_without_rules_has_its_whole_range(mill: ParameterFile) -> None:
    validator = Validator(mill)
    validator.run()
    free = next(a for a in mill.addresses() if not validator._plan.rule_readers.get(a))
    assert validator.allowed(free, "").around(0.0, 5.0, []) == (0.0, 5.0)
