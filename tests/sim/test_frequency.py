"""A swept sine on the simulated axis and the linear model of its law say the same."""

from math import isfinite

import numpy as np
import pytest

from amp_studio.sim import SimulationError, Trace
from amp_studio.sim.scenarios import SCENARIOS
from amp_studio.sim.scenarios.sweep import Tone, sweep
from amp_studio.sim.tuning.linear import linear_model
from amp_studio.sim.tuning.loops import Loops
from tests.sim.tiny import tiny


@pytest.fixture(scope="module")
def elastic() -> Trace:
    """An axis with everything that a linear model has: two masses, a lag, a delay, a scale at the load."""
    axis = tiny(
        gain=30.0,
        resonance=60.0,
        inertia_ratio=2.0,
        bandwidth=300.0,
        delay=0.0004,
        viscous_friction=0.02,
        load_sensor=True,
        position_count=0.0001,
    )
    return SCENARIOS["frequency"].run(axis, {})


def test_the_swept_axis_is_its_linear_model_at_every_frequency(elastic: Trace) -> None:
    for loop in ("closed", "open"):
        apart = np.abs(elastic.columns[f"{loop}_gain_db"] - elastic.columns[f"{loop}_gain_db_model"])
        turned = np.abs(elastic.columns[f"{loop}_phase_deg"] - elastic.columns[f"{loop}_phase_deg_model"])
        assert np.count_nonzero(np.isfinite(apart)) > 24
        assert np.nanmax(apart) < 0.12
        assert np.nanmax(turned) < 0.8


@pytest.mark.parametrize(
    ("figure", "near"), [("bandwidth", 0.005), ("phase_margin", 0.005), ("gain_margin", 0.01)]
)
def test_the_swept_figures_are_those_of_the_model(elastic: Trace, figure: str, near: float) -> None:
    assert elastic.result[f"swept_{figure}"][0] == pytest.approx(elastic.result[figure][0], rel=near)


def test_an_unstable_loop_is_called_so_with_its_margin_and_not_swept() -> None:
    trace = SCENARIOS["frequency"].run(tiny(gain=2500.0), {})
    (alarm,) = trace.alarms
    assert alarm.code == "UNSTABLE"
    assert "position loop is not stable: an oscillation of 111 Hz" in alarm.message
    assert trace.result["gain_margin"] == (pytest.approx(-1.762, abs=0.01), "dB")
    assert trace.result["bandwidth"][0] is None
    assert not np.isfinite(trace.columns["closed_gain_db"]).any()


def test_an_unstable_velocity_loop_is_named_and_its_margin_given() -> None:
    trace = SCENARIOS["frequency"].run(tiny(velocity_rate=1200.0, delay=0.0013), {})
    assert "velocity loop is not stable" in trace.alarms[0].message
    assert trace.result["gain_margin"][0] < 0.0


def test_feed_forward_changes_what_follows_but_not_the_margins() -> None:
    plain, ahead = tiny(gain=60.0), tiny(gain=60.0, forward=1.0)
    assert linear_model(ahead).margins() == linear_model(plain).margins()
    assert linear_model(ahead).bandwidth() > 3 * linear_model(plain).bandwidth()
    trace = SCENARIOS["frequency"].run(ahead, {"move.points": 2.0, "move.lowest": 5.0, "move.highest": 40.0})
    assert trace.result["swept_phase_margin"][0] == pytest.approx(trace.result["phase_margin"][0], rel=0.01)
    assert any("feed-forward off" in note for note in trace.assumptions)


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"move.highest": 900.0}, "500 Hz at most"),
        ({"move.lowest": 90.0, "move.highest": 20.0}, "below 20 Hz"),
        ({"move.lowest": -1.0}, "above 0"),
        ({"move.lowest": 1e-5}, "Raise move.lowest"),
        ({"move.points": 2.5}, "whole number"),
        ({"move.amplitude": float("nan")}, "finite"),
        ({"move.feedrate": 100.0}, "Unknown setting"),
    ],
)
def test_an_impossible_sweep_is_one_sentence(settings: dict[str, float], words: str) -> None:
    with pytest.raises(SimulationError, match=words):
        SCENARIOS["frequency"].run(tiny(), settings)


def test_every_figure_is_a_number_or_nothing(elastic: Trace) -> None:
    assert all(value is None or isfinite(value) for value, _ in elastic.result.values())


def test_an_answer_below_half_a_count_is_no_point_of_the_sweep() -> None:
    # At 0.4 counts the device measures nothing at all, which would be a gain of minus 240 dB.
    axis = tiny(position_count=0.01)
    found = sweep(axis, [Tone(1.0, 0.004, 0.0, 1.0, 2.0), Tone(1.0, 0.4, 2.0, 3.0, 4.0)])
    assert np.isnan(found.measured[0])
    assert abs(found.measured[1]) == pytest.approx(1.0, abs=0.3)


def test_an_axis_that_never_answers_with_more_than_its_command_has_no_resonance_peak() -> None:
    sweep = SCENARIOS["frequency"].run
    few = {"move.points": 2.0, "move.highest": 90.0}
    assert sweep(tiny(), few).result["resonance_peak"] == (None, "dB")
    peak = sweep(tiny(gain=120.0), few).result["resonance_peak"][0]
    assert peak > 0.2
    assert sweep(tiny(gain=120.0), {**few, "move.lowest": 60.0}).result["resonance_peak"][0] == peak, (
        "of the loop, not of the part of it that is drawn"
    )


def test_the_damping_ratio_is_that_of_the_position_loop_and_the_least_one_has_its_own_name() -> None:
    axis = tiny(resonance=60.0, damping=0.05, inertia_ratio=0.2)
    few = {"move.points": 2.0, "move.lowest": 10.0, "move.highest": 40.0}
    result = SCENARIOS["frequency"].run(axis, few).result
    assert result["damping_ratio"][0] == Loops(axis).damping
    assert result["least_damping_ratio"][0] < 0.3 < result["damping_ratio"][0]
