"""What a record shows beside inertia and friction, in axes that scipy moved."""

import math
from pathlib import Path

import numpy as np
import pytest

from amp_studio.files import open_file
from amp_studio.sim import SimulationError, Trace, identify
from tests.campaigns import some

MILL = Path(__file__).parents[2] / "examples" / "mill-1394" / "MILL_1394.amp"
PERIOD = 2e-3
SIZE, VISCOUS, COULOMB = 40.0, 0.02, 3.0
"""mm/s² for 1 %, % for 1 mm/s, %."""


def moved(
    *,
    shift: float = 0.0,
    static: float = 0.0,
    stribeck: float = 1.0,
    wave: float = 0.0,
    slow: bool = False,
    square: float = 0.0,
    every: int = 1,
) -> tuple[np.ndarray, ...]:
    """Return time, speed (mm/s) and torque (%) of moves at several speeds in both directions, ``every`` so
    many rows; the torque by scipy's differentiation.
    """
    from scipy.interpolate import CubicSpline

    time = np.arange(0.0, 12.0, PERIOD)
    tops = (40.0, -25.0, 80.0, -80.0, 12.0, -50.0) if not slow else (4.0, -4.0, 60.0, -60.0, 3.0, -30.0)
    knots = np.arange(13.0)
    speeds = [0.0] + [each for top in tops for each in (top, 0.0)]
    spline = CubicSpline(knots, np.array(speeds) * 1.0, bc_type="clamped")
    speed, acceleration = spline(time), spline(time, 1)
    dry = COULOMB + static * np.exp(-((speed / stribeck) ** 2))
    torque = acceleration / SIZE + VISCOUS * speed + dry * np.tanh(speed / 0.02)
    torque += wave * np.sin(2.0 * math.pi * np.cumsum(speed) * PERIOD / 10.0)
    torque += square * speed * np.abs(speed)
    torque += 0.02 * np.random.default_rng(1).standard_normal(len(time))
    return time[::every], np.interp(time - shift, time, speed)[::every], torque[::every]


def identified(folder: Path, head: str, columns: tuple[np.ndarray, ...], turn: str | None = None) -> Trace:
    record = folder / "record.csv"
    rows = (",".join(map(repr, row)) for row in zip(*(each.tolist() for each in columns), strict=True))
    record.write_text("\n".join([head, *rows]))
    return identify(open_file(MILL).file, record, "1", turn=turn)


HEAD = "time (s),velocity (mm/s),torque (%)"


@pytest.mark.parametrize("shift", some([0.0, 4e-3, -3e-3], 2))
def test_a_shift_between_the_channels_is_found_and_taken_out(tmp_path: Path, shift: float) -> None:
    trace = identified(tmp_path, HEAD, moved(shift=shift))
    assert trace.result["time_shift"][0] == pytest.approx(1e3 * shift, abs=0.3)
    assert trace.result["acceleration_per_output"][0] == pytest.approx(SIZE, rel=0.02)
    assert trace.result["coulomb_friction"][0] == pytest.approx(COULOMB, rel=0.03)
    assert any("was shifted so" in note for note in trace.assumptions) == (shift != 0.0)


def test_static_friction_and_its_speed_are_found_and_none_where_there_is_none(tmp_path: Path) -> None:
    result = identified(tmp_path, HEAD, moved(static=2.0, stribeck=3.0, slow=True)).result
    assert result["static_friction"][0] == pytest.approx(COULOMB + 2.0, rel=0.1)
    assert result["stribeck_speed"][0] == pytest.approx(60.0 * 3.0, rel=0.3)
    assert "static_friction" not in identified(tmp_path, HEAD, moved(slow=True)).result


@pytest.mark.parametrize("square", [4e-4, 1.5e-3])
def test_friction_that_rises_with_the_square_of_the_speed_is_no_static_one(
    tmp_path: Path, square: float
) -> None:
    """A wide Stribeck curve took the place of Coulomb friction: 0.8 % where it was 6.2, without a doubt."""
    trace = identified(tmp_path, HEAD, moved(square=square))
    assert "static_friction" not in trace.result
    assert any("depends on the speed" in doubt for doubt in trace.doubts)


def test_static_friction_in_few_rows_is_as_uncertain_as_the_means_of_rows_blur_it(tmp_path: Path) -> None:
    """Its error did not have the mean of three rows: 8.80 ± 0.09 % where it was 9.4."""
    result = identified(tmp_path, HEAD, moved(static=2.0, stribeck=3.0, slow=True, every=8)).result
    value, error = (result[f"static_friction{each}"][0] for each in ("", "_standard_error"))
    assert abs(value - COULOMB - 2.0) < 3.0 * error


def test_a_friction_that_depends_on_the_position_is_a_doubt(tmp_path: Path) -> None:
    assert not any("depends on the position" in doubt for doubt in identified(tmp_path, HEAD, moved()).doubts)
    bent = moved()
    way = np.cumsum(bent[1]) * PERIOD
    bent = (bent[0], bent[1], bent[2] + 0.02 * (way - way.mean()))
    assert any("depends on the position" in doubt for doubt in identified(tmp_path, HEAD, bent).doubts)


def test_a_record_in_rpm_has_its_travel_for_a_turn(tmp_path: Path) -> None:
    time, speed, torque = moved()
    columns = (time, speed * 60.0 / 10.0, torque)
    trace = identified(tmp_path, "time (s),speed (rpm),torque (%)", columns, turn="10 mm")
    assert trace.result["acceleration_per_output"][0] == pytest.approx(SIZE, rel=0.02)
    with pytest.raises(SimulationError, match="give the travel for a turn"):
        identified(tmp_path, "time (s),speed (rpm),torque (%)", columns)
    with pytest.raises(SimulationError, match="in mm, the unit of the axis"):
        identified(tmp_path, "time (s),speed (rpm),torque (%)", columns, turn="90 deg")
