"""The scenarios of ``simulate`` by name, without the simulator: to load that takes a second."""

from __future__ import annotations

from importlib import import_module

SCENARIOS = {
    "step": "amp_studio.sim.scenarios.step:SCENARIO",
    "velocity": "amp_studio.sim.scenarios.velocity:SCENARIO",
    "frequency": "amp_studio.sim.scenarios.frequency:SCENARIO",
    "tune": "amp_studio.sim.scenarios.tune:SCENARIO",
    "load": "amp_studio.sim.scenarios.load:SCENARIO",
    "sweep": "amp_studio.sim.variations.scenario:SCENARIO",
    "circle": "amp_studio.sim.scenarios.circle:SCENARIO",
    "home": "amp_studio.sim.scenarios.home:SCENARIO",
    "jog": "amp_studio.sim.scenarios.jog:SCENARIO",
    "travel": "amp_studio.sim.scenarios.travel:SCENARIO",
    "spindle": "amp_studio.sim.scenarios.spindle:SCENARIO",
    "tap": "amp_studio.sim.scenarios.tap:SCENARIO",
    "probe": "amp_studio.sim.scenarios.probe:SCENARIO",
    "fault": "amp_studio.sim.scenarios.fault:SCENARIO",
    "handwheel": "amp_studio.sim.scenarios.handwheel:SCENARIO",
}
"""Scenario of any family -> where it is."""

IDENTIFY = "identify"
"""In the place of a scenario: the machine out of a record."""

CHARTS = ("bode", "nyquist", "nichols")
"""How `frequency` draws the open loop: over the frequency, in the complex plane, its gain over its phase."""

_OF_SCENARIOS = ("move", "model", "tune", "sweep", "gear", "cam")
"""First words of the settings of a scenario that are no parameters."""


def setting_of_keyword(name: str) -> str:
    """Return the setting of a scenario that a name of Python means: ``move_feedrate``, ``servo__p_gain``."""
    first, _, rest = name.partition("_")
    return f"{first}.{rest}" if first in _OF_SCENARIOS and "." not in name else name.replace("__", ".")


def scenario_names() -> tuple[str, ...]:
    """Return the scenarios of any family, then those that single families bring."""
    own: dict[str, tuple[str, ...]] = import_module("amp_studio.families").SCENARIOS
    return tuple(dict.fromkeys((*SCENARIOS, *(name for names in own.values() for name in names))))
