"""What the tests of the formats share."""

from pathlib import Path

import pytest

from amp_studio.files import Document, open_file
from amp_studio.schema import Schema, Value
from tests.families.num.small_num import small_num

EXAMPLE = Path(__file__).parents[2] / "examples" / "mill-1394" / "MILL_1394.amp"


@pytest.fixture
def mill(tmp_path: Path) -> Path:
    """The example's mill, which has no errors, with one speed in inches."""
    path = tmp_path / "mill.amp"
    file = open_file(EXAMPLE).file
    file.set(file.find("1350"), Value(10.0, "in/min"))
    Document.create(file, path).close()
    return path


@pytest.fixture(scope="session")
def num(tmp_path_factory: pytest.TempPathFactory) -> Schema:
    """Return a small NUM family with a word of every type, and all words of the manual's example."""
    return small_num(tmp_path_factory.mktemp("made") / "num")
