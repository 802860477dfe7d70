"""The calibration table of an axis as one text: form, limits of the screen, and what the points come to."""

from fractions import Fraction

import pytest

from amp_studio.families.ninepc.formulas.calibration import (
    CalibrationTextError,
    calibration_fault,
    calibration_net,
    calibration_points,
    read_calibration,
)
from amp_studio.schema import load_schema


def test_measured_points_are_the_same_table_as_their_deviations() -> None:
    by_measurement = read_calibration("measurement - mm -50:-50 0:0.0025 50:49.999")
    by_deviation = read_calibration("deviation - mm -50:0 0:0.0025 50:-0.001")
    assert by_measurement.points == by_deviation.points
    assert by_deviation.points[1] == (Fraction(0), Fraction("0.0025"))


@pytest.mark.parametrize(
    "text", ["measurement + mm -50:-49.999 0:0", "deviation - deg 0:0 180:0.00001 360:0"]
)
def test_a_table_is_written_as_it_was_read(text: str) -> None:
    assert read_calibration(text).written() == text


@pytest.mark.parametrize(
    ("text", "states"),
    [
        ("", "begins with"),
        ("deviation - mm", "begins with"),
        ("deviation * mm 0:0", "begins with"),
        ("deviation - cm 0:0", "begins with"),
        ("deviation - mm 0:0 1e2:0", "'1e2:0' is no point"),
        ("deviation - mm 0:0 100,5:0", "is no point"),
        ("deviation - mm 0:0 100:0.000001", "is no point"),
        ("deviation - mm 0:0 1000000000:0", "is no point"),
        ("deviation - mm 0:0 0:0", "positions rise"),
        ("deviation - mm 0:0.1 100:0", "has the deviation 0"),
        ("deviation + mm 0:0 100:0.1", "100, has the deviation 0"),
        ("deviation - mm 0:0 100:-2.00001", "PARAMETER OUT OF RANGE"),
        ("deviation - in 0:0 84.00001:0", "more than 84 in"),
    ],
)
def test_what_the_control_would_not_take_is_named(text: str, states: str) -> None:
    with pytest.raises(CalibrationTextError, match=states):
        read_calibration(text)
    assert states in calibration_fault(text, turns=False)


def test_two_percent_count_from_the_point_that_was_entered_before() -> None:
    assert calibration_fault("deviation - mm 0:0 10:0.2 110:2", turns=False) == ""
    assert "of the 10 mm" in calibration_fault("deviation + mm 0:0.21 10:0.3 110:0", turns=False)


def test_degrees_are_for_an_axis_that_turns_and_only_there() -> None:
    assert calibration_fault("deviation - deg 0:0 90:0.01", turns=True) == ""
    assert "turns" in calibration_fault("deviation - mm 0:0 90:0.01", turns=True)


def test_points_of_axes_without_a_table_count_nothing() -> None:
    assert calibration_points(["deviation - mm 0:0 1:0", None, "", "deviation - mm 0:0"]) == 3


def test_the_net_correction_of_a_turn_is_what_its_end_has_more_than_its_beginning() -> None:
    assert calibration_net("deviation - deg 0:0 120:0.004 360:0") == 0
    assert calibration_net("deviation - deg 0:0 120:0.004 360:-0.002") == pytest.approx(-0.002)


def test_the_table_that_came_later_is_not_in_the_signature_of_files_and_controls() -> None:
    schema = load_schema("9pc")
    assert not schema.parameters["calibration.table"].in_signature
    assert [p.id for p in schema.parameters.values() if not p.in_signature] == ["calibration.table"]
