"""The course of a command: moves, blocks, changes of the feedrate and stops as profiles of closed pieces.

Distances in u, velocities in u/s, times in s. A course goes one way; its sign comes last.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from amp_studio.sim.engine.profiles import EXPONENTIAL, IN_POSITION, POLYNOMIAL, START, WIDTH
from amp_studio.sim.errors import SimulationError

from .events import Ramp
from .pieces import Piece, change, length

_BISECTIONS = 200
"""Halvings in which the interval of two floats has no float inside any more."""


def profile_of(pieces: Sequence[Piece], distance: float, sign: float = 1.0) -> list[float]:
    """Return the flat profile of pieces that go ``distance`` u; pieces without duration are left out."""
    rows: list[float] = []
    start = position = 0.0
    for piece in pieces:
        if piece.duration <= 0.0:
            continue
        rows += [start, piece.duration, sign * position, sign * piece.velocity, sign * piece.acceleration]
        rows += [sign * piece.jerk, piece.kind, piece.figure]
        start, position = start + piece.duration, position + piece.length()
    rows += [start, math.inf, sign * distance, 0.0, 0.0, 0.0, POLYNOMIAL, 0.0]
    return rows


def end_of(profile: Sequence[float]) -> float:
    """Return when a profile is at its end, in s."""
    return profile[len(profile) - WIDTH + START]


def move(distance: float, feedrate: float, ramp: Ramp, count: float = 0.0) -> list[float]:
    """Return a move of ``distance`` u with its sign at ``feedrate`` u/s, from rest to rest.

    An exponential move ends when less than ``count`` u, or a billionth of it, is left.
    """
    size = abs(distance)
    pieces = (
        exponential_pieces(size, [(0.0, feedrate)], ramp, count)
        if ramp.kind == "exponential"
        else leg(size, feedrate, ramp)
    )
    return profile_of(pieces, size, math.copysign(1.0, distance))


def leg(distance: float, feedrate: float, ramp: Ramp, entry: float = 0.0, leave: float = 0.0) -> list[Piece]:
    """Return the pieces of one block from the velocity ``entry`` to ``leave``;
    lower than ``feedrate`` if it is short.

    Raises SimulationError where the block is too short for the change of velocity.
    """

    def way_of_ramps(peak: float) -> float:
        return length(change(ramp, entry, peak)) + length(change(ramp, peak, leave))

    peak = feedrate
    if way_of_ramps(peak) > distance:
        low, high = max(entry, leave), feedrate
        # Rounding alone must not refuse a block that is exactly as long as its change of velocity.
        if way_of_ramps(low) > distance * (1.0 + 1e-12):
            raise SimulationError(
                f"A block of {distance:g} is too short to change the velocity from {entry * 60.0:g} to"
                f" {leave * 60.0:g} a minute"
            )
        # The way of both ramps grows with the peak between them, but not all kinds of ramp have a closed
        # form for its inverse. The lower end is used: the ramps are then never longer than the block.
        for _ in range(_BISECTIONS):
            middle = 0.5 * (low + high)
            if middle in (low, high):  # no number lies between them
                break
            low, high = (middle, high) if way_of_ramps(middle) <= distance else (low, middle)
        peak = low
    left = max(distance - way_of_ramps(peak), 0.0)
    even = [Piece(left / peak, peak)] if left > 0.0 and peak > 0.0 else []
    return [*change(ramp, entry, peak), *even, *change(ramp, peak, leave)]


def exponential_pieces(
    distance: float, feedrates: Sequence[tuple[float, float]], ramp: Ramp, count: float
) -> list[Piece]:
    """Return the pieces of a move whose feedrate passes a first-order lag; the lag keeps the distance.

    ``feedrates`` are the feedrates from their moments (s) on, the first from 0.
    """
    if ramp.time == 0.0:
        raise SimulationError("The time constant of the exponential ramp is 0; it must be above 0")
    pieces: list[Piece] = []
    velocity = given = 0.0
    for n, (moment, feedrate) in enumerate(feedrates):
        lasts = feedrates[n + 1][0] - moment if n + 1 < len(feedrates) else math.inf
        if feedrate > 0.0:
            lasts = min(lasts, (distance - given) / feedrate)
        if not math.isfinite(lasts):
            raise SimulationError("The feedrate stays 0: the move never ends")
        given += feedrate * lasts
        piece = Piece(lasts, velocity, (feedrate - velocity) / ramp.time, 0.0, EXPONENTIAL, ramp.time)
        velocity = piece.end
        pieces.append(piece)
        # The parts of a distance add up to it but for rounding.
        if given >= distance * (1.0 - 1e-12):
            break
    # What a lag of time constant T has still to go when its input is 0 is the integral of v e^(-t/T), v T;
    # it falls as e^(-t/T) and never ends, so it is cut where less than a count is left.
    left = velocity * ramp.time
    fades = ramp.time * math.log(max(left / max(count, 1e-9 * distance), 1.0))
    return [*pieces, Piece(fades, velocity, -velocity / ramp.time, 0.0, EXPONENTIAL, ramp.time)]


@dataclass(frozen=True)
class Override:
    """From a moment on the feedrate has another share: 0.5 for 50 %, 0 for feedhold."""

    moment: float
    """s"""
    share: float


def overridden(
    distance: float, feedrate: float, ramp: Ramp, overrides: Sequence[Override], count: float = 0.0
) -> list[float]:
    """Return a move whose feedrate is overridden; the velocity goes to each new one by the ramp.

    A change in the middle of a ramp with jerk comes when that ramp is over, in the middle of a straight one
    at once. Raises SimulationError where the move never ends.
    """
    size, sign = abs(distance), math.copysign(1.0, distance)
    if ramp.kind == "exponential":
        steps = [(0.0, feedrate), *((each.moment, each.share * feedrate) for each in overrides)]
        return profile_of(exponential_pieces(size, steps, ramp, count), size, sign)
    pieces: list[Piece] = []
    now = gone = velocity = 0.0
    wanted = feedrate
    for each in [*overrides, None]:
        until = math.inf if each is None else each.moment
        if each is None and wanted == 0.0:
            raise SimulationError("The feedrate stays 0: the move never ends")
        part = _towards(ramp, velocity, wanted, until - now)
        stop = change(ramp, part[-1].end if part else wanted, 0.0)
        if each is None or gone + length(part) + length(stop) > size:
            return profile_of([*pieces, *_remaining(size - gone, velocity, wanted, ramp)], size, sign)
        pieces += part
        gone, now = gone + length(part), now + math.fsum(piece.duration for piece in part)
        velocity, wanted = part[-1].end if part else velocity, each.share * feedrate
    raise AssertionError  # the last round returns


def _towards(ramp: Ramp, before: float, after: float, lasts: float) -> list[Piece]:
    """Return the pieces to a velocity and on at it, cut after ``lasts`` s; a ramp with jerk is not cut."""
    pieces: list[Piece] = []
    for piece in change(ramp, before, after):
        # A ramp with jerk that is cut would leave an acceleration, which no piece takes up.
        straight = piece.kind == POLYNOMIAL and piece.jerk == 0.0 and ramp.kind != "s-curve"
        duration = min(piece.duration, max(lasts, 0.0)) if straight else piece.duration
        pieces.append(replace(piece, duration=duration))
        lasts -= duration
    return [*pieces, Piece(lasts, after)] if 0.0 < lasts < math.inf else pieces


def _remaining(distance: float, velocity: float, feedrate: float, ramp: Ramp) -> list[Piece]:
    """Return the pieces to the end of the move; it turns back to a lower velocity where the end is near."""
    if velocity > feedrate:
        down = change(ramp, velocity, feedrate)
        if length(down) + length(change(ramp, feedrate, 0.0)) <= distance:
            return [*down, *leg(distance - length(down), feedrate, ramp, feedrate)]
        return leg(distance, velocity, ramp, velocity)
    return leg(distance, feedrate, ramp, velocity)


def blocks(
    parts: Sequence[tuple[float, float]], ramp: Ramp, *, exact_stop: bool, check: float
) -> list[float]:
    """Return several blocks (distance with its sign, feedrate) of one axis.

    With ``exact_stop`` every block ends at rest and waits until the axis is in position, checked every
    ``check`` s; else the velocity goes through a corner between blocks of the same direction,
    at the lower of both feedrates.
    """
    rows: list[float] = []
    start = position = entry = 0.0
    for n, (distance, feedrate) in enumerate(parts):
        following = parts[n + 1] if n + 1 < len(parts) else (0.0, 0.0)
        # Same direction: the product of both ways is positive.
        through = not exact_stop and distance * following[0] > 0.0
        leave = min(feedrate, following[1]) if through else 0.0
        pieces = leg(abs(distance), feedrate, ramp, entry, leave)
        # The end of the last block is waited for by the run (`moves.until_of`).
        if exact_stop and n + 1 < len(parts):
            pieces.append(Piece(check, kind=IN_POSITION))
        flat = profile_of(pieces, abs(distance), math.copysign(1.0, distance))
        for k in range(0, len(flat) - WIDTH, WIDTH):
            rows += [flat[k] + start, flat[k + 1], flat[k + 2] + position, *flat[k + 3 : k + WIDTH]]
        start, position, entry = start + end_of(flat), position + distance, leave
    return [*rows, start, math.inf, position, 0.0, 0.0, 0.0, POLYNOMIAL, 0.0]
