"""The scenarios by name; each moves one axis in its own way and returns a trace."""

from __future__ import annotations

from . import circle, frequency, step, velocity
from .scenario import Scenario

SCENARIOS: dict[str, Scenario] = {
    each.name: each for each in (step.SCENARIO, velocity.SCENARIO, frequency.SCENARIO, circle.SCENARIO)
}

__all__ = ["SCENARIOS", "Scenario"]
