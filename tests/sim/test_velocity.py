"""The scenario velocity: a step of the velocity command on the velocity loop alone."""

import math

import pytest

from amp_studio.sim import SimulationError
from amp_studio.sim.scenarios import SCENARIOS
from tests.sim.tiny import tiny

VELOCITY = SCENARIOS["velocity"].run


def test_a_first_order_velocity_loop_rises_as_its_rate_shows() -> None:
    # 10 to 90 % of a first-order lag of 200/s: ln 9 / 200 = 11 ms.
    trace = VELOCITY(tiny(), {"move.feedrate": 600.0})
    assert trace.result["rise_time"][0] == pytest.approx(math.log(9.0) / 200.0, rel=0.1)
    assert trace.result["steady_velocity"] == (pytest.approx(600.0, rel=1e-6), "mm/min")
    assert trace.result["overshoot"] == (pytest.approx(0.0, abs=1e-9), "%")
    assert "following_error" not in trace.columns


def test_a_lag_that_is_too_long_for_the_gain_is_an_unstable_velocity_loop() -> None:
    trace = VELOCITY(tiny(velocity_rate=2000.0, delay=0.002), {"move.feedrate": 600.0})
    assert trace.alarms[0].code == "UNSTABLE"
    assert trace.result["settle_time"] == (None, "s")
    assert trace.result["swing_at_speed"][0] > 60.0


def test_friction_leaves_a_proportional_loop_short_of_its_command() -> None:
    # 5 % of friction at 4 % for 1 mm/s of velocity error.
    trace = VELOCITY(tiny(coulomb_friction=5.0), {"move.feedrate": 600.0})
    assert trace.result["steady_velocity"][0] == pytest.approx(600.0 - 60.0 * 5.0 / 4.0, rel=1e-4)
    assert trace.result["settle_time"] == (None, "s")


def test_a_setting_it_does_not_have_is_refused() -> None:
    with pytest.raises(SimulationError, match=r"move\.distance"):
        VELOCITY(tiny(), {"move.distance": 5.0})
