"""What a report contains, chosen in one place for the Report dialog and for the preview,
and kept for the next time.
"""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QCheckBox, QComboBox, QFormLayout, QLabel, QVBoxLayout, QWidget

from amp_studio.languages import language_codes, name_of_language
from amp_studio.report import CHAPTERS, PAPER_SIZES, SORTS, UNIT_CHOICES, Chapter, Contents
from amp_studio.ui.base.theme import GAP
from amp_studio.ui.base.translated import language_in_use

from .settings import UserSettings


class ReportChoice(QObject):
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
            next((each for each in SORTS if each == sort), "group"),
            kept.get("changed") == "yes",
            kept.get("inactive") == "yes",
            next((each for each in UNIT_CHOICES if each == units), "file"),
            language if language in language_codes() else language_in_use(self._settings.language()),
            frozenset(each for each in CHAPTERS if each in without),
            next((each for each in PAPER_SIZES if each == paper), "a4"),
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
                "language": "" if contents.language == of_window else contents.language,
                "changed": "yes" if contents.changed_only else "no",
                "inactive": "yes" if contents.inactive else "no",
                "without": ",".join(sorted(contents.without)),
            }
        )
        self.changed.emit()


class ReportOptions(QWidget):
    """The fields of it."""

    chosen = Signal()
    """A person has changed a field."""

    def __init__(self, contents: Contents, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.sort = _box(
            {
                "group": self.tr("By group"),
                "number": self.tr("By parameter number"),
                "axis": self.tr("Axis and non-axis parameters"),
                "steps": self.tr("By step of commissioning"),
            }
        )
        self.units = _box(
            {
                "file": self.tr("As in the file"),
                "metric": self.tr("Metric"),
                "inch": self.tr("Inch"),
                "both": self.tr("Both, the other system's below"),
            }
        )
        self.language = _box({code: name_of_language(code) for code in language_codes()})
        self.paper = _box({"a4": "A4", "letter": self.tr("US Letter")})
        self.changed = QCheckBox(self.tr("Only values that &differ from the default"))
        self.inactive = QCheckBox(self.tr("Also what the control &ignores on this machine"))
        named = {
            "pictures": self.tr("Pi&ctures"),
            "motion": self.tr("&Motion, simulated"),
            "power-up": self.tr("Part pro&grams after power-up"),
            "exchanges": self.tr("E&xchanges with controls"),
            "signatures": self.tr("&Signatures"),
        }
        self.chapters: dict[Chapter, QCheckBox] = {each: QCheckBox(named[each]) for each in CHAPTERS}
        self.form = form = QFormLayout(self)
        form.setContentsMargins(0, 0, 0, 0)
        for label, field in (
            (self.tr("&Order"), self.sort),
            (self.tr("&Units"), self.units),
            (self.tr("&Language"), self.language),
            (self.tr("P&aper"), self.paper),
        ):
            form.addRow(label, field)
            field.currentIndexChanged.connect(lambda _: self.chosen.emit())
        chapters = QWidget()
        column = QVBoxLayout(chapters)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(GAP)
        for box in self.chapters.values():
            column.addWidget(box)
        form.addRow("", self.changed)
        form.addRow("", self.inactive)
        form.addRow(QLabel(self.tr("Chapters")), chapters)
        for box in (self.changed, self.inactive, *self.chapters.values()):
            box.toggled.connect(lambda _: self.chosen.emit())
        self.show_contents(contents)

    def show_contents(self, contents: Contents) -> None:
        """Show a choice without telling anybody."""
        self.blockSignals(True)
        for box, key in (
            (self.sort, contents.sort),
            (self.units, contents.units),
            (self.language, contents.language),
            (self.paper, contents.paper),
        ):
            box.setCurrentIndex(max(box.findData(key), 0))
        self.changed.setChecked(contents.changed_only)
        self.inactive.setChecked(contents.inactive)
        for chapter, check in self.chapters.items():
            check.setChecked(chapter not in contents.without)
        self.blockSignals(False)

    def contents(self) -> Contents:
        """Return what is chosen."""
        return Contents(
            self.sort.currentData(),
            self.changed.isChecked(),
            self.inactive.isChecked(),
            self.units.currentData(),
            self.language.currentData(),
            frozenset(chapter for chapter, box in self.chapters.items() if not box.isChecked()),
            self.paper.currentData(),
        )


def _box(names: Mapping[str, str]) -> QComboBox:
    box = QComboBox()
    for key, name in names.items():
        box.addItem(name, key)
    return box
