"""What is constant while an axis moves at one speed: following error, output, reference."""

from __future__ import annotations

from .law import AxisLaw
from .trace import Trace

SPEED = 1e-3
"""Largest relative difference from the feedrate of a constant speed."""


def error_at_speed(trace: Trace) -> float | None:
    """Return the mean following error in the second half of the rows at full speed,
    above 0 for an axis that is behind.

    None where the scenario found no steady error.
    """
    import numpy as np  # a picture of the loops needs the signals alone

    feedrate = trace.result.get("feedrate", (None, ""))[0]
    if not feedrate or trace.result.get("steady_following_error", (None, ""))[0] is None:
        return None
    speed = trace.columns["command_velocity"]
    even = np.flatnonzero(np.abs(np.abs(speed) / feedrate - 1.0) <= SPEED)
    if even.size == 0:
        return None
    # In the first half the error still settles: the loop lags behind the ramp that has just ended.
    late = even[even.size // 2 :]
    return float((trace.columns["following_error"][late] * np.sign(speed[late])).mean())


def steady_signals(axis: AxisLaw, speed: float) -> dict[str, tuple[float, str]]:
    """Return the signals of an axis at a constant speed in u/s, by name, each with its unit.

    Those that the law predicts, and the output that keeps this speed: of a drive with a velocity loop its
    reference, of one that gives a torque that of the friction and of the weight.
    """
    machine = axis.machine
    if machine.velocity_per_output > 0.0:
        output = speed / machine.velocity_per_output
    else:
        output = machine.viscous_friction * speed + machine.coulomb_friction + machine.gravity
    predicted = {
        name: (each.value, each.unit) for name, each in axis.predict(speed).items() if each.value is not None
    }
    return {
        "command_velocity": (speed * 60.0, f"{axis.unit}/min"),
        "output": (output, axis.output_unit),
        **predicted,
    }
