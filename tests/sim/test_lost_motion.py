"""Backlash in a record of motor and load, of axes that numpy made, not the simulator."""

from pathlib import Path

import numpy as np
import pytest

from amp_studio.files import open_file
from amp_studio.sim import SimulationError, identify, machine_settings
from amp_studio.sim.identification.drive_record import drive_record_of

FILE = open_file(Path(__file__).parents[2] / "examples" / "mill-1394" / "MILL_1394.amp").file
PERIOD = 1e-3


def written(path: Path, **columns: np.ndarray) -> Path:
    heads = {
        "time": "time (s)",
        "velocity": "velocity (mm/s)",
        "torque": "torque (%)",
        "motor": "motor position (mm)",
        "load": "load position (mm)",
    }
    table = np.column_stack(list(columns.values()))
    rows = "\n".join(",".join(f"{value:.7g}" for value in row) for row in table)
    path.write_text(",".join(heads[name] for name in columns) + "\n" + rows + "\n")
    return path


def swinging(seed: int, gap: float) -> dict[str, np.ndarray]:
    """Return an axis to and fro at two speeds: a play operator with noise, a scale error and counts."""
    dice = np.random.default_rng(seed)
    time = np.arange(0.0, 6.0, PERIOD)
    wave = np.clip(3.0 * np.sin(2.0 * np.pi * time / 1.5), -1.0, 1.0)
    speed = 60.0 * wave * np.where(time < 3.0, 1.0, 0.4)
    motor = np.cumsum(speed) * PERIOD
    load, last = np.empty_like(motor), 0.0
    for n, place in enumerate(motor):  # the load stays until the gap is crossed
        last = min(max(last, place - 0.5 * gap), place + 0.5 * gap)
        load[n] = last
    load = 1.0001 * load + 0.3 + 0.001 * dice.standard_normal(len(load))
    torque = np.gradient(speed, PERIOD) / 90.0 + 0.03 * speed + 4.0 * np.sign(speed)
    return {
        "time": time,
        "torque": torque + 0.05 * dice.standard_normal(len(time)),
        "motor": np.round(motor, 3),
        "load": np.round(load, 3),
    }


@pytest.mark.parametrize("gap", [0.012, 0.05])
def test_backlash_is_by_how_much_the_load_lags_more_in_one_direction(tmp_path: Path, gap: float) -> None:
    trace = identify(FILE, written(tmp_path / "r.csv", **swinging(1, gap)), "1")
    value, unit = trace.result["backlash"]
    error = trace.result["backlash_standard_error"][0]
    assert (unit, value) == ("mm", pytest.approx(gap, abs=max(4.0 * error, 0.0005)))
    assert 0.0 < error < 0.002
    assert machine_settings(trace)["model.backlash"].endswith("mm")


def test_no_backlash_is_none_and_one_position_shows_none(tmp_path: Path) -> None:
    columns = swinging(2, 0.0)
    trace = identify(FILE, written(tmp_path / "r.csv", **columns), "1")
    assert trace.result["backlash"][0] <= 0.0005
    del columns["load"]
    assert "backlash" not in identify(FILE, written(tmp_path / "s.csv", **columns), "1").result


def test_a_backlash_that_is_not_sure_may_be_as_large_as_it_looks(tmp_path: Path) -> None:
    """It was called 0 ± 0.0015 mm where it was 0.0079, as 0.0049 was not four times its error."""
    columns = swinging(1, 0.012)
    columns["load"] = columns["load"] - 0.016 * np.sin(columns["time"] * 9.0)
    result = identify(FILE, written(tmp_path / "r.csv", **columns), "1").result
    value, error = result["backlash"][0], result["backlash_standard_error"][0]
    assert value == 0.0
    assert 3.0 * error > 0.012


def test_positions_in_two_units_are_refused() -> None:
    rows = "\n".join(f"{n / 1000},{n},{n},1" for n in range(200))
    with pytest.raises(SimulationError, match="Motor and load are in mm and deg: give one unit"):
        drive_record_of("time (s),motor position (mm),load position (deg),torque (%)\n" + rows)
