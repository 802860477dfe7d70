"""The benchmarks run and say what they measured. How long anything takes is no matter of a test."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.campaigns import CAMPAIGN

QUICK = ("warm", "rules", "screen", "grid") if CAMPAIGN else ("grid",)
"""Groups that take no process or kernel each, and the one that needs most of the program, for every day;
`make bench` measures all.
"""
TARGETS_OF_THE_GRID = {
    "frame while scrolling by the wheel, at worst",
    "frame while scrolling by the page, at worst",
    "key that moves the current cell, painted, at worst",
    "edit of a value in the table, painted, at worst",
    "keystroke in a cell, with its result, painted, at worst",
}
TARGETS = {
    *TARGETS_OF_THE_GRID,
    "every fix of a badly damaged 9/PC file",
    "one edit of a cam of 1900 points",
    "full run over a full 9/PC file, just opened",
    "a full 9/PC file again",
    "full run over a NUM file, just opened",
    "a NUM file again",
    "re-validate after one edit of a 9/PC value",
    "another value of servo.excess_error@1",
    "re-validate after one edit of a NUM value",
    "import and validate a full NUM table",
    "load the schema from its cache",
    "the loaded schema in memory",
    "open and validate",
    "keystroke in the find box, painted",
}


def files_of(checkout: Path) -> set[Path]:
    return {path for folder in ("bench", "examples") for path in (checkout / folder).rglob("*.*")}


@pytest.fixture(scope="module")
def rows(checkout: Path, tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    """Return the lines that ``bench/run.py --quick`` prints of some groups, run from somewhere else."""
    before = files_of(checkout)
    command = [sys.executable, str(checkout / "bench" / "run.py"), "--quick", "--only", *QUICK]
    done = subprocess.run(
        command, cwd=tmp_path_factory.mktemp("bench"), capture_output=True, encoding="utf-8", check=False
    )
    assert done.returncode == 0, done.stderr
    assert {p for p in files_of(checkout) - before if "__pycache__" not in p.parts} == set(), (
        "it leaves nothing"
    )
    return done.stdout.splitlines()


def test_it_prints_one_table_with_every_measure(rows: list[str]) -> None:
    machine, head, line, *measures = rows
    assert machine.startswith("Python ")
    assert head.split() == ["median", "min", "max", "target"]
    assert set(line) == {"-"}
    assert len(measures) >= (20 if CAMPAIGN else 6)
    time = r"[\d.]+ (?:s|ms|µs|MB|%)"
    for measure in measures:
        assert re.fullmatch(
            rf" *\S.*?  +{time}  +{time}  +{time}(?:  +< {time}  +(?:pass|over))?", measure
        ), measure


def test_every_target_is_judged(rows: list[str]) -> None:
    judged = {row.strip().split("  ")[0] for row in rows if row.endswith(("pass", "over"))}
    assert judged == (TARGETS if CAMPAIGN else TARGETS_OF_THE_GRID)
