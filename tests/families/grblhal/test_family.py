"""grblHAL and Grbl on the command line: by number, by label, by axis."""

import json
from pathlib import Path

import pytest

from amp_studio.cli import run
from amp_studio.files import new_file, open_file
from amp_studio.files.axes import AxisError
from amp_studio.files.axis_fitting import name_axes
from amp_studio.files.stored_text import storage_text
from amp_studio.schema import Value


@pytest.fixture
def mill(tmp_path: Path) -> Path:
    path = tmp_path / "mill.amp"
    assert run(["new", "grblhal", str(path), "--axes", "X,Y,Z"]) == 0
    return path


def value(path: Path, text: str) -> Value | None:
    file = open_file(path).file
    return file.get(file.find(text))


@pytest.mark.parametrize(
    ("assignment", "address", "expected"),
    [
        ("$130=250", "axis.max_travel@X", Value(250.0, "mm")),
        ("130=250", "$130", Value(250.0, "mm")),
        ("axis.max_rate@Y=10 ipm", "$111", Value(10.0, "in/min")),
        ("$22=Enable, Override locks", "$22", Value(65)),
        ("$22.0=yes", "$22", Value(1)),
        ("$22=0x05", "$22", Value(5)),
        ("$22=none", "$22", Value(0)),
        ("$23=X, Z", "$23", Value(5)),
        ("$32=Laser mode", "$32", Value("laser_mode")),
        ("$32=raw:2", "$32", Value("lathe_mode")),
        ("$39=no", "$39", Value(False)),
        ("$100=80 step/mm", "$100", Value(80.0, "steps/mm")),
        ("$100=2032 steps/in", "$100", Value(2032.0, "steps/in")),
        ("$0=5 microseconds", "$0", Value(5.0, "us")),
        ("$120=500 mm/sec^2", "$120", Value(500.0, "mm/s2")),
        ("$26=100 milliseconds", "$26", Value(100, "ms")),
    ],
)
def test_a_setting_is_given_as_its_users_write_it(
    mill: Path, assignment: str, address: str, expected: Value
) -> None:
    assert run(["set", str(mill), assignment]) == 0
    assert value(mill, address) == expected


@pytest.mark.parametrize(
    ("assignment", "message"),
    [
        ("$22=Enble", "Did you mean: Enable"),
        ("$22.11=yes", "has the bits 0 to 10, not 11"),
        ("$23=W", "is no bit of Homing direction invert"),
        ("$999=1", "Unknown parameter '$999'"),
        ("$110=-5", "is outside at least 0 mm/min"),
        ("$26=70000", "is outside 0 to 65535 ms"),
        ("$0=1", "at least 2 µs"),
        ("$43=129", "is outside 1 to 128"),
        ("$32=Plasma", "is not a choice of Mode of operation"),
    ],
)
def test_what_the_control_would_refuse_or_cut_is_refused(
    mill: Path, assignment: str, message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    before = mill.read_bytes()
    assert run(["set", str(mill), assignment]) == 2
    assert message in capsys.readouterr().err
    assert mill.read_bytes() == before


def test_a_figure_is_kept_as_it_was_typed_and_its_number_at_the_control_is_beside_it(
    mill: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["set", str(mill), "$11=0.0004"]) == 0
    capsys.readouterr()
    assert run(["get", str(mill), "$11", "--json"]) == 0
    (row,) = json.loads(capsys.readouterr().out)["values"]
    assert (row["value"], row["raw"]) == (0.0004, 0.0)


def test_a_build_has_the_first_axes_in_their_order() -> None:
    assert new_file("grblhal", None, ["x", "y", "z", "a"]).get(("build.axes", "")) == Value("XYZA")
    assert new_file("grblhal").get(("build.axes", "")) == Value("XYZ")
    for names in ("XZ", "XYA", "XYZB", "XYZABCUVW", "XY"):
        with pytest.raises(AxisError):
            new_file("grblhal", None, names)


def test_a_new_file_has_no_setting_that_the_build_has_not() -> None:
    three = new_file("grblhal", None, "XYZ")
    assert {address[1] for address in three.values} == {"", "X", "Y", "Z"}
    assert ("homing.phase_4", "") not in three.values
    assert ("homing.phase_4", "") in new_file("grblhal", None, "XYZA").values
    assert ("homing.phase_5", "") not in new_file("grblhal", None, "XYZA").values


def test_grbl_has_its_own_settings_under_the_same_numbers(tmp_path: Path) -> None:
    path = tmp_path / "old.amp"
    assert run(["new", "grblhal", str(path), "--machine", "grbl-1.1"]) == 0
    assert run(["set", str(path), "$22=yes", "$0=8", "$100=80"]) == 0
    assert value(path, "$22") == Value(True)
    assert open_file(path).file.get(("classic.homing", "")) == Value(True)
    assert run(["set", str(path), "$376=1"]) == 2
    assert run(["validate", str(path)]) == 0


def test_axes_of_the_list_can_be_named_again() -> None:
    file = new_file("grblhal", None, "XYZ")
    name_axes(file, "XYZAB")
    assert file.evaluation.state(("axis.steps", "B")).state == "in-force"
    assert file.evaluation.state(("axis.steps", "C")).state == "hidden"
    assert file.evaluation.state(("homing.phase_5", "")).state == "in-force"


def test_alarms_and_errors_are_tables(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["tables", "grblhal", "alarms"]) == 0
    assert "Homing: switch not found" in capsys.readouterr().out
    assert run(["tables", "grblhal", "errors"]) == 0
    assert "Soft limits" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("0.0004", "0.0004, shown as 0.000"),
        ("0.01", ""),
        ("0.5", ""),
        ("123.456789", "123.45679, shown as 123.457"),
        ("0.1 in", "2.54"),
        ("16777217", "16777216"),
        ("1e39", "inf"),
    ],
)
def test_what_the_control_keeps_and_shows_is_beside_the_value(text: str, expected: str) -> None:
    file = new_file("grblhal")
    address = file.find("$11")
    file.set(address, file.read(address, text))
    assert storage_text(file, address) == expected


def test_a_mask_is_shown_with_its_labels_beside_the_number(
    mill: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["set", str(mill), "$22=67", "$23=5"]) == 0
    capsys.readouterr()
    assert run(["get", str(mill), "$22", "$23", "$3"]) == 0
    first, second, third = capsys.readouterr().out.splitlines()
    assert first.endswith("67 (Enable, Enable single axis commands, Override locks) *")
    assert second.endswith("5 (X, Z) *")
    assert third.endswith("0 (none)")
    assert run(["get", str(mill), "$23", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["values"][0]["labels"] == "X, Z"
