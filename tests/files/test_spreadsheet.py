"""Texts in a CSV file stay texts in a spreadsheet, and come back as they were."""

import csv
import io
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from amp_studio.files import new_file
from amp_studio.files.spreadsheet import cell_text, text_cell
from amp_studio.formats import export_file, import_file
from amp_studio.report import print_report
from amp_studio.schema import Value

FORMULA = '=HYPERLINK("http://x","y")'


@pytest.mark.parametrize(
    "text",
    [FORMULA, "+1+1", "-1+cmd|' /C calc'!A0", "@SUM(A1)", "\t=1", "\r=1", " =1", "'=1", "＝1", "-", "+"],
)
def test_what_would_be_a_formula_gets_an_apostrophe(text: str) -> None:
    assert text_cell(text) == f"'{text}"
    assert cell_text(f"'{text}") == text


@pytest.mark.parametrize("text", ["-5", "+0.5", "-1e-05", "0,5", "X", "", "1=2", "'X", "don't"])
def test_numbers_and_other_texts_stay(text: str) -> None:
    assert text_cell(text) == text
    assert cell_text(text) == text


@given(st.text(alphabet="'=+-@\t\r\n 1.,eXé", max_size=8))
def test_every_text_comes_back(text: str) -> None:
    assert cell_text(text_cell(text)) == text


def test_a_text_value_is_no_formula_in_any_table_and_comes_back(tmp_path: Path) -> None:
    file = new_file("acromill")
    texts = [p for p in file.schema.parameters.values() if p.type == "text"]
    address = next(a for a in file.addresses() if a[0] == texts[0].id)
    file.set(address, Value(FORMULA))
    print_report(file, tmp_path / "report.csv")
    export_file(file, tmp_path / "values.csv")
    for name in ("report.csv", "values.csv"):
        rows = list(csv.reader(io.StringIO((tmp_path / name).read_text(encoding="utf-8-sig"), newline="")))
        found = [cell for row in rows for cell in row if FORMULA in cell]
        assert found == [f"'{FORMULA}"], name
        assert import_file(tmp_path / name, "acromill").get(address) == Value(FORMULA), name
