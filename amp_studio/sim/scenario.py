"""What a scenario is, and its settings as plain figures."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Literal

from amp_studio.schema import unknown_name

from .axis_parameters import ParameterValue
from .errors import SimulationError
from .trace import Trace

CheckPart = Literal["homing", "travel", "following", "spindle", "probing", "coupling"]
"""What a check of the machine is about; in this order."""
ScenarioSettings = Mapping[str, ParameterValue]


@dataclass(frozen=True)
class Scenario:
    """One kind of simulation."""

    name: str
    title: str
    settings: Mapping[str, str]
    """Settings of the scenario -> what they are."""
    run: Callable[..., Trace]
    """run(axis, settings in canonical units) -> Trace, with the second axis after them if there is one;
    raises SimulationError."""
    gains: bool = True
    """Whether gains are recommended after it; a homing or a stop asks for its own figures."""
    tried: bool = False
    """Whether it tries other values: run(trial, settings,
    trials of the axes that make contours with this one)."""
    second: bool = False
    """Whether a second axis takes part: the one of ``move.second_axis``, else the next that can be
    simulated."""
    of_machine: bool = False
    """Whether it is not about one axis: run(machine, settings) with a `BoundMachine`."""
    several: Callable[..., Trace] | None = None
    """The same for several axes at once, run like one of the machine; None where it takes one axis."""
    checked: tuple[str, ...] = ()
    """The figures that a check of the machine shows; () for a scenario that it leaves out."""
    part: CheckPart = "following"
    """Where a check of the machine lists it."""
    headline: str = ""
    """The figure of ``checked`` that a list has room for; "" for the first."""
    once: bool = False
    """Whether a check runs it once for the machine instead of for each axis."""
    programmed: Mapping[str, float | str] = field(default_factory=dict)
    """What a program gives where the file does not, as a check takes it."""
    opposite: Mapping[str, float | str] = field(default_factory=dict)
    """What makes it the same at the other end of the travel, which a check looks at too."""


def number(settings: ScenarioSettings, name: str) -> float | None:
    """Return a setting as a number, None if it is not given; raises SimulationError for anything else."""
    setting = settings.get(name)
    if setting is None:
        return None
    if isinstance(setting, bool) or not isinstance(setting, (int, float)):
        raise SimulationError(f"{name} is {setting!r:.80}, not a number", name)
    # float() takes "nan" and "inf" as numbers; no motion can be computed with them.
    if not math.isfinite(setting):
        raise SimulationError(f"{name} is {setting:g}; it must be finite", name)
    return float(setting)


def above_zero(settings: ScenarioSettings, name: str, most: float = math.inf) -> float | None:
    """Return a setting that must be above 0, and ``most`` at most."""
    value = number(settings, name)
    if value is not None and value <= 0.0:
        raise SimulationError(f"{name} is {value:g}; it must be above 0", name)
    if value is not None and value > most:
        raise SimulationError(f"{name} is {value:g}; simulated is {most:g} at most", name)
    return value


def direction(settings: ScenarioSettings) -> float | None:
    """Return 1 or -1 for ``move.direction``, None where it is not given."""
    word = settings.get("move.direction")
    if word not in (None, "plus", "minus"):
        raise SimulationError("move.direction must be plus or minus", "move.direction")
    return None if word is None else 1.0 if word == "plus" else -1.0


def refuse_unknown(settings: ScenarioSettings, known: Mapping[str, str]) -> None:
    """Raise SimulationError for a setting that the scenario does not have."""
    for name in settings:
        if name not in known:
            raise SimulationError(unknown_name("setting", name, known), name)
