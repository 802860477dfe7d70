"""What an axis is ordered to do, and what it answers."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

from amp_studio.sim.command.events import Ramp


@dataclass(frozen=True)
class Watch:
    """A place in u that is reported at the first servo sample at which the axis has passed it in a
    direction.
    """

    at: float
    sign: float
    """1.0 or -1.0."""
    device: bool = False
    """Whether it is a place of the position device (a marker, a software limit), not of the load (a
    switch)."""


@dataclass(frozen=True)
class Seen:
    """The servo sample that saw a place passed: number of the watch, s,
    and in u the actual and the measured position.
    """

    watch: int
    time: float
    position: float
    measured: float


@dataclass(frozen=True)
class GoOrder:
    """Go at a velocity until a place is passed, at most ``farthest`` u; what was seen is the answer,
    None for nothing.
    """

    velocity: float
    ramp: Ramp
    watch: Watch
    farthest: float


@dataclass(frozen=True)
class StopOrder:
    """Stop along a ramp, and wait until the axis is in position."""

    ramp: Ramp
    waits: bool = True
    """Whether it is waited for."""


@dataclass(frozen=True)
class MoveOrder:
    """Move to a position from rest, and wait until the axis is in position."""

    position: float
    feedrate: float
    ramp: Ramp


@dataclass(frozen=True)
class PauseOrder:
    """Wait for a time, s."""

    time: float


Order = GoOrder | StopOrder | MoveOrder | PauseOrder
Orders = Generator[Order, Seen | None, None]
"""A sequence as a control goes through it: each order is answered with what it saw."""


def one(order: Order) -> Orders:
    """Return a sequence of one order."""
    yield order
