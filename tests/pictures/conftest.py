"""Example machines, a new copy for each test."""

from collections.abc import Callable
from pathlib import Path

import pytest

from amp_studio.files import ParameterFile, open_file

EXAMPLES = {
    "9pc": "mill-1394/MILL_1394.amp",
    "lathe": "lathe-ls176/LATHE_LS176.amp",
    "num": "num-1060-mill/MILL_1060.amp",
    "syntec": "syntec-mill/SYNTEC_MILL.amp",
    "57c422b": "57c422b-label-press/LABEL_PRESS.amp",
    "acromill": "acromill-router/ROUTER.amp",
    "grblhal": "grblhal-router/GRBL_ROUTER.amp",
}


@pytest.fixture
def example(checkout: Path) -> Callable[[str], ParameterFile]:
    """Return example machines by name, each time a separate file."""
    return lambda name: open_file(checkout / "examples" / EXAMPLES[name]).file
