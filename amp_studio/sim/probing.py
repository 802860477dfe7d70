"""How a control meets a probe or a registration mark, as plain figures that a family fills in."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from .command.events import Ramp


@dataclass(frozen=True)
class Probing:
    """One probing move along an axis. Lengths in u, velocities in u/s, times in s."""

    name: str
    """The cycle, as a program calls it."""
    speed: float
    """At which the probe is met; 0 where only the program has it."""
    latency: float
    """From the signal to the position that is taken."""
    latency_note: str
    """Where the latency is from."""
    approach: float = 0.0
    """Speed up to ``approach_distance`` from the start; 0 where the whole way goes at ``speed``."""
    approach_distance: float = 0.0
    band: float = math.inf
    """u on both sides of the expected place in which the signal has to come; inf for no such band."""
    outside: str = ""
    """Code where the signal comes outside of the band, or not at all; "" where the motion just ends."""
    ramp: Ramp | None = None
    """How it stops; None for the axis' ramp of positioning."""
    after: Literal["stays", "returns", "goes on"] = "stays"
    """Where the axis is at the end: where it stopped, back where the signal came,
    or on its way as if nothing was."""
    alternatives: Mapping[str, float] = field(default_factory=dict)
    """Other latencies that the manual prints, by page."""
    page: str = ""
    notes: tuple[str, ...] = ()
