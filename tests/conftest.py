"""What every test shares: no display, no folder of the person who runs them, no clock in property tests."""

from __future__ import annotations

import atexit
import gc
import os
import shutil
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from hypothesis import settings

if TYPE_CHECKING:
    from collections.abc import Iterator

    from amp_studio.schema import Schema

# Set here, before anything imports Qt or asks where the user's folders are.
os.environ["QT_QPA_PLATFORM"] = "offscreen"
os.environ.pop("DISPLAY", None)
os.environ.pop("WAYLAND_DISPLAY", None)

# The program is started some hundred times: compiled once, whatever the person who runs the tests has set.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False


def _private_folders() -> None:
    """Point the user's folders to temporary ones: one cache for all workers of a run, the rest for each alone."""
    home = os.environ.get("AMP_STUDIO_TEST_HOME")
    if home is None:
        home = os.environ["AMP_STUDIO_TEST_HOME"] = tempfile.mkdtemp(prefix="amp-studio-tests-")
        atexit.register(shutil.rmtree, home, ignore_errors=True)
    own = Path(home) / os.environ.get("PYTEST_XDIST_WORKER", "main")
    os.environ["XDG_CACHE_HOME"] = str(Path(home) / "cache")
    for name in ("CONFIG", "DATA", "STATE"):
        os.environ[f"XDG_{name}_HOME"] = str(own / name.lower())


_private_folders()

# Two workers on two cores take as long as they take; a failing example is printed so that it can be repeated.
# CI repeats the same examples, so that a change is judged by what it changed; every other run explores further.
settings.register_profile("amp-studio", deadline=None, print_blob=True, derandomize="CI" in os.environ)
settings.load_profile("amp-studio")


# Eight thousand tests, and the schemas they load, stay to the end: Python need not look through them again and again.
gc.set_threshold(100_000)


def pytest_collection_finish() -> None:
    """Leave what was collected out of the search for unreachable objects."""
    gc.freeze()


@pytest.fixture(scope="session", autouse=True)
def _controls_answer_at_once() -> Iterator[None]:
    """Wait a tenth of a second, not half of one or two, for a Grbl to make itself known: what is not one never answers."""
    with pytest.MonkeyPatch.context() as patch:
        for name in ("RECOGNISED", "RECOGNISED_SERIAL"):
            patch.setattr(f"amp_studio.transfer.client.drivers.{name}", 0.1)
        yield


@pytest.fixture(scope="session")
def checkout() -> Path:
    """Return the top of the checkout."""
    return Path(__file__).resolve().parent.parent


@pytest.fixture(scope="session")
def wide_family(tmp_path_factory: pytest.TempPathFactory) -> Schema:
    """Return the schema of a family that is nothing like the 9/PC."""
    from .wide_family import wide_schema  # after the folders above are set

    return wide_schema(tmp_path_factory.mktemp("made") / "wide")
