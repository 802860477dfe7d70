"""What a report contains, chosen in one place for the Report dialog and for the preview,
and kept for the next time.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeVar

from PySide6.QtCore import QObject, Signal

from amp_studio.languages import language_codes, name_of_language
from amp_studio.report import CHAPTERS, PAPER_SIZES, SORTS, UNIT_CHOICES, Contents
from amp_studio.ui.base.translated import language_in_use, tr
from amp_studio.ui.forms.form import Field, FormAnswers

from .settings import UserSettings

_T = TypeVar("_T")


class ReportOptions(QObject):
    """The contents of reports as a person last chose them."""

    changed = Signal()

    def __init__(self, settings: UserSettings, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._settings = settings

    @property
    def contents(self) -> Contents:
        """What is stored; an entry that cannot be used is left out."""
        kept = self._settings.report()
        sort, units, paper, language = (kept.get(name, "") for name in ("sort", "units", "paper", "language"))
        without = kept.get("without", "").split(",")
        return Contents(
            _one_of(sort, SORTS, "group"),
            kept.get("changed") == "yes",
            kept.get("inactive") == "yes",
            _one_of(units, UNIT_CHOICES, "file"),
            language if language in language_codes() else language_in_use(self._settings.language()),
            frozenset(each for each in CHAPTERS if each in without),
            _one_of(paper, PAPER_SIZES, "a4"),
        )

    @contents.setter
    def contents(self, contents: Contents) -> None:
        if contents == self.contents:
            return
        of_window = language_in_use(self._settings.language())
        self._settings.keep_report(
            {
                "sort": contents.sort,
                "units": contents.units,
                "paper": contents.paper,
                # The language of the window is not stored: with another window language reports follow it.
                "language": "" if contents.language == of_window else contents.language,
                "changed": "yes" if contents.changed_only else "no",
                "inactive": "yes" if contents.inactive else "no",
                "without": ",".join(sorted(contents.without)),
            }
        )
        self.changed.emit()


def report_fields(contents: Contents) -> tuple[Field, ...]:
    """Return the fields of what a report contains."""
    given = answers_of(contents)
    sorts = {
        "group": tr("By group"),
        "number": tr("By parameter number"),
        "axis": tr("Axis and non-axis parameters"),
        "steps": tr("By step of commissioning"),
    }
    units = {
        "file": tr("As in the file"),
        "metric": tr("Metric"),
        "inch": tr("Inch"),
        "both": tr("Both, the other system's below"),
    }
    languages = [(code, name_of_language(code)) for code in language_codes()]
    papers = [("a4", "A4"), ("letter", tr("US Letter"))]
    chapters = {
        "pictures": tr("Pi&ctures"),
        "motion": tr("&Motion, simulated"),
        "power-up": tr("Part pro&grams after power-up"),
        "tuning": tr("&Tuning record"),
        "exchanges": tr("E&xchanges with controls"),
        "signatures": tr("&Signatures"),
    }
    return (
        Field("sort", tr("&Order"), "choice", given["sort"], [*sorts.items()]),
        Field("units", tr("&Units"), "choice", given["units"], [*units.items()]),
        Field("language", tr("&Language"), "choice", given["language"], languages),
        Field("paper", tr("P&aper"), "choice", given["paper"], papers),
        Field("changed", tr("Only values that &differ from the default"), "check", given["changed"]),
        Field("inactive", tr("Also what the control &ignores on this machine"), "check", given["inactive"]),
        *(
            Field(each, chapters[each], "check", given[each], head="" if n else tr("Chapters"))
            for n, each in enumerate(CHAPTERS)
        ),
    )


def answers_of(contents: Contents) -> dict[str, object]:
    """Return what the fields show for a choice."""
    return {
        "sort": contents.sort,
        "units": contents.units,
        "language": contents.language,
        "paper": contents.paper,
        "changed": contents.changed_only,
        "inactive": contents.inactive,
        **{chapter: chapter not in contents.without for chapter in CHAPTERS},
    }


def contents_of(given: FormAnswers) -> Contents:
    """Return what is chosen in the fields."""
    without = frozenset(chapter for chapter in CHAPTERS if not given[chapter])
    shared = (given["units"], given["language"], without, given["paper"])
    return Contents(given["sort"], given["changed"], given["inactive"], *shared)


def _one_of(text: str, known: Iterable[_T], otherwise: _T) -> _T:
    """Return which of the known texts one is."""
    return next((each for each in known if each == text), otherwise)
