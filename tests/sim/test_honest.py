"""Figures that mean what they say: steady, settled, unstable, doubtful, absurd."""

from pathlib import Path

import numpy as np
import pytest

from amp_studio.files import ParameterFile, open_file
from amp_studio.schema import Value
from amp_studio.sim import SimulationError, simulate, trace_summary, trace_text
from amp_studio.sim.scenarios import SCENARIOS
from amp_studio.sim.scenarios.figures import grows, steady
from tests.campaigns import some
from tests.sim.tiny import tiny

MILL = Path(__file__).parents[2] / "examples" / "mill-1394" / "MILL_1394.amp"
STEP = SCENARIOS["step"].run


@pytest.fixture
def mill() -> ParameterFile:
    return open_file(MILL).file


def test_a_figure_that_still_creeps_is_not_steady() -> None:
    time = np.linspace(0.0, 1.0, 1000)
    assert steady(np.full(1000, 5.0), 0.0) == 5.0
    assert steady(5.0 * (1.0 - np.exp(-time / 0.05)), 0.0) == pytest.approx(5.0)
    # A tenth of a slow lag changes by less than 1 %, and the lag still has half of its way to go.
    slow = 5.0 + (1.0 - np.exp(-time / 10.0))
    assert np.ptp(slow[-100:]) < 0.01 * slow[-1]
    assert steady(slow, 0.0) is None


def test_a_figure_that_swings_is_not_steady_and_counts_are_no_swing() -> None:
    time = np.linspace(0.0, 1.0, 1000)
    assert steady(5.0 + 0.1 * np.sin(80.0 * time), 0.0) is None
    assert steady(np.round(5.0 + 0.001 * np.sin(80.0 * time), 3), 0.003) == pytest.approx(5.0, abs=0.001)


def test_an_error_that_grows_inside_the_band_does_not_settle() -> None:
    time = np.linspace(0.0, 1.0, 500)
    assert grows(0.001 * np.exp(time) * np.sin(50.0 * time), 0.0)
    assert not grows(0.001 * np.exp(-time) * np.sin(50.0 * time), 0.0)
    assert not grows(0.001 * np.exp(time) * np.sin(50.0 * time), 0.002), "that is inside of 3 counts"


def test_an_unstable_loop_is_named_with_its_margin_and_never_settles() -> None:
    # A velocity loop of 20/s cannot carry a position loop of 400/s with a delay of 2 ms.
    trace = STEP(tiny(gain=400.0, velocity_rate=400.0, delay=0.002, excess=1e6), {"move.feedrate": 60.0})
    alarm = trace.alarms[0]
    assert alarm.code == "UNSTABLE"
    assert "is not stable: -" in alarm.message
    assert "dB gain margin" in alarm.message
    assert trace.result["settle_time"] == (None, "s")
    assert trace.result["steady_following_error"] == (None, "mm")


def test_an_axis_that_settles_shows_when_and_stays_there() -> None:
    trace = STEP(tiny(), {})
    at = trace.result["in_position_time"][0]
    assert at is not None
    after = trace.columns["time_s"] >= at
    assert np.max(np.abs(trace.columns["measured_position"][after] - 80.0)) <= 0.011
    assert trace.result["settle_time"][0] == pytest.approx(at - 1.0, abs=0.002)


def test_a_suppressed_feedrate_delays_the_end_of_the_command_not_the_settling(mill: ParameterFile) -> None:
    mill.set(
        mill.find("servo.feedrate_suppression@1"), mill.read(mill.find("servo.feedrate_suppression@1"), "8")
    )
    trace = simulate(mill, "step", "1")
    end = trace.columns["time_s"][np.flatnonzero(np.diff(trace.columns["command_position"]))[-1]]
    in_position, settle = trace.result["in_position_time"][0], trace.result["settle_time"][0]
    assert settle == pytest.approx(in_position - end, abs=0.003)


def test_a_sound_file_leaves_no_doubt(mill: ParameterFile) -> None:
    assert simulate(mill, "step", "1").doubts == ()


def test_a_value_outside_its_range_is_shown_with_the_result(mill: ParameterFile) -> None:
    offset = mill.find("servo.torque_offset@1")
    mill.values[offset] = type(mill.get(offset))(900.0, mill.get(offset).unit)
    trace = simulate(mill, "step", "1", {"move.duration": 0.05})
    assert any("is outside" in doubt for doubt in trace.doubts), trace.doubts
    assert trace_summary(trace)["doubts"] == list(trace.doubts)
    assert f"DOUBTFUL: {trace.doubts[0]}" in trace_text(trace)


def test_a_file_with_errors_elsewhere_is_shown_too(mill: ParameterFile) -> None:
    other = mill.find("servo.initial_gain@3")
    mill.values[other] = type(mill.get(other))(900.0, mill.get(other).unit)
    (doubt,) = simulate(mill, "step", "1", {"move.duration": 0.05}).doubts
    assert "other error" in doubt


def test_a_value_that_is_not_set_is_shown_where_the_axis_would_have_used_it(mill: ParameterFile) -> None:
    mill.set(mill.find("servo.torque_offset@1"), None)
    (doubt,) = simulate(mill, "step", "1", {"move.duration": 0.05}).doubts
    assert doubt.startswith("Not set, and simulated as if there were none: 1690 Torque Offset Percentage")


@pytest.mark.parametrize(
    ("setting", "value"),
    [
        ("model.acceleration_per_output", 1e300),
        ("model.acceleration_per_output", 1e-300),
        ("model.acceleration_per_output", -1.0),
        ("model.acceleration_per_output", float("nan")),
        ("model.inertia_ratio", 1e300),
        ("model.viscous_friction", 1e12),
        ("model.coulomb_friction", float("inf")),
        ("model.resonance", 1e9),
        ("model.delay", 1e9),
        ("model.damping", 1e300),
        ("model.backlash", 1e300),
        ("model.gravity", 1e300),
        ("model.spring", 1e300),
        ("model.current_bandwidth", 1e-300),
        ("move.distance", 1e300),
        ("move.distance", 1e-300),
        ("move.feedrate", 1e300),
        ("move.feedrate", 1e-300),
        ("move.feedrate", 0.0),
        ("move.duration", 1e9),
        ("move.duration", 0.0),
        ("move.distance", "far"),
        ("move.blocks", 1.5),
        ("move.colour", 1.0),
        ("move.override", 50.0),
    ],
)
@pytest.mark.filterwarnings("error")
def test_absurd_input_gets_a_sentence_or_finite_figures(
    mill: ParameterFile, setting: str, value: float | str
) -> None:
    sentence, finite = "", True
    try:
        trace = simulate(mill, "step", "1", {setting: value})
    except SimulationError as error:
        sentence = str(error)
    else:
        figures = [figure for figure, _ in trace.result.values() if figure is not None]
        finite = all(np.isfinite(each).all() for each in (*trace.columns.values(), figures))
    assert finite
    assert sentence == "" or (len(sentence) > 20 and "\n" not in sentence and "nan" not in sentence[:5])


@pytest.mark.parametrize(
    ("scenario", "settings"),
    [
        ("step", {}),
        ("velocity", {}),
        ("frequency", {"move.points": 2.0, "move.lowest": 10.0, "move.highest": 40.0}),
        ("circle", {}),
    ],
)
def test_an_axis_whose_friction_is_above_the_torque_limit_is_shown_not_to_move(
    scenario: str, settings: dict[str, float]
) -> None:
    stuck = tiny(coulomb_friction=120.0, torque_limit_positive=100.0, torque_limit_negative=100.0)
    alarm = SCENARIOS[scenario].run(stuck, settings).alarms[0]
    assert alarm.code == "NO MOTION"
    assert alarm.message.startswith(
        "Axis 1 does not move: its friction at rest is 120 %, and the torque was at most"
    )


def test_a_move_that_friction_hardly_hinders_and_an_axis_that_falls_have_no_such_alarm() -> None:
    assert STEP(tiny(coulomb_friction=5.0), {}).alarms == ()
    inside = STEP(tiny(coulomb_friction=20.0), {"move.distance": 0.005})
    assert not np.any(inside.columns["velocity"]), "the test needs an axis that stays where it is"
    assert inside.alarms == (), "and is in position there"


def test_an_inertia_ratio_without_two_masses_is_refused(mill: ParameterFile) -> None:
    for rigid in ({}, {"model.resonance": 0.0}):
        with pytest.raises(SimulationError, match=r"give model\.resonance or model\.backlash too"):
            simulate(mill, "step", "1", {"model.inertia_ratio": 3.0, **rigid})
    given = {"model.inertia_ratio": 3.0, "model.resonance": 80.0, "move.duration": 0.05}
    simulate(mill, "step", "1", given, advise=False)


@pytest.mark.parametrize("scenario", some(["step", "velocity", "frequency", "circle", "home", "travel"], 2))
def test_other_values_make_the_same_move_where_they_are_compared(mill: ParameterFile, scenario: str) -> None:
    # from a tenth of the bandwidth on, a sweep takes seconds
    few = {"move.points": 3, "move.lowest": 20.0} if scenario == "frequency" else {}
    before = mill.copy()
    mill.set(("servo.initial_gain", "1"), Value(0.4))
    mill.set(("feedrate.rapid", "1"), Value(4000.0, "mm/min"))
    mill.set(("home.g28_speed", "1"), Value(500.0, "mm/min"))
    after = simulate(mill, scenario, "1", few, advise=False)
    assert simulate(before, scenario, "1", few, advise=False).move != after.move
    assert simulate(before, scenario, "1", few, advise=False, like=after).move == after.move
