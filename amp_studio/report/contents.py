"""What a report contains, in which order, units, language and on which paper:
the choices of the person who prints it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any, Literal

from amp_studio.schema import unknown_name

Sort = Literal["axis", "number", "group", "steps"]
"""The three orders of a report (9/PC CNC AMP Reference Manual, Documenting AMP Files),
and that of commissioning."""

SORTS: dict[Sort, str] = {
    "axis": "by axis, then non-axis parameters",
    "number": "by parameter number",
    "group": "by group",
    "steps": "by step of commissioning",
}

Chapter = Literal["pictures", "motion", "power-up", "tuning", "exchanges", "signatures"]

CHAPTERS: tuple[Chapter, ...] = ("pictures", "motion", "power-up", "tuning", "exchanges", "signatures")
"""Chapters that can be left out of a PDF and of a web page; text and tables have only the last four,
or none."""

UnitChoice = Literal["file", "metric", "inch", "both"]
"""The units of a report: those of the file, one system, or the file's with the other system's beside them."""

UNIT_CHOICES: dict[UnitChoice, str] = {
    "file": "as in the file",
    "metric": "metric",
    "inch": "inch",
    "both": "those of the file, with the other system's below",
}

PaperSize = Literal["a4", "letter"]

PAPER_SIZES: dict[PaperSize, tuple[str, str]] = {"a4": ("a4", "A4"), "letter": ("us-letter", "letter")}
"""The paper of a PDF and of a printed web page -> its name in Typst, and in CSS."""


@dataclass(frozen=True, slots=True)
class Contents:
    """What a report contains, and how."""

    sort: Sort = "group"
    changed_only: bool = False
    """Only what is set and differs from the printed default, or has none."""
    inactive: bool = False
    """Also what the control ignores or cannot use on this machine."""
    units: UnitChoice = "file"
    language: str = "en"
    """Code of the language of the report's own words (``language_codes``)."""
    without: frozenset[Chapter] = frozenset()
    """Chapters that are left out."""
    paper: PaperSize = "a4"
    check: bool = False
    """With a chapter of what `check` finds: every scenario is run for it."""
    programs: tuple[Path, ...] = ()
    """Part programs with a chapter each."""

    def __post_init__(self) -> None:
        if self.sort not in SORTS:
            raise ValueError(f"Unknown order '{self.sort}'. Known: {', '.join(SORTS)}")
        if self.units not in UNIT_CHOICES:
            raise ValueError(f"Unknown units '{self.units}'. Known: {', '.join(UNIT_CHOICES)}")
        if self.paper not in PAPER_SIZES:
            raise ValueError(f"Unknown paper '{self.paper}'. Known: {', '.join(PAPER_SIZES)}")
        if unknown := sorted({*self.without}.difference(CHAPTERS)):
            raise ValueError(f"Unknown chapter '{unknown[0]}'. Known: {', '.join(CHAPTERS)}")
        # A caller may give lists; the fields are read as what they are declared.
        object.__setattr__(self, "without", frozenset(self.without))
        object.__setattr__(self, "programs", tuple(map(Path, self.programs)))

    @property
    def typst_paper(self) -> str:
        """The paper's name in Typst."""
        return PAPER_SIZES[self.paper][0]

    @property
    def css_paper(self) -> str:
        """The paper's name in CSS."""
        return PAPER_SIZES[self.paper][1]

    @property
    def text(self) -> str:
        """The choice in words."""
        which = "active parameters" if not self.inactive else "all parameters"
        return f"{which} that differ from the printed default or have none" if self.changed_only else which


def contents_of(given: Mapping[str, Any]) -> Contents:
    """Return the contents that a script names; raises ValueError for one that there is not."""
    known = [each.name for each in fields(Contents)]
    if unknown := [name for name in given if name not in known]:
        raise ValueError(unknown_name("content of a report", unknown[0], known))
    return Contents(**given)
