"""What every test shares: no display, no folder of the person who runs them, no clock in property tests."""

from __future__ import annotations

import atexit
import gc
import os
import shutil
import sys
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any
from xml.sax.saxutils import escape

import pytest
from _pytest.assertion import rewrite
from hypothesis import HealthCheck, settings
from hypothesis.internal.conjecture import providers

from tests.campaigns import CAMPAIGN, examples

if TYPE_CHECKING:
    from collections.abc import Iterator

    from amp_studio.schema import Schema

_KEPT = (
    "PATH",
    "PYTHONPATH",
    "VIRTUAL_ENV",
    "LD_LIBRARY_PATH",
    "TMPDIR",
    "TEMP",
    "TMP",
    "SYSTEMROOT",
    "COMSPEC",
    "PATHEXT",
)
_KEPT_BEGIN = ("AMP_STUDIO_FULL", "AMP_STUDIO_TEST_", "COV_", "PYTEST_")
"""Of the environment tests see what finds programs and packages, and what steers the tests: no language, no
number of columns, no style of Qt, no proxy, no password."""
_FIXED = {"QT_QPA_PLATFORM": "offscreen", "LANG": "C.UTF-8", "TZ": "UTC"}


def _private_folders() -> Path:
    """Make the temporary home of the user: one cache for all workers of a run, the rest for each alone;
    return the first.
    """
    home = os.environ.get("AMP_STUDIO_TEST_HOME")
    if home is None:
        home = os.environ["AMP_STUDIO_TEST_HOME"] = tempfile.mkdtemp(prefix="amp-studio-tests-")
        atexit.register(shutil.rmtree, home, ignore_errors=True)
    own = Path(home) / os.environ.get("PYTEST_XDIST_WORKER", "main")
    os.environ["HOME"] = str(own)
    os.environ["XDG_CACHE_HOME"] = str(Path(home) / "cache")
    for name in ("CONFIG", "DATA", "STATE", "RUNTIME"):
        folder = own / name.lower()
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        os.environ["XDG_RUNTIME_DIR" if name == "RUNTIME" else f"XDG_{name}_HOME"] = str(folder)
    return Path(home)


def _the_fonts_of_the_tests(home: Path) -> None:
    """Let fontconfig find the one font of ``tests/fonts`` and none of this computer."""
    file = home / "fonts.conf"
    fonts, cache = (
        escape(str(f)) for f in (Path(__file__).with_name("fonts"), home / "cache" / "fontconfig")
    )
    text = f"""<?xml version="1.0"?>
<!DOCTYPE fontconfig SYSTEM "fonts.dtd">
<fontconfig><dir>{fonts}</dir><cachedir>{cache}</cachedir></fontconfig>
"""
    if not file.exists():
        file.write_text(text, encoding="utf-8")
    os.environ["FONTCONFIG_FILE"] = str(file)


# Set here, before anything imports Qt or asks where the user's folders are.
for name in [name for name in os.environ if name not in _KEPT and not name.startswith(_KEPT_BEGIN)]:
    del os.environ[name]
os.environ.update(_FIXED)
if hasattr(time, "tzset"):
    time.tzset()
os.umask(0o022)
# The program is started some hundred times: compiled once, whatever the person who runs the tests has set.
sys.dont_write_bytecode = False
_the_fonts_of_the_tests(_private_folders())

# Two workers on two cores take as long as they take, and so does what they generate. Generated cases are the
# same each time, so that a change is judged by what it changed, and what an earlier run found is not
# remembered; `make campaign` tries new ones and prints how to repeat one.
_NO_CLOCK: Any = {"deadline": None, "suppress_health_check": [HealthCheck.too_slow]}
settings.register_profile("fixed", **_NO_CLOCK, derandomize=True, database=None, max_examples=examples(100))
settings.register_profile("campaign", **_NO_CLOCK, print_blob=True, max_examples=examples(100))
settings.load_profile("campaign" if CAMPAIGN else "fixed")
if not CAMPAIGN:
    # Hypothesis also tries the constants of the modules that are imported so far: with them the cases of a
    # test depended on the tests before it, and every worker parsed the whole program (4 s each in a fresh
    # clone).
    vars(providers)["_get_local_constants"] = lambda: vars(providers)["_local_constants"]


# Twelve thousand tests, and the schemas they load, stay to the end: Python need not look through them again
# and again, and not at all while they are collected.
gc.set_threshold(100_000)
gc.disable()


def pytest_collection_finish() -> None:
    """Leave what was collected out of the search for unreachable objects."""
    gc.freeze()
    gc.enable()


def pytest_sessionfinish() -> None:
    """Leave everything out of the search at the end of Python too: a worker has a gigabyte of it."""
    gc.disable()
    gc.freeze()


def pytest_collection(session: pytest.Session) -> None:
    """Divide the rewriting of the asserts (10 s of a processor in a fresh clone) among the workers:
    each stores its share where the others find it, and then collects.
    """
    workers = int(os.environ.get("PYTEST_XDIST_WORKER_COUNT", "1"))
    if workers == 1:
        return
    state = session.config.stash[rewrite.assertstate_key]
    asked = [Path(argument.partition("::")[0]).resolve() for argument in session.config.args]
    files = sorted(file for each in asked for file in (each.rglob("*.py") if each.is_dir() else [each]))
    for file in files[int(os.environ["PYTEST_XDIST_WORKER"][2:]) :: workers]:
        pyc = rewrite.get_cache_dir(file) / (file.stem + rewrite.PYC_TAIL)
        if (
            file.name.startswith(("test_", "conftest"))
            and not pyc.exists()
            and rewrite.try_makedirs(pyc.parent)
        ):
            hashed, code = rewrite._rewrite_test(file, session.config)
            rewrite._write_pyc(state, code, hashed, pyc)


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_setupnodes() -> None:
    """Compile the facts of every family once, before several workers do it at the same time."""
    from amp_studio.schema import family_ids, load_schema  # after the folders above are set

    for family in family_ids():
        load_schema(family)


@pytest.fixture(scope="session", autouse=True)
def _nothing_waits_for_long() -> Iterator[None]:
    """Wait a tenth of a second, not half of one or two, for a Grbl to make itself known: what is not one
    never answers. Simulate in Python what is not worth its machine code.
    """
    with pytest.MonkeyPatch.context() as patch:
        for name in ("RECOGNISED", "RECOGNISED_SERIAL"):
            patch.setattr(f"amp_studio.transfer.client.drivers.{name}", 0.1)
        # In a fresh checkout machine code takes 5 s a law to be made, as long as so many steps in Python.
        patch.setattr("amp_studio.sim.engine.compiled.PLAIN_STEPS", 1_000_000)
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
