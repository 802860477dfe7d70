"""What is found of axes that scipy moved (`hidden_plants.py`): each figure is within 3 %, or within its
uncertainty, or there is none. ``make campaign`` takes all twenty.
"""

from collections.abc import Mapping
from pathlib import Path

import pytest

from amp_studio.files import open_file
from amp_studio.sim import Trace, identify
from amp_studio.sim.model import AT_SPEED
from tests.campaigns import CAMPAIGN
from tests.sim.hidden_plants import SAMPLE, TURN, HiddenPlant, hidden_plants, record

MILL = Path(__file__).parents[2] / "examples" / "mill-1394" / "MILL_1394.amp"
TOLERANCE, ERRORS = 0.03, 3.0
PLANTS = list(hidden_plants())
STATIC, WEIGHT = 9, 7


def wrong(trace: Trace, figures: Mapping[str, float]) -> list[str]:
    """Return the figures that are further off than 3 % and than their uncertainty."""
    found = []
    for name, value in figures.items():
        there, error = (trace.result.get(each, (None,))[0] for each in (name, f"{name}_standard_error"))
        if (
            there is not None
            and error is not None
            and abs(there - value) > max(TOLERANCE * abs(value), ERRORS * error)
        ):
            found.append(f"{name} is {there:.4g} ± {error:.2g}, and was {value:.4g}")
    return found


def figures_of(plant: HiddenPlant) -> dict[str, float]:
    """Return what a record of moves may show, in the units of the settings."""
    figures = {
        "acceleration_per_output": plant.size,
        "viscous_friction": plant.viscous / AT_SPEED,
        "coulomb_friction": plant.coulomb,
        "gravity": plant.gravity,
        # A torque that is kept for a sample comes half of it later.
        "time_shift": 1e3 * (plant.shift + plant.delay + 0.5 * SAMPLE),
        "backlash": plant.backlash,
        "static_friction": plant.coulomb + plant.static,
    }
    return figures | ({"stribeck_speed": 60.0 * plant.stribeck} if plant.static else {})


def found_in_moves(plant: HiddenPlant, folder: Path) -> Trace:
    """Return what is found in the record of moves of an axis."""
    path = folder / "moves.csv"
    record(plant, path, both_sides=plant.backlash > 0.0)
    turn = f"{TURN:g} mm" if plant.channel == "rpm" else None
    return identify(open_file(MILL).file, path, "1", turn=turn)


@pytest.mark.parametrize("seed", range(len(PLANTS)) if CAMPAIGN else [STATIC])
def test_moves_of_a_hidden_plant_give_no_figure_that_is_surely_wrong(seed: int, tmp_path: Path) -> None:
    plant = PLANTS[seed]
    trace = found_in_moves(plant, tmp_path)
    assert wrong(trace, figures_of(plant)) == []
    for name in ("acceleration_per_output", "coulomb_friction"):
        assert trace.result[name][0] == pytest.approx(figures_of(plant)[name], rel=0.05), name


def test_a_backlash_that_a_weight_keeps_closed_is_a_doubt(tmp_path: Path) -> None:
    """It was called 0.0108 ± 0.0003 mm where it was 0.032, and the inertia, of a motor that rattles in it, 10
    % too small.
    """
    plant = PLANTS[WEIGHT]
    trace = found_in_moves(plant, tmp_path)
    assert wrong(trace, figures_of(plant)) == []
    assert "backlash" not in trace.result
    assert any("backlash cannot be seen" in doubt for doubt in trace.doubts)
