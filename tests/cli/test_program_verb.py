"""The verb program."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from .conftest import Outcome

EXAMPLES = Path(__file__).parents[2] / "examples"
ROUTER = EXAMPLES / "acromill-router" / "ROUTER.amp"
PLATE = (
    "%\nG20 G90 G62\nG0 X-2 Y-1 Z-0.5\nG1 Z-0.6 F24\nX-3 F190\nG3 X-3.5 Y-1.5 I-3 J-1.5\nG1 X-3\n"
    "G0 Z-0.5\nM2\n"
)


@pytest.fixture
def plate(tmp_path: Path) -> Path:
    path = tmp_path / "plate.nc"
    path.write_text(PLATE)
    return path


def test_a_program_as_json_has_time_limits_and_error(amp: Callable[..., Outcome], plate: Path) -> None:
    message = amp("program", plate, "--machine", ROUTER, "--json", "--what-if", "speeds.feed_acc_dec=+20%")
    assert message.code == 0
    found = json.loads(message.out)
    assert found["time"]["unit"] == "s"
    assert sum(row["share"] for row in found["limited_by"]) == pytest.approx(1.0, abs=0.002)
    assert {"speeds.rapid", "speeds.feed_acc_dec"} <= {row["param"] for row in found["limited_by"]}
    assert found["contour_error"]["max"]["value"] >= found["contour_error"]["p95"]["value"] > 0.0
    assert sum(block["time_s"] for block in found["blocks"]) == pytest.approx(
        found["time"]["value"], rel=1e-4
    )
    tried = found["what_if"][0]
    assert tried["changes"] == [{"param": "speeds.feed_acc_dec", "from": "100 in/s²", "to": "120 in/s²"}]
    assert tried["time_change"] < 0.0


def test_text_csv_and_picture(amp: Callable[..., Outcome], plate: Path, tmp_path: Path) -> None:
    message = amp("program", plate, "--machine", ROUTER, "--no-contour", "-o", tmp_path / "a.csv")
    assert message.code == 0
    assert "Where the time goes:" in message.out
    rows = (tmp_path / "a.csv").read_text().splitlines()
    assert rows[0].startswith("line,start_s,time_s")
    assert len(rows) == 7
    assert amp("program", plate, "--machine", ROUTER, "--no-contour", "-o", tmp_path / "a.svg").code == 0
    assert "path" in (tmp_path / "a.svg").read_text()
    assert amp("program", plate, "--machine", ROUTER, "--no-contour", "-o", tmp_path / "a.pdf").code == 0
    assert (tmp_path / "a.pdf").read_bytes().startswith(b"%PDF")


def test_a_block_that_cannot_be_used_ends_with_1_and_is_named(
    amp: Callable[..., Outcome], tmp_path: Path
) -> None:
    path = tmp_path / "a.nc"
    path.write_text("G20\nG1 X-1 F10\nG41 X-2\n")
    message = amp("program", path, "--machine", ROUTER, "--no-contour")
    assert message.code == 1
    assert "Line 3: G41 is not simulated" in message.out


def test_two_changes_are_tried_each_and_together(amp: Callable[..., Outcome], plate: Path) -> None:
    changes = ("--what-if", "speeds.rapid=150", "--what-if", "speeds.min_corner=20")
    message = amp("program", plate, "--machine", ROUTER, "--no-contour", "--json", *changes)
    tries = json.loads(message.out)["what_if"]
    assert [len(each["changes"]) for each in tries] == [1, 1, 2]
    assert tries[2]["time"]["value"] <= min(each["time"]["value"] for each in tries[:2])


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (("--start", "Q1"), "has no axis Q"),
        (("--start", "X"), "has to be places of axes"),
        (("--override", "0"), "takes per cent"),
        (("--retract", "much"), "takes a length"),
        (("-o", "a.txt"), "is written as .csv, .svg, .pdf"),
        (("--what-if", "nothing=1"), "nothing"),
        (("--what-if", "speeds.rapid"), "is not PARAM=VALUE"),
        (("--what-if", "control.default_units=+5%"), "has no number"),
    ],
)
def test_what_is_no_option_ends_with_2(
    amp: Callable[..., Outcome], plate: Path, arguments: tuple[str, ...], sentence: str
) -> None:
    message = amp("program", plate, "--machine", ROUTER, *arguments)
    assert message.code == 2
    assert sentence in message.err


def test_a_family_without_printed_paths_and_a_file_that_is_none_end_with_2(
    amp: Callable[..., Outcome], plate: Path, tmp_path: Path
) -> None:
    message = amp("program", plate, "--machine", EXAMPLES / "57c422b-label-press" / "LABEL_PRESS.amp")
    assert (message.code, "no page here prints" in message.err) == (2, True)
    binary = tmp_path / "a.nc"
    binary.write_bytes(bytes(1000))
    message = amp("program", binary, "--machine", ROUTER)
    assert (message.code, "is no text" in message.err) == (2, True)


def test_a_program_runs_under_the_file_as_it_was_before_its_saves(
    amp: Callable[..., Outcome], plate: Path, tmp_path: Path
) -> None:
    machine = tmp_path / "ROUTER.amp"
    machine.write_bytes(ROUTER.read_bytes())
    assert amp("set", machine, "speeds.rapid=200").code == 0
    found = json.loads(
        amp("program", plate, "--machine", machine, "--history", "3", "--no-contour", "--json").out
    )
    (version,) = found["versions"]
    assert version["file"].startswith("before 2")
    assert version["file"].endswith("(speeds.rapid)")
    assert version["time_change"] > 0.0
