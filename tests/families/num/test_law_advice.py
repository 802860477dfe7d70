"""What a move of a NUM axis recommends, and that the recommended word ends its cause."""

from pathlib import Path

import pytest

from amp_studio.files import ParameterFile, open_file
from amp_studio.schema import Value
from amp_studio.sim import Recommendation, Trace, simulate

EXAMPLE = Path(__file__).parents[3] / "examples" / "num-1060-mill" / "MILL_1060.amp"


def mill(**changes: int) -> ParameterFile:
    file = open_file(EXAMPLE).file
    for name, value in changes.items():
        put(file, f"servo.{name}", value)
    return file


def put(file: ParameterFile, parameter: str, value: int) -> None:
    old = file.get((parameter, "0"))
    assert old is not None
    file.set((parameter, "0"), Value(value, old.unit))


def moved(file: ParameterFile, **model: float) -> Trace:
    return simulate(file, "step", "0", {f"model.{name}": value for name, value in model.items()})


def only(trace: Trace) -> Recommendation:
    (found,) = trace.recommendations
    return found


def test_the_example_needs_nothing() -> None:
    assert moved(mill()).recommendations == ()


def test_a_time_constant_follows_its_kvar() -> None:
    file = mill(loop_gain=4000, movement_tolerance=100, max_following_error=9000)
    found = only(moved(file))
    assert (found.parameter, found.value, found.unit) == (
        "servo.axis_time_constant",
        74.0,
        "ms",
    )  # 6-14: 60 x 4915 / 4000
    assert found.price.startswith("On paths with axes of another time constant")
    file.set((found.parameter, "0"), Value(int(found.value), found.unit))
    assert moved(file).recommendations == ()


def test_an_emax_below_the_following_error_is_calculated_again() -> None:
    file = mill(max_following_error=5000)
    trace = moved(file)
    assert [alarm.code for alarm in trace.alarms] == ["40 to 71"]
    found = only(trace)
    assert (found.parameter, found.unit) == ("servo.max_following_error", "iu")
    assert found.value == pytest.approx(6600.0, abs=1.0)  # 6-22
    put(file, found.parameter, int(found.value))
    assert moved(file).alarms == ()


def test_an_emax_far_above_the_following_error_notices_a_blocked_axis_late() -> None:
    assert only(moved(mill(max_following_error=99000))).value == pytest.approx(6600.0, abs=1.0)


def test_an_axis_that_is_outside_its_window_gets_twice_its_error() -> None:
    file = mill(in_position_window=5, movement_tolerance=200)
    trace = moved(file, gravity=20.0, velocity_integral=0.0)
    assert trace.result["in_position_time"][0] is None
    found = only(trace)
    assert found.parameter == "servo.in_position_window"
    # 11-7: 20 % of 10 mm/s2, kept by a loop of 2 pi x 50 1/s behind a position loop, stop it 38.0 µm from its
    # end.
    assert found.value == 76.0
    put(file, found.parameter, int(found.value))
    after = moved(file, gravity=20.0, velocity_integral=0.0)
    assert after.result["in_position_time"][0] is not None


def test_a_dynamic_check_that_is_off_is_recommended_with_room_for_the_move() -> None:
    file = mill(movement_tolerance=0)
    found = only(moved(file))
    assert (found.parameter, found.value) == ("servo.movement_tolerance", 60.0)  # 11-8: 3 windows of 20
    put(file, found.parameter, int(found.value))
    assert moved(file).alarms == ()


def test_a_dynamic_check_is_not_made_to_fit_a_wrong_kvar() -> None:
    found = moved(mill(movement_tolerance=0, loop_gain=12000)).recommendations
    assert [each.parameter for each in found] == ["servo.axis_time_constant", "servo.max_following_error"]


def test_an_acceleration_beyond_a_known_torque_is_lowered() -> None:
    file = mill(movement_tolerance=200)
    found = only(moved(file, acceleration_per_output=2.5))
    assert (found.parameter, found.value) == ("servo.acceleration_fast", 400.0)
    put(file, found.parameter, int(found.value))
    assert moved(file, acceleration_per_output=2.5).recommendations == ()


def test_an_assumed_torque_lowers_no_acceleration() -> None:
    assert moved(mill(), coulomb_friction=150.0).recommendations == ()
