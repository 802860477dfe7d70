"""The whole report as a workbook with a sheet for each kind of it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from amp_studio.report.model import CheckedMotion, ExchangeLine, ProgramState, Report, ReportRow
from amp_studio.schema import write_figure

from .table_csv import HEADS, line_of
from .workbook import WorkbookCell, WorkbookSheet, workbook


def render_workbook(report: Report) -> bytes:
    """Return the report as XLSX: values, findings, what is not set, exchanges, notes, axes, machine.
    Numbers are numbers.
    """
    values, *others = _sheets(report)
    every = [values, *(sheet for sheet in others if sheet.rows)]
    return workbook(every, f"{report.title} – {report.subject}", report.program, report.contents.paper)


def _sheets(report: Report) -> Iterator[WorkbookSheet]:
    """Yield every sheet that there can be, the values first."""
    yield _values(report)
    findings = [
        (n.severity, n.count, n.place, ", ".join(x for _, x in n.about), n.message, n.fix, n.page)
        for n in report.notes
    ]
    heads = ("severity", "count", "place", "about", "message", "fix", "page")
    yield WorkbookSheet("Findings", heads, findings)
    yield WorkbookSheet("Not set", ("number", "parameter", "belongs to"), report.not_set)
    yield _records("Power-up", report.power_up)
    yield _records("Check in motion", report.checks)
    yield _records("Exchanges", report.exchanges)
    limits = [
        (each.name, limit.letter, limit.name, limit.param, limit.time_s, limit.share)
        for each in report.programs
        for limit in each.limits
    ]
    yield WorkbookSheet("Part programs", ("program", "letter", "limit", "parameter", "s", "share"), limits)
    noted = [("Machine", report.remarks), *report.remarked] if report.remarks else report.remarked
    yield WorkbookSheet("Notes", ("about", "note"), noted)
    yield WorkbookSheet("Axes", report.axis_heads, report.axes)
    about = (("", report.title), ("Printed", report.when), *report.machine, *report.facts, *report.counts)
    yield WorkbookSheet("Machine", ("", ""), about)


def _values(report: Report) -> WorkbookSheet:
    heads = [head.replace("_", " ") for head in HEADS]
    place = HEADS.index("instance") + 1
    heads.insert(place, "belongs to")
    number_columns = {HEADS.index("value"), HEADS.index("default")}
    values = []
    for row in report.rows():
        line = [_number(text, row) if n in number_columns else text for n, text in enumerate(line_of(row))]
        line.insert(place, row.place)
        values.append(tuple(line))
    return WorkbookSheet("Values", tuple(heads), values)


def _records(title: str, records: Sequence[ProgramState | CheckedMotion | ExchangeLine]) -> WorkbookSheet:
    """Return records of one kind, a column for each of their fields."""
    names = tuple(records[0].__slots__) if records else ()
    return WorkbookSheet(title, names, [tuple(getattr(each, name) for name in names) for each in records])


def _number(text: str, row: ReportRow) -> WorkbookCell:
    """Return a number as a number, if the cell then reads as the same text."""
    if not row.is_number:
        return text
    try:
        number = float(text)
    except ValueError:
        return text
    return number if write_figure(number) == text else text
