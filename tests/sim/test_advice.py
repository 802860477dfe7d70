"""Recommendations leave a sound axis, name their price, and never raise a gain on a guessed machine."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import pytest

from amp_studio.files import open_file
from amp_studio.schema import Value
from amp_studio.sim import AxisLaw, Recommendation, Source, address_of, simulate
from amp_studio.sim.tuning.advice import recommendations, stable_inertias
from amp_studio.sim.tuning.aims import NORMAL
from amp_studio.sim.tuning.linear import linear_model, velocity_model
from amp_studio.sim.tuning.loops import Loops
from amp_studio.sim.tuning.solver import solve
from tests.campaigns import CAMPAIGN
from tests.sim.tiny import changed, tiny

EXAMPLES = Path(__file__).parents[2] / "examples"


class TinyTrial:
    """A tiny axis whose two gains are parameters of a file."""

    def __init__(self, *, assumed: bool = False, **figures: float) -> None:
        self._figures = {"gain": 20.0, "velocity_rate": 200.0, **figures}
        self._assumed = assumed
        self.axis = self._axis(self._figures)

    def _axis(self, figures: Mapping[str, float]) -> AxisLaw:
        axis = tiny(**figures)
        sources = {"position_gain": Source("gain", page="1-1"), "velocity_gain": Source("velocity_rate")}
        gains = ("velocity_gain", "position_gain")
        return replace(axis, sources=sources, gains=gains, assumed=axis.assumed if self._assumed else {})

    def value(self, parameter: str) -> Value | None:
        return Value(self._figures[parameter])

    def bound(self, numbers: Mapping[str, float]) -> AxisLaw | None:
        return self._axis({**self._figures, **numbers})

    def range_of(self, _parameter: str) -> tuple[float | None, float | None]:
        return 0.0, 20_000.0

    def called(self, parameter: str) -> str:
        return parameter

    def decimals(self, _parameter: str) -> int | None:
        return 3


def recommended(trial: TinyTrial, scenario: str) -> dict[str, Recommendation]:
    return {each.parameter: each for each in recommendations(trial, scenario)[0]}


def test_a_sound_axis_gets_no_recommendation_after_a_move() -> None:
    assert recommendations(TinyTrial(), "step") == ((), ())


@pytest.mark.parametrize("gain", [300.0, 2500.0])
def test_too_high_a_position_gain_is_lowered_to_where_the_axis_is_sound(gain: float) -> None:
    trial = TinyTrial(gain=gain, assumed=True)
    found = recommended(trial, "frequency")
    values = {name: each.value for name, each in found.items()}
    assert 20.0 < values["gain"] < gain
    assert values == dict(solve(trial, NORMAL).to_change)  # the gains of tune, and no others
    assert Loops(trial.bound(values)).sound()
    assert found["gain"].price.startswith("The following error at the rapid feedrate grows from ")
    assert "page 1-1" in found["gain"].why


def test_a_move_names_a_loop_that_is_not_sound_and_who_finds_gains() -> None:
    found, notes = recommendations(TinyTrial(gain=300.0, assumed=True), "step")
    assert found == ()
    assert notes[0].startswith("The position loop has too little margin: Ms ")
    assert notes[0].endswith("The scenario tune finds gains.")


def test_a_velocity_loop_that_is_not_stable_is_mended_with_all_around_it() -> None:
    trial = TinyTrial(velocity_rate=1200.0, delay=0.0013, assumed=True)
    found = recommended(trial, "step")
    assert "velocity loop is not stable" in found["velocity_rate"].why
    values = {name: each.value for name, each in found.items()}
    assert Loops(trial.bound(values)).sound()
    assert found["velocity_rate"].value < 1200.0


def test_a_gain_that_is_raised_on_an_assumed_machine_is_named_a_choice() -> None:
    trial = TinyTrial(gain=50.0, velocity_rate=20.0, assumed=True)
    trial.range_of = lambda parameter: (45.0 if parameter == "gain" else 0.0, 20_000.0)
    found = recommended(trial, "frequency")
    assert found["velocity_rate"].value > 20.0
    assert found["velocity_rate"].price.endswith("your choice.")


@pytest.mark.skipif(not CAMPAIGN, reason="3 s: make campaign; test_solver.py applies what tune recommends")
def test_applied_recommendations_make_a_file_sound_again() -> None:
    """AcroMill's example sampled more slowly: no single gain is enough."""
    file = open_file(EXAMPLES / "acromill-router" / "ROUTER.amp").file
    file.set(file.find("tuning.servo_period"), Value(500, "us"))
    before = simulate(file, "frequency", "X", {"move.points": 2})
    assert [alarm.code for alarm in before.alarms] == ["UNSTABLE"]
    assert {each.parameter for each in before.recommendations} >= {"servo.p_gain", "servo.d_gain"}
    for each in before.recommendations:
        file.set(address_of(file, each.parameter, "X"), Value(each.value, each.unit))
    after = simulate(file, "frequency", "X", {"move.points": 2})
    assert after.alarms == after.recommendations == ()
    assert after.result["gain_margin"][0] > 8.0


def test_the_inertia_that_an_axis_bears_is_the_margin_of_its_velocity_loop() -> None:
    """A lighter axis is a higher velocity gain: the loop ends where its gain margin does."""
    axis = tiny(velocity_rate=800.0, delay=0.0004)
    least, most = stable_inertias(axis)
    assert least == pytest.approx(10 ** (-velocity_model(axis).margins().gain / 20), rel=0.03)
    assert most == 16.0
    assert linear_model(changed(axis, acceleration_per_output=50.0 / (1.05 * least))).is_stable()
    assert not linear_model(changed(axis, acceleration_per_output=50.0 / (0.95 * least))).is_stable()


def test_the_inertia_is_none_of_the_matter_of_a_drive_with_a_velocity_loop() -> None:
    assert stable_inertias(tiny(velocity_per_output=10.0, velocity_bandwidth=50.0)) is None


def test_frequency_and_tune_both_recommend_nothing_where_a_gain_has_the_wrong_sign() -> None:
    file = open_file(EXAMPLES / "57c422b-label-press/LABEL_PRESS.amp").file
    gain = file.get(("gain.velocity", "X"))
    assert gain is not None
    file.set(("gain.velocity", "X"), Value(-gain.value, gain.unit))
    for scenario in ("frequency", "tune"):
        trace = simulate(file, scenario, "X", {}, "metric")
        assert trace.recommendations == (), scenario
        # A grid over both signs finds sound gains: the sentence does not deny it.
        assert any("the other one is not tried" in each for each in trace.assumptions), scenario
