"""Backlash of a NUM axis from measured points: in its internal unit, with a sign that means the direction."""

from fractions import Fraction

import pytest

from amp_studio.calibration import (
    CalibrationError,
    MeasurementAnswers,
    ProposalRequest,
    compensation_of,
    lost_motion,
    propose,
)
from amp_studio.calibration.reading import read_measurement
from amp_studio.files import new_file

UM = MeasurementAnswers("mm", "um", "measured-target")


@pytest.mark.parametrize(("falling", "lost"), [(7.4, 7), (-7.4, -7)])
def test_backlash_is_counted_in_internal_units_towards_zero_and_keeps_its_sign(
    falling: float, lost: int
) -> None:
    """Page 7-14: a positive value is added where the axis moves in the positive direction."""
    file = new_file("num")
    file.set(("axes.internal_unit", ""), file.read(("axes.internal_unit", ""), "3"))
    points = read_measurement(f"0,0\n100,0\n100,{falling}\n0,{falling}\n", UM)
    address = ("travel.backlash", "0")
    proposal = propose(file, "0", points, ProposalRequest(was_on=False))
    value = proposal.settings[address]
    file.set(address, value)
    assert (value.value, value.unit) == (lost, "iu")
    assert lost_motion(file, compensation_of("num"), "0") == Fraction(lost, 1000)
    assert any("no calibration table" in note for note in proposal.notes)


def test_without_the_size_of_the_internal_unit_nothing_is_proposed() -> None:
    points = read_measurement("0,0\n100,0\n100,7\n0,7\n", UM)
    with pytest.raises(CalibrationError, match="is not set"):
        propose(new_file("num"), "0", points, ProposalRequest(was_on=False))
