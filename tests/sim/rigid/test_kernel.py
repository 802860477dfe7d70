"""The laws of the inner loop one by one, as plain functions."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from amp_studio.sim.rigid import kernel
from amp_studio.sim.rigid.servo import AxisServo

Axis = Callable[..., AxisServo]


@pytest.mark.parametrize("position", [0.0, 0.0004, 0.0007, -0.0007, 3.14159, -3.14159])
def test_the_encoder_tells_the_nearest_whole_count(axis: Axis, position: float) -> None:
    loop = axis().loop()
    told = kernel.measured(loop, position)
    assert abs(told - position) <= 0.5 * loop.resolution * (1.0 + 1e-9)
    assert told / loop.resolution == pytest.approx(round(told / loop.resolution), abs=1e-9)
    assert kernel.measured(axis(ideal_feedback=True).loop(), position) == position


def test_the_position_loop_is_odd_and_has_no_jump_at_the_break(axis: Axis) -> None:
    # Pages 7-22 and 7-27.
    loop = axis(gain_break_point=2.0, gain_break_ratio=0.5).loop()
    gain = 1000.0 / 60.0
    assert kernel.velocity_asked(loop, 1.0) == pytest.approx(gain)
    assert kernel.velocity_asked(loop, 2.0) == pytest.approx(2.0 * gain)
    assert kernel.velocity_asked(loop, math.nextafter(2.0, 3.0)) == pytest.approx(2.0 * gain)
    assert kernel.velocity_asked(loop, 4.0) == pytest.approx(3.0 * gain)
    assert kernel.velocity_asked(loop, -4.0) == -kernel.velocity_asked(loop, 4.0)


def test_the_velocity_error_is_summed_unless_the_torque_is_cut(axis: Axis) -> None:
    # kp 200/s over 5000 mm/s2: 100 mm/s of error ask for 400 %, 10 mm/s for 40 %; the limit is 200 %.
    loop = axis(integral_rate=5.0, integrator_discharge=3.0).loop()
    assert kernel.rates(loop, 10.0, 0.0, 0.0, 0.0) == (pytest.approx(2000.0), 10.0)
    assert kernel.rates(loop, 100.0, 0.0, 0.0, 0.0) == (pytest.approx(10000.0), 0.0)
    assert kernel.rates(loop, -100.0, 0.0, 0.0, 0.0) == (pytest.approx(-10000.0), 0.0)
    # An error that takes the torque out of the limit again is summed, and by page 7-58 three times as fast.
    assert kernel.rates(loop, -1.0, 0.0, 100.0, 0.0) == (pytest.approx(10000.0), -3.0)


def test_the_torque_limits_are_by_its_sign(axis: Axis) -> None:
    loop = axis(torque_limit_positive=30.0, torque_limit_negative=70.0).loop()
    assert [kernel.limited_torque(loop, t) for t in (-100.0, -70.0, 0.0, 29.0, 31.0)] == [
        -70.0,
        -70.0,
        0.0,
        29.0,
        30.0,
    ]


def test_an_axis_that_stands_stays_until_the_torque_is_above_the_friction(axis: Axis) -> None:
    loop = axis(coulomb_friction=10.0).loop()  # 500 mm/s2; kp 200/s: 2.5 mm/s of velocity error
    h = 0.00025
    assert kernel.advance(loop, 2.4, 1.0, 0.0, 0.0, h) == (1.0, 0.0, pytest.approx(2.4 * h))
    position, speed, _ = kernel.advance(loop, 2.6, 1.0, 0.0, 0.0, h)
    assert position > 1.0
    assert speed > 0.0


def test_a_speed_that_passes_through_zero_against_friction_ends_at_zero(axis: Axis) -> None:
    loop = axis(coulomb_friction=10.0).loop()
    assert kernel.advance(loop, 0.0, 1.0, 0.1, 0.0, 0.00025)[1] == 0.0
    assert kernel.advance(loop, 0.0, 1.0, -0.1, 0.0, 0.00025)[1] == 0.0


def test_a_linear_ramp_stops_from_the_speed_the_rest_allows() -> None:
    profile = kernel.Profile(kernel.LINEAR, 1.0, 10.0, 100.0, 500.0, 250.0, 1.0, 0.0, math.inf, 0.0, math.inf)
    progress, speed, longest = 0.0, 0.0, 0
    while progress < 10.0:
        before = speed
        progress, speed = kernel.linear_step(profile, progress, speed, 100.0, 0.001)
        assert speed - before <= 500.0 * 0.001 + 1e-12
        # What is left is always enough to stop in.
        assert speed * speed / (2.0 * 250.0) <= 10.0 - progress + 1e-9
        longest += 1
    assert (progress, speed) == (10.0, 0.0)
    # Peak speed sqrt(2 s / (1/a + 1/d)) = 57.7 mm/s: 0.1155 + 0.2309 s.
    assert longest == pytest.approx(346, abs=2)


def test_a_halved_feedrate_is_reached_by_the_ramp() -> None:
    profile = kernel.Profile(kernel.LINEAR, 1.0, 1e6, 100.0, 500.0, 250.0, 1.0, 0.0, math.inf, 0.0, math.inf)
    assert kernel.linear_step(profile, 0.0, 100.0, 50.0, 0.001)[1] == pytest.approx(99.75)
    assert kernel.linear_step(profile, 0.0, 50.1, 50.0, 0.001)[1] == 50.0
