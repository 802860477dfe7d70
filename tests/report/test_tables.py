"""A family with tables of hundreds of entries, of which an operator fills a few."""

import io

from openpyxl import load_workbook

from amp_studio.files import open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.report.build import build_report
from amp_studio.report.output.workbook import WorkbookSheet, workbook


def test_of_a_table_only_what_is_set_is_printed() -> None:
    (path,) = (examples_folder() / "acromill-router").glob("*.amp")
    file = open_file(path).file
    values = int(dict(build_report(file).counts)["Values"])
    assert len(file.values) <= values < 400, "not the thousands of entries that are empty"
    file.set(("offset.r_geometric", "7"), None)
    assert int(dict(build_report(file).counts)["Values"]) == values - 1


def test_numbers_of_a_workbook_are_aligned_at_the_decimal_sign_and_long_texts_have_room() -> None:
    long = " ".join(["A text that is longer than one line of its column has"] * 3)
    rows = [(long, 12), ("", -2.54), ("", 1e-9)]
    page = load_workbook(io.BytesIO(workbook([WorkbookSheet("Values", ("text", "number"), rows)]))).active
    assert [page.cell(n, 2).number_format for n in (2, 3, 4)] == ["0_._0_0", "0.00", "General"]
    assert [page.cell(n, 2).value for n in (2, 3, 4)] == [12, -2.54, 1e-9]
    assert page.row_dimensions[2].height == 26.0
    assert page.cell(2, 1).alignment.wrap_text
    assert page.column_dimensions["A"].width == 132, "what the other column leaves of the page"
