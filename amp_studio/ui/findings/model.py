"""The findings as rows: one for each rule, and below it one for each finding."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from PySide6.QtCore import QAbstractItemModel, QModelIndex, Qt

from amp_studio.report import FindingGroup, finding_axes, finding_groups, fix_text, severity_name
from amp_studio.ui.base.model_index import ModelIndex
from amp_studio.ui.base.places import finding_text
from amp_studio.ui.base.translated import worded
from amp_studio.ui.base.workspace import Workspace
from amp_studio.validate import Finding

_NO_PARENT = 0
"""Internal id of a row of a rule; a finding below it has the number of its rule, counted from one."""


class FindingsModel(QAbstractItemModel):
    """Rows of rules with rows of findings; ``show_findings`` gives it the ones that are listed."""

    def __init__(self, workspace: Workspace) -> None:
        super().__init__()
        self._workspace = workspace
        self.groups: tuple[FindingGroup, ...] = ()
        self._fixes: dict[str, str] = {}

    def show_findings(self, findings: Iterable[Finding]) -> bool:
        """List these findings; returns whether anything is new."""
        groups = finding_groups(self._workspace.validator, findings)
        # A reset folds everything and drops the selection: only where there is something new.
        if groups == self.groups:
            return False
        self.beginResetModel()
        self.groups = groups
        file = self._workspace.file
        # Made once: the list asks for it at every paint and every move of the mouse.
        self._fixes = {group.key: fix_text(file, group.fixable) for group in groups}
        self.endResetModel()
        return True

    # -- what a row is -------------------------------------------------------------

    def group(self, index: ModelIndex) -> FindingGroup:
        """Return the rule of a row, also of a row of one of its findings."""
        return self.groups[index.internalId() - 1 if index.internalId() else index.row()]

    def finding(self, index: ModelIndex) -> Finding | None:
        """Return the finding of a row; None for the row of a rule."""
        return self.group(index).findings[index.row()] if index.internalId() else None

    def findings_of(self, index: ModelIndex) -> tuple[Finding, ...]:
        """Return the finding of a row, or all findings of the row of a rule."""
        finding = self.finding(index)
        return (finding,) if finding else self.group(index).findings

    def fix_of(self, index: ModelIndex) -> str:
        """Return what the fix of the row of a rule does, as its button has it; empty without one."""
        return "" if index.internalId() else self._fixes[self.group(index).key]

    def axes_of(self, index: ModelIndex) -> tuple[str, ...]:
        """Return the letters of the axes of a row."""
        finding = self.finding(index)
        return finding_axes(self._workspace.file, finding) if finding else self.group(index).axes

    def text_of(self, index: ModelIndex) -> str:
        """Return what is wrong, and for a finding in the words of its rule the values it is about."""
        finding, group, file = self.finding(index), self.group(index), self._workspace.file
        if finding is not None and finding.message == group.message:
            labels = map(file.machine_schema.label, finding.addresses[:6])
            if text := ", ".join(dict.fromkeys(labels)):
                return text
        return finding_text(file, finding or group.findings[0])

    # -- Qt's side -----------------------------------------------------------------

    def index(self, row: int, column: int, parent: ModelIndex = QModelIndex()) -> QModelIndex:  # noqa: B008  # Qt's own signature
        if not self.hasIndex(row, column, parent):
            return QModelIndex()
        # An index carries no parent: the number that Qt keeps with it is the row of the rule, from 1, and 0
        # for a rule itself. A number, for an object that Python has collected would be a wild pointer there.
        return self.createIndex(row, column, parent.row() + 1 if parent.isValid() else _NO_PARENT)

    def parent(self, index: ModelIndex = QModelIndex()) -> QModelIndex:  # type: ignore[override]  # noqa: B008  # Qt's own signature; the parent of an object too
        if not index.isValid() or not index.internalId():
            return QModelIndex()
        return self.createIndex(index.internalId() - 1, 0, _NO_PARENT)

    def rowCount(self, parent: ModelIndex = QModelIndex()) -> int:  # noqa: B008  # Qt's own signature
        if not parent.isValid():
            return len(self.groups)
        return 0 if parent.internalId() else len(self.groups[parent.row()].findings)

    def columnCount(self, parent: ModelIndex = QModelIndex()) -> int:  # noqa: B008  # Qt's own signature
        return 1

    def data(self, index: ModelIndex, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        if role in (Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.AccessibleTextRole):
            axes = f" ({', '.join(axes)})" if (axes := self.axes_of(index)) else ""
            return f"{worded(severity_name(self.group(index).severity))}: {self.text_of(index)}{axes}"
        return None
