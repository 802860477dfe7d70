"""The command of an axis: closed pieces for every ramp,
against the equations of the book and against another program.
"""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from ruckig import InputParameter, Result, Ruckig, Trajectory

from amp_studio.sim import Ramp, SimulationError
from amp_studio.sim.command.ramps import Override, blocks, end_of, move, overridden
from amp_studio.sim.engine.profiles import DURATION, START, WIDTH, command, piece_at
from amp_studio.sim.engine.signals import COMMAND, COMMAND_ACCELERATION, COMMAND_VELOCITY, MONITOR
from tests.campaigns import examples, some

LINEAR = Ramp("linear", 500.0, 250.0)
S_CURVE = Ramp("s-curve", 500.0, jerk=4000.0)
SINE = Ramp("sine-squared", 500.0, time=0.1)
EXPONENTIAL = Ramp("exponential", time=0.08)


def at(profile: list[float], time: float) -> tuple[float, float, float]:
    """Return position, velocity and acceleration of a moment."""
    io = [0.0] * MONITOR
    command(profile, piece_at(profile, 0, time), time, io)
    return io[COMMAND], io[COMMAND_VELOCITY], io[COMMAND_ACCELERATION]


def edges(profile: list[float]) -> list[float]:
    return [profile[k + START] for k in range(WIDTH, len(profile), WIDTH)]


def test_without_a_ramp_the_command_goes_at_the_feedrate_from_start_to_end() -> None:
    profile = move(-50.0, 100.0, Ramp())
    assert end_of(profile) == 0.5
    assert at(profile, 0.25) == (-25.0, -100.0, 0.0)
    assert at(profile, 0.75) == (-50.0, 0.0, 0.0)


def test_a_linear_ramp_rises_by_the_one_figure_and_falls_by_the_other() -> None:
    profile = move(60.0, 100.0, LINEAR)
    # 0.2 s up over 10 mm, 0.4 s down over 20 mm, 30 mm at 100 mm/s between them.
    assert edges(profile) == pytest.approx([0.2, 0.5, 0.9])
    assert at(profile, 0.1) == pytest.approx((2.5, 50.0, 500.0))
    assert at(profile, 0.7) == pytest.approx((55.0, 50.0, -250.0))


def test_a_short_linear_move_turns_at_the_velocity_from_which_it_can_stop() -> None:
    profile = move(10.0, 100.0, LINEAR)
    # v = sqrt(2 s / (1/a + 1/d)) = 57.735 mm/s.
    assert at(profile, edges(profile)[0])[1] == pytest.approx(57.735, rel=1e-4)
    assert at(profile, end_of(profile))[0] == 10.0


def test_a_change_up_to_the_velocity_step_needs_no_ramp_and_a_larger_one_has_all_of_it() -> None:
    ramp = Ramp("linear", 500.0, velocity_step=20.0)
    slow = move(5.0, 20.0, ramp)
    assert at(slow, 0.0)[1] == 20.0
    assert end_of(slow) == 0.25
    fast = move(50.0, 100.0, ramp)
    assert at(fast, 0.0)[1] == 0.0
    assert end_of(fast) == pytest.approx(0.2 + 30.0 / 100.0 + 0.2)


@given(st.floats(0.01, 1000.0), st.floats(1.0, 500.0), st.floats(50.0, 10000.0), st.floats(100.0, 1e6))
@settings(max_examples=examples(60))
def test_an_s_curve_is_as_fast_as_the_best_trajectory_of_ruckig(
    distance: float, feedrate: float, acceleration: float, jerk: float
) -> None:
    wanted = InputParameter(1)
    wanted.target_position = [distance]
    wanted.max_velocity, wanted.max_acceleration, wanted.max_jerk = [feedrate], [acceleration], [jerk]
    best = Trajectory(1)
    assert Ruckig(1).calculate(wanted, best) == Result.Working, "that is: calculated"
    profile = move(distance, feedrate, Ramp("s-curve", acceleration, jerk=jerk))
    assert end_of(profile) == pytest.approx(best.duration, rel=1e-9)
    for share in (0.1, 0.3, 0.5, 0.62, 0.85):
        moment = share * best.duration
        position, velocity, _ = best.at_time(moment)
        assert at(profile, moment)[:2] == pytest.approx(
            (position[0], velocity[0]), rel=1e-6, abs=1e-6 * (1.0 + feedrate)
        )


def test_an_exponential_ramp_has_63_percent_after_one_time_constant_and_keeps_the_distance() -> None:
    # Page 10-15 of the 9/PC manual: 63 % after one time constant, 86 % after two.
    profile = move(100.0, 100.0, EXPONENTIAL, count=0.001)
    assert at(profile, 0.08)[1] == pytest.approx(63.2, abs=0.05)
    assert at(profile, 0.16)[1] == pytest.approx(86.5, abs=0.05)
    before_end = at(profile, math.nextafter(end_of(profile), 0.0))[0]
    assert 100.0 - before_end == pytest.approx(0.001, rel=1e-6), "one count is left for the end"
    assert at(profile, end_of(profile))[0] == 100.0


def test_a_sine_squared_ramp_has_half_of_the_greatest_acceleration_on_average() -> None:
    # 100 mm/s at 500 mm/s2 on top, 250 on average: 0.4 s.
    profile = move(100.0, 100.0, SINE)
    assert edges(profile)[0] == pytest.approx(0.4)
    assert at(profile, 0.2) == pytest.approx((5.0 - 500.0 / (5.0 * math.pi) ** 2, 50.0, 500.0))
    # A change of 10 mm/s would take 0.04 s: it takes the least time instead.
    assert edges(move(100.0, 10.0, SINE))[0] == pytest.approx(0.1)


@pytest.mark.parametrize("ramp", some([LINEAR, S_CURVE, SINE, EXPONENTIAL], 2), ids=lambda ramp: ramp.kind)
@pytest.mark.parametrize("distance", [0.3, 20.0, 300.0])
def test_position_velocity_and_acceleration_of_a_profile_belong_together(ramp: Ramp, distance: float) -> None:
    profile = move(distance, 100.0, ramp, count=1e-6)
    time = np.linspace(0.0, end_of(profile), 20001)
    position, velocity, acceleration = np.array([at(profile, t) for t in time]).T
    step = time[1]
    np.testing.assert_allclose(
        np.cumsum(0.5 * step * (velocity[1:] + velocity[:-1])), position[1:], atol=2e-5
    )
    assert np.max(np.abs(velocity)) <= 100.0 * (1.0 + 1e-12)
    if ramp.acceleration:
        assert np.max(np.abs(acceleration)) <= ramp.acceleration * (1.0 + 1e-9)


def test_a_lower_override_is_reached_by_the_ramp_and_the_distance_stays() -> None:
    profile = overridden(100.0, 100.0, LINEAR, [Override(0.5, 0.4)])
    assert at(profile, 0.4)[1] == 100.0
    assert at(profile, 0.6)[1] == pytest.approx(75.0)
    assert at(profile, 0.9)[1] == pytest.approx(40.0)
    assert at(profile, end_of(profile))[0] == 100.0


def test_a_feedhold_stands_until_the_start_and_then_goes_to_the_end() -> None:
    profile = overridden(100.0, 100.0, LINEAR, [Override(0.4, 0.0), Override(2.0, 1.0)])
    stands = at(profile, 1.5)
    assert stands[1:] == (0.0, 0.0)
    # 10 mm of ramp, 20 mm at speed, 20 mm of stop.
    assert stands[0] == pytest.approx(50.0)
    assert at(profile, 2.1)[1] == pytest.approx(50.0)
    assert at(profile, end_of(profile))[0] == 100.0


def test_a_feedhold_without_an_end_is_refused() -> None:
    with pytest.raises(SimulationError, match="the move never ends"):
        overridden(100.0, 100.0, LINEAR, [Override(0.4, 0.0)])
    with pytest.raises(SimulationError, match="the move never ends"):
        overridden(100.0, 100.0, EXPONENTIAL, [Override(0.4, 0.0)])


def test_an_override_in_the_middle_of_an_s_curve_comes_when_the_ramp_is_over() -> None:
    profile = overridden(100.0, 100.0, S_CURVE, [Override(0.05, 0.5)])
    velocities = [at(profile, t)[1] for t in np.linspace(0.0, end_of(profile), 500)]
    assert max(velocities) == pytest.approx(100.0, rel=1e-4)
    assert at(profile, end_of(profile))[0] == 100.0


@given(
    st.sampled_from([LINEAR, S_CURVE, SINE, EXPONENTIAL]),
    st.lists(st.tuples(st.floats(0.01, 2.0), st.floats(0.05, 2.0)), max_size=4),
    st.floats(0.5, 200.0),
)
@settings(max_examples=examples(60))
def test_whatever_is_overridden_the_velocity_has_no_gap_and_the_move_its_length(
    ramp: Ramp, changes: list[tuple[float, float]], distance: float
) -> None:
    moments = sorted(moment for moment, _ in changes)
    overrides = [Override(moment, share) for moment, (_, share) in zip(moments, changes, strict=True)]
    profile = overridden(distance, 100.0, ramp, overrides, count=1e-6)
    for edge in edges(profile)[:-1]:
        assert at(profile, math.nextafter(edge, 0.0))[0:2] == pytest.approx(
            at(profile, edge)[0:2], rel=1e-6, abs=1e-5
        )
    assert at(profile, math.nextafter(end_of(profile), 0.0))[0] == pytest.approx(distance, abs=1e-5)
    assert min(profile[DURATION::WIDTH]) > 0.0


def test_contouring_goes_through_a_corner_where_an_exact_stop_stands() -> None:
    parts = [(50.0, 100.0), (50.0, 40.0), (-30.0, 100.0)]
    through = blocks(parts, LINEAR, exact_stop=False, check=0.001)
    stopped = blocks(parts, LINEAR, exact_stop=True, check=0.001)
    at_corner = [
        at(profile, next(t for t in np.arange(0.0, 9.0, 0.001) if at(profile, t)[0] >= 50.0 - 1e-9))[1]
        for profile in (through, stopped)
    ]
    assert at_corner == [pytest.approx(40.0), pytest.approx(0.0, abs=0.1)]
    assert end_of(stopped) > end_of(through)
    assert at(through, end_of(through))[0] == at(stopped, end_of(stopped))[0] == 70.0
    assert min(at(through, t)[1] for t in edges(through)) >= -100.0
