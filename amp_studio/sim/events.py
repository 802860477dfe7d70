"""Ramps, homing, jogging and limits of travel of an axis as plain figures, which a family fills in."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

RAMPS = ("none", "linear", "exponential", "s-curve", "sine-squared")


@dataclass(frozen=True)
class Ramp:
    """How the speed of the command changes; a figure of 0 is "none of it"."""

    kind: str = "none"
    """One of RAMPS."""
    acceleration: float = 0.0
    """u/s2; 0 for no ramp."""
    deceleration: float = 0.0
    """u/s2; 0 for the acceleration."""
    jerk: float = 0.0
    """u/s3 of an S-curve."""
    time: float = 0.0
    """s: time constant of an exponential ramp, least time of a sine-squared one."""
    velocity_step: float = 0.0
    """u/s: a change of velocity that needs no ramp."""


@dataclass(frozen=True)
class Homing:
    """One homing sequence. Velocities in u/s with their sign in the direction of the machine, lengths in u."""

    approach: float
    """Towards the switch; 0 for a sequence without one."""
    leave: float
    """Off the switch, or towards the marker where there is no switch."""
    marker: Literal["nearest", "next", "none"]
    """The marker that counts: the one nearest to the end of the switch, the next one beyond it, or the end of the switch itself."""
    turn: float
    """From one marker to the next."""
    coordinate: float
    """What the axis is called where it is home."""
    search: float = 0.0
    """From the end of the switch to the next marker; 0 to go on as it left."""
    final: float = 0.0
    """Speed of the move to the home position; 0 where the axis just stops: the coordinate belongs to the place of the marker."""
    offset: float = 0.0
    """From the marker to the home position."""
    skipped: float = 0.0
    """Share of a turn: a next marker that is nearer is not taken."""
    too_fast: str = ""
    """Alarm where the axis has passed the whole switch before it stops, and leaves it in the same direction; with a colon at its end
    where the control shows the name of the axis after it."""
    direction_lost: bool = False
    """Whether ``move.direction`` turns the whole sequence round: the direction is not in the file."""
    ramp: Ramp | None = None
    """None for the axis' ramp of manual moves."""
    page: str = ""
    notes: tuple[str, ...] = ()
    """What is printed with its page, and what is assumed."""


@dataclass(frozen=True)
class Jogging:
    """Speeds of continuous jogs in u/s and distances of incremental ones in u, by name, the usual one first."""

    speeds: Mapping[str, float]
    increments: Mapping[str, float] = field(default_factory=dict)
    increment_speed: str = ""
    """The speed of incremental jogs; "" for the chosen one."""
    ramp: Ramp | None = None
    """None for the axis' ramp of manual moves."""
    page: str = ""
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Travel:
    """Limits of the travel in the coordinates of the machine: name -> (least, greatest) u; infinite for none."""

    limits: Mapping[str, tuple[float, float]]
    alarm: str
    """Code where a limit is passed."""
    page: str
    notes: tuple[str, ...] = ()
    zones: Mapping[str, tuple[float, float]] | None = None
    """Zones that a program switches on, by number; each side is a limit. None where zones are not simulated."""
    zone_page: str = ""
    zone_note: str = ""
    """Page of the zones, and what is assumed of them."""

    def nearest(self, start: float, sign: float) -> tuple[str, float] | None:
        """Return name and place of the first limit in a direction from a place inside; None without one."""
        ahead = [
            (name, edge)
            for name, edges in self.limits.items()
            for edge in edges
            if math.isfinite(edge) and sign * (edge - start) > 0.0
        ]
        return min(ahead, key=lambda found: sign * found[1]) if ahead else None
