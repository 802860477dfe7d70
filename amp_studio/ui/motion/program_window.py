"""Blocks and programs as a window: a block typed, word by word; a program with its path, what limits it,
and the same with another value.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtGui import QCloseEvent
from PySide6.QtWidgets import (
    QDialog,
    QFileDialog,
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

from amp_studio.errors import AmpStudioError
from amp_studio.files import ParameterFile
from amp_studio.programs import BlockReader, ProgramBlockError, power_up, read_program
from amp_studio.schema import Address, Value
from amp_studio.sim import (
    PathMoment,
    ProgramJob,
    ProgramRun,
    SimulationError,
    WhatIf,
    limit_sort,
    limited_by,
    line_rows,
    moment_at,
    path_picture,
    try_summary,
    typed_places,
    typed_values,
    value_text,
    what_if,
)
from amp_studio.ui.base.figures import written
from amp_studio.ui.base.plot import Plot
from amp_studio.ui.base.screen_room import fit_to_screen
from amp_studio.ui.base.task import Task, TaskProgress
from amp_studio.ui.base.theme import GAP2, GAP3, font
from amp_studio.ui.base.translated import worded
from amp_studio.ui.forms.form import Field, FieldForm
from amp_studio.ui.forms.segment import Segment

from .program_play import PlayBar, TimeBar, TimePart

MOST_LINES = 5000
"""Lines of a program that are listed; the rest is computed too."""
Apply = Callable[[Mapping[Address, Value]], bool]


class StoppedError(AmpStudioError):
    """The window was closed while it computed."""


class ProgramWindow(QDialog):
    """One file; a program is run in a thread, on a copy of the file."""

    def __init__(
        self, read: Callable[[], ParameterFile], apply: Apply, parent: QWidget | None = None
    ) -> None:
        """``read`` returns the file as it is now, in a copy that nobody else changes; ``apply`` takes the
        values of a try into the file.
        """
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self._read, self._file, self._apply = read, read(), apply
        self._job: ProgramJob | None = None
        self._name = ""
        self.outcome: ProgramRun | None = None
        self._tried: Mapping[Address, Value] = {}
        self._task: Task | None = None
        self.setWindowTitle(self.tr("Program"))
        self.setModal(False)
        self.words = _table(
            self.tr("Words of the block"),
            (self.tr("Word"), self.tr("Number"), self.tr("Meaning"), self.tr("Parameters")),
            2,
        )
        self.lines = _table(
            self.tr("Blocks of the program"), (self.tr("Block"), self.tr("Limit"), self.tr("s"))
        )
        self.limits = _table(
            self.tr("What limits the feed"), ("", self.tr("What limits"), self.tr("s"), self.tr("%")), 1
        )
        self.tries = _table(
            self.tr("What if"), (self.tr("Change"), self.tr("s"), self.tr("%"), self.tr("Error, µm"))
        )
        self.summary = QLabel()
        self.summary.setFont(font("text", own=True))
        self.summary.setWordWrap(True)
        self.plot = Plot()
        self.view = Segment(
            self.tr("Path"), (("plan", self.tr("Plan"), ""), ("tilted", self.tr("Tilted"), ""))
        )
        self.view.show_choice("plan")
        self.view.chosen.connect(lambda _key: self._draw())
        self.bar, self.play = TimeBar(), PlayBar()
        self.play.moved.connect(self._show_moment)
        self.form = FieldForm(self._fields())
        self.form.entered.connect(self._entered)
        self._lay_out()
        fit_to_screen(self, 1180, 720)
        self._say(self.tr("Type a block, or open a part program."))

    def _fields(self) -> Sequence[Field]:
        return (
            Field(
                "block",
                self.tr("&Block"),
                hint="G1 X10 F200",
                tip=self.tr(
                    "Enter shows each word as this file has it read; empty, what is active after power-up"
                ),
            ),
            Field(
                "zero",
                self.tr("&Zero"),
                hint="X0,Y0",
                tip=self.tr("Where the zero of the program is in the machine; empty takes work coordinates"),
            ),
            Field(
                "change",
                self.tr("What &if"),
                hint="1210=+20%",
                tip=self.tr("A parameter and another value, several separated by semicolons; Enter tries it"),
            ),
        )

    def _lay_out(self) -> None:
        self.open_button = QPushButton(self.tr("&Open Program…"))
        self.apply_button = QPushButton(self.tr("&Apply to File"))
        self.apply_button.setEnabled(False)
        self.apply_button.setToolTip(self.tr("Take the values of the last try into the file, as one step"))
        close = QPushButton(self.tr("&Close"))
        for button, step in (
            (self.open_button, self.ask),
            (self.apply_button, self._apply_tried),
            (close, self.close),
        ):
            button.setAutoDefault(False)
            button.clicked.connect(step)
        left, middle, right = QWidget(), QWidget(), QWidget()
        for side, parts in (
            (left, (self.form, self.words, self.lines)),
            (middle, (self.view, self.plot, self.bar, self.play)),
            (right, (self.limits, self.tries)),
        ):
            column = QVBoxLayout(side)
            column.setContentsMargins(0, 0, 0, 0)
            column.setSpacing(GAP2)
            for part in parts:
                column.addWidget(part)
        splitter = QSplitter(Qt.Orientation.Horizontal)
        for n, side in enumerate((left, middle, right)):
            splitter.addWidget(side)
            splitter.setStretchFactor(n, (3, 5, 3)[n])
        foot = QHBoxLayout()
        foot.addWidget(self.summary, 1)
        for button in (self.open_button, self.apply_button, close):
            foot.addWidget(button)
        column = QVBoxLayout(self)
        column.setContentsMargins(GAP3, GAP3, GAP3, GAP3)
        column.setSpacing(GAP2)
        column.addWidget(splitter, 1)
        column.addLayout(foot)

    # -- a block -------------------------------------------------------------------

    def _entered(self, key: str) -> None:
        if key == "block":
            self._read_block(str(self.form.answers()["block"]))
        elif key == "change":
            self._try(str(self.form.answers()["change"]))
        else:
            self.run_again()

    def run_again(self) -> None:
        """Run the program once more, under the file of now."""
        if self._job is not None:
            self.start(self._job, self._name)

    def _read_block(self, text: str) -> None:
        """Show the words of a block; without one, what is active after power-up."""
        if not text.strip():
            self._show_power_up()
            return
        try:
            block = BlockReader(self._read()).read(text)
        except ProgramBlockError as error:
            self._say(str(error))
            return
        short = self._file.machine_schema.short
        _fill(
            self.words,
            [
                (
                    word.word,
                    "" if word.number is None else value_text(word.number, word.unit, 9),
                    f"{word.meaning}: {word.fault}" if word.fault else word.meaning,
                    ", ".join(short(address) for address in word.params),
                )
                for word in block.words
            ],
        )
        self._say("; ".join(block.faults) or "; ".join(block.assumptions))

    def _show_power_up(self) -> None:
        """Show the codes after power-up, what changes them, and the calls of the builder's programs."""
        found = power_up(self._read())
        short = self._file.machine_schema.short
        _fill(
            self.words,
            [
                (line.code, "", f"{line.what}: {line.meaning}", ", ".join(map(short, line.params)))
                for line in (*found.active, *found.changes, *found.calls)
            ],
        )
        self._say(self.tr("What is active after power-up, what changes it, and what calls a program."))

    # -- a program -----------------------------------------------------------------

    def ask(self) -> None:
        """Ask for a program and run it."""
        text, _ = QFileDialog.getOpenFileName(
            self, self.tr("Part Program"), "", self.tr("Part programs (*.nc *.ngc *.txt);;All files (*)")
        )
        if text:
            self.open_program(Path(text))

    def open_program(self, path: Path) -> None:
        """Run a program from a file."""
        try:
            self.start(ProgramJob(read_program(path)), path.name)
        except (ProgramBlockError, OSError) as error:
            self._say(str(error))

    def start(self, job: ProgramJob, name: str) -> None:
        """Run a program under the file of now."""
        self._file = self._read()
        try:
            text = str(self.form.answers()["zero"]).strip()
            zero = typed_places(text, self._file) if text else None
        except SimulationError as error:
            self._say(str(error))
            return
        self._job, self._name = replace(job, zero=zero), name
        job = self._job
        self._begin(lambda show: job.run(self._file, show), self._show)

    def _try(self, text: str) -> None:
        """Run the program with other values."""
        before, job = self.outcome, self._job
        if before is None or job is None:
            self._say(self.tr("Open a part program first."))
            return
        try:
            values = typed_values(self._file, text.split(";"))
        except SimulationError as error:
            self._say(str(error))
            return
        self._begin(
            lambda show: what_if(job, self._file, [values], show)[0],
            lambda tried: self._show_try(values, tried),
        )

    def _begin(
        self, work: Callable[[Callable[[str, float], None]], object], show: Callable[..., None]
    ) -> None:
        """Do work in a thread; what was going on before is stopped."""
        self._stop()

        def run(progress: TaskProgress, cancelled: threading.Event) -> object:
            def step(what: str, share: float) -> None:
                if cancelled.is_set():
                    raise StoppedError("stopped")
                progress(what, int(100.0 * share), 100)

            return work(step)

        task = self._task = Task(run, self)
        task.progressed.connect(lambda what, done, _of: self._say(f"{what} {done} %"))
        task.done.connect(show)
        task.failed.connect(lambda error: self._say("" if isinstance(error, StoppedError) else str(error)))
        task.begin()

    def _show(self, run: ProgramRun) -> None:
        self.outcome = run
        _fill(
            self.limits,
            [
                (
                    row["letter"],
                    f"{worded(row['name'])}  {row['param']}".rstrip(),
                    f"{row['time_s']:.3g}",
                    f"{100 * row['share']:.0f}",
                )
                for row in limited_by(self._file, run)
            ],
        )
        assert self._job is not None
        listed = {n: (letter, f"{time:.3g}") for n, (letter, time) in line_rows(run).items()}
        _fill(
            self.lines,
            [(line, *listed.get(n, ("", ""))) for n, line in enumerate(self._job.lines[:MOST_LINES], 1)],
        )
        time = written(value_text(run.plan.time, "s", 4))
        words = [f"{self._name}: {run.plan.path.blocks} {self.tr('blocks')}, {time}"]
        if run.contour is not None:
            error = written(value_text(1000.0 * run.contour.largest, "µm", 3))
            words.append(self.tr("largest contour error {error}").format(error=error))
        words += [f"{self.tr('Line')} {alarm.line}: {alarm.code} {alarm.message}" for alarm in run.alarms[:2]]
        self._say("; ".join(words))
        self.bar.show_parts(
            [
                TimePart(row["letter"], worded(row["name"]), row["time_s"], limit_sort(row["letter"]))
                for row in limited_by(self._file, run)
            ]
        )
        self.play.show_program(run.plan.time)

    def _show_moment(self, _seconds: float) -> None:
        """Draw where the axes are, and show the block that is run."""
        moment = self._draw()
        if moment is not None and moment.line <= self.lines.rowCount():
            self.lines.selectRow(moment.line - 1)

    def _draw(self) -> PathMoment | None:
        if self.outcome is None:
            return None
        moment = moment_at(self.outcome.plan, self.play.moment)
        picture = path_picture(self._file, self.outcome, moment)
        above = picture.close if self.view.choice == "tilted" else picture.above
        self.plot.draw(replace(picture, above=above, close=None))
        return moment

    def _show_try(self, values: Mapping[Address, Value], tried: WhatIf) -> None:
        assert self.outcome is not None
        if tried.run is None:
            self._say(tried.why_not)
            return
        found = try_summary(self._file, self.outcome, tried)
        changed = ", ".join(f"{each['param']} {each['from']} → {each['to']}" for each in found["changes"])
        error = found.get("contour_error_change", {}).get("value")
        row = (
            changed,
            f"{found['time']['value']:.4g}",
            f"{100.0 * found['time_change']:+.1f}",
            "" if error is None else f"{1000.0 * error:+.3g}",
        )
        _fill(self.tries, [row], add=True)
        self._tried = values
        self.apply_button.setEnabled(True)
        self._say("; ".join(tried.not_allowed))

    def _apply_tried(self) -> None:
        if self._apply(self._tried):
            self.run_again()

    # -- the window ----------------------------------------------------------------

    def _say(self, text: str) -> None:
        self.summary.setText(text)

    def _stop(self) -> None:
        self.play.pause()
        if self._task is not None:
            self._task.cancelled.set()
            self._task = None

    def closeEvent(self, event: QCloseEvent) -> None:  # Qt's name
        self._stop()
        super().closeEvent(event)


def _table(name: str, heads: Sequence[str], wide: int = 0) -> QTableWidget:
    """Return a table that is read; the column ``wide`` has the room that is left."""
    table = QTableWidget(0, len(heads))
    table.setAccessibleName(name)
    table.setHorizontalHeaderLabels(list(heads))
    table.setEditTriggers(QTableWidget.EditTrigger.NoEditTriggers)
    table.setSelectionBehavior(QTableWidget.SelectionBehavior.SelectRows)
    table.verticalHeader().hide()
    table.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
    table.horizontalHeader().setSectionResizeMode(wide, QHeaderView.ResizeMode.Stretch)
    return table


def _fill(table: QTableWidget, rows: Sequence[Sequence[str]], *, add: bool = False) -> None:
    first = table.rowCount() if add else 0
    table.setRowCount(first + len(rows))
    for n, row in enumerate(rows, first):
        for column, text in enumerate(row):
            item = QTableWidgetItem(text)
            item.setToolTip(text)
            table.setItem(n, column, item)
