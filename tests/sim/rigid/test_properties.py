"""Whatever the figures of an axis, its motion is finite, bounded and told truly."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from amp_studio.sim import trace_summary
from amp_studio.sim.rigid.servo import AxisServo
from amp_studio.sim.rigid.step import StepMove, run_step


def numbers(low: float, high: float) -> st.SearchStrategy[float]:
    return st.floats(low, high, allow_nan=False, allow_infinity=False)


limits = st.one_of(numbers(0.0, 214.1), st.just(math.inf))
servos = st.builds(
    AxisServo,
    position_gain=numbers(0.05, 30.0),
    velocity_rate=numbers(1.0, 1000.0),
    acceleration_at_rated=numbers(10.0, 50000.0),
    feedback_counts=numbers(4.0, 4194304.0),
    travel=numbers(0.01, 254.0),
    servo_period=numbers(1.0, 30.0),
    integral_rate=st.one_of(st.just(0.0), numbers(0.0, 1000.0)),
    integrator_discharge=st.integers(1, 8).map(float),
    torque_limit_positive=numbers(0.0, 300.0),
    torque_limit_negative=numbers(0.0, 300.0),
    gain_break_point=limits,
    gain_break_ratio=numbers(0.0, 1.0),
    zero_following_error=st.booleans(),
    feed_forward=numbers(0.0, 100.0),
    linear_acceleration=st.one_of(st.just(0.0), numbers(10.0, 20000.0)),
    linear_deceleration=st.one_of(st.just(0.0), numbers(10.0, 20000.0)),
    exponential_time=numbers(1.0, 500.0),
    inposition_band=numbers(0.0, 1.0),
    feedrate_suppression=limits,
    excess_error=limits,
    viscous_friction=numbers(0.0, 20.0),
    coulomb_friction=numbers(0.0, 100.0),
    rapid_feedrate=numbers(1000.0, 240000.0),
    cutting_feedrate=numbers(1.0, 10000.0),
)
moves = st.builds(
    StepMove,
    distance=st.one_of(numbers(0.001, 500.0), numbers(-500.0, -0.001)),
    feedrate=numbers(10.0, 240000.0),
    mode=st.sampled_from(["linear", "exponential", "none"]),
    duration=numbers(0.001, 1.0),
)


@settings(max_examples=300)
@given(servo=servos, move=moves)
def test_motion_is_finite_bounded_and_its_alarms_are_true(servo: AxisServo, move: StepMove) -> None:
    trace = run_step(servo, move, engine="compiled")
    for name, column in trace.columns.items():
        assert np.isfinite(column).all(), name
    for name, (value, _) in trace.result.items():
        assert value is None or math.isfinite(value), name
    torque = trace.columns["torque_percent"]
    assert torque.max() <= servo.torque_limit_positive
    assert torque.min() >= -servo.torque_limit_negative
    command = trace.columns["command_position"]
    forward = command * math.copysign(1.0, move.distance)
    assert forward.min() >= 0.0
    assert forward.max() <= abs(move.distance) * (1.0 + 1e-12)
    speed = np.abs(trace.columns["command_velocity"])
    assert speed.max() <= move.feedrate * (1.0 + 1e-9)
    error = np.abs(trace.columns["following_error"][:: servo.substeps])
    assert (error[:-1] <= servo.excess_error).all()
    assert bool(trace.alarms) == bool(error[-1] > servo.excess_error)
    assert all(math.isfinite(advice.value) and advice.why for advice in trace.recommendations)
    assert trace_summary(trace)["trace"]["rows"] == len(torque)


@settings(max_examples=60)
@given(servo=servos, move=moves)
def test_plain_python_agrees_with_machine_code(servo: AxisServo, move: StepMove) -> None:
    short = StepMove(move.distance, move.feedrate, move.mode, duration=min(move.duration or 1.0, 0.1))
    plain = run_step(servo, short, engine="plain")
    compiled = run_step(servo, short, engine="compiled")
    assert plain.rows == compiled.rows
    for name, column in plain.columns.items():
        assert np.allclose(column, compiled.columns[name], rtol=1e-9, atol=1e-9), name


@settings(max_examples=100)
@given(servo=servos, move=moves)
def test_the_other_direction_is_the_mirror_image(servo: AxisServo, move: StepMove) -> None:
    figures = {name: getattr(servo, name) for name in AxisServo.__dataclass_fields__}
    # Without counts: half a count is rounded up in both directions.
    figures |= {"ideal_feedback": True, "torque_limit_negative": servo.torque_limit_positive}
    there = run_step(AxisServo(**figures), move, engine="compiled")
    back = run_step(
        AxisServo(**figures),
        StepMove(-move.distance, move.feedrate, move.mode, move.duration),
        engine="compiled",
    )
    assert there.rows == back.rows
    for name in ("command_position", "position", "following_error", "velocity", "torque_percent"):
        assert np.array_equal(there.columns[name], -back.columns[name]), name
