"""Lost motion from the circles of a ball-bar: machines whose backlash is known, circled both ways round."""

import math
from collections.abc import Callable
from fractions import Fraction

import pytest

from amp_studio.calibration import CalibrationError, MeasurementAnswers, ProposalRequest, propose
from amp_studio.calibration.ballbar import lost_motions
from amp_studio.calibration.errors import MeasurementError
from amp_studio.calibration.reading import read_measurement
from amp_studio.files import new_file
from amp_studio.schema import Value

UM = MeasurementAnswers("deg", "um", "measured-target")


def circle(backlash: Callable[[str], float], *, clockwise: bool = False, squareness: float = 0.0) -> str:
    """Return what a ball-bar reads: each slide is half of its lost motion behind the way it moves."""
    lines = []
    for step in range(720):
        angle = math.radians((720 - step if clockwise else step) / 2)
        way = -1 if clockwise else 1
        errors = {
            "first": -backlash("first") / 2 * math.copysign(1, -math.sin(angle) * way),
            "second": -backlash("second") / 2 * math.copysign(1, math.cos(angle) * way),
        }
        radius = errors["first"] * math.cos(angle) + errors["second"] * math.sin(angle)
        radius += squareness * math.sin(2 * angle) + 3.0
        lines.append(f"{math.degrees(angle):.4f},{radius:.4f}")
    return "angle [deg],deviation [um]\n" + "\n".join(lines)


@pytest.mark.parametrize("clockwise", [False, True])
@pytest.mark.parametrize(("which", "lost"), [("first", 8.0), ("second", 3.0)])
def test_each_axis_has_its_own_lost_motion_whichever_way_round(
    clockwise: bool, which: str, lost: float
) -> None:
    text = circle({"first": 8.0, "second": 3.0}.__getitem__, clockwise=clockwise, squareness=5.0)
    found = lost_motions(read_measurement(text, UM), which)
    assert len(found) == 2
    assert [float(step) * 1000 for step in found] == pytest.approx([lost, lost], abs=0.15)


def test_a_circle_gives_a_reversal_error_and_no_table() -> None:
    file = new_file("9pc", "mill", ["X", "Y"])
    file.set(("servo.hardware_type", "1"), Value("sercos"))
    file.set(("servo.loop_type", "1"), Value("digital"))
    measurement = read_measurement(circle({"first": 8.0, "second": 0.0}.__getitem__), UM)
    with pytest.raises(CalibrationError, match="first or the second"):
        propose(file, "1", measurement, ProposalRequest(was_on=False))
    proposal = propose(file, "1", measurement, ProposalRequest(was_on=False, circle="first"))
    assert list(proposal.settings) == [("servo.reversal_error", "1")]
    assert proposal.reversal is not None
    assert abs(proposal.reversal[1] - Fraction("0.008")) < Fraction("0.0002")


def test_an_arc_that_does_not_reach_the_turn_is_refused() -> None:
    lines = circle({"first": 8.0, "second": 0.0}.__getitem__).splitlines()
    arc = "\n".join([lines[0], *lines[60:300]])
    with pytest.raises(CalibrationError, match="too few points about 0 and 180 degrees"):
        lost_motions(read_measurement(arc, UM), "first")
    assert lost_motions(read_measurement(arc, UM), "second")


def test_a_radius_is_no_error_of_a_radius() -> None:
    with pytest.raises(MeasurementError, match="not the radius"):
        read_measurement("angle,measured\n0,100\n1,100\n", UM)
    with pytest.raises(MeasurementError, match="errors of its radius"):
        read_measurement("angle,deviation\n0,1\n1,1\n", MeasurementAnswers("deg", "deg", "measured-target"))
    assert read_measurement("angle,deviation\n0,1\n1,1\n", MeasurementAnswers()).assumed == (
        "error_unit",
        "sign",
    )
