"""The machines of ``examples/``, each opened from a copy so that no test can change it."""

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from amp_studio.files import ParameterFile, open_file
from amp_studio.files.example_files import examples_folder

EXAMPLES = sorted(path.relative_to(examples_folder()).as_posix() for path in examples_folder().rglob("*.amp"))


@pytest.fixture(params=EXAMPLES)
def example(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    """Return the path of one example, in a copy of its project folder."""
    original = examples_folder() / request.param
    return shutil.copytree(original.parent, tmp_path / original.parent.name) / original.name


@pytest.fixture
def machine() -> Callable[[str], ParameterFile]:
    """Return what reads the only file of a project by the name of its folder."""

    def read(folder: str) -> ParameterFile:
        (path,) = (examples_folder() / folder).glob("*.amp")
        return open_file(path).file

    return read
