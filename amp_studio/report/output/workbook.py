"""Tables as a workbook (XLSX), written with openpyxl: it writes every number to its last digit,
and a text stays a text.
"""

from __future__ import annotations

import io
import math
import re
import textwrap
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from amp_studio.report.contents import PaperSize

WorkbookCell = str | float | int | None

_FORBIDDEN = re.compile(r"[\[\]:*?/\\]")
# Bounds of Excel, which calls a file damaged that exceeds one.
_MAX_NAME = 31
_WIDEST, _ACROSS = 30, 140
"""Characters of a column, and of a page, which is as wide as all columns; long texts have several lines,
and what the others leave of the page.
"""
_ROOM = 2
"""Characters of a column that stay blank."""
_LINE, _MAX_LINES = 13.0, 30
"""Height of a line in points; no row is higher than a page."""
_MAX_DECIMALS = 6
"""Digits behind the decimal separator up to which a column is aligned at it."""
_TIME = re.compile(rb"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ")
_MAX_TEXT = 32_767
_MAX_FOOTER = 100
"""Characters of the title at the foot of a page; all of a foot are 255 at most."""
_PAPERS: dict[PaperSize, int] = {"a4": 9, "letter": 1}
"""Paper -> its number in a workbook."""
_MARGIN = 0.35
"""Inches."""


@dataclass(frozen=True)
class WorkbookSheet:
    """One sheet: heads, and rows of texts and numbers."""

    title: str
    heads: tuple[str, ...]
    rows: Sequence[Sequence[WorkbookCell]]


def workbook(
    sheets: Iterable[WorkbookSheet], title: str = "", creator: str = "", paper: PaperSize = "a4"
) -> bytes:
    """Return the file; heads stay in view and can be filtered by.

    It is ready to print: across the page and as wide as it, with the heads on each page, and title, sheet and
    page number at the foot.
    """
    from openpyxl import Workbook

    book = Workbook()
    book.remove(book.active)
    book.properties.title, book.properties.creator = _text(title) or None, _text(creator) or None
    names: set[str] = set()
    for sheet in sheets:
        page = book.create_sheet(_name(sheet.title, names))
        widths = _widths(sheet)
        _fill(page, sheet, widths)
        for column, width in enumerate(widths, 1):
            page.column_dimensions[page.cell(1, column).column_letter].width = width
        if any(sheet.heads):
            page.freeze_panes = "A2"
            page.auto_filter.ref = page.dimensions
        _set_up_print(page, title, paper, has_heads=any(sheet.heads))
    stream = io.BytesIO()
    book.save(stream)
    return _without_times(stream)


def _fill(page: Any, sheet: WorkbookSheet, widths: Sequence[int]) -> None:
    """Write heads and rows."""
    from openpyxl.styles import Alignment, Font

    rows = [sheet.heads, *sheet.rows] if any(sheet.heads) else sheet.rows
    decimals = [max(map(_decimals, column), default=0) for column in zip(*sheet.rows, strict=True)]
    for at, row in enumerate(rows, 1):
        for column, content in enumerate(row, 1):
            if content in (None, ""):
                continue
            cell = page.cell(at, column)
            _put(cell, content, decimals[column - 1] if decimals else 0)
            if row is sheet.heads:
                cell.font = Font(bold=True)
            else:
                is_long = _lines(content, widths[column - 1]) > 1
                cell.alignment = Alignment(wrap_text=is_long, vertical="top")
        if (lines := max(map(_lines, row, widths), default=1)) > 1:
            page.row_dimensions[at].height = _LINE * lines


def _put(cell: Any, content: str | float, places: int) -> None:
    """Write a number with its decimals below those of its column, or a text."""
    if isinstance(content, str) or not math.isfinite(content):
        cell.value = _text(str(content))
        cell.data_type = "s"  # also of a text that begins with "=": it is no formula
        return
    cell.value = content
    if places > 0 and (own := _decimals(content)) >= 0:
        # The cell keeps its number; only how it is shown has the room of the missing digits.
        cell.number_format = _aligned(own, places)


def _lines(content: WorkbookCell, width: int) -> int:
    """Return the lines of a cell: a spreadsheet keeps the height that a row is given."""
    if not isinstance(content, str) or len(content) <= width - _ROOM:
        return 1
    return min(len(textwrap.wrap(content, width - _ROOM)), _MAX_LINES)


def _decimals(content: WorkbookCell) -> int:
    """Return the digits behind the decimal separator of a number; -1 for no number, or too many."""
    if content is None or isinstance(content, str) or not math.isfinite(content):
        return -1
    fraction = repr(float(content)).partition(".")[2]
    digits = 0 if fraction == "0" else len(fraction)
    return digits if fraction.isdigit() and digits <= _MAX_DECIMALS else -1


def _aligned(own: int, most: int) -> str:
    """Return the format of a number with all its digits, and as much room behind as the longest needs."""
    return f"0.{'0' * own}{'_0' * (most - own)}" if own else f"0_.{'_0' * most}"


def _set_up_print(page: Any, title: str, paper: PaperSize, *, has_heads: bool) -> None:
    """Set up a sheet of openpyxl for paper."""
    setup = page.page_setup
    setup.orientation, setup.paperSize = "landscape", _PAPERS[paper]
    setup.fitToWidth, setup.fitToHeight = 1, 0
    page.sheet_properties.pageSetUpPr.fitToPage = True
    page.page_margins.left = page.page_margins.right = _MARGIN
    page.page_margins.top = page.page_margins.bottom = 2 * _MARGIN
    if has_heads:
        page.print_title_rows = "1:1"
    # & begins a code in a foot.
    page.oddFooter.left.text = _text(title).replace("&", "&&")[:_MAX_FOOTER]
    page.oddFooter.right.text = "&A   &P / &N"  # in the middle it would lie under a long title


def _without_times(content: io.BytesIO) -> bytes:
    """Return an archive whose parts have no time of their own, so that equal workbooks have equal bytes."""
    import zipfile

    stream = io.BytesIO()
    with zipfile.ZipFile(content) as packed, zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as again:
        for part in packed.infolist():
            text = packed.read(part)
            if part.filename == "docProps/core.xml":
                # openpyxl writes the time of saving into the properties.
                text = _TIME.sub(b"2000-01-01T00:00:00Z", text)
            # A ZipInfo made by hand has the date 1980-01-01, the first that an archive can have.
            again.writestr(zipfile.ZipInfo(part.filename), text, zipfile.ZIP_DEFLATED)
    return stream.getvalue()


def _name(title: str, names: set[str]) -> str:
    """Return a name that a workbook allows and does not have yet."""
    name = _FORBIDDEN.sub(" ", title).strip("' ")[:_MAX_NAME] or "Sheet"
    chosen, n = name, 1
    # Excel takes "Axes" and "AXES" for one name, and refuses the file.
    while chosen.casefold() in names:
        n += 1
        chosen = f"{name[: _MAX_NAME - len(str(n)) - 1]} {n}"
    names.add(chosen.casefold())
    return chosen


def _text(text: str) -> str:
    """Return a text without the control characters that a workbook cannot contain."""
    from openpyxl.cell.cell import ILLEGAL_CHARACTERS_RE

    return str(ILLEGAL_CHARACTERS_RE.sub(" ", text))[:_MAX_TEXT]


def _widths(sheet: WorkbookSheet) -> list[int]:
    """Return the characters of each column."""
    longest: dict[int, int] = {}
    for row in (sheet.heads, *sheet.rows):
        for column, content in enumerate(row):
            length = len(str(content)) if content is not None else 0
            longest[column] = max(longest.get(column, 6), length + _ROOM)
    short = [width for width in longest.values() if width <= _WIDEST]
    long = len(longest) - len(short)
    # What short columns leave of the page is shared by the long ones.
    widest = max(_WIDEST, (_ACROSS - sum(short)) // long) if long else _WIDEST
    return [min(width, widest) for width in longest.values()]
