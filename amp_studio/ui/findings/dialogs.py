"""Dialogs about one finding: its explanation, and its suppression."""

from __future__ import annotations

import html
from collections.abc import Callable, Iterable

from PySide6.QtCore import Qt, QUrl
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QLabel,
    QTextBrowser,
    QTreeWidget,
    QTreeWidgetItem,
    QWidget,
)

from amp_studio.files import ParameterFile
from amp_studio.report import FindingGroup, finding_groups, fix_lines, severity_name, why_parts
from amp_studio.schema import Address, written
from amp_studio.ui.base.figures import unbroken
from amp_studio.ui.base.layout import in_column
from amp_studio.ui.base.places import finding_text, sentenced_with_letters
from amp_studio.ui.base.theme import severity_html, severity_icon
from amp_studio.ui.base.translated import tr, worded
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.forms.form import Field, FormDialog
from amp_studio.validate import Finding, explain

_EXPRESSIONS = ("Applies if", "Requires", "With the values", "Result")
"""Lines of an explanation that are in the words of a rule file."""


class WhyDialog(QDialog):
    """Shows the rule of a finding with its values; parameters are links. Stays open beside the table."""

    def __init__(
        self, workspace: Workspace, finding: Finding, go_to: Callable[[Address], object], parent: QWidget
    ) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowTitle(self.tr("Why"))
        self.resize(640, 460)
        self._go_to, self._linked = go_to, list[Address]()
        self.page = QTextBrowser()
        self.page.setOpenLinks(False)
        self.page.anchorClicked.connect(self._follow)
        self.page.setHtml(unbroken(self._written(workspace, finding)))
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        buttons.rejected.connect(self.reject)
        in_column(self.page, buttons, on=self)
        workspace.closed.connect(self.close)

    def _written(self, workspace: Workspace, finding: Finding) -> str:
        """Return a finding with all that it is made of, as HTML."""
        file, why = workspace.file, explain(workspace.validator, finding)
        mark = (
            f"{severity_html(finding.severity)}"
            f" <b>{worded(severity_name(finding.severity)).capitalize()}:</b>"
        )
        lines, before = [f"<p>{mark} {html.escape(finding_text(file, finding))}</p><table cellpadding=3>"], ""
        for title, text, address in why_parts(file, finding, why):
            cell = html.escape(sentenced_with_letters(file, text) if address is not None else text)
            if title in _EXPRESSIONS:
                cell = f"<code>{cell}</code>"
            if address is not None:
                # The number of the address, not its text: instances may have characters that a URL changes.
                cell = f'<a href="seen:{len(self._linked)}">{cell}</a>'
                self._linked.append(address)
            lines.append(
                f"<tr><td><b>{'' if title == before else worded(title)}</b>&nbsp;</td><td>{cell}</td></tr>"
            )
            before = title
        return "".join(lines) + "</table>"

    def _follow(self, url: QUrl) -> None:
        self._go_to(self._linked[int(url.toString().removeprefix("seen:"))])


class SuppressDialog(FormDialog):
    """Asks who suppresses a finding, and why."""

    def __init__(self, file: ParameterFile, finding: Finding, who: str, parent: QWidget) -> None:
        self._finding = finding
        effect = tr(
            "The finding is no longer listed, but reports print it with the reason and the name. The"
            " suppression is saved in rules.yaml beside the file."
        )
        everywhere = tr("Also suppress the same finding of other parameters")
        reason, name = tr("Type a reason."), tr("Type the name of the person who suppresses it.")
        fields = (
            Field("reason", tr("&Reason"), check=lambda text: "" if text else reason),
            Field("name", tr("&Name"), default=who, check=lambda text: "" if text else name),
            Field("everywhere", everywhere, "check", default=False, enabled=bool(finding.addresses)),
        )
        hint = f"<b>{html.escape(finding_text(file, finding))}</b><br>{effect}"
        super().__init__(tr("Suppress a Finding"), fields, tr("&Suppress"), parent, hint=hint, width=520)

    def params(self) -> tuple[str, ...]:
        """Return the parameters of the suppression; empty for all instances."""
        return () if self.form.answer("everywhere") else tuple(map(written, self._finding.addresses))


class FixSeveralDialog(QDialog):
    """Lists every suggested fix with a check; those that cannot change motion are checked."""

    def __init__(self, workspace: Workspace, findings: Iterable[Finding], parent: QWidget) -> None:
        super().__init__(parent)
        self.setWindowTitle(self.tr("Fix Several"))
        self.resize(760, 480)
        self._leaves: list[tuple[QTreeWidgetItem, Finding]] = []
        self.list = QTreeWidget(self)  # rows are measured by the rules of a dialog
        self.list.setHeaderHidden(True)
        self.list.setAccessibleName(self.tr("Suggested fixes"))
        self.list.setWordWrap(True)
        for group in finding_groups(workspace.validator, findings):
            if group.fixable:
                self._add(workspace, group)
        # After the rows are filled: each check that is set would count them again.
        self.list.itemChanged.connect(self._count)
        note = QLabel(
            self.tr("Checked at first: fixes that cannot change motion. All of them are one step of Undo.")
        )
        note.setWordWrap(True)
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
        self.ok = buttons.addButton("", QDialogButtonBox.ButtonRole.AcceptRole)
        self.ok.setDefault(True)
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        in_column(note, self.list, buttons, on=self)
        self._count()

    def _add(self, workspace: Workspace, group: FindingGroup) -> None:
        top = QTreeWidgetItem(self.list, [finding_text(workspace.file, group.findings[0])])
        top.setIcon(0, severity_icon(group.severity))
        top.setFlags(top.flags() | Qt.ItemFlag.ItemIsUserCheckable | Qt.ItemFlag.ItemIsAutoTristate)
        for finding in group.fixable:
            leaf = QTreeWidgetItem(top, ["; ".join(fix_lines(workspace.file, finding))])
            leaf.setFlags(leaf.flags() | Qt.ItemFlag.ItemIsUserCheckable)
            leaf.setCheckState(0, Qt.CheckState.Checked if finding.safe else Qt.CheckState.Unchecked)
            self._leaves.append((leaf, finding))
        top.setExpanded(True)

    def chosen(self) -> tuple[Finding, ...]:
        """Return the findings whose fixes are checked."""
        return tuple(finding for leaf, finding in self._leaves if leaf.checkState(0) == Qt.CheckState.Checked)

    def _count(self, *_: object) -> None:
        number = len(self.chosen())
        self.ok.setText(self.tr("Apply {number} &Fixes").format(number=number))
        self.ok.setEnabled(number > 0)
