"""The verb for pictures."""

import json
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest


def test_the_pictures_of_a_file_are_listed_with_their_parts(amp, example: Path) -> None:
    message = amp("picture", example)
    assert message.code == 0
    assert "travel       Travel: X Y, X Z, Y Z" in message.out.splitlines()
    listed = amp("picture", example, "--json").json["pictures"]
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


def test_a_picture_is_written_as_svg_and_the_file_left_alone(amp, example: Path) -> None:
    before, out = example.read_bytes(), example.with_name("travel.svg")
    message = amp("picture", example, "travel", "--part", "x,z", "-o", out)
    assert (message.code, message.out) == (0, "")
    assert "Limit 3" in "".join(ET.fromstring(out.read_text("utf-8")).itertext())
    assert example.read_bytes() == before


def test_a_picture_as_data_has_its_handles_in_the_unit_of_the_file(amp, example: Path) -> None:
    reported = amp("picture", example, "travel", "--json").json
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
    amp, example: Path, folder, arguments, message: str
) -> None:
    arguments = [example.parent / a if "." in a else a for a in arguments]
    before = example.read_bytes()
    refused = amp("picture", example, *arguments)
    assert (refused.code, message in refused.err) == (2, True), refused.err
    assert len(refused.err.splitlines()) == 1
    assert (example.read_bytes(), [p.name for p in example.parent.iterdir() if p.suffix == ".svg"]) == (
        before,
        [],
    )
