"""The table for a spreadsheet: values read back equal those of the file."""

import csv
import io
import math
from datetime import datetime
from pathlib import Path

import pytest

from amp_studio.files import ParameterFile, new_file
from amp_studio.report import SORTS, Contents, print_report
from amp_studio.report.build import build_report
from amp_studio.report.contents import Sort
from amp_studio.report.output.table_csv import HEADS
from amp_studio.schema import Value, family_ids, read_value
from tests.campaigns import some


def table_of(path: Path) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(path.read_text("utf-8-sig"), newline="")))


def read_back(file: ParameterFile, line: dict[str, str]) -> Value | None:
    parameter = file.schema.parameters[line["id"]]
    return read_value(parameter, line["value"], line["unit"]) if line["value"] else None


@pytest.mark.parametrize(
    ("family", "sort"),
    some([(family, tuple(SORTS)[n % len(SORTS)]) for n, family in enumerate(family_ids())]),
)
def test_the_values_of_a_new_file_read_back(tmp_path: Path, family: str, sort: Sort) -> None:
    file = new_file(family)
    print_report(file, tmp_path / "r.csv", Contents(sort, inactive=True))
    lines = table_of(tmp_path / "r.csv")
    lines = [n for n in lines if not file.schema.parameters[n["id"]].secret]
    assert [file.get((n["id"], n["instance"])) for n in lines] == [read_back(file, n) for n in lines]


@pytest.mark.parametrize("number", some([0.1, 1 / 3, -1e-7, 123456789.125, 1e300, 5e-324, 2.0, math.pi], 2))
def test_a_number_reads_back_to_the_last_digit(tmp_path: Path, mill: ParameterFile, number: float) -> None:
    mill.set(("home.calibration", "3"), Value(number, "mm"))
    print_report(mill, tmp_path / "r.csv")
    found = [n for n in table_of(tmp_path / "r.csv") if (n["id"], n["instance"]) == ("home.calibration", "3")]
    assert [read_back(mill, n) for n in found] == [Value(number, "mm")]


def test_a_line_reports_all_about_a_value(tmp_path: Path, mill: ParameterFile) -> None:
    """1300 Home Calibration and its numbers for the other axes: page 5-10; 1730 Gain Break Point: page
    7-22.
    """
    print_report(mill, tmp_path / "r.csv")
    lines = {(n["id"], n["instance"]): tuple(n.values()) for n in table_of(tmp_path / "r.csv")}
    name, group = "Home Calibration", "Home Parameters"
    for number, instance, value, unit, changed in (
        ("1300", "1", "12.5", "mm", "yes"),
        ("2300", "2", "-0.1", "in", "yes"),
        ("4300", "4", "0", "deg", "no"),
    ):
        names = (number, "home.calibration", instance, name, group)
        line = (*names, value, unit, "0", changed, "in-force", "", "yes", "")
        assert lines["home.calibration", instance] == line
    tail = ("999999", "mm", "203.2", "yes", "in-force", "by J. Fitter on 2026-07-01", "yes", "")
    assert lines["servo.gain_break_point", "1"][5:] == tail
    not_set = lines["servo.inposition_band", "2"]
    assert not_set[5:9] == ("", "mm", "0.0254", "no"), "a value that is not set does not differ from anything"


def test_a_default_is_in_the_unit_of_its_value(tmp_path: Path, mill: ParameterFile) -> None:
    mill.set(("servo.gain_break_point", "2"), Value(8.0, "in"))  # 203.2 mm
    print_report(mill, tmp_path / "r.csv")
    line = next(n for n in table_of(tmp_path / "r.csv") if n["number"] == "2730")
    assert (line["value"], line["unit"], line["default"], line["changed"]) == ("8", "in", "8", "no")


def test_the_file_is_what_rfc_4180_and_excel_expect(tmp_path: Path, mill: ParameterFile) -> None:
    mill.forced[("servo.gain_break_point", "1")] = 'by "J, Fitter"\nat night'
    print_report(mill, tmp_path / "r.csv")
    content = (tmp_path / "r.csv").read_bytes()
    assert content.startswith(b"\xef\xbb\xbf" + ",".join(HEADS).encode() + b"\r\n")
    assert content.endswith(b"\r\n")
    assert b'"by ""J, Fitter""\nat night",yes,\r\n' in content
    assert all(len(line) == len(HEADS) for line in table_of(tmp_path / "r.csv"))


@pytest.mark.parametrize("sort", some(SORTS))
def test_every_order_has_the_same_lines(mill: ParameterFile, date: datetime, sort: Sort) -> None:
    by_group = build_report(mill, date=date)
    ordered = build_report(mill, Contents(sort), date=date)
    assert sorted(r.anchor for r in by_group.rows()) == sorted(r.anchor for r in ordered.rows())
