"""The page Program of a file: a block typed, word by word; a program with its path, what limits it,
and the same with another value.
"""

from __future__ import annotations

import math
import threading
from collections.abc import Callable, Collection
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import cast

from PySide6.QtCore import Qt
from PySide6.QtGui import QHideEvent, QKeySequence, QShortcut
from PySide6.QtWidgets import QLabel, QPushButton, QSizePolicy, QSplitter, QTableWidget, QWidget

from amp_studio.errors import AmpStudioError
from amp_studio.files import ParameterFile
from amp_studio.programs import ProgramBlockError, read_program
from amp_studio.schema import read_address
from amp_studio.sim import (
    NOT_GOOD,
    JobProgress,
    ProgramJob,
    ProgramRun,
    SimulationError,
    alarm_text,
    assumed_texts,
    length_unit,
    limit_sort,
    limited_by,
    line_columns,
    lines_limited_by,
    moment_at,
    not_good_lines,
    path_error_text,
    typed_error,
    typed_places,
    value_text,
)
from amp_studio.ui.base.ask_path import ask_to_open
from amp_studio.ui.base.figures import written
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.task import Task, TaskProgress
from amp_studio.ui.base.theme import GAP2, GAP3, font
from amp_studio.ui.base.translated import sentenced, worded
from amp_studio.ui.forms.form import Field, FieldForm
from amp_studio.ui.page.page_of_file import PageOfFile

from .block import block_fields, block_in_words, found_line
from .block_list import MAX_LISTED, BlockTable, BlockView, kinds_of
from .choosing import GoToField
from .path_view import PathView
from .play import PlayBar, TimePart
from .tables import TableLook, fill, read_table
from .trying import Apply, EarlierFiles, ProgramTries
from .what_if_panel import WhatIfPanel

_LEFT = 210
"""Width in pixels of the program at least."""
_SHARES = (5, 11, 7)
"""Of the width: the program, its path, what limits it."""
FIRST = 2000
"""Blocks of a long program that are drawn before all of it is computed: in a twentieth of a second."""


class StoppedError(AmpStudioError):
    """The page was left while it computed."""


class ProgramPage(PageOfFile):
    """One file; a program is run in a thread, on a copy of the file."""

    def __init__(
        self,
        read: Callable[[], ParameterFile],
        apply: Apply,
        parent: QWidget | None = None,
        *,
        earlier: EarlierFiles = tuple,
    ) -> None:
        """``read`` returns the file as it is now, in a copy that nothing else changes; ``apply`` takes the
        values of a try into the file; ``earlier`` returns the file before its last saves.
        """
        super().__init__(parent)
        self._read, self.file = read, read()
        self.job: ProgramJob | None = None
        self._limiting: list[str] = []
        """What limits, row by row, as it is typed."""
        self._name = ""
        self.outcome: ProgramRun | None = None
        self._task: Task | None = None
        self.setAccessibleName(self.tr("Program"))
        self.words = read_table(
            self.tr("Words of the block"),
            (self.tr("Word"), self.tr("Number"), self.tr("Meaning"), self.tr("Parameters")),
            TableLook(wide=2, figures=(1,)),
        )
        self.lines = BlockView(self.tr("Blocks of the program"))
        self.lines.picked.connect(self._go_to_line)
        self.go_to_field = GoToField()
        self.go_to_field.text_requested.connect(self._go_to)
        self.play = PlayBar()
        self.limits = read_table(
            self.tr("What limits the feed"),
            ("", self.tr("What limits"), self.tr("s"), self.tr("%")),
            TableLook(wide=1, figures=(2, 3), chips=0),
        )
        # Of its rows there are a few: what is below has the room.
        self.limits.setSizeAdjustPolicy(QTableWidget.SizeAdjustPolicy.AdjustToContents)
        self.limits.cellActivated.connect(lambda row, _column: self._begin_try(row))
        self.limits.setSelectionMode(QTableWidget.SelectionMode.SingleSelection)
        self.limits.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Maximum)
        self.tries = WhatIfPanel()
        self.trying = ProgramTries(self, self.tries, apply, earlier)
        self.summary = QLabel()
        self.summary.setFont(font("text", own=True))
        self.summary.setWordWrap(True)
        self.missing = QLabel()
        self.missing.setFont(font("small", own=True))
        self.path = PathView()
        self.path.line_picked.connect(self._go_to_line)
        self.path.time_picked.connect(self.play.go_to)
        self.path.stepped.connect(self._step)
        self.path.only_changed.connect(self._show_only)
        self.play.moved.connect(self._show_moment)
        self.words.hide()
        self._add_keys()
        self.form, self.change_form = FieldForm(block_fields()), FieldForm((self._change_field(),))
        self.form.entered.connect(self._entered)
        self.change_form.entered.connect(
            lambda _key: self.trying.attempt(str(self.change_form.answers()["change"]))
        )
        self._lay_out()
        self.path.title.setText(self.tr("Type a block, or open a part program."))

    def _add_keys(self) -> None:
        """Have Space play, and 1 to 6 list the blocks of a limit alone, where nothing is typed."""
        for part in (self.lines, self.limits, self.path.plot, self.play.slider):
            keys: list[tuple[str, Callable[[], None]]] = [
                ("Space", self.play.toggle),
                ("0", lambda: self.path.filter.choose(0)),
                ("7", lambda: self.path.filter.turn_to(NOT_GOOD)),
            ]
            keys += [(str(n + 1), partial(self._choose_limit, n)) for n in range(6)]
            for key, do in keys:
                shortcut = QShortcut(QKeySequence(key), part, do)
                shortcut.setContext(Qt.ShortcutContext.WidgetShortcut)
        self.lines.setToolTip(
            self.tr(
                "Space plays; 1 to 6 show one limit alone, 7 what is not good, 0 all; Ctrl+G goes to a block"
            )
        )

    def _choose_limit(self, n: int) -> None:
        """Show the n-th limit alone; all of them where it is shown so."""
        cell = self.limits.item(n, 0)
        if cell is not None:
            self.path.filter.turn_to(cell.text())

    def _lines_of(self, run: ProgramRun, letter: str) -> Collection[int]:
        """Return the lines that a limit has a part of, or that are not good."""
        if letter == NOT_GOOD:
            return not_good_lines(run, self.path.own_limit)
        return cast("Collection[int]", lines_limited_by(run, letter, MAX_LISTED).tolist())

    def _show_only(self, letter: str) -> None:
        """Show one limit, or what is not good, alone, in the list and on the path; all of them for ""."""
        # Kept over the filter: the same block stays in sight.
        line = self.lines.line()
        self.lines.blocks.show_only(letter)
        self.lines.show_line(line, is_asked=False)

    # -- a place in the program ----------------------------------------------------------

    def go_to(self) -> bool:
        """Ask for a block or a line."""
        self.go_to_field.begin()
        return True

    def escape(self) -> None:
        """Ask for no block any more; else go back to the values."""
        if self.go_to_field.isVisible():
            self.go_to_field.hide()
            self.lines.setFocus()
        else:
            super().escape()

    def _go_to(self, text: str) -> None:
        if self.job is None:
            self.say(self.tr("Open a part program first."))
            return
        line = found_line(self.job.lines, text)
        if not line:
            self.say(self.tr("The program has no block {text}.").format(text=text))
            return
        self.say("")
        self._go_to_line(line)
        self.lines.setFocus()

    def _go_to_line(self, line: int) -> None:
        """Show a line in the list, and the moment at which it begins."""
        if not self.lines.show_line(line):
            # The filter may leave it out: a line that is asked for by its number is shown in any case.
            self.path.filter.choose(0)
            if not self.lines.show_line(line):
                self.say(self.tr("Only the first {count} blocks are listed.").format(count=MAX_LISTED))
        begin = None if self.outcome is None else self.outcome.plan.listed.begin(line)
        if begin is not None:
            self.play.go_to(begin)
            self.lines.show_line(line)

    def _step(self, step: int) -> None:
        """Go to the block so many rows on."""
        row = self.lines.currentIndex().row() + step
        if 0 <= row < self.lines.blocks.rowCount():
            self._go_to_line(self.lines.blocks.line_of(row))

    def _change_field(self) -> Field:
        return Field(
            "change",
            self.tr("What &if"),
            hint="1210=+20%",
            tip=self.tr("A parameter and another value, several separated by semicolons; Enter tries it"),
        )

    def _lay_out(self) -> None:
        self.open_button = QPushButton(self.tr("&Open Program…"))
        self.open_button.clicked.connect(self.ask)
        left, right = QWidget(), QWidget()
        for side, parts in (
            (left, (self.open_button, self.go_to_field, self.lines, self.play, self.words, self.form)),
            (right, (self.path.filter, self.limits, self.change_form, self.tries)),
        ):
            in_column(
                *parts,
                on=side,
                margins=(0 if side is left else GAP2, 0, 0 if side is right else GAP2, 0),
                gap=GAP2,
            )
        left.setMinimumWidth(_LEFT)
        splitter = QSplitter(Qt.Orientation.Horizontal)
        for n, side in enumerate((left, self.path, right)):
            splitter.addWidget(side)
            splitter.setStretchFactor(n, _SHARES[n])
        splitter.setSizes([1000 * share for share in _SHARES])
        in_column((splitter, 1), in_row((self.summary, 1), self.missing), on=self, margins=GAP3, gap=GAP2)

    # -- a block -------------------------------------------------------------------

    def _entered(self, key: str) -> None:
        if key == "block":
            self._read_block(str(self.form.answers()["block"]))
        elif key == "limit":
            self._take_limit(str(self.form.answers()["limit"]))
        else:
            self.run_again()

    def _take_limit(self, text: str) -> None:
        """Judge the contour error by another limit; by none where the text is empty."""
        try:
            # No limit of one's own is none that is ever passed.
            limit = typed_error(text, self.file) if text.strip() else math.inf
        except SimulationError as error:
            self.say(self.worded(str(error)))
            return
        self.say("")
        self.path.own_limit = limit
        self.tries.judge_by(limit)
        if self.outcome is not None:
            self.path.draw_again()
            self._show_only(self.path.filter.letter)

    def run_again(self) -> None:
        """Run the program once more, under the file of now."""
        if self.job is not None:
            self.start(self.job, self._name)

    def _read_block(self, text: str) -> None:
        """Show the words of a block; without one, what is active after power-up."""
        try:
            rows, remark = block_in_words(self._read(), text)
        except ProgramBlockError as error:
            self.say(self.worded(str(error)))
            return
        self.words.show()
        fill(self.words, rows)
        self.say(remark)

    # -- a program -----------------------------------------------------------------

    def ask(self) -> None:
        """Ask for a program and run it."""
        kinds = self.tr("Part programs (*.nc *.ngc *.txt);;All files (*)")
        if path := ask_to_open(self, self.tr("Part Program"), "", kinds):
            self.open_program(path)

    def open_program(self, path: Path) -> None:
        """Run a program from a file."""
        # The picture of another program is not shown under the name of this one.
        self.outcome = None
        self.begin(
            lambda _show: ProgramJob(read_program(path, self.file)), lambda job: self.start(job, path.name)
        )

    def start(self, job: ProgramJob, name: str) -> None:
        """Run a program under the file of now."""
        # A copy of now: the run and its tries are of the same file, whatever is edited meanwhile.
        self.file = self._read()
        self.tries.show_lengths_in(length_unit(self.file))
        try:
            text = str(self.form.answers()["zero"]).strip()
            zero = typed_places(text, self.file) if text else None
        except SimulationError as error:
            self.say(self.worded(str(error)))
            return
        self.job, self._name = replace(job, zero=zero), name
        job = self.job
        # A long program shows its beginning at once; one that is run again has its whole picture already.
        if self.outcome is None and len(job.lines) > FIRST:
            self.begin(lambda show: self._beginning(job, show), self._run_all)
        else:
            self._run_all(None)

    def _beginning(self, job: ProgramJob, show: JobProgress) -> ProgramRun | None:
        """Return the beginning of a long program; None where it cannot be run without the rest."""
        try:
            # Without the contour error, for which the loops of all axes are simulated.
            return replace(job, lines=job.lines[:FIRST], with_contour=False).run(self.file, show)
        except (ProgramBlockError, SimulationError):
            return None

    def _run_all(self, beginning: ProgramRun | None) -> None:
        """Run all of the program, with its beginning in the picture so far."""
        job = self.job
        assert job is not None
        if beginning is not None:
            self.path.title.setText(
                self.tr("{name}: the first {count} blocks").format(name=self._name, count=FIRST)
            )
            self.path.show_run(self.file, beginning)

        def run(show: JobProgress) -> tuple[ProgramRun, BlockTable]:
            found = job.run(self.file, show)
            letters, times = line_columns(found, min(len(job.lines), MAX_LISTED))
            return found, BlockTable(job.lines, letters, times, kinds_of(job.lines, letters), {})

        self.begin(run, self._show)

    def begin(self, work: Callable[[JobProgress], object], show: Callable[..., None]) -> None:
        """Do work in a thread; what was going on before is stopped."""
        self._stop()

        def run(progress: TaskProgress, cancelled: threading.Event) -> object:
            def step(what: str, share: float) -> None:
                if cancelled.is_set():
                    # Work asks through its progress: there is no other point at which it can stop.
                    raise StoppedError("stopped")
                progress(what, int(100.0 * share), 100)

            return work(step)

        task = self._task = Task(run, self)
        task.progressed.connect(lambda what, done, _of: self.say(f"{self.worded(what)} {done} %"))
        task.done.connect(show)
        task.failed.connect(
            # That it was stopped is what was asked for.
            lambda error: self.say("" if isinstance(error, StoppedError) else self.worded(str(error)))
        )
        task.begin()

    def _show(self, found: tuple[ProgramRun, BlockTable]) -> None:
        run, blocks = found
        self.outcome = run
        self.tries.clear()
        limited = limited_by(self.file, run)
        fill(
            self.limits,
            [
                (
                    row["letter"],
                    " ".join(filter(None, (self._number_of(row["param"]), worded(row["name"])))),
                    written(f"{row['time_s']:.3g}"),
                    f"{100 * row['share']:.0f}",
                )
                for row in limited
            ],
        )
        self._limiting = [row["param"] for row in limited]
        assert self.job is not None
        faults = {each.line: self.worded(alarm_text(self.file, each)) for each in run.alarms}
        self.lines.blocks.show_rows(replace(blocks, faults=faults, lines_of=partial(self._lines_of, run)))
        self.path.filter.offer([(row["letter"], worded(row["name"])) for row in limited if row["letter"]])
        time = written(value_text(run.plan.time, "s", 4))
        words = [f"{self._name}: {run.plan.path.blocks} {self.tr('blocks')}", time]
        if run.contour is not None:
            error = sentenced(path_error_text(run.contour.largest, length_unit(self.file)))
            words.append(self.tr("largest contour error {error}").format(error=error))
        self.path.title.setText(", ".join(words))
        alarms = [
            f"{self.tr('Line')} {each.line}: {self.worded(alarm_text(self.file, each))}"
            # Two fill the line; the list marks the others.
            for each in run.alarms[:2]
        ]
        self.say("; ".join(alarms))
        self.path.bar.show_parts(
            [
                TimePart(row["letter"], worded(row["name"]), row["time_s"], limit_sort(row["letter"]))
                for row in limited
            ]
        )
        self.path.show_run(self.file, run)
        self.play.show_program(run.plan.time)
        text = self.tr("Cutter radius compensation and the tool are not simulated. Assumed: {count}")
        parts = [text.format(count=len(run.assumptions))]
        if (fault := run.plan.path.fault) is not None:
            # The control refuses the block of the fault, and runs nothing after it.
            left = len(self.job.lines) - fault.line + 1
            parts.insert(0, self.tr("Blocks that are not run: {count}.").format(count=left))
        self.missing.setText(" ".join(parts))
        self.missing.setToolTip("\n".join(map(self.worded, assumed_texts(self.file, run))))

    def _number_of(self, typed: str) -> str:
        """Return the number of a parameter as the control shows it; "" of one that has a name alone."""
        return "" if read_address(typed)[0] in self.file.schema.parameters else typed

    def _begin_try(self, row: int) -> None:
        """Begin to try another value of what limits: its parameter is in the field, as it is typed."""
        if row < len(self._limiting) and self._limiting[row]:
            self.change_form.set_answer("change", f"{self._limiting[row]}=+20%")
            self.change_form.editors["change"].setFocus()

    def worded(self, text: str) -> str:
        return sentenced(text, self._read().schema.family.family)

    def _show_moment(self, _seconds: float) -> None:
        """Mark where the axes are, and show the block that is run and what limits it."""
        run = self.outcome
        moment = moment_at(run.plan, self.play.moment) if run is not None else None
        if run is None or moment is None:
            return
        lines = self.lines.blocks.rows.lines
        self.path.show_moment(moment, self.play.moment, lines[moment.line - 1])
        # Only when the block is another one: a moment passes many times in each.
        if self.lines.show_line(moment.line, is_asked=False):
            letter = str(self.lines.blocks.rows.letters[moment.line])
            for row in range(self.limits.rowCount()):
                if self.limits.item(row, 0).text() == letter:
                    self.limits.selectRow(row)

    # -- the page ------------------------------------------------------------------

    def say(self, text: str) -> None:
        self.summary.setText(text)

    def _stop(self) -> None:
        self.play.pause()
        if self._task is not None:
            self._task.cancelled.set()
            self._task = None

    def hideEvent(self, event: QHideEvent) -> None:
        self._stop()
        super().hideEvent(event)
