"""Recommendations leave a sound axis, name their price, and never raise a gain on a guessed machine."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import pytest

from amp_studio.files import open_file
from amp_studio.schema import Value
from amp_studio.sim import AxisLaw, Source, address_of, simulate
from amp_studio.sim.advice import Loops, recommend, stable_inertias
from amp_studio.sim.linear import LinearModel, Margins, linear_model, velocity_model
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
        return replace(axis, sources=sources, assumed=axis.assumed if self._assumed else {})

    def value(self, parameter: str) -> Value | None:
        return Value(self._figures[parameter])

    def bound(self, numbers: Mapping[str, float]) -> AxisLaw | None:
        return self._axis({**self._figures, **numbers})


def test_a_sound_axis_gets_no_recommendation_after_a_move() -> None:
    assert recommend(TinyTrial(), "step") == ()


@pytest.mark.parametrize("gain", [150.0, 300.0, 2500.0])
def test_too_high_a_position_gain_is_lowered_to_where_the_axis_is_sound(gain: float) -> None:
    trial = TinyTrial(gain=gain, assumed=True)
    (found,) = recommend(trial, "step")
    assert found.parameter == "gain"
    assert 60.0 < found.value < gain
    assert Loops(trial.bound({"gain": found.value})).sound()
    assert not Loops(trial.bound({"gain": found.value * 1.1})).sound()
    assert found.price.startswith("The following error at the rapid feedrate grows from ")
    assert "page 1-1" in found.why


def test_a_velocity_loop_that_is_not_stable_is_mended_first() -> None:
    trial = TinyTrial(velocity_rate=1200.0, delay=0.0013, assumed=True)
    (found,) = recommend(trial, "step")
    assert found.parameter == "velocity_rate"
    assert "velocity loop is not stable" in found.why
    assert Loops(trial.bound({"velocity_rate": found.value})).inner_sound()


def test_on_a_known_machine_the_smaller_change_may_be_to_raise_the_velocity_gain() -> None:
    (found,) = recommend(TinyTrial(gain=100.0, velocity_rate=150.0), "step")
    assert (found.parameter, found.value > 150.0) == ("velocity_rate", True)
    assert found.price.startswith("Every count of the feedback moves the output ")


def test_on_an_assumed_machine_no_gain_is_raised() -> None:
    for scenario in ("step", "frequency"):
        for figures in ({"gain": 100.0, "velocity_rate": 150.0}, {"gain": 5.0}):
            trial = TinyTrial(assumed=True, **figures)
            assert all(each.value < trial.value(each.parameter).value for each in recommend(trial, scenario))


def test_a_reserve_is_shown_after_a_sweep_of_a_known_machine_with_its_price() -> None:
    trial = TinyTrial(gain=5.0)
    (found,) = recommend(trial, "frequency")
    assert found.value == 40.0
    assert "reserve" in found.why
    assert found.price
    assert Loops(trial.bound({"gain": found.value})).sound(60.0, 10.0, 0.7)


def test_applied_recommendations_make_a_file_sound_again() -> None:
    """AcroMill's example sampled more slowly: no single gain is enough, all of them in proportion are."""
    file = open_file(EXAMPLES / "acromill-router" / "ROUTER.amp").file
    file.set(file.find("tuning.servo_period"), Value(500, "us"))
    before = simulate(file, "frequency", "X")
    assert [alarm.code for alarm in before.alarms] == ["UNSTABLE"]
    assert {each.parameter for each in before.recommendations} >= {"servo.p_gain", "servo.d_gain"}
    for each in before.recommendations:
        file.set(address_of(file, each.parameter, "X"), Value(each.value, each.unit))
    after = simulate(file, "frequency", "X")
    assert after.alarms == ()
    assert after.result["gain_margin"][0] > 4.0


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


def test_margins_are_computed_for_stable_values_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    # 100 samples of delay are 100 states: the margins of each value that was tried took 3 s.
    counted: list[int] = []
    computed = LinearModel.margins

    def margins(model: LinearModel, *points: int) -> Margins:
        counted.append(1)
        return computed(model, *points)

    monkeypatch.setattr(LinearModel, "margins", margins)
    file = open_file(EXAMPLES / "mill-1394" / "MILL_1394.amp").file
    trace = simulate(file, "step", "1", {"model.delay": 100, "move.duration": 0.1})
    assert trace.alarms[0].code == "UNSTABLE"
    assert len(counted) <= 6
