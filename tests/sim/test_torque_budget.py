"""The torque budget of a move, by hand: peak, root mean square, and how often the motor can make it."""

import numpy as np
import pytest

from amp_studio.sim.scenarios.step import run_step
from tests.sim.tiny import tiny

MOVE = {"move.distance": 50.0, "move.duration": 1.0}
RAMP, STEADY, LASTS = 0.2, 0.3, 1.0  # s: 100 mm/s by 500 mm/s2 over 50 mm, watched for 1 s
AXIS = {"velocity_rate": 80.0, "gain": 5.0, "forward": 1.0, "position_count": 0.0}
PUSH = 500.0 / 50.0  # %


@pytest.mark.parametrize("weight", [0.0, 3.0])
def test_peak_rms_and_duty_are_those_by_hand(weight: float) -> None:
    """10 % and the weight up the ramp, the weight alone at speed and at rest, the weight less 10 % down."""
    found = run_step(tiny(**AXIS, gravity=weight), {**MOVE, "move.rated_torque": 5.0}).result
    squares = RAMP * ((weight + PUSH) ** 2 + (weight - PUSH) ** 2) + (LASTS - 2.0 * RAMP) * weight**2
    rms = np.sqrt(squares / LASTS)
    assert found["peak_torque"][0] == pytest.approx(weight + PUSH, rel=0.1)  # commands come in steps of 1 ms
    assert found["rms_torque"] == (pytest.approx(rms, rel=0.02), "%")
    by_hand = 100.0 * (5.0**2 - weight**2) / (rms**2 - weight**2)
    assert found["duty"] == (pytest.approx(by_hand, rel=0.06), "%")


def test_a_move_below_the_rated_torque_may_go_on_for_ever_and_a_weight_above_it_never() -> None:
    assert run_step(tiny(**AXIS), MOVE).result["duty"] == (100.0, "%")  # 100 % of rated torque is the default
    heavy = run_step(tiny(**AXIS, gravity=6.0), {**MOVE, "move.rated_torque": 5.0}).result
    assert heavy["duty"] == (0.0, "%")
