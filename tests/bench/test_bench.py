"""The benchmarks run and say what they measured. How long anything takes is no matter of a test."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

TARGETS = {
    "every fix of a badly damaged 9/PC file",
    "one edit of a cam of 1900 points",
    "frame of a dragged handle, 9/PC, processor time",
    "frame of a dragged handle, NUM, processor time",
    "the worst of all, with findings and other views",
    "frame while scrolling by the wheel, at worst",
    "frame while scrolling by the page, at worst",
    "key that moves the current cell, painted, at worst",
    "edit of a value in the table, painted, at worst",
    "keystroke in a cell, with its result, painted, at worst",
    "--version, cold process",
    "validate, cold process",
    "report to PDF, cold process",
    "report to a web page without motion, cold process",
    "simulate a move and draw it, cold process",
    "10 s of an axis with all non-linear parts",
    "9pc law, a sample each 1 ms",
    "num law, a sample each 5 ms",
    "syntec law, a sample each 0.2457 ms",
    "57c422b law, a sample each 1.25 ms",
    "acromill law, a sample each 0.4 ms",
    "first paint of the desktop program, cold process",
    "load the schema from its cache",
    "the loaded schema in memory",
    "memory with five families open in one window",
    "full file open in a window, painted",
    "keystroke in the find box, painted",
    "48 published listings: refused",
    "published listings: values lost or changed",
    "published listings: false errors per listing",
    "index of grblhal",
    "a question, every keystroke of it",
    "the slowest keystroke",
    "a question after an edit",
    "a comparison of three, painted",
    "a comparison filtered, painted",
    "all rows of a comparison filtered, painted",
    "a side taken with its findings, painted",
    "open and validate",
    "full run over a full 9/PC file, just opened",
    "a full 9/PC file again",
    "full run over a NUM file, just opened",
    "a NUM file again",
    "re-validate after one edit of a 9/PC value",
    "another value of servo.excess_error@1",
    "re-validate after one edit of a NUM value",
    "import and validate a full NUM table",
    "download of a full file, TCP (0.5 s of it is the control's restart)",
    "verify of a full file, TCP",
    "validate 12 files from the command line on all processors: a file",
    "validate 12 files again, ten changed",
}


def files_of(checkout: Path) -> set[Path]:
    return {path for folder in ("bench", "examples") for path in (checkout / folder).rglob("*.*")}


@pytest.fixture(scope="module")
def rows(checkout: Path, tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    """Return the lines that ``bench/run.py --quick`` prints, run from somewhere else."""
    before = files_of(checkout)
    command = [sys.executable, str(checkout / "bench" / "run.py"), "--quick"]
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
    assert len(measures) >= 20
    time = r"[\d.]+ (?:s|ms|µs|MB|%)"
    for measure in measures:
        assert re.fullmatch(
            rf" *\S.*?  +{time}  +{time}  +{time}(?:  +< {time}  +(?:pass|over))?", measure
        ), measure


def test_every_target_is_judged(rows: list[str]) -> None:
    judged = {row.strip().split("  ")[0] for row in rows if row.endswith(("pass", "over"))}
    assert judged == TARGETS
