"""What can be simulated with a file, and what can be set."""

from __future__ import annotations

from dataclasses import dataclass

from amp_studio.files import ParameterFile

from .law import Law, law_of
from .model import model_settings
from .scenarios import SCENARIOS


@dataclass(frozen=True)
class Entry:
    """One scenario."""

    name: str
    title: str
    settings: dict[str, str]
    """Setting -> what it is."""


@dataclass(frozen=True)
class Listing:
    """Scenarios and settings for one file."""

    axes: tuple[str, ...]
    scenarios: tuple[Entry, ...]
    model: dict[str, str]
    """Settings of the machine -> what they are."""


def known_settings(law: Law, scenario: str) -> dict[str, str]:
    """Return every setting of a scenario and of the machine -> what it is."""
    own = dict(SCENARIOS[scenario].settings) if scenario in SCENARIOS else {}
    return {**model_settings(), **law.settings, **own}


def listing(file: ParameterFile) -> Listing:
    """Return what can be simulated with a file; raises SimulationError for a family without a law."""
    law = law_of(file.schema.family.family)
    general = [SCENARIOS[name] for name in law.scenarios if name in SCENARIOS]
    entries = [Entry(each.name, each.title, dict(each.settings)) for each in general]
    for name, run in law.own.items():
        title = (run.__doc__ or "").strip().partition("\n")[0].rstrip(".")
        own = {key: text for key, text in law.settings.items() if key.startswith(f"{name}.")}
        entries.append(Entry(name, title, own))
    model = {key: text for key, text in law.settings.items() if key.startswith("model.")}
    return Listing(tuple(law.axes(file)), tuple(entries), {**model_settings(), **model})
