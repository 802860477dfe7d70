"""The page Machine of a file: every scenario that it allows as a row with its verdict, the share of its limit
and a figure; of the chosen one its picture, what is not good and what mends it; below the plan of the travel
and the spindle.
"""

from __future__ import annotations

import html
import threading
import time
from collections.abc import Callable, Iterable, Sequence
from functools import partial

from PySide6.QtCore import QEvent, QModelIndex, QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent, QKeySequence, QShortcut, QShowEvent
from PySide6.QtWidgets import QLabel, QMessageBox, QPushButton, QSplitter, QToolButton, QWidget

from amp_studio.files import ParameterFile, RangeError, check_output
from amp_studio.schema import Address, Value
from amp_studio.sim import (
    MotionCheck,
    Recommendation,
    SimulationError,
    address_of,
    check_again,
    check_motion,
    value_text,
)
from amp_studio.ui.base.ask_path import ask_to_save
from amp_studio.ui.base.figures import unbroken, written
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.loading import load
from amp_studio.ui.base.places import sentenced_with_letters
from amp_studio.ui.base.questions import show_message
from amp_studio.ui.base.task import Task, TaskProgress, in_background
from amp_studio.ui.base.theme import GAP, GAP2, GAP3, SMALL_ICON, colour, font, icon, scheme
from amp_studio.ui.base.translated import (
    language_of_window,
    scenario_in_words,
    sentenced,
    unit_in_words,
    written_to,
)
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.dialogs.file_dialogs import PAPER_KINDS
from amp_studio.ui.forms.elided_label import ElidedLabel
from amp_studio.ui.forms.segment import chip
from amp_studio.ui.page.page_of_file import PageOfFile

from .check_list import (
    MARKS,
    CheckRows,
    MachineCheckList,
    counts_of,
    figures_of,
    part_in_words,
    verdict_in_words,
)
from .latest_work import LatestWork
from .machine_cards import CheckCard, SpindleCard, TravelCard
from .results import name_of

LEFT = 280
"""Least width of the list in logical pixels."""
AXES = 4
"""Axes that have a key."""
MAX_LINKS = 5
"""Parameters of a check that are links; those after them are counted, and named in the tooltip."""


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
            return sentenced_with_letters(self._file, error.what)
        return ""


def _is_run(event: QEvent) -> bool:
    """Return whether a key is F9."""
    return isinstance(event, QKeyEvent) and event.key() == Qt.Key.Key_F9 and not event.modifiers()


class _WholeLabel(ElidedLabel):
    """A heading that is there whole or not at all: a first letter alone names nothing."""

    def _elided(self) -> str:
        return self.text() if super()._elided() == self.text() else ""


class CheckPage(PageOfFile):
    """Runs every scenario in a thread and shows each check as soon as it is done; again after edits, once the
    page is seen.
    """

    motion_requested = Signal(str, str)
    """The scenario and axis of a check are wanted as a motion."""

    def __init__(self, workspace: Workspace, show_parameter: Callable[[str], object]) -> None:
        super().__init__()
        self._workspace, self._show_parameter = workspace, show_parameter
        self._checking: _Checking | None = None
        self._task: Task | None = None
        self._is_stale = True
        self._begun, self._lasted = 0.0, 0.0
        self._axis = ""
        """The axis that was chosen last."""
        self._chosen = ("", "")
        """Scenario and axis of the row that was chosen last, which stays after an edit."""
        self._fix: dict[Address, Value | None] = {}
        """What the offered fix sets."""
        self.rows = CheckRows(workspace.file)
        self.list = MachineCheckList(self.rows)
        self.list.setAccessibleName(self.tr("Checks of the machine in motion"))
        self.setAccessibleName(self.tr("Check in Motion"))
        self.card, self.travel, self.spindle = CheckCard(), TravelCard(), SpindleCard()
        self._again = LatestWork()
        self._make_head()
        self._lay_out()
        self._connect()
        self.setFocusProxy(self.list)

    @property
    def checks(self) -> list[MotionCheck]:
        """The checks so far, in the order in which they were made."""
        return self.rows.checks

    @property
    def check(self) -> MotionCheck | None:
        """The chosen check."""
        return self.rows.check(self.list.currentIndex())

    @property
    def _family(self) -> str:
        return self._workspace.file.schema.family.family

    # -- how it is laid out ----------------------------------------------------------

    def _make_head(self) -> None:
        self.heading = _WholeLabel()
        self.heading.setText(self.tr("Checks"))
        strong = font("text", own=True)
        strong.setWeight(strong.Weight.DemiBold)
        self.heading.setFont(strong)
        self.chips: dict[str, QToolButton] = {}
        for verdict in MARKS:
            button = self.chips[verdict] = chip("", verdict_in_words(verdict))
            button.setAccessibleName(verdict_in_words(verdict))
            button.clicked.connect(self._filter)
        self.summary = ElidedLabel()
        self.summary.setFont(font("small", own=True))
        self.report = QPushButton(icon("printer"), self.tr("Rep&ort…"))
        self.report.setToolTip(self.tr("Write the list and the pictures as a document"))
        self.title, self.why = ElidedLabel(), ElidedLabel()
        self.title.setFont(font("title", own=True))
        self.mark = QLabel()
        self.assumptions = QPushButton()
        self.assumptions.setFlat(True)
        self.motion = QPushButton(icon("activity"), self.tr("Show the &Move"))
        self.motion.setToolTip(self.tr("The scenario of the selected row in Motion (Enter)"))
        self.again = QPushButton(icon("play"), self.tr("Check Aga&in"))
        self.again.setToolTip(self.tr("Run every scenario again (F9)"))
        self.detail = QLabel()
        self.detail.setWordWrap(True)
        self.detail.setTextFormat(Qt.TextFormat.RichText)
        self.detail.setTextInteractionFlags(Qt.TextInteractionFlag.TextBrowserInteraction)
        self.motion.setEnabled(False)
        self._paint_chips()

    def _lay_out(self) -> None:
        left, right = QWidget(), QWidget()
        in_column(
            in_row((self.heading, 1), *self.chips.values(), margins=(GAP3, GAP, GAP2, GAP), gap=GAP),
            (self.list, 1),
            in_row((self.summary, 1), self.report, margins=(GAP3, GAP, GAP2, GAP)),
            on=left,
            margins=0,
            gap=0,
        )
        in_column(
            in_row(self.title, self.mark, (self.why, 1), self.assumptions, self.motion, self.again, gap=GAP2),
            (self.card, 5),
            self.detail,
            (in_row((self.travel, 1), (self.spindle, 1), gap=GAP2), 4),
            on=right,
            margins=(GAP2, GAP, GAP2, GAP2),
            gap=GAP2,
        )
        left.setMinimumWidth(LEFT)
        splitter = QSplitter(Qt.Orientation.Horizontal)
        for side, share in ((left, 27), (right, 73)):
            splitter.addWidget(side)
            splitter.setStretchFactor(splitter.count() - 1, share)
        splitter.setSizes([2700, 7300])
        in_column(splitter, on=self, margins=0)

    def _connect(self) -> None:
        self._workspace.changed.connect(self._after_edit)
        self._workspace.closed.connect(self.stop)
        self.list.selectionModel().currentChanged.connect(self._chosen_row)
        self.list.activated.connect(lambda _index: self._show_motion())
        self.detail.linkActivated.connect(self._show_parameter)
        self.report.clicked.connect(self.write_report)
        self.motion.clicked.connect(self._show_motion)
        self.again.clicked.connect(self.start)
        self.assumptions.clicked.connect(self._show_assumptions)
        self.card.axis_requested.connect(self._show_axis)
        self.card.length_given.connect(self._home_with_marker)
        self.card.fix_requested.connect(self._apply_fix)
        for view in (self.card.scene, self.travel.scene, self.spindle.scene):
            view.parameter_requested.connect(lambda address: self._show_parameter(address[0]))
        self._again.done.connect(self._take_again)
        scheme().changed.connect(self._repaint)
        for n in range(AXES):
            key = QShortcut(QKeySequence(str(n + 1)), self, partial(self._show_nth, n))
            key.setContext(Qt.ShortcutContext.WidgetWithChildrenShortcut)

    def _repaint(self) -> None:
        self._paint_chips()
        self._show_detail()

    def _paint_chips(self) -> None:
        for verdict, button in self.chips.items():
            button.setIcon(icon(*MARKS[verdict]))

    # -- when it runs ------------------------------------------------------------------

    def event(self, event: QEvent) -> bool:
        """Take F9, which shows the motion elsewhere."""
        is_taken = event.type() == QEvent.Type.ShortcutOverride and _is_run(event)
        # Accepted here, F9 comes as a key of this page instead of the action of the window.
        if is_taken:
            event.accept()
        return is_taken or super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Run everything again by F9."""
        if _is_run(event):
            self.start()
        else:
            super().keyPressEvent(event)

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
        self._begun = time.monotonic()
        self.rows.file = self._workspace.file
        # The old verdicts go at once: they are of another file.
        self.rows.show_checks((), self.rows.wanted)
        self._show_detail()
        checking = self._checking = _Checking(self._workspace.file.copy())
        checking.checked.connect(self.show_check)
        task = self._task = Task(checking.run)
        task.done.connect(self._over)
        task.failed.connect(self._over)
        task.begin()
        self._show_summary()

    def stop(self) -> None:
        """Cancel the check that is under way."""
        for latest in (self._again, self.travel.latest, self.spindle.latest):
            latest.stop()
        if self._task is not None and self._checking is not None:
            # Cut off first: the thread may emit one more check before it sees that it is cancelled.
            self._checking.checked.disconnect(self.show_check)
            self._task.done.disconnect(self._over)
            self._task.failed.disconnect(self._over)
            self._task.cancelled.set()
            self._task = None

    def _over(self, why: object) -> None:
        self._task = None
        self._lasted = time.monotonic() - self._begun
        self._show_summary()
        self.travel.follow(self._workspace.file.copy())
        has_spindle = any(
            check.part == "spindle" and check.verdict != "not possible" for check in self.checks
        )
        self.spindle.follow(self._workspace.file.copy(), has_spindle)
        if self.check is None:
            self.choose(*self._chosen)
        if why:
            self.summary.setText(str(why))

    def show_check(self, check: MotionCheck) -> None:
        """Add one check in its place."""
        self.rows.add(check)
        # The row that was chosen before the file was edited is chosen again as soon as it is there.
        if (check.scenario, check.axis) == self._chosen:
            self.choose(*self._chosen)
        self._show_summary()

    # -- the list ------------------------------------------------------------------------

    def _filter(self) -> None:
        wanted = [verdict for verdict, button in self.chips.items() if button.isChecked()]
        self.rows.show_checks(self.checks, wanted)
        self.choose(*self._chosen)

    def _show_summary(self) -> None:
        counts = counts_of(self.checks)
        for verdict, button in self.chips.items():
            button.setText(str(counts[verdict]))
            # A filter that is on stays: without its button it could not be switched off.
            button.setVisible(bool(counts[verdict]) or button.isChecked())
        if self._task is not None:
            self.summary.setText(self.tr("checking …"))
            return
        many = self.tr("%n checks", "", len(self.checks))
        lasted = written(value_text(self._lasted, digits=2))
        self.summary.setText(self.tr("{checks} in {time} s").format(checks=many, time=lasted))

    def choose(self, scenario: str, axis: str) -> None:
        """Choose the row of a scenario and axis; where there is none the first of the worst."""
        rows = {n: row for n, row in enumerate(self.rows.rows) if isinstance(row, MotionCheck)}
        own = [n for n, row in rows.items() if (row.scenario, row.axis) == (scenario, axis)]
        order = list(MARKS)
        worst = sorted(rows, key=lambda n: order.index(rows[n].verdict))
        # Without the row of before: the worst one, which needs work first.
        for at in (*own, *worst)[:1]:
            self.list.setCurrentIndex(self.rows.index(at))

    def _chosen_row(self, current: QModelIndex, _previous: QModelIndex) -> None:
        check = self.rows.check(current)
        if check is not None:
            self._chosen, self._axis = (check.scenario, check.axis), check.axis or self._axis
            self.travel.show_axis(check.axis)
            if check.scenario == "tap" and self.spindle.isVisible():
                self.spindle.show_view("tap")
        self._show_detail()

    def _axes_of(self, scenario: str) -> list[tuple[str, str]]:
        """Return the axes that have a scenario, with their letters."""
        own = {each.axis: each.letter for each in self.checks if each.scenario == scenario and each.axis}
        return list(own.items())

    def _show_axis(self, axis: str) -> None:
        if self.check is not None:
            self.choose(self.check.scenario, axis)

    def _show_nth(self, n: int) -> None:
        if self.check is not None:
            axes = self._axes_of(self.check.scenario)
            if n < len(axes):
                self._show_axis(axes[n][0])

    def _show_motion(self) -> None:
        if self.check is not None and self.check.verdict != "not possible":
            self.motion_requested.emit(self.check.scenario, self.check.axis)

    # -- the chosen check ------------------------------------------------------------------

    def _show_detail(self) -> None:
        """Show the picture of the current check, what is not good, its figures, and its parameters."""
        check = self.check
        self.motion.setEnabled(check is not None and check.verdict != "not possible")
        self._offer(())
        if check is None:
            for label in (self.title, self.why, self.detail):
                label.clear()
            self.mark.setPixmap(icon("circle-dashed", "dim").pixmap(0, 0))
            self.assumptions.hide()
            self.card.show_reason("")
            return
        self._show(check)
        # Recommendations take as long as the check again: only for what is not good, and once all is checked.
        if check.verdict in ("bad", "doubtful") and self._task is None:
            self._ask_again(check, None)

    def _show(self, check: MotionCheck) -> None:
        parts = (scenario_in_words(check.scenario), check.letter)
        self.title.setText(", ".join(filter(None, parts)))
        mark, tint = MARKS[check.verdict]
        self.mark.setPixmap(icon(mark, tint).pixmap(SMALL_ICON, SMALL_ICON))
        self.mark.setAccessibleName(verdict_in_words(check.verdict))
        why = sentenced_with_letters(self._workspace.file, check.why)
        self.why.setText(why or verdict_in_words(check.verdict))
        self.why.setStyleSheet(f"color: {colour(tint).name()}")
        self.assumptions.setText(self.tr("%n assumptions", "", len(check.assumptions)))
        self.assumptions.setVisible(bool(check.assumptions))
        self.card.show_check(
            self._workspace.file, check, part_in_words(check.part), self._axes_of(check.scenario)
        )
        self.detail.setText(unbroken("<br>".join(self._lines_of(check))))
        self.detail.setVisible(bool(self.detail.text()))
        schema = self._workspace.file.schema
        self.detail.setToolTip("\n".join(name_of(schema, each) for each in dict.fromkeys(check.params)))

    def _lines_of(self, check: MotionCheck) -> Iterable[str]:
        """Yield figures and parameters of a check."""
        if figures := ", ".join(figures_of(check)):
            yield html.escape(figures)
        if check.params:
            shade, named = colour("sel").name(), list(dict.fromkeys(check.params))
            # Each parameter once, though several limits may name it.
            links = [
                f'<a href="{each}" style="color:{shade}">'
                f"{html.escape(name_of(self._workspace.file.schema, each))}</a>"
                for each in named[:MAX_LINKS]
            ]
            if len(named) > MAX_LINKS:  # a fourth line has no room on a screen at 200 %
                links.append(self.tr("%n more", "", len(named) - MAX_LINKS))
            yield f"{self.tr('Parameters:')} {', '.join(links)}"

    def _show_assumptions(self) -> None:
        if self.check is not None:
            file = self._workspace.file
            text = "\n\n".join(sentenced_with_letters(file, each) for each in self.check.assumptions)
            title = self.tr("What was assumed")
            show_message(self, title, text, QMessageBox.Icon.Information)

    # -- the fix ---------------------------------------------------------------------------

    def _home_with_marker(self, length: str | None) -> None:
        if self.check is not None:
            self._ask_again(self.check, length)

    def _ask_again(self, check: MotionCheck, length: str | None) -> None:
        """Run a check again with what is recommended, and with a switch of a length where one is given."""
        settings = {"move.switch_length": length} if length else None
        file, axis = self._workspace.file.copy(), check.axis or None
        self._again.ask(partial(check_again, file, check.scenario, axis, settings))

    def _take_again(self, found: object) -> None:
        check = self.check
        if not isinstance(found, MotionCheck) or check is None:
            return
        # Another row has been chosen while it was computed.
        if (found.scenario, found.axis) != (check.scenario, check.axis):
            return
        self._show(found)
        self._offer(found.trace.recommendations if found.trace else ())

    def _offer(self, found: Sequence[Recommendation]) -> None:
        """Offer what is recommended as one fix: gains of one loop belong together."""
        file, check = self._workspace.file, self.check
        usable = dict[Address, Recommendation]()
        if check is not None and self._workspace.may_edit:
            addresses = ((address_of(file, each.parameter, check.axis), each) for each in found)
            usable = {address: each for address, each in addresses if address is not None}
        self._fix = {address: self._value(address, each) for address, each in usable.items()}
        if not usable:
            self.card.offer_fix("")
            return
        words = [self._fix_in_words(address, each) for address, each in usable.items()]
        self.card.offer_fix(words[0] if len(words) == 1 else self.tr("Set %n values", "", len(words)))
        why = dict.fromkeys(
            sentenced(f"{each.why} {each.price}".strip(), self._family) for each in usable.values()
        )
        self.card.fix.setToolTip("\n".join((*words, *why)))

    def _value(self, address: Address, fix: Recommendation) -> Value:
        old = self._workspace.file.get(address)
        is_whole = old is not None and isinstance(old.value, int) and fix.value.is_integer()
        return Value(int(fix.value) if is_whole else fix.value, fix.unit)

    def _fix_in_words(self, address: Address, fix: Recommendation) -> str:
        schema = self._workspace.file.schema
        called = self._workspace.file.machine_schema.number(address) or name_of(schema, fix.parameter)
        value = written(value_text(fix.value, unit_in_words(fix.unit), 6))
        return self.tr("Set {parameter} to {value}").format(parameter=called, value=value)

    def _apply_fix(self) -> None:
        try:
            self._workspace.edit(self.tr("Apply Recommendation"), self._fix)
        except RangeError as error:
            self.why.setText(str(error))

    # -- on paper --------------------------------------------------------------------------

    def write_report(self) -> None:
        """Ask for a file, and write the list with its pictures."""
        load("amp_studio.motion_paper")
        from amp_studio.motion_paper import write_check_paper

        path = self._workspace.path
        near = path.with_name(f"{path.stem}-check.pdf")
        target = ask_to_save(self, self.tr("Report of the Check"), near, PAPER_KINDS)
        if target is None:
            return
        check_output(target, path)
        file, checks, notes = self._workspace.file.copy(), list(self.checks), list[str]()
        in_background(
            self,
            self.tr("Report of the Check"),
            lambda: write_check_paper(
                file, path.name, checks, target, notes.append, language=language_of_window()
            ),
        )
        self.summary.setText("; ".join([written_to(target), *notes]))
