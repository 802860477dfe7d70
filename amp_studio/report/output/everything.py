"""The whole report as a workbook with a sheet for each kind of it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from amp_studio.report.chapters import ExchangeLine, ProgramState
from amp_studio.report.language import Language, language_of
from amp_studio.report.model import Report, ReportRow
from amp_studio.report.wording import state_name
from amp_studio.schema import write_figure

from .workbook import WorkbookCell, WorkbookSheet, workbook

_VALUE_HEADS = (
    "Number",
    "Id",
    "Instance",
    "Belongs to",
    "Parameter",
    "Group",
    "Value",
    "Unit",
    "Default",
    "Changed",
    "State",
    "Forced",
    "Default printed",
    "Note",
)


def render_workbook(report: Report) -> bytes:
    """Return the report as XLSX: values, findings, what is not set, exchanges, notes, axes, machine.
    Numbers are numbers.
    """
    words = language_of(report.contents.language, report.family_id)
    values, *others = _sheets(report, words)
    every = [
        replace(sheet, title=words.text(sheet.title), heads=tuple(map(words.text, sheet.heads)))
        # The values stay though there may be none: a workbook needs one sheet.
        for sheet in (values, *(sheet for sheet in others if sheet.rows))
    ]
    return workbook(every, f"{report.title} – {report.subject}", report.program, report.contents.paper)


def _sheets(report: Report, words: Language) -> Iterator[WorkbookSheet]:
    """Yield every sheet that there can be, the values first."""
    text = words.text
    yield _values(report, words)
    findings = [
        (
            words.title(n.severity),
            n.count,
            n.place,
            ", ".join(x for _, x in n.about),
            n.message,
            n.fix,
            n.page,
        )
        for n in report.notes
    ]
    heads = ("Severity", "Count", "Belongs to", "About", "Message", "Suggestion", "Page")
    yield WorkbookSheet("Findings", heads, findings)
    not_set = [(number, name, text(place)) for number, name, place in report.not_set]
    yield WorkbookSheet("Not set", ("Number", "Parameter", "Belongs to"), not_set)
    yield _records("Power-up", ("What", "Code", "Meaning", "Parameter", "Page"), report.power_up)
    heads = ("Verdict", "Scenario", "Axis", "Figure", "Value", "Unit", "Why")
    yield WorkbookSheet("Check in motion", heads, [*_checks(report, words)])
    heads = ("When", "Who", "What", "Control", "Before", "After", "Result")
    yield _records("Exchanges", heads, report.exchanges)
    tuned = [
        (each.when, each.who, each.axis, words.sentence(each.aim), *row, each.note)
        for each in report.tunings
        for row in each.rows(words)
    ]
    columns = "When", "Who", "Axis", "Aim", "What", "Before", "After", "Result", "Note"
    yield WorkbookSheet("Tuning record", columns, tuned)
    limits = [
        (each.name, limit.letter, words.sentence(limit.name), limit.param, limit.time_s, limit.share)
        for each in report.programs
        for limit in each.limits
    ]
    of_programs = ("Program", "Letter", "What limits the feed", "Parameter", "s", "Share")
    yield WorkbookSheet("Part programs", of_programs, limits)
    noted = [(text("Machine"), report.remarks), *report.remarked] if report.remarks else report.remarked
    yield WorkbookSheet("Notes", ("About", "Note"), noted)
    yield WorkbookSheet("Axes", report.axis_heads, [tuple(map(text, line)) for line in report.axes])
    about = (("", report.title), ("Printed", report.when), *report.machine, *report.facts, *report.counts)
    facts = [(text(title), report.fact(title, body, text)) for title, body in about]
    yield WorkbookSheet("Machine", ("", ""), facts)


def _checks(report: Report, words: Language) -> Iterator[tuple[WorkbookCell, ...]]:
    """Yield a line for each figure of a scenario, and one for a scenario without."""
    for check in report.checks:
        scenario, _, why = check.printed(words)
        head = words.text(check.verdict), scenario, check.axis
        if not check.figures:
            yield *head, "", None, "", why
        for n in check.figures:
            yield *head, words.figure(n.name, n.unit), n.value, words.unit(n.unit), why


def _values(report: Report, words: Language) -> WorkbookSheet:
    """Return the sheet of values; a number that a cell cannot have exactly is a text."""
    values = []
    for row in report.rows():
        value, default = (_number(text, row) for text in (row.value, row.plain_default))
        yes_no = ("yes" if row.is_changed else "no"), ("no" if row.no_default else "yes")
        changed, printed = map(words.text, yes_no)
        place, state = words.text(row.place), words.title(state_name(row.state))
        identity = (row.number, row.id, row.instance, place, row.name, row.group)
        unit = words.unit(row.unit)
        values.append((*identity, value, unit, default, changed, state, row.forced, printed, row.note))
    return WorkbookSheet("Values", _VALUE_HEADS, values)


def _records(
    title: str, heads: tuple[str, ...], records: Sequence[ProgramState | ExchangeLine]
) -> WorkbookSheet:
    """Return records of one kind, a column for each of their fields."""
    return WorkbookSheet(
        title, heads, [tuple(getattr(one, name) for name in one.__slots__) for one in records]
    )


def _number(text: str, row: ReportRow) -> WorkbookCell:
    """Return a number as a number, if the cell then reads as the same text."""
    if not row.is_number:
        return text
    try:
        number = float(text)
    except ValueError:
        return text
    # A float has 15 digits for certain: a longer figure would be another number in the cell.
    return number if write_figure(number) == text else text
