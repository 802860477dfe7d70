"""Following error: what the manual's equations predict is what the simulated axis does."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from amp_studio.sim import Trace
from amp_studio.sim.rigid.laws import (
    excess_error_wanted,
    gain_break_wanted,
    response_ramp,
    response_time,
    steady_following_error,
)
from amp_studio.sim.rigid.servo import AxisServo
from amp_studio.sim.rigid.step import StepMove, run_step

Axis = Callable[..., AxisServo]


def figure(trace: Trace, name: str) -> float:
    value = trace.result[name][0]
    assert value is not None, f"{name} was not reached"
    return value


@pytest.mark.parametrize(
    ("gain", "per_feedrate"), [(0.25, 0.0040), (0.5, 0.0020), (1.0, 0.0010), (2.0, 0.0005)]
)
@pytest.mark.parametrize("feedrate", [1000.0, 4000.0])
def test_steady_following_error_is_that_of_table_7a(
    axis: Axis, gain: float, per_feedrate: float, feedrate: float
) -> None:
    # Table 7.A, page 7-25: following error in mm for each mm/min.
    servo = axis(position_gain=gain)
    assert steady_following_error(servo, feedrate) == pytest.approx(per_feedrate * feedrate, rel=1e-12)
    trace = run_step(servo, StepMove(distance=feedrate / 60.0 * 4.0, feedrate=feedrate))
    assert figure(trace, "predicted_following_error") == pytest.approx(per_feedrate * feedrate, rel=1e-12)
    assert figure(trace, "steady_following_error") == pytest.approx(per_feedrate * feedrate, abs=servo.count)


@pytest.mark.parametrize("direction", [1.0, -1.0])
@pytest.mark.parametrize("period", [1.0, 4.0, 30.0])
def test_the_servo_period_and_the_direction_do_not_change_it(
    axis: Axis, direction: float, period: float
) -> None:
    servo = axis(servo_period=period, position_gain=0.5)
    trace = run_step(servo, StepMove(direction * 200.0, 3000.0))
    assert figure(trace, "steady_following_error") == pytest.approx(6.0, abs=servo.count)
    assert trace.columns["following_error"][len(trace.columns["time_s"]) // 3] * direction > 0


@pytest.mark.parametrize(("percent", "left"), [(0.0, 1.0), (50.0, 0.5), (80.0, 0.2), (100.0, 0.0)])
def test_feed_forward_takes_its_percentage_off(axis: Axis, percent: float, left: float) -> None:
    # Page 7-28: 80 % leaves about 20 % of the following error of a closed loop.
    servo = axis(zero_following_error=True, feed_forward=percent)
    trace = run_step(servo, StepMove(300.0, 6000.0))
    assert figure(trace, "predicted_following_error") == pytest.approx(6.0 * left, abs=1e-12)
    assert figure(trace, "steady_following_error") == pytest.approx(6.0 * left, abs=servo.count)


def test_feed_forward_counts_only_with_zero_following_error(axis: Axis) -> None:
    # Page 7-28: the percentage is significant only for ZFE Closed Loop.
    servo = axis(feed_forward=80.0)
    assert steady_following_error(servo, 6000.0) == 6.0


@pytest.mark.parametrize("ratio", [0.25, 0.5, 0.8])
@pytest.mark.parametrize("feedrate", [1500.0, 2000.0, 6000.0])
def test_beyond_the_gain_break_the_error_follows_the_broken_line(
    axis: Axis, ratio: float, feedrate: float
) -> None:
    # Pages 7-22 and 7-27. With gain 1 and a break at 2 mm the line breaks at 2000 mm/min; what is beyond it
    # needs 1/ratio times the error: 2 mm + (feedrate - 2000) / (1000 ratio).
    servo = axis(gain_break_point=2.0, gain_break_ratio=ratio)
    expected = min(feedrate, 2000.0) / 1000.0 + max(feedrate - 2000.0, 0.0) / 1000.0 / ratio
    assert steady_following_error(servo, feedrate) == pytest.approx(expected, rel=1e-12)
    trace = run_step(servo, StepMove(feedrate / 60.0 * 4.0, feedrate))
    assert figure(trace, "steady_following_error") == pytest.approx(expected, abs=servo.count)


def test_zero_following_error_does_not_use_the_gain_break(axis: Axis) -> None:
    # Pages 7-22 and 7-27.
    servo = axis(zero_following_error=True, gain_break_point=0.1, gain_break_ratio=0.5)
    trace = run_step(servo, StepMove(200.0, 3000.0))
    assert figure(trace, "steady_following_error") == pytest.approx(3.0, abs=servo.count)


def test_a_gain_break_ratio_of_zero_has_no_steady_error(axis: Axis) -> None:
    servo = axis(gain_break_point=2.0, gain_break_ratio=0.0)
    trace = run_step(servo, StepMove(100.0, 3000.0))
    assert trace.result["predicted_following_error"] == (None, "mm")
    assert trace.result["steady_following_error"] == (None, "mm")


def test_a_move_too_short_to_settle_has_no_steady_error(axis: Axis) -> None:
    trace = run_step(axis(), StepMove(1.0, 6000.0))
    assert trace.result["steady_following_error"][0] is None


def test_an_angle_is_treated_as_a_length(axis: Axis) -> None:
    servo = axis(unit="deg", travel=360.0, feedback_counts=360000.0)
    trace = run_step(servo, StepMove(180.0, 3600.0))
    value, unit = trace.result["steady_following_error"]
    assert unit == "deg"
    assert value == pytest.approx(3.6, abs=servo.count)
    assert trace.units["velocity"] == "deg/min"


def test_the_manuals_equations_for_limits_and_ramps(axis: Axis) -> None:
    servo = axis(position_gain=2.0, gain_break_ratio=0.5, gain_break_point=1.0)
    # Page 7-20: 1.1 rapid / (gain 1000 ratio).
    assert excess_error_wanted(servo, 10000.0) == pytest.approx(1.1 * 10000.0 / (2.0 * 1000.0 * 0.5))
    # Page 7-22: cutting 0.001 / gain.
    assert gain_break_wanted(servo, 5000.0) == pytest.approx(2.5)
    # Page 10-2: 120 ms / gain, and speed / response time.
    assert response_time(servo) == pytest.approx(0.060)
    assert response_ramp(servo, 6000.0) == pytest.approx(100.0 / 0.060)


def test_without_a_ramp_the_response_takes_the_time_the_manual_gives(axis: Axis) -> None:
    # Page 10-2: 120 ms at gain 1, two time constants of Table 7.A; servo period and velocity loop add.
    servo = axis(linear_acceleration=0.0, velocity_rate=800.0, ideal_feedback=True, torque_limit_positive=1e6)
    trace = run_step(servo, StepMove(200.0, 3000.0))
    assert figure(trace, "response_time") == pytest.approx(0.120, abs=0.003)
