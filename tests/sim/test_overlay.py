"""A record of the machine laid over the simulated move."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from amp_studio.files import open_file
from amp_studio.sim import SimulationError, laid_over, picture_of, simulate

MILL = Path(__file__).parents[2] / "examples" / "mill-1394" / "MILL_1394.amp"
MOVE = {"move.distance": 20.0, "move.feedrate": 3000.0}


def written(path: Path, head: str, *columns: np.ndarray) -> Path:
    rows = (",".join(map(repr, row)) for row in zip(*(each.tolist() for each in columns), strict=True))
    path.write_text("\n".join([head, *rows]))
    return path


def test_a_record_is_laid_over_by_its_best_lag(tmp_path: Path) -> None:
    trace = simulate(open_file(MILL).file, "step", "1", MOVE, advise=False)
    time = np.arange(0.0, 2.5, 0.002)
    position = 5.0 + np.interp(time - 0.4321, trace.columns["time_s"], trace.columns["position"])
    error = 0.02 + np.interp(time - 0.4321, trace.columns["time_s"], trace.columns["following_error"])
    record = written(
        tmp_path / "record.csv", "time (s),position (mm),following error (mm)", time, position, error
    )
    found = laid_over(trace, record)
    assert found.result["record_lag"][0] == pytest.approx(0.4321, abs=5e-4)
    assert found.result["difference_rms_position"][0] == pytest.approx(5.0, abs=0.02)
    assert found.result["difference_rms_following_error"][0] == pytest.approx(0.02, abs=5e-3)
    assert any(
        "recorded position" in curve.name for panel in picture_of(found).panels for curve in panel.curves
    )


def test_a_record_in_another_unit_is_converted_and_one_that_does_not_fit_is_one_sentence(
    tmp_path: Path,
) -> None:
    trace = simulate(open_file(MILL).file, "step", "1", MOVE, advise=False)
    time, speed = trace.columns["time_s"][::4], trace.columns["velocity"][::4]
    record = written(tmp_path / "record.csv", "time (ms),velocity (mm/s)", 1e3 * time, speed / 60.0)
    assert laid_over(trace, record).result["difference_rms_velocity"][0] == pytest.approx(0.0, abs=3.0)
    for head, message in (
        ("time (s),velocity (deg)", "and the simulation has it in"),
        ("a,b", "needs a column of time"),
    ):
        with pytest.raises(SimulationError, match=message):
            laid_over(trace, written(tmp_path / "bad.csv", head, time, speed))
    with pytest.raises(SimulationError, match="does not rise"):
        laid_over(trace, written(tmp_path / "bad.csv", "time (s),velocity (mm/min)", 0.0 * time, speed))
