"""The printed sheet: every format contains every entry, and no text of a file becomes markup,
a formula or a terminal's order.
"""

import csv
import io
from datetime import UTC, datetime
from pathlib import Path

import pytest
from rule_machines import sound

from amp_studio.report.papers.sheet import (
    SHEET_FORMATS,
    PrintedSheet,
    render_sheet_csv,
    render_sheet_html,
    render_sheet_text,
)
from amp_studio.sheet import make_sheet

from .test_pages import small_words
from .test_pdf import poppler

NASTY = "</td><script>alert(1)</script> #panic() \x1b[31m =1+1 \u202e"
WHEN = datetime(2026, 11, 22, 14, 0, tzinfo=UTC)


@pytest.fixture(scope="module")
def printed() -> PrintedSheet:
    """Return a sheet with limits that wait for each other, a tick and a value read back."""
    present = sound("9pc", "mill")
    wanted = present.copy()
    for number, text in (("1750", "9 mm"), ("1740", "8 mm"), ("1730", "6 mm"), ("399", "b"), ("2030", "a")):
        address = wanted.find(number)
        wanted.set(address, wanted.read(address, text))
    wanted.header.name = NASTY
    sheet = make_sheet(wanted, present, of=NASTY, against=NASTY)
    return PrintedSheet(sheet, {"399"}, (("1740", NASTY),), WHEN)


@pytest.mark.parametrize("ending", sorted(SHEET_FORMATS))
def test_every_format_takes_whatever_a_file_is_called(printed: PrintedSheet, ending: str) -> None:
    content = SHEET_FORMATS[ending](printed)
    assert len(content) > 500


def test_text_has_a_box_for_each_entry_and_no_line_that_steers_a_terminal(printed: PrintedSheet) -> None:
    text = render_sheet_text(printed).decode()
    assert [line[:3] for line in text.splitlines() if line.startswith("[")].count("[ ]") == 3
    assert "[x]" in text
    assert "\x1b" not in text
    assert "\u202e" not in text
    assert max(map(len, text.splitlines())) <= 100


def test_the_page_escapes_every_text(printed: PrintedSheet) -> None:
    page = render_sheet_html(printed).decode()
    assert "<script>" not in page
    assert page.count('class="tick"') == 4


def test_the_table_has_a_row_an_entry_and_no_formula(printed: PrintedSheet) -> None:
    head, *rows = csv.reader(io.StringIO(render_sheet_csv(printed).decode("utf-8-sig")))
    assert [row[head.index("number")] for row in rows] == [e.number for e in printed.sheet.entries]
    assert not any(cell.startswith(("=", "+", "@")) for row in rows for cell in row)


@poppler
def test_no_type_of_a_sheet_is_small(printed: PrintedSheet, tmp_path: Path) -> None:
    (tmp_path / "s.pdf").write_bytes(SHEET_FORMATS[".pdf"](printed))
    assert {word for word in small_words(tmp_path / "s.pdf") if word.isascii()} == set()


def test_equal_sheets_have_equal_bytes(printed: PrintedSheet) -> None:
    assert SHEET_FORMATS[".pdf"](printed) == SHEET_FORMATS[".pdf"](printed)
