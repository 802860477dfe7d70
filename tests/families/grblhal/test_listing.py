"""A saved answer to $$ is read with whatever a sender has around it, and written as the control shows it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from amp_studio.cli import run
from amp_studio.families.grblhal.formats.listing import FORMAT
from amp_studio.files import open_file
from amp_studio.formats.text_format import FormatError
from amp_studio.schema import Value, load_schema

from .recorded import LISTING

CLASSIC = """Grbl 1.1h ['$' for help]
ok
$0=10 (Step pulse time, microseconds)
$1=25    (Step idle delay, milliseconds)
$2=0
$3=5 ; direction
$4=0
$5=0
$6=0
$10=1
$11=0.010
$12=0.002
$13=0
$20=0
$21=0
$22=1
$23=3
$24=25.000
$25=500.000
$26=250
$27=1.000
$30=1000.
$31=0.
$32=0
$100=250.000
$101=250.000
$102=250.000
$110=500.000
$111=500.000
$112=500.000
$120=10.000
$121=10.000
$122=10.000
$130=200.000
$131=200.000
$132=200.000
ok
<Idle|MPos:0.000,0.000,0.000|FS:0,0>
"""


def read(text: str, *, keep: bool = False) -> dict[tuple[str, str], Value]:
    assert FORMAT.recognises(text)
    return FORMAT.read(text, load_schema("grblhal"), keep).values


def test_a_listing_comes_back_as_it_was(tmp_path: Path) -> None:
    text, made, again = tmp_path / "backup.txt", tmp_path / "mill.amp", tmp_path / "again.settings"
    text.write_text(f">>> $$\r\n{LISTING}ok\n", "utf-8")
    assert run(["import", str(text), "-o", str(made)]) == 0
    assert open_file(made).file.values[("build.axes", "")] == Value("XYZ")
    assert run(["validate", str(made)]) == 0
    assert run(["export", str(made), "-o", str(again)]) == 0
    assert again.read_text("utf-8") == LISTING


def test_a_grbl_is_told_by_having_all_of_its_settings_and_no_other(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text, made = tmp_path / "old.nc", tmp_path / "old.amp"
    text.write_text(CLASSIC, "utf-8")
    assert run(["import", str(text), "-o", str(made)]) == 0
    capsys.readouterr()
    assert run(["get", str(made), "$22", "$3", "$30", "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)["values"]
    assert [(row["id"], row["value"]) for row in rows] == [
        ("classic.homing", "Yes"),
        ("stepper.invert_direction", 5),
        ("spindle.max_speed", 1000.0),
    ]
    older = "".join(line for line in CLASSIC.splitlines(True) if not line.startswith("$3"))
    assert ("homing.cycle", "") in read(older), "without $3 it is no Grbl, but a part of something"


def test_start_up_lines_and_offsets_of_a_log_are_left_out_with_a_note() -> None:
    text = "$I\n[VER:1.1f:]\n$#\n[G54:0.000,0.000,0.000]\n$N0=G21 G90\n$N1=\n$110=600\nok\n"
    found = FORMAT.read(text, load_schema("grblhal"), False)
    assert found.values == {("axis.max_rate", "X"): Value(600.0, "mm/min")}
    assert found.notes == ["start-up lines are no settings and are left out: $N0"]


def test_a_part_of_a_listing_is_read_as_one_of_grblhal() -> None:
    assert read("$22=1\n$110=600\n") == {
        ("homing.cycle", ""): Value(1),
        ("axis.max_rate", "X"): Value(600.0, "mm/min"),
    }


def test_the_steps_tell_how_many_axes_there_are() -> None:
    text = "".join(f"${100 + n}=80\n" for n in range(5))
    assert read(text)["build.axes", ""] == Value("XYZAB")
    assert read(text + "$376=1\n")["axis.steps", "A"] == Value(80.0, "steps/deg")
    assert read(text + "$376=1\n")["axis.steps", "B"] == Value(80.0, "steps/mm")


def test_a_setting_that_is_not_known_is_kept_where_that_is_asked_for() -> None:
    with pytest.raises(FormatError, match=r"line 2, column 1: \$999 is a setting that is not known"):
        read("$0=5\n$999=a b\n")
    kept = FORMAT.read("$0=5\n$999=a b\n", load_schema("grblhal"), True)
    assert kept.unknown == {"$999": "a b"}


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("$0=5\n$0=6\n", r"line 2, column 1: \$0 occurs twice, in line 1 already"),
        ("$0=5\nG0 X1\n", r"line 2, column 1: 'G0 X1' is no setting"),
        ("$0=1e-05\n", r"line 1, column 1: \$0: '1e-05' is not a number"),
        ("$0=\n", r"\$0: '' is not a number"),
        ("$22=1.5\n", r"\$22: Homing cycle takes whole numbers, not 1.5"),
        ("$0=" + "9" * 400 + "\n", "is not a number"),
        ("$0=nan\n", "is not a number"),
        ("$0=0x05\n", "is not a number"),
    ],
)
def test_what_cannot_be_meant_is_refused_with_its_line(text: str, message: str) -> None:
    with pytest.raises(FormatError, match=message):
        read(text)


@pytest.mark.parametrize("text", ["", "G0 X1\n$0=5\n", "hello", "$N0=G21", "$X", "$100 is the first"])
def test_other_texts_are_not_recognised(text: str) -> None:
    assert not FORMAT.recognises(text)


def test_a_choice_out_of_range_and_a_code_are_read_as_they_are() -> None:
    found = read("$32=7\n$20=3\n")
    assert found == {("general.mode", ""): Value("raw:7"), ("limits.soft", ""): Value("raw:3")}


def test_a_figure_smaller_than_what_is_shown_is_written_whole(tmp_path: Path) -> None:
    made, text = tmp_path / "mill.amp", tmp_path / "mill.settings"
    assert run(["new", "grblhal", str(made)]) == 0
    assert run(["set", str(made), "$11=0.0004", "$100=123.4567891"]) == 0
    assert run(["export", str(made), "-o", str(text)]) == 0
    assert "\n$11=0.0004\n" in text.read_text("utf-8")
    assert "\n$100=123.4567891\n" in text.read_text("utf-8")
