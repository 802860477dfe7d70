"""Checks all files of a project and lists the findings of each."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtGui import QBrush
from PySide6.QtWidgets import QDialog, QHeaderView, QLabel, QTreeWidget, QTreeWidgetItem, QWidget

from amp_studio.files import ParameterFileError, open_file
from amp_studio.guide import present
from amp_studio.schema import Address
from amp_studio.ui.base.figures import finding_in_words
from amp_studio.ui.base.layout import in_column
from amp_studio.ui.base.screen_room import fit_to_screen
from amp_studio.ui.base.task import TaskProgress
from amp_studio.ui.base.theme import severity_colour, severity_icon
from amp_studio.ui.base.translated import counted, worded
from amp_studio.validate import SEVERITIES, Finding, KeptValidators, rules_beside

_GOES_TO = Qt.ItemDataRole.UserRole


@dataclass(frozen=True)
class CheckedFile:
    """The findings of one file as it is on disk."""

    path: Path
    findings: tuple[Finding, ...] = ()
    labels: tuple[str, ...] = ()
    """The name of the parameter of each finding."""
    fault: str = ""
    """Why the file cannot be read; empty when it was read."""

    def count(self, severity: str) -> int:
        """Return how many findings of a severity there are."""
        return sum(finding.severity == severity for finding in self.findings)


def check_files(paths: list[Path], progress: TaskProgress, cancelled: threading.Event) -> list[CheckedFile]:
    """Return the findings of files, with the rules beside them;
    after a cancel only those of the files checked so far.
    """
    checked = []
    kept = KeptValidators()
    for n, path in enumerate(paths):
        # Between files: the check of one is not interrupted.
        if cancelled.is_set():
            break
        progress(path.name, n, len(paths))
        checked.append(_checked(path, kept))
    return checked


def _checked(path: Path, kept: KeptValidators) -> CheckedFile:
    try:
        file = open_file(path).file
    except ParameterFileError as fault:
        return CheckedFile(path, fault=str(fault))
    with kept.validator_of(file, path, rules_beside(path, file)) as validator:
        findings = present(validator, validator.findings()).findings
    labels = tuple(file.machine_schema.label(f.addresses[0]) if f.addresses else "" for f in findings)
    return CheckedFile(path, findings, labels)


class ProjectCheckDialog(QDialog):
    """Lists the findings; a double click or Enter opens the file at the finding. Stays open beside the
    table.
    """

    def __init__(
        self,
        checked: list[CheckedFile],
        show: Callable[[Path, Address | None], None],
        parent: QWidget | None,
        total: int | None = None,
    ) -> None:
        """``total`` is how many files were to be checked, where that was more: it was cancelled."""
        super().__init__(parent)
        self._checked = checked
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowTitle(self.tr("Check All Files"))
        fit_to_screen(self, 900, 500)
        totals = [counted(sum(c.count(s) for c in checked), s, none="no") for s in SEVERITIES]
        unread = sum(bool(c.fault) for c in checked)
        self.text = QLabel(
            self.tr("{count} as saved on disk: {list}").format(
                count=counted(len(checked), "file"), list=", ".join(totals)
            )
            + (self.tr("; {unread} cannot be read").format(unread=unread) if unread else "")
        )
        if total is not None and (left := total - len(checked)):
            cancelled = self.tr("Cancelled: {count} not checked.").format(count=counted(left, "file"))
            self.text.setText(f"{cancelled} {self.text.text()}")
        self.tree = QTreeWidget()
        self.tree.setHeaderLabels(
            [
                self.tr("File"),
                self.tr("Errors"),
                self.tr("Warnings"),
                self.tr("Recommendations"),
                self.tr("Finding"),
            ]
        )
        self.tree.setAccessibleName(self.tr("Findings of each file"))
        self.tree.setUniformRowHeights(True)
        self.tree.addTopLevelItems([_branch(c) for c in checked])
        for column in range(4):
            self.tree.header().setSectionResizeMode(column, QHeaderView.ResizeMode.ResizeToContents)
        self.tree.itemExpanded.connect(self._fill)
        self.tree.itemActivated.connect(lambda item: show(*item.data(0, _GOES_TO)))
        in_column(self.text, self.tree, on=self)

    def _fill(self, item: QTreeWidgetItem) -> None:
        """Give a file its findings when it is opened: a project can have a hundred thousand."""
        if item.childCount() == 0:
            of = self._checked[self.tree.indexOfTopLevelItem(item)]
            item.addChildren([_leaf(of.path, *each) for each in zip(of.findings, of.labels, strict=True)])


def _branch(checked: CheckedFile) -> QTreeWidgetItem:
    counts = {severity: checked.count(severity) for severity in SEVERITIES}
    worst = "error" if checked.fault else next((s for s in SEVERITIES if counts[s]), "")
    first = checked.fault or next(map(finding_in_words, checked.findings), worded("no findings"))
    figures = ["" if checked.fault else str(count) for count in counts.values()]
    item = QTreeWidgetItem([checked.path.name, *figures, first])
    if worst:
        item.setIcon(0, severity_icon(worst))
    item.setData(0, _GOES_TO, (checked.path, None))
    if checked.findings:
        item.setChildIndicatorPolicy(QTreeWidgetItem.ChildIndicatorPolicy.ShowIndicator)
    return item


def _leaf(path: Path, finding: Finding, label: str) -> QTreeWidgetItem:
    """Return the line of a finding of a file."""
    leaf = QTreeWidgetItem([label, "", "", "", finding_in_words(finding)])
    leaf.setIcon(0, severity_icon(finding.severity))
    leaf.setForeground(0, QBrush(severity_colour(finding.severity)))
    leaf.setToolTip(4, finding_in_words(finding))
    leaf.setData(0, _GOES_TO, (path, finding.addresses[0] if finding.addresses else None))
    return leaf
