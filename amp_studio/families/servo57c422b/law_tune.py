"""The three tune commands of the 57C422B on the simulated axis (pages 4-29 to 4-31).

Printed: the order of the commands and of the gains, what each needs, what it leaves, and that the axis moves
both ways. How the module searches is not printed. Here it searches as a person would by sections 5.2.2 of the
manual: a gain is doubled until the shaft vibrates, the edge is found by halves, and a third of it is left:
ASSUMED, and in the result.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from amp_studio.sim import (
    OUTPUT_TEST,
    POLYNOMIAL,
    POSITION_LOOP,
    VELOCITY_LOOP,
    AxisLaw,
    Motion,
    Piece,
    RunEnd,
    SimulationError,
    end_of,
    linear_model,
    move,
    profile_of,
    run_axis,
)

from . import law_sample as loop
from .law_facts import ids

LARGEST = 32767
"""Of a register of 16 bits."""
_LEFT = 1.0 / 3.0
"""Share of the gain at which the shaft vibrates that a tune leaves."""
_HALVES = 6
_QUIET = 40.0
"""Counts that a shaft at rest may go to and fro in 0.1 s: two counts wide at 100 Hz."""
WAY = 0.1
"""s of each of the four ramps of the move there and back."""
_REST = 0.2
"""s of rest after it, of which the last half is checked."""


@dataclass(frozen=True)
class Scales:
    """Register number of 1 in the parameters of the loop."""

    proportional: float = 1.0
    integral: float = 1.0
    feed_forward: float = 1.0
    velocity: float = 1.0


@dataclass(frozen=True)
class CommandResult:
    """What a command leaves: registers by parameter id, and the axis with them."""

    registers: dict[str, float]
    axis: AxisLaw


def gains(axis: AxisLaw, scales: Scales, increment: float) -> CommandResult:
    """Tune gains: deadband, velocity, integral and proportional gain,
    with moves of ``increment`` counts both ways.

    Raises SimulationError where the shaft vibrates at the least gain.
    """
    faults = {place: axis.parameters[place] for place in (loop.POSITION_ERROR, loop.VELOCITY_ERROR)}
    # Without faults: at the gain that is sought the shaft vibrates, which is not to end the search.
    axis = _with_figures(axis, {loop.POSITION_ERROR: -1.0, loop.VELOCITY_ERROR: -1.0, loop.INTEGRAL: 0.0})
    found = {ids.gain_deadband: deadband(axis)}
    axis = _with_figures(axis, {loop.DEADBAND: found[ids.gain_deadband]})
    if axis.parameters[loop.CURRENT_REFERENCE] > 0.0:

        def velocity(gain: float) -> bool:
            trial = _with_figures(axis, {loop.VELOCITY: gain / scales.velocity})
            # The velocity loop alone: position gains have no part in it yet.
            return vibrates(trial, increment, VELOCITY_LOOP)

        found[ids.gain_velocity] = _third_of_gain("Velocity Gain", velocity)
        axis = _with_figures(axis, {loop.VELOCITY: found[ids.gain_velocity] / scales.velocity})

    def proportional(gain: float) -> bool:
        # Without feed-forward, which moves the axis but has no part in its stability.
        trial = {loop.PROPORTIONAL: gain / scales.proportional, loop.FEED_FORWARD: 0.0}
        return vibrates(_with_figures(axis, trial), increment, POSITION_LOOP)

    gain = _third_of_gain("Proportional Gain", proportional)
    share = gain / scales.proportional
    found[ids.gain_integral] = float(
        math.floor(share * share / 4.0 * scales.integral)
    )  # the aperiodic limit of both
    found[ids.gain_proportional] = gain
    integral = found[ids.gain_integral] / scales.integral
    tuned = _with_figures(axis, {loop.PROPORTIONAL: share, loop.INTEGRAL: integral, **faults})
    # The search looks at the shaft for 0.1 s: a slow growth is not seen there.
    if not linear_model(tuned).is_stable():
        raise SimulationError(
            "The search ended at gains that are not stable: this axis has to be tuned by hand (page 5-2)"
        )
    return CommandResult(found, tuned)


def dynamics(axis: AxisLaw, travel: float, speed: float, up: float, down: float) -> CommandResult:
    """Tune dynamics: the greatest velocity, acceleration and deceleration, at most those given,
    in counts and s.

    Greatest are those at which the axis moves ``travel`` counts there and back,
    with neither fault nor clamped output.
    """

    def good(velocity: float, acceleration: float, deceleration: float) -> bool:
        ramp = replace(axis.ramps["linear"], acceleration=acceleration, deceleration=deceleration)
        return all(
            not _overloads(axis, run(axis, move(way * travel, velocity, ramp), 0.05)) for way in (1.0, -1.0)
        )

    gentle = 1.25 / travel  # ramps that leave a fifth of the travel for the speed itself
    velocity = _greatest(speed, lambda v: good(v, gentle * v * v, gentle * v * v))
    # The gentle ramp at the other end, so that only one figure is tried at a time.
    acceleration = _greatest(up, lambda a: good(velocity, a, min(a, gentle * velocity**2)))
    deceleration = _greatest(down, lambda d: good(velocity, min(acceleration, gentle * velocity**2), d))
    deceleration = min(max(deceleration, acceleration / 5.0), acceleration * 5.0)  # page 4-14
    found = {
        ids.command_velocity: velocity,
        ids.command_acceleration: acceleration,
        ids.command_deceleration: deceleration,
    }
    ramp = replace(axis.ramps["linear"], acceleration=acceleration, deceleration=deceleration)
    return CommandResult(found, replace(axis, feedrate=velocity, ramps={**axis.ramps, "linear": ramp}))


def feed_forward(
    axis: AxisLaw, scales: Scales, positive: float, negative: float, speed: float
) -> CommandResult:
    """Tune feedforward: the greatest gain that leaves no negative following error
    at ``speed`` counts/s either way.

    ``positive`` and ``negative`` are the limits of the travel from the present position, in counts.
    """
    quiet = _with_figures(axis, {loop.INTEGRAL: 0.0, loop.POSITION_ERROR: -1.0, loop.VELOCITY_ERROR: -1.0})

    def error(share: float) -> float:
        trial = _with_figures(quiet, {loop.FEED_FORWARD: share})
        # The direction that is ahead sooner decides: the error must not be negative in either.
        return min(_at_speed(trial, positive, speed), _at_speed(trial, negative, speed))

    low, high = 0.0, 1.0
    first, second = error(low), error(high)
    share = low if first <= second else first / (first - second)  # the error falls in a straight line
    if not 0.0 <= share * scales.feed_forward <= LARGEST:
        raise SimulationError(
            f"No Feedforward Gain from 0 to {LARGEST} takes the following error of {first:.6g} counts away",
            ids.gain_feedforward,
        )
    gain = float(math.floor(share * scales.feed_forward))
    return CommandResult(
        {ids.gain_feedforward: gain}, _with_figures(axis, {loop.FEED_FORWARD: gain / scales.feed_forward})
    )


def _with_figures(axis: AxisLaw, figures: dict[int, float]) -> AxisLaw:
    """Return the axis with other figures of its loop; its linear model has the same gains."""
    parameters, linear = list(axis.parameters), list(axis.linear_parameters or axis.parameters)
    for place, value in figures.items():
        if place != loop.DEADBAND:  # which is a step
            linear[place] = value
        parameters[place] = value
    return replace(axis, parameters=parameters, linear_parameters=linear)


def run(axis: AxisLaw, profile: list[float], rest: float, mode: float = POSITION_LOOP) -> Motion:
    """Run a profile and ``rest`` s after it."""
    return run_axis(axis, profile, RunEnd(end_of(profile) + rest), mode=mode)


def deadband(axis: AxisLaw) -> float:
    """Return the greatest output in words at which the axis stays at rest, both ways."""
    clamp = axis.parameters[loop.CLAMP]
    found = []
    for way in (1.0, -1.0):
        coarse = _breakaway(axis, 0.0, way * clamp)
        found.append(abs(_breakaway(axis, 0.5 * coarse, coarse)))  # once more, slowly
    # The smaller of both directions, rounded down: more would move an axis that is to rest.
    return float(math.floor(min(found)))


def _breakaway(axis: AxisLaw, start: float, end: float) -> float:
    """Return the output in words at which the axis begins to move,
    of one that rises from ``start`` to ``end`` in 1 s.
    """
    volts, rise = start / loop.WORDS_PER_VOLT, (end - start) / loop.WORDS_PER_VOLT
    ramp = [0.0, math.inf, volts, rise, 0.0, 0.0, POLYNOMIAL, 0.0]
    motion = run_axis(axis, ramp, RunEnd(1.0), mode=OUTPUT_TEST)
    moved = np.flatnonzero(np.abs(motion.columns["measured_position"]) >= 1.0)
    if moved.size == 0:
        raise SimulationError(
            f"The axis does not move with {abs(end) / loop.WORDS_PER_VOLT:.3g} V: its friction is above"
            " Maximum Voltage Reference",
            ids.max_voltage,
        )
    return float(motion.columns["output"][moved[0]]) * loop.WORDS_PER_VOLT


def vibrates(axis: AxisLaw, increment: float, mode: float) -> bool:
    """Return whether the shaft vibrates at rest after a move of ``increment`` counts there and back."""
    ramp = increment / WAY**2
    speed = ramp * WAY
    there_and_back = [Piece(WAY, 0.0, ramp), Piece(2.0 * WAY, speed, -ramp), Piece(WAY, -speed, ramp)]
    motion = run(axis, profile_of(there_and_back, 0.0), _REST, mode)
    position = motion.columns["position"]
    last = position[motion.columns["time_s"] > 4.0 * WAY + 0.5 * _REST]
    if motion.stop != 0 or last.size < 2:
        return True
    # Less the way from first to last: creeping to the end is no vibration.
    to_and_fro = float(np.abs(np.diff(last)).sum()) - abs(float(last[-1] - last[0]))
    return to_and_fro > _QUIET


def _third_of_gain(name: str, too_much: Callable[[float], bool]) -> float:
    """Return a third of the gain from which on the shaft vibrates,
    of the largest register where it never does.
    """
    low, high = 0.0, 25.0
    if too_much(high):
        raise SimulationError(f"The shaft vibrates at a {name} of {high:g}: it cannot be tuned")
    while high < LARGEST and not too_much(high):
        low, high = high, min(2.0 * high, float(LARGEST))
    for _ in range(_HALVES):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if too_much(middle) else (middle, high)
    return float(math.floor(low * _LEFT))


def _greatest(most: float, good: Callable[[float], bool]) -> float:
    """Return the greatest figure up to ``most`` that is good, to a 64th;
    raises SimulationError where none is.
    """
    if good(most):
        return most
    low, high = 0.0, most
    for _ in range(_HALVES + 4):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if good(middle) else (low, middle)
    if low == 0.0:
        raise SimulationError(
            "The axis follows at no speed without a fault or a clamped output: tune its gains first"
        )
    return low


def _overloads(axis: AxisLaw, motion: Motion) -> bool:
    """Return whether a run ended in a fault or reached the clamp of register 31."""
    clamp = axis.parameters[loop.CLAMP] / loop.WORDS_PER_VOLT
    return motion.stop != 0 or float(np.abs(motion.columns["output"]).max()) >= clamp * (1.0 - 1e-9)


def _at_speed(axis: AxisLaw, travel: float, speed: float) -> float:
    """Return the mean following error at speed, positive for an axis that is behind,
    of a move of ``travel`` counts.
    """
    profile = move(travel, speed, axis.ramps["linear"])
    motion = run(axis, profile, 0.0)
    columns = motion.columns
    even = np.flatnonzero(np.abs(np.abs(columns["command_velocity"]) - speed) < 1e-6 * speed)
    if even.size < 8:
        raise SimulationError(
            f"The axis does not reach {speed:g} counts/s within {abs(travel):g} counts: the travel limits are"
            " too near",
            ids.setup_overtravel_positive,
        )
    # The second half of the constant speed: in the first the ramp still dies away.
    return float(columns["following_error"][even[even.size // 2 :]].mean()) * math.copysign(1.0, travel)
