"""What a migration lists: each active parameter of the old file once, below what became of it."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from PySide6.QtCore import Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QTreeWidget, QTreeWidgetItem, QWidget

from amp_studio.meaning import MigratedParameter, Migration
from amp_studio.ui.base.theme import Token, font, icon
from amp_studio.ui.base.translated import tr

_MAX_OLD, _MAX_MEANING, _MIN_COLUMN = 460, 280, 120
"""Widths of the columns in a window without room for their texts: at most, and at least."""
_AS_WRITTEN = ("key", "value", "raw", "id", "page", "answer")
"""Facts of an entry that are no words: they stay as file and control have them."""
_QUANTITY = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?: \S+|°)?")
"""A number with its unit, which each language writes in its way."""


@dataclass(frozen=True)
class MigrationRow:
    """One parameter: ``old`` and ``new`` as each control has it, ``meaning`` between them, and ``why``."""

    parameter: str
    old: str
    meaning: str
    new: str
    why: str


def _outcomes() -> dict[str, tuple[str, str, Token]]:
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
        raw = facts.get("raw", "")
        old = (sentence(raw) if _QUANTITY.fullmatch(raw) else raw) or facts.get("old", "")
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
        self._widths: list[int] = []
        """Of old and meaning, as they were given here."""

    def show_migration(
        self, migration: Migration, label: Callable[[MigratedParameter], str], sentence: Callable[[str], str]
    ) -> None:
        """List a migration; what was folded, and the place in the list, stay."""
        for item in self._heads():
            outcome = item.data(0, Qt.ItemDataRole.UserRole)
            # Each answer makes the list again: what was folded by hand stays folded.
            (self._folded.discard if item.isExpanded() else self._folded.add)(outcome)
        place = self.verticalScrollBar().value()
        self.clear()
        rows = list(zip(migration.entries, rows_of(migration, label, sentence), strict=True))
        for outcome, (title, mark, shade) in _outcomes().items():
            own = [row for entry, row in rows if entry.outcome == outcome]
            if own:
                self._add(outcome, f"{title} ({len(own)})", mark, shade, own)
        self._share_room()
        self.verticalScrollBar().setValue(place)

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._share_room()

    def _share_room(self) -> None:
        """Give old and meaning the width of their texts, less where the tree has no room for that; what a
        person has made of the columns stays.
        """
        if self._widths != [self.columnWidth(column) for column in (0, 1)] and self._widths:
            return
        for column in (0, 1):
            self.resizeColumnToContents(column)
        whole = [max(_MIN_COLUMN, self.columnWidth(column)) for column in (0, 1)]
        is_wide = sum(whole) + max(_MIN_COLUMN, self.sizeHintForColumn(2)) <= self.viewport().width()
        self._widths = whole if is_wide else list(map(min, whole, (_MAX_OLD, _MAX_MEANING)))
        for column, width in enumerate(self._widths):
            self.setColumnWidth(column, width)

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
