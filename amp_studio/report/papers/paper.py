"""Papers that are tables: differences, machines side by side, results, forms; as PDF, web page, workbook,
CSV or text.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from amp_studio.files import Notify, text_cell
from amp_studio.report.language import Language, language_of
from amp_studio.report.model import PrintedFigure
from amp_studio.report.output.page import filled_page
from amp_studio.report.output.pdf import filled_template, typeset
from amp_studio.schema import MASKED, NOT_SET
from amp_studio.version import __version__

from .endings import write_by_ending

_OWN_FACTS = frozenset({"Differ", "The same"})
"""Facts in words of the paper."""
_MANY_COLUMNS = 6
_MAX_COLUMNS = 14
"""Columns that a page takes; a wider table is for a screen or a spreadsheet."""


@dataclass(frozen=True, slots=True)
class PaperTable:
    """One table; every row has as many cells as there are heads."""

    title: str
    heads: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    shares: tuple[float, ...] = ()
    """Widths of the columns on paper, in relation to each other; equal where there are none."""
    strong: frozenset[tuple[int, int]] = frozenset()
    """Cells (row, column) in bold."""
    values_from: int = _MAX_COLUMNS
    """First column that has values with units and not names."""
    labels: frozenset[int] = frozenset()
    """Rows whose values are words of the control, which stay as it shows them."""


@dataclass(frozen=True, slots=True)
class Paper:
    """A paper."""

    kind: str
    """``Differences``."""
    title: str
    facts: tuple[tuple[str, str], ...]
    tables: tuple[PaperTable, ...]
    date: datetime
    empty: str = ""
    """What is printed where there is no table."""
    figures: tuple[PrintedFigure, ...] = ()
    """Drawings below the tables, in a PDF and a page."""
    signed: tuple[str, ...] = ()
    """Who signs it: a line each."""
    language: str = "en"
    """Code of the language of the paper's own words."""

    @property
    def when(self) -> str:
        """Date and time in printed form."""
        return self.words.moment(self.date)

    @property
    def words(self) -> Language:
        """Its language."""
        return language_of(self.language)

    def fact(self, name: str, body: str) -> str:
        """Return a fact in its language; what a person wrote stays as it is."""
        return self.words.text(body) if name in _OWN_FACTS else body

    def cell(self, table: PaperTable, row: int, column: int) -> str:
        """Return a cell for the eye, its figures as the language writes them."""
        text = table.rows[row][column]
        if column < table.values_from:
            return text
        if text in (NOT_SET, MASKED):
            return self.words.text(text)
        return text if row in table.labels else self.words.quantity(text)

    @property
    def program(self) -> str:
        """The program that has made it."""
        return f"AMP Studio {__version__}"

    @property
    def lies_across(self) -> bool:
        """Whether its widest table needs landscape paper."""
        return max((len(table.heads) for table in self.tables), default=0) > _MANY_COLUMNS


def _pdf(paper: Paper) -> bytes:
    if any(len(table.heads) > _MAX_COLUMNS for table in paper.tables):
        raise ValueError(
            f"more than {_MAX_COLUMNS} columns are too many for paper: write it as .html, .xlsx or .csv"
        )
    return typeset(filled_template("paper.typ.j2", language=paper.words, paper=paper), paper.date)


def _page(paper: Paper) -> bytes:
    return filled_page("paper.html.j2", language=paper.words, paper=paper)


def _workbook(paper: Paper) -> bytes:
    """Return the paper as XLSX, a sheet for each table."""
    from amp_studio.report.output.workbook import WorkbookSheet, workbook

    text = paper.words.text
    facts = [(text(name), paper.fact(name, body)) for name, body in paper.facts]
    sheets = [
        WorkbookSheet(table.title or text(paper.kind), tuple(map(text, table.heads)), table.rows)
        for table in paper.tables
    ]
    about = (("", paper.title), *facts, (text("Printed"), paper.when))
    # The tables come first: what takes one sheet alone, as a spreadsheet without a window does, takes them.
    every = [*sheets, WorkbookSheet(text("This document"), ("", ""), about)]
    return workbook(every, f"{paper.title} – {text(paper.kind)}", paper.program)


def _csv(paper: Paper) -> bytes:
    """Return the tables below each other, with heads where they change and the title of each in front."""
    text = io.StringIO(newline="")
    lines = csv.writer(text)
    several = len(paper.tables) > 1
    for n, table in enumerate(paper.tables):
        heads = tuple(map(paper.words.text, table.heads))
        if not n or table.heads != paper.tables[n - 1].heads:
            lines.writerow(map(text_cell, (paper.words.text("table"), *heads) if several else heads))
        lines.writerows(map(text_cell, (table.title, *row) if several else row) for row in table.rows)
    # With the mark by which Excel knows UTF-8.
    return text.getvalue().encode("utf-8-sig")


PAPER_FORMATS: dict[str, Callable[[Paper], bytes]] = {
    ".pdf": _pdf,
    ".html": _page,
    ".xlsx": _workbook,
    ".csv": _csv,
}


def results_paper(title: str, heads: Sequence[str], rows: Sequence[Sequence[str]]) -> Paper:
    """Return a table of results of this moment."""
    table = PaperTable("", tuple(heads), tuple(map(tuple, rows)))
    return Paper("Results", title, (), (table,), datetime.now().astimezone())


def check_paper_ending(path: Path) -> None:
    """Refuse a name whose ending is that of no such paper; raises ValueError."""
    endings = tuple(PAPER_FORMATS)
    if path.suffix.lower() not in endings:
        raise ValueError(f"{path}: the table is written as {', '.join(endings[:-1])} or {endings[-1]}")


def write_paper(paper: Paper, path: Path, notify: Notify = lambda _note: None) -> None:
    """Write a paper in the format of its file extension, whole or not at all; raises ValueError,
    SaveError.
    """
    check_paper_ending(path)
    write_by_ending(path, PAPER_FORMATS, paper, "a table", notify)
