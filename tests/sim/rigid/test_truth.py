"""The simulated axis without limits and counts against exact solutions of the same linear system."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import numpy.typing as npt
import pytest

from amp_studio.sim.rigid.servo import AxisServo
from amp_studio.sim.rigid.step import StepMove, run_step

Axis = Callable[..., AxisServo]
Matrix = npt.NDArray[np.float64]


def exponential(matrix: Matrix) -> Matrix:
    """Return the matrix exponential by scaling, Taylor series and squaring (good to rounding here)."""
    halvings = max(0, math.ceil(math.log2(max(np.abs(matrix).sum(axis=1).max(), 1e-300))) + 6)
    small = matrix / 2.0**halvings
    term = total = np.eye(len(matrix))
    for n in range(1, 16):
        term = term @ small / n
        total = total + term
    for _ in range(halvings):
        total = total @ total
    return total


def exact_positions(servo: AxisServo, feedrate: float, periods: int) -> Matrix:
    """Return the position at each servo period while the command runs at a constant speed from t = 0.

    States x, v, w and the held velocity command; exact over a period, the position loop sampled between.
    """
    kp, ki, period = servo.velocity_rate, servo.integral_rate, servo.servo_period / 1000.0
    system = np.array([[0, 1, 0, 0], [0, -kp, kp * ki, kp], [0, -1, 0, 1], [0, 0, 0, 0]], dtype=np.float64)
    over = exponential(system * period)
    speed, state, positions = feedrate / 60.0, np.zeros(4), []
    for k in range(periods):
        positions.append(state[0])
        state[3] = servo.position_rate * (speed * k * period - state[0]) + servo.feed_forward_share * speed
        state = over @ state
    return np.array(positions)


def boundless(axis: Axis, **figures: object) -> AxisServo:
    """Return the axis with ideal feedback and a torque it never uses up."""
    return axis(
        ideal_feedback=True,
        torque_limit_positive=1e9,
        torque_limit_negative=1e9,
        linear_acceleration=0.0,
        **figures,
    )


@pytest.mark.parametrize("integral", [0.0, 1.25, 12.0])
@pytest.mark.parametrize(("rate", "period"), [(30.0, 1.0), (265.6, 1.0), (265.6, 4.0), (800.0, 8.0)])
def test_the_sampled_loop_is_exact_to_a_billionth(
    axis: Axis, integral: float, rate: float, period: float
) -> None:
    servo = boundless(axis, velocity_rate=rate, integral_rate=integral, servo_period=period)
    trace = run_step(servo, StepMove(1000.0, 6000.0, duration=1.0))
    simulated = trace.columns["position"][:: servo.substeps]
    exact = exact_positions(servo, 6000.0, len(simulated))
    # The positions go to 94 mm and more; Runge-Kutta leaves 3e-9 mm.
    assert np.abs(simulated - exact).max() < 3e-8


def test_the_sampled_loop_with_feed_forward_is_exact_too(axis: Axis) -> None:
    servo = boundless(axis, zero_following_error=True, feed_forward=70.0)
    trace = run_step(servo, StepMove(1000.0, 6000.0, duration=1.0))
    simulated = trace.columns["position"][:: servo.substeps]
    assert np.abs(simulated - exact_positions(servo, 6000.0, len(simulated))).max() < 3e-8


def test_a_quicker_servo_comes_to_the_continuous_loop(axis: Axis) -> None:
    # With a velocity loop of rate kp and no integral the following error of a ramp obeys
    # e'' + kp e' + kp Kv e = kp V, e(0) = 0, e'(0) = V; sampling costs less than a period of travel.
    kp, speed = 200.0, 100.0
    servo = boundless(axis, velocity_rate=kp, servo_period=0.1)
    trace = run_step(servo, StepMove(1000.0, speed * 60.0, duration=0.6))
    time = trace.columns["time_s"]
    kv = servo.position_rate
    root = math.sqrt(kp * kp / 4.0 - kp * kv)
    a, b = -kp / 2.0 + root, -kp / 2.0 - root
    steady = speed / kv
    first = (speed + b * steady) / (a - b)
    error = steady + first * np.exp(a * time) - (steady + first) * np.exp(b * time)
    assert error[0] == pytest.approx(0.0, abs=1e-12)
    assert np.abs(trace.columns["following_error"] - error).max() < speed * servo.servo_period / 1000.0


def test_the_discharge_rate_leaves_the_steady_state_alone(axis: Axis) -> None:
    # Page 7-58: little or no effect in steady state.
    errors = []
    for discharge in (1.0, 8.0):
        servo = boundless(axis, integral_rate=10.0, integrator_discharge=discharge)
        trace = run_step(servo, StepMove(600.0, 6000.0))
        errors.append(trace.result["steady_following_error"][0])
    assert errors == [pytest.approx(6.0, abs=0.002)] * 2


def test_the_discharge_rate_shortens_the_tail_of_a_change_of_speed(axis: Axis) -> None:
    # Page 7-58: a larger value empties the sum of the velocity error sooner.
    over = []
    for discharge in (1.0, 8.0):
        servo = boundless(
            axis,
            integral_rate=40.0,
            integrator_discharge=discharge,
            zero_following_error=True,
            feed_forward=100.0,
        )
        trace = run_step(servo, StepMove(100.0, 6000.0))
        over.append(trace.result["overshoot"][0])
    assert over[0] is not None
    assert over[1] is not None
    assert 0.0 < over[1] < over[0]
