"""An axis of the 57C422B with the registers that its own commands read."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from amp_studio.sim import AxisLaw, AxisParameters, SimulationError

from .law_tune import Scales


@dataclass(frozen=True)
class ModuleAxis(AxisLaw):
    """One axis and its registers, by parameter id in canonical units."""

    read: AxisParameters | None = None
    names: Mapping[str, str] = field(default_factory=dict)
    """Parameter id -> number and name, for messages."""
    scales: Scales = field(default_factory=Scales)

    def register(self, parameter: str, point: int | None = None) -> float | None:
        """Return a register, of a cam table the one of a point; None where it is not set."""
        assert self.read is not None
        at = None if point is None else f"{self.axis}.{point}"
        return self.read.optional(parameter, at=at)

    def needed(self, parameter: str, why: str) -> float:
        """Return a register that a command needs; raises SimulationError with its number where it is not
        set.
        """
        value = self.register(parameter)
        if value is None:
            raise SimulationError(f"{self.names[parameter]} is not set: {why}", parameter)
        return value

    def bit(self, parameter: str, bit: int) -> bool:
        """Return a bit of a register; off where the register is not set."""
        return bool(int(self.register(parameter) or 0.0) >> bit & 1)
