"""The PID loop of a LinuxCNC joint and its following error, from sample to sample (C456 to C490)."""

from __future__ import annotations

from amp_studio.sim import (
    COMMAND,
    COMMAND_VELOCITY,
    MODE,
    MONITOR,
    OUTPUT,
    OUTPUT_TEST,
    POSITION,
    STOP,
    VELOCITY_LOOP,
    Vector,
)

GAIN, FORWARD, FERROR, MIN_ERROR, TOP = range(5)  # 1/s, a ratio, u, u, u/s
PARAMETERS = 5
_TRIPPED = 1.0


def position_sample(p: Vector, s: Vector, io: Vector) -> None:  # noqa: ARG001 -- every law has a state
    """Set the speed in u/s; the monitor is the limit of the following error in u."""
    if io[MODE] == OUTPUT_TEST:
        io[OUTPUT] = io[COMMAND]
        return
    if io[MODE] == VELOCITY_LOOP:
        io[OUTPUT] = io[COMMAND_VELOCITY]
        return
    error = io[COMMAND] - io[POSITION]
    limit = p[FERROR] * abs(io[COMMAND_VELOCITY]) / p[TOP]
    limit = max(limit, p[MIN_ERROR])
    io[MONITOR] = limit
    if abs(error) > limit:
        io[STOP] = _TRIPPED
    io[OUTPUT] = p[GAIN] * error + p[FORWARD] * io[COMMAND_VELOCITY]
