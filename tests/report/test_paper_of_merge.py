"""The paper of a comparison: every source with its result, conflicts that are open, secrets masked."""

from pathlib import Path

import pytest

from amp_studio.files import Merge, ParameterFile, Typed, new_file
from amp_studio.report.papers.merge import merge_paper
from amp_studio.report.papers.paper import PAPER_FORMATS, Paper, write_paper
from amp_studio.schema import MASKED, Value

CALIBRATION, PASSWORD = ("home.calibration", "1"), ("password.character", "1")
NAMES = {"base": "Last saved", "a": "mill.amp", "b": "CNC_1"}


def changed(base: ParameterFile, calibration: float, unit: str, password: int) -> ParameterFile:
    """Return a file with another calibration and another password."""
    file = base.copy()
    file.set(CALIBRATION, Value(calibration, unit))
    file.set(PASSWORD, Value(password))
    return file


@pytest.fixture
def merge() -> Merge:
    """Return a merge with two conflicts, one of them about a secret."""
    base = new_file("9pc", "mill", ["X"], "mill")
    return Merge(changed(base, 1.0, "mm", 70), changed(base, 1.0, "in", 71), base)


def cells(paper: Paper, name: str) -> tuple[str, ...]:
    """Return the row of a parameter."""
    return next(row for table in paper.tables for row in table.rows if row[1] == name)


def test_each_source_is_a_column_in_one_unit_and_an_open_conflict_is_named(merge: Merge) -> None:
    paper = merge_paper(merge, NAMES)
    assert cells(paper, "Home Calibration")[3:] == ("0 mm", "1 mm", "25.4 mm", "not settled")
    assert ("Conflicts", "2, 2 not settled") in paper.facts
    merge.choose(merge.conflicts[-1], "b")
    merge.take("b")
    assert cells(merge_paper(merge, NAMES), "Home Calibration")[-1] == "25.4 mm"


def test_a_typed_value_is_named_and_a_secret_is_masked(merge: Merge) -> None:
    for row in merge.conflicts:
        merge.choose(row, Typed(Value(2.0, "mm")) if row.address == CALIBRATION else "a")
    paper = merge_paper(merge, NAMES)
    assert cells(paper, "Home Calibration")[-1] == "2 mm (typed)"
    assert set(cells(paper, "Characters of the Password")[3:]) == {MASKED}


def test_it_is_written_in_every_format(merge: Merge, tmp_path: Path) -> None:
    for ending in set(PAPER_FORMATS) - {".pdf"}:
        path = tmp_path / f"paper{ending}"
        write_paper(merge_paper(merge, NAMES), path)
        assert path.stat().st_size > 200
