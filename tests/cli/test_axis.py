"""The verb ``axis``: every family's axes from the command line."""

import json
from pathlib import Path

import pytest

from amp_studio.files import open_file


@pytest.fixture
def num(amp, tmp_path: Path) -> Path:
    """Return a NUM with the axes X, Y and B."""
    path = tmp_path / "num.amp"
    assert amp("new", "num", path, "--axes", "X,Y,B").code == 0
    return path


def test_axes_are_listed_with_name_type_and_group(amp, num: Path) -> None:
    assert amp("axis", num).out.splitlines() == ["0 X linear", "1 Y linear", "2 B rotary", "3 of 32 axes"]
    message = json.loads(amp("axis", num, "list", "--json").out)
    assert message["axes"][2] == {"axis": "2", "name": "B", "type": "rotary", "group": "Group 1"}


def test_values_are_copied_and_compared_by_letter(amp, num: Path) -> None:
    amp("set", num, "travel.limit_max@X=5000 iu", "P15N0=1")
    message = amp("axis", num, "compare", "x", "Y")
    assert message.code == 1
    assert message.out.splitlines()[-1] == "0 X linear and 1 Y linear: 2 differ"
    rows = json.loads(amp("axis", num, "compare", "X", "Y", "--json").out)["differences"]
    assert rows == [
        {"param": "P15N0.0", "a": "yes", "b": "no"},
        {"param": "P17N1", "a": "5000 iu", "b": "not set"},
    ]
    assert "P17N3 Axis Travel Limits, Maximum: not set -> 5000 iu" in amp("axis", num, "copy", "X", "Y").out
    assert amp("axis", num, "compare", "X", "Y").code == 0
    assert amp("axis", num, "copy", "X", "Y").err == "no change\n"


def test_axes_are_named_added_swapped_and_removed(amp, num: Path) -> None:
    assert amp("axis", num, "name", "Y", "V").code == 0
    assert amp("axis", num, "add", "Z").code == 0
    assert amp("axis", num, "swap", "Z", "X").code == 0
    assert amp("axis", num, "remove", "B").code == 0
    assert amp("axis", num).out.splitlines()[:-1] == ["0 Z linear", "1 V linear", "3 X linear"]
    assert num.with_name("num.amp.bak").exists(), "each change has its backup"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["copy", "X"], "axis copy takes 2 arguments"),
        (["list", "X"], "axis list takes no argument"),
        (["add"], "axis add takes 1 or 2 arguments"),
        (["copy", "X", "B"], "axis 0 is linear and axis 2 is rotary"),
        (["remove", "W"], "Unknown axis 'W'. Known: X, Y, "),
        (["type", "X", "rotary"], "has no types of axes"),
        (["name", "X", "Y"], "would both be named Y"),
        (["turn", "X"], "turn"),
    ],
)
def test_what_cannot_be_done_changes_nothing(amp, num: Path, arguments: list[str], message: str) -> None:
    before = num.read_bytes()
    refused = amp("axis", num, *arguments)
    assert refused.code == 2
    assert message in refused.err
    assert num.read_bytes() == before


def test_a_type_is_given_by_its_label(amp, tmp_path: Path) -> None:
    path = tmp_path / "mill.amp"
    amp("new", "9pc", path, "--machine", "mill", "--axes", "X,Y")
    assert amp("axis", path, "type", "Y", "rotary").code == 0
    assert open_file(path).file.get(("home.calibration", "2")).unit == "deg"
