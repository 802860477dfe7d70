"""The report as a CSV table: one line for each value, RFC 4180, UTF-8 with a byte order mark for Excel."""

from __future__ import annotations

import csv
import io

from amp_studio.files import text_cell
from amp_studio.report.model import Report, ReportRow

HEADS = (
    "number",
    "id",
    "instance",
    "name",
    "group",
    "value",
    "unit",
    "default",
    "changed",
    "state",
    "forced",
    "default_printed",
    "note",
)


def render_csv(report: Report) -> bytes:
    """Return the table. Units are spelled as in the parameter file, so that values can be read back.

    A default is given in the unit of its value.
    """
    stream = io.StringIO(newline="")
    table = csv.writer(stream, lineterminator="\r\n")
    table.writerow(HEADS)
    # A text that begins like a formula would be run by the spreadsheet that opens it.
    table.writerows(map(text_cell, line_of(row)) for row in report.rows())
    # Without the mark Excel takes UTF-8 for the code page of the country.
    return stream.getvalue().encode("utf-8-sig")


def line_of(row: ReportRow) -> tuple[str, ...]:
    """Return the cells of a value, in the order of ``HEADS``."""
    return (
        row.number,
        row.id,
        row.instance,
        row.name,
        row.group,
        row.value,
        row.unit,
        row.plain_default,
        "yes" if row.is_changed else "no",
        row.state,
        row.forced,
        "no" if row.no_default else "yes",
        row.note,
    )
