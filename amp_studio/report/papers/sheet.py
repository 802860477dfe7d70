"""The printed sheet for keying values in at a control: PDF, web page, plain text, table."""

from __future__ import annotations

import csv
import io
import textwrap
from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from amp_studio.files import Notify, text_cell
from amp_studio.report.language import Language, language_of
from amp_studio.report.output.page import filled_page
from amp_studio.report.output.pdf import filled_template, typeset
from amp_studio.report.wording import counted, printable
from amp_studio.sheet import Instruction, Sheet, SheetEntry, Stage
from amp_studio.version import __version__

from .endings import write_by_ending

WIDTH = 100
_HEADS = (
    "step",
    "number",
    "name",
    "now",
    "key in",
    "unit",
    "value in the file",
    "page",
    "read back",
    "notes",
)


@dataclass(frozen=True)
class Step:
    """One entry with its number in the order, whether it is ticked, and what was read back."""

    at: int
    entry: SheetEntry
    is_ticked: bool
    screen_text: str

    @property
    def notes(self) -> tuple[str, ...]:
        """Why it comes here, and what is broken meanwhile."""
        return ((self.entry.order,) if self.entry.order else ()) + self.entry.until

    def meaning(self, words: Language) -> str:
        """Return the value as the file gives it, in a language; a word of the control as it is."""
        entry = self.entry
        return words.label(entry.meaning) if entry.is_label else words.sentence(entry.meaning)


@dataclass(frozen=True)
class PrintedSheet:
    """A sheet with the ticks that it has and the moment of printing."""

    sheet: Sheet
    ticked: Collection[str] = ()
    """The numbers of the entries that are keyed in already."""
    screen_text: tuple[tuple[str, str], ...] = ()
    date: datetime | None = None
    language: str = "en"
    """Code of the language of the page's own words."""

    @property
    def when(self) -> str:
        """Date and time in printed form."""
        return self.words.moment(self.printed)

    @property
    def printed(self) -> datetime:
        """The moment of printing."""
        return self.date or datetime.now().astimezone()

    @property
    def words(self) -> Language:
        """Its language, with the facts of the family."""
        return language_of(self.language, self.sheet.family_id)

    @property
    def program(self) -> str:
        """Who printed it."""
        return f"AMP Studio {__version__}"

    @property
    def title(self) -> str:
        """The machine's name, or what the sheet is."""
        return self.sheet.machine or self.sheet.title

    @property
    def summary(self) -> str:
        """How much there is to do, in a sentence."""
        left = len(self.sheet.left_out)
        done = sum(entry.number in self.ticked for entry in self.sheet.entries)
        parts = [
            f"{counted(len(self.sheet.entries), 'value')} to key in" + (f", {done} done" if done else ""),
            f"{self.sheet.same} are the same already",
            *([f"{left} {'differs' if left == 1 else 'differ'} and cannot be keyed in here"] if left else []),
        ]
        return "; ".join(parts) + "."

    def parts(self) -> Iterator[tuple[Stage, tuple[Step, ...]]]:
        """Yield the steps in order, in runs of one stage."""
        screen_text = dict(self.screen_text)
        run: list[Step] = []
        for at, entry in enumerate(self.sheet.entries, 1):
            # The order of keying in decides: a stage may come again.
            if run and run[-1].entry.stage != entry.stage:
                yield self.sheet.stages[run[-1].entry.stage], tuple(run)
                run = []
            run.append(Step(at, entry, entry.number in self.ticked, screen_text.get(entry.number, "")))
        if run:
            yield self.sheet.stages[run[-1].entry.stage], tuple(run)


def render_sheet_text(printed: PrintedSheet) -> bytes:
    """Return plain text in UTF-8, of 100 columns."""
    return ("\n".join(line.rstrip() for line in text_lines(printed)) + "\n").encode("utf-8")


def _stage_lines(stage: Stage, words: Language) -> Iterator[str]:
    """Yield the title of a part of the sheet, and why it is a part; nothing for one without a title."""
    if stage.title:
        page = f" ({words.text(f'page {stage.page}')})" if stage.page else ""
        yield from _wrapped(words.title(stage.title).upper() + page, "")
        if stage.why:
            yield from _wrapped(words.sentence(stage.why), "")


def text_lines(printed: PrintedSheet) -> Iterator[str]:
    """Yield the lines of the sheet as text."""
    sheet, words = printed.sheet, printed.words
    yield "=" * WIDTH
    yield words.title(sheet.title).upper().ljust(WIDTH - len(printed.when)) + printed.when
    yield "=" * WIDTH
    facts = (
        ("Machine", sheet.machine),
        ("Control", sheet.family),
        ("Values of", sheet.wanted),
        ("Compared with", sheet.present),
    )
    for name, text in facts:
        if text:
            yield from _wrapped(text, f"{words.text(name) + ' ':.<16} ")
    yield from _wrapped(words.text(printed.summary), "")
    for warning in sheet.warnings:
        yield from _wrapped(words.sentence(warning), "! ")
    yield from _instructions("Before", sheet.before, words)
    step_head, number, key, unit, now = map(words.text, ("Step", "Number", "Key in", "Unit", "Now"))
    head = f"{step_head:>8}  {number:<12}{key:>16} {unit:<8}{now:>14}  {words.text('Parameter')}"
    for stage, steps in printed.parts():
        yield ""
        yield from _stage_lines(stage, words)
        yield head
        for step in steps:
            yield from _step_lines(step, words)
    yield from _instructions("After", sheet.after, words)
    if sheet.left_out:
        yield ""
        yield words.text("Not on this sheet").upper()
        for left in sheet.left_out:
            yield from _wrapped(
                f"{words.of_place(left.name, left.place)}: {words.sentence(left.why)}",
                f"  {left.number:<12} ",
            )


def _step_lines(step: Step, words: Language) -> Iterator[str]:
    """Yield the lines of one entry: a box, what to key in, what is there now, and its remarks."""
    entry = step.entry
    head = (
        f"[{'x' if step.is_ticked else ' '}] {step.at:>4}  {entry.number:<12}{entry.new:>16}"
        f" {words.unit(entry.unit):<8}{entry.old or '?':>14}  "
    )
    about = words.of_place(entry.name, entry.place) + (f" = {step.meaning(words)}" if entry.meaning else "")
    about += f" ({words.text(f'page {entry.page}')})"
    if step.screen_text:
        about += f"; {words.text('read back')} {step.screen_text}"
    yield from _wrapped(about, head)
    for note in step.notes:
        yield from _wrapped(words.sentence(note), " " * 12 + "- ")


def _instructions(title: str, steps: tuple[Instruction, ...], words: Language) -> Iterator[str]:
    if steps:
        yield ""
        yield words.text(title).upper()
        for n, each in enumerate(steps, 1):
            page = f" ({words.text(f'page {each.page}')})" if each.page else ""
            yield from _wrapped(words.sentence(each.text) + page, f"{n:>3}. ")


def _wrapped(text: str, head: str) -> list[str]:
    indent = " " * len(head)
    head = printable(head)
    # A long number or value may fill a line: what it is then still has 30 characters.
    room = max(WIDTH, len(head) + 30)
    return textwrap.wrap(printable(text), room, initial_indent=head, subsequent_indent=indent) or [head]


def render_sheet_csv(printed: PrintedSheet) -> bytes:
    """Return a table, one line an entry in the order of the steps;
    the column ``read back`` is to be filled in.
    """
    stream = io.StringIO(newline="")
    table = csv.writer(stream, lineterminator="\r\n")
    table.writerow(_HEADS)
    for _, steps in printed.parts():
        for step in steps:
            e = step.entry
            row = (
                str(step.at),
                e.number,
                e.name,
                e.old,
                e.new,
                e.unit,
                e.meaning,
                e.page,
                step.screen_text,
                " ".join(step.notes),
            )
            # A cell that begins as a formula is kept from being one: names come from files of others.
            table.writerow(map(text_cell, row))
    return stream.getvalue().encode("utf-8-sig")


def render_sheet_html(printed: PrintedSheet) -> bytes:
    """Return one web page that can be printed."""
    return filled_page("sheet.html.j2", language=printed.words, printed=printed, sheet=printed.sheet)


def _render_sheet_pdf(printed: PrintedSheet) -> bytes:
    """Return the PDF."""
    source = filled_template("sheet.typ.j2", language=printed.words, printed=printed, sheet=printed.sheet)
    return typeset(source, printed.printed)


SHEET_FORMATS: dict[str, Callable[[PrintedSheet], bytes]] = {
    ".pdf": _render_sheet_pdf,
    ".html": render_sheet_html,
    ".csv": render_sheet_csv,
    ".txt": render_sheet_text,
}


def write_sheet(printed: PrintedSheet, path: Path, notify: Notify = lambda _note: None) -> None:
    """Write a sheet, whole or not at all, in the format of the path's ending; raises ValueError,
    SaveError.
    """
    write_by_ending(path, SHEET_FORMATS, printed, "a sheet", notify)
