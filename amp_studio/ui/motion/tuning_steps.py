"""The printed way of tuning an axis as steps: what to change, what to look for, what the simulated axis shows
now; beside them the gains that the solver proposes for an aim, before and after.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np
from PySide6.QtCore import QSignalBlocker, QSize, Qt, QUrl, Signal
from PySide6.QtWidgets import QComboBox, QLabel, QListWidget, QListWidgetItem, QPushButton, QSplitter, QWidget

from amp_studio.drawing import linked
from amp_studio.files import ParameterFile, now, user
from amp_studio.guide import tick
from amp_studio.schema import Address, Guide, Value, axis_name
from amp_studio.sim import (
    Recommendation,
    SimulationError,
    Trace,
    add_tuning,
    address_of,
    picture_of,
    recorded_tuning,
    simulate,
    simulated_axes,
    value_text,
)
from amp_studio.ui.base.figures import written
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.places import sentenced_with_letters
from amp_studio.ui.base.plot import Plot
from amp_studio.ui.base.single_shot import single_shot
from amp_studio.ui.base.theme import CONTROL, GAP, GAP2, SMALL_ICON, icon
from amp_studio.ui.base.translated import sentenced, unit_in_words, worded
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.forms.pages import LINK
from amp_studio.ui.forms.segment import Segment

from .latest_work import LatestWork
from .map_rows import nearest_row, row_beside
from .results import RecommendationsPage
from .settings import scrolled
from .step_detail import StepDetail
from .tuning_target import FileTarget, TuningTarget

_SETTLE_MS = 250
"""Milliseconds without a further change before it is simulated again."""
_LEFT, _RIGHT = 258, 266
"""Widths in pixels of the steps and of what is proposed."""
_ROWS = 9
"""Steps that are seen at once."""
_FIGURES = ("Ms", "phase_margin", "gain_margin", "bandwidth", "stiffness", "velocity_loop_Ms")
_STEP, _TUNE, _MAP = "step", "tune", "sweep"
_OTHERS_TUNED = "With the other gains as they are none is safe"
"""Begins the sentence of a map in which other gains than its two are not the present ones."""
_DONE, _OPEN = "check-circle-fill", "circle"


class TuningSteps(QWidget):
    """One guide of tuning, at the file or at a control."""

    send_requested = Signal(list)
    """Addresses of proposed values, in the file by now, that are to be sent to the control, and no others."""

    def __init__(
        self, guide: Guide, workspace: Workspace, guarded: Callable[[Callable[[], object]], object]
    ) -> None:
        """``workspace`` has the ticks; ``guarded`` runs what may fail and shows the error."""
        super().__init__()
        self.guide, self._workspace, self._guarded = guide, workspace, guarded
        self._target: TuningTarget | None = None
        # One run of a kind at a time: else an older result could be shown over a newer one.
        self._work = {key: LatestWork() for key in (_STEP, _MAP, _TUNE)}
        self.mapped: Trace | None = None
        self._row: int | None = None
        """The row of the map that is proposed; None where the gains of the solver are."""
        self.now: Trace | None = None
        self.before: Trace | None = None
        """The axis as it was when the step was opened."""
        self.tuned: Trace | None = None
        self._make_widgets()
        self._arrange()
        self._timer = single_shot(self, self.run, _SETTLE_MS)
        for work in self._work.values():
            work.done.connect(self._receive)
        self.steps.currentRowChanged.connect(lambda *_: self._open())
        self.axis.currentIndexChanged.connect(lambda *_: self._open())
        self.below.pointed.connect(self._pointed)
        self.below.stepped.connect(self._move_point)
        self.aim.chosen.connect(self._aimed)
        self.chart.chosen.connect(self._charted)

    def _make_widgets(self) -> None:
        self.title = QLabel()
        self.title.setWordWrap(True)
        self.steps = QListWidget()
        self.steps.setAccessibleName(self.tr("Steps of tuning"))
        self.steps.setIconSize(QSize(SMALL_ICON, SMALL_ICON))
        self.detail = StepDetail(self._guarded)
        self.next, self.back = QPushButton(self.tr("Done, Ne&xt")), QPushButton(self.tr("Bac&k"))
        self.page = QLabel()
        self.next.clicked.connect(lambda: self._go(1))
        self.back.clicked.connect(lambda: self._go(-1))
        self.axis = QComboBox()
        self.axis.setAccessibleName(self.tr("Simulated axis"))
        self.plot, self.below = Plot(), Plot(has_cursors=False)
        self.plot.setAccessibleName(self.tr("What the simulated axis shows"))
        self.below.setAccessibleName(self.tr("The axis with the proposed gains"))
        self.aim = Segment(
            self.tr("Aim"),
            (
                ("quiet", self.tr("Quiet"), ""),
                ("normal", self.tr("Normal"), ""),
                ("stiff", self.tr("Stiff"), ""),
            ),
        )
        self.aim.show_choice("normal")
        self._aim = "normal"
        self.chart = Segment(
            self.tr("Below"), ((_TUNE, self.tr("Inertia"), ""), (_MAP, self.tr("Gain Map"), ""))
        )
        self.chart.show_choice(_TUNE)
        self._chart = _TUNE
        self.proposed = RecommendationsPage(self._apply, self._follow)
        self.send = QPushButton(icon("arrow-line-down"), self.tr("Se&nd…"))
        self.send.setToolTip(
            self.tr("Take the proposed values into the file, and send these alone: at the control")
        )
        self.send.clicked.connect(self._send)
        self.send.hide()
        self._found: Sequence[Recommendation] = ()
        self.figures, self.assumed = QLabel(), QLabel()
        for label in (self.figures, self.assumed):
            label.setWordWrap(True)
            label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)

    def _arrange(self) -> None:
        left, middle, right = QWidget(), QWidget(), QWidget()
        footer = in_row(self.next, self.back, 0, self.page)
        detail = scrolled(self.detail)
        in_column(self.title, self.steps, (detail, 1), footer, on=left, margins=(GAP2, 0, GAP, GAP2))
        label = QLabel(self.tr("Axi&s"))
        label.setBuddy(self.axis)
        head = in_row(label, self.axis, 0, self.chart)
        in_column(head, (self.plot, 1), (self.below, 1), on=middle, margins=(GAP, 0, 0, 0))
        aim = in_row(self.aim, 0)
        column = in_column(
            aim, self.figures, (self.proposed, 1), on=right, margins=(GAP, 0, GAP2, GAP2), gap=GAP
        )
        column.addWidget(self.send, 0, Qt.AlignmentFlag.AlignRight)
        column.addWidget(self.assumed)
        left.setFixedWidth(_LEFT)
        right.setFixedWidth(_RIGHT)
        splitter = QSplitter(Qt.Orientation.Horizontal)
        for widget in (left, middle, right):
            splitter.addWidget(widget)
        splitter.setChildrenCollapsible(False)
        in_row(splitter, on=self, margins=0)

    # -- what is shown -------------------------------------------------------------

    def show_target(self, target: TuningTarget) -> None:
        """Show the values of a file, or of what a control contains."""
        if self._target is not None:
            self._target.changed.disconnect(self._changed)
        self._target = target
        target.changed.connect(self._changed)
        family, file = target.file.schema.family.family, target.file
        self.title.setText(worded(self.guide.title, family))
        axis = self.axis.currentData()
        with QSignalBlocker(self.axis):
            self.axis.clear()
            for each in simulated_axes(file):
                letter = axis_name(file.evaluation, each)
                self.axis.addItem(f"{each} {letter}" if letter and letter != each else each, each)
            self.axis.setCurrentIndex(max(0, self.axis.findData(axis)))
        with QSignalBlocker(self.steps):
            row = max(0, self.steps.currentRow())
            self.steps.clear()
            for n, step in enumerate(self.guide.steps, 1):
                item = QListWidgetItem(icon(_OPEN), f"{n}  {worded(step.title, family)}")
                item.setSizeHint(QSize(0, CONTROL))
                self.steps.addItem(item)
            self.steps.setCurrentRow(row)
            self.steps.setFixedHeight(min(self.steps.count(), _ROWS) * (CONTROL + 1) + GAP)
        self._open()

    def _open(self) -> None:
        """Show the present step of the axis, from how it moves now."""
        step = self.guide.steps[max(0, self.steps.currentRow())]
        self.before = self.now = self.tuned = self.mapped = None
        self.page.setText(worded(f"page {step.page}"))
        self.back.setEnabled(self.steps.currentRow() > 0)
        self._show_step()
        self._timer.start()

    def _show_step(self) -> None:
        self._show_ticks()
        if self._target is not None and self.axis.currentData() is not None:
            step = self.guide.steps[max(0, self.steps.currentRow())]
            self.detail.show_step(self._target, step, str(self.axis.currentData()))

    def _changed(self, *_: object) -> None:
        self._show_step()
        self._timer.start()

    def showEvent(self, event: object) -> None:
        """Simulate once it is seen."""
        super().showEvent(event)  # type: ignore[arg-type]  # Qt gives the event of this kind
        self._timer.start()

    def _go(self, by: int) -> None:
        """Tick the step in the file and open the next one, or go back; no value is changed by it."""
        row = self.steps.currentRow()
        ticked, file = row if by > 0 else row - 1, self._workspace.file
        if self._workspace.may_edit and ticked >= 0:
            who = self.tr("{now} by {user}").format(now=now(), user=user()) if by > 0 else None
            name = self.steps.item(ticked).text()
            text = self.tr("{test} done") if by > 0 else self.tr("{test} not done")
            key = self._tick_of(ticked)
            self._guarded(lambda: self._workspace.do(text.format(test=name), lambda: tick(file, key, who)))
        self.steps.setCurrentRow(min(max(0, row + by), self.steps.count() - 1))

    def _tick_of(self, row: int) -> str:
        """Return what the tick of a step of this axis is kept under in the file."""
        return f"{self.guide.id}-{row + 1}@{self.axis.currentData()}"

    def _show_ticks(self) -> None:
        """Show which steps of the axis are done, and by whom."""
        family = self._workspace.file.schema.family.family
        for row, step in enumerate(self.guide.steps[: self.steps.count()]):
            who = self._workspace.file.header.done.get(self._tick_of(row), "")
            item = self.steps.item(row)
            item.setIcon(icon(_DONE if who else _OPEN))
            item.setToolTip("\n".join(filter(None, (worded(step.title, family), who))))

    # -- what is computed ----------------------------------------------------------

    def run(self) -> None:
        """Simulate the step, and seek the gains, in threads; once more where something changed meanwhile."""
        if self._target is None or not self.isVisible() or self.axis.currentData() is None:
            return
        file, axis = self._target.simulated(), str(self.axis.currentData())
        shows = self.guide.steps[self.steps.currentRow()].shows
        # What is proposed has all the room beside a step without a move.
        self.plot.setVisible(shows is not None)
        if shows is not None:
            scenario, settings = shows.scenario, dict(shows.settings)
            # Tapping is of the machine: it finds the spindle and the axis that taps itself.
            on = None if scenario == "tap" else axis
            self._work[_STEP].ask(lambda: (_STEP, _simulated(file, scenario, on, settings)))
        aim = self._aim
        if self._chart == _MAP:
            self._work[_MAP].ask(lambda: (_MAP, _simulated(file, "sweep", axis, {})))
        # Also beside the map: the gains and their figures are always shown.
        self._work[_TUNE].ask(lambda: (_TUNE, _simulated(file, "tune", axis, {"tune.for": aim})))

    def _receive(self, made: tuple[str, Trace | SimulationError]) -> None:
        key, found = made
        if isinstance(found, SimulationError):
            self._failed(key, found)
        else:
            {_STEP: self._stepped, _MAP: self._mapped, _TUNE: self._tuned}[key](found)

    def _stepped(self, trace: Trace) -> None:
        # The first run of a step is how the axis was before anything was changed.
        if self.before is None or self.before.scenario != trace.scenario:
            self.before = trace
        self.now = trace
        picture = picture_of(trace, self.before if self.before is not trace else None)
        # Of a move the position comes first, in which nothing is seen.
        panels = picture.panels[1:3] if len(picture.panels) > 2 else picture.panels
        self.plot.draw(replace(picture, panels=linked(panels)))
        self.detail.show_figures(self.guide.steps[self.steps.currentRow()], trace, self.before)

    def _tuned(self, trace: Trace) -> None:
        assert self._target is not None
        self.tuned, self._row = trace, None
        if self._chart == _TUNE:
            self.below.draw(picture_of(trace))
        schema = self._target.file.schema
        self._propose(trace.recommendations, self._figures_text(trace))
        assumed = [text for text in trace.assumptions if text.startswith("ASSUMED: model.")]
        family = schema.family.family
        # The first sentence has setting and value; the reasons behind it have no room here.
        self.assumed.setText("\n".join(sentenced(text.split(". ")[0] + ".", family) for text in assumed))

    def _figures_text(self, trace: Trace) -> str:
        """Return Ms, margins, bandwidth and stiffness in the file and as proposed, as a table."""
        of_file = isinstance(self._target, FileTarget)
        heads = (self.tr("in the file") if of_file else self.tr("in the control"), self.tr("proposed"))
        rows = [f"<tr><td></td><td align=right>{heads[0]}</td><td align=right>{heads[1]}</td></tr>"]
        for name in _FIGURES:
            if name not in trace.result:
                continue
            cells = []
            for key in (f"{name}_before", name):
                value = trace.result.get(key, (None, ""))[0]
                text = self.tr("unstable") if value is None and name == "Ms" else "–"
                cells.append(text if value is None else written(value_text(value, digits=3)))
            # The unit is behind the name, where it finds room in another line, but is not broken itself.
            unit = unit_in_words(trace.result[name][1]).replace("/", "/\N{WORD JOINER}")
            words = worded(name.replace("_", " ")) + (f" ({unit})" if unit else "")
            rows.append(
                f"<tr><td>{words}</td><td align=right>{cells[0]}</td>"
                f"<td align=right><b>&nbsp;{cells[1]}</b></td></tr>"
            )
        return f"<table cellspacing=0 cellpadding=1 width=100%>{''.join(rows)}</table>"

    def _propose(self, found: Sequence[Recommendation], figures: str) -> None:
        """Show gains that can be applied, with what the loop has with them."""
        assert self._target is not None
        may = self._target.may_edit
        self.proposed.show_all(
            self._target.file.schema, found, lambda name: may and self._address(name) is not None
        )
        self.figures.setText(figures)
        self._found = found
        self.send.setVisible(bool(found) and may and isinstance(self._target, FileTarget))

    def _pointed(self, x: float, y: float) -> None:
        """Propose the gains of a point of the map: the nearest that was computed."""
        if self.mapped is not None:
            self._propose_row(self.mapped, nearest_row(self.mapped, (x, y)))

    def _move_point(self, *steps: int) -> None:
        """Propose the gains beside those that are proposed on the map, or beside the present ones."""
        if self.mapped is not None:
            self._propose_row(self.mapped, row_beside(self.mapped, self._row, steps))

    def _propose_row(self, trace: Trace, row: int) -> None:
        if self._target is None or row == self._row:
            return
        self._row = row
        one, two = (float(trace.columns[name][row]) for name in trace.over)
        self.below.mark(self.tr("proposed"), (one, two))
        is_safe = trace.columns["safe"][row] == 1.0
        why = self.tr("Point of the map: safe.") if is_safe else self.tr("Point of the map: not safe.")
        found = [
            Recommendation(
                name, self._settable(name, float(trace.columns[name][row])), trace.limits[name][1], why, ""
            )
            for name in trace.over
        ]
        text = self._figures_text(replace(trace, result=self._figures_of_row(trace, row)))
        if any(each.startswith(_OTHERS_TUNED) for each in trace.assumptions):
            # The map is of the axis with its other gains as tune has them: they belong to the point.
            is_known = self.tuned is not None and self._aim == "normal"
            others = self.tuned.recommendations if self.tuned is not None and is_known else ()
            found += [each for each in others if each.parameter not in trace.over]
            text = text if is_known else ""
        self._propose(found, text)

    def _figures_of_row(self, trace: Trace, row: int) -> dict[str, tuple[float | None, str]]:
        """Return the figures of a point of the map, each with that of the file as it is."""
        figures = {name: trace.columns[name][row] for name in _FIGURES if name in trace.columns}
        there = {name: None if np.isnan(each) else float(each) for name, each in figures.items()}
        result = {name: (each, trace.units.get(name, "")) for name, each in there.items()}
        # The figures of the file are not those of a cell near it.
        known = self.tuned.result if self.tuned else {}
        before = [f"{name}_before" for name in there]
        return result | {name: known[name] for name in before if name in known}

    def _settable(self, parameter: str, value: float) -> float:
        """Return a gain as it can be set: whole where it is, else with three digits."""
        address = self._address(parameter)
        old = self._target.file.get(address) if self._target is not None and address else None
        is_whole = old is not None and isinstance(old.value, int)
        return float(round(value)) if is_whole else float(f"{value:.3g}")

    def _mapped(self, trace: Trace) -> None:
        self.mapped, self._row = trace, None
        if self._chart == _MAP:
            self.below.draw(picture_of(trace))

    def _failed(self, key: str, error: Exception) -> None:
        text = (
            sentenced_with_letters(self._target.file, str(error)) if self._target else sentenced(str(error))
        )
        if key == _STEP:
            self.plot.clear_picture()
            self.detail.show_figures(self.guide.steps[self.steps.currentRow()], None, None, text)
        elif key == _TUNE:
            self.tuned = None
            self.figures.setText(text)
            self.below.clear_picture()
        else:
            self.below.clear_picture()

    # -- what is chosen ------------------------------------------------------------

    def _aimed(self, key: str) -> None:
        self._aim = key
        self.aim.show_choice(key)
        self._timer.start()

    def _charted(self, key: str) -> None:
        self._chart = key
        self.chart.show_choice(key)
        self._timer.start()

    def _address(self, parameter: str) -> Address | None:
        assert self._target is not None
        return address_of(self._target.file, parameter, str(self.axis.currentData()))

    def _values_of(self, found: Sequence[Recommendation]) -> dict[Address, Value | None]:
        """Return proposed values as the file writes them."""
        assert self._target is not None
        values = dict[Address, Value | None]()
        for each in found:
            address = self._address(each.parameter)
            if address is not None:
                old = self._target.file.get(address)
                whole = old is not None and isinstance(old.value, int) and each.value.is_integer()
                values[address] = Value(int(each.value) if whole else each.value, each.unit)
        return values

    def _apply(self, found: Sequence[Recommendation]) -> None:
        """Set proposed values as one step, in the file or in the control."""
        assert self._target is not None
        target, values = self._target, self._values_of(found)
        self._guarded(lambda: self._set_and_record(target, values))

    def _send(self) -> None:
        """Take what is proposed into the file, and have these values alone sent."""
        values, found = self._values_of(self._found), self._found
        self._apply(found)
        if self._target is not None and all(self._target.file.get(a) == v for a, v in values.items()):
            self.send_requested.emit(list(values))

    def _set_and_record(self, target: TuningTarget, values: Mapping[Address, Value | None]) -> None:
        """Set values; all that are proposed go into the tuning record, with what the loop had and has. Raises
        ValueError, OSError.
        """
        found, before = self.tuned, target.file.copy()
        target.set(self.tr("Apply Recommendation"), values)
        # With a part of them the loop is neither that of before nor that of after.
        if found is not None and all(
            self._address(each.parameter) in values for each in found.recommendations
        ):
            add_tuning(target.path, recorded_tuning(before, target.path, found, self._aim))

    def _follow(self, url: QUrl) -> None:
        address = self._address(url.toString().removeprefix(LINK))
        if address in self.detail.fields:
            self.detail.fields[address].setFocus()


def _simulated(
    file: ParameterFile, scenario: str, axis: str | None, settings: dict[str, float | str]
) -> Trace | SimulationError:
    try:
        return simulate(file, scenario, axis, settings, file.header.units)
    except SimulationError as error:
        return error
