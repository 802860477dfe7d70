"""An axis of LinuxCNC in motion: following error, homing, limits (lines of the source of 2.9.8)."""

from pathlib import Path

import pytest

from amp_studio.files import ParameterFile, open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.schema import Value
from amp_studio.sim import SimulationError, simulate


@pytest.fixture
def mill() -> ParameterFile:
    (path,) = Path(examples_folder() / "linuxcnc-mill").glob("*.amp")
    return open_file(path).file


def joint(file: ParameterFile, **values: float | bool | None) -> ParameterFile:
    """Return the mill with other values of joint 0."""
    for name, value in values.items():
        address = (f"joint.{name}", "0")
        unit = file.evaluation.unit(address, "metric")
        file.set(address, None if value is None else Value(value, "" if isinstance(value, bool) else unit))
    return file


def test_without_feed_forward_the_axis_lags_by_its_speed_over_its_gain(mill: ParameterFile) -> None:
    """A gain of 16.67 lags by 9.96 mm at 166 mm/s:
    10.000 mm at 166.667 mm/s were measured on the real program.
    """
    file = joint(mill, pid_p=16.666667, pid_ff1=0.0, ferror=11.0, min_ferror=11.0)
    trace = simulate(file, "step", axis="X", settings={"move.distance": 400.0})
    assert trace.result["peak_following_error"][0] == pytest.approx(9.96, abs=0.05)
    assert trace.alarms == ()


def test_the_error_limit_shrinks_with_the_speed_down_to_the_least_one(mill: ParameterFile) -> None:
    """C476 to C482: with 1 mm at standstill a lag loop trips on its way up."""
    file = joint(mill, pid_p=16.666667, pid_ff1=0.0, ferror=9.9, min_ferror=1.0)
    trace = simulate(file, "step", axis="X", settings={"move.distance": 400.0})
    assert [alarm.code for alarm in trace.alarms] == ["joint 0 following error"]


def test_home_gets_its_coordinate_after_the_move_from_the_marker(mill: ParameterFile) -> None:
    trace = simulate(joint(mill, home=6.0, home_offset=4.0), "home", axis="X")
    assert trace.result["home_position"][0] == pytest.approx(6.0)


@pytest.mark.parametrize(
    "values", [{"home_latch_velocity": 0.0}, {"home_search_velocity": 0.0, "home_use_index": False}]
)
def test_a_homing_that_the_control_refuses_names_the_latch(mill: ParameterFile, values: dict) -> None:
    with pytest.raises(SimulationError) as caught:
        simulate(joint(mill, **values), "home", axis="X")
    assert "latch" in str(caught.value)


def test_a_block_beyond_the_limit_is_not_begun(mill: ParameterFile) -> None:
    trace = simulate(mill, "travel", axis="Z")
    assert "5 mm" in trace.alarms[0].message
