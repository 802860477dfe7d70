"""Excess error and feedrate suppression, watched once a servo period."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

from amp_studio.sim.rigid.servo import AxisServo
from amp_studio.sim.rigid.step import StepMove, run_step

Axis = Callable[..., AxisServo]


def blocked(axis: Axis, **figures: object) -> AxisServo:
    """Return an axis that cannot move."""
    return axis(torque_limit_positive=0.0, torque_limit_negative=0.0, linear_acceleration=0.0, **figures)


@pytest.mark.parametrize("limit", [0.55, 2.05, 9.99])
@pytest.mark.parametrize("period", [1.0, 3.0])
def test_a_blocked_axis_is_noticed_when_the_command_has_gone_so_far(
    axis: Axis, limit: float, period: float
) -> None:
    # Page 7-20. At 6000 mm/min the command goes 0.1 mm a millisecond.
    trace = run_step(blocked(axis, excess_error=limit, servo_period=period), StepMove(100.0, 6000.0))
    (alarm,) = trace.alarms
    step = 0.1 * period
    assert alarm.code == "EXCESS FOLLOWING ERROR"
    assert alarm.time_s == pytest.approx((math.floor(limit / step + 1e-9) + 1) * period / 1000.0, abs=1e-9)
    assert trace.columns["time_s"][-1] == alarm.time_s
    assert trace.result["in_position_time"][0] is None


def test_an_error_equal_to_the_limit_is_no_alarm(axis: Axis) -> None:
    # Page 7-20: the alarm comes when the error exceeds the value.
    trace = run_step(blocked(axis, excess_error=10.0, ideal_feedback=True), StepMove(10.0, 6000.0))
    assert trace.alarms == ()
    assert trace.result["peak_following_error"][0] == 10.0
    assert trace.columns["time_s"][-1] > 0.2  # and the motion goes on after the command has ended


def test_a_normal_move_below_the_limit_ends_in_position_without_alarm(axis: Axis) -> None:
    trace = run_step(axis(excess_error=6.6), StepMove(200.0, 6000.0))
    assert trace.alarms == ()
    assert trace.result["in_position_time"][0] is not None


def test_a_limit_below_the_steady_error_stops_the_move_on_its_way(axis: Axis) -> None:
    servo = axis(excess_error=5.0)
    trace = run_step(servo, StepMove(200.0, 6000.0))
    (alarm,) = trace.alarms
    assert 0.2 < alarm.time_s < 1.0
    error = np.abs(trace.columns["following_error"][:: servo.substeps])
    assert error[-1] > 5.0
    assert (error[:-1] <= 5.0).all()
    assert "5 mm" in alarm.message


def test_above_the_suppression_point_the_feedrate_is_halved_until_the_error_is_below_it(axis: Axis) -> None:
    # Page 7-21. 6000 mm/min needs 6 mm, 3000 mm/min only 3 mm: the error swings about the point of 5 mm.
    servo = axis(feedrate_suppression=5.0, linear_acceleration=0.0)
    trace = run_step(servo, StepMove(300.0, 6000.0))
    error = np.abs(trace.columns["following_error"][:: servo.substeps])
    command = np.abs(trace.columns["command_velocity"][:: servo.substeps])
    moving = command[:-1] > 0.0
    moving[-60:] = False
    halved = np.isclose(command[:-1], 3000.0)
    full = np.isclose(command[:-1], 6000.0)
    running = moving & (np.arange(len(moving)) < np.flatnonzero(moving)[-1])
    assert (halved | full)[running].all()
    assert (halved == (error[:-1] > 5.0))[running].all()
    lost = trace.result["time_in_feedrate_suppression"][0]
    assert lost is not None
    assert lost == pytest.approx((error > 5.0).sum() * 0.001)
    assert lost > 0.5
    assert trace.result["in_position_time"][0] is not None


def test_a_suppression_point_equal_to_the_excess_error_does_nothing(axis: Axis) -> None:
    # Page 7-21: that is how it is switched off.
    plain = run_step(axis(excess_error=6.6), StepMove(200.0, 6000.0))
    same = run_step(axis(excess_error=6.6, feedrate_suppression=6.6), StepMove(200.0, 6000.0))
    assert np.array_equal(plain.columns["position"], same.columns["position"])


def test_in_position_is_judged_by_the_band_alone(axis: Axis) -> None:
    # Page 7-24.
    servo = axis(inposition_band=0.5)
    trace = run_step(servo, StepMove(200.0, 6000.0))
    moment, settle = trace.result["in_position_time"][0], trace.result["settle_time"][0]
    assert moment is not None
    assert settle is not None
    off = np.abs(200.0 - trace.columns["position"][:: servo.substeps])
    time = trace.columns["time_s"][:: servo.substeps]
    assert (off[time >= moment] <= 0.5 + servo.count).all()
    assert off[np.searchsorted(time, moment) - 1] > 0.5 - servo.count
    tighter = run_step(axis(inposition_band=0.01), StepMove(200.0, 6000.0)).result["settle_time"][0]
    assert tighter is not None
    # From 0.5 to 0.01 mm the error of a first-order loop takes 60 ms x ln 50.
    assert tighter - settle == pytest.approx(0.060 * math.log(50.0), abs=0.03)
