"""The pages of a PDF as a typographer sees them: sizes of type, rows that stay whole, titles that go on,
no row alone.
"""

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from amp_studio.files import ParameterFile, new_file, open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.files.notes import set_value_note
from amp_studio.files.storage import save_file
from amp_studio.report import Contents, PrintedFigure, print_report
from amp_studio.report.build import build_report
from amp_studio.report.contents import Chapter, Sort
from amp_studio.report.model import Listing, Report
from amp_studio.report.output.pdf import render_pdf
from amp_studio.report.papers.form import form_paper
from amp_studio.report.papers.paper import write_paper
from amp_studio.report.rows import rows_of
from amp_studio.report.sections import numbers_of

from .conftest import IN_EVERY_ORDER
from .test_pdf import output_of, poppler, texts_of

HEIGHT_OF_TYPE = 1.14
"""Height of a word's box in Libertinus Serif, in sizes of its type."""
BARE: frozenset[Chapter] = frozenset({"pictures", "motion", "exchanges", "signatures"})


def set_as(report: Report, folder: Path) -> Path:
    path = folder / "r.pdf"
    path.write_bytes(render_pdf(report))
    return path


def by_number(mill: ParameterFile) -> tuple[Report, Listing]:
    report = build_report(mill, Contents("number", inactive=True, without=BARE))
    (section,) = report.sections
    (part,) = section.parts
    assert isinstance(part, Listing)
    return report, part


def with_rows(report: Report, listing: Listing, count: int) -> Report:
    """Return the report of the first rows that need one line."""
    short = tuple(r for r in listing.rows if len(r.name) < 24 and len(r.text) < 12 and not r.small_print)
    own = replace(report.sections[0], parts=(replace(listing, rows=short[:count]),))
    return replace(report, sections=(own,), notes=(), not_set=())


def rows_on(text: str) -> int:
    return len(re.findall(r"^ *\d{1,5} {2,}\S", text, re.MULTILINE))


def small_words(path: Path) -> set[str]:
    """Return the words of a PDF that are smaller than 8.5 points."""
    boxes = output_of("pdftotext", "-bbox", path, "-")
    words = re.findall(r'yMin="([\d.]+)" xMax="[\d.]+" yMax="([\d.]+)">(.+?)</word>', boxes)
    assert len(words) > 50
    return {text for low, high, text in words if float(high) - float(low) < 8.49 * HEIGHT_OF_TYPE}


@poppler
@IN_EVERY_ORDER
def test_no_type_is_smaller_than_eight_and_a_half_points(
    printed: Callable[..., Path], which: str, sort: Sort
) -> None:
    assert small_words(printed(which, sort)) == set()


@poppler
def test_the_last_page_of_a_table_has_two_rows_or_more(tmp_path: Path, mill: ParameterFile) -> None:
    report, listing = by_number(mill)
    many = texts_of(set_as(with_rows(report, listing, 150), tmp_path), "-layout")
    full = next(rows_on(page) for page in many if "Parameters by number" in page and rows_on(page) > 20)
    pages = texts_of(set_as(with_rows(report, listing, full + 1), tmp_path), "-layout")
    last = next(page for page in pages if "Parameters by number (continued)" in page)
    assert rows_on(last) == 2


@poppler
def test_a_note_of_any_length_is_printed_whole_once_and_short_beside_its_value(
    tmp_path: Path, mill: ParameterFile
) -> None:
    note = " ".join(f"w{n}" for n in range(600))
    set_value_note(mill, ("home.calibration", "1"), note)
    path = tmp_path / "r.pdf"
    print_report(mill, path, Contents(changed_only=True, without=BARE))
    text = " ".join(output_of("pdftotext", "-raw", path, "-").split())
    assert text.count(" w599") == 1
    assert text.count(" w20 ") == 2
    assert "… (all of it under Notes)" in text


@poppler
def test_the_notes_of_a_drawing_stay_on_its_page(tmp_path: Path, mill: ParameterFile) -> None:
    svg = (
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 620 350"><text x="9" y="90">drawing'
        " {}</text></svg>"
    )
    figures = tuple(
        PrintedFigure(f"D{n}", svg.replace("{}", str(n)), (f"note a {n}", f"note b {n}", f"note c {n}"))
        for n in range(5)
    )
    report, listing = by_number(mill)
    pages = texts_of(set_as(replace(with_rows(report, listing, 5), pictures=figures), tmp_path))
    for n in range(5):
        (page,) = [page for page in pages if f"drawing {n}" in page]
        assert f"note c {n}" in page


@poppler
def test_each_changed_value_is_printed_once_in_its_row(tmp_path: Path, mill: ParameterFile) -> None:
    path = tmp_path / "r.pdf"
    print_report(mill, path, Contents("number", changed_only=True, without=BARE))
    text = "".join(page for page in texts_of(path, "-layout") if "Parameters by number" in page)
    changed = [
        r
        for r in build_report(mill, Contents("number", changed_only=True)).rows()
        if r.is_changed and r.number
    ]
    assert len(changed) > 10
    for row in changed:
        (line,) = re.findall(rf"^ *{row.number} +[A-Za-z#%1-9].*", text, re.MULTILINE)
        assert row.name.split()[0] in line
        assert row.figure.split()[0] in line
        assert "*" in line


@poppler
def test_what_one_copies_has_no_invisible_characters(tmp_path: Path, mill: ParameterFile) -> None:
    mill.header.name = "A_machine_with_a_name_of_one_long_word_that_breaks"
    source = tmp_path / "a_file_with_a_name_of_one_long_word_that_breaks.amp"
    save_file(mill, source)
    report = build_report(mill, Contents(changed_only=True, without=BARE), source=source)
    text = output_of("pdftotext", "-raw", set_as(report, tmp_path), "-")
    assert "\u200b" not in text
    (checksum,) = [body for name, body in report.facts if name.startswith("SHA-256")]
    assert len(checksum) == 64
    assert checksum in text
    assert mill.header.name in text.replace("\n", "")
    assert source.name in text.replace("\n", "")


@poppler
def test_pages_for_america_are_letter(tmp_path: Path, mill: ParameterFile) -> None:
    print_report(mill, tmp_path / "r.pdf", Contents(paper="letter", changed_only=True, without=BARE))
    assert re.search(r"Page size:\s+612 x 792", output_of("pdfinfo", tmp_path / "r.pdf"))
    with pytest.raises(ValueError, match=r"Unknown paper 'a5'\. Known: a4, letter"):
        Contents(paper="a5")


def test_numbers_with_dots_between_them_go_on_in_equal_steps(mill: ParameterFile) -> None:
    rows = [r for r in rows_of(mill).rows if r.id == "home.calibration"]

    def of(*numbers: str) -> str:
        return numbers_of([replace(rows[0], number=number) for number in numbers])

    assert of("1300", "2300", "3300", "4300", "5300") == "1300, 2300 … 5300"
    assert of("1300", "2300", "3300", "8300") == "1300, 2300, 3300, 8300"
    assert of("P9N0", "P9N1", "P9N2", "P9N3", "P9N24", "P9N28") == "P9N0, P9N1 … P9N3, P9N24, P9N28"
    assert of("20020", "21020") == "20020, 21020"
    assert of("R3", "R2051") == "R3, R2051"
    assert of("Pr21", "Pr22", "Pr23", "Pr24") == "Pr21, Pr22 … Pr24"
    assert of("") == ""


@poppler
def test_a_number_that_is_a_name_has_a_column_in_which_it_ends(tmp_path: Path) -> None:
    mill = open_file(examples_folder() / "linuxcnc-mill" / "MILL.amp").file
    print_report(mill, tmp_path / "r.pdf", Contents(without=BARE))
    text = output_of("pdftotext", "-layout", tmp_path / "r.pdf", "-")
    assert re.search(r"\[KINS\]JOINTS {2,}Joints", text)
    assert re.search(r"\[HAL\]HALUI {2,}Pins", text), "alone in its table, and over the next column"
    assert re.search(r"\[JOINT_0\]MAX_VELOCITY {2,}Greatest Speed", text)


@poppler
def test_a_unit_is_not_parted_at_its_stroke(tmp_path: Path) -> None:
    """The narrow fields of a form had ``1/`` at the end of a line and ``min`` on the next."""
    write_paper(form_paper(new_file("num"), language="de"), tmp_path / "f.pdf")
    text = output_of("pdftotext", "-layout", tmp_path / "f.pdf", "-")
    assert "1/min" in text
    assert re.findall(r"(?:1|mm|°|U|µm)/(?:\s|$)", text) == []
