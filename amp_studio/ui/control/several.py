"""One file and several controls: which of them, what each is doing, and how it ended."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QSignalBlocker, QSize, Qt, Signal
from PySide6.QtGui import QIcon
from PySide6.QtWidgets import QCheckBox, QHeaderView, QPushButton, QTreeWidget, QTreeWidgetItem, QWidget

from amp_studio.ui.base.ask_path import ask_to_save
from amp_studio.ui.base.layout import in_column
from amp_studio.ui.base.task import Task, TaskProgress
from amp_studio.ui.base.theme import ROW, severity_icon
from amp_studio.ui.base.translated import message_in_words, worded
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.forms.elided_label import ElidedLabel
from amp_studio.ui.forms.message_bar import MessageBar

from .exchange import stages
from .known_list import ListedControl
from .rows import FOOT, side_by_side
from .session import SILENT

if TYPE_CHECKING:
    from amp_studio.transfer.client import ExchangeOf, FleetRow

_CONTROL, _ADDRESS, _RESULT, _DIGEST, _ENDING = range(5)


class SeveralControls(QWidget):
    """The known controls with a tick each; the file goes to those with a tick, or is compared with them."""

    changed = Signal()
    """An exchange has begun or ended, or another one would be made."""

    def __init__(self, save: Callable[[], bool]) -> None:
        super().__init__()
        self._save_file = save
        self._workspace: Workspace | None = None
        self._sends = False
        self._task: Task | None = None
        self.rows: list[FleetRow] = []
        self.bar = MessageBar()
        self.table = QTreeWidget()
        self.table.setHeaderLabels(
            [self.tr("Control"), self.tr("Address"), self.tr("Result"), "SHA-256", self.tr("How it ended")]
        )
        self.table.setRootIsDecorated(False)
        self.table.setUniformRowHeights(True)
        self.table.setAccessibleName(self.tr("Several controls"))
        for column in range(_ENDING):
            self.table.header().setSectionResizeMode(column, QHeaderView.ResizeMode.ResizeToContents)
        self.table.itemChanged.connect(self._follow)
        self.stop = QCheckBox(self.tr("One after the other, and &stop at the first failure"))
        self.stop.setChecked(True)
        self.checked = QCheckBox(
            self.tr("All parameters of each are replaced; what it contains is kept beside the file first")
        )
        self.checked.toggled.connect(self._follow)
        self.hint = ElidedLabel()
        self.save_button = QPushButton(self.tr("Save &Table…"))
        self.save_button.clicked.connect(self.save)
        self.cancel = QPushButton(self.tr("Cancel"))
        self.cancel.clicked.connect(self.stop_all)
        self.primary = QPushButton()
        self.primary.setProperty("primary", True)
        self.primary.clicked.connect(self._act)
        in_column(
            self.bar,
            (self.table, 1),
            side_by_side(30, self.stop, None),
            side_by_side(30, self.checked, None),
            side_by_side(FOOT, self.hint, None, self.save_button, self.cancel, self.primary),
            on=self,
            margins=0,
            gap=0,
        )
        self.setFocusProxy(self.table)

    # -- what is shown -----------------------------------------------------------

    def show_file(self, workspace: Workspace | None, *, sends: bool) -> None:
        """Show what is done with the controls: the file is sent to them, or compared with them."""
        if workspace is not self._workspace:
            self._workspace, self.rows = workspace, []
            for item in self._items():
                for column in (_RESULT, _DIGEST, _ENDING):
                    item.setText(column, "")
                item.setIcon(_RESULT, QIcon())
        self._sends = sends
        self.checked.setChecked(False)
        self.bar.hide()
        if sends and workspace is not None and workspace.is_dirty and workspace.may_edit:
            text = self.tr("{name} has unsaved changes. A download sends the saved file.")
            self.bar.say(text.format(name=workspace.path.name), "warning", (self.tr("Save"), self._save))
        self._follow()

    def _save(self) -> None:
        self._save_file()
        self._follow()

    def show_controls(self, listed: Sequence[ListedControl]) -> None:
        """List the known controls; ticks and results stay."""
        there = {item.text(_ADDRESS): item for item in self._items()}
        # Qt emits itemChanged for what the program writes too; only ticks of the user are to be followed.
        with QSignalBlocker(self.table):
            for each in listed:
                item = there.get(each.address) or self._add(each.address)
                item.setText(_CONTROL, each.name)

    def tick(self, address: str) -> None:
        """Tick a control, which is listed then."""
        item = next((i for i in self._items() if i.text(_ADDRESS) == address), None) or self._add(address)
        item.setCheckState(_CONTROL, Qt.CheckState.Checked)
        self.table.setCurrentItem(item)

    def _add(self, address: str) -> QTreeWidgetItem:
        item = QTreeWidgetItem([address.partition("://")[2] or address, address, "", "", ""])
        item.setFlags(item.flags() | Qt.ItemFlag.ItemIsUserCheckable)
        item.setCheckState(_CONTROL, Qt.CheckState.Unchecked)
        item.setSizeHint(_CONTROL, QSize(0, ROW))
        self.table.addTopLevelItem(item)
        return item

    def _items(self) -> list[QTreeWidgetItem]:
        items = (self.table.topLevelItem(n) for n in range(self.table.topLevelItemCount()))
        return [item for item in items if item is not None]

    @property
    def ticked(self) -> list[str]:
        """The addresses with a tick."""
        return [i.text(_ADDRESS) for i in self._items() if i.checkState(_CONTROL) == Qt.CheckState.Checked]

    @property
    def is_busy(self) -> bool:
        """Whether exchanges are under way."""
        return self._task is not None

    @property
    def is_sending(self) -> bool:
        """Whether something is being written to controls."""
        return self.is_busy and self._sends

    def _follow(self, *_: object) -> None:
        count, workspace = len(self.ticked), self._workspace
        text = (
            self.tr("Send to %n Controls", "", count)
            if self._sends
            else self.tr("Compare With %n Controls", "", count)
        )
        why = self._why_not(workspace)
        self.primary.setText(text)
        self.primary.setEnabled(not why and not self.is_busy)
        self.primary.setVisible(not self.is_busy)
        self.cancel.setVisible(self.is_busy)
        self.checked.setVisible(self._sends and not self.is_busy)
        self.table.setEnabled(not self.is_busy)
        self.save_button.setEnabled(bool(self.rows))
        self.hint.setText("" if self.is_busy else why)

    def _why_not(self, workspace: Workspace | None) -> str:
        """Return what is missing before the exchanges, in words."""
        if not self.ticked:
            return self.tr("Tick the controls; “+” at the left adds one by its address.")
        if not self._sends or workspace is None:
            return ""
        if workspace.is_dirty and workspace.may_edit:
            return self.tr("Waiting: the file is not saved")
        if workspace.count("error"):
            return self.tr("Waiting: the file has errors")
        return "" if self.checked.isChecked() else self.tr("Waiting: what is replaced is not checked")

    # -- the exchanges -------------------------------------------------------------

    def press(self) -> None:
        """Do what the primary button does, if it is on."""
        if self.primary.isVisible() and self.primary.isEnabled():
            self.primary.click()

    def _act(self) -> None:
        """Exchange the file with each control that has a tick, at once or one after the other."""
        from amp_studio.transfer.client import check_addresses, download_each, verify_each

        workspace, named = self._workspace, self.ticked
        assert workspace is not None
        try:
            check_addresses(named)
        except ValueError as error:
            self.bar.say(message_in_words(str(error)), "warning")
            return
        each = download_each if self._sends else verify_each
        file, one_by_one = workspace.file.copy(), self.stop.isChecked()
        self._begin(workspace.path, lambda of: each(file, named, of, stop_on_failure=one_by_one))

    def _begin(self, path: Path, exchange_with_all: Callable[[ExchangeOf], list[FleetRow]]) -> None:
        def work(progress: TaskProgress, cancel: threading.Event) -> list[FleetRow]:
            from amp_studio.transfer import Exchange

            def exchange(address: str) -> Exchange:
                def show(stage: str, done: int, total: int) -> None:
                    # They would take the place of the stage that the row was in, which is still under way.
                    if stage not in SILENT:
                        progress(f"{stage} {address}", done, total)

                return Exchange(show, cancel, keep=path, record=path)

            return exchange_with_all(exchange)

        self.bar.hide()
        task = self._task = Task(work)
        results: list[Callable[[], None]] = []
        task.done.connect(lambda rows: results.append(lambda: self._show_rows(rows)))
        task.failed.connect(
            lambda error: results.append(lambda: self.bar.say(message_in_words(str(error)), "error"))
        )
        task.progressed.connect(self._show_stage)
        task.finished.connect(lambda: self._finish(results))
        task.begin()
        self._follow()
        self.changed.emit()

    def _show_stage(self, stage: str, done: int, total: int) -> None:
        name, _, address = stage.rpartition(" ")  # a stage, or what is to be done at the control
        item = next((i for i in self._items() if i.text(_ADDRESS) == address), None)
        if item is not None:
            share = f"{round(100 * done / total)} %" if total > 0 else ""
            item.setText(_RESULT, share)
            item.setText(_ENDING, stages().get(name) or message_in_words(name))

    def _finish(self, results: Sequence[Callable[[], None]]) -> None:
        self._task = None
        for take in results:
            take()
        self.checked.setChecked(False)
        self._follow()
        self.changed.emit()

    def _show_rows(self, rows: list[FleetRow]) -> None:
        self.rows = rows
        found = {row.address: row for row in rows}
        for item in self._items():
            row = found.get(item.text(_ADDRESS))
            if row is None:
                continue
            item.setText(_RESULT, worded(row.word))
            item.setText(_DIGEST, row.sha256[:12])
            item.setText(_ENDING, worded(row.text))
            severity = {"differs": "warning", "not tried": "warning"}.get(row.ending, "error")
            item.setIcon(_RESULT, QIcon() if row.ending == "well" else severity_icon(severity))
            item.setToolTip(_ENDING, row.text)
        well = sum(row.ending == "well" for row in rows)
        self.bar.say(
            self.tr("{well} of {count} without a failure").format(well=well, count=len(rows)),
            "information" if well == len(rows) else "warning",
        )

    def ends(self) -> list[str]:
        """Return how the last exchange with each control ended, in words."""
        return [f"{row.address}: {worded(row.text)}" for row in self.rows]

    def stop_all(self) -> None:
        """Break off what is under way, each exchange at its next safe point."""
        if self._task is not None:
            self._task.cancelled.set()

    def save(self) -> None:
        """Ask for a name and write the table of results."""
        from amp_studio.report import results_paper, write_paper
        from amp_studio.transfer.client import HEADS

        assert self._workspace is not None
        near = self._workspace.path.with_name("controls.csv")
        path = ask_to_save(self, self.tr("Save table"), near, "Tables (*.csv *.html *.pdf *.xlsx)")
        if path is None:
            return
        try:
            write_paper(results_paper(self.tr("Controls"), HEADS, [r.cells for r in self.rows]), path)
        except (OSError, ValueError) as error:
            self.bar.say(message_in_words(str(error)), "error")
