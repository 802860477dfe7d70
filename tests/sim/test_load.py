"""A torque on the load moves a standing axis as far as an independent integration of its equations,
and as the linear model predicts.
"""

import numpy as np
import pytest

from amp_studio.sim.scenarios.load import run_load
from tests.sim.tiny import tiny

GAIN, RATE, PUSH = 20.0, 200.0, 50.0  # 1/s, 1/s, mm/s2 for 1 %


def test_the_sag_is_that_of_the_equations_of_motion() -> None:
    """x'' = PUSH load - RATE (x' + GAIN x): what samples of 0.25 and 1 ms leave out is below a percent."""
    from scipy.integrate import solve_ivp  # here, as it takes long: every worker collects all tests

    trace = run_load(tiny(position_count=0.0), {"move.load": 8.0, "move.duration": 1.0})
    judged = solve_ivp(
        lambda _t, y: [y[1], PUSH * 8.0 - RATE * (y[1] + GAIN * y[0])],
        (0.0, 1.0),
        [0.0, 0.0],
        rtol=1e-9,
        atol=1e-12,
    )
    assert trace.result["sag"][0] == pytest.approx(np.abs(judged.y[0]).max(), rel=0.01)
    assert trace.result["stiffness"] == (pytest.approx(PUSH / RATE / GAIN, rel=0.01), "mm/%")
    assert trace.result["predicted_stiffness"][0] == pytest.approx(trace.result["stiffness"][0], rel=1e-3)
    assert trace.result["remaining_deflection"][0] == pytest.approx(trace.result["sag"][0], rel=1e-3)
    assert trace.result["recovery_time"][0] is None  # no integral gain takes it up
    assert trace.result["lost_motion"][0] == pytest.approx(0.0, abs=1e-6)


def test_dry_friction_takes_its_part_and_leaves_lost_motion() -> None:
    free = run_load(tiny(position_count=0.0), {"move.load": 8.0}).result
    dry = run_load(
        tiny(position_count=0.0, coulomb_friction=3.0, motor_friction=0.0), {"move.load": 8.0}
    ).result
    assert dry["sag"][0] == pytest.approx(free["sag"][0] * 5.0 / 8.0, rel=0.02)
    assert dry["lost_motion"][0] == pytest.approx(2.0 * 3.0 / 8.0 * free["sag"][0], rel=0.2)


def test_lost_motion_of_a_load_with_backlash_is_the_sum_by_hand() -> None:
    """The load stays where the loop pushes it with no more than its friction: behind the gap, the loop and
    the contact each yield by that much, on both sides.
    """
    gap, friction = 0.02, 3.0
    axis = tiny(position_count=0.0, backlash=gap, coulomb_friction=friction, motor_friction=0.0)
    contact = (2.0 * np.pi * 150.0) ** 2 / (4.0 * PUSH)  # of two equal masses: 150 Hz, as assumed
    by_hand = gap + 2.0 * friction * (PUSH / RATE / GAIN + 1.0 / contact)
    found = run_load(axis, {"move.load": 8.0, "move.duration": 1.0}).result["lost_motion"]
    assert found == (pytest.approx(by_hand, rel=0.02), "mm")


def test_what_is_known_of_the_force_gives_micrometres_for_a_newton() -> None:
    result = run_load(tiny(position_count=0.0), {"move.force_per_torque": 25.0}).result
    assert result["stiffness_by_force"] == (pytest.approx(1e3 * result["stiffness"][0] / 25.0), "µm/N")


def test_an_axis_that_is_not_stable_has_no_stiffness() -> None:
    trace = run_load(tiny(velocity_rate=6000.0, delay=0.002), {})
    assert trace.alarms[0].code == "UNSTABLE"
    assert trace.result["stiffness"][0] is None
