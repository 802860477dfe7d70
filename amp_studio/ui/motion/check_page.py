"""The page Machine of a file: every scenario that it allows with its verdict and a figure; of the chosen one
its picture, what is not good, all figures, and parameters to look at.
"""

from __future__ import annotations

import html
import threading
from bisect import bisect_right
from collections import Counter
from collections.abc import Callable

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import (
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QPushButton,
    QSplitter,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from amp_studio.files import ParameterFile
from amp_studio.schema import unit_text
from amp_studio.sim import MotionCheck, SimulationError, check_motion, picture_of, value_text
from amp_studio.ui.base.plot import Plot
from amp_studio.ui.base.task import Task, TaskProgress
from amp_studio.ui.base.theme import GAP2, GAP3, ROW, Token, colour, font, icon, scheme
from amp_studio.ui.base.translated import scenario_in_words, sentenced, worded
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.forms.elided_label import ElidedLabel
from amp_studio.ui.page.page_of_file import PageOfFile

from .results import name_of

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
            return sentenced(error.what, self._file.schema.family.family)
        return ""


_ORDER = {"bad": 0, "doubtful": 1, "good": 2, "not possible": 3}
"""Places of the verdicts in the list."""


class CheckPage(PageOfFile):
    """Runs every scenario in a thread and shows each check as soon as it is done; again after edits, once the
    page is seen.
    """

    motion_wanted = Signal(str, str)
    """The scenario and axis of a check are wanted as a motion."""

    def __init__(self, workspace: Workspace, show_parameter: Callable[[str], object]) -> None:
        super().__init__()
        self._workspace, self._show_parameter = workspace, show_parameter
        self._checking: _Checking | None = None
        self.checks: list[MotionCheck] = []
        self._drawn: MotionCheck | None = None
        self._begun_with: MotionCheck | None = None
        self._task: Task | None = None
        self._is_stale = True
        workspace.changed.connect(self._after_edit)
        workspace.closed.connect(self.stop)
        self.setAccessibleName(self.tr("Check in Motion"))
        self.summary = QLabel()
        self.summary.setFont(font("text", own=True))
        self.table = QTableWidget(0, 2)
        self.table.setHorizontalHeaderLabels([self.tr("Scenario"), self.tr("Figure")])
        self.table.verticalHeader().setDefaultSectionSize(ROW)
        self.table.setAccessibleName(self.tr("Checks of the machine in motion"))
        self.table.setEditTriggers(QTableWidget.EditTrigger.NoEditTriggers)
        self.table.setSelectionBehavior(QTableWidget.SelectionBehavior.SelectRows)
        self.table.setShowGrid(False)
        self.table.verticalHeader().hide()
        head = self.table.horizontalHeader()
        head.setDefaultAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        head.setHighlightSections(False)
        head.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        head.setStretchLastSection(True)
        self.table.currentCellChanged.connect(lambda *_: self._show_detail())
        scheme().changed.connect(self._show_detail)  # a link keeps the colour in which it was written
        self.title = ElidedLabel()
        self.title.setFont(font("title", own=True))
        self.plot = Plot(has_cursors=False)
        self.detail = QLabel()
        self.detail.setWordWrap(True)
        self.detail.setTextFormat(Qt.TextFormat.RichText)
        self.detail.setTextInteractionFlags(Qt.TextInteractionFlag.TextBrowserInteraction)
        self.detail.setMinimumHeight(48)
        self.detail.linkActivated.connect(self._show_parameter)
        self.motion = QPushButton(icon("activity"), self.tr("Show the &Move"))
        self.motion.setToolTip(self.tr("The scenario of the selected row in Motion (Enter)"))
        self.again = QPushButton(self.tr("Check Aga&in"))
        for button, step in ((self.motion, self._show_motion), (self.again, self.start)):
            button.setAutoDefault(False)
            button.clicked.connect(step)
        self.motion.setEnabled(False)
        self.table.cellActivated.connect(lambda *_: self._show_motion())
        self._lay_out()
        self.setFocusProxy(self.table)

    def _lay_out(self) -> None:
        left, right = QWidget(), QWidget()
        for side, parts in (
            (left, (self.table, self.summary)),
            (right, (self.title, self.plot, self.detail)),
        ):
            column = QVBoxLayout(side)
            column.setContentsMargins(0 if side is left else GAP2, 0, 0, 0)
            column.setSpacing(GAP2)
            for part in parts:
                column.addWidget(part, int(part is self.plot or part is self.table))
        foot = QHBoxLayout()
        foot.addStretch()
        foot.addWidget(self.again)
        foot.addWidget(self.motion)
        right_column = right.layout()
        assert isinstance(right_column, QVBoxLayout)
        right_column.addLayout(foot)
        splitter = QSplitter(Qt.Orientation.Horizontal)
        for side, share in ((left, 3), (right, 7)):
            splitter.addWidget(side)
            splitter.setStretchFactor(splitter.count() - 1, share)
        splitter.setSizes([3000, 7000])
        column = QVBoxLayout(self)
        column.setContentsMargins(GAP3, GAP3, GAP3, GAP3)
        column.addWidget(splitter)

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        if self._is_stale:
            self.start()

    def _after_edit(self, *_: object) -> None:
        self._is_stale = True
        if self.isVisible():
            self.start()

    def start(self) -> None:
        """Check the file as it is now, on a copy; a check that is under way is cancelled."""
        self.stop()
        self._is_stale = False
        self.checks.clear()
        self.table.setRowCount(0)
        self.detail.clear()
        self.title.clear()
        self.plot.clear_picture()
        self._drawn = None
        self.motion.setEnabled(False)
        checking = self._checking = _Checking(self._workspace.file.copy())
        checking.checked.connect(self.show_check)
        task = self._task = Task(checking.run)
        task.done.connect(self._over)
        task.failed.connect(self._over)
        task.begin()
        self._sum_up()

    def stop(self) -> None:
        """Cancel the check that is under way."""
        if self._task is not None and self._checking is not None:
            # Cut off first: the thread may emit one more check before it sees that it is cancelled.
            self._checking.checked.disconnect(self.show_check)
            self._task.done.disconnect(self._over)
            self._task.failed.disconnect(self._over)
            self._task.cancelled.set()
            self._task = None

    def _show_motion(self) -> None:
        if 0 <= (row := self.table.currentRow()) < len(self.checks):
            self.motion_wanted.emit(self.checks[row].scenario, self.checks[row].axis)

    @property
    def _family(self) -> str:
        return self._workspace.file.schema.family.family

    def _over(self, why: object) -> None:
        self._task = None
        if self.checks and self._drawn is self._begun_with:  # the person has chosen none: the worst is first
            self.table.setCurrentCell(0, 0)
        self._sum_up()
        if why:
            self.summary.setText(str(why))

    def show_check(self, check: MotionCheck) -> None:
        """Add one check: what is bad comes first, then in the order in which it was tried."""
        row = bisect_right([_ORDER[each.verdict] for each in self.checks], _ORDER[check.verdict])
        self.checks.insert(row, check)
        self.table.insertRow(row)
        mark, colour_name = MARKS[check.verdict]
        name = " ".join(filter(None, (scenario_in_words(check.scenario), check.letter)))
        for column, text in enumerate((name, next(iter(_figures(check)), ""))):
            item = QTableWidgetItem(text)
            item.setToolTip(f"{text}: {self._word(check.verdict)}")
            if column == 0:
                item.setIcon(icon(mark, colour_name))
                item.setData(Qt.ItemDataRole.AccessibleTextRole, item.toolTip())
            self.table.setItem(row, column, item)
        if self.table.currentRow() < 0:
            self._begun_with = check
            self.table.setCurrentCell(0, 0)
        self._sum_up()

    def _word(self, verdict: str) -> str:
        return {
            "good": self.tr("good"),
            "doubtful": self.tr("doubtful"),
            "bad": self.tr("bad"),
            "not possible": self.tr("not possible"),
        }[verdict]

    def _sum_up(self) -> None:
        counts = Counter[str](check.verdict for check in self.checks)
        words = [f"{counts[verdict]} {self._word(verdict)}" for verdict in _ORDER if counts[verdict]]
        if self._task is not None:
            words.append(self.tr("checking …"))
        self.summary.setText(", ".join(words))

    def _show_detail(self) -> None:
        """Show the picture of the current check, its alarms and figures, and its parameters as links."""
        row = self.table.currentRow()
        if not 0 <= row < len(self.checks):
            return
        check = self.checks[row]
        self.motion.setEnabled(check.verdict != "not possible")
        titles = (scenario_in_words(check.scenario), check.letter, self._word(check.verdict))
        self.title.setText(" · ".join(filter(None, titles)))
        if check.trace is None:
            self.plot.clear_picture()
        elif check is not self._drawn:
            self.plot.draw(picture_of(check.trace))
        self._drawn = check
        parts = [
            f"<b>{alarm.code}</b> {html.escape(sentenced(alarm.message, self._family))}"
            for alarm in check.alarms
        ] or [html.escape(sentenced(check.why, self._family))]
        parts.append(html.escape(", ".join(_figures(check))))
        if check.params:
            names = {each: name_of(self._workspace.file.schema, each) for each in check.params}
            shade = colour("sel").name()
            links = ", ".join(
                f'<a href="{each}" style="color:{shade}">{html.escape(name)}</a>'
                for each, name in names.items()
            )
            parts.append(f"{self.tr('Parameters:')} {links}")
        self.detail.setText("<br>".join(filter(None, parts)))


def _figures(check: MotionCheck) -> list[str]:
    """Return the figures of a check in words, each with its number first: where there is no room for all, the
    number stays.
    """
    return [
        f"{_number(value, unit)} {worded(name.replace('_', ' '))}"
        for name, (value, unit) in check.figures.items()
    ]


def _number(value: float | None, unit: str) -> str:
    return "–" if value is None else sentenced(value_text(float(value), unit_text(unit)))
