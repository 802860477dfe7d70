"""The parameter groups beside the table: areas, groups and their sections."""

from __future__ import annotations

from collections import Counter

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHeaderView, QTreeWidgetItem, QWidget

from amp_studio.schema import Group, Parameter
from amp_studio.ui.base.layout import in_column
from amp_studio.ui.base.translated import counted
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.forms.place_tree import COUNTS, RIGHT, TOKEN, PlaceTree
from amp_studio.validate import NOT_SET, SEVERITIES

_KEYS = Qt.ItemDataRole.UserRole
_ALL = "*"


class GroupList(QWidget):
    """Chooses which parameters the table shows."""

    chosen = Signal(str, list)
    """Title and parameters."""

    def __init__(self, workspace: Workspace, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._workspace = workspace
        self.tree = PlaceTree(self)
        self.tree.setColumnCount(3)
        self.tree.setAccessibleName(self.tr("Parameter groups"))
        in_column(self.tree, on=self, margins=0, gap=0)
        self.setFocusProxy(self.tree)
        self._items: list[QTreeWidgetItem] = []
        self._counted: dict[int, tuple[tuple[tuple[str, int], ...], int]] = {}
        """Place in ``_items`` -> the counts that it has."""
        self._machine = workspace.file.machine
        self._fill()
        self.tree.currentItemChanged.connect(self.choose)
        self.tree.itemClicked.connect(self.choose)
        self._follows = True
        workspace.changed.connect(self._follow)

    def follow_edits(self, follows: bool) -> None:
        """Keep the counts up to date, or leave them until they are seen."""
        if follows and not self._follows:
            self.update_counts()
        self._follows = follows

    def _fill(self) -> None:
        schema = self._workspace.file.schema
        self._add(None, self.tr("All parameters"), [_ALL])
        areas = [(area.name, area.groups) for area in schema.family.areas]
        by_key = {group.key: group for group in schema.groups}
        for name, keys in areas or [("", tuple(by_key))]:
            head = self._add_head(name) if name else None
            self._add_groups(head, [by_key[key] for key in keys if key in by_key])
        self.tree.expandAll()
        header = self.tree.header()
        header.setStretchLastSection(False)
        header.setMinimumSectionSize(8)
        header.setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        for column in (1, 2):  # for who reads the tree without seeing it
            header.hideSection(column)
        self.update_counts()
        self._hide_empty()
        self.tree.setCurrentItem(next(filter(_has_values, self._items[1:])))

    def _add_head(self, name: str) -> QTreeWidgetItem:
        """Add an area: a head over its groups, no page."""
        head = self._add(None, name, [])
        head.setFlags(Qt.ItemFlag.ItemIsEnabled)
        head.setData(0, TOKEN, "dim")
        return head

    def _add_groups(self, head: QTreeWidgetItem | None, groups: list[Group]) -> None:
        """Add groups under an area, those of one name as one with its sections below it."""
        by_name: dict[str, list[Group]] = {}
        for group in groups:
            by_name.setdefault(group.name, []).append(group)
        for name, alike in by_name.items():
            item = self._add(head, name, [group.key for group in alike])
            for group in alike if len(alike) > 1 else ():
                self._add(item, group.section or name, [group.key])

    def _hide_empty(self) -> None:
        """Hide the groups of which this machine type, or this control, has no parameter."""
        schema, here = self._workspace.file.schema, self._workspace.file.machine_schema
        present = {schema.group_of[p].key for p, scope in here.scopes.items() if scope is not None}
        groups = {group.key for group in schema.groups}
        for item in self._items:
            keys = set(item.data(0, _KEYS))
            item.setHidden(bool(keys) and keys <= groups and keys.isdisjoint(present))
        for item in self._items:
            if not item.data(0, _KEYS):
                item.setHidden(all(item.child(n).isHidden() for n in range(item.childCount())))

    def _add(self, parent: QTreeWidgetItem | None, text: str, keys: list[str]) -> QTreeWidgetItem:
        item = QTreeWidgetItem([text.removesuffix(" Parameters"), "", ""])
        item.setData(0, _KEYS, keys)
        self._items.append(item)
        item.setToolTip(0, text)
        if parent is None:
            self.tree.addTopLevelItem(item)
        else:
            parent.addChild(item)
        return item

    def update_counts(self) -> None:
        """Show how many findings and open values each group has."""
        found, not_set = self._found(), self._not_set()
        for n, item in enumerate(self._items):
            keys = self._groups_of(item)
            here = Counter(severity for severity, places in found if not keys.isdisjoint(places))
            counts = tuple((severity, here[severity]) for severity in SEVERITIES if here[severity])
            here_now = counts, sum(not_set[key] for key in keys)
            if self._counted.get(n) != here_now:  # an edit changes those of few groups
                self._counted[n] = here_now
                self._show_counts(item, *here_now)

    def _found(self) -> list[tuple[str, set[str]]]:
        """Return the severity of each finding but open values, and the groups that it is about."""
        group_of = self._workspace.file.schema.group_of
        return [
            (finding.severity, {group_of[a[0]].key for a in finding.causes})
            for finding in self._workspace.listed
            if finding.rule != NOT_SET
        ]

    def _not_set(self) -> Counter[str]:
        """Return how many open values each group has."""
        group_of = self._workspace.file.schema.group_of
        steps = self._workspace.progress.steps
        return Counter(group_of[address[0]].key for step in steps for address in step.open)

    def _groups_of(self, item: QTreeWidgetItem) -> set[str]:
        """Return the keys of the groups that a row is about."""
        keys = set(item.data(0, _KEYS))
        return {group.key for group in self._workspace.file.schema.groups} if keys == {_ALL} else keys

    def _show_counts(self, item: QTreeWidgetItem, counts: tuple[tuple[str, int], ...], missing: int) -> None:
        """Show the findings of a group by severity, and how many of its values are not set."""
        for column, severity in enumerate(SEVERITIES[:2], 1):
            item.setText(column, str(dict(counts).get(severity, "")))
        item.setData(0, COUNTS, counts)
        item.setData(0, RIGHT, str(missing) if missing else "")
        parts = [item.text(0), *(counted(n, severity) for severity, n in counts)]
        parts += [self.tr("%n values not set", "", missing)] if missing else []
        item.setData(0, Qt.ItemDataRole.AccessibleTextRole, ", ".join(parts))

    def _follow(self, *_: object) -> None:
        """Update the counts after the present edit."""
        if self._workspace.file.machine != self._machine:  # another machine type has other groups
            self._machine = self._workspace.file.machine
            self._hide_empty()
        if self._follows:
            self.update_counts()

    # -- choosing --------------------------------------------------------------

    def choose(self, *_: object) -> None:
        """Emit the present choice again."""
        item = self.tree.currentItem()
        if item is not None and item.data(0, _KEYS):
            item.setSelected(True)
            self.chosen.emit(item.toolTip(0), self._parameters(item.data(0, _KEYS)))

    def show_none(self) -> None:
        """Mark no group, while the table shows something else."""
        self.tree.clearSelection()

    def _parameters(self, keys: list[str]) -> list[Parameter]:
        schema = self._workspace.file.schema
        if keys == [_ALL]:
            return list(schema.parameters.values())
        return [p for g in schema.groups if g.key in keys for p in g.parameters]

    def choose_group_of(self, parameter_id: str) -> None:
        """Select the group of a parameter."""
        wanted = self._workspace.file.schema.group_of[parameter_id].key
        for item in self._items:
            if item.data(0, _KEYS) == [wanted]:
                self.tree.setCurrentItem(item)
                self.choose()
                return


def _has_values(item: QTreeWidgetItem) -> bool:
    return not item.isHidden() and bool(item.data(0, _KEYS))
