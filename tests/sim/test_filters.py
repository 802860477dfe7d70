"""Filters as unknowns of the solver: which settings are tried, and what a count does behind a filter.

``make campaign`` lets the solver set a notch; ``make tunings`` searches 300 machines on a grid with other
filters.
"""

import math
from pathlib import Path

import numpy as np
import pytest

from amp_studio.files import ParameterFile, open_file
from amp_studio.schema import Value
from amp_studio.sim import AxisLaw, linear_model, simulate
from amp_studio.sim.binding import bind_axis
from amp_studio.sim.law import law_of
from amp_studio.sim.tuning.filters import Filters
from amp_studio.sim.tuning.linear import LawMatrices
from amp_studio.sim.tuning.trial import Trial, address_of
from tests.campaigns import CAMPAIGN

EXAMPLES = Path(__file__).parents[2] / "examples"
ROUTER, MILL = EXAMPLES / "acromill-router/ROUTER.amp", EXAMPLES / "mill-1394/MILL_1394.amp"
RESONANT = {"model.resonance": 150.0, "model.inertia_ratio": 1.0, "model.damping": 0.03}


def trial_of(path: Path, axis: str, model: dict[str, float] | None = None) -> Trial:
    file = open_file(path).file
    law = law_of(file.schema.family.family)
    return Trial(file, lambda other: bind_axis(other, law, axis, model or {}))


def test_a_notch_is_tried_at_a_resonance_that_is_known_and_nowhere_else() -> None:
    rigid, resonant = (Filters(trial_of(ROUTER, "X", model)) for model in ({}, RESONANT))
    notched = [
        dict(each) for each in resonant.others(resonant.present) if dict(each)["tuning.notch_frequency"]
    ]
    assert {each["tuning.notch_frequency"] for each in notched} == {150.0, 135.0, 168.0}
    assert all(1.0 <= each["tuning.notch_width"] <= each["tuning.notch_frequency"] for each in notched)
    assert rigid.is_resonance_known is False
    assert all(dict(each)["tuning.notch_frequency"] is None for each in rigid.others(rigid.present))


def test_every_setting_that_is_tried_is_one_that_the_control_can_have() -> None:
    """A cutoff of LOPASS is at most a tenth of the servo update frequency (page 128), a torque filter 10 to
    10000 Hz (7-69).
    """
    for path, axis, name, low, high in (
        (ROUTER, "X", "tuning.lopass_frequency", 1.0, 250.0),
        (MILL, "1", "servo.torque_filter", 40.0, 10000.0),
    ):
        trial = trial_of(path, axis, RESONANT)
        filters = Filters(trial)
        tried = {dict(each)[name] for each in filters.others(filters.present)} - {None}
        assert len(tried) > 5
        assert all(low <= each <= high for each in tried)
        setting = {key: value for key, value in filters.others(filters.present)[0] if value is not None}
        bound = trial.bound(setting)
        assert bound is not None
        assert linear_model(bound).period == linear_model(trial.axis).period


def jolt(axis: AxisLaw) -> float:
    return LawMatrices.of(axis).jolt()


def test_a_count_behind_a_low_pass_moves_the_output_less_but_later() -> None:
    """Against the law itself, sample by sample."""
    trial = trial_of(ROUTER, "X")
    sharp, smooth = trial.axis, trial.bound({"tuning.lopass_frequency": 150.0})
    assert smooth is not None
    law = LawMatrices.of(smooth)
    z, seen = np.zeros((len(law.position), 1)), []
    for _ in range(40):
        z[[law.places.signals["position"], law.places.signals["motor"]]] = 1.0
        z = law.position @ z
        seen.append(abs(float(z[law.places.signals["output"], 0])))
    assert max(seen) == pytest.approx(jolt(smooth))
    assert seen[0] < 0.2 * jolt(smooth)
    assert 0.2 * jolt(sharp) < jolt(smooth) < jolt(sharp)
    assert math.isfinite(jolt(smooth))


def applied(file: ParameterFile, axis: str, settings: dict[str, float | str]) -> list[str]:
    trace = simulate(file, "tune", axis, settings)
    for each in trace.recommendations:
        address = address_of(file, each.parameter, trace.axis)
        file.set(address, Value(each.value, each.unit))
    return [each.parameter for each in trace.recommendations]


@pytest.mark.skipif(not CAMPAIGN, reason="searches with several filters, ten seconds; make campaign")
def test_a_resonant_axis_gets_its_notch_and_a_second_run_has_nothing_to_add() -> None:
    file = open_file(ROUTER).file
    assert {"tuning.notch_frequency", "tuning.notch_width"} <= set(applied(file, "X", {**RESONANT}))
    assert applied(file, "X", {**RESONANT}) == []
    assert simulate(file, "frequency", "X", {**RESONANT, "move.points": 2}).recommendations == ()
