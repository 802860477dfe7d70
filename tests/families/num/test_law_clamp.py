"""An axis with a clamp waits for the PLC before it moves and before the program goes on (4-22, 4-23)."""

import pytest

from amp_studio.files import ParameterFile
from amp_studio.schema import Value
from amp_studio.sim import SimulationError, Trace, simulate
from tests.programs.test_block import example


@pytest.fixture
def num() -> ParameterFile:
    """The mill whose axis 3, B, has a clamp."""
    return example("num-1060-mill")


def clamped(file: ParameterFile, axis: str | None = None, **settings: float | str) -> Trace:
    return simulate(
        file, "clamp", axis, {f"move.{name}": each for name, each in settings.items()}, advise=False
    )


def test_the_axis_moves_between_unclamping_and_clamping(num: ParameterFile) -> None:
    trace = clamped(num, distance=10.0, timeout=0.05, unclamping=0.3, clamping=0.4)
    motion = simulate(num, "step", "B", {"move.distance": 10.0}, advise=False).result["in_position_time"][0]
    assert motion is not None
    assert trace.result["time_before"][0] == pytest.approx(0.35)
    assert trace.result["motion_time"][0] == pytest.approx(motion)
    assert trace.result["time"][0] == pytest.approx(0.35 + motion + 0.4)
    time, position, clamp = (trace.columns[name] for name in ("time_s", "position", "clamped"))
    assert position[time < 0.35].max() == 0.0
    assert set(clamp[time < 0.35]) == {1.0}
    assert set(clamp[(time > 0.4) & (time < 0.35 + motion)]) == {0.0}


def test_it_is_clamped_within_its_window(num: ParameterFile) -> None:
    """End of movement, then clamping (4-23): the clamp takes what error is left, P22 at most."""
    trace = clamped(num, distance=10.0)
    window = num.evaluation.canonical(("servo.in_position_window", "3"))
    assert isinstance(window, float)
    assert 0.0 < (trace.result["error_at_clamping"][0] or 0.0) <= window * 0.0001 + 1e-9


def test_without_the_report_of_the_plc_nothing_moves(num: ParameterFile) -> None:
    trace = clamped(num, distance=10.0, crm="none")
    assert [alarm.code for alarm in trace.alarms] == ["WAIT FOR CRM"]
    assert trace.columns["position"].max() == 0.0
    assert trace.result["time"][0] is None


def test_an_axis_without_a_clamp_is_refused(num: ParameterFile) -> None:
    with pytest.raises(SimulationError, match="P8 gives axis 0 no clamp"):
        clamped(num, "X")
    num.set(("axes.clamped", ""), Value(0))
    with pytest.raises(SimulationError, match="P8 gives no axis a clamp"):
        clamped(num)
