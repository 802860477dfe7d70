"""The smallest law there is, as a family writes one:
a proportional position loop over a proportional velocity loop.
"""

import math
from dataclasses import replace
from typing import Any

from amp_studio.sim import AlarmText, AxisLaw, Machine, Prediction, Ramp
from amp_studio.sim.engine import compiled
from amp_studio.sim.engine.arrays import Vector
from amp_studio.sim.engine.signals import (
    COMMAND,
    COMMAND_VELOCITY,
    MODE,
    MONITOR,
    MOTOR,
    OUTPUT,
    OUTPUT_TEST,
    POSITION,
    POSITION_LOOP,
    STOP,
)

GAIN, VELOCITY_GAIN, EXCESS, RATE, FORWARD = range(5)  # 1/s, % per u/s, u, velocity samples in 1 s, share
WANTED, LAST = 0, 1  # u/s, u


def position_sample(p: Vector, s: Vector, io: Vector) -> None:
    """Ask for a velocity in proportion to the following error; stop if that is too large."""
    error = io[COMMAND] - io[POSITION]
    if io[MODE] == POSITION_LOOP:
        if abs(error) > p[EXCESS]:
            io[STOP] = 1.0
        s[WANTED] = p[GAIN] * error + p[FORWARD] * io[COMMAND_VELOCITY]
    else:
        s[WANTED] = io[COMMAND_VELOCITY]
    io[MONITOR] = s[WANTED]


def velocity_sample(p: Vector, s: Vector, io: Vector) -> None:
    """Ask for a torque in proportion to the velocity error."""
    velocity = (io[MOTOR] - s[LAST]) * p[RATE]
    s[LAST] = io[MOTOR]
    io[OUTPUT] = p[VELOCITY_GAIN] * (s[WANTED] - velocity)
    if io[MODE] == OUTPUT_TEST:
        io[OUTPUT] = io[COMMAND]


# No machine code unless it is asked for: to make it takes longer than all that is computed with this law.
compiled._plain_steps[position_sample, velocity_sample] = -math.inf


def tiny(
    *,
    gain: float = 20.0,
    velocity_rate: float = 200.0,
    excess: float = 20.0,
    forward: float = 0.0,
    **machine: Any,
) -> AxisLaw:
    """Return an axis of 50 mm/s2 per % of torque; position loop in ``gain``,
    velocity loop in ``velocity_rate`` 1/s.
    """
    figures = {"acceleration_per_output": 50.0, "position_count": 0.001, "motor_count": 0.0} | machine
    acceleration = figures["acceleration_per_output"]
    return AxisLaw(
        axis="1",
        unit="mm",
        title="tiny axis",
        position_sample=position_sample,
        velocity_sample=velocity_sample,
        parameters=(gain, velocity_rate / acceleration, excess, 4000.0, forward),
        state_size=2,
        servo_period=0.001,
        velocity_period=0.00025,
        machine=Machine(**figures),
        output_unit="%",
        position_rate=gain,
        feedrate=100.0,
        inposition_band=0.01,
        ramps={"linear": Ramp("linear", 500.0), "none": Ramp()},
        monitors=(("wanted_velocity", "mm/s"),),
        alarms={1: AlarmText("EXCESS ERROR", f"The following error is above {excess:g} mm.")},
        predict=lambda feedrate: {"steady_following_error": Prediction(feedrate / gain, "mm", "1-1")},
        limits={"excess error": excess},
        assumed={"acceleration_per_output": "The tiny axis has no motor table."},
    )


def changed(axis: AxisLaw, **figures: Any) -> AxisLaw:
    """Return an axis with other figures of its machine."""
    return replace(axis, machine=replace(axis.machine, **figures))
