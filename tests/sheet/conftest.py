"""Two states of one sound mill: what the control contains, and what it is to contain."""

from collections.abc import Callable

import pytest
from rule_machines import sound

from amp_studio.files import ParameterFile


@pytest.fixture(scope="session")
def sound_mill() -> ParameterFile:
    """Return a mill without a finding; to be copied."""
    return sound("9pc", "mill")


@pytest.fixture
def present(sound_mill: ParameterFile) -> ParameterFile:
    """Return what the control contains."""
    return sound_mill.copy()


@pytest.fixture(scope="session")
def sound_lathe() -> ParameterFile:
    """Return a lathe without a finding; to be copied."""
    return sound("9pc", "lathe")


@pytest.fixture
def lathe(sound_lathe: ParameterFile) -> ParameterFile:
    """Return what the control of a lathe contains."""
    return sound_lathe.copy()


@pytest.fixture
def changed(sound_mill: ParameterFile) -> Callable[..., ParameterFile]:
    """Return what makes the file that is wanted: ``changed({"1750": "40 mm"})``."""

    def change(values: dict[str, str], of: ParameterFile = sound_mill) -> ParameterFile:
        file = of.copy()
        for number, text in values.items():
            address = file.find(number)
            file.set(address, file.read(address, text))
        return file

    return change
