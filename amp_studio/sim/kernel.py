"""One axis from servo sample to servo sample: the loop that every law shares, over flat arrays.

Once a servo period the command is evaluated, the position measured, and ``position_sample`` of the law called; once a
velocity period ``velocity_sample``; in between the plant moves in physics steps. The output is held between the samples (zero-order
hold: G. F. Franklin, J. D. Powell, M. L. Workman, Digital Control of Dynamic Systems, 1998).

`compiled.py` makes one copy of ``run`` for each law, with the law's two functions in the place of those here, plain or as
machine code; both give equal results.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from .arrays import Vector
from .machine import LOAD_SENSOR, MOTOR_COUNT, POSITION_COUNT
from .plant import (
    COMMAND_TIME,
    ENDED,
    LOAD_POSITION,
    LOAD_SPEED,
    MOTOR_POSITION,
    PIECE,
    RESTLESS,
    SAMPLES,
    SHARE,
    advance,
)
from .plant import TORQUE as MOTOR_TORQUE
from .profiles import ACCELERATION, VELOCITY, WIDTH, command, piece_at
from .signals import (
    COMMAND,
    COMMAND_ACCELERATION,
    COMMAND_VELOCITY,
    DIVERGED,
    FEED_SHARE,
    MONITOR,
    MOTOR,
    OUTPUT,
    POSITION,
    REFERENCE_LAG,
    STOP,
    TIME,
    TORQUE,
)

COLUMNS = (
    "time_s",
    "command_position",
    "command_velocity",
    "position",
    "measured_position",
    "following_error",
    "velocity",
    "output",
    "torque",
)
"""Columns of the rows; the monitors of the law follow. ``position`` and ``velocity`` are those of the load."""

SERVO_PERIOD, VELOCITY_SAMPLES, SUBSTEPS, STEP = 0, 1, 2, 3
"""s; velocity samples in a servo period, physics steps in a velocity sample; s."""
SHARE_RATE = 4
"""1/s: how fast the share of the feedrate changes; infinite for at once."""
REST_BAND, REST_TIME, SETTLE_TIME = 5, 6, 7
"""u, s, s: the run ends when the axis was within the band for the time, or so long after the end of the command."""
STRIDE = 8
"""Physics steps for one row."""
MONITORS = 9
"""How many there are."""
FORWARD = 10
"""1; 0 takes velocity and acceleration of the command from the law, for a loop without feed-forward."""
TIMING_SIZE = 11

BOUNDLESS = 1e12
"""Positions beyond are no motion of a machine any more, u."""


def position_sample(p: Vector, s: Vector, io: Vector) -> None:
    """Stand for the law's sample function of the servo period."""


def velocity_sample(p: Vector, s: Vector, io: Vector) -> None:
    """Stand for the law's sample function of the velocity period."""


def counted(position: float, count: float) -> float:
    """Return a position in whole counts, the nearest one; as it is for an ideal device (count 0)."""
    if count == 0.0:
        return position
    return math.floor(position / count + 0.5) * count


def feed(x: Vector, timing: Vector, wanted: float) -> float:
    """Move the time of the command by a servo period at the feed share; return the share at its end."""
    share = x[SHARE]
    most = timing[SHARE_RATE] * timing[SERVO_PERIOD]
    after = min(max(wanted, share - most), share + most)
    x[COMMAND_TIME] += 0.5 * (share + after) * timing[SERVO_PERIOD]
    x[SHARE] = after
    return after


def at_rest(x: Vector, timing: Vector, profile: Vector, error: float) -> bool:
    """Return whether the run is over: at rest long enough after the end of the command, or not within the time for it."""
    k = int(x[PIECE]) * WIDTH
    over = (
        int(x[PIECE]) == len(profile) // WIDTH - 1
        and profile[k + VELOCITY] == 0.0
        and profile[k + ACCELERATION] == 0.0
    )
    if x[ENDED] < 0.0 and over:
        x[ENDED] = x[SAMPLES]
    if not over or error > timing[REST_BAND]:
        x[RESTLESS] = x[SAMPLES]
    if not over:
        return False
    if (x[SAMPLES] - x[RESTLESS]) * timing[SERVO_PERIOD] > timing[REST_TIME]:
        return True
    return (x[SAMPLES] - x[ENDED]) * timing[SERVO_PERIOD] > timing[SETTLE_TIME]


def run(
    p: Vector,
    s: Vector,
    io: Vector,
    m: Vector,
    x: Vector,
    timing: Vector,
    profile: Vector,
    rows: npt.NDArray[np.float64],
) -> int:
    """Run the axis until the command is over and the axis at rest, an alarm, or all rows are filled; return the rows.

    ``p``, ``s`` parameters and state of the law, ``io`` the signals, ``m``, ``x`` machine and state of the plant, ``timing``
    and ``profile`` as their indices say; all but p, m, timing and profile are changed, so that a run can be continued.
    """
    period, h = timing[SERVO_PERIOD], timing[STEP]
    samples, substeps, stride = int(timing[VELOCITY_SAMPLES]), int(timing[SUBSTEPS]), int(timing[STRIDE])
    monitors = int(timing[MONITORS])
    row, since = 0, stride
    while True:
        start = x[SAMPLES] * period
        piece = piece_at(profile, int(x[PIECE]), x[COMMAND_TIME])
        x[PIECE] = float(piece)
        begun, share = x[COMMAND_TIME], x[SHARE]
        command(profile, piece, begun, io)
        io[COMMAND_VELOCITY] *= share * timing[FORWARD]
        io[COMMAND_ACCELERATION] *= share * share * timing[FORWARD]
        sensed = x[LOAD_POSITION] if m[LOAD_SENSOR] == 1.0 else x[MOTOR_POSITION]
        io[TIME], io[TORQUE] = start, x[MOTOR_TORQUE]
        io[POSITION] = counted(sensed, m[POSITION_COUNT])
        io[MOTOR] = counted(x[MOTOR_POSITION], m[MOTOR_COUNT])
        position_sample(p, s, io)
        if at_rest(x, timing, profile, abs(io[COMMAND] - io[POSITION])):
            return row
        sampled, velocity = io[COMMAND], io[COMMAND_VELOCITY]
        feed(x, timing, io[FEED_SHARE])
        rate = (x[COMMAND_TIME] - begun) / period
        for k in range(samples):
            if k > 0:
                io[TIME], io[TORQUE] = start + k * substeps * h, x[MOTOR_TORQUE]
                io[MOTOR] = counted(x[MOTOR_POSITION], m[MOTOR_COUNT])
            velocity_sample(p, s, io)
            for j in range(substeps):
                if since == stride or io[STOP] != 0.0:
                    if row >= rows.shape[0]:
                        return row
                    since = 0
                    passed = (k * substeps + j) * h
                    if passed > 0.0:
                        moment = begun + passed * rate
                        command(profile, piece_at(profile, piece, moment), moment, io)
                        io[COMMAND_VELOCITY] *= rate
                    sensed = x[LOAD_POSITION] if m[LOAD_SENSOR] == 1.0 else x[MOTOR_POSITION]
                    rows[row, 0] = start + passed
                    rows[row, 1] = io[COMMAND]
                    rows[row, 2] = io[COMMAND_VELOCITY]
                    rows[row, 3] = x[LOAD_POSITION]
                    rows[row, 4] = counted(sensed, m[POSITION_COUNT])
                    rows[row, 5] = io[COMMAND] - io[REFERENCE_LAG] - rows[row, 4]
                    rows[row, 6] = x[LOAD_SPEED]
                    rows[row, 7] = io[OUTPUT]
                    rows[row, 8] = x[MOTOR_TORQUE]
                    for n in range(monitors):
                        rows[row, 9 + n] = io[MONITOR + n]
                    row += 1
                    io[COMMAND], io[COMMAND_VELOCITY] = sampled, velocity
                if io[STOP] != 0.0:
                    return row
                since += 1
                advance(m, x, io[OUTPUT], h)
        if not abs(x[MOTOR_POSITION]) < BOUNDLESS:
            io[STOP] = DIVERGED
        x[SAMPLES] += 1.0
