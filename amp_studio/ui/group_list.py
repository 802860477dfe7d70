"""The parameter groups beside the table: areas, groups and their sections, with a search field over them."""

from __future__ import annotations

from collections import Counter

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QHeaderView, QLineEdit, QTreeWidgetItem, QVBoxLayout, QWidget

from amp_studio.report.wording import counted
from amp_studio.schema import Group, Parameter
from amp_studio.validate import NOT_SET, SEVERITIES

from .place_tree import COUNTS, INK, RIGHT, PlaceTree
from .theme import GAP, GAP2
from .workspace import Workspace

_KEYS = Qt.ItemDataRole.UserRole
_ALL, _CHANGED, _FINDINGS = "*", "changed", "findings"


class _Search(QLineEdit):
    """A search field; Down and Enter move to the results."""

    left = Signal()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Down):
            self.left.emit()
        elif event.key() == Qt.Key.Key_Escape and self.text():
            self.clear()
        else:
            super().keyPressEvent(event)


class GroupList(QWidget):
    """Chooses which parameters the table shows; every word of a search must be found."""

    chosen = Signal(str, list)
    """Title and parameters."""
    left = Signal()
    """Enter was pressed in the search field."""

    def __init__(self, workspace: Workspace) -> None:
        super().__init__()
        self._workspace = workspace
        self.search = _Search()
        self.search.setPlaceholderText("Search  (Ctrl+F)")
        self.search.setClearButtonEnabled(True)
        self.search.setToolTip("Search numbers, names and help texts; every word must be found")
        self.search.setAccessibleName("Search parameters")
        self.search.textChanged.connect(self.choose)
        self.search.left.connect(self.left)
        self.tree = PlaceTree()
        self.tree.setColumnCount(3)
        self.tree.setAccessibleName(self.tr("Parameter groups"))
        layout, above = QVBoxLayout(self), QVBoxLayout()
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        above.setContentsMargins(GAP2, GAP, GAP2, GAP)
        above.addWidget(self.search)
        layout.addLayout(above)
        layout.addWidget(self.tree)
        self.setFocusProxy(self.tree)
        self._items: list[QTreeWidgetItem] = []
        self._machine, self._texts = workspace.file.machine, _search_texts(workspace)
        self._fill()
        self.tree.currentItemChanged.connect(self._choose_group)
        self.tree.itemClicked.connect(self._choose_group)
        self._later = QTimer(self)
        self._later.setSingleShot(True)
        self._later.timeout.connect(self.choose)
        workspace.changed.connect(self._follow)

    def focus_search(self) -> None:
        """Put the cursor into the search field."""
        self.search.setFocus()
        self.search.selectAll()

    def _fill(self) -> None:
        schema = self._workspace.file.schema
        for text, key in (
            ("All parameters", _ALL),
            ("Changed from default", _CHANGED),
            ("With findings", _FINDINGS),
        ):
            self._add(None, text, [key])
        areas = [(area.name, area.groups) for area in schema.family.areas]
        by_key = {group.key: group for group in schema.groups}
        for name, keys in areas or [("", tuple(by_key))]:
            head = self._add_head(name) if name else None
            self._add_groups(head, [by_key[key] for key in keys])
        self.tree.expandAll()
        header = self.tree.header()
        header.setStretchLastSection(False)
        header.setMinimumSectionSize(8)
        header.setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        for column in (1, 2):  # for who reads the tree without seeing it
            header.hideSection(column)
        self.update_counts()
        self._hide_empty()
        self.tree.setCurrentItem(next(i for i in self._items[3:] if not i.isHidden() and i.data(0, _KEYS)))

    def _add_head(self, name: str) -> QTreeWidgetItem:
        """Add an area: a head over its groups, no page."""
        head = self._add(None, name, [])
        head.setFlags(Qt.ItemFlag.ItemIsEnabled)
        head.setData(0, INK, "dim")
        return head

    def _add_groups(self, head: QTreeWidgetItem | None, groups: list[Group]) -> None:
        """Add groups under an area, those of one name as one with its sections below it."""
        by_name: dict[str, list[Group]] = {}
        for group in groups:
            by_name.setdefault(group.name, []).append(group)
        for name, alike in by_name.items():
            item = self._add(head, name, [group.key for group in alike])
            for group in alike if len(alike) > 1 else ():
                self._add(item, group.section, [group.key])

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
        schema = self._workspace.file.schema
        found = [
            (finding.severity, {schema.group_of[a[0]].key for a in finding.causes})
            for finding in self._workspace.listed
            if finding.rule != NOT_SET
        ]
        not_set = Counter(
            schema.group_of[a[0]].key for each in self._workspace.progress.steps for a in each.open
        )
        for item in self._items:
            keys = set(item.data(0, _KEYS))
            counts = {
                s: sum(own == s and not keys.isdisjoint(places) for own, places in found) for s in SEVERITIES
            }
            for column, severity in enumerate(SEVERITIES[:2], 1):
                item.setText(column, str(counts[severity] or ""))
            missing = sum(not_set[key] for key in keys)
            item.setData(0, COUNTS, tuple((s, n) for s, n in counts.items() if n))
            item.setData(0, RIGHT, str(missing) if missing else "")
            parts = [item.text(0), *(counted(n, s) for s, n in counts.items() if n)]
            parts += [self.tr("%n values not set", "", missing)] if missing else []
            item.setData(0, Qt.ItemDataRole.AccessibleTextRole, ", ".join(parts))

    def _follow(self, addresses: list[object]) -> None:
        """Update the counts, and a list that depends on values, after the present edit."""
        if self._workspace.file.machine != self._machine:  # another machine type has other numbers
            self._machine, self._texts = self._workspace.file.machine, _search_texts(self._workspace)
            self._hide_empty()
        self.update_counts()
        item = self.tree.currentItem()
        if (
            item is not None
            and item.data(0, _KEYS)[:1]
            and item.data(0, _KEYS)[0] in (_CHANGED, _FINDINGS)
            and not self.search.text()
        ):
            self._later.start(0)

    # -- choosing --------------------------------------------------------------

    def _choose_group(self, *_: object) -> None:
        if self.search.text():
            self.search.blockSignals(True)
            self.search.clear()
            self.search.blockSignals(False)
        self.choose()

    def choose(self, *_: object) -> None:
        """Emit the present choice again."""
        words = self.search.text().casefold().split()
        item = self.tree.currentItem()
        if item is not None:  # while a search is shown no group is
            item.setSelected(not words)
        if words:
            self.chosen.emit(f"Search: {self.search.text()}", self.found(words))
        elif item is not None and item.data(0, _KEYS):
            self.chosen.emit(item.toolTip(0), self._parameters(item.data(0, _KEYS)))

    def found(self, words: list[str]) -> list[Parameter]:
        """Return the parameters whose numbers, name, id or help contain every word; matches of number and name first."""
        schema = self._workspace.file.schema
        heads, rest = [], []
        for parameter in schema.parameters.values():
            head, text = self._texts[parameter.id]
            if all(word in head for word in words):
                heads.append(parameter)
            elif all(word in text for word in words):
                rest.append(parameter)
        return heads + rest

    def _parameters(self, keys: list[str]) -> list[Parameter]:
        schema, file = self._workspace.file.schema, self._workspace.file
        every = list(schema.parameters.values())
        if keys == [_ALL]:
            return every
        if keys == [_CHANGED]:
            ids = {a[0] for a in file.values if not file.is_default(a)}
            return [p for p in every if p.id in ids]
        if keys == [_FINDINGS]:
            ids = {a[0] for f in self._workspace.listed for a in f.addresses if f.rule != NOT_SET}
            return [p for p in every if p.id in ids]
        return [p for g in schema.groups if g.key in keys for p in g.parameters]

    def choose_group_of(self, parameter_id: str) -> None:
        """Select the group of a parameter."""
        wanted = self._workspace.file.schema.group_of[parameter_id].key
        for item in self._items:
            if item.data(0, _KEYS) == [wanted]:
                self.tree.setCurrentItem(item)
                self._choose_group()
                return


def _search_texts(workspace: Workspace) -> dict[str, tuple[str, str]]:
    """Return two lower-case texts for each parameter: its numbers, id and name, and all of its help."""
    schema, machine = workspace.file.schema, workspace.file.machine
    texts = {}
    for parameter in schema.parameters.values():
        numbers = " ".join(schema.on(machine).numbers(parameter).values())
        choices = " ".join(c.label for c in parameter.choices or ())
        help_text = f"{parameter.help.what} {parameter.help.find} {parameter.help.wrong}"
        head = f"{numbers} {parameter.id} {parameter.name}".casefold()
        texts[parameter.id] = (head, f"{head} {choices} {help_text}".casefold())
    return texts
