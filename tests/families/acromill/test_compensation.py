"""The ballscrew table of AcroMill made of measured points: the printed example of page 107,
and what it refuses.
"""

from fractions import Fraction

import pytest

from amp_studio.calibration import (
    CalibrationError,
    MeasurementAnswers,
    ProposalRequest,
    compensation_of,
    present_table,
    propose,
)
from amp_studio.calibration.reading import read_measurement
from amp_studio.files import ParameterFile, new_file
from amp_studio.schema import Value

PRINTED = """Primary Setpoint Position,Actual 1,Actual 2,Actual 3,Actual 4
0,0,0,0,0
1,0.979,1.000,0.997,0.999
2,1.996,1.998,1.995,1.998
3,2.997,3.000,2.997,2.999
4,4.004,4.001,4.004,4.001
"""
INCHES = MeasurementAnswers("in", "in", "measured-target")
OFF = ProposalRequest(was_on=False)
TABLE = ("ballscrew.table", "X")


@pytest.fixture
def router() -> ParameterFile:
    """Return a machine with home at 2 of the guide's five positions: two before it, two behind."""
    file = new_file("acromill")
    file.header.units = "inch"
    file.set(("control.default_units", ""), Value("inch"))
    file.set(("axes.soft_limit_minus", "X"), Value(-2.0, "in"))
    file.set(("axes.soft_limit_plus", "X"), Value(2.0, "in"))
    file.set(("home.preset", "X"), Value(2.0, "in"))
    return file


def test_the_measurement_of_the_guide_gives_the_words_of_the_guide(router) -> None:
    """Page 107: 0.00625, 0.00325, 0.00175 and -0.00250; position 2 is home and word 0,
    positions 0 and 1 wrap around.
    """
    text = PRINTED.replace("Primary Setpoint Position", "Position").replace("Actual ", "Measured ")
    proposal = propose(router, "X", read_measurement(text, INCHES), OFF)
    assert proposal.settings[TABLE] == Value("X0E.00325 X1E.00175 X2E-.00250 X3E.00000 X4E.00625")
    assert float(proposal.span_after) == pytest.approx(0, abs=1e-9)


def test_a_table_is_read_as_the_errors_it_takes_away(router) -> None:
    router.set(TABLE, Value("X0E.00325 X1E.00175 X2E-.00250 X3E.00000 X4E.00625"))
    table = present_table(router, compensation_of("acromill"), "X")
    assert table is not None
    inches = [(at / Fraction("25.4"), by / Fraction("25.4")) for at, by in table.points]
    assert inches == [
        (0, 0),
        (1, Fraction("-0.00625")),
        (2, Fraction("-0.00325")),
        (3, Fraction("-0.00175")),
        (4, Fraction("0.0025")),
    ]
    form = compensation_of("acromill").table
    assert form is not None
    assert form.write(router, "X", table) == str(router.get(TABLE).value)


def test_positions_between_those_that_were_measured_lie_on_their_line(router) -> None:
    points = read_measurement("0,0\n4,0.004\n", INCHES)
    proposal = propose(router, "X", points, OFF)
    assert proposal.settings[TABLE] == Value("X0E-.00200 X1E-.00300 X2E-.00400 X3E.00000 X4E-.00100")
    assert any("3 of 5 whole positions" in note for note in proposal.notes)


def test_a_travel_that_was_not_measured_whole_is_refused(router) -> None:
    with pytest.raises(CalibrationError, match="from 0 in to 4 in, and 0 in to 3 in was measured"):
        propose(router, "X", read_measurement("0,0\n3,0.004\n", INCHES), OFF)


def test_a_correction_with_digits_before_the_point_has_no_form(router) -> None:
    with pytest.raises(CalibrationError, match="digits before the point"):
        propose(router, "X", read_measurement("0,0\n4,4.1\n", INCHES), OFF)


def test_the_backlash_is_the_lost_motion(router) -> None:
    points = read_measurement("0,0\n4,0\n4,0.0003\n0,0.0003\n", INCHES)
    value = propose(router, "X", points, OFF).settings[("backlash.amount", "X")]
    assert (float(value.value), value.unit) == (pytest.approx(0.0003), "in")
