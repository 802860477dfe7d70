"""A printed report as plain data: what every format writes, with nothing left to look up.

Texts are for a person and not escaped; each format escapes in its own way.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from datetime import datetime
from typing import Literal

from amp_studio.schema.model import Severity, State

Sort = Literal["axis", "number", "group"]
"""The three orders of the documenter (9/PC CNC AMP Reference Manual, Documenting AMP Files)."""

SORTS: dict[Sort, str] = {
    "axis": "by axis, then what belongs to no axis",
    "number": "by parameter number",
    "group": "by group",
}

MARKS: dict[str, str] = {
    "*": "differs from the printed default, or none is printed",
    "!": "forced: set out of range on purpose",
    "i": "ignored by the control for this machine; the reason stands below the table under its number",
    "u": "unusable: another setting forbids it, likewise with its reason",
}


_MANY_AXES = 4


@dataclass(frozen=True, slots=True)
class Row:
    """One addressable value."""

    id: str
    instance: str
    number: str
    """The number that addresses it; empty where it has none of its own."""
    name: str
    group: str
    place: str
    """``Axis 1 X``; empty for a value of the whole control."""
    is_set: bool
    value: str
    """Label or number without its unit; empty when not set."""
    unit: str
    """As the database writes it (``mm/s2``)."""
    shown_unit: str
    """As a person reads it (``mm/s²``)."""
    detail: str
    """What the set bits of a packed word mean; empty for everything else."""
    default: str
    """The printed default, with its unit only where that is not the value's."""
    plain_default: str
    """The default in the unit of the value, for a table that is calculated with."""
    is_changed: bool
    """A value is set, and it is not the printed default."""
    state: State
    why: str
    """Why it is out of force."""
    state_mark: str
    """``i2`` for the second reason of this report why a value is ignored, ``u1`` for unusable; empty in force."""
    forced: str
    """When and by whom it was set out of range on purpose; empty when it was not."""

    @property
    def anchor(self) -> str:
        """What links to this row."""
        return f"{self.id}@{self.instance}"

    @property
    def marks(self) -> str:
        """The marks of ``MARKS`` that this value bears."""
        return ("*" if self.is_changed else "") + self.other_marks

    @property
    def other_marks(self) -> str:
        """Its marks without that of a change, for a format that shows a change by its looks."""
        return ("!" if self.forced else "") + self.state_mark

    @property
    def text(self) -> str:
        """Value and unit; a dash when it is not set."""
        if not self.value:
            return self.bare_text
        return f"{self.value}{'' if self.shown_unit == '°' else ' '}{self.shown_unit}".rstrip()

    @property
    def bare_text(self) -> str:
        """Value without its unit; a dash when it is not set."""
        return self.value or ("(empty)" if self.is_set else "—")


@dataclass(frozen=True, slots=True)
class Line:
    """One line of a grid: a parameter across the axes, or a value that belongs to no axis and spans them."""

    number: str
    name: str
    place: str
    shown_unit: str
    """Of most cells; a cell in another unit writes its own."""
    default: str
    cells: tuple[Row | None, ...]
    """One for each column, None where the parameter does not exist there; a single one when it spans."""
    spans: bool

    @property
    def is_changed(self) -> bool:
        """Whether any of its values differs from the printed default."""
        return any(row.is_changed for row in self.cells if row is not None)

    def cell_text(self, row: Row) -> str:
        """Return what stands in a cell."""
        return row.bare_text if row.shown_unit == self.shown_unit else row.text


@dataclass(frozen=True, slots=True)
class Listing:
    """Values one below the other."""

    title: str
    rows: tuple[Row, ...]
    by_place: bool
    """Whether a column must say where each value belongs."""

    @property
    def reasons(self) -> tuple[tuple[str, str], ...]:
        """The marks of values out of force, and why they are."""
        return _reasons(self.rows)


@dataclass(frozen=True, slots=True)
class Grid:
    """Parameters one below the other, axes side by side, as in the editor."""

    title: str
    columns: tuple[str, ...]
    lines: tuple[Line, ...]

    @property
    def rows(self) -> tuple[Row, ...]:
        """Every value, line by line."""
        return tuple(row for line in self.lines for row in line.cells if row is not None)

    @property
    def reasons(self) -> tuple[tuple[str, str], ...]:
        """The marks of values out of force, and why they are."""
        return _reasons(self.rows)


def _reasons(rows: Iterable[Row]) -> tuple[tuple[str, str], ...]:
    found = {row.state_mark: row.why for row in rows if row.state_mark}
    return tuple(sorted(found.items(), key=lambda item: (item[0][0], int(item[0][1:]))))


@dataclass(frozen=True, slots=True)
class Section:
    """One chapter of the report."""

    key: str
    title: str
    parts: tuple[Listing | Grid, ...]


NoteKind = Severity | Literal["suppressed"]


@dataclass(frozen=True, slots=True)
class Note:
    """One finding, or several that say the same of other axes."""

    severity: NoteKind
    count: int
    place: str
    """``Axis 1 X, 2 Y``; empty for a finding about many values, whose message names the first of them."""
    about: tuple[tuple[str, str], ...]
    """(anchor, label) of the values it is about; an empty anchor where the report does not print the value."""
    message: str
    repair: str
    page: str
    is_own: bool = False
    """It is of a builder's rule: ``page`` is where he wrote it down."""

    @property
    def cited(self) -> str:
        """The page as a sentence says it."""
        return self.page if self.is_own else f"page {self.page}"


@dataclass(frozen=True, slots=True)
class Report:
    """Everything a format writes."""

    title: str
    """The machine's name, or the file's."""
    family: str
    file_name: str
    date: datetime
    program: str
    order: str
    changed_only: bool
    facts: tuple[tuple[str, str], ...]
    counts: tuple[tuple[str, str], ...]
    remarks: str
    """The notes kept in the file."""
    axis_heads: tuple[str, ...]
    axes: tuple[tuple[str, ...], ...]
    notes: tuple[Note, ...]
    forced: tuple[Row, ...]
    not_set: tuple[tuple[str, str, str], ...]
    """(number, parameter, places) of what is in force without a value, one entry a parameter."""
    sections: tuple[Section, ...]

    @property
    def when(self) -> str:
        """Date and time as they are printed."""
        return self.date.strftime("%Y-%m-%d %H:%M")

    @property
    def lies_across(self) -> bool:
        """Whether its widest grid needs the long side of the paper."""
        grids = (p for section in self.sections for p in section.parts if isinstance(p, Grid))
        return max((len(g.columns) for g in grids), default=0) >= _MANY_AXES

    def rows(self) -> Iterator[Row]:
        """Yield every printed value in the order of the report."""
        for section in self.sections:
            for part in section.parts:
                yield from part.rows

    def severities(self) -> dict[NoteKind, tuple[Note, ...]]:
        """Return the findings by severity, errors first, suppressed ones last; no entry for a severity without one."""
        names: tuple[NoteKind, ...] = ("error", "warning", "advice", "suppressed")
        found = {name: tuple(n for n in self.notes if n.severity == name) for name in names}
        return {name: notes for name, notes in found.items() if notes}


SEVERITY_WORDS = {"advice": "recommendation"}
"""What a person reads for a severity whose key is another word."""


def counted(number: int, noun: str) -> str:
    """Return ``1 error``, ``2 errors``, ``3 recommendations``; ``noun`` may be a severity."""
    noun = SEVERITY_WORDS.get(noun, noun)
    if noun == "suppressed":
        return f"{number} suppressed {'finding' if number == 1 else 'findings'}"
    return f"{number} {noun}{'' if number == 1 else 's'}"


def printable(text: str) -> str:
    """Return a text without signs that would steer a printer, a terminal or the direction of writing."""
    return (
        text if text.isprintable() else "".join(c if c.isprintable() or c == "\u00a0" else " " for c in text)
    )
