"""What the loops of an axis keep: margins, Ms and stiffness, and whether that is what is asked for.

Every sentence of the program about a sound loop is made here: a scenario, the solver (`solver.py`) and the
check of a file ask the same question with the same numbers and cannot contradict each other.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from amp_studio.sim.law import AxisLaw

from .linear import AxisModel, LawMatrices, LinearModel, Margins, axis_model

POINTS = 120
"""Points of the grid for a value that is tried."""
_LASTING = 0.25
"""s in which a loop shall have taken a load up again:
the mean way of the load in this time counts beside the largest one."""


@dataclass(frozen=True)
class LoopDemand:
    """What loops have to keep."""

    sensitivity: float
    """Ms at most, of both loops."""
    phase: float
    """deg, of the position loop."""
    inner_phase: float
    """deg, of the velocity loop."""
    gain: float
    """dB, of both loops."""
    damping: float = 0.0
    """Least damping ratio of the position loop."""

    def text(self) -> str:
        """Return it as words."""
        damping = f", damping ratio from {self.damping:g}" if self.damping else ""
        return (
            f"Ms up to {self.sensitivity:g}, phase margin from {self.phase:g} deg (velocity loop"
            f" {self.inner_phase:g} deg), gain margin from {self.gain:g} dB{damping}"
        )


SOUND = LoopDemand(1.6, 45.0, 40.0, 8.0)
"""What every sound axis keeps. Ms 1.6 is the middle of the 1.4 to 2 that K. J. Åström and T. Hägglund name
(Advanced PID Control, 2006, 4.6); the phase margins are usual for a position loop and a velocity loop."""


@dataclass(frozen=True)
class LoopFigures:
    """One loop: its margins and its largest sensitivity."""

    margins: Margins
    sensitivity: float

    @classmethod
    def of(cls, model: LinearModel, *, exact: bool) -> LoopFigures:
        """Return those of a loop; not ``exact`` within half a percent, for a value that is tried."""
        if not exact:
            return cls(*model.quick(POINTS))
        return cls(model.margins(), model.sensitivity()[0])

    def lacks(self, phase: float, need: LoopDemand) -> float:
        """Return by which share of it the worst figure misses what is needed;
        0 and below for a loop that keeps it.
        """
        missing = [self.sensitivity / need.sensitivity - 1.0]
        if self.margins.phase is not None:
            missing.append(1.0 - self.margins.phase / phase)
        if self.margins.gain is not None:
            missing.append(1.0 - self.margins.gain / need.gain)
        return max(missing)


class Loops:
    """How an axis is damped: its loops, each computed when it is asked for."""

    def __init__(self, axis: AxisLaw, law: LawMatrices | None = None, *, exact: bool = True) -> None:
        self.axis, self._law, self._exact = axis, law, exact

    @cached_property
    def models(self) -> AxisModel:
        """The linear models."""
        return axis_model(self.axis, self._law)

    @property
    def closed(self) -> bool:
        """Whether anything controls the position."""
        whole = self.models.whole
        return bool(np.any(self.models.cut.measured)) and not whole.drifts()

    @cached_property
    def stable(self) -> bool:
        """Whether the axis is stable."""
        return self.models.whole.is_stable()

    @cached_property
    def inner_stable(self) -> bool:
        """Whether the velocity loop alone is stable."""
        return self.models.inner is None or self.models.inner.is_stable(drift=True)

    @cached_property
    def inner(self) -> LoopFigures | None:
        """The velocity loop; None without one."""
        return LoopFigures.of(self.models.inner, exact=self._exact) if self.models.inner else None

    @cached_property
    def outer(self) -> LoopFigures:
        """The position loop."""
        return LoopFigures.of(self.models.cut, exact=self._exact)

    @cached_property
    def damping(self) -> float:
        """Damping ratio of the position loop."""
        return self.models.damping(self.outer.margins.phase_frequency)

    @cached_property
    def sensitivity(self) -> float:
        """Ms: that of the loop which has the larger one."""
        return max(self.outer.sensitivity, self.inner.sensitivity if self.inner else 0.0)

    @cached_property
    def yields(self) -> tuple[float, float]:
        """The largest way of the load, in u, for one unit of torque that comes at once and stays,
        and its mean in `_LASTING` s.
        """
        return self.models.whole.yields(_LASTING)

    def inner_sound(self) -> bool:
        """Return whether the velocity loop keeps what every sound axis keeps."""
        return self.inner_stable and (self.inner is None or self.inner.lacks(SOUND.inner_phase, SOUND) <= 0.0)

    def sound(self, need: LoopDemand = SOUND) -> bool:
        """Return whether the axis keeps what is needed."""
        return self.stable and self.inner_stable and self.lacks(need) <= 0.0

    def lacks(self, need: LoopDemand = SOUND) -> float:
        """Return by which share the worst figure misses what is needed;
        infinite for an axis that is not stable.
        """
        if not (self.stable and self.inner_stable):
            return math.inf
        missing = [self.outer.lacks(need.phase, need)]
        if self.inner is not None:
            missing.append(self.inner.lacks(need.inner_phase, need))
        if need.damping:
            missing.append(1.0 - self.damping / need.damping)
        return max(missing)


_SPREAD = ((0.5, 0.0), (2.0, 0.0))
"""Shares of inertia and of viscous friction that a machine may have beside those it is taken to have. Twice
the friction takes phase away from no loop: the campaign of tests/sim/tuning_campaign.py checks it."""


def spread_of(axis: AxisLaw) -> list[AxisLaw]:
    """Return an axis with other machines: half and twice the inertia, without friction."""
    others = [with_inertia(axis, inertia, friction) for inertia, friction in _SPREAD]
    return [replace(axis, machine=machine) for machine in dict.fromkeys(each.machine for each in others)]


def with_inertia(axis: AxisLaw, inertia: float, friction: float = 1.0) -> AxisLaw:
    """Return an axis with shares of its inertia and its viscous friction.

    A drive with a velocity loop keeps its gains,
    so that its loop is as much faster or slower as the machine is lighter or heavier.
    """
    machine = axis.machine
    changes = {
        "acceleration_per_output": machine.acceleration_per_output / inertia,
        "viscous_friction": machine.viscous_friction * friction,
    }
    if machine.velocity_per_output > 0.0:
        changes["velocity_bandwidth"] = machine.velocity_bandwidth / inertia
    return replace(axis, machine=replace(machine, **changes))  # type: ignore[arg-type]  # none is the flag
