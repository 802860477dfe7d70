"""The sound machines of the 9/PC, for whatever is tried on a machine in which nothing is to be found."""

from collections.abc import Callable
from functools import partial

import pytest
from rule_machines import sound

from amp_studio.files import ParameterFile


@pytest.fixture(scope="session")
def machine() -> Callable[[str], ParameterFile]:
    """Return what builds a sound machine: ``machine("mill")``."""
    return partial(sound, "9pc")


@pytest.fixture
def mill(machine: Callable[[str], ParameterFile]) -> ParameterFile:
    """Return a separate sound mill, whose rapid is 12000 mm/min on seven axes."""
    return machine("mill")
