"""A single commanded move: its settings, the profile it makes, and when it is over."""

from __future__ import annotations

import math
from dataclasses import dataclass

from amp_studio.sim.command.ramps import Override, blocks, end_of, move, overridden
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import RAMPS, AxisLaw, Ramp
from amp_studio.sim.rounding import rounded_up
from amp_studio.sim.scenario import ScenarioSettings, above_zero, number

from .motion import RunEnd

MOVE_SETTINGS = {
    "move.distance": "distance of the move, with its sign (mm or deg)",
    "move.feedrate": "feedrate of the move (mm/min or deg/min); default: the rapid feedrate",
    "move.mode": f"ramp: {', '.join(RAMPS)}; default: the axis' ramp for positioning",
    "move.duration": "time to simulate (s); default: until the axis is at rest",
    "move.override": "share of the feedrate from move.override_time on (%); 0 for feedhold",
    "move.override_time": "when the override changes (s)",
    "move.resume_time": "when the override goes back to 100 % (s)",
    "move.blocks": "number of equal blocks that the move has",
    "move.corner": "between the blocks: exact-stop or contour",
    "move.emergency_time": "when the emergency stop takes the output from the drive (s)",
}

PAUSE = 0.1
"""Time at rest in s at the end of every trace; longer for a slow loop."""
_LONGEST_WAIT = 12.0
"""Time constants of the position loop after the end of the command,
after which an axis is not waited for any more."""
_LONGEST_SETTLING = 5.0
"""s more than that."""
_LONG_STRETCH = 1e5
"""s of a move that reaches its feedrate by any ramp."""
_FOLLOWED = 5.0
"""Time constants of the position loop, or of an exponential ramp, until the axis follows its command."""
STEADY_LAGS = 6.0
"""Number of time constants of the position loop after which a constant speed can be steady."""


@dataclass(frozen=True)
class Move:
    """What is commanded: u, u/s, the ramp."""

    distance: float
    feedrate: float
    ramp: Ramp
    profile: list[float]

    @property
    def share_rate(self) -> float:
        """1/s: how fast the control changes the share of the feedrate."""
        return self.ramp.acceleration / self.feedrate if self.ramp.acceleration > 0.0 else math.inf


def move_of(axis: AxisLaw, settings: ScenarioSettings) -> Move:
    """Return what is commanded; raises SimulationError for an impossible move."""
    feedrate, ramp = feedrate_of(axis, settings), ramp_of(axis, settings)
    count = axis.machine.position_count
    distance = number(settings, "move.distance")
    if distance == 0.0:
        raise SimulationError("move.distance is 0; it must not be 0", "move.distance")
    if distance is None:
        # So long a move takes _LONG_STRETCH s at its feedrate: what it takes beyond that are its ramps.
        ramps = end_of(move(_LONG_STRETCH * feedrate, feedrate, ramp, count)) - _LONG_STRETCH
        distance = rounded_up(feedrate * (max(ramps, 0.0) + 2.0 * STEADY_LAGS / axis.position_rate), 2)
    if not (math.isfinite(distance) and abs(distance) / feedrate < math.inf):
        raise SimulationError("The move is too long to be simulated. Give move.distance", "move.distance")
    overrides, parts = _overrides(settings), _parts(settings)
    if parts > 1:
        if overrides:
            raise SimulationError(
                "A move in blocks has no override here: leave out one of both", "move.blocks"
            )
        exact = _exact(settings)
        profile = blocks(
            [(distance / parts, feedrate)] * parts, ramp, exact_stop=exact, check=axis.servo_period
        )
    elif overrides:
        profile = overridden(distance, feedrate, ramp, overrides, count)
    else:
        profile = move(distance, feedrate, ramp, count)
    return Move(distance, feedrate, ramp, profile)


def _overrides(settings: ScenarioSettings) -> list[Override]:
    """Return when the override of the feed changes in a move; raises SimulationError."""
    share, start = number(settings, "move.override"), number(settings, "move.override_time")
    resumed = number(settings, "move.resume_time")
    if share is None and start is None and resumed is None:
        return []
    if share is None or start is None:
        raise SimulationError("Give move.override and move.override_time together", "move.override")
    if share < 0.0 or not 0.0 < start < (math.inf if resumed is None else resumed):
        raise SimulationError(
            "The override must not be negative, and its times above 0 and in their order", "move.override"
        )
    overrides = [Override(start, share / 100.0)]
    if resumed is not None:
        overrides.append(Override(resumed, 1.0))
    return overrides


def _parts(settings: ScenarioSettings) -> int:
    parts = number(settings, "move.blocks")
    if parts is None:
        return 1
    if not (parts == int(parts) and 1 <= parts <= 1000):
        raise SimulationError(
            f"move.blocks is {parts:g}; it must be a whole number from 1 to 1000", "move.blocks"
        )
    return int(parts)


def _exact(settings: ScenarioSettings) -> bool:
    corner = settings.get("move.corner", "exact-stop")
    if corner not in ("exact-stop", "contour"):
        raise SimulationError(f"move.corner is '{corner}'; it must be exact-stop or contour", "move.corner")
    return corner == "exact-stop"


def until_of(axis: AxisLaw, moved: Move, duration: float | None) -> RunEnd:
    """Return when a move is over: after ``duration`` s, or None for when the axis is at rest."""
    if duration is not None:
        return RunEnd(duration)
    lag = 1.0 / axis.position_rate
    settle = _LONGEST_WAIT * lag + _LONGEST_SETTLING
    blocks = len(moved.profile) // 8
    return RunEnd(
        # Each exact stop between blocks may be waited for as long as the end is.
        2.0 * end_of(moved.profile) + settle + blocks * _LONGEST_WAIT * lag,
        max(axis.inposition_band, axis.rest_band, 1.5 * axis.machine.position_count),
        3.0 * lag + PAUSE,
        settle,
    )


def feedrate_of(axis: AxisLaw, settings: ScenarioSettings) -> float:
    """Return the feedrate of a move in u/s; raises SimulationError if none is known."""
    given = above_zero(settings, "move.feedrate")
    if given is not None:
        return given / 60.0
    if axis.feedrate is None or not axis.feedrate > 0.0:
        source = axis.sources.get("feedrate")
        raise SimulationError(
            "The rapid feedrate of the axis is not set. Give a feedrate for the move",
            source.parameter if source else "move.feedrate",
        )
    return axis.feedrate


def ramp_of(axis: AxisLaw, settings: ScenarioSettings) -> Ramp:
    """Return the ramp of a move: the one asked for, else the axis' own."""
    kind = settings.get("move.mode")
    if kind is None:
        return next(iter(axis.ramps.values()))
    found = axis.ramps.get(str(kind))
    if found is None:
        raise SimulationError(
            f"Unknown ramp '{kind}'. Axis {axis.axis} has: {', '.join(axis.ramps)}", "move.mode"
        )
    return found


def time_to_speed(ramp: Ramp, speed: float) -> float:
    """Return how long the command takes from rest to a speed in u/s, s."""
    return _FOLLOWED * ramp.time + (speed / ramp.acceleration if ramp.acceleration else 0.0)


def run_up(axis: AxisLaw, speed: float, ramp: Ramp) -> float:
    """Return a distance in u over which an axis reaches a speed in u/s from rest, and follows it."""
    return speed * (time_to_speed(ramp, speed) + _FOLLOWED / axis.position_rate)
