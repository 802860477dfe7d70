"""A law as a family writes one runs over the shared kernel."""

import numpy as np
import pytest

from amp_studio.sim.axis.motion import RunEnd, run_axis
from amp_studio.sim.command.ramps import move
from amp_studio.sim.scenarios import SCENARIOS
from tests.campaigns import CAMPAIGN
from tests.sim.tiny import tiny


def test_a_proportional_loop_follows_at_the_velocity_over_its_gain() -> None:
    trace = SCENARIOS["step"].run(tiny(), {"move.feedrate": 6000.0, "move.distance": 80.0})
    steady, unit = trace.result["steady_following_error"]
    assert (steady, unit) == (pytest.approx(5.0, rel=2e-3), "mm")
    assert trace.result["overshoot"] == (0.0, "mm")


def test_an_alarm_of_the_law_ends_the_run_and_is_named() -> None:
    trace = SCENARIOS["step"].run(tiny(excess=4.0), {"move.feedrate": 6000.0})
    (alarm,) = trace.alarms
    assert alarm.code == "EXCESS ERROR"
    assert trace.columns["following_error"][trace.columns["time_s"] == alarm.time_s] == pytest.approx(
        4.0, abs=0.1
    )
    assert trace.result["settle_time"][0] is None


@pytest.mark.skipif(not CAMPAIGN, reason="seven seconds of compiling; test_engines.py has a law of a family")
def test_machine_code_and_plain_python_give_the_same_numbers() -> None:
    axis = tiny(
        inertia_ratio=2.0,
        viscous_friction=0.01,
        coulomb_friction=1.0,
        static_friction=2.0,
        motor_friction=0.3,
        backlash=0.01,
        resonance=80.0,
        gravity=1.5,
        spring=0.01,
        bandwidth=300.0,
        delay=0.0003,
        torque_limit_positive=15.0,
        torque_limit_negative=12.0,
        load_sensor=True,
        motor_count=0.0005,
    )
    profile = move(4.0, 100.0, axis.ramps["linear"])
    runs = [run_axis(axis, profile, RunEnd(0.25), engine=engine) for engine in ("plain", "compiled")]
    assert len(runs[0].columns["time_s"]) == 1000
    for name, column in runs[0].columns.items():
        np.testing.assert_allclose(column, runs[1].columns[name], rtol=1e-9, atol=1e-9, err_msg=name)
