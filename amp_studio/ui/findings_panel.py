"""The findings below the table: what is wrong, where, and a repair one keystroke away."""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import QAbstractTableModel, QModelIndex, QPersistentModelIndex, Qt, Signal
from PySide6.QtGui import QBrush
from PySide6.QtWidgets import QAbstractItemView, QHBoxLayout, QHeaderView, QLabel, QPushButton, QTableView, QVBoxLayout, QWidget

from amp_studio.schema import show_value
from amp_studio.validate import Finding

from .theme import severity_ink
from .workspace import Workspace

Index = QModelIndex | QPersistentModelIndex
_COLUMNS = ("Severity", "Parameters", "Finding", "Repair", "Page")


class FindingsTable(QAbstractTableModel):
    """The present findings, errors first."""

    def __init__(self, workspace: Workspace) -> None:
        super().__init__()
        self._workspace = workspace
        self.findings: tuple[Finding, ...] = workspace.findings
        workspace.changed.connect(self._refresh)

    def _refresh(self, _: object) -> None:
        if self.findings != self._workspace.findings:
            self.beginResetModel()
            self.findings = self._workspace.findings
            self.endResetModel()

    def rowCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008  # Qt's own signature
        return 0 if parent.isValid() else len(self.findings)

    def columnCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008  # Qt's own signature
        return len(_COLUMNS)

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        if orientation == Qt.Orientation.Horizontal and role == Qt.ItemDataRole.DisplayRole:
            return _COLUMNS[section]
        return None

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        finding = self.findings[index.row()]
        if role == Qt.ItemDataRole.ForegroundRole and index.column() == 0:
            return QBrush(severity_ink(finding.severity))
        if role == Qt.ItemDataRole.ToolTipRole:
            return finding.message
        if role != Qt.ItemDataRole.DisplayRole:
            return None
        file = self._workspace.file
        if index.column() == 0:
            return finding.severity
        if index.column() == 1:
            names = [file.schema.label(a, file.machine) for a in finding.addresses[:3]]
            return ", ".join(names) + (" …" if len(finding.addresses) > 3 else "")
        if index.column() == 2:
            return finding.message
        if index.column() == 3:
            return self._repair(finding)
        return finding.page or ""

    def _repair(self, finding: Finding) -> str:
        file = self._workspace.file
        return ", ".join(
            f"{file.schema.short(r.address, file.machine)} = {show_value(file.schema.parameters[r.address[0]], r.value)}"
            for r in finding.repairs
        )


class FindingsPanel(QWidget):
    """The table of findings with its buttons."""

    activated = Signal(object)
    """A finding that was double-clicked."""
    repaired = Signal(object)
    """A finding whose repair is wanted."""

    def __init__(self, workspace: Workspace) -> None:
        super().__init__()
        self._workspace = workspace
        self.model = FindingsTable(workspace)
        self.view = QTableView()
        self.view.setModel(self.model)
        self.view.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.view.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.view.setWordWrap(True)
        self.view.verticalHeader().hide()
        header = self.view.horizontalHeader()
        for column, width in enumerate((70, 250, 480, 190, 50)):
            self.view.setColumnWidth(column, width)
        header.setSectionResizeMode(2, QHeaderView.ResizeMode.Stretch)
        self.view.doubleClicked.connect(lambda _: self._activate())
        self.view.selectionModel().selectionChanged.connect(lambda *_: self._update_buttons())
        self.counts = QLabel()
        self.repair_button = QPushButton("&Repair")
        self.repair_button.setToolTip("Apply the repair of the selected finding (F8)")
        self.repair_button.clicked.connect(self.repair)
        self.show_button = QPushButton("&Show")
        self.show_button.clicked.connect(self._activate)
        buttons = QHBoxLayout()
        for widget in (self.counts, None, self.show_button, self.repair_button):
            buttons.addStretch() if widget is None else buttons.addWidget(widget)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.view)
        layout.addLayout(buttons)
        self.model.modelReset.connect(self._after_reset)
        self._after_reset()

    def _after_reset(self) -> None:
        counts = {s: sum(f.severity == s for f in self.model.findings) for s in ("error", "warning", "advice")}
        self.counts.setText(f"{counts['error']} errors, {counts['warning']} warnings, {counts['advice']} pieces of advice")
        self.view.resizeRowsToContents()
        if self.model.findings:
            self.view.selectRow(0)
        self._update_buttons()

    def current(self) -> Finding | None:
        """Return the selected finding."""
        index = self.view.currentIndex()
        return self.model.findings[index.row()] if index.isValid() and index.row() < len(self.model.findings) else None

    def repair(self) -> None:
        """Ask for the repair of the selected finding."""
        finding = self.current()
        if finding and finding.repairs:
            self.repaired.emit(finding)

    def _activate(self) -> None:
        finding = self.current()
        if finding:
            self.activated.emit(finding)

    def _update_buttons(self) -> None:
        finding = self.current()
        self.show_button.setEnabled(bool(finding and finding.addresses))
        self.repair_button.setEnabled(bool(finding and finding.repairs and self._workspace.document.is_locked))
