"""The tests at the machine: programs and procedures that the manual prints, with this file's figures,
what must be seen at each step, and a tick for each test that is kept in the file.
"""

from __future__ import annotations

import html
from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import (
    QHeaderView,
    QLabel,
    QPushButton,
    QSplitter,
    QTextBrowser,
    QTreeWidget,
    QTreeWidgetItem,
    QWidget,
)

from amp_studio.dossier import machine_tests_of
from amp_studio.files import now, user, write_atomic
from amp_studio.guide import tick
from amp_studio.report import PrintedTest
from amp_studio.ui.base.ask_path import ask_to_save
from amp_studio.ui.base.figures import unbroken
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.theme import GAP2, GAP3, font
from amp_studio.ui.base.translated import sentenced, worded
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.page.page_of_file import PageOfFile

TEST, PAGE, DONE = range(3)
"""Columns of the list."""


class MachineTestsPage(PageOfFile):
    """Lists the tests of every axis; the one in front with its program and its steps beside it."""

    def __init__(self, workspace: Workspace, fail: Callable[[Exception], object]) -> None:
        """``fail`` shows an error."""
        super().__init__()
        self._workspace, self._fail = workspace, fail
        self.tests: list[PrintedTest] = []
        self._is_stale, self._is_filling = True, False
        workspace.changed.connect(self._after_edit)
        self.setAccessibleName(self.tr("Tests at the Machine"))
        self.list = QTreeWidget()
        self.list.setRootIsDecorated(False)
        self.list.setAccessibleName(self.tr("Tests of every axis"))
        self.list.setHeaderLabels([self.tr("Test"), self.tr("Page"), self.tr("Done")])
        self.list.header().setSectionResizeMode(TEST, QHeaderView.ResizeMode.Stretch)
        self.list.header().setStretchLastSection(False)
        self.list.currentItemChanged.connect(lambda *_: self._show_test())
        self.list.itemChanged.connect(self._follow_tick)
        self.steps = QTextBrowser()
        self.steps.setAccessibleName(self.tr("Program and steps of the test"))
        self.summary = QLabel()
        self.summary.setFont(font("text", own=True))
        self.save = QPushButton(self.tr("Save Pro&gram…"))
        self.save.setToolTip(self.tr("The program of the test, as the control reads it"))
        self.save.clicked.connect(self._save_program)
        parts = QSplitter(Qt.Orientation.Horizontal)
        parts.addWidget(self.list)
        parts.addWidget(self._right())
        parts.setSizes([2, 3])
        in_column(parts, on=self, margins=GAP3)
        self.setFocusProxy(self.list)

    def _right(self) -> QWidget:
        right = QWidget()
        in_column((self.steps, 1), in_row((self.summary, 1), self.save), on=right, margins=0, gap=GAP2)
        return right

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        if self._is_stale:
            self.fill()

    def _after_edit(self, *_: object) -> None:
        self._is_stale = True
        if self.isVisible():
            self.fill()

    @property
    def _family(self) -> str:
        return self._workspace.file.schema.family.family

    @property
    def _test(self) -> PrintedTest | None:
        """The test in front."""
        item = self.list.currentItem()
        return None if item is None else self.tests[self.list.indexOfTopLevelItem(item)]

    def fill(self) -> None:
        """List the tests of the file as it is now; the one in front stays."""
        before = self._test
        self._is_stale, self._is_filling = False, True
        self.tests = list(machine_tests_of(self._workspace.file))
        self.list.clear()
        for test in self.tests:
            axis, _, title = test.title.partition(": ")
            item = QTreeWidgetItem([f"{axis}: {worded(title, self._family)}", test.page, test.ticked])
            if test.refusal:
                item.setText(DONE, self.tr("refused"))
                item.setToolTip(TEST, sentenced(test.refusal, self._family))
            else:
                item.setCheckState(TEST, Qt.CheckState.Checked if test.ticked else Qt.CheckState.Unchecked)
            self.list.addTopLevelItem(item)
        for column in (PAGE, DONE):
            self.list.resizeColumnToContents(column)
        self._is_filling = False
        ids = [test.id for test in self.tests]
        if self.tests:
            # By its id: an edit may add tests before it, or take them away.
            row = ids.index(before.id) if before and before.id in ids else 0
            self.list.setCurrentIndex(self.list.model().index(row, TEST))
        done = sum(bool(test.ticked) for test in self.tests)
        # A refused test cannot be done, and is not counted.
        total = sum(not test.refusal for test in self.tests)
        self.summary.setText(
            self.tr("{done} of {total} tests done").format(done=done, total=total)
            if self.tests
            else self.tr("No page here prints a test for this control.")
        )
        self._show_test()

    def _show_test(self) -> None:
        test = self._test
        self.save.setEnabled(bool(test and test.lines and not test.refusal))
        self.steps.setHtml("" if test is None else unbroken(self._written(test)))

    def _written(self, test: PrintedTest) -> str:
        """Return a test as rich text: its refusal, or its program and what must be seen at each step."""
        axis, _, title = test.title.partition(": ")
        parts = [f"<h3>{html.escape(axis)}: {self._sentence(title)}</h3>"]
        if test.refusal:
            parts.append(f"<p>{html.escape(self.tr('Refused:'))} {self._sentence(test.refusal)}</p>")
            return "".join(parts)
        if test.lines:
            parts.append(f"<pre>{html.escape(chr(10).join(test.lines))}</pre>")
        if test.steps:
            seen = html.escape(self.tr("Must be seen:"))
            steps = "".join(
                f"<li>{self._sentence(do)}<br><b>{seen}</b> {self._sentence(see)}</li>"
                for do, see in test.steps
            )
            parts.append(f"<ol>{steps}</ol>")
        parts += [f"<p>{self._sentence(note)}</p>" for note in test.notes]
        return "".join(parts)

    def _sentence(self, text: str) -> str:
        return html.escape(sentenced(text, self._family))

    def _follow_tick(self, item: QTreeWidgetItem, column: int) -> None:
        """Keep a tick in the file, as one step to undo."""
        # Qt emits itemChanged for what the program writes too.
        if self._is_filling or column != TEST:
            return
        test = self.tests[self.list.indexOfTopLevelItem(item)]
        is_done = item.checkState(TEST) == Qt.CheckState.Checked
        # Another change of the item, its text for instance, is no tick.
        if is_done == bool(test.ticked):
            return
        by = self.tr("{now} by {user}").format(now=now(), user=user()) if is_done else None
        text = self.tr("{test} done") if is_done else self.tr("{test} not done")
        file = self._workspace.file
        self._workspace.do(text.format(test=item.text(TEST)), lambda: tick(file, test.id, by))
        self.fill()

    def _save_program(self) -> None:
        test = self._test
        if test is None:
            return
        near = f"{test.id.partition('@')[0]}.nc"
        path = ask_to_save(self, self.tr("Program of a Test"), near, self.tr("All files (*)"))
        if path is None:
            return
        try:
            text = "".join(f"{line}\n" for line in test.lines)
            write_atomic(path, text.encode("ascii"), keep_backup=False)
        except OSError as error:
            self._fail(error)
