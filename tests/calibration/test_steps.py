"""Values tuned in steps: as fine as the control keeps them, and no further than their range (page 36-11)."""

from fractions import Fraction

import pytest

from amp_studio.calibration import CalibrationError
from amp_studio.calibration.steps import stepped, steps_of, usual_step, with_followers
from amp_studio.files import ParameterFile, new_file
from amp_studio.schema import Value

REVERSAL = ("servo.reversal_error", "1")


@pytest.fixture(scope="module")
def mill() -> ParameterFile:
    file = new_file("9pc", "mill", ["X"])
    file.set(("servo.hardware_type", "1"), Value("sercos"))
    file.set(("servo.loop_type", "1"), Value("digital"))
    return file


def test_the_smallest_step_is_the_last_decimal_that_the_control_keeps(mill) -> None:
    assert steps_of(mill, REVERSAL) == tuple(Fraction(n, 100_000) for n in (1, 10, 100, 1000))
    assert steps_of(mill, ("axis.rollover", "1"))[0] == 1
    assert steps_of(mill, ("axis.type", "1")) == ()
    assert steps_of(mill, ("calibration.table", "1")) == ()


def test_a_value_goes_up_and_down_exactly(mill) -> None:
    file = mill.copy()
    for _ in range(10):
        file.set(REVERSAL, stepped(file, REVERSAL, Fraction(1, 1000)))
    assert file.get(REVERSAL) == Value(0.01, "mm")
    file.set(REVERSAL, stepped(file, REVERSAL, Fraction(-1, 100)))
    assert file.get(REVERSAL) == Value(0.0, "mm")


def test_a_value_stops_at_the_bound_of_its_range(mill) -> None:
    file = mill.copy()
    file.set(REVERSAL, Value(9.995, "mm"))
    for _ in range(3):
        file.set(REVERSAL, stepped(file, REVERSAL, Fraction(1, 100)))
    assert file.get(REVERSAL) == Value(9.999, "mm")
    assert stepped(file, REVERSAL, Fraction(-1, 1000)) == Value(9.998, "mm")
    file.set(REVERSAL, Value(-9.995, "mm"))
    assert stepped(file, REVERSAL, Fraction(-1, 100)) == Value(-9.999, "mm")


def test_a_value_out_of_range_is_not_pulled_back_but_comes_in_by_steps(mill) -> None:
    file = mill.copy()
    file.set(REVERSAL, Value(12.0, "mm"))
    assert stepped(file, REVERSAL, Fraction(-1)) == Value(11.0, "mm")


def test_a_value_that_is_not_set_has_no_step(mill) -> None:
    file = mill.copy()
    file.set(REVERSAL, None)
    with pytest.raises(CalibrationError, match="not set"):
        stepped(file, REVERSAL, Fraction(1))


def test_a_velocity_gain_that_is_tuned_switches_the_motor_table_off(mill) -> None:
    """Page 36-11: the control sets Standard Motor Table Values to No."""
    gain = ("servo.velocity_proportional_gain", "1")
    found = with_followers(mill, {gain: Value(2)})
    assert found[("servo.standard_motor_values", "")] == Value(False)
    assert with_followers(mill, {REVERSAL: Value(0.1, "mm")}) == {REVERSAL: Value(0.1, "mm")}
    assert with_followers(mill, {gain: mill.get(gain)}) == {gain: mill.get(gain)}


@pytest.mark.parametrize(
    ("gain", "step"),
    [(0.0, 1e-6), (1.5e-6, 1e-8), (0.00021, 1e-6), (-0.00021, 1e-6), (0.08, 1e-4), (40.0, 0.1)],
)
def test_a_step_of_a_gain_without_decimals_is_some_hundredth_of_it(gain: float, step: float) -> None:
    """It was a thousandth whatever the gain: one click made 1.5e-6 of it, as a feed forward has, 0.001."""
    file, address = new_file("acromill", "mill", ["X", "Y"]), ("servo.d_gain", "X")
    file.set(address, Value(gain, file.evaluation.unit(address, "metric")))
    assert float(usual_step(file, address)) == step


def test_the_first_step_from_nothing_is_one_of_a_whole_number_and_a_micrometre_of_a_way(mill) -> None:
    file = mill.copy()
    file.set(REVERSAL, Value(0.0, "mm"))
    assert usual_step(file, REVERSAL) == Fraction(1, 1000)
    file.set(("servo.velocity_integral_gain", "1"), Value(0))
    assert usual_step(file, ("servo.velocity_integral_gain", "1")) == 1
