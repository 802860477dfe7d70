"""Help and completion name every scenario there is, and load no simulator for it."""

import subprocess
import sys

from amp_studio.families import SCENARIOS as OWN
from amp_studio.scenarios import scenario_names
from amp_studio.sim import law_of
from amp_studio.sim.law import simulated_families
from amp_studio.sim.scenarios import SCENARIOS


def test_every_scenario_of_every_family_is_named() -> None:
    own = {family: tuple(law_of(family).own()) for family in simulated_families()}
    assert {family: names for family, names in own.items() if names} == OWN
    assert scenario_names() == tuple(
        dict.fromkeys([*SCENARIOS, *(n for names in own.values() for n in names)])
    )
    assert all(SCENARIOS[name].name == name for name in SCENARIOS)


def test_the_names_are_there_without_the_simulator_and_a_law_without_numpy() -> None:
    script = """
import sys
from amp_studio.cli.manual import sections
from amp_studio.cli.registry import module_of
print([lines for title, lines in sections(module_of("simulate").VERB) if title == "scenarios"])
print([name for name in sys.modules if name in ("numba", "pydantic") or name.startswith("amp_studio.s")])
from amp_studio.sim import law_of  # the pictures of a report without motion bind axes by it
law_of("9pc")
print([name for name in sys.modules if name in ("numpy", "amp_studio.sim.scenario")])
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    listed, loaded, by_law = done.stdout.splitlines()
    assert listed == f"[('{', '.join(scenario_names())}',)]"
    assert loaded == "['amp_studio.scenarios']"
    assert by_law == "[]"
