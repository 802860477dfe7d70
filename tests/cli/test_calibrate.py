"""calibrate: what an axis has, what measured points would make of it, and points changed by hand;
all or nothing.
"""

import math
from pathlib import Path

import pytest

from .conftest import MEASURED, from_points

MILL = Path(__file__).parents[2] / "examples" / "mill-1394" / "MILL_1394.amp"
POINTS = "position [mm],error [um]\n0,0\n100,4\n200,7\n200,13\n100,10\n0,6\n"


@pytest.fixture
def laser(tmp_path: Path) -> Path:
    path = tmp_path / "laser.csv"
    path.write_text(POINTS)
    return path


def table(amp, example: Path, axis: str = "X"):
    return amp("calibrate", example, "--axis", axis, "--json").json["table"]


def test_measured_points_become_a_table_and_a_reversal_error(amp, example: Path, laser: Path) -> None:
    message = amp(*from_points(example, laser), *MEASURED, "--json")
    assert message.code == 0
    found = message.json
    assert [(p["position"], p["figure"]) for p in found["table"]["points"]] == [
        (0, 0),
        (100, 0.004),
        (200, 0.007),
    ]
    assert found["reversal"] == {"param": "1340", "value": "0.006 mm"}
    assert found["residual"] == {"before": pytest.approx(0.013), "after": pytest.approx(0, abs=1e-9)}
    assert found["figures"]["mean_reversal"] == pytest.approx(-0.006)
    assert found["assumed"] == []
    assert amp("get", example, "1340", "--json").json["values"][0]["value"] == 0.006
    assert example.with_name("mill.amp.bak").read_bytes() == MILL.read_bytes()
    assert "calibration" not in amp("validate", example).out


def test_what_has_no_answer_is_shown_and_never_written(amp, example: Path, laser: Path) -> None:
    dry = amp(*from_points(example, laser), "--dry-run")
    assert dry.code == 0
    assert "--sign measured-target" in dry.err
    message = amp(*from_points(example, laser))
    assert message.code == 2
    assert "confirm with --sign measured-target" in message.err
    assert example.read_bytes() == MILL.read_bytes()


def test_a_dry_run_changes_nothing_and_shows_what_would_be(amp, example: Path, laser: Path) -> None:
    arguments = (*from_points(example, laser), "--sign", "target-measured", "--dry-run")
    found = amp(*arguments, "--json").json
    assert [p["figure"] for p in found["table"]["points"]] == [0, -0.004, -0.007]
    assert [change["param"] for change in found["changes"]] == ["calibration.table@1"]
    assert "would be changed" in amp(*arguments).out
    assert any("check the sign" in note for note in found["notes"])
    assert example.read_bytes() == MILL.read_bytes()


def test_a_compensated_axis_is_measured_again_only_with_an_answer(amp, example: Path, laser: Path) -> None:
    assert amp(*from_points(example, laser), *MEASURED).code == 0
    again = amp(*from_points(example, laser), *MEASURED)
    assert again.code == 2
    assert "compensation on or off" in again.err
    assert amp(*from_points(example, laser), *MEASURED, "--compensation", "on").code == 0
    assert [p["figure"] for p in table(amp, example)["points"]] == [0, 0.008, 0.014]


def test_only_one_of_both_is_made_where_only_one_is_wanted(amp, example: Path, laser: Path) -> None:
    base = (*from_points(example, laser), *MEASURED, "--dry-run", "--json")
    assert [c["param"] for c in amp(*base, "--only", "table").json["changes"]] == ["calibration.table@1"]
    only = amp(*base, "--only", "reversal").json
    assert [c["param"] for c in only["changes"]] == ["1340"]
    assert only["residual"]["after"] == pytest.approx(0.007)


def test_points_are_changed_by_hand_as_at_the_screen(amp, example: Path) -> None:
    first = ("--input", "deviation", "--start", "negative", "--insert", "-50=0", "--insert", "50=0.001")
    assert amp("calibrate", example, "--axis", "X", *first).code == 0
    assert amp("calibrate", example, "--axis", "X", "--insert", "0=0.0005", "--replace", "50=0.002").code == 0
    assert [(p["position"], p["figure"]) for p in table(amp, example)["points"]] == [
        (-50, 0),
        (0, 0.0005),
        (50, 0.002),
    ]
    assert amp("calibrate", example, "--axis", "X", "--delete", "0").code == 0
    assert "deviation - mm -50:0 50:0.002" in amp("get", example, "calibration.table@X").out
    assert amp("calibrate", example, "--axis", "X", "--clear").code == 0
    assert table(amp, example) is None


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        (["--insert", "50=0.001"], "has the deviation 0"),
        (
            ["--insert", "0=0", "--insert", "10=0.3", "--input", "deviation", "--start", "negative"],
            "PARAMETER OUT OF RANGE",
        ),
        (["--insert", "0"], "is not POSITION=FIGURE"),
        (["--insert", "0 mm=0"], "bare number"),
        (["--insert", "x=0"], "is not a number"),
        (["--delete", "7"], "the table is empty"),
        (["--insert", "0=0", "--from", "laser.csv"], "measured (--from) or changed by hand"),
        (["--from", "nothing.csv"], "nothing.csv"),
    ],
)
def test_what_cannot_be_done_is_refused_in_one_line(
    amp, example: Path, arguments: list[str], named: str
) -> None:
    message = amp("calibrate", example, "--axis", "X", *arguments)
    assert message.code == 2
    assert named in message.err
    assert example.read_bytes() == MILL.read_bytes()


def test_the_other_families_have_what_they_have(amp, tmp_path: Path, laser: Path) -> None:
    for family, axis, named in (
        ("acromill", "X", "backlash.amount@X"),
        ("grblhal", "X", "$160"),
        ("num", "0", "P18N0"),
    ):
        path = tmp_path / f"{family}.amp"
        assert amp("new", family, path).code == 0
        assert amp("calibrate", path, "--axis", axis, "--json").json["reversal"]["param"] == named
    path = tmp_path / "grbl.amp"
    assert amp("new", "grblhal", path, "--machine", "grbl-1.1").code == 0
    assert "grbl-1.1 has neither" in amp("calibrate", path, "--axis", "X").err
    path = tmp_path / "syntec.amp"
    assert amp("new", "syntec", path).code == 0
    assert "neither a calibration table nor a reversal error" in amp("calibrate", path, "--axis", "X").err


def test_an_inch_file_shows_and_takes_its_points_in_inches(amp, tmp_path: Path) -> None:
    path = tmp_path / "router.amp"
    assert amp("new", "acromill", path).code == 0
    limits = ("axes.soft_limit_minus@X=-1 in", "axes.soft_limit_plus@X=1 in", "control.default_units=Inch")
    assert amp("set", path, *limits).code == 0
    path.write_text(path.read_text().replace("units: metric", "units: inch"))
    points = tmp_path / "laser.csv"
    points.write_text("position [in],measured [in]\n-1,-1.001\n0,0\n1,1.002\n")
    found = amp(*from_points(path, points), "--json").json["table"]
    assert found["unit"] == "in"
    assert [(p["position"], p["figure"]) for p in found["points"]] == [(-1, 0.001), (0, 0), (1, -0.002)]
    assert amp("calibrate", path, "--axis", "X", "--replace", "1=-0.003").code == 0
    assert "X0E.00000 X1E-.00300 X2E.00100" in amp("get", path, "ballscrew.table@X").out


def test_a_circle_of_a_ball_bar_needs_to_know_which_axis(amp, example: Path, tmp_path: Path) -> None:
    points = tmp_path / "ballbar.csv"
    rows = [(n, (2.5 if 0 < n % 360 < 180 else -2.5) * math.cos(math.radians(n))) for n in range(-20, 200)]
    points.write_text("angle [deg],deviation [um]\n" + "".join(f"{n},{by:.4f}\n" for n, by in rows))
    assert "first or the second" in amp(*from_points(example, points), *MEASURED).err
    message = amp(*from_points(example, points), *MEASURED, "--circle", "first", "--dry-run", "--json")
    assert [change["param"] for change in message.json["changes"]] == ["1340"]
    assert "residual" not in message.json


def test_a_table_that_cannot_be_used_is_named_deleted_or_replaced(amp, example: Path, laser: Path) -> None:
    assert amp("set", example, "calibration.table@X=deviation - mm 0:0 100:9").code == 0
    assert "PARAMETER OUT OF RANGE" in amp("calibrate", example, "--axis", "X").err
    measured = (*from_points(example, laser), *MEASURED)
    assert "cannot be used" in amp(*measured, "--compensation", "on").err
    assert amp(*measured, "--compensation", "off", "--dry-run").code == 0
    assert amp("calibrate", example, "--axis", "X", "--clear").code == 0
    assert table(amp, example) is None


def test_a_point_measured_with_the_calibration_on_is_added_to_what_the_table_takes_away(
    amp, example: Path
) -> None:
    first = ("--input", "deviation", "--start", "negative", "--insert", "0=0", "--insert", "100=0.004")
    assert amp("calibrate", example, "--axis", "X", *first).code == 0
    assert amp("calibrate", example, "--axis", "X", "--compensation", "on", "--insert", "50=0.001").code == 0
    assert (
        amp("calibrate", example, "--axis", "X", "--compensation", "on", "--replace", "100=0.001").code == 0
    )
    assert [p["figure"] for p in table(amp, example)["points"]] == [0, 0.003, 0.005]


def test_the_errors_before_and_after_are_drawn(amp, example: Path, laser: Path, tmp_path: Path) -> None:
    picture = tmp_path / "errors.svg"
    base = (*from_points(example, laser), "--dry-run")
    assert amp(*base, "-o", picture).code == 0
    text = picture.read_text(encoding="utf-8")
    for words in ("Axis X", "measured, rising", "measured, falling", "expected, rising", "13 µm measured"):
        assert words in text, words
    assert "name the file errors.svg" in amp(*base, "-o", tmp_path / "errors.png").err
    assert amp(*base, "-o", laser).code == 2
    assert laser.read_text() == POINTS
    assert "--from" in amp("calibrate", example, "--axis", "X", "-o", picture).err


def test_a_turn_whose_net_correction_is_not_zero_is_taken_with_the_message_of_the_control(
    amp, example: Path
) -> None:
    assert amp("set", example, "axis.rollover@4=360").code == 0
    points = ("--insert", "0=0", "--insert", "180=0.004", "--insert", "360=0.001")
    message = amp("calibrate", example, "--axis", "4", "--input", "deviation", "--start", "negative", *points)
    assert message.code == 0
    assert "NET CORRECTION IS NOT ZERO: it is 0.00100 deg" in message.err
    assert "9pc.calibration.net" in amp("validate", example, "--json").out
    assert amp("calibrate", example, "--axis", "4", "--replace", "360=0", "--json").json["remarks"] == []
