"""The left panel of a file: steps of commissioning, parameter groups, or the project; one of them at a
time.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import Literal, get_args

from PySide6.QtCore import Signal
from PySide6.QtGui import QPalette
from PySide6.QtWidgets import QStackedWidget, QWidget

from amp_studio.guide import step_of
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.theme import GAP2, HEAD
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.forms.segment import Segment

from .group_list import GroupList
from .steps_panel import StepsPanel

LeftSide = Literal["steps", "groups", "project"]


def as_side(kept: object) -> LeftSide | None:
    """Return a stored side; None where it is none."""
    return next((side for side in get_args(LeftSide) if side == kept), None)


class LeftPanel(QWidget):
    """Chooses which parameters the table shows, by step or by group."""

    chosen = Signal(str, list)
    """Title and parameters."""
    turned = Signal(str)
    """The person chose one of the sides."""
    value_requested, next_requested, tick_requested = Signal(object), Signal(), Signal(object)
    defaults_requested, print_requested = Signal(object), Signal()
    """Those of the steps."""

    def __init__(self, workspace: Workspace, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._workspace = workspace
        self._make_project: Callable[[], QWidget] = QWidget
        self.side: LeftSide = "groups"
        """The side that is shown."""
        self.setAutoFillBackground(True)
        self.setBackgroundRole(QPalette.ColorRole.AlternateBase)
        self._stack = QStackedWidget(self)
        in_column((self._stack, 1), on=self, margins=0, gap=0)
        self.groups = GroupList(workspace, self._stack)
        self._stack.addWidget(self.groups)
        self.groups.chosen.connect(self.chosen)
        self.head = self._head()
        """What the dock shows above the panel."""
        # An unfinished machine is set up by its steps; a finished one is looked up by groups.
        self.show_side("steps" if workspace.progress.set < workspace.progress.total else "groups")

    @cached_property
    def steps(self) -> StepsPanel:
        """The steps, made when they are first asked for."""
        steps = StepsPanel(self._workspace, self._stack)
        self._stack.addWidget(steps)
        steps.chosen.connect(self.chosen)
        steps.value_requested.connect(self.value_requested)
        steps.next_requested.connect(self.next_requested)
        steps.tick_requested.connect(self.tick_requested)
        steps.defaults_requested.connect(self.defaults_requested)
        steps.print_requested.connect(self.print_requested)
        return steps

    @cached_property
    def project(self) -> QWidget:
        """The project, made when it is first asked for."""
        project = self._make_project()
        self._stack.addWidget(project)
        return project

    def _head(self) -> QWidget:
        """Return the head of the dock: which of the three is shown."""
        self.segment = Segment(
            self.tr("Left panel"),
            [
                ("steps", self.tr("Steps"), ""),
                ("groups", self.tr("Groups"), ""),
                ("project", self.tr("Project"), ""),
            ],
            is_tight=True,
        )
        self.segment.chosen.connect(self._turn)
        head = QWidget()
        head.setFixedHeight(HEAD)
        in_row(self.segment, 0, on=head, margins=(GAP2, 0, GAP2, 0))
        return head

    def show_side(self, side: LeftSide) -> None:
        """Show steps, groups or the project; the table stays as it is."""
        widget = self.steps if side == "steps" else self.groups if side == "groups" else self.project
        self._stack.setCurrentWidget(widget)
        self.side = side
        self.segment.show_choice(side)
        self.groups.follow_edits(side == "groups")
        self.setFocusProxy(widget)

    def _turn(self, key: str) -> None:
        side = as_side(key)
        assert side is not None
        self.show_side(side)
        # Files of the project leave the table as it is.
        if side != "project":
            self.choose()
        self.turned.emit(side)

    def take_project(self, make: Callable[[], QWidget]) -> None:
        """Show what ``make`` returns as the project; it is called when the page is shown."""
        self._make_project = make

    def choose(self) -> None:
        """Emit the present choice again."""
        if self.side == "steps":
            self.steps.choose()
        else:
            self.groups.choose()

    def show_place_of(self, parameter_id: str) -> None:
        """Show the step or the group of a parameter, whichever the panel is at."""
        if self.side == "steps":
            self.steps.choose_step(step_of(self._workspace.file.schema)[parameter_id])
        else:
            self.groups.choose_group_of(parameter_id)
