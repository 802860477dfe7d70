"""The whole report as a workbook with a sheet for each kind of it."""

from __future__ import annotations

from amp_studio.report.model import CheckedMotion, ExchangeLine, ProgramState, Report, ReportRow
from amp_studio.schema import write_figure

from .table_csv import HEADS, line_of
from .workbook import WorkbookCell, WorkbookSheet, workbook


def render_workbook(report: Report) -> bytes:
    """Return the report as XLSX: values, findings, what is not set, exchanges, notes, axes, machine.
    Numbers are numbers.
    """
    heads = [head.replace("_", " ") for head in HEADS]
    place = HEADS.index("instance") + 1
    heads.insert(place, "belongs to")
    number_columns = {HEADS.index("value"), HEADS.index("default")}
    values = []
    for row in report.rows():
        line = [_number(text, row) if n in number_columns else text for n, text in enumerate(line_of(row))]
        line.insert(place, row.place)
        values.append(tuple(line))
    sheets = [WorkbookSheet("Values", tuple(heads), values)]
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
    records: tuple[ProgramState | CheckedMotion | ExchangeLine, ...]
    for title, records in (
        ("Power-up", report.power_up),
        ("Check in motion", report.checks),
        ("Exchanges", report.exchanges),
    ):
        if records:
            names = tuple(records[0].__slots__)
            lines = [tuple(getattr(each, name) for name in names) for each in records]
            sheets.append(WorkbookSheet(title, names, lines))
    limits = [
        (each.name, limit.letter, limit.name, limit.param, limit.time_s, limit.share)
        for each in report.programs
        for limit in each.limits
    ]
    if limits:
        heads_of_limits = ("program", "letter", "limit", "parameter", "s", "share")
        sheets.append(WorkbookSheet("Part programs", heads_of_limits, limits))
    noted = [("Machine", report.remarks), *report.remarked] if report.remarks else report.remarked
    if noted:
        sheets.append(WorkbookSheet("Notes", ("about", "note"), noted))
    if report.axes:
        sheets.append(WorkbookSheet("Axes", report.axis_heads, report.axes))
    about = (("", report.title), ("Printed", report.when), *report.machine, *report.facts, *report.counts)
    every = [*sheets, WorkbookSheet("Machine", ("", ""), about)]
    return workbook(every, f"{report.title} – {report.subject}", report.program, report.contents.paper)


def _number(text: str, row: ReportRow) -> WorkbookCell:
    """Return a number as a number, if the cell then reads as the same text."""
    if not row.is_number:
        return text
    try:
        number = float(text)
    except ValueError:
        return text
    return number if write_figure(number) == text else text
