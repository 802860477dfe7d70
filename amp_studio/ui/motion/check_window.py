"""The check of a machine in motion as a window: every scenario that the file allows, with verdict,
figures and parameters to look at.
"""

from __future__ import annotations

import threading
from collections import Counter
from collections.abc import Callable

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QCloseEvent
from PySide6.QtWidgets import (
    QDialog,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QPushButton,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from amp_studio.files import ParameterFile
from amp_studio.sim import MotionCheck, SimulationError, check_motion, value_text
from amp_studio.ui.base.figures import written
from amp_studio.ui.base.screen_room import fit_to_screen
from amp_studio.ui.base.task import Task, TaskProgress
from amp_studio.ui.base.theme import GAP2, GAP3, Token, font, icon

MARKS: dict[str, tuple[str, Token]] = {
    "good": ("check-circle-fill", "text"),
    "doubtful": ("warning-fill", "warn"),
    "bad": ("x-circle-fill", "error"),
    "not possible": ("circle-dashed", "dim"),
}
"""Verdict -> its icon."""


class _Checking(QObject):
    """The checks of a file, made in a thread that may outlast the window."""

    checked = Signal(object)

    def __init__(self, file: ParameterFile) -> None:
        super().__init__()
        self._file = file

    def run(self, _progress: TaskProgress, cancelled: threading.Event) -> str:
        """Emit each check; returns why there are none, or no more."""
        try:
            for check in check_motion(self._file):
                if cancelled.is_set():
                    break
                self.checked.emit(check)
        except SimulationError as error:
            return error.what
        return ""


class CheckWindow(QDialog):
    """Runs every scenario in a thread and shows each check as soon as it is done."""

    def __init__(
        self, file: ParameterFile, show_parameter: Callable[[str], object], parent: QWidget | None = None
    ) -> None:
        """``file`` is a copy that nobody else changes."""
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self._checking, self._show_parameter = _Checking(file), show_parameter
        self.checks: list[MotionCheck] = []
        self._task: Task | None = None
        self._checking.checked.connect(self.show_check)
        self.setWindowTitle(self.tr("Check in Motion"))
        self.setModal(False)
        self.summary = QLabel()
        self.summary.setFont(font("text", own=True))
        self.table = QTableWidget(0, 5)
        self.table.setHorizontalHeaderLabels(
            [
                self.tr("Verdict"),
                self.tr("Scenario"),
                self.tr("Axis"),
                self.tr("What is not good"),
                self.tr("Figures"),
            ]
        )
        self.table.setAccessibleName(self.tr("Checks of the machine in motion"))
        self.table.setEditTriggers(QTableWidget.EditTrigger.NoEditTriggers)
        self.table.setSelectionBehavior(QTableWidget.SelectionBehavior.SelectRows)
        self.table.setWordWrap(True)
        self.table.verticalHeader().hide()
        self.table.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        for wide in (3, 4):
            self.table.horizontalHeader().setSectionResizeMode(wide, QHeaderView.ResizeMode.Stretch)
        self.table.currentCellChanged.connect(lambda *_: self._show_detail())
        self.detail = QLabel()
        self.detail.setWordWrap(True)
        self.detail.setTextFormat(Qt.TextFormat.RichText)
        self.detail.setTextInteractionFlags(Qt.TextInteractionFlag.TextBrowserInteraction)
        self.detail.setMinimumHeight(48)
        self.detail.linkActivated.connect(self._show_parameter)
        close = QPushButton(self.tr("&Close"))
        close.setAutoDefault(False)
        close.clicked.connect(self.close)
        foot = QHBoxLayout()
        foot.addWidget(self.summary, 1)
        foot.addWidget(close)
        column = QVBoxLayout(self)
        column.setContentsMargins(GAP3, GAP3, GAP3, GAP3)
        column.setSpacing(GAP2)
        column.addWidget(self.table, 1)
        column.addWidget(self.detail)
        column.addLayout(foot)
        fit_to_screen(self, 860, 560)

    def start(self) -> None:
        """Begin to check."""
        task = self._task = Task(self._checking.run)
        task.done.connect(self._over)
        task.failed.connect(self._over)
        task.begin()
        self._sum_up()

    def _over(self, why: object) -> None:
        self._task = None
        self._sum_up()
        if why:
            self.summary.setText(str(why))

    def closeEvent(self, event: QCloseEvent) -> None:  # Qt's name
        if self._task is not None:
            self._task.cancelled.set()
        super().closeEvent(event)

    def show_check(self, check: MotionCheck) -> None:
        """Add one check at the end."""
        self.checks.append(check)
        row = self.table.rowCount()
        self.table.insertRow(row)
        figures = ", ".join(_figure(name, value, unit) for name, (value, unit) in check.figures.items())
        mark, colour_name = MARKS[check.verdict]
        for column, text in enumerate(
            (self._word(check.verdict), check.scenario, check.letter, check.why, figures)
        ):
            item = QTableWidgetItem(text)
            item.setToolTip(text)
            if column == 0:
                item.setIcon(icon(mark, colour_name))
            self.table.setItem(row, column, item)
        self._sum_up()

    def _word(self, verdict: str) -> str:
        return {
            "good": self.tr("good"),
            "doubtful": self.tr("doubtful"),
            "bad": self.tr("bad"),
            "not possible": self.tr("not possible"),
        }[verdict]

    def _sum_up(self) -> None:
        counts = Counter(check.verdict for check in self.checks)
        words = [f"{count} {self._word(verdict)}" for verdict, count in counts.items()]
        if self._task is not None:
            words.append(self.tr("checking …"))
        self.summary.setText(", ".join(words))

    def _show_detail(self) -> None:
        """Show the alarms of the current check, and its parameters as links."""
        row = self.table.currentRow()
        if not 0 <= row < len(self.checks):
            return
        check = self.checks[row]
        parts = [f"<b>{alarm.code}</b> {alarm.message}" for alarm in check.alarms]
        if check.params:
            links = ", ".join(f'<a href="{each}">{each}</a>' for each in check.params)
            parts.append(f"{self.tr('Parameters:')} {links}")
        self.detail.setText("<br>".join(parts))


def _figure(name: str, value: float | None, unit: str) -> str:
    words = name.replace("_", " ")
    return f"{words} –" if value is None else f"{words} {written(value_text(float(value), unit))}"
