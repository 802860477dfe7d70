"""The command of a move: ramps, the exponential, and the way it ends."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

from amp_studio.sim import SimulationError
from amp_studio.sim.rigid.servo import AxisServo
from amp_studio.sim.rigid.step import StepMove, default_move, run_step

Axis = Callable[..., AxisServo]


def command(servo: AxisServo, move: StepMove) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return (time, position, velocity in unit/s) of the command, one row a servo period."""
    columns = run_step(servo, move).columns
    step = slice(None, None, servo.substeps)
    return (
        columns["time_s"][step],
        columns["command_position"][step],
        columns["command_velocity"][step] / 60.0,
    )


def test_a_linear_move_takes_the_time_of_a_trapezoid_and_ends_exactly(axis: Axis) -> None:
    # 100 mm/s with 500 mm/s2 up and 250 mm/s2 down: 200 / 100 + 0.1 + 0.2 s.
    servo = axis(linear_acceleration=500.0, linear_deceleration=250.0)
    time, position, _ = command(servo, StepMove(200.0, 6000.0))
    assert position[-1] == 200.0
    assert time[np.flatnonzero(position == 200.0)[0]] == pytest.approx(2.3, abs=0.003)


@pytest.mark.parametrize("distance", [0.001, 0.5, 3.7, -8.0])
def test_a_short_move_never_reaches_the_feedrate_and_keeps_both_ramps(axis: Axis, distance: float) -> None:
    servo = axis(linear_acceleration=500.0, linear_deceleration=250.0)
    _, position, velocity = command(servo, StepMove(distance, 60000.0))
    assert position[-1] == distance
    change = np.diff(np.abs(velocity)) / 0.001
    assert change.max() <= 500.0 * (1.0 + 1e-9)
    # In the last period what is left of the distance is taken at once: up to 1.5 times the ramp.
    assert change.min() >= -375.0 * (1.0 + 1e-9)
    assert change[: np.argmin(change) - 2].min(initial=0.0) >= -250.0 * (1.0 + 1e-6)


def test_a_deceleration_of_zero_is_that_of_the_acceleration(axis: Axis) -> None:
    # Page 10-10.
    one = command(axis(linear_acceleration=300.0, linear_deceleration=0.0), StepMove(50.0, 3000.0))
    two = command(axis(linear_acceleration=300.0, linear_deceleration=300.0), StepMove(50.0, 3000.0))
    assert all(np.array_equal(a, b) for a, b in zip(one, two, strict=True))


def test_an_acceleration_of_zero_is_no_ramp(axis: Axis) -> None:
    # Page 10-8.
    _, _, velocity = command(axis(linear_acceleration=0.0, linear_deceleration=300.0), StepMove(50.0, 3000.0))
    assert velocity[0] == pytest.approx(50.0)
    assert set(np.round(np.unique(np.abs(velocity)), 6)) <= {0.0, 50.0}


def test_an_exponential_move_has_reached_63_percent_after_one_time_constant(axis: Axis) -> None:
    # Page 10-14: 100 in/min, a constant of 10 and a scan of 20 ms: 63 after 0.2 s, 86 after 0.4 s.
    servo = axis(exponential_time=200.0)
    time, position, velocity = command(servo, StepMove(500.0, 6000.0, mode="exponential"))
    for moment, share in ((0.2, 1.0 - math.exp(-1.0)), (0.4, 1.0 - math.exp(-2.0))):
        # The velocity of a period is that at its end.
        assert velocity[np.searchsorted(time, moment - 1e-9) - 1] == pytest.approx(100.0 * share, rel=1e-9)
    assert position[-1] == 500.0
    assert np.all(np.diff(position) >= 0.0)


def test_a_move_that_needs_the_time_constant_says_which_one_is_missing(axis: Axis) -> None:
    with pytest.raises(SimulationError, match="exponential time is not set"):
        run_step(axis(), StepMove(10.0, 1000.0, mode="exponential"))


def test_the_default_move_is_at_rapid_and_long_enough_for_a_steady_error(axis: Axis) -> None:
    servo = axis()
    move = default_move(servo)
    assert move.feedrate == 10000.0
    assert run_step(servo, move).result["steady_following_error"][0] == pytest.approx(10.0, abs=0.01)


def test_the_default_move_needs_a_feedrate(axis: Axis) -> None:
    with pytest.raises(SimulationError, match="feedrate"):
        default_move(axis(rapid_feedrate=None, cutting_feedrate=None))


def test_a_duration_gives_exactly_so_many_rows(axis: Axis) -> None:
    trace = run_step(axis(), StepMove(1000.0, 1000.0, duration=0.5))
    assert trace.rows == 2000
    assert trace.result["in_position_time"][0] is None


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"distance": 0.0}, "distance"),
        ({"distance": math.nan}, "distance"),
        ({"feedrate": 0.0}, "feedrate"),
        ({"feedrate": math.inf}, "feedrate"),
        ({"mode": "s-curve"}, "ramp"),
        ({"duration": 0.0}, "duration"),
    ],
)
def test_a_move_that_is_none_is_refused(changes: dict[str, object], words: str) -> None:
    with pytest.raises(SimulationError, match=words):
        StepMove(**{"distance": 1.0, "feedrate": 1.0, **changes})


def test_a_move_of_hours_is_refused_before_it_is_run(axis: Axis) -> None:
    with pytest.raises(SimulationError, match="more than can be simulated"):
        run_step(axis(), StepMove(1000.0, 1.0))
