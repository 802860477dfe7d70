"""The window that compares two or three sources and merges them into the open file, or into a new one."""

from __future__ import annotations

import threading
from collections.abc import Callable
from functools import partial
from itertools import pairwise

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QDialog, QListWidgetItem, QTreeView, QWidget

from amp_studio.files import Merge, MergeChoice, ParameterFile, Row, Side
from amp_studio.schema import Address, same_value
from amp_studio.ui.base.layout import in_column
from amp_studio.ui.base.screen_room import fit_to_screen
from amp_studio.ui.base.single_shot import single_shot
from amp_studio.ui.base.task import PATIENCE_MS, Task
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.forms.message_bar import MessageBar

from .bars import FindingList, ReadingBar, ResultBar, ViewBar
from .check import MergeCheck
from .columns import BASE, SIDES, A, B
from .detail import MergeDetail
from .header import MergeHeader
from .model import Filter, MergeModel
from .report import save_merge_report
from .sources import MergeSource, MergeSources, Offer, ReadSource, is_same_content
from .tree import MergeTree

_LIVE_MS = 150
"""Milliseconds after an edit of the file until the comparison follows."""
Offers = Callable[[], list[tuple[str, list[Offer]]]]
SaveResult = Callable[[ParameterFile], object]


class MergeWindow(QDialog):
    """Stays open beside the table. The file is changed by Merge alone, in one step that can be undone."""

    went_to = Signal(object)
    """An address that is to be shown in the table."""
    merged = Signal(str, int)
    """The result is in the file: from where, and how many values it changed."""

    def __init__(
        self,
        workspace: Workspace,
        sources: MergeSources,
        offers: Offers,
        save_result: SaveResult,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowFlag(Qt.WindowType.WindowMaximizeButtonHint)
        self.setWindowTitle(self.tr("Compare and Merge: {file}").format(file=workspace.path.name))
        self.workspace, self.sources = workspace, sources
        sources.setParent(self)
        first = sources.now()
        self.chosen: dict[int, MergeSource] = {A: first, B: first}
        """Column -> its source; without a base there is no entry for it."""
        self._reading: dict[int, threading.Event] = {}
        """Column -> what cancels the reading of its source. Not the task: a connection of a task that leads
        to the task itself keeps both, and this window, for good."""
        self.check = MergeCheck(workspace, self)
        self._warned = False
        units = None if workspace.as_entered else workspace.file.header.units
        self.model = MergeModel(Merge(first.file, first.file), units=units, secrets=workspace.secrets)
        self.tree = MergeTree(self.model, lambda tree: self._make_header(offers, tree))
        self.head = self.tree.head
        self.detail = MergeDetail(self.model, self.check.of_choice)
        self._build()
        self._follow = single_shot(self, self._read_again, _LIVE_MS)
        self._update = single_shot(self, self._after_choice, 0)
        self._patience = single_shot(self, self.reading.show, PATIENCE_MS)
        self._connect(save_result)
        fit_to_screen(self, 1180, 740)
        self._show_sources()

    # -- building ------------------------------------------------------------------------

    def _make_header(self, offers: Offers, tree: QTreeView) -> MergeHeader:
        return MergeHeader(offers, self.start, tree)

    def _build(self) -> None:
        self.message, self.reading, self.findings = MessageBar(), ReadingBar(), FindingList()
        self.view = ViewBar(list(self.workspace.file.schema.family.units), self.model.units)
        self.outcome = ResultBar(self.findings)
        self.detail.setFixedHeight(122)
        in_column(
            self.view,
            self.reading,
            self.message,
            (self.tree, 1),
            self.detail,
            self.findings,
            self.outcome,
            on=self,
            margins=0,
            gap=0,
        )
        self.tree.setStyleSheet("QTreeView { border: 0 }")
        self.tree.setFocus()
        order = (self.view.next, *self.head.buttons.values(), self.tree, self.detail.buttons["base"])
        for first, second in pairwise(order):
            self.setTabOrder(first, second)

    def _connect(self, save_result: SaveResult) -> None:
        view, tree, sources = self.view, self.tree, self.sources
        view.two.clicked.connect(lambda: self.use_base(None))
        view.three.clicked.connect(
            lambda: self.use_base(sources.as_saved())
        )  # another can be chosen over its column
        view.swap.clicked.connect(self.swap_sides)
        for system, button in view.units.items():
            button.clicked.connect(partial(self._show_in, system))
        for chip in (view.only_differences, view.only_conflicts, view.only_active):
            chip.toggled.connect(self._filter)
        view.search.textChanged.connect(self._filter)
        view.previous.clicked.connect(partial(tree.step, -1))
        view.next.clicked.connect(partial(tree.step, 1))
        self.reading.cancel.clicked.connect(self.stop_reading)
        tree.current_row.connect(self.detail.show_row)
        tree.went_to.connect(self.went_to)
        tree.delegate.typed.connect(self._choose)
        self.detail.chosen.connect(self._choose)
        self.check.ready.connect(self._after_choice)
        self.check.failed.connect(self._not_checked)
        self.model.chosen.connect(self._count)
        self.model.chosen.connect(self._update.start)
        self.findings.itemActivated.connect(self._show_finding)
        self.outcome.save.clicked.connect(lambda: save_result(self.merge.result()))
        self.outcome.report.clicked.connect(self.report)
        self.outcome.merge.clicked.connect(self.merge_into)
        self.workspace.changed.connect(self._edited)
        self.workspace.closed.connect(self.close)
        QShortcut(QKeySequence(QKeySequence.StandardKey.Find), self, view.search.setFocus)
        QShortcut(QKeySequence("Ctrl+M"), self, view.next_units)

    def _choose(self, row: Row, choice: MergeChoice) -> None:
        self.model.choose([row], choice)

    def _edited(self, *_: object) -> None:
        if self.model.secrets != self.workspace.secrets:  # masked at once
            self.model.show_in(self.model.units, secrets=self.workspace.secrets)
        self._follow.start()

    # -- sources ---------------------------------------------------------------------------

    @property
    def merge(self) -> Merge:
        """The sources and what was chosen."""
        return self.model.merge

    def start(self, column: int, begin: Callable[[], ReadSource | None]) -> None:
        """Read a source in the background and show it; an error is a message, and the source before it
        stays.
        """
        try:
            read = begin()
        except (OSError, ValueError) as error:
            self.message.say(str(error), "error")
            return
        if read is not None:
            self.read(column, read)

    def read(self, column: int, read: ReadSource) -> None:
        """Read a source in the background."""
        task = Task(read)
        cancelled = self._reading[column] = task.cancelled
        task.progressed.connect(self.reading.show_stage)
        task.done.connect(partial(self._read_done, column, cancelled))
        task.failed.connect(partial(self._read_failed, column, cancelled))
        self.reading.show_stage()
        self._patience.start()
        task.begin()

    def stop_reading(self) -> None:
        """Cancel what is being read; the sources stay as they were."""
        for cancelled in self._reading.values():
            cancelled.set()
        self.reading.stage.setText(self.tr("Stopping at the next safe point …"))

    def _read_done(self, column: int, cancelled: threading.Event, source: MergeSource) -> None:
        if self._reading.get(column) is not cancelled:
            return
        self._is_read(column)
        if not cancelled.is_set():
            self.use(column, source)

    def _read_failed(self, column: int, cancelled: threading.Event, error: Exception) -> None:
        if self._reading.get(column) is not cancelled:
            return
        self._is_read(column)
        if column == BASE and BASE not in self.chosen:
            self.view.two.setChecked(True)
        if not cancelled.is_set():
            self.message.say(str(error), "error")

    def _is_read(self, column: int) -> None:
        del self._reading[column]
        if not self._reading:
            self._patience.stop()
            self.reading.hide()

    def use(self, column: int, source: MergeSource) -> None:
        """Compare with a source that has been read."""
        self.show_merge({**self.chosen, column: source}, replaced=SIDES[column])
        if source.remark:
            self.message.say(source.remark, "information")

    def use_base(self, source: MergeSource | None) -> None:
        """Compare three sources; None goes back to two."""
        chosen = {column: each for column, each in self.chosen.items() if column != BASE}
        self.show_merge(chosen if source is None else {**chosen, BASE: source}, replaced="base")

    def show_merge(
        self, chosen: dict[int, MergeSource], *, swapped: bool = False, replaced: Side | None = None
    ) -> None:
        """Show sources; what was chosen stays where rows still differ,
        but for what was taken from a side that is ``replaced``.

        A source of another family is refused.
        """
        base = chosen.get(BASE)
        try:
            initial: Side = "b" if chosen[B].is_now and not chosen[A].is_now else "a"
            merge = Merge(chosen[A].file, chosen[B].file, base.file if base else None, initial=initial)
        except ValueError as error:
            self.message.say(str(error), "error")
            return
        merge.keep_choices(self.merge, swapped=swapped, without=replaced)
        here = self.tree.row()
        self.chosen = chosen
        self.model.set_merge(merge)
        self._show_sources()
        if here is not None:
            self.tree.show_row(here)

    def swap_sides(self) -> None:
        """Exchange A and B with what was taken from them."""
        self.show_merge({**self.chosen, A: self.chosen[B], B: self.chosen[A]}, swapped=True)

    def _show_sources(self) -> None:
        has_base = BASE in self.chosen
        (self.view.three if has_base else self.view.two).setChecked(True)
        self.tree.setColumnHidden(BASE, not has_base)
        for column, button in self.head.buttons.items():
            button.show_source(self.chosen.get(column))
        self.head.target = self.tr("goes to {file}").format(file=self.workspace.path.name)
        text = self.tr("{differ} differ, {same} the same")
        self.head.counts = text.format(differ=len(self.merge.differing), same=self.merge.same)
        self.view.only_conflicts.setText(self.tr("Conflicts") + f" {len(self.merge.conflicts)}")
        self.view.only_conflicts.setEnabled(has_base)
        self.view.only_conflicts.setChecked(has_base and self.view.only_conflicts.isChecked())
        self.head.viewport().update()
        self.tree.fit()
        self.head.place()
        self.tree.unfold()
        self.check.start(self.merge, is_file=self._target_column() is not None)
        self._after_choice()

    def _read_again(self) -> None:
        """Follow an edit of the file that is compared; what was only shown otherwise is no edit."""
        now, column = self.sources.now(), self._target_column()
        if column is not None and not is_same_content(self.chosen[column].file, now.file):
            self.show_merge({c: now if each.is_now else each for c, each in self.chosen.items()})

    # -- what the result would be ---------------------------------------------------------------

    def _not_checked(self, why: str) -> None:
        self.message.say(
            self.tr("The result cannot be checked, and so not merged: {why}").format(why=why), "error"
        )

    def _after_choice(self) -> None:
        """Check the result again after a choice, and show what comes of it."""
        self._update.stop()
        self.check.follow()
        self.detail.show_row(self.tree.row())
        self.outcome.show_findings(self.check.new() if self.check.is_ready else None)
        self._count()

    def _count(self) -> None:
        """Update the counts and the buttons; at once, before the next click."""
        merge, side = self.merge, self._target_side()
        decided = (row for row in merge.differing if merge.choice(row) is not None)
        changes = sum(not same_value(merge.result_of(row), row.of(side)) for row in decided)
        left = len(self.merge.open_conflicts)
        self.outcome.show_counts(left, changes)
        self._enable(changes, left)

    def _enable(self, changes: int, left: int) -> None:
        errors = sum(f.severity == "error" for f in self.check.new())
        self._warned = self._warned and bool(errors)
        if self._warned:
            self.outcome.merge.setText(self.tr("&Merge Anyway (%n New Errors)", "", errors))
        else:
            name = self.workspace.path.stem.replace("&", "&&")
            self.outcome.merge.setText(self.tr("&Merge into {file}").format(file=name))
        why = ""
        if left:
            why = self.tr("Settle every conflict first.")
        elif self._target_column() is None:
            why = self.tr("Neither A nor B is the open file: save the result as a new file.")
        elif not self.workspace.may_edit:
            why = self.tr("The file is open read-only.")
        elif not changes:
            why = self.tr("Nothing has been taken yet.")
        elif not self.check.is_ready:
            why = self.tr("The result is being checked.")
        self.outcome.merge.setEnabled(not why)
        self.outcome.merge.setToolTip(why)
        self.outcome.save.setEnabled(not left)

    def _target_column(self) -> int | None:
        return next((column for column in (A, B) if self.chosen[column].is_now), None)

    def _target_side(self) -> Side:
        return "b" if self._target_column() == B else "a"

    def _show_finding(self, item: QListWidgetItem) -> None:
        finding = FindingList.finding(item)
        rows = {row.address: row for row in self.merge.differing if row.id.part == "value"}
        row = next((rows[address] for address in finding.addresses if address in rows), None)
        if row is not None:
            self.tree.show_row(row)
            self.tree.setFocus()

    # -- doing it ------------------------------------------------------------------------------

    def merge_into(self) -> None:
        """Put the result into the open file as one step; new errors are shown before."""
        if self._follow.isActive():  # the file was edited just now
            self._follow.stop()
            self._read_again()
        self._after_choice()
        if not self.outcome.merge.isEnabled():
            return
        errors = any(f.severity == "error" for f in self.check.new())
        if errors and not self._warned:
            self._warned = True
            self.outcome.findings_button.setChecked(True)
            self._count()
            return
        column = self._target_column()
        merge, other = self.merge, self.chosen[A if column == B else B].title
        changed: list[Address] = []
        text = self.tr("Merge with {source}").format(source=other)
        self.workspace.do(
            text, lambda: changed.extend(c.address for c in merge.apply_to(self.workspace.file))
        )
        self.merged.emit(other, len(dict.fromkeys(changed)))
        self.close()

    def report(self) -> None:
        """Write the comparison as a paper."""
        save_merge_report(self, self.merge, self.chosen, self.workspace.path, self.message)

    # -- what is shown -------------------------------------------------------------------------

    def _show_in(self, system: str) -> None:
        self.model.show_in(system, secrets=self.workspace.secrets)

    def _filter(self, *_: object) -> None:
        here = self.tree.row()
        self.model.show_only(
            Filter(
                self.view.search.text(),
                self.view.only_differences.isChecked(),
                self.view.only_conflicts.isChecked(),
                self.view.only_active.isChecked(),
            )
        )
        self.tree.unfold()
        if here is not None:
            self.tree.show_row(here)

    def done(self, result: int) -> None:
        """Close, and stop what is being read."""
        for cancelled in self._reading.values():
            cancelled.set()
        self._reading.clear()
        super().done(result)
