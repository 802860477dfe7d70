"""Every run of the tests tries the same cases on the same ground, whatever computer it runs on."""

import ast
import os
import re
import sys
import time
from pathlib import Path

import pytest
from hypothesis import settings
from PySide6.QtGui import QFontDatabase, QFontInfo
from PySide6.QtWidgets import QApplication

from tests.campaigns import CAMPAIGN

SOURCES = sorted(Path(__file__).parent.rglob("*.py"))
UNSEEDED = {
    "betavariate",
    "choice",
    "choices",
    "gauss",
    "getrandbits",
    "randbytes",
    "randint",
    "random",
    "randrange",
    "sample",
    "shuffle",
    "uniform",
}
"""Functions of the module ``random`` that draw from a generator that begins anywhere."""


def drawn_anew(source: str) -> list[str]:
    """Return the calls in a source that draw from a generator without a seed,
    and settings that undo the fixed ones.
    """
    if not re.search("random|default_rng", source, re.IGNORECASE):
        return []  # parsing all tests takes seconds
    found, tree = [], ast.parse(source)
    imported = any(isinstance(node, ast.Import) and node.names[0].name == "random" for node in ast.walk(tree))
    for node in ast.walk(tree):
        if not isinstance(node, ast.Call):
            continue
        name = ast.unparse(node.func)
        module, _, function = name.rpartition(".")
        found += [name] * (function in ("Random", "default_rng") and not node.args and not node.keywords)
        found += [name] * (
            (imported and module == "random" and function in UNSEEDED) or function == "SystemRandom"
        )
        found += [f"{name}({each.arg})" for each in node.keywords if each.arg == "derandomize"]
    return found


@pytest.mark.parametrize(
    ("source", "calls"),
    [
        ("import random\nx = random.Random()", ["random.Random"]),
        ("x = np.random.default_rng()", ["np.random.default_rng"]),
        ("import random\nx = random.choice('ab')", ["random.choice"]),
        ("@settings(derandomize=False)\ndef test(): ...", ["settings(derandomize)"]),
        ("chance = Random(7)\nx = chance.choice('ab')", []),
    ],
)
def test_a_generator_without_a_seed_is_seen(source: str, calls: list[str]) -> None:
    assert drawn_anew(source) == calls


def test_no_test_draws_from_a_generator_without_a_seed() -> None:
    drawn = {path.name: drawn_anew(path.read_text(encoding="utf-8")) for path in SOURCES}
    assert {name: calls for name, calls in drawn.items() if calls and name != "conftest.py"} == {}


@pytest.mark.skipif(CAMPAIGN, reason="a campaign tries new cases")
def test_generated_examples_are_the_same_each_time() -> None:
    assert (settings.default.derandomize, settings.default.database) == (True, None)


def test_nothing_of_the_person_who_runs_the_tests_is_used() -> None:
    home = Path(os.environ["AMP_STUDIO_TEST_HOME"])
    assert Path.home().is_relative_to(home)
    assert all(
        Path(path).is_relative_to(home) for name, path in os.environ.items() if name.startswith("XDG_")
    )
    assert (os.environ["LANG"], time.timezone) == ("C.UTF-8", 0)
    assert not {
        "LANGUAGE",
        "LC_ALL",
        "COLUMNS",
        "NO_COLOR",
        "CI",
        "QT_SCALE_FACTOR",
        "QT_STYLE_OVERRIDE",
    } & set(os.environ)


@pytest.mark.skipif(sys.platform != "linux", reason="fontconfig chooses the fonts on Linux")
def test_windows_have_the_font_of_the_tests_and_no_other(qapp: QApplication) -> None:
    of_the_program = {family for n in range(20) for family in QFontDatabase.applicationFontFamilies(n)}
    assert set(QFontDatabase.families()) - of_the_program - {"Sans Serif", "Serif", "Monospace"} == {
        "DejaVu Sans"
    }
    general = QFontDatabase.systemFont(QFontDatabase.SystemFont.GeneralFont)
    assert QFontInfo(general).family() == "DejaVu Sans"
