"""The motion page of a file: a scenario on one axis with the values of the file, and of the saved one."""

from __future__ import annotations

import html
import re
from collections.abc import Callable, Sequence
from functools import partial

from PySide6.QtCore import QSignalBlocker, Qt, QUrl
from PySide6.QtGui import QResizeEvent, QShowEvent, QStandardItemModel
from PySide6.QtWidgets import QComboBox, QLabel, QPushButton, QSplitter, QTabWidget, QWidget

from amp_studio.files import ParameterFile, RangeError, axis_title
from amp_studio.scenarios import CHARTS
from amp_studio.schema import Address, Value, angular, axis_name
from amp_studio.sim import Recommendation, SimulationError, Trace, address_of, picture_of, settling_span
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.places import sentenced_with_letters
from amp_studio.ui.base.plot import Plot
from amp_studio.ui.base.task import Task
from amp_studio.ui.base.theme import GAP2, GAP3, scheme, severity_colour
from amp_studio.ui.base.translated import scenario_in_words, sentenced, worded, written_to
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.forms.form import Field, FieldForm, fill_choices
from amp_studio.ui.forms.pages import LINK
from amp_studio.ui.page.page_of_file import PageOfFile

from .machine_page import MachinePage
from .recorder import RecorderPage
from .results import AssumptionsPage, FiguresPage, RecommendationsPage, name_of
from .run import AskedMotion, SimulatedMotion, run_motion, simulated_by
from .saving import ask_where, write_motion
from .settings import SettingsForm, scrolled

_MIN_FIGURES = 280
"""Height in pixels of the figures below the form, which is there whole; a low window scrolls both."""
_MAX_SIDE = 0.45
"""Share of the page that the form and its tabs may have without the user."""
_ASSUMED = re.compile(r"ASSUMED: (model\.\w+) = (.+?)\. ")


class MotionView(PageOfFile):
    """Simulates with the present values, and again after every edit that is seen;
    the trace of the saved file, or of what was kept for this scenario, lies under it.
    """

    def __init__(
        self,
        workspace: Workspace,
        address: Address | None,
        show: Callable[[Address], None],
        parent: QWidget | None = None,
        control: Callable[[], str | None] = lambda: None,
    ) -> None:
        """``control`` gives the address where the control of the file shows its status."""
        super().__init__(parent)
        self.setAccessibleName(self.tr("Motion"))
        self._workspace, self._show_parameter = workspace, show
        self._task: Task | None = None
        self._again = self._is_stale = False
        self._asked: tuple[object, ...] = ()
        self._impossible: SimulationError | None = None
        self._counts = False  # whether the axis moves in counts, not in a length or an angle
        self.trace: Trace | None = None
        self.before: Trace | None = None
        self._reference_values: dict[tuple[str, str], ParameterFile] = {}
        """Scenario and axis -> the values that were kept to compare with."""
        # The values of both traces; None until there is one.
        self._file_ran: ParameterFile | None = None
        self._file_before: ParameterFile | None = None
        self._make_widgets(control)
        self._arrange()
        self._fill(address[1] if address else "")
        self._connect()
        self.run()

    def _make_widgets(self, control: Callable[[], str | None]) -> None:
        self.scenario, self.axis, self.against = QComboBox(), QComboBox(), QComboBox()
        for box in (self.scenario, self.axis, self.against):
            box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.settings = SettingsForm(self.run)
        self.machine_page = MachinePage(
            self.run, lambda: (self._workspace.file, str(self.axis.currentData())), self._fail
        )
        self.machine = self.machine_page.form
        self.run_button, self.save_button = QPushButton(self.tr("&Run")), QPushButton(self.tr("&Save…"))
        self.recorder = RecorderPage(lambda: self._workspace.path, self._axis_names, control)
        self.settling, self.all_of_it = (
            QPushButton(self.tr("&Zoom to Settling")),
            QPushButton(self.tr("Show &All")),
        )
        self.keep = QPushButton(self.tr("&Keep"))
        self.against.setAccessibleName(self.tr("Compared with"))
        self.against.setToolTip(self.tr("What lies under the present motion, making the same move"))
        for key, name in (
            ("saved", self.tr("With the saved file")),
            ("kept", self.tr("With what was kept")),
            ("alone", self.tr("Alone")),
        ):
            self.against.addItem(name, key)
        self.chart = QComboBox()
        self.chart.setAccessibleName(self.tr("Chart"))
        self.chart.setToolTip(self.tr("How the open loop is drawn"))
        for name in CHARTS:
            self.chart.addItem(worded(name.capitalize()), name)
        self.keep.setToolTip(
            self.tr("Compare this scenario of this axis with the present values from now on")
        )
        self.summary, self.values = QLabel(), QLabel()
        self.summary.setWordWrap(True)
        self.summary.setTextInteractionFlags(Qt.TextInteractionFlag.TextBrowserInteraction)
        self.values.setTextFormat(Qt.TextFormat.RichText)
        self.values.setAlignment(Qt.AlignmentFlag.AlignTop)
        self.plot = Plot()
        self.figures, self.assumptions = FiguresPage(self._follow), AssumptionsPage()
        self.plot.setAccessibleName(self.tr("Simulated motion"))
        self.figures.setAccessibleName(self.tr("Figures of the motion"))
        self.recommendations = RecommendationsPage(self.apply, self._follow)
        for button in (self.save_button, self.settling, self.all_of_it, self.keep):
            button.setEnabled(False)
        self.chart.hide()

    def _arrange(self) -> None:
        form = FieldForm(
            (
                Field("scenario", self.tr("S&cenario"), "choice", editor=lambda: self.scenario),
                Field("axis", self.tr("A&xis"), "choice", editor=lambda: self.axis),
                Field("against", self.tr("&Under it"), "choice", editor=lambda: self.against),
            )
        )
        tools = in_row(self.chart, self.settling, self.all_of_it, 0)
        below = in_row(0, self.keep, self.run_button, self.save_button)
        self.tabs = QTabWidget()
        self.tabs.setDocumentMode(True)
        pages = (
            (self.figures, self.tr("Figures")),
            (self.recommendations, self.tr("Recommended")),
            (self.assumptions, self.tr("Assumed")),
        )
        for page, title in (
            *pages,
            (self.machine_page, self.tr("Machine")),
            (self.values, self.tr("Cursors")),
            (self.recorder, self.tr("Recorder")),
        ):
            self.tabs.addTab(page, title)
        side = QWidget()
        self.tabs.setMinimumHeight(_MIN_FIGURES)
        in_column(form, below, self.settings, (self.tabs, 1), on=side, margins=(GAP3, 0, GAP2, 0))
        left = QWidget()
        in_column(tools, (self.plot, 1), on=left, margins=0)
        self.middle = QSplitter()
        self.middle.addWidget(left)
        self.middle.addWidget(scrolled(side))
        self.middle.setStretchFactor(0, 1)
        self.middle.setSizes([790, 430])
        in_column(self.summary, (self.middle, 1), on=self, margins=(GAP3, GAP2, GAP2, GAP2))
        self.setFocusProxy(self.scenario)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Show the tabs whole where the picture keeps the greater part."""
        super().resizeEvent(event)
        picture, side = self.middle.sizes()
        wanted = side - self.tabs.width() + self.tabs.tabBar().sizeHint().width()
        if side < wanted <= _MAX_SIDE * (picture + side):
            self.middle.setSizes([picture + side - wanted, wanted])

    def _connect(self) -> None:
        self.scenario.currentIndexChanged.connect(self._choose)
        self.axis.currentIndexChanged.connect(self._choose)
        self.run_button.clicked.connect(self._run_or_stop)
        self.save_button.clicked.connect(self.save)
        self.chart.currentIndexChanged.connect(self._redraw)
        self.recorder.changed.connect(self.run)
        self.recorder.channels.rescaled.connect(self._redraw)
        self.recorder.live.connect(self.plot.draw)
        self.settling.clicked.connect(self._zoom_to_settling)
        self.all_of_it.clicked.connect(lambda: self.plot.zoom(None))
        self.against.currentIndexChanged.connect(self.run)
        self.keep.clicked.connect(self._keep_before)
        self.plot.read.connect(self.values.setText)
        self.summary.linkActivated.connect(lambda url: self._follow(QUrl(url)))
        self._workspace.changed.connect(self._after_edit)
        self._workspace.saved.connect(self._after_edit)
        self._workspace.closed.connect(self._end)
        scheme().changed.connect(self._redraw)

    # -- what can be chosen --------------------------------------------------------

    def _fill(self, wanted: str) -> None:
        """Fill the scenarios and axes of the file; keep the axis ``wanted`` where it is there."""
        file = self._workspace.file
        found, self._impossible = simulated_by(file)
        titles = [(axis, axis_title(file, axis)) for axis in found.axes]
        fill_choices(
            self.scenario,
            [(each.name, scenario_in_words(each.name)) for each in found.scenarios],
            str(self.scenario.currentData() or "step"),
        )
        fill_choices(self.axis, titles, wanted)
        chosen = next((each for each in found.scenarios if each.name == self.scenario.currentData()), None)
        others = [each for each in titles if each[0] != self.axis.currentData()]
        family = file.schema.family.family
        self.scenario.setToolTip(sentenced(chosen.title, family) if chosen else "")
        self.settings.offer_settings(chosen.settings if chosen else {}, self._units(), others, family)
        self.machine.offer_settings(found.model, ("", ""), family=family)
        self._offer_reference()

    def show_axis(self, axis: str) -> None:
        """Choose an axis where it can be simulated; another instance than of an axis changes nothing."""
        if (row := self.axis.findData(axis)) >= 0:
            self.axis.setCurrentIndex(row)

    def show_scenario(self, scenario: str, axis: str) -> None:
        """Choose a scenario of an axis, where they are there."""
        self.show_axis(axis)
        if (row := self.scenario.findData(scenario)) >= 0:
            self.scenario.setCurrentIndex(row)

    def _axis_names(self) -> tuple[str, str]:
        """Return number and letter of the chosen axis."""
        axis = str(self.axis.currentData() or "")
        return axis, axis_name(self._workspace.file.evaluation, axis) if axis else ""

    def _units(self) -> tuple[str, str]:
        """Return the units of distance and feedrate for the chosen axis."""
        if self._counts:
            return "", ""
        file, axis = self._workspace.file, self.axis.currentData()
        family = file.schema.family
        system = family.units.get(file.header.units, {})
        length, velocity = system.get("length", "mm"), system.get("velocity", "mm/min")
        turns = family.axes is not None and axis and file.evaluation.turns((family.axes.type, str(axis)))
        return (angular(length), angular(velocity)) if turns else (length, velocity)

    def _choose(self, *_: object) -> None:
        """Take another scenario or axis, with what was kept for it."""
        self.before = self._file_before = self.recorder.recording = None
        self._fill(str(self.axis.currentData()))
        self.machine_page.leave_axis(str(self.axis.currentData()))
        self.run()

    def _offer_reference(self) -> None:
        """Offer what was kept for this scenario and axis, where something was."""
        is_kept = self._what in self._reference_values
        rows = self.against.model()
        assert isinstance(rows, QStandardItemModel)
        rows.item(self.against.findData("kept")).setEnabled(is_kept)
        # The scenario is run after this anyway: the choice that is taken back must not run it as well.
        with QSignalBlocker(self.against):
            if not is_kept and self.against.currentData() == "kept":
                self.against.setCurrentIndex(self.against.findData("saved"))

    @property
    def _what(self) -> tuple[str, str]:
        """The scenario and the axis that are chosen."""
        return str(self.scenario.currentData() or "step"), str(self.axis.currentData())

    def _compared(self, file: ParameterFile) -> ParameterFile | None:
        """Return the values that those of ``file`` are compared with; None where none differs."""
        match self.against.currentData():
            case "kept":
                return self._reference_values.get(self._what)
            case "saved" if self._workspace.document.saved != file.values:
                saved = self._workspace.document.as_saved()
                # In the same units, or both curves would not share a scale.
                saved.header.units = file.header.units
                return saved
        return None

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        if self._is_stale:
            self._after_edit()

    def _after_edit(self, *_: object) -> None:
        """Update the choices and simulate again; while the page is hidden it is only marked as stale."""
        self._is_stale = not self.isVisible()
        if self._is_stale:
            return
        self._fill(str(self.axis.currentData()))
        self.run()

    # -- running -------------------------------------------------------------------

    def run(self, *_: object) -> None:
        """Simulate in a separate thread; a run requested meanwhile follows."""
        if self._task is not None:
            self._again = True
            self._task.cancelled.set()  # a sweep of values that are no longer those
            return
        if self._impossible is not None:
            self._stop(self._impossible)
            return
        try:
            settings = {**self.settings.filled_in(), **self.machine.filled_in()}
            trigger = self.recorder.chosen_trigger()
        except ValueError as error:
            self._fail(error)
            return
        file, axis = self._workspace.file.copy(), self.axis.currentData()
        scenario = str(self.scenario.currentData() or "step")
        asked, file_before = (scenario, axis, tuple(settings.items())), self._compared(file)
        # The trace before is made again only where its values or the settings are others.
        is_same = (self._file_before and self._file_before.values) == (file_before and file_before.values)
        before = self.before if is_same and asked == self._asked else None
        self._asked, self._file_before = asked, file_before
        wanted, record = str(axis) if axis else None, self.recorder.recording
        asks = AskedMotion(scenario, wanted, settings, file, file_before, before, record, trigger)
        self.summary.setText(self.tr("Simulating …"))
        self.run_button.setText(self.tr("&Stop") if scenario == "sweep" else self.tr("&Run"))
        self._task = Task(partial(run_motion, asks))
        self._task.progressed.connect(self._show_progress)
        self._task.done.connect(self._show_result)
        self._task.failed.connect(self._stop)
        self._task.finished.connect(self._ended)
        self._task.begin()

    def _run_or_stop(self) -> None:
        """Stop a sweep; run anything else."""
        if self._task is None:
            self.run()
        else:
            self._task.cancelled.set()

    def _show_progress(self, _stage: str, done: int, total: int) -> None:
        self.summary.setText(f"{self.tr('Simulating …')} {100 * done // max(total, 1)} %")

    def _ended(self) -> None:
        self._task = None
        self.run_button.setText(self.tr("&Run"))
        if self._again:
            self._again = False
            self.run()

    def _stop(self, error: Exception) -> None:
        """Show why there is no trace, and no old one that is not true any more."""
        self.trace = None
        self.recorder.show_trace(None)
        self.plot.clear_picture()
        self._redraw()
        self.figures.clear()
        self.assumptions.clear()
        self.recommendations.show_all(self._workspace.file.schema, (), self._may_apply)
        self.tabs.setTabText(1, self.tr("Recommended"))
        for button in (self.save_button, self.settling, self.all_of_it, self.keep):
            button.setEnabled(False)
        self._fail(error)

    def _fail(self, error: Exception) -> None:
        """Show what is true, with a way to the parameter that has to be set."""
        text = html.escape(sentenced_with_letters(self._workspace.file, str(error)))
        parameter = getattr(error, "parameter", "")
        schema = self._workspace.file.schema
        if parameter in schema.parameters:
            there = self.tr("Go to {name}").format(name=html.escape(name_of(schema, parameter)))
            text += f' <a href="{LINK}{parameter}">{there}</a>'
        self.summary.setText(f'<span style="color:{severity_colour("error").name()}">{text}</span>')

    def _show_result(self, ran: SimulatedMotion) -> None:
        trace = ran.trace
        self.trace, self._file_ran = trace, ran.file
        self.recorder.show_trace(trace, ran.record_error)
        self.before = ran.before if ran.before and ran.before.units == trace.units else None
        counts = trace.units.get("position") == "counts"
        # That an axis moves in counts is known only from its trace: the units of the settings follow it.
        if counts != self._counts:
            self._counts = counts
            self._fill(str(self.axis.currentData()))
        for button in (self.save_button, self.all_of_it, self.keep):
            button.setEnabled(True)
        self.settling.setEnabled(settling_span(trace) is not None)
        schema = self._workspace.file.schema
        family = schema.family.family
        assumed = sum(text.startswith("ASSUMED") for text in trace.assumptions)
        text = self.tr("<b>%n figures of the machine are assumed</b>, see Assumed.", "", assumed)
        self.summary.setText(f"{html.escape(sentenced(trace.model, family))}. {text if assumed else ''}")
        self.recommendations.show_all(schema, trace.recommendations, self._may_apply)
        self._show_count(len(trace.recommendations))
        self.assumptions.show_trace(family, trace)
        taken = (_ASSUMED.match(text) for text in trace.assumptions)
        self.machine.show_defaults(
            {found[1]: self.tr("{what}, assumed").format(what=found[2]) for found in taken if found}
        )
        self._redraw()

    def _show_count(self, count: int) -> None:
        """Show in the tab how many recommendations there are."""
        title = self.tr("Recommended ({count})").format(count=count) if count else self.tr("Recommended")
        self.tabs.setTabText(1, title)

    def _redraw(self, *_: object) -> None:
        if self.trace is None:
            # A record can be read where nothing can be simulated, too.
            if alone := self.recorder.alone():
                self.plot.draw(self.recorder.channels.scaled(alone))
        else:
            self.chart.setVisible(self.trace.scenario == "frequency")
            picture = picture_of(self.trace, self.before, str(self.chart.currentData()))
            self.plot.draw(self.recorder.channels.scaled(picture))
            family = self._workspace.file.schema.family.family
            self.figures.show_trace(family, self.trace, self.before, str(self.against.currentData()))

    def _zoom_to_settling(self) -> None:
        self.plot.zoom(settling_span(self.trace) if self.trace else None)

    def _keep_before(self) -> None:
        if self._file_ran is not None:
            self._reference_values[self._what] = self._file_ran
        self._offer_reference()
        # Chosen already, the box emits nothing: the run has to be asked for.
        if self.against.currentData() == "kept":
            self.run()
        self.against.setCurrentIndex(self.against.findData("kept"))

    # -- recommendations -------------------------------------------------------------

    def _address(self, parameter: str) -> Address | None:
        axis = self.trace.axis if self.trace else ""
        return address_of(self._workspace.file, parameter, axis)

    def _may_apply(self, parameter: str) -> bool:
        return self._workspace.may_edit and self._address(parameter) is not None

    def apply(self, found: Sequence[Recommendation]) -> None:
        """Set recommended values as one undoable step; the run after it follows from the change."""
        wanted: dict[Address, Value | None] = {}
        for each in found:
            address = self._address(each.parameter)
            if address is None:
                continue
            old = self._workspace.file.get(address)
            whole = old is not None and isinstance(old.value, int) and each.value.is_integer()
            wanted[address] = Value(int(each.value) if whole else each.value, each.unit)
        try:
            self._workspace.edit(self.tr("Apply Recommendation"), wanted)
        except RangeError as error:
            self._fail(error)

    def _follow(self, url: QUrl) -> None:
        address = self._address(url.toString().removeprefix(LINK))
        if address is None:
            parameter = url.toString().removeprefix(LINK)
            instances = self._workspace.file.machine_schema.instances(
                self._workspace.file.schema.parameters[parameter]
            )
            axis = str(self.axis.currentData())
            # A link to a parameter of the machine or of another kind of instance leads to its first value.
            address = (parameter, axis if axis in instances else instances[0])
        self._show_parameter(address)

    # -- files -----------------------------------------------------------------------

    def save(self) -> None:
        """Write the trace as CSV, or its picture as SVG or PNG."""
        if self.trace is None:
            return
        chart = str(self.chart.currentData())
        given = [(name, str(value), self.tr("entered")) for name, value in self.machine.filled_in().items()]
        path = ask_where(self, self._workspace.path, self.trace)
        if path is None or self._file_ran is None:
            return
        try:
            notes = write_motion(
                path, self._file_ran, self._workspace.path.name, self.trace, self.before, chart, given
            )
        except (OSError, ValueError) as error:
            self._fail(error)
        else:
            self.summary.setText(html.escape("; ".join([written_to(path), *notes])))

    def _end(self) -> None:
        """Ignore the result of a run that has not finished."""
        self._workspace.changed.disconnect(self._after_edit)
        self.recorder.end()
        if self._task is not None:
            # The thread goes on: what it emits must not reach widgets that are being deleted.
            self._task.done.disconnect(self._show_result)
            self._task.failed.disconnect(self._stop)
            self._task.finished.disconnect(self._ended)
