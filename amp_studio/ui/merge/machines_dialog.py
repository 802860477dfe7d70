"""Several machines side by side: which files, what differs between them, the way to a value,
and the table as a paper.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from PySide6.QtCore import QEvent, QModelIndex, QSignalBlocker, Qt
from PySide6.QtWidgets import (
    QCheckBox,
    QDialog,
    QFileDialog,
    QHeaderView,
    QLabel,
    QLineEdit,
    QListWidget,
    QListWidgetItem,
    QPushButton,
    QSplitter,
    QStackedWidget,
    QTableView,
    QWidget,
)

from amp_studio.files import ParameterFile, check_output, matched_by_letter, open_file, same_file
from amp_studio.report import MachineLine, machine_lines, machine_names, machines_paper, write_paper
from amp_studio.schema import Address
from amp_studio.ui.base.ask_path import ask_to_save
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.screen_room import fit_to_screen
from amp_studio.ui.base.task import TaskProgress, in_background, run_with_progress
from amp_studio.ui.base.theme import GAP2, GAP3, ROW
from amp_studio.ui.base.translated import counted, written_to
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.dialogs.file_dialogs import PAPER_KINDS
from amp_studio.ui.forms.message_bar import MessageBar

from .comparisons import parameter_files
from .machines_model import MachinesFilter, MachinesModel

_ROW_HEAD, _COLUMN = 290, 130
"""Width of the names of values, and the least width of a machine."""


@dataclass
class _Machine:
    """One file that can be compared."""

    path: Path
    workspace: Workspace | None
    """Where it is open: what is compared is as in the window, with unsaved changes."""
    file: ParameterFile | None = None
    fault: str = ""

    def read(self) -> None:
        """Read it again where it is open, and once where it is on disk."""
        if self.workspace is not None:
            # A copy each time: it is compared in a thread, with what is unsaved in the window.
            self.file = self.workspace.file.copy()
        elif self.file is None and not self.fault:
            try:
                self.file = open_file(self.path).file
            except (OSError, ValueError) as error:
                self.fault = str(error)


class MachinesDialog(QDialog):
    """Stays open beside the table; a double click or Enter leads to a value of a machine."""

    def __init__(
        self,
        opened: Sequence[Workspace],
        paths: Sequence[Path],
        show: Callable[[Path, Address | None], None],
        parent: QWidget | None = None,
        language: str = "en",
    ) -> None:
        """``language`` is that of the paper that is exported."""
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowTitle(self.tr("Compare Machines"))
        fit_to_screen(self, 1120, 640)
        self._show, self._language = show, language
        self._machines = [_Machine(each.path, each) for each in opened]
        self._machines += [
            _Machine(path, None) for path in paths if not any(same_file(path, m.path) for m in self._machines)
        ]
        self._compared: list[_Machine] = []
        self._files: list[ParameterFile] = []
        self._left_out: list[str] = []
        self._is_stale = False
        for each in opened:
            each.changed.connect(self._mark_stale)
        self.bar = MessageBar()
        self.list = QListWidget()
        self.list.setAccessibleName(self.tr("Machines"))
        self.add_button = QPushButton(self.tr("&Add Files…"))
        self.add_button.clicked.connect(self.add)
        self.filter = QLineEdit()
        self.filter.setPlaceholderText(self.tr("Filter by number, name, axis or value"))
        self.filter.setAccessibleName(self.tr("Filter"))
        self.filter.setClearButtonEnabled(True)
        self.everything = QCheckBox(self.tr("Also what is the &same"))
        self.by_letter = QCheckBox(self.tr("Axes by &letter"))
        self.by_letter.setToolTip(self.tr("Compare the axes that have the same letter, not the same number"))
        self.model, self.rows = MachinesModel(self), MachinesFilter(self)
        self.rows.setSourceModel(self.model)
        self.table = self._make_table()
        self.empty, self.count = QLabel(), QLabel()
        self.empty.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.stack = QStackedWidget()
        self.stack.addWidget(self.empty)
        self.stack.addWidget(self.table)
        self.export_button, close = QPushButton(self.tr("&Export…")), QPushButton(self.tr("&Close"))
        self.export_button.clicked.connect(self.export)
        close.clicked.connect(self.close)
        for button in (self.add_button, self.export_button, close):
            button.setAutoDefault(False)
        self._arrange(close)
        self.filter.textChanged.connect(self._filter)
        self.everything.toggled.connect(self.compare)
        self.by_letter.toggled.connect(self.compare)
        self.list.itemChanged.connect(self.compare)

    def _make_table(self) -> QTableView:
        table = QTableView()
        table.setModel(self.rows)
        table.setAccessibleName(self.tr("Values of the machines"))
        table.setShowGrid(True)
        table.setWordWrap(False)
        head, rows = table.horizontalHeader(), table.verticalHeader()
        head.setDefaultSectionSize(_COLUMN)
        head.setStyleSheet("QHeaderView::section { padding: 4px 3px; }")  # names begin where the values do
        head.setDefaultAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        rows.setDefaultSectionSize(ROW)
        rows.setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        rows.setFixedWidth(_ROW_HEAD)
        table.activated.connect(self._go_to)
        table.doubleClicked.connect(self._go_to)
        return table

    def _arrange(self, close: QPushButton) -> None:
        left, right = QWidget(), QWidget()
        in_column(self.list, self.add_button, on=left, margins=(0, 0, GAP2, 0))
        above = in_row(self.filter, self.everything, self.by_letter, gap=GAP3)
        in_column(above, self.stack, on=right, margins=(GAP2, 0, 0, 0))
        parts = QSplitter()
        parts.addWidget(left)
        parts.addWidget(right)
        parts.setStretchFactor(1, 1)
        parts.setSizes([200, 820])
        parts.setChildrenCollapsible(False)
        in_column(self.bar, (parts, 1), in_row((self.count, 1), self.export_button, close), on=self)

    # -- which machines ----------------------------------------------------------------------

    def begin(self) -> None:
        """Read the files, and compare those of the family of the first."""
        self._machines = self._read(self._machines)
        first = next((m.file for m in self._machines if m.file is not None), None)
        family = first.schema.family.family if first is not None else ""
        for machine in self._machines:
            self._list(
                machine, chosen=machine.file is not None and machine.file.schema.family.family == family
            )
        self.compare()

    def _read(self, machines: list[_Machine]) -> list[_Machine]:
        """Return machines whose files are read: all of them, or the first ones where it was cancelled."""
        read: list[_Machine] = run_with_progress(
            self.tr("Reading the files"), lambda *about: _read(machines, *about), self
        )
        if left := len(machines) - len(read):
            self._left_out.append(self.tr("Cancelled: {count} not read.").format(count=counted(left, "file")))
        return read

    def _list(self, machine: _Machine, *, chosen: bool) -> None:
        item = QListWidgetItem(machine.path.stem)
        item.setToolTip(machine.fault or str(machine.path))
        item.setFlags(
            Qt.ItemFlag.ItemIsEnabled | Qt.ItemFlag.ItemIsSelectable | Qt.ItemFlag.ItemIsUserCheckable
        )
        item.setCheckState(Qt.CheckState.Checked if chosen else Qt.CheckState.Unchecked)
        if machine.file is None:
            item.setText(self.tr("{name} (cannot be read)").format(name=machine.path.stem))
            item.setFlags(Qt.ItemFlag.ItemIsSelectable)
        elif not chosen:
            family = machine.file.schema.family
            item.setText(f"{machine.path.stem} ({family.short or family.name})")
        # Adding an entry is no choice: each would compare all machines again.
        with QSignalBlocker(self.list):
            self.list.addItem(item)

    def add(self) -> None:
        """Ask for other files and compare them too."""
        near = str(self._machines[0].path.parent) if self._machines else ""
        texts, _ = QFileDialog.getOpenFileNames(self, self.tr("Add files"), near, parameter_files())
        added = [
            _Machine(Path(text), None)
            for text in texts
            if not any(same_file(Path(text), m.path) for m in self._machines)
        ]
        for machine in self._read(added):
            self._machines.append(machine)
            self._list(machine, chosen=machine.file is not None)
        if faults := [machine.fault for machine in added if machine.fault]:
            self.bar.say("\n".join(faults), "error")
        self.compare()

    def _chosen(self) -> list[_Machine]:
        return [
            machine
            for n, machine in enumerate(
                self._machines[: self.list.count()]
            )  # while one is added it has no line yet
            if machine.file is not None and self.list.item(n).checkState() == Qt.CheckState.Checked
        ]

    # -- what differs ------------------------------------------------------------------------

    def compare(self, *_: object) -> None:
        """Compare the chosen machines as they are now."""
        self._is_stale = False
        chosen, everything, by_letter = (
            self._chosen(),
            self.everything.isChecked(),
            self.by_letter.isChecked(),
        )
        self.export_button.setEnabled(False)
        if len(chosen) < 2:
            self._show_nothing(self.tr("Choose two machines or more."))
            return
        try:
            lines, same, self._files, notes = in_background(
                self, self.tr("Comparing"), partial(_compared, chosen, everything, by_letter)
            )
        except ValueError as error:
            self._show_nothing("")
            self.bar.say(str(error), "error")
            return
        self._compared = chosen
        if notes or self._left_out:
            self.bar.say("\n".join((*self._left_out, *notes)), "warning" if self._left_out else "information")
        else:
            self.bar.hide()
        self.model.show_lines(lines, self._names(), [machine.path for machine in chosen])
        self._same = same
        room = self.stack.width() - _ROW_HEAD - GAP3
        head, mode = self.table.horizontalHeader(), QHeaderView.ResizeMode
        # Few machines fill the width; many keep theirs and scroll.
        head.setSectionResizeMode(mode.Stretch if room >= _COLUMN * len(chosen) else mode.Interactive)
        self.empty.setText(self.tr("Nothing differs."))
        self.stack.setCurrentWidget(self.table if lines else self.empty)
        self.export_button.setEnabled(True)
        self._show_summary()

    def _show_nothing(self, why: str) -> None:
        self.model.show_lines((), (), ())
        self.count.clear()
        self.empty.setText(why)
        self.stack.setCurrentWidget(self.empty)

    def _names(self) -> list[str]:
        return machine_names([machine.path.stem for machine in self._compared])

    def _filter(self, text: str) -> None:
        self.rows.set_filter(text)
        self._show_summary()

    def _show_summary(self) -> None:
        if not self.export_button.isEnabled():
            return
        differ = sum(line.differs for line in self.model.lines)
        text = self.tr("Different: {differ}; the same: {same}").format(differ=differ, same=self._same)
        if self.filter.text():
            text += self.tr("; shown: {count}").format(count=self.rows.rowCount())
        self.count.setText(text)
        self.table.setAccessibleDescription(text)

    def _mark_stale(self, *_: object) -> None:
        self._is_stale = True

    def changeEvent(self, event: QEvent) -> None:
        """Compare again when one comes back from an edit."""
        super().changeEvent(event)
        # Not at each edit: the table would change under the hand in the other window.
        if event.type() == QEvent.Type.ActivationChange and self.isActiveWindow() and self._is_stale:
            self.compare()

    # -- ways out ----------------------------------------------------------------------------

    def _go_to(self, index: QModelIndex) -> None:
        row = self.rows.mapToSource(index).row()
        self._show(self._compared[index.column()].path, self.model.lines[row].address)

    def export(self) -> None:
        """Ask for a file and write the table of these machines, not only the rows that the filter leaves."""
        near, everything = self._compared[0].path.with_name("machines.pdf"), self.everything.isChecked()
        path = ask_to_save(self, self.tr("Export"), near, PAPER_KINDS)
        if path is None:
            return
        try:
            for machine in self._machines:
                check_output(path, machine.path)
            paper = partial(
                machines_paper, self._files, self._names(), everything=everything, language=self._language
            )
            in_background(self, self.tr("Export"), lambda: write_paper(paper(), path))
        except (OSError, ValueError) as error:
            self.bar.say(str(error), "error")
            return
        self.bar.say(written_to(path))


def _read(machines: Sequence[_Machine], progress: TaskProgress, cancelled: threading.Event) -> list[_Machine]:
    read = []
    for n, machine in enumerate(machines):
        if cancelled.is_set():
            break
        progress(machine.path.name, n, len(machines))
        machine.read()
        read.append(machine)
    return read


def _compared(
    chosen: Sequence[_Machine], everything: bool, by_letter: bool
) -> tuple[list[MachineLine], int, list[ParameterFile], list[str]]:
    """Return the rows, how many values are the same, the files as they were compared, and notes;
    raises ValueError.
    """
    for machine in chosen:
        machine.read()
    files = [machine.file for machine in chosen if machine.file is not None]
    notes: list[str] = []
    if by_letter:
        for n, machine in enumerate(chosen[1:], 1):
            matched = matched_by_letter(files[n], files[0])
            files[n] = matched.file
            name = machine.path.stem
            notes += [
                f"{name}: axis {letter} is axis {number}; it is compared as axis {place}"
                for letter, number, place in matched.moved
            ]
            notes += [f"{name}: axis {letter} is not compared" for letter in matched.left_out]
    lines, same = machine_lines(files, everything=everything)
    return lines, same, files, notes
