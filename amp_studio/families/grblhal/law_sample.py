"""The steps of a Grbl axis: a stepper follows its command; there is no servo loop and no measured
position.
"""

from __future__ import annotations

from amp_studio.sim import (
    COMMAND,
    COMMAND_VELOCITY,
    MODE,
    MONITOR,
    OUTPUT,
    OUTPUT_TEST,
    POSITION,
    POSITION_LOOP,
    Vector,
)

GAIN, STEPS = 0, 1  # 1/s, steps for 1 u
PARAMETERS = 2


def position_sample(p: Vector, s: Vector, io: Vector) -> None:  # noqa: ARG001 -- every law has a state
    """Give the commanded speed, and keep to the commanded position; the monitor is the step rate in Hz."""
    if io[MODE] == OUTPUT_TEST:
        io[OUTPUT] = io[COMMAND]
        return
    io[OUTPUT] = 60.0 * io[COMMAND_VELOCITY]
    if io[MODE] == POSITION_LOOP:
        io[OUTPUT] += 60.0 * p[GAIN] * (io[COMMAND] - io[POSITION])
    io[MONITOR] = abs(io[COMMAND_VELOCITY]) * p[STEPS]
