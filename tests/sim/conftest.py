"""One axis to start from, and one 9/PC axis as a file would give it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

from amp_studio.sim.rigid.servo import AxisServo

AXIS = AxisServo(
    position_gain=1.0,
    velocity_rate=200.0,  # 5 ms: twelve times as fast as the 60 ms of the position loop
    acceleration_at_rated=5000.0,
    feedback_counts=8000.0,
    travel=10.0,
    linear_acceleration=500.0,
    inposition_band=0.02,
    rapid_feedrate=10000.0,
    cutting_feedrate=5000.0,
    axis="1",
)

NINEPC: dict[str, float | str | bool | None] = {
    "axis.type": "linear",
    "servo.hardware_type": "sercos",
    "servo.loop_type": "digital",
    "servo.position_loop_type": "closed",
    "servo.sercos_cycle": 1.0,
    "servo.standard_motor_values": False,
    "servo.motor_type": "nonstandard",
    "servo.position_feedback_type": "inc-wide",
    "servo.position_counts": 8000.0,
    "servo.position_gear_teeth": 1.0,
    "servo.position_screw_teeth": 2.0,
    "servo.lead_screw_pitch": 10.0,
    "servo.initial_gain": 1.0,
    "servo.gain_break_point": 8.0,
    "servo.gain_break_ratio": 1.0,
    "servo.feed_forward": 0.0,
    "servo.inposition_band": 0.0254,
    "servo.feedrate_suppression": 11.0,
    "servo.excess_error": 11.2,
    "servo.velocity_proportional_gain": 13107.2,
    "servo.velocity_integral_gain": 0.0,
    "servo.integrator_discharge": 1.0,
    "servo.max_torque_positive": 200.0,
    "servo.max_torque_negative": 200.0,
    "servo.peak_current": "p200",
    "servo.max_acceleration": 1989.66667,
    "feedrate.rapid": 10000.0,
    "feedrate.max_cutting": 5000.0,
    "accdec.positioning_mode": "linear",
    "accdec.linear_acceleration": 500.0,
    "accdec.linear_deceleration": 0.0,
}


@pytest.fixture(scope="session")
def axis() -> Callable[..., AxisServo]:
    """Return a function that gives the axis with some figures changed."""

    def changed(**figures: Any) -> AxisServo:
        return replace(AXIS, **figures)

    return changed


@pytest.fixture(scope="session")
def ninepc() -> Callable[..., Callable[[str, str], float | str | bool | None]]:
    """Return a function that gives the look-up of a 9/PC axis with some values changed (None: not set)."""

    def changed(
        values: dict[str, float | str | bool | None] | None = None,
    ) -> Callable[[str, str], float | str | bool | None]:
        merged = {**NINEPC, **(values or {})}

        def value(parameter: str, instance: str) -> float | str | bool | None:
            everywhere = parameter.startswith("timing.") or parameter in (
                "servo.sercos_cycle",
                "servo.standard_motor_values",
                "accdec.positioning_mode",
                "accdec.programmed_delay",
            )
            assert instance == ("" if everywhere else "1"), f"{parameter} was asked for at '{instance}'"
            return merged.get(parameter)

        return value

    return changed
