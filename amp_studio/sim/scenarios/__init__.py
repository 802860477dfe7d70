"""The scenarios by name; each moves one axis in its own way and returns a trace."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from amp_studio.scenarios import SCENARIOS as PLACES
from amp_studio.schema import load_part
from amp_studio.sim.scenario import Scenario


class _Scenarios(Mapping[str, Scenario]):
    """Every scenario, loaded when it is first asked for: a report needs two, and all take a tenth of a
    second.
    """

    def __getitem__(self, name: str) -> Scenario:
        found: Scenario = load_part(PLACES[name])
        return found

    def __contains__(self, name: object) -> bool:
        return name in PLACES

    def __iter__(self) -> Iterator[str]:
        return iter(PLACES)

    def __len__(self) -> int:
        return len(PLACES)


SCENARIOS: Mapping[str, Scenario] = _Scenarios()

__all__ = ["SCENARIOS", "Scenario"]
