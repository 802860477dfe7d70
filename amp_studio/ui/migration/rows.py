"""What a migration lists: each active parameter of the old file once, below what became of it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QTreeWidget, QTreeWidgetItem, QWidget

from amp_studio.meaning import MigratedParameter, Migration
from amp_studio.ui.base.theme import Token, font, icon
from amp_studio.ui.base.translated import tr

_MAX_OLD, _MAX_MEANING, _MIN_COLUMN = 460, 280, 120
"""Widths of the columns as the window opens: at most, and at least."""
_AS_WRITTEN = ("key", "value", "raw", "id", "page", "answer")
"""Facts of an entry that are no words: they stay as file and control have them."""


@dataclass(frozen=True)
class MigrationRow:
    """One parameter: ``old`` and ``new`` as each control has it, ``meaning`` between them, and ``why``."""

    parameter: str
    old: str
    meaning: str
    new: str
    why: str


def outcomes() -> dict[str, tuple[str, str, Token]]:
    """Return what can become of a parameter: its title, icon and colour, what needs a person first."""
    return {
        "asked": (tr("Asked"), "question", "warn"),
        "not_possible": (tr("Not possible"), "x-circle-fill", "error"),
        "approximate": (tr("Approximated"), "warning-fill", "warn"),
        "exact": (tr("Taken over exactly"), "check-circle-fill", "text"),
        "old_hardware": (tr("Of the old hardware"), "circle-dashed", "dim"),
    }


def meanings() -> dict[str, str]:
    """Return the concepts of a machine in words."""
    return {
        "kind": tr("linear or rotary"),
        "travel.kind": tr("kind of travel limits"),
        "travel.low": tr("low end of travel"),
        "travel.high": tr("high end of travel"),
        "rollover": tr("rollover"),
        "rapid": tr("rapid speed"),
        "ramp.kind": tr("kind of ramp"),
        "acceleration": tr("acceleration"),
        "jerk": tr("jerk"),
        "error.limit": tr("limit of the following error"),
        "gain": tr("position loop gain"),
        "feed_forward": tr("feed forward"),
        "backlash": tr("backlash"),
        "scale": tr("scale of the feedback"),
        "output.sign": tr("sign of the output"),
        "home.kind": tr("kind of homing"),
        "home.coordinate": tr("position at home"),
        "home.offset": tr("offset of home"),
        "home.search": tr("speed towards the home switch"),
        "home.leave": tr("speed off the home switch"),
        "home.towards": tr("direction of homing"),
        "home.first": tr("reference position"),
        "home.second": tr("second home position"),
        "work.offsets": tr("work offsets"),
        "feed.ceiling": tr("greatest feedrate"),
        "jog": tr("jog speed"),
        "spindle.greatest": tr("greatest spindle speed"),
        "spindle.least": tr("least spindle speed"),
        "tool.radius": tr("tool radii"),
        "tool.wear": tr("wear of the tools"),
        "startup": tr("codes active after power-up"),
    }


def rows_of(
    migration: Migration, label: Callable[[MigratedParameter], str], sentence: Callable[[str], str]
) -> Iterator[MigrationRow]:
    """Yield the row of each entry, in their order; ``label`` names a parameter of the old file,
    ``sentence`` returns the words of one in the language of the window.
    """
    words = meanings()
    for entry in migration.entries:
        facts = {
            key: str(value) if key in _AS_WRITTEN else sentence(str(value))
            for key, value in entry.facts.items()
            if value is not None
        }
        concepts = dict.fromkeys(f"{letter} {words[concept]}".strip() for letter, concept in entry.meanings)
        key, value = facts.get("key", ""), facts.get("value", "")
        new = f"{key} = {value}" if key else facts.get("answer", "")
        old = facts.get("raw") or facts.get("old", "")
        yield MigrationRow(
            entry.address[0], f"{label(entry)}: {old}", ", ".join(concepts), new, _why(entry, facts)
        )


def _why(entry: MigratedParameter, facts: dict[str, str]) -> str:
    """Return how a parameter went over, or why it did not."""
    page = f" ({tr('page {page}').format(page=facts['page'])})" if facts.get("page") else ""
    if entry.outcome == "exact":
        return f"{facts['formula']}{page}"
    if entry.outcome == "approximate":
        text = tr("Before: {old}. Now: {new}. Safe: {side}.")
        return text.format(old=facts["old"], new=facts["new"], side=facts["safe_side"]) + page
    if entry.outcome == "not_possible":
        return f"{facts['loses']}; {facts['do']}{page}"
    return facts["id"] if entry.outcome == "asked" else ""


class MigrationTree(QTreeWidget):
    """Old, meaning, new, in one line each; the outcomes are heads that fold."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setHeaderLabels([tr("Old"), tr("Meaning"), tr("New")])
        self.setAccessibleName(tr("Parameters and what becomes of them"))
        self.setUniformRowHeights(True)
        self.setAlternatingRowColors(True)
        self._folded = {"exact", "old_hardware"}
        self._is_sized = False

    def show_migration(
        self, migration: Migration, label: Callable[[MigratedParameter], str], sentence: Callable[[str], str]
    ) -> None:
        """List a migration; what was folded, and the place in the list, stay."""
        for item in self._heads():
            outcome = item.data(0, Qt.ItemDataRole.UserRole)
            (self._folded.discard if item.isExpanded() else self._folded.add)(outcome)
        place = self.verticalScrollBar().value()
        self.clear()
        rows = list(zip(migration.entries, rows_of(migration, label, sentence), strict=True))
        for outcome, (title, mark, shade) in outcomes().items():
            own = [row for entry, row in rows if entry.outcome == outcome]
            if own:
                self._add(outcome, f"{title} ({len(own)})", mark, shade, own)
        if not self._is_sized and rows:
            self._is_sized = True  # once: what a person has made of the columns stays
            for column, most in ((0, _MAX_OLD), (1, _MAX_MEANING)):
                self.resizeColumnToContents(column)
                self.setColumnWidth(column, min(most, max(_MIN_COLUMN, self.columnWidth(column))))
        self.verticalScrollBar().setValue(place)

    def _heads(self) -> Iterator[QTreeWidgetItem]:
        for n in range(self.topLevelItemCount()):
            if (item := self.topLevelItem(n)) is not None:
                yield item

    def _add(self, outcome: str, title: str, mark: str, shade: Token, rows: list[MigrationRow]) -> None:
        head = QTreeWidgetItem(self, [title])
        head.setData(0, Qt.ItemDataRole.UserRole, outcome)
        head.setIcon(0, icon(mark, shade))
        head.setFont(0, font("text", own=True))
        head.setFirstColumnSpanned(True)
        for row in rows:
            item = QTreeWidgetItem(head, [row.old, row.meaning, row.new])
            item.setData(0, Qt.ItemDataRole.UserRole, row)
            for column, text in enumerate((row.old, row.meaning, row.new)):
                item.setToolTip(column, text)
        head.setExpanded(outcome not in self._folded)

    def row(self) -> MigrationRow | None:
        """Return the current row, None on a head."""
        item = self.currentItem()
        found = item.data(0, Qt.ItemDataRole.UserRole) if item is not None else None
        return found if isinstance(found, MigrationRow) else None
