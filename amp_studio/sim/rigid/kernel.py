"""One move of one servo axis, from servo period to servo period: the inner loop, over plain floats and one
array.

All compiled code is in this one file: numba's cache notices changes of the file it compiled
from, and of no other. The source is ordinary Python and runs without numba, with equal results; `engine.py`
chooses.

Once a servo period (the SERCOS cycle, which the 9/PC AMP manual calls the servo update rate, 7-4) the
position is measured, the following error is checked, and the velocity command is set and kept constant, a
zero-order hold as in G. F. Franklin, J. D. Powell, M. L. Workman, Digital Control of Dynamic Systems (1998).
Within the period velocity loop, torque limit and axis run in physics steps. Their states are position x,
speed v and the sum w of the velocity error:

    velocity error      e  = vc - v
    acceleration asked  a* = kp e + kp ki w                       (PI, series form)
    torque              M  = 100 a* / a_rated, cut to [-M_neg, +M_pos]       in % of rated torque
    axis                dv/dt = a_rated M / 100 - viscous v - friction(v),   dx/dt = v

Sources, 9/PC AMP manual: proportional and integral share added into an acceleration command 7-54, 7-56 and
block diagram 7-9; discharge of the sum 7-58; torque limits 7-61, 7-62; ramps 10-8, 10-10; exponential speed
10-14. Textbooks: PI in series form, and holding the sum while the output is cut, K. J. Åström, T. Hägglund,
PID Controllers: Theory, Design, and Tuning (1995); cascade of position and velocity loop on a rigid axis, H.
Gross, J. Hamann, G. Wiegärtner, Electrical Feed Drives in Automation (2001); ramps in discrete time, S.-H.
Suh, S.-K. Kang, D.-H. Chung, I. Stroud, Theory and Design of CNC Systems (2008).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

COLUMNS = (
    "time_s",
    "command_position",
    "position",
    "following_error",
    "command_velocity",
    "velocity",
    "torque_percent",
)

NONE, LINEAR, EXPONENTIAL = 0.0, 1.0, 2.0
"""How the speed of the command changes."""


class Loop(NamedTuple):
    """The data of the axis. Lengths in the axis' unit (mm or deg), times in s; all floats."""

    servo_period: float
    position_gain: float
    """1/s: commanded speed per following error."""
    gain_break_point: float
    gain_break_ratio: float
    feed_forward: float
    """Share of the command velocity added to the velocity command, 0 to 1."""
    velocity_rate: float
    """kp, 1/s."""
    integral_rate: float
    """ki, 1/s."""
    discharge: float
    """Discharge rate of the integral of the velocity error, as a multiple of its charge rate."""
    rated_acceleration: float
    """unit/s2 at 100 % torque, above 0."""
    torque_positive: float
    """%"""
    torque_negative: float
    """%, as a positive number."""
    viscous: float
    """1/s."""
    coulomb: float
    """unit/s2."""
    resolution: float
    """Travel of one encoder count; 0 for ideal feedback."""
    feedrate_suppression: float
    excess_error: float


class Profile(NamedTuple):
    """The command of a move; all floats, lengths in the axis' unit, times in s."""

    ramp: float
    """NONE, LINEAR or EXPONENTIAL."""
    sign: float
    """+1.0 or -1.0: the direction."""
    distance: float
    """Without sign."""
    feedrate: float
    """unit/s."""
    acceleration: float
    """unit/s2, above 0 when the ramp is LINEAR."""
    deceleration: float
    """unit/s2, above 0 when the ramp is LINEAR."""
    time_constant: float
    """s, above 0 when the ramp is EXPONENTIAL."""
    snap: float
    """Remaining distance below which an exponential command jumps to its end."""
    settle: float
    """Most time in s after the end of the command; infinite to fill all rows."""
    rest: float
    """Largest following error of an axis at rest, after the end of the command."""
    hold: float
    """Time at rest in s that ends the move; infinite to fill all rows."""


def velocity_asked(f: Loop, following_error: float) -> float:
    """Return the speed in unit/s that the position loop commands.

    Proportional to the following error up to the gain break point (7-25); the part beyond it counts only
    ``gain_break_ratio`` times (7-22, 7-27): the slope changes, without a step.
    """
    size = abs(following_error)
    if size > f.gain_break_point:
        size = f.gain_break_point + f.gain_break_ratio * (size - f.gain_break_point)
    return math.copysign(f.position_gain * size, following_error)


def measured(f: Loop, position: float) -> float:
    """Return the measured position: the nearest whole count (7-33)."""
    if f.resolution == 0.0:
        return position
    return math.floor(position / f.resolution + 0.5) * f.resolution


def wanted_torque(f: Loop, velocity_command: float, speed: float, error_sum: float) -> float:
    """Return the torque commanded by the velocity loop, in % of rated torque, before the limit (7-54, 7-56)."""
    wanted = f.velocity_rate * ((velocity_command - speed) + f.integral_rate * error_sum)
    return 100.0 * wanted / f.rated_acceleration


def limited_torque(f: Loop, torque: float) -> float:
    """Return a torque in % clamped to the two torque limits (7-61, 7-62)."""
    return min(max(torque, -f.torque_negative), f.torque_positive)


def rates(
    f: Loop, velocity_command: float, speed: float, error_sum: float, dry: float
) -> tuple[float, float]:
    """Return (dv/dt, dw/dt) in unit/s2 and unit/s; ``dry`` is the dry friction in unit/s2 with its sign.

    The sum w discharges ``discharge`` times faster than it charges (7-58), and is frozen while the torque is limited and
    the error would increase it further (conditional integration, Åström and Hägglund).
    """
    error = velocity_command - speed
    wanted = wanted_torque(f, velocity_command, speed, error_sum)
    torque = limited_torque(f, wanted)
    gathered = error
    if wanted != torque and error * wanted > 0.0:
        gathered = 0.0
    elif error * error_sum < 0.0:
        gathered = error * f.discharge
    return f.rated_acceleration * torque / 100.0 - f.viscous * speed - dry, gathered


def advance(
    f: Loop, velocity_command: float, position: float, speed: float, error_sum: float, h: float
) -> tuple[float, float, float]:
    """Return position, speed and error sum ``h`` seconds later at a constant velocity command (Runge-Kutta 4).

    Dry friction has the sign of the speed over the whole step. An axis at rest stays at rest until the torque is
    above the friction, and an axis whose speed changes its sign in a step is at rest at its end (after D. Karnopp,
    Computer Simulation of Stick-Slip Friction in Mechanical Dynamic Systems, ASME Journal of Dynamic Systems,
    Measurement, and Control 107, 1985).
    """
    dry = 0.0
    if f.coulomb > 0.0:
        push, gathered = rates(f, velocity_command, speed, error_sum, 0.0)
        if speed == 0.0 and abs(push) <= f.coulomb:
            return position, 0.0, error_sum + h * gathered
        dry = math.copysign(f.coulomb, push if speed == 0.0 else speed)
    v1, w1 = rates(f, velocity_command, speed, error_sum, dry)
    speed2 = speed + 0.5 * h * v1
    v2, w2 = rates(f, velocity_command, speed2, error_sum + 0.5 * h * w1, dry)
    speed3 = speed + 0.5 * h * v2
    v3, w3 = rates(f, velocity_command, speed3, error_sum + 0.5 * h * w2, dry)
    speed4 = speed + h * v3
    v4, w4 = rates(f, velocity_command, speed4, error_sum + h * w3, dry)
    moved = h * (speed + 2.0 * speed2 + 2.0 * speed3 + speed4) / 6.0
    reached = speed + h * (v1 + 2.0 * v2 + 2.0 * v3 + v4) / 6.0
    if reached * dry < 0.0:
        reached = 0.0
    return position + moved, reached, error_sum + h * (w1 + 2.0 * w2 + 2.0 * w3 + w4) / 6.0


def linear_step(
    p: Profile, progress: float, speed: float, feedrate: float, period: float
) -> tuple[float, float]:
    """Return (progress, speed) one servo period later under the linear ramps (10-8, 10-10).

    The speed rises and falls by the ramps towards ``feedrate``, and never above the speed from which the
    deceleration can still stop at the end: with the mean of the old and the new speed over the period,
    rest - (v + v') T / 2 = v'^2 / 2d, solved for v'.
    """
    rest = p.distance - progress
    if speed <= feedrate:
        wanted = min(speed + p.acceleration * period, feedrate)
    else:
        wanted = max(speed - p.deceleration * period, feedrate)
    half = 0.5 * p.deceleration * period
    under = half * half + p.deceleration * (2.0 * rest - speed * period)
    stopping = math.sqrt(under) - half if under > 0.0 else 0.0
    following = max(min(wanted, stopping), 0.0)
    step = 0.5 * (speed + following) * period
    if following == 0.0 or step >= rest:
        return p.distance, 0.0
    return progress + step, following


def next_command(
    p: Profile, progress: float, speed: float, fed: float, feedrate: float, period: float
) -> tuple[float, float, float]:
    """Return (progress, speed, fed) of the command one servo period later, in unit, unit/s, unit.

    All three are measured along the move and never negative. ``feedrate`` is the active one (halved
    while suppressed, 7-21). ``fed`` is the input of the exponential filter so far: the programmed
    feedrate passes a first-order lag, v += (F - v)(1 - exp(-T / time constant)), which keeps the distance
    (10-14).
    """
    if p.ramp == LINEAR:
        progress, speed = linear_step(p, progress, speed, feedrate, period)
        return progress, speed, progress
    if p.ramp == EXPONENTIAL:
        given = min(feedrate * period, p.distance - fed)
        share = 1.0 - math.exp(-period / p.time_constant)
        speed = speed + (given / period - speed) * share
        progress = progress + speed * period
        fed = fed + given
        rest = p.distance - progress
        if fed >= p.distance and rest <= p.snap and speed * period + rest <= p.feedrate * period:
            return p.distance, 0.0, p.distance
        return progress, speed, fed
    step = min(feedrate * period, p.distance - progress)
    return progress + step, step / period, progress + step


def run_move(f: Loop, p: Profile, substeps: int, rows: npt.NDArray[np.float64]) -> int:
    """Run one move from rest, fill ``rows``, and return the number of filled rows.

    ``rows`` is (n, 7) float64, one row for each physics step (``substeps`` per servo period), columns as
    COLUMNS in s, unit, unit/s and %. Fewer than n rows are filled when the excess error ended the move (the
    last row is then the first servo period with the error above it, 7-20), or when the command has ended and
    the axis has been at rest for ``hold``, or ``settle`` has passed.
    """
    h = f.servo_period / substeps
    position, speed, error_sum = 0.0, 0.0, 0.0
    progress, command_speed, fed = 0.0, 0.0, 0.0
    row, period, ended, restless = 0, 0, -1, 0
    while True:
        command = p.sign * progress
        following_error = command - measured(f, position)
        size = abs(following_error)
        stopped = size > f.excess_error
        if ended < 0 and progress >= p.distance:
            ended = period
        if ended < 0 or size > p.rest:
            restless = period
        if (period - restless) * f.servo_period > p.hold:
            return row
        if ended >= 0 and (period - ended) * f.servo_period > p.settle:
            return row
        feedrate = 0.5 * p.feedrate if size > f.feedrate_suppression else p.feedrate
        reached, command_speed, fed = next_command(p, progress, command_speed, fed, feedrate, f.servo_period)
        moved = p.sign * (reached - progress)
        command_velocity = moved / f.servo_period
        velocity_command = velocity_asked(f, following_error) + f.feed_forward * command_velocity
        for j in range(substeps):
            if row >= rows.shape[0]:
                return row
            now = command + moved * j / substeps
            rows[row, 0] = period * f.servo_period + j * h
            rows[row, 1] = now
            rows[row, 2] = position
            rows[row, 3] = now - measured(f, position)
            rows[row, 4] = command_velocity
            rows[row, 5] = speed
            rows[row, 6] = limited_torque(f, wanted_torque(f, velocity_command, speed, error_sum))
            row += 1
            if stopped:
                return row
            position, speed, error_sum = advance(f, velocity_command, position, speed, error_sum, h)
        progress = reached
        period += 1
