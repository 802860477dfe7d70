"""What the tests of Grbl controls have in common."""

from pathlib import Path

import pytest

from tests.families.grblhal.bench import Bench


@pytest.fixture
def bench(tmp_path: Path) -> Bench:
    return Bench(tmp_path)
