"""The report as plain text of 100 columns, for line printers and terminals."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Iterator, Sequence

from amp_studio.report.findings.printed_finding import PrintedFinding
from amp_studio.report.language import Language, language_of
from amp_studio.report.model import MARKS, Grid, Listing, Report, ReportRow
from amp_studio.report.wording import note_lines, printable

WIDTH = 100

_ROW = (8, 34, 10, 25, 13, 5)
"""Columns of number, name, place, value, default and marks, one space apart."""
_HEAD = ("Number", "Parameter", "", "Value", "Default", "")


def render_text(report: Report) -> bytes:
    """Return the text in UTF-8; no line is longer than ``WIDTH``."""
    words = language_of(report.contents.language, report.family_id)
    return ("\n".join(line.rstrip() for line in _lines(report, words)) + "\n").encode("utf-8")


def _lines(report: Report, words: Language) -> Iterator[str]:
    """Yield all lines of the report, which may end in blanks."""
    yield from _title(report, words)
    yield from _findings(report, words)
    yield from _values(report.forced, words)
    yield from _not_set(report, words)
    yield from _dangers(report, words)
    for section in report.sections:
        yield from _heading(section.title.upper())
        for part in section.parts:
            yield from _part(part, words)
    yield from _power_up(report, words)
    yield from _checks(report, words)
    yield from _programs(report, words)
    yield from _tunings(report, words)
    yield from _exchanges(report, words)
    if "signatures" not in report.contents.without:
        yield from _heading(words.text("Signatures").upper())
        for label in ("Set up by", "Checked by", "Released by", "Taken over by"):
            yield ""
            yield f"{words.text(label) + ' ':_<60}  {words.text('Date') + ' ':_<38}"


def _part(part: Listing | Grid, words: Language) -> Iterator[str]:
    """Yield the lines of one table, what the bits of its words mean, and why values are inactive."""
    if part.title:
        yield from _wrapped(part.title, "")
        yield "-" * min(len(part.title), WIDTH)
    yield from _table(part.rows, not isinstance(part, Listing) or part.by_place, words)
    for word in part.words:
        for places, value, meaning in word.values:
            head = " ".join(filter(None, (word.number, word.name, words.listed(places), value)))
            yield from _wrapped(f"{head}: {meaning}", "  ")
    for mark, why in part.reasons:
        yield from _wrapped(why, f"  {mark} ")
    yield ""


def _power_up(report: Report, words: Language) -> Iterator[str]:
    if not report.power_up:
        return
    yield from _heading(words.text("Part programs after power-up").upper())
    for line in report.power_up:
        yield from _wrapped(f"{line.what}: {line.code} {line.meaning}".replace("  ", " "), "")
        yield from _wrapped(f"{line.parameters} ({words.text('page')} {line.page})".strip(), "    ")
    yield ""


def _checks(report: Report, words: Language) -> Iterator[str]:
    """Yield the lines of the check in motion; none where it was not asked for."""
    if not report.checks:
        return
    yield from _heading(words.text("Check in motion").upper())
    for each in report.checks:
        scenario, figures, text = each.printed(words)
        where = f"{scenario} {each.axis}".rstrip()
        yield from _wrapped(f"{words.text(each.verdict)}  {where}  {figures}".rstrip(), "")
        if text:
            yield from _wrapped(text, "    ")
    yield ""


def _programs(report: Report, words: Language) -> Iterator[str]:
    """Yield the lines of each part program: what limits its feed, and how long."""
    for each in report.programs:
        yield from _heading(f"{words.text('Part program').upper()} {each.name}")
        for limit in each.limits:
            name = f"{words.sentence(limit.name)}  {limit.param}".rstrip()
            time, share = map(words.number, limit.texts)
            yield f"  {limit.letter}  {time:>7} s  {share:>5} %  {name}"
        for line in each.notes:
            yield from _wrapped(words.sentence(line), "")
        yield ""


def _tunings(report: Report, words: Language) -> Iterator[str]:
    """Yield the lines of the tuning record."""
    if not report.tunings:
        return
    yield from _heading(words.text("Tuning record").upper())
    for each in report.tunings:
        yield from _wrapped(each.head(words), "")
        for what, before, after, remark in each.rows(words):
            values = " → ".join(filter(None, (before, after)))
            yield from _wrapped(f"{what}: {values}{f' ({remark})' if remark else ''}", "    ")
        if each.note:
            yield from _wrapped(each.note, "    ")
    yield ""


def _exchanges(report: Report, words: Language) -> Iterator[str]:
    if not report.exchanges:
        return
    yield from _heading(words.text("Exchanges with controls").upper())
    for each in report.exchanges:
        yield from _wrapped(f"{each.when}  {each.who}  {each.verb}  {each.control}", "")
        yield from _wrapped(f"{each.before or '?'} → {each.after or '?'}  {each.text}", "    ")
    yield ""


# -- before the values ---------------------------------------------


def _remarks(report: Report) -> Iterator[str]:
    """Yield the remarks on the machine, and those on its axes and values."""
    if report.remarks:
        for line in note_lines(report.remarks):
            yield from _wrapped(line, "")
        yield ""
    for about, noted in report.remarked:
        start = f"{about}: "
        for n, line in enumerate(note_lines(noted)):
            yield from _wrapped(line, " " * len(start) if n else start)
    if report.remarked:
        yield ""


def _title(report: Report, words: Language) -> Iterator[str]:
    """Yield the lines of the cover: facts, notes, axes and what the marks mean."""
    yield "=" * WIDTH
    head = f"{words.text('Machine parameters')} {words.text(report.order)}".upper()
    yield f"{report.program}   {head}".ljust(WIDTH - len(report.when)) + report.when
    yield "=" * WIDTH
    for title, text in (*report.machine, *report.facts, *report.counts):
        yield from _wrapped(report.fact(title, text, words.text), f"{words.text(title) + ' ':.<30} ")
    yield ""
    yield from _remarks(report)
    if report.axes:
        lines = [tuple(map(words.text, line)) for line in report.axes]
        yield from _columns(tuple(map(words.text, report.axis_heads)), lines)
        yield ""
    for mark, what in MARKS.items():
        yield from _wrapped(words.text(what), f"  {mark} ")
    yield ""


def _findings(report: Report, words: Language) -> Iterator[str]:
    """Yield the lines of all findings by severity."""
    yield from _heading(words.text("Findings").upper())
    if not report.notes:
        yield words.text("No errors, no warnings, no recommendations.")
    for severity, notes in report.severities().items():
        yield words.counted(sum(n.count for n in notes), severity)
        for finding in notes:
            yield from _finding(finding, words)
    yield ""


def _finding(finding: PrintedFinding, words: Language) -> Iterator[str]:
    """Yield the lines of one finding: its message, its values, its fix."""
    cited = finding.page if finding.is_own else f"{words.text('page')} {finding.page}"
    page = f" ({cited})" if finding.page else ""
    place = f"{words.text(finding.place)}: " if finding.place else ""
    yield from _wrapped(place + finding.message + page, "  - ")
    if finding.about:
        about = words.text("About").lower()
        yield from _wrapped(", ".join(label for _, label in finding.about), f"    {about:<6} ")
    if finding.fix:
        yield from _wrapped(finding.fix, f"    {words.text('fix'):<6} ")


def _dangers(report: Report, words: Language) -> Iterator[str]:
    """Yield the lines of each danger with its parameters."""
    if report.dangers:
        yield from _heading(words.text("Dangers").upper())
        for danger in report.dangers:
            yield from _wrapped(
                f"{danger.says} ({words.text('page')} {danger.page})", f"  {words.title('Danger').upper()}  "
            )
            yield from _wrapped("; ".join(label for _, label in danger.about), "          ")
        yield ""


def _values(rows: Sequence[ReportRow], words: Language) -> Iterator[str]:
    if rows:
        yield from _heading(words.text("Forced out of range").upper())
        yield from _table(rows, True, words)
        yield ""


def _not_set(report: Report, words: Language) -> Iterator[str]:
    """Yield a line for each active parameter without a value."""
    if report.not_set:
        yield from _heading(words.text("Not set").upper())
        sentence = (
            "These parameters are active but have no value in the file: the control keeps its own value."
        )
        yield from _wrapped(words.text(sentence), "")
        for number, name, places in report.not_set:
            yield from _beside((number or "–", name, words.text(places)), (13, 36, WIDTH - 13 - 36 - 2))
        yield ""


# -- lines of a given width ----------------------------------------------------


def _heading(title: str) -> Iterator[str]:
    yield "=" * WIDTH
    yield from _wrapped(title, "")
    yield "=" * WIDTH


def _table(rows: Iterable[ReportRow], by_place: bool, words: Language) -> Iterator[str]:
    """Yield the lines of a table of values; a name is written once for its values."""
    listed = tuple(rows)
    # A number that is a name (LinuxCNC) is before the name of its parameter instead of in a column of eight.
    joined = any(len(row.number) > _ROW[0] for row in listed)
    place = _ROW[2] if by_place else 0
    name_width = _ROW[1] + (0 if by_place else _ROW[2] + 1) + (_ROW[0] + 1 if joined else 0)
    widths = (0 if joined else _ROW[0], name_width, place, *_ROW[3:])
    number, *heads = map(words.text, _HEAD)
    if joined:
        heads[0] = f"{number}, {heads[0]}"
    yield from _beside((number, *heads), widths)
    before = ""
    for row in listed:
        name = row.name if row.id != before else ""
        number = row.number or "–"
        if joined:
            name = f"{number} {name}"
        cells = (number, name, words.text(row.place), _value_text(row, words), row.default, row.marks)
        yield from _beside(cells, widths)
        before = row.id


def _value_text(row: ReportRow, words: Language) -> str:
    """Return a value with what is printed small elsewhere, and why it was forced."""
    value = words.text(row.bare_text) if row.is_own_word else row.text
    if small_print := row.small_print_in(words.text):
        value += f" ({small_print})"
    return f"{value} [{row.forced}]" if row.forced else value


def _columns(heads: Sequence[str], lines: Sequence[Sequence[str]]) -> Iterator[str]:
    """Yield a small table; the width of a column depends on its content."""
    wanted = [max(len(text) for text in column) for column in zip(heads, *lines, strict=True)]
    while sum(wanted) + len(wanted) - 1 > WIDTH:
        # From the widest, so that short columns stay whole.
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
