"""The tree of a comparison: the groups of the manual,
and in each a row for every value with all sources and the result.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from PySide6.QtCore import QAbstractItemModel, QModelIndex, Qt, Signal

from amp_studio.drawing import THIN
from amp_studio.files import (
    ENTRIES,
    FACTS,
    HEADER_TEXTS,
    NOTES,
    Merge,
    MergeChoice,
    Row,
    RowGroup,
    RowId,
    Typed,
    axis_letters,
)
from amp_studio.schema import Value, fault, read_address, read_real, read_value, same_value, visible, whole_of
from amp_studio.ui.base.figures import as_tip
from amp_studio.ui.base.model_index import ModelIndex

from .cells import MergeCell, cells_of
from .columns import AXIS, BASE, NAME, RESULT, SIDES, A, B

_TYPABLE = (*HEADER_TEXTS, "value_notes", "group_notes")
"""Entries of the header that are free texts."""


@dataclass(frozen=True)
class Filter:
    """Which rows are shown."""

    text: str = ""
    only_differences: bool = True
    only_conflicts: bool = False
    only_active: bool = False


class MergeModel(QAbstractItemModel):
    """Groups and rows of one merge. The text of a cell is in one unit for all sources of its row."""

    chosen = Signal()
    """What the result takes has changed."""

    def __init__(self, merge: Merge, *, units: str | None, secrets: bool) -> None:
        super().__init__()
        self.merge = merge
        self.units = units
        """Unit system of the figures; None as they were entered."""
        self.secrets = secrets
        self.filter = Filter()
        self.groups: list[RowGroup] = []
        self._letters: dict[str, str] = {}
        self._words: dict[RowId, str] = {}
        self._cells: dict[RowId, dict[int, MergeCell]] = {}
        self._result = merge.result()
        self.set_merge(merge)

    # -- what is shown -------------------------------------------------------------

    def set_merge(self, merge: Merge) -> None:
        """Show another merge."""
        self.beginResetModel()
        self.merge = merge
        self._result = merge.result()
        self._letters = axis_letters(merge.a)
        self._words.clear()
        self._cells.clear()
        self.groups = merge.grouped(self._visible_rows())
        self.endResetModel()

    def show_only(self, wanted: Filter) -> None:
        """Show only some of the rows."""
        self.beginResetModel()
        self.filter = wanted
        self.groups = self.merge.grouped(self._visible_rows())
        self.endResetModel()

    def show_in(self, units: str | None, *, secrets: bool) -> None:
        """Show figures in another unit system, and secrets in clear or masked."""
        self.units, self.secrets = units, secrets
        self._cells.clear()
        self._refresh_all()

    def _visible_rows(self) -> Iterable[Row]:
        wanted = self.filter
        rows: Iterable[Row] = self.merge.differing if wanted.only_differences else self.merge.rows
        if wanted.only_conflicts:
            rows = self.merge.conflicts
        words = wanted.text.casefold().split()
        if words:
            rows = [row for row in rows if all(word in self._searched(row) for word in words)]
        if wanted.only_active:
            rows = filter(self._is_active, rows)
        return rows

    def _is_active(self, row: Row) -> bool:
        """Return whether a row is an active value, or none."""
        is_value, state = row.id.part == "value", self.merge.a.evaluation.state
        return not is_value or (row.address in self._places and state(row.address).is_active)

    @property
    def _places(self) -> Any:
        return self.merge.a.machine_schema.places

    def _searched(self, row: Row) -> str:
        words = self._words.get(row.id)
        if words is None:
            words = f"{self.number(row)} {self.name(row)} {self.axis(row)} {row.address[0]}".casefold()
            # Once a row: the filter asks at every key.
            self._words[row.id] = words
        return words

    # -- a row in words --------------------------------------------------------------

    def number(self, row: Row) -> str:
        """Return the number that the manual prints for a row; empty where there is none."""
        here = self.merge.a.machine_schema
        if row.id.part != "value" or here.is_disputed(row.address[0]):
            return ""
        return here.number(row.address) or ""

    def name(self, row: Row) -> str:
        """Return the name of a row."""
        if row.id.part == "value":
            return self.merge.a.schema.parameters[row.address[0]].name
        return self._header_name(row) if row.id.part == "header" else visible(row.id.key)

    def _header_name(self, row: Row) -> str:
        """Return what an entry of the header is: a fact of the machine, a note, a step that was ticked."""
        names = {
            "application": self.tr("Application"),
            "revision": self.tr("Control software revision"),
            "notes": self.tr("Notes"),
            "machine": self.tr("Machine type"),
        }
        kind, key = row.address
        if kind == "value_notes":
            address, here = read_address(key), self.merge.a.machine_schema
            label = here.label(address) if address in here.places else visible(key)
            return self.tr("Note on {parameter}").format(parameter=label)
        if kind == "group_notes":
            groups = {group.key: group.name for group in self.merge.a.schema.groups}
            return self.tr("Note on {parameter}").format(parameter=groups.get(key, visible(key)))
        if kind == "done":
            return self.tr("Step {step} ticked as done").format(step=visible(key))
        return names.get(kind, visible(key or kind))

    def axis(self, row: Row) -> str:
        """Return the axis of a row by its letter, or what else its instance is; empty for the only one."""
        here, address = self.merge.a.machine_schema, row.address
        if row.id.part != "value" or not address[1]:
            return ""
        if address[0] in here.scopes and here.kin(here.scopes[address[0]], "axis"):
            whole = whole_of(address[1])
            return self._letters.get(whole, whole) + address[1][len(whole) :]
        return address[1]

    def cell(self, row: Row, column: int) -> MergeCell:
        """Return the value of a source, or of the result, as it is shown."""
        cells = self._cells.get(row.id)
        if cells is None:
            values = (row.base, row.a, row.b, self.result_of(row))
            made = cells_of(self.merge, row, values, units=self.units, secrets=self.secrets)
            cells = self._cells[row.id] = dict(zip((BASE, A, B, RESULT), made, strict=True))
        return cells[column]

    def result_of(self, row: Row) -> Value | None:
        """Return what the result really has: on an axis that begins to turn, the figure in degrees."""
        return self._result.get(row.address) if row.id.part == "value" else self.merge.result_of(row)

    def is_refitted(self, row: Row) -> bool:
        """Return whether a value has another unit in the result than where it was taken."""
        return not same_value(self.result_of(row), self.merge.result_of(row))

    def text_to_edit(self, row: Row) -> str:
        """Return the result as it is typed: plain figures with their unit; empty for a masked secret."""
        if (
            row.id.part == "value"
            and self.merge.a.schema.parameters[row.address[0]].secret
            and not self.secrets
        ):
            return ""
        value = self.result_of(row)
        cell = self.cell(row, RESULT)
        return "" if value is None else (cell.typed or cell.whole).replace(THIN, "")

    def read(self, row: Row, text: str) -> Typed:
        """Read what was typed for the result; raises ValueError with what is allowed."""
        if row.id.part != "value":
            if not text.isprintable():
                raise ValueError(self.tr("The text contains a character that no file can contain."))
            return Typed(Value(text.strip()) if text.strip() else None)
        if not text.strip():
            return Typed(None)
        file, parameter = self.merge.a, self.merge.a.schema.parameters[row.address[0]]
        unit = self._unit_of(row)
        value = read_real(file.evaluation, row.address, text, unit) or read_value(parameter, text, unit)
        message = fault(file.evaluation, row.address, value)
        if message:
            raise ValueError(message)
        return Typed(value)

    def may_type(self, row: Row) -> bool:
        """Return whether a value can be typed for a row: a parameter of this machine type, or a note."""
        if row.id.part == "value":
            return row.kind != "same" and row.address in self._places
        return row.kind != "same" and row.id.part == "header" and row.address[0] in _TYPABLE

    def _unit_of(self, row: Row) -> str:
        """Return the unit in which a row is shown, which is meant by a number without one."""
        usual = self.merge.a.evaluation.unit(row.address, self.units or self.merge.a.header.units)
        # A unit system that was chosen has precedence; else the unit of the values that are there.
        if self.units is not None:
            return usual
        return next(
            (v.unit for v in (self.merge.result_of(row), row.a, row.b) if v is not None and v.unit), usual
        )

    # -- choosing --------------------------------------------------------------------

    def choose(self, rows: Iterable[Row], choice: MergeChoice | None) -> None:
        """Take a side, a typed value or the default again for rows;
        those that are the same have nothing to choose.
        """
        changed = [
            # Without a base there is nothing of it to take.
            row
            for row in rows
            if row.kind != "same" and (choice != "base" or self.merge.base is not None)
        ]
        for row in changed:
            self.merge.choose(row, choice)
            self._cells.pop(row.id, None)
        # A choice may change more than its row: the values of an axis that begins to turn get other units.
        others = self._make_result() - {row.id for row in changed}
        is_one = len(changed) == 1 and not others
        first = self.index_of(changed[0].id, NAME) if is_one else QModelIndex()
        # One row is painted again, not the tree: choosing with the keys goes through hundreds.
        if first.isValid():
            self.dataChanged.emit(first, first.siblingAtColumn(RESULT))
        else:
            self._refresh_all()
        self.chosen.emit()

    def _make_result(self) -> set[RowId]:
        """Make the result again; returns the values that are another one,
        also those whose unit follows their axis.
        """
        before, self._result = self._result.values, self.merge.result()
        after = self._result.values
        stale = {RowId("value", a) for a in {*before, *after} if before.get(a) != after.get(a)}
        for row_id in stale:
            self._cells.pop(row_id, None)
        return stale

    def _refresh_all(self) -> None:
        for n, group in enumerate(self.groups):
            parent = self.index(n, NAME)
            self.dataChanged.emit(parent, self.index(n, RESULT))
            if group.rows:
                last = self.index(len(group.rows) - 1, RESULT, parent)
                self.dataChanged.emit(self.index(0, NAME, parent), last)

    # -- Qt --------------------------------------------------------------------------

    def group_at(self, index: ModelIndex) -> RowGroup | None:
        """Return the group of a head; None for a row."""
        return self.groups[index.row()] if index.isValid() and index.internalId() == 0 else None

    def row_at(self, index: ModelIndex) -> Row | None:
        """Return the row of an index; None for the head of a group."""
        if not index.isValid() or index.internalId() == 0:
            return None
        return self.groups[int(index.internalId()) - 1].rows[index.row()]

    def index_of(self, row_id: RowId, column: int = RESULT) -> QModelIndex:
        """Return where a row is shown; invalid where it is not."""
        for n, group in enumerate(self.groups):
            for m, row in enumerate(group.rows):
                if row.id == row_id:
                    return self.index(m, column, self.index(n, NAME))
        return QModelIndex()

    def index(self, row: int, column: int, parent: ModelIndex = QModelIndex()) -> QModelIndex:  # noqa: B008  # Qt's own signature
        if not self.hasIndex(row, column, parent):
            return QModelIndex()
        # The number is that of the group, from 1: 0 is the head of a group itself.
        return self.createIndex(row, column, parent.row() + 1 if parent.isValid() else 0)

    def parent(self, index: ModelIndex = QModelIndex()) -> QModelIndex:  # type: ignore[override]  # noqa: B008  # Qt's own signature
        if not index.isValid() or index.internalId() == 0:
            return QModelIndex()
        return self.createIndex(int(index.internalId()) - 1, NAME, 0)

    def rowCount(self, parent: ModelIndex = QModelIndex()) -> int:  # noqa: B008  # Qt's own signature
        if not parent.isValid():
            return len(self.groups)
        return len(self.groups[parent.row()].rows) if parent.internalId() == 0 and parent.column() == 0 else 0

    def columnCount(self, parent: ModelIndex = QModelIndex()) -> int:  # noqa: B008  # Qt's own signature
        return RESULT + 1

    def flags(self, index: ModelIndex) -> Qt.ItemFlag:
        flags = super().flags(index)
        row = self.row_at(index)
        if row is not None and index.column() == RESULT and self.may_type(row):
            flags |= Qt.ItemFlag.ItemIsEditable
        return flags

    def headerData(
        self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole
    ) -> Any:
        if role != Qt.ItemDataRole.DisplayRole or orientation != Qt.Orientation.Horizontal:
            return None
        names = (self.tr("Parameter"), self.tr("Axis"), "0", "A", "B", self.tr("Result"))
        return names[section]

    def data(self, index: ModelIndex, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        group, row, column = self.group_at(index), self.row_at(index), index.column()
        if group is not None:
            is_text = role in (Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.AccessibleTextRole)
            return self.group_text(group) if is_text and column == NAME else None
        if row is None:
            return None
        if role == Qt.ItemDataRole.DisplayRole:
            return self.text(row, column)
        if role == Qt.ItemDataRole.EditRole:
            return self.text_to_edit(row)
        if role == Qt.ItemDataRole.ToolTipRole:
            return as_tip(self.text(row, column))
        if role == Qt.ItemDataRole.AccessibleTextRole:
            return self._accessible_text(row, column)
        return None

    def text(self, row: Row, column: int) -> str:
        """Return the text of a cell."""
        if column == NAME:
            return f"{self.number(row)} {self.name(row)}".strip()
        if column == AXIS:
            return self.axis(row)
        if column == RESULT and self.merge.choice(row) is None:
            return self.tr("Both changed: choose")
        return self.cell(row, column).whole

    def group_text(self, group: RowGroup) -> str:
        """Return the head of a group with how many of its rows differ."""
        differ = sum(row.kind != "same" for row in group.rows)
        own = {
            FACTS: self.tr("Machine facts"),
            NOTES: self.tr("Notes and ticks"),
            ENTRIES: self.tr("Entries that this family does not know"),
        }
        title = own.get(group.title, group.title)
        text = self.tr("%n differ", "", differ)
        if group.conflicts:
            text += ", " + self.tr("%n conflicts", "", group.conflicts)
        return f"{title}  {text}"

    def _accessible_text(self, row: Row, column: int) -> str:
        """Return a cell for a screen reader: whose value it is, and whether the result takes it."""
        text = self.text(row, column)
        if column in SIDES:
            taken = self.merge.choice(row) == SIDES[column] and row.kind != "same"
            name = self.tr("base") if column == BASE else "A" if column == A else "B"
            return f"{name}: {text}, {self.tr('taken')}" if taken else f"{name}: {text}"
        return f"{self.tr('Result')}: {text}" if column == RESULT else text
