"""Text formats: what is written reads back, and what cannot be meant is reported with line and column."""

import csv
from pathlib import Path

import pytest

from amp_studio.cli import run
from amp_studio.files import ParameterFile, compare, new_file, open_file
from amp_studio.files.example_files import Example, examples, examples_folder
from amp_studio.formats import FormatError, export_file, import_file
from amp_studio.schema import Value
from amp_studio.validate import Validator

MILL = examples_folder() / "mill-1394" / "MILL_1394.amp"
CALIBRATION = ("home.calibration", "1")


@pytest.fixture
def mill() -> ParameterFile:
    """Return a mill with its printed defaults."""
    return new_file("9pc", "mill", ["X", "Y", "Z", "S"], "TRY")


@pytest.mark.parametrize("example", examples(), ids=lambda example: example.path.stem)
def test_a_table_of_values_reads_back_as_it_was(tmp_path: Path, example: Example) -> None:
    """Also in a family whose listings are read out of any text: that of Grbl took the table for one."""
    file = open_file(example.path).file
    export_file(file, tmp_path / "mill.csv", secrets=True)
    back = import_file(tmp_path / "mill.csv", example.family)
    found = compare(file.schema, file.values, back.values)
    assert (list(found.differences), found.same) == ([], len(file.values))


@pytest.mark.parametrize(("sign", "encoding"), [(";", "cp1252"), (";", "utf-8-sig"), ("\t", "utf-16")])
def test_a_table_that_a_german_spreadsheet_has_saved_is_read(
    tmp_path: Path, sign: str, encoding: str
) -> None:
    path = tmp_path / "values.csv"
    router = open_file(examples_folder() / "grblhal-router" / "GRBL_ROUTER.amp").file
    export_file(router, path)
    rows = csv.reader(path.read_text("utf-8-sig").splitlines())
    lines = [sign.join(cell.replace(".", ",") if n == 4 else cell for n, cell in enumerate(r)) for r in rows]
    # Excel takes a first line that names the sign between the cells, and shows it to nobody.
    for first in ([], [f"sep={sign}"]):
        path.write_bytes("\r\n".join([*first, *lines, " " * 3, ""]).encode(encoding))
        for family in ("grblhal", None):
            assert import_file(path, family).values == router.values


def test_the_csv_of_a_report_can_be_read_too(tmp_path: Path) -> None:
    assert run(["report", str(MILL), "-o", str(tmp_path / "report.csv")]) == 0
    back, file = import_file(tmp_path / "report.csv", "9pc"), open_file(MILL).file
    found = compare(file.schema, file.values, back.values)
    assert {d.b for d in found.differences} == {None}, (
        "it leaves out what unfitted axes hold, and changes nothing"
    )
    assert found.same == len(back.values) > 600


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("id,value\n", "line 1: there is no column 'unit'"),
        ("id,instance,value,unit\nhome.nonsense,1,3,mm\n", "line 2, column 1: .* has no home.nonsense@1"),
        (
            "id,instance,value,unit\nhome.calibration,9,3,mm\n",
            "line 2, column 1: .* has no home.calibration@9",
        ),
        ("id,instance,value,unit\nhome.calibration,1,3 bar,mm\n", "line 2, column 3: home.calibration@1: "),
        ("id,instance,value,unit\nhome.calibration,1,1,mm\nhome.calibration,1,2,mm\n", "line 3, .* twice"),
        ("sep=;\nid;instance;value;unit\nhome.calibration;9;3;mm\n", "line 3, column 1: "),
        ("id,instance,value,unit\nhome.calibration,1,1\n", "line 2: 3 cells below 4 columns"),
        ('id,instance,value,unit\nhome.calibration,1,"1,mm\n', "line 2: this is no line of a table"),
    ],
)
def test_a_table_that_cannot_be_understood_is_reported_with_its_place(
    tmp_path: Path, text: str, message: str
) -> None:
    path = tmp_path / "bad.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(FormatError, match=message):
        import_file(path, "9pc")


def test_what_is_not_understood_is_kept_where_that_is_wanted(tmp_path: Path) -> None:
    (tmp_path / "odd.csv").write_text(
        "id,instance,value,unit\nhome.nonsense,1,3,mm\nhome.calibration,1,1,mm\n", "utf-8"
    )
    file = import_file(tmp_path / "odd.csv", "9pc", keep_unknown=True)
    assert (file.unknown, file.values) == ({"home.nonsense@1": "3 mm"}, {CALIBRATION: Value(1.0, "mm")})


def test_the_sheet_contains_what_the_control_stores(mill: ParameterFile, tmp_path: Path) -> None:
    """10 in/min are 4.23333 mm/s in the control (page 37-3)."""
    mill.set(("home.speed_off_switch", "1"), Value(10.0, "in/min"))
    export_file(mill, tmp_path / "mill.patch")
    lines = (tmp_path / "mill.patch").read_text("utf-8").splitlines()
    assert [line for line in lines if line.startswith("1350\t")] == [
        "1350\t4.2333\tmm/s\tHome Speed from Limit Switch Axis 1"
    ]
    assert [line.split("\t")[1] for line in lines if line.startswith("1002\t")] == ["-1"]
    back = import_file(tmp_path / "mill.patch")
    assert back.get(("home.speed_off_switch", "1")) == Value(4.2333, "mm/s")
    assert (back.machine, back.get(("home.direction_off_switch", "1"))) == ("mill", Value("negative"))


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("99999\t1", "line 3, column 1: Unknown parameter '99999'"),
        ("1300", "line 3: a line is number, value, unit and name"),
        ("1300\tfast\tmm", "line 3, column 6: "),
        ("1300\t1\tms", "line 3, column 8: Home Calibration is stored in mm, not in ms"),
        ("360\t1", "line 3, column 1: 360 cannot be keyed in at the control"),
    ],
)
def test_a_sheet_that_cannot_be_understood_is_reported_with_its_place(
    tmp_path: Path, line: str, message: str
) -> None:
    path = tmp_path / "bad.patch"
    path.write_text(f"# Patch sheet of X\n# machine mill\n{line}\n", "utf-8")
    with pytest.raises(FormatError, match=message):
        import_file(path)


def test_a_code_that_is_none_is_kept_and_found_by_the_check(tmp_path: Path) -> None:
    (tmp_path / "odd.patch").write_text("# Patch sheet of X\n# machine mill\n402\t7\n", "utf-8")
    file = import_file(tmp_path / "odd.patch")
    assert file.get(("accdec.positioning_mode", "")) == Value("raw:7")
    assert [f.rule for f in Validator(file).run() if f.severity == "error"] == ["schema.choice"]


def test_the_verbs_write_read_and_refuse(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    sheet, back = tmp_path / "mill.csv", tmp_path / "back.amp"
    assert run(["export", str(MILL), "-o", str(sheet), "--secrets"]) == 0
    assert run(["import", str(sheet), "-o", str(back), "--family", "9pc"]) == 0
    assert run(["diff", str(MILL), str(back)]) == 0
    capsys.readouterr()
    assert run(["import", str(sheet), "-o", str(back), "--family", "9pc"]) == 2
    assert "exists already" in capsys.readouterr().err
    assert run(["export", str(MILL), "-o", str(tmp_path / "mill.doc")]) == 2
    assert ".patch (patch)" in capsys.readouterr().err
    assert run(["import", str(sheet), "-o", str(tmp_path / "x.amp")]) == 0, "its ids show the family"
    sheet.write_text("id,instance,value,unit\nhome.calibration,1,1,mm\nhome.direction,1,pos,\n", "utf-8")
    assert run(["import", str(sheet), "-o", str(tmp_path / "y.amp")]) == 2
    assert "does not show which family" in capsys.readouterr().err


def test_an_import_with_a_value_out_of_range_writes_nothing_unless_reported(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "far.csv").write_text("id,instance,value,unit\nhome.calibration,1,9999999,mm\n", "utf-8")
    arguments = ["import", str(tmp_path / "far.csv"), "-o", str(tmp_path / "far.amp"), "--family", "9pc"]
    assert run(arguments) == 2
    assert "an import contains an illegal value, nothing was written" in capsys.readouterr().err
    assert not (tmp_path / "far.amp").exists()
    assert run([*arguments, "--on-fault", "keep"]) == 0
    assert open_file(tmp_path / "far.amp").file.forced[CALIBRATION].endswith("by an import")
