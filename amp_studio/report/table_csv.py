"""The report as a table for a spreadsheet: one line a value, RFC 4180, UTF-8 with the mark Excel looks for."""

from __future__ import annotations

import csv
import io

from amp_studio.files.spreadsheet import text_cell

from .model import Report, Row

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
)


def render_csv(report: Report) -> bytes:
    """Return the table. Units are those of the parameter file, so that a value reads back as it is.

    A default stands in the unit of its value.
    """
    stream = io.StringIO(newline="")
    table = csv.writer(stream, lineterminator="\r\n")
    table.writerow(HEADS)
    table.writerows(map(text_cell, _line(row)) for row in report.rows())
    return stream.getvalue().encode("utf-8-sig")


def _line(row: Row) -> tuple[str, ...]:
    return (row.number, row.id, row.instance, row.name, row.group, row.value, row.unit, row.plain_default,
            "yes" if row.is_changed else "no", row.state, row.forced)  # fmt: skip
