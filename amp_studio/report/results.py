"""A table of results as a file: heads and rows of text, for a spreadsheet or a browser."""

from __future__ import annotations

import csv
import html
import io
from collections.abc import Sequence
from pathlib import Path

from amp_studio.files import write_atomic
from amp_studio.files.spreadsheet import text_cell

ENDINGS = (".csv", ".html")


def check_ending(path: Path) -> None:
    """Refuse a name whose ending is that of no table of results; raises ValueError."""
    if path.suffix.lower() not in ENDINGS:
        raise ValueError(f"{path}: the table is written as {' or '.join(ENDINGS)}")


def write_results(path: Path, title: str, heads: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """Write a table under a new name; raises ValueError for another ending, SaveError."""
    check_ending(path)
    content = _csv(heads, rows) if path.suffix.lower() == ".csv" else _page(title, heads, rows)
    write_atomic(path, content.encode(errors="replace"), expected=None)


def _csv(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    text = io.StringIO()
    csv.writer(text).writerows(map(text_cell, row) for row in (heads, *rows))
    return text.getvalue()


def _page(title: str, heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    def line(tag: str, row: Sequence[str]) -> str:
        return f"<tr>{''.join(f'<{tag}>{html.escape(cell)}</{tag}>' for cell in row)}</tr>"

    body = "\n".join([line("th", heads), *(line("td", row) for row in rows)])
    style = "table{border-collapse:collapse}td,th{border:1px solid #ccc;padding:4px 8px;text-align:left}"
    return (f'<!doctype html>\n<html lang="en"><meta charset="utf-8"><title>{html.escape(title)}</title>'
            f"<style>{style}</style>\n<table>\n{body}\n</table></html>\n")  # fmt: skip
