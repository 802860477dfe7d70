"""The small NUM family of the tests of its table."""

import pytest

from amp_studio.schema import Schema

from .small_num import small_num


@pytest.fixture(scope="session")
def num(tmp_path_factory: pytest.TempPathFactory) -> Schema:
    """Return a small NUM family with a word of every type, and all words of the manual's example."""
    return small_num(tmp_path_factory.mktemp("made") / "num")
