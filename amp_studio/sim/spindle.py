"""A spindle as plain figures, which a family fills in: gears, output, ramp, speed watch, orient and
tapping.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from .errors import SimulationError


@dataclass(frozen=True)
class Gear:
    """One speed range. Speeds in rpm."""

    name: str
    low: float
    high: float
    """Ends of what may be programmed in it."""
    full: float
    """Speed at which the output is ``output``."""
    output: float
    least_output: float = 0.0
    """Output just above speed 0; the output goes on in proportion from there to ``full``."""
    least: float = 0.0
    """Speed at ``least_output``."""
    ramp_time: float = 0.0
    """s from 0 to ``ramp_top``; 0 for one step."""
    ramp_top: float = 0.0
    gain: float = 0.0
    """1/s of the position loop for orient and tapping; 0 where there is none."""
    tap_rate: float = 0.0
    """Acceleration while tapping, revolutions/s2; 0 where none is known."""
    tap_speed: float = math.inf
    """Highest speed while tapping."""

    def output_at(self, speed: float) -> float:
        """Return the output at a speed, which ends at that of ``full``."""
        if speed == 0.0:
            return 0.0
        share = (min(abs(speed), self.full) - self.least) / (self.full - self.least)
        size = self.least_output + max(share, 0.0) * (self.output - self.least_output)
        return math.copysign(1.0, speed) * size


@dataclass(frozen=True)
class Orient:
    """An orient: to the marker where it is not known, then to the angle by the position loop."""

    speed: float
    """rpm"""
    sign: float
    """Direction before the marker is known, 1 or -1."""
    calibration: float
    """deg from the marker to the zero of the spindle."""
    angle: float
    """deg, where the block has none."""
    band: float
    """deg"""
    standstill: float = math.inf
    """rpm: how slow it has to be to be done; infinite for any speed."""
    page: str = ""


@dataclass(frozen=True)
class SpeedWatch:
    """Compares the measured speed with an expected one: a ramp of ``time`` s to the command,
    within ``tolerance`` (share of it).
    """

    tolerance: float
    time: float
    flag: str
    page: str


@dataclass(frozen=True)
class Spindle:
    """One spindle of a file."""

    name: str
    title: str
    unit: str
    """Of the output: V or %."""
    gears: tuple[Gear, ...]
    page: str
    notes: tuple[str, ...] = ()
    iteration: float = 0.0
    """s from one step of the ramp to the next; 0 for a smooth one."""
    orient: Orient | None = None
    watch: SpeedWatch | None = None
    no_gear: str = "NO GEAR"
    """Code where no gear has the speed."""
    refusal: str = ""
    """Why no gear is ever requested, a sentence; "" where gears are."""
    programs_ranges: bool = False
    """Whether the range that is given is programmed, so that a speed outside of it is refused."""
    clipped: bool = False
    """Whether a speed outside of all gears is set to the nearest one instead of refused."""

    def gear_for(
        self, speed: float, present: str | None, *, programmed: bool = False
    ) -> tuple[Gear | None, str]:
        """Return the gear for a speed and what is assumed of the choice; None where none has it,
        or the ``programmed`` one has it not.

        The manuals do not print which gear is taken where ranges overlap.
        """
        fitting = [gear for gear in self.gears if gear.low <= abs(speed) <= gear.high]
        engaged = next((gear for gear in self.gears if gear.name == present), None)
        if present is not None and engaged is None:
            known = ", ".join(gear.name for gear in self.gears)
            raise SimulationError(
                f"Gear {present} of spindle {self.name} is not used. Used are: {known}", "move.gear"
            )
        if programmed:
            return (engaged if engaged in fitting else None), ""
        if not fitting:
            return None, ""
        if len(fitting) > 1:
            names = ", ".join(gear.name for gear in fitting)
            assumption = (
                f"ASSUMED: of the gears {names}, which all have this speed, the present one stays, else the"
                " lowest is taken; it is not printed."
            )
            return (engaged if engaged in fitting else fitting[0]), assumption
        return fitting[0], ""


@dataclass(frozen=True)
class Tapping:
    """How a control taps: who leads, and what both follow."""

    overrides: Mapping[str, float]
    """Values of the axis while it taps, by parameter id."""
    gain: float
    """1/s of the spindle's position loop; 0 where the axis follows the spindle itself."""
    forward: float
    """Share of velocity feed-forward of the spindle's loop."""
    rate: float
    """u/s2 of both along the axis; 0 for the axis' own."""
    speed: float
    """rpm at most."""
    leads: bool = False
    """Whether the spindle leads: the axis follows its measured angle."""
    anticipation: float = 0.0
    """s by which the command of the axis is ahead of the spindle."""
    figures: Mapping[str, tuple[float | None, str]] | None = None
    """Further figures by name, with their unit."""
    feed_stop: Literal["", "detaps", "inhibited"] = ""
    """What a feed stop does on the way into the hole; "" where no page prints it."""
    feed_stop_page: str = ""
    page: str = ""
    notes: tuple[str, ...] = ()
