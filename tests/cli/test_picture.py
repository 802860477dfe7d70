"""The verb for pictures."""

import json
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest


@pytest.fixture
def machine(tmp_path: Path, checkout: Path) -> Path:
    """Return a copy of the example mill."""
    path = tmp_path / "mill.amp"
    path.write_bytes((checkout / "examples" / "mill-1394" / "MILL_1394.amp").read_bytes())
    return path


def test_the_pictures_of_a_file_are_listed_with_their_parts(amp, machine: Path) -> None:
    message = amp("picture", machine)
    assert message.code == 0
    assert "travel       Travel: X Y, X Z, Y Z" in message.out.splitlines()
    listed = amp("picture", machine, "--json").json["pictures"]
    assert [each["picture"] for each in listed] == [
        "travel",
        "ramps",
        "gears",
        "jog",
        "increments",
        "error",
        "loop",
        "calibration",
    ]


def test_a_picture_is_written_as_svg_and_the_file_left_alone(amp, machine: Path) -> None:
    before, out = machine.read_bytes(), machine.with_name("travel.svg")
    message = amp("picture", machine, "travel", "--part", "x,z", "-o", out)
    assert (message.code, message.out) == (0, "")
    assert "Limit 3" in "".join(ET.fromstring(out.read_text("utf-8")).itertext())
    assert machine.read_bytes() == before


def test_a_picture_as_data_has_its_handles_in_the_unit_of_the_file(amp, machine: Path) -> None:
    reported = amp("picture", machine, "travel", "--json").json
    moves = {
        (m["id"], m["instance"]): h for h in reported["handles"] if len(h["moves"]) == 1 for m in h["moves"]
    }
    handle = moves["zone.overtravel_negative", "1"]
    assert (handle["value"], handle["at"][0], handle["moves"][0]["range"]) == (
        "-500 mm",
        -500.0,
        [-2540000.0, 8.0],
    )
    assert json.dumps(reported)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("nothing",), "has no picture 'nothing'. Pictures: travel, ramps"),
        (("travel", "--part", "Q"), "There is no part 'Q': X Y, X Z, Y Z"),
        (("travel", "-o", "travel.pdf"), "A picture is drawn as SVG"),
        (("-o", "travel.svg"), "Name a picture"),
        (("travel", "-o", "mill.amp"), ""),
    ],
)
def test_a_picture_that_cannot_be_drawn_is_refused(
    amp, machine: Path, folder, arguments, message: str
) -> None:
    arguments = [machine.parent / a if "." in a else a for a in arguments]
    before = machine.read_bytes()
    refused = amp("picture", machine, *arguments)
    assert (refused.code, message in refused.err) == (2, True), refused.err
    assert len(refused.err.splitlines()) == 1
    assert (machine.read_bytes(), [p.name for p in machine.parent.iterdir() if p.suffix == ".svg"]) == (
        before,
        [],
    )
