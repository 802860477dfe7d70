"""What can be simulated with a file, and what can be set."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from amp_studio.files import ParameterFile
from amp_studio.schema import axis_name

from .law import Law, law_of
from .model import model_settings
from .scenarios import SCENARIOS
from .unit_system import described, length_unit


@dataclass(frozen=True)
class ScenarioEntry:
    """One scenario."""

    name: str
    title: str
    settings: dict[str, str]
    """Setting -> what it is."""


@dataclass(frozen=True)
class SimulationListing:
    """Scenarios and settings for one file."""

    axes: tuple[str, ...]
    letters: tuple[str, ...]
    """Of each axis; the axis itself where the file gives it none."""
    scenarios: tuple[ScenarioEntry, ...]
    model: dict[str, str]
    """Settings of the machine -> what they are."""


def known_settings(law: Law, scenario: str) -> dict[str, str]:
    """Return every setting of a scenario and of the machine -> what it is."""
    own = (law.own().get(scenario) or SCENARIOS[scenario]).settings
    return {**model_settings(), **law.motion.settings, **own}


def listing(file: ParameterFile, system: str | None = None) -> SimulationListing:
    """Return what can be simulated with a file, settings in a unit system (None: that of the file); raises
    SimulationError for a family without a law.
    """
    law, length = law_of(file.schema.family.family), length_unit(file, system)
    scenarios = [*(SCENARIOS[name] for name in law.motion.scenarios), *law.own().values()]
    entries = [ScenarioEntry(each.name, each.title, _described(each.settings, length)) for each in scenarios]
    model = _described({**model_settings(), **law.motion.settings}, length)
    axes = tuple(law.axes(file))
    letters = tuple(axis_name(file.evaluation, axis) or axis for axis in axes)
    return SimulationListing(axes, letters, tuple(entries), model)


def _described(settings: Mapping[str, str], length: str) -> dict[str, str]:
    return {name: described(text, length) for name, text in settings.items()}
