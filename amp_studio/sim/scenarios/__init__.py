"""The scenarios by name; each moves one axis in its own way and returns a trace."""

from __future__ import annotations

from amp_studio.scenarios import SCENARIOS as PLACES
from amp_studio.schema import load_part
from amp_studio.sim.scenario import Scenario

SCENARIOS: dict[str, Scenario] = {name: load_part(place) for name, place in PLACES.items()}

__all__ = ["SCENARIOS", "Scenario"]
