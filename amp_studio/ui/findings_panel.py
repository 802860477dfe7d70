"""The findings below the table: what is wrong, where, and the suggested fix."""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import (
    QAbstractTableModel,
    QModelIndex,
    QPersistentModelIndex,
    Qt,
    QTimer,
    Signal,
    SignalInstance,
)
from PySide6.QtGui import QBrush, QKeyEvent, QResizeEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QPushButton,
    QTableView,
    QVBoxLayout,
    QWidget,
)

from amp_studio.report.wording import counted, severity_name
from amp_studio.schema import show_value
from amp_studio.validate import SEVERITIES, Finding

from .theme import severity_icon, severity_ink
from .workspace import Workspace

Index = QModelIndex | QPersistentModelIndex
_COLUMNS = ("Severity", "Parameters", "Finding", "Suggested fix", "Page")
_WIDTHS = (136, 230, 480, 170, 52)


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

    def headerData(
        self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole
    ) -> Any:
        if orientation == Qt.Orientation.Horizontal and role == Qt.ItemDataRole.DisplayRole:
            return _COLUMNS[section]
        return None

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        finding = self.findings[index.row()]
        if index.column() == 0 and role == Qt.ItemDataRole.ForegroundRole:
            return QBrush(severity_ink(finding.severity))
        if index.column() == 0 and role == Qt.ItemDataRole.DecorationRole:
            return severity_icon(finding.severity)
        if role == Qt.ItemDataRole.ToolTipRole:
            return finding.message
        if role == Qt.ItemDataRole.DisplayRole:
            return self._text(finding, index.column())
        return None

    def _text(self, finding: Finding, column: int) -> str:
        file = self._workspace.file
        if column == 1:
            names = [file.machine_schema.label(a) for a in finding.addresses[:3]]
            return ", ".join(names) + (" …" if len(finding.addresses) > 3 else "")
        if column == 3:
            return ", ".join(
                f"{file.machine_schema.short(r.address)} = {show_value(file.schema.parameters[r.address[0]], r.value)}"
                for r in finding.fix
            )
        return {0: severity_name(finding.severity), 2: finding.message}.get(column, finding.page or "")


class _View(QTableView):
    """The list: Enter shows the finding, and the row height fits the text."""

    entered_on = Signal()

    def __init__(self) -> None:
        super().__init__()
        self._fit = QTimer(self)
        self._fit.setSingleShot(True)
        self._fit.timeout.connect(self._fit_rows)

    def fit(self) -> None:
        """Update the row heights after the present event."""
        self._fit.start(0)

    def _fit_rows(self) -> None:
        self.resizeRowsToContents()
        self.scrollTo(self.currentIndex())

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self.fit()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self.entered_on.emit()
        else:
            super().keyPressEvent(event)


class FindingsPanel(QWidget):
    """The table of findings with its buttons."""

    activated = Signal(object)
    """A finding was double-clicked, or Enter was pressed."""
    fix_requested = Signal(object)
    """The suggested fix of a finding is to be applied."""
    explanation_requested = Signal(object)
    """A finding is to be explained."""
    suppression_requested = Signal(object)
    """A finding is to be suppressed."""

    def __init__(self, workspace: Workspace) -> None:
        super().__init__()
        self._workspace = workspace
        self._selected: Finding | None = None
        self._row = 0
        self.model = FindingsTable(workspace)
        self.view = _View()
        self.view.setModel(self.model)
        self.view.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.view.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.view.setTabKeyNavigation(False)
        self.view.verticalHeader().hide()
        self.view.verticalHeader().setMinimumSectionSize(1)
        header = self.view.horizontalHeader()
        for column, width in enumerate(_WIDTHS):
            self.view.setColumnWidth(column, width)
        header.setSectionResizeMode(2, QHeaderView.ResizeMode.Stretch)
        header.sectionResized.connect(self.view.fit)
        self.view.doubleClicked.connect(self._activate)
        self.view.entered_on.connect(self._activate)
        self.view.selectionModel().currentRowChanged.connect(self._select)
        self.counts = QLabel()
        self.show_button, self.fix_button = QPushButton("Sho&w"), QPushButton("Fi&x")
        self.why_button, self.suppress_button = QPushButton("Exp&lain"), QPushButton("Supp&ress…")
        self.show_button.setToolTip("Show the first parameter of the selected finding (Enter)")
        self.fix_button.setToolTip("Apply the suggested fix of the selected finding (F8)")
        self.why_button.setToolTip("Explain the selected finding: its rule and the values in it (Shift+F1)")
        self.suppress_button.setToolTip("Accept the selected finding for good, with a reason and a name")
        self.show_button.clicked.connect(self._activate)
        self.why_button.clicked.connect(lambda: self._ask(self.explanation_requested))
        self.suppress_button.clicked.connect(lambda: self._ask(self.suppression_requested))
        self.fix_button.clicked.connect(self.fix)
        buttons = QHBoxLayout()
        buttons.setContentsMargins(6, 0, 6, 4)
        for widget in (
            self.counts,
            None,
            self.show_button,
            self.why_button,
            self.fix_button,
            self.suppress_button,
        ):
            buttons.addStretch() if widget is None else buttons.addWidget(widget)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(4)
        layout.addWidget(self.view)
        layout.addLayout(buttons)
        self.setFocusProxy(self.view)
        self.model.modelReset.connect(self._after_reset)
        self._after_reset()

    def _after_reset(self) -> None:
        """Select the same finding again, or the one that took its place."""
        counts = [counted(self._workspace.count(s), s, none="no") for s in SEVERITIES]
        left = self._workspace.validator.suppressed
        if left:
            counts.append(f"{len(left)} suppressed")
        self.counts.setText(", ".join(counts))
        self.counts.setToolTip(
            "\n".join(
                f"{s.finding.message} Suppressed by {s.suppression.by}: {s.suppression.reason}" for s in left
            )
        )
        self.view.fit()
        findings = self.model.findings
        if findings:
            same = [n for n, f in enumerate(findings) if self._selected and f.key == self._selected.key]
            self.view.selectRow(same[0] if same else min(self._row, len(findings) - 1))
        self._update_buttons()

    def _select(self, *_: object) -> None:
        self._selected = self.current() or self._selected
        self._row = max(self.view.currentIndex().row(), 0)
        self._update_buttons()

    def current(self) -> Finding | None:
        """Return the selected finding."""
        index = self.view.currentIndex()
        return (
            self.model.findings[index.row()]
            if index.isValid() and index.row() < len(self.model.findings)
            else None
        )

    def fix(self) -> None:
        """Ask to apply the suggested fix of the selected finding."""
        finding = self.current()
        if finding and finding.fix:
            self.fix_requested.emit(finding)

    def _ask(self, signal: SignalInstance) -> None:
        finding = self.current()
        if finding:
            signal.emit(finding)

    def _activate(self, *_: object) -> None:
        finding = self.current()
        if finding:
            self.activated.emit(finding)

    def _update_buttons(self) -> None:
        finding = self.current()
        self.show_button.setEnabled(bool(finding and finding.addresses))
        self.why_button.setEnabled(finding is not None)
        self.suppress_button.setEnabled(finding is not None and not finding.rule.startswith("rules."))
        self.fix_button.setEnabled(bool(finding and finding.fix and self._workspace.may_edit))
