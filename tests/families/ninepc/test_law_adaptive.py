"""Adaptive feed of a 9/PC (30-1 to 30-3): the torque gains decide how soon the torque of the block is
back."""

from pathlib import Path

import pytest

import amp_studio as amp
from amp_studio import MachineParameters
from amp_studio.sim import SimulationError


@pytest.fixture
def mill(checkout: Path) -> MachineParameters:
    return amp.open(checkout / "examples" / "mill-1394" / "MILL_1394.amp")


def test_the_feedrate_falls_until_the_torque_is_that_of_the_block(mill: MachineParameters) -> None:
    """A cut that takes 1.5 times the torque at the same feedrate is left 1 / 1.5 of it."""
    found = mill.simulate("adaptive-feed", axis="X").result
    assert found["torque_before"][0] == pytest.approx(30.0, rel=0.01)
    assert found["torque_after"][0] == pytest.approx(30.0, rel=0.01)
    assert found["feedrate_after"][0] == pytest.approx(500.0 / 1.5, rel=0.01)
    assert found["peak_torque"][0] == pytest.approx(45.0, rel=0.02)


def test_a_higher_integral_gain_is_sooner_at_the_torque(mill: MachineParameters) -> None:
    quick = mill.simulate("adaptive-feed", axis="X").result["time_off_torque"][0]
    mill["1152"] = 0.1
    slow = mill.simulate("adaptive-feed", axis="X").result["time_off_torque"][0]
    assert 0.0 < quick < 0.5 * slow


def test_gains_that_are_too_high_for_the_axis_hold_no_torque(mill: MachineParameters) -> None:
    trace = mill.simulate("adaptive-feed", axis="B")
    assert [alarm.code for alarm in trace.alarms] == ["TORQUE NOT REACHED"]


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"1101": "group 1", "2101": "group 1"}, "more than one servo"),
        ({"660": "X", "661": "Y", "662": 2, "663": 1}, "more than one servo"),
    ],
)
def test_an_axis_of_several_servos_has_none(
    mill: MachineParameters, values: dict[str, str], words: str
) -> None:
    """Page 30-2."""
    for number, value in values.items():
        mill[number] = value
    with pytest.raises(SimulationError, match=words):
        mill.simulate("adaptive-feed", axis="X")
