"""Feed to hard stop of a 9/PC (7-65, 7-66): found by its torque, or never, or the control stops before."""

from pathlib import Path

import pytest

import amp_studio as amp
from amp_studio import MachineParameters


@pytest.fixture
def mill(checkout: Path) -> MachineParameters:
    machine = amp.open(checkout / "examples" / "mill-1394" / "MILL_1394.amp")
    machine["1151"], machine["1150"] = 90, 10
    return machine


def test_the_stop_is_found_when_the_torque_is_that_of_the_detection(mill: MachineParameters) -> None:
    trace = mill.simulate("hard-stop", axis="X")
    found = trace.result
    assert trace.alarms == (), "the feed ends there"
    assert found["detection_torque"] == (90.0, "%")
    assert found["peak_torque"][0] == pytest.approx(90.0, rel=0.05)
    assert found["pressed_in"][0] == pytest.approx(0.09, rel=0.05), "90 % at 1000 % for 1 mm"
    assert found["held_in"] == (0.01, "mm")


def test_a_detection_above_the_torque_limit_is_never_reached(mill: MachineParameters) -> None:
    """Page 7-65: the torque limits must be set properly before."""
    mill["1151"] = 250
    trace = mill.simulate("hard-stop", axis="X")
    assert trace.alarms[0].code in ("NO HARD STOP", "EXCESS FOLLOWING ERROR")
    assert trace.result["time"] == (None, "s")


def test_a_following_error_beyond_its_limit_ends_it_before(mill: MachineParameters) -> None:
    """Page 7-20: above Excess Error the control goes into E-STOP."""
    mill["1750"], mill["1740"], mill["1730"], mill["1735"] = "0.05 mm", "0.04 mm", "0.03 mm", "0.02 mm"
    trace = mill.simulate("hard-stop", axis="X", **{"stop.stiffness": 100.0})
    assert [alarm.code for alarm in trace.alarms] == ["EXCESS FOLLOWING ERROR"]
