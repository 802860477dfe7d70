"""Ramps, homing, jogging and limits of travel of an axis as plain figures, which a family fills in."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
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
class Failure:
    """An alarm of a homing that fails, as the control shows it."""

    code: str
    """With a colon at its end where the control shows the name of the axis after it."""
    message: str
    reach: float = math.inf
    """u after which it comes: without a marker, or without leaving the switch."""


@dataclass(frozen=True)
class CodedScale:
    """Distance-coded markers of a linear scale: odd ones every ``small`` u from its zero,
    even ones every ``large`` u from ``first`` on.
    """

    small: float
    large: float
    first: float
    zero: float
    """Machine position of the zero of the scale."""
    markers: int = 3
    """How many in a row are needed."""


@dataclass(frozen=True)
class Homing:
    """One homing sequence. Velocities in u/s with their sign in the direction of the machine, lengths in
    u.
    """

    approach: float
    """Towards the switch; 0 for a sequence without one."""
    leave: float
    """Off the switch, or towards the marker where there is no switch; 0 where the axis does not move at
    all."""
    marker: Literal["nearest", "next", "none"]
    """The marker that counts: the one nearest to the end of the switch, the next one beyond it,
    or the end of the switch itself."""
    turn: float
    """From one marker to the next."""
    coordinate: float
    """What the axis is called where it is home."""
    search: float = 0.0
    """From the end of the switch to the next marker; 0 to go on as it left."""
    final: float = 0.0
    """Speed of the move to the home position; 0 where the axis just stops:
    the coordinate belongs to the place of the marker."""
    offset: float = 0.0
    """From the marker to the home position."""
    skipped: float = 0.0
    """Share of a turn: a next marker that is nearer is not taken."""
    through: bool = False
    """Whether the axis goes on over the switch to the first marker after it comes on, without a stop."""
    again: float = 0.0
    """Speed of a second approach, after which the switch counts;
    the axis backs off by ``pull_off`` before and after it."""
    pull_off: float = 0.0
    """0 for an axis that backs off until the switch goes off, and does not after it."""
    passes: int = 1
    """How often the second approach is made."""
    scale: CodedScale | None = None
    """For an axis without a switch that goes by distance-coded markers: it leaves,
    and then goes to ``coordinate``."""
    direction_lost: bool = False
    """Whether ``move.direction`` turns the whole sequence round: the direction is not in the file."""
    stops_by_switch: bool = False
    """Whether the switch stops the axis at once, without a ramp."""
    failures: Mapping[str, Failure] = field(default_factory=dict)
    """Of: switch (none came), fast (passed before it stopped), moving (not at rest in time), stuck (not
    left), marker (none came), scatter (another turn than the first time)."""
    rest_window: float = math.inf
    """Following error that counts as at rest ``REST_AFTER`` s after the stop on the switch."""
    order: int | None = None
    """The step in which it is homed when all axes are, from 0 or 1; None where the control has no order."""
    pause: float = 0.0
    """s at rest on the switch before the axis goes on."""
    ramp: Ramp | None = None
    """None for the axis' ramp of manual moves."""
    speeds: Mapping[str, str] = field(default_factory=dict)
    """Of approach, leave, search, again and final: the parameter that sets its speed; a search without one
    goes on as the axis left."""
    page: str = ""
    notes: tuple[str, ...] = ()
    """What is printed with its page, and what is assumed."""

    def turned(self) -> Homing:
        """Return the same sequence the other way."""
        return replace(self, approach=-self.approach, leave=-self.leave)


@dataclass(frozen=True)
class Surroundings:
    """What is around an axis: switch, markers and ends of its way, in u of the machine."""

    switch: float = math.inf
    """Where the switch comes on, on the way to it."""
    length: float = math.inf
    """How long it stays on, farther on that way."""
    marker: float = 0.0
    """One of the markers."""
    has_markers: bool = True
    is_stuck: bool = False
    """Whether the switch never goes off again."""
    low: float = -math.inf
    high: float = math.inf
    """Where the axis can go no farther."""
    scale: float = 0.0
    """Place on a distance-coded scale where the machine position is 0."""


@dataclass(frozen=True)
class Jogging:
    """Speeds of continuous jogs in u/s and distances of incremental ones in u, by name, the usual one
    first.
    """

    speeds: Mapping[str, float]
    increments: Mapping[str, float] = field(default_factory=dict)
    increment_speed: str = ""
    """The speed of incremental jogs; "" for the chosen one."""
    ramp: Ramp | None = None
    """None for the axis' ramp of manual moves."""
    page: str = ""
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Handwheel:
    """A handwheel that moves an axis."""

    step: float
    """u for one mark, with its sign."""
    fastest: float
    """u/s at which the axis follows it at most."""
    marks: float | None = None
    """Marks in a turn; None where no parameter gives them."""
    ramp: Ramp | None = None
    """None for the axis' ramp of manual moves."""
    page: str = ""
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Travel:
    """Limits of the travel in the coordinates of the machine: name -> (least, greatest) u; infinite for
    none.
    """

    limits: Mapping[str, tuple[float, float]]
    alarm: str
    """Code where a limit is passed."""
    page: str
    notes: tuple[str, ...] = ()
    zones: Mapping[str, tuple[float, float]] | None = None
    """Zones that a program switches on, by number; each side is a limit. None where zones are not
    simulated."""
    zone_page: str = ""
    zone_note: str = ""
    """Page of the zones, and what is assumed of them."""
    alarm_negative: str = ""
    """Of the lower limit, where it is another."""
    stop: Ramp | None = None
    """How the command stops at a limit; None for at once."""
    coasts: bool = False
    """Whether the loop is switched off at a limit instead."""
    refuses: bool = False
    """Whether a move beyond a limit is not begun."""
    begins_arcs: bool = False
    """Whether an arc that ends inside is begun, and the axis stops where it passes the limit."""
    slow: float = 0.0
    """u/s while an external deceleration is requested; 0 where the control has none."""
    reads_ahead: str = ""
    """Code with which a programmed block beyond a limit is not begun; "" where it is begun."""

    def nearest(self, start: float, sign: float) -> tuple[str, float] | None:
        """Return name and place of the first limit in a direction from a place inside; None without one."""
        ahead = [
            (name, edge)
            for name, edges in self.limits.items()
            for edge in edges
            if math.isfinite(edge) and sign * (edge - start) > 0.0
        ]
        return min(ahead, key=lambda found: sign * found[1]) if ahead else None
