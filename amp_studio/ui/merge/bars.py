"""The bars of a comparison: what is shown, what is being read, and what becomes of the result."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import (
    QButtonGroup,
    QFrame,
    QLabel,
    QLineEdit,
    QListWidget,
    QListWidgetItem,
    QProgressBar,
    QPushButton,
    QSizePolicy,
    QToolButton,
)

from amp_studio.report import severity_name
from amp_studio.ui.base.figures import finding_in_words
from amp_studio.ui.base.layout import in_row
from amp_studio.ui.base.theme import ICON, MESSAGE, STATUS, TOOLS, font, icon, scheme, severity_icon
from amp_studio.ui.base.translated import worded
from amp_studio.ui.forms.icon_button import icon_button
from amp_studio.validate import Finding

_NARROW, _NARROWER = 1240, 1120
"""Widths below which the heading, and the words of a button, leave."""


class ViewBar(QFrame):
    """How many sources, in which units, and which rows are shown."""

    def __init__(self, systems: Sequence[str], units: str | None) -> None:
        super().__init__()
        self.setFixedHeight(TOOLS + 4)
        # As wide as the window lets it be: what there is no room for leaves, so it never keeps a window wide.
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        row = self._row = in_row(on=self, margins=(12, 4, 8, 4), gap=8)
        self.heading = QLabel(self.tr("Compare and merge"))
        self.heading.setFont(font("title"))
        row.addWidget(self.heading)
        self.two, self.three = self._segment((self.tr("&2 sources"), self.tr("&3 sources")))
        self.swap = QPushButton()
        self.swap.setAutoDefault(False)
        self.swap.setIcon(icon("swap"))
        self.swap.setAccessibleName(self.tr("Swap A and B"))
        self.swap.setToolTip(self.tr("Swap A and B (Alt+W)"))
        self.swap.setShortcut("Alt+W")
        row.addWidget(self.swap)
        names = {"metric": "mm", "inch": self.tr("inch")}
        several = systems if len(systems) > 1 else ()
        buttons = self._segment([names.get(system, system) for system in several])
        self.units = dict(zip(several, buttons, strict=True))
        if units in self.units:
            self.units[units].setChecked(True)
        row.addStretch()
        self.only_differences = self._chip(self.tr("Only &differences"), checked=True)
        self.only_conflicts = self._chip(self.tr("Conflicts"))
        self.only_active = self._chip(self.tr("Acti&ve only"))
        self.search = QLineEdit()
        self.search.setPlaceholderText(self.tr("Filter by name, number"))
        self.search.setAccessibleName(self.tr("Filter"))
        self.search.setClearButtonEnabled(True)
        self.search.setMinimumWidth(110)
        self.search.setMaximumWidth(210)
        row.addWidget(self.search, 1)
        self.previous = self._arrow("arrow-up", self.tr("Previous difference (Alt+Up)"))
        self.next = self._arrow("arrow-down", self.tr("Next difference (Alt+Down)"))
        self.narrow(_NARROW)

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self.narrow(self.width())

    def narrow(self, width: int) -> None:
        """Show what there is room for."""
        self.heading.setVisible(width > _NARROW)
        self.swap.setText(self.tr("Swap A and B") if width > _NARROWER else "")

    def next_units(self) -> None:
        """Show the figures in the next unit system."""
        buttons = list(self.units.values())
        if buttons:
            here = next((n for n, button in enumerate(buttons) if button.isChecked()), -1)
            buttons[(here + 1) % len(buttons)].click()

    def _segment(self, texts: Sequence[str]) -> list[QToolButton]:
        group, buttons = QButtonGroup(self), list[QToolButton]()
        for n, text in enumerate(texts):
            button = QToolButton()
            button.setText(text)
            button.setCheckable(True)
            button.setProperty("segment", "first" if n == 0 else "last" if n == len(texts) - 1 else "middle")
            group.addButton(button)
            buttons.append(button)
        self._row.addLayout(in_row(*buttons, gap=0))
        return buttons

    def _chip(self, text: str, *, checked: bool = False) -> QToolButton:
        chip = QToolButton()
        chip.setText(text)
        chip.setCheckable(True)
        chip.setChecked(checked)
        chip.setProperty("chip", True)
        self._row.addWidget(chip)
        return chip

    def _arrow(self, name: str, tip: str) -> QToolButton:
        button = icon_button(name, tip)
        self._row.addWidget(button)
        return button


class ReadingBar(QFrame):
    """What is being read, how far it is, and Cancel."""

    def __init__(self) -> None:
        super().__init__()
        self.setFixedHeight(MESSAGE)
        self.stage, self.amount = QLabel(), QProgressBar()
        self.amount.setAccessibleName(self.tr("Progress"))
        self.cancel = QPushButton(self.tr("Cance&l"))
        self.cancel.setAutoDefault(False)
        in_row(self.stage, (self.amount, 1), self.cancel, on=self, margins=(12, 2, 8, 2))
        self.hide()

    def show_stage(self, stage: str = "", done: int = 0, total: int = 0) -> None:
        """Show what is read now, and how much of how much."""
        if stage in ("silent", "cut"):
            self.stage.setText(
                self.tr("No answer, trying again …") if done or stage == "cut" else self.tr("Reading …")
            )
            return
        self.stage.setText(self.tr("Reading …") + (f" {100 * done // total} %" if total > 0 else ""))
        self.amount.setRange(0, max(total, 0))
        self.amount.setValue(done)


class ResultBar(QFrame):
    """What is left to decide, what would be found about the result, and what can be done with it."""

    def __init__(self, findings: FindingList) -> None:
        super().__init__()
        self.setFixedHeight(STATUS + 20)
        self._findings = findings
        self.mark, self.summary, self.findings_button = QLabel(), QLabel(), QToolButton()
        self.findings_button.setCheckable(True)
        self.findings_button.toggled.connect(findings.setVisible)
        self.report = QPushButton(icon("printer"), self.tr("&Report…"))
        self.save, self.merge = QPushButton(self.tr("Save Result A&s…")), QPushButton()
        self.merge.setProperty("primary", True)
        buttons = (self.report, self.save, self.merge)
        for button in buttons:
            button.setAutoDefault(False)
        left = (self.mark, self.summary, self.findings_button)
        in_row(*left, 0, *buttons, on=self, margins=(12, 4, 12, 4), gap=8)
        self._left = 0
        scheme().changed.connect(self._show_mark)  # a pixmap keeps the colours in which it was drawn

    def show_counts(self, left: int, changes: int) -> None:
        """Show how many conflicts are left and how many values change."""
        texts = [f"<b>{self.tr('%n conflicts left', '', left)}</b>"] if left else []
        texts.append(self.tr("%n changes so far", "", changes))
        self.summary.setText("&nbsp; ".join(texts))
        self._left = left
        self._show_mark()

    def _show_mark(self) -> None:
        self.mark.setPixmap((severity_icon("warning") if self._left else icon("check")).pixmap(ICON, ICON))

    def show_findings(self, new: Sequence[Finding] | None) -> None:
        """Show what would be found about the result that is not found now; None while it is being checked."""
        counts = [sum(f.severity == severity for f in new or ()) for severity in ("error", "warning")]
        names = (self.tr("%n new errors", "", counts[0]), self.tr("%n new warnings", "", counts[1]))
        text = ", ".join(name for name, count in zip(names, counts, strict=True) if count)
        self.findings_button.setText(
            text or (self.tr("Checking …") if new is None else self.tr("No new finding"))
        )
        self.findings_button.setEnabled(bool(new))
        if not new:
            self.findings_button.setChecked(False)
        self._findings.fill(new or ())


class FindingList(QListWidget):
    """The new findings of the result."""

    def __init__(self) -> None:
        super().__init__()
        self.setAccessibleName(self.tr("New findings in the result"))
        self.setMaximumHeight(120)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setWordWrap(True)
        self.setIconSize(QSize(ICON, ICON))
        self.hide()

    def fill(self, found: Sequence[Finding]) -> None:
        """List findings."""
        if [self.finding(self.item(n)) for n in range(self.count())] == list(found):
            return  # the list keeps its place
        self.clear()
        for finding in found:
            item = QListWidgetItem(severity_icon(finding.severity), finding_in_words(finding))
            item.setToolTip(worded(severity_name(finding.severity)))
            item.setData(Qt.ItemDataRole.UserRole, finding)
            self.addItem(item)

    @staticmethod
    def finding(item: QListWidgetItem) -> Finding:
        """Return the finding of an item."""
        found: Finding = item.data(Qt.ItemDataRole.UserRole)
        return found
