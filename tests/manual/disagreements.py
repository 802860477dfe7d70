"""Places where a manual and the database say different things,
and those that an exception covers with its reason.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from manual_facts import Section
from pydantic import TypeAdapter
from ruamel.yaml import YAML

NOWHERE = "says nothing"


@dataclass(frozen=True)
class Disagreement:
    """One place where manual and database say different things."""

    check: str
    line: int
    """Line of the manual's text; 0 where the database has something that is printed nowhere."""
    about: str
    """A parameter's number or id."""
    section: str
    manual: str
    database: str

    def __str__(self) -> str:
        where = f"line {self.line}, {self.section}" if self.line else self.section
        return f"{self.check}: {self.about} ({where}): manual {self.manual}; database {self.database}"


def at_line(check: str, section: Section, line: int, about: str, manual: str, database: str) -> Disagreement:
    """Return a disagreement on what a line of a section prints."""
    return Disagreement(check, line, about, f"{section.page} {section.heading}", manual, database)


def nowhere(check: str, about: str, database: str, among: str = "the whole text") -> Disagreement:
    """Return a disagreement on what is in the database and printed nowhere."""
    return Disagreement(check, 0, about, among, NOWHERE, database)


@dataclass(frozen=True, kw_only=True)
class Exempt:
    """A place of the manual that no rule can judge, and why; it must be needed on every line of its span."""

    check: str
    lines: str
    """``1754``, or ``1754-1761``; ``0`` where the database has something that is printed nowhere."""
    about: tuple[str, ...] = ()
    """What it is about, where the lines alone do not show it."""
    why: str

    @property
    def span(self) -> range:
        first, _, last = self.lines.partition("-")
        return range(int(first), int(last or first) + 1)

    def needed_for(self) -> Iterator[tuple[int, str]]:
        """Yield every line and subject that must have a disagreement."""
        yield from ((line, about) for line in self.span for about in self.about or ("",))

    def covers(self, found: Disagreement) -> bool:
        """Return whether a disagreement is excused."""
        return (
            found.check == self.check
            and found.line in self.span
            and (not self.about or found.about in self.about)
        )


def exemptions(path: Path) -> tuple[Exempt, ...]:
    """Return the hand-kept list of a family."""
    return TypeAdapter(tuple[Exempt, ...]).validate_python(
        YAML(typ="safe").load(path.read_text("utf-8")) or ()
    )


def unsettled(check: str, found: Iterable[Disagreement], exempt: Iterable[Exempt]) -> list[str]:
    """Return the disagreements no exception covers, and the exceptions that are not needed any more."""
    found, exempt = list(found), [e for e in exempt if e.check == check]
    open_ones = [str(one) for one in found if not any(e.covers(one) for e in exempt)]
    return open_ones + [
        f"{check}: the exception for line {line} {about}".rstrip() + " is not needed any more"
        for e in exempt
        for line, about in e.needed_for()
        if not any(e.covers(one) and one.line == line and about in {"", one.about} for one in found)
    ]
