"""The torque limits hold at every moment, and friction costs torque."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from amp_studio.sim.rigid.servo import AxisServo
from amp_studio.sim.rigid.step import StepMove, run_step

Axis = Callable[..., AxisServo]


@pytest.mark.parametrize(("positive", "negative"), [(200.0, 200.0), (50.0, 20.0), (5.0, 300.0)])
@pytest.mark.parametrize("distance", [200.0, -200.0])
def test_the_torque_stays_between_its_limits(
    axis: Axis, positive: float, negative: float, distance: float
) -> None:
    # Pages 7-61 and 7-62.
    servo = axis(torque_limit_positive=positive, torque_limit_negative=negative, linear_acceleration=0.0)
    torque = run_step(servo, StepMove(distance, 10000.0)).columns["torque_percent"]
    assert torque.max() <= positive
    assert torque.min() >= -negative


def test_a_cut_torque_gives_exactly_the_acceleration_it_can(axis: Axis) -> None:
    servo = axis(torque_limit_positive=10.0, linear_acceleration=0.0, velocity_rate=2000.0)
    trace = run_step(servo, StepMove(400.0, 10000.0, duration=0.1))
    # 10 % of 5000 mm/s2 from the first servo period on, one period after the command has started.
    late = trace.columns["time_s"] >= 0.002
    speed = trace.columns["velocity"][late] / 60.0
    time = trace.columns["time_s"][late]
    assert np.polyfit(time, speed, 1)[0] == pytest.approx(500.0, rel=1e-3)
    assert trace.result["time_at_torque_limit"][0] == pytest.approx(0.099, abs=0.001)


def test_a_steady_ramp_asks_for_the_torque_of_its_acceleration(axis: Axis) -> None:
    # 500 mm/s2 of 5000 mm/s2 are 10 % once the axis follows the ramp.
    servo = axis(velocity_rate=60.0, ideal_feedback=True, servo_period=0.25)
    trace = run_step(servo, StepMove(400.0, 20000.0))
    time = trace.columns["time_s"]
    inside = (time > 0.5) & (time < 0.6)
    assert trace.columns["torque_percent"][inside] == pytest.approx(10.0, rel=1e-2)


def test_friction_asks_for_its_torque_at_a_steady_speed(axis: Axis) -> None:
    # 4 % dry and 3 % at 1000 mm/min: 4 + 3 x 6 = 22 % at 6000 mm/min.
    servo = axis(coulomb_friction=4.0, viscous_friction=3.0, ideal_feedback=True, integral_rate=2.0)
    trace = run_step(servo, StepMove(400.0, 6000.0))
    time = trace.columns["time_s"]
    inside = (time > 3.0) & (time < 3.5)
    assert trace.columns["torque_percent"][inside] == pytest.approx(22.0, rel=1e-2)


def test_without_an_integral_friction_makes_the_axis_follow_further_behind(axis: Axis) -> None:
    # The velocity loop needs an error of friction / kp, and the position loop that over its gain.
    servo = axis(coulomb_friction=4.0, ideal_feedback=True)
    error = run_step(servo, StepMove(400.0, 6000.0)).result["steady_following_error"][0]
    more = 0.04 * 5000.0 / servo.velocity_rate / servo.position_rate
    assert error == pytest.approx(6.0 + more, rel=1e-4)


def test_dry_friction_holds_the_axis_short_of_the_end_and_does_not_chatter(axis: Axis) -> None:
    # Without an integral the axis comes to rest where the torque asked for is the friction:
    # friction / (kp Kv) = 200 / (200 x 16.67) = 0.06 mm before the end.
    servo = axis(coulomb_friction=4.0, ideal_feedback=True, inposition_band=0.0)
    trace = run_step(servo, StepMove(50.0, 6000.0))
    assert 50.0 - trace.columns["position"][-1] == pytest.approx(0.06, rel=1e-3)
    assert (np.diff(trace.columns["position"]) >= 0.0).all()
    assert trace.columns["torque_percent"][-400:] == pytest.approx(4.0, rel=1e-3)


def test_an_integral_brings_the_axis_home_against_friction(axis: Axis) -> None:
    band = 0.02
    stuck, free = (axis(coulomb_friction=4.0, integral_rate=ki, inposition_band=band) for ki in (0.0, 5.0))
    assert run_step(stuck, StepMove(50.0, 6000.0)).result["in_position_time"][0] is None
    assert run_step(free, StepMove(50.0, 6000.0)).result["in_position_time"][0] is not None


def test_the_sum_of_the_velocity_error_does_not_wind_up_while_the_torque_is_cut(axis: Axis) -> None:
    weak = axis(
        torque_limit_positive=10.0, torque_limit_negative=200.0, linear_acceleration=0.0, integral_rate=10.0
    )
    strong = axis(linear_acceleration=0.0, integral_rate=10.0)
    over = [run_step(s, StepMove(300.0, 6000.0)).result["overshoot"][0] or 0.0 for s in (weak, strong)]
    assert over[0] <= over[1] + 0.05
