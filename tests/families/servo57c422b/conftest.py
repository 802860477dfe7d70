"""The small servo module of the tests of the AutoMax formats."""

import pytest

from amp_studio.schema import Schema, load_schema

from .small_module import small_module


@pytest.fixture(scope="session")
def module(tmp_path_factory: pytest.TempPathFactory) -> Schema:
    """Return a small servo module with every kind of register."""
    return small_module(tmp_path_factory.mktemp("made") / "small")


@pytest.fixture(scope="module")
def servo() -> Schema:
    """Return the real 57C422B family."""
    return load_schema("57c422b")
