"""Papers of the command line: what differs as a document, machines side by side, forms."""

import json
from pathlib import Path

import pytest


@pytest.fixture
def other(mill: Path, amp) -> Path:
    path = mill.with_name("other.amp")
    path.write_bytes(mill.read_bytes())
    assert amp("set", path, "1300=1.5").code == 0
    return path


def test_differences_are_written_as_a_document(amp, mill: Path, other: Path, tmp_path: Path) -> None:
    message = amp("diff", mill, other, "-o", tmp_path / "d.html")
    assert message.code == 1, "they differ"
    assert "Home Calibration" in (tmp_path / "d.html").read_text("utf-8")
    assert amp("diff", mill, mill, "-o", tmp_path / "same.csv").code == 0
    assert amp("diff", mill, other, "-o", tmp_path / "d.doc").code == 2
    assert amp("diff", mill, other, "-o", other).code == 2, "a parameter file is no document"


def test_machines_are_compared_value_by_value(amp, mill: Path, other: Path, tmp_path: Path) -> None:
    message = amp("compare", mill, other, mill, "--json")
    assert message.code == 1
    (row,) = json.loads(message.out)["rows"]
    assert (row["param"], row["values"][1]) == ("1300", "1.5 mm")
    assert row["values"][0] == row["values"][2] != row["values"][1]
    assert "1 listed" in amp("compare", mill, other).out
    assert amp("compare", mill, mill).code == 0
    assert "give two files or more" in amp("compare", mill).err
    assert amp("compare", mill, other, "-o", tmp_path / "c.xlsx").code == 1
    assert (tmp_path / "c.xlsx").read_bytes().startswith(b"PK")


def test_forms_are_of_a_family_or_of_a_machine(amp, mill: Path, tmp_path: Path) -> None:
    assert amp("form", "num", "-o", tmp_path / "n.html").code == 0
    assert "P4N0" in (tmp_path / "n.html").read_text("utf-8")
    assert amp("form", mill, "-o", tmp_path / "m.html").code == 0
    assert "____" in (tmp_path / "m.html").read_text("utf-8")
    assert "its own machine type" in amp("form", mill, "--machine", "lathe", "-o", tmp_path / "x.html").err
    assert amp("form", "num", "--machine", "boat", "-o", tmp_path / "x.html").code == 2
    assert not (tmp_path / "x.html").exists()
