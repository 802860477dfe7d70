"""The steps of commissioning beside the table: how far the file is, what is open, and what comes next."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtCore import QRect, QSize, Qt, Signal
from PySide6.QtGui import QCursor, QPainter, QPaintEvent
from PySide6.QtWidgets import (
    QGridLayout,
    QLabel,
    QMenu,
    QPushButton,
    QToolButton,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)

from amp_studio.files import axis_letter, with_local_times
from amp_studio.guide import GuideProgress, SetupStep, StepProgress, StepState
from amp_studio.schema import Address, Guide, Parameter
from amp_studio.ui.base.figures import as_tip
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.places import short_place
from amp_studio.ui.base.single_shot import single_shot
from amp_studio.ui.base.theme import FIGURE_SPACE, GAP, GAP2, GAP3, SMALL_CONTROL, Token, colour, font
from amp_studio.ui.base.translated import counted, worded
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.forms.elided_label import ElidedLabel
from amp_studio.ui.forms.icon_button import icon_button
from amp_studio.ui.forms.place_tree import COUNTS, KEY, PICTURE, RIGHT, TOKEN, PlaceTree
from amp_studio.validate import SEVERITIES

_PICTURES: dict[StepState, tuple[str, Token]] = {
    "not begun": ("circle", "dim"),
    "begun": ("circle-half", "text"),
    "done": ("check-circle-fill", "text"),
    "not needed": ("minus", "off"),
}


class _Bar(QWidget):
    """A thin line that is filled as far as the values are set."""

    def __init__(self) -> None:
        super().__init__()
        self.setFixedHeight(3)
        self._part = 0.0

    def show_part(self, part: float) -> None:
        """Fill a part of it, 0 to 1."""
        self._part = part
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.fillRect(self.rect(), colour("line2"))
        painter.fillRect(QRect(0, 0, round(self.width() * self._part), self.height()), colour("text"))


class StepsPanel(QWidget):
    """Chooses the step that the table shows; under it are the values that are not set."""

    chosen = Signal(str, list)
    """Title and parameters."""
    value_requested = Signal(object)
    """An address to go to."""
    next_requested = Signal()
    tick_requested = Signal(object)
    """A step is to be ticked as done, or its tick taken away."""
    defaults_requested = Signal(object)
    """What is not set in a step is to be set to the defaults."""
    print_requested = Signal()

    def __init__(self, workspace: Workspace, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._workspace, self._family = workspace, workspace.file.schema.family.family
        self._here: SetupStep | None = None
        """The step whose values the table shows, if it shows a step."""
        self.tree = PlaceTree(self)
        self.tree.setAccessibleName(self.tr("Steps of commissioning"))
        self.setFocusProxy(self.tree)
        in_column(self._head(), (self.tree, 1), self._footer(), on=self, margins=0, gap=0)
        self._items: dict[str, QTreeWidgetItem] = {}
        self._fill()
        self.tree.currentItemChanged.connect(self._choose)
        self.tree.itemClicked.connect(self._choose)
        self.tree.itemActivated.connect(self._activate)
        self.tree.toggled.connect(self._toggle)
        self.tree.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self.tree.customContextMenuRequested.connect(lambda place: self._menu(self.tree.itemAt(place)))
        self._later = single_shot(self, self.show_progress)
        workspace.changed.connect(self._follow)

    # -- building --------------------------------------------------------------

    def _head(self) -> QGridLayout:
        self.steps_done, self.values_set, self.bar = QLabel(), QLabel(), _Bar()
        not_set = QLabel(self.tr("not set"))
        not_set.setFont(font("caption"))
        self.values_set.setFont(font("caption"))
        for label in (self.values_set, not_set):
            label.setForegroundRole(label.palette().ColorRole.PlaceholderText)
        not_set.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.steps_done.setAccessibleName(self.tr("Steps that are done"))
        order = self._workspace.file.schema.commissioning
        if order is not None:
            page = self.tr(" (page {page})").format(page=order.page) if order.order == "manual" else ""
            self.steps_done.setToolTip(worded(order.why, self._family) + page)
        self.bar.setAccessibleName(self.tr("Part of the values that is set"))
        self.values_set.setAccessibleName(self.tr("Values that are set"))
        head = QGridLayout()
        head.setContentsMargins(GAP3, GAP2, GAP2, GAP)
        head.setVerticalSpacing(GAP2)
        head.addWidget(self.steps_done, 0, 0, 1, 2)
        head.addWidget(self.bar, 1, 0, 1, 2)
        head.addWidget(self.values_set, 2, 0)
        head.addWidget(not_set, 2, 1)
        return head

    def _footer(self) -> QVBoxLayout:
        self.later, self.show_later = ElidedLabel(), QToolButton()
        self.later.setFont(font("small"))
        self.later.setForegroundRole(self.later.palette().ColorRole.PlaceholderText)
        self.show_later.setFont(font("small"))
        self.show_later.setAutoRaise(True)
        self.show_later.setCursor(Qt.CursorShape.PointingHandCursor)
        self.show_later.clicked.connect(lambda: self._workspace.show_later(not self._workspace.shows_later))
        self.next = QPushButton(self.tr("Next Not Set  (Ctrl+.)"))
        self.next.setToolTip(self.tr("Go to the next value that is not set"))
        self.next.clicked.connect(self.next_requested)
        self.print = icon_button("printer", self.tr("Print the check list"))
        self.print.setFixedSize(QSize(28, 26))
        self.print.clicked.connect(self.print_requested)
        self.next.setMinimumHeight(SMALL_CONTROL)
        return in_column(
            in_row((self.later, 1), self.show_later),
            in_row(self.next, self.print, 0),
            margins=(GAP3, GAP, GAP2, GAP2),
            gap=GAP,
        )

    def _fill(self) -> None:
        for each in self._workspace.progress.steps:
            step = each.step
            item = QTreeWidgetItem(
                # A space as wide as a figure: titles begin below each other.
                [f"{str(step.number).rjust(2, FIGURE_SPACE)}  {worded(step.title, self._family)}"]
            )
            item.setData(0, KEY, step)
            self.tree.addTopLevelItem(item)
            self._items[step.id] = item
        for guide in self._workspace.file.schema.guides:
            self._add_guide(guide)
        self.show_progress()

    def _add_guide(self, guide: Guide) -> None:
        """Add a procedure below the steps, with its own steps below it."""
        if self.tree.topLevelItemCount() == len(self._items):
            head = QTreeWidgetItem([self.tr("Procedures")])
            head.setFlags(Qt.ItemFlag.ItemIsEnabled)
            head.setData(0, TOKEN, "dim")
            self.tree.addTopLevelItem(head)
        item = QTreeWidgetItem([worded(guide.title, self._family)])
        item.setData(0, KEY, guide)
        item.setData(0, PICTURE, ("list-numbers", "dim"))
        for n, step in enumerate(guide.steps, 1):
            below = QTreeWidgetItem([f"{n}  {worded(step.title, self._family)}"])
            below.setData(0, KEY, step)
            below.setToolTip(
                0,
                self.tr("{title}, page {page}").format(title=worded(step.title, self._family), page=step.page)
                + "".join(
                    f": {worded(text, self._family)}" if n == 0 else f"\n{worded(text, self._family)}"
                    for n, text in enumerate(filter(None, (step.what, step.look)))
                ),
            )
            item.addChild(below)
        self.tree.addTopLevelItem(item)

    # -- what is shown ---------------------------------------------------------

    def _follow(self, _: object) -> None:
        """Show the progress after the present edit, and only where it is seen."""
        if self.isVisible():
            self._later.start(0)

    def showEvent(self, event: object) -> None:
        self.show_progress()

    def show_progress(self) -> None:
        """Show how far the file is."""
        now = self._workspace.progress
        self.steps_done.setText(
            self.tr("{done} of {needed} steps").format(done=now.done, needed=len(now.needed))
        )
        self.values_set.setText(self.tr("{set} of {total} set").format(set=now.set, total=now.total))
        # A family without steps has nothing left to do.
        self.bar.show_part(now.set / now.total if now.total else 1.0)
        for each in now.steps:
            self._show_step(self._items[each.step.id], each, now)
        later = len(now.deferred)
        self.later.setText(self.tr("%n later findings held back", "", later) if later else "")
        self.show_later.setText(self.tr("Hide") if self._workspace.shows_later else self.tr("Show"))
        self.show_later.setAccessibleName(self.tr("Show later findings"))
        self.show_later.setVisible(later > 0)
        self.next.setEnabled(now.set < now.total)

    def _show_step(self, item: QTreeWidgetItem, each: StepProgress, now: GuideProgress) -> None:
        item.setData(0, PICTURE, _PICTURES[each.state])
        counts = tuple((s, each.count(s)) for s in SEVERITIES if each.count(s))
        item.setData(0, COUNTS, counts)
        item.setData(0, RIGHT, str(len(each.open)) if each.open else "")
        item.setData(0, TOKEN, _token(each, now))
        parts = [item.text(0), self._state_name(each.state)]
        found = [counted(n, severity) for severity, n in counts]
        parts += found
        parts += [self.tr("%n values not set", "", len(each.open))] if each.open else []
        item.setData(0, Qt.ItemDataRole.AccessibleTextRole, ", ".join(parts))
        item.setToolTip(
            0, as_tip("\n".join([_tip(each.step, self._family), ", ".join(self._figures(each) + found)]))
        )
        if each.step in (self._here, now.current.step if now.current else None):
            self._show_open(item, each.open)
        # Of other steps the open values are not listed: only the present one unfolds.
        elif item.childCount():
            item.takeChildren()

    def _figures(self, each: StepProgress) -> list[str]:
        """Return how far a step is, in words."""
        defaults = each.active - each.own - len(each.open)
        figures = [self._state_name(each.state)]
        figures += (
            [self.tr("{set} of {total} set").format(set=each.set, total=each.total)] if each.total else []
        )
        figures += [self.tr("%n at the default", "", defaults)] if defaults else []
        if each.ticked:
            figures.append(self.tr("ticked {when}").format(when=with_local_times(each.ticked)))
        return figures

    def _state_name(self, state: StepState) -> str:
        names = {
            "not begun": self.tr("not begun"),
            "begun": self.tr("begun"),
            "done": self.tr("done"),
            "not needed": self.tr("not needed on this machine"),
        }
        return names[state]

    def _show_open(self, item: QTreeWidgetItem, addresses: Iterable[Address]) -> None:
        """Show the open values of a step below it: each parameter once, with its axes."""
        by_parameter: dict[str, list[Address]] = {}
        for address in addresses:
            by_parameter.setdefault(address[0], []).append(address)
        # Items are used again: new ones would take the selection and the place of the scroll bar away.
        while item.childCount() > len(by_parameter):
            item.takeChild(item.childCount() - 1)
        while item.childCount() < len(by_parameter):
            item.addChild(QTreeWidgetItem())
        here = self._workspace.file.machine_schema
        for n, places in enumerate(by_parameter.values()):
            below = item.child(n)
            below.setText(0, here.label(places[0]))
            below.setData(0, KEY, places[0])
            below.setData(0, PICTURE, ("circle-dashed", "dim"))
            below.setData(0, RIGHT, self._instances(places))
            labels = ", ".join(filter(None, (short_place(self._workspace.file, a) for a in places)))
            below.setToolTip(0, " – ".join(filter(None, (here.label(places[0]), labels))))
            below.setData(
                0,
                Qt.ItemDataRole.AccessibleTextRole,
                self.tr("{what}, not set").format(what=below.toolTip(0)),
            )
        item.setExpanded(True)

    def _instances(self, places: list[Address]) -> str:
        """Return the instances of an open parameter, as short as they are known: ``X Y Z``."""
        if len(places) == 1 and not places[0][1]:
            return ""
        file, scopes = self._workspace.file, self._workspace.file.machine_schema.scopes
        names = [
            axis_letter(file, place) or place if scopes[name] == "axis" else place for name, place in places
        ]
        return " ".join(names) if len(names) <= 4 else f"{names[0]} … {names[-1]}"

    # -- choosing --------------------------------------------------------------

    def choose(self) -> None:
        """Emit the present choice again; without one it is the step that has been reached."""
        if self.tree.currentItem() is None:
            now = self._workspace.progress
            first = now.current.step if now.current else now.steps[0].step
            self.tree.setCurrentItem(self._items[first.id])
        else:
            self._choose(self.tree.currentItem())

    def choose_step(self, step: SetupStep) -> None:
        """Show a step."""
        if self._items[step.id] is not self.tree.currentItem():
            self.tree.setCurrentItem(self._items[step.id])
        else:
            self._choose(self._items[step.id])

    def _choose(self, item: QTreeWidgetItem | None, *_: object) -> None:
        place = item.data(0, KEY) if item is not None else None
        if isinstance(place, tuple):  # an open value: its step is shown, and the cursor goes there
            assert item is not None
            self._show(item.parent().data(0, KEY))
            self.value_requested.emit(place)
        elif isinstance(place, SetupStep):
            self._show(place)
        elif place is not None:
            self._show_guide(place)

    def _toggle(self, item: QTreeWidgetItem) -> None:
        """Tick the step of a place, or take its tick away."""
        step = item.data(0, KEY)
        if isinstance(step, SetupStep) and self._workspace.may_edit:
            self.tick_requested.emit(step)

    def _menu(self, item: QTreeWidgetItem | None) -> None:
        """Show what can be done with a step."""
        step = item.data(0, KEY) if item is not None else None
        if not isinstance(step, SetupStep):
            return
        each, menu = self._workspace.progress.of(step), QMenu(self)
        done = self.tr("Mark as Not &Done") if each.ticked else self.tr("Mark as &Done")
        for text, signal in (
            (done, self.tick_requested),
            (self.tr("Keep De&faults of This Step"), self.defaults_requested),
        ):
            action = menu.addAction(text)
            action.setEnabled(self._workspace.may_edit)
            action.triggered.connect(lambda *_, signal=signal: signal.emit(step))
        menu.popup(QCursor.pos())

    def _activate(self, *_: object) -> None:
        self._choose(self.tree.currentItem())

    def _show(self, step: SetupStep) -> None:
        self._here = step
        parameters = list(step.parameters)
        self.chosen.emit(
            self.tr("Step {number}").format(number=step.number) + f" › {worded(step.title, self._family)}",
            parameters,
        )
        self._later.start(0)

    def _show_guide(self, place: object) -> None:
        """Show the parameters of a procedure, or of one step of it, in its order."""
        self._here = None
        steps = place.steps if isinstance(place, Guide) else (place,)
        names = dict.fromkeys(name for step in steps for name in step.params)  # type: ignore[attr-defined]  # GuideStep
        every = self._workspace.file.schema.parameters
        parameters: list[Parameter] = [every[name] for name in names]
        self.chosen.emit(worded(place.title, self._family), parameters)  # type: ignore[attr-defined]  # both have one


def _tip(step: SetupStep, family: str) -> str:
    page = ", " + worded(f"page {step.page}") if step.page else ""
    what = f": {worded(step.what, family)}" if step.what else ""
    return f"{worded(step.title, family)}{page}{what}"


def _token(each: StepProgress, now: GuideProgress) -> str:
    """Return the colour of a step: what is not needed or comes later is dim."""
    if each.state == "not needed":
        return "dim"
    is_near = now.current is None or each.step.number <= now.current.step.number
    return "text" if is_near or each.own else "dim"
