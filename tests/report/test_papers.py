"""Papers that are tables: differences, machines side by side, forms,
and the workbook a real spreadsheet opens.
"""

import csv
import io
import json
import math
import re
import shutil
import subprocess
import zipfile
from datetime import UTC, datetime
from pathlib import Path

import pytest

from amp_studio.files import ParameterFile, compare, new_file
from amp_studio.files.notes import set_group_note, set_machine_note
from amp_studio.report import Contents, print_report
from amp_studio.report.output.workbook import WorkbookSheet, workbook
from amp_studio.report.papers.differences import differences_paper, machine_rows, machines_paper
from amp_studio.report.papers.form import form_paper
from amp_studio.report.papers.paper import PAPER_FORMATS, Paper, PaperTable, check_paper_ending, write_paper
from amp_studio.schema import MASKED, Value
from tests.campaigns import CAMPAIGN, some

DATE = datetime(2026, 7, 1, 14, 5, tzinfo=UTC)
NASTY = '=HYPERLINK("http://x","y")'
SOFFICE = shutil.which("soffice")


def opened_by_a_spreadsheet(path: Path, sheet: int = 1) -> list[list[str]]:
    """Return what LibreOffice shows of a sheet, every number in full."""
    assert SOFFICE
    out = path.parent / "out"
    options = f"csv:Text - txt - csv (StarCalc):44,34,76,1,,0,false,false,false,false,false,{sheet}"
    profile = f"-env:UserInstallation={(path.parent / 'profile').as_uri()}"
    subprocess.run(
        [SOFFICE, profile, "--headless", "--convert-to", options, "--outdir", out, path],
        check=True,
        capture_output=True,
        timeout=120,
    )
    return list(csv.reader(io.StringIO(next(out.glob("*.csv")).read_text("utf-8"))))


@pytest.fixture
def other(mill: ParameterFile) -> ParameterFile:
    changed = mill.copy()
    changed.set(("home.calibration", "1"), Value(13.0, "mm"))
    changed.set(("home.calibration", "3"), Value(1.0, "in"))
    return changed


def test_differences_are_in_their_group_and_in_one_unit(mill: ParameterFile, other: ParameterFile) -> None:
    paper = differences_paper(
        mill, compare(mill.schema, mill.values, other.values), ("mill.amp", "other.amp"), date=DATE
    )
    assert [(t.title, t.rows) for t in paper.tables] == [
        (
            "Home Parameters",
            (
                ("1300", "Home Calibration", "X", "12.5 mm", "13 mm"),
                ("3300", "Home Calibration", "Z", "0 mm", "25.4 mm"),
            ),
        )
    ]
    assert dict(paper.facts)["Differ"] == "2"


def test_of_several_machines_the_one_that_departs_is_out(mill: ParameterFile, other: ParameterFile) -> None:
    paper = machines_paper([mill, other, mill], ["A", "B", "C"], date=DATE)
    (table,) = paper.tables
    assert table.heads == ("Number", "Parameter", "Belongs to", "A", "B", "C")
    assert table.rows[0] == ("1300", "Home Calibration", "X", "12.5 mm", "13 mm", "12.5 mm")
    assert table.strong == {(0, 4), (1, 4)}
    rows, same = machine_rows([mill, other, mill], everything=True)
    assert len(rows) == same + 2
    assert machines_paper([mill, mill], ["A", "B"]).tables == ()


def test_many_machines_are_grouped_by_those_that_agree(
    mill: ParameterFile, other: ParameterFile, tmp_path: Path
) -> None:
    third = other.copy()
    third.set(("home.calibration", "3"), mill.get(("home.calibration", "3")))
    files = [mill, other, third, *[mill.copy() for _ in range(30)]]
    paper = machines_paper(files, [f"M{n}" for n in range(33)], date=DATE)
    groups, values = paper.tables
    assert [row[:2] for row in groups.rows] == [("1", "31"), ("2", "1"), ("3", "1")]
    assert [row[2] for row in groups.rows[1:]] == ["M1", "M2"]
    assert groups.rows[0][2].startswith("M0, M3, M4, ")
    assert values.rows == (
        ("1300", "Home Calibration", "X", "12.5 mm", "1"),
        ("1300", "Home Calibration", "X", "13 mm", "2, 3"),
        ("3300", "Home Calibration", "Z", "0 mm", "1, 3"),
        ("3300", "Home Calibration", "Z", "25.4 mm", "2"),
    )
    assert values.strong == {(1, 3), (3, 3)}, "what most machines have is plain"
    write_paper(paper, tmp_path / "m.csv")
    lines = (tmp_path / "m.csv").read_text("utf-8-sig").splitlines()
    assert [line for line in lines if line.startswith("table,")] == [
        "table,Group,Machines,Names",
        "table,Number,Parameter,Belongs to,Value,Groups",
    ]
    assert machines_paper([mill] * 20, ["M"] * 20).tables == ()


def test_machines_with_other_secrets_are_in_other_groups(mill: ParameterFile) -> None:
    files = [mill.copy() for _ in range(8)]
    for n, file in enumerate(files):
        file.set(("password.character", "1"), Value(66 if n == 5 else 65))
    groups, values = machines_paper(files, [f"M{n}" for n in range(8)]).tables
    assert [row[2] for row in groups.rows] == ["M0, M1, M2, M3, M4, M6, M7", "M5"]
    assert [row[3:] for row in values.rows] == [(MASKED, "1"), (MASKED, "2")]


def test_the_first_sheet_of_a_workbook_is_the_table(
    tmp_path: Path, mill: ParameterFile, other: ParameterFile
) -> None:
    from openpyxl import load_workbook

    write_paper(machines_paper([mill, other], ["A", "B"], date=DATE), tmp_path / "m.xlsx")
    book = load_workbook(tmp_path / "m.xlsx", read_only=True)
    assert book.sheetnames == ["Machines compared", "This document"]
    assert next(book.worksheets[0].iter_rows(values_only=True))[0] == "Number"


def test_machines_of_different_families_are_not_compared(mill: ParameterFile) -> None:
    with pytest.raises(ValueError, match="different control families"):
        machine_rows([mill, new_file("num")])
    with pytest.raises(ValueError, match="two files"):
        machine_rows([mill])


@pytest.mark.parametrize("ending", PAPER_FORMATS)
def test_every_format_has_every_cell_and_takes_any_text(tmp_path: Path, ending: str) -> None:
    paper = Paper(
        "Differences",
        'Mill "7" #strong[x]',
        (("A", "<b>"),),
        (PaperTable("T", ("Number", "Value"), (("1300", NASTY),)),),
        DATE,
    )
    path = tmp_path / f"p{ending}"
    write_paper(paper, path)
    content = path.read_bytes()
    if ending == ".html":
        assert b"&lt;b&gt;" in content
        assert NASTY.replace('"', "&#34;").encode() in content
    elif ending == ".csv":
        assert b"\"'=HYPERLINK" in content, "no formula"
    elif ending == ".xlsx":
        assert b"<f>" not in zipfile.ZipFile(path).read("xl/worksheets/sheet1.xml"), "no formula"
    elif shutil.which("pdftotext"):
        text = subprocess.run(
            ["pdftotext", "-layout", path, "-"], capture_output=True, check=True, text=True
        ).stdout
        assert "1300" in text
        assert "HYPERLINK" in text.replace("\u200b", "")


def test_a_table_too_wide_for_paper_is_refused_there_alone(tmp_path: Path) -> None:
    heads = tuple(map(str, range(20)))
    paper = Paper("Machines compared", "all", (), (PaperTable("", heads, (heads,)),), DATE)
    with pytest.raises(ValueError, match="too many for paper"):
        write_paper(paper, tmp_path / "p.pdf")
    assert not list(tmp_path.iterdir())
    write_paper(paper, tmp_path / "p.html")
    with pytest.raises(ValueError, match="is written as"):
        check_paper_ending(tmp_path / "p.doc")


@pytest.mark.parametrize("family", some(["9pc", "num", "57c422b", "acromill", "syntec", "grblhal"]))
def test_a_form_has_a_blank_for_each_number(family: str) -> None:
    file = new_file(family)
    paper = form_paper(file, everything=True, date=DATE)
    cells = [cell for table in paper.tables for row in table.rows for cell in (row[0], *row[2:])]
    numbers = {cell.partition(" ____")[0] for cell in cells}
    undisputed = {
        n
        for a in file.addresses()
        if not file.machine_schema.is_disputed(a[0]) and (n := file.machine_schema.number(a))
    }
    assert undisputed <= numbers
    assert sum("____" in cell for cell in cells) >= len(file.addresses())


@pytest.mark.skipif(not (CAMPAIGN and SOFFICE), reason="make campaign, with LibreOffice")
def test_a_spreadsheet_opens_the_workbook_with_every_number_to_its_last_digit(tmp_path: Path) -> None:
    numbers = [0.1, 1 / 3, 123456789.125, 1e300, 5e-324, math.pi, -2.0]
    path = tmp_path / "w.xlsx"
    path.write_bytes(
        workbook(
            [
                WorkbookSheet(
                    "Val:ues", ("text", "number"), [(NASTY, n) for n in numbers] + [("007", float("inf"))]
                )
            ]
        )
    )
    displayed = opened_by_a_spreadsheet(path)
    assert displayed[0] == ["text", "number"]
    assert [row[0] for row in displayed[1:]] == [NASTY] * len(numbers) + ["007"]
    cells = zipfile.ZipFile(path).read("xl/worksheets/sheet1.xml").decode()
    assert set(numbers) <= {float(text) for text in re.findall(r"<v>([^<]*)</v>", cells)}
    assert [float(row[1]) for row in displayed[1:-1]] == pytest.approx(numbers, rel=1e-14)


def test_the_report_as_json_and_as_workbook_has_every_value(tmp_path: Path, mill: ParameterFile) -> None:
    set_machine_note(mill, "Rebuilt in 2019.\nNew drives.")
    set_group_note(mill, "home", NASTY)
    for ending in (".json", ".xlsx"):
        print_report(mill, tmp_path / f"r{ending}", Contents(inactive=True), date=DATE)
    document = json.loads((tmp_path / "r.json").read_text("utf-8"))
    values = {(v["id"], v["instance"]): v for v in document["values"]}
    assert (values["home.calibration", "1"]["value"], values["home.calibration", "1"]["unit"]) == (12.5, "mm")
    assert document["title"] == "Mill 7"
    assert any(f["severity"] == "error" for f in document["findings"])
    from openpyxl import load_workbook

    book = load_workbook(tmp_path / "r.xlsx", read_only=True)
    assert book.sheetnames[0] == "Values"
    rows = list(book["Values"].iter_rows(values_only=True))
    assert len(rows) == len(document["values"]) + 1
    assert (12.5, "mm") in {(row[6], row[7]) for row in rows}
    notes = list(book["Notes"].iter_rows(values_only=True))
    assert notes == [
        ("About", "Note"),
        ("Machine", "Rebuilt in 2019.\nNew drives."),
        ("Home Parameters", NASTY),
    ]
    assert [row[1] for row in book["Axes"].iter_rows(values_only=True)] == ["Name", "X", "Y", "Z", "B", "S"]
    assert [axis["letter"] for axis in document["axes"]] == ["X", "Y", "Z", "B", "S"]
    assert document["notes"] == {
        "machine": "Rebuilt in 2019.\nNew drives.",
        "others": [{"about": "Home Parameters", "text": NASTY}],
    }


def test_a_workbook_is_ready_to_print(tmp_path: Path, mill: ParameterFile) -> None:
    from openpyxl import load_workbook

    print_report(mill, tmp_path / "r.xlsx", Contents(paper="letter"), date=DATE)
    book = load_workbook(tmp_path / "r.xlsx")
    assert book.properties.title == "Mill 7 – Machine parameters by group, Allen-Bradley 9/PC AMP"
    assert book.properties.creator.startswith("AMP Studio ")
    values = book["Values"]
    assert (values.page_setup.orientation, values.page_setup.paperSize) == ("landscape", 1)
    assert (values.page_setup.fitToWidth, values.page_setup.fitToHeight) == (1, 0)
    assert values.sheet_properties.pageSetUpPr.fitToPage
    assert values.print_title_rows == "$1:$1"
    assert {"X", "Y", "Z", "B", "S"} <= {row[3] for row in values.iter_rows(values_only=True)}
