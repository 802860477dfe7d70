"""The page Program of a file: a block typed, word by word; a program with its path, what limits it,
and the same with another value.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import cast

from PySide6.QtCore import Qt
from PySide6.QtGui import QHideEvent, QKeySequence, QShortcut
from PySide6.QtWidgets import (
    QFileDialog,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QSizePolicy,
    QSplitter,
    QTableWidget,
    QVBoxLayout,
    QWidget,
)

from amp_studio.errors import AmpStudioError
from amp_studio.files import ParameterFile, SavedVersion, day_and_time
from amp_studio.programs import ProgramBlockError, read_program
from amp_studio.schema import Address, Value, read_address
from amp_studio.sim import (
    JobProgress,
    PathColours,
    PathMoment,
    ProgramJob,
    ProgramRun,
    ProgramVersion,
    SimulationError,
    WhatIf,
    length_unit,
    limit_sort,
    limit_tries,
    limited_by,
    line_rows,
    moment_at,
    path_error_text,
    path_picture,
    run_against,
    try_summary,
    typed_places,
    typed_values,
    value_text,
    versions,
    what_if,
)
from amp_studio.ui.base.figures import written
from amp_studio.ui.base.plot import Plot
from amp_studio.ui.base.task import Task, TaskProgress
from amp_studio.ui.base.theme import GAP2, GAP3, font
from amp_studio.ui.base.translated import sentenced, worded
from amp_studio.ui.forms.form import Field, FieldForm
from amp_studio.ui.forms.segment import Segment
from amp_studio.ui.page.page_of_file import PageOfFile

from .program_block import block_fields, block_in_words
from .program_play import PlayBar, TimeBar, TimePart
from .program_tables import TableLook, fill, read_table
from .what_if_panel import WhatIfPanel

_LEFT = 210
"""Width in pixels of the program at least."""
_SHARES = (5, 11, 7)
"""Of the width: the program, its path, what limits it."""
MOST_LINES = 5000
FIRST = 2000
"""Blocks of a long program that are drawn before all of it is computed: in a twentieth of a second."""
"""Lines of a program that are listed; the rest is computed too."""
Apply = Callable[[Mapping[Address, Value]], bool]


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
        earlier: Callable[[], Sequence[SavedVersion]] = tuple,
    ) -> None:
        """``read`` returns the file as it is now, in a copy that nothing else changes; ``apply`` takes the
        values of a try into the file; ``earlier`` returns the file before its last saves.
        """
        super().__init__(parent)
        self._read, self._file, self._apply, self._earlier = read, read(), apply, earlier
        self._job: ProgramJob | None = None
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
        self.lines = read_table(
            self.tr("Blocks of the program"),
            (self.tr("Block"), self.tr("Limit"), self.tr("s")),
            TableLook(figures=(2,), bars=1),
        )
        self.limits = read_table(
            self.tr("What limits the feed"),
            ("", self.tr("What limits"), self.tr("s"), self.tr("%")),
            TableLook(wide=1, figures=(2, 3), chips=0),
        )
        # Of its rows there are a few: what is below has the room.
        self.limits.setSizeAdjustPolicy(QTableWidget.SizeAdjustPolicy.AdjustToContents)
        self.limits.cellActivated.connect(lambda row, _column: self._begin_try(row))
        self.limits.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Maximum)
        self.tries = WhatIfPanel()
        self.tries.limits_button.clicked.connect(self._try_limits)
        self.tries.earlier_button.clicked.connect(self._try_earlier)
        self.tries.ticked.connect(self._try_together)
        self.tries.applied.connect(self._apply_ticked)
        self.summary = QLabel()
        self.summary.setFont(font("text", own=True))
        self.summary.setWordWrap(True)
        self.title = QLabel()
        self.title.setFont(font("title", own=True))
        self.title.setWordWrap(True)
        self.missing = QLabel()
        self.missing.setFont(font("small", own=True))
        self.plot = Plot()
        self.view = Segment(
            self.tr("Path"), (("plan", self.tr("Plan"), ""), ("tilted", self.tr("Tilted"), ""))
        )
        self.view.show_choice("plan")
        self.colours = Segment(
            self.tr("Colour of the path"),
            (("limit", self.tr("Limit"), ""), ("feed", self.tr("Feed"), ""), ("error", self.tr("Error"), "")),
        )
        self.colours.show_choice("limit")
        for segment in (self.view, self.colours):
            segment.chosen.connect(lambda _key: self._draw())
        self.bar, self.play = TimeBar(), PlayBar()
        self.play.moved.connect(self._show_moment)
        self.words.hide()
        self._only = ""
        """Letter of the limit whose blocks alone are listed."""
        self._add_keys()
        self.form, self.change_form = FieldForm(block_fields()), FieldForm((self._change_field(),))
        self.form.entered.connect(self._entered)
        self.change_form.entered.connect(lambda _key: self._try(str(self.change_form.answers()["change"])))
        self._lay_out()
        self._say(self.tr("Type a block, or open a part program."))

    def _add_keys(self) -> None:
        """Have Space play, and 1 to 6 list the blocks of a limit alone, where nothing is typed."""
        for part in (self.lines, self.limits, self.plot, self.play.slider):
            keys: list[tuple[str, Callable[[], None]]] = [("Space", self.play.toggle)]
            keys += [(str(n + 1), partial(self._list_limit, n)) for n in range(6)]
            for key, do in keys:
                shortcut = QShortcut(QKeySequence(key), part, do)
                shortcut.setContext(Qt.ShortcutContext.WidgetShortcut)
        self.lines.setToolTip(self.tr("Space plays; 1 to 6 list the blocks of one limit, and all again"))

    def _list_limit(self, n: int) -> None:
        """List the blocks of the n-th limit alone; all of them where they are listed so."""
        cell = self.limits.item(n, 0)
        letter = cell.text() if cell is not None else ""
        self._only = "" if letter == self._only else letter
        for row in range(self.lines.rowCount()):
            own = self.lines.item(row, 1)
            self.lines.setRowHidden(row, bool(self._only) and (own is None or own.text() != self._only))

    def _change_field(self) -> Field:
        return Field(
            "change",
            self.tr("What &if"),
            hint="1210=+20%",
            tip=self.tr("A parameter and another value, several separated by semicolons; Enter tries it"),
        )

    def _lay_out(self) -> None:
        self.open_button = QPushButton(self.tr("&Open Program…"))
        self.open_button.setAutoDefault(False)
        self.open_button.clicked.connect(self.ask)
        self.head = QWidget()
        row = QHBoxLayout(self.head)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(GAP2)
        row.addWidget(self.view)
        row.addWidget(self.colours)
        row.addStretch()
        left, middle, right = QWidget(), QWidget(), QWidget()
        for side, parts in (
            (left, (self.open_button, self.lines, self.play, self.words, self.form)),
            (middle, (self.title, self.head, self.plot, self.bar)),
            (right, (self.limits, self.change_form, self.tries)),
        ):
            column = QVBoxLayout(side)
            column.setContentsMargins(0 if side is left else GAP2, 0, 0 if side is right else GAP2, 0)
            column.setSpacing(GAP2)
            for part in parts:
                column.addWidget(part)
        left.setMinimumWidth(_LEFT)
        splitter = QSplitter(Qt.Orientation.Horizontal)
        for n, side in enumerate((left, middle, right)):
            splitter.addWidget(side)
            splitter.setStretchFactor(n, _SHARES[n])
        splitter.setSizes([1000 * share for share in _SHARES])
        foot = QHBoxLayout()
        foot.addWidget(self.summary, 1)
        foot.addWidget(self.missing)
        column = QVBoxLayout(self)
        column.setContentsMargins(GAP3, GAP3, GAP3, GAP3)
        column.setSpacing(GAP2)
        column.addWidget(splitter, 1)
        column.addLayout(foot)

    # -- a block -------------------------------------------------------------------

    def _entered(self, key: str) -> None:
        if key == "block":
            self._read_block(str(self.form.answers()["block"]))
        else:
            self.run_again()

    def run_again(self) -> None:
        """Run the program once more, under the file of now."""
        if self._job is not None:
            self.start(self._job, self._name)

    def _read_block(self, text: str) -> None:
        """Show the words of a block; without one, what is active after power-up."""
        try:
            rows, remark = block_in_words(self._read(), text)
        except ProgramBlockError as error:
            self._say(self._worded(str(error)))
            return
        self.words.show()
        fill(self.words, rows)
        self._say(remark)

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
        self.outcome = None
        self._begin(
            lambda _show: ProgramJob(read_program(path, self._file)), lambda job: self.start(job, path.name)
        )

    def start(self, job: ProgramJob, name: str) -> None:
        """Run a program under the file of now."""
        # A copy of now: the run and its tries are of the same file, whatever is edited meanwhile.
        self._file = self._read()
        self.tries.show_lengths_in(length_unit(self._file))
        try:
            text = str(self.form.answers()["zero"]).strip()
            zero = typed_places(text, self._file) if text else None
        except SimulationError as error:
            self._say(self._worded(str(error)))
            return
        self._job, self._name = replace(job, zero=zero), name
        job = self._job
        if self.outcome is None and len(job.lines) > FIRST:
            self._begin(lambda show: self._beginning(job, show), self._run_all)
        else:
            self._run_all(None)

    def _beginning(self, job: ProgramJob, show: JobProgress) -> ProgramRun | None:
        """Return the beginning of a long program; None where it cannot be run without the rest."""
        try:
            return replace(job, lines=job.lines[:FIRST], with_contour=False).run(self._file, show)
        except (ProgramBlockError, SimulationError):
            return None

    def _run_all(self, beginning: ProgramRun | None) -> None:
        """Run all of the program, with its beginning in the picture so far."""
        job = self._job
        assert job is not None
        if beginning is not None:
            self.title.setText(
                self.tr("{name}: the first {count} blocks").format(name=self._name, count=FIRST)
            )
            self._draw_run(beginning, None)
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
            self._say(self._worded(str(error)))
            return
        self._compute([values], is_ticked=True)

    def _compute(self, tries: Sequence[Mapping[Address, Value]], *, is_ticked: bool) -> None:
        job = self._job
        assert job is not None
        self._begin(
            lambda show: what_if(job, self._file, tries, show),
            lambda found: self._show_tries(tries, found, is_ticked=is_ticked),
        )

    def _try_limits(self) -> None:
        """Run the program with more of each parameter that limits it."""
        if self.outcome is None:
            self._say(self.tr("Open a part program first."))
            return
        tries = list(limit_tries(self._file, self.outcome))
        if tries:
            self._compute(tries, is_ticked=False)
        else:
            self._say(self.tr("No parameter with a number limits this program."))

    def _try_earlier(self) -> None:
        """Run the program under the file as it was before its last saves."""
        job, before = self._job, self.outcome
        if before is None or job is None:
            self._say(self.tr("Open a part program first."))
            return
        earlier = self._earlier()
        if not earlier:
            self._say(self.tr("The file has no earlier versions: its history is empty."))
            return
        named = {self._version_name(each): each.file for each in earlier}
        self._begin(lambda show: versions(job, named, show), self._show_versions)

    def _version_name(self, version: SavedVersion) -> str:
        label = self._file.machine_schema.label
        changed = ", ".join(label(read_address(each)) for each in version.changed[:3])
        more = ", …" if len(version.changed) > 3 else ""
        return self.tr("Before {time}").format(time=day_and_time(version.when)) + f" ({changed}{more})"

    def _show_versions(self, found: Sequence[ProgramVersion]) -> None:
        assert self.outcome is not None
        for each in found:
            if each.run is None:
                self._say(self._worded(each.why_not))
                continue
            self.tries.add(each.name, None, run_against(self.outcome, each.run), is_ticked=False)
        self._say(self.tr("{count} earlier versions").format(count=len(found)))

    def _try_together(self) -> None:
        """Run the program with all ticked changes: they are computed together, not added."""
        job = self._job
        if job is None or len(self.tries.chosen()) < 2:
            return
        values = self.tries.values()
        self._begin(lambda show: what_if(job, self._file, [values], show)[0], self._show_together)

    def _show_together(self, tried: WhatIf) -> None:
        assert self.outcome is not None
        if tried.run is None:
            self._say(self._worded(tried.why_not))
            return
        self.tries.show_together(try_summary(self._file, self.outcome, tried))
        self._say("; ".join(map(self._worded, tried.not_allowed)))

    def _begin(self, work: Callable[[JobProgress], object], show: Callable[..., None]) -> None:
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
        task.progressed.connect(lambda what, done, _of: self._say(f"{self._worded(what)} {done} %"))
        task.done.connect(show)
        task.failed.connect(
            lambda error: self._say("" if isinstance(error, StoppedError) else self._worded(str(error)))
        )
        task.begin()

    def _show(self, run: ProgramRun) -> None:
        self.outcome, self._only = run, ""
        self.tries.clear()
        limited = limited_by(self._file, run)
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
        assert self._job is not None
        listed = {
            n: (letter, written(f"{time:.3g}")) for n, (letter, time) in line_rows(run, MOST_LINES).items()
        }
        fill(
            self.lines,
            [(line, *listed.get(n, ("", ""))) for n, line in enumerate(self._job.lines[:MOST_LINES], 1)],
        )
        time = written(value_text(run.plan.time, "s", 4))
        words = [f"{self._name}: {run.plan.path.blocks} {self.tr('blocks')}", time]
        if run.contour is not None:
            error = sentenced(path_error_text(run.contour.largest, length_unit(self._file)))
            words.append(self.tr("largest contour error {error}").format(error=error))
        self.title.setText(", ".join(words))
        alarms = [
            f"{self.tr('Line')} {each.line}: {each.code} {self._worded(each.message)}"
            for each in run.alarms[:2]
        ]
        self._say("; ".join(alarms))
        self.bar.show_parts(
            [
                TimePart(row["letter"], worded(row["name"]), row["time_s"], limit_sort(row["letter"]))
                for row in limited
            ]
        )
        self.play.show_program(run.plan.time)
        text = self.tr("Cutter radius compensation and the tool are not simulated. Assumed: {count}")
        parts = [text.format(count=len(run.assumptions))]
        if (fault := run.plan.path.fault) is not None:
            left = len(self._job.lines) - fault.line + 1
            parts.insert(0, self.tr("Blocks that are not run: {count}.").format(count=left))
        self.missing.setText(" ".join(parts))
        self.missing.setToolTip("\n".join(map(self._worded, run.assumptions)))

    def _number_of(self, typed: str) -> str:
        """Return the number of a parameter as the control shows it; "" of one that has a name alone."""
        return "" if read_address(typed)[0] in self._file.schema.parameters else typed

    def _begin_try(self, row: int) -> None:
        """Begin to try another value of what limits: its parameter is in the field, as it is typed."""
        if row < len(self._limiting) and self._limiting[row]:
            self.change_form.set_answer("change", f"{self._limiting[row]}=+20%")
            self.change_form.editors["change"].setFocus()

    def _worded(self, text: str) -> str:
        return sentenced(text, self._read().schema.family.family)

    def _show_moment(self, _seconds: float) -> None:
        """Draw where the axes are, and show the block that is run."""
        moment = self._draw()
        if moment is not None and moment.line <= self.lines.rowCount():
            self.lines.selectRow(moment.line - 1)

    def _draw(self) -> PathMoment | None:
        if self.outcome is None:
            return None
        moment = moment_at(self.outcome.plan, self.play.moment)
        self._draw_run(self.outcome, moment)
        return moment

    def _draw_run(self, run: ProgramRun, moment: PathMoment | None) -> None:
        colours = cast("PathColours", self.colours.choice or "limit")
        picture = path_picture(self._file, run, moment, colours)
        above = picture.close if self.view.choice == "tilted" else picture.above
        self.plot.draw(replace(picture, above=above, close=None))

    def _show_tries(
        self, values: Sequence[Mapping[Address, Value]], tries: Sequence[WhatIf], *, is_ticked: bool
    ) -> None:
        assert self.outcome is not None
        notes = []
        for each, tried in zip(values, tries, strict=True):
            if tried.run is None:
                notes.append(tried.why_not)
                continue
            found = try_summary(self._file, self.outcome, tried)
            named = map(self._file.machine_schema.label, tried.changes)
            changes = [
                f"{name}\n{one['from']} → {one['to']}"
                for name, one in zip(named, found["changes"], strict=True)
            ]
            self.tries.add("\n".join(changes), each, found, is_ticked=is_ticked)
            notes += tried.not_allowed
        self._say("; ".join(map(self._worded, notes)))
        self._try_together()

    def _apply_ticked(self) -> None:
        if self._apply(self.tries.values()):
            self.run_again()

    # -- the page ------------------------------------------------------------------

    def _say(self, text: str) -> None:
        self.summary.setText(text)

    def _stop(self) -> None:
        self.play.pause()
        if self._task is not None:
            self._task.cancelled.set()
            self._task = None

    def hideEvent(self, event: QHideEvent) -> None:
        self._stop()
        super().hideEvent(event)
