"""One axis from servo sample to servo sample: the loop that every law shares, over flat arrays.

Once a servo period the command is evaluated, the position measured, and ``position_sample`` of the law
called; once a velocity period ``velocity_sample``; in between the plant moves in physics steps. The output is
constant between the samples (zero-order
hold: G. F. Franklin, J. D. Powell, M. L. Workman, Digital Control of Dynamic Systems, 1998).

`compiled.py` makes one copy of ``run`` for each law, with the law's two functions in the place of those here,
plain or as machine code; both give equal results.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from .arrays import Vector
from .counts import nearest
from .machine import (
    DELAY_SHARE,
    DELAY_STEPS,
    GRAVITY,
    LOAD_SENSOR,
    MOTOR_COUNT,
    MOTOR_COUNTS,
    POSITION_COUNT,
    POSITION_COUNTS,
)
from .plant import advance, brake, delayed
from .profiles import IN_POSITION, KIND, WIDTH, command, piece_at
from .signals import (
    COMMAND,
    COMMAND_ACCELERATION,
    COMMAND_VELOCITY,
    DIVERGED,
    EMERGENCY_STOP,
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

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

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
"""Columns of the rows; the monitors of the law follow. ``position`` and ``velocity`` are those of the
load."""

SERVO_PERIOD, VELOCITY_SAMPLES, SUBSTEPS, STEP = 0, 1, 2, 3
"""s; velocity samples in a servo period, physics steps in a velocity sample; s."""
SHARE_RATE = 4
"""1/s: how fast the share of the feedrate changes; infinite for at once."""
REST_BAND, REST_TIME, SETTLE_TIME = 5, 6, 7
"""u, s, s: the run ends when the axis was within the band for the time,
or so long after the end of the command."""
STRIDE = 8
"""Physics steps for one row."""
MONITORS = 9
"""How many there are."""
FORWARD = 10
"""1; 0 takes velocity and acceleration of the command from the law, for a loop without feed-forward."""
IN_POSITION_BAND = 11
"""u"""
COAST_TIME = 12
"""s after an alarm in which the axis runs out without output; 0 to end at the alarm."""
EMERGENCY = 13
"""s: moment of an emergency stop; infinite for none."""
DRIVEN_ROWS = 14
"""Rows at most before an alarm."""
LAST_SAMPLE = 15
"""The run is interrupted before this servo sample, and can be taken up there; infinite for never."""
TO_END = 16
"""1 to be interrupted before the first servo sample at the end of the command."""
WATCHES = 17
"""How many places are watched; a run is interrupted before the servo sample that sees one passed."""
WATCH = 18
"""The first place: signal (`AT_LOAD` or `AT_DEVICE`), direction (1 or -1), place (u), and the command (u)
beyond which it counts."""
WATCH_WIDTH, MAX_WATCHES = 4, 4
"""Figures of a watch, and how many there is room for."""
TIMING_SIZE = WATCH + MAX_WATCHES * WATCH_WIDTH

AT_LOAD, AT_DEVICE = 0.0, 1.0
"""What a watch reads: where the load is (a switch), what the position device measures (a marker,
a software limit)."""

STANDSTILL = 1e-9
"""u/s: an axis that runs out is at rest below; a drive with a velocity loop brings it to 0 in no finite
time."""

ENDED, ALARM_ROW = 0, 1
"""Of a run: sample at which the command ended and row of the alarm, both -1 before."""
PLANT = 2
"""State of the plant: the first of the seven figures of `plant.State`."""
SAMPLE, LAST_MOVED, PIECE, MOMENT, SHARE = 9, 10, 11, 12, 13
"""Where the run is: servo sample, that of the last motion, piece and moment of the command,
share of the feedrate."""
SLOT, SINCE, COASTING = 14, 15, 16
"""Place in the delay line, physics steps since the last row,
s that the axis may still run out after an alarm."""
SEEN = 17
"""Number of the watch that interrupted the run, from 1; 0 for none."""
STATE_SIZE = 18

_BOUNDLESS = 1e12
"""Positions beyond are no motion of a machine any more, u."""


def position_sample(p: Vector, s: Vector, io: Vector) -> None:
    """Placeholder of the law's sample function of the servo period."""


def velocity_sample(p: Vector, s: Vector, io: Vector) -> None:
    """Placeholder of the law's sample function of the velocity period."""


def counted(m: Vector, position: float, count: int, counts: int) -> float:
    """Return a position in whole counts, the nearest one; as it is for an ideal device (count 0)."""
    if m[count] == 0.0:
        return position
    return nearest(position * m[counts]) * m[count]


def fed(timing: Vector, time: float, share: float, wanted: float) -> tuple[float, float]:
    """Return the time of the command a servo period later, and its share of the feedrate,
    which goes towards the wanted one.
    """
    # An override slows the time of the command: all pieces of the profile stay as they are. The share
    # changes in a straight line over a period, so that its trapezium is the exact time.
    most = timing[SHARE_RATE] * timing[SERVO_PERIOD]
    after = min(max(wanted, share - most), share + most)
    return time + 0.5 * (share + after) * timing[SERVO_PERIOD], after


def seen(timing: Vector, commanded: float, measured: float, load: float) -> int:
    """Return the number of the first watch whose place is passed, from 1; 0 for none."""
    for n in range(int(timing[WATCHES])):
        k = WATCH + n * WATCH_WIDTH
        sign, where = timing[k + 1], load if timing[k] == AT_LOAD else measured
        # Only once the command has gone on towards the place: an axis beyond a limit can be moved back.
        if sign * (commanded - timing[k + 3]) > 0.0 and sign * (where - timing[k + 2]) >= 0.0:
            return n + 1
    return 0


def run(
    p: Vector,
    s: Vector,
    io: Vector,
    m: Vector,
    before: Vector,
    after: Vector,
    x: Vector,
    line: Vector,
    timing: Vector,
    profile: Vector,
    push: Vector,
    rows: npt.NDArray[np.float64],
) -> int:
    """Run the axis until the command is over and the axis at rest, an alarm, an interruption,
    or all rows are filled; return the rows.

    After an interruption the same call goes on where it was,
    with the profile and the watches that it then gets.

    ``p``, ``s`` parameters and state of the law, ``io`` the signals, ``m`` the machine over a physics step,
    ``before`` and ``after`` over its two parts where a delayed output arrives in it, ``x`` the state of run
    and plant, ``line`` the delay line, ``timing`` and ``profile`` as their indices say, ``push`` the torque
    on the load at each servo sample (as many as there are); all but p, timing, profile and push are changed.
    """
    period, h = timing[SERVO_PERIOD], timing[STEP]
    samples, substeps, stride = int(timing[VELOCITY_SAMPLES]), int(timing[SUBSTEPS]), int(timing[STRIDE])
    monitors = int(timing[MONITORS])
    delay, part, slot = int(m[DELAY_STEPS]), m[DELAY_SHARE], int(x[SLOT])
    late, arrives = delay > 0 or part > 0.0, part * h
    on_load = m[LOAD_SENSOR] == 1.0
    motor_position, motor, load_position = x[PLANT], x[PLANT + 1], x[PLANT + 2]
    load, torque, error_sum, against = x[PLANT + 3], x[PLANT + 4], x[PLANT + 5], x[PLANT + 6]
    row, since, coasting = 0, int(x[SINCE]), x[COASTING]
    most, last = int(timing[DRIVEN_ROWS]), len(profile) // WIDTH - 1
    # Servo samples since the start, that of the last motion, that of the end of the command (-1 before).
    sample, last_moved, ended = int(x[SAMPLE]), int(x[LAST_MOVED]), int(x[ENDED])
    piece, moment, share = int(x[PIECE]), x[MOMENT], x[SHARE]
    weight, pushed = m[GRAVITY], len(push)
    while True:
        start = sample * period
        if pushed > 0:
            # The load is constant over a servo period: the mean of the recorded torque at both ends of it.
            now, later = min(sample, pushed - 1), min(sample + 1, pushed - 1)
            m[GRAVITY] = weight - 0.5 * (push[now] + push[later])
            before[GRAVITY] = after[GRAVITY] = m[GRAVITY]
        piece = piece_at(profile, piece, moment)
        begun = moment
        command(profile, piece, begun, io)
        io[COMMAND_VELOCITY] *= share * timing[FORWARD]
        # The chain rule of a command whose time runs slower: once for each derivative.
        io[COMMAND_ACCELERATION] *= share * share * timing[FORWARD]
        io[TIME], io[TORQUE] = start, torque
        io[POSITION] = counted(
            m, load_position if on_load else motor_position, POSITION_COUNT, POSITION_COUNTS
        )
        io[MOTOR] = counted(m, motor_position, MOTOR_COUNT, MOTOR_COUNTS)
        passed_by = seen(timing, io[COMMAND], io[POSITION], load_position)
        if passed_by > 0 or sample >= timing[LAST_SAMPLE] or (piece == last and timing[TO_END] != 0.0):
            # The sample is not run: what is put away is the state before it, so that the same call goes on
            # there.
            x[PLANT], x[PLANT + 1], x[PLANT + 2] = motor_position, motor, load_position
            x[PLANT + 3], x[PLANT + 4], x[PLANT + 5], x[PLANT + 6] = load, torque, error_sum, against
            x[SAMPLE], x[LAST_MOVED], x[PIECE], x[MOMENT] = (
                float(sample),
                float(last_moved),
                float(piece),
                begun,
            )
            x[SHARE], x[SLOT], x[SINCE], x[COASTING] = share, float(slot), float(since), coasting
            x[SEEN] = float(passed_by)
            return row
        if coasting > 0.0:
            coasting -= period
            if coasting <= 0.0 or (abs(motor) < STANDSTILL and abs(load) < STANDSTILL):
                # Motor and load are where they came to rest; the rest of the state is that of a drive
                # without output.
                x[PLANT], x[PLANT + 2], x[COASTING] = motor_position, load_position, 0.0
                return row
        else:
            position_sample(p, s, io)
            # The reference of the control is behind the command by design: that is no error.
            error = abs(io[COMMAND] - io[REFERENCE_LAG] - io[POSITION])
            # An axis that waits in the middle of its command is not at its end, however still it is.
            if piece < last or error > timing[REST_BAND]:
                last_moved = sample
            if piece == last:
                if ended < 0:
                    ended = sample
                    x[ENDED] = float(ended)
                if (sample - last_moved) * period > timing[REST_TIME]:
                    return row
                if (sample - ended) * period > timing[SETTLE_TIME]:
                    return row
            if start >= timing[EMERGENCY]:
                io[STOP] = EMERGENCY_STOP
            # While a piece waits for the axis to be in position, the time of the command does not go on.
            if profile[piece * WIDTH + KIND] != IN_POSITION or error <= timing[IN_POSITION_BAND]:
                moment, share = fed(timing, begun, share, io[FEED_SHARE])
        sampled, velocity = io[COMMAND], io[COMMAND_VELOCITY]
        # By this the time of the command goes on between two samples: 1 but for an override or a wait.
        rate = (moment - begun) / period
        for k in range(samples):
            if coasting == 0.0:
                if k > 0:
                    io[TIME], io[TORQUE] = start + k * substeps * h, torque
                    io[MOTOR] = counted(m, motor_position, MOTOR_COUNT, MOTOR_COUNTS)
                velocity_sample(p, s, io)
            output = io[OUTPUT]
            for j in range(substeps):
                # The row of an alarm is written whatever the stride: it is the last that is shown of the
                # driven axis.
                if since == stride or (io[STOP] != 0.0 and coasting == 0.0):
                    if row >= most:
                        return row
                    since = 0
                    passed = (k * substeps + j) * h
                    if passed > 0.0:
                        between = begun + passed * rate
                        command(profile, piece_at(profile, piece, between), between, io)
                        io[COMMAND_VELOCITY] *= rate
                    measured = counted(
                        m, load_position if on_load else motor_position, POSITION_COUNT, POSITION_COUNTS
                    )
                    rows[row, 0] = start + passed
                    rows[row, 1] = io[COMMAND]
                    rows[row, 2] = io[COMMAND_VELOCITY]
                    rows[row, 3] = load_position
                    rows[row, 4] = measured
                    rows[row, 5] = io[COMMAND] - io[REFERENCE_LAG] - measured
                    rows[row, 6] = load
                    rows[row, 7] = output
                    rows[row, 8] = torque
                    for n in range(monitors):
                        rows[row, 9 + n] = io[MONITOR + n]
                    row += 1
                    # The law goes on with the command of its sample: that of the row was for the row alone.
                    io[COMMAND], io[COMMAND_VELOCITY] = sampled, velocity
                if io[STOP] != 0.0 and coasting == 0.0:
                    x[ALARM_ROW] = float(row - 1)
                    coasting = timing[COAST_TIME]
                    if coasting == 0.0 or io[STOP] == DIVERGED:
                        # Positions without bounds mean nothing: such an axis does not run out.
                        return row
                    # The control takes the output away and goes on with the command no more.
                    io[OUTPUT] = output = rate = 0.0
                    io[COMMAND_VELOCITY] = velocity = share = 0.0
                    most = rows.shape[0]  # the rows that were kept free for the way after an alarm
                    brake(m)
                    # A step that a delayed output cuts in two has arrays for the whole and for both parts:
                    # each has the brake.
                    brake(before)
                    brake(after)
                since += 1
                applied, machine, span = output, m, h
                if late:
                    older, applied = delayed(line, slot, delay, output)
                    slot = slot + 1 if slot + 1 < len(line) else 0
                    if part > 0.0 and older != applied:  # it arrives inside of the step, which is cut there
                        motor_position, motor, load_position, load, torque, error_sum, against = advance(
                            before,
                            motor_position,
                            motor,
                            load_position,
                            load,
                            torque,
                            error_sum,
                            against,
                            older,
                            arrives,
                        )
                        machine, span = after, h - arrives
                motor_position, motor, load_position, load, torque, error_sum, against = advance(
                    machine,
                    motor_position,
                    motor,
                    load_position,
                    load,
                    torque,
                    error_sum,
                    against,
                    applied,
                    span,
                )
        # Not ``>=``: a position that is no number any more is caught by this form alone.
        if not abs(motor_position) < _BOUNDLESS:
            io[STOP] = DIVERGED
        sample += 1
