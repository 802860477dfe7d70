"""A report as plain data, complete for every output format.

Texts are not escaped; each format escapes them itself.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime
from itertools import groupby
from typing import Any, Protocol

from amp_studio.schema import MASKED, ParameterState

from .chapters import CheckedMotion, Danger, ExchangeLine, PrintedProgram, ProgramState, TuningLine
from .contents import SORTS, Contents
from .findings.printed_finding import PrintedFinding, PrintedSeverity
from .language import language_of

MARKS: dict[str, str] = {
    "*": "differs from the printed default",
    "n": "set, and no default is printed",
    "!": "forced: set out of range on purpose",
    "i": "ignored by the control on this machine; the reason is below the table",
    "u": "not available: another setting excludes it; the reason is below the table",
}


_OWN_FACTS = frozenset(
    {
        "Axes",
        "File",
        "SHA-256 of the file",
        "SHA-256 without the secret values",
        "Unit system",
        "Order",
        "Contents",
        "Findings",
        "State",
    }
)
"""Facts in words of the report."""
_MANY_AXES = 4
_WHOLE = re.compile(r"(≈ )?−?\d+")
_LONGEST_NOTE = 160
"""Characters of a note that are printed beside its value;
all notes are printed whole in a chapter of their own."""


@dataclass(frozen=True, slots=True)
class ReportRow:
    """One value."""

    id: str
    instance: str
    number: str
    """Its number; empty if it has none."""
    name: str
    group: str
    place: str
    """``Axis 1 X``; empty for a value of the whole control."""
    is_set: bool
    is_number: bool
    """Whether it is a number, not a choice or a text."""
    value: str
    """Label, or number without its unit to the last digit, as in the file; empty when not set."""
    unit: str
    """Of ``value`` and ``plain_default``, in the spelling of the database (``mm/s2``)."""
    figure: str
    """Label, or number without its unit, as printed: in the one unit that a report has for the parameter;
    ``≈`` when rounded."""
    shown_unit: str
    """Of ``figure`` and ``default``, in the printed spelling (``mm/s²``)."""
    also: str
    """Number and unit in the other unit system; empty unless the report prints both."""
    entered: str
    """Value and unit as in the file, where ``figure`` is rounded."""
    detail: str
    """The meaning of the set bits of a packed word; empty for all others."""
    default: str
    """The printed default in ``shown_unit``; with its own unit where it cannot be given in that."""
    plain_default: str
    """The default as a number in ``unit``, for calculations in a spreadsheet."""
    is_changed: bool
    """Whether a value is set and differs from the printed default."""
    no_default: bool
    """Whether a value is set and the manual prints no default for it."""
    state: ParameterState
    why: str
    """Why it is inactive; empty when it is active."""
    state_mark: str
    """``i2`` for the second reason in this report why a value is ignored, ``u1`` for not available;
    empty when active."""
    forced: str
    """When and by whom it was forced out of range; empty when it was not."""
    note: str = ""
    """What a person noted about it."""
    data: float | bool | str | None = None
    """The value as data: a number in ``unit``, the label of a choice; None when it is not set, or secret."""
    default_data: float | bool | str | None = None
    """The default likewise."""

    @property
    def anchor(self) -> str:
        """The anchor of links to this row."""
        return f"{self.id}@{self.instance}"

    @property
    def marks(self) -> str:
        """The marks (keys of ``MARKS``) of this value."""
        return ("*" if self.is_changed else "") + self.other_marks

    @property
    def other_marks(self) -> str:
        """Its marks without ``*``, for a format that shows a change by colour."""
        return ("n" if self.no_default else "") + ("!" if self.forced else "") + self.state_mark

    @property
    def text(self) -> str:
        """Value and unit; a dash when it is not set."""
        if not self.figure:
            return self.bare_text
        return f"{self.figure}{'' if self.shown_unit == '°' else ' '}{self.shown_unit}".rstrip()

    @property
    def bare_text(self) -> str:
        """Value without its unit; a dash when it is not set."""
        return self.figure or ("(empty)" if self.is_set else "—")

    @property
    def is_own_word(self) -> bool:
        """Whether ``bare_text`` is a word of the report and not of the file: not set, empty, secret."""
        return not self.figure or self.figure == MASKED

    @property
    def small_print(self) -> str:
        """The text below the value: the other unit system, the unit of entry, a note."""
        return self.small_print_in(str)

    def small_print_in(self, text: Callable[[str], str]) -> str:
        """Return ``small_print`` in the language of ``text``, which returns a phrase in it."""
        entered = f"{text('in the file')} {self.entered}" if self.entered else ""
        short = self.note
        if len(short) > _LONGEST_NOTE:
            short = f"{short[:_LONGEST_NOTE]}… ({text('all of it under Notes')})"
        note = f"{text('Note:')} {short}" if short else ""
        return "; ".join(part for part in (self.also, entered, note) if part)

    @property
    def whole(self) -> str:
        """The text before the decimal separator of its figure, for a column aligned there; empty for what is
        no number.
        """
        found = _WHOLE.match(self.figure) if self.is_number else None
        return found[0] if found else ""


@dataclass(frozen=True, slots=True)
class GridLine:
    """One line of a grid: a parameter across the axes, or a non-axis value that spans all columns."""

    id: str
    number: str
    name: str
    place: str
    shown_unit: str
    """The unit of most cells; a cell in another unit includes it."""
    default: str
    cells: tuple[ReportRow | None, ...]
    """One cell for each column, None where the parameter does not exist; one single cell when it spans."""
    spans: bool

    @property
    def is_changed(self) -> bool:
        """Whether any of its values differs from the printed default."""
        return any(row.is_changed for row in self.cells if row is not None)

    def cell_text(self, row: ReportRow) -> str:
        """Return the text of a cell."""
        # The unit is printed once a line; a cell in another one would be read wrongly without it.
        return row.bare_text if row.shown_unit == self.shown_unit else row.text


@dataclass(frozen=True, slots=True)
class DecodedWord:
    """What the bits of one parameter mean, for the text below its table."""

    number: str
    name: str
    values: tuple[tuple[tuple[str, ...], str, str], ...]
    """(places, value, meaning), places with the same value together."""


class _HasRows(Protocol):
    @property
    def rows(self) -> tuple[ReportRow, ...]: ...


class _TableOfRows:
    """What is printed below a table of values, or sets the width of its figures."""

    __slots__ = ()

    @property
    def reasons(self: _HasRows) -> tuple[tuple[str, str], ...]:
        """The marks of inactive values with their reasons."""
        return _reasons(self.rows)

    @property
    def words(self: _HasRows) -> tuple[DecodedWord, ...]:
        """Its words of bits with their meaning."""
        return tuple(_decoded(self.rows))

    @property
    def widest(self: _HasRows) -> int:
        """Most characters before the decimal separator of a figure."""
        # Of the printed figures: the template puts as much room before shorter ones, so that decimal
        # signs align.
        return max((len(row.whole) for row in self.rows), default=0)


@dataclass(frozen=True, slots=True)
class Listing(_TableOfRows):
    """A table with one line for each value."""

    title: str
    rows: tuple[ReportRow, ...]
    by_place: bool
    """Whether a column with the axis or instance is needed."""


@dataclass(frozen=True, slots=True)
class Column:
    """The head of an axis in a grid: its letter, and what it is (``1 linear``)."""

    name: str
    kind: str

    @property
    def text(self) -> str:
        """Both in one line."""
        return f"{self.name} {self.kind}".rstrip()


@dataclass(frozen=True, slots=True)
class Grid(_TableOfRows):
    """A table with one line for each parameter and one column for each axis, as in the editor."""

    title: str
    columns: tuple[Column, ...]
    lines: tuple[GridLine, ...]

    @property
    def rows(self) -> tuple[ReportRow, ...]:
        """Every value, line by line."""
        return tuple(row for line in self.lines for row in line.cells if row is not None)


def _decoded(rows: Sequence[ReportRow]) -> Iterator[DecodedWord]:
    """Yield the words of bits of a table, each value once."""
    for _, members in groupby((row for row in rows if row.detail), key=lambda row: row.id):
        own = list(members)
        places: dict[tuple[str, str], list[str]] = {}
        for row in own:
            # Axes with equal bits share an entry: eight axes would print the same list eight times.
            places.setdefault((row.figure, row.detail), []).append(row.place)
        numbers = dict.fromkeys(filter(None, (row.number for row in own)))
        values = tuple((tuple(filter(None, at)), *known) for known, at in places.items())
        yield DecodedWord(", ".join(numbers), own[0].name, values)


def _reasons(rows: Iterable[ReportRow]) -> tuple[tuple[str, str], ...]:
    reasons = {row.state_mark: row.why for row in rows if row.state_mark}
    # By the number: as texts i10 comes before i2.
    return tuple(sorted(reasons.items(), key=lambda item: (item[0][0], int(item[0][1:]))))


@dataclass(frozen=True, slots=True)
class PrintedFigure:
    """One drawing."""

    title: str
    svg: str
    notes: tuple[str, ...] = ()
    """The text below it."""
    run: Mapping[str, Any] | None = None
    """The simulation that it is of, as report.json has it."""


@dataclass(frozen=True, slots=True)
class Additions:
    """What the simulator and the records add to the report of a file."""

    motion: Iterable[PrintedFigure] = ()
    """Drawings of the simulator."""
    exchanges: Sequence[ExchangeLine] = ()
    tunings: Sequence[TuningLine] = ()
    """What the records have of the file."""
    checks: Sequence[CheckedMotion] = ()
    """What every scenario found."""
    programs: Sequence[PrintedProgram] = ()
    """Part programs under the file."""


NOTHING_ADDED = Additions()


@dataclass(frozen=True, slots=True)
class Section:
    """One chapter of the report."""

    key: str
    title: str
    parts: tuple[Listing | Grid, ...]


@dataclass(frozen=True, slots=True)
class Report:
    """The complete content of a report."""

    title: str
    """The machine's name, or the file's."""
    family: str
    file_name: str
    date: datetime
    program: str
    contents: Contents
    machine: tuple[tuple[str, str], ...]
    """The facts of the cover about the machine and its control."""
    facts: tuple[tuple[str, str], ...]
    """The facts of the cover about the file and the document."""
    counts: tuple[tuple[str, str], ...]
    remarks: str
    """What a person noted about the machine."""
    remarked: tuple[tuple[str, str], ...]
    """(group or value, what a person noted about it) of all that have a note,
    also where the value is not printed."""
    axis_heads: tuple[str, ...]
    axes: tuple[tuple[str, ...], ...]
    notes: tuple[PrintedFinding, ...]
    """The findings; templates of builders know them by this name."""
    dangers: tuple[Danger, ...]
    """Of values that are active and not the printed default."""
    forced: tuple[ReportRow, ...]
    not_set: tuple[tuple[str, str, str], ...]
    """(number, parameter, places) of each active parameter without a value."""
    sections: tuple[Section, ...]
    pictures: tuple[PrintedFigure, ...]
    motion: Sequence[PrintedFigure]
    """May still be made while the pages before it are."""
    power_up: tuple[ProgramState, ...]
    exchanges: tuple[ExchangeLine, ...]
    tunings: tuple[TuningLine, ...]
    help: dict[str, tuple[tuple[str, str], ...]]
    """Id of a printed parameter -> (title, text) of its help and its page."""
    family_id: str = ""
    file_data: dict[str, str | bool | None] = field(default_factory=dict)
    """Of the file: checksum, signature, unit system, as data."""
    totals: dict[str, int] = field(default_factory=dict)
    """The counts of the cover as data."""
    checks: tuple[CheckedMotion, ...] = ()
    """Every scenario that the file allows, where that chapter is asked for."""
    programs: tuple[PrintedProgram, ...] = ()
    """The part programs that were given."""
    machine_file: str = ""
    """The parameter file that is printed, without its secrets."""

    @property
    def program_figures(self) -> tuple[PrintedFigure, ...]:
        """Their paths."""
        words = language_of(self.contents.language, self.family_id)
        return tuple(
            PrintedFigure(each.name, each.svg, tuple(map(words.sentence, each.notes)))
            for each in self.programs
        )

    @property
    def check_figures(self) -> tuple[PrintedFigure, ...]:
        """The pictures of the check in motion."""
        words = language_of(self.contents.language, self.family_id)
        return tuple(
            PrintedFigure(each.title, each.svg, tuple(map(words.sentence, each.notes)))
            for check in self.checks
            for each in check.drawings
        )

    @property
    def machine_name(self) -> str:
        """The name of the parameter file that a PDF has with it."""
        return self.file_name or f"{self.title}.amp"

    @property
    def subject(self) -> str:
        """What the report is about, in a line."""
        text = language_of(self.contents.language).text
        return f"{text('Machine parameters')} {text(self.order)}, {self.family}"

    @property
    def keywords(self) -> tuple[str, ...]:
        """By what a search finds it: family, machine and file."""
        return tuple(dict.fromkeys(filter(None, (self.family, self.title, self.file_name))))

    @property
    def order(self) -> str:
        """The order in words."""
        return SORTS[self.contents.sort]

    @property
    def when(self) -> str:
        """Date and time in printed form."""
        return language_of(self.contents.language).moment(self.date)

    @property
    def lies_across(self) -> bool:
        """Whether its widest grid needs landscape paper."""
        grids = (p for section in self.sections for p in section.parts if isinstance(p, Grid))
        return max((len(g.columns) for g in grids), default=0) >= _MANY_AXES

    def fact(self, name: str, body: str, text: Callable[[str], str]) -> str:
        """Return a fact in the language of ``text``; what a person wrote stays as it is."""
        return text(body) if name in _OWN_FACTS else body

    def rows(self) -> Iterator[ReportRow]:
        """Yield all printed values in the order of the report."""
        for section in self.sections:
            for part in section.parts:
                yield from part.rows

    def severities(self) -> dict[PrintedSeverity, tuple[PrintedFinding, ...]]:
        """Return the findings by severity, errors first, suppressed ones last; empty severities are left
        out.
        """
        names: tuple[PrintedSeverity, ...] = ("error", "warning", "advice", "suppressed")
        found = {name: tuple(n for n in self.notes if n.severity == name) for name in names}
        return {name: notes for name, notes in found.items() if notes}
