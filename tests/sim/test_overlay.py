"""A record of the machine laid over the simulated move."""

from pathlib import Path

import numpy as np
import pytest

from amp_studio.files import open_file
from amp_studio.sim import SimulationError, laid_over, picture_of, simulate, trigger_of, unit_factor

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
    panels = {panel.title: panel for panel in picture_of(found).panels}
    assert "recorded position" in {curve.name for curve in panels["position"].curves}
    (difference,) = panels["machine less simulation"].curves
    assert np.median(difference.y) == pytest.approx(5.0, abs=0.02)


def test_what_a_record_does_not_cover_is_not_drawn(tmp_path: Path) -> None:
    trace = simulate(open_file(MILL).file, "step", "1", MOVE, advise=False)
    half = len(trace.columns["time_s"]) // 2
    columns = (trace.columns["time_s"][:half:4], trace.columns["position"][:half:4])
    found = laid_over(trace, written(tmp_path / "record.csv", "time (s),position (mm)", *columns))
    assert np.isnan(found.columns["recorded_position"]).any()
    for panel in picture_of(found).panels:
        for curve in panel.curves:
            assert np.isfinite(curve.y).all(), curve.name


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


def test_a_trigger_lays_both_over_each_other_where_a_signal_passes_its_level(tmp_path: Path) -> None:
    trace = simulate(open_file(MILL).file, "step", "1", MOVE, advise=False)
    time = np.arange(0.0, 2.5, 0.001)
    speed = np.interp(time - 0.6, trace.columns["time_s"], trace.columns["velocity"])
    speed += 40.0 * (time < 0.3)  # another motion before: the best lag of all of it would not care
    record = written(tmp_path / "record.csv", "time (s),velocity (mm/min)", time, speed)
    found = laid_over(trace, record, trigger_of("velocity > 500", 0.05))
    assert found.result["record_lag"][0] == pytest.approx(0.6, abs=1e-3)
    laid = found.columns["recorded_velocity"]
    passes = found.columns["time_s"][np.argmax(trace.columns["velocity"] > 500.0)]
    assert found.columns["time_s"][np.isfinite(laid)][0] == pytest.approx(max(0.0, passes - 0.05), abs=2e-3)
    assert np.nanmax(np.abs(found.columns["difference_velocity"])) < 30.0


def test_a_record_that_begins_beyond_the_level_is_laid_over_from_its_first_row(tmp_path: Path) -> None:
    trace = simulate(open_file(MILL).file, "step", "1", MOVE, advise=False)
    here, speed = trace.columns["time_s"], trace.columns["velocity"]
    first = int(np.argmax(speed >= 500.0))
    record = written(
        tmp_path / "record.csv", "time (s),velocity (mm/min)", here[first:] - here[first], speed[first:]
    )
    with pytest.raises(SimulationError, match="never goes above 500"):
        laid_over(trace, record, trigger_of("velocity>500"))
    found = laid_over(trace, record, trigger_of("velocity>=500"))
    assert found.result["record_lag"][0] == pytest.approx(-here[first], abs=here[1] - here[0])
    step = np.abs(np.diff(speed)).max()
    assert found.result["difference_peak_velocity"][0] <= step
    falling = written(tmp_path / "falling.csv", "time (s),velocity (mm/min)", here, speed)
    assert laid_over(trace, falling, trigger_of("velocity<=500")).result["record_lag"][0] == 0.0


@pytest.mark.parametrize(
    ("text", "words"),
    [("velocity", "is no trigger"), ("colour>1", "is no trigger"), ("velocity>1e9", "is no trigger")],
)
def test_what_is_no_trigger_is_one_sentence(text: str, words: str) -> None:
    with pytest.raises(SimulationError, match=words):
        trigger_of(text)


def test_a_level_that_is_never_passed_and_a_signal_that_is_missing_are_named(tmp_path: Path) -> None:
    trace = simulate(open_file(MILL).file, "step", "1", MOVE, advise=False)
    time, speed = trace.columns["time_s"][::4], trace.columns["velocity"][::4]
    record = written(tmp_path / "record.csv", "time (s),velocity (mm/min)", time, speed)
    for text, words in (
        ("velocity>90000", "its velocity never goes above 90000, where the trigger is"),
        ("torque>1", "it has no torque for the trigger"),
    ):
        with pytest.raises(SimulationError, match=words):
            laid_over(trace, record, trigger_of(text))
    with pytest.raises(SimulationError, match="it must be 0 or more"):
        trigger_of("velocity>1", -1.0)


def test_a_speed_in_counts_a_second_lies_over_one_in_counts_a_minute() -> None:
    """Counts are no unit that is converted: the readings of a 57C422B were refused."""
    assert unit_factor("record", "velocity", "counts/s", "counts/min") == 60.0
    with pytest.raises(SimulationError, match="is in counts/s"):
        unit_factor("record", "velocity", "counts/s", "mm/min")
