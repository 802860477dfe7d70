"""``amp-studio sheet``: print, write, tick, read back, and what its exit codes mean."""

import json
import shutil
from pathlib import Path

import pytest

from amp_studio.files import open_file
from amp_studio.transfer.client.kept import save_image
from amp_studio.transfer.image import encode_image
from tests.campaigns import some

EXAMPLE = Path(__file__).parents[2] / "examples" / "mill-1394" / "MILL_1394.amp"


@pytest.fixture
def sides(tmp_path: Path, amp) -> tuple[Path, Path]:
    """Return a file in which two limits are wider than in the control's, and what the control contains."""
    wanted, present = tmp_path / "wanted.amp", tmp_path / "present.amp"
    shutil.copy(EXAMPLE, wanted)
    shutil.copy(EXAMPLE, present)
    assert amp("set", wanted, "1740=39 mm", "1750=40 mm").code == 0
    return wanted, present


def test_the_sheet_is_printed_in_a_safe_order_and_nothing_is_written(amp, sides, tmp_path: Path) -> None:
    before = sorted(tmp_path.iterdir())
    message = amp("sheet", sides[0], "--against", sides[1])
    assert message.code == 0
    assert message.out.index("1750 ") < message.out.index("1740 ")
    assert (
        "[ ]    1  1750                      40 mm                  11  Excess Error Axis X (page 7-20)"
        in message.out
    )
    assert sorted(tmp_path.iterdir()) == before


def test_a_kept_copy_is_a_side_as_good_as_a_file(amp, sides, tmp_path: Path) -> None:
    copy = tmp_path / "mill.before-20261122-140000.img"
    save_image(encode_image(open_file(sides[1]).file), copy)
    of_copy, of_file = (amp("sheet", sides[0], "--against", side, "--json").json for side in (copy, sides[1]))
    assert of_copy["entries"] == of_file["entries"]
    assert [(e["param"], e["old"], e["new"], e["unit"]) for e in of_copy["entries"]] == [
        ("1750", "11", "40", "mm"),
        ("1740", "11", "39", "mm"),
    ]


@pytest.mark.parametrize("ending", some([".pdf", ".html", ".txt", ".csv"], 2))
def test_the_sheet_is_written_in_the_format_of_its_ending(amp, sides, tmp_path: Path, ending: str) -> None:
    output = tmp_path / f"sheet{ending}"
    message = amp("sheet", sides[0], "--against", sides[1], "-o", output)
    assert (message.code, message.out) == (0, f"{output}: 2 values to key in, 0 ticked\n")
    content = output.read_bytes()
    assert content.startswith(b"%PDF") if ending == ".pdf" else b"1750" in content


def test_ticks_are_kept_beside_the_file_and_the_work_goes_on_where_it_ended(amp, sides) -> None:
    assert amp("sheet", sides[0], "--against", sides[1], "--tick", "1750").code == 0
    entries = amp("sheet", sides[0], "--against", sides[1], "--json").json["entries"]
    assert [entry["ticked"] for entry in entries] == [True, False]
    assert "[x]    1  1750" in amp("sheet", sides[0], "--against", sides[1]).out
    amp("sheet", sides[0], "--against", sides[1], "--untick", "servo.excess_error@1")
    assert not any(
        e["ticked"] for e in amp("sheet", sides[0], "--against", sides[1], "--json").json["entries"]
    )


def test_what_the_screen_shows_is_compared_and_each_difference_is_named(amp, sides, tmp_path: Path) -> None:
    screen = tmp_path / "screen.txt"
    screen.write_text("1750 40.00000\n1740 11.00000\n")
    message = amp("sheet", sides[0], "--against", sides[1], "--check", screen)
    assert message.code == 1
    assert message.out.splitlines() == [
        (
            "1740 Feedrate Suppression Point Axis X: still the old value: the screen shows 11.00000, it"
            " should be 39 mm"
        ),
        "1 as keyed in, 1 still the old value",
    ]
    screen.write_text("1750 40.00000\n1740 39\n")
    assert amp("sheet", sides[0], "--against", sides[1], "--check", screen).code == 0


def test_a_value_that_was_not_read_back_is_not_proved(amp, sides, tmp_path: Path) -> None:
    screen = tmp_path / "screen.txt"
    screen.write_text("1750 40\n")
    message = amp("sheet", sides[0], "--against", sides[1], "--check", screen, "--json")
    assert (message.code, [entry["state"] for entry in message.json["entries"]]) == (1, ["same", "not read"])


@pytest.mark.parametrize(
    ("more", "message"),
    [
        (("--tick", "1350"), "1350 is not on this sheet"),
        (("--tick", "nonsense"), "Unknown parameter 'nonsense'"),
        (("--check", "nowhere.txt"), "nowhere.txt: No such file or directory"),
        (("-o", "sheet.doc"), "unknown format of a sheet"),
    ],
)
def test_what_cannot_be_understood_is_refused_in_one_line(amp, sides, monkeypatch, more, message) -> None:
    monkeypatch.chdir(sides[0].parent)
    refused = amp("sheet", sides[0], "--against", sides[1], *more)
    assert refused.code == 2
    assert message in refused.err


@pytest.mark.parametrize("content", ["1750", "1750 40\n1750 40", "9 9"])
def test_a_list_of_the_screen_that_cannot_be_understood_names_file_and_line(
    amp, sides, tmp_path, content
) -> None:
    screen = tmp_path / "screen.txt"
    screen.write_text(content)
    refused = amp("sheet", sides[0], "--against", sides[1], "--check", screen)
    assert refused.code == 2
    assert f"{screen}: line " in refused.err


def test_neither_the_file_nor_its_ticks_are_overwritten_by_the_sheet(amp, sides) -> None:
    amp("sheet", sides[0], "--against", sides[1], "--tick", "1750")
    ticks = sides[0].with_name("wanted.amp.ticks.json")
    for output in (sides[0], ticks):
        before = output.read_bytes()
        assert amp("sheet", sides[0], "--against", sides[1], "-o", output).code == 2
        assert output.read_bytes() == before
    assert json.loads(ticks.read_bytes())["ticks"][0]["number"] == "1750"


def test_errors_that_are_there_afterwards_are_reported_though_patch_amp_does_not(amp, sides) -> None:
    assert amp("set", sides[0], "1740=not-set", "1750=1 mm").code == 0
    message = amp("sheet", sides[0], "--against", sides[1])
    assert "Error when all is keyed in" in message.err


def test_an_error_of_several_axes_is_one_line_with_their_letters(amp, tmp_path: Path) -> None:
    """It was a line for each axis, and none had the axis."""
    file = tmp_path / "new.amp"
    assert amp("new", "9pc", file, "--axes", "X,Y,Z").code == 0
    shutil.copy(file, present := tmp_path / "present.amp")
    lines = amp("sheet", file, "--against", present).err.splitlines()
    assert len(lines) == len(set(lines)) > 0
    assert [line for line in lines if not line.startswith("Error as before (X, Y, Z): The axis")] == []
    german = amp("sheet", file, "--against", present, "--language", "de").err
    assert german.startswith("Fehler wie zuvor (X, Y, Z): Die Achse")
