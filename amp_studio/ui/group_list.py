"""The left side: a search field over the parameter groups."""

from __future__ import annotations

from collections import Counter

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QHeaderView, QLineEdit, QTreeWidget, QTreeWidgetItem, QVBoxLayout, QWidget

from amp_studio.schema import Parameter

from .theme import severity_ink
from .workspace import Workspace

_KeyRole = Qt.ItemDataRole.UserRole


class GroupList(QWidget):
    """Chooses which parameters the table shows; every word of a search must be found."""

    chosen = Signal(str, list)
    """Title and parameters."""

    def __init__(self, workspace: Workspace) -> None:
        super().__init__()
        self._workspace = workspace
        self.search = QLineEdit()
        self.search.setPlaceholderText("Search number, name, help  (Ctrl+F)")
        self.search.setClearButtonEnabled(True)
        self.search.textChanged.connect(lambda _: self.choose())
        self.tree = QTreeWidget()
        self.tree.setHeaderHidden(True)
        self.tree.setColumnCount(2)
        self.tree.currentItemChanged.connect(lambda *_: self._choose_group())
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.search)
        layout.addWidget(self.tree)
        QShortcut(QKeySequence.StandardKey.Find, self, self.focus_search)
        self._texts = _search_texts(workspace)
        self._fill()
        workspace.changed.connect(lambda _: self.update_counts())

    def focus_search(self) -> None:
        """Put the cursor into the search field."""
        self.search.setFocus()
        self.search.selectAll()

    def _fill(self) -> None:
        schema = self._workspace.file.schema
        self._add(None, "All parameters", "*")
        self._add(None, "Changed from default", "changed")
        self._add(None, "With findings", "findings")
        by_name: dict[str, list[str]] = {}
        for group in schema.groups:
            by_name.setdefault(group.name, []).append(group.key)
        sections = {g.key: g.section for g in schema.groups}
        for name, keys in by_name.items():
            item = self._add(None, name, "+".join(keys))
            for key in keys if len(keys) > 1 else ():
                self._add(item, sections[key], key)
            item.setExpanded(True)
        header = self.tree.header()
        header.setStretchLastSection(False)
        header.setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        header.setSectionResizeMode(1, QHeaderView.ResizeMode.ResizeToContents)
        self.update_counts()
        self.tree.setCurrentItem(self.tree.topLevelItem(3))

    def _add(self, parent: QTreeWidgetItem | None, text: str, key: str) -> QTreeWidgetItem:
        item = QTreeWidgetItem([text, ""])
        item.setData(0, _KeyRole, key)
        item.setTextAlignment(1, Qt.AlignmentFlag.AlignRight)
        if parent is None:
            self.tree.addTopLevelItem(item)
        else:
            parent.addChild(item)
        return item

    def update_counts(self) -> None:
        """Show how many errors and warnings each group has."""
        schema = self._workspace.file.schema
        counts: Counter[tuple[str, str]] = Counter()
        for finding in self._workspace.findings:
            if finding.severity == "advice":
                continue
            for key in {schema.group_of[a[0]].key for a in finding.addresses}:
                counts[(key, finding.severity)] += 1
        items = [self.tree.topLevelItem(n) for n in range(self.tree.topLevelItemCount())]
        items += [i.child(n) for i in list(items) for n in range(i.childCount())]
        for item in items:
            keys = str(item.data(0, _KeyRole)).split("+")
            errors = sum(counts[(k, "error")] for k in keys)
            warnings = sum(counts[(k, "warning")] for k in keys)
            item.setText(1, " ".join([f"{errors} E"] * bool(errors) + [f"{warnings} W"] * bool(warnings)))
            item.setForeground(1, severity_ink("error" if errors else "warning"))

    # -- choosing --------------------------------------------------------------

    def _choose_group(self) -> None:
        if self.search.text():
            self.search.blockSignals(True)
            self.search.clear()
            self.search.blockSignals(False)
        self.choose()

    def choose(self) -> None:
        """Tell again what is chosen."""
        words = self.search.text().casefold().split()
        if words:
            self.chosen.emit(f"Search: {self.search.text()}", self.found(words))
            return
        item = self.tree.currentItem()
        if item is not None:
            self.chosen.emit(item.text(0), self._parameters(str(item.data(0, _KeyRole))))

    def found(self, words: list[str]) -> list[Parameter]:
        """Return the parameters whose numbers, name, id or help hold every word."""
        schema = self._workspace.file.schema
        hits = [pid for pid, text in self._texts.items() if all(word in text for word in words)]
        return [schema.parameters[pid] for pid in hits]

    def _parameters(self, key: str) -> list[Parameter]:
        schema, file = self._workspace.file.schema, self._workspace.file
        every = list(schema.parameters.values())
        if key == "*":
            return every
        if key == "changed":
            ids = {a[0] for a in file.values if not file.is_default(a)}
            return [p for p in every if p.id in ids]
        if key == "findings":
            ids = {a[0] for f in self._workspace.findings for a in f.addresses if f.rule != "schema.unset"}
            return [p for p in every if p.id in ids]
        keys = set(key.split("+"))
        return [p for g in schema.groups if g.key in keys for p in g.parameters]

    def choose_group_of(self, parameter_id: str) -> None:
        """Select the group a parameter stands in."""
        wanted = self._workspace.file.schema.group_of[parameter_id].key
        items = [self.tree.topLevelItem(n) for n in range(self.tree.topLevelItemCount())]
        items += [i.child(n) for i in list(items) for n in range(i.childCount())]
        for item in items:
            if item.data(0, _KeyRole) == wanted:
                self.tree.setCurrentItem(item)
                self._choose_group()
                return


def _search_texts(workspace: Workspace) -> dict[str, str]:
    """Return one lower-case text a parameter, made once, so that a keystroke only compares."""
    schema, machine = workspace.file.schema, workspace.file.machine
    texts = {}
    for parameter in schema.parameters.values():
        numbers = " ".join(schema.numbers(parameter, machine).values())
        choices = " ".join(c.label for c in parameter.choices or ())
        told = f"{parameter.help.what} {parameter.help.find} {parameter.help.wrong}"
        texts[parameter.id] = f"{numbers} {parameter.id} {parameter.name} {choices} {told}".casefold()
    return texts
