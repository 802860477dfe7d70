"""A family whose database is compared with its manual: what ``families.py`` records of each."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cache, cached_property
from pathlib import Path
from typing import Any, Generic, NamedTuple, TypeVar

from altered import Alter, altered_schema
from disagreements import Disagreement, Exempt, exemptions
from manual_facts import Section, read
from printed_book import Book

from amp_studio.schema import load_schema

OwnBook = TypeVar("OwnBook", bound=Book)
"""The family's own class of book."""
Check = Callable[[Any], Iterator[Disagreement]]
"""What yields the disagreements of a whole book, which is of the family's own class."""
Judge = Callable[[Any, Section], Iterator[Disagreement]]
"""What yields those of one section."""


class AlteredFact(NamedTuple):
    """Facts of a kind that a check must report when they are altered."""

    check: str
    kind: str
    alter: Alter


class AlteredEntry(NamedTuple):
    """A changed parameter of the database that a check must report, and words of its report."""

    check: str
    parameter: str
    changes: Mapping[str, object]
    told: str = ""


@dataclass(frozen=True, kw_only=True, eq=False)
class Family(Generic[OwnBook]):
    """A family and its manual."""

    key: str
    book_class: type[OwnBook]
    checks: Mapping[str, Check]
    judges: Mapping[str, Judge] = field(default_factory=dict)
    """Check -> what it does with one section; without it an altered fact is judged by the check
    of the whole book."""
    counts: Mapping[str, int]
    """Kind of fact -> how many the manual prints."""
    described: int
    """How many numbers are in the tables that describe parameters."""
    facts: tuple[AlteredFact, ...]
    entries: tuple[AlteredEntry, ...]

    @cached_property
    def book(self) -> OwnBook:
        """The manual beside the database as it is."""
        return self.book_class(load_schema(self.key), printed(self.key))

    @cached_property
    def exempt(self) -> tuple[Exempt, ...]:
        """The hand-kept exceptions."""
        return exemptions(Path(__file__).with_name(f"exceptions_{self.key}.yaml"))

    @cached_property
    def told(self) -> Mapping[str, frozenset[Disagreement]]:
        """Check -> the disagreements as it is, those with an exception too."""
        return {check: frozenset(report(self.book)) for check, report in self.checks.items()}

    def new_with_entry(self, entry: AlteredEntry) -> set[Disagreement]:
        """Return what a changed parameter adds."""
        schema = altered_schema(self.key, entry.parameter, entry.changes)
        other = self.book_class(schema, self.book.sections)
        return set(self.checks[entry.check](other)) - self.told[entry.check]

    def new_with_section(self, check: str, at: int, altered: Section) -> set[Disagreement]:
        """Return what an altered section adds."""
        if judge := self.judges.get(check):
            return set(judge(self.book, altered)) - set(judge(self.book, self.book.sections[at]))
        sections = (*self.book.sections[:at], altered, *self.book.sections[at + 1 :])
        return set(self.checks[check](replace(self.book, sections=sections))) - self.told[check]

    def excused(self, check: str) -> set[int]:
        """Return the lines that exceptions of a check cover."""
        return {line for exempt in self.exempt if exempt.check == check for line in exempt.span}


@cache
def printed(key: str) -> tuple[Section, ...]:
    """Return the facts of a family's manual."""
    return read(Path(__file__).with_name(f"{key}.yaml"))
