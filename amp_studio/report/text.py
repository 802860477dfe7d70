"""The report as plain text of 100 columns, for line printers and terminals."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Iterator, Sequence

from .model import MARKS, Listing, Report, ReportRow, printable
from .note import Note
from .wording import counted

WIDTH = 100

_ROW = (8, 34, 10, 25, 13, 5)
"""Columns of number, name, place, value, default and marks, one space apart."""
_HEAD = ("Number", "Parameter", "", "Value", "Default", "")


def render_text(report: Report) -> bytes:
    """Return the text in UTF-8; no line is longer than ``WIDTH``."""
    return ("\n".join(line.rstrip() for line in _lines(report)) + "\n").encode("utf-8")


def _lines(report: Report) -> Iterator[str]:
    yield from _title(report)
    yield from _findings(report)
    yield from _values("FORCED OUT OF RANGE", report.forced)
    yield from _not_set(report)
    yield from _dangers(report)
    for section in report.sections:
        yield from _heading(section.title.upper())
        for part in section.parts:
            if part.title:
                yield from _wrapped(part.title, "")
                yield "-" * min(len(part.title), WIDTH)
            yield from _table(part.rows, by_place=not isinstance(part, Listing) or part.by_place)
            for mark, why in part.reasons:
                yield from _wrapped(why, f"  {mark} ")
            yield ""
    if report.exchanges:
        yield from _heading("EXCHANGES WITH CONTROLS")
        for each in report.exchanges:
            yield from _wrapped(f"{each.when}  {each.who}  {each.verb}  {each.control}", "")
            yield from _wrapped(f"{each.before or '?'} → {each.after or '?'}  {each.text}", "    ")
        yield ""
    if "signatures" not in report.contents.without:
        yield from _heading("SIGNATURES")
        for label in ("Set up by", "Checked by", "Released by", "Taken over by"):
            yield ""
            yield f"{label + ' ':_<60}  {'Date ':_<38}"


# -- before the values ---------------------------------------------


def _title(report: Report) -> Iterator[str]:
    yield "=" * WIDTH
    yield (
        f"{report.program}   MACHINE PARAMETERS {report.order.upper()}".ljust(WIDTH - len(report.when))
        + report.when
    )
    yield "=" * WIDTH
    for title, text in (*report.machine, *report.facts, *report.counts):
        yield from _wrapped(text, f"{title + ' ':.<30} ")
    yield ""
    if report.remarks:
        for paragraph in report.remarks.splitlines():
            yield from _wrapped(paragraph, "")
        yield ""
    for about, noted in report.remarked:
        yield from _wrapped(noted, f"{about}: ")
    if report.remarked:
        yield ""
    if report.axes:
        yield from _columns(report.axis_heads, report.axes)
        yield ""
    for mark, what in MARKS.items():
        yield from _wrapped(what, f"  {mark} ")
    yield ""


def _findings(report: Report) -> Iterator[str]:
    yield from _heading("FINDINGS")
    if not report.notes:
        yield "No errors, no warnings, no recommendations."
    for severity, notes in report.severities().items():
        yield counted(sum(n.count for n in notes), severity).capitalize()
        for note in notes:
            yield from _finding(note)
    yield ""


def _finding(note: Note) -> Iterator[str]:
    page = f" ({note.cited})" if note.page else ""
    yield from _wrapped((f"{note.place}: " if note.place else "") + note.message + page, "  - ")
    if note.about:
        yield from _wrapped(", ".join(label for _, label in note.about), "    about  ")
    if note.fix:
        yield from _wrapped(note.fix, "    fix    ")


def _dangers(report: Report) -> Iterator[str]:
    if report.dangers:
        yield from _heading("DANGERS")
        for danger in report.dangers:
            yield from _wrapped(f"{danger.says} (page {danger.page})", "  DANGER  ")
            yield from _wrapped("; ".join(label for _, label in danger.about), "          ")
        yield ""


def _values(title: str, rows: Sequence[ReportRow]) -> Iterator[str]:
    if rows:
        yield from _heading(title)
        yield from _table(rows, by_place=True)
        yield ""


def _not_set(report: Report) -> Iterator[str]:
    if report.not_set:
        yield from _heading("NOT SET: THE CONTROL KEEPS ITS OWN VALUE")
        for number, name, places in report.not_set:
            yield from _beside((number or "–", name, places), (13, 36, WIDTH - 13 - 36 - 2))
        yield ""


# -- lines of a given width ----------------------------------------------------


def _heading(title: str) -> Iterator[str]:
    yield "=" * WIDTH
    yield from _wrapped(title, "")
    yield "=" * WIDTH


def _table(rows: Iterable[ReportRow], by_place: bool) -> Iterator[str]:
    place = _ROW[2] if by_place else 0
    widths = (_ROW[0], _ROW[1] + (0 if by_place else _ROW[2] + 1), place, *_ROW[3:])
    yield from _beside(_HEAD, widths)
    before = ""
    for row in rows:
        name = row.name if row.id != before else ""
        value = (
            row.text
            + (f" ({row.small_print})" if row.small_print else "")
            + (f" [{row.forced}]" if row.forced else "")
        )
        yield from _beside((row.number or "–", name, row.place, value, row.default, row.marks), widths)
        before = row.id


def _columns(heads: Sequence[str], lines: Sequence[Sequence[str]]) -> Iterator[str]:
    """Yield a small table; the width of a column depends on its content."""
    wanted = [max(len(text) for text in column) for column in zip(heads, *lines, strict=True)]
    while sum(wanted) + len(wanted) - 1 > WIDTH:
        wanted[wanted.index(max(wanted))] -= 1
    for line in (heads, *lines):
        yield from _beside(line, wanted)


def _beside(texts: Sequence[str], widths: Sequence[int]) -> Iterator[str]:
    """Yield texts side by side, each wrapped to its width; a width of 0 leaves a column out."""
    pairs = [(text, width) for text, width in zip(texts, widths, strict=True) if width]
    wrapped = [textwrap.wrap(printable(text), width) or [""] for text, width in pairs]
    for n in range(max(len(lines) for lines in wrapped)):
        cells = (lines[n] if n < len(lines) else "" for lines in wrapped)
        yield " ".join(cell.ljust(width) for cell, (_, width) in zip(cells, pairs, strict=True))


def _wrapped(text: str, start: str) -> list[str]:
    return textwrap.wrap(
        printable(text), WIDTH, initial_indent=start, subsequent_indent=" " * len(start)
    ) or [start]
