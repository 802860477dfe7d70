"""From measured points to the table and the reversal error of a 9/PC axis,
on machines whose errors are known.
"""

from fractions import Fraction
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from amp_studio.calibration import (
    CalibrationError,
    Measurement,
    MeasurementAnswers,
    Proposal,
    ProposalRequest,
    compensation_of,
    propose,
)
from amp_studio.calibration.edit import deleted, inserted, rechosen, replaced
from amp_studio.calibration.reading import read_measurement
from amp_studio.families.ninepc.formulas.calibration import (
    calibration_fault,
    calibration_net,
    read_calibration,
)
from amp_studio.files import ParameterFile, new_file
from amp_studio.schema import Value
from tests.campaigns import examples

TABLE, REVERSAL = ("calibration.table", "1"), ("servo.reversal_error", "1")
OFF = ProposalRequest(was_on=False)
MM = MeasurementAnswers("mm", "mm", "measured-target")


@cache
def _new_mill() -> ParameterFile:
    file = new_file("9pc", "mill", ["X", "Y", "A"])
    for axis in ("1", "2", "3"):
        file.set(("servo.hardware_type", axis), Value("sercos"))
        file.set(("servo.loop_type", axis), Value("digital"))
    return file


@pytest.fixture
def mill() -> ParameterFile:
    return _new_mill().copy()


def laser(error: np.ndarray, targets: np.ndarray, lost: float, runs: int = 2) -> Measurement:
    """Return what a laser measures: rising runs half of the lost motion behind, falling ones ahead."""
    lines = []
    for _ in range(runs):
        lines += [f"{t:.5f},{e - lost / 2:.7f}" for t, e in zip(targets, error, strict=True)]
        lines += [f"{t:.5f},{e + lost / 2:.7f}" for t, e in zip(targets[::-1], error[::-1], strict=True)]
    return read_measurement("\n".join(lines), MM)


def table_of(proposal: Proposal, address=TABLE) -> str:
    return str(proposal.settings[address].value)


def test_a_screw_that_is_too_long_and_a_lost_motion_are_found_as_they_are(mill) -> None:
    targets = np.arange(0, 501, 100.0)
    proposal = propose(mill, "1", laser(targets * 30e-6, targets, 0.008), OFF)
    assert table_of(proposal) == "deviation - mm 0:0 100:0.003 200:0.006 300:0.009 400:0.012 500:0.015"
    assert proposal.settings[REVERSAL] == Value(0.008, "mm")
    assert float(proposal.span_before) == pytest.approx(0.015 + 0.008)
    assert float(proposal.span_after) == pytest.approx(0, abs=1e-9)


@settings(max_examples=examples(40))
@given(st.integers(0, 2**32 - 1))
def test_what_remains_after_a_table_is_what_rounding_leaves(seed: int) -> None:
    file = _new_mill()
    chance = np.random.default_rng(seed)
    targets = np.arange(-300, 301, 25.0)
    error = np.cumsum(chance.normal(0, 0.002, targets.size))
    lost = round(float(chance.uniform(0, 0.03)), 5)
    proposal = propose(file, "1", laser(error, targets, lost), OFF)
    text = table_of(proposal)
    assert calibration_fault(text, turns=False) == ""
    # Independent of the program: interpolate the table with numpy and look at what is left of the true error.
    points = read_calibration(text).points
    at = [float(p) for p, _ in points]
    left = error - np.interp(targets, at, [float(v) for _, v in points])
    assert np.ptp(left) < 2.1e-5
    assert float(proposal.span_after) < 2.1e-5 + 2e-5
    assert abs(float(proposal.settings[REVERSAL].value) - lost) <= 1.01e-5
    assert float(proposal.settings[REVERSAL].value) <= lost + 1e-9  # never more than is lost (page 7-18)


def test_points_measured_with_compensation_on_are_added_to_what_it_takes_away_already(mill) -> None:
    targets = np.array([0.0, 100.0, 200.0])
    mill.set(TABLE, Value("deviation - mm 0:0 100:0.003 200:0.006"))
    mill.set(REVERSAL, Value(0.005, "mm"))
    left = np.array([0.0, 0.0005, 0.002])
    proposal = propose(mill, "1", laser(left, targets, 0.001), ProposalRequest(was_on=True))
    assert table_of(proposal) == "deviation - mm 0:0 100:0.0035 200:0.008"
    assert proposal.settings[REVERSAL] == Value(0.006, "mm")
    assert float(proposal.span_after) == pytest.approx(0, abs=1e-9)


def test_an_axis_that_is_compensated_is_asked_how_it_was_measured(mill) -> None:
    points = laser(np.array([0.0, 0.001]), np.array([0.0, 100.0]), 0)
    mill.set(REVERSAL, Value(0.005, "mm"))
    with pytest.raises(CalibrationError, match="compensation on or off"):
        propose(mill, "1", points, ProposalRequest())
    mill.set(REVERSAL, Value(0.0, "mm"))
    mill.set(TABLE, Value("deviation - mm 0:0 100:0.003"))
    with pytest.raises(CalibrationError, match="compensation on or off"):
        propose(mill, "1", points, ProposalRequest())
    assert table_of(propose(mill, "1", points, OFF)) == "deviation - mm 0:0 100:0.001"


def test_the_sign_of_the_reversal_error_stays_because_it_only_chooses_the_first_move(mill) -> None:
    mill.set(REVERSAL, Value(-0.002, "mm"))
    proposal = propose(mill, "1", laser(np.zeros(2), np.array([0.0, 100.0]), 0.004), OFF)
    assert proposal.settings[REVERSAL] == Value(-0.004, "mm")


def test_motion_that_is_gained_at_a_reversal_points_to_a_wrong_sign(mill) -> None:
    proposal = propose(mill, "1", laser(np.zeros(2), np.array([0.0, 100.0]), -0.004), OFF)
    assert REVERSAL not in proposal.settings
    assert any("check the sign" in note for note in proposal.notes)


def test_no_reversal_error_is_proposed_for_an_axis_on_a_linear_scale(mill) -> None:
    mill.set(("servo.position_feedback_type", "1"), Value("aqb-no-marker"))
    proposal = propose(mill, "1", laser(np.zeros(2), np.array([0.0, 100.0]), 0.004), OFF)
    assert REVERSAL not in proposal.settings
    assert any("linear scale" in note for note in proposal.notes)


def test_a_reversal_error_out_of_range_is_not_proposed(mill) -> None:
    proposal = propose(mill, "1", laser(np.zeros(2), np.array([0.0, 100.0]), 12.0), OFF)
    assert REVERSAL not in proposal.settings
    assert any("no reversal error is proposed" in note for note in proposal.notes)


def test_the_error_at_the_start_is_a_shift_and_no_deviation(mill) -> None:
    points = laser(np.array([0.01, 0.012]), np.array([0.0, 100.0]), 0)
    assert table_of(propose(mill, "1", points, OFF)) == "deviation - mm 0:0 100:0.002"
    positive = propose(mill, "1", points, ProposalRequest(was_on=False, start="+", input="measurement"))
    assert table_of(positive) == "measurement + mm 0:-0.002 100:100"


# -- limits of the control ------------------------------------------------------------------------


def test_points_that_other_axes_leave_no_room_for_are_thinned_where_the_curve_is_straight(mill) -> None:
    taken = " ".join(f"{n}:0" for n in range(996))
    mill.set(("calibration.table", "2"), Value(f"deviation - mm {taken}"))
    targets = np.arange(0, 1001, 100.0)
    error = np.where(targets < 500, 0.0, (targets - 500) * 20e-6)
    proposal = propose(mill, "1", laser(error, targets, 0), OFF)
    points = read_calibration(table_of(proposal)).points
    assert len(points) <= 5
    assert (Fraction(500), Fraction(0)) in points
    assert float(proposal.span_after) == pytest.approx(0, abs=1e-9)
    mill.set(
        ("calibration.table", "2"),
        Value(f"deviation - mm {taken} " + " ".join(f"{n}:0" for n in range(996, 1000))),
    )
    with pytest.raises(CalibrationError, match="MEASUREMENT POINT OVERFLOW"):
        propose(mill, "1", laser(error, targets, 0), OFF)


def test_a_deviation_above_two_percent_of_the_way_is_reached_over_a_longer_one(mill) -> None:
    targets = np.array([0.0, 100.0, 101.0, 200.0])
    proposal = propose(mill, "1", laser(np.array([0, 0.5, 0.5, 1.0]), targets, 0), OFF)
    assert table_of(proposal) == "deviation - mm 0:0 100:0.5 200:1"
    assert any("2 %" in note for note in proposal.notes)


def test_an_error_that_no_table_can_hold_is_refused(mill) -> None:
    with pytest.raises(CalibrationError, match="check units and sign"):
        propose(mill, "1", laser(np.array([0.0, 4.0]), np.array([0.0, 100.0]), 0), OFF)


def test_neighbours_that_are_too_far_apart_get_points_between_them(mill) -> None:
    targets = np.array([0.0, 5000.0])
    text = table_of(propose(mill, "1", laser(np.array([0.0, 0.3]), targets, 0), OFF))
    points = read_calibration(text).points
    assert len(points) == 4
    assert calibration_fault(text, turns=False) == ""


def test_thousands_of_targets_become_the_points_that_matter_in_a_moment(mill) -> None:
    targets = np.arange(2_000) * 0.5
    error = 0.001 * np.sin(targets / 40)
    proposal = propose(mill, "1", laser(error, targets, 0, runs=1), OFF)
    assert len(read_calibration(table_of(proposal)).points) <= 1001
    assert float(proposal.span_after) < 2e-5


def test_positions_with_too_many_digits_for_the_screen_are_refused(mill) -> None:
    with pytest.raises(CalibrationError, match="six digits"):
        propose(mill, "1", laser(np.zeros(2), np.array([0.0, 2e6]), 0), OFF)


# -- a table that turns ---------------------------------------------------------------------------


def rotary(text: str) -> Measurement:
    return read_measurement(text, MeasurementAnswers("deg", "deg", "measured-target"), "deg")


@pytest.mark.parametrize("start", ["-", "+"])
@pytest.mark.parametrize("last", ["", "360,0.002\n"])
def test_a_turn_of_a_rollover_axis_has_no_net_correction(mill, start: str, last: str) -> None:
    mill.set(("axis.rollover", "3"), Value(360, "deg"))
    points = rotary("0,0\n90,0.004\n180,0.006\n270,0.003\n" + last)
    text = table_of(
        propose(mill, "3", points, ProposalRequest(was_on=False, start=start)), ("calibration.table", "3")
    )
    assert calibration_fault(text, turns=True) == ""
    assert calibration_net(text) == 0
    found = read_calibration(text).points
    assert found[-1][0] - found[0][0] == 360


def test_more_than_a_turn_is_refused(mill) -> None:
    mill.set(("axis.rollover", "3"), Value(360, "deg"))
    with pytest.raises(CalibrationError, match="rolls over at 360"):
        propose(mill, "3", rotary("0,0\n200,0.001\n400,0\n"), OFF)


def test_lengths_are_refused_for_a_table_and_degrees_for_a_slide(mill) -> None:
    with pytest.raises(CalibrationError, match="measured in degrees"):
        propose(mill, "3", laser(np.zeros(2), np.array([0.0, 100.0]), 0), OFF)
    with pytest.raises(CalibrationError, match="measured in a length"):
        propose(mill, "1", rotary("0,0\n90,0.001\n"), OFF)


def test_an_unfitted_axis_has_no_table(mill) -> None:
    with pytest.raises(CalibrationError, match="is not used"):
        propose(mill, "8", laser(np.zeros(2), np.array([0.0, 100.0]), 0), OFF)


# -- by hand --------------------------------------------------------------------------------------


def test_points_are_inserted_replaced_and_deleted_as_at_the_screen(mill) -> None:
    form = compensation_of("9pc").table
    assert form is not None
    table = form.empty(mill, "1", "deviation", "-")
    assert form.write(mill, "1", table) == ""
    table = inserted(table, Fraction(0), Fraction(0))
    table = inserted(table, Fraction(100), Fraction("0.004"))
    table = inserted(table, Fraction(50), Fraction("0.001"))
    table = replaced(table, Fraction(50), Fraction("0.002"))
    assert form.write(mill, "1", table) == "deviation - mm 0:0 50:0.002 100:0.004"
    assert form.write(mill, "1", deleted(table, Fraction(50))) == "deviation - mm 0:0 100:0.004"
    with pytest.raises(CalibrationError, match="the nearest is at 50"):
        deleted(table, Fraction(51))
    with pytest.raises(CalibrationError, match="already"):
        inserted(table, Fraction(50), Fraction(0))
    with pytest.raises(CalibrationError, match="when all points"):
        rechosen(table, "measurement", "-")
    with pytest.raises(CalibrationError, match="PARAMETER OUT OF RANGE"):
        form.write(mill, "1", replaced(table, Fraction(100), Fraction(2)))


def test_a_family_without_compensation_offers_none() -> None:
    assert compensation_of("syntec").reversal == ""
    with pytest.raises(CalibrationError, match="neither a calibration table"):
        propose(new_file("syntec"), "1", laser(np.zeros(2), np.array([0.0, 100.0]), 0), OFF)
