"""The left side: a search field over the parameter groups."""

from __future__ import annotations

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QHeaderView, QLineEdit, QTreeWidget, QTreeWidgetItem, QVBoxLayout, QWidget

from amp_studio.report.wording import counted
from amp_studio.schema import Parameter

from .theme import severity_ink
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
        self.tree = QTreeWidget()
        self.tree.setHeaderHidden(True)
        self.tree.setColumnCount(3)
        self.tree.setUniformRowHeights(True)
        self.tree.setIndentation(14)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(3)
        layout.addWidget(self.search)
        layout.addWidget(self.tree)
        self.setFocusProxy(self.tree)
        self._items: list[QTreeWidgetItem] = []
        self._steps: dict[str, set[str]] = {}
        """Key of a step of a guide -> the parameters to set in it."""
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
        by_name: dict[str, list[str]] = {}
        for group in schema.groups:
            by_name.setdefault(group.name, []).append(group.key)
        sections = {g.key: g.section for g in schema.groups}
        for name, keys in by_name.items():
            item = self._add(None, name, keys)
            for key in keys if len(keys) > 1 else ():
                self._add(item, sections[key], [key])
            item.setExpanded(True)
        for guide in schema.guides:
            keys = [f"{guide.id} {n}" for n in range(1, len(guide.steps) + 1)]
            self._steps |= {key: set(step.params) for key, step in zip(keys, guide.steps, strict=True)}
            item = self._add(None, guide.title, keys)
            for n, (key, step) in enumerate(zip(keys, guide.steps, strict=True), 1):
                tip = f"{step.title}, page {step.page}" + (f": {step.what}" if step.what else "")
                self._add(item, f"{n}  {step.title}", [key]).setToolTip(0, tip)
        header = self.tree.header()
        header.setStretchLastSection(False)
        header.setMinimumSectionSize(8)
        header.setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        for column in (1, 2):
            header.setSectionResizeMode(column, QHeaderView.ResizeMode.ResizeToContents)
        self.update_counts()
        self._hide_empty()
        self.tree.setCurrentItem(next(i for i in self._items[3:] if not i.isHidden()))

    def _hide_empty(self) -> None:
        """Hide the groups of which this machine type, or this control, has no parameter."""
        schema, here = self._workspace.file.schema, self._workspace.file.machine_schema
        present = {schema.group_of[p].key for p, scope in here.scopes.items() if scope is not None}
        groups = {group.key for group in schema.groups}
        for item in self._items:
            keys = set(item.data(0, _KEYS))
            item.setHidden(keys <= groups and keys.isdisjoint(present))

    def _add(self, parent: QTreeWidgetItem | None, text: str, keys: list[str]) -> QTreeWidgetItem:
        item = QTreeWidgetItem([text.removesuffix(" Parameters"), "", ""])
        item.setData(0, _KEYS, keys)
        self._items.append(item)
        item.setToolTip(0, text)
        for column in (1, 2):
            item.setTextAlignment(column, Qt.AlignmentFlag.AlignRight)
        if parent is None:
            self.tree.addTopLevelItem(item)
        else:
            parent.addChild(item)
        return item

    def update_counts(self) -> None:
        """Show how many errors and warnings each group has."""
        schema = self._workspace.file.schema
        found = []
        for finding in self._workspace.findings:
            ids = {a[0] for a in finding.causes}
            steps = {key for key, params in self._steps.items() if not params.isdisjoint(ids)}
            found.append((finding.severity, {schema.group_of[name].key for name in ids} | steps))
        for item in self._items:
            keys = set(item.data(0, _KEYS))
            for column, severity in ((1, "error"), (2, "warning")):
                count = sum(s == severity and not keys.isdisjoint(places) for s, places in found)
                item.setText(column, str(count) if count else "")
                item.setForeground(column, severity_ink(severity))
                item.setToolTip(column, counted(count, severity) if count else "")

    def _follow(self, addresses: list[object]) -> None:
        """Update the counts, and a list that depends on values, after the present edit."""
        if self._workspace.file.machine != self._machine:  # another machine type has other numbers
            self._machine, self._texts = self._workspace.file.machine, _search_texts(self._workspace)
            self._hide_empty()
        self.update_counts()
        item = self.tree.currentItem()
        if item is not None and item.data(0, _KEYS)[0] in (_CHANGED, _FINDINGS) and not self.search.text():
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
        elif item is not None:
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
            ids = {a[0] for f in self._workspace.findings for a in f.addresses if f.rule != "schema.unset"}
            return [p for p in every if p.id in ids]
        if keys[0] in self._steps:
            order = dict.fromkeys(name for key in keys for name in self._ordered(key))
            return [schema.parameters[name] for name in order]
        return [p for g in schema.groups if g.key in keys for p in g.parameters]

    def _ordered(self, key: str) -> tuple[str, ...]:
        """Return the parameters of a step in the guide's order."""
        guide, _, n = key.rpartition(" ")
        return next(g for g in self._workspace.file.schema.guides if g.id == guide).steps[int(n) - 1].params

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
