"""The verb block."""

import json
from pathlib import Path

import pytest

from amp_studio.cli import run

EXAMPLES = Path(__file__).parents[2] / "examples"
MILL = str(EXAMPLES / "mill-1394" / "MILL_1394.amp")


def test_each_word_is_reported_with_its_number_and_parameters(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["block", MILL, "G01 X10 F200", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert [(w["word"], w["number"], w["unit"]) for w in found["words"]] == [
        ("G01", 1, ""),
        ("X10", 10, "mm"),
        ("F200", 200, "mm/min"),
    ]
    assert found["words"][2]["params"][:2] == ["467", "1201"]
    assert all(text.startswith("assumed") for text in found["assumptions"])


def test_a_word_that_the_control_refuses_ends_with_1(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["block", MILL, "X12345.", "--json"]) == 1
    assert json.loads(capsys.readouterr().out)["errors"] == [
        "X12345.: '12345.' has more digits than the format 4.3 allows"
    ]


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (("block", MILL, "X1 @"), "is no word"),
        (("block", str(EXAMPLES / "57c422b-label-press" / "LABEL_PRESS.amp"), "X1"), "no page here prints"),
        (("block", MILL, "X1\n" * 1001), "more than 1000"),
    ],
)
def test_what_cannot_be_read_ends_with_2(
    arguments: tuple[str, ...], sentence: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run([*arguments]) == 2
    assert sentence in capsys.readouterr().err


def test_without_a_block_it_is_what_power_up_puts_in_force(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["block", MILL]) == 0
    assert "G21  metric" in capsys.readouterr().out
    assert run(["block", MILL, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert {"what": "unit", "code": "G21", "meaning": "metric", "params": ["526"], "source": "18-3"} in found[
        "active"
    ]
