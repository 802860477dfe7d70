"""The page Tuning of a file: what is tuned at the machine, step by step of its manual,
in the open file or in the control that is connected.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtCore import QEvent, QSize, Qt, Signal
from PySide6.QtGui import QKeyEvent, QKeySequence
from PySide6.QtWidgets import (
    QLabel,
    QListWidget,
    QPushButton,
    QScrollArea,
    QSplitter,
    QStackedWidget,
    QVBoxLayout,
    QWidget,
)

from amp_studio.calibration import compensation_of
from amp_studio.files import RangeError
from amp_studio.schema import Guide, registration_of
from amp_studio.ui.base.ask_path import ask_to_open
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.loading import load
from amp_studio.ui.base.modal import run_dialog
from amp_studio.ui.base.questions import ask
from amp_studio.ui.base.task import Task
from amp_studio.ui.base.theme import CONTROL, GAP2, icon
from amp_studio.ui.base.translated import worded
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.forms.message_bar import MessageBar
from amp_studio.ui.forms.segment import Segment
from amp_studio.ui.page.page_of_file import PageOfFile

from .tuning_target import ControlTarget, ControlWork, FileTarget, TuningTarget
from .tuning_values import ValuesPage

if TYPE_CHECKING:
    from amp_studio.transfer.client import LiveTuning

    from .calibration_page import CalibrationPage
    from .step_answer import StepAnswer
    from .tuning_steps import TuningSteps

Connect = Callable[[], "LiveTuning | None"]
"""Asks for a control and returns it, not yet read; None where the user names none."""
_LIST_WIDTH = 190


class TuningView(PageOfFile):
    """Steps at the left; above them what is tuned, and what the control contains."""

    send_requested = Signal(list)
    """Addresses of values of the file that are to be sent to the control, and no others."""

    def __init__(self, workspace: Workspace, connect: Connect, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAccessibleName(self.tr("Tuning"))
        self._workspace, self._connect = workspace, connect
        self.file_target = FileTarget(workspace)
        self.control: ControlTarget | None = None
        self.target: TuningTarget = self.file_target
        self.message = MessageBar()
        self.state = QLabel()
        self.state.setTextFormat(Qt.TextFormat.PlainText)
        self.switch = Segment(
            self.tr("What is tuned"),
            (("file", self.tr("File"), "floppy-disk"), ("control", self.tr("Control"), "cpu")),
        )
        self.switch.chosen.connect(lambda key: self.guarded(lambda: self._choose(key)))
        self.send = self._button(self.tr("Do&wnload Values"), self._send, "arrow-line-down")
        self.look = self._button(self.tr("Read A&gain"), self._read_again, "arrow-line-up")
        self.put_back = self._button(self.tr("Put Old Values &Back"), self._put_back, "arrow-u-up-left")
        self.take = self._button(self.tr("Take Into Fil&e"), self._copy_to_file, "floppy-disk")
        self.pages, self.stack = QListWidget(), QStackedWidget()
        self.pages.setAccessibleName(self.tr("Pages"))
        self.answer: StepAnswer | None = None
        self.guided: list[TuningSteps] = []
        """The printed ways of tuning, each made when it is first shown."""
        self.values: list[ValuesPage] = []
        self._later: dict[QWidget, Callable[[], None]] = {}
        self.calibration: CalibrationPage | None = None
        self._is_asked = False
        """Whether it was asked what shall be in the control when the file is closed."""
        self._make_pages()
        self._arrange()
        self.pages.currentRowChanged.connect(self._bring)
        workspace.closed.connect(self._end)
        self._show(self.file_target)
        self.setFocusProxy(self.pages)
        self.pages.setCurrentRow(0)

    def _button(self, text: str, act: Callable[[], object], icon_name: str) -> QPushButton:
        button = QPushButton(icon(icon_name), text)
        button.clicked.connect(lambda *_: self.guarded(act))
        return button

    def _make_pages(self) -> None:
        """Make the pages of values; those with a plot are made when they are first shown,
        because plots take long to load.
        """
        family = self._workspace.file.schema.family.family
        offered = compensation_of(family)
        titles: list[tuple[str, QWidget]] = []
        for page in offered.pages:
            is_reversal = page.params == (offered.reversal,)
            values = ValuesPage(page, self.guarded, self.read_measured if is_reversal else None)
            self.values.append(values)
            widget: QWidget = values
            if page.key == "servo" and registration_of(family).law:
                widget = QSplitter(Qt.Orientation.Vertical)
                widget.addWidget(values)
                widget.setChildrenCollapsible(False)
                self._later[widget] = partial(self._make_answer, widget, values)
            titles.append((worded(page.title), widget))
        if offered.table is not None:
            holder = _empty_page()
            self._later[holder] = partial(self._make_calibration, holder)
            keys = [page.key for page in offered.pages]
            # Before what is tuned by it: gains are tried on an axis whose scale is right.
            at = next((n for n, key in enumerate(keys) if key in ("servo", "filters", "steps")), len(titles))
            titles.insert(at, (self.tr("Axis Calibration"), holder))
        for guide in self._workspace.file.schema.guides:
            if any(step.shows for step in guide.steps):
                holder = _empty_page()
                self._later[holder] = partial(self._make_steps, holder, guide)
                titles.append((worded(guide.title, family), holder))
        for n, (title, widget) in enumerate(titles):
            self.pages.addItem(title)
            item = self.pages.item(n)
            item.setToolTip(title)
            item.setSizeHint(QSize(0, CONTROL + 4))
            self.stack.addWidget(widget)
        Task(lambda *_: _load_plots()).begin()

    def _make_answer(self, holder: QSplitter, values: ValuesPage) -> None:
        _load_plots()
        from .step_answer import StepAnswer

        self.answer = StepAnswer()
        values.axis_chosen.connect(self.answer.choose)
        holder.addWidget(self.answer)
        self.answer.show_target(self.target)

    def _make_steps(self, holder: QWidget, guide: Guide) -> None:
        _load_plots()
        from .tuning_steps import TuningSteps

        steps = TuningSteps(guide, self._workspace, self.guarded)
        steps.send_requested.connect(self.send_requested)
        self.guided.append(steps)
        # Its three parts side by side need more than a small screen has beside a panel.
        area = QScrollArea()
        area.setFrameShape(QScrollArea.Shape.NoFrame)
        area.setWidgetResizable(True)
        area.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        area.setWidget(steps)
        _put_into(holder, area)
        steps.show_target(self.target)

    def _make_calibration(self, holder: QWidget) -> None:
        _load_plots()
        from .calibration_page import CalibrationPage

        self.calibration = CalibrationPage(self.guarded, self.read_measured)
        _put_into(holder, self.calibration)
        self.calibration.show_target(self.target)
        self.calibration.show()

    def _bring(self, row: int) -> None:
        """Show a page, and make what it has not yet."""
        self.stack.setCurrentIndex(row)
        page = self.stack.currentWidget()
        if page in self._later:
            self._later.pop(page)()

    def _arrange(self) -> None:
        self.state.setWordWrap(True)
        buttons = (self.send, self.look, self.put_back, self.take)
        bar = in_row(self.switch, (self.state, 1), *buttons, margins=(GAP2, GAP2, GAP2, 0))
        self.pages.setMinimumWidth(_LIST_WIDTH)
        titles = (self.pages.item(n).text() for n in range(self.pages.count()))
        widest = max(map(self.pages.fontMetrics().horizontalAdvance, titles), default=0)
        self.pages.setMaximumWidth(max(_LIST_WIDTH, widest + 4 * GAP2))
        self.pages.setStyleSheet("QListWidget::item { padding-left: 8px; }")
        below = in_row((self.pages, 1), (self.stack, 6))
        in_column(bar, self.message, (below, 1), on=self, margins=0)

    # -- what is tuned -------------------------------------------------------------

    def _show(self, target: TuningTarget) -> None:
        self.target = target
        for page in (*self.values, *self.guided, self.calibration, self.answer):
            if page is not None:
                page.show_target(target)
        self.switch.show_choice("file" if target is self.file_target else "control")
        self._update()

    def _update(self, *_: object) -> None:
        control = self.control if self.target is self.control else None
        for button in (self.send, self.look, self.put_back, self.take):
            button.setVisible(control is not None)
        if control is None:
            self.state.setText(
                self.tr("Changes go into the open file; Ctrl+Z takes each back.")
                if self.file_target.may_edit
                else self.tr("The file is read-only.")
            )
            return
        known, changed = control.may_edit, control.differences()
        self.send.setVisible(not control.live.is_live)
        self.send.setEnabled(known and control.waiting > 0)
        one, several = self.tr("Do&wnload 1 Value"), self.tr("Do&wnload {count} Values")
        self.send.setText(one if control.waiting == 1 else several.format(count=control.waiting))
        self.look.setVisible(not known)
        self.put_back.setEnabled(known and (changed > 0 or control.waiting > 0))
        self.take.setEnabled(known and changed > 0 and self.file_target.may_edit)
        if not known:
            text = self.tr("It is not known what the control contains.")
        elif control.live.is_live:
            text = self.tr(
                "Each change goes into the control at once. %n values changed. The file stays.", "", changed
            )
        else:
            text = self.tr(
                "This control takes all values together, in E-stop. %n values changed. The file stays.",
                "",
                changed,
            )
        self.state.setText(text)

    def _choose(self, key: str) -> None:
        if key == "file":
            self._show(self.file_target)
            return
        if self.control is None:
            # Until the control is read the file is what is tuned: connecting may fail or be cancelled.
            self.switch.show_choice("file")
            live = self._connect()
            if live is None:
                return
            try:
                self.run_exchange(self.tr("Read Control"), live.look)
                self._demand_family(live)
            # Cancelling too: an unused line must be closed, or the control stays occupied.
            except BaseException:
                live.close()
                raise
            self.control = ControlTarget(live, self.run_exchange, self._workspace)
            self.control.notified.connect(self._exchanged)
            self.control.changed.connect(self._update)
        self._show(self.control)

    def _exchanged(self, text: str) -> None:
        self.message.say(text)

    def _demand_family(self, live: LiveTuning) -> None:
        family = self._workspace.file.schema.family
        assert live.file is not None
        if live.file.schema.family.family != family.family:
            raise ValueError(
                self.tr("The control contains parameters for {found}, and the file is for {family}.").format(
                    found=live.file.schema.family.name, family=family.name
                )
            )

    # -- actions -------------------------------------------------------------------

    def guarded(self, act: Callable[[], object]) -> object:
        """Run what may fail; the error is shown in the bar,
        and what is known of the control beside the pages.
        """
        try:
            return act()
        except RangeError as error:
            self.message.say(f"{error}.", "warning")
        except (ValueError, OSError) as error:
            self.message.say(
                f"{str(error).rstrip('.')}.", "error" if isinstance(error, OSError) else "warning"
            )
        finally:
            self._update()
        return None

    def run_exchange(self, title: str, work: ControlWork) -> object:
        """Run work with the control in a dialog that shows it and can stop it; raises its error."""
        from amp_studio.ui.control.exchange import run_exchange

        return run_exchange(title, work, self, f"{title} …")

    def read_measured(self, axis: str) -> None:
        """Ask for a file of measured points and set what they make of an axis, as one step."""
        from .measured_dialog import MeasuredDialog

        kinds = self.tr("Measured points (*.csv *.txt *.rtl *.pos *.dat);;All files (*)")
        path = ask_to_open(self, self.tr("Measured Points"), self._workspace.path.parent, kinds)
        if path is None:
            return
        dialog = MeasuredDialog(self.target.file, axis, path, self)
        if run_dialog(dialog) and dialog.proposal is not None:
            self.target.set(self.tr("Calibrate axis {axis}").format(axis=axis), dialog.proposal.settings)

    def event(self, event: QEvent) -> bool:
        """Take the keys of undo and redo before the window does: a step may have gone into the control."""
        if event.type() == QEvent.Type.ShortcutOverride and _step_of(event) is not None:
            event.accept()
            return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        step = _step_of(event)
        if step is None:
            super().keyPressEvent(event)
        else:
            self.guarded(self.target.undo if step == "undo" else self.target.redo)

    def _send(self) -> None:
        assert self.control is not None
        self.control.send()

    def _read_again(self) -> None:
        assert self.control is not None
        self.control.look()

    def _put_back(self) -> None:
        assert self.control is not None
        self.control.put_back()

    def _copy_to_file(self) -> None:
        """Take what differs in the control from the first look into the file, as one step of its undo."""
        assert self.control is not None
        changes = self.control.live.changes().differences
        known = self.file_target.file.schema.parameters
        # A control of another build may have parameters that this file has no place for.
        values = {d.address: d.b for d in changes if d.address[0] in known}
        self._workspace.edit(self.tr("Take from control"), values)
        self.message.say(self.tr("%n values taken into the file, which is not saved yet.", "", len(values)))

    def escape(self) -> None:
        """Take the message away; without one go back to the values. A control stays connected."""
        if self.message.isVisible():
            self.message.hide()
        else:
            super().escape()

    # -- the end -------------------------------------------------------------------

    def may_leave(self) -> bool:
        """Offer the old values back before the file, and with it the control, is left with others."""
        self._is_asked = self.control is None or self._may_leave(self.control)
        return self._is_asked

    def _end(self) -> None:
        """Leave the control with the file; one that was not asked about yet is asked about now."""
        if self.control is not None:
            if not self._is_asked:
                self._may_leave(self.control)
            self.control.live.close()
            self.control = None

    def _may_leave(self, control: ControlTarget) -> bool:
        if not control.may_edit:
            text = self.tr("It is not known what the control contains. Verify it before the machine is used.")
            leave = self.tr("&Leave")
            return ask(self, self.tr("Tuning"), text, leave, self.tr("Cancel"), default=1) == leave
        changed, waiting = control.differences(), control.waiting
        if not changed and not waiting:
            return True
        kept = self.tr(
            "%n values of the control differ from when it was connected. The file has them only if you took"
            " them.",
            "",
            changed,
        )
        lost = self.tr("%n values were not downloaded and will be forgotten.", "", waiting)
        text = "\n".join(part for part, count in ((kept, changed), (lost, waiting)) if count)
        back, keep = self.tr("Put the Old Values &Back"), self.tr("&Keep Them in the Control")
        if not changed:
            keep = self.tr("&Forget Them")
            answer = ask(self, self.tr("Tuning"), text, keep, self.tr("Cancel"), default=1)
            return answer == keep
        # Putting back comes first, and is what Enter does: values that were not chosen to be kept are not
        # left at a machine.
        answer = ask(self, self.tr("Tuning"), text, back, keep, self.tr("Cancel"))
        if answer == back:
            self.guarded(control.put_back)
            # Only when it is proven that they are back.
            return control.may_edit and not control.differences()
        return answer == keep


def _step_of(event: QEvent) -> str | None:
    """Return what a key means: a step back, or again; None for any other."""
    if isinstance(event, QKeyEvent) and event.matches(QKeySequence.StandardKey.Undo):
        return "undo"
    if isinstance(event, QKeyEvent) and event.matches(QKeySequence.StandardKey.Redo):
        return "redo"
    return None


def _load_plots() -> None:
    """Load what draws and simulates: first in a thread, so that a page seldom waits for it."""
    parts = ("calibration_page", "measured_dialog", "step_answer", "tuning_steps")
    load("amp_studio.sim", *(f"{__package__}.{part}" for part in parts))


def _empty_page() -> QWidget:
    """Return a page whose content is made when it is first shown."""
    holder = QWidget()
    QVBoxLayout(holder).setContentsMargins(0, 0, 0, 0)
    return holder


def _put_into(holder: QWidget, widget: QWidget) -> None:
    layout = holder.layout()
    assert layout is not None
    layout.addWidget(widget)
