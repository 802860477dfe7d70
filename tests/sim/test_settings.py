"""Settings as a person writes them."""

from pathlib import Path

import pytest

from amp_studio.cli import run
from amp_studio.files import open_file
from amp_studio.sim import SimulationError, listing, simulate
from amp_studio.sim.scenarios import SCENARIOS
from amp_studio.sim.settings import read_settings

MILL = Path(__file__).parents[2] / "examples" / "mill-1394" / "MILL_1394.amp"
STEP = dict(SCENARIOS["step"].settings)


@pytest.mark.parametrize(
    ("name", "text", "value"),
    [
        ("move.duration", "500 ms", 0.5),
        ("move.duration", "0.5 s", 0.5),
        ("move.duration", "0.5", 0.5),
        ("move.distance", "2 in", 50.8),
        ("move.feedrate", "10 ipm", 254.0),
        ("move.override", "50 %", 50.0),
        ("move.mode", "linear", "linear"),
    ],
)
def test_a_setting_is_taken_in_its_own_unit_whatever_it_is_written_in(
    name: str, text: str, value: float | str
) -> None:
    assert read_settings({name: text}, STEP)[0] == {name: pytest.approx(value)}


@pytest.mark.parametrize(
    ("name", "text", "sentence"),
    [
        ("move.duration", "5 mm", "move.duration is given in mm; give it in s"),
        ("move.distance", "5 s", "move.distance is given in s; give it in mm or deg"),
        ("move.blocks", "5 mm", "give it as a number without a unit"),
        ("move.distance", "5 parsec", "move.distance: 'parsec' is not a unit"),
    ],
)
def test_a_unit_that_does_not_fit_is_refused(name: str, text: str, sentence: str) -> None:
    with pytest.raises(SimulationError, match=sentence):
        read_settings({name: text}, STEP)


def test_an_angle_is_no_distance_of_a_linear_axis() -> None:
    with pytest.raises(SimulationError, match="axis 1 moves in mm: give it in mm"):
        simulate(open_file(MILL).file, "step", "1", {"move.distance": "5 deg"})
    with pytest.raises(SimulationError, match=r"model\.backlash is given in deg"):
        simulate(open_file(MILL).file, "step", "1", {"model.backlash": "5 deg"})


def test_a_file_lists_what_can_be_simulated_and_set(capsys: pytest.CaptureFixture[str]) -> None:
    found = listing(open_file(MILL).file)
    assert {"step", "velocity", "frequency", "circle"} <= {each.name for each in found.scenarios}
    assert found.axes[0] == "1"
    assert {"model.inertia_ratio", "model.delay", "model.backlash"} <= found.model.keys()
    assert run(["simulate", str(MILL), "--list"]) == 0
    listed = capsys.readouterr().out
    assert "velocity: One step of the velocity command" in listed
    assert "model.resonance" in listed


def test_a_scenario_has_to_be_named(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["simulate", str(MILL)]) == 2
    assert "--list" in capsys.readouterr().err
