"""The data of an axis is checked when it is made, and every fault names what is wrong."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from amp_studio.sim import SimulationError, Source
from amp_studio.sim.rigid.servo import AxisServo

Axis = Callable[..., AxisServo]


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("position_gain", 0.0),
        ("travel", 0.0),
        ("feedback_counts", 0.0),
        ("gear_teeth", 0.0),
        ("screw_teeth", -1.0),
        ("servo_period", 0.0),
        ("velocity_rate", 0.0),
        ("acceleration_at_rated", math.nan),
        ("acceleration_at_rated", math.inf),
        ("torque_limit_negative", -200.0),
        ("gain_break_ratio", 1.5),
        ("gain_break_ratio", -0.1),
        ("feed_forward", 101.0),
        ("integrator_discharge", 0.0),
        ("excess_error", -1.0),
        ("excess_error", math.nan),
        ("inposition_band", math.inf),
        ("exponential_time", 0.0),
        ("rapid_feedrate", math.nan),
        ("linear_acceleration", math.inf),
        ("positioning_ramp", "s-curve"),
    ],
)
def test_impossible_data_is_refused_in_one_sentence(axis: Axis, name: str, value: object) -> None:
    with pytest.raises(SimulationError) as fault:
        axis(**{name: value})
    told = str(fault.value)
    assert told.startswith(name.replace("_", " "))
    assert "; it must" in told
    assert "\n" not in told
    assert fault.value.parameter == name


def test_a_fault_names_the_parameter_and_the_value_in_the_file(axis: Axis) -> None:
    source = Source("servo.velocity_proportional_gain", scale=65.536, unit="")
    with pytest.raises(SimulationError) as fault:
        axis(velocity_rate=-2.0, sources={"velocity_rate": source})
    assert fault.value.parameter == "servo.velocity_proportional_gain"
    assert (
        str(fault.value)
        == "velocity rate (servo.velocity_proportional_gain@1) is -131.072; it must be above 0"
    )


def test_a_loop_too_fast_for_the_physics_step_is_refused(axis: Axis) -> None:
    for rate in (1e9, 1e308):
        with pytest.raises(SimulationError, match="too fast to simulate"):
            axis(velocity_rate=rate)


def test_the_physics_step_follows_the_servo_period_and_the_fastest_loop(axis: Axis) -> None:
    assert axis(servo_period=1.0).substeps == 4
    assert axis(servo_period=30.0).substeps == 120
    assert axis(servo_period=0.1).substeps == 1
    # 8000/s: a step of 0.0625 ms.
    assert axis(servo_period=1.0, velocity_rate=8000.0).substeps == 16


def test_a_count_follows_from_counts_teeth_and_pitch(axis: Axis) -> None:
    # Pages 7-33, 7-38, 7-40: a screw with 40 teeth turns a device with 20 twice.
    servo = axis(feedback_counts=8000.0, travel=10.0, gear_teeth=20.0, screw_teeth=40.0)
    assert servo.count == pytest.approx(10.0 / 16000.0)
