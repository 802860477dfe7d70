"""The benchmarks run and print what they measured. How long anything takes is no matter of a test."""

import importlib
import re
import sys
from pathlib import Path

import pytest

from tests.campaigns import CAMPAIGN

QUICK = ("find", "warm", "rules", "screen", "grid") if CAMPAIGN else ("find",)
"""Groups that take no process or kernel each, and the quickest of them, for every day; `make bench` measures
all."""
TARGETS_OF_FIND = {
    "index of grblhal",
    "a question, every keystroke of it",
    "the slowest keystroke",
    "a question after an edit",
}
TARGETS = {
    *TARGETS_OF_FIND,
    "frame while scrolling by the wheel, at worst",
    "frame while scrolling by the page, at worst",
    "key that moves the current cell, painted, at worst",
    "edit of a value in the table, painted, at worst",
    "keystroke in a cell, with its result, painted, at worst",
    "step of an expression, as its cost is counted",
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
    "edit of a value, painted, at worst",
    "edit of a value, 165 findings more and less, painted, at worst",
    "edit of the type of an axis, painted, at worst",
    "page of all parameters scrolled, painted, at worst",
    "theme, painted",
    "a full file opened in a running window, painted",
}


def test_it_prints_one_table_with_every_measure_and_judges_every_target(
    checkout: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.syspath_prepend(str(checkout / "bench"))
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "argv", ["run.py", "--quick", "--only", *QUICK])
    importlib.import_module("run").main()
    machine, head, line, *measures = capsys.readouterr().out.splitlines()
    assert list(tmp_path.iterdir()) == [], "it leaves nothing"
    assert machine.startswith("Python ")
    assert head.split() == ["median", "min", "max", "target"]
    assert set(line) == {"-"}
    time = r"[\d.]+ (?:s|ms|µs|MB|%)"
    for measure in measures:
        assert re.fullmatch(
            rf" *\S.*?  +{time}  +{time}  +{time}(?:  +< {time}  +(?:pass|over))?", measure
        ), measure
    judged = {row.strip().split("  ")[0] for row in measures if row.endswith(("pass", "over"))}
    assert judged == (TARGETS if CAMPAIGN else TARGETS_OF_FIND)
