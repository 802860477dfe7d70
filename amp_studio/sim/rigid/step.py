"""Scenario `step`: one commanded move of one axis, from rest to rest.

The axis moves with its own parameters; the result compares the manual's equations with the
simulated motion.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from amp_studio.sim.errors import SimulationError
from amp_studio.sim.rounding import rounded_up, shown
from amp_studio.sim.trace import Alarm, Figure, Trace

from . import kernel
from .engine import Engine, run_move_by
from .laws import RESPONSE_SHARE, response_time, steady_following_error
from .recommendations import recommend
from .servo import RAMPS, AxisServo

MOST_ROWS = 4_000_000
"""Most rows of a move, 16 minutes at the longest physics step; one row is 56 bytes."""
STEADY_SPEED = 1e-3
"""Largest relative difference from the feedrate of a constant command speed."""
STEADY_LAGS = 6.0
"""Number of time constants of the position loop after which a constant speed is steady."""
_PAUSE = 0.1
"""Time at rest in s at the end of every trace; longer for a slow loop."""

MODEL = (
    "position loop P with gain break and feed-forward, velocity loop PI, torque limit, rigid axis, counted"
    " feedback"
)

TEXTBOOK = (
    (
        "The axis is one rigid mass; screw, coupling and bearings have no elasticity and no backlash (Gross, Hamann,"
        " Wiegärtner, Electrical Feed Drives in Automation, 2001)."
    ),
    (
        "The current loop is ideal: the torque follows its command at once (same source; it is 5 to 10 times"
        " faster than the velocity loop)."
    ),
    (
        "Position is measured and the velocity command is set once in each servo period and constant in between (Franklin,"
        " Powell, Workman, Digital Control of Dynamic Systems, 1998)."
    ),
    (
        "The velocity loop is continuous and its feedback has no counts; the position feedback is rounded to"
        " the nearest count."
    ),
    (
        "The integral of the velocity error is frozen while the torque is limited and the error would increase it"
        " (Åström, Hägglund, PID Controllers, 1995)."
    ),
    (
        "While the feedrate is suppressed the command goes to half the feedrate and back by the same ramp as"
        " any other change of speed."
    ),
    "The simulated motion ends with an excess error alarm; how the axis then stops is not simulated.",
)


@dataclass(frozen=True)
class StepMove:
    """One move from rest: signed distance in the axis' unit, feedrate in unit/min, ramp, time in s.

    `mode` None means the axis' ramp for positioning; `duration` None ends when the axis is at rest.
    Raises SimulationError for an impossible move.
    """

    distance: float
    feedrate: float
    mode: str | None = None
    duration: float | None = None

    def __post_init__(self) -> None:
        if not (math.isfinite(self.distance) and self.distance != 0.0):
            raise SimulationError(f"The distance of the move is {self.distance:g}; it must not be 0")
        if not (math.isfinite(self.feedrate) and self.feedrate > 0.0):
            raise SimulationError(f"The feedrate of the move is {self.feedrate:g}; it must be above 0")
        if self.mode is not None and self.mode not in RAMPS:
            raise SimulationError(f"Unknown ramp '{self.mode}'. Known: {', '.join(RAMPS)}")
        if self.duration is not None and not 0.0 < self.duration < math.inf:
            raise SimulationError(f"The duration is {self.duration:g} s; it must be above 0")


def default_move(
    servo: AxisServo,
    distance: float | None = None,
    feedrate: float | None = None,
    mode: str | None = None,
    duration: float | None = None,
) -> StepMove:
    """Return a move at rapid feedrate that is long enough for the following error to
    settle.

    Raises SimulationError if no feedrate is known.
    """
    speed = next((f for f in (feedrate, servo.rapid_feedrate, servo.cutting_feedrate) if f is not None), None)
    if speed is None:
        raise SimulationError(
            "The rapid feedrate of the axis is not set. Give a feedrate for the move",
            servo.parameter("rapid_feedrate"),
        )
    if distance is None:
        probe = StepMove(1.0, speed, mode)
        ramps = _ramp_time(servo, probe)
        distance = rounded_up(speed / 60.0 * (ramps + 2.0 * STEADY_LAGS * _slowest_lag(servo)), 2)
    return StepMove(distance, speed, mode, duration)


def run_step(servo: AxisServo, move: StepMove, *, engine: Engine = "auto") -> Trace:
    """Run the move and return its trace.

    Columns have one row for each physics step (at most 0.25 ms): time_s in s, command_position, position and
    following_error in the axis' unit, command_velocity and velocity in unit/min, torque_percent in %. Raises
    SimulationError if the move is not possible (no time constant for an exponential ramp, a move that would
    take longer than MOST_ROWS rows).
    """
    loop, profile = servo.loop(), _profile(servo, move)
    substeps = servo.substeps
    likely, most = _rows(servo, move, profile)
    rows = np.empty((most, len(kernel.COLUMNS)))
    filled = run_move_by(engine, likely)(loop, profile, substeps, rows)
    rows = np.ascontiguousarray(rows[:filled].T)
    rows[4:6] *= 60.0
    columns = dict(zip(kernel.COLUMNS, rows, strict=True))
    alarms = _alarms(servo, columns)
    result = _figures(servo, move, columns, substeps, bool(alarms))
    return Trace(
        scenario="step",
        axis=servo.axis,
        model=f"{servo.model}: {MODEL}" if servo.model else MODEL,
        columns=columns,
        units=_units(servo.unit),
        result=result,
        alarms=alarms,
        recommendations=recommend(servo, move.feedrate, ramp_of(servo, move), result),
        assumptions=servo.assumptions + TEXTBOOK,
        limits=_limits(servo),
    )


def ramp_of(servo: AxisServo, move: StepMove) -> str:
    """Return the active ramp: a linear ramp of 0 is none (10-8)."""
    mode = move.mode or servo.positioning_ramp
    return "none" if mode == "linear" and servo.linear_acceleration == 0.0 else mode


def _ramp_time(servo: AxisServo, move: StepMove) -> float:
    """Return the time in s that the ramps add to distance / feedrate."""
    mode, speed = ramp_of(servo, move), move.feedrate / 60.0
    if mode == "linear":
        down = servo.linear_deceleration or servo.linear_acceleration
        return 0.5 * speed / servo.linear_acceleration + 0.5 * speed / down
    if mode == "exponential":
        constant = _time_constant(servo)
        return constant * max(1.0, math.log(max(speed * constant / _snap(servo, move), 1.0)))
    return 0.0


def _time_constant(servo: AxisServo) -> float:
    if servo.exponential_time is None:
        raise SimulationError(
            f"{servo.described('exponential_time')} is not set, but the move has an exponential ramp. Set it or choose another ramp",
            servo.parameter("exponential_time"),
        )
    return servo.exponential_time / 1000.0


def _snap(servo: AxisServo, move: StepMove) -> float:
    """Return the distance from the end at which an exponential command ends: one count, or a billionth of the move."""
    return max(0.0 if servo.ideal_feedback else servo.count, 1e-9 * abs(move.distance))


def _profile(servo: AxisServo, move: StepMove) -> kernel.Profile:
    mode = ramp_of(servo, move)
    return kernel.Profile(
        ramp={"none": kernel.NONE, "linear": kernel.LINEAR, "exponential": kernel.EXPONENTIAL}[mode],
        sign=math.copysign(1.0, move.distance),
        distance=abs(float(move.distance)),
        feedrate=move.feedrate / 60.0,
        acceleration=float(servo.linear_acceleration),
        deceleration=float(servo.linear_deceleration or servo.linear_acceleration),
        time_constant=_time_constant(servo) if mode == "exponential" else 1.0,
        snap=_snap(servo, move),
        settle=math.inf if move.duration is not None else _settling(servo, move),
        rest=max(servo.inposition_band, 0.0 if servo.ideal_feedback else 1.5 * servo.count),
        hold=math.inf if move.duration is not None else 3.0 / servo.position_rate + _PAUSE,
    )


def _slowest_lag(servo: AxisServo) -> float:
    """Return the longest time constant of the position loop in s, that above the gain break if there is one."""
    return 1.0 / (servo.position_rate * (servo.break_ratio or 1.0))


def _settling(servo: AxisServo, move: StepMove) -> float:
    """Return the most time in s to wait for the axis to come to rest after the end of the command.

    Twelve time constants of the position loop; the time down to the gain break; six integral times of the
    velocity loop, but not more than 5 s.
    """
    lag = 1.0 / servo.position_rate
    wait = 12.0 * lag + _PAUSE
    if servo.integral_rate > 0.0:
        wait += min(6.0 / servo.integral_rate, 5.0)
    if servo.break_ratio < 1.0 and servo.gain_break_point < abs(move.distance):
        slow = 12.0 * lag / servo.break_ratio if servo.break_ratio else math.inf
        furthest = min(servo.excess_error, abs(move.distance))
        steady = furthest * lag / servo.gain_break_point if servo.gain_break_point else math.inf
        extra = min(slow, steady)
        wait += extra if math.isfinite(extra) else 0.0
    return wait


def _rows(servo: AxisServo, move: StepMove, profile: kernel.Profile) -> tuple[int, int]:
    """Return (expected rows, most rows); the move may take twice as long at half the feedrate."""
    period = servo.servo_period / 1000.0
    if move.duration is not None:
        likely = most = move.duration
    else:
        moving = abs(move.distance) / profile.feedrate + _ramp_time(servo, move) + 4.0 * period
        likely, most = moving + profile.hold, 2.0 * moving + profile.settle
    per_second = servo.substeps / period
    if likely * per_second > MOST_ROWS:
        raise SimulationError(
            f"The move takes about {likely:.0f} s, more than can be simulated ({MOST_ROWS / per_second:.0f}"
            " s). Give a shorter distance or a higher feedrate"
        )
    return math.ceil(likely * per_second), min(math.ceil(most * per_second - 1e-6), MOST_ROWS)


def _alarms(servo: AxisServo, columns: Mapping[str, npt.NDArray[np.float64]]) -> tuple[Alarm, ...]:
    """Return the excess error alarm if the last measured following error is above it."""
    last = float(abs(columns["following_error"][-1]))
    if not last > servo.excess_error or len(columns["time_s"]) % servo.substeps != 1 % servo.substeps:
        return ()
    moment = float(columns["time_s"][-1])
    return (
        Alarm(
            "EXCESS FOLLOWING ERROR",
            moment,
            f"Following error {shown(last, servo.unit)} is above {servo.described('excess_error')},"
            f" {shown(servo.excess_error, servo.unit)}; the control goes into E-STOP and the move ends.",
        ),
    )


def _figures(
    servo: AxisServo,
    move: StepMove,
    columns: Mapping[str, npt.NDArray[np.float64]],
    substeps: int,
    stopped: bool,
) -> dict[str, Figure]:
    """Return the named figures. The following error is that at the servo periods, as the control measures it."""
    unit, period = servo.unit, servo.servo_period / 1000.0
    error = np.abs(columns["following_error"][::substeps])
    torque, speed = columns["torque_percent"], np.abs(columns["velocity"])
    forward = columns["position"] * math.copysign(1.0, move.distance)
    predicted = steady_following_error(servo, move.feedrate)
    limited = (torque >= servo.torque_limit_positive) | (torque <= -servo.torque_limit_negative)
    quick = np.flatnonzero(speed >= RESPONSE_SHARE * move.feedrate)
    in_position, settle = (None, None) if stopped else _settled(servo, move, columns, substeps)
    return {
        "distance": (move.distance, unit),
        "feedrate": (move.feedrate, f"{unit}/min"),
        "predicted_following_error": (predicted if math.isfinite(predicted) else None, unit),
        "steady_following_error": (_steady(servo, move, columns, substeps), unit),
        "peak_following_error": (float(error.max()), unit),
        "peak_torque": (float(np.abs(torque).max()), "%"),
        "time_at_torque_limit": (float(limited.sum()) * period / substeps, "s"),
        "predicted_response_time": (response_time(servo), "s"),
        "response_time": (float(columns["time_s"][quick[0]]) if quick.size else None, "s"),
        "in_position_time": (in_position, "s"),
        "settle_time": (settle, "s"),
        "overshoot": (max(0.0, float(forward.max()) - abs(move.distance)), unit),
        "time_in_feedrate_suppression": (float((error > servo.feedrate_suppression).sum()) * period, "s"),
    }


def _steady(
    servo: AxisServo, move: StepMove, columns: Mapping[str, npt.NDArray[np.float64]], substeps: int
) -> float | None:
    """Return the mean following error (without sign) at the end of the longest stretch of constant feedrate.

    None if the stretch is shorter than STEADY_LAGS time constants or the error still changes in it.
    """
    error = np.abs(columns["following_error"][::substeps])
    constant = np.abs(np.abs(columns["command_velocity"][::substeps]) / move.feedrate - 1.0) <= STEADY_SPEED
    edges = np.flatnonzero(np.diff(np.concatenate(([0], constant.astype(np.int8), [0]))))
    starts, ends = edges[::2], edges[1::2]
    if starts.size == 0:
        return None
    longest = int(np.argmax(ends - starts))
    start, end = int(starts[longest]), int(ends[longest])
    if (end - start) * servo.servo_period / 1000.0 < STEADY_LAGS * _slowest_lag(servo):
        return None
    # The first sample of the stretch ends the ramp; the sample after it still belongs to the constant speed.
    window = error[end - max(1, (end - start) // 10) : end]
    mean = float(window.mean())
    counts = 0.0 if servo.ideal_feedback else 3.0 * servo.count
    if float(window.max() - window.min()) > max(counts, 0.01 * mean, 1e-9 * abs(move.distance)):
        return None
    return mean


def _settled(
    servo: AxisServo, move: StepMove, columns: Mapping[str, npt.NDArray[np.float64]], substeps: int
) -> tuple[float | None, float | None]:
    """Return (time in s from the start of the move, time in s from the end of the command) of reaching the
    position.

    In position is the first servo period from which the measured position stays within the inposition band of
    the end of the move (7-24). (None, None) if the command or the axis does not reach it.
    """
    time = columns["time_s"][::substeps]
    command = columns["command_position"][::substeps]
    arrived = np.flatnonzero(command == move.distance)
    if arrived.size == 0:
        return None, None
    off = np.abs(move.distance - (command - columns["following_error"][::substeps]))
    outside = np.flatnonzero(off > servo.inposition_band)
    first = int(outside[-1]) + 1 if outside.size else 0
    if first >= time.size:
        return None, None
    moment = float(time[first])
    return moment, max(0.0, moment - float(time[arrived[0]]))


def _limits(servo: AxisServo) -> dict[str, Figure]:
    levels = {
        "excess error": servo.excess_error,
        "feedrate suppression": servo.feedrate_suppression,
        "inposition band": servo.inposition_band,
    }
    if servo.break_ratio < 1.0:
        levels["gain break point"] = servo.gain_break_point
    return {name: (level, servo.unit) for name, level in levels.items() if math.isfinite(level)}


def _units(unit: str) -> dict[str, str]:
    return dict(zip(kernel.COLUMNS, ("s", unit, unit, unit, f"{unit}/min", f"{unit}/min", "%"), strict=True))
