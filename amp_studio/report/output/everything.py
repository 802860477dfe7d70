"""The whole report as data: JSON, and a workbook with a sheet for each kind of it."""

from __future__ import annotations

import json

from amp_studio.report.model import Report, ReportRow
from amp_studio.schema import write_figure

from .table_csv import HEADS, line_of
from .workbook import WorkbookCell, WorkbookSheet, workbook


def render_json(report: Report) -> bytes:
    """Return the report as one JSON document; every value to its last digit, as text with its unit beside
    it.
    """
    document = {
        "title": report.title,
        "family": report.family,
        "printed": report.date.isoformat(timespec="seconds"),
        "program": report.program,
        "machine": dict(report.machine),
        "document": dict(report.facts),
        "counts": dict(report.counts),
        "notes": report.remarks,
        "noted": [{"about": about, "note": text} for about, text in report.remarked],
        "axes": [dict(zip(report.axis_heads, line, strict=True)) for line in report.axes],
        "values": [
            dict(zip(HEADS, line_of(row), strict=True)) | {"place": row.place, "why": row.why}
            for row in report.rows()
        ],
        "findings": [
            {
                "severity": note.severity,
                "count": note.count,
                "place": note.place,
                "about": [label for _, label in note.about],
                "message": note.message,
                "fix": note.fix,
                "page": note.page,
            }
            for note in report.notes
        ],
        "not_set": [
            {"number": number, "name": name, "place": place} for number, name, place in report.not_set
        ],
        "power_up": [{name: getattr(each, name) for name in each.__slots__} for each in report.power_up],
        "exchanges": [{name: getattr(each, name) for name in each.__slots__} for each in report.exchanges],
    }
    return (json.dumps(document, ensure_ascii=False, indent=1) + "\n").encode("utf-8")


def render_workbook(report: Report) -> bytes:
    """Return the report as XLSX: values, findings, what is not set, exchanges, notes, axes, machine.
    Numbers are numbers.
    """
    heads = tuple(head.replace("_", " ") for head in HEADS)
    number_columns = {HEADS.index("value"), HEADS.index("default")}
    values = [
        tuple(_number(text, row) if n in number_columns else text for n, text in enumerate(line_of(row)))
        for row in report.rows()
    ]
    sheets = [WorkbookSheet("Values", heads, values)]
    findings = [
        (n.severity, n.count, n.place, ", ".join(x for _, x in n.about), n.message, n.fix, n.page)
        for n in report.notes
    ]
    if findings:
        sheets.append(
            WorkbookSheet(
                "Findings", ("severity", "count", "place", "about", "message", "fix", "page"), findings
            )
        )
    if report.not_set:
        sheets.append(WorkbookSheet("Not set", ("number", "parameter", "belongs to"), report.not_set))
    for title, records in (("Power-up", report.power_up), ("Exchanges", report.exchanges)):
        if records:
            names = tuple(records[0].__slots__)
            lines = [tuple(getattr(each, name) for name in names) for each in records]
            sheets.append(WorkbookSheet(title, names, lines))
    noted = [("Machine", report.remarks), *report.remarked] if report.remarks else report.remarked
    if noted:
        sheets.append(WorkbookSheet("Notes", ("about", "note"), noted))
    if report.axes:
        sheets.append(WorkbookSheet("Axes", report.axis_heads, report.axes))
    about = (("", report.title), ("Printed", report.when), *report.machine, *report.facts, *report.counts)
    return workbook([*sheets, WorkbookSheet("Machine", ("", ""), about)])


def _number(text: str, row: ReportRow) -> WorkbookCell:
    """Return a number as a number, if the cell then reads as the same text."""
    if not row.is_number:
        return text
    try:
        number = float(text)
    except ValueError:
        return text
    return number if write_figure(number) == text else text
